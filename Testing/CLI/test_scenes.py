# SPDX-License-Identifier: BSD-3-Clause
"""The thesis's scene format: appendix B.3 loads, renders, and survives conversion number for number."""
import json
import os
import re

from harness import SCENES, Case, main

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
