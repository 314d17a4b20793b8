"""Cut DXF read again by ezdxf, dxflib and, where it is installed, FreeCAD: version, units, layers, closed polylines and
bulges, and the same contours as the SVG. Usage: dxf_check.py PROGRAM SOURCE_DIR"""
import json
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

from cut_files import LAYERS, Dxf, Svg, check, design, finish, must_fabricate

program, source = sys.argv[1:3]

FREECAD = """
import json, FreeCAD, Import
document = FreeCAD.newDocument("check")
Import.readDXF({path!r}, document.Name)
edges = [e for o in document.Objects if hasattr(o, "Shape") for e in o.Shape.Edges]
box = [1e9, 1e9, -1e9, -1e9]
for e in edges:
    b = e.BoundBox
    box = [min(box[0], b.XMin), min(box[1], b.YMin), max(box[2], b.XMax), max(box[3], b.YMax)]
json.dump(dict(edges=len(edges), arcs=sum(e.Curve.TypeId == "Part::GeomCircle" for e in edges),
               length=sum(e.Length for e in edges), box=box), open({out!r}, "w"))
"""


def check_ezdxf(dxf, version):
    document, name = dxf.document, dxf.path.name
    auditor = document.audit()
    check(not auditor.errors and not auditor.fixes, f"{name}: audit {auditor.errors} {auditor.fixes}")
    check(document.dxfversion == version, f"{name}: version {document.dxfversion}")
    check(document.header["$INSUNITS"] == 4 and document.header["$MEASUREMENT"] == 1, f"{name}: millimetres")
    kind = "LWPOLYLINE" if version == "AC1015" else "POLYLINE"
    names = [layer.dxf.name for layer in document.layers]
    for entity, contour in zip(dxf.entities, dxf.contours):
        check(entity.dxftype() == kind, f"{name}: {entity.dxftype()}")
        check(contour.layer in LAYERS and contour.layer in names, f"{name}: layer {contour.layer}")
        check(contour.closed == (contour.layer not in ["ENGRAVE", "CUT_INNER"]), f"{name}: closed on {contour.layer}")
        check(all(abs(s[4]) <= 1 + 1e-6 for s in contour.segments), f"{name}: bulge above a half circle")
    text = dxf.path.read_text(encoding="ascii")
    check(version == "AC1015" or "LWPOLYLINE" not in text and "AcDb" not in text, f"{name}: a hybrid")
    check("SPLINE" not in text and "\nTEXT\n" not in text, f"{name}: splines or text")


def check_against_svg(dxf, svg):
    worst = 0
    check(len(dxf.contours) == len(svg.contours), f"{dxf.path.name}: {len(dxf.contours)} of {len(svg.contours)} paths")
    for a, b in zip(dxf.contours, svg.contours):
        check(a.layer == b.layer and a.closed == b.closed, f"{dxf.path.name}: order of the paths")
        check(a.arcs == b.arcs and len(a.segments) == len(b.segments),
              f"{dxf.path.name} {b.name}: {a.arcs} arcs, {b.arcs} in SVG")
        scale = abs(a.area) if a.closed else a.length
        difference = abs(a.area - b.area) if a.closed else abs(a.length - b.length)
        worst = max(worst, difference / scale, abs(a.length - b.length) / a.length)
    check(worst < 1e-4, f"{dxf.path.name}: contours differ from the SVG by {worst:.2e}")
    return worst


def check_dxflib(reader, dxf):
    read = json.loads(subprocess.run([reader, str(dxf.path)], capture_output=True, text=True, check=True).stdout)
    layers = Counter(c.layer for c in dxf.contours)
    check(read["units"] == 4, f"{dxf.path.name}: dxflib reads units {read['units']}")
    check(read["polylines"] == len(dxf.contours), f"{dxf.path.name}: dxflib reads {read['polylines']} polylines")
    check(read["closed"] == sum(c.closed for c in dxf.contours), f"{dxf.path.name}: dxflib's closed {read['closed']}")
    check(read["bulges"] == sum(c.arcs for c in dxf.contours), f"{dxf.path.name}: dxflib's bulges {read['bulges']}")
    check(read["layers"] == dict(layers), f"{dxf.path.name}: dxflib's layers {read['layers']}")
    print(f"  dxflib: {read['polylines']} polylines, {read['closed']} closed, {read['bulges']} bulges, units 4")


def check_freecad(dxf, folder):
    script, out = Path(folder) / "read.py", Path(folder) / "freecad.json"
    script.write_text(FREECAD.format(path=str(dxf.path), out=str(out)))
    out.unlink(missing_ok=True)
    subprocess.run(["freecadcmd", str(script)], capture_output=True, stdin=subprocess.DEVNULL, timeout=300)
    read = json.loads(out.read_text())
    arcs = sum(c.arcs for c in dxf.contours)
    length = sum(c.length for c in dxf.contours)
    check(read["arcs"] == arcs, f"{dxf.path.name}: FreeCAD reads {read['arcs']} arcs of {arcs}")
    check(abs(read["length"] / length - 1) < 1e-6, f"{dxf.path.name}: FreeCAD's length {read['length']} of {length}")
    print(f"  FreeCAD: {read['edges']} edges, {read['arcs']} arcs, {read['length'] / 1000:.4f} m, box "
          + " ".join(f"{v:.3f}" for v in read["box"]))


def build_dxflib_reader(folder):
    reader = Path(folder) / "dxflib_reader"
    code = Path(source) / "tests/checks/dxflib_reader.cpp"
    subprocess.run(["g++", "-std=c++20", "-w", str(code), "-o", str(reader), "-ldxflib"], check=True)
    return reader


with tempfile.TemporaryDirectory() as folder:
    reader = build_dxflib_reader(folder)
    has_freecad = shutil.which("freecadcmd")
    for version, options in [("AC1015", []), ("AC1009", ["--dxf", "r12"])]:
        cut = must_fabricate(program, design(folder), Path(folder) / f"kit-{version}", *options)
        files = sorted(cut.glob("*.dxf"))
        check(len(files) >= 2, f"files {files}")
        for file in files:
            dxf = Dxf(file)
            check_ezdxf(dxf, version)
            worst = check_against_svg(dxf, Svg(file.with_suffix(".svg")))
            print(f"{version} {file.name}: {len(dxf.contours)} polylines, {sum(c.arcs for c in dxf.contours)} arcs, "
                  f"SVG differs by {worst:.1e}")
            check_dxflib(reader, dxf)
        if has_freecad:
            check_freecad(Dxf(files[0]), folder)
    print("FreeCAD:", has_freecad or "not installed, not asked")
finish()
