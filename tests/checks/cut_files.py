"""Reads the cut files the way other programs would, for the checks beside this file.

A path is a list of segments; a segment is (ax, ay, bx, by, bulge) in mm with y up, bulge as in DXF.
"""
import json
import math
import re
import subprocess
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import ezdxf
import numpy as np

SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
LAYERS = ["ENGRAVE", "CUT_INNER", "CUT_OUTER", "SHEET", "REFERENCE"]
NOT_CUT = ["SHEET", "REFERENCE"]

failures = []


def check(condition, message):
    if not condition:
        failures.append(message)
        if len(failures) <= 20:
            print("FAILED:", message)


def finish():
    print("failed:" if failures else "passed", len(failures) or "")
    sys.exit(1 if failures else 0)


def design(folder, la=80.0, ratio=1.1, alpha=63.435, thickness=0.5, shape="ball-30"):
    """A design file with one base shape."""
    path = Path(folder) / f"{shape}-{la:g}-{ratio:g}-{alpha:g}-{thickness:g}.json"
    path.write_text(json.dumps({
        "rhombloom": 1, "title": "check",
        "element": {"la_mm": la, "lb_mm": la * ratio, "alpha_deg": alpha, "thickness_mm": thickness},
        "operations": [{"op": "place", "id": "body", "shape": shape}]}))
    return path


def fabricate(program, design_file, out, *options):
    """The folder cut/ of the kit, or what the program refused with."""
    run = subprocess.run([program, "fabricate", str(design_file), "-o", str(out), "--only", "cut", *options],
                         capture_output=True, text=True)
    if run.returncode != 0:
        return None, run.stderr.strip()
    return Path(out) / "cut", ""


def must_fabricate(program, design_file, out, *options):
    folder, message = fabricate(program, design_file, out, *options)
    check(folder, f"fabricate {design_file.name} {' '.join(options)}: {message}")
    if not folder:
        finish()
    return folder


class Contour:
    def __init__(self, layer, segments, closed, name=""):
        self.layer, self.segments, self.closed, self.name = layer, segments, closed, name

    @property
    def arcs(self):
        return sum(1 for s in self.segments if s[4] != 0)

    @property
    def area(self):
        return sum(segment_area(s) for s in self.segments)

    @property
    def length(self):
        return sum(segment_length(s) for s in self.segments)

    def points(self, tolerance=0.002):
        return [p for s in self.segments for p in segment_points(s, tolerance)]


def segment_area(s):
    ax, ay, bx, by, bulge = s
    area = (ax * by - ay * bx) / 2
    if bulge:
        sweep = 4 * math.atan(bulge)
        radius = math.hypot(bx - ax, by - ay) / (2 * abs(math.sin(sweep / 2)))
        area += radius * radius * (sweep - math.sin(sweep)) / 2
    return area


def segment_length(s):
    ax, ay, bx, by, bulge = s
    chord = math.hypot(bx - ax, by - ay)
    half = 2 * math.atan(bulge)
    return chord if bulge == 0 else chord * half / math.sin(half)


def segment_circle(s):
    ax, ay, bx, by, bulge = s
    offset = (1 - bulge * bulge) / (4 * bulge)
    cx, cy = (ax + bx) / 2 - (by - ay) * offset, (ay + by) / 2 + (bx - ax) * offset
    return cx, cy, math.hypot(ax - cx, ay - cy)


def segment_points(s, tolerance):
    """Points from the start on, without the end."""
    ax, ay, bx, by, bulge = s
    if bulge == 0:
        return [(ax, ay)]
    cx, cy, r = segment_circle(s)
    sweep = 4 * math.atan(bulge)
    steps = max(1, math.ceil(abs(sweep) / (2 * math.acos(max(0, 1 - tolerance / r)))))
    start = math.atan2(ay - cy, ax - cx)
    return [(cx + r * math.cos(start + sweep * k / steps), cy + r * math.sin(start + sweep * k / steps))
            for k in range(steps)]


# SVG -----------------------------------------------------------------------------------------------------------------

COMMAND = re.compile(r"([MLAZ])([^MLAZ]*)")


def arc_bulge(ax, ay, bx, by, r, large, sweep):
    """Bulge, y up, of an SVG arc between points that are already y up."""
    half = min(1.0, math.hypot(bx - ax, by - ay) / 2 / r)
    angle = 2 * math.asin(half)
    if large:
        angle = 2 * math.pi - angle
    return math.tan(angle / 4) * (-1 if sweep else 1)


