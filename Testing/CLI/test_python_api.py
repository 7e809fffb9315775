# SPDX-License-Identifier: BSD-3-Clause
"""The Python package beyond single pictures: scenes of dicts, datasets, threads, misuse, memory, stubs and reference."""
import ast
import copy
import inspect
import json
import math
import os
import pickle
import random
import shutil
import subprocess
import sys
import threading
import time

import numpy
from harness import SCENES, SOURCE, Case, digests, main

PACKAGES = os.path.join(os.environ["DGTK_BUILD"], "lib", "python3", "dist-packages")
sys.path.insert(0, PACKAGES)
DEMO = os.path.join(SCENES, "demo.json")
SIZE = (64, 48)

import dgtk  # noqa: E402


def square():
    """A small scene: one square in front of one camera."""
    return {"objects": [{"name": "floor", "model": os.path.join(SOURCE, "Data", "Models", "floor.ac")}],
            "cameras": [{"name": "above", "eye": [0, 3, 4], "lookAt": [0, 0, 0]}]}


class Scenes(Case):
    def test_a_description_is_the_scene_again(self):
        loaded = dgtk.load(DEMO)
        description = loaded.description()
        again = dgtk.scene(description, folder=loaded.folder)
        self.assertEqual(again.description(), description)
        self.assertEqual((again.cameras, again.objects, again.frames), (["left", "right"], loaded.objects, range(0, 3)))
        self.assertEqual(loaded.folder, os.path.realpath(SCENES))
        numpy.testing.assert_array_equal(dgtk.render(again, "color", frame=1, size=SIZE), dgtk.render(loaded, "color", frame=1, size=SIZE))
        description["objects"].clear()
        self.assertEqual(len(loaded.objects), len(loaded.description()["objects"]), "the caller's own")

    def test_relative_paths_start_in_the_folder(self):
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        description = dgtk.load(DEMO).description()
        os.chdir(SCENES)
        here, elsewhere = dgtk.scene(description), dgtk.scene(description, folder="../Scenes")
        os.chdir(self.folder)
        for made in (here, elsewhere):
            self.assertEqual(made.folder, os.path.realpath(SCENES))
            self.assertEqual(dgtk.generate(made, "out", "depth", 0, "left", SIZE, replace=True)["request"]["size"], "64x48")
        with self.assertRaisesRegex(ValueError, r"\Ascene: .* model files are missing: "):
            dgtk.scene(description)

    def test_without_a_current_folder(self):
        self.addCleanup(os.chdir, os.getcwd())
        os.mkdir(self.path("gone"))
        os.chdir(self.path("gone"))
        os.rmdir(self.path("gone"))
        with self.assertRaisesRegex(RuntimeError, "folder: the current folder: "):
            dgtk.scene(square())
        self.assertEqual(dgtk.scene(square(), folder="/").folder, "/")
        self.assertEqual(len(dgtk.load(DEMO).cameras), 2)

    def test_numbers_of_numpy(self):
        plain, numbers = square(), square()
        plain["objects"][0].update(position=[0, 0.5, 0], scale=[2, 2, 2], visible=True)
        numbers["objects"][0].update(position=numpy.array([0, 0.5, 0], numpy.float32), scale=numpy.full(3, 2), visible=numpy.bool_(True))
        numbers["cameras"][0].update(eye=(0, numpy.int64(3), numpy.float64(4)))
        self.assertEqual(dgtk.scene(plain).description(), dgtk.scene(numbers).description())

    def test_refusals_name_the_value(self):
        def changed(change):
            description = square()
            change(description)
            return description
        for change, says in (
                (lambda d: d["objects"][0].update(position=[0, "far", 0]), r"scene: objects\[0\].position\[1\] has the wrong type .expected a number.*found 'far'"),
                (lambda d: d["objects"][0].update(position=[0, math.nan, 0]), r"scene: objects\[0\].position\[1\] is out of range .expected a finite number, found nan"),
                (lambda d: d["cameras"][0].update(eye=numpy.array([0, numpy.inf, 0])), r"scene: cameras\[0\].eye\[1\] is out of range .expected a finite number, found inf"),
                (lambda d: d.update(fps=10**400), r"scene: fps is out of range .expected a finite number, found 1000"),
                (lambda d: d["objects"][0].update(position=1 + 2j), r"scene: objects\[0\].position has the wrong type .expected a number, .*found an object of complex"),
                (lambda d: d["objects"][0].update(position={1, 2}), r"scene: objects\[0\].position has the wrong type .expected a number, .*found {1, 2}"),
                (lambda d: d["objects"][0].update(position=None), r"scene: objects\[0\].position"),
                (lambda d: d["objects"][0].update({3: 4}), r"scene: objects\[0\] has a key that is none .expected text, found 3"),
                (lambda d: d["objects"][0].update(name="\ud800"), r"scene: objects\[0\].name has no meaning .expected text"),
                (lambda d: d["objects"][0].update(poistion=[0, 0, 0]), r"scene: objects\[0\].poistion is an unknown key .expected perhaps 'position'"),
                (lambda d: d["objects"].append(d), "scene: is nested too deeply .expected at most 32 lists and dicts in one another"),
                (lambda d: d["cameras"][0].update(near=2, far=1), r"scene: cameras\[0\].far"),
                (lambda d: d["objects"][0].update(model="/no/such.ac"), r"scene: object 'floor': model: /no/such.ac"),
                (lambda d: d["objects"][0].update(parent="nobody"), r"scene: objects\[0\].parent")):
            with self.assertRaisesRegex(ValueError, r"\A" + says) as caught:
                dgtk.scene(changed(change))
            self.assertNotIn("\n", str(caught.exception))

    def copied(self):
        """The demo with its models in a folder of the test's own."""
        shutil.copytree(os.path.join(SOURCE, "Data", "Models"), self.path("Models"))
        os.mkdir(self.path("Scenes"))
        return shutil.copy(DEMO, self.path("Scenes"))

    def test_a_scene_like_another_reads_no_model(self):
        first = dgtk.load(self.copied())
        before = dgtk.render(first, "objects", size=SIZE)
        description = first.description()
        description["objects"][1]["position"] = [-1, 0, -6.6]
        second = dgtk.scene(description, folder=first.folder)
        shutil.rmtree(self.path("Models"))
        kept = dgtk.dgtkRenderer()
        third = dgtk.scene(description, like=first)
        fourth = dgtk.scene(description, like=third)
        self.assertEqual(third.folder, first.folder)
        expected = dgtk.render(second, ["objects", "color"], size=SIZE)
        self.assertTrue((expected["objects"] != before).any())
        for scene in (third, fourth):
            found = dgtk.render(scene, ["objects", "color"], size=SIZE, keep=kept)
            numpy.testing.assert_array_equal(found["objects"], expected["objects"])
            numpy.testing.assert_array_equal(found["color"], expected["color"])
        numpy.testing.assert_array_equal(dgtk.render(first, "objects", size=SIZE), before, "it stays as it is")
        description["objects"][0]["model"] = "../Models/other.ac"
        with self.assertRaisesRegex(ValueError, "scene: object 'terrain': model: .*other.ac: cannot be read"):
            dgtk.scene(description, like=first)
        with self.assertRaisesRegex(ValueError, "model files are missing"):
            dgtk.scene(first.description(), folder=first.folder)

    def test_an_empty_scene_and_an_empty_dict(self):
        self.assertEqual(dgtk.Scene().description(), {})
        with self.assertRaisesRegex(ValueError, "no scene is set"):
            dgtk.render(dgtk.Scene(), "depth")
        with self.assertRaisesRegex(ValueError, "no scene is set"):
            dgtk.generate(dgtk.Scene(), self.path("out"))
        with self.assertRaisesRegex(ValueError, "camera"):
            dgtk.render(dgtk.scene({}), "depth")


