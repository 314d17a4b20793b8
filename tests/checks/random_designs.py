"""Designs made by chance, the same ones for the same numbers: a base shape of some element, grown by extrusions, merged
with other parts, opened. Not all can be built; the program says so, and such a design is passed over."""
import json
import math
import random
import subprocess
from pathlib import Path

ELEMENTS = [{}, {"la_mm": 40, "lb_mm": 44, "alpha_deg": 52, "thickness_mm": 0.2},
            {"la_mm": 40, "lb_mm": 46, "alpha_deg": 76, "thickness_mm": 0.2},
            {"la_mm": 120, "lb_mm": 130, "alpha_deg": 63.435, "thickness_mm": 0.8},
            {"la_mm": 60, "lb_mm": 80, "alpha_deg": 70, "thickness_mm": 0.3}]
BASES = ["ball-30", "ball-90", "checker-24", "checker-80", "polar-5x6", "polar-4x5", "rhombic-12", "tube-6x6"]
PARTS = ["ball-30", "polar-3x5", "polar-4x4", "polar-5x6", "checker-24"]


def direction(chance):
    while True:
        v = [chance.uniform(-1, 1) for _ in range(3)]
        length = math.sqrt(sum(x * x for x in v))
        if 0.1 < length < 1:
            return [round(x / length, 3) for x in v]


def random_design(number):
    chance = random.Random(number)
    element = ELEMENTS[number % len(ELEMENTS)]
    unit = element.get("la_mm", 80)
    operations = [{"op": "place", "id": "body", "shape": chance.choice(BASES)}]
    for k in range(chance.randint(1, 3)):
        way = direction(chance)
        if chance.random() < 0.5:
            operations.append({"op": "extrude", "id": f"limb {k + 1}", "on": "body", "apex": {"toward": way},
                               "brush": chance.choice(PARTS),
                               "by_mm": [round(chance.uniform(1.2, 2.5) * unit * x, 1) for x in way]})
        else:
            operations.append({"op": "place", "id": f"part {k + 1}", "shape": chance.choice(PARTS),
                               "position_mm": [round(chance.uniform(1.4, 2.4) * unit * x, 1) for x in way]})
            operations.append({"op": "merge", "on": "body", "with": f"part {k + 1}"})
    for purpose in chance.sample(["lamp holder", "bulb hatch", "cable"], chance.randint(0, 2)):
        operations.append({"op": "open", "on": "body", "elements": [{"toward": direction(chance)}], "purpose": purpose})
    return {"rhombloom": 1, "title": f"Chance {number}", "element": element, "operations": operations}


def planned(program, folder, count, first=1):
    """Plan the first designs from this number on that the program does not refuse. Yields (name, folder with plan.json
    and surface.json, design)."""
    for number in range(first, first + 20 * count):
        if count == 0:
            return
        here = Path(folder) / f"chance-{number}"
        here.mkdir()
        file = here / "design.json"
        design = random_design(number)
        file.write_text(json.dumps(design))
        plan = subprocess.run([program, "plan", file, "--json"], capture_output=True)
        embedded = subprocess.run([program, "embed", file, "-o", here / "surface.json"], capture_output=True)
        if plan.returncode == 0 and embedded.returncode == 0:
            (here / "plan.json").write_bytes(plan.stdout)
            count -= 1
            yield f"chance-{number}", here, design
