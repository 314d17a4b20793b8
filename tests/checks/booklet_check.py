"""Reads booklet.pdf back with other programs and compares it with plan.json and surface.json: what is drawn where, in
which order, how much of the next element can be seen, texts, bookmarks, fonts, PDF/A-1b, the imposed file.
Run as: booklet_check.py PROGRAM SOURCE_DIR [--all], or booklet_check.py --kit FOLDER for a finished kit. Of long booklets
every fifteenth page is read closely, with --all and of a finished kit every page.
Needs mutool, qpdf, poppler-utils, numpy; PDFBox's preflight (libpdfbox2-java) for PDF/A.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy

NEXT = (0xC8, 0x1E, 0x1E)
JARS = ["preflight", "pdfbox2", "pdfbox2-tools", "xmpbox", "fontbox2", "commons-logging", "commons-io",
        "javax.activation", "jaxb-api"]
DESIGNS = {"rhombic-6": "a4", "polar-3x3": "letter", "ball-30": "a4", "checker-120": "letter", "torus-12x6": "a4",
           "tube-6x6": "a4", "dome-5x3": "letter", "sheet-4x6": "a4", "sheet-1x1": "letter", "sheet-1x2": "a4",
           "sheet-1x5": "a4", "sheet-1x7": "letter"}


def run(*command, **options):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, **options)


def pages_of_quads(pdf, height, wanted):
    """All filled four-cornered polygons of each wanted page, in drawing order: ((4, 2) array with y up, colour)."""
    trace = run("mutool", "draw", "-F", "trace", pdf, ",".join(map(str, wanted))).stdout
    pages = {}
    for number, page in zip(wanted, re.findall(r"<page .*?</page>", trace, re.S)):
        quads = []
        for attributes, body in re.findall(r"<fill_path ([^>]*)>(.*?)</fill_path>", page, re.S):
            outline = body.split("<closepath/>")[0]  # cairo adds an empty subpath after it
            points = re.findall(r'<(?:moveto|lineto) x="([^"]*)" y="([^"]*)"', outline)
            if len(points) != 4 or "curveto" in body:
                continue
            a, b, c, d, e, f = map(float, re.search(r'transform="([^"]*)"', attributes)[1].split())
            colour = tuple(round(255 * float(v)) for v in re.search(r'color="([^"]*)"', attributes)[1].split())
            xy = numpy.array(points, float)
            xy = xy @ numpy.array([[a, b], [c, d]]) + [e, f]
            quads.append((numpy.column_stack([xy[:, 0], height - xy[:, 1]]), colour * (3 if len(colour) == 1 else 1)))
        pages[number] = quads
    return pages


class Kit:
    def __init__(self, folder, every_page=True):
        self.folder = Path(folder)
        self.plan = json.loads((self.folder / "plan.json").read_text())
        self.surface = json.loads((self.folder / "surface.json").read_text())
        self.pdf = self.folder / "booklet.pdf"
        self.problems = []
        numbers = sorted({step["page"] for step in self.plan["steps"]})
        self.pages = numbers if every_page or len(self.plan["steps"]) <= 130 else numbers[::15] + numbers[-1:]
        shapes = dict(enumerate(self.plan["shapes"]))
        final = dict(self.surface, elements=list(range(len(self.surface["faces"]))))
        self.shapes = {}
        for key, shape in {**shapes, "final": final}.items():
            vertices = numpy.array(shape["vertices_mm"])
            self.shapes[key] = {e: vertices[face] for e, face in zip(shape["elements"], shape["faces"])}

    def complain(self, text):
        self.problems.append(text)

    def states(self):
        """For each step: the step and the elements that lie there beside the step's own."""
        present = set()
        for k, step in enumerate(self.plan["steps"]):
            yield k, step, sorted(present - {step["element"]})
            present.add(step["element"])
            if step["op"] == "remove":
                present.discard(step["element"])


