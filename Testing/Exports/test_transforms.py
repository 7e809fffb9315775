# SPDX-License-Identifier: BSD-3-Clause
"""transforms.json and NeRF-synthetic sets: points of the dataset are projected by each reader's own formulas."""
import json
import math
import os
import struct

import numpy as np

import datasets
from datasets import layer_of, load_json, main, read_png

TRACKS = ("--tracks-step", 6, "--tracks-every", 1)


def nerf_pixel(document, frame, points):
    """instant-ngp's and nerfstudio's camera: the world through the inverse matrix, y up, z back, then the lens in OpenCV's axes."""
    value = {**document, **frame}
    back = np.linalg.inv(np.array(frame["transform_matrix"]))
    x, y, z = (back @ np.column_stack([points, np.ones(len(points))]).T)[:3]
    a, b = x / -z, -y / -z
    square = a * a + b * b
    if document["is_fisheye"]:  # nerfstudio, fisheye_undistort: theta by a polynomial
        r = np.sqrt(square)
        angle = np.arctan(r)
        bent = angle * (1 + value["k1"] * angle**2 + value["k2"] * angle**4 + value["k3"] * angle**6 + value["k4"] * angle**8)
        a, b = a * bent / r, b * bent / r
    else:  # instant-ngp, opencv_lens_distortion_delta
        radial = value["k1"] * square + value["k2"] * square**2
        p1, p2 = value["p1"], value["p2"]
        a, b = (a + a * radial + 2 * p1 * a * b + p2 * (square + 2 * a * a), b + b * radial + 2 * p2 * a * b + p1 * (square + 2 * b * b))
    return np.column_stack([value["fl_x"] * a + value["cx"], value["fl_y"] * b + value["cy"]]), -z


def two_roundings_off(rows):
    """The largest number of the points, moved by two of float32."""
    points = np.frombuffer(rows, np.dtype([("x", "<f4", 3), ("c", "u1", 3)])).copy()
    x = points["x"].reshape(-1)
    at = np.abs(x).argmax()
    x[at] = np.nextafter(np.nextafter(x[at], np.float32(np.inf)), np.float32(np.inf))
    points["x"] = x.reshape(-1, 3)
    return points.tobytes()


