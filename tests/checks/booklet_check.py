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
DPI = 100
JARS = ["preflight", "pdfbox2", "pdfbox2-tools", "xmpbox", "fontbox2", "commons-logging", "commons-io",
        "javax.activation", "jaxb-api"]
DESIGNS = {"rhombic-6": "a4", "polar-3x3": "letter", "ball-30": "a4", "checker-120": "letter", "torus-12x6": "a4",
           "tube-6x6": "a4", "dome-5x3": "letter", "sheet-4x6": "a4", "sheet-1x1": "letter", "sheet-1x2": "a4",
           "sheet-1x5": "a4", "sheet-1x7": "letter", "sheet-2x4": "a4"}


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
        self.printed = None
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

    def images(self):
        """The pages that are read, printed: (page, pixels)."""
        if self.printed is None:
            self.printed = []
            for page in self.pages:
                data = subprocess.run(["pdftoppm", "-r", str(DPI), "-f", str(page), "-l", str(page), self.pdf],
                                      capture_output=True).stdout
                header = re.match(rb"P6\s(\d+) (\d+)\s255\s", data)
                size = int(header[2]), int(header[1]), 3
                self.printed.append((page, numpy.frombuffer(data[header.end():], numpy.uint8).reshape(size)))
        return self.printed

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
    """Exactly one next element, the built ones as replayed, all where the camera projects them. Returns each step's
    elements with their tints."""
    tints = {}
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
        tints[k] = {e: None if i is None else index.quads[i][1] for e, i in drawn.items()}
    for page, index in indices.items():
        left = [c for (_, c), used in zip(index.quads, index.used) if not used and (c == NEXT or is_built(c))]
        if left:
            kit.complain(f"page {page}: {len(left)} elements are drawn that should not be there")
    return tints


def raster(quads, shape, origin, scale):
    """Each quad's pixels (two triangles): yields (index, rows, columns, depths). Rows grow downward from the origin."""
    for i, q in enumerate(quads):
        p = numpy.column_stack([(q[:, 0] - origin[0]) * scale, (origin[1] - q[:, 1]) * scale, q[:, 2]])
        for t in ((0, 1, 2), (0, 2, 3)):
            a, b, c = p[list(t)]
            area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            if abs(area) < 1e-9:
                continue
            limit = numpy.array([shape[1], shape[0]])
            x0, y0 = numpy.floor(numpy.minimum(numpy.minimum(a, b), c)[:2]).astype(int).clip(0, limit)
            x1, y1 = numpy.ceil(numpy.maximum(numpy.maximum(a, b), c)[:2]).astype(int).clip(0, limit)
            x, y = numpy.meshgrid(numpy.arange(x0, x1) + 0.5, numpy.arange(y0, y1) + 0.5)
            v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
            w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
            rows, columns = numpy.nonzero((v >= 0) & (w >= 0) & (v + w <= 1))
            v, w = v[rows, columns], w[rows, columns]
            yield i, rows + y0, columns + x0, a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2])


def same_round_about(ids):
    """Pixels whose eight neighbours show the same element."""
    inner = numpy.zeros(ids.shape, bool)
    middle = ids[1:-1, 1:-1]
    inner[1:-1, 1:-1] = middle >= 0
    for y in range(3):
        for x in range(3):
            inner[1:-1, 1:-1] &= ids[y:ids.shape[0] - 2 + y, x:ids.shape[1] - 2 + x] == middle
    return inner


def in_blocks(pixels):
    """Those in a square of four: the edge of a dot may have any tint, but only in single pixels."""
    blocks = pixels[:-1, :-1] & pixels[1:, :-1] & pixels[:-1, 1:] & pixels[1:, 1:]
    result = numpy.zeros(pixels.shape, bool)
    for y, x in ((0, 0), (0, 1), (1, 0), (1, 1)):
        result[y:y + blocks.shape[0], x:x + blocks.shape[1]] |= blocks
    return result