def projected(view, corners):
    m = numpy.array(view)
    return corners @ m[:, :3].T + m[:, 3]


class Index:
    """Finds drawn polygons by where their corners should be."""

    def __init__(self, quads):
        self.quads = quads
        self.used = [False] * len(quads)
        self.by_place = {}
        for i, (xy, _) in enumerate(quads):
            self.by_place.setdefault(tuple(numpy.round(xy.mean(axis=0)).astype(int)), []).append(i)

    def take(self, xy, accept, last=False):
        """The first, or the last drawn polygon with these corners that is not taken yet."""
        x, y = numpy.round(xy.mean(axis=0)).astype(int)
        for key in ((x + i, y + j) for i in (0, -1, 1) for j in (0, -1, 1)):
            for i in (reversed if last else list)(self.by_place.get(key, [])):
                drawn, colour = self.quads[i]
                if not self.used[i] and accept(colour) and numpy.abs(drawn - xy).max() <= 0.05:
                    self.used[i] = True
                    return i
        return None


def is_built(colour):
    return colour != NEXT and min(colour) >= 0xB0 and colour not in ((255, 255, 255), (0xFB, 0xE9, 0xB7))


def check_drawing(kit, pages):
    """Exactly one next element, the built ones as replayed, all where the camera projects them."""
    orders = {}
    indices = {}
    for k, step, built in kit.states():
        page = step["page"]
        if page not in pages:
            continue
        index = indices.setdefault(page, Index(pages[page]))
        shape = kit.shapes[step["shape"]]
        own = projected(step["view"], shape[step["element"]])[:, :2]
        wanted = (lambda c: c == (255, 255, 255)) if step["op"] == "remove" else (lambda c: c == NEXT)
        # An element to remove is white like the ghost under it, which is drawn first.
        drawn = {step["element"]: index.take(own, wanted, last=step["op"] == "remove")}
        for e in built:
            drawn[e] = index.take(projected(step["view"], shape[e])[:, :2], is_built)
        missing = [e for e, i in drawn.items() if i is None]
        if missing:
            kit.complain(f"step {k + 1}: elements {missing[:5]} are not drawn where the camera sees them")
        if step["inset"]:
            for e in built:
                index.take(projected(step["inset"]["view"], shape[e])[:, :2], is_built)
        orders[k] = [e for e, i in sorted(drawn.items(), key=lambda item: -1 if item[1] is None else item[1])]
    for page, index in indices.items():
        left = [c for (_, c), used in zip(index.quads, index.used) if not used and (c == NEXT or is_built(c))]
        if left:
            kit.complain(f"page {page}: {len(left)} elements are drawn that should not be there")
    return orders


def raster(quads, size, low, scale):
    """Each quad's pixels (two triangles): yields (index, rows, columns, depths)."""
    for i, q in enumerate(quads):
        p = numpy.column_stack([(q[:, :2] - low) * scale, q[:, 2]])
        for t in ((0, 1, 2), (0, 2, 3)):
            a, b, c = p[list(t)]
            area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            if abs(area) < 1e-9:
                continue
            x0, y0 = numpy.floor(numpy.minimum(numpy.minimum(a, b), c)[:2]).astype(int).clip(0, size - 1)
            x1, y1 = numpy.ceil(numpy.maximum(numpy.maximum(a, b), c)[:2]).astype(int).clip(0, size - 1)
            x, y = numpy.meshgrid(numpy.arange(x0, x1 + 1) + 0.37, numpy.arange(y0, y1 + 1) + 0.41)
            v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
            w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
            rows, columns = numpy.nonzero((v >= 0) & (w >= 0) & (v + w <= 1))
            v, w = v[rows, columns], w[rows, columns]
            yield i, rows + y0, columns + x0, a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2])


