# SPDX-License-Identifier: BSD-3-Clause
"""Debian packages of the build: what is in which, what they ask for, and that what was unpacked works where it lies."""
import glob
import gzip
import io
import itertools
import json
import os
import re
import shutil
import struct
import subprocess
import tarfile
import tempfile
import unittest

import packages
from harness import SCENES, SOURCE, WHOLE, Case, digests, main
from many_runs import ManyCase

PLAIN_ENVIRONMENT = {name: value for name, value in os.environ.items() if name not in ("LD_LIBRARY_PATH", "PYTHONPATH", "DGTK")}
CONTROL = ["control", "md5sums", "postinst", "postrm", "prerm", "shlibs"]
made = {}


def setUpModule():
    made["folder"] = tempfile.mkdtemp(prefix="dgtk-packages-")
    unittest.addModuleCleanup(shutil.rmtree, made["folder"], ignore_errors=True)
    made["packages"] = packages.make(os.path.join(made["folder"], "first"), versions=WHOLE, DEBIAN_COMPRESSION_TYPE="gzip")
    made["root"] = os.path.join(made["folder"], "root")
    for path in made["packages"].values():
        packages.run("dpkg-deb", "--extract", path, made["root"])


def unpacked(*names):
    return os.path.join(made["root"], "usr", *names)


def library_folder():
    return "lib/" + packages.run("dpkg-architecture", "-qDEB_HOST_MULTIARCH").strip()


def is_elf(path):
    with open(path, "rb") as file:
        return file.read(4) == b"\x7fELF"


def said(entry, paths):
    """Names in the dynamic sections of programs and libraries: NEEDED, those of libraries that they ask the loader for."""
    return re.findall(rf"(?m)^  {entry} +(\S+)$", packages.run("objdump", "-p", *paths)) if paths else []


