# SPDX-License-Identifier: BSD-3-Clause
"""YOLO's labels, read from the description of their formats."""
import json
import os

import numpy as np
import yaml

import datasets
import hard_scenes
from datasets import layer_of, load_json, main

LAYERS = "color,objects,boxes"


def labels(path, width, height, poses=False):
    """[(class, places in pixels)]"""
    found = []
    with open(path) as file:
        for line in file:
            kind, *numbers = line.split()
            places = np.array(numbers, float)
            scale = np.array([width, height] * len(places))[:len(places)].astype(float)
            if poses:
                scale[4:] = np.tile([width, height, 1], (len(places) - 4) // 3)
            found.append((int(kind), places * scale))
    return found


def drawn(polygon, height, width):
    """Pixels whose centres lie inside, by the even-odd rule."""
    y, x = np.mgrid[0:height, 0:width] + 0.5
    odd = np.zeros((height, width), bool)
    points = polygon.reshape(-1, 2)
    for (x0, y0), (x1, y1) in zip(points, np.roll(points, -1, axis=0)):
        if y0 != y1:
            odd ^= ((y0 < y) != (y1 < y)) & (x < x0 + (x1 - x0) * (y - y0) / (y1 - y0))
    return odd


class Yolo(datasets.ExportCase):
    def pictures(self, dataset, folder, record, poses=False):
        """ids, objects and labels of every picture; classes by their numbers from 0."""
        document = load_json(os.path.join(dataset, "objects.json"))
        numbers = [one["id"] for one in document["classes"]]
        classes = {one["id"]: numbers.index(one["class_id"]) for one in document["objects"]}
        for entry in record["names"]:
            ids = layer_of(dataset, "objects", entry["camera"], entry["frame"])
            stem = os.path.splitext(entry["name"][len("images/"):])[0]
            rows = labels(os.path.join(folder, "labels", stem + ".txt"), ids.shape[1], ids.shape[0], poses)
            yield entry, ids, classes, rows

    def test_names_that_yaml_would_change(self):
        dataset = self.render(hard_scenes.hostile(self.path("scene")), LAYERS)
        folder, _ = self.export(dataset, "yolo")
        with open(os.path.join(folder, "data.yaml"), encoding="utf-8") as file:
            read = yaml.safe_load(file)
        self.assertEqual(list(read["names"].values()), [one["name"] for one in load_json(os.path.join(dataset, "objects.json"))["classes"]])
        self.assertIn("größe\u2028XL\u0085", read["names"].values())

        for key in ("names", "path"):
            self.refused("export", dataset, "--format", "yolo", "-o", self.path("no"), "--split", key + "=7:7", status=2, says=("split", f"'{key}'"))
        with open(os.path.join(self.export(dataset, "yolo", "--split", "no=7:7")[0], "data.yaml"), encoding="utf-8") as file:
            self.assertEqual(yaml.safe_load(file)["no"], "images/no")
        nothing = self.render(hard_scenes.nothing(self.path("nothing")), LAYERS)
        with open(os.path.join(self.export(nothing, "yolo")[0], "data.yaml"), encoding="utf-8") as file:
            self.assertEqual(yaml.safe_load(file)["names"], {})  # ultralytics counts them

    def test_boxes_and_segments(self):
        dataset = self.render(datasets.stereo(self.path("scene")), LAYERS)
        boxes, record = self.export(dataset, "yolo", "--split", "train=0:1,val=2:2")
        self.assertEqual(sorted(os.listdir(boxes)), ["data.yaml", "export.json", "images", "labels"])
        with open(os.path.join(boxes, "data.yaml")) as file:
            self.assertEqual(file.read(), 'train: images/train\nval: images/val\nnames:\n  0: "wall"\n  1: "ring"\n  2: "block"\n')
        for _, ids, classes, rows in self.pictures(dataset, boxes, record):
            seen = [i for i in np.unique(ids) if i]
            self.assertEqual([kind for kind, _ in rows], [classes[i] for i in seen])
            for (_, (cx, cy, w, h)), i in zip(rows, seen):
                y, x = np.nonzero(ids == i)
                expected = [(x.min() + x.max() + 1) / 2, (y.min() + y.max() + 1) / 2, np.ptp(x) + 1, np.ptp(y) + 1]
                self.assertLess(np.abs(np.array([cx, cy, w, h]) - expected).max(), 1e-9)
        said = self.planted(dataset, boxes, "labels/train/left_eye_000000.txt", lambda text: text.replace(b" 0.", b" 0.1", 1))
        self.assertIn("layer box", said)
        said = self.planted(dataset, boxes, "labels/train/left_eye_000000.txt", lambda text: b"2" + text[1:])
        self.assertIn("layer category", said)
        segments, record = self.export(dataset, "yolo", "--labels", "segments", "--image-format", "jpg")
        for _, ids, _, rows in self.pictures(dataset, segments, record):
            for (_, polygon), i in zip(rows, [i for i in np.unique(ids) if i]):
                self.assertTrue(np.array_equal(drawn(polygon, *ids.shape), ids == i), "holes too")

    def test_oriented(self):
        dataset = self.render(datasets.stereo(self.path("scene")), LAYERS)
        folder, record = self.export(dataset, "yolo", "--labels", "oriented")
        turned = 0
        for _, ids, _, rows in self.pictures(dataset, folder, record):
            for (_, places), i in zip(rows, [i for i in np.unique(ids) if i]):
                corners = places.reshape(4, 2)
                y, x = np.nonzero(ids == i)
                pixels = np.concatenate([np.stack([x + a, y + b], axis=1) for a in (0, 1) for b in (0, 1)])
                sides = np.roll(corners, -1, axis=0) - corners
                self.assertLess(max(abs(sides[k] @ sides[(k + 1) % 4]) for k in range(4)), 1e-6)
                for corner, side in zip(corners, sides):
                    across = np.array([-side[1], side[0]]) / np.linalg.norm(side)
                    self.assertLess(abs((pixels - corner) @ across).min(), 1e-6)
                    self.assertGreater(((pixels - corner) @ across).min(), -1e-6)
                area = np.linalg.norm(sides[0]) * np.linalg.norm(sides[1])
                angles = np.linspace(0, np.pi / 2, 500)
                around = min(np.prod([np.ptp(pixels @ [np.cos(a), np.sin(a)]), np.ptp(pixels @ [-np.sin(a), np.cos(a)])]) for a in angles)
                self.assertLessEqual(area, around * (1 + 1e-9))
                turned += np.abs(sides[0]).min() > 0.5
        self.assertGreater(turned, 0)
        said = self.planted(dataset, folder, "labels/train/left_eye_000000.txt", lambda text: text.replace(b" 1 ", b" 0.9 ", 1))
        self.assertIn("layer rectangle", said)

    def test_keypoints_and_an_empty_picture(self):
        scene = load_json(datasets.walk(self.path("scene")))
        plain = self.render(self.path("scene", "walk.json"), LAYERS)
        self.refused("export", plain, "--format", "yolo", "-o", self.path("no"), "--labels", "poses", status=2, says="keypoints")
        scene["classes"] = {"wall": 5, "ring": 7, "block": {"id": 9, "keypoints": ["low", "high"]}}
        scene["objects"][2]["keypoints"] = {"low": [-0.5, -0.4, 0.3], "high": [0.5, 0.4, -0.3]}
        dataset = self.render(self.write("scene/pointed.json", json.dumps(scene)), LAYERS)
        folder, record = self.export(dataset, "yolo", "--labels", "poses")
        with open(os.path.join(folder, "data.yaml")) as file:
            self.assertIn("\nkpt_shape: [2, 3]\n", file.read())
        count = 0
        for entry, ids, _, rows in self.pictures(dataset, folder, record, poses=True):
            self.assertEqual(len(rows), int((ids == 3).any()))
            boxes = load_json(os.path.join(dataset, entry["camera"], "boxes", f"{entry['frame']:06d}.json"))["objects"]
            for kind, places in rows:
                self.assertEqual(kind, 2)
                points = {p["name"]: p for p in next(box for box in boxes if box["id"] == 3)["keypoints"]}
                for (x, y, v), name in zip(places[4:].reshape(2, 3), ("low", "high")):
                    if v:
                        self.assertLess(np.abs(np.array([x, y]) - [points[name]["u"], points[name]["v"]]).max(), 1e-9)
                        count += 1
        self.assertGreater(count, 2)
        self.assertEqual(os.path.getsize(os.path.join(folder, "labels", "train", "Kamera_1_000003.txt")), 0)


if __name__ == "__main__":
    main()