def wrong_pixels(step, shape, order):
    """Share of the model's pixels whose colour the drawing order gets wrong, against a z-buffer. Where elements touch
    (0.01 mm; folded ones round a vertex of valence two do) either may be seen."""
    quads = [projected(step["view"], shape[e]) for e in order]
    points = numpy.concatenate(quads)[:, :2]
    low, size = points.min(axis=0), 220
    scale = size / max(1e-9, (points.max(axis=0) - low).max())
    painted = numpy.full((size, size), -1)
    painted_depth = numpy.full((size, size), -1e30)
    depth = numpy.full((size, size), -1e30)
    for i, rows, columns, z in raster(quads, size, low, scale):
        same = painted[rows, columns] == i  # the other half of a bent element
        painted_depth[rows, columns] = numpy.where(same, numpy.maximum(painted_depth[rows, columns], z), z)
        painted[rows, columns] = i
        depth[rows, columns] = numpy.maximum(depth[rows, columns], z)
    return (painted_depth < depth - 0.01).sum() / max(1, (painted >= 0).sum())


def check_painter(kit, orders):
    steps = kit.plan["steps"]
    worst = max((wrong_pixels(steps[k], kit.shapes[steps[k]["shape"]], order), k) for k, order in orders.items())
    if worst[0] > 0.005:
        kit.complain(f"step {worst[1] + 1}: {100 * worst[0]:.2f} % of the pixels are in the wrong order")
    return worst[0]


def red_areas(kit):
    """mm2 of red that can be seen in each step's cell, from a rendering at 100 dpi."""
    height = kit.plan["paper_pt"][1]
    areas, image, shown = [], None, 0
    for k, step in enumerate(kit.plan["steps"]):
        if step["page"] not in kit.pages:
            continue
        if step["page"] != shown:
            shown = step["page"]
            data = subprocess.run(["pdftoppm", "-r", "100", "-f", str(shown), "-l", str(shown), kit.pdf],
                                  capture_output=True).stdout
            header = re.match(rb"P6\s(\d+) (\d+)\s255\s", data)
            image = numpy.frombuffer(data[header.end():], numpy.uint8).reshape(int(header[2]), int(header[1]), 3)
        x0, y0, x1, y1 = [v * 100 / 72 for v in step["cell_pt"]]
        top = height * 100 / 72
        cell = image[int(top - y1):int(top - y0), int(x0):int(x1)].astype(int)
        red = (numpy.abs(cell - NEXT).max(axis=2) < 40).sum()
        areas.append((red * 0.254 ** 2, k))
    return areas


def check_red(kit):
    areas = [(a, k) for a, k in red_areas(kit) if kit.plan["steps"][k]["op"] != "remove"]
    if not areas:
        return 0
    least, k = min(areas)
    if least < 25:
        kit.complain(f"step {k + 1}: only {least:.1f} mm2 of the next element can be seen")
    return least


def check_turns(kit):
    turns = 0
    previous = None
    for k, step in enumerate(kit.plan["steps"]):
        rows = numpy.array(step["view"])[:, :3]
        rows = rows / numpy.linalg.norm(rows, axis=1)[:, None]
        changed = previous is not None and numpy.abs(rows - previous).max() > 1e-6
        told = step["turn"]["round_deg"] != 0 or step["turn"]["tilt_deg"] != 0
        if changed != told:
            kit.complain(f"step {k + 1}: the view {'turns' if changed else 'stays'}, but the turn says otherwise")
        turns += changed
        previous = rows
    if turns != kit.plan["scorecard"]["view_turns"]:
        kit.complain(f"{turns} view turns, the scorecard says {kit.plan['scorecard']['view_turns']}")


def check_text(kit):
    text = run("pdftotext", kit.pdf, "-").stdout
    found = [int(n) for n in re.findall(r"\bStep (\d+)\b", text)]
    if found != list(range(1, len(kit.plan["steps"]) + 1)):
        kit.complain(f"\"Step k\" is not 1..{len(kit.plan['steps'])} in order: {found[:12]} ...")
    for page, body in enumerate(text.split("\f"), 1):
        here = [k + 1 for k, step in enumerate(kit.plan["steps"]) if step["page"] == page]
        if [int(n) for n in re.findall(r"\bStep (\d+)\b", body)] != here:
            kit.complain(f"page {page}: the plan puts steps {here} there")


