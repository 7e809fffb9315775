# SPDX-License-Identifier: BSD-3-Clause
"""The referee of exports is refereed: of every format, wrong values of its documents and pixels are planted, and `dgtk verify --export`
must name the row and the file of each, and no other row.

One small dataset serves all formats. Errors of one format are planted together, each of another row, so that one run judges them."""
import concurrent.futures
import hashlib
import io
import json
import os
import re
import shutil
import struct
import subprocess
import tarfile
from typing import Callable, NamedTuple

import numpy as np

import datasets
from datasets import load_json, main, sealed
from harness import DGTK
from pictures import read_png, write_png

SMALL = {"width": 48, "height": 36}


def stepped(edit, step):
    """Takes a share of its step, too, where that is no whole number."""
    edit.scales = isinstance(step, float)
    return edit


def number(pattern, step, nth=0):
    """Adds to the number behind the nth place that matches: `pattern` is what stands before it."""
    place = re.compile("(?:" + pattern + r")(-?[0-9.]+(?:e-?[0-9]+)?)")

    def edit(data, share=1):
        found = list(place.finditer(data.decode()))[nth]
        value = float(found.group(1)) + step * share
        text = repr(int(value)) if isinstance(step, int) and re.fullmatch("-?[0-9]+", found.group(1)) else repr(value)
        return (data.decode()[:found.start(1)] + text + data.decode()[found.end(1):]).encode()

    return stepped(edit, step)


def word(old, new):
    return lambda data: data.replace(old.encode(), new.encode(), 1)


def packed(kind, at, step):
    """Adds to a number of a binary file."""
    def edit(data, share=1):
        value = struct.unpack_from(kind, data, at)[0]
        return data[:at] + struct.pack(kind, value + step * share) + data[at + struct.calcsize(kind):]

    return stepped(edit, step)


def double(value, step, nth=0):
    """Adds to the nth double of this value."""
    def edit(data, share=1):
        at = -1
        for _ in range(nth + 1):
            at = data.index(struct.pack("<d", value), at + 1)
        return packed("<d", at, step)(data, share)

    return stepped(edit, step)


def pixel(x, y, step=1):
    """A code of a PNG file."""
    def edit(path):
        image = read_png(path).copy()
        image[y, x] = image[y, x] + (step if np.max(image[y, x]) < 200 else -step)
        write_png(path, image)

    edit.of_path = True
    return edit


def last_bytes(step=1):
    """The last number of a file of pixels, of float32."""
    return lambda data: packed("<f", len(data) - 4 * 500, step)(data)


def archive(member, change):
    """An array of a .npz file."""
    def edit(data):
        arrays = dict(np.load(io.BytesIO(data)))
        arrays[member] = change(arrays[member])
        file = io.BytesIO()
        np.savez(file, **arrays)
        return file.getvalue()

    return edit


def member(suffix, change):
    """A file of a tar: its bytes, which may be more or fewer."""
    def edit(data):
        out = io.BytesIO()
        with tarfile.open(fileobj=io.BytesIO(data)) as old, tarfile.open(fileobj=out, mode="w", format=tarfile.USTAR_FORMAT) as new:
            changed = False
            for one in old:
                content = old.extractfile(one).read()
                if one.name.endswith(suffix) and not changed:
                    content, changed = change(content), True
                    one.size = len(content)
                new.addfile(one, io.BytesIO(content))
        return out.getvalue()

    return edit


def joined(name, content):
    """One more file in a tar, behind the first one's."""
    def edit(data):
        out = io.BytesIO()
        with tarfile.open(fileobj=io.BytesIO(data)) as old, tarfile.open(fileobj=out, mode="w", format=tarfile.USTAR_FORMAT) as new:
            for number, one in enumerate(old):
                new.addfile(one, old.extractfile(one))
                if number == 0:
                    more = tarfile.TarInfo(one.name.split(".")[0] + name)
                    more.size = len(content)
                    new.addfile(more, io.BytesIO(content))
        return out.getvalue()

    return edit


def narrower(data):
    """An array of a picture without its last column."""
    out = io.BytesIO()
    np.save(out, np.load(io.BytesIO(data))[:, :-1])
    return out.getvalue()


def shifted(values):
    values = values.copy()
    values.flat[0] += 0.01
    return values


