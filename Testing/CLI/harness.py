# SPDX-License-Identifier: BSD-3-Clause
"""What the whole-program cases share: running dgtk, temporary folders, comparing datasets byte by byte."""
import atexit
import contextlib
import ctypes
import functools
import hashlib
import json
import os
import select
import shutil
import struct
import subprocess
import tempfile
import time
import unittest

DGTK = os.environ["DGTK"]
SOURCE = os.environ["DGTK_SOURCE"]
SCENES = os.path.join(SOURCE, "Data", "Scenes")
EXTRA = os.environ.get("DGTK_EXTRA_MODELS", os.environ.get("DGTK_EXTRA_MODELS_DEFAULT", ""))
WHOLE = bool(os.environ.get("DGTK_TEST_WHOLE"))  # each sweep as broad as it can be; a thin one sees each kind once

# Models that were read are kept for the runs of this program alone. Where each run has to read them itself, a case
# says so: DGTK_CACHE=0. Shaders that Mesa compiled stay where they are for all programs.
os.environ.setdefault("MESA_SHADER_CACHE_DIR", os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"))
CACHES = tempfile.mkdtemp(prefix="dgtk-cache-")
atexit.register(shutil.rmtree, CACHES, ignore_errors=True)
os.environ["XDG_CACHE_HOME"] = CACHES

measures = unittest.skipIf(os.environ.get("DGTK_TEST_SANITIZED"), "measures time or memory, which sanitizers change")


@contextlib.contextmanager
def ended(process):
    """A process that does not outlive the block, however this ends."""
    with process:
        try:
            yield process
        finally:
            process.kill()


class Case(unittest.TestCase):
    """A test case with a folder of its own, removed afterwards."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="dgtk-cli-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "w" if isinstance(text, str) else "wb") as file:
            file.write(text)
        return self.path(name)

    def dgtk(self, *arguments, status=0, environment=None, timeout=600):
        """Runs dgtk; returns the finished process. Fails unless it exits with `status`."""
        done = subprocess.run([DGTK, *map(str, arguments)], capture_output=True, text=True, timeout=timeout,
                              env={**os.environ, **(environment or {})})
        self.assertEqual(done.returncode, status, f"dgtk {' '.join(map(str, arguments))}\n{done.stdout}\n{done.stderr}")
        return done

    def refused(self, *arguments, status, says=()):
        """Runs dgtk, which must fail with `status` and one line on standard error that holds every text of `says`."""
        done = self.dgtk(*arguments, status=status)
        lines = [line for line in done.stderr.splitlines() if line]
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertTrue(lines[0].startswith("dgtk: "), lines[0])
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, lines[0])
        return lines[0]

    def interrupted(self, words, folder, how, when, tries=5):
        """Starts dgtk with `words` and sends `how` as soon as `when()` holds; returns its exit status and what it said.

        On a busy machine a run may be at its end before it is looked at again; it is then begun anew, in an empty folder.
        """
        for _ in range(tries):
            shutil.rmtree(folder, ignore_errors=True)
            with ended(subprocess.Popen([DGTK, *words], stderr=subprocess.PIPE, text=True)) as process:
                end = time.monotonic() + 120
                while process.poll() is None and not when() and time.monotonic() < end:
                    time.sleep(0.002)
                process.send_signal(how)
                _, errors = process.communicate(timeout=120)
            if process.returncode != 0 and not os.path.exists(os.path.join(folder, "manifest.json")):
                return process.returncode, errors
        self.fail(f"dgtk {' '.join(words)}: ran to its end {tries} times, {how.name} or not")

    @contextlib.contextmanager
    def goes_at_once(self, folder):
        """What is done within removes the folder, and moves it away first: at no time some of it is lost."""
        system = ctypes.CDLL(None)
        removed, moved = 0x200, 0x800  # IN_DELETE, IN_MOVE_SELF
        events = system.inotify_init1(os.O_NONBLOCK)
        self.assertGreaterEqual(events, 0, "there are too many watches")
        self.addCleanup(os.close, events)
        self.assertGreaterEqual(system.inotify_add_watch(events, os.fsencode(folder), removed | moved), 0)
        yield
        self.assertTrue(select.select([events], [], [], 0)[0], "nothing goes")
        found, seen = os.read(events, 1 << 16), []
        while found:
            _, mask, _, size = struct.unpack_from("iIII", found)
            name, found = os.fsdecode(found[16:16 + size].rstrip(b"\0")), found[16 + size:]
            seen += [(mask & (removed | moved), name)] if not name.startswith("workers-") else []
        self.assertEqual(seen[:1], [(moved, "")])
        self.assertFalse(os.path.exists(folder))

    def assert_same_files(self, first, second, ignore=()):
        """Both folders hold the same files with the same bytes."""
        one, two = digests(first), digests(second)
        for name in ignore:
            one.pop(name, None)
            two.pop(name, None)
        self.assertEqual(sorted(one), sorted(two))
        differing = [name for name in one if one[name] != two[name]]
        self.assertEqual(differing, [], f"{first} and {second} differ")
        self.assertGreater(len(one), 0)


def needs_povray(test):
    """For a case or a class of cases: without POV-Ray it fails, and says so. It is one of the packages to install."""
    def wrapped(self, *arguments):
        self.assertTrue(shutil.which("povray"), "POV-Ray is not installed (Utilities/Setup/packages.txt)")
        return test(self, *arguments)

    if isinstance(test, type):
        for name in [n for n in vars(test) if n.startswith("test")]:
            setattr(test, name, needs_povray(getattr(test, name)))
        return test
    return functools.wraps(test)(wrapped)


needs_samples = unittest.skipUnless(os.path.exists(os.path.join(EXTRA, "TRUTH.json")) if EXTRA else False,
                                    "the sample models are not part of the source: set DGTK_EXTRA_MODELS")


def digests(folder):
    """Relative path -> SHA-256 of every file below a folder."""
    found = {}
    for root, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(root, name)
            with open(path, "rb") as file:
                found[os.path.relpath(path, folder)] = hashlib.sha256(file.read()).hexdigest()
    return found


def copy_scenes(folder, change, wanted=lambda name: name.endswith((".json", ".scene"))):
    """Sample scenes in folder/Scenes, among the files that they name, those in JSON as `change` leaves what they say.

    Returns their names without extensions. One run of dgtk renders them all.
    """
    os.makedirs(os.path.join(folder, "Scenes"))
    names = []
    for base, within in ((os.path.dirname(SCENES), ""), (SCENES, "Scenes")):
        for name in sorted(set(os.listdir(base)) - {"Scenes"}):
            source, target = os.path.join(base, name), os.path.join(folder, within, name)
            if base != SCENES or not name.endswith((".json", ".scene")):
                os.symlink(source, target)
            elif wanted(name):
                names.append(os.path.splitext(name)[0])
                shutil.copy(source, target)
                if name.endswith(".json"):
                    scene = load_json(source)
                    change(scene)
                    with open(target, "w", encoding="utf-8") as file:
                        json.dump(scene, file)
    return names


def load_json(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def main():
    unittest.main()