def outline_items(node):
    return sum(1 + outline_items(child.get("kids", [])) for child in node)


def check_file(kit):
    for name in ("booklet.pdf", "booklet-imposed.pdf"):
        result = run("qpdf", "--check", kit.folder / name)
        if result.returncode != 0:
            kit.complain(f"qpdf --check {name}: {result.returncode} {result.stdout[-200:]}")
        for line in run("pdffonts", kit.folder / name).stdout.splitlines()[2:]:
            if not re.search(r"yes yes yes\s+\d+\s+\d+$", line):
                kit.complain(f"{name}: font not embedded with Unicode: {line}")
        if len(run("pdfimages", "-list", kit.folder / name).stdout.splitlines()) > 2:
            kit.complain(f"{name} has raster images")
    document = json.loads(run("qpdf", "--json", "--json-key=outlines", kit.pdf).stdout)
    chapters = 0
    previous = None
    for step in kit.plan["steps"]:
        chapters += step["component"] != previous
        previous = step["component"]
    if outline_items(document["outlines"]) != chapters + len(kit.plan["steps"]):
        kit.complain(f"{outline_items(document['outlines'])} bookmarks for {chapters} chapters and "
                     f"{len(kit.plan['steps'])} steps")
    info = run("pdfinfo", kit.pdf).stdout
    if "Tagged:          yes" not in info or not re.search(r"Title: +\S", info):
        kit.complain("not tagged, or without a title")


def check_pdfa(kit):
    paths = [Path(f"/usr/share/java/{jar}.jar") for jar in JARS]
    missing = [p.name for p in paths if not p.exists()]
    if missing:
        kit.complain(f"PDF/A not checked: {missing} (libpdfbox2-java, libactivation-java, libjaxb-api-java)")
        return
    for name in ("booklet.pdf", "booklet-imposed.pdf"):
        result = run("java", "-cp", ":".join(map(str, paths)), "org.apache.pdfbox.preflight.Validator_A1b",
                     kit.folder / name)
        if f"{name} is a valid PDF/A-1b file" not in result.stdout:
            kit.complain(f"{name} is not PDF/A-1b: {result.stdout[-300:]}")


def check_imposed(kit):
    single = run("pdftotext", kit.pdf, "-").stdout.split("\f")[:-1]
    sides = int(re.search(r"Pages: +(\d+)", run("pdfinfo", kit.folder / "booklet-imposed.pdf").stdout)[1])
    count = (len(single) + 3) // 4 * 4
    if sides != count // 2:
        kit.complain(f"the imposed file has {sides} sides for {len(single)} pages")
    width, height = kit.plan["paper_pt"][1], kit.plan["paper_pt"][0]
    for s in range(sides):
        low, high = s + 1, count - s
        for half, page in enumerate((high, low) if s % 2 == 0 else (low, high)):
            text = run("pdftotext", "-f", s + 1, "-l", s + 1, "-x", int(half * width / 2), "-y", 0, "-W",
                       int(width / 2), "-H", int(height) + 1, kit.folder / "booklet-imposed.pdf", "-").stdout
            wanted = sorted(single[page - 1].split()) if page <= len(single) else []
            if sorted(text.split()) != wanted:
                kit.complain(f"imposed side {s + 1}: page {page} should stand on half {half + 1}")


