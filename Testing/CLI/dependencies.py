# SPDX-License-Identifier: BSD-3-Clause
"""In place of dpkg-shlibdeps where packages are made for tests: which packages have the libraries that files ask for.

For the least version of each, which no test asks for, that takes longer than all else of a package. It gets few files itself.
"""
import os
import re
import subprocess
import sys

OWN = "/usr/bin/dpkg-shlibdeps"
FEW = 2


def said(*words, check=True):
    return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=check).stdout


def main(arguments):
    files = [word for word in arguments if not word.startswith("-")]
    if len(files) <= FEW:
        os.execv(OWN, [OWN, *arguments])
    wanted = set(re.findall(r"(?m)^  NEEDED +(\S+)$", said("objdump", "-p", *files)))
    known = dict(re.findall(r"(?m)^\t(\S+) \(libc6,[\w-]*64\b.*\) => (\S+)$", said("/sbin/ldconfig", "-p")))
    private = {name for word in arguments if word.startswith("-l") for name in os.listdir(word[2:])}
    if lost := sorted(wanted - private - set(known)):
        sys.exit(f"cannot find {', '.join(lost)}")
    paths = {path for name in wanted - private for path in (known[name], os.path.realpath(known[name]))}
    both = {path.removeprefix("/usr") for path in paths} | {"/usr" + path.removeprefix("/usr") for path in paths}
    owners = set(re.findall(r"(?m)^([^:,\s]+).*: /", said("dpkg-query", "--search", *sorted(both), check=False)))
    print("shlibs:Depends=" + ", ".join(sorted(owners)))


if __name__ == "__main__":
    main(sys.argv[1:])
