"""Makes the target meshes of the examples: smooth unions of simple solids, cut into triangles on a grid.

    /usr/bin/python3 make_targets.py [FOLDER] [NAME ...]

Without names: bust, solid_mug and hand, which examples/imports are made from. The other shapes serve as tests.
Lengths are millimetres, z is up. Needs numpy.
"""
import pathlib
import sys

import numpy as np


def length(p):
    return np.sqrt((p * p).sum(-1))


def ball(p, centre, radius):
    return length(p - np.array(centre, float)) - radius


def ellipsoid(p, centre, radii):
    q = (p - np.array(centre, float)) / np.array(radii, float)
    k = length(q)
    g = length(q / np.array(radii, float))
    return k * (k - 1) / np.maximum(g, 1e-9)


def limb(p, a, b, ra, rb):
    """A rounded cone from a to b, good enough as a distance."""
    a, b = np.array(a, float), np.array(b, float)
    t = np.clip(((p - a) @ (b - a)) / ((b - a) @ (b - a)), 0, 1)
    return length(p - (a + t[..., None] * (b - a))) - (ra + t * (rb - ra))


def torus(p, centre, ring, tube, axis=2):
    q = p - np.array(centre, float)
    flat = np.delete(q, axis, -1)
    return np.sqrt((length(flat) - ring) ** 2 + q[..., axis] ** 2) - tube


def cylinder(p, bottom, top, radius, rounding):
    r = np.hypot(p[..., 0], p[..., 1]) - radius + rounding
    z = np.abs(p[..., 2] - (bottom + top) / 2) - (top - bottom) / 2 + rounding
    return np.minimum(np.maximum(r, z), 0) + np.hypot(np.maximum(r, 0), np.maximum(z, 0)) - rounding


def union(k, *solids):
    """Smooth union: solids blend over a width of about k."""
    result = solids[0]
    for d in solids[1:]:
        h = np.clip(0.5 + 0.5 * (d - result) / k, 0, 1)
        result = d * (1 - h) + result * h - k * h * (1 - h)
    return result


def without(k, solid, hole):
    return -union(k, -solid, hole)


def bust(p):
    head = ellipsoid(p, (0, 0, 330), (85, 100, 115))
    face = ellipsoid(p, (0, -40, 300), (62, 70, 85))
    nose = limb(p, (0, -105, 330), (0, -128, 300), 10, 16)
    neck = limb(p, (0, 10, 120), (0, 10, 260), 58, 52)
    shoulders = ellipsoid(p, (0, 15, 60), (190, 85, 80))
    chest = ellipsoid(p, (0, 0, 10), (130, 90, 90))
    return union(40, union(14, union(25, head, face), nose), neck, shoulders, chest)


def mug(p):
    body = cylinder(p, 0, 300, 130, 40)
    hole = cylinder(p, 90, 420, 75, 40)
    handle = torus(p, (150, 0, 150), 85, 26, axis=1)
    handle = np.maximum(handle, 100 - np.hypot(p[..., 0], p[..., 1]))
    return without(20, union(15, body, handle), hole)


def hand(p):
    palm = ellipsoid(p, (0, 0, 100), (95, 42, 110))
    wrist = limb(p, (0, 0, -60), (0, 0, 40), 55, 58)
    fingers = []
    for x, top, lean in ((-72, 300, -55), (-26, 345, -15), (24, 335, 20), (70, 285, 60)):
        fingers.append(limb(p, (x, 0, 160), (x + lean, -8, top), 31, 24))
    thumb = limb(p, (-70, -10, 60), (-185, -35, 165), 36, 27)
    return union(18, union(30, palm, wrist), thumb, *fingers)


def sphere(p):
    return ball(p, (0, 0, 0), 100)


def egg(p):
    return ellipsoid(p, (0, 0, 0), (130, 100, 80))


def spindle(p):
    return ellipsoid(p, (0, 0, 0), (100, 100, 140))


def pancake(p):
    return ellipsoid(p, (0, 0, 0), (100, 100, 40))


def cigar(p):
    return ellipsoid(p, (0, 0, 0), (60, 60, 180))


def capsule(p):
    return limb(p, (0, 0, -100), (0, 0, 100), 60, 60)


def ring(p):
    return torus(p, (0, 0, 0), 130, 50)


def double_torus(p):
    return union(25, torus(p, (-105, 0, 0), 100, 40), torus(p, (105, 0, 0), 100, 40))


def triple_torus(p):
    return union(25, *[torus(p, (120 * np.cos(a), 120 * np.sin(a), 0), 85, 36) for a in (0.0, 2.0944, 4.1888)])


def solid_mug(p):
    return union(15, cylinder(p, 0, 260, 110, 30), torus(p, (110, 0, 130), 85, 28, axis=1))


def octopus(p):
    arms = [limb(p, (60 * np.cos(a), 60 * np.sin(a), 0), (220 * np.cos(a), 220 * np.sin(a), -60), 32, 16)
            for a in np.arange(6) * np.pi / 3]
    return union(25, ellipsoid(p, (0, 0, 60), (95, 95, 120)), *arms)


