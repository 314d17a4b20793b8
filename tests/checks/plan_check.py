"""Replays plan.json on surface.json alone and holds it to the hard rules; then spoils it in every way that matters and
expects to be told. Run as: plan_check.py PROGRAM SOURCE_DIR [--all], or plan_check.py --kit FOLDER for a finished kit;
--all: 60 designs made by chance instead of four.

H1 every element but the first joins something        H2 one piece after every step
H3 the end is the surface                             H4 only what is there is removed, and never an articulation
H5 components are built one after the other           H6 no plug (four joins) at a vertex of negative defect,
                                                          unless the whole hole lies at such vertices
H7 the open sides left are the surface's boundary     steps = inserts + removals + unhooks + hooks
"""
import copy
import json
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import random_designs

DESIGNS = {
    "ball-30": 1, "rhombic-6": 1, "polar-3x3": 1, "ball-90": 1, "tube-6x6": 1, "torus-12x6": 1, "dome-5x3": 1,
    "sheet-4x6": 1,
}


class Shape:
    """A surface: which sides meet, and which elements touch a vertex of negative defect."""

    def __init__(self, element, vertices, vertex_side, faces, facing, elements):
        self.element_of = elements
        self.ports = {}
        half_edges = {}
        for face, corners in enumerate(faces):
            for k in range(4):
                half_edges[(corners[k], corners[(k + 1) % 4])] = (elements[face], k)
        for (a, b), (e, k) in half_edges.items():
            self.ports[(e, k)] = half_edges.get((b, a))
        self.hard = self.hard_elements(element, len(vertices), vertex_side, faces, facing, half_edges)

    def hard_elements(self, element, count, vertex_side, faces, facing, half_edges):
        alpha = math.radians(element["alpha_deg"])
        angles = [0.0] * count
        boundary = set()
        for face, corners in enumerate(faces):
            for v in corners:
                acute = (vertex_side[v] == "long") == (facing[face] == "front")
                angles[v] += alpha if acute else math.pi - alpha
        for a, b in half_edges:
            if (b, a) not in half_edges:
                boundary.update((a, b))
        return {self.element_of[f] for f, corners in enumerate(faces)
                if any(v not in boundary and 2 * math.pi - angles[v] < -1e-9 for v in corners)}


def shapes_of(plan, surface):
    final = Shape(surface["element"], surface["vertices_mm"], surface["vertex_side"], surface["faces"],
                  surface["facing"], list(range(len(surface["faces"]))))
    shapes = {"final": final}
    for i, s in enumerate(plan["shapes"]):
        shapes[i] = Shape(surface["element"], s["vertices_mm"], s["vertex_side"], s["faces"], s["facing"],
                          s["elements"])
    return shapes


def pieces(present, hooked):
    left = set(present)
    count = 0
    while left:
        count += 1
        stack = [left.pop()]
        while stack:
            e = stack.pop()
            for k in range(4):
                other = hooked.get((e, k))
                if other and other[0] in left:
                    left.discard(other[0])
                    stack.append(other[0])
    return count


