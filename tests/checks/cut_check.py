"""Cut sheets proved with a second geometry library (GEOS): closed simple contours, as many as ordered, the spacing and
the margins kept, the kerf's area, nothing drawn twice, no segment under 0.05 mm, neighbours not cut in a row, the same
bytes again; the 1:1 template at its exact size. Odd elements, kerfs and every machine.
Usage: cut_check.py PROGRAM SOURCE_DIR"""
import hashlib
import math
import re
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

from shapely.geometry import Point, Polygon
from shapely.strtree import STRtree

from cut_files import (NOT_CUT, Svg, check, design, fabricate, finish, must_fabricate, overlapping, segment_length,
                       svg_path)

warnings.filterwarnings("ignore", module="shapely")
warnings.filterwarnings("ignore", message="STRtree")
program = sys.argv[1]
SPACING = 2.0
MACHINES = ["k40", "glowforge", "xtool-m1", "xtool-d1-pro", "xtool-s1", "xtool-p2", "epilog-zing-16", "epilog-24x12",
            "trotec-speedy-100", "cricut-12x12", "cricut-12x24", "silhouette-portrait", "silhouette-cameo-12x12",
            "silhouette-cameo-12x24", "a4", "letter"]


def digest(folder):
    return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(folder.iterdir())}


def check_contours(name, svg):
    """Simple, closed, no short segment, nothing twice."""
    cut = [c for c in svg.contours if c.layer not in NOT_CUT]
    shortest = min(segment_length(s) for c in cut for s in c.segments)
    check(shortest >= 0.05 - 1e-5, f"{name}: a segment of {shortest:.4f} mm")
    polygons = [Polygon(c.points()) for c in svg.layer("CUT_OUTER")]
    check(all(p.is_valid for p in polygons), f"{name}: a contour crosses itself")
    doubled = overlapping(svg.contours)
    check(doubled == 0, f"{name}: {doubled} segments lie on others")
    return polygons, shortest


def check_layout(name, svg, polygons, kerf, margin):
    """Finished edges are half a kerf inside of the lines; returns the least gap between them."""
    kerf_max = max(kerf)
    tree = STRtree(polygons)
    least = 1e9
    for i, polygon in enumerate(polygons):
        for other in tree.query(polygon.buffer(SPACING + 1)):
            if other is not polygon:
                least = min(least, polygon.distance(other) + kerf_max)
    check(least >= SPACING - 0.003, f"{name}: pieces {least:.4f} mm apart")
    edge = min(min(p.bounds[0], p.bounds[1], svg.width - p.bounds[2], svg.height - p.bounds[3]) for p in polygons)
    check(edge + kerf_max / 2 >= margin - 0.003, f"{name}: {edge:.4f} mm from the sheet's edge")
    return least


def check_engraving(name, svg, polygons, numbers):
    """Every mark lies well inside of the piece whose number it has."""
    pieces = {c.name: p for c, p in zip(svg.layer("CUT_OUTER"), polygons)}
    marked = set()
    for mark in svg.layer("ENGRAVE"):
        piece = mark.name.split("-mark")[0]
        marked.add(piece)
        line_points = mark.points(0.05) + [mark.segments[-1][2:4]]
        shrunk = pieces[piece].buffer(-2)
        check(all(shrunk.covers(Point(p)) for p in line_points), f"{name}: {mark.name} leaves its piece")
    check(marked == (set(pieces) if numbers else set()), f"{name}: marks on {len(marked)} of {len(pieces)} pieces")


