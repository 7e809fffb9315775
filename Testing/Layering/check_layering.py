#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the structure of the library against the table of Documentation/DeveloperGuide/architecture.md.

usage: check_layering.py SOURCE_FOLDER

* every dependency between modules in Modules/*/vtk.module is allowed by the table, and the table has no cycle;
* no public header names a type or header of a third-party library other than Eigen and VTK, and one that is installed
  includes VTK only where its target passes VTK on;
* modules that must be independent of VTK's rendering name no VTK module;
* no text in a module names an option of the command line (but for the files that start programs);
* what drives, writes, reads or shows layers names none of them: their names stand in their own files, in Verification, and
  as keys of documents and words of other files' formats;
* where files are made, sines, powers and logarithms are those of dgtkPortableMath.h: the C library chooses its own by the processor;
* a class of a namespace is defined in one place: to the linker two of one name are one, also when
  their modules do not see each other.
"""
import os
import re
import sys

USES_VTK = {"RenderGL", "Pipeline", "FromVTK", "Live", "Views", "Viewer", "Matches"}
PRIVATE_LIBRARIES = re.compile(
    r"#\s*include\s*[<\"](GL/|EGL/|embree|assimp|opencv|OpenImageIO|OpenEXR|nlohmann|openssl|libdeflate|bullet|bt[A-Z]|fcl/|ccd/|png\.h|zlib|vtkgl|vtk_glew)")


ALLOWED = {}
TABLE = os.path.join("Documentation", "DeveloperGuide", "architecture.md")
STRING = re.compile(r'"(?:[^"\\\n]|\\.)*"')
START_PROGRAMS = {"dgtkOptionFields.cxx", "dgtkBlendReader.cxx", "dgtkFence.cxx"}
# Modules (and the program) that meet layers of whatever name. In Scene, ModelIO, SceneExport and Export the same words are those of files.
MEET_LAYERS = ["Core", "DatasetIO", "Document", "Layers", "Live", "Pipeline", "RayTrace", "RenderGL", "Sensor", "Stage", "Visibility", "Controls", "Views", "Viewer", "Matches", "Panels", "Runs", "Windows", "../Apps/dgtk", "../Apps/Editor"]
# A literal beside == or !=, or looked for in a text, or given to what takes a layer's name.
COMPARED = re.compile(r"([=!]=\s*|\b(?:rfind|compare|makeRepresentation|layerBox|formatsOf|firstLayer|startsWith|endsWith)\(\s*)$")
# Of what is compared: formats, parts of formats and extensions are called like some layers.
OTHER_WORDS = re.compile(r"(format|extension|part|word|key|name\(\)|filename\(\)|kind)(\(\w*\))?\s*[=!]=\s*$")


def table(source):
    """Module -> modules that it may use directly; what those use comes along."""
    text = open(os.path.join(source, TABLE), encoding="utf-8").read()
    rows = re.search(r"\| module \| may use \|.*?\n\|[-|]+\n((?:\|.*\n)+)", text).group(1)
    allowed = {}
    for row in rows.splitlines():
        module, used = (cell.strip() for cell in row.split("|")[1:3])
        allowed[module] = [] if used == "\u2013" else used.split(", ")
    return allowed


def layer_names(modules):
    """Names of the layers in the rows of representations and in the files of the others."""
    rows = open(os.path.join(modules, "GroundTruth", "CMakeLists.txt"), encoding="utf-8").read()
    names = set(re.findall(r"dgtk_representation\(\w+ LAYER (\w+)", rows))
    for name in files(modules, "Layers"):
        if name.endswith("Layer.cxx"):
            text = open(os.path.join(modules, "Layers", name), encoding="utf-8").read()
            for found in re.findall(r'(?:return \{ |[lL]ayer(?:Name)? = )(?:\w+ \? )?"(\w+)"(?: : "(\w+)")?[,;]', text):
                names |= set(found) - {""}
    return names


def files(modules, module):
    """Sources and headers of a module, from its folder; without its tests."""
    top = os.path.join(modules, module)
    for folder, below, names in os.walk(top):
        below[:] = sorted(set(below) - {"Testing"})
        yield from (os.path.relpath(os.path.join(folder, name), top) for name in sorted(names) if name.endswith((".h", ".cxx")))


def sources(modules, module):
    for name in files(modules, module):
        text = open(os.path.join(modules, module, name), encoding="utf-8").read()
        yield name, re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.DOTALL)


def named_in_texts(modules):
    problems = []
    layers = layer_names(modules)
    for module in sorted(os.listdir(modules)):
        for name, code in sources(modules, module):
            for text in STRING.findall(code):
                if os.path.basename(name) not in START_PROGRAMS and re.search(r"--[a-z]|^\"--\"$", text) and ";" not in text:  # shaders count down
                    problems.append(f"Modules/{module}/{name}: {text} names an option of the command line")
    for module in MEET_LAYERS:
        for name, code in sources(modules, module):
            if name.endswith("Layer.cxx"):
                continue
            for text in STRING.finditer(code):
                before = code[max(0, text.start() - 60):text.start()]
                driven = module == "Pipeline" or (COMPARED.search(before) and not OTHER_WORDS.search(before)) or re.match(r"\s*[=!]=", code[text.end():])
                if text.group()[1:-1] in layers and driven:
                    problems.append(f"Modules/{module}/{name}: {text.group()} is the name of a layer")
    return problems


# What shows or judges what was made, and the one place that calls the C library.
MAKE_NO_FILES = {"Controls", "Document", "Live", "Matches", "Panels", "RenderGL", "Report", "Runs", "Verification", "Viewer", "Views", "Windows"}
BY_PROCESSOR = re.compile(r"\bstd::(a?(sin|cos|tan)h?|atan2|exp2?|expm1|log(2|10|1p)?|pow)\(|\bAngleAxis|\.slerp\(")


def by_processor(modules):
    for module in sorted(set(os.listdir(modules)) - MAKE_NO_FILES):
        for name, code in sources(modules, module):
            for found in BY_PROCESSOR.finditer(code):
                if os.path.basename(name) != "dgtkPortableMath.cxx":
                    yield f"Modules/{module}/{name}: {found.group()} has not the same bits on every processor"


COMMENT_OR_TEXT = re.compile(r"""//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])'|^\s*\#(?:\\\n|[^\n])*""", re.S | re.M)
NAMESPACE = re.compile(r"\bnamespace\s*([\w:]*)\s*$")
CLASS = re.compile(r"^(?:.*[;>\s])?(?<!enum )(?:class|struct)\s+(?:[A-Z0-9]+_EXPORT\s+)?(\w+)\s*(?:final\s*)?(?::[^:].*)?$", re.S)


def classes(text):
    """Full names of the classes that are defined in namespaces with a name."""
    scopes, last = [], 0
    text = COMMENT_OR_TEXT.sub(" ", text)
    for mark in re.finditer("[{};]", text):
        head = text[last:mark.start()].strip()
        last = mark.end()
        if mark.group() == "}" and scopes:
            scopes.pop()
        elif mark.group() == "{":
            namespace = NAMESPACE.search(head)
            found = CLASS.match(head)
            if found and None not in scopes:
                yield "::".join(scopes + [found.group(1)])
            scopes.append(namespace.group(1) or None if namespace else None)


def closure(module, seen=()):
    """All modules that `module` may see; raises on a cycle."""
    if module in seen:
        raise SystemExit("the table has a cycle: " + " -> ".join(seen + (module,)))
    found = set()
    for used in ALLOWED[module]:
        found |= {used} | closure(used, seen + (module,))
    return found


def dependencies(path, keys=("DEPENDS", "PRIVATE_DEPENDS", "OPTIONAL_DEPENDS")):
    text = re.sub(r"#.*", "", open(path, encoding="utf-8").read())
    key, names = None, []
    for word in text.split():
        if re.fullmatch(r"[A-Z_]+", word) and not word.startswith("DGTk"):
            key = word
        elif key in keys:
            names.append(word)
    return names


def passes_on_vtk(modules, module):
    """Whether whoever links a module's target finds headers of VTK."""
    names = [name.split("::") for name in dependencies(os.path.join(modules, module, "vtk.module"), ("DEPENDS",))]
    return any(package == "VTK" or (package == "DGTk" and passes_on_vtk(modules, used)) for package, used in names)


def check(source):
    ALLOWED.update(table(source))
    places = {}
    modules = os.path.join(source, "Modules")
    problems = named_in_texts(modules) + list(by_processor(modules))
    lists = open(os.path.join(source, "CMakeLists.txt"), encoding="utf-8").read()
    editor = re.search(r'dgtk_editor_modules INCLUDE REGEX "::\((.*?)\)', lists).group(1).split("|")
    owners = {os.path.basename(name): module for module in ALLOWED for name in files(modules, module)}
    for module in sorted(os.listdir(modules)):
        declaration = os.path.join(modules, module, "vtk.module")
        if not os.path.exists(declaration):
            continue
        if module not in ALLOWED:
            problems.append(f"Modules/{module}: not in the table of modules")
            continue
        may_see = closure(module)
        for name in dependencies(declaration):
            package, _, used = name.partition("::")
            if package == "DGTk" and used not in may_see:
                problems.append(f"Modules/{module}/vtk.module: {module} may not use {used}")
            if package == "VTK" and module not in USES_VTK:
                problems.append(f"Modules/{module}/vtk.module: {module} may not use VTK")
        lists = open(os.path.join(modules, module, "CMakeLists.txt"), encoding="utf-8").read()
        for name in files(modules, module):
            text = open(os.path.join(modules, module, name), encoding="utf-8").read()
            public = name.endswith(".h") and re.search(r"\b" + re.escape(name) + r"\b", lists)
            if public and PRIVATE_LIBRARIES.search(text):
                problems.append(f"Modules/{module}/{name}: a public header includes a private library")
            listed = re.search(r"\b" + os.path.basename(name)[:-2] + r"\b(?!\.cxx)", lists)  # as a header or a class
            if name.endswith(".h") and listed and module not in editor and re.search(r'#\s*include\s*[<"]vtk', text) and not passes_on_vtk(modules, module):
                problems.append(f"Modules/{module}/{name}: an installed header includes VTK, which its target does not pass on")
            for defined in classes(text):
                places.setdefault(defined, []).append(f"Modules/{module}/{name}")
            for included in re.findall(r'#\s*include\s*"(dgtk\w+\.h)"', text):
                owner = owners.get(included, module)
                if owner != module and owner not in may_see:
                    problems.append(f"Modules/{module}/{name}: includes {included} of {owner}")
    problems += [f"{name}: defined in {' and '.join(files)}" for name, files in sorted(places.items()) if len(files) > 1]
    return problems


if __name__ == "__main__":
    found = check(sys.argv[1])
    print("\n".join(found) or "the modules keep to the table")
    sys.exit(1 if found else 0)
