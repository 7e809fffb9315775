# SPDX-License-Identifier: BSD-3-Clause
"""The Python package beyond single pictures: scenes of dicts, datasets, stubs and reference."""
import ast
import functools
import inspect
import json
import math
import os
import pathlib
import pickle
import shutil
import subprocess
import warnings

import numpy
from harness import SCENES, SOURCE, Case, digests, main, measures
from many_runs import ManyCase
from python_package import DEMO, OF_VTK, PACKAGES, SIZE, dgtk, square


class Samples(Case):
    SCENE = {"seed": 5, "lights": [{"name": "sun", "intensity": {"uniform": [2, 4]}}]}

    def test_a_sample_is_that_of_the_command(self):
        path = self.write("random.json", json.dumps(self.SCENE))
        self.dgtk("sample", path, "-o", self.path("out"), "--samples", "7", "--quiet")
        with open(self.path("out/000007.json"), encoding="utf-8") as file:
            written = json.load(file)
        self.assertEqual(dgtk.sample(self.SCENE, 7), written)
        self.assertEqual(dgtk.sample(path, 7), written)
        self.assertNotEqual(dgtk.sample(path, 7, seed=6), written)
        self.assertEqual(dgtk.scene(dgtk.sample(path, 7)).cameras, [])
        self.assertEqual(written["lights"][0]["intensity"], 2 + 2 * dgtk.random(5, 7, "lights/sun/intensity"))
        self.assertEqual(dgtk.sample(path, numpy.int8(7), seed=numpy.uint64(2**53 - 1)), dgtk.sample(path, 7, seed=2**53 - 1))
        self.assertEqual(dgtk.random(numpy.int64(5), 7, "a"), dgtk.random(5, 7, "a"))

    def test_relative_paths_start_in_the_folder(self):
        os.mkdir(self.path("m"))
        self.write("m/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        drawn = dgtk.sample({"objects": [{"name": "o", "model": {"choice": {"files": "m/*.obj"}}}]}, 0, folder=self.folder)
        self.assertEqual(os.path.realpath(drawn["objects"][0]["model"]), os.path.realpath(self.path("m/a.obj")))

    def test_what_a_sample_goes_without_is_a_warning(self):
        self.write("flat.obj", "v -1 0 -1\nv 1 0 -1\nv 0 0 1\nf 1 2 3\n")
        self.write("tall.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        scene = {"objects": [{"name": "table", "model": "flat.obj"},
                             {"name": "cup", "model": "tall.obj", "scale": 9, "place": {"on": "table", "attempts": 3}}]}
        with self.assertWarnsRegex(UserWarning, "^left out: objects/cup/place: ") as warned:
            drawn = dgtk.sample(scene, 0, folder=self.folder)
        self.assertEqual(os.path.basename(warned.filename), os.path.basename(__file__))
        self.assertEqual([one["name"] for one in drawn["objects"]], ["table"])

    def test_refusals(self):
        wrong = {"lights": [{"name": "l", "intensity": {"uniform": [2, 1]}}]}
        for call, says in ((lambda: dgtk.sample(wrong, 0), r"lights\[0\].intensity.uniform is empty"), (lambda: dgtk.sample(self.SCENE, -1), "number: "),
                           (lambda: dgtk.sample(self.SCENE, 1.5), "number: "), (lambda: dgtk.sample(self.SCENE, 0, seed=-1), "seed: "),
                           (lambda: dgtk.sample(self.SCENE, 0, seed=2**53), r"seed: expected an integer from 0 to 2\*\*53 - 1, found 9007199254740992"),
                           (lambda: dgtk.sample(self.SCENE, 0, seed=numpy.True_), "seed: "), (lambda: dgtk.random(2.0, 0, "a"), "seed: "),
                           (lambda: dgtk.sample("a.json", 0, folder="."), "folder: "), (lambda: dgtk.random(0, -1, "a"), "sample: "),
                           (lambda: dgtk.random(0, 0, ""), "path: "), (lambda: dgtk.random(0, 0, "a", -1), "draw: "), (lambda: dgtk.sample(3, 0), "scene: ")):
            with self.assertRaisesRegex(ValueError, says):
                call()
        for call, says in ((lambda: dgtk.random(0, 2**31, "a"), r"^sample: expected an integer from 0 to 2\*\*31 - 1, found 2147483648$"),
                           (lambda: dgtk.random(0, 0, "a\0b"), "^path: expected a text without a character 0, ")):
            with self.assertRaisesRegex(ValueError, says):
                call()
        with self.assertRaisesRegex(ValueError, "makes the scene random"):
            dgtk.scene(self.SCENE)


class Scenes(Case):
    def test_a_missing_texture_is_a_warning(self):
        self.write("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n")
        description = {"objects": [{"model": self.path("tri.obj"), "materials": {"*": {"texture": "no.png"}}}]}
        file = self.write("missing.json", json.dumps(description))
        for make, says in ((lambda: dgtk.scene(description), "^scene: .*'no.png': not found"),
                           (lambda: dgtk.load(file), r"missing.json: .*'no.png': not found")):
            with self.assertWarnsRegex(UserWarning, says) as warned:
                made = make()
            self.assertEqual(os.path.basename(warned.filename), os.path.basename(__file__))
            self.assertEqual(made.GetWarnings().count("\n"), 1)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            dgtk.scene({"objects": [{"model": self.path("tri.obj")}]})

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

    def test_paths_and_ranges_of_python(self):
        made = dgtk.scene({"objects": [{"model": pathlib.Path(SCENES).parent / "Models" / "floor.ac", "position": range(3)}]})
        self.assertEqual(made.description()["objects"][0]["position"], [0, 1, 2])
        for long in (range(10**9), range(10**30)):  # costs nothing, and as a list all memory
            with self.assertRaisesRegex(ValueError, r"scene: objects is too long .expected at most 1000000 numbers, found an object of range"):
                dgtk.scene({"objects": long})

    def test_numbers_of_numpy(self):
        plain, numbers = square(), square()
        plain["objects"][0].update(position=[0, 0.5, 0], scale=[2, 2, 2], visible=True)
        numbers["objects"][0].update(position=numpy.array([0, 0.5, 0], numpy.float32), scale=numpy.full(3, 2), visible=numpy.bool_(True))
        numbers["cameras"][0].update(eye=(0, numpy.int64(3), numpy.float64(4)))
        self.assertEqual(dgtk.scene(plain).description(), dgtk.scene(numbers).description())
        numbers["objects"][0].update(position=numpy.array([0, 0.5, 0], numpy.longdouble), scale=[numpy.longdouble(2)] * 3)
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
                (lambda d: d.update(fps=numpy.longdouble("1e4000")), r"scene: fps is out of range .expected a finite number, found inf"),
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

    def test_each_picture_is_asked_for_anew(self):
        description, kept = square(), dgtk.dgtkRenderer()
        description["cameras"][0]["eye"] = {"keys": [[3, [0, 3, 4]], [7, [0, 5, 4]]]}
        description["cameras"].append({"name": "flat", "model": "orthographic", "eye": [0, 3, 4], "lookAt": [0, 0, 0]})
        scene = dgtk.scene(description)
        fresh = dgtk.render(scene, "color", frame=3, size=SIZE)
        smooth = dgtk.render(scene, "color", frame=3, size=SIZE, samples=4, keep=kept)
        self.assertTrue((smooth != fresh).any())
        numpy.testing.assert_array_equal(dgtk.render(scene, "color", frame=3, size=SIZE, keep=kept), fresh)
        numpy.testing.assert_array_equal(dgtk.render(scene, "color", size=SIZE), fresh, "the first frame")
        self.assertLess({"K", "R", "t"}, set(dgtk.render(scene, "calibration", frame=3)))
        self.assertEqual(set(dgtk.render(scene, "calibration", camera="flat", frame=3)), {"thesis_K", "thesis_Rt", "viewport"})

    def test_points_that_nobody_sees(self):
        scene = square()
        scene["cameras"][0]["lookAt"] = [0, 6, 8]
        cloud = dgtk.render(dgtk.scene(scene), "points", size=SIZE)
        self.assertEqual({name: len(cloud[name]) for name in ("x", "normal", "color", "object", "triangle", "track")},
                         dict.fromkeys(("x", "normal", "color", "object", "triangle", "track"), 0))
        self.assertEqual((len(cloud), cloud["frame"], cloud["cameras"]), (8, 0, ["above"]))

    def test_a_scene_can_be_pickled(self):
        again = pickle.loads(pickle.dumps(dgtk.load(DEMO)))
        self.assertEqual(type(again), dgtk.Scene)
        self.assertEqual((again.description(), again.folder), (dgtk.load(DEMO).description(), dgtk.load(DEMO).folder))

    def test_a_folder_whose_name_is_no_utf8(self):
        folder = os.path.join(os.path.realpath(self.folder), "f\udcff")
        os.mkdir(folder)
        shutil.copy(os.path.join(SOURCE, "Data", "Models", "floor.ac"), folder)
        made = dgtk.scene({"objects": [{"name": "floor", "model": "floor.ac"}]}, folder=folder)
        self.assertEqual(made.folder, folder)
        description = made.description()
        for again in (pickle.loads(pickle.dumps(made)), dgtk.scene(description, like=made), dgtk.scene(description, folder=made.folder)):
            self.assertEqual((again.folder, again.objects), (folder, ["floor"]))

    def test_an_empty_scene_and_an_empty_dict(self):
        self.assertEqual(dgtk.Scene().description(), {})
        again = pickle.loads(pickle.dumps(dgtk.Scene()))
        self.assertEqual((type(again), again.description(), again.folder), (dgtk.Scene, {}, ""))
        with self.assertRaisesRegex(ValueError, "no scene is set"):
            dgtk.render(dgtk.Scene(), "depth")
        with self.assertRaisesRegex(ValueError, "no scene is set"):
            dgtk.generate(dgtk.Scene(), self.path("out"))
        with self.assertRaisesRegex(ValueError, "camera"):
            dgtk.render(dgtk.scene({}), "depth")


class Datasets(ManyCase):
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
        self.assertEqual((reports[0], reports[-1], reports), ((0, 4), (4, 4), sorted(set(reports))))
        self.by_python("scene", dgtk.load(DEMO), **options)
        for name in ("path", "scene"):
            self.assert_same_files(self.path("command"), self.path(name))
        with open(self.path("path", "manifest.json"), encoding="utf-8") as file:
            self.assertEqual(json.load(file), manifest)

    def test_an_export_is_that_of_the_command(self):
        self.by_python("dataset", layers="color", cameras="left")
        self.dgtk("export", self.path("dataset"), "--format", "imagefolder", "-o", self.path("command"), "--frames", "0:2:2", "--quiet")
        reports = []
        dgtk.export(self.path("dataset"), "imagefolder", self.path("python"), frames=(0, 2, 2), progress=lambda *state: reports.append(state))
        self.assertEqual((reports[0][0], reports[-1][0], reports), (0, reports[-1][1], sorted(set(reports))))
        self.assert_same_files(self.path("command"), self.path("python"))

    def test_formats_of_exports(self):
        listed = json.loads(self.dgtk("list", "exporters", "--json").stdout)["exporters"]
        known = dgtk.exporters()
        self.assertEqual({name: (",".join(layers), text) for name, (layers, text) in known.items()},
                         {row["format"]: (row["layers"], row["description"]) for row in listed})
        self.assertEqual(known["gltf"][0], [])
        self.assertEqual(known["tum"][0], ["color", "depth"])

    def test_the_usual_layers_and_all_frames(self):
        self.dgtk("render", DEMO, "-o", self.path("command"), "--quiet", "--size", "32x24")
        dgtk.generate(os.path.join(SCENES, "demo.json"), self.path("python"), size=(32, 24))
        self.assert_same_files(self.path("command"), self.path("python"))

    def test_frames_of_a_range(self):
        for frames, numbers in ((dgtk.load(DEMO).frames, (0, 2)), (range(0, 4, 2), (0, 2, 2))):
            for name, given in (("range", frames), ("numbers", numbers)):
                dgtk.generate(DEMO, self.path(name), "objects", given, "left", (8, 6), replace=os.path.exists(self.path(name)))
            self.assert_same_files(self.path("range"), self.path("numbers"))

    def test_progress_that_is_empty_is_called(self):
        class Reports(list):
            def __call__(self, *report):
                self.append(report)

            def __bool__(self):
                return False
        reports = Reports()
        self.by_python("out", layers="objects", progress=reports)
        self.assertEqual((reports[0], reports[-1]), ((0, 6), (6, 6)))

    def test_a_folder_of_scenes(self):
        """As the command, to the byte; progress counts scenes, and what it raises ends the run."""
        os.mkdir(self.path("scenes"))
        for name, kind in (("a", "pear"), ("b", "apple")):
            scene = dgtk.load(DEMO).description()
            scene["objects"] = [{**one, "class": kind, "model": os.path.join(SCENES, one["model"])} for one in scene["objects"]]
            scene.pop("classes", None)
            self.write(f"scenes/{name}.json", json.dumps(scene))
        options = ("--layers", "depth,classes", "--size", "32x24", "--frames", "0", "--quiet")
        self.dgtk("render", self.path("scenes"), "-o", self.path("command"), *options)
        wanted = {"layers": ["depth", "classes"], "size": (32, 24), "frames": 0}
        seen = []
        manifest = dgtk.generate(self.path("scenes"), self.path("python"), progress=lambda *state: seen.append(state), **wanted)
        self.assertEqual(digests(self.path("command")), digests(self.path("python")))
        with self.assertRaisesRegex(ValueError, "python: holds 2 datasets .expected one of them, such as 'a'."):
            dgtk.dataset(self.path("python"))
        self.assertEqual([one["path"] for one in manifest["datasets"]], ["a/manifest.json", "b/manifest.json"])
        self.assertEqual((seen[0], seen[-1]), ((0, 2), (2, 2)))

        def stop(done, total):
            if done == 1:
                raise KeyError("enough")

        with self.assertRaises(KeyError):
            dgtk.generate(self.path("scenes"), self.path("stopped"), progress=stop, **wanted)
        dgtk.generate(self.path("scenes"), self.path("stopped"), resume=True, replace=False, **wanted)
        self.assertEqual(digests(self.path("command")), digests(self.path("stopped")))
        self.write("numbers.json", '{ "pear": 5, "apple": 4 }')
        dgtk.generate(self.path("scenes"), self.path("numbered"), classes=self.path("numbers.json"), **wanted)
        with open(self.path("numbered", "a", "objects.json"), encoding="utf-8") as file:
            self.assertEqual({one["class_id"] for one in json.load(file)["objects"]}, {5})
        with self.assertRaisesRegex(ValueError, "names no class|none.json"):
            dgtk.generate(self.path("scenes"), self.path("no"), classes=self.path("none.json"), **wanted)

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
                if len(calls) == 2:
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
def interrupt():
    while not os.path.isdir(sys.argv[2] + "/left"):  # it draws
        time.sleep(0.005)
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt, daemon=True).start()
try:  # pictures of three bands each, six of them
    dgtk.generate(sys.argv[1], sys.argv[2], layers=["depth", "normal", "ldi"], size=(160, 1500), samples=4)
except KeyboardInterrupt:
    whole = [name for _, _, names in os.walk(sys.argv[2]) for name in names if name.endswith(".ldi")]
    print("interrupted", len(whole) < 3, os.path.exists(sys.argv[2] + "/manifest.json"))
"""

    @measures
    def test_an_interrupt_without_progress(self):
        done = subprocess.run(["/usr/bin/python3", "-c", f"import sys; sys.path.insert(0, {PACKAGES!r})" + self.INTERRUPTED, DEMO, self.path("out")],
                              capture_output=True, text=True, timeout=300)
        self.assertEqual((done.returncode, done.stdout), (0, "interrupted True False\n"), done.stderr)

    def test_a_list_of_frames_is_those(self):
        for frames, expected in (([0, 2], [0, 2]), ((0, 2), [0, 1, 2]), (numpy.array([1, 2]), [1, 2]), ([1], [1]), ((1,), [1]), (range(0, 3, 2), [0, 2])):
            manifest = dgtk.generate(DEMO, self.path("out"), layers="calibration", cameras="left", frames=frames, size=(32, 24), replace=True)
            self.assertEqual([file["frame"] for file in manifest["files"] if file.get("layer") == "calibration"], expected)

    def test_refusals(self):
        self.write("file", "text")
        for wrong, kind, says in (
                ({"layers": "depht"}, ValueError, "'depht'"),
                ({"layers": []}, ValueError, "layers: expected a name or a list of names"),
                ({"cameras": "nobody"}, ValueError, "no camera 'nobody'"),
                ({"frames": (2, 1)}, ValueError, "frames: expected an integer, .first, last. or"),
                ({"frames": 77}, ValueError, "the scene has frames 0 to 2, found 77"),
                ({"frames": "all"}, ValueError, "frames: expected"),
                ({"frames": range(0)}, ValueError, "frames: expected an integer, .first, last. or .* a range, or a list of frames one step apart, found an object of range"),
                ({"frames": range(2, -1, -1)}, ValueError, "frames: expected"),
                ({"frames": [0, 1, 3]}, ValueError, "frames: expected .* found .0, 1, 3."),
                ({"frames": []}, ValueError, "frames: expected"),
                ({"frames": [0, 1, 2000000000]}, ValueError, "frames: expected"),
                ({"frames": ()}, ValueError, "frames: expected"),
                ({"frames": (0, 1, 1, 1)}, ValueError, "frames: expected"),
                ({"frames": [0, "1"]}, ValueError, "frames: expected"),
                ({"size": (0, 5)}, ValueError, "size: expected"),
                ({"progress": 3}, ValueError, "progress: expected something to call, found 3"),
                ({"resume": 1}, ValueError, "resume: expected True or False"),
                ({"resume": True, "replace": True}, ValueError, "either resumed or replaced"),
                ({"samples": 99}, ValueError, "samples: expected an integer from 1 to 16, found '99'"),
                ({"sample": 4}, ValueError, "there is no option 'sample'"),
                ({"scene": "/nothing.json"}, ValueError, "/nothing.json: "),
                ({"scene": 3}, ValueError, "scene: expected"),
                ({"scene": dgtk.Snapshot()}, ValueError, "no renderer was taken"),
                ({"folder": SCENES}, ValueError, "holds"),
                ({"folder": self.path("file")}, (ValueError, RuntimeError), "file"),
                ({"folder": "/proc/none/out"}, RuntimeError, "/proc/none")):
            with self.subTest(wrong):
                with self.assertRaisesRegex(kind, says) as caught:
                    dgtk.generate(**{"scene": DEMO, "folder": self.path("out"), "size": SIZE, **wrong})
                self.assertNotIn("--", str(caught.exception))
                self.assertNotIn("\n", str(caught.exception))
        self.assertEqual(os.listdir(self.folder), ["file"])
        for long in (10**5000, [-10**5000]):
            with self.assertRaisesRegex(ValueError, r"\Asamples: expected a number of fewer digits, found a number of too many digits\Z"):
                dgtk.generate(DEMO, self.path("out"), samples=long)


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
            bases = [base.value.id.lower() if isinstance(base, ast.Subscript) else base.id for base in node.bases]  # Dict[...] is dict
            self.assertEqual(bases, [base.__name__ for base in kind.__bases__ if base is not object])
            methods = {function.name: function for function in self.named(ast.FunctionDef, node)}
            self.assertEqual({name for name in methods if not name.startswith("__")}, {name for name in vars(kind) if not name.startswith("_")} - OF_VTK)
            for name, function in methods.items():
                thing = vars(kind)[name]
                if isinstance(thing, (property, functools.cached_property)):
                    self.assertEqual([one.id for one in function.decorator_list], ["property"])
                    continue
                count = len(function.args.args) - ("staticmethod" not in [one.id for one in function.decorator_list])
                if node.name.startswith("dgtk"):  # VTK says the signature in the first line
                    given = inspect.getdoc(getattr(kind, name)).splitlines()[0].split("(", 1)[1].rsplit(")", 1)[0]
                    self.assertIn(len([word for word in given.split(", ") if ":" in word]), range(count - len(function.args.defaults), count + 1),
                                  f"{node.name}.{name}({given})")

    def test_everything_public_has_a_docstring(self):
        for name in dgtk.__all__:
            self.assertGreater(len(inspect.getdoc(getattr(dgtk, name))), 40)
        for kind in (dgtk.Scene, dgtk.Dataset):
            for name, thing in vars(kind).items():
                self.assertTrue(name.startswith("_") or inspect.getdoc(thing), name)

    def test_the_reference_is_made_from_the_docstrings(self):
        script = os.path.join(SOURCE, "Utilities", "Maintenance", "update_python_reference")
        done = subprocess.run(["/usr/bin/python3", script, "--check", PACKAGES], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    main()
