#!/usr/bin/python3
"""The glTF previews in other programs: gltf-validator, a second Draco decoder (draco3dgltf), three.js in Chromium.

usage: gltf_check.py PROGRAM SOURCE_DIR [DESIGN...]
"""
import os
import subprocess
import sys
import tempfile

PROGRAM, SOURCE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
CHECKS = os.path.join(SOURCE, "tests", "checks")
SHAPES = {"flipped": "polar-5x4", "large": "ball-270"}


def designs(folder):
    if len(sys.argv) > 3:
        return [os.path.abspath(path) for path in sys.argv[3:]]
    made = [os.path.join(SOURCE, "examples", "ball-30.json")]
    for name, shape in SHAPES.items():
        made.append(os.path.join(folder, name + ".json"))
        with open(made[-1], "w", encoding="ascii") as file:
            file.write('{"rhombloom": 1, "operations": [{"op": "place", "id": "body", "shape": "%s"}]}' % shape)
    return made


with tempfile.TemporaryDirectory() as folder:
    failed = False
    for design in designs(folder):
        kit = os.path.join(folder, "kit-" + os.path.basename(design))
        subprocess.run([PROGRAM, "fabricate", design, "-o", kit, "--only", "preview"], check=True, stdout=subprocess.DEVNULL)
        print(os.path.basename(design), flush=True)
        failed |= subprocess.run(["node", os.path.join(CHECKS, "gltf_check.mjs"), kit], check=False).returncode != 0
    sys.exit(1 if failed else 0)
