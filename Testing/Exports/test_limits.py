# SPDX-License-Identifier: BSD-3-Clause
"""What formats cannot say is refused from where it begins: of one small dataset copies are changed a little, and a little less."""
import hashlib
import json
import os
import pickle
import shutil

import h5py
import numpy as np

import datasets
from datasets import layer_of, load_json, main, read_png
from test_kitti import labels

FORMATS = "bop,nerf-synthetic,middlebury,kitti-odometry,kitti-object,kitti-depth,kitti2015,colmap,transforms,voc,tum,tapvid,hdf5"
DEPTHS = ("bop", "colmap-dense", "hdf5", "kitti-depth", "mcap", "mvsnet", "rosbag", "sintel", "transforms", "tum")
PAIR = ("--cameras", "left,right")


def scene_in(folder):
    """A pair, and beside it a fisheye with two pinhole twins, of which the first has another height."""
    path = datasets.street(folder, width=24, height=18)
    scene = load_json(path)
    for camera, name in zip(scene["cameras"], ("left", "right")):
        camera["name"] = name
    small = {"width": 24, "height": 18}
    scene["cameras"] += [
        {**datasets._camera("lens", [0.3, 0.2, 4.2], [0, 0, 0], **small), "model": "fisheye", "K": [[10, 0, 12], [0, 10, 9], [0, 0, 1]]},
        datasets._camera("a flat one", [0.3, 0.2, 4.2], [0, 0, 0], **{**small, "height": 16}),
        datasets._camera("flat", [0.3, 0.2, 4.2], [0, 0, 0], **small)]
    return datasets._write(folder, "limits", scene)


