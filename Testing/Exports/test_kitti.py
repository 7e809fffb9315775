# SPDX-License-Identifier: BSD-3-Clause
"""KITTI's sets, read as its development kits do: io_disp.h, io_flow.h, the evaluations of stereo, flow, objects and odometry."""
import json
import math
import os

import numpy as np

import datasets
from datasets import layer_of, load_json, main, read_png

SCENE_FLOW = "color,disparity,disparity_forward,flow_forward,objects"


def disparity(path):
    """io_disp.h: v / 256, 0 is not valid."""
    codes = read_png(path, (16, 1))[..., 0]
    return np.where(codes > 0, codes / 256, np.nan)


def flow(path):
    """io_flow.h: (R - 32768) / 64, (G - 32768) / 64, valid where B is not 0."""
    codes = read_png(path, (16, 3))
    return np.where(codes[..., 2:] > 0, (codes[..., :2] - 32768) / 64, np.nan)


def outliers(truth, found):
    """Share of the valid pixels that are off by more than 3 pixels and 5 percent (evaluate_scene_flow.cpp)."""
    truth, found = (np.atleast_3d(a) for a in (truth, found))
    valid = np.isfinite(truth).all(axis=2)
    error = np.sqrt(((truth - found) ** 2).sum(axis=2))[valid]
    size = np.sqrt((truth ** 2).sum(axis=2))[valid]
    return np.mean(~(error <= 3) & ~(error / size <= 0.05))


def calibration(path):
    """As every reader of raw data: KEY: numbers."""
    with open(path) as file:
        lines = [line.split(":", 1) for line in file if ":" in line]
    return {key: np.array([float(word) for word in text.split()]) for key, text in lines}


