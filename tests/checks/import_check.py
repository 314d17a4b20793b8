"""Meshes from anywhere: sound ones become designs that can be built, broken ones are repaired or refused in one sentence
with exit code 1 and no file left behind; nothing crashes.

    import_check.py PROGRAM SOURCE_DIR [broken]

With `broken`: only the broken meshes, which a sanitized program gets through in seconds."""
import json
import math
import pathlib
import random
import struct
import subprocess
import sys
import tempfile

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
broken_only = sys.argv[3:] == ["broken"]
work = pathlib.Path(tempfile.mkdtemp(prefix="rhombloom-import-"))
problems = []
checked = 0


def ball(rings=12, around=24, radius=50.0, centre=(0, 0, 0)):
    points = [(centre[0], centre[1], centre[2] + radius)]
    for i in range(1, rings):
        for k in range(around):
            a, b = math.pi * i / rings, 2 * math.pi * k / around
            points.append((centre[0] + radius * math.sin(a) * math.cos(b), centre[1] + radius * math.sin(a) * math.sin(b),
                           centre[2] + radius * math.cos(a)))
    points.append((centre[0], centre[1], centre[2] - radius))
    triangles = []
    at = lambda i, k: 1 + (i - 1) * around + k % around
    for k in range(around):
        triangles.append((0, at(1, k), at(1, k + 1)))
        triangles.append((len(points) - 1, at(rings - 1, k + 1), at(rings - 1, k)))
        for i in range(1, rings - 1):
            triangles += [(at(i, k), at(i + 1, k), at(i + 1, k + 1)), (at(i, k), at(i + 1, k + 1), at(i, k + 1))]
    return points, triangles


def together(*meshes):
    points, triangles = [], []
    for p, t in meshes:
        triangles += [tuple(v + len(points) for v in f) for f in t]
        points += p
    return points, triangles


def off(mesh):
    points, triangles = mesh
    return ("OFF\n%d %d 0\n" % (len(points), len(triangles)) + "".join("%r %r %r\n" % tuple(p) for p in points) +
            "".join("3 %d %d %d\n" % tuple(t) for t in triangles)).encode()


def obj(mesh):
    points, triangles = mesh
    return ("# a comment\n" + "".join("v %r %r %r\n" % tuple(p) for p in points) + "vn 0 0 1\n" +
            "".join("f %d//1 %d//1 %d//1\n" % tuple(v + 1 for v in t) for t in triangles)).encode()


def stl(mesh):
    points, triangles = mesh
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *points[a], *points[b], *points[c], 0) for a, b, c in triangles)
    return b"\0" * 80 + struct.pack("<I", len(triangles)) + body


def stl_text(mesh):
    points, triangles = mesh
    text = "solid x\n"
    for t in triangles:
        text += "facet normal 0 0 0\nouter loop\n" + "".join("vertex %r %r %r\n" % tuple(points[v]) for v in t)
        text += "endloop\nendfacet\n"
    return (text + "endsolid x\n").encode()


def ply(mesh, order="<"):
    points, triangles = mesh
    name = {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    head = ("ply\nformat %s 1.0\ncomment made by a test\nelement vertex %d\nproperty float x\nproperty float y\n"
            "property float z\nproperty uchar red\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n")
    return ((head % (name, len(points), len(triangles))).encode() +
            b"".join(struct.pack(order + "3fB", *p, 7) for p in points) +
            b"".join(struct.pack(order + "B3i", 3, *t) for t in triangles))


def glb(mesh):
    points, triangles = mesh
    data = b"".join(struct.pack("<3f", *p) for p in points) + b"".join(struct.pack("<3I", *t) for t in triangles)
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                "nodes": [{"children": [1]}, {"mesh": 0, "scale": [0.001, 0.001, 0.001]}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3"},
                              {"bufferView": 1, "componentType": 5125, "count": 3 * len(triangles), "type": "SCALAR"}],
                "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 12 * len(points)},
                                {"buffer": 0, "byteOffset": 12 * len(points), "byteLength": 12 * len(triangles)}],
                "buffers": [{"byteLength": len(data)}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x4E4942) + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def moebius():
    points, triangles, n = [], [], 60
    for k in range(n):
        a = 2 * math.pi * k / n
        for s in (-20, 20):
            r = 80 + s * math.cos(a / 2)
            points.append((r * math.cos(a), r * math.sin(a), s * math.sin(a / 2)))
    for k in range(n):
        a, b = 2 * k, 2 * k + 1
        c, d = (2 * k + 2, 2 * k + 3) if k + 1 < n else (1, 0)
        triangles += [(a, c, d), (a, d, b)]
    return points, triangles