class Limits(datasets.ExportCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.dataset = cls.rendered_once(scene_in, "--for", FORMATS, "--color-bits", "16")

    def changed(self, name, edit):
        """The dataset with another document: `edit` is given what it holds."""
        copy = self.path(f"changed-{len(os.listdir(self.folder))}")
        shutil.copytree(self.dataset, copy, copy_function=os.link)
        def rewritten(document, place):
            os.remove(os.path.join(copy, place))
            with open(os.path.join(copy, place), "w", encoding="utf-8") as file:
                json.dump(document, file)
        document, manifest = load_json(os.path.join(copy, name)), load_json(os.path.join(copy, "manifest.json"))
        edit(document)
        rewritten(document, name)
        for entry in manifest["files"]:
            entry["bytes"] = os.path.getsize(os.path.join(copy, entry["path"]))
        rewritten(manifest, "manifest.json")
        return copy

    def with_cameras(self, edit, amount):
        """`edit` changes a camera at a frame by an amount."""
        return self.changed("cameras.json", lambda document: [edit(camera, camera["name"], camera["frame"], amount) for camera in document["cameras"]])

    def nothing(self, form, dataset, says, *options):
        target = self.path(f"no-{len(os.listdir(self.folder))}")
        self.refused("export", dataset, "--format", form, "-o", target, *options, status=2, says=says)
        self.assertFalse(os.path.exists(target))

    def refuses(self, form, says, edit, amount, small, *options):
        with self.subTest(form=form, says=says):
            self.nothing(form, self.with_cameras(edit, amount), says, *options)
            self.export(self.with_cameras(edit, small), form, *options, verify=False)

    def test_cameras(self):
        def lower(camera, name, frame, amount):
            camera["K"][1][2] += amount

        def skewed(camera, name, frame, amount):
            camera["K"][0][1] += amount

        def behind(camera, name, frame, amount):
            camera["t"][2] += amount * (name == "right")

        def apart(camera, name, frame, amount):  # the baseline is 0.2
            camera["t"][0] -= 0.2 * amount * (name == "right" and frame == 1)

        def drifting(camera, name, frame, amount):
            camera["t"][1] += amount * (name == "right" and frame == 1)

        def beside(camera, name, frame, amount):
            camera["t"][0] += amount * (name != "lens")

        def rolling(camera, name, frame, amount):
            if amount > 0:
                camera["rollingShutter"] = {"duration": amount, "direction": "down"}

        def prisms(camera, name, frame, amount):
            camera["distortion"] = [0.1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, amount]

        def zooming(camera, name, frame, amount):
            camera["K"][0][0] += amount * (frame == 1)

        self.refuses("nerf-synthetic", "has its principal point beside the middle", lower, 3, 1e-12, "--cameras", "left")
        self.refuses("nerf-synthetic", "has pixels that are not square", skewed, 1e-3, 0, "--cameras", "left")
        self.refuses("middlebury", "has no square pixels", skewed, 1e-3, 0, *PAIR)
        self.refuses("middlebury", "no two cameras are a rectified pair", behind, 1e-3, 1e-12, *PAIR)
        self.refuses("kitti-odometry", "are not equally far apart at all frames", apart, 1e-2, 1e-12, *PAIR)
        self.refuses("colmap", "no two cameras keep their places to each other", drifting, 1e-5, 1e-12, "--rigs", *PAIR)
        for form in ("tum", "colmap", "transforms"):
            self.refuses(form, "a rolling shutter", rolling, 0.01, 0, "--cameras", "left")
        self.refuses("colmap", "thin prisms", prisms, 1e-3, 0, "--cameras", "left")
        self.refuses("kitti-depth", "has another matrix at frame 1", zooming, 1e-3, 0, "--cameras", "left")
        self.nothing("coco", self.with_cameras(rolling, 0.01), ("camera 'left' (pinhole with a rolling shutter) needs a pinhole twin",
                     "without distortion and rolling shutter"), "--undistort", "--cameras", "left")
        self.refuses("tum", "needs a pinhole twin", beside, 1e-5, 1e-12, "--undistort", "--cameras", "lens")

    def refuses_documents(self, form, says, edit, most, *options):
        """One more than `most` is refused."""
        def copy(count):
            return self.changed("objects.json", lambda document: edit(document, count))

        with self.subTest(form=form, says=says):
            self.nothing(form, copy(most + 1), says, *options)
            self.export(copy(most), form, *options, verify=False)

    def test_codes(self):
        """KITTI 2015 numbers objects, VOC classes, with 8 bits; 255 is VOC's border."""
        def objects(document, count):
            last = document["objects"][-1]
            document["objects"] += [{**last, "id": 1000 + i, "name": f"more {i}"} for i in range(count - len(document["objects"]))]

        def classes(document, count):
            last = document["classes"][-1]
            document["classes"] += [{**last, "id": 1000 + i, "name": f"more {i}"} for i in range(count - len(document["classes"]))]

        self.refuses_documents("kitti2015", "255 objects (found 256)", objects, 255, *PAIR)
        self.refuses_documents("voc", "more than 254 classes", classes, 254)
        self.nothing("kitti2015", self.dataset, "foreground: no class 'Lorry' (expected one of ", *PAIR, "--foreground", "Car,Lorry")

    def test_a_layer_without_any_code(self):
        dataset = self.render(datasets.in_units(datasets.walk(self.path("scene"), 2)), "color,depth")
        for form, metres in (("tum", "201.168"), ("tum", "1e-300"), ("kitti-depth", "1000"), ("rosbag", "1e-300"), ("hdf5", "1e-300")):
            if form == "hdf5":
                dataset = self.render(self.path("scene", "walk.json"), "color,depth,objects,classes")
            with self.subTest(form=form, metres=metres):
                self.nothing(form, dataset, (f"{form}: none of the ", " values of layer depth has a code in the format"), "--unit-metres", metres)
        self.export(dataset, "tum", "--unit-metres", "1")

    def test_a_class_that_kitti_means_otherwise(self):
        def rename(document):
            for box in document["objects"]:
                box["class"] = "DontCare" if box["class"] == "Car" else box["class"]

        copy = self.changed("left/boxes/000000.json", rename)
        folder, _ = self.export(copy, "kitti-object", "--cameras", "left")
        name = "training/label_2/000000.txt"
        kinds = {kind for kind, _ in labels(os.path.join(folder, name))}
        self.assertIn("DontCare_2", kinds)
        self.assertNotIn("DontCare", kinds)
        self.assertIn("layer type", self.planted(copy, folder, name, lambda text: text.replace(b"DontCare_2", b"DontCare")))

    def test_a_picture_of_depth_is_no_depth(self):
        scene = datasets.street(self.path("scene"), width=24, height=18)
        layers = ("depth_noisy", "--for", ",".join(DEPTHS), "--depth-noisy-format", "png", "--depth-format")
        shown = self.render(scene, *layers, "png")
        for form in DEPTHS:
            with self.subTest(form):
                self.nothing(form, shown, (f"{form}: camera 'cam L' has no file of layer depth at frame 0", "its values are to be rendered as npy"))
        both = self.render(scene, *layers, "png,npy")
        self.nothing("tum", both, ("layer depth_noisy", "its values are to be rendered as npy"), "--depth", "depth_noisy")
        with h5py.File(os.path.join(self.export(both, "hdf5")[0], "0.hdf5"), "r") as file:
            depth = layer_of(both, "depth", "cam L", 0)
            self.assertTrue(np.array_equal(file["depth_0"][()], np.where(np.isfinite(depth), depth, 1e10).astype(np.float32)))
        # of a layer that is no depth a .png holds values; an export of these is not one of depths
        path = os.path.join(shown, "manifest.json")
        with open(path, encoding="utf-8") as file:
            manifest = file.read()
        document = json.loads(manifest)
        next(layer for layer in document["layers"] if layer["name"] == "depth")["meaning"] = "mask"
        self.write(path, json.dumps(document))
        folder, record = self.export(shown, "kitti-depth", "--unit-metres", "1")
        self.write(path, manifest)
        record["dataset_manifest"] = hashlib.sha256(manifest.encode()).hexdigest()
        request = [record["version"], "kitti-depth", record["dataset_manifest"], *(f"{key}={value}" for key, value in record["request"].items())]
        record["request_hash"] = hashlib.sha256("\n".join(request).encode()).hexdigest()
        self.written({os.path.join(folder, "export.json"): datasets.sealed(record)})
        self.assertIn("has no file of layer depth", self.dgtk("verify", shown, "--export", folder, status=1).stderr)

    def test_a_twin_has_width_and_height(self):
        _, record = self.export(self.dataset, "tum", "--undistort", "--cameras", "lens")
        self.assertEqual({one["camera"] for one in record["names"]}, {"flat"})

    def test_what_is_hidden_of_a_label(self):
        """0: at most a tenth, 1: at most a half, 2: more."""
        rows = [(20, 0), (18, 0), (17, 1), (10, 1), (9, 2)]  # visible of 20, class

        def hide(document):
            self.assertEqual(len(document["objects"]), len(rows))
            for box, (visible, _) in zip(document["objects"], rows):
                box.update(pixels_visible=visible, pixels_amodal=20, pixels_whole=20, visible_fraction=visible / 20)

        folder, _ = self.export(self.changed("left/boxes/000000.json", hide), "kitti-object", "--cameras", "left", verify=False)
        found = labels(os.path.join(folder, "training", "label_2", "000000.txt"))
        self.assertEqual([numbers[1] for _, numbers in found], [hidden for _, hidden in rows])

    def test_sixteen_bits_are_rounded_to_eight(self):
        wide = read_png(os.path.join(self.dataset, "left", "color", "000000.png"), (16, 3)).astype(int)
        self.assertTrue((wide % 257 > 128).any())
        rounded = (wide + 128) // 257
        folder, _ = self.export(self.dataset, "tapvid", "--cameras", "left")
        with open(os.path.join(folder, "tapvid.pkl"), "rb") as file:
            self.assertTrue(np.array_equal(pickle.load(file)["left"]["video"][0], rounded))
        folder, _ = self.export(self.dataset, "hdf5", "--cameras", "left")
        with h5py.File(os.path.join(folder, "0.hdf5"), "r") as file:
            self.assertTrue(np.array_equal(file["colors"][()], rounded))


    def test_pictures_of_another_size_than_the_camera(self):
        for key, amount in (("width", 2 ** 31 - 1), ("width", 25), ("height", 17), ("height", 1)):
            dataset = self.with_cameras(lambda camera, name, frame, amount, key=key: camera.update({key: amount} if name == "left" else {}), amount)
            for form in ("voc", "tum", "kitti-depth", "hdf5", "transforms", "bop"):
                with self.subTest(form=form, key=key, amount=amount):
                    self.refused("export", dataset, "--format", form, "-o", self.path(f"size-{form}-{key}-{amount}"), "--cameras", "left", "--quiet", status=3,
                                 says=("/left/", "size differs from the camera's", "found 24 x 18)"))


if __name__ == "__main__":
    main()
