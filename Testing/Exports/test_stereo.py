# SPDX-License-Identifier: BSD-3-Clause
"""Middlebury, ETH3D, MPI Sintel and FlyingThings3D, read as their own tools do: evaldisp, sintel_io.py, the readers of SceneFlow."""
import json
import os
import re

import h5py
import numpy as np

import datasets
from datasets import layer_of, load_json, main, read_png

LEFT, RIGHT = "left eye", "right.eye"


def read_pfm(path):
    """The readers' own pattern: one line each for kind, size and scale."""
    with open(path, "rb") as file:
        kind = file.readline().rstrip()
        width, height = map(int, re.match(rb"^(\d+)\s(\d+)\s$", file.readline()).groups())
        scale = float(file.readline().rstrip())
        data = np.frombuffer(file.read(), "<f4" if scale < 0 else ">f4")
    assert kind in (b"Pf", b"PF")
    return data.reshape(height, width, *([3] if kind == b"PF" else []))[::-1]


def read_flo(path):
    with open(path, "rb") as file:
        data = file.read()
    assert data[:4] == b"PIEH"
    width, height = np.frombuffer(data, "<i4", 2, 4)
    assert len(data) == 12 + 8 * width * height
    return np.frombuffer(data, "<f4", offset=12).reshape(height, width, 2)


def classes_of(dataset, layer, camera, frame):
    return read_png(os.path.join(dataset, camera, layer, f"{frame:06d}.png"))[..., 0]


def calib(path):
    """calib.txt of Middlebury."""
    found = {}
    with open(path) as file:
        for line in file:
            key, value = line.rstrip().split("=")
            rows = [list(map(float, row.split())) for row in value.strip("[]").split(";")]
            found[key] = np.array(rows) if len(rows) > 1 else rows[0][0]
    return found


def evaldisp(found, truth, mask, bad=1.0):
    """evaldisp.cpp: truth of INFINITY is unknown, mask 0 is unknown and 128 not counted; per cent of bad, and of invalid."""
    counted = (truth != np.inf) & (mask == 255)
    invalid = counted & (found == np.inf)
    wrong = counted & ~invalid & ~(np.abs(found - truth) <= bad)
    return 100 * wrong.sum() / counted.sum(), 100 * invalid.sum() / counted.sum()


