"""The arrows of the house: core <- exporters <- apps, and inside core model <- form, model <- design -> form,
building -> design -> form. No type of Cairo, FreeType, HarfBuzz, libdeflate, tinygltf, Draco or qpdf in a header outside
its own exporter; core knows no file format but the design file. And no name stands for two types: with the same name in
the same namespace, the linker would keep one of two constructors for both."""
import collections
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])

# folder -> folders it may include from
ALLOWED = {
    "core/model": {"core", "core/model"},
    "core/form": {"core", "core/model", "core/form"},
    "core/design": {"core", "core/model", "core/form", "core/design"},
    "core/building": {"core", "core/model", "core/form", "core/design", "core/building"},
    "core": {"core"},
    "exporters": {"core", "core/model", "core/form", "core/design", "core/building", "exporters"},
    "apps/cli": {"core", "core/model", "core/form", "core/design", "core/building", "exporters", "apps/cli",
                 "apps/studio"},
    "apps/studio": {"core", "core/model", "core/form", "core/design", "core/building", "exporters", "apps/studio"},
}
FOREIGN = re.compile(r"^(cairo|ft2build|freetype|hb\b|libdeflate|draco/|tiny_gltf|qpdf/|polyclipping|httplib|CLI/)", re.I)
FOREIGN_IN_CORE = re.compile(r"^(cairo|ft2build|freetype|hb\b|libdeflate|draco/|tiny_gltf|qpdf/|httplib|CLI/)", re.I)
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')

NAMESPACE = re.compile(r"namespace(?: ([\w:]+))? \{")
TYPE = re.compile(r"(?:template <.*> )?(?:struct|class|enum class|enum) (\w+)(?: : .*)?$")


def types(text):
    """Names of the types defined at namespace scope, with their namespaces; those of one file alone left out."""
    inside = []
    for line in text.splitlines():
        if match := NAMESPACE.match(line):
            inside.append(match[1])
        elif line.startswith("} // namespace"):
            inside.pop()
        elif (match := TYPE.match(line)) and None not in inside:
            yield "::".join([*inside, match[1]])


problems = []
places = collections.defaultdict(list)
checked = 0
for path in sorted(root.rglob("*")):
    relative = path.relative_to(root)
    if path.suffix not in {".h", ".cpp"} or relative.parts[0] not in {"core", "exporters", "apps"}:
        continue
    folder = relative.parent.as_posix()
    while folder not in ALLOWED and "/" in folder:
        folder = folder.rsplit("/", 1)[0]
    checked += 1
    for name in types(path.read_text()):
        places[name].append(str(relative))
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        kind, name = match.groups()
        place = f"{relative}:{number}"
        if kind == '"':
            target = name.rsplit("/", 1)[0] if "/" in name else ""
            while target not in ALLOWED and "/" in target:
                target = target.rsplit("/", 1)[0]
            if target not in ALLOWED[folder]:
                problems.append(f"{place}: {folder} may not include {name}")
        elif folder.startswith("core") and FOREIGN_IN_CORE.match(name):
            problems.append(f"{place}: core knows no {name}")
        elif path.suffix == ".h" and folder == "exporters" and FOREIGN.match(name):
            problems.append(f"{place}: {name} must stay out of headers")

problems += [f"{name} is defined in {' and '.join(files)}" for name, files in places.items() if len(files) > 1]
print("\n".join(problems) or f"{checked} files keep the arrows")
sys.exit(1 if problems or checked == 0 else 0)
