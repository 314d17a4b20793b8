"""Imports many kinds of targets at several sizes and prints how each went.

    /usr/bin/python3 import_table.py PROGRAM SOURCE_DIR [--elements 150,300] [--only NAME ...] [--scans N] [--folder MESHES]

An import counts as good when `rhombloom check` calls the design buildable, no element crosses another, and the number of
elements is within 5 % of what was asked for. Otherwise the reason is printed. A mesh that is refused before any network
is searched (several solids, an open sheet) counts as refused, not as failed. `size` is the distance as a share of the
square root of the target's area: it should fall as the elements become more. Needs numpy.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

parser = argparse.ArgumentParser()
parser.add_argument("program")
parser.add_argument("source", type=pathlib.Path)
parser.add_argument("--elements", default="150,300,600,1200")
parser.add_argument("--only", nargs="*", default=[])
parser.add_argument("--scans", type=int, default=6, help="random blobs with noise")
parser.add_argument("--folder", type=pathlib.Path, help="meshes of your own, in place of the shapes made here")
arguments = parser.parse_args()
sys.path.insert(0, str(arguments.source / "examples/targets"))
import make_targets  # noqa: E402


def scan(seed):
    """A blob of three to six limbs about a body, with the noise of a scanner."""
    random = np.random.default_rng(seed)
    directions = random.normal(size=(random.integers(3, 7), 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    radii = random.uniform(30, 55, len(directions))
    lengths = random.uniform(90, 150, len(directions))

    def solid(p):
        limbs = [make_targets.limb(p, (0, 0, 0), d * n, 1.2 * r, r) for d, r, n in zip(directions, radii, lengths)]
        return make_targets.union(30, make_targets.ball(p, (0, 0, 0), 80), *limbs)

    points, triangles = make_targets.polygonise(solid, (220, 220, 220), (0, 0, 0), 60)
    return points + random.normal(scale=0.8, size=points.shape), triangles


def with_sharp_edges():
    """Solids as a CAD program writes them: few triangles, sharp edges."""
    box = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    sides = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    around = 24
    angle = 2 * np.pi * np.arange(around) / around
    rim = [(np.cos(a), np.sin(a), z) for z in (0, 2) for a in angle]
    tube = []
    for k in range(around):
        n = (k + 1) % around
        tube += [(k, n, around + n), (k, around + n, around + k), (2 * around, n, k),
                 (2 * around + 1, around + k, around + n)]
    plan = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    corner = [(x, y, z) for z in (0, 1) for x, y in plan]
    caps = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]
    bent = [t[::-1] for t in caps] + [tuple(v + 6 for v in t) for t in caps]
    bent += [t for k in range(6) for t in ((k, (k + 1) % 6, 6 + (k + 1) % 6), (k, 6 + (k + 1) % 6, 6 + k))]
    cone = [(np.cos(a), np.sin(a), 0) for a in angle] + [(0, 0, 0), (0, 0, 2)]
    skirt = [t for k in range(around) for t in ((around, (k + 1) % around, k), (k, (k + 1) % around, around + 1))]
    return {"sharp_cube": (box, sides),
            "slab": ([(2 * x, 2 * y, 0.6 * z) for x, y, z in box], sides),
            "cylinder": (rim + [(0, 0, 0), (0, 0, 2)], tube),
            "angle": (corner, bent),
            "cone": (cone, skirt),
            "octahedron": ([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)],
                           [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)])}


def write(path, points, triangles):
    make_targets.write_off(path, 100 * np.array(points) if np.abs(points).max() < 10 else np.array(points), triangles)


def verdict(design):
    result = subprocess.run([arguments.program, "check", str(design), "--json"], capture_output=True)
    return json.loads(result.stdout) if result.stdout else {"buildable": False, "problems": [result.stderr.decode()]}


def row(name, mesh, elements, folder):
    design = folder / f"{name}-{elements}.json"
    begin = time.monotonic()
    result = subprocess.run([arguments.program, "import", str(mesh), "-o", str(design), "--elements", str(elements),
                             "--json"], capture_output=True)
    seconds = time.monotonic() - begin
    if not result.stdout:
        told = result.stderr.decode().strip()
        unfit = any(word in told for word in ("separate solids", "open sheet", "one-sided", "encloses nothing"))
        return {"good": False, "refused": unfit, "line": told, "size": None}
    report = json.loads(result.stdout)
    check = verdict(design)
    problems = check["problems"] + ([report["problem"]] if report["problem"] else [])
    if abs(report["elements"] / elements - 1) > 0.05:
        problems.append(f"{report['elements']} elements")
    both = [report[side]["rms_la"] for side in ("to_target", "from_target")]
    # An element covers 0.866 la^2 of the target.
    size = np.hypot(*both) / np.sqrt(2 * 0.866 * report["elements"])
    line = (f"n {report['elements']:5d}  rms {both[0]:.3f} / {both[1]:.3f} la ({100 * size:.2f} % of the size)  max {report['to_target']['max_la']:.2f} / "
            f"{report['from_target']['max_la']:.2f}  stretch {100 * report['max_stretch']:.2f} %  defects "
            f"{report['min_defect_deg']:.0f} .. {report['max_defect_deg']:.0f}  {seconds:.1f} s")
    return {"good": not problems and check["buildable"], "refused": False, "size": size,
            "line": line + "".join("  ! " + p[:160] for p in problems)}


def targets(folder):
    if arguments.folder:
        for path in sorted(arguments.folder.iterdir()):
            if not arguments.only or path.stem in arguments.only:
                yield path.stem, path
        return
    shapes = {name: lambda s=shape: make_targets.polygonise(*s, 60) for name, shape in make_targets.SHAPES.items()}
    shapes.update({name: lambda m=mesh: m for name, mesh in with_sharp_edges().items()})
    shapes.update({f"scan_{seed}": lambda s=seed: scan(s) for seed in range(arguments.scans)})
    for name, make in shapes.items():
        if not arguments.only or name in arguments.only:
            path = folder / f"{name}.off"
            write(path, *make())
            yield name, path


def main():
    folder = pathlib.Path(tempfile.mkdtemp(prefix="rhombloom-table-"))
    good = total = nearer = pairs = refused = 0
    for name, mesh in targets(folder):
        before = None
        for elements in map(int, arguments.elements.split(",")):
            told = row(name, mesh, elements, folder)
            refused += told["refused"]
            good += told["good"]
            total += not told["refused"]
            if before is not None and told["size"] is not None:
                pairs += 1
                nearer += told["size"] < before
            before = told["size"] if told["size"] is not None else before
            word = "good" if told["good"] else "none" if told["refused"] else "FAIL"
            print(f"{name:13s} {elements:5d} {word} {told['line']}", flush=True)
    print(f"{good} of {total} good ({100 * good / max(total, 1):.0f} %), {refused} refused; more elements came nearer, "
          f"measured by the target's size, in {nearer} of {pairs} steps")


main()