def quadruped(p):
    legs = [limb(p, (x, y, 120), (1.1 * x, 1.2 * y, 0), 34, 26) for x in (-90, 90) for y in (-45, 45)]
    return union(30, limb(p, (-100, 0, 160), (100, 0, 165), 75, 80), ball(p, (190, 0, 240), 62),
                 limb(p, (225, 0, 230), (275, 0, 205), 38, 28), limb(p, (-160, 0, 190), (-240, 0, 250), 18, 12), *legs)


def cube(p):
    q = np.abs(p) - 70
    return length(np.maximum(q, 0)) + np.minimum(q.max(-1), 0) - 10


# name: solid, half size of the box around it, its middle
SHAPES = {
    "bust": (bust, (215, 160, 270), (0, 0, 190)),
    "mug": (mug, (215, 150, 190), (60, 0, 150)),
    "hand": (hand, (250, 95, 260), (-20, 0, 125)),
    "sphere": (sphere, (110, 110, 110), (0, 0, 0)),
    "egg": (egg, (140, 110, 90), (0, 0, 0)),
    "spindle": (spindle, (110, 110, 150), (0, 0, 0)),
    "pancake": (pancake, (110, 110, 50), (0, 0, 0)),
    "cigar": (cigar, (70, 70, 190), (0, 0, 0)),
    "capsule": (capsule, (70, 70, 170), (0, 0, 0)),
    "torus": (ring, (190, 190, 60), (0, 0, 0)),
    "double_torus": (double_torus, (255, 150, 60), (0, 0, 0)),
    "triple_torus": (triple_torus, (250, 250, 60), (0, 0, 0)),
    "solid_mug": (solid_mug, (190, 125, 145), (50, 0, 130)),
    "octopus": (octopus, (250, 250, 150), (0, 0, 50)),
    "quadruped": (quadruped, (290, 110, 170), (15, 0, 145)),
    "cube": (cube, (90, 90, 90), (0, 0, 0)),
}

# The six tetrahedra about a cube's diagonal; corners are numbered by bits x, y, z.
TETRAHEDRA = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]


def polygonise(solid, half, middle, cells=70):
    """Marching tetrahedra: a closed manifold whatever the function. Returns points and triangles."""
    half, middle = np.array(half, float), np.array(middle, float)
    step = 2 * half.max() / cells
    counts = np.ceil(2 * half / step).astype(int) + 1
    axes = [middle[k] - half[k] + step * np.arange(counts[k]) for k in range(3)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    # A little off centre, so that no sample is exactly zero.
    value = solid(grid) + 1e-7 * step
    strides = np.array([counts[1] * counts[2], counts[2], 1])
    base = np.stack(np.meshgrid(*[np.arange(c - 1) for c in counts], indexing="ij"), -1).reshape(-1, 3) @ strides
    corner = [base + (b & 1) * strides[0] + (b >> 1 & 1) * strides[1] + (b >> 2 & 1) * strides[2] for b in range(8)]
    faces = []
    for tetrahedron in TETRAHEDRA:
        c = np.stack([corner[b] for b in tetrahedron], -1)
        inside = value[c] < 0
        for mask in range(1, 15):
            rows = c[(inside == np.array([mask >> k & 1 for k in range(4)], bool)).all(-1)]
            if len(rows):
                inner = [k for k in range(4) if mask >> k & 1]
                outer = [k for k in range(4) if not mask >> k & 1]
                cuts = [(i, o) for i in inner for o in outer]
                if len(cuts) == 4:
                    cuts = [cuts[0], cuts[1], cuts[3], cuts[2]]
                for k in range(2, len(cuts)):
                    tri = [cuts[0], cuts[k - 1], cuts[k]]
                    edges = np.stack([np.sort(rows[:, list(e)], -1) for e in tri], 1)
                    faces.append((edges, rows[:, inner[0]]))
    edges = np.concatenate([f[0] for f in faces])
    inner = np.concatenate([f[1] for f in faces])
    unique, index = np.unique(edges.reshape(-1, 2), axis=0, return_inverse=True)
    a, b = unique[:, 0], unique[:, 1]
    t = (value[a] / (value[a] - value[b]))[:, None]
    points = grid[a] + np.clip(t, 0.02, 0.98) * (grid[b] - grid[a])
    triangles = index.reshape(-1, 3)
    p = points[triangles]
    normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    inward = ((p.mean(1) - grid[inner]) * normal).sum(-1) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    return points, triangles


def write_off(path, points, triangles):
    with open(path, "w") as file:
        file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        file.writelines(f"{x:.3f} {y:.3f} {z:.3f}\n" for x, y, z in points)
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    folder.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:] or ["bust", "solid_mug", "hand"]:
        solid, half, middle = SHAPES[name]
        points, triangles = polygonise(solid, half, middle)
        write_off(folder / f"{name}.off", points, triangles)
        print(f"{name}: {len(points)} points, {len(triangles)} triangles")


if __name__ == "__main__":
    main()