class Stereo(datasets.ExportCase):
    def setUp(self):
        super().setUp()
        self.dataset = self.render(datasets.in_units(datasets.stereo(self.path("scene")), 0.5), "color,disparity,depth")

    def scene(self, form, frame):
        folder, _ = self.export(self.dataset, form)
        if form == "eth3d":
            return [os.path.join(folder, top, f"left_eye_{frame:06d}") for top in ("two_view_training", "two_view_training_gt")]
        return [os.path.join(folder, f"left_eye_{frame:06d}")] * 2

    def test_disparities_masks_and_calibration(self):
        for form in ("middlebury", "eth3d"):
            pictures, truth = self.scene(form, 1)
            found = read_pfm(os.path.join(truth, "disp0GT.pfm"))
            values = layer_of(self.dataset, "disparity", LEFT, 1)
            self.assertFalse(np.isnan(found).any())
            self.assertTrue(np.array_equal(np.where(np.isfinite(values), values, np.inf).astype(np.float32), found))
            classes = classes_of(self.dataset, "disparity", LEFT, 1)
            mask = read_png(os.path.join(truth, "mask0nocc.png"), (8, 1))[..., 0]
            self.assertTrue(np.array_equal(mask, np.array([0, 255, 128, 128, 128, 0])[classes]))
            self.assertEqual(evaldisp(found, found, mask), (0, 0))
            self.assertGreater(evaldisp(found + 2, found, mask)[0], 99)
            numbers = calib(os.path.join(pictures, "calib.txt"))
            self.assertAlmostEqual(numbers["baseline"], 60)
            self.assertGreater(numbers["ndisp"], found[found < np.inf].max())
            f, cx = numbers["cam0"][0, 0], numbers["cam0"][0, 2]
            self.assertAlmostEqual(cx, 47.5)
            depth = layer_of(self.dataset, "depth", LEFT, 1) * 500
            self.assertLess(np.abs(numbers["baseline"] * f / (found + numbers["doffs"]) / depth - 1)[found < np.inf].max(), 1e-6)
            if form == "middlebury":
                self.assertEqual(open(os.path.join(truth, "disp0.pfm"), "rb").read(), open(os.path.join(truth, "disp0GT.pfm"), "rb").read())
                other = layer_of(self.dataset, "disparity", RIGHT, 1)
                self.assertTrue(np.array_equal(read_pfm(os.path.join(truth, "disp1.pfm")), np.where(np.isfinite(other), other, np.inf).astype(np.float32)))

    def test_the_referee_finds_what_is_wrong(self):
        folder, _ = self.export(self.dataset, "middlebury")
        name = "left_eye_000000/"
        for old, new, layer in ((b"baseline=6", b"baseline=7", "baseline"), (b"doffs=0", b"doffs=1", "doffs"), (b" 47.5;", b" 48;", "intrinsics"),
                                (b"width=96", b"width=97", "size"), (b"ndisp=", b"ndisp=-", "range")):
            self.assertIn("layer " + layer, self.planted(self.dataset, folder, name + "calib.txt", lambda text, old=old, new=new: text.replace(old, new, 1)))
        flipped = self.planted(self.dataset, folder, name + "disp0.pfm", lambda data: data[:-5] + bytes([data[-5] ^ 64]) + data[-4:])
        self.assertIn("layer disparity", flipped)
        with open(os.path.join(folder, "left_eye_000001", "mask0nocc.png"), "rb") as file:
            other = file.read()
        self.assertIn("layer disparity_class", self.planted(self.dataset, folder, name + "mask0nocc.png", lambda data: other))

    def test_refusals(self):
        walk = self.render(datasets.walk(self.path("walk"), empty=False), "color")
        self.refused("export", walk, "--format", "middlebury", "-o", self.path("no"), status=2, says="lacks layers")
        self.refused("export", self.dataset, "--format", "middlebury", "-o", self.path("no"), "--image-format", "jpg", status=2, says="PNG")
        self.refused("export", self.dataset, "--format", "eth3d", "-o", self.path("no"), "--cameras", RIGHT, status=2, says="no two cameras")
        self.assertFalse(os.path.exists(self.path("no")))


