# SPDX-License-Identifier: BSD-3-Clause
"""Class numbers that scenes share: the layer, objects.json, info, verify, and what a change of the file means."""
import json

from harness import Case, load_json, main

QUAD = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n"
CAMERA = {"name": "c", "eye": [0, 0, 5], "lookAt": [0, 0, 0], "width": 32, "height": 24}


class Classes(Case):
    def setUp(self):
        super().setUp()
        self.write("quad.obj", QUAD)

    def scene(self, name, classes, objects):
        items = [{"model": "quad.obj", "class": c, "position": [3 * i - 2, 0, 0]} for i, c in enumerate(objects)]
        return self.write(name, json.dumps({"classes": classes, "objects": items, "cameras": [CAMERA]}))

    def render(self, scene, out, *more, **options):
        return self.dgtk("render", scene, "-o", self.path(out), "--layers", "classes,objects", "--classes-format", "npy",
                         "--objects-format", "npy", "--quiet", *more, **options)

    def test_scenes_share_the_numbers_of_a_file(self):
        import numpy

        self.write("classes.json", '{ "vehicle": 300, "tree": 2, "house": { "id": 65535 } } // for all scenes')
        numbers = {"vehicle": 300, "tree": 2, "house": 65535}
        for out, objects in (("one", ["tree", "vehicle"]), ("two", ["house", "tree"])):
            self.render(self.scene(out + ".json", "classes.json", objects), out)
            classes = numpy.load(self.path(out, "c", "classes", "000000.npy"))
            ids = numpy.load(self.path(out, "c", "objects", "000000.npy"))
            for i, name in enumerate(objects):
                self.assertEqual(set(classes[ids == i + 1]), {numbers[name]})
            self.assertEqual(set(classes[ids == 0]), {0})
            table = load_json(self.path(out, "objects.json"))
            self.assertEqual([o["class_id"] for o in table["objects"]], [numbers[c] for c in objects])
            self.assertEqual({c["name"]: c["id"] for c in table["classes"]}, numbers)
            inputs = [entry["path"] for entry in load_json(self.path(out, "manifest.json"))["inputs"]]
            self.assertIn("../classes.json", inputs)
            self.assertEqual(load_json(self.path(out, "scene.json"))["classes"], "../classes.json")
            self.dgtk("verify", self.path(out))
            for what in (self.path(out), self.path(out + ".json")):
                info = json.loads(self.dgtk("info", what, "--json").stdout)
                self.assertEqual({c["name"]: c["id"] for c in info["classes"]}, numbers)
        self.write("classes.json", '{ "vehicle": 301, "tree": 2, "house": 65535 }')
        self.dgtk("verify", self.path("one"), status=1)
        self.refused("render", self.path("one.json"), "-o", self.path("one"), "--layers", "classes,objects",
                     "--classes-format", "npy", "--objects-format", "npy", "--resume", "--quiet", status=2, says="one")

    def test_a_class_that_is_not_in_the_file_is_refused(self):
        self.write("classes.json", '{ "vehicle": 1, "tree": 2 }')
        scene = self.scene("s.json", "classes.json", ["tree", "car"])
        self.refused("render", scene, "-o", self.path("out"), status=3,
                     says=["s.json:1", "objects[1].class", "classes.json", "'vehicle', 'tree'", "'car'"])
        self.refused("convert", self.scene("t.json", {"tree": 4}, ["tree"]), self.path("t.scene"), status=3, says="classes")

    def test_numbers_in_the_scene_survive_writing(self):
        scene = self.scene("s.json", {"vehicle": 9, "tree": 4}, ["tree"])
        self.dgtk("convert", scene, self.path("again.json"))
        self.assertEqual(load_json(self.path("again.json"))["classes"], {"vehicle": 9, "tree": 4})
        self.render(scene, "out")
        objects = self.path("out", "objects.json")
        self.assertEqual(load_json(objects)["objects"][0]["class_id"], 4)
        with open(objects, encoding="utf-8") as file:
            text = file.read()
        self.write("out/objects.json", text.replace('"class_id": 4', '"class_id": 5').replace('"id": 4,', '"id": 5,'))
        rows = json.loads(self.dgtk("verify", self.path("out"), "--json", status=1).stdout)["residuals"]
        found = [row for row in rows if (row["check"], row["layer"]) == ("cameras", "objects")]
        self.assertEqual([row["bad"] for row in found], [1], rows)


if __name__ == "__main__":
    main()
