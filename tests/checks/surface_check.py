"""surface.json of every library shape, recomputed from the file alone: tags, Gauss-Bonnet, limits, energies, gradient.
An independent derivation with numpy: no code is shared with the program."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
ELEMENTS = [
    {"la_mm": 80, "lb_mm": 88, "alpha_deg": 63.435, "thickness_mm": 0.5},
    {"la_mm": 40, "lb_mm": 43, "alpha_deg": 60, "thickness_mm": 0.25},
]


def corner_angles(s):
    """faces x 4: acute iff (side is long) == (facing is front)."""
    alpha = math.radians(s["element"]["alpha_deg"])
    angles = []
    for face, facing in zip(s["faces"], s["facing"]):
        angles.append([alpha if (s["vertex_side"][v] == "long") == (facing == "front") else math.pi - alpha
                       for v in face])
    return np.array(angles)


def springs(s):
    e = s["element"]
    la, lb, alpha = e["la_mm"], e["lb_mm"], math.radians(e["alpha_deg"])
    short = math.sqrt(la * la + lb * lb - 2 * la * lb * math.cos(alpha))
    long = math.sqrt(la * la + lb * lb + 2 * la * lb * math.cos(alpha))
    result = []
    for face, facing in zip(s["faces"], s["facing"]):
        for k in range(4):
            a, b = face[k], face[(k + 1) % 4]
            result.append((a, b, lb if s["vertex_side"][a] == "long" else la))
        acute_even = (s["vertex_side"][face[0]] == "long") == (facing == "front")
        result.append((face[0], face[2], long if acute_even else short))
        result.append((face[1], face[3], short if acute_even else long))
    return result


def hinges(s):
    """(a, b, left, right): the edge from a to b and the corner triangles' third vertices at one of its ends."""
    nxt = {}
    for face in s["faces"]:
        for k in range(4):
            nxt[face[k], face[(k + 1) % 4]] = (face[(k + 2) % 4], face[(k + 3) % 4])
    result = []
    for (a, b), (c, d) in nxt.items():
        if a < b and (b, a) in nxt:
            e, f = nxt[b, a]  # right face (b, a, e, f)
            if d != e:
                result.append((a, b, d, e))
            if c != f:
                result.append((a, b, c, f))
    return result


def energies(s, x):
    spring = 0.0
    for a, b, rest in springs(s):
        length = np.linalg.norm(x[a] - x[b])
        spring += (100 if length > rest else 1) / rest * (length - rest) ** 2
    weight = s["embedding"]["concavity_weight"] * s["element"]["la_mm"]
    concavity = 0.0
    for a, b, left, right in hinges(s):
        edge = x[b] - x[a]
        n1 = np.cross(edge, x[left] - x[a])
        n2 = np.cross(x[right] - x[a], edge)
        gamma = math.atan2(np.dot(np.cross(n1, n2), edge / np.linalg.norm(edge)), np.dot(n1, n2))
        concavity += weight * gamma ** 2 * (1 if gamma < 0 else s["embedding"]["convex_weight"])
    return spring, concavity


def check(s, name):
    problems = []
    x = np.array(s["vertices_mm"])
    faces = s["faces"]
    edges = {}
    for f, face in enumerate(faces):
        for k in range(4):
            a, b = face[k], face[(k + 1) % 4]
            if s["vertex_side"][a] == s["vertex_side"][b]:
                problems.append(f"sides do not alternate in element {f}")
            if (a, b) in edges:
                problems.append(f"edge {a}-{b} twice in one direction")
            edges[a, b] = f
    boundary = {v for a, b in edges if (b, a) not in edges for v in (a, b)}
    undirected = {tuple(sorted(e)) for e in edges}
    euler = len(x) - len(undirected) + len(faces)
    total = np.zeros(len(x))
    for face, angles in zip(faces, corner_angles(s)):
        for v, angle in zip(face, angles):
            total[v] += angle
    defects = np.array([(math.pi if v in boundary else 2 * math.pi) - total[v] for v in range(len(x))])
    if abs(defects.sum() - 2 * math.pi * euler) > 1e-9:
        problems.append("Gauss-Bonnet fails")
    alpha = math.radians(s["element"]["alpha_deg"])
    low, high = 2 * math.pi - 4 * (math.pi - alpha) - alpha, 2 * math.pi - 2 * alpha
    inner = [defects[v] for v in range(len(x)) if v not in boundary]
    if inner and not (low - 1e-9 <= min(inner) and max(inner) <= high + 1e-9):
        problems.append("a defect leaves the limits")
    e = s["embedding"]
    spring, concavity = energies(s, x)
    if abs(spring - e["spring_energy_mm"]) > 1e-5 or abs(concavity - e["concavity_energy_mm"]) > 1e-5:
        problems.append(f"energies {spring} {concavity} are not the file's")
    stretch = max((np.linalg.norm(x[a] - x[b]) - rest) / rest for a, b, rest in springs(s))
    if abs(stretch - e["max_stretch"]) > 1e-9:
        problems.append(f"largest stretch {stretch} is not the file's {e['max_stretch']}")
    if not e["converged"] or e["gradient_norm"] > 1e-6:
        problems.append(f"not at rest: gradient {e['gradient_norm']}")
    problems += gradient_problem(s, x)
    return [f"{name}: {p}" for p in problems]


def gradient_problem(s, x, samples=4, step=1e-5):
    """Central differences at a few vertices: the positions really are an equilibrium."""
    for v in range(0, len(x), max(1, len(x) // samples)):
        for axis in range(3):
            moved = x.copy()
            moved[v, axis] += step
            up = sum(energies(s, moved))
            moved[v, axis] -= 2 * step
            down = sum(energies(s, moved))
            if abs(up - down) / (2 * step) > 1e-4:  # a spring at rest has a kink: the quotient is off by 50 step / L
                return [f"gradient {(up - down) / (2 * step)} at vertex {v}"]
    return []


problems = []
count = 0
shapes = [row["name"] for row in json.loads(subprocess.check_output([program, "shapes", "--json"]))]
with tempfile.TemporaryDirectory() as folder:
    for element in ELEMENTS:
        for shape in shapes if element is ELEMENTS[0] else shapes[::4]:
            design = pathlib.Path(folder) / "design.json"
            design.write_text(json.dumps({"rhombloom": 1, "element": element,
                                          "operations": [{"op": "place", "shape": shape}]}))
            output = pathlib.Path(folder) / "surface.json"
            subprocess.run([program, "embed", design, "-o", output], check=True, stdout=subprocess.DEVNULL)
            surface = json.loads(output.read_text())
            problems += check(surface, f"{shape} la {element['la_mm']}")
            count += 1
            if shape == "ball-30" and element is ELEMENTS[0]:
                e = surface["embedding"]
                if abs(e["spring_energy_mm"] - 58.4927) > 1e-4 or e["concavity_energy_mm"] != 0 or \
                        abs(e["max_stretch"] - 0.00153) > 1e-5:
                    problems.append(f"the 30-ball is not the reference one: {e}")
print("\n".join(problems) or f"{count} surfaces recomputed from their files")
sys.exit(1 if problems else 0)
