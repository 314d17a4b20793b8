"""Layouts of `rhombloom nest` proved with GEOS (shapely): no overlap, gaps, margins, counts, grain, offcuts.

Reads nesting.json, the SVG and the DXF sheets; outlines are the two reference pieces, random concave polygons,
rectangles, and one outline written as SVG and as DXF.
"""
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile

import ezdxf
from shapely.affinity import affine_transform
from shapely.geometry import Polygon, box

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
TOLERANCE = 1e-6
failures = []


def run(outline_file, folder, *arguments):
    command = [program, "nest", str(outline_file), "-o", str(folder), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True)


def outline_file(folder, points):
    path = folder / "outline.json"
    path.write_text(json.dumps({"outline": points}))
    return path


def placed(piece, placement):
    a = math.radians(placement["angle_deg"])
    c, s = math.cos(a), math.sin(a)
    m = -1 if placement["mirrored"] else 1
    return affine_transform(piece, [c * m, -s, s * m, c, placement["x"], placement["y"]])


def smallest_gap(copies, reach):
    """Least distance between copies nearer than reach; overlaps count as negative."""
    least = math.inf
    boxes = [c.buffer(reach).bounds for c in copies]
    for i, copy in enumerate(copies):
        for j in range(i):
            (ax, ay, bx, by), (cx, cy, dx, dy) = boxes[i], copies[j].bounds
            if ax <= dx and cx <= bx and ay <= dy and cy <= by:
                distance = copy.distance(copies[j])
                overlap = copy.intersection(copies[j]).area if distance == 0 else 0
                least = min(least, distance if overlap < 1e-9 else -overlap)
    return least


def prove(name, points, data, width, height, count, spacing, margin, grain="any", mirror=False, remnant=None):
    """All facts of one nesting; returns copies per full sheet."""
    piece = Polygon(points)
    problems = []
    placements = data["placements"]
    if len(placements) != count:
        problems.append(f"{len(placements)} placements instead of {count}")
    gap = math.inf
    for index, sheet in enumerate(data["sheets"]):
        here = [p for p in placements if p["sheet"] == index]
        copies = [placed(piece, p) for p in here]
        size = remnant if remnant and index == 0 else (width, height)
        if (sheet["width_mm"], sheet["height_mm"]) != size and not (remnant and index == 0):
            problems.append(f"sheet {index} is {sheet['width_mm']} x {sheet['height_mm']}")
        if sheet["copies"] != len(here) or not here:
            problems.append(f"sheet {index} says {sheet['copies']} copies, has {len(here)}")
        gap = min(gap, smallest_gap(copies, spacing + 1))
        room = box(margin, margin, sheet["width_mm"] - margin, sheet["height_mm"] - margin).buffer(
            TOLERANCE, join_style=2)
        problems += [f"copy outside the margins of sheet {index}" for c in copies if not room.contains(c)][:1]
        o = sheet["offcut_mm"]
        offcut = box(o["x"], o["y"], o["x"] + o["width"], o["y"] + o["height"])
        if offcut.area > 0:
            problems += [f"offcut of sheet {index} is not free" for c in copies
                         if c.distance(offcut) < spacing - TOLERANCE][:1]
    if gap < spacing - TOLERANCE:
        problems.append(f"gap {gap:.9f} < {spacing}")
    for p in placements:
        turned = p["angle_deg"] % 360
        allowed = {"any": True, "half-turn": min(turned % 180, 180 - turned % 180) < 1e-9,
                   "fixed": min(turned, 360 - turned) < 1e-9}[grain]
        if not allowed or (p["mirrored"] and not mirror):
            problems.append(f"placement against the grain: {p}")
            break
    print(f"{name:34s} {width:g}x{height:g} spacing {spacing:g} margin {margin:g} {grain:9s}"
          f" {data['per_sheet']:4d} per sheet, {len(data['sheets'])} sheets, least gap {gap:.7f}"
          f"{'' if not problems else '  FAILED: ' + '; '.join(problems)}")
    failures.extend(f"{name}: {p}" for p in problems)
    return data["per_sheet"]