def several(*edits):
    def edit(data, share=1):
        for one in edits:
            data = one(data, share)
        return data

    return stepped(edit, 1.0)


F = 43.45584412271571
GT = "test/000001/scene_gt_info.json"
LABEL = "training/label_2/000000.txt"
BOX, COLMAP = "annotations/instances_train.json", "sparse/0/"
PANOPTIC = "annotations/panoptic_train.json"
XML = "Annotations/cam_L_000000.xml"
# A calibration of KITTI's has the focal length and the centre twice, which must agree.
KITTI = several(number("K_02: ", 5e-8), number("P_rect_02: ", 5e-8))


def stereo(folder, disparity):
    calib = folder + "calib.txt"
    return [("doffs", calib, number("doffs=", 5e-8)), ("baseline", calib, number("baseline=", 5e-8)),
            ("intrinsics", calib, number(r"cam0=\[", 5e-8)), ("size", calib, number("width=", 1)),
            ("range", calib, number("vmax=", -2)), ("disparity", disparity, last_bytes())]


def colmap(folder, depth):
    def places(data, share=1):
        name = 8 + 4 + 7 * 8 + 4  # the first picture's, then how many places, then their u, v and point
        return packed("<d", data.index(b"\0", name) + 1 + 8, 5e-8)(data, share)

    plants = [("places", folder + "images.bin", stepped(places, 1.0)), ("intrinsics", folder + "cameras.bin", packed("<d", 32, 5e-8)), ("size", folder + "cameras.bin", packed("<Q", 16, 1)),
              ("pose", folder + "images.bin", packed("<d", 44, 5e-8)), ("colors", folder + "points3D.bin", packed("<B", 40, -3)),
              ("reprojection", folder + "points3D.bin", packed("<d", 16, 3e-5))]
    return plants + [("depth", depth, last_bytes())] if depth else plants


def recording(file, left, *also):
    """K of a camera, with P that must be the same; where an object is; and a baseline, of the right camera, or of the left one, which leads
    to no camera."""
    def intrinsics(data, share=1):
        at = data.index(struct.pack("<9d", F, 0, 23.5, 0, F, 17.5, 0, 0, 1))
        return several(packed("<d", at, 5e-8), packed("<d", at + 144, 5e-8))(data, share)

    def baseline(data, share=1):
        at = data.index(struct.pack("<6d", F, 0, 23.5, 0 if left else -0.2 * F, 0, F))
        return packed("<d", at + 24, 1e-5)(data, share)

    return [("intrinsics", file, stepped(intrinsics, 1.0), also), ("baseline", file, stepped(baseline, 1.0)),
            ("pose of objects", file, double(-1.9, 5e-8))]


class Plant(NamedTuple):
    row: str  # that must name the error
    file: str
    edit: Callable
    also: tuple = ()  # rows that see it by their nature, such as sums of a file
    named: str = None  # the file that is named, where it is another
    alone: bool = False  # another plant changes what its row compares with