def run(name, data, *options):
    path, output = work / name, work / (name + ".json")
    path.write_bytes(data)
    before = set(work.iterdir())
    result = subprocess.run([program, "import", str(path), "-o", str(output), "--json", *options], capture_output=True,
                            timeout=280)
    return result, output, set(work.iterdir()) - before


def expect_refusal(name, data, words, *options):
    global checked
    checked += 1
    result, _, left = run(name, data, *options)
    text = result.stderr.decode("utf-8", "replace")
    if result.returncode != 1 or len(text.strip().splitlines()) != 1 or words not in text:
        problems.append(f"{name}: exit {result.returncode}, {text[:300]!r}, expected 1 and {words!r}")
    if left:
        problems.append(f"{name}: left behind {left}")


def expect_design(name, data, elements, words="", *options):
    global checked
    checked += 1
    result, output, _ = run(name, data, "--elements", str(elements), *options)
    if result.returncode != 0:
        problems.append(f"{name}: exit {result.returncode}, {result.stderr[:300]!r}")
        return
    report = json.loads(result.stdout)
    if abs(report["elements"] / elements - 1) > 0.05:
        problems.append(f"{name}: {report['elements']} elements instead of {elements}")
    if words not in " ".join(report["repairs"]):
        problems.append(f"{name}: repairs {report['repairs']} do not tell {words!r}")
    check = subprocess.run([program, "check", str(output), "--json"], capture_output=True, timeout=280)
    told = json.loads(check.stdout or b"{}")
    if check.returncode != 0:
        problems.append(f"{name}: cannot be built: {told.get('problems')}")
    print(f"{name}: {report['elements']} elements, rms {report['to_target']['rms_la']:.3f} and "
          f"{report['from_target']['rms_la']:.3f} la, stretch {100 * report['max_stretch']:.2f} %, {report['repairs']}")


good = ball()
points, triangles = good
far = lambda p, x: (x, p[1], p[2])
expect_refusal("empty.obj", b"", "empty")
expect_refusal("empty.stl", b"", "empty")
expect_refusal("noise.glb", bytes(range(256)) * 4, "GLB")
expect_refusal("noise.ply", bytes(range(256)) * 4, "PLY")
expect_refusal("noise.stl", bytes(range(256)) * 4, "")
expect_refusal("noise.off", bytes(range(256)) * 4, "")
expect_refusal("noise.obj", bytes(range(256)) * 4, "")
expect_refusal("wrong.step", b"x", "expected .obj")
expect_refusal("points.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no faces")
expect_refusal("points.off", b"OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no faces")
expect_refusal("huge_index.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999\n", "99999999999")
expect_refusal("negative.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -9\n", "-9")
expect_refusal("huge_index.off", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2000000000\n", "unknown point")
expect_refusal("huge_count.off", b"OFF\n4000000000 4000000000 0\n", "announces")
expect_refusal("huge_sum.off", b"OFF\n9000000000000000000 9000000000000000000 0\n", "announces")
expect_refusal("huge_count.ply", ply(good).replace(b"element vertex %d" % len(points), b"element vertex 4000000000"), "")
expect_refusal("huge_list.ply", b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
               b"float z\nelement face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n2000000000 0 0 0\n", "list")
expect_refusal("cut.stl", stl(good)[:-77], "cut short")
expect_refusal("cut.ply", ply(good)[:-77], "cut short")
expect_refusal("cut.glb", glb(good)[:-77], "cut short")
expect_refusal("cut.off", off(good)[:-77], "")
expect_refusal("nan.off", off(([(math.nan,) * 3] * len(points), triangles)), "not finite")
expect_refusal("far.off", off(([(1e308, -1e308, 1e308)] * len(points), triangles)), "not finite")
expect_refusal("flat.off", off(([(0, 0, 0)] * len(points), triangles)), "")
expect_refusal("line.off", off(([far((0, 0, 0), p[0]) for p in points], triangles)), "")
expect_refusal("sheet.off", off(([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)])), "")
expect_refusal("moebius.off", off(moebius()), "one-sided")
expect_refusal("shells.off", off(together(*[ball(6, 8, 10, (30 * k, 0, 0)) for k in range(100)])), "separate solids")
expect_refusal("few.off", off(good), "expected", "--elements", "3")
expect_refusal("many.off", off(good), "expected", "--elements", "1000000000")
expect_refusal("three.off", off(good), "leave one out", "--elements", "150", "--la", "80", "--height", "300")
deep = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"children": [0]}]}
text = json.dumps(deep).encode()
text += b" " * (-len(text) % 4)
expect_refusal("loop.glb", struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text, "")

