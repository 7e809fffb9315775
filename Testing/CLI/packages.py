# SPDX-License-Identifier: BSD-3-Clause
"""What the cases of Debian packages share: making them of the build, and asking them."""
import functools
import glob
import os
import re
import subprocess

BUILD = os.environ["DGTK_BUILD"]
NAMES = ["dgtk", "dgtk-editor", "libdgtk-dev", "python3-dgtk"]


def run(*words, **options):
    """Runs a program that must succeed; what it printed."""
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, words))}: status {done.returncode}\n{done.stdout}")
    return done.stdout


def make(folder, versions=True, **settings):
    """The packages of the build, made in a folder, with settings of CPack: name -> path. Without versions, libraries ask for none."""
    os.makedirs(os.path.join(folder, "bin"))
    scripts = {"words": '[ "$1 $2" = "-E env" ] || exec cmake "$@"\nshift 2\nexec env "$@"\n'}  # as CPack's `cmake -E env WORDS`, one a file, which takes longer than all WORDS
    if not versions:
        own = "/usr/bin/dpkg-shlibdeps"
        scripts["dpkg-shlibdeps"] = f'[ $# -gt 1 ] || exec {own} "$@"\nexec /usr/bin/python3 "{os.path.dirname(__file__)}/dependencies.py" "$@"\n'
    for name, script in scripts.items():
        with open(os.path.join(folder, "bin", name), "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\n" + script)
        os.chmod(file.name, 0o755)
    config = os.path.join(folder, "config.cmake")
    with open(config, "w", encoding="utf-8") as file:
        file.write(f'include("{BUILD}/CPackConfig.cmake")\nset(CMAKE_COMMAND "{folder}/bin/words")\n')
        file.writelines(f'set(CPACK_{name} "{value}")\n' for name, value in settings.items())
    run("cpack", "--config", config, "-B", folder, env={**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}"})
    return {os.path.basename(path).split("_")[0]: path for path in glob.glob(os.path.join(folder, "*.deb"))}


@functools.cache
def files(package):
    """Paths, without the folders, from the root on, of what a package holds: path -> (mode, owner)."""
    found = {}
    for line in run("dpkg-deb", "--contents", package).splitlines():
        mode, owner, _, _, _, path = line.split(None, 5)
        if not mode.startswith("d"):
            found[path.split(" -> ")[0][1:]] = mode, owner
    return found


def unpacked_size(package):
    """Bytes of its files. CPack's Installed-Size counts a library again for each of its links."""
    return sum(int(line.split()[2]) for line in run("dpkg-deb", "--contents", package).splitlines() if line.startswith("-"))


@functools.cache
def fields(package):
    return dict(re.findall(r"(?ms)^(\S+): (.*?)$(?=\n\S|\n?\Z)", run("dpkg-deb", "--field", package)))


def field(package, name):
    return fields(package)[name].strip()


def dependencies(package, kind="Depends"):
    """Names of the packages that one asks for; alternatives are one of them."""
    text = field(package, kind)
    return {re.match(r"[\w.+-]+", part.strip()).group() for clause in text.split(",") if clause.strip() for part in clause.split("|")}