def wrong_pixels(kit, step, tints, image):
    """Share of the model's pixels, lines aside, in which the printed page shows the tint of an element that a z-buffer
    says is hidden there. Where elements touch (0.01 mm; folded ones round a vertex of valence two do) either may be
    seen; lines, dots, numbers and arrows over the model are no element's tint."""
    shape = kit.shapes[step["shape"]]
    elements = [e for e in tints if tints[e] is not None]
    quads = [projected(step["view"], shape[e]) for e in elements]
    x0, y0, x1, y1 = step["cell_pt"]
    scale = DPI / 72
    top, left = int(image.shape[0] - y1 * scale), int(x0 * scale)
    cell = image[top:int(image.shape[0] - y0 * scale), left:int(x1 * scale)].astype(int)
    origin = (left / scale, (image.shape[0] - top) / scale)
    depth, ids = numpy.full(cell.shape[:2], -1e30), numpy.full(cell.shape[:2], -1)
    covered = list(raster(quads, cell.shape[:2], origin, scale))
    for i, rows, columns, z in covered:
        nearer = z > depth[rows, columns]
        depth[rows[nearer], columns[nearer]] = z[nearer]
        ids[rows[nearer], columns[nearer]] = i
    right, wrong = numpy.zeros(ids.shape, bool), numpy.zeros(ids.shape, bool)
    for i, rows, columns, z in covered:
        shows = numpy.abs(cell[rows, columns] - tints[elements[i]]).max(axis=1) <= 2
        seen = z >= depth[rows, columns] - 0.01
        right[rows, columns] |= shows & seen
        wrong[rows, columns] |= shows & ~seen
    counted = same_round_about(ids)
    if step["inset"]:
        y, x = numpy.mgrid[:ids.shape[0], :ids.shape[1]] + 0.5
        cx, cy = step["inset"]["centre_pt"]
        counted &= numpy.hypot(x / scale + origin[0] - cx, origin[1] - y / scale - cy) > step["inset"]["radius_pt"] + 1
    return in_blocks(wrong & ~right & counted).sum() / max(1, counted.sum())


def check_visible(kit, tints):
    worst = (0, 0)
    for page, image in kit.images():
        steps = [k for k in tints if kit.plan["steps"][k]["page"] == page]
        worst = max([worst] + [(wrong_pixels(kit, kit.plan["steps"][k], tints[k], image), k) for k in steps])
    if worst[0] > 0.005:
        kit.complain(f"step {worst[1] + 1}: {100 * worst[0]:.2f} % of the pixels show what should be hidden")
    return worst[0]


def red_areas(kit):
    """mm2 of red that can be seen in each step's cell."""
    areas = []
    for page, image in kit.images():
        for k, step in enumerate(kit.plan["steps"]):
            if step["page"] == page:
                x0, y0, x1, y1 = [v * DPI / 72 for v in step["cell_pt"]]
                top = image.shape[0]
                cell = image[int(top - y1):int(top - y0), int(x0):int(x1)].astype(int)
                red = (numpy.abs(cell - NEXT).max(axis=2) < 40).sum()
                areas.append((red * (25.4 / DPI) ** 2, k))
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
    words = " ".join(text.split())
    if "bulb hatch between" in words and "is the bulb hatch" in words:
        kit.complain("an opening and an element are both called the bulb hatch")


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
    wrong = check_visible(kit, check_drawing(kit, pages))
    red = check_red(kit)
    for check in (check_turns, check_text, check_file, check_pdfa):
        check(kit)
    if len(kit.plan["steps"]) <= 60:
        check_imposed(kit)
    size = kit.pdf.stat().st_size
    small = len(kit.surface["faces"]) <= 188
    if size > min(1e6 if small else 5e6, 8600 * max(30, len(kit.plan["steps"]))):
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
    kit = Kit(folder)
    tints = check_drawing(kit, pages_of_quads(kit.pdf, plan["paper_pt"][1], kit.pages))
    for step in kit.plan["steps"]:
        step["view"][2] = [-v for v in step["view"][2]]  # as if the hidden half were in front
    check_visible(kit, tints)
    noticed += bool(kit.problems)
    print(f"mutations: {noticed} of {len(spoilt) + 2} noticed")
    return noticed == len(spoilt) + 2


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