class Sintel(datasets.ExportCase):
    def cam(self, path):
        """sintel_io.py, cam_read: a tag, M and N as float64."""
        with open(path, "rb") as file:
            self.assertEqual(np.fromfile(file, np.float32, 1)[0], np.float32(202021.25))
            return np.fromfile(file, "float64", 9).reshape(3, 3), np.fromfile(file, "float64", 12).reshape(3, 4)

    def dpt(self, path):
        with open(path, "rb") as file:
            self.assertEqual(np.fromfile(file, np.float32, 1)[0], np.float32(202021.25))
            width, height = np.fromfile(file, np.int32, 2)
            values = np.fromfile(file, np.float32, -1)
        return values.reshape(height, width)

    def test_all_files(self):
        dataset = self.render(datasets.stereo(self.path("scene")), "color,depth,flow_forward,objects,disparity")
        folder, _ = self.export(dataset, "sintel")
        training = os.path.join(folder, "training")
        place = lambda kind, frame, end: os.path.join(training, kind, "left_eye", f"frame_{frame + 1:04d}.{end}")  # noqa: E731
        self.assertEqual(len(os.listdir(os.path.join(training, "flow", "left_eye"))), 2)  # one less than pictures
        cameras = datasets.cameras_of(dataset)
        for frame in range(3):
            M, N = self.cam(place("camdata_left", frame, "cam"))
            camera = cameras[LEFT, frame]
            self.assertTrue(np.array_equal(M[:2, 2], camera["K"][:2, 2] - 0.5))
            self.assertTrue(np.array_equal(N, np.column_stack([camera["R"], camera["t"]])))
            depth = layer_of(dataset, "depth", LEFT, frame)
            self.assertTrue(np.array_equal(self.dpt(place("depth", frame, "dpt")), depth.astype(np.float32)))
            codes = read_png(place("segmentation", frame, "png"), (8, 3))
            self.assertTrue(np.array_equal(codes @ [65536, 256, 1], layer_of(dataset, "objects", LEFT, frame)))
            codes = read_png(place("disparities", frame, "png"), (8, 3))
            values = layer_of(dataset, "disparity", LEFT, frame)
            valid = np.isfinite(values)
            found = codes @ [4, 1 / 64, 1 / 16384]
            self.assertLessEqual(np.abs(found - values)[valid].max(), 1 / 32768)
            self.assertTrue((found[~valid] == 0).all())
            classes = classes_of(dataset, "disparity", LEFT, frame)
            self.assertTrue(np.array_equal(read_png(place("outofframe", frame, "png"), (8, 1))[..., 0], 255 * (classes == 4)))
            if frame < 2:
                classes = classes_of(dataset, "flow_forward", LEFT, frame)
                self.assertTrue(np.array_equal(read_png(place("occlusions", frame, "png"))[..., 0], 255 * (classes >= 2)))
                self.assertTrue(np.array_equal(read_png(place("invalid", frame, "png"))[..., 0], 255 * (classes == 0)))
                flow = read_flo(place("flow", frame, "flo"))
                self.assertEqual(flow.tobytes(), read_flo(os.path.join(dataset, LEFT, "flow_forward", f"{frame:06d}.flo")).tobytes())
        self.assertIn("layer pose", self.planted(dataset, folder, "training/camdata_left/left_eye/frame_0001.cam",
                                                 lambda data: data[:100] + bytes([data[100] ^ 1]) + data[101:]))
        self.assertIn("layer depth", self.planted(dataset, folder, "training/depth/left_eye/frame_0001.dpt",
                                                  lambda data: data[:5002] + bytes([data[5002] ^ 1]) + data[5003:]))
        with open(place("disparities", 1, "png"), "rb") as file:
            other = file.read()
        self.assertIn("layer disparity", self.planted(dataset, folder, "training/disparities/left_eye/frame_0001.png", lambda data: other))

    def test_of_stereo_and_of_single_cameras(self):
        dataset = self.render(datasets.stereo(self.path("scene")), "color,depth,flow_forward,objects,disparity")
        folder, _ = self.export(dataset, "sintel", "--occlusions", "stereo")
        found = read_png(os.path.join(folder, "training", "occlusions", "left_eye", "frame_0003.png"))[..., 0]
        self.assertTrue(np.array_equal(found, 255 * np.isin(classes_of(dataset, "disparity", LEFT, 2), [2, 3])))
        walk = self.render(datasets.walk(self.path("walk"), empty=False), "color,depth,flow_forward,objects")
        folder, _ = self.export(walk, "sintel")
        self.assertEqual(sorted(os.listdir(os.path.join(folder, "training"))),
                         ["camdata_left", "depth", "final", "flow", "invalid", "occlusions", "segmentation"])
        self.refused("export", walk, "--format", "sintel", "-o", self.path("no"), "--frames", "0:2:2", status=2, says="not consecutive")
        lens = self.render(datasets.twins(self.path("twins")), "color,depth,flow_forward,objects")
        self.refused("export", lens, "--format", "sintel", "-o", self.path("no"), "--cameras", "fish.auge", status=2, says="not a plain pinhole")

    def test_each_camera_has_a_scene(self):
        """A right one alone is called after its left one, and not as another camera is."""
        path = datasets.stereo(self.path("three"), 2)
        scene = load_json(path)
        eyes = {"cam": 0, "cam_mid": 0.06, "cam_right": 0.15}
        scene["cameras"] = [{**scene["cameras"][0], "name": name, "eye": [x, 0.2, 4.5], "lookAt": [x, 0.2, 0], "width": 24, "height": 18} for name, x in eyes.items()]
        dataset = self.render(datasets._write(os.path.dirname(path), "three", scene), "color,depth,flow_forward,objects")
        _, record = self.export(dataset, "sintel")
        self.assertEqual({one["camera"]: one["name"].split("/")[2] for one in record["names"]},
                         {"cam": "cam", "cam_mid": "cam_right_2", "cam_right": "cam_right"})