class Replay:
    def __init__(self, plan, surface):
        self.plan, self.surface = plan, surface
        self.shapes = shapes_of(plan, surface)
        self.count = len(surface["faces"])
        self.temporary = {t["element"] for t in plan["temporary"]}
        self.present, self.hooked, self.problems = set(), {}, []
        self.chapters, self.chapter, self.to_come = set(), None, set()
        self.score = dict.fromkeys(["steps", "inserts", "removals", "parts_needed", "exposure", "one_neighbour_inserts",
                                    "four_at_once_inserts", "negative_defect_inserts"], 0)

    def complain(self, k, rule, what):
        self.problems.append(f"step {k + 1}: {rule}: {what}")

    def check_joins(self, k, step, shape):
        e = step["element"]
        for j in step["joins"]:
            here, there = (e, j["side"]), (j["to"], j["to_side"])
            if j["to"] not in self.present:
                self.complain(k, "joins", f"element {j['to']} is not there")
            if step["op"] in ("insert", "hook"):
                if self.hooked.get(here) or self.hooked.get(there):
                    self.complain(k, "joins", f"side {j['side']} of {e} or its partner is hooked already")
                if shape.ports.get(here) != there:
                    self.complain(k, "joins", f"side {j['side']} of {e} does not meet element {j['to']} in the shape")
                self.hooked[here], self.hooked[there] = there, here
            else:
                if self.hooked.get(here) != there:
                    self.complain(k, "joins", f"side {j['side']} of {e} is not hooked to element {j['to']}")
                self.hooked.pop(here, None)
                self.hooked.pop(there, None)

    def rest_of_chapter(self, k, chapter):
        rest = set()
        for step in self.plan["steps"][k:]:
            if step["op"] == "insert" and (str(step["shape"]), step["component"]) == chapter:
                rest.add(step["element"])
            elif step["op"] == "insert":
                break
        return rest

    def easier_plug(self, e, shape):
        """Did the hole that the chapter found round e hold an element at no vertex of negative defect? Components are
        built one after the other (H5), so only the chapter's own elements could have been the plug instead."""
        hole, stack = {e}, [e]
        while stack:
            f = stack.pop()
            if f not in shape.hard:
                return True
            for side in range(4):
                other = shape.ports.get((f, side))
                if other and other[0] in self.to_come and other[0] not in hole:
                    hole.add(other[0])
                    stack.append(other[0])
        return False

    def insert(self, k, step, shape):
        e, joins = step["element"], len(step["joins"])
        if e in self.present:
            self.complain(k, "H4", f"element {e} is there already")
        if not 0 <= e < self.count and e not in self.temporary:
            self.complain(k, "H3", f"element {e} is unknown")
        if joins == 0 and self.present:
            self.complain(k, "H1", f"element {e} touches nothing")
        missing = [p for s in range(4) if (p := shape.ports.get((e, s))) and p[0] in self.present
                   and p not in [(j["to"], j["to_side"]) for j in step["joins"]]]
        if missing and not all(self.hooked.get(p) for p in missing):
            self.complain(k, "joins", f"element {e} is left unhooked from {missing}")
        chapter = (str(step["shape"]), step["component"])
        if chapter != self.chapter:
            self.to_come = self.rest_of_chapter(k, chapter)
        if joins == 4 and e in shape.hard and self.easier_plug(e, shape):
            self.complain(k, "H6", f"element {e} is a plug at a vertex of negative defect")
        if chapter != self.chapter and chapter in self.chapters:
            self.complain(k, "H5", f"component {step['component']} is taken up again")
        self.chapter = chapter
        self.chapters.add(chapter)
        self.score["inserts"] += 1
        self.score["one_neighbour_inserts"] += joins == 1
        self.score["four_at_once_inserts"] += joins == 4
        self.score["negative_defect_inserts"] += joins >= 3 and e in shape.hard

    def step(self, k, step):
        shape = self.shapes[step["shape"]]
        op, e = step["op"], step["element"]
        if op == "insert":
            self.insert(k, step, shape)
        elif op in ("remove", "unhook", "hook"):
            if e not in self.present:
                self.complain(k, "H4", f"element {e} is not there")
        else:
            self.complain(k, "op", f"unknown operation {op}")
        if op == "insert":
            self.present.add(e)
        self.check_joins(k, step, shape)
        if op == "remove":
            self.score["removals"] += 1
            self.present.discard(e)
            if any(self.hooked.get((e, s)) for s in range(4)):
                self.complain(k, "H4", f"element {e} is removed with a side still hooked")
        if pieces(self.present, self.hooked) > 1:
            self.complain(k, "H2", "the shape falls apart")
        for e in self.present:
            if e not in shape.element_of:
                self.complain(k, "shape", f"element {e} is there but not in the shape drawn")
        self.score["steps"] += 1
        self.score["exposure"] += sum(1 for e in self.present for side in range(4)
                                      if (e, side) not in self.hooked and self.is_hooked_in_the_end((e, side)))
        self.score["parts_needed"] = max(self.score["parts_needed"], len(self.present))

    def is_hooked_in_the_end(self, side):
        return side[0] >= self.count or self.shapes["final"].ports.get(side) is not None

    def finish(self):
        if self.present != set(range(self.count)):
            self.complain(len(self.plan["steps"]), "H3", "the elements at the end are not the surface's")
        final = {side: port for side, port in self.shapes["final"].ports.items() if port}
        if final != self.hooked:
            self.complain(len(self.plan["steps"]), "H3/H7", "the connections at the end are not the surface's")
        for key, value in self.score.items():
            if self.plan["scorecard"].get(key) != value:
                self.problems.append(f"scorecard: {key} is {self.plan['scorecard'].get(key)}, counted {value}")
        ops = [s["op"] for s in self.plan["steps"]]
        inserts, removals = ops.count("insert"), ops.count("remove")
        if inserts != self.count + removals:
            self.problems.append(f"{inserts} inserts, {removals} removals do not make {self.count} elements")


