# SPDX-License-Identifier: BSD-3-Clause
"""Debian's python3 imports dgtk and renders a scene into numpy arrays: the values of the command line's files, or a sentence."""
import json
import os
import re
import subprocess
import sys

import numpy
from harness import SCENES, SOURCE, Case, main
from pictures import read_png

PACKAGES = os.path.join(os.environ["DGTK_BUILD"], "lib", "python3", "dist-packages")
sys.path.insert(0, PACKAGES)
DEMO = os.path.join(SCENES, "demo.json")


class Interpreter(Case):
    """Programs in interpreters of their own, which a signal may end."""

    def python(self, program, *arguments, flags=(), status=0, limit=120):
        done = subprocess.run(["/usr/bin/python3", *flags, "-c", f"import sys; sys.path.insert(0, {PACKAGES!r})\n" + program,
                               *map(str, arguments)], capture_output=True, text=True, timeout=limit)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done


class Arrays(Interpreter):
    EVERY_LAYER = """
import json, sys, dgtk, numpy
scene, size, said = dgtk.load(sys.argv[1]), (64, 48), {}
for layer in sys.argv[3:]:
    print(layer, flush=True)
    try:
        numpy.save(f"{sys.argv[2]}/{layer}.npy", dgtk.render(scene, layer, size=size, frame=1, visibility="ray"))
    except (RuntimeError, ValueError) as error:
        said[layer] = str(error)
json.dump(said, open(sys.argv[2] + "/said.json", "w"))
"""

    def layers(self):
        return [line.split()[0] for line in self.dgtk("list", "layers").stdout.splitlines()]

    def test_every_layer_is_that_of_the_file_or_refused(self):
        self.python(self.EVERY_LAYER, DEMO, self.folder, *self.layers())
        with open(self.path("said.json"), encoding="utf-8") as file:
            said = json.load(file)
        given = [layer for layer in self.layers() if layer not in said]
        formats = [word for layer in given if layer != "color" for word in (f"--{layer}-format", "npy")]
        self.dgtk("render", DEMO, "-o", self.path("out"), "--quiet", "--layers", ",".join(given), "--size", "64x48", "--frames", "1",
                  "--visibility", "ray", *formats)
        for layer in given:
            with self.subTest(layer):
                array = numpy.load(self.path(f"{layer}.npy"))
                path = self.path("out", "left", layer, "000001")
                file = read_png(path + ".png").astype(numpy.uint8) if layer == "color" else numpy.load(path + ".npy")
                self.assertEqual(file.dtype, array.dtype)
                numpy.testing.assert_array_equal(file, array)
        for layer, line in said.items():
            self.assertRegex(line, rf"\Athe layer {layer} is not given as an array yet \(expected one of color, depth, .*\)\Z")
        self.assertLess({"color", "depth", "objects", "normal", "position", "uv", "triangles"}, set(given))
        self.assertLess({"boxes", "ldi", "flow_forward", "color_noisy", "points", "tiles"}, set(said))

    def test_colour_of_a_lens_a_shutter_and_samples(self):
        import dgtk

        path = os.path.join(SCENES, "lens_and_shutter.json")
        scene = dgtk.load(path)
        self.dgtk("render", path, "-o", self.path("out"), "--quiet", "--layers", "color", "--size", "64x48", "--samples", "2", "--frames", "2")
        for i in range(scene.GetNumberOfCameras()):
            name = scene.GetCameraName(i)
            file = read_png(self.path("out", name, "color", "000002.png"), (8, 3))
            array = dgtk.render(scene, "color", camera=name, frame=2, size=(64, 48), samples=2)
            numpy.testing.assert_array_equal(file, array)
            self.assertGreater(len(numpy.unique(array)), 20)

    def test_several_layers_outlive_scene_and_renderer(self):
        import dgtk

        renderer, scene = dgtk.dgtkRenderer(), dgtk.load(DEMO)
        images = dgtk.render(scene, ["color", "depth", "objects"], camera="right", frame=1, size=(64, 48), renderer=renderer)
        again = dgtk.render(scene, "depth", camera="right", frame=1, size=(64, 48), renderer=renderer)
        del renderer, scene
        self.assertEqual(list(images), ["color", "depth", "objects"])
        self.assertEqual((images["color"].shape, images["color"].dtype), ((48, 64, 3), numpy.uint8))
        self.assertEqual((images["depth"].shape, images["depth"].dtype), ((48, 64), numpy.float64))
        self.assertTrue((numpy.isfinite(again) == (images["objects"] > 0)).all())
        numpy.testing.assert_array_equal(images["depth"], again)

    def test_failures_raise_one_line(self):
        import dgtk

        with self.assertRaisesRegex(ValueError, r"\A/nothing.json: .*\Z"):
            dgtk.load("/nothing.json")
        scene = dgtk.load(DEMO)
        for wrong, says in (
                ({"layers": "depht"}, r"unknown layer 'depht' \(expected one of color, depth, "),
                ({"layers": "all"}, "unknown layer 'all'"),
                ({"layers": ["depth", "boxes"]}, "boxes is not given as an array"),
                ({"visibility": "foo"}, r"unknown visibility engine 'foo' \(expected auto, raster or ray\)"),
                ({"gl": "foo"}, "unknown OpenGL backend 'foo'"),
                ({"samples": 99}, r"samples must be between 1 and 16 \(found 99\)"),
                ({"samples": 0}, "between 1 and 16"),
                ({"frame": 77}, "the scene has frames 0 to 2, found 77"),
                ({"frame": -1}, "found -1"),
                ({"size": (-1, 5)}, "image size out of range"),
                ({"camera": "nobody"}, "no camera 'nobody'")):
            with self.subTest(wrong):
                with self.assertRaisesRegex(RuntimeError, says) as caught:
                    dgtk.render(scene, **{"layers": "depth", "size": (8, 6), **wrong})
                self.assertNotIn("--", str(caught.exception))
                self.assertNotIn("\n", str(caught.exception))


