#!/usr/bin/python3
"""OpenSCAD runs every template with every preset, 2D and STL, and refuses every invalid value with a remedy.

usage: scad_check.py PROGRAM SOURCE_DIR
"""
import concurrent.futures
import json
import os
import re
import resource
import subprocess
import sys
import tempfile

SOURCE = sys.argv[2]
TEMPLATES = os.path.join(SOURCE, "templates")
NAMES = ["element", "fit_coupon", "connectors", "lamp_parts"]
SECONDS = 0.2  # for one element
failures = []


def fail(what):
    failures.append(what)
    print("FAILED:", what)


def template(name):
    return os.path.join(TEMPLATES, name + ".scad")


def presets(name):
    with open(os.path.join(TEMPLATES, name + ".json"), encoding="ascii") as file:
        return json.load(file)["parameterSets"]


def openscad(scad, out, arguments=()):
    command = ["openscad", "--hardwarnings", "-o", out, *arguments, scad]
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


def complaint(run):
    if run.returncode == 0 and not re.search(r"ERROR|WARNING|Simple: *no", run.stderr):
        return ""
    return f"exit {run.returncode}: {run.stderr.strip()[:300]}"


def open_edges(path):
    """Edges of an ASCII STL that are not used exactly once in each direction, and its number of facets."""
    with open(path, encoding="ascii") as file:
        corners = [line.split(None, 1)[1].strip() for line in file if line.lstrip().startswith("vertex")]
    used = {}
    for i in range(0, len(corners), 3):
        for a, b in ((i, i + 1), (i + 1, i + 2), (i + 2, i)):
            edge = (corners[a], corners[b])
            used[edge] = used.get(edge, 0) + 1
    bad = [e for e, n in used.items() if n != 1 or used.get((e[1], e[0])) != 1 or e[0] == e[1]]
    return bad, len(corners) // 3


def preset_arguments(path, values):
    with open(path, "w", encoding="ascii") as file:
        json.dump({"parameterSets": {"check": values}, "fileFormatVersion": "1"}, file)
    return ["-p", path, "-P", "check"]


def export_preset(job):
    """One preset of one template to SVG or STL; the complaint, if any, and the number of facets."""
    folder, name, preset, values, output = job
    stem = os.path.join(folder, re.sub(r"\W+", "_", f"{name}-{preset}-{output}"))
    out = stem + (".svg" if output == "cut" else ".stl")
    run = openscad(template(name), out, preset_arguments(stem + ".json", {**values, "output": output}))
    problem, facets = complaint(run), 0
    if not problem and output == "print":
        bad, facets = open_edges(out)
        problem = f"{len(bad)} open edges, such as {bad[0]}" if bad or not facets else ""
    if os.path.exists(out):
        os.remove(out)
    return f"{name}, {preset}, {output}: {problem}" if problem else "", facets


def check_presets(folder):
    jobs = [(folder, name, preset, values, output) for name in NAMES for preset, values in presets(name).items()
            for output in ("cut", "print")]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        results = list(pool.map(export_preset, jobs))
    for problem, _ in results:
        if problem:
            fail(problem)
    print(f"{len(jobs)} exports of {len(jobs) // 2} presets, {sum(n for _, n in results)} STL facets, all edges closed"
          if not failures else f"{len(failures)} of {len(jobs)} exports failed")