class Contents(Case):
    def test_there_are_four_and_each_says_what_it_is(self):
        self.assertEqual(packages.NAMES, sorted(made["packages"]))
        version = self.dgtk("--version").stdout.split()[1]
        for name, path in made["packages"].items():
            with self.subTest(name):
                self.assertEqual([name, version + "-1", "dgtk"], [packages.field(path, key) for key in ("Package", "Version", "Source")])
                self.assertRegex(packages.field(path, "Maintainer"), r"^\S.+ <\S+@\S+>$")
                summary, *rest = packages.field(path, "Description").splitlines()
                self.assertLess(len(summary), 80)
                self.assertTrue(rest and all(line.startswith(" ") for line in rest))
        self.assertEqual(["graphics", "graphics", "libdevel", "python"],
                         [packages.field(made["packages"][name], "Section") for name in packages.NAMES])

    def test_every_installed_file_is_in_one_package(self):
        owners = {}
        for name, path in made["packages"].items():
            for file, (mode, owner) in packages.files(path).items():
                self.assertNotIn(file, owners, f"in {name}, too")
                owners[file] = name
                self.assertEqual(("root/root", "r", "r"), (owner, mode[4], mode[7]), f"{file}: {mode}")
        packages.run("cmake", "--install", packages.BUILD, "--prefix", self.path("prefix"))
        installed = {"/usr/" + file + (".gz" if "/man1/" in file else "") for file in digests(self.path("prefix"))}
        besides = {f"/usr/share/doc/{name}/{file}" for name in packages.NAMES for file in ("copyright", "changelog.Debian.gz")}
        self.assertEqual(installed | besides, set(owners))

    def test_what_belongs_where(self):
        where = library_folder()
        for package, names in {
                "dgtk": ["bin/dgtk", "libexec/dgtk/dgtk-import", f"{where}/libdgtkCore.so.0.1", f"{where}/libdgtkdeepexr.so.0.1",
                         "share/man/man1/dgtk.1.gz", "share/bash-completion/completions/dgtk"],
                "dgtk-editor": ["bin/dgtk-editor", f"{where}/dgtk/libdgtkViews.so", "share/applications/dgtk-editor.desktop",
                                "share/man/man1/dgtk-editor.1.gz", "share/mime/packages/dgtk-editor.xml"],
                "python3-dgtk": ["lib/python3/dist-packages/dgtk/__init__.py"],
                "libdgtk-dev": ["include/dgtk/dgtkGenerator.h", f"{where}/libdgtkCore.so", f"{where}/cmake/DGTk/DGTkConfig.cmake"]}.items():
            with self.subTest(package):
                held = packages.files(made["packages"][package])
                self.assertEqual([], ["/usr/" + name for name in names if "/usr/" + name not in held])

    def test_control_files(self):
        for name, path in made["packages"].items():
            held = packages.run("dpkg-deb", "--info", path)
            self.assertEqual([], [line for line in held.splitlines() if line.endswith("#!/bin/sh") and line.split()[-2] not in CONTROL])
            folder = self.path(name)
            packages.run("dpkg-deb", "--control", path, folder)
            for script in ("postinst", "prerm", "postrm"):
                if os.path.exists(os.path.join(folder, script)):
                    self.assertTrue(os.access(os.path.join(folder, script), os.X_OK), script)
                    packages.run("sh", "-n", os.path.join(folder, script))
        with open(self.path("dgtk", "shlibs"), encoding="utf-8") as file:
            shlibs = [line.split()[:3] for line in file]
        libraries = glob.glob(unpacked(library_folder(), "libdgtk*.so.*.*.*"))
        sonames = [name.split(".so.") for name in said("SONAME", libraries)]
        self.assertEqual(len(sonames), len(libraries))
        self.assertEqual(sorted(shlibs), sorted([library, number, "dgtk"] for library, number in sonames))
        self.assertIn("libdgtkPipeline", [library for library, _, _ in shlibs])

    def test_the_same_build_gives_the_same_bytes(self):
        """But for what dpkg-shlibdeps, which is most of the time, and whose lists are sorted, adds to the control files: it is left out here."""
        def parts(package):
            """(header, bytes) of what the archive of a package holds: a header has 60 bytes, the size in those from 48 on."""
            with open(package, "rb") as file:
                self.assertEqual(file.read(8), b"!<arch>\n")
                while header := file.read(60):
                    size = int(header[48:58])
                    yield header, file.read(size + size % 2)

        def controls(data, added):
            with tarfile.open(fileobj=io.BytesIO(data)) as archive:
                for row in archive:
                    text = archive.extractfile(row).read() if row.isfile() else b""
                    if row.name == "./control":
                        text, row.size, row.chksum = re.sub(rb"^Depends: .*\n", b"", text, flags=re.M), 0, 0
                    if row.name not in added:
                        yield row.get_info(), text

        second = packages.make(self.path("second"), DEBIAN_PACKAGE_SHLIBDEPS="OFF", DEBIAN_COMPRESSION_TYPE="gzip")
        self.assertEqual(packages.NAMES, sorted(second))
        for name, path in made["packages"].items():
            added = ("./postinst", "./postrm") if name == "dgtk" else ()  # ldconfig
            for (header, data), (again, other) in itertools.zip_longest(parts(path), parts(second[name])):
                if header.startswith(b"control.tar"):
                    self.assertEqual((header[:48], list(controls(data, added))), (again[:48], list(controls(other, added))), name)
                else:
                    self.assertTrue(header == again and data == other, f"{name}: {header[:16]}")