def check_kit(folder, name, every_page=True):
    kit = Kit(folder, every_page)
    pages = pages_of_quads(kit.pdf, kit.plan["paper_pt"][1], kit.pages)
    orders = check_drawing(kit, pages)
    wrong = check_painter(kit, orders)
    red = check_red(kit)
    for check in (check_turns, check_text, check_file, check_pdfa):
        check(kit)
    if len(kit.plan["steps"]) <= 60:
        check_imposed(kit)
    size = kit.pdf.stat().st_size
    if size > min(5e6, 90000 + 10000 * len(kit.plan["steps"])):
        kit.complain(f"{size} bytes for {len(kit.plan['steps'])} steps")
    print(f"{name}: {len(kit.plan['steps'])} steps, {len(pages)} pages read, {size} bytes, least red {red:.0f} mm2, wrong "
          f"pixels {100 * wrong:.2f} %, {len(kit.problems)} problems")
    for line in kit.problems[:10]:
        print("   ", line)
    return not kit.problems


def mutations_are_noticed(folder):
    """A recoloured element, a step moved in the plan and a wrong camera must be told."""
    plan = json.loads((folder / "plan.json").read_text())
    steps = plan["steps"]
    k = len(steps) // 2
    spoilt = []
    spoilt.append(dict(plan, steps=steps[:k] + [dict(steps[k], element=steps[k - 1]["element"])] + steps[k + 1:]))
    moved = [[row[0], row[1], row[2], row[3] + (0.2 if i == 0 else 0)] for i, row in enumerate(steps[k]["view"])]
    spoilt.append(dict(plan, steps=steps[:k] + [dict(steps[k], view=moved)] + steps[k + 1:]))
    spoilt.append(dict(plan, steps=steps[:k] + steps[k + 1:]))
    noticed = 0
    for other in spoilt:
        kit = Kit(folder)
        kit.plan = other
        check_drawing(kit, pages_of_quads(kit.pdf, plan["paper_pt"][1], kit.pages))
        noticed += bool(kit.problems)
    kit = Kit(folder)
    pages = {page: [(xy, (0xC0, 0xC0, 0xC0) if colour == NEXT else colour) for xy, colour in quads]
             for page, quads in pages_of_quads(kit.pdf, plan["paper_pt"][1], kit.pages).items()}
    check_drawing(kit, pages)
    noticed += bool(kit.problems)
    print(f"mutations: {noticed} of {len(spoilt) + 1} noticed")
    return noticed == len(spoilt) + 1


def fabricate(program, design, paper, folder, **environment):
    (folder / "design.json").write_text(json.dumps(design))
    subprocess.run([program, "fabricate", folder / "design.json", "-o", folder / "kit", "--only", "booklet", "--paper",
                    paper], check=True, stdout=subprocess.DEVNULL, env={**os.environ, **environment})
    return folder / "kit"


def same_everywhere(program, design):
    """Identical bytes under another locale and time zone."""
    kits = []
    for environment in ({}, {"LC_ALL": "de_DE.UTF-8", "TZ": "Asia/Tokyo"}):
        with tempfile.TemporaryDirectory() as folder:
            kit = fabricate(program, design, "a4", Path(folder), **environment)
            kits.append({f.name: f.read_bytes() for f in kit.iterdir() if f.is_file()})
    print("same bytes in another locale and time zone:", kits[0] == kits[1])
    return kits[0] == kits[1]


def main():
    if sys.argv[1] == "--kit":
        return 0 if all([check_kit(folder, folder) for folder in sys.argv[2:]]) else 1
    program, source = sys.argv[1], Path(sys.argv[2])
    designs = {name: ({"rhombloom": 1, "title": name, "operations": [{"op": "place", "id": "body", "shape": name}]},
                      paper) for name, paper in DESIGNS.items()}
    for file in sorted((source / "examples").glob("*.json")):
        designs[file.name] = (json.loads(file.read_text()), "a4")
    ok = same_everywhere(program, designs["ball-30"][0])
    for name, (design, paper) in designs.items():
        with tempfile.TemporaryDirectory() as folder:
            kit = fabricate(program, design, paper, Path(folder))
            ok &= check_kit(kit, f"{name} {paper}", "--all" in sys.argv)
            if name == "ball-30":
                ok &= mutations_are_noticed(kit)
    return 0 if ok else 1


if __name__ == "__main__":
    sys.exit(main())
