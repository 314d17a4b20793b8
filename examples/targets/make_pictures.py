"""Draws imported designs beside their targets: left the mesh, right the network of elements, from the same camera.

    /usr/bin/python3 make_pictures.py PICTURE.png DESIGN.json ...

Each design's first operation has to be an import; its target lies beside it. Needs numpy.
"""
import json
import pathlib
import struct
import sys
import zlib

import numpy as np

SIZE = 420  # pixels of one picture
FINER = 2   # samples per pixel and axis


def read_ply(path):
    """The triangles of a target that the import has stored."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    head = data[:end].decode()
    counts = {line.split()[1]: int(line.split()[2]) for line in head.splitlines() if line.startswith("element")}
    if "ascii" in head:
        rows = data[end:].decode().split("\n")
        points = np.array([row.split()[:3] for row in rows[:counts["vertex"]]], float)
        faces = np.array([row.split()[1:4] for row in rows[counts["vertex"]:counts["vertex"] + counts["face"]]], int)
        return points, faces
    kind = "<f8" if "property double x" in head else "<f4"
    points = np.frombuffer(data, kind, 3 * counts["vertex"], end).reshape(-1, 3).astype(float)
    end += points.size * np.dtype(kind).itemsize
    faces = np.frombuffer(data, [("n", "u1"), ("v", "<i4", 3)], counts["face"], end)["v"]
    return points, faces


def camera(points):
    """Looks down the shorter horizontal axis, a little from above and from the side."""
    size = np.ptp(points, axis=0)
    side = np.array([0, 1, 0]) if size[0] >= size[1] else np.array([1, 0, 0])
    out = -side + 0.35 * np.roll(side, 1) * (1 if side[1] else -1) + np.array([0, 0, 0.25])
    out = out / np.linalg.norm(out)
    right = np.cross([0, 0, 1], out)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(out, right), out])


def render(points, polygons, view, middle, scale, colours):
    """Flat-shaded polygons with a depth buffer; each polygon is drawn as a fan."""
    pixels = SIZE * FINER
    image = np.ones((pixels, pixels, 3))
    depth = np.full((pixels, pixels), -np.inf)
    seen = (points - middle) @ view.T
    screen = np.stack([pixels / 2 + scale * seen[:, 0], pixels / 2 - scale * seen[:, 1], scale * seen[:, 2]], -1)
    light = np.array([0.35, 0.55, 0.75]) / np.linalg.norm([0.35, 0.55, 0.75])
    for polygon, colour in zip(polygons, colours):
        whole = seen[list(polygon)]
        normal = np.cross(whole[2] - whole[0], whole[-1] - whole[1])
        shade = 0.35 + 0.65 * abs(normal @ light) / max(np.linalg.norm(normal), 1e-12)
        for k in range(2, len(polygon)):
            a, b, c = screen[[polygon[0], polygon[k - 1], polygon[k]]]
            low = np.maximum(np.floor(np.minimum(np.minimum(a, b), c)[:2]).astype(int), 0)
            high = np.minimum(np.ceil(np.maximum(np.maximum(a, b), c)[:2]).astype(int) + 1, pixels)
            area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            if abs(area) < 1e-9 or (high <= low).any():
                continue
            x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
            u = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
            v = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
            z = a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2])
            place = np.s_[low[1]:high[1], low[0]:high[0]]
            hit = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9) & (z > depth[place])
            depth[place][hit] = z[hit]
            image[place][hit] = shade * np.array(colour)
    return image.reshape(SIZE, FINER, SIZE, FINER, 3).mean((1, 3))


def shrunk(points, quads):
    """Elements a little smaller than their places, so that they can be told apart."""
    corners = points[quads]
    middle = corners.mean(1, keepdims=True)
    return (middle + 0.93 * (corners - middle)).reshape(-1, 3), np.arange(4 * len(quads)).reshape(-1, 4)


def write_png(path, image):
    rows = (np.clip(image, 0, 1) * 255 + 0.5).astype(np.uint8)
    raw = b"".join(b"\0" + row.tobytes() for row in rows)
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", rows.shape[1], rows.shape[0], 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def pair(design):
    operation = json.loads(design.read_text())["operations"][0]
    points, faces = read_ply(design.parent / operation["target"])
    view, middle = camera(points), (points.max(0) + points.min(0)) / 2
    scale = 0.46 * SIZE * FINER / np.abs((points - middle) @ view.T)[:, :2].max()
    target = render(points, faces, view, middle, scale, [(0.62, 0.66, 0.72)] * len(faces))
    network, quads = shrunk(np.array(operation["points_mm"], float), np.array(operation["elements"]))
    turned = set(operation["flipped"])
    colours = [(0.80, 0.45, 0.25) if k in turned else (0.93, 0.78, 0.50) for k in range(len(quads))]
    return np.concatenate([target, render(network, quads, view, middle, scale, colours)], 1)


write_png(pathlib.Path(sys.argv[1]), np.concatenate([pair(pathlib.Path(name)) for name in sys.argv[2:]], 1))
