# SPDX-License-Identifier: BSD-3-Clause
"""BOP sets, read as bop_toolkit's inout.py and misc.py do: models projected by their poses, masks, counts, and ADD and MSPD of the poses."""
import json
import os
import re

import numpy as np

import datasets
from datasets import layer_of, load_json, main, read_png

LAYERS = "color,depth,objects,boxes,amodal"


def read_ply(path):
    """An ASCII model: vertices, normals, faces."""
    with open(path) as file:
        lines = [line.rstrip("\n") for line in file]
    assert lines[:2] == ["ply", "format ascii 1.0"], lines[:2]
    end = lines.index("end_header")
    count = {line.split()[1]: int(line.split()[2]) for line in lines[:end] if line.startswith("element ")}
    rows = np.array([line.split() for line in lines[end + 1:end + 1 + count["vertex"]]], float)
    faces = np.array([line.split() for line in lines[end + 1 + count["vertex"]:]], int)
    assert len(faces) == count["face"] and (faces[:, 0] == 3).all()
    return rows[:, :3], rows[:, 3:6], faces[:, 1:]


def filled(points, faces, height, width):
    """Pixels whose centres lie in a projected face; whole numbers are pixel centres."""
    y, x = np.mgrid[0:height, 0:width].astype(float)
    inside = np.zeros((height, width), bool)
    for a, b, c in points[faces]:
        sides = [(q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]) for p, q in ((a, b), (b, c), (c, a))]
        inside |= np.all([s >= 0 for s in sides], axis=0) | np.all([s <= 0 for s in sides], axis=0)
    return inside


def decoded(segmentation):
    height, width = segmentation["size"]
    counts = segmentation["counts"]
    return np.repeat(np.arange(len(counts)) % 2, counts).reshape(width, height).T.astype(bool)


def add(vertices, found, truth):
    """Average distance of distinguishable points (Hinterstoisser et al. 2012), in the model's unit; poses are (R, t)."""
    (R, t), (Q, s) = found, truth
    return np.linalg.norm(vertices @ R.T + t - vertices @ Q.T - s, axis=1).mean()


def mspd(vertices, found, truth, K):
    """Maximum projection distance (BOP 2019) in pixels; these models have no symmetries."""
    pixels = [(vertices @ R.T + t) @ K.T for R, t in (found, truth)]
    return np.linalg.norm(pixels[0][:, :2] / pixels[0][:, 2:] - pixels[1][:, :2] / pixels[1][:, 2:], axis=1).max()


