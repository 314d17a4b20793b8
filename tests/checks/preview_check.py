#!/usr/bin/python3
"""preview.html in Chromium from file://: steps, click, deep link, keyboard, phone; no request, no error; sizes.

usage: preview_check.py PROGRAM SOURCE_DIR [DESIGN...]
"""
import os
import subprocess
import sys
import tempfile

PROGRAM, SOURCE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
EXAMPLES = os.path.join(SOURCE, "examples")
failed = False
with tempfile.TemporaryDirectory() as folder:
    for design in sys.argv[3:] or [os.path.join(EXAMPLES, "ball-30.json"), os.path.join(EXAMPLES, "bunny.json")]:
        kit = os.path.join(folder, os.path.basename(design))
        subprocess.run([PROGRAM, "fabricate", design, "-o", kit, "--only", "preview"], check=True, stdout=subprocess.DEVNULL)
        page = os.path.join(kit, "preview.html")
        print(f"{os.path.basename(design)}: preview.html {os.path.getsize(page)} bytes", flush=True)
        check = os.path.join(SOURCE, "tests", "checks", "preview_check.mjs")
        failed |= subprocess.run(["node", check, page], check=False).returncode != 0
sys.exit(1 if failed else 0)
