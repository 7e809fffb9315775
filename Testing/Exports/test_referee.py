# SPDX-License-Identifier: BSD-3-Clause
"""The referee of exports is refereed: of every format, wrong values of its documents and pixels are planted, and `dgtk verify --export`
must name the row and the file of each, and no other row.

One small dataset serves all formats. Errors of one format are planted together, each of another row, so that one run judges them."""
import concurrent.futures
import hashlib
import json
import math
import os
import shutil
import struct

import numpy as np

import datasets
from datasets import load_json, main, sealed
from planted_exports import COLMAP, NO_NUMBERS, PANOPTIC, PLANTS, F, packed, word

# What each format needs of every picture, in the order in which it is missed.
NEEDS = {form: layers.split() for form, layers in {
    "bop": "color depth objects boxes amodal", "coco": "color objects boxes amodal", "coco-panoptic": "color objects", "colmap": "color objects tracks",
    "colmap-dense": "color depth normal objects tracks", "eth3d": "color disparity", "middlebury": "color disparity",
    "flyingthings": "color disparity objects", "gltf": "", "hdf5": "color depth objects classes", "imagefolder": "color", "kitti2015": "color",
    "kitti-depth": "color depth", "kitti-object": "color boxes", "kitti-odometry": "color", "rosbag": "color depth", "mcap": "color depth",
    "mvsnet": "color depth objects tracks", "nerf-synthetic": "color_rgba", "sintel": "color",
    "spring": "color disparity disparity_backward flow_backward", "tapvid": "color tracks", "transforms": "color depth objects tracks",
    "tum": "color depth", "voc": "color objects boxes", "webdataset": "color", "yolo": "color objects boxes"}.items()}

# What rows of documents leave to rounding, of all formats or of one; those of pixels are as wide as their codes.
TOLERANCES = {
    **dict.fromkeys(("baseline", "box 3d", "box 3d centre", "doffs", "front", "intrinsics", "length", "lights", "models_info", "places", "pose",
                     "pose of objects", "vertices"), 1e-9),
    **dict.fromkeys(("alpha", "angle", "points", "quaternion", "time", "truncated", "visib_fract"), 1e-12),
    "reprojection": 1e-6, "nerf-synthetic intrinsics": 1e-6, "yolo box": 1e-6,
    "kitti-odometry time": 1e-9 * 1.04, "mcap time": 1e-9, "rosbag time": 1e-9, "tum time": 5.01e-7,  # half a microsecond
    "mvsnet range": 1e-9 * 7.4, "tapvid queries": 6e-8 * (48 + 36), "transforms points": 6e-8 * 2.9,  # of the wall's front
    "gltf brightness": 1e-9 * 0.8 * np.pi, "gltf colors": 1e-3, "gltf field of view": 1e-9 * F, "gltf normals": 5e-7, "gltf pose": 2e-6,
    "gltf pose of cameras": 5e-7, "gltf pose of nodes": 5e-7, "gltf quaternion": 5e-7, "gltf range": 1e-9 * 100, "gltf time": 1e-7 * 1.04, "gltf vertices": 1e-6}
OF_PIXELS = {"color", "depth", "disparity", "disparity_forward", "flow_forward"}