class Dependencies(Case):
    def test_what_is_linked_and_what_is_opened_by_name(self):
        asked = {name: packages.dependencies(path) for name, path in made["packages"].items()}
        self.assertEqual(set(), {name for name in asked["dgtk"] if "qt" in name})
        self.assertLessEqual({"libc6", "libstdc++6", "libvtk9.1", "libembree3-3", "libassimp5", "libegl1", "libgl1-mesa-dri"}, asked["dgtk"])
        self.assertEqual({"povray", "blender"}, packages.dependencies(made["packages"]["dgtk"], "Suggests"))
        self.assertLessEqual({"dgtk", "libqt5widgets5", "libvtk9.1-qt"}, asked["dgtk-editor"])
        self.assertLessEqual({"dgtk", "python3", "python3-numpy", "python3-vtk9", "libvtk9.1"}, asked["python3-dgtk"])
        self.assertLessEqual({"dgtk", "libeigen3-dev", "libvtk9-dev"}, asked["libdgtk-dev"])
        version = packages.field(made["packages"]["dgtk"], "Version")
        for name in ("dgtk-editor", "python3-dgtk", "libdgtk-dev"):
            self.assertIn(f"dgtk (= {version})", packages.field(made["packages"][name], "Depends"))

    def test_libraries_of_windows_are_needed_by_the_editor_alone(self):
        wanted = {"dgtk": set(), "dgtk-editor": set(), "python3-dgtk": set(), "libdgtk-dev": set()}
        for name, path in made["packages"].items():
            paths = [made["root"] + file for file in packages.files(path)]
            wanted[name].update(said("NEEDED", [path for path in paths if not os.path.islink(path) and is_elf(path)]))
        self.assertEqual([], [name for name in wanted["dgtk"] | wanted["python3-dgtk"] if "Qt" in name])
        self.assertIn("libQt5Widgets.so.5", wanted["dgtk-editor"])
        ours = {os.path.basename(file) for file in packages.files(made["packages"]["dgtk"]) if "libdgtk" in file}
        self.assertEqual(set(), {name for name in wanted["dgtk"] | wanted["python3-dgtk"] if name.startswith("libdgtk")} - ours)


class Pages(ManyCase):
    def page(self, name):
        """As `man` shows it; it must have nothing to warn of."""
        done = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", unpacked("share", "man", "man1", name + ".1.gz")],
                              capture_output=True, text=True, env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "80", "MANPAGER": "cat",
                                                                      "MAN_DISABLE_SECCOMP": "1"})
        self.assertEqual(("", 0), (done.stderr, done.returncode), name)
        return " ".join(done.stdout.split()).replace("| ", "|")  # a line may break after it

    def test_each_command_has_a_page_with_all_of_its_options(self):
        commands = json.loads(self.dgtk("list", "commands", "--json").stdout)["commands"]
        self.assertEqual(sorted(["dgtk.1.gz", "dgtk-editor.1.gz"] + [f"dgtk-{row['command']}.1.gz" for row in commands]),
                         sorted(os.listdir(unpacked("share", "man", "man1"))))
        overview = self.page("dgtk")
        self.assertIn("4 The machine cannot do it. 75 The run was interrupted, or another process is at work on it: ", overview)
        for row in commands:
            self.assertIn(f"dgtk-{row['command']}(1) {row['help']}", overview)
            page = self.page("dgtk-" + row["command"])
            self.assertIn(f"dgtk {row['command']} {row['arguments']} [options]", page)
            help_ = self.dgtk(row["command"], "--help").stdout
            for option in row["options"]:
                named = " ".join(filter(None, (option["name"], option["value"])))
                self.assertIn(named, help_)
                self.assertIn(named + " " + option["help"][0].upper() + option["help"][1:], page)
        self.assertIn("depth Z in the camera frame, positive forward.", self.page("dgtk-render"))

    def test_the_page_of_the_editor(self):
        page = self.page("dgtk-editor")
        for text in ("dgtk-editor - the desktop editor of DGTk", "--language LANGUAGE", "--version", "DGTK of the environment"):
            self.assertIn(text, page)

    def test_licence_and_changelog(self):
        for name in packages.NAMES:
            with open(unpacked("share", "doc", name, "copyright"), encoding="utf-8") as file:
                text = file.read()
            self.assertIn("License: BSD-3-Clause\n Redistribution and use", text)
            self.assertIn("Copyright: 2026, the DGTk developers", text)
            everything, openssl, apache = text.split("Files: *")[1].rstrip("\n").split("\n\n")
            self.assertEqual([], [line for line in everything.splitlines()[3:] if not line.startswith(" ")])
            self.assertRegex(openssl, r"^Files: usr/lib/\*/libdgtkCore\.so\.\*\nCopyright: .*\n The OpenSSL Project Authors\nLicense: BSD-3-Clause and Apache-2\.0\nComment: ")
            self.assertTrue(apache.startswith("License: Apache-2.0\n "))
            with gzip.open(unpacked("share", "doc", name, "changelog.Debian.gz"), "rt", encoding="utf-8") as file:
                self.assertTrue(file.read().startswith(f"dgtk ({packages.field(made['packages'][name], 'Version')}) "))