expect_refusal("area.off", off(([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)] * 50)), "area")
expect_refusal("one.stl", stl(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])), "")
expect_refusal("count.stl", stl(good)[:80] + struct.pack("<I", 4000000000) + stl(good)[84:], "cut short")
expect_refusal("chunk.glb", glb(good)[:12] + struct.pack("<I", 4000000000) + glb(good)[16:], "")
expect_refusal("view.glb", glb(good).replace(b'"byteOffset": 0', b'"byteOffset": 9'), "")
expect_refusal("type.ply", ply(good).replace(b"property uchar red", b"property quark red"), "line 8")
expect_refusal("shy.ply", ply(good).replace(b"property float z", b"property float q"), "z")

# Anything may be wrong with a file: three elements are refused, but only after it was read and repaired.
chance = random.Random(1)
little = ball(5, 7)
sound = {"obj": obj(little), "off": off(little), "stl": stl(little), "ply": ply(little), "glb": glb(little)}
for number in range(40):
    ending, data = list(sound.items())[number % len(sound)]
    data = bytearray(data)
    for _ in range(1 + number // 10):
        at = chance.randrange(len(data) if number % 2 else min(len(data), 700))
        data[at:at + chance.choice([0, 1, 1, 1, 4])] = bytes([chance.randrange(256)])
    expect_refusal(f"spoilt-{number}.{ending}", bytes(data), "", "--elements", "3")

groups = b"".join(b"g %s\no %s\ns %d\nusemtl m%d\n" % (b"a/" * 200, b"b" * 3000, k, k) for k in range(200))
expect_refusal("groups.obj", groups + obj(little) + groups, "", "--elements", "3")
if not broken_only:
    expect_design("grouped.obj", groups + obj(little) + groups, 24)
    expect_design("length.glb", glb(good)[:8] + struct.pack("<I", 4000000000) + glb(good)[12:], 150)
    for name, data in {"ball.obj": obj(good), "ball.off": off(good), "ball.stl": stl(good), "text.stl": stl_text(good),
                       "little.ply": ply(good), "big.ply": ply(good, ">"), "ball.glb": glb(good)}.items():
        expect_design(name, data, 150)
    expect_design("tiny.off", off(([tuple(1e-9 * x for x in p) for p in points], triangles)), 150)
    expect_design("inside_out.off", off((points, [t[::-1] for t in triangles])), 150)
    expect_design("mixed.off", off((points, [t[::-1] if k % 3 == 0 else t for k, t in enumerate(triangles)])), 150)
    expect_design("twice.off", off((points, triangles + triangles[:40])), 150, "duplicate")
    expect_design("holes.off", off((points, [t for k, t in enumerate(triangles) if k % 61])), 150, "closed")
    expect_design("some_nan.off", off(([(math.nan, 0, 0)] + points[1:], triangles)), 150, "not finite")
    expect_design("overlap.off", off(together(good, ball(12, 24, 40, (45, 0, 20)))), 240, "shells")
    expect_design("crowded.off", off((points + [(0, 0, 90)], triangles + [(1, 2, len(points))])), 150, "more than two")
    colours = ply(good).replace(b"property uchar red\n", b"property uchar red\nproperty list uchar float weights\n")
    split = colours.index(b"end_header\n") + len(b"end_header\n")
    points_end = split + 13 * len(points)
    odd = b"".join(colours[k:k + 13] + b"\x02" + b"\0" * 8 for k in range(split, points_end, 13))
    expect_design("odd.ply", colours[:split] + odd + colours[points_end:], 150)

print(f"{checked} meshes, {len(problems)} problems")
print("\n".join(problems))
sys.exit(1 if problems else 0)
