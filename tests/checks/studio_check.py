"""The studio in Chromium, by mouse alone: a bunny from an empty scene, reloaded on the way, fabricated, downloaded.

usage: studio_check.py PROGRAM SOURCE_DIR [FOLDER_FOR_SCREENSHOTS]
"""
import io
import json
import os
import subprocess
import sys
import tempfile
import zipfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from studio_server import Studio

program, source = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
pages = os.path.join(source, "build", "studio")
if not os.path.exists(os.path.join(pages, "index.html")):
    subprocess.run([os.path.join(source, "apps", "studio", "web", "build")], check=True, stdout=subprocess.DEVNULL)
work = tempfile.mkdtemp(prefix="rhombloom-studio-")
shots = os.path.abspath(sys.argv[3]) if len(sys.argv) > 3 else work
problems = []


def run(script, design):
    studio = Studio(program, design, pages)
    check = os.path.join(source, "tests", "checks", script)
    if subprocess.run(["node", check, studio.address, shots, work], check=False).returncode != 0:
        problems.append(script + " failed")
    if not studio.alive():
        problems.append("the studio died")
    errors = studio.stop()
    if errors.strip():
        problems.append("it complained: " + errors[-2000:])


bunny = os.path.join(work, "bunny.json")
run("studio_bunny.mjs", bunny)
if not problems:
    design = json.load(open(bunny))
    recorded = json.load(open(os.path.join(work, "recorded.json")))
    print(f"  {len(design['operations'])} operations: " + ", ".join(op["op"] for op in design["operations"]))
    if design["operations"] != recorded["operations"]:
        problems.append("the design is not the recorded history")
    if {"place", "merge", "extrude"} - {op["op"] for op in design["operations"]} or not any(op.get("symmetric") for op in design["operations"]):
        problems.append("the bunny lacks an operation")
    result = subprocess.run([program, "check", bunny, "--json"], capture_output=True, text=True, check=False)
    report = json.loads(result.stdout)
    if not report["buildable"] or report["elements"] != recorded["elements"]:
        problems.append(f"replayed: {report['elements']} elements instead of {recorded['elements']}, {report['problems']}")
    kit = zipfile.ZipFile(io.BytesIO(open(os.path.join(work, "kit.zip"), "rb").read()))
    manifest = json.loads(kit.read("kit/kit.json"))
    if kit.testzip() or manifest["elements"] != recorded["elements"] or "kit/booklet.pdf" not in kit.namelist():
        problems.append("the downloaded kit is not this design's")
    print(f"  kit.zip: {len(kit.namelist())} files, {manifest['elements']} elements on {manifest['sheets']} sheets")
large = os.path.join(work, "large.json")
json.dump({"rhombloom": 1, "title": "588", "operations": [{"op": "place", "shape": "checker-588"}]}, open(large, "w"))
run("studio_drag.mjs", large)
print("\n".join(problems) or "the bunny is made, and the limbs follow")
sys.exit(1 if problems else 0)
