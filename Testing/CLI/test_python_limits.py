# SPDX-License-Identifier: BSD-3-Clause
"""What the Python package bears: threads, many pictures, and whatever it is given."""
import copy
import inspect
import math
import os
import pickle
import random
import subprocess
import threading
import time

import numpy
from harness import Case, main, measures
from python_package import DEMO, OF_VTK, PACKAGES, SIZE, dgtk, square


class Threads(Case):
    @measures
    def test_other_threads_run_while_one_renders(self):
        """With the interpreter's lock held, one gap would be all of the time."""
        scene, size = dgtk.load(DEMO), (600, 450)
        for work in (lambda: [dgtk.render(scene, "color", size=size, samples=2) for _ in range(2)],
                     lambda: [dgtk.render(scene, "ldi", size=size, renderer="vtk") for _ in range(2)],
                     lambda: [dgtk.load(DEMO) for _ in range(10)]):
            thread = threading.Thread(target=work)
            began = last = time.monotonic()
            thread.start()
            longest = 0
            while thread.is_alive():
                time.sleep(0.001)
                now = time.monotonic()
                longest, last = max(longest, now - last), now
            self.assertLess(longest, (time.monotonic() - began) / 2)

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

    def test_a_renderer_inside_its_own_use(self):
        """As a signal handler does that interrupts a picture: it is refused, and the picture is drawn."""
        scene, kept, told = dgtk.scene(square()), dgtk.dgtkRenderer(), []

        class Interrupting(int):
            def __str__(self):
                try:
                    dgtk.render(scene, "objects", size=SIZE, keep=kept)
                except RuntimeError as error:
                    told.append(str(error))
                return "1"
        thread = threading.Thread(target=lambda: told.append(dgtk.render(scene, "objects", size=SIZE, keep=kept, samples=Interrupting())), daemon=True)
        thread.start()
        thread.join(60)
        self.assertFalse(thread.is_alive(), "it waits for itself")
        self.assertEqual(len(told), 2)
        self.assertRegex(told[0], r"\Athe dgtkRenderer is in use by this thread already")
        numpy.testing.assert_array_equal(told[1], dgtk.render(scene, "objects", size=SIZE, keep=kept))

    def ends(self, program, *arguments):
        done = subprocess.run(["/usr/bin/python3", "-c", f"import sys; sys.path.insert(0, {PACKAGES!r})\n" + program, *arguments],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (3, "", ""))

    def test_a_script_that_ends_while_a_daemon_thread_renders(self):
        for layer in ("depth", "color", "color"):  # the threads that draw are where chance has them
            self.ends("""
import sys, threading, dgtk
scene, began = dgtk.load(sys.argv[1]), threading.Event()
def ahead():
    while True:
        dgtk.render(scene, sys.argv[2], size=(160, 120), samples=4)
        began.set()
threading.Thread(target=ahead, daemon=True).start()
began.wait()
sys.exit(3)
""", DEMO, layer)

    def test_a_fork_has_no_threads_to_wait_for(self):
        self.ends("""
import json, os, sys, threading, dgtk
sampler, began = dgtk.dgtkSceneSampler(), threading.Event()
sampler.LoadText(json.dumps({"lights": [{"name": f"l{i}", "intensity": {"uniform": [2, 4]}} for i in range(3000)]}), ".")
def ahead():
    while True:
        sampler.Draw(0, ".")
        began.set()
threading.Thread(target=ahead, daemon=True).start()
began.wait()
child = os.fork()
sys.exit(3 if child == 0 else os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
""")

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

    @measures
    def test_many_small_renders(self):
        scene, kept = dgtk.scene(square()), dgtk.dgtkRenderer()
        self.flat(lambda: dgtk.render(scene, "depth", size=(32, 24), keep=kept))
        self.flat(lambda: dgtk.render(scene, "depth", size=(32, 24)), 300)

    @measures
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
        ("generate", "layers"): [None], ("generate", "classes"): [None], ("generate", "frames"): [None, 0, [0, 0], [1], (1, 2, 3)], ("generate", "cameras"): [None], ("generate", "formats"): [None],
        ("export", "cameras"): [None], ("export", "frames"): [None, 0, [0, 0], [1]], ("export", "progress"): [None, "callable"],
        ("export", "resume"): [True], ("export", "replace"): [True],
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
        dataset = self.path("dataset")
        dgtk.generate(scene, dataset, formats="coco", size=(8, 6))
        good = {"load": {"path": DEMO}, "scene": {"description": square()}, "render": {"scene": scene, "layers": "depth", "size": (8, 6)},
                "generate": {"scene": scene, "folder": self.path("out"), "layers": "depth", "size": (8, 6)},
                "export": {"dataset": dataset, "format": "coco", "folder": self.path("exported")}}
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        for name, arguments in good.items():
            function = getattr(dgtk, name)
            for argument, parameter in inspect.signature(function).parameters.items():
                if parameter.kind is parameter.VAR_KEYWORD:
                    continue
                for value in self.WRONG:
                    if value is int and argument == "progress":
                        continue  # it is called, and what it raises is raised on
                    with self.subTest(f"{name}({argument}={self.label(value)})"):
                        self.refused(function, {**arguments, argument: value}, self.may_work(name, argument, value)
                                     or (name, argument) in (("generate", "folder"), ("export", "folder")) and isinstance(value, str))

    def test_every_argument_about_views(self):
        from vtkmodules.vtkRenderingCore import vtkRenderer

        good = {"snapshot": {"view": vtkRenderer()}, "truth": {"view": vtkRenderer(), "layers": "depth", "size": (8, 6)},
                "visible_cells": {"view": vtkRenderer(), "size": (8, 6)}, "correspond": {"first": dgtk.Snapshot(), "second": dgtk.Snapshot()}}
        for name, arguments in good.items():
            for argument, parameter in inspect.signature(getattr(dgtk, name)).parameters.items():
                for value in self.WRONG if parameter.kind is not parameter.VAR_KEYWORD else ():
                    with self.subTest(f"{name}({argument}={self.label(value)})"):
                        self.refused(getattr(dgtk, name), {**arguments, argument: value}, argument == "size" and (value is None or isinstance(value, list)))

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


if __name__ == "__main__":
    main()