def check(name, points, width, height, count, spacing, margin=0, grain="any", mirror=False, remnant=None):
    with tempfile.TemporaryDirectory() as t:
        folder = pathlib.Path(t)
        arguments = ["--sheet", f"{width}x{height}", "--count", count, "--spacing", spacing, "--margin", margin,
                     "--grain", grain] + (["--mirror"] if mirror else [])
        arguments += ["--remnant", f"{remnant[0]}x{remnant[1]}"] if remnant else []
        result = run(outline_file(folder, points), folder / "out", *arguments)
        if result.returncode != 0:
            failures.append(f"{name}: {result.stderr.strip()}")
            print(f"{name}: exit {result.returncode}: {result.stderr.strip()}")
            return 0
        data = json.loads((folder / "out/nesting.json").read_text())
        return prove(name, points, data, width, height, count, spacing, margin, grain, mirror, remnant)


def expect(condition, what):
    print(("ok      " if condition else "FAILED  ") + what)
    if not condition:
        failures.append(what)


def reference(name):
    return json.loads((source / "tests/data" / name).read_text())["outline"]


def random_outline(rng):
    """A simple polygon: uneven radii round a point, sometimes turned and stretched."""
    n = rng.randint(3, 16)
    stretch = rng.uniform(0.4, 1.6)
    points = []
    for i in range(n):
        a = 2 * math.pi * (i + rng.uniform(0, 0.8)) / n
        r = rng.uniform(8, 45)
        points.append((stretch * r * math.cos(a), r * math.sin(a)))
    if rng.random() < 0.5:
        points.reverse()
    return points if Polygon(points).is_valid and Polygon(points).area > 50 else random_outline(rng)


def check_references():
    element = reference("nest_default_element.json")
    per_sheet = check("default element", element, 600, 400, 188, 2)
    expect(per_sheet >= 27, f"default element: {per_sheet} per sheet, at least 27 expected")
    piece = reference("nest_piece_a.json")
    per_sheet = check("piece A", piece, 600, 400, 188, 2)
    expect(per_sheet >= 40, f"piece A: {per_sheet} per sheet, at least 40 expected")
    check("piece A, mirrored too", piece, 495, 279, 40, 1.5, 4, mirror=True)
    check("piece A, half turns", piece, 600, 400, 60, 2, 5, grain="half-turn")
    check("piece A, remnant first", piece, 600, 400, 90, 2, 3, remnant=(350.0, 260.0))
    check("element, fixed", element, 610, 410, 30, 3, 2, grain="fixed")
    expect(check("rectangles, exact", [(0, 0), (98, 0), (98, 48), (0, 48)], 598, 398, 48, 2) == 48,
           "48 rectangles of 98 x 48 mm fill a sheet of 598 x 398 mm with gaps of 2 mm")


def check_random(seed, how_many):
    rng = random.Random(seed)
    for i in range(how_many):
        points = random_outline(rng)
        width, height = rng.choice([(600, 400), (300, 200), (495, 279), (297, 210), (413.7, 222.2)])
        check(f"random {i}", points, width, height, rng.randint(1, 60), round(rng.uniform(0, 5), 2),
              rng.choice([0, 0, 3, 7.5]), rng.choice(["any", "any", "half-turn", "fixed"]), rng.random() < 0.3)


def svg_numbers(folder):
    """All contours in a written sheet: arcs as their end points."""
    text = "".join(p.read_text() for p in sorted(folder.glob("sheet-*.svg")))
    return re.findall(r'<path[^>]*id="copy-\d+"', text)


def dxf_area(folder):
    areas = []
    for path in sorted(folder.glob("sheet-*.dxf")):
        for entity in ezdxf.readfile(path).modelspace().query('LWPOLYLINE[layer=="CUT_OUTER"]'):
            assert entity.closed
            points = entity.get_points("xyb")
            total = 0
            for (x0, y0, bulge), (x1, y1, _) in zip(points, points[1:] + points[:1]):
                total += (x0 * y1 - x1 * y0) / 2
                if bulge:
                    sweep = 4 * math.atan(bulge)
                    r = math.hypot(x1 - x0, y1 - y0) * (1 + bulge ** 2) / (4 * abs(bulge))
                    total += math.copysign(r * r / 2 * (abs(sweep) - math.sin(abs(sweep))), bulge)
            areas.append(abs(total))
    return areas