class Kitti(datasets.ExportCase):
    def test_a_last_frame_alone(self):
        dataset = self.render(datasets.stereo(self.path("scene")), SCENE_FLOW)
        self.refused("export", dataset, "--format", "kitti2015", "-o", self.path("no"), "--frames", "2", status=2,
                     says=("kitti2015: no picture that is exported has layers that the format needs: disparity_forward, flow_forward",
                           "a last frame is followed by none"))
        self.refused("export", self.render(self.path("scene", "stereo.json"), "color,disparity"), "--format", "kitti2015", "-o", self.path("no"),
                     "--frames", "2", status=2, says="kitti2015: the dataset lacks layers that the format needs: disparity_forward, flow_forward, objects")
        self.refused("export", dataset, "--format", "kitti2015", "-o", self.path("no"), "--cameras", "left eye", status=2,
                     says="plain pinholes of one size and, but for cx, one matrix, alike turned")

    def test_stereo_and_flow(self):
        """Disparity within 1/512, flow within 1/128, valid where the classes say so; the truth against itself has no outlier."""
        dataset = self.render(datasets.stereo(self.path("scene")), SCENE_FLOW)
        folder, record = self.export(dataset, "kitti2015")
        training = os.path.join(folder, "training")
        self.assertEqual(sorted(os.listdir(os.path.join(training, "image_2"))),
                         ["000000_10.png", "000000_11.png", "000001_10.png", "000001_11.png"])
        largest = {"disp": 0, "flow": 0}
        for frame in range(2):
            name = f"{frame:06d}_10.png"
            flow_class = layer_of(dataset, "flow_forward", "left eye", frame)[..., 0]
            for kind, layer in (("0", "disparity"), ("1", "disparity_forward")):
                values = layer_of(dataset, layer, "left eye", frame).astype(float)
                classes = read_png(os.path.join(dataset, "left eye", layer, f"{frame:06d}.png"))[..., 0]
                seen = (classes == 1) & ((flow_class == 1) | (kind == "0"))
                for part, valid in (("noc", seen), ("occ", np.isin(classes, [1, 2, 3, 4]))):
                    found = disparity(os.path.join(training, f"disp_{part}_{kind}", name))
                    self.assertTrue(np.array_equal(np.isfinite(found), valid & np.isfinite(values)))
                    self.assertGreater(valid.sum(), 1000)
                    largest["disp"] = max(largest["disp"], np.abs(found - values)[valid].max())
                    self.assertEqual(outliers(found, found), 0)
                    self.assertEqual(outliers(found, values), 0)
            values = self.flo(dataset, frame)
            for part, valid in (("noc", flow_class == 1), ("occ", np.isin(flow_class, [1, 2, 3, 4]))):
                found = flow(os.path.join(training, f"flow_{part}", name))
                self.assertTrue(np.array_equal(np.isfinite(found[..., 0]), valid))
                largest["flow"] = max(largest["flow"], np.abs(found - values)[valid].max())
                self.assertEqual(outliers(found, values), 0)
            ids = layer_of(dataset, "objects", "left eye", frame)
            self.assertTrue(np.array_equal(read_png(os.path.join(training, "obj_map", name), (8, 1))[..., 0], ids))
        self.assertLessEqual(largest["disp"], 1 / 512)
        self.assertLessEqual(largest["flow"], 1 / 128)
        self.assertGreater(min(largest.values()), 1e-4)
        print(f"disparity off by {largest['disp']:.5f}, flow by {largest['flow']:.5f} px")

    def flo(self, dataset, frame):
        data = open(os.path.join(dataset, "left eye", "flow_forward", f"{frame:06d}.flo"), "rb").read()
        width, height = np.frombuffer(data, "<i4", 2, 4)
        return np.frombuffer(data, "<f4", offset=12).reshape(height, width, 2).astype(float)

    def test_a_point_lies_where_the_calibration_says(self):
        """Depth from disparity and P_rect, and the point's pixel in both pictures: the half pixel is in cx and cy."""
        dataset = self.render(datasets.in_units(datasets.stereo(self.path("scene")), 0.01), SCENE_FLOW + ",depth")
        folder, record = self.export(dataset, "kitti2015", "--unit-metres", 0.01)
        self.assertIn(["metres_per_unit", "0.01"], [list(pair) for pair in pairs(record["conventions"])])
        all_numbers = calibration(os.path.join(folder, "training", "calib_cam_to_cam", "000000.txt"))
        left, right = (all_numbers[f"P_rect_{n}"].reshape(3, 4) for n in ("02", "03"))
        camera = datasets.cameras_of(dataset)["left eye", 0]
        self.assertTrue(np.allclose(left[:2, 2], camera["K"][:2, 2] - 0.5, atol=1e-12))
        found = disparity(os.path.join(folder, "training", "disp_occ_0", "000000_10.png"))
        y, x = np.nonzero(np.isfinite(found))
        depth = layer_of(dataset, "depth", "left eye", 0)[y, x] * 0.01
        rays = np.linalg.inv(left[:, :3]) @ np.stack([x, y, np.ones(len(x))])
        points = np.vstack([rays * depth, np.ones(len(x))])
        u = right @ points
        self.assertLess(np.abs(x - u[0] / u[2] - found[y, x]).max(), 1 / 512 + 1e-6)
        self.assertLess(np.abs(y - u[1] / u[2]).max(), 1e-9)

    def test_foreground_and_refusals(self):
        dataset = self.render(datasets.stereo(self.path("scene")), SCENE_FLOW)
        folder, _ = self.export(dataset, "kitti2015", "--foreground", "block")
        found = read_png(os.path.join(folder, "training", "obj_map", "000000_10.png"))[..., 0]
        ids = layer_of(dataset, "objects", "left eye", 0)
        self.assertTrue(np.array_equal(found, np.select([ids == 3, ids == 4], [1, 2], 0)))
        target = self.path("target")
        for says, *more in (("no two cameras are a rectified pair", "--cameras", "left eye"), ("PNG", "--image-format", "jpg"),
                            ("has no parts", "--split", "train=0:1"), ("two frames", "--frames", "0")):
            self.refused("export", dataset, "--format", "kitti2015", "-o", target, *more, status=2, says=says)
            self.assertFalse(os.path.exists(target))

    def test_the_referee_finds_what_is_wrong(self):
        dataset = self.render(datasets.stereo(self.path("scene")), SCENE_FLOW)
        folder, _ = self.export(dataset, "kitti2015")
        calib = "training/calib_cam_to_cam/000000.txt"
        self.assertIn("layer baseline", self.planted(dataset, folder, calib, lambda text: text.replace(b"T_03: -0.12", b"T_03: -0.13")))
        self.assertIn("layer intrinsics", self.planted(dataset, folder, calib, lambda text: text.replace(b" 0 47.5 ", b" 0 48 ", 1)))
        for name, other, layer in (("disp_noc_0", "disp_occ_0", "disparity"), ("disp_noc_1", "disp_occ_1", "disparity_forward"),
                                   ("flow_noc", "flow_occ", "flow_forward"), ("image_2", "image_3", "color")):
            with open(os.path.join(folder, "training", other, "000000_10.png"), "rb") as file:
                said = self.planted(dataset, folder, f"training/{name}/000000_10.png", lambda old, new=file.read(): new)
            self.assertIn("layer " + layer, said)

    def test_depth(self):
        """256 codes a metre; what is too far for 16 bits is none, and counted."""
        dataset = self.render(datasets.in_units(datasets.walk(self.path("scene"), empty=False)), "color,depth")
        depths = np.stack([layer_of(dataset, "depth", "Kamera 1", frame) for frame in range(4)])
        last = float(65535 / 256 / depths[np.isfinite(depths)].max())  # the farthest has the last code
        for metres, beyond in ((1, False), (40, True), (last, False)):
            folder, record = self.export(dataset, "kitti-depth", "--unit-metres", metres)
            drive = os.path.join(folder, "train", "Kamera_1")
            rounding = next(one for one in record["layers"] if one["layer"] == "depth")
            largest = 0
            for frame in range(4):
                codes = read_png(os.path.join(drive, "proj_depth", "groundtruth", "image_02", f"{frame:010d}.png"), (16, 1))[..., 0]
                truth = layer_of(dataset, "depth", "Kamera 1", frame) * metres
                valid = truth * 256 < 65535.5
                self.assertTrue(np.array_equal(codes > 0, valid))
                self.assertLessEqual(np.abs(codes / 256 - truth)[valid].max(), 1 / 512 + 1e-12)
                largest = max(largest, codes.max())
            self.assertEqual(largest == 65535, metres == last)
            self.assertEqual(rounding["without_code"] > 0, beyond)
            K = calibration(os.path.join(drive, "calib_cam_to_cam.txt"))["K_02"].reshape(3, 3)
            self.assertTrue(np.allclose(K[:2, 2], datasets.cameras_of(dataset)["Kamera 1", 0]["K"][:2, 2] - 0.5))
            said = self.dgtk("export", dataset, "--format", "kitti-depth", "-o", self.path(f"said{metres}"), "--unit-metres", metres).stderr
            self.assertIn(f"depth: rounded by at most {rounding['largest_rounding']:.3g} ", said)
            self.assertEqual(f"warning: {rounding['without_code']} of {rounding['values']} values of depth have no code in the format" in said, beyond)
        os.mkdir(self.path("there"))
        for folder in ("no", "there"):  # what is found while it is written leaves nothing either
            self.refused("export", dataset, "--format", "kitti-depth", "-o", self.path(folder), "--unit-metres", 40, "--out-of-range", "refuse",
                         status=2, says="have no code")
        self.assertFalse(os.path.exists(self.path("no")))
        self.assertEqual(os.listdir(self.path("there")), [])