class Datasets(Case):
    LAYERS = ["color", "depth", "objects", "flow_forward"]

    def by_command(self, *more):
        self.dgtk("render", DEMO, "-o", self.path("command"), "--quiet", "--size", "64x48", "--layers", ",".join(self.LAYERS), *more)
        return self.path("command")

    def by_python(self, name, scene=DEMO, **more):
        return dgtk.generate(scene, self.path(name), **{"layers": self.LAYERS, "size": SIZE, **more})

    def test_the_bytes_are_those_of_the_command(self):
        self.by_command("--samples", "2", "--frames", "0:2:2", "--cameras", "left,right", "--contact-sheet")
        options = {"samples": 2, "frames": (0, 2, 2), "cameras": ["left", "right"], "contact_sheet": True}
        reports = []
        manifest = self.by_python("path", progress=lambda done, total: reports.append((done, total)), **options)
        self.assertEqual((reports[0], reports[-1], reports), ((0, 4), (4, 4), sorted(reports)))
        self.by_python("scene", dgtk.load(DEMO), **options)
        for name in ("path", "scene"):
            self.assert_same_files(self.path("command"), self.path(name))
        with open(self.path("path", "manifest.json"), encoding="utf-8") as file:
            self.assertEqual(json.load(file), manifest)

    def test_the_usual_layers_and_all_frames(self):
        self.dgtk("render", DEMO, "-o", self.path("command"), "--quiet", "--size", "32x24")
        dgtk.generate(os.path.join(SCENES, "demo.json"), self.path("python"), size=(32, 24))
        self.assert_same_files(self.path("command"), self.path("python"))

    def test_a_scene_of_a_dict(self):
        loaded = dgtk.load(DEMO)
        description = loaded.description()
        description["background"] = [1, 0, 0]
        made = dgtk.scene(description, like=loaded)
        manifest = self.by_python("out", made, frames=(0, 1))
        self.assertEqual([one["path"] for one in manifest["inputs"] if one["path"].endswith(".json")], [])
        again = dgtk.load(self.path("out", "scene.json"))
        self.assertEqual(again.description()["background"], [1, 0, 0])
        self.dgtk("verify", self.path("out"))
        array = dgtk.render(made, "depth", camera="right", frame=1, size=SIZE)
        numpy.testing.assert_array_equal(numpy.load(self.path("out", "right", "depth", "000001.npy")), array)
        first = digests(self.path("out"))
        self.by_python("out", made, frames=(0, 1), resume=True)
        self.assertEqual(digests(self.path("out")), first)
        description["background"] = [0, 1, 0]
        with self.assertRaisesRegex(ValueError, "replace removes it"):
            self.by_python("out", dgtk.scene(description, like=loaded), frames=(0, 1), resume=True)
        self.assertEqual(digests(self.path("out")), first)
        self.by_python("packed", made, frames=0, pack=True)
        shutil.move(self.path("packed"), self.path("moved"))
        self.dgtk("verify", self.path("moved"))

    def test_a_file_that_has_changed_since(self):
        path = shutil.copy(os.path.join(SCENES, "demo.json"), self.path("demo.json"))
        with open(path, encoding="utf-8") as file:
            text = file.read().replace("../Models", os.path.join(SOURCE, "Data", "Models"))
        self.write("demo.json", text)
        loaded = dgtk.load(path)
        self.write("demo.json", text.replace("0.62", "0.5"))
        with self.assertRaisesRegex(ValueError, "demo.json: has changed since the scene was loaded"):
            self.by_python("out", loaded)
        self.assertFalse(os.path.exists(self.path("out")))

    def test_what_progress_raises_ends_the_run_and_resume_completes_it(self):
        self.by_command()
        for problem in (KeyError("mine"), KeyboardInterrupt(), SystemExit(3)):
            calls = []

            def stop(*report):
                calls.append(report)
                if len(calls) == 3:
                    raise problem
            shutil.rmtree(self.path("python"), ignore_errors=True)
            with self.assertRaises(type(problem)) as caught:
                self.by_python("python", progress=stop)
            self.assertIs(caught.exception, problem)
            self.assertFalse(os.path.exists(self.path("python", "manifest.json")))
            with self.assertRaisesRegex(ValueError, "resume completes it, replace starts over"):
                self.by_python("python")
            self.by_python("python", resume=True)
            self.assert_same_files(self.path("command"), self.path("python"))

    INTERRUPTED = """
import os, signal, sys, threading, time, dgtk
threading.Timer(1.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
began = time.monotonic()
try:
    dgtk.generate(sys.argv[1], sys.argv[2], layers=["depth", "normal", "ldi"], size=(2000, 1500), samples=4)
except KeyboardInterrupt:
    print("interrupted", time.monotonic() - began < 30, os.path.exists(sys.argv[2] + "/manifest.json"))
"""

    def test_an_interrupt_without_progress(self):
        done = subprocess.run(["/usr/bin/python3", "-c", f"import sys; sys.path.insert(0, {PACKAGES!r})" + self.INTERRUPTED, DEMO, self.path("out")],
                              capture_output=True, text=True, timeout=120)
        self.assertEqual((done.returncode, done.stdout), (0, "interrupted True False\n"), done.stderr)

    def test_refusals(self):
        self.write("file", "text")
        for wrong, kind, says in (
                ({"layers": "depht"}, ValueError, "'depht'"),
                ({"layers": []}, ValueError, "layers: expected a name or a list of names"),
                ({"cameras": "nobody"}, ValueError, "no camera 'nobody'"),
                ({"frames": (2, 1)}, ValueError, "frames: expected an integer, .first, last. or"),
                ({"frames": 77}, ValueError, "the scene has frames 0 to 2, found 77"),
                ({"frames": "all"}, ValueError, "frames: expected"),
                ({"size": (0, 5)}, ValueError, "size: expected"),
                ({"progress": 3}, ValueError, "progress: expected something to call, found 3"),
                ({"resume": 1}, ValueError, "resume: expected True or False"),
                ({"resume": True, "replace": True}, ValueError, "either resumed or replaced"),
                ({"samples": 99}, ValueError, "samples: expected an integer from 1 to 16, found '99'"),
                ({"sample": 4}, ValueError, "there is no option 'sample'"),
                ({"scene": "/nothing.json"}, ValueError, "/nothing.json: "),
                ({"scene": 3}, ValueError, "scene: expected"),
                ({"folder": SCENES}, ValueError, "holds"),
                ({"folder": self.path("file")}, (ValueError, RuntimeError), "file"),
                ({"folder": "/proc/none/out"}, RuntimeError, "/proc/none")):
            with self.subTest(wrong):
                with self.assertRaisesRegex(kind, says) as caught:
                    dgtk.generate(**{"scene": DEMO, "folder": self.path("out"), "size": SIZE, **wrong})
                self.assertNotIn("--", str(caught.exception))
                self.assertNotIn("\n", str(caught.exception))
        self.assertEqual(os.listdir(self.folder), ["file"])