PLANTS = {form: [Plant(*one) for one in rows] for form, rows in {
    "bop": [
        ("intrinsics", "test/000001/scene_camera.json", number(r'"cam_K":\[', 5e-8)),
        ("pose", "test/000001/scene_camera.json", number(r'"cam_t_w2c":\[', 1e-3)),
        ("poses", "test/000001/scene_gt.json", number(r'"cam_t_m2c":\[', 1.0, 4), ("instances",)),
        ("vertices", "test/000001/scene_gt.json", number(r'"cam_t_m2c":\[', 1e-3, 3), (), "models/models_info.json"),
        ("bbox_obj", GT, number(r'"bbox_obj":\[', 1)), ("bbox_visib", GT, number(r'"bbox_visib":\[', 1)),
        ("px_count_all", GT, number('"px_count_all":', 1, 1)), ("px_count_visib", GT, number('"px_count_visib":', 1, 2)),
        ("px_count_valid", GT, number('"px_count_valid":', 1)), ("visib_fract", GT, number('"visib_fract":', 1e-11)),
        ("models_info", "models/models_info.json", number('"min_x":', 5e-8), ("models_eval",), "models/obj_000001.ply"),
        ("models", "models_eval/obj_000004.ply", number("end_header\n", 1.0)),
        ("coco", "test/000001/scene_gt_coco.json", number('"area":', 1)),
        ("mask", "test/000001/mask_visib/000000_000000.png", pixel(20, 20, 255)),
        ("amodal mask", "test/000001/mask/000000_000000.png", pixel(20, 20, 255)),
        ("depth", "test/000001/depth/000000.png", pixel(20, 20)), ("color", "test/000001/rgb/000000.png", pixel(20, 20))],
    "coco": [
        ("area", BOX, number('"area":', 1)), ("box", BOX, number(r'"bbox":\[', 1)), ("category", BOX, number('"category_id":', 1)),
        ("size", BOX, number('"width":', 1)), ("ids", BOX, number('"id":', 7, 5)), ("names", BOX, word('"frame":1', '"frame":0')),
        ("color", "train/cam_L_000000.png", pixel(20, 20))],
    "coco-panoptic": [
        ("area", PANOPTIC, number('"area":', 1)), ("box", PANOPTIC, number(r'"bbox":\[', 1)),
        ("category", PANOPTIC, number('"category_id":', 1)), ("size", PANOPTIC, number('"width":', 1)),
        ("objects", "annotations/panoptic_train/cam_R_000000.png", pixel(20, 20), ("segments",)), ("color", "train/cam_L_000000.png", pixel(20, 20))],
    "colmap": [*colmap(COLMAP, None), ("objects", "masks/cam_L/000000.png.png", pixel(20, 20, 255)),
               ("color", "images/cam_L/000000.png", pixel(20, 20))],
    "colmap-dense": [*colmap("sparse/", "stereo/depth_maps/cam_L/000000.png.geometric.bin"),
                     ("normal", "stereo/normal_maps/cam_R/000000.png.geometric.bin", last_bytes())],
    "eth3d": stereo("two_view_training/cam_L_000000/", "two_view_training_gt/cam_L_000001/disp0GT.pfm"),
    "middlebury": stereo("cam_L_000000/", "cam_L_000001/disp0GT.pfm"),
    "flyingthings": [("pose", "camera_data/TRAIN/A/0000/camera_data.txt", number("R 1 0 0 ", 5e-8)),
                     ("disparity", "disparity/TRAIN/A/0000/left/0006.pfm", last_bytes()),
                     ("disparity_forward", "disparity_change/TRAIN/A/0000/into_future/left/0006.pfm", last_bytes()),
                     ("flow_backward", "optical_flow/TRAIN/A/0000/into_past/right/OpticalFlowIntoPast_0007_R.pfm", last_bytes()),
                     ("objects", "object_index/TRAIN/A/0000/left/0007.pfm", last_bytes())],
    "gltf": [("intrinsics", "scene.gltf", number(r'"K":\s*\[\s*\[\s*', 5e-8)), ("field of view", "scene.gltf", number('"yfov": ?', 5e-8), (), None, True),
             ("size", "scene.gltf", number('"width": ?', 1))],
    "hdf5": [("intrinsics", "0.hdf5", word("43.4558", "43.4559"))],
    "imagefolder": [
        ("camera", "train/metadata.jsonl", number(r'"K":\[\[', 5e-8), ("croissant",)), ("time", "train/metadata.jsonl", number('"seconds":', 1e-10)),
        ("poses", "train/metadata.jsonl", number(r'"scale":\[', 5e-8)), ("unit", "train/metadata.jsonl", number('"metres_per_unit":', 1e-3)),
        ("box", "train/metadata.jsonl", number(r'"bbox":\[\[', 1)), ("color", "train/cam_L_000000.png", pixel(20, 20))],
    "kitti2015": [("intrinsics", "training/calib_cam_to_cam/000000.txt", KITTI),
                  ("rotation", "training/calib_cam_to_cam/000000.txt", number("R_02: ", 5e-8)),
                  ("baseline", "training/calib_cam_to_cam/000000.txt", number("T_03: ", 5e-8)),
                  ("disparity", "training/disp_occ_0/000000_10.png", pixel(20, 20)),
                  ("objects", "training/obj_map/000000_10.png", pixel(20, 20)),
                  ("color", "training/image_3/000000_11.png", pixel(20, 20))],
    "kitti-depth": [("intrinsics", "train/cam_L/calib_cam_to_cam.txt", KITTI), ("size", "train/cam_R/calib_cam_to_cam.txt", number("S_02: ", 1)),
                    ("distortion", "train/cam_R/calib_cam_to_cam.txt", number("D_02: ", 5e-8)),
                    ("rotation", "train/cam_R/calib_cam_to_cam.txt", number("R_rect_02: ", 5e-8)),
                    ("baseline", "train/cam_R/calib_cam_to_cam.txt", number("T_02: ", 5e-8)),
                    ("depth", "train/cam_L/proj_depth/groundtruth/image_02/0000000000.png", pixel(20, 20))],
    "kitti-object": [("alpha", LABEL, number("Car 0 0 ", 1e-10), (), None, True), ("truncated", LABEL, number("wall ", 1e-10)),
                     ("occluded", LABEL, number("van [0-9.]+ ", 1)), ("box", LABEL, number("Car 0 2 [-0-9.]+ ", 1)),
                     ("type", LABEL, word("Misc", "Tram")), ("box 3d centre", LABEL, number("18 33 26 [0-9.]+ [0-9.]+ [0-9.]+ ", 5e-8)),
                     ("intrinsics", "training/calib/000001.txt", number("P2: ", 5e-8)),
                     ("rotation", "training/calib/000001.txt", number("R0_rect: ", 5e-8)),
                     ("baseline", "training/calib/000001.txt", number("P2: [0-9.]+ 0 [0-9.]+ ", 5e-8)),
                     ("scanner", "training/calib/000001.txt", number("Tr_velo_to_cam: ", 5e-8))],
    "kitti-odometry": [("pose", "poses/00.txt", number("1 0 0 0 0 1 0 0 0 0 1 ", 1e-6, 1)),
                       ("first pose", "poses/00.txt", number("^1 ", 5e-8)), ("time", "sequences/00/times.txt", word("4.000000000000e-02", "4.000100000000e-02")),
                       ("intrinsics", "sequences/00/calib.txt", number("P2: ", 5e-8)),
                       ("baseline", "sequences/00/calib.txt", number("P3: [0-9.]+ 0 [0-9.]+ ", 5e-8)),
                       ("scanner", "sequences/00/calib.txt", number("Tr: ", 5e-8))],
    "rosbag": recording("dataset.bag", True), "mcap": recording("dataset.mcap", False, "recording"),
    "mvsnet": [("pose", "cams/00000000_cam.txt", number("1 0 0 ", 5e-8)), ("intrinsics", "cams/00000000_cam.txt", number("intrinsic\n", 5e-8)),
               ("range", "cams/00000000_cam.txt", number("192 ", 1e-3)), ("scores", "cams/pair.txt", number("\n3 3 ", 1e-3)),
               ("depth", "rendered_depth_maps/00000001.pfm", last_bytes())],
    "nerf-synthetic": [("intrinsics", "transforms_train.json", number('"camera_angle_x": ', 5e-8)),
                       ("pose", "transforms_train.json", number(r'"transform_matrix":\[\[1.0,-0.0,-0.0,', 5e-8)),
                       ("color_rgba", "train/r_0.png", pixel(20, 20))],
    "sintel": [("intrinsics", "training/camdata_left/cam_L/frame_0001.cam", packed("<d", 4, 5e-8)),
               ("pose", "training/camdata_left/cam_L/frame_0001.cam", packed("<d", 4 + 72 + 24, 5e-8)),
               ("tag", "training/camdata_left/cam_L/frame_0002.cam", packed("<f", 0, 1)),
               ("depth", "training/depth/cam_L/frame_0001.dpt", last_bytes()),
               ("flow_forward", "training/flow/cam_L/frame_0001.flo", last_bytes())],
    "spring": [("intrinsics", "train/0001/cam_data/intrinsics.txt", number("^", 5e-8)),
               ("pose", "train/0001/cam_data/extrinsics.txt", number("1 0 0 ", 5e-8))],
    "tapvid": [("points", "cam_L/tracks.npz", archive("points", shifted), (), "tapvid.pkl"), ("queries", "cam_L/tracks.npz", archive("query_points", shifted)),
               ("occluded", "cam_R/tracks.npz", archive("occluded", np.logical_not))],
    "transforms": [("intrinsics", "transforms.json", number('"fl_x": ', 5e-8)), ("angle", "transforms.json", number('"camera_angle_x": ', 1e-10), (), None, True),
                   ("pose", "transforms.json", number(r'"transform_matrix":\[\[1.0,-0.0,-0.0,', 5e-8)),
                   ("size", "transforms.json", number('"w": ', 1)), ("distortion", "transforms.json", number('"k1": ', 5e-8)),
                   ("depth", "depth/cam_L_000000.png", pixel(20, 20)), ("objects", "masks/cam_L_000000.png", pixel(20, 20, 255))],
    "tum": [("pose", "cam_L/groundtruth.txt", number("\n0.040000 ", 5e-8)), ("intrinsics", "cam_L/calibration.txt", number("^", 5e-8)),
            ("time", "cam_L/rgb.txt", number("\n(?=0.04)", 1e-3), ("associations",), "cam_L/groundtruth.txt"), ("depth", "cam_L/depth/0.040000.png", pixel(20, 20))],
    "voc": [("box", XML, number("<xmin>", 1)), ("category", XML, word("<name>wall", "<name>Car")),
            ("size", XML, number("<width>", 1)), ("truncated", XML, word("<truncated>1", "<truncated>0")),
            ("occluded", XML, word("<occluded>0", "<occluded>1"))],
    "webdataset": [("members", "train-000000.tar", joined(".notes.txt", b"of nobody")), ("camera", "train-000000.tar", word("43.4558", "43.4559"), ("croissant",)), ("time", "train-000000.tar", word('"seconds":0.04', '"seconds":0.05')),
                   ("size", "train-000000.tar", member(".disparity.npy", narrower)), ("poses", "train-000000.tar", word('"scale":[1.0', '"scale":[1.1')), ("unit", "train-000000.tar", word('per_unit":1.0', 'per_unit":1.1'))],
    "yolo": [("box", "labels/train/cam_L_000000.txt", number("^0 ", 5e-8)), ("category", "labels/train/cam_L_000001.txt", number("^", 1))],
}.items()}