def pairs(conventions):
    return conventions.items() if isinstance(conventions, dict) else [tuple(one.values()) if isinstance(one, dict) else one for one in conventions]


class Odometry(datasets.ExportCase):
    def poses(self, path):
        """kitti_odometry.py: 12 numbers a line, one space between."""
        with open(path) as file:
            lines = file.read().split("\n")
        self.assertEqual(lines.pop(), "")
        found = []
        for line in lines:
            self.assertEqual(line, " ".join(line.split()))
            found.append(np.vstack([np.array(line.split(" "), float).reshape(3, 4), [0, 0, 0, 1]]))
        return np.array(found)

    def test_relative_poses(self):
        """Every pose leads points of a frame to the first one; the error against the true trajectory is 0."""
        for scene, names in ((datasets.stereo(self.path("stereo")), ("left eye", "right.eye")), (datasets.walk(self.path("walk")), ("Kamera 1", None))):
            dataset = self.render(datasets.in_units(scene), "color")
            folder, _ = self.export(dataset, "kitti-odometry", "--unit-metres", 2)
            cameras = datasets.cameras_of(dataset)
            poses = self.poses(os.path.join(folder, "poses", "00.txt"))
            self.assertTrue(np.array_equal(poses[0], np.eye(4)))
            world = [np.vstack([np.column_stack([cameras[names[0], i]["R"], 2 * cameras[names[0], i]["t"]]), [0, 0, 0, 1]]) for i in range(len(poses))]
            for i, pose in enumerate(poses):
                self.assertLess(np.abs(world[0] @ np.linalg.inv(world[i]) - pose).max(), 1e-12)
            sequence = os.path.join(folder, "sequences", "00")
            with open(os.path.join(sequence, "times.txt")) as file:
                self.assertTrue(np.allclose([float(line) for line in file], np.arange(len(poses)) / 25, atol=1e-12))
            numbers = calibration(os.path.join(sequence, "calib.txt"))
            self.assertEqual(sorted(os.listdir(sequence)), ["calib.txt", "image_2"] + ["image_3"] * bool(names[1]) + ["times.txt"])
            self.assertAlmostEqual(-numbers["P3"][3] / numbers["P3"][0], 0.24 if names[1] else 0)
            last = repr(0.001 + poses[-1][2, 3]).encode()
            said = self.planted(dataset, folder, "poses/00.txt", lambda text, last=last: text.rsplit(b" ", 1)[0] + b" " + last + b"\n")
            self.assertRegex(said, "layer (pose|poses|first pose)")

    def test_a_camera_is_in_one_pair(self):
        """Of three side by side the nearest two are a pair, and the third is alone, whatever their names are."""
        path = datasets.stereo(self.path("three"), 1)
        scene = load_json(path)
        eyes = {"third": -0.2, "left": -0.06, "right": 0.06}
        scene["cameras"] = [{**scene["cameras"][0], "name": name, "eye": [x, 0.2, 4.5], "lookAt": [x, 0.2, 0]} for name, x in eyes.items()]
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        folder, _ = self.export(self.render(path, "color"), "kitti-odometry")
        sequences = os.path.join(folder, "sequences")
        self.assertEqual({name: sorted(os.listdir(os.path.join(sequences, name))) for name in sorted(os.listdir(sequences))},
                         {"00": ["calib.txt", "image_2", "image_3", "times.txt"], "01": ["calib.txt", "image_2", "times.txt"]})