class Transforms(datasets.ExportCase):
    LAYERS = "color,depth,objects,tracks"

    def reprojection(self, dataset, folder, record):
        """The largest distance, in pixels, of a static point's projection from where the dataset sees it."""
        document = load_json(os.path.join(folder, "transforms.json"))
        places = {entry["name"]: (entry["camera"], entry["frame"]) for entry in record["names"]}
        points = load_json(os.path.join(dataset, "tracks", "points.json"))["points"]
        static = np.array([point["static"] for point in points])
        x = np.array([point["x"] for point in points])
        largest, count = 0, 0
        for frame in document["frames"]:
            camera, number = places[frame["file_path"]]
            seen = np.load(os.path.join(dataset, camera, "tracks", f"{number:06d}.npy"))
            use = static & (seen[:, 2] == 1)
            pixels, z = nerf_pixel(document, frame, x[use])
            largest = max(largest, np.abs(pixels - seen[use, :2]).max(initial=0))
            codes = read_png(os.path.join(folder, frame["depth_path"]), (16, 1))[..., 0]
            truth = layer_of(dataset, "depth", camera, number)
            step = document["integer_depth_scale"]
            self.assertTrue(np.array_equal(codes > 0, (truth > step / 2) & (truth < 65535.5 * step)))
            self.assertLess(np.abs(codes * step - truth)[codes > 0].max(initial=0), step / 2 + 1e-12)
            count += use.sum()
        return document, largest, count

    def test_a_moving_camera_and_its_parts(self):
        dataset = self.render(datasets.walk(self.path("scene")), self.LAYERS, *TRACKS)  # its last frame is empty
        folder, record = self.export(dataset, "transforms", "--split", "train=0:1,val=2:2,test=3:3")
        document, largest, count = self.reprojection(dataset, folder, record)
        self.assertGreater(count, 200)
        self.assertLess(largest, 1e-9)
        self.assertEqual(document["val_filenames"], ["images/Kamera_1_000002.png"])
        self.assertEqual((document["w"], document["h"], document["cx"], document["camera_model"]), (96, 72, 48, "OPENCV"))
        self.assertNotIn("fl_x", document["frames"][0])
        self.assertNotIn("mask_path", document["frames"][0])
        self.assertAlmostEqual(document["camera_angle_y"], math.radians(45))
        with open(os.path.join(folder, "points.ply"), "rb") as file:
            head, rows = file.read().split(b"end_header\n", 1)
        found = np.frombuffer(rows, np.dtype([("x", "<f4", 3), ("c", "u1", 3)]))
        points = load_json(os.path.join(dataset, "tracks", "points.json"))["points"]
        self.assertEqual(found["x"].tolist(), np.array([p["x"] for p in points], np.float32).tolist())
        self.assertEqual(found["c"].tolist(), [p["color"] for p in points])
        # instant-ngp's unit cube is 1 / 0.33 long; the scene's is the smallest power of two of it that holds all, both around the origin
        centres = [frame["transform_matrix"][i][3] for frame in document["frames"] for i in range(3)]
        reach = 0.33 * max(np.abs(centres).max(), np.abs([point["x"] for point in points]).max())
        self.assertLessEqual(reach, document["aabb_scale"] / 2)
        self.assertGreater(reach, document["aabb_scale"] / 4)
        said = self.planted(dataset, folder, "transforms.json", lambda text: text.replace(b'"cx": 48', b'"cx": 47', 1))
        self.assertIn("layer intrinsics", said)
        wider = json.dumps(2 * math.atan(97 / 96 * math.tan(document["camera_angle_x"] / 2))).encode()
        angle = json.dumps(document["camera_angle_x"]).encode()
        self.planted(dataset, folder, "transforms.json", lambda text: text.replace(b'"w": 96', b'"w": 97', 1).replace(angle, wider, 1))
        said = self.planted(dataset, folder, "transforms.json", lambda text: text.replace(b'0.0,0.0,0.0,1.0]]', b'0.0,0.0,0.0,2.0]]', 1))
        self.assertIn("layer pose", said)
        said = self.planted(dataset, folder, "points.ply", lambda data: data[:-13] + bytes([data[-13] ^ 64]) + data[-12:])
        self.assertIn("layer points", said)
        said = self.planted(dataset, folder, "points.ply", lambda data: head + b"end_header\n" + two_roundings_off(data[-len(rows):]))
        self.assertIn("layer points", said)

    def test_places_far_from_the_origin_are_rounded_and_it_says_so(self):
        path = datasets.far_away(datasets.walk(self.path("scene"), 2), (500000.3, 30.1, -4200000.7))
        dataset = self.render(path, self.LAYERS, *TRACKS)
        folder = self.path("far")
        said = self.dgtk("export", dataset, "--format", "transforms", "-o", folder).stderr
        self.referee(dataset, folder)
        x = np.array([point["x"] for point in load_json(os.path.join(dataset, "tracks", "points.json"))["points"]])
        [layer] = [row for row in load_json(os.path.join(folder, "export.json"))["layers"] if row["layer"] == "tracks"]
        self.assertEqual(layer["largest_rounding"], np.abs(x.astype(np.float32) - x).max())
        self.assertEqual((layer["unit"], layer["values"], layer["without_code"]), ("scene units", x.size, 0))
        self.assertRegex(said, "(?m)^tracks: rounded by at most 0[.].* scene units$")
        self.assertEqual(load_json(os.path.join(folder, "transforms.json"))["aabb_scale"], 128)
        self.assertRegex(said, "(?m)^warning: transforms.json: aabb_scale is at most 128, and the cube of cameras and points needs 27720")

    def test_a_code_of_depth_is_a_millimetre(self):
        for metres, step in ((None, 0.001), (1, 0.001), (0.01, 0.1), (0.001, 1)):
            path = datasets.in_units(datasets.walk(self.path(str(metres)), 2), metres)
            folder, record = self.export(self.render(path, self.LAYERS, *TRACKS), "transforms")
            document = load_json(os.path.join(folder, "transforms.json"))
            self.assertEqual(document["integer_depth_scale"], step)
            [layer] = [row for row in record["layers"] if row["layer"] == "depth"]
            self.assertEqual(layer["largest_rounding"], step / 2)

    def test_what_moves_is_masked(self):
        dataset = self.render(datasets.stereo(self.path("scene")), self.LAYERS, *TRACKS)
        folder, record = self.export(dataset, "transforms", "--image-format", "jpg")
        document, largest, count = self.reprojection(dataset, folder, record)
        self.assertGreater(count, 500)
        self.assertLess(largest, 1e-9)
        places = {entry["name"]: (entry["camera"], entry["frame"]) for entry in record["names"]}
        for frame in document["frames"]:
            moves = np.isin(layer_of(dataset, "objects", *places[frame["file_path"]]), [3, 4])
            stem = os.path.splitext(os.path.basename(frame["file_path"]))[0]
            self.assertTrue(np.array_equal(read_png(os.path.join(folder, frame["mask_path"]))[..., 0] == 0, moves))
            self.assertTrue(np.array_equal(read_png(os.path.join(folder, "images", f"dynamic_mask_{stem}.png"))[..., 0] > 0, moves))

    def test_what_comes_and_goes_is_masked(self):
        """As what moves, in all formats of what stands still; among frames that all have it, it stays."""
        path = datasets.stereo(self.path("scene"))
        scene = load_json(path)
        scene["objects"][1]["visible"] = {"keys": [[0, True], [1, False], [2, True]]}
        self.write(path, json.dumps(scene))
        dataset = self.render(path, "normal," + self.LAYERS, *TRACKS)
        points = load_json(os.path.join(dataset, "tracks", "points.json"))["points"]
        for frames, held in (("0:2", [1]), ("0:2:2", [1, 2])):
            folders = {}
            for form in ("transforms", "colmap", "colmap-dense", "mvsnet"):
                folders[form], record = self.export(dataset, form, "--frames", frames)
            for number, entry in enumerate(record["names"]):
                stays = np.isin(layer_of(dataset, "objects", entry["camera"], entry["frame"]), [0, *held])
                name = f"{entry['camera'].replace(' ', '_').replace('.', '_')}/{entry['frame']:06d}.png"
                for mask in (os.path.join(folders["transforms"], "masks", name.replace("/", "_")), os.path.join(folders["colmap"], "masks", name + ".png")):
                    self.assertTrue(np.array_equal(read_png(mask)[..., 0] > 0, stays), mask)
                with open(os.path.join(folders["mvsnet"], "rendered_depth_maps", f"{number:08d}.pfm"), "rb") as file:
                    depth = np.frombuffer(file.read().split(b"\n", 3)[3], "<f4").reshape(72, 96)[::-1]
                self.assertTrue(np.array_equal(depth > 0, stays & np.isfinite(layer_of(dataset, "depth", entry["camera"], entry["frame"]))))
            with open(os.path.join(folders["transforms"], "points.ply"), "rb") as file:
                self.assertIn(f"element vertex {sum(point['object'] in held for point in points)}\n".encode(), file.read())
            with open(os.path.join(folders["colmap"], "sparse", "0", "points3D.bin"), "rb") as file:
                rows = file.read()
            ids, at = [], 8
            while at < len(rows):
                ids.append(struct.unpack_from("<Q", rows, at)[0])
                at += 51 + 8 * struct.unpack_from("<Q", rows, at + 43)[0]
            self.assertEqual({points[one - 1]["object"] for one in ids}, set(held))

    def test_lenses(self):
        dataset = self.render(datasets.lenses(self.path("scene")), self.LAYERS, *TRACKS)
        for cameras, model in (("plain,mild", "OPENCV"), ("fish", "OPENCV_FISHEYE")):
            folder, record = self.export(dataset, "transforms", "--cameras", cameras)
            document, largest, count = self.reprojection(dataset, folder, record)
            self.assertEqual(document["camera_model"], model)
            self.assertGreater(count, 50)
            self.assertLess(largest, 1e-4)
            self.assertEqual(model == "OPENCV", "fl_x" in document["frames"][0])
        for says, cameras in ((("radial", "k1 k2 p1 p2"), "radial"), (("models of their own", "fish"), "plain,fish")):
            self.refused("export", dataset, "--format", "transforms", "-o", self.path("no"), "--cameras", cameras, status=2, says=says)
        self.refused("export", dataset, "--format", "transforms", "-o", self.path("no"), "--cameras", "plain", "--split", "eval=0:0", status=2, says="train, val and test")
        self.assertFalse(os.path.exists(self.path("no")))