class FlyingThings(datasets.ExportCase):
    LAYERS = "color,disparity,disparity_forward,disparity_backward,flow_forward,flow_backward,objects"

    def matrices(self, path):
        found = {}
        with open(path) as file:
            lines = file.read().split("\n")
        for i in range(0, len(lines) - 3, 4):
            self.assertRegex(lines[i], r"^Frame \d+$")
            self.assertEqual(lines[i + 3], "")
            for line in lines[i + 1:i + 3]:
                side, *numbers = line.split(" ")
                found[int(lines[i][6:]), side] = np.array(numbers, float).reshape(4, 4)
        return found

    def test_all_files(self):
        dataset = self.render(datasets.stereo(self.path("scene")), self.LAYERS)
        folder, _ = self.export(dataset, "flyingthings")
        sequence = "TRAIN/A/0000"
        matrices = self.matrices(os.path.join(folder, "camera_data", sequence, "camera_data.txt"))
        self.assertEqual(len(matrices), 6)
        cameras = datasets.cameras_of(dataset)
        filled = lambda values: np.where(np.isfinite(values), values, 1e10).astype(np.float32)  # noqa: E731
        for (number, letter), world in matrices.items():
            camera, side, frame = {"L": LEFT, "R": RIGHT}[letter], {"L": "left", "R": "right"}[letter], number - 6
            entry = cameras[camera, frame]
            view = np.diag([1, -1, -1, 1]) @ np.linalg.inv(world)
            self.assertLess(np.abs(view[:3] - np.column_stack([entry["R"], entry["t"]])).max(), 1e-12)
            here = layer_of(dataset, "disparity", camera, frame).astype(float)
            path = lambda top, *names: os.path.join(folder, top, sequence, *names)  # noqa: E731, B023
            self.assertTrue(np.array_equal(read_pfm(path("disparity", side, f"{number:04d}.pfm")), filled(here)))
            self.assertGreater(here[np.isfinite(here)].min(), 0)
            self.assertTrue(np.array_equal(read_pfm(path("object_index", side, f"{number:04d}.pfm")), layer_of(dataset, "objects", camera, frame)))
            for way, word, layer in (("into_future", "Future", "forward"), ("into_past", "Past", "backward")):
                name = path("optical_flow", way, side, f"OpticalFlowInto{word}_{number:04d}_{letter}.pfm")
                flow, change = read_pfm(name), read_pfm(path("disparity_change", way, side, f"{number:04d}.pfm"))
                if not 0 <= frame + (1 if way == "into_future" else -1) < 3:  # loaders pair files by their order
                    self.assertTrue((flow[..., :2] == 1e10).all() and (change == 1e10).all())
                else:
                    self.assertTrue(np.array_equal(flow[..., :2], read_flo(os.path.join(dataset, camera, f"flow_{layer}", f"{frame:06d}.flo"))))
                    self.assertFalse(flow[..., 2].any())
                    there = layer_of(dataset, f"disparity_{layer}", camera, frame).astype(float)
                    self.assertTrue(np.array_equal(change, filled(there - here)))
        name = f"disparity_change/{sequence}/into_future/left/0006.pfm"
        self.assertIn("layer disparity_forward", self.planted(dataset, folder, name, lambda data: data[:-6] + bytes([data[-6] ^ 1]) + data[-5:]))
        name = f"optical_flow/{sequence}/into_past/right/OpticalFlowIntoPast_0006_R.pfm"
        self.assertIn("layer flow_backward", self.planted(dataset, folder, name, lambda data: data[:-6] + bytes([data[-6] ^ 1]) + data[-5:]))
        name = f"camera_data/{sequence}/camera_data.txt"
        self.assertIn("layer pose", self.planted(dataset, folder, name, lambda text: text.replace(b"\nL 1 ", b"\nL -1 ", 1)))
        for line, side in ((2, b"L"), (3, b"R")):
            said = self.planted(dataset, folder, name, lambda text: text.replace(b"\n" + side + b" 1 ", b"\n" + side + b" x ", 1))  # noqa: B023
            self.assertIn(f"camera_data.txt: found line {line}: ", said)

    def test_parts(self):
        dataset = self.render(datasets.stereo(self.path("scene")), self.LAYERS)
        folder, _ = self.export(dataset, "flyingthings", "--split", "train=0:1,test=2:2")
        self.assertEqual(os.listdir(os.path.join(folder, "frames_finalpass", "TEST", "A", "0000", "left")), ["0006.png"])
        self.refused("export", dataset, "--format", "flyingthings", "-o", self.path("twice"), "--split", "train=0:1,Train=2:2", status=2, says=("two files would be", "/TRAIN/"))
        self.assertFalse(os.path.exists(self.path("twice")))



