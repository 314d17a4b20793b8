#!/usr/bin/python3
"""The outline in a kit's hooks/element.scad, exported by OpenSCAD, against the kit's sheets: SVG and DXF.

usage: scad_kit_check.py PROGRAM SOURCE_DIR
"""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

import ezdxf
import numpy as np
from shapely.affinity import affine_transform
from shapely.geometry import Point, Polygon

PROGRAM = sys.argv[1]
AREA = 1e-4    # relative
DISTANCE = 0.01  # mm
CHORD = 0.002  # mm between an arc and its chords
failures = []

# la, lb, alpha, thickness, kerf
PIECES = [(80, 88, 63.435, 0.5, 0), (80, 88, 63.435, 0.5, 0.2), (60, 66, 69, 0.3, 0.1), (120, 128, 58, 0.8, 0.3)]


def fail(what):
    failures.append(what)
    print("FAILED:", what)


def flattened(vertices):
    """Points of a closed path of (x, y, bulge)."""
    points = []
    for (ax, ay, bulge), (bx, by, _) in zip(vertices, vertices[1:] + vertices[:1]):
        a, b, sweep = complex(ax, ay), complex(bx, by), 4 * math.atan(bulge)
        points.append(a)
        if bulge:
            radius = abs(b - a) / 2 / abs(math.sin(sweep / 2))
            pieces = math.ceil(abs(sweep) / (2 * math.acos(1 - min(1, CHORD / radius)))) + 1
            for k in range(1, pieces):
                f = k / pieces
                turn = complex(math.cos((f - 1) * sweep / 2), math.sin((f - 1) * sweep / 2))
                points.append(a + (b - a) * turn * math.sin(f * sweep / 2) / math.sin(sweep / 2))
    return Polygon([(p.real, p.imag) for p in points])


def svg_vertices(data):
    """(x, y, bulge) of one closed path of M, L, H, V, A and z in absolute coordinates, y turned up."""
    vertices = []
    for command, rest in re.findall(r"([MLHVA])([^A-Za-z]*)", data):
        n = [float(v) for v in re.findall(r"-?[\d.]+(?:e-?\d+)?", rest)]
        x, y = {"H": lambda: (n[0], -vertices[-1][1]), "V": lambda: (vertices[-1][0], n[0])}.get(
            command, lambda: (n[-2], n[-1]))()
        if command == "A" and vertices:
            px, py, _ = vertices[-1]
            half = min(1, math.hypot(x - px, -y - py) / 2 / n[0])
            bulge = math.tan(math.asin(half) / 2)
            vertices[-1] = (px, py, -bulge if n[4] == 1 else bulge)  # sweep 1 is clockwise once y points up
        vertices.append((x, -y, 0))
    if vertices[0][:2] == vertices[-1][:2]:
        vertices.pop()
    return vertices


def sheet_svg_outline(path):
    for element in xml.parse(path).iter("{http://www.w3.org/2000/svg}path"):
        if re.fullmatch(r"element-\d+", element.get("id", "")):
            return flattened(svg_vertices(element.get("d")))
    return None


def sheet_dxf_outline(path):
    pieces = [p for p in ezdxf.readfile(path).modelspace().query("LWPOLYLINE") if p.dxf.layer == "CUT_OUTER"]
    return flattened([tuple(v) for v in pieces[0].get_points("xyb")]) if pieces else None


def scad_outline(folder, scad):
    out = os.path.join(folder, "element.svg")
    run = subprocess.run(["openscad", "--hardwarnings", "-o", out, scad], capture_output=True, text=True, timeout=60)
    if run.returncode or "matches the project" not in run.stderr:
        fail(f"{scad}: exit {run.returncode}, {run.stderr[:300]}")
        return None
    with open(out, encoding="ascii") as file:
        return flattened(svg_vertices(re.search(r' d="([^"]*)"', file.read(), re.S)[1]))


def principal_angle(shape):
    ring, step = shape.exterior, 0.05
    points = np.array([ring.interpolate(d).coords[0] for d in np.arange(0, ring.length, step)])
    x, y = (points - [shape.centroid.x, shape.centroid.y]).T
    return math.atan2(2 * (x * y).sum(), (x * x).sum() - (y * y).sum()) / 2


def aligned(shape, mirror):
    """About the origin, longest direction along x. An element turned by half a turn is the same."""
    shape = affine_transform(shape, [-1 if mirror else 1, 0, 0, 1, 0, 0])
    a, c = -principal_angle(shape), shape.centroid
    matrix = [math.cos(a), -math.sin(a), math.sin(a), math.cos(a)]
    return affine_transform(affine_transform(shape, [1, 0, 0, 1, -c.x, -c.y]), [*matrix, 0, 0])


def farthest(shape, other):
    """Largest distance of a vertex of shape from the edge of other."""
    return max(other.exterior.distance(Point(p)) for p in shape.exterior.coords)


def compare(ours, theirs, told):
    """Area and largest distance, whichever face of the sheet is up."""
    target = aligned(theirs, False)
    distance = min(max(farthest(aligned(ours, m), target), farthest(target, aligned(ours, m))) for m in (False, True))
    area = abs(ours.area / theirs.area - 1)
    print(f"{told}: area differs by {100 * area:.4f} %, edge by {distance:.4f} mm")
    if area > AREA or distance > DISTANCE:
        fail(f"{told}: allowed are {100 * AREA} % and {DISTANCE} mm")


def check_kit(folder, la, lb, alpha, thickness, kerf):
    design, kit = os.path.join(folder, "design.json"), os.path.join(folder, f"kit-{la}-{kerf}")
    element = {"la_mm": la, "lb_mm": lb, "alpha_deg": alpha, "thickness_mm": thickness}
    with open(design, "w", encoding="ascii") as file:
        json.dump({"rhombloom": 1, "title": 'a"; cube(9); //', "element": element,
                   "operations": [{"op": "place", "id": "a", "shape": "ball-6"}]}, file)
    run = subprocess.run([PROGRAM, "fabricate", design, "-o", kit, "--only", "cut,hooks", "--kerf", str(kerf)],
                         capture_output=True, text=True, timeout=300)
    if run.returncode:
        fail(f"fabricate: {run.stderr}")
        return
    told = f"la {la}, kerf {kerf}"
    scad = scad_outline(folder, os.path.join(kit, "hooks", "element.scad"))
    for kind, read in (("svg", sheet_svg_outline), ("dxf", sheet_dxf_outline)):
        ours = read(os.path.join(kit, "cut", "sheet-01." + kind))
        if ours is None or scad is None:
            fail(f"{told}: no outline on the {kind} sheet or none from OpenSCAD")
        else:
            compare(ours, scad, f"{told}, {kind} against OpenSCAD")


def main():
    with tempfile.TemporaryDirectory() as folder:
        for piece in PIECES:
            check_kit(folder, *piece)
    sys.exit(1 if failures else 0)


main()