def check_presets_apply(folder):
    """A preset's values arrive: the echo tells the slit of the preset, not of the template."""
    for preset, values in list(presets("element").items())[::7]:
        out = os.path.join(folder, "a.echo")
        file = os.path.join(TEMPLATES, "element.json")
        openscad(template("element"), out, ["-p", file, "-P", preset])
        with open(out, encoding="utf-8") as echo:
            said = echo.read()
        slit = float(values["thickness"]) + float(values["slit_clearance"])
        if f"slit {slit:g} mm" not in said:
            fail(f"preset {preset}: expected slit {slit:g} mm, OpenSCAD said {said.strip()}")


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def check_time(folder):
    """Processor time, because others may use the machine; best of five, for the largest element of the table."""
    for output, suffix in (("cut", ".svg"), ("print", ".stl")):
        times = []
        for _ in range(5):
            start = processor_seconds()
            run = openscad(template("element"), os.path.join(folder, "t" + suffix),
                           ["-D", f'output="{output}"', "-D", "la=200", "-D", "lb=220"])
            times.append(processor_seconds() - start)
            if complaint(run):
                fail(f"element to {suffix}: {complaint(run)}")
        print(f"element to {suffix}: {min(times):.3f} s of processor time")
        if min(times) > SECONDS:
            fail(f"element to {suffix} takes {min(times):.3f} s, allowed are {SECONDS}")


def parameters(name):
    """What the Customizer shows: name, literal, and the range (min, max) or the choices."""
    with open(template(name), encoding="ascii") as file:
        shown = file.read().split("/* [Hidden] */")[0]
    found = []
    for key, literal, comment in re.findall(r"^(\w+) = (.*?); // \[(.*)\]$", shown, re.M):
        if literal.startswith('"'):
            found.append((key, literal, [c.split(":")[0] for c in comment.split(",")]))
        else:
            low, _, high = comment.split(":")
            found.append((key, literal, (float(low), float(high))))
    return found


def invalid_literals(limits):
    if isinstance(limits, list):
        return ['"sphere"', '""', "7"]
    low, high = limits
    return [f"{low - 0.01:g}", f"{high + 0.01:g}", "1e308", "-1e308", "0/0", '"a"', "[1,2]", "undef"]


# Pairs that are each in range and do not go together; the name that the message must begin with.
CONFLICTS = [
    ("lb", ["la=80", "lb=80"]), ("lb", ["la=80", "lb=79.5"]), ("lb", ["la=80", "lb=121"]),
    ("kerf", ["kerf=0.8"]), ("kerf", ["kerf=0.76"]), ("kerf_y", ["kerf=0.1", "kerf_y=0.9"]),
    ("lip_rounding", ['hook_sizes="given"', "lip_rounding=3.7"]),
    ("barb", ['hook_sizes="given"', "barb=3", "neck_setback=0.1"]),
    ("neck_setback", ['hook_sizes="given"', "neck_setback=3", "hole_radius=3"]),
    ("finger_width", ['hook_sizes="given"', "finger_width=25", "hole_radius=20", "lip=20"]),
    ("finger_length", ['hook_sizes="given"', "finger_length=30"]),
    ("scoop_depth", ['hook_sizes="given"', "scoop_depth=0"]),
    ("scoop_depth", ['hook_sizes="given"', "scoop_depth=45"]),
    ("layer_height", ['output="print"', "slit_clearance=0.1", "thickness=0.3", "layer_height=0.4"]),
]


def refused(job):
    """A run that must stop with one assert that names the parameter and a remedy, and write nothing."""
    folder, number, name, key, settings = job
    out = os.path.join(folder, f"r{number}.svg")
    run = openscad(template(name), out, [a for s in settings for a in ("-D", s)])
    said = re.search(r"Assertion .*? failed: \"(.*)\"", run.stderr)
    told = f"{name} with {', '.join(settings)}"
    if run.returncode != 1 or os.path.exists(out):
        return f"{told}: exit {run.returncode}, expected 1 and no file"
    if not said:
        return f"{told}: no assert but {run.stderr.strip()[:200]}"
    if not said[1].startswith(key + " is ") or not re.search(r"\b(set|choose|make)\b", said[1]):
        return f"{told}: the message names not {key} and a remedy: {said[1]}"
    return ""


