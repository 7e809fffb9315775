# SPDX-License-Identifier: BSD-3-Clause
"""HDF5: files read by the HDF5 library itself, through h5py and h5dump, and compared as BlenderProc's and Spring's readers take them."""
import json
import os
import subprocess

import h5py
import numpy as np

import datasets
from datasets import cameras_of, layer_of, load_json, main, read_png  # noqa: F401

LEFT, RIGHT = "left eye", "right.eye"
LAYERS = "color,depth,objects,classes,distance,normal,objectcoords,flow_forward,flow_backward,disparity"


class BlenderProc(datasets.ExportCase):
    METRES = 0.25

    def frame(self, path):
        with h5py.File(path, "r") as file:
            found = {key: file[key][()] for key in file}
            for key in file:
                self.assertEqual(file[key].compression, None if file[key].shape == () else "gzip")
        self.assertEqual(list(found), sorted(found))
        done = subprocess.run(["h5dump", "-p", path], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return found

    def flow(self, dataset, way, camera, frame):
        with open(os.path.join(dataset, camera, "flow_" + way, f"{frame:06d}.flo"), "rb") as file:
            values = np.frombuffer(file.read()[12:], "<f4").reshape(72, 96, 2)
        return np.where(np.abs(values) < 1e9, values, np.nan)

    def compare(self, dataset, found, camera, frame, suffix):
        read = lambda layer: layer_of(dataset, layer, camera, frame)  # noqa: E731
        entry = cameras_of(dataset)[camera, frame]
        self.assertTrue(np.array_equal(found["colors" + suffix], read_png(os.path.join(dataset, camera, "color", f"{frame:06d}.png"))))
        for key in ("depth", "distance"):
            values = read(key)
            self.assertEqual(found[key + suffix].dtype, np.float32)
            self.assertTrue(np.array_equal(found[key + suffix], np.where(np.isfinite(values), values * self.METRES, 1e10).astype(np.float32)))
        normals = read("normal").astype(float)
        there = np.isfinite(normals).all(axis=2)
        decoded = 2 * found["normals" + suffix].astype(float) - 1
        self.assertLess(np.abs(decoded - normals * [1, -1, -1])[there].max(), 1e-6)
        self.assertFalse(decoded[~there].any())
        # nocs: what BlenderProc's material makes of Object coordinates, 0.5 x + 0.5, and an alpha
        local = read("objectcoords")
        seen = np.isfinite(local).all(axis=2)
        self.assertEqual(found["nocs" + suffix].shape, (72, 96, 4))
        self.assertTrue(np.array_equal(found["nocs" + suffix][..., 3] == 1, seen))
        self.assertLess(np.abs(found["nocs" + suffix][..., :3] - (0.5 * local + 0.5))[seen].max(initial=0), 1e-6)
        self.assertFalse(found["nocs" + suffix][~seen].any())
        for key, layer in (("instance_segmaps", "objects"), ("class_segmaps", "classes")):
            self.assertTrue(np.array_equal(found[key + suffix], read(layer).reshape(72, 96)))
        for key, way, last in (("forward_flow", "forward", 2), ("backward_flow", "backward", 0)):
            self.assertEqual(key + suffix in found, frame != last)
            if frame != last:
                self.assertTrue(np.array_equal(found[key + suffix], self.flow(dataset, way, camera, frame), equal_nan=True))
        maps = json.loads(bytes(found["instance_attribute_maps" + suffix]))
        self.assertEqual([row["idx"] for row in maps], sorted(np.unique(read("objects"))))
        pose = json.loads(bytes(found["camera_pose" + suffix]))
        K = np.reshape(pose["cam_K"], (3, 3))
        self.assertTrue(np.allclose(K + [[0, 0, 0.5], [0, 0, 0.5], [0, 0, 0]], entry["K"], rtol=0, atol=1e-12))
        self.assertTrue(np.array_equal(np.reshape(pose["cam_R_w2c"], (3, 3)), entry["R"]))
        self.assertTrue(np.allclose(pose["cam_t_w2c"], entry["t"] * self.METRES, rtol=1e-15))
        # the depth's points lie as far as the distance says
        v, u = np.nonzero(found["depth" + suffix] < 1e9)
        rays = np.stack([(u - K[0, 2]) / K[0, 0], (v - K[1, 2]) / K[1, 1], np.ones(len(u))])
        lengths = np.linalg.norm(rays * found["depth" + suffix][v, u], axis=0)
        self.assertLess(np.abs(lengths / found["distance" + suffix][v, u] - 1).max(), 1e-6)
        return maps

    def test_pairs(self):
        dataset = self.render(datasets.in_units(datasets.stereo(self.path("scene"))), LAYERS)
        folder, _ = self.export(dataset, "hdf5", "--unit-metres", self.METRES)
        self.assertEqual(sorted(os.listdir(folder)), ["0.hdf5", "1.hdf5", "2.hdf5", "export.json"])
        for frame in range(3):
            found = self.frame(os.path.join(folder, f"{frame}.hdf5"))
            for camera, suffix in ((LEFT, "_0"), (RIGHT, "_1")):
                maps = self.compare(dataset, found, camera, frame, suffix)
                values = layer_of(dataset, "disparity", camera, frame)
                self.assertTrue(np.array_equal(found["disparity" + suffix], values, equal_nan=True))
            self.assertEqual({row["name"]: row["category_id"] for row in maps}["röter Ring.v2"], 2)

    def test_single_cameras_and_empty_frames(self):
        dataset = self.render(datasets.walk(self.path("scene")), LAYERS.replace(",disparity", "").replace(",flow_backward", ""))
        folder, _ = self.export(dataset, "hdf5")
        found = self.frame(os.path.join(folder, "3.hdf5"))
        self.assertEqual(json.loads(bytes(found["instance_attribute_maps"])), [{"idx": 0, "category_id": 0, "name": "background"}])
        self.assertTrue((found["depth"] == 1e10).all())
        many = self.render(datasets.many(self.path("many"), 3), "color,depth,objects,classes")
        folder, record = self.export(many, "hdf5")
        self.assertEqual(sorted(one["name"] for one in record["names"]), ["cam_0/0.hdf5", "cam_1/0.hdf5", "cam_2/0.hdf5"])
        self.assertEqual(len(self.frame(os.path.join(folder, "cam_1", "0.hdf5"))), 6)

    def test_a_pair_beside_another_camera(self):
        scene = datasets.stereo(self.path("scene"), 1)
        document = load_json(scene)
        document["cameras"].append({**document["cameras"][0], "name": "away", "eye": [1, 1, 4]})
        with open(scene, "w", encoding="utf-8") as file:
            json.dump(document, file)
        dataset = self.render(scene, "color,depth,objects,classes")
        folder, record = self.export(dataset, "hdf5")
        self.assertEqual(sorted(one["name"] for one in record["names"]), ["away/0.hdf5", "left_eye/0.hdf5_0", "left_eye/0.hdf5_1"])
        for number, name in enumerate(sorted(os.listdir(folder))):
            self.assertEqual(os.path.isdir(os.path.join(folder, name)), number in (0, 2), name)

    def test_flow_leads_to_pictures_of_the_export(self):
        dataset = self.render(datasets.stereo(self.path("scene"), 4), LAYERS, "--frames", "0:2")  # frame 2 has flow to the scene's frame 3
        for frames, forward, backward in (((), (0, 1), (1, 2)), (("--frames", "0:2:2"), (), ())):
            folder, _ = self.export(dataset, "hdf5", *frames)
            for name in set(os.listdir(folder)) - {"export.json"}:
                frame, found = int(name.split(".")[0]), self.frame(os.path.join(folder, name))
                self.assertEqual(("forward_flow_0" in found, "backward_flow_1" in found), (frame in forward, frame in backward), name)
                self.assertIn("disparity_0", found)

    def test_large_pictures_have_several_chunks(self):
        dataset = self.render(datasets.walk(self.path("scene"), frames=2), "color,depth,objects,classes", "--size", "611x403")
        folder, _ = self.export(dataset, "hdf5")
        with h5py.File(os.path.join(folder, "0.hdf5"), "r") as file:
            self.assertLess(file["depth"].chunks[0], 403)
            self.assertEqual(file["depth"].chunks[1], 611)
            found, values = file["depth"][()], layer_of(dataset, "depth", "Kamera 1", 0)
            self.assertTrue(np.array_equal(found, np.where(np.isfinite(values), values, 1e10).astype(np.float32)))
            self.assertTrue(np.array_equal(file["depth"][17:300:7, 5], found[17:300:7, 5]))

    def test_a_tree_has_one_node_whatever_the_height(self):
        """64 chunks are the most that it holds: 391 rows in sixes would be 66."""
        path = datasets.walk(self.path("scene"), frames=2)
        dataset = self.render(path, "color,depth,objects,classes", "--size", "3000x391", "--frames", "0")
        folder, _ = self.export(dataset, "hdf5")
        with h5py.File(os.path.join(folder, "0.hdf5"), "r") as file:
            values = layer_of(dataset, "depth", "Kamera 1", 0)
            self.assertEqual(file["depth"].chunks[0], 7)
            self.assertTrue(np.array_equal(file["depth"][()], np.where(np.isfinite(values), values, 1e10).astype(np.float32)))

    def planted_value(self, dataset, folder, key, change):
        """Rewrites a member with h5py; the referee must name the layer."""
        def rewrite(data):
            path = self.write("planted.hdf5", data)
            with h5py.File(path, "r+") as file:
                values = file[key][()]
                file[key][...] = change(values)
            with open(path, "rb") as file:
                return file.read()
        return self.planted(dataset, folder, "1.hdf5", rewrite)

    def test_the_referee_finds_what_is_wrong(self):
        dataset = self.render(datasets.stereo(self.path("scene")), LAYERS)
        folder, _ = self.export(dataset, "hdf5")

        def one(values):
            values = values.copy()
            values[40, 50] = values[40, 50] + 1
            return values

        for key, layer in (("depth_0", "depth"), ("instance_segmaps_1", "objects"), ("normals_0", "normal"), ("forward_flow_1", "flow_forward"),
                           ("colors_1", "color"), ("distance_0", "distance"), ("nocs_0", "objectcoords")):
            self.assertIn("layer " + layer, self.planted_value(dataset, folder, key, one))
        for old, new, layer in ((b'"cam_t_w2c":[0', b'"cam_t_w2c":[1', "pose"), (b'47.5', b'48.0', "intrinsics"), (b'"back wall"', b'"back well"', "attributes")):
            self.assertIn("layer " + layer, self.planted(dataset, folder, "1.hdf5", lambda data, old=old, new=new: data.replace(old, new, 1)))
        self.planted(dataset, folder, "1.hdf5", lambda data: data[:-1])

    def test_refusals(self):
        lenses = self.render(datasets.lenses(self.path("lenses")), "color,depth,objects,classes")
        self.refused("export", lenses, "--format", "hdf5", "-o", self.path("no"), status=2, says="hdf5")
        self.export(lenses, "hdf5", "--cameras", "plain")
        walk = self.render(datasets.walk(self.path("walk")), "color,depth")
        self.refused("export", walk, "--format", "hdf5", "-o", self.path("no"), status=2, says="lacks layers")
        self.assertFalse(os.path.exists(self.path("no")))


def read_flow(path, name="flow"):
    """flow_IO.py, readFlo5Flow and readDsp5Disp."""
    with h5py.File(path, "r") as file:
        assert list(file) == [name] and file[name].compression == "gzip" and file[name].compression_opts == 5
        return file[name][()]


class Spring(datasets.ExportCase):
    LAYERS = "color,disparity,disparity_forward,disparity_backward,flow_forward,flow_backward"

    def path_of(self, kind, side, frame, end):
        return os.path.join(self.sequence, f"{kind}_{side}", f"{kind}_{side}_{frame + 1:04d}.{end}")

    def test_all_files(self):
        dataset = self.render(datasets.in_units(datasets.stereo(self.path("scene"))), self.LAYERS, "--size", "192x144")
        folder, _ = self.export(dataset, "spring", "--unit-metres", 0.5)
        self.sequence = os.path.join(folder, "train", "0001")
        lines = [np.loadtxt(os.path.join(self.sequence, "cam_data", name)) for name in ("intrinsics.txt", "extrinsics.txt")]
        cameras = cameras_of(dataset)
        for frame in range(3):
            left, right = cameras[LEFT, frame], cameras[RIGHT, frame]
            fx, fy, cx, cy = lines[0][frame]
            self.assertTrue(np.allclose([[2 * fx, 0, 2 * cx], [0, 2 * fy, 2 * cy], [0, 0, 1]], left["K"], rtol=1e-15))
            self.assertTrue(np.allclose(lines[1][frame].reshape(4, 4)[:3], np.column_stack([left["R"], left["t"] * 0.5]), rtol=1e-15))
            baseline = np.linalg.norm(left["R"].T @ left["t"] - right["R"].T @ right["t"]) * 0.5
            for camera, side in ((LEFT, "left"), (RIGHT, "right")):
                stem = os.path.join(dataset, camera, "color", f"{frame:06d}.png")
                code = read_png(stem).astype(float) / 255
                light = np.where(code <= 0.04045, code / 12.92, ((code + 0.055) / 1.055) ** 2.4)
                mean = light.reshape(72, 2, 96, 2, 3).mean(axis=(1, 3))
                want = 255 * np.where(mean <= 0.0031308, 12.92 * mean, 1.055 * mean ** (1 / 2.4) - 0.055)
                found = read_png(self.path_of("frame", side, frame, "png"), (8, 3))
                self.assertLessEqual(np.abs(found - want).max(), 0.5 + 1e-6)
                for kind, layer, step in (("disp1", "disparity", 0), ("disp2_FW", "disparity_forward", 1), ("disp2_BW", "disparity_backward", -1)):
                    path = self.path_of(kind, side, frame, "dsp5")
                    self.assertEqual(os.path.exists(path), 0 <= frame + step < 3)
                    if os.path.exists(path):
                        disparity, values = read_flow(path, "disparity"), layer_of(dataset, layer, camera, frame)
                        self.assertEqual((disparity.dtype, disparity.shape), (np.float32, (144, 192)))
                        self.assertTrue(np.array_equal(disparity, np.where(np.isfinite(values), values / 2, np.nan), equal_nan=True))
                        self.assertGreater(np.isfinite(disparity).sum(), 5000)
                for kind, way, step in (("flow_FW", "forward", 1), ("flow_BW", "backward", -1)):
                    path = self.path_of(kind, side, frame, "flo5")
                    self.assertEqual(os.path.exists(path), 0 <= frame + step < 3)
                    if os.path.exists(path):
                        with open(os.path.join(dataset, camera, "flow_" + way, f"{frame:06d}.flo"), "rb") as file:
                            values = np.frombuffer(file.read()[12:], "<f4").reshape(144, 192, 2)
                        self.assertTrue(np.array_equal(read_flow(path), np.where(np.abs(values) < 1e9, values / 2, np.nan), equal_nan=True))
            # readers of Spring: depth = fx baseline / disparity, with every second value in both directions
            depth = fx * baseline / read_flow(self.path_of("disp1", "left", frame, "dsp5"), "disparity")[::2, ::2]
            self.assertTrue(1 < np.nanmin(depth) and np.nanmax(depth) < 4.2)
        flo5 = "train/0001/flow_FW_left/flow_FW_left_0001.flo5"

        def changed(data):
            path = self.write("planted.flo5", data)
            with h5py.File(path, "r+") as file:
                values = file["flow"][()]
                values[100, 90] += 0.001
                file["flow"][...] = values
            with open(path, "rb") as file:
                return file.read()

        self.assertIn("layer flow_forward", self.planted(dataset, folder, flo5, changed))
        for name, layer in (("intrinsics", "intrinsics"), ("extrinsics", "pose")):
            self.assertIn("layer " + layer, self.planted(dataset, folder, f"train/0001/cam_data/{name}.txt", lambda text: b"2" + text))
        with open(self.path_of("frame", "right", 1, "png"), "rb") as file:
            other = file.read()
        self.assertIn("layer color", self.planted(dataset, folder, "train/0001/frame_left/frame_left_0002.png", lambda data: other))

    def test_refusals(self):
        odd = self.render(datasets.stereo(self.path("scene")), self.LAYERS, "--size", "97x72")
        self.refused("export", odd, "--format", "spring", "-o", self.path("no"), status=2, says="odd width or height")
        even = self.render(self.path("scene", "stereo.json"), self.LAYERS)
        self.refused("export", even, "--format", "spring", "-o", self.path("no"), "--frames", "0:2:2", status=2, says="not consecutive")
        self.refused("export", even, "--format", "spring", "-o", self.path("no"), "--image-format", "jpg", status=2, says="PNG")
        self.refused("export", even, "--format", "spring", "-o", self.path("no"), "--cameras", LEFT, status=2, says="no two cameras")
        document = load_json(self.path("scene", "stereo.json"))
        for camera, cx in zip(document["cameras"], (48, 47.5)):
            del camera["fovY"]
            camera["K"] = [[100, 0, cx], [0, 100, 36], [0, 0, 1]]
        shifted = self.render(self.write(self.path("scene", "shifted.json"), json.dumps(document)), self.LAYERS + ",depth,objects")
        for form in ("spring", "sintel", "flyingthings"):
            self.refused("export", shifted, "--format", form, "-o", self.path("no"), status=2, says="has another cx than 'left eye' (47.5 and 48)")
        self.export(self.render(self.path("scene", "shifted.json"), "color,depth,objects,flow_forward"), "sintel")
        self.assertFalse(os.path.exists(self.path("no")))


if __name__ == "__main__":
    main()
