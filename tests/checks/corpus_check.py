"""Bad input gets one sentence on stderr that names the place, the right exit code, and nothing half-written."""
import os
import pathlib
import pty
import resource
import shutil
import subprocess
import sys
import tempfile

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
work = pathlib.Path(tempfile.mkdtemp(prefix="rhombloom-corpus-"))
problems = []
checked = 0


def run(arguments, limit_bytes=None):
    def limits():
        if limit_bytes is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit_bytes, limit_bytes))
    return subprocess.run([program, *map(str, arguments)], capture_output=True, timeout=120, preexec_fn=limits)


def expect(name, result, exit_code, words):
    global checked
    checked += 1
    text = result.stderr.decode("utf-8", "replace")
    if result.returncode != exit_code:
        problems.append(f"{name}: exit {result.returncode} instead of {exit_code}: {text[:300]}")
    if len(text.strip().splitlines()) != 1 or len(text) > 700:
        problems.append(f"{name}: not one short sentence but {text[:300]!r}")
    if words not in text:
        problems.append(f"{name}: {text.strip()!r} does not name {words!r}")
    if any(ord(c) < 32 and c != "\n" for c in text):
        problems.append(f"{name}: control characters reach the terminal")


def expect_nothing_in(folder, name):
    left = [str(p) for p in folder.rglob("*")] if folder.exists() else []
    if left:
        problems.append(f"{name}: left behind {left[:3]}")


commands = {
    "fabricate": lambda design, out: ["fabricate", design, "-o", out],
    "check": lambda design, out: ["check", design],
    "embed": lambda design, out: ["embed", design, "-o", out / "x.json"],
    "plan": lambda design, out: ["plan", design],
}

cases = []
for line in (source / "tests/corpus/expected.txt").read_text().splitlines():
    if not line.startswith("#"):
        cases.append(line.split(": ", 1))
for number, (name, words) in enumerate(cases):
    design = source / "tests/corpus" / name
    # Every file goes through fabricate; the other commands read designs the same way and take turns.
    for command in ["fabricate", list(commands)[1 + number % (len(commands) - 1)]]:
        out = work / "out"
        expect(f"{command} {name}", run(commands[command](design, out)), 1, words)
        expect_nothing_in(out, f"{command} {name}")

# Larger than a repository should carry.
brackets = work / "brackets.json"
with open(brackets, "wb") as file:
    for _ in range(200):
        file.write(b"[" * 1_000_000)
expect("200 MB of brackets", run(["check", brackets]), 1, "brackets.json")
brackets.unlink()
(work / "nested.json").write_text("[" * 3_000_000)
expect("3 MB of brackets", run(["check", work / "nested.json"]), 1, "nested")

good = source / "examples/ball-30.json"
expect("missing file", run(["fabricate", work / "none.json", "-o", work / "out"]), 1, "does not exist")
expect("folder for a file", run(["fabricate", work, "-o", work / "out"]), 1, "is a folder")
expect("empty file name", run(["check", ""]), 1, "does not exist")
expect("unknown ending", run(["embed", good, "-o", work / "x.xyz"]), 1, ".obj")
(work / "folder.json").mkdir()
expect("folder named as the target", run(["embed", good, "-o", work / "folder.json"]), 3, "folder")
expect("target in a missing folder", run(["embed", good, "-o", work / "none/x.json"]), 3, "cannot write")
(work / "file").write_text("keep me")
expect("file where the kit should be", run(["fabricate", good, "-o", work / "file"]), 3, "file of that name")
if (work / "file").read_text() != "keep me":
    problems.append("fabricate destroyed the file in its way")
expect("unwritable target", run(["fabricate", good, "-o", "/proc/kit"]), 3, "/proc/kit")

# What was there before: neither the input nor the files of a folder that never held a kit are replaced.
home = work / "home"
home.mkdir()
for name in ["design.json", "plan.json"]:
    shutil.copy(good, home / name)
(home / "outline.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" '
                                  'viewBox="0 0 60 40"><path d="M0 0H60V40Z" fill="none"/></svg>')
shutil.copy(home / "outline.svg", home / "sheet-01.svg")
(home / "mesh.off").write_text("OFF\n0 0 0\n")
(home / "mesh.png").write_text("a photograph")
before = {p: p.read_bytes() for p in home.iterdir()}
for name, arguments, code, words in [
        ("embed onto its design", ["embed", home / "design.json", "-o", home / "./design.json"], 1, "would replace"),
        ("kit onto its design", ["fabricate", home / "plan.json", "-o", home, "--only", "booklet"], 1, "would replace"),
        ("kit among other files", ["fabricate", good, "-o", home, "--only", "booklet"], 3, "no kit.json beside it"),
        ("nest onto its outline", ["nest", home / "sheet-01.svg", "-o", home, "--count", "3"], 1, "would replace"),
        ("import onto its mesh", ["import", home / "mesh.off", "-o", home / "mesh.off"], 1, "would replace"),
        ("import named as its picture", ["import", home / "mesh.off", "-o", home / "mesh.png"], 1, "another ending"),
        ("import into a missing folder", ["import", home / "mesh.off", "-o", home / "none/x.json"], 3, "no folder"),
        ("studio in a missing folder", ["studio", home / "none/x.json", "--no-browser"], 1, "no folder")]:
    expect(name, run(arguments), code, words)
    if {p: p.read_bytes() for p in home.iterdir()} != before:
        problems.append(f"{name}: the folder is not as it was")