def corners(label):
    """computeBox3D.m: x by length, y up from the bottom, z by width, turned by ry."""
    h, w, length, x, y, z, ry = label[7:14]
    box = np.array([[sx * length / 2, -sy * h, sz * w / 2] for sx in (-1, 1) for sy in (0, 1) for sz in (-1, 1)])
    turn = np.array([[math.cos(ry), 0, math.sin(ry)], [0, 1, 0], [-math.sin(ry), 0, math.cos(ry)]])
    return box @ turn.T + [x, y, z]


def labels(path):
    with open(path) as file:
        rows = [line.split(" ") for line in file.read().splitlines()]
    assert all(len(row) == 15 for row in rows)
    return [(row[0], [float(word) for word in row[1:]]) for row in rows]


def overlap(a, b):
    """Of two boxes, as a share of both."""
    width = min(a[2], b[2]) - max(a[0], b[0])
    height = min(a[3], b[3]) - max(a[1], b[1])
    inner = max(width, 0) * max(height, 0)
    return inner / (sum((box[2] - box[0]) * (box[3] - box[1]) for box in (a, b)) - inner)


def average_precision(truth, found):
    """evaluate_object.cpp for one class, all scores 1: thresholds of recall, precision at eleven of forty-one places."""
    hits = wrong = 0
    for expected, rows in zip(truth, found):
        free = list(rows)
        for numbers in expected:
            best = max(free, key=lambda one: overlap(one[3:7], numbers[3:7]), default=None)
            if best is not None and overlap(best[3:7], numbers[3:7]) > 0.7:
                free.remove(best)
                hits += 1
        wrong += len(free)
    total = sum(len(rows) for rows in truth)
    thresholds, current = 0, 0.0
    for i in range(hits):  # getThresholds
        left = (i + 1) / total
        right = (i + 2) / total if i < hits - 1 else left
        if right - current < current - left and i < hits - 1:
            continue
        thresholds += 1
        current += 1 / 40
    precision = [hits / (hits + wrong)] * thresholds + [0] * (41 - thresholds)
    return 100 * sum(precision[0:41:4]) / 11