# What each format needs of every picture, in the order in which it is missed.
NEEDS = {form: layers.split() for form, layers in {
    "bop": "color depth objects boxes amodal", "coco": "color objects boxes amodal", "coco-panoptic": "color objects", "colmap": "color objects tracks",
    "colmap-dense": "color depth normal objects tracks", "eth3d": "color disparity", "middlebury": "color disparity",
    "flyingthings": "color disparity objects", "gltf": "", "hdf5": "color depth objects classes", "imagefolder": "color", "kitti2015": "color",
    "kitti-depth": "color depth", "kitti-object": "color boxes", "kitti-odometry": "color", "rosbag": "color depth", "mcap": "color depth",
    "mvsnet": "color depth objects tracks", "nerf-synthetic": "color_rgba", "sintel": "color",
    "spring": "color disparity disparity_backward flow_backward", "tapvid": "color tracks", "transforms": "color depth objects tracks",
    "tum": "color depth", "voc": "color objects boxes", "webdataset": "color", "yolo": "color objects boxes"}.items()}


class Referee(datasets.ExportCase):
    def setUp(self):
        super().setUp()
        scene = datasets.street(self.path("scene"))
        document = load_json(scene)
        for camera in document["cameras"]:
            camera.update(SMALL)
        with open(scene, "w", encoding="utf-8") as file:
            json.dump(document, file)
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
        subprocess.run([DGTK, "export", self.dataset, "--format", form, "-o", folder, "--quiet"], check=True)
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
        return sound, planted, (one, small, large)

    def rows(self, folder):
        done = subprocess.run([DGTK, "verify", self.dataset, "--export", folder, "--json"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
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
                done = subprocess.run([DGTK, "export", copy, "--format", form, "-o", target, "--quiet"], capture_output=True, text=True)
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
        subprocess.run([DGTK, "export", self.dataset, "--format", "hdf5", "-o", folder, "--quiet"], check=True)
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
                subprocess.run([DGTK, "export", self.dataset, "--format", form, "-o", folder, "--quiet"], check=True)
                self.plant(os.path.join(folder, file), edit)
                self.accept(folder)
                self.assertEqual({layer for layer, row in self.rows(folder).items() if row["breach"]}, breaches)


if __name__ == "__main__":
    main()