def problems(plan, surface):
    replay = Replay(plan, surface)
    for k, step in enumerate(plan["steps"]):
        replay.step(k, step)
    replay.finish()
    return replay.problems


def swapped(plan):
    """Exchange each step with the next one that it depends on."""
    for k in range(len(plan["steps"]) - 1):
        a, b = plan["steps"][k:k + 2]
        if any(j["to"] == a["element"] for j in b["joins"]):
            spoilt = copy.deepcopy(plan)
            spoilt["steps"][k], spoilt["steps"][k + 1] = spoilt["steps"][k + 1], spoilt["steps"][k]
            yield f"steps {k + 1} and {k + 2} swapped", spoilt


def dropped(plan):
    for k in range(len(plan["steps"])):
        spoilt = copy.deepcopy(plan)
        del spoilt["steps"][k]
        yield f"step {k + 1} dropped", spoilt


def broken_joins(plan):
    for k, step in enumerate(plan["steps"]):
        if step["joins"]:
            spoilt = copy.deepcopy(plan)
            spoilt["steps"][k]["joins"].pop()
            yield f"a join of step {k + 1} dropped", spoilt
            spoilt = copy.deepcopy(plan)
            join = spoilt["steps"][k]["joins"][0]
            join["side"] = (join["side"] + 1) % 4
            yield f"a join of step {k + 1} moved to another side", spoilt


def mutations(plan):
    yield from swapped(plan)
    yield from dropped(plan)
    yield from broken_joins(plan)
    spoilt = copy.deepcopy(plan)
    spoilt["steps"].append(copy.deepcopy(spoilt["steps"][-1]))
    yield "last step repeated", spoilt


def sample(all_mutations, plan):
    """All for small plans; for longer ones a few, among them those of steps that open and close."""
    if len(plan["steps"]) <= 120:
        return all_mutations
    opening = {k + 1 for k, step in enumerate(plan["steps"]) if step["op"] in ("unhook", "hook", "remove")}
    told = [m for m in all_mutations if int(re.search(r"\d+", m[0] + " 0")[0]) in opening]
    return told[:: max(1, len(told) // 20)] + all_mutations[:: max(1, len(all_mutations) // 20)]


def check_kit(folder, name):
    plan = json.loads((folder / "plan.json").read_text())
    surface = json.loads((folder / "surface.json").read_text())
    found = problems(plan, surface)
    undetected = []
    count = 0
    if len(plan["steps"]) <= 220:
        for what, spoilt in sample(list(mutations(plan)), plan):
            count += 1
            if not problems(spoilt, surface):
                undetected.append(what)
    print(f"{name}: {len(plan['steps'])} steps, {len(found)} problems; {count} mutations, {len(undetected)} unnoticed")
    for line in (found + undetected)[:8]:
        print("   ", line)
    return not found and not undetected


def fabricate(program, design, folder):
    file = folder / "design.json"
    file.write_text(json.dumps(design))
    subprocess.run([program, "fabricate", file, "-o", folder / "kit", "--only", "booklet"], check=True,
                   stdout=subprocess.DEVNULL)
    return folder / "kit"


def main():
    if sys.argv[1] == "--kit":
        return 0 if all([check_kit(Path(folder), folder) for folder in sys.argv[2:]]) else 1
    program, source = sys.argv[1], Path(sys.argv[2])
    ok = True
    designs = {name: {"rhombloom": 1, "title": name, "operations": [{"op": "place", "id": "body", "shape": name}]}
               for name in DESIGNS}
    for file in sorted((source / "examples").glob("*.json")):
        designs[file.name] = json.loads(file.read_text())
    for name, design in designs.items():
        with tempfile.TemporaryDirectory() as folder:
            ok &= check_kit(fabricate(program, design, Path(folder)), name)
    with tempfile.TemporaryDirectory() as folder:
        for name, kit, _ in random_designs.planned(program, folder, 60 if "--all" in sys.argv else 4):
            ok &= check_kit(kit, name)
    return 0 if ok else 1


if __name__ == "__main__":
    sys.exit(main())