class Threads(Case):
    def test_other_threads_run_while_one_renders(self):
        scene, size, ticks = dgtk.load(DEMO), (1200, 900), 0
        for work in (lambda: dgtk.render(scene, "color", size=size, samples=4), lambda: dgtk.load(DEMO) and dgtk.render(scene, "ldi", size=size)):
            thread = threading.Thread(target=work)
            thread.start()
            ticks = 0
            while thread.is_alive():
                time.sleep(0.005)
                ticks += 1
            self.assertGreater(ticks, 10)

    def test_two_scenes_at_once(self):
        scenes = [dgtk.load(DEMO), dgtk.scene(square())]
        layers = ["color", "depth", "objects", "normal"]
        expected = [dgtk.render(scene, layers, size=(160, 120)) for scene in scenes]
        problems = []

        def draw(i):
            for _ in range(5):
                for name, array in dgtk.render(scenes[i], layers, size=(160, 120)).items():
                    if not numpy.array_equal(array, expected[i][name], equal_nan=array.dtype.kind == "f"):
                        problems.append((i, name))
        threads = [threading.Thread(target=draw, args=[i % 2]) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(problems, [])

    def test_threads_that_share_a_renderer_wait_for_one_another(self):
        scene, kept, found = dgtk.load(DEMO), dgtk.dgtkRenderer(), []
        expected = {frame: dgtk.render(scene, "objects", frame=frame, size=SIZE) for frame in (0, 2)}
        self.assertTrue((expected[0] != expected[2]).any())

        def draw(frame):
            for _ in range(10):
                found.append(numpy.array_equal(dgtk.render(scene, "objects", frame=frame, size=SIZE, keep=kept), expected[frame]))
        threads = [threading.Thread(target=draw, args=[frame]) for frame in (0, 2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [True] * 20)

    def test_pictures_while_a_dataset_is_made(self):
        scene = dgtk.load(DEMO)
        expected = dgtk.render(scene, "depth", size=SIZE)
        seen = []
        dgtk.generate(scene, self.path("out"), "depth", size=SIZE, progress=lambda *_: seen.append(dgtk.render(scene, "depth", size=SIZE)))
        self.assertGreater(len(seen), 3)
        for array in seen:
            numpy.testing.assert_array_equal(array, expected)
        numpy.testing.assert_array_equal(numpy.load(self.path("out", "left", "depth", "000000.npy")), expected)


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Memory(Case):
    WARM, RENDERS, MOST = 300, 1500, 4 << 20  # bytes

    def flat(self, draw, renders=RENDERS):
        for _ in range(self.WARM):
            draw()
        before = resident()
        for _ in range(renders):
            draw()
        self.assertLess(resident() - before, self.MOST)

    def test_many_small_renders(self):
        scene, kept = dgtk.scene(square()), dgtk.dgtkRenderer()
        self.flat(lambda: dgtk.render(scene, "depth", size=(32, 24), keep=kept))
        self.flat(lambda: dgtk.render(scene, "depth", size=(32, 24)), 300)

    def test_many_scenes_and_refusals(self):
        first, place = dgtk.scene(square()), [0.0]

        def edit():
            description = square()
            place[0] += 0.001
            description["objects"][0]["position"] = [0, place[0], 0]
            dgtk.render(dgtk.scene(description, like=first), "depth", size=(8, 6))

        def refuse():
            for wrong in ({"layers": "depht"}, {"layers": "depth", "samples": 99}):
                try:
                    dgtk.render(first, size=(8, 6), **wrong)
                except ValueError:
                    pass
        self.flat(edit, 300)
        self.flat(refuse, 300)

    def test_arrays_are_not_copied_and_outlive_everything(self):
        renderer, scene = dgtk.dgtkRenderer(), dgtk.load(DEMO)
        depth = dgtk.render(scene, "depth", size=SIZE, keep=renderer)
        self.assertFalse(depth.flags.owndata)
        self.assertTrue(depth.flags.writeable)
        before = depth.copy()
        for frame in (1, 2):
            dgtk.render(scene, "depth", frame=frame, size=SIZE, keep=renderer)
        del renderer, scene
        numpy.testing.assert_array_equal(depth, before)

    def test_results_can_be_pickled(self):
        outputs = dgtk.render(dgtk.load(DEMO), ["color", "flow_forward", "boxes", "ldi", "calibration", "points", "pov"], size=SIZE)
        again = pickle.loads(pickle.dumps(outputs))
        self.assertEqual(list(again), list(outputs))
        numpy.testing.assert_array_equal(again["ldi"]["depth"], outputs["ldi"]["depth"])
        numpy.testing.assert_array_equal(copy.deepcopy(outputs)["color"], outputs["color"])


class Broken:
    """An object on which everything fails."""

    def __getattr__(self, name):
        raise RuntimeError("broken\nobject")

    def __repr__(self):
        raise RuntimeError("broken\nobject")


class Misuse(Case):
    WRONG = [None, True, -1, 0, 1.5, math.nan, math.inf, 1 << 31, -(1 << 31) - 1, 1 << 70, 10**5000, 2j, "", "nobody", "a\nb", "a\0b", "\ud800", "x" * 100000,
             "depth,color", b"depth", b"\xff", [], [None], [[]], [1], [-1, -1], [0, 0], [1 << 20, 1 << 20], [1 << 40, 2], ["depth", 3], (1, 2, 3), {}, {"a": 1}, {1, 2}, object(), int,
             Broken(), numpy.zeros(3), numpy.array("a"), numpy.array([math.nan] * 2), numpy.array([None]), range(10**9), range(0), lambda *_: None,
             iter([1]), dgtk, dgtk.dgtkRenderer(), dgtk.dgtkScene(), dgtk.Scene(), dgtk.dgtkDatasetGenerator()]
    # What may stand there, of the list: it is not refused.
    RIGHT = {
        ("render", "camera"): [None], ("render", "frame"): [None, 0], ("render", "size"): [None],
        ("render", "renderer"): [None, "dgtk.dgtkRenderer"], ("render", "keep"): [None, "dgtk.dgtkRenderer"],
        ("generate", "layers"): [None], ("generate", "frames"): [None, 0, [0, 0], [1], (1, 2, 3)], ("generate", "cameras"): [None],
        ("generate", "size"): [None], ("generate", "progress"): [None, "callable"], ("generate", "resume"): [True], ("generate", "replace"): [True],
        ("scene", "folder"): [None, "any"], ("scene", "like"): [None, "dgtk.dgtkScene"], ("scene", "description"): [{}],
    }

    @staticmethod
    def label(value):
        return type(value).__name__

    def refused(self, function, arguments, may_work):
        try:
            function(**arguments)
        except (ValueError, RuntimeError) as error:
            self.assertIn(type(error), (ValueError, RuntimeError), error)
            self.assertEqual(len(str(error).splitlines()), 1, str(error)[:500])
            self.assertNotIn("--", str(error))
            self.assertLess(len(str(error)), 2000)
            return
        self.assertTrue(may_work, "was not refused")

    def may_work(self, name, argument, value):
        for right in self.RIGHT.get((name, argument), []):
            if right == "any" and isinstance(value, str):
                return True
            if right == "callable" and callable(value):
                return True
            if isinstance(right, str) and right.startswith("dgtk.") and isinstance(value, getattr(dgtk, right[5:])):
                return True
            if type(right) is type(value) and right == value:
                return True
        return False

    def test_every_argument_of_every_function(self):
        scene = dgtk.scene(square())
        good = {"load": {"path": DEMO}, "scene": {"description": square()}, "render": {"scene": scene, "layers": "depth", "size": (8, 6)},
                "generate": {"scene": scene, "folder": self.path("out"), "layers": "depth", "size": (8, 6)}}
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        for name, arguments in good.items():
            function = getattr(dgtk, name)
            for argument, parameter in inspect.signature(function).parameters.items():
                if parameter.kind is parameter.VAR_KEYWORD:
                    continue
                for value in self.WRONG:
                    with self.subTest(f"{name}({argument}={self.label(value)})"):
                        self.refused(function, {**arguments, argument: value}, self.may_work(name, argument, value)
                                     or (name, argument) == ("generate", "folder") and isinstance(value, str))

    def test_every_option(self):
        scene = dgtk.scene(square())
        for name in (line.split("\t")[0] for line in dgtk.dgtkRenderer.GetOptions().splitlines()):
            for wrong in self.WRONG:
                may_work = name == "renderer" and self.may_work("render", name, wrong) or isinstance(wrong, (str, int, float, list, tuple, numpy.ndarray, range))  # another test has values of options
                with self.subTest(f"{name}={self.label(wrong)}"):
                    self.refused(dgtk.render, {"scene": scene, "layers": "depth", "size": (8, 6), name: wrong}, may_work)
        for wrong in ("", "no_such", "Samples", "gl_", "\ud800", "a\nb"):
            self.refused(dgtk.render, {"scene": scene, "layers": "depth", wrong: 1}, False)

    def test_values_of_descriptions(self):
        """Anything anywhere in a description is read or refused by its path."""
        chance = random.Random(7)

        def places(value, path=()):
            yield path
            for key, one in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
                yield from places(one, path + (key,))
        original = dgtk.load(DEMO).description()
        every = list(places(original))[1:]
        folder, refused = dgtk.load(DEMO).folder, 0
        like = dgtk.load(DEMO)
        for _ in range(400):
            description = copy.deepcopy(original)
            path, value = chance.choice(every), chance.choice(self.WRONG)
            inside = description
            for key in path[:-1]:
                inside = inside[key]
            inside[path[-1]] = value
            with self.subTest(f"{path}={self.label(value)}"):
                try:
                    dgtk.scene(description, folder=folder, like=like)
                except ValueError as error:
                    self.assertEqual(len(str(error).splitlines()), 1)
                    self.assertTrue(str(error).startswith("scene: "), str(error)[:200])
                    refused += 1
        self.assertGreater(refused, 200)

    def test_methods_of_the_vtk_classes(self):
        """Whatever they are given: they refuse it in words, or do nothing that ends the interpreter."""
        chance = random.Random(3)
        for kind in (dgtk.dgtkScene, dgtk.Scene, dgtk.dgtkRenderer, dgtk.dgtkDatasetGenerator):
            methods = [name for name in vars(kind if kind is not dgtk.Scene else dgtk.dgtkScene) if not name.startswith("_") and name not in OF_VTK]
            for _ in range(1500):
                thing, name = kind(), chance.choice(methods)
                arguments = [chance.choice(self.WRONG) for _ in range(chance.randrange(4))]
                arguments = [one for one in arguments if not isinstance(one, str) or one != "\ud800"]  # VTK's wrapper ends the program at it
                if name == "Wait" and arguments and isinstance(arguments[0], (int, float)) and arguments[0] > 100:
                    continue
                try:
                    getattr(thing, name)(*arguments)
                except (TypeError, ValueError, OverflowError, RuntimeError, AttributeError):
                    pass
                if hasattr(thing, "IsRunning"):
                    while thing.IsRunning():
                        thing.Wait(100)
        scene, renderer = dgtk.scene(square()), dgtk.dgtkRenderer()
        with self.assertRaisesRegex(RuntimeError, "not enough memory: arrays of 1048576 x 1048576 pixels take 8796 GB, and there are [0-9]+"):
            dgtk.render(scene, "depth", size=(1 << 20, 1 << 20))
        renderer.SetScene(scene)
        self.assertIsNone(renderer.GetOutput(0))
        self.assertFalse(renderer.RenderLayers("depht"))
        self.assertEqual(renderer.GetErrorCode(), 2)
        self.assertTrue(renderer.RenderLayers("depth"))
        self.assertEqual((renderer.GetErrorCode(), renderer.GetErrorMessage()), (0, ""))
        self.assertIsNone(renderer.GetOutput(1 << 30))
        renderer.SetScene(None)
        self.assertIsNone(renderer.Render("depth"))


# VTK's own methods of every class, which its wrapper does not guard.
OF_VTK = {"IsA", "IsTypeOf", "NewInstance", "SafeDownCast", "GetNumberOfGenerationsFromBase", "GetNumberOfGenerationsFromBaseType"}


class Stubs(Case):
    """What type checkers are told is what there is."""

    def setUp(self):
        super().setUp()
        with open(os.path.join(os.path.dirname(dgtk.__file__), "__init__.pyi"), encoding="utf-8") as file:
            self.tree = ast.parse(file.read())

    def named(self, kind, tree=None):
        return [node for node in (tree or self.tree).body if isinstance(node, kind)]

    def test_the_package_is_typed(self):
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(dgtk.__file__), "py.typed")))
        listed = next(node for node in self.named(ast.Assign) if node.targets[0].id == "__all__")
        self.assertEqual(ast.literal_eval(listed.value), dgtk.__all__)
        defined = {node.name for node in self.named((ast.FunctionDef, ast.ClassDef))}
        self.assertEqual(defined, set(dgtk.__all__))
        there = {name for name, value in vars(dgtk).items() if not name.startswith("_") and not inspect.ismodule(value)}
        self.assertEqual(there - {"EXECUTABLE", "PYTHON", "VERSION"}, set(dgtk.__all__))

    def parameters(self, function):
        """Name and default of each, in order; a default of ... is any."""
        arguments = function.args
        defaults = [inspect.Parameter.empty] * (len(arguments.args) - len(arguments.defaults)) + [ast.literal_eval(one) for one in arguments.defaults]
        return list(zip([one.arg for one in arguments.args], defaults)) + ([("**" + arguments.kwarg.arg, inspect.Parameter.empty)] if arguments.kwarg else [])

    def test_functions_have_their_parameters_and_defaults(self):
        functions = self.named(ast.FunctionDef)
        self.assertGreater(len(functions), 3)
        for function in functions:
            there = inspect.signature(getattr(dgtk, function.name)).parameters.values()
            self.assertEqual(self.parameters(function), [("**" + one.name if one.kind is one.VAR_KEYWORD else one.name, one.default) for one in there])
            self.assertIsNotNone(function.returns)
            for argument in function.args.args:
                self.assertIsNotNone(argument.annotation, argument.arg)

    def test_classes_have_their_methods(self):
        for node in self.named(ast.ClassDef):
            kind = getattr(dgtk, node.name)
            self.assertEqual([base.id for base in node.bases], [base.__name__ for base in kind.__bases__])
            methods = {function.name: function for function in self.named(ast.FunctionDef, node)}
            self.assertEqual(set(methods), {name for name in vars(kind) if not name.startswith("_")} - OF_VTK)
            for name, function in methods.items():
                thing = vars(kind)[name]
                if isinstance(thing, property):
                    self.assertEqual([one.id for one in function.decorator_list], ["property"])
                    continue
                count = len(function.args.args) - ("staticmethod" not in [one.id for one in function.decorator_list])
                if node.name.startswith("dgtk"):  # VTK says the signature in the first line
                    given = inspect.getdoc(getattr(kind, name)).splitlines()[0].split("(", 1)[1].rsplit(")", 1)[0]
                    self.assertEqual(len([word for word in given.split(", ") if ":" in word]), count, f"{node.name}.{name}({given})")

    def test_everything_public_has_a_docstring(self):
        for name in dgtk.__all__:
            self.assertGreater(len(inspect.getdoc(getattr(dgtk, name))), 40)
        for name, thing in vars(dgtk.Scene).items():
            self.assertTrue(name.startswith("_") or inspect.getdoc(thing), name)

    def test_the_reference_is_made_from_the_docstrings(self):
        script = os.path.join(SOURCE, "Utilities", "Maintenance", "update_python_reference")
        done = subprocess.run(["/usr/bin/python3", script, "--check", PACKAGES], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    main()