def svg_path(text, height):
    segments, start, at, closed = [], None, None, False
    matched = 0
    for command, arguments in COMMAND.findall(text):
        matched += 1 + len(arguments)
        numbers = [float(n) for n in arguments.split()]
        if command == "Z":
            if math.dist(at, start) > 1e-9:
                segments.append((*at, *start, 0.0))
            closed = True
            continue
        point = (numbers[-2], height - numbers[-1])
        if command == "M":
            start = point
        elif command == "L":
            segments.append((*at, *point, 0.0))
        else:
            rx, ry, rotation, large, sweep = numbers[:5]
            assert rx == ry and rotation == 0, text
            segments.append((*at, *point, arc_bulge(*at, *point, rx, large, sweep)))
        at = point
    assert matched == len(text), f"unknown SVG path commands in {text[:80]}"
    return segments, closed


class Svg:
    def __init__(self, path):
        self.path = path
        self.text = path.read_text()
        root = xml.fromstring(self.text)
        self.size = root.get("width"), root.get("height")
        self.view = [float(v) for v in root.get("viewBox").split()]
        self.width, self.height = self.view[2:]
        self.contours, self.ids, self.colours = [], [], {}
        for group in root.findall(SVG + "g"):
            layer = group.get(INKSCAPE + "label")
            self.ids.append(group.get("id"))
            for element in group:
                assert element.tag == SVG + "path", element.tag
                self.ids.append(element.get("id"))
                self.colours.setdefault(layer, set()).add(element.get("stroke"))
                segments, closed = svg_path(element.get("d"), self.height)
                self.contours.append(Contour(layer, segments, closed, element.get("id")))
        self.settings = [e.text for e in root.iter("{urn:rhombloom}setting")]

    def layer(self, name):
        return [c for c in self.contours if c.layer == name]


# DXF -----------------------------------------------------------------------------------------------------------------

def dxf_contour(entity):
    if entity.dxftype() == "LWPOLYLINE":
        vertices, closed = list(entity.get_points("xyb")), bool(entity.closed)
    else:
        vertices = [(v.dxf.location.x, v.dxf.location.y, v.dxf.get("bulge", 0.0)) for v in entity.vertices]
        closed = bool(entity.is_closed)
    ends = vertices[1:] + (vertices[:1] if closed else [])
    segments = [(a[0], a[1], b[0], b[1], a[2]) for a, b in zip(vertices, ends)]
    return Contour(entity.dxf.layer, segments, closed)


class Dxf:
    def __init__(self, path):
        self.path = path
        self.document = ezdxf.readfile(path)
        self.entities = list(self.document.modelspace())
        self.contours = [dxf_contour(e) for e in self.entities]

    def layer(self, name):
        return [c for c in self.contours if c.layer == name]


# Overlaps ------------------------------------------------------------------------------------------------------------

def overlapping(contours, tolerance=1e-3):
    """Pairs of segments that share a stretch longer than 10 micrometres."""
    segments = [s for c in contours for s in c.segments]
    lines = np.array([s[:4] for s in segments if s[4] == 0]).reshape(-1, 4)
    arcs = [s for s in segments if s[4] != 0]
    return overlapping_lines(lines, tolerance) + overlapping_arcs(arcs, tolerance)


def overlapping_lines(lines, tolerance):
    count = 0
    start, end = lines[:, :2], lines[:, 2:]
    along = end - start
    length = np.hypot(*along.T)
    along = along / length[:, None]
    for i in range(len(lines)):
        normal = np.array([-along[i, 1], along[i, 0]])
        off = np.maximum(abs((start[i + 1:] - start[i]) @ normal), abs((end[i + 1:] - start[i]) @ normal))
        for j in np.nonzero(off < tolerance)[0] + i + 1:
            a, b = sorted([(start[j] - start[i]) @ along[i], (end[j] - start[i]) @ along[i]])
            if min(b, length[i]) - max(a, 0) > 0.01:
                count += 1
    return count


def overlapping_arcs(arcs, tolerance):
    if not arcs:
        return 0
    circles = np.array([segment_circle(s) for s in arcs])
    sweeps = [4 * math.atan(s[4]) for s in arcs]
    starts = [math.atan2(s[1] - c[1], s[0] - c[0]) for s, c in zip(arcs, circles)]
    lows = [start if sweep > 0 else start + sweep for start, sweep in zip(starts, sweeps)]
    count = 0
    for i in range(len(arcs)):
        for j in np.nonzero(abs(circles[i + 1:] - circles[i]).max(axis=1) < tolerance)[0] + i + 1:
            shift = (lows[j] - lows[i]) % (2 * math.pi)
            first, second = abs(sweeps[i]), abs(sweeps[j])
            shared = max(min(first, shift + second) - shift, min(first, shift + second - 2 * math.pi))
            if shared * circles[i][2] > 0.01:
                count += 1
    return count