def check_invalid_values(folder):
    wrong = [(name, key, [f"{key}={literal}"]) for name in NAMES for key, _, limits in parameters(name)
             for literal in invalid_literals(limits)]
    wrong += [("element", key, settings) for key, settings in CONFLICTS]
    wrong += [("lamp_parts", "part", ['part="ring"', "la=40", "lb=44", "thickness=0.2"]),
              ("lamp_parts", "part", ['part="ring"', 'socket="other"', "bore=70"]),
              ("lamp_parts", "stand_width", ['part="stand"', "lamp_radius=60", "stand_width=120"]),
              ("connectors", "rivet_hole", ["rivet_hole=2"]), ("connectors", "rivet_layers", ["rivet_layers=1.5"]),
              ("fit_coupon", "ladder_slits", ["ladder_slits=4.5"])]
    jobs = [(folder, i, *w) for i, w in enumerate(wrong)]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        problems = [p for p in pool.map(refused, jobs) if p]
    for problem in problems:
        fail(problem)
    print(f"{len(jobs)} invalid settings, {len(jobs) - len(problems)} refused with name and remedy, exit 1")


CANARY = "translate([5000, 5000]) square(1);"  # OpenSCAD writes no empty file


def overlap(folder, name, values, shapes):
    """The area in mm2 that two of a template's shapes have in common, the template set to a preset's values."""
    with open(template(name), encoding="ascii") as file:
        scad = file.read()
    stem = os.path.join(folder, "overlap")
    with open(stem + ".scad", "w", encoding="ascii") as file:
        file.write(f"{scad}\n!union() {{ intersection() {{ {shapes} }} {CANARY} }}\n")
    run = openscad(stem + ".scad", stem + ".svg", preset_arguments(stem + ".json", values))
    if complaint(run):
        fail(f"{name}, overlap of {shapes}: {complaint(run)}")
        return 0
    with open(stem + ".svg", encoding="ascii") as file:
        rings = re.findall(r"M ([^Mz]*)z", file.read())
    return abs(sum(ring_area(r) for r in rings)) - 1


def ring_area(ring):
    points = [tuple(map(float, p.split(","))) for p in re.findall(r"[-0-9.e]+,[-0-9.e]+", ring)]
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1])) / 2


SHEET = "rotate(edge_angle) translate([1.5 * wall, -({0}) / 2]) square([20, {0}]);"
# Shapes that must not touch, as far as the grip asks: template, part, shapes, most mm2 in common per mm of thickness.
FREE = [
    ("connectors", "clip", "repair_clip(); held_edges();", 1.0),
    ("lamp_parts", "ring", "ring(); held_neighbours();", 0),
    ("lamp_parts", "cap", "cap(); held_neighbours();", 0),
    ("lamp_parts", "edge_clip", "edge_clip(); " + SHEET.format("thickness"), 0.4),
]
# A sheet a fifth thicker and past the play must not pass the slots: least mm2 in common.
TIGHT = [("lamp_parts", "edge_clip", "edge_clip(); " + SHEET.format("1.2 * thickness + play"), 1.0)]


def check_fit(folder):
    """Each connector takes the sheet of its preset, and no thicker one."""
    count = 0
    for tight, table in ((False, FREE), (True, TIGHT)):
        for name, part, shapes, limit in table:
            for preset, values in presets(name).items():
                if values["part"] != part:
                    continue
                count += 1
                common = overlap(folder, name, values, shapes)
                allowed = limit * float(values["thickness"])
                if (common < allowed) if tight else (common > allowed + 0.01):
                    fail(f"{name}, {preset}: part and sheet have {common:.3f} mm2 in common, limit {allowed:.3f}")
    print(f"{count} fits of connectors to their sheets")


def main():
    if subprocess.run(["which", "openscad"], capture_output=True, check=False).returncode:
        sys.exit("OpenSCAD is not installed: the templates were NOT checked")
    with tempfile.TemporaryDirectory() as folder:
        check_time(folder)
        check_presets_apply(folder)
        check_invalid_values(folder)
        check_fit(folder)
        check_presets(folder)
    sys.exit(1 if failures else 0)


main()
