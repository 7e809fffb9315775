# SPDX-License-Identifier: BSD-3-Clause
"""Debian packages of the build, installed into a fresh Debian: with DGTK_FRESH_ROOT=1, as root, with debootstrap and where
apt reaches Debian's packages. Some 2 GB of them: minutes. It says how many packages each asks for, and how large they are.
"""
import os
import re
import shutil
import sys
import tempfile
import unittest

import packages
from harness import SOURCE, main

FOLDERS = os.environ.get("DGTK_FRESH_ROOT_FOLDER")  # where the root stands; a temporary folder without it
QUIET = ("-q", "-y", "-o", "Dpkg::Use-Pty=0")
made = {}


def setUpModule():
    if os.environ.get("DGTK_FRESH_ROOT") != "1":
        raise unittest.SkipTest("left out: it installs into a fresh Debian; set DGTK_FRESH_ROOT=1")
    made["folder"] = tempfile.mkdtemp(prefix="dgtk-fresh-", dir=FOLDERS)
    unittest.addModuleCleanup(remove)
    made["root"] = os.path.join(made["folder"], "root")
    made["packages"] = packages.make(os.path.join(made["folder"], "packages"))
    bootstrap()


def bootstrap():
    """A minimal Debian of this machine's release, from where this machine's apt takes it, with apt's own settings."""
    release = packages.run("sh", "-c", '. /etc/os-release && echo "$VERSION_CODENAME"').strip()
    sources = packages.run("apt-get", "indextargets", "--format", "$(CODENAME) $(REPO_URI)", "Created-By: Packages")
    mirror = next(line.split()[1] for line in sources.splitlines() if line.split()[0] == release)
    packages.run("debootstrap", "--variant=minbase", release, made["root"], mirror)
    shutil.copytree("/etc/apt", os.path.join(made["root"], "etc", "apt"), dirs_exist_ok=True, symlinks=True)
    for name in ("hosts", "resolv.conf"):
        shutil.copy(os.path.join("/etc", name), os.path.join(made["root"], "etc", name))
    os.mkdir(os.path.join(made["root"], "dgtk"))
    for path in made["packages"].values():
        shutil.copy(path, os.path.join(made["root"], "dgtk"))
    shutil.copytree(os.path.join(SOURCE, "Data"), os.path.join(made["root"], "dgtk", "Data"))
    shutil.copytree(os.path.join(SOURCE, "Testing", "Consumer", "project"), os.path.join(made["root"], "dgtk", "project"))
    for system in ("proc", "dev"):
        packages.run("mount", "--rbind" if system == "dev" else "--bind", "/" + system, os.path.join(made["root"], system))
        packages.run("mount", "--make-rslave", os.path.join(made["root"], system))
    inside("apt-get", "-q", "update")
    for name in ("dgtk", "dgtk-editor", "python3-dgtk", "libdgtk-dev"):
        tell(name)


def remove():
    """Nothing of the machine's own folders is below the root when it is removed."""
    for system in ("proc", "dev"):
        place = os.path.join(made["root"], system)
        if os.path.ismount(place):
            packages.run("umount", "--recursive", "--lazy", place)
    if not any(os.path.ismount(os.path.join(made["root"], system)) for system in ("proc", "dev")):
        shutil.rmtree(made["folder"], ignore_errors=True)


def inside(*words, **variables):
    """Runs a program in the fresh root, with an environment of its own."""
    passed = {name: value for name, value in os.environ.items() if name.lower().endswith("_proxy")}
    settings = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive"}
    return packages.run("chroot", made["root"], *words, env={**passed, **settings, **variables})


def installed():
    rows = inside("dpkg-query", "--show", "--showformat", "${db:Status-Abbrev} ${Package}\n").splitlines()
    return {row.split()[1] for row in rows if row.startswith("ii")}


def place(name):
    return f"/dgtk/{os.path.basename(made['packages'][name])}"


def tell(name):
    """What a package of ours takes on a minimal Debian, with dgtk and without what is only recommended."""
    plan = inside("sh", "-c", f"apt-get install --no-install-recommends --assume-no {place('dgtk')} {place(name)} || true")
    count = re.search(r"(\d+) newly installed", plan).group(1)
    size = re.search(r"([\d.,]+ .B) of additional", plan).group(1)
    package = made["packages"][name]
    print(f"{name}: {os.path.getsize(package) / 1e6:.2f} MB, {packages.unpacked_size(package) / 1e6:.1f} MB unpacked, asks for "
          f"{len(packages.dependencies(package))} packages; on a minimal Debian {count} new packages, {size}", file=sys.stderr)


def install(name, *others):
    """Installs a package of ours without what is only recommended, and other packages; the names of all that came."""
    before = installed()
    inside("apt-get", "install", "--no-install-recommends", *QUIET, place(name), *others)
    return installed() - before


class FreshRoot(unittest.TestCase):
    """The order of the cases is that of their names: each package is installed by the first that needs it."""

    def test_1_the_program_without_windows(self):
        new = install("dgtk")
        self.assertEqual([], sorted(name for name in new if "qt" in name.lower()))
        self.assertRegex(inside("dgtk", "--version"), r"^dgtk \d")
        inside("dgtk", "render", "/dgtk/Data/Scenes/demo.json", "-o", "/tmp/demo", "--size", "64x48", "--layers", "all", "--quiet")
        inside("dgtk", "verify", "/tmp/demo")
        for gl in ("egl", "osmesa"):
            inside("dgtk", "render", "/dgtk/Data/Scenes/demo.json", "-o", "/tmp/" + gl, "--size", "64x48", "--frames", "0", "--renderer",
                   "vtk", "--layers", "color", "--gl", gl, "--quiet")
            self.assertTrue(os.path.exists(os.path.join(made["root"], "tmp", gl, "manifest.json")))

    def test_2_python(self):
        install("python3-dgtk")
        script = ("import dgtk; scene = dgtk.load('/dgtk/Data/Scenes/demo.json')\n"
                  "print(dgtk.__file__, dgtk.render(scene, 'depth', size=(32, 24)).shape)")
        self.assertEqual("/usr/lib/python3/dist-packages/dgtk/__init__.py (24, 32)\n", inside("/usr/bin/python3", "-c", script))
        self.assertTrue(os.path.isdir(os.path.join(made["root"], "usr/lib/python3/dist-packages/dgtk/__pycache__")))

    def test_3_the_editor(self):
        install("dgtk-editor")
        self.assertRegex(inside("dgtk-editor", "--version", QT_QPA_PLATFORM="offscreen"), r"^dgtk-editor \d")
        line = inside("sh", "-c", "timeout 10 dgtk-editor /dgtk/Data/Scenes/demo.json; test $? -eq 124 && echo stayed", QT_QPA_PLATFORM="offscreen")
        self.assertTrue(line.endswith("stayed\n"), line)

    def test_4_another_project(self):
        install("libdgtk-dev", "g++", "cmake", "make")
        inside("cmake", "-S", "/dgtk/project", "-B", "/tmp/project")
        inside("cmake", "--build", "/tmp/project", "--parallel", str(os.cpu_count()))
        inside("ctest", "--test-dir", "/tmp/project", "--output-on-failure")

    def test_5_nothing_stays_when_they_are_removed(self):
        self.assertLessEqual(set(packages.NAMES), installed())
        inside("apt-get", "purge", *QUIET, *packages.NAMES)
        self.assertEqual("", packages.run("find", os.path.join(made["root"], "usr"), "-name", "*dgtk*", "-o", "-name", "DGTk*"))


if __name__ == "__main__":
    main()