class Referee(datasets.ExportCase):
    def setUp(self):
        super().setUp()
        scene = datasets.street(self.path("scene"), width=48, height=36)
        self.dataset = self.render(scene, "boxes,amodal,objects,classes", "--for", ",".join(PLANTS))

    def plant(self, path, edit, *share):
        with open(path, "rb") as file:
            old = file.read()
        os.remove(path)  # it may be a link to the dataset's
        if hasattr(edit, "of_path"):
            with open(path, "wb") as file:
                file.write(old)
            edit(path)
        else:
            with open(path, "wb") as file:
                file.write(edit(old, *share))

    def accept(self, folder):
        path = os.path.join(folder, "export.json")
        record = load_json(path)
        for row in record["files"]:
            with open(os.path.join(folder, row["path"]), "rb") as file:
                data = file.read()
            row.update(sha256=hashlib.sha256(data).hexdigest(), bytes=len(data))
        with open(path, "wb") as file:
            file.write(sealed(record))

    def judge(self, form):
        """(rows of a sound export, rows where errors were planted, (of these, those of numbers, rows of a tenth of their tolerances, of ten
        times))."""
        folder = self.path(form)
        self.dgtk("export", self.dataset, "--format", form, "-o", folder, "--quiet")
        sound = self.rows(folder)
        copy = self.path(form + "-copy")
        shutil.copytree(folder, copy)
        planted = self.planted(folder, PLANTS[form])
        one, small, large = {}, {}, {}
        for alone in (True, False):
            plants = [plant for plant in PLANTS[form] if plant.alone == alone and getattr(plant.edit, "scales", False)]
            found = self.planted(copy, plants) if alone and plants else planted
            one.update({plant.row: found[plant.row] for plant in plants})
            shares = {plant: found[plant.row]["tolerance"] / found[plant.row]["largest"] for plant in plants}
            shares = {plant: share for plant, share in shares.items() if share > 0}
            for rows, times in ((small, 0.1), (large, 10)):
                judged = self.planted(copy, shares, times, shares) if shares else {}
                rows.update((layer, row) for layer, row in judged.items() if alone or layer not in {plant.row for plant in PLANTS[form] if plant.alone})
        scaled = [plant for plant in PLANTS[form] if getattr(plant.edit, "scales", False) and not plant.file.endswith(("json", "jsonl", "gltf"))]
        for plant in [*scaled, *NO_NUMBERS.get(form, ())]:
            rows = self.planted(copy, [plant], math.nan, {plant: 1})
            self.assertTrue(rows[plant.row]["breach"], f"{plant.row} in {plant.file} is no number")
        return sound, planted, (one, small, large)

    def rows(self, folder):
        done = self.ran("verify", self.dataset, "--export", folder, "--json")
        return {row["layer"]: dict(row, largest=float(row["largest"])) for row in json.loads(done.stdout)["residuals"]}

    def planted(self, folder, plants, times=1, shares=None):
        """The rows with these errors, which are taken back where they are shares."""
        before = {}
        for plant in plants:
            path = os.path.join(folder, plant.file)
            with open(path, "rb") as file:
                before.setdefault(path, file.read())
            self.plant(path, plant.edit, *([times * shares[plant]] if shares else []))
        self.accept(folder)
        rows = self.rows(folder)
        if folder.endswith("-copy"):
            for path, data in before.items():
                self.plant(path, lambda _, whole=data: whole)
        return rows

    def test_a_picture_that_lacks_is_named(self):
        """The last of one camera has no files; they come back as they are asked for. No export begins before all is there."""
        self.assertEqual(set(NEEDS), set(PLANTS))
        manifest = load_json(os.path.join(self.dataset, "manifest.json"))
        for form, layers in NEEDS.items():
            copy, target = self.path(form + "-lacking"), self.path(form + "-none")
            shutil.copytree(self.dataset, copy, copy_function=os.link)
            for known in range(len(layers) + 1):
                files = [file for file in manifest["files"] if (file.get("camera"), file.get("frame")) != ("cam R", 1) or
                         file["layer"] in layers[:known]]
                os.remove(os.path.join(copy, "manifest.json"))
                with open(os.path.join(copy, "manifest.json"), "w", encoding="utf-8") as file:
                    json.dump({**manifest, "files": files}, file)
                done = self.ran("export", copy, "--format", form, "-o", target, "--quiet")
                with self.subTest(form=form, known=known):
                    if known == len(layers):
                        self.assertEqual(done.returncode, 0, done.stderr)
                    else:
                        self.assertEqual(done.returncode, 2, done.stderr)
                        self.assertRegex(done.stderr, f"'cam R' has no file of layer {layers[known]} .*at frame 1")
                        self.assertFalse(os.path.exists(target))

    def test_planted_errors(self):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            judged = dict(zip(PLANTS, pool.map(self.judge, PLANTS)))
        for form, (sound, rows, shared) in judged.items():
            for layer in {layer for layer, row in sound.items() if row["tolerance"] > 0} - OF_PIXELS:
                with self.subTest(form=form, tolerance=layer):
                    if (form, layer) != ("mvsnet", "scores"):  # their sums decide
                        expected = TOLERANCES.get(f"{form} {layer}", TOLERANCES.get(layer))
                        self.assertAlmostEqual(sound[layer]["tolerance"] / expected, 1, places=6)
            with self.subTest(form=form):
                breaches = [{layer for layer, row in each.items() if row["breach"]} for each in (sound, rows, shared[1])]
                also = set().union(*(plant.also for plant in PLANTS[form]))
                self.assertEqual(breaches[:2], [set(), also.union(plant.row for plant in PLANTS[form])])
                self.assertLessEqual(breaches[2], also, "of a tenth")
            for plant in PLANTS[form]:
                with self.subTest(form=form, row=plant.row):
                    row, tolerance = rows[plant.row], sound[plant.row]["tolerance"]
                    self.assertEqual(row["worst"]["file"], plant.named or plant.file)
                    self.assertAlmostEqual(row["tolerance"], tolerance, delta=1e-12)
                    if plant.row in shared[2] and shared[0].get(plant.row, row)["largest"] < np.inf and getattr(plant.edit, "scales", False) and tolerance > 0:
                        as_planted, small, large = (each[plant.row]["largest"] / tolerance for each in shared)
                        self.assertTrue(0.01 < small < 1 < large < 20, (small, large))
                        self.assertLess(as_planted, 500, "a looser tolerance would be seen")
        # Of values with different tolerances a row shows the largest.
        self.assertEqual(judged["kitti2015"][0]["baseline"]["tolerance"], 1e-9)


    def test_damaged_structures(self):
        """What a reader cannot follow is one line, with the file's name."""
        def longer_header(data):
            header = struct.unpack_from("<Q", data, 64)[0]  # of the root group: its address stands in the superblock
            return packed("<I", header + 8, 8)(data)

        folder = self.path("hdf5")
        self.dgtk("export", self.dataset, "--format", "hdf5", "-o", folder, "--quiet")
        self.plant(os.path.join(folder, "0.hdf5"), longer_header)
        self.accept(folder)
        self.refused("verify", self.dataset, "--export", folder, status=1, says=("0.hdf5", "not as long as it says"))

    def test_what_names_nothing(self):
        """A point and a picture that nothing has are errors of their rows, not of the program."""
        strangers = [("colmap", COLMAP + "points3D.bin", packed("<Q", 8, 1000), {"points", "tracks"}),
                     ("coco-panoptic", PANOPTIC, word('"image_id":2', '"image_id":99'), {"ids"})]
        for form, file, edit, breaches in strangers:
            with self.subTest(form):
                folder = self.path(form + "-stranger")
                self.dgtk("export", self.dataset, "--format", form, "-o", folder, "--quiet")
                self.plant(os.path.join(folder, file), edit)
                self.accept(folder)
                self.assertEqual({layer for layer, row in self.rows(folder).items() if row["breach"]}, breaches)


if __name__ == "__main__":
    main()