def load_blender(folder, split):
    """load_blender.py of the original NeRF: pictures in [0, 1], poses, focal length in pixels."""
    document = load_json(os.path.join(folder, f"transforms_{split}.json"))
    pictures = np.array([read_png(os.path.join(folder, frame["file_path"] + ".png")) for frame in document["frames"]]) / 255
    poses = np.array([frame["transform_matrix"] for frame in document["frames"]])
    width = pictures.shape[2]
    return pictures, poses, 0.5 * width / math.tan(0.5 * document["camera_angle_x"])


class NerfSynthetic(datasets.ExportCase):
    def test_pictures_without_their_background(self):
        """Over the background they are the picture again; rays of the loader meet the points that pixels show."""
        dataset = self.render(datasets.walk(self.path("scene")), "color,color_rgba,position,objects", "--samples", 5)
        folder, _ = self.export(dataset, "nerf-synthetic", "--split", "train=0:1,test=2:3")
        self.assertEqual(sorted(os.listdir(folder)), ["export.json", "test", "train", "transforms_test.json", "transforms_train.json"])
        background = np.array([0.2, 0.3, 0.4])
        mixed = 0
        for split, frames in (("train", (0, 1)), ("test", (2, 3))):
            pictures, poses, focal = load_blender(folder, split)
            for picture, pose, frame in zip(pictures, poses, frames):
                alpha = picture[..., 3:]
                color = read_png(os.path.join(dataset, "Kamera 1", "color", f"{frame:06d}.png")) / 255
                self.assertLess(np.abs(picture[..., :3] * alpha + background * (1 - alpha) - color).max(), 2.01 / 255)
                mixed += np.count_nonzero((alpha > 0) & (alpha < 1))
                points = layer_of(dataset, "position", "Kamera 1", frame)
                height, width = points.shape[:2]
                x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)  # centres of pixels, which the original's own rays miss by half a pixel
                rays = np.stack([(x - width / 2) / focal, -(y - height / 2) / focal, -np.ones_like(x)], axis=-1) @ pose[:3, :3].T
                away = points - pose[:3, 3]
                there = np.isfinite(points[..., 0])
                if there.any():
                    cross = np.cross(away[there], rays[there] / np.linalg.norm(rays[there], axis=-1, keepdims=True))
                    self.assertLess(np.linalg.norm(cross, axis=-1).max(), 1e-6)
        self.assertGreater(mixed, 100)
        self.assertFalse(pictures[1][..., 3].any(), "the last frame is empty")
        said = self.planted(dataset, folder, "transforms_train.json", lambda text: text.replace(b'"camera_angle_x": ', b'"camera_angle_x": 1', 1))
        self.assertIn("layer intrinsics", said)
        said = self.planted(dataset, folder, "transforms_train.json", lambda text: text.replace(b"0.0,0.0,0.0,1.0]]", b"0.0,0.0,0.0,2.0]]", 1))
        self.assertIn("layer pose", said)

    def test_refusals(self):
        dataset = self.render(datasets.lenses(self.path("scene")), "color_rgba")
        for says, cameras in (("not a plain pinhole", "mild"), ("angle of view", "plain,mild")):
            self.refused("export", dataset, "--format", "nerf-synthetic", "-o", self.path("no"), "--cameras", cameras, status=2, says="nerf-synthetic")
        self.refused("export", dataset, "--format", "nerf-synthetic", "-o", self.path("no"), "--cameras", "plain", "--image-format", "jpg", status=2, says="PNG")
        self.assertFalse(os.path.exists(self.path("no")))


if __name__ == "__main__":
    main()