ROUND = "M10 30 V20 A10 10 0 0 1 20 10 H60 A15 15 0 0 0 90 10 H100 a 10 10 0 0 1 10 10 v10 q-50 20 -100 0 Z"


def round_dxf():
    """A slot with a bite: lines and arcs in loose pieces, in inches."""
    document = ezdxf.new("R2000")
    document.header["$INSUNITS"] = 1
    space = document.modelspace()
    space.add_line((0, 0), (3, 0))
    space.add_arc((3, 0.5), 0.5, 270, 90)
    space.add_line((3, 1), (2, 1))
    space.add_arc((1.5, 1), 0.5, 180, 0)
    space.add_line((0, 1), (1, 1))
    space.add_line((0, 1), (0, 0))
    return document


def check_formats():
    with tempfile.TemporaryDirectory() as t:
        folder = pathlib.Path(t)
        (folder / "a.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="40mm" '
                                      f'viewBox="0 0 120 40"><g transform="translate(1 2)"><path d="{ROUND}"/></g></svg>')
        result = run(folder / "a.svg", folder / "svg", "--sheet", "300x200", "--count", 12)
        expect(result.returncode == 0, f"SVG outline: {result.stdout.strip()}{result.stderr.strip()}")
        expect(len(svg_numbers(folder / "svg")) == 12, "the SVG sheets hold 12 contours")
        round_dxf().saveas(folder / "b.dxf")
        result = run(folder / "b.dxf", folder / "dxf", "--sheet", "300x200", "--count", 9)
        expect(result.returncode == 0, f"DXF outline in inches: {result.stdout.strip()}{result.stderr.strip()}")
        exact = 25.4 ** 2 * (3 + math.pi * 0.125 - math.pi * 0.125)
        areas = dxf_area(folder / "dxf")
        expect(len(areas) == 9 and all(abs(a - exact) < 1e-4 * exact for a in areas),
               f"the DXF sheets hold 9 contours of {exact:.4f} mm2: {min(areas):.4f} .. {max(areas):.4f}")
        first = {p.name: p.read_bytes() for p in (folder / "dxf").iterdir()}
        run(folder / "b.dxf", folder / "again", "--sheet", "300x200", "--count", 9)
        expect(first == {p.name: p.read_bytes() for p in (folder / "again").iterdir()}, "the same bytes twice")


def check_refusals():
    broken = {
        "open.svg": '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M0 0H9V9"/></svg>',
        "two.svg": '<svg xmlns="http://www.w3.org/2000/svg"><rect width="9" height="9"/><circle r="4"/></svg>',
        "bad.svg": '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0 L 9 x Z"/></svg>',
        "cut.svg": '<svg><path d="M0 0H9',
        "none.svg": '<svg xmlns="http://www.w3.org/2000/svg"/>',
        "cross.json": '{"outline": [[0,0],[40,40],[40,0],[0,40]]}',
        "nan.json": '{"outline": [[0,0],[NaN,40],[40,0]]}',
        "huge.json": '{"outline": [[0,0],[1e999,40],[40,0]]}',
        "text.json": '{"outline": [[0,0],["a",40],[40,0]]}',
        "empty.json": '{"outline": []}',
        "flat.json": '{"outline": [[0,0],[10,0],[20,0]]}',
        "big.json": '{"outline": [[0,0],[900,0],[900,900]]}',
        "bad.dxf": "0\nSECTION\n2\nENTITIES\nx\nLINE\n",
        "none.dxf": "0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n",
        "void.json": "",
        "what.txt": "0 0",
    }
    with tempfile.TemporaryDirectory() as t:
        folder = pathlib.Path(t)
        for name, text in broken.items():
            (folder / name).write_text(text)
            result = run(folder / name, folder / "out", "--sheet", "600x400", "--count", 3)
            expect(result.returncode == 1 and not (folder / "out").exists() and name in result.stderr,
                   f"{name} is refused: {result.stderr.strip()}")


check_references()
check_random(20260101, 24)
check_formats()
check_refusals()
for failure in failures:
    print("FAILED", failure)
sys.exit(1 if failures else 0)