class Guide(Interpreter):
    def test_the_page_runs_as_it_stands(self):
        with open(os.path.join(SOURCE, "Documentation", "UserGuide", "python.md"), encoding="utf-8") as file:
            blocks = re.findall(r"^```python\n(.*?)^```$", file.read(), re.MULTILINE | re.DOTALL)
        self.assertGreater(len(blocks), 3)
        said = self.python(f"import os; os.chdir({SOURCE!r})\n" + "\n".join(blocks)).stdout
        self.assertIn("(240, 320) float64 (240, 320, 3) uint8", said)
        self.assertIn("the layer boxes is not given as an array", said)


class Import(Interpreter):
    def test_version_is_that_of_the_program(self):
        self.assertEqual("dgtk " + self.python("import dgtk; print(dgtk.__version__)").stdout, self.dgtk("--version").stdout)

    def test_another_python_is_told_which_one_is_needed(self):
        self.assertIn("/usr/bin/python3", self.said("import dgtk", "-S"))  # -S: without Debian's packages
        line = self.said("sys.version_info = (3, 99, 0); sys.executable = '/opt/python'; import dgtk")
        self.assertIn("/usr/bin/python3", line)
        self.assertIn("this is 3.99 (/opt/python)", line)

    def said(self, program, *flags):
        lines = self.python(program, flags=flags, status=1).stderr.splitlines()
        self.assertTrue(lines[-1].startswith("ImportError: dgtk "), lines)
        self.assertEqual([line for line in lines[1:-1] if not line.startswith("  ")], [], "nothing but one traceback")
        return lines[-1]


class ThreadsAndProcesses(Interpreter):
    START = """
import os, signal, sys, threading, dgtk, numpy
scene, size = dgtk.load(sys.argv[1]), (64, 48)
def render(layer="color", renderer=None):
    return dgtk.render(scene, layer, size=size, renderer=renderer)
def forked(job):
    '''What job() returns or raises in a forked process, as text.'''
    ours, theirs = os.pipe()
    child = os.fork()
    if child == 0:
        signal.alarm(60)
        try:
            said = str(job())
        except Exception as error:
            said = f"{type(error).__name__}: {error}"
        os.write(theirs, said.encode())
        os._exit(0)
    os.close(theirs)
    said = b"".join(iter(lambda: os.read(ours, 4096), b"")).decode()
    assert os.waitpid(child, 0)[1] == 0, "ended by a signal"
    return said
"""

    def test_threads_draw_in_turns(self):
        self.python(self.START + """
first, kept, found = render(), dgtk.dgtkRenderer(), []
def draw(renderer=None):
    found.append(render(renderer=renderer))
threads = [threading.Thread(target=draw) for _ in range(3)] + [threading.Thread(target=draw, args=[kept])]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
draw(kept)      # used by a thread that is no more
def drop():
    global kept
    kept = None
thread = threading.Thread(target=drop)
thread.start()
thread.join()
draw()          # after another thread has cleared away
assert len(found) == 6, len(found)
for array in found:
    numpy.testing.assert_array_equal(array, first)
""", DEMO)

    def test_a_forked_process_draws_after_the_first_colour(self):
        self.python(self.START + """
kept = dgtk.dgtkRenderer()
first, depth = render(renderer=kept), render("depth")
def child():
    numpy.testing.assert_array_equal(render("depth"), depth)
    numpy.testing.assert_array_equal(render(renderer=kept), first)
    numpy.testing.assert_array_equal(render(), first)
    numpy.testing.assert_array_equal(render("depth", kept), depth)
    return "drawn"
for _ in range(2):
    said = forked(child)
    assert said == "drawn", said
numpy.testing.assert_array_equal(render(renderer=kept), first)      # the parent goes on
""", DEMO)

    def test_a_pool_of_forked_processes(self):
        self.python(self.START + """
import multiprocessing
def total(frame):
    return int(dgtk.render(scene, "color", frame=frame, size=size).sum())
expected = [total(frame) for frame in (0, 1, 2)]
with multiprocessing.get_context("fork").Pool(2) as pool:
    assert pool.map_async(total, (0, 1, 2)).get(60) == expected
""", DEMO)

    def test_what_a_fork_cannot_have_is_refused_in_words(self):
        """A fork of a fork: both displays that Mesa's software renderer has are in use."""
        words = "RuntimeError: OpenGL was used before this process was forked and cannot be used in the copy"
        done = self.python(self.START + """
render()
print(forked(lambda: [render() is None, forked(render), forked(lambda: render("depth").shape)]))
""", DEMO)
        self.assertIn(f"[False, '{words}", done.stdout)
        self.assertIn("'(48, 64)']", done.stdout)

    def test_no_other_way_to_opengl_after_a_fork(self):
        done = subprocess.run(["xvfb-run", "-a", "/usr/bin/python3", "-c", f"import sys; sys.path.insert(0, {PACKAGES!r})" + self.START + """
dgtk.render(scene, "color", size=size, gl="glx")
print(forked(render))
print(forked(lambda: dgtk.render(scene, "color", size=size, gl="egl")))
""", DEMO], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        first, second = done.stdout.splitlines()
        self.assertIn("cannot be used in the copy", first)
        self.assertIn("in use through GLX and cannot change to EGL", second)


if __name__ == "__main__":
    main()
