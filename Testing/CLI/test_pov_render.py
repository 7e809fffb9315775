# SPDX-License-Identifier: BSD-3-Clause
"""dgtk render --renderer povray and the layer pov, as a user runs them."""
import json
import os
import shutil
import signal
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor

import numpy

from harness import SCENES, SOURCE, WHOLE, digests, load_json, main, needs_povray
from many_runs import ManyCase
from pictures import read_png
from pov_scene import draw, ids_of, read_pnm

SCENE = os.path.join(SCENES, "cameras_all_kinds.json")
MODELS = os.path.join(SOURCE, "Data", "Models")
WORKERS = 4  # POV-Ray sleeps for most of a small picture
SMALL = ("--size", "96x72", "--quiet")


def povray_processes(folder):
    """Processes named povray that work below a folder."""
    found = []
    for number in filter(str.isdigit, os.listdir("/proc")):
        try:
            if os.path.basename(os.readlink(f"/proc/{number}/exe")).startswith("povray") and os.readlink(f"/proc/{number}/cwd").startswith(folder):
                found.append(number)
        except OSError:
            pass
    return found


class WithoutPovRay(ManyCase):
    """What needs no POV-Ray, or one of our own making."""

    def fake(self, script):
        os.makedirs(self.path("bin"), exist_ok=True)
        program = self.write(os.path.join("bin", "povray"), "#!/bin/sh\n" + script)
        os.chmod(program, 0o755)
        return {"PATH": self.path("bin") + ":/usr/bin:/bin"}

    def failed(self, environment, status, *says, options=()):
        done = self.dgtk("render", SCENE, "-o", self.path("d"), "--renderer", "povray", "--layers", "color", "--cameras", "matrix", "--frames", "0",
                         "--replace",
                         *SMALL, *options, status=status, environment=environment)
        lines = [line for line in done.stderr.splitlines() if line]
        self.assertEqual(len(lines), 1, done.stderr)
        for text in says:
            self.assertIn(text, lines[0])
        self.assertFalse(os.path.exists(self.path("d", ".povray")))

    def test_not_installed(self):
        os.mkdir(self.path("empty"))
        self.failed({"PATH": self.path("empty")}, 4, "install the package povray")
        self.assertFalse(os.path.exists(self.path("d", "manifest.json")))
        self.dgtk("render", SCENE, "-o", self.path("all else"), "--layers", "depth,objects,pov", "--cameras", "matrix", "--frames", "0", *SMALL,
                  environment={"PATH": self.path("empty")})

    def test_errors_are_one_line(self):
        self.failed(self.fake("echo \"File 'house_12.inc' line 17: Parse Error: Expected 'numeric expression',\"\n"
                              "echo ' } found instead'\necho Fatal error in parser: Cannot parse input.\nexit 1\n"),
                    4, "house_12.inc:17: POV-Ray: Expected 'numeric expression', } found instead")
        self.failed(self.fake("echo \"File 'a.inc' line 3: Possible Parse Error: Cannot find file 'bark.png', even after trying\" >&2\nexit 1\n"),
                    3, "a.inc:3: POV-Ray: Cannot find file 'bark.png'")
        self.failed(self.fake("exit 7\n"), 4, "POV-Ray ended with status 7")
        self.failed(self.fake("printf 'Parsing\\n too many\\tthreads \\n\\nPOV-Ray finished\\n'\nexit 1\n"), 4, "POV-Ray ended with status 1: too many\\x09threads")
        self.failed(self.fake("kill -9 $$\n"), 4, "POV-Ray ended with signal 9")
        self.failed(self.fake("exit 0\n"), 4, "POV-Ray's picture is not whole")

    def test_it_is_started_again_where_its_thread_did_not_begin(self):
        """POV-Ray 3.7 gives up after 3 s in which its thread has not begun: on a machine that was halted meanwhile, say."""
        times = self.path("times")
        late = f"echo x >> '{times}'\nif [ $(wc -l < '{times}') -lt %d ]; then echo Timed out waiting for worker thread startup >&2; exit 1; fi\n"
        environment = self.fake(late % 3 + 'exec /usr/bin/povray "$@"\n')
        self.dgtk("render", SCENE, "-o", self.path("d"), "--renderer", "povray", "--layers", "color", "--cameras", "matrix", "--frames", "0", *SMALL,
                  environment=environment)
        with open(times, encoding="ascii") as file:
            self.assertEqual(file.read(), "x\n" * 3)
        os.remove(times)
        self.failed(self.fake(late % 1000), 4, "POV-Ray ended with status 1: Timed out waiting")
        with open(times, encoding="ascii") as file:
            self.assertEqual(file.read(), "x\n" * 5)

    def test_arguments_reach_it_without_a_shell(self):
        self.failed(self.fake(f"for word in \"$@\"; do echo \"$word\" >> {self.path('words')}; done\nexit 1\n"), 4, "status 1",
                    options=("--pov-antialias", "3"))
        with open(self.path("words"), encoding="utf-8") as file:
            words = file.read().split("\n")
        for word in ("+W96", "+H72", "+FP16", "+WT1", "+R3", "-J", "File_Gamma=sRGB", "Dither=off"):
            self.assertIn(word, words)

    def test_refusals(self):
        render = ("render", SCENE, "-o", self.path("x"))
        self.refused(*render, "--renderer", "povrey", status=2, says=["--renderer", "vtk, povray"])
        self.refused(*render, "--pov-shadows", status=2, says="--pov-shadows: is for pictures and scenes of POV-Ray")
        for option, value in (("--pov-area-lights", "1"), ("--pov-antialias", "10"), ("--pov-focal-blur", "1"), ("--pov-focal-blur", "0,1"),
                              ("--pov-focal-blur", "1,x"), ("--pov-position-colors", "0,0,0,1,1"), ("--pov-position-colors", "0,0,0,1,0,1")):
            self.refused(*render, "--renderer", "povray", option, value, status=2, says=option)
        self.assertFalse(os.path.exists(self.path("x")))

    def test_layer_is_found_again_and_resumed(self):
        options = ("--layers", "pov", "--cameras", "matrix,orthographic", "--frames", "0:2")
        self.alone("render", SCENE, "-o", self.path("one"), *options, "--threads", "1", *SMALL)
        self.dgtk("render", SCENE, "-o", self.path("two"), *options, "--threads", "3", *SMALL)
        self.assert_same_files(self.path("one"), self.path("two"))
        manifest = load_json(self.path("one", "manifest.json"))
        listed = {file["path"]: file for file in manifest["files"]}
        self.assertEqual(len(listed), len(manifest["files"]))
        found = digests(self.path("one"))
        self.assertEqual(sorted([*listed, "manifest.json"]), sorted(found))
        self.assertTrue(all(file["sha256"] == found[name] for name, file in listed.items()))
        shared = [name for name in listed if name.startswith("pov/")]
        creatures = [name for name in shared if name.startswith("pov/creature") and name.endswith(".inc")]
        self.assertEqual(len(creatures), 3)  # it moves: once a frame, for both cameras
        self.assertEqual(len([name for name in shared if "/house" in name]), 1)
        self.assertEqual(self.dgtk_triangles(self.path("one", "matrix", "pov", "000001.pov")), self.dgtk_triangles(SCENE))

    def dgtk_triangles(self, path):
        info = json.loads(self.dgtk("info", path, "--json").stdout)
        if "triangles" in info:
            return info["triangles"]
        return sum(thing["triangles"] for thing in info["objects"])


