"""The kit as a whole: every file of the contract is there and listed with its true sha256, a second run writes the
same bytes in another locale and time zone, PDFs pass qpdf with all fonts embedded, stale files go, an interrupted or
refused run leaves the old kit alone."""
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
EXPECTED = ["README.txt", "booklet.pdf", "booklet-imposed.pdf", "plan.json", "surface.json", "preview.glb",
            "thumbnail.png", "cut/sheet-01.svg", "cut/sheet-01.dxf", "cut/coupon.svg", "cut/coupon.dxf",
            "cut/template-1to1.pdf", "hooks/element.scad", "hooks/element.json"]
KEYS = ["elements", "sheets", "utilisation", "cut_length_m", "cut_minutes", "mass_g", "max_stretch", "min_defect_deg",
        "max_defect_deg", "warnings", "files"]
problems = []


def expect(condition, what):
    if not condition:
        problems.append(what)


def fabricate(design, folder, *options, **environment):
    subprocess.run([program, "fabricate", design, "-o", folder, *options], check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, **environment})


def tree(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def check_kit(folder, name):
    files = tree(folder)
    for expected in EXPECTED:
        expect(expected in files, f"{name}: {expected} is missing")
    manifest = json.loads(files["kit.json"])
    for key in KEYS:
        expect(key in manifest, f"{name}: kit.json has no {key}")
    expect(set(manifest["files"]) == set(files) - {"kit.json"}, f"{name}: kit.json lists other files")
    for file, entry in manifest["files"].items():
        expect(hashlib.sha256(files.get(file, b"")).hexdigest() == entry["sha256"], f"{name}: sha256 of {file}")
    sheets = [f for f in files if f.startswith("cut/sheet-") and f.endswith(".svg")]
    expect(len(sheets) == manifest["sheets"], f"{name}: {len(sheets)} sheets, kit.json says {manifest['sheets']}")
    surface = json.loads(files["surface.json"])
    expect(len(surface["faces"]) == manifest["elements"], f"{name}: elements")
    check_pdfs(folder, name)
    return manifest


def check_pdfs(folder, name):
    for pdf in sorted(folder.rglob("*.pdf")):
        result = subprocess.run(["qpdf", "--check", pdf], capture_output=True, text=True)
        expect(result.returncode == 0, f"{name}: qpdf {pdf.name}: {result.stdout[-200:]} {result.stderr[-200:]}")
        fonts = subprocess.run(["pdffonts", pdf], capture_output=True, text=True, check=True).stdout.splitlines()[2:]
        for line in fonts:
            embedded, subset, unicode = line.split()[-5:-2]
            expect(embedded == "yes" and unicode == "yes", f"{name}: font in {pdf.name}: {line}")


with tempfile.TemporaryDirectory() as temporary:
    work = pathlib.Path(temporary)
    ball = source / "examples/ball-30.json"
    fabricate(ball, work / "kit")
    manifest = check_kit(work / "kit", "ball-30")
    expect(manifest["elements"] == 30 and abs(manifest["max_stretch"] - 0.00153) < 1e-5, "ball-30: numbers")
    first = tree(work / "kit")

    start = time.time()
    fabricate(ball, work / "kit", LC_ALL="de_DE.UTF-8", TZ="Asia/Tokyo")
    print(f"second fabricate of the 30-ball: {time.time() - start:.2f} s")
    second = tree(work / "kit")
    for file in sorted(set(first) | set(second)):
        expect(first.get(file) == second.get(file), f"{file} differs in a second run")

    # Small sheets, then large ones: the sheets that are no longer needed go; a stranger's file stays.
    (work / "kit/notes-of-mine.txt").write_text("keep")
    fabricate(ball, work / "kit", "--sheet", "300x200")
    many = len(list((work / "kit/cut").glob("sheet-*.svg")))
    fabricate(ball, work / "kit")
    expect(many > len(list((work / "kit/cut").glob("sheet-*.svg"))), "stale sheets stay")
    expect((work / "kit/notes-of-mine.txt").read_text() == "keep", "a stranger's file was touched")

    before = tree(work / "kit")
    result = subprocess.run([program, "fabricate", ball, "-o", work / "kit", "--finger-width", "24"], capture_output=True)
    expect(result.returncode == 1 and tree(work / "kit") == before, "a refused run changed the old kit")

    designs = {
        "card": ({"la_mm": 40, "lb_mm": 44, "alpha_deg": 63, "thickness_mm": 0.25}, "sheet-1x1", ["--paper", "letter"]),
        "large": ({"la_mm": 200, "lb_mm": 220, "alpha_deg": 60, "thickness_mm": 0.8}, "polar-5x4", []),
        "slim": ({"la_mm": 100, "lb_mm": 108, "alpha_deg": 70, "thickness_mm": 0.5}, "tube-6x6", ["--kerf", "0.2"]),
        "ring": ({"la_mm": 60, "lb_mm": 66, "alpha_deg": 63.435, "thickness_mm": 0.3}, "torus-12x6", []),
    }
    for name, (element, shape, options) in designs.items():
        design = work / f"{name}.json"
        design.write_text(json.dumps({"rhombloom": 1, "title": name, "element": element,
                                      "operations": [{"op": "place", "id": "all", "shape": shape}]}))
        fabricate(design, work / name, *options)
        check_kit(work / name, name)

    fabricate(ball, work / "only", "--only", "cut,hooks")
    files = set(tree(work / "only"))
    expect("booklet.pdf" not in files and "preview.glb" not in files and "cut/sheet-01.svg" in files, "--only")

print("\n".join(problems) or "the kits hold what they promise")
sys.exit(1 if problems else 0)