def check_order(name, svg, polygons):
    """How many pieces are cut straight after one that lies within 10 mm of it; travel between starts."""
    starts = [c.segments[0][:2] for c in svg.layer("CUT_OUTER")]
    beside = sum(a.distance(b) <= 9.9 for a, b in zip(polygons, polygons[1:]))
    travel = sum(((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2) ** 0.5 for a, b in zip(starts, starts[1:]))
    return beside, travel


def check_sheets(label, folder, count, kerf=(0, 0), margin=3, numbers=True):
    sheets = sorted(folder.glob("sheet-*.svg"))
    total, beside, least, shortest, travel = 0, 0, 1e9, 1e9, 0
    for path in sheets:
        svg = Svg(path)
        name = f"{label} {path.name}"
        polygons, short = check_contours(name, svg)
        least = min(least, check_layout(name, svg, polygons, kerf, margin))
        check_engraving(name, svg, polygons, numbers)
        sheet_beside, way = check_order(name, svg, polygons)
        check(sheet_beside == 0 or len(polygons) < 15, f"{name}: {sheet_beside} pieces follow a neighbour")
        total, shortest, travel, beside = total + len(polygons), min(shortest, short), travel + way, beside + sheet_beside
    check(total == count, f"{label}: {total} pieces of {count}")
    check_contours(f"{label} coupon", Svg(folder / "coupon.svg"))
    print(f"{label}: {total} pieces on {len(sheets)}, least gap {least:.4f} mm, shortest segment {shortest:.4f} mm, "
          f"{beside} after a neighbour, travel {travel / 1000:.2f} m")
    return sheets


def outline_measures(folder):
    contour = Svg(folder / "sheet-01.svg").layer("CUT_OUTER")[0]
    return abs(contour.area), contour.length, contour.arcs


def check_kerf(folder, la, thickness):
    """The area grows by kerf/2 times the length, and once round the corner disc's area."""
    file = design(folder, la=la, thickness=thickness, shape="rhombic-6")
    nominal = None
    for kerf in [0, 0.05, 0.1, 0.2, 0.3, 0.4]:
        cut = must_fabricate(program, file, Path(folder) / f"kerf-{la:g}-{kerf}", "--kerf", str(kerf))
        check_sheets(f"la {la:g} kerf {kerf}", cut, 6, (kerf, kerf))
        area, length, _ = outline_measures(cut)
        nominal = nominal or (area, length)
        slits = len(Svg(cut / "sheet-01.svg").layer("CUT_INNER"))
        expected = nominal[0] + nominal[1] * kerf / 2 + math.pi * kerf * kerf / 4
        if slits == 0:
            check(abs(area / expected - 1) < 2e-4, f"la {la:g} kerf {kerf}: area {area:.3f}, expected {expected:.3f}")


def template_paths(pdf):
    """Stroked paths of the first page in mm, read from its content stream; curves become chords."""
    plain = subprocess.run(["qpdf", "--qdf", "--object-streams=disable", str(pdf), "-"], capture_output=True,
                           check=True).stdout.decode("latin-1")
    stream = next(s for s in re.findall(r"\nstream\n(.*?)\nendstream", plain, re.S) if " re" in s)
    paths, current, numbers = [], [], []
    for token in stream.split():
        if re.fullmatch(r"[-+]?[\d.]+", token):
            numbers.append(float(token) * 25.4 / 72)
            continue
        if token == "re":
            x, y, w, h = numbers
            current += [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
        elif token in ("m", "l"):
            current.append(tuple(numbers))
        elif token == "c":
            current += cubic(current[-1], numbers)
        elif token == "S":
            paths, current = paths + [current], []
        numbers = []
    return paths


def cubic(start, c):
    steps = [k / 32 for k in range(1, 33)]
    return [tuple((1 - t) ** 3 * start[a] + 3 * t * (1 - t) ** 2 * c[a] + 3 * t * t * (1 - t) * c[2 + a]
                  + t ** 3 * c[4 + a] for a in (0, 1)) for t in steps]


def check_template(label, folder, tiled):
    pdf = folder / "template-1to1.pdf"
    quality = subprocess.run(["qpdf", "--check", str(pdf)], capture_output=True, text=True)
    check(quality.returncode == 0, f"{label}: qpdf {quality.stdout} {quality.stderr}")
    fonts = subprocess.run(["pdffonts", str(pdf)], capture_output=True, text=True, check=True).stdout.splitlines()
    check(len(fonts) == 2, f"{label}: the template holds fonts {fonts[2:]}")
    sizes = [box(points) for points in template_paths(pdf)]
    squares = [s for s in sizes if abs(s[0] - 50) < 0.01 and abs(s[1] - 50) < 0.01]
    check(len(squares) == 1, f"{label}: {len(squares)} squares of 50 mm among {sizes[:5]}")
    if tiled or not squares:
        return print(f"{label}: template tiled, square {squares}")
    areas = [Polygon(points).area for points in template_paths(pdf) if len(points) > 100 and box(points)[0] > 30]
    nominal = outline_measures(folder)[0]
    worst = max(abs(a / nominal - 1) for a in areas)
    check(areas and worst < 1e-4, f"{label}: template area off by {worst:.2e}")
    print(f"{label}: template {len(areas)} pieces, area off by {worst:.1e}, square {squares[0][0]:.4f} mm")


def box(points):
    xs, ys = zip(*points)
    return max(xs) - min(xs), max(ys) - min(ys)


with tempfile.TemporaryDirectory() as folder:
    folder = Path(folder)
    ball = design(folder)
    first = must_fabricate(program, ball, folder / "a")
    check_sheets("default", first, 30)
    check_template("default", first, tiled=False)
    check(digest(first) == digest(must_fabricate(program, ball, folder / "b")), "a second run wrote other bytes")
    check_sheets("spares", must_fabricate(program, ball, folder / "c", "--spares", "10%"), 33)
    check_sheets("no engraving", must_fabricate(program, ball, folder / "d", "--no-engraving"), 30, numbers=False)
    for la, ratio, alpha, thickness in [(40, 1.1, 63.435, 0.25), (40, 1.05, 78, 0.2), (55, 1.12, 55, 0.3),
                                        (120, 1.06, 69, 0.8), (200, 1.1, 60, 0.8), (150, 1.15, 72, 0.5)]:
        label = f"la {la} lb/la {ratio} alpha {alpha} t {thickness}"
        cut, message = fabricate(program, design(folder, la, ratio, alpha, thickness), folder / label)
        if cut is None:
            check(re.search(r"\bC\d+\b|la|alpha", message), f"{label}: refused without a reason: {message}")
            print(f"{label}: refused: {message}")
            continue
        check_sheets(label, cut, 30)
        check_template(label, cut, tiled=la >= 150)
    check_kerf(folder, 80, 0.5)
    check_kerf(folder, 40, 0.25)
    for machine in MACHINES:
        cut = must_fabricate(program, ball, folder / machine, "--machine", machine, "--kerf", "0.15")
        check_sheets(machine, cut, 30, (0.15, 0.15))
    for refused in [["--machine", "toaster"], ["--sheet", "60x40"], ["--sheet", "1e9x400"], ["--sheet", "abc"]]:
        cut, message = fabricate(program, ball, folder / "refused", *refused)
        check(cut is None and message.count("\n") == 0 and not (folder / "refused").exists(),
              f"{refused}: not refused in one sentence: {message}")
finish()