def recorded_files(folder):
    """Files that the journal of a run knows to be whole."""
    try:
        with open(os.path.join(folder, ".dgtk-journal"), encoding="utf-8") as journal:
            lines = journal.read().splitlines()[1:]
    except FileNotFoundError:
        return []
    return [line.split("\t")[-1] for line in lines if not line.startswith("planned")]


@needs_povray
class Render(ManyCase):
    def test_truth_is_unchanged_and_threads_change_nothing(self):
        options = ("--layers", "color,tiles,depth,normal,objects,triangles,pov", "--cameras", "matrix,flight", "--frames", "0", "--tile", "25x20",
                   "--contact-sheet", "--color-format", "png,exr", "--pov-antialias", "2", "--pov-area-lights", "2", "--pov-reflections", "--size", "48x36", "--quiet")
        self.dgtk("render", SCENE, "-o", self.path("rays"), *options)
        self.alone("render", SCENE, "-o", self.path("one"), *options, "--renderer", "povray", "--threads", "1")
        self.dgtk("render", SCENE, "-o", self.path("three"), *options, "--renderer", "povray", "--threads", "3")
        self.assert_same_files(self.path("one"), self.path("three"))
        rays, pov = digests(self.path("rays")), digests(self.path("one"))
        self.assertEqual(sorted(rays), sorted(pov))
        differing = sorted(name for name in rays if rays[name] != pov[name])
        colors = [name for name in rays if "/color/" in name or "/tiles/" in name or name in ("manifest.json", "contact.png")]
        self.assertEqual(differing, sorted(colors))
        request = load_json(self.path("one", "manifest.json"))["request"]
        self.assertEqual({key: request[key] for key in request if key.startswith(("pov_a", "pov_s", "pov_re", "renderer"))},
                         {"renderer": "povray", "pov_area_lights": "2", "pov_reflections": "on", "pov_antialias": "2"})
        self.assertEqual(load_json(self.path("rays", "manifest.json"))["request"]["renderer"], "ray")

    def test_rows_of_a_large_picture(self):
        """Drawn in several ranges of rows, in more than one canonical tile."""
        self.dgtk("render", SCENE, "-o", self.path("big"), "--renderer", "povray", "--pov-flat-ids", "--layers", "color,objects", "--visibility", "ray",
                  "--cameras", "flight", "--frames", "0", "--size", "4200x260", "--quiet")
        color = ids_of(read_png(self.path("big", "flight", "color", "000000.png")))
        ids = ids_of(read_pnm(self.path("big", "flight", "objects", "000000.ppm")))
        differing = numpy.argwhere(color != ids)
        print(f"4200x260: {len(differing)} pixels differ")
        self.assertGreater(len(numpy.unique(ids)), 3)
        self.assertLess(len(differing), 30)  # at edges

    def test_names_with_spaces_and_quotes(self):
        folder = self.path("it's \"a\" $(name)")
        os.mkdir(folder)
        shutil.copy(os.path.join(MODELS, "ball.ac"), os.path.join(folder, "b a 'l' \"l\".ac"))
        os.mkdir(os.path.join(folder, "textures"))
        with open(os.path.join(MODELS, "ball.ac"), encoding="utf-8") as file:
            text = file.read()
        scene = {"version": 1, "objects": [{"name": "ball", "model": "b a 'l' \"l\".ac"}],
                 "cameras": [{"name": "the camera", "eye": [0, 0.2, 1], "lookAt": [0, 0, 0], "near": 0.01}]}
        self.assertIn("texture", text)
        path = os.path.join(folder, "s 'c'.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        data = os.path.join(folder, "data $HOME")
        self.dgtk("render", path, "-o", data, "--renderer", "povray", "--layers", "color,objects,pov", *SMALL)
        ids = ids_of(read_pnm(os.path.join(data, "the camera", "objects", "000000.ppm")))
        color = read_png(os.path.join(data, "the camera", "color", "000000.png"))
        self.assertGreater((ids > 0).sum(), 100)
        self.assertGreater(color[ids > 0].mean(), 20)
        self.assertEqual(color[ids == 0].max(), 0)

    def test_layer_is_drawn_in_its_folder_and_by_name(self):
        self.dgtk("render", SCENE, "-o", self.path("d"), "--renderer", "povray", "--layers", "color,pov", "--cameras", "matrix", "--frames", "3", *SMALL)
        color = read_png(self.path("d", "matrix", "color", "000003.png"))
        scene = self.path("d", "matrix", "pov", "000003.pov")
        self.assertTrue((draw(scene) == color).all())
        os.mkdir(self.path("elsewhere"))
        with open(scene, encoding="utf-8") as file:
            options = file.read().split("\n")[1].split()[2:-1]
        target = self.path("elsewhere", "x.ppm")
        subprocess.run(["povray", *options, "+FP8", f"+L{os.path.dirname(scene)}", f"+I{scene}", f"+O{target}", "-D"], check=True, capture_output=True,
                       cwd=self.path("elsewhere"), timeout=60)
        self.assertTrue((read_pnm(target) == color).all())

    def test_interrupt_ends_povray_and_resume_completes(self):
        options = ("--renderer", "povray", "--layers", "color,objects,pov", "--cameras", "matrix", "--frames", "0:5", "--size", "160x100", "--quiet", "--threads", "3")
        self.dgtk("render", SCENE, "-o", self.path("whole"), *options)
        for number, how in enumerate((3 if WHOLE else 1) * (signal.SIGINT,) + (signal.SIGKILL,)):
            with self.subTest(how, number=number):
                folder = self.path(f"{how.name}{number}")
                # pictures are recorded in their order: the first one is whole
                status, errors = self.interrupted(["render", SCENE, "-o", folder, *options], folder, how, lambda: (
                    "matrix/color/000001.png" in recorded_files(folder) and povray_processes(folder)))
                if how == signal.SIGINT:
                    self.assertEqual(status, 75, errors)
                    self.assertIn("--resume", errors)
                    self.assertFalse(os.path.exists(os.path.join(folder, ".povray")))
                deadline = time.monotonic() + 5
                while povray_processes(folder) and time.monotonic() < deadline:
                    time.sleep(0.01)
                self.assertEqual(povray_processes(folder), [])
                self.assertFalse(os.path.exists(os.path.join(folder, "manifest.json")))
                first = os.stat(os.path.join(folder, "matrix", "color", "000000.png")).st_mtime_ns
                self.dgtk("render", SCENE, "-o", folder, *options, "--resume")
                self.assertEqual(os.stat(os.path.join(folder, "matrix", "color", "000000.png")).st_mtime_ns, first)
                self.assert_same_files(self.path("whole"), folder)

    def test_effects(self):
        """Each option changes the picture, and two runs of it are the same."""
        effects = {"plain": [], "shadows": ["--pov-shadows"], "area": ["--pov-area-lights", "3"], "radiosity": ["--pov-radiosity"],
                   "blur": ["--pov-focal-blur", "0.5,4"], "antialias": ["--pov-antialias", "3"]}
        scene = self.write("s.json", json.dumps({
            "objects": [{"name": name, "model": os.path.join(MODELS, name + ".ac"), "position": at}
                        for name, at in (("floor", [0, 0, 0]), ("crate", [0, 0, -0.5]), ("torus", [1.2, 0.6, 1.5]))],
            "lights": [{"name": "light", "kind": "point", "position": [-2, 2.5, -1.5]}],
            "cameras": [{"name": "c", "fovY": 25, "eye": [3, 3.5, 7], "lookAt": [0, 0.7, 0]}]}))

        def draw_twice(name):
            for run in ("1", "2") if name in ("radiosity", "blur") else ("1",):
                self.dgtk("render", scene, "-o", self.path(name + run), "--renderer", "povray", "--layers", "color", "--size", "60x45", "--quiet",
                          "--threads", run, *effects[name])

        with ThreadPoolExecutor(WORKERS) as pool:
            list(pool.map(draw_twice, effects))
        pictures = {name: read_png(self.path(name + "1", "c", "color", "000000.png")) for name in effects}
        for name in ("radiosity", "blur"):
            self.assert_same_files(self.path(name + "1"), self.path(name + "2"))
        for name, picture in pictures.items():
            if name != "plain":
                self.assertGreater((picture != pictures["plain"]).any(-1).mean(), 0.01, name)
        self.assertLess(pictures["shadows"].mean(), pictures["plain"].mean())


if __name__ == "__main__":
    main()