class Gone(datasets.ExportCase):
    """A surface that is switched off until the other frame has class 0 and a value; formats without classes have none there."""
    LAYERS = "color,depth,objects,classes,disparity,disparity_forward,disparity_backward,flow_forward,flow_backward"

    def test_what_is_no_longer_there_has_no_value(self):
        path = datasets.stereo(self.path("scene"), 2)
        scene = load_json(path)
        scene["objects"][1]["visible"] = {"keys": [[0, True], [1, False]]}
        dataset = self.render(self.write(path, json.dumps(scene)), self.LAYERS)
        values = {}
        for camera in (LEFT, RIGHT):
            flow = read_flo(os.path.join(dataset, camera, "flow_forward", "000000.flo"))
            gone = classes_of(dataset, "flow_forward", camera, 0) == 0
            second = layer_of(dataset, "disparity_forward", camera, 0)
            gone_second = classes_of(dataset, "disparity_forward", camera, 0) == 0
            self.assertGreater((gone & (flow[..., 0] < 1e9)).sum(), 300)
            self.assertGreater((gone_second & np.isfinite(second)).sum(), 300)
            values[camera] = np.where(gone[..., None], 1e10, flow), second - layer_of(dataset, "disparity", camera, 0), gone_second, np.where(gone_second, np.nan, second)
            values[camera] += ((gone & (flow[..., 0] < 1e9)).sum(), (gone_second & np.isfinite(second)).sum())
        flow, change, gone, second, lost, lost_second = values[LEFT]
        both = [sum(values[camera][i] for camera in (LEFT, RIGHT)) for i in (4, 5)]

        folder, record = self.export(dataset, "sintel")
        self.assertEqual(read_flo(os.path.join(folder, "training/flow/left_eye/frame_0001.flo")).tobytes(), flow.astype(np.float32).tobytes())
        self.assertEqual(self.lost(record), {"flow_forward": 2 * lost})
        folder, record = self.export(dataset, "kitti2015")
        self.assertFalse(read_png(os.path.join(folder, "training/flow_occ/000000_10.png"), (16, 3))[gone].any())
        self.assertEqual(self.lost(record), {"flow_forward": lost, "disparity_forward": lost_second})
        folder, record = self.export(dataset, "flyingthings")
        found = read_pfm(os.path.join(folder, "optical_flow/TRAIN/A/0000/into_future/left/OpticalFlowIntoFuture_0006_L.pfm"))
        self.assertTrue(np.array_equal(found[..., :2], flow))
        found = read_pfm(os.path.join(folder, "disparity_change/TRAIN/A/0000/into_future/left/0006.pfm"))
        self.assertTrue(np.array_equal(found, np.where(gone | ~np.isfinite(change), 1e10, change).astype(np.float32)))
        self.assertEqual(self.lost(record), {"flow_forward": 2 * both[0], "disparity_forward": both[1]})
        name = "optical_flow/TRAIN/A/0000/into_future/left/OpticalFlowIntoFuture_0006_L.pfm"
        with open(os.path.join(folder, name), "rb") as file:
            data = file.read()
        at = len(data) - 12 * (found.shape[1] * found.shape[0] - np.flatnonzero(gone[::-1])[0])
        filled = data[:at] + bytes(8) + data[at + 8:]
        self.assertIn("layer flow_forward", self.planted(dataset, folder, name, lambda _: filled))
        folder, record = self.export(dataset, "spring")
        with h5py.File(os.path.join(folder, "train/0001/flow_FW_left/flow_FW_left_0001.flo5")) as file:
            self.assertTrue(np.array_equal(file["flow"][()], np.where(flow < 1e9, flow / 2, np.nan), equal_nan=True))
        with h5py.File(os.path.join(folder, "train/0001/disp2_FW_left/disp2_FW_left_0001.dsp5")) as file:
            self.assertTrue(np.array_equal(file["disparity"][()], second / 2, equal_nan=True))
        self.assertEqual(self.lost(record), {"flow_forward": 2 * both[0], "disparity_forward": both[1]})
        folder, record = self.export(dataset, "hdf5")
        with h5py.File(os.path.join(folder, "0.hdf5")) as file:
            self.assertTrue(np.array_equal(file["forward_flow_0"][()], np.where(flow < 1e9, flow, np.nan), equal_nan=True))
        self.assertEqual(self.lost(record), {"flow_forward": 2 * both[0]})
        for form in ("sintel", "kitti2015", "flyingthings", "spring", "hdf5"):
            self.refused("export", dataset, "--format", form, "-o", self.path("no"), "--out-of-range", "refuse", status=2,
                         says="have no code in the format")
            self.assertFalse(os.path.exists(self.path("no")))

    @staticmethod
    def lost(record):
        return {row["layer"]: row["without_code"] for row in record["layers"] if row["without_code"]}