class Completion(Case):
    def all_completed(self, lines, program="dgtk"):
        """What bash offers for the last word of each line, which is a tuple of words."""
        function = "_" + program.replace("-", "_")
        script = ('source "$1"; shift; COMP_WORDS=(); for word; do if [ "$word" != END ]; then COMP_WORDS+=("$word"); else '
                  f'COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); COMPREPLY=(); {function}; '
                  '[ ${#COMPREPLY[@]} -eq 0 ] || printf "%s\\n" "${COMPREPLY[@]}"; echo END; COMP_WORDS=(); fi; done')
        file = unpacked("share", "bash-completion", "completions", program)
        words = [word for line in lines for word in (program, *line, "END")]
        found = packages.run("bash", "-euc", script, "bash", file, *words, cwd=self.folder).split("END\n")
        return [offered.splitlines() for offered in found[:-1]]

    def completed(self, *words, program="dgtk"):
        return self.all_completed([words], program)[0]

    def test_commands_options_and_their_words(self):
        commands = json.loads(self.dgtk("list", "commands", "--json").stdout)["commands"]
        self.assertEqual([row["command"] for row in commands] + ["--help", "--version"], self.completed(""))
        self.assertEqual(["convert", "correspond", "compare"], self.completed("co"))
        for row, offered in zip(commands, self.all_completed([(row["command"], "-") for row in commands]), strict=True):
            self.assertEqual({name for option in row["options"] for name in (option.get("short"), option["name"]) if name}, set(offered))
        choices = [(row["command"], option) for row in commands for option in row["options"] if "choices" in option]
        for (command, option), offered in zip(choices, self.all_completed([(command, option["name"], "") for command, option in choices]), strict=True):
            self.assertEqual(option["choices"], offered, f"{command} {option['name']}")
        self.assertEqual(["ray", "raster"], sorted(self.completed("render", "--visibility", "ra"), reverse=True))
        self.assertEqual(["egl"], self.completed("render", "--gl", "=", "e"))
        self.assertEqual(["color,depth,distance"], self.completed("render", "--layers", "color,depth,dist"))
        self.assertNotIn("color,color", self.completed("render", "--layers", "color,"))
        self.assertEqual([], self.completed("render", "--size", ""))
        self.assertEqual(["gl"], self.completed("list", "g"))

    def test_files_and_folders(self):
        self.write("a scene.json", "{}")
        os.mkdir(self.path("folder"))
        self.assertEqual(["a scene.json", "folder"], sorted(self.completed("render", "")))
        self.assertEqual(["folder"], self.completed("render", "-o", ""))
        self.assertEqual(["folder"], self.completed("verify", ""))
        self.assertEqual(["a scene.json"], self.completed("correspond", "x", "--points", "a"))
        self.assertEqual(["a scene.json"], self.completed("a", program="dgtk-editor"))
        self.assertEqual(["--language"], self.completed("--l", program="dgtk-editor"))


class Desktop(Case):
    def test_menu_icons_and_kinds_of_files(self):
        packages.run("desktop-file-validate", unpacked("share", "applications", "dgtk-editor.desktop"))
        for size in (48, 128, 256):
            with open(unpacked("share", "icons", "hicolor", f"{size}x{size}", "apps", "dgtk-editor.png"), "rb") as file:
                head = file.read(24)
            self.assertEqual((b"\x89PNG", size, size), (head[:4], *struct.unpack(">II", head[16:])))
        mime = self.path("mime")
        shutil.copytree(unpacked("share", "mime"), mime)
        self.assertEqual("", packages.run("update-mime-database", mime, env={**os.environ, "XDG_DATA_HOME": self.folder}))
        with open(os.path.join(mime, "globs"), encoding="utf-8") as file:
            self.assertLessEqual({"text/x-dgtk-scene:*.scene", "application/x-dgtk-scene+json:*.scene.json"}, set(file.read().splitlines()))
        for scene in glob.glob(os.path.join(SCENES, "*.scene")):
            with open(scene, "rb") as file:
                self.assertIn(file.read(32).find(b"glObject_"), range(2, 9), scene)


