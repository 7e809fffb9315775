# SPDX-License-Identifier: BSD-3-Clause
"""Debian's python3 imports dgtk and renders a scene into numpy arrays: the values of the command line's files, or a sentence."""
import functools
import json
import os
import pickle
import re
import subprocess
import sys

import numpy
from harness import SCENES, SOURCE, main
from many_runs import ManyCase
from pictures import read_exr, read_png

PATIENCE = int(os.environ.get("DGTK_TEST_PATIENCE", 1))  # how much longer everything takes, as with sanitizers
PACKAGES = os.path.join(os.environ["DGTK_BUILD"], "lib", "python3", "dist-packages")
sys.path.insert(0, PACKAGES)
DEMO = os.path.join(SCENES, "demo.json")


class Interpreter(ManyCase):
    """Programs in interpreters of their own, which a signal may end."""

    def python(self, program, *arguments, flags=(), status=0, limit=120):
        done = subprocess.run(["/usr/bin/python3", *flags, "-c", f"import sys; sys.path.insert(0, {PACKAGES!r})\n" + program,
                               *map(str, arguments)], capture_output=True, text=True, timeout=limit * PATIENCE)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done


class Arrays(Interpreter):
    EVERY_LAYER = """
import pickle, sys, dgtk
scene, given = dgtk.load(sys.argv[1]), {}
for layer in sys.argv[3:]:
    print(layer, flush=True)
    try:
        given[layer] = dgtk.render(scene, [layer], size=(64, 48), frame=1, samples=2)
    except (RuntimeError, ValueError) as error:
        given[layer] = str(error)
pickle.dump(given, open(sys.argv[2] + "/given.pickle", "wb"))
"""
    # Of other scenes than the demo, or with words of their own.
    SPECIAL = {"color_sharp": ("lens_and_shutter.json", {}, ()), "matting": ("demo.json", {"matte": ["house"]}, ("--matte", "house"))}

    @functools.cached_property
    def formats(self):
        return {row[0]: row[1].split(",") for row in map(str.split, self.dgtk("list", "layers").stdout.splitlines())}

    def test_every_layer_is_that_of_the_file_or_refused(self):
        import dgtk

        usual = [layer for layer in self.formats if layer not in self.SPECIAL]
        self.python(self.EVERY_LAYER, DEMO, self.folder, *usual, limit=300)
        with open(self.path("given.pickle"), "rb") as file:
            given = pickle.load(file)
        self.dgtk("render", DEMO, "-o", self.path("demo"), "--quiet", "--size", "64x48", "--frames", "1", "--samples", "2", "--layers",
                  ",".join(usual), *(word for layer in usual for word in self.format_of(layer)))
        self.assertEqual(given.pop("tiles"), "the layer tiles is not given as an array: it is color cut into files")
        self.assertEqual(given.pop("tracks"), "the layer tracks is not given as an array: its points are those of a run of views")
        for layer, outputs in given.items():
            self.compare(layer, outputs, self.path("demo"))
        for layer, (scene, options, words) in self.SPECIAL.items():
            folder = self.path(layer)
            self.dgtk("render", os.path.join(SCENES, scene), "-o", folder, "--quiet", "--size", "64x48", "--frames", "1", "--samples", "2",
                      "--layers", layer, *words)
            one = dgtk.load(os.path.join(SCENES, scene))
            self.compare(layer, dgtk.render(one, [layer], size=(64, 48), frame=1, samples=2, **options), folder)

    def format_of(self, layer):
        return (f"--{layer}-format", "npy") if "npy" in self.formats[layer] and len(self.formats[layer]) > 1 else ()

    def compare(self, layer, outputs, dataset):
        """Every file of the picture is an output, and every output has its values."""
        self.assertIsInstance(outputs, dict, outputs)
        with open(os.path.join(dataset, "cameras.json"), encoding="utf-8") as file:
            camera = json.load(file)["cameras"][0]
        with open(os.path.join(dataset, "manifest.json"), encoding="utf-8") as file:
            files = [entry["path"] for entry in json.load(file)["files"] if entry.get("camera") == camera["name"]]
        own = [path for path in files if path.split("/")[-2] == layer or path.split("/")[-2].startswith((layer + "_class", layer + "_right", "matting"))
               and layer in ("correspondence", "matting")]
        self.assertGreater(len(own), 0, layer)
        for path in own:
            folder, name = path.split("/")[-2:]
            stem, extension = os.path.splitext(name)
            output = folder + stem[6:]
            whole = os.path.join(dataset, path)
            with self.subTest(path):
                if layer == "points":  # two files are one output; see below
                    self.assertGreater(len(outputs[layer]["x"]), 0)
                    continue
                if extension == ".png" and len([other for other in own if os.path.splitext(other)[0] == os.path.splitext(path)[0]]) > 1:
                    output += "_class"
                if extension == ".json":
                    self.compare_json(layer, outputs, whole)
                    continue
                self.assertIn(output, outputs)
                getattr(self, "compare_" + extension[1:])(outputs[output], whole, camera)

    def compare_png(self, array, path, camera):
        pixels = read_png(path)
        numpy.testing.assert_array_equal(pixels.reshape(array.shape), array)
        self.assertIn(array.dtype, (numpy.uint8, numpy.uint16))

    def compare_npy(self, array, path, camera):
        file = numpy.load(path)
        self.assertEqual(file.dtype, array.dtype)
        numpy.testing.assert_array_equal(file, array)

    def compare_exr(self, array, path, camera):
        channels = read_exr(path)[1]
        names = [f"CryptoObject{level:02}.{channel}" for level in range(array.shape[2] // 4) for channel in "rgba"]
        self.assertEqual(sorted(names), sorted(channels))
        numpy.testing.assert_array_equal(numpy.stack([channels[name] for name in names], axis=-1), array)

    def compare_txt(self, calibration, path, camera):
        with open(path, encoding="utf-8") as file:
            text = file.read().split()
        self.assertEqual([float(word) for word in text[1:10]], calibration["thesis_K"].ravel().tolist())
        self.assertEqual([float(word) for word in text[11:23]], calibration["thesis_Rt"].ravel().tolist())
        self.assertEqual([int(word) for word in text[24:]], list(calibration["viewport"]))
        for name in ("K", "R", "t"):
            numpy.testing.assert_allclose(calibration[name], camera[name], rtol=1e-12, atol=1e-12)

    def compare_pov(self, text, path, camera):
        with open(path, encoding="utf-8") as file:
            self.assertEqual(text, file.read())

    def compare_ldi(self, ldi, path, camera):
        with open(path, "rb") as file:
            data = file.read()
        self.assertEqual(ldi["count"].shape, (48, 64))
        at, rows = 8, iter(zip(ldi["rgba"], ldi["depth"], ldi["splat"]))
        for count in ldi["count"].ravel():
            self.assertEqual(int.from_bytes(data[at:at + 4], "little"), count)
            at += 4
            for _ in range(count):
                color, depth, splat = next(rows)
                self.assertEqual(data[at:at + 16], color.tobytes() + depth.tobytes() + splat.tobytes())
                at += 16
        self.assertEqual((at, list(rows)), (len(data), []))

    def compare_json(self, layer, outputs, path):
        with open(path, encoding="utf-8") as file:
            self.assertEqual(json.load(file), outputs[layer])

    def test_points_are_those_of_the_files(self):
        import dgtk

        cloud = dgtk.render(dgtk.load(DEMO), ["points"], size=(64, 48), frame=1, samples=2, points_step=7)["points"]
        self.dgtk("render", DEMO, "-o", self.path("out"), "--quiet", "--layers", "points", "--size", "64x48", "--frames", "1", "--points-step", "7")
        with open(self.path("out", "points", "000001.json"), encoding="utf-8") as file:
            document = json.load(file)
        self.assertGreater(len(document["points"]), 50)
        self.assertEqual(cloud["cameras"], document["cameras"])
        self.assertEqual(cloud["x"].tolist(), [point["x"] for point in document["points"]])
        self.assertEqual(cloud["triangle"].tolist(), [point["triangle"] for point in document["points"]])
        self.assertEqual([track.tolist() for track in cloud["track"]], [point["track"] for point in document["points"]])
        numpy.testing.assert_allclose(numpy.linalg.norm(cloud["normal"], axis=1), 1, atol=1e-6)
        self.assertEqual(list(cloud), ["x", "normal", "color", "object", "triangle", "frame", "cameras", "track"])

    def test_pairs_lead_where_they_are_asked_to(self):
        import dgtk

        scene = dgtk.load(DEMO)
        outputs = dgtk.render(scene, "correspondence", camera="right", size=(32, 24), pairs=["right:left+1", "left:right"])
        self.assertEqual(list(outputs), ["correspondence_left+1", "correspondence_left+1_class"])
        self.dgtk("render", DEMO, "-o", self.path("out"), "--quiet", "--layers", "correspondence", "--size", "32x24", "--frames", "0",
                  "--pairs", "right:left+1")
        numpy.testing.assert_array_equal(
            numpy.load(self.path("out", "right", "correspondence_left+1", "000000.npy")), outputs["correspondence_left+1"])

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

    def test_names_of_what_is_not_there(self):
        import dgtk

        scene = dgtk.load(DEMO)
        for count, name in ((scene.GetNumberOfCameras(), scene.GetCameraName), (scene.GetNumberOfObjects(), scene.GetObjectName)):
            self.assertTrue(name(count - 1))
            self.assertEqual((name(-1), name(count)), ("", ""))

    def test_another_camera_that_cannot_be_drawn(self):
        """Only the picture that is asked for is drawn, or has a matrix."""
        import dgtk

        plain = dgtk.load(DEMO)
        description = plain.description()
        description["cameras"].append({"name": "wide", "model": "fisheye", "eye": [0, 2, 9], "lookAt": [0, 1, 0], "fovY": 120})
        scene = dgtk.scene(description, like=plain)
        for layer, options in (("depth", {"visibility": "raster"}), ("color", {"renderer": "vtk"}), ("calibration", {})):
            alone, beside = (dgtk.render(one, layer, camera="right", size=(64, 48), **options) for one in (plain, scene))
            self.assertEqual(pickle.dumps(alone), pickle.dumps(beside), layer)
            with self.assertRaisesRegex(ValueError, "camera 'wide' .fisheye. has no linear projection"):
                dgtk.render(scene, layer, camera="wide", size=(64, 48), **options)

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
                ({"layers": ["depth", "tiles"]}, "tiles is not given as an array: it is color cut into files"),
                ({"layers": "matting"}, "matting would have no file in this run|needs the names of the objects"),
                ({"layers": "flow_backward"}, "needs a frame of the scene before the picture's own"),
                ({"layers": "matting", "matte": ["nobody"]}, "the scene has no object 'nobody'"),
                ({"layers": "points", "points_step": 0}, "points_step: expected an integer from 1 to 1048576, found '0'"),
                ({"layers": "correspondence", "pairs": ["left:nobody"]}, "pairs: expected FROM:TO"),
                ({"visibility": "foo"}, "visibility: expected one of auto, raster, ray, found 'foo'"),
                ({"gl": "foo"}, "gl: expected one of auto, egl, osmesa, glx, found 'foo'"),
                ({"samples": 99}, "samples: expected an integer from 1 to 16, found '99'"),
                ({"samples": 0}, "from 1 to 16, found '0'"),
                ({"sample": 4}, "there is no option 'sample' .expected one of samples, filter, "),
                ({"matte": ["tree", ""], "layers": "matting"}, "matte: an empty name in 'tree,'"),
                ({"layers": "color", "color_format": ["png", "exr"]}, "color_format: an array has one format, found 'png,exr'"),
                ({"renderer": "povray"}, "renderer: arrays are not drawn by POV-Ray"),
                ({"frame": 77}, "the scene has frames 0 to 2, found 77"),
                ({"frame": -1}, "found -1"),
                ({"size": (-1, 5)}, "image size out of range"),
                ({"camera": "nobody"}, "no camera 'nobody'")):
            with self.subTest(wrong):
                with self.assertRaisesRegex(ValueError, says) as caught:
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
        self.assertIn("the layer tiles is not given as an array", said)
        self.assertIn("scene: objects[0].position[1] has the wrong type (expected a number", said)
        self.assertIn("\n4 of 4\n12 files, request ", said)


class Import(Interpreter):
    def test_version_is_that_of_the_program(self):
        import dgtk

        self.assertEqual(f"dgtk {dgtk.__version__}\n", self.dgtk("--version").stdout)

    def test_help_lists_every_option_and_is_not_needed(self):
        import dgtk

        said = dgtk.render.__doc__
        for row in json.loads(self.dgtk("list", "options", "--json").stdout)["options"]:
            self.assertEqual(f"\n    {row['name']}: " in said, row["name"] not in ("threads", "pack", "models", "contact_sheet"), row["name"])
        self.python("import dgtk", flags=("-OO",))

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
def render(layer="color", renderer=None, by="ray"):
    return dgtk.render(scene, layer, size=size, renderer=by, keep=renderer)
def forked(job):
    '''What job() returns or raises in a forked process, as text.'''
    ours, theirs = os.pipe()
    child = os.fork()
    if child == 0:
        signal.alarm(60 * int(os.environ.get("DGTK_TEST_PATIENCE", 1)))
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
    assert pool.map_async(total, (0, 1, 2)).get(60 * int(os.environ.get("DGTK_TEST_PATIENCE", 1))) == expected
""", DEMO)


class ThreadsAndOpenGL(ThreadsAndProcesses):
    START = ThreadsAndProcesses.START.replace('"ray"', '"vtk"')

    def test_what_a_fork_cannot_have_is_refused_in_words(self):
        """A fork of a fork: both displays that Mesa's software renderer has are in use."""
        words = "RuntimeError: OpenGL was used before this process was forked and cannot be used in the copy"
        done = self.python(self.START + """
render()
print(forked(lambda: [render() is None, forked(render), forked(lambda: render("depth").shape), forked(lambda: render(by="ray").shape)]))
""", DEMO)
        self.assertIn(f"[False, '{words}", done.stdout)
        self.assertIn("'(48, 64)', '(48, 64, 3)']", done.stdout)  # rays need none

    def test_no_other_way_to_opengl_after_a_fork(self):
        done = subprocess.run(["xvfb-run", "-a", "-n", "460", "/usr/bin/python3", "-c", f"import sys; sys.path.insert(0, {PACKAGES!r})" + self.START + """
draw = lambda gl: dgtk.render(scene, "color", size=size, renderer="vtk", gl=gl)
draw("glx")
print(forked(lambda: draw("auto")))
print(forked(lambda: draw("egl")))
""", DEMO], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        first, second = done.stdout.splitlines()
        self.assertIn("cannot be used in the copy", first)
        self.assertIn("in use through GLX and cannot change to EGL", second)


if __name__ == "__main__":
    main()