class OfThreeCameras(datasets.ExportCase):
    """Disparities are those to the nearest camera of the run: what an export says of the pair must be of the same one."""
    NAMES = "left eye,right.eye"

    def setUp(self):
        super().setUp()
        self.file = datasets.stereo(self.path("scene"), 1)
        document = load_json(self.file)
        document["cameras"].append({**document["cameras"][0], "name": "middle", "eye": [0, 0.2, 4.5], "lookAt": [0, 0.2, 0]})
        self.write(self.file, json.dumps(document))

    def baseline(self, dataset, *options):
        """Of the only pair, in metres, which must give the depth of the left camera's pixels; and the two cameras."""
        folder, record = self.export(dataset, "middlebury", *options)
        left, right = [one["camera"] for one in record["names"]]
        scene, = [os.path.join(folder, name) for name in os.listdir(folder) if name != "export.json"]
        numbers, found = calib(os.path.join(scene, "calib.txt")), read_pfm(os.path.join(scene, "disp0GT.pfm"))
        depth = layer_of(dataset, "depth", left, 0) * 1000
        self.assertLess(np.abs(numbers["baseline"] * numbers["cam0"][0, 0] / (found + numbers["doffs"]) / depth - 1)[found < np.inf].max(), 1e-6)
        return round(numbers["baseline"] / 1000, 9), left, right

    def placed(self, places, layers="color,disparity,depth", *options):
        """A dataset of cameras at these places beside one another."""
        document = load_json(self.file)
        first = document["cameras"][0]
        document["cameras"] = [{**first, "name": name, "eye": [x, y, 4.5], "lookAt": [x, y, 0]} for name, x, y in places]
        for item in document["objects"]:
            item["position"][0] += places[0][1]
        return self.render(self.write(self.path("scene", "placed.json"), json.dumps(document)), layers, *options)

    def test_a_run_of_two_has_the_disparities_of_these(self):
        dataset = self.render(self.file, "color,disparity,depth", "--cameras", self.NAMES)
        self.dgtk("verify", dataset)
        self.assertEqual(self.baseline(dataset), (0.12, LEFT, RIGHT))

    def test_pairs_are_of_cameras_whose_disparities_are_to_each_other(self):
        dataset = self.render(self.file, "color,disparity,depth,objects,classes")
        self.dgtk("verify", dataset)
        self.assertEqual(self.baseline(dataset), (0.06, LEFT, "middle"))  # of those as near the first by name
        self.refused("export", dataset, "--format", "middlebury", "-o", self.path("no"), "--cameras", self.NAMES, status=2,
                     says=("disparities of camera 'left eye' at frame 0 are those to 'middle', not to 'right.eye'", "a run of these two cameras alone"))
        for options, names in (((), [(LEFT, "left_eye/0.hdf5_0"), ("middle", "left_eye/0.hdf5_1"), (RIGHT, "right_eye/0.hdf5")]),
                               (("--cameras", self.NAMES), [(LEFT, "left_eye/0.hdf5"), (RIGHT, "right_eye/0.hdf5")])):
            folder, record = self.export(dataset, "hdf5", *options)
            self.assertEqual(sorted((one["camera"], one["name"]) for one in record["names"]), names)
            with h5py.File(os.path.join(folder, "right_eye", "0.hdf5"), "r") as file:
                self.assertNotIn("disparity", file)
        plain = self.render(self.file, "color,depth,objects,classes")  # without disparities any two are a pair
        _, record = self.export(plain, "hdf5", "--cameras", self.NAMES)
        self.assertEqual([one["name"] for one in record["names"]], ["0.hdf5_0", "0.hdf5_1"])

    def test_the_right_camera_may_be_the_one_that_is_nearer_to_another(self):
        dataset = self.placed([("a", 0, 0.2), ("b", 0.1, 0.2), ("c", 0.15, 0.2)])
        self.refused("export", dataset, "--format", "middlebury", "-o", self.path("no"), "--cameras", "a,b", status=2,
                     says="disparities of camera 'b' at frame 0 are those to 'c', not to 'a'")
        self.assertEqual(self.baseline(dataset), (0.05, "b", "c"))

    def test_places_far_from_the_origin(self):
        """Ties, and what is beside the x axis, are to the rounding of the places."""
        for whole in ("0", "10000", "4300000"):
            left, middle, right, beside = (float(whole + part) for part in (".4", ".52", ".64", ".57"))
            dataset = self.placed([("b", middle, 0.2), ("d", left, 0.2), ("c", right, 0.2), ("a", beside, 0.2 + 5e-6)])
            self.assertEqual(sorted(os.listdir(os.path.join(dataset, "a"))), ["color", "depth"])
            self.dgtk("verify", dataset)
            self.assertEqual(self.baseline(dataset)[1:], ("b", "c"))

    def test_scenes_of_a_folder(self):
        """Each is judged by itself, by its own cameras, also those that are not exported."""
        document = load_json(self.file)
        document["cameras"][2]["name"] = "A"
        for name in ("one", "two"):
            self.write(os.path.join("scene", name + ".json"), json.dumps(document))
        os.remove(self.file)
        folder = self.path("set")
        self.dgtk("render", self.path("scene"), "-o", folder, "--layers", "color,disparity,depth", "--quiet")
        self.refused("export", folder, "--format", "kitti2015", "-o", self.path("no"), "--cameras", self.NAMES, status=2, says="lacks layers")
        self.refused("export", folder, "--format", "middlebury", "-o", self.path("no"), "--cameras", self.NAMES, status=2, says="are those to 'A', not to 'right.eye'")


if __name__ == "__main__":
    main()