class Unpacked(Case):
    def run_there(self, *words, **environment):
        done = subprocess.run(words, capture_output=True, text=True, env={**PLAIN_ENVIRONMENT, **environment}, cwd=self.folder)
        self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout}\n{done.stderr}")
        return done.stdout

    def loaded(self, *words, **environment):
        """Paths of our libraries that the loader takes."""
        text = self.run_there(*words, LD_TRACE_LOADED_OBJECTS="1", **environment)
        self.assertNotIn("not found", text)
        return [line.split()[2] for line in text.splitlines() if line.strip().startswith("libdgtk")]

    def test_the_program_with_its_helpers(self):
        dgtk = unpacked("bin", "dgtk")
        self.assertEqual(self.dgtk("--version").stdout, self.run_there(dgtk, "--version"))
        libraries = self.loaded(dgtk)
        self.assertGreater(len(libraries), 5)
        self.assertEqual([], [path for path in libraries if not os.path.realpath(path).startswith(os.path.realpath(made["root"]))])
        scene = os.path.join(SCENES, "demo.json")
        words = ("render", scene, "--size", "64x48", "--frames", "0", "--layers", "color,depth,ldi", "--ldi-format", "exr", "--quiet")
        self.run_there(dgtk, *words, "-o", self.path("there"))
        self.dgtk(*words, "-o", self.path("here"))
        self.assert_same_files(self.path("here"), self.path("there"))

    def test_python(self):
        script = ("import dgtk, sys; scene = dgtk.load(sys.argv[1])\n"
                  "images = dgtk.render(scene, ['color', 'depth'], size=(32, 24))\n"
                  "print(dgtk.__file__, images['color'].shape, images['depth'].shape)")
        packages_of_python = unpacked("lib", "python3", "dist-packages")
        said = self.run_there("/usr/bin/python3", "-c", script, os.path.join(SCENES, "demo.json"), PYTHONPATH=packages_of_python,
                              PYTHONDONTWRITEBYTECODE="1")
        self.assertEqual(f"{packages_of_python}/dgtk/__init__.py (24, 32, 3) (24, 32)\n", said)

    def test_the_editor(self):
        editor = unpacked("bin", "dgtk-editor")
        self.assertRegex(self.run_there(editor, "--version", QT_QPA_PLATFORM="offscreen"), r"^dgtk-editor \d")
        libraries = self.loaded(editor)
        self.assertIn("libdgtkViews.so", map(os.path.basename, libraries))
        self.assertEqual([], [path for path in libraries if not os.path.realpath(path).startswith(os.path.realpath(made["root"]))])

    def test_another_project(self):
        shutil.copy(os.path.join(SOURCE, "Testing", "Consumer", "project", "consumer.cxx"), self.folder)
        self.write("CMakeLists.txt", "cmake_minimum_required(VERSION 3.25)\nproject(Mine LANGUAGES C CXX)\nfind_package(DGTk 0.1 REQUIRED)\n"
                                     "add_executable(mine consumer.cxx)\ntarget_link_libraries(mine PRIVATE DGTk::Camera DGTk::Pipeline)\n")
        with open(os.path.join(packages.BUILD, "CMakeCache.txt"), encoding="utf-8") as cache:  # what VTK would try of the system: it is the same
            known = re.findall(r"(?m)^((?:CMAKE_HAVE_|CMAKE_LIB_|X11_LIB_)\w+:INTERNAL=1)$", cache.read())
        self.run_there("cmake", "-G", "Ninja", "-S", ".", "-B", "build", f"-DDGTk_ROOT={unpacked()}", *("-D" + one for one in known))
        self.run_there("cmake", "--build", "build")
        self.assertRegex(self.run_there(self.path("build", "mine")), r"^320 240, \d+ layers\n$")
        self.assertTrue(self.loaded(self.path("build", "mine"))[0].startswith(made["root"]))


if __name__ == "__main__":
    main()