class Bop(datasets.ExportCase):
    def errors(self, vertices, pose, truth, K):
        """The exported pose has no error against the dataset's, and errors in closed form where it is moved or turned."""
        self.assertLess(add(vertices, pose, truth), 1e-9 * np.linalg.norm(truth[1]))
        (R, t), (_, s) = pose, truth
        self.assertAlmostEqual(add(vertices, (R, t + [3, 0, 4]), truth), 5, places=8)
        half = np.diag([-1., -1, 1])  # a half turn about the model's z: each point moves by twice its distance from the axis
        self.assertAlmostEqual(add(vertices, (R @ half, t), truth), 2 * np.hypot(vertices[:, 0], vertices[:, 1]).mean(), places=8)
        depth = (vertices @ R.T + t)[:, 2].min()
        if depth > 0:
            self.assertLess(mspd(vertices, pose, truth, K), 1e-9)
            self.assertAlmostEqual(mspd(vertices, (R, t + [2, 0, 0]), truth, K), K[0, 0] * 2 / depth, places=8)
            self.assertAlmostEqual(mspd(vertices, (R, t + [0, 2, 0]), truth, K), K[1, 1] * 2 / depth, places=8)

    def check(self, dataset, folder, record, metres=1.0, step=0.1):
        """All images of a set against the dataset; how many instances, and how many of them are cut off by the border."""
        names = {entry["name"]: (entry["camera"], entry["frame"]) for entry in record["names"]}
        cameras = datasets.cameras_of(dataset)
        poses = {(pose["frame"], pose["id"]): pose for pose in load_json(os.path.join(dataset, "poses.json"))["poses"]}
        info = load_json(os.path.join(folder, "models", "models_info.json"))
        models = {int(i): read_ply(os.path.join(folder, "models", f"obj_{int(i):06d}.ply")) for i in info}
        for number, (vertices, normals, _) in models.items():
            row = info[str(number)]
            self.assertLess(np.abs(vertices.max(axis=0) + vertices.min(axis=0)).max(), 1e-9, "the origin is the box's middle")
            self.assertLess(np.abs(vertices.min(axis=0) - [row["min_x"], row["min_y"], row["min_z"]]).max(), 1e-9)
            self.assertLess(np.abs(np.ptp(vertices, axis=0) - [row["size_x"], row["size_y"], row["size_z"]]).max(), 1e-9)
            widest = max(np.linalg.norm(vertices - one, axis=1).max() for one in vertices)
            self.assertAlmostEqual(row["diameter"], widest, places=9)
            self.assertLess(np.abs(np.linalg.norm(normals, axis=1) - 1).max(), 1e-6)
        seen, cut = 0, 0
        for name, (camera, frame) in names.items():
            scene = os.path.dirname(os.path.dirname(name))
            image = str(int(os.path.splitext(os.path.basename(name))[0]))
            read = lambda which: load_json(os.path.join(folder, scene, which + ".json"))  # noqa: E731
            view, truth, counts = read("scene_camera")[image], read("scene_gt")[image], read("scene_gt_info")[image]
            coco = [one for one in read("scene_gt_coco")["annotations"] if one["image_id"] == int(image)]
            K = np.array(view["cam_K"]).reshape(3, 3)
            own = cameras[camera, frame]
            self.assertTrue(np.allclose(K[:2, 2], own["K"][:2, 2] - 0.5, atol=1e-12))
            self.assertTrue(np.allclose(np.array(view["cam_t_w2c"]), own["t"] * 1000 * metres, atol=1e-9))
            depth = read_png(os.path.join(folder, scene, "depth", f"{int(image):06d}.png"), (16, 1))[..., 0]
            exact = layer_of(dataset, "depth", camera, frame) * 1000 * metres
            self.assertEqual(view["depth_scale"], step)
            valid = exact < 65535.5 * step
            self.assertTrue(np.array_equal(depth > 0, valid))
            self.assertLessEqual(np.abs(depth * step - exact)[valid].max(initial=0), step / 2 + 1e-9)
            ids = layer_of(dataset, "objects", camera, frame)
            boxes = {box["id"]: box for box in load_json(os.path.join(dataset, camera, "boxes", f"{frame:06d}.json"))["objects"]}
            self.assertEqual(len(truth), len(counts))
            for i, (pose, row) in enumerate(zip(truth, counts)):
                R, t = np.array(pose["cam_R_m2c"]).reshape(3, 3), np.array(pose["cam_t_m2c"])
                self.assertLess(np.abs(R @ R.T - np.eye(3)).max(), 1e-9)
                vertices, _, faces = models[pose["obj_id"]]
                x = vertices @ R.T + t
                whole = read_png(os.path.join(folder, scene, "mask", f"{int(image):06d}_{i:06d}.png"))[..., 0]
                visible = read_png(os.path.join(folder, scene, "mask_visib", f"{int(image):06d}_{i:06d}.png"))[..., 0]
                self.assertLessEqual(set(np.unique(visible)) | set(np.unique(whole)), {0, 255})
                self.assertFalse(((visible > 0) & (whole == 0)).any())
                if (x[:, 2] > 0).all():
                    pixels = x @ K.T
                    drawn = filled(pixels[:, :2] / pixels[:, 2:], faces, *whole.shape)
                    self.assertLessEqual(np.count_nonzero(drawn != (whole > 0)), 2, "the model's silhouette")
                    seen += 1
                if (visible > 0).any():
                    number = np.unique(ids[visible > 0])
                    self.assertEqual(len(number), 1)
                    self.assertTrue(np.array_equal(ids == number[0], visible > 0))
                    matrix = np.array(poses[frame, number[0]]["matrix"]).reshape(3, 4)
                    middle = own["R"] @ (matrix[:, 3]) + own["t"]
                    self.assertLess(np.linalg.norm(t / 1000 / metres - middle), 1e-9, "the test's models are around their origins")
                    turn = matrix[:, :3] / np.linalg.norm(matrix[:, :3], axis=0)
                    self.errors(vertices, (R, t), (own["R"] @ turn, middle * 1000 * metres), K)
                    rows, columns = np.nonzero(visible)
                    self.assertEqual(row["bbox_visib"], [columns.min(), rows.min(), np.ptp(columns), np.ptp(rows)])
                    one = next(one for one in coco if np.array_equal(decoded(one["segmentation"]), visible > 0))
                    self.assertEqual(one["ignore"], counts[i]["visib_fract"] < 0.1)
                    self.assertEqual((one["category_id"], one["area"]), (pose["obj_id"], len(rows)))
                    self.assertEqual(row["px_count_all"], boxes[number[0]]["pixels_whole"])
                    cut += row["px_count_all"] > np.count_nonzero(whole)
                else:
                    self.assertEqual(row["bbox_obj"], [-1, -1, -1, -1])
                self.assertEqual(row["px_count_visib"], np.count_nonzero(visible))
                self.assertEqual(row["px_count_valid"], np.count_nonzero((whole > 0) & valid))
                self.assertAlmostEqual(row["visib_fract"], row["px_count_visib"] / row["px_count_all"])
        return seen, cut

    def test_moving_objects_before_two_cameras(self):
        dataset = self.render(datasets.stereo(self.path("scene")), LAYERS, "--models")
        folder, record = self.export(dataset, "bop", "--objects", "ring,block")
        self.assertEqual(sorted(os.listdir(folder)), ["camera.json", "dataset_info.json", "export.json", "models", "models_eval", "test", "test_targets_bop19.json"])
        self.assertEqual(sorted(os.listdir(os.path.join(folder, "test"))), ["000001", "000002"])
        self.assertEqual(len(load_json(os.path.join(folder, "models", "models_info.json"))), 3, "a model for each size of the block")
        seen, cut = self.check(dataset, folder, record)
        self.assertEqual(seen, 18)
        self.assertGreater(cut, 3)
        targets = load_json(os.path.join(folder, "test_targets_bop19.json"))
        self.assertEqual({tuple(sorted(row)) for row in targets}, {("im_id", "inst_count", "obj_id", "scene_id")})
        self.assertEqual({row["scene_id"] for row in targets}, {1, 2})
        for name, key, layer in (("scene_camera.json", b'"cam_K":[', "intrinsics"), ("scene_gt.json", b'"cam_t_m2c":[', "(poses|instances)"),
                                 ("scene_gt_info.json", b'"px_count_visib":', "px_count_visib"), ("scene_gt_coco.json", b'"area":', "coco")):
            said = self.planted(dataset, folder, "test/000001/" + name, lambda text, key=key: re.sub(re.escape(key) + b"[^],}]*", key + b"7.5", text, count=1))
            self.assertRegex(said, "layer " + layer)
        with open(os.path.join(folder, "test", "000001", "mask_visib", "000002_000001.png"), "rb") as file:
            said = self.planted(dataset, folder, "test/000001/mask_visib/000000_000000.png", lambda old, new=file.read(): new)
        self.assertRegex(said, "layer (mask|coco)")

    def test_parts_units_and_an_empty_frame(self):
        dataset = self.render(datasets.in_units(datasets.walk(self.path("scene"))), LAYERS, "--models")
        folder, record = self.export(dataset, "bop", "--split", "train_pbr=0:1,test=2:3", "--unit-metres", 0.5, "--depth-scale", 0.25, "--image-format", "jpg")
        self.assertEqual(sorted(os.listdir(folder))[-2:], ["test_targets_bop19.json", "train_pbr"])
        seen, _ = self.check(dataset, folder, record, metres=0.5, step=0.25)
        self.assertGreater(seen, 4)
        empty = load_json(os.path.join(folder, "test", "000001", "scene_gt_info.json"))["1"]
        self.assertEqual([row["px_count_visib"] for row in empty], [0] * len(empty))

    def test_a_picture_of_some_faces_is_none_of_all(self):
        """The format has one picture for all faces of a model."""
        scene = load_json(datasets.stereo(self.path("scene")))
        self.write("scene/p.ppm", "P3 1 1 255 9 200 9\n")
        self.write("scene/half.mtl", "newmtl m\nmap_Kd p.ppm\n")
        for bare, there in (("f 1 3 4\n", False), ("f 1/1 3/2 4/3\n", True)):
            self.write("scene/half.obj", "mtllib half.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl m\nf 1/1 2/2 3/3\n" + bare)
            scene["objects"] = [{"name": "half", "model": "half.obj", "class": "half"}]
            scene.pop("classes", None)
            dataset = self.render(self.write("scene/half.json", json.dumps(scene)), LAYERS, "--models")
            folder, _ = self.export(dataset, "bop")
            with open(os.path.join(folder, "models", "obj_000001.ply"), encoding="ascii") as file:
                self.assertEqual("comment TextureFile" in file.read(), there)

    def test_refusals(self):
        path = datasets.stereo(self.path("scene"))
        scene = load_json(path)
        scene["objects"][1]["scale"] = {"keys": [[0, [1, 1, 1]], [2, [2, 2, 2]]]}
        scene["objects"][2]["scale"] = [-1, 1, 1]
        dataset = self.render(self.write("scene/odd.json", json.dumps(scene)), LAYERS, "--models")
        for says, *more in ((("röter Ring.v2", "changes its size"), "--objects", "ring"), (("'block'", "mirrored"), "--objects", "wall,block"),
                            (("no object", "chair"), "--objects", "chair")):
            self.refused("export", dataset, "--format", "bop", "-o", self.path("no"), *more, status=2, says=says)
        self.export(dataset, "bop", "--objects", "wall")
        plain = self.render(path, LAYERS)
        self.refused("export", plain, "--format", "bop", "-o", self.path("no"), status=2, says="no file of the model")
        self.assertFalse(os.path.exists(self.path("no")))


if __name__ == "__main__":
    main()
