# SPDX-License-Identifier: BSD-3-Clause
"""Datasets of many scenes: one export of all where pictures stand side by side, else one a scene."""
import json
import os
import shutil

import datasets
from datasets import load_json, main

JOINED = ("coco", "coco-panoptic", "yolo", "voc", "imagefolder", "bop")


class Scenes(datasets.ExportCase):
    def setUp(self):
        super().setUp()
        os.makedirs(self.path("scenes"))
        self.write("scenes/quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n")
        for number, names in enumerate((("b", "c", "d"), ("a", "b"), ("e",))):
            scene = {"units": "m", "fps": 10, "classes": "../classes.json",
                     "objects": [{"name": name, "class": "even" if ord(name) % 2 == 0 else "odd", "model": "quad.obj", "scale": 0.5,
                                  "position": [0.8 * k - 0.8, 0.3 * number, -0.1 * k]} for k, name in enumerate(names)],
                     "cameras": [{"name": "view", "width": 48, "height": 36, "eye": [0, 0, 5], "lookAt": [0, 0, 0]}]}
            self.write(f"scenes/s{number}.json", json.dumps(scene))
        self.write("classes.json", json.dumps({"odd": 1, "even": 2}))
        self.dgtk("render", self.path("scenes"), "-o", self.path("all"), "--for", ",".join((*JOINED, "hdf5")), "--quiet")

    def export(self, form, *options):
        folder = self.path("export", form + "-".join(options).replace("=", "_").replace(",", "_").replace(":", "_"))
        self.dgtk("export", self.path("all"), "--format", form, "-o", folder, "--quiet", *options)
        self.dgtk("verify", self.path("all"), "--export", folder)
        return folder

    def test_one_export_of_all(self):
        for form in JOINED:
            with self.subTest(form):
                self.assertTrue(os.path.exists(os.path.join(self.export(form), "export.json")))

    def test_coco_counts_through(self):
        document = load_json(os.path.join(self.export("coco"), "annotations", "instances_train.json"))
        self.assertEqual([image["id"] for image in document["images"]], [1, 2, 3])
        self.assertEqual([image["camera"] for image in document["images"]], ["s0/view", "s1/view", "s2/view"])
        self.assertEqual(len({one["id"] for one in document["annotations"]}), 6)
        seen = sorted((one["image_id"], one["object"], one["category_id"]) for one in document["annotations"])
        self.assertEqual(seen, [(1, "b", 2), (1, "c", 1), (1, "d", 2), (2, "a", 1), (2, "b", 2), (3, "e", 1)])

    def test_splits_count_scenes(self):
        folder = self.export("coco", "--split", "train=0:1,val=2:2")
        self.assertEqual(len(load_json(os.path.join(folder, "annotations", "instances_val.json"))["images"]), 1)
        self.assertEqual(len(load_json(os.path.join(folder, "annotations", "instances_train.json"))["images"]), 2)

    def test_each_part_holds_scenes(self):
        for form in ("imagefolder", "coco"):
            for part in ("val=3:9", "val=-3:-1"):
                self.refused("export", self.path("all"), "--format", form, "-o", self.path("no"), "--split", "train=0:1," + part, status=2,
                             says=f"split: expected some of the scenes 0 to 2, found '{part}'")
                self.assertFalse(os.path.exists(self.path("no")))
        self.export("imagefolder", "--split", "train=0:1,val=2:9")

    def changed(self, name, edit):
        document = load_json(self.path("all", name))
        edit(document)
        with open(self.path("all", name), "w", encoding="utf-8") as file:
            json.dump(document, file)

    def test_units_that_differ_are_refused(self):
        self.changed("s1/manifest.json", lambda manifest: manifest.update(metres_per_unit=2))
        self.refused("export", self.path("all"), "--format", "coco", "-o", self.path("no"), status=2,
                     says="dgtk: the scenes 's0' and 's1' have units of other lengths, which one export of all cannot say")
        self.assertFalse(os.path.exists(self.path("no")))

    def test_each_scene_has_its_own_rate(self):
        for number in range(3):
            scene = load_json(self.path("scenes", f"s{number}.json"))
            scene.update(fps=10 * 2**number, keyFrames=[5, 6])
            self.write(f"scenes/s{number}.json", json.dumps(scene))
        self.dgtk("render", self.path("scenes"), "-o", self.path("all"), "--for", "imagefolder", "--quiet", "--replace")
        self.export("imagefolder")

    def test_no_scene_is_begun_before_all_are_looked_at(self):
        def skew(document):
            document["cameras"][0]["K"][0][1] = 1e-3

        self.changed("s1/cameras.json", skew)
        for share in ((), ("--shard", "0/2")):
            self.refused("export", self.path("all"), "--format", "tum", "-o", self.path("no"), *share, status=2, says="has a skew")
            self.assertFalse(os.path.exists(self.path("no")))

    def test_bop_shares_models(self):
        folder = self.export("bop")
        self.assertEqual(list(load_json(os.path.join(folder, "models", "models_info.json"))), ["1"])
        poses = [load_json(os.path.join(folder, "test", f"{scene:06}", "scene_gt.json"))["0"] for scene in (1, 2, 3)]
        self.assertEqual([len(one) for one in poses], [3, 2, 1])

    def test_others_are_exported_one_by_one(self):
        self.dgtk("export", self.path("all"), "--format", "hdf5", "-o", self.path("h"), "--quiet")
        self.assertEqual(sorted(os.listdir(self.path("h"))), ["s0", "s1", "s2"])
        self.dgtk("verify", self.path("all"), "--export", self.path("h"))

    def left_by_a_kill(self, folder):
        """What stands beside export.json before the last steps."""
        for name in (".dgtk-journal", ".dgtk-journal.partial", ".dgtk-journal-notes"):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(f"DGTk journal 1 {load_json(os.path.join(folder, 'export.json'))['request_hash']}\n")

    def test_shares(self):
        """Of scenes, or of what they become together."""
        for form in ("hdf5", "bop"):
            whole, shares = self.path(form + "-whole"), self.path(form + "-shares")
            command = ("export", self.path("all"), "--format", form, "--quiet", "-o")
            self.dgtk(*command, whole)
            self.dgtk(*command, shares, "--shard", "1/2")
            self.refused("merge", shares, status=1, says=("--array=0",))
            for share in ("0/2", "1/2"):
                self.dgtk(*command, shares, "--shard", share)
            if form == "hdf5":  # a scene is written where it belongs: what is damaged there is missing
                [file] = [os.path.join(base, name) for base, _, names in os.walk(os.path.join(shares, "s1")) for name in names if name.endswith(".hdf5")]
                with open(file, "ab") as damaged:
                    damaged.write(b"!")
                self.refused("merge", shares, status=1, says=("1 of 3 blocks", "shares 1 of 2; --array=0)"))
                self.dgtk(*command, shares, "--shard", "1/2")
                self.left_by_a_kill(os.path.join(shares, "s0"))
            with self.goes_at_once(os.path.join(shares, ".dgtk-parts")):
                self.dgtk("merge", shares)
            self.assert_same_files(whole, shares)
            os.mkdir(os.path.join(shares, ".dgtk-parts-merged"))  # by a merge that was killed at its end
            self.assertEqual(self.dgtk("merge", shares).stdout, f"{shares}: is whole already\n")
            self.assert_same_files(whole, shares)
            self.dgtk(*command, shares, "--shard", "0/2")
            self.assert_same_files(whole, shares)
            alone = self.path(form + "-alone")  # all of it is a share, too
            self.dgtk(*command, alone, "--shard", "0/1")
            if form == "bop":  # put together, and killed before it went where it belongs
                together = os.path.join(alone, ".dgtk-parts", "whole")
                shutil.copytree(whole, together)
                self.left_by_a_kill(together)
            self.dgtk("merge", alone)
            self.assert_same_files(whole, alone)

    def test_a_wrong_class_is_found(self):
        folder = self.export("coco")
        path = os.path.join(folder, "annotations", "instances_train.json")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace('"category_id":1', '"category_id":2', 1))
        self.assertIn("category", self.dgtk("verify", self.path("all"), "--export", folder, status=1).stdout)

    def test_classes_that_differ_are_refused(self):
        scene = load_json(self.path("scenes", "s2.json"))
        scene["classes"] = {"odd": 5}
        self.write("scenes/s2.json", json.dumps(scene))
        self.refused("render", self.path("scenes"), "-o", self.path("other"), "--for", "coco", "--quiet", status=3, says=("s2.json", "s0.json"))
        self.dgtk("render", self.path("scenes", "s2.json"), "-o", self.path("all", "s2"), "--for", "coco", "--replace", "--quiet")
        done = self.refused("export", self.path("all"), "--format", "coco", "-o", self.path("no"), status=2, says=("other classes",))
        self.assertIn("'s0'", done)
        self.assertFalse(os.path.exists(self.path("no")))


if __name__ == "__main__":
    main()
