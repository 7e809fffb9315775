# SPDX-License-Identifier: BSD-3-Clause
"""The thesis's scene format: appendix B.3 loads, renders, and survives conversion number for number."""
import json
import os
import re

from harness import SCENES, Case, load_json, main

NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def numbers(path):
    """Every number of a scene file, in order; names of files are left out."""
    with open(path, encoding="utf-8") as file:
        text = re.sub(r"(glObject_\w+:)\s*[^\s(]+\.\w+", r"\1", file.read())
    return [float(n) for n in NUMBER.findall(re.sub(r"glObject_\w+", "", text))]


class Scenes(Case):
    def test_appendix_b3(self):
        scene = os.path.join(SCENES, "appendix_b3.scene")
        self.dgtk("convert", scene, self.path("b3.json"))
        self.dgtk("convert", self.path("b3.json"), self.path("b3.scene"))
        self.assertEqual(numbers(scene), numbers(self.path("b3.scene")))
        self.dgtk("convert", self.path("b3.scene"), self.path("again.json"))
        with open(self.path("b3.json")) as one, open(self.path("again.json")) as two:
            self.assertEqual(json.load(one), json.load(two))
        self.dgtk("render", self.path("b3.scene"), "-o", self.path("out"), "--quiet", "--size", "320x240")
        camera = [n for n in os.listdir(self.path("out")) if os.path.isdir(self.path("out", n))]
        self.assertEqual(len(camera), 1)
        self.assertEqual(sorted(os.listdir(self.path("out", camera[0], "color"))), ["000000.png", "000001.png", "000002.png"])

    def test_a_folder_has_scenes_without_objects_and_files_that_are_damaged(self):
        """What is a scene, however little it has, is rendered; what cannot be is named, and keeps no other from it."""
        os.mkdir(self.path("models"))
        self.write("models/quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n")
        camera = {"name": "c", "eye": [0, 0, 5], "lookAt": [0, 0, 0]}
        self.write("few.json", json.dumps({"seed": 3, "objects": [{"name": "b", "model": "models/quad.obj", "count": {"integer": [0, 2]}}], "cameras": [camera]}))
        self.dgtk("sample", self.path("few.json"), "-o", self.path("few"), "--samples", "0:5", "--quiet")
        scenes = [f"{i:06}" for i in range(6)]
        self.assertTrue(any("objects" not in load_json(self.path("few", name + ".json")) for name in scenes), "one without objects")
        self.write("few/flat.json", json.dumps({"background": [0.5, 0.5, 0.5], "cameras": [camera]}))
        self.write("few/classes.json", json.dumps({"car": 1}))
        self.write("few/cameras.json", json.dumps({"cameras": [{"name": "c", "frame": 0}]}))
        self.write("few/lock.json", json.dumps({"version": 3, "packages": []}))
        options = ("--layers", "color,objects", "--size", "8x6", "--quiet")
        self.dgtk("render", self.path("few"), "-o", self.path("out"), *options)
        manifest = load_json(self.path("out", "manifest.json"))
        self.assertEqual([one["path"].split("/")[0] for one in manifest["datasets"]], scenes + ["flat"])
        self.assertEqual(manifest["left_out"], ["cameras.json", "classes.json", "lock.json", "samples.json"])
        for name, contents in (("._flat.json", b"\0\5\26\7"), ("wide.json", '{"version": 1}'.encode("utf-16")), ("cut.json", b'{"objects":'),
                               ("typo.json", json.dumps({"version": 1, "objects": [], "camera": [camera]}).encode())):
            with open(self.path("few", name), "wb") as file:
                file.write(contents)
        said = self.dgtk("render", self.path("few"), "-o", self.path("more"), *options, status=3).stderr
        self.assertIn("3 of 10 scenes could not be rendered", said)
        self.assertIn("cut.json:1: is not valid JSON", said)
        self.refused("info", self.path("few", "wide.json"), status=3, says=("wide.json: is UTF-16 (expected text in UTF-8)",))
        for name in scenes + ["flat"]:
            self.assertTrue(os.path.exists(self.path("more", name, "manifest.json")), name)
        for name in ("._flat.json", "wide.json", "cut.json", "typo.json"):
            os.remove(self.path("few", name))
        self.dgtk("render", self.path("few"), "-o", self.path("more"), *options, "--replace")
        self.assert_same_files(self.path("out"), self.path("more"))

    def test_every_thesis_scene_survives(self):
        for name in sorted(os.listdir(SCENES)):
            if name.endswith(".scene"):
                with self.subTest(name):
                    self.dgtk("convert", os.path.join(SCENES, name), self.path("x.json"))
                    self.dgtk("convert", self.path("x.json"), self.path("x.scene"))
                    self.assertEqual(numbers(os.path.join(SCENES, name)), numbers(self.path("x.scene")))

    def test_a_light_keeps_its_name(self):
        keys = "".join(f"{frame}\n< 0 1 0 > {{ 1, < 0 0 0 > }}\n< 0 2 0 > {{ 1, < 0 0 0 > }}\n" for frame in (0, 1))
        self.write("x.scene", "2\nglObject_Light: lamp\nglObject_Light:\n2\n" + keys)
        self.dgtk("convert", self.path("x.scene"), self.path("x.json"))
        self.dgtk("convert", self.path("x.json"), self.path("y.scene"))
        self.dgtk("convert", self.path("y.scene"), self.path("y.json"))
        with open(self.path("x.json")) as one, open(self.path("y.json")) as two:
            names = [[light["name"] for light in json.load(file)["lights"]] for file in (one, two)]
        self.assertEqual(names[0], names[1])
        self.assertEqual(names[0][0], "lamp")

    def test_what_a_scene_file_cannot_say_is_refused_by_name(self):
        self.refused("convert", os.path.join(SCENES, "lights_many.json"), self.path("x.scene"), status=3, says="light")
        self.assertFalse(os.path.exists(self.path("x.scene")))

    def test_a_dataset_holds_the_scene_it_was_rendered_from(self):
        self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", self.path("a"), "--quiet", "--size", "64x48", "--layers", "depth")
        self.dgtk("render", self.path("a", "scene.json"), "-o", self.path("b"), "--quiet", "--size", "64x48", "--layers", "depth")
        self.assert_same_files(self.path("a"), self.path("b"), ignore=("manifest.json",))


if __name__ == "__main__":
    main()