# A disk that is full after a few kilobytes: nothing new, and the old kit untouched.
out = work / "full"
expect("full disk", run(["fabricate", good, "-o", out], limit_bytes=2000), 3, "cannot write")
expect_nothing_in(out, "full disk")
if os.path.exists("/dev/full"):
    with open("/dev/full", "wb") as full:
        result = subprocess.run([program, "shapes"], stdout=full, stderr=subprocess.PIPE)
    expect("full standard output", result, 3, "standard output")

for arguments, words in [([], "subcommand"), (["bogus"], "bogus"), (["fabricate"], "DESIGN"),
                         (["fabricate", good], "--output"), (["check", good, "--bogus"], "--bogus"),
                         (["fabricate", good, "-o", work / "out", "--paper", "a5"], "a5"),
                         (["plan", good, "--order", "worst"], "worst")]:
    expect(f"usage {arguments}", run(arguments), 2, words)
for arguments, words in [(["fabrcate", good], "did you mean fabricate?"), (["--vresion"], "did you mean --version?"),
                         (["fabricate", good, "-o", work / "out", "--machin", "k40"], "did you mean --machine?"),
                         (["nest", good, "-o", work / "out", "--cuont", "4"], "did you mean --count?"),
                         (["embed", good, "-o", work / "out", "--qqqqqq"], "rhombloom embed --help"),
                         (["nest", good], "rhombloom nest --help"),
                         (["nest", good, "-o", work / "out", "--count", "many"], "--count = many: expected a number"),
                         (["nest", good, "-o", work / "out", "--count", "9", "--grain", "1"], "any, half-turn, fixed"),
                         (["fabricate", good, "-o", ""], "--output: the value is empty"),
                         (["embed", good, "-o="], "--output: the value is empty"),
                         (["fabricate", good, "--output=", "--lamp"], "--output: the value is empty"),
                         (["fabricate", good, "-o", work / "out", "--kerf", ""], "--kerf: the value is empty"),
                         (["fabricate", good, "-o", work / "out", "--machine="], "--machine: the value is empty"),
                         (["fabricate", good, "-o", work / "out", "--kerf", "0,2"], "--kerf = 0,2: expected a number "),
                         (["check", good, "--max-stretch", "nan"], "nan is not from 0.1 to 5"),
                         (["fabricate", good, "-o", work / "out", "--stroke", "0"], "0 is not from 0.001 to 2"),
                         (["fabricate", good, "-o", work / "out", "--only", "cut,hoks"], "cut, booklet, preview, hooks")]:
    expect(f"usage {arguments}", run(arguments), 2, words)
expect("a spacing of -1", run(["fabricate", good, "-o", work / "out", "--spacing", "-1"]), 1, "--spacing is -1 mm")
expect("a length of 0", run(["import", good, "-o", work / "x.json", "--la", "0"]), 1, "la_mm is 0 mm: expected")
# A value may follow a '=', behind the short name as behind the long one.
for number, option in enumerate(["-o=", "--output=", "-o"]):
    target = work / f"named-{number}.off"
    told = run(["embed", good, f"{option}{target}"])
    checked += 1
    if told.returncode != 0 or not target.exists():
        problems.append(f"{option}{target}: {told.stdout} {told.stderr}")
told = run(["import", "none.obj", "-o", work / "x.json"])
expect("mesh that is missing", told, 1, "none.obj does not exist")
if told.stderr.count(b"none.obj") != 1:
    problems.append(f"the missing mesh is named twice: {told.stderr}")
for command in ["fabricate", "check", "embed", "shapes", "plan", "nest", "import", "studio"]:
    told = run([command, "--version"]), run([command, "--help"])
    checked += 1
    if [t.returncode for t in told] != [0, 0] or not told[0].stdout.startswith(b"rhombloom ") or \
            b"Example: rhombloom " + command.encode() not in told[1].stdout:
        problems.append(f"{command} --version and --help: {told}")
expect_nothing_in(work / "out", "wrong usage")


def shown_on_a_terminal(arguments):
    """What the program shows on a terminal, and its exit code; None where this machine has no terminal to give."""
    try:
        ours, theirs = pty.openpty()
    except OSError as error:
        print(f"not looked at: what a terminal shows ({error})")
        return None
    code = subprocess.run([program, *arguments], stdout=theirs, stderr=theirs).returncode
    os.close(theirs)
    shown = b""
    try:
        while piece := os.read(ours, 10000):  # what is shown arrives in pieces
            shown += piece
    except OSError:  # the end
        pass
    os.close(ours)
    return code, shown.decode()


# On a terminal, progress is gone before the result is printed beside it.
(work / "piece.json").write_text('{"outline": [[0, 0], [60, 0], [60, 40]]}')
shown = shown_on_a_terminal(["nest", work / "piece.json", "-o", work / "nested", "--count", "2", "--sheet", "100x90"])
checked += 1
if shown and (shown[0] != 0 or "nesting ..." not in shown[1] or
              "\r\x1b[Koutline of 60 x 40 mm: 2 copies" not in shown[1]):
    problems.append(f"nest on a terminal shows {shown!r}")

shutil.rmtree(work)
print("\n".join(problems) or f"{checked} bad inputs refused as they should be")
sys.exit(1 if problems else 0)
