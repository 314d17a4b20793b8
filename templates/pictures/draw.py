#!/usr/bin/python3
"""Draws the pictures of ../README.md: OpenSCAD's preview of every part, cropped and smoothed.

Needs openscad, xvfb and python3-pil. usage: draw.py [NAME ...]
"""
import os
import subprocess
import sys
import tempfile

from PIL import Image, ImageChops

HERE = os.path.dirname(os.path.abspath(__file__))
WIDTH, HEIGHT, MARGIN, SMOOTHING = 480, 300, 12, 4

# name: template, part, angles of the view
PICTURES = {
    "element": ("element", "", "35,0,15"),
    "fit_coupon": ("fit_coupon", "", "35,0,10"),
    "clip": ("connectors", "clip", "25,0,-10"),
    "rivet": ("connectors", "rivet", "60,0,30"),
    "holes": ("connectors", "holes", "45,0,15"),
    "ring": ("lamp_parts", "ring", "40,0,20"),
    "cap": ("lamp_parts", "cap", "40,0,20"),
    "edge_clip": ("lamp_parts", "edge_clip", "35,0,-15"),
    "cord_lock": ("lamp_parts", "cord_lock", "50,0,25"),
    "hanger": ("lamp_parts", "hanger", "55,0,35"),
    "stand": ("lamp_parts", "stand", "30,0,15"),
}


def preview(template, part, angles, out):
    size = f"{WIDTH * SMOOTHING},{HEIGHT * SMOOTHING}"
    settings = ["-D", 'output="print"'] + (["-D", f'part="{part}"'] if part else [])
    subprocess.run(["xvfb-run", "-a", "openscad", "-o", out, f"--imgsize={size}", f"--camera=0,0,0,{angles},500",
                    "--viewall", "--autocenter", "--projection=o", "--preview=full", "--colorscheme=Tomorrow", *settings,
                    os.path.join(HERE, "..", template + ".scad")], check=True, capture_output=True, timeout=120)


def framed(image):
    """The part in the middle of a frame of WIDTH x HEIGHT."""
    paper = image.getpixel((0, 0))
    box = ImageChops.difference(image, Image.new("RGB", image.size, paper)).getbbox()
    part = image.crop(box)
    scale = min((WIDTH - 2 * MARGIN) / part.width, (HEIGHT - 2 * MARGIN) / part.height)
    part = part.resize((round(part.width * scale), round(part.height * scale)), Image.LANCZOS)
    frame = Image.new("RGB", (WIDTH, HEIGHT), paper)
    frame.paste(part, ((WIDTH - part.width) // 2, (HEIGHT - part.height) // 2))
    return frame.quantize(64)


def main():
    with tempfile.TemporaryDirectory() as folder:
        for name in sys.argv[1:] or PICTURES:
            raw = os.path.join(folder, name + ".png")
            preview(*PICTURES[name], raw)
            framed(Image.open(raw).convert("RGB")).save(os.path.join(HERE, name + ".png"), optimize=True)


main()