class Objects(datasets.ExportCase):
    LAYERS = "color,objects,boxes"

    def test_upright_boxes(self):
        dataset = self.render(datasets.street(self.path("scene")), self.LAYERS)
        folder, record = self.export(dataset, "kitti-object", "--split", "train=0:0,val=1:1")
        self.assertEqual([(one["largest_rounding"], one["without_code"]) for one in record["layers"] if one["layer"] == "boxes"], [(0, 0)])
        kinds, cut, hidden, truth = set(), 0, set(), {}
        for entry in record["names"]:
            number = os.path.basename(entry["name"])[:6]
            boxes = [box for box in datasets.load_json(os.path.join(dataset, entry["camera"], "boxes", f"{entry['frame']:06d}.json"))["objects"]
                     if box["pixels_visible"]]
            truth[number] = labels(os.path.join(folder, "training", "label_2", number + ".txt"))
            self.assertEqual(len(truth[number]), len(boxes))
            for (kind, numbers), box in zip(truth[number], boxes):
                kinds.add(kind)
                distances = np.linalg.norm(corners(numbers)[:, None] - np.array(box["box3d"])[None], axis=2)
                self.assertLess(max(distances.min(axis=0).max(), distances.min(axis=1).max()), 1e-5)
                x0, y0, x1, y1 = box["box_amodal"]
                self.assertEqual(numbers[3:7], [x0, y0, x1 - 1, y1 - 1])
                self.assertAlmostEqual(math.remainder(numbers[2] - numbers[13] + math.atan2(numbers[10], numbers[12]), 2 * math.pi), 0)
                axis = np.array(box["box3d"][1]) - box["box3d"][0]
                self.assertLess(np.abs(axis / np.linalg.norm(axis) - [math.cos(numbers[13]), 0, -math.sin(numbers[13])]).max(), 1e-5)
                cut += numbers[0] > 0
                hidden.add(numbers[1])
        self.assertEqual(kinds, {"wall", "Car", "delivery_van", "Misc"})
        self.assertGreater(cut, 0)
        self.assertGreater(len(hidden), 1)
        cars = [[numbers for kind, numbers in rows if kind == "Car"] for rows in truth.values()]
        self.assertEqual(40 % sum(len(rows) for rows in cars), 0)
        cars *= 40 // sum(len(rows) for rows in cars)
        self.assertAlmostEqual(average_precision(cars, cars), 90.909, places=3)  # forty labels against themselves
        beside = [[[*n[:3], n[3] + 40, n[4], n[5] + 40, *n[6:]] for n in rows] for rows in cars]
        self.assertLess(average_precision(cars, beside), 80)
        with open(os.path.join(folder, "ImageSets", "val.txt")) as file:
            self.assertEqual(file.read().split(), ["000001", "000003"])
        name = "training/label_2/000000.txt"
        said = self.planted(dataset, folder, name, lambda text: self.changed(text, 5, 1))
        self.assertIn("layer box", said)
        said = self.planted(dataset, folder, name, lambda text: self.changed(text, 14, 0.01))
        self.assertRegex(said, "layer (alpha|box 3d|front)")
        said = self.planted(dataset, folder, name, lambda text: self.changed(text, 12, 0.5))
        self.assertIn("layer", said)

    @staticmethod
    def changed(text, column, by):
        words = text.split(b" ", 15)
        at = words[column].split(b"\n")
        words[column] = b"\n".join([repr(float(at[0]) + by).encode(), *at[1:]])
        return b" ".join(words)

    def test_tilted_boxes(self):
        dataset = self.render(datasets.stereo(self.path("scene")), self.LAYERS)
        self.refused("export", dataset, "--format", "kitti-object", "-o", self.path("no"), status=2, says=("block, kleiner", "45 degrees", "fit"))
        self.assertFalse(os.path.exists(self.path("no")))
        folder, record = self.export(dataset, "kitti-object", "--tilt", "fit", "--label-boxes", "visible")
        tilt = next(one for one in record["layers"] if one["layer"] == "boxes")
        self.assertGreater(tilt["largest_rounding"], 44)
        self.assertEqual(tilt["unit"], "degrees of tilt")

    def test_other_fronts(self):
        dataset = self.render(datasets.street(self.path("scene")), self.LAYERS)
        folder, _ = self.export(dataset, "kitti-object", "--front", "-z")
        box = datasets.load_json(os.path.join(dataset, "cam L", "boxes", "000000.json"))["objects"][1]
        numbers = labels(os.path.join(folder, "training", "label_2", "000000.txt"))[1][1]
        self.assertTrue(np.allclose(numbers[7:10], [0.8, 1.0, 0.6]))
        ahead = np.array(box["box3d"][0]) - box["box3d"][4]
        self.assertLess(np.abs(ahead / np.linalg.norm(ahead) - [math.cos(numbers[13]), 0, -math.sin(numbers[13])]).max(), 1e-5)


if __name__ == "__main__":
    main()
