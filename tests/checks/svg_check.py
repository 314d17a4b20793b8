"""Cut SVG as cutting programs want it: xmllint and rsvg-convert read it, the page is in millimetres, 1 unit = 1 mm,
absolute coordinates, closed outlines, no transform, text, style or fill. Usage: svg_check.py PROGRAM SOURCE_DIR"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from cut_files import LAYERS, Svg, check, design, finish, must_fabricate

program = sys.argv[1]


def rendered_size(path):
    """Width and height in pixels at one pixel per millimetre."""
    png = subprocess.run(["rsvg-convert", "-d", "25.4", "-p", "25.4", str(path)], capture_output=True, check=True).stdout
    return int.from_bytes(png[16:20], "big"), int.from_bytes(png[20:24], "big")


def check_text(svg):
    name = svg.path.name
    for word in ["transform", "<text", "<tspan", "<use", "<style", "style=", "class=", "clip", "<image", "<symbol"]:
        check(word not in svg.text, f"{name} holds {word}")
    paths = re.findall(r"<path [^>]*>", svg.text)
    check(paths and all('fill="none"' in p and 'stroke="#' in p and "stroke-width=" in p for p in paths),
          f"{name}: every path has fill none, a stroke and its width")
    check(not re.search(r' d="[^"]*[a-z]', svg.text), f"{name}: absolute commands only")
    check(len(svg.ids) == len(set(svg.ids)), f"{name}: ids are unique")
    check(any(s.startswith("kerf:") for s in svg.settings), f"{name}: the settings are recorded")


def check_file(path):
    subprocess.run(["xmllint", "--noout", "--nonet", str(path)], check=True)
    svg = Svg(path)
    page = [float(size.removesuffix("mm")) for size in svg.size if size.endswith("mm")]
    check([0, 0, *page] == svg.view,
          f"{path.name}: page {svg.size}, view {svg.view}")
    width, height = rendered_size(path)
    check(abs(width - svg.width) <= 1 and abs(height - svg.height) <= 1, f"{path.name}: rendered {width} x {height}")
    check_text(svg)
    for contour in svg.contours:
        check(contour.layer in LAYERS, f"{path.name}: layer {contour.layer}")
        check(contour.closed == (contour.layer not in ["ENGRAVE", "CUT_INNER"]), f"{path.name}: {contour.name} closed")
    colours = [c for colours in svg.colours.values() for c in colours]
    check(len(colours) == len(set(colours)) == len(svg.colours), f"{path.name}: one colour per layer {svg.colours}")
    print(f"{path.name}: {svg.size[0]} x {svg.size[1]}, {len(svg.contours)} paths, layers {sorted(svg.colours)}")


with tempfile.TemporaryDirectory() as folder:
    cut = must_fabricate(program, design(folder), Path(folder) / "kit")
    files = sorted(cut.glob("*.svg"))
    check(any(f.name == "coupon.svg" for f in files) and len(files) >= 2, f"files {[f.name for f in files]}")
    for file in files:
        check_file(file)
finish()
