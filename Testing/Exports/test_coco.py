# SPDX-License-Identifier: BSD-3-Clause
"""COCO instances, read from the format's description: masks, boxes and average precision of the ground truth against itself."""
import os

import numpy as np

import datasets
from datasets import load_json, main


def decoded(segmentation):
    """A mask of run lengths, compressed or not (cocoapi, maskApi.c: rleFrString, rleDecode)."""
    height, width = segmentation["size"]
    counts = segmentation["counts"]
    if isinstance(counts, str):
        values, at = [], 0
        while at < len(counts):
            value, k, more = 0, 0, True
            while more:
                c = ord(counts[at]) - 48
                value |= (c & 0x1f) << (5 * k)
                more = bool(c & 0x20)
                at, k = at + 1, k + 1
                if not more and c & 0x10:
                    value |= -1 << (5 * k)
            values.append(value + (values[-2] if len(values) > 2 else 0))
        counts = values
    return np.repeat(np.arange(len(counts)) % 2, counts).reshape(width, height).T.astype(bool)


def drawn(polygons, height, width):
    """Pixels whose centres lie inside."""
    y, x = np.mgrid[0:height, 0:width] + 0.5
    inside = np.zeros((height, width), bool)
    for polygon in polygons:
        points = np.array(polygon).reshape(-1, 2)
        odd = np.zeros((height, width), bool)
        for (x0, y0), (x1, y1) in zip(points, np.roll(points, -1, axis=0)):
            if y0 != y1:
                odd ^= ((y0 < y) != (y1 < y)) & (x < x0 + (x1 - x0) * (y - y0) / (y1 - y0))
        inside |= odd
    return inside


def average_precision(truth, found):
    """Of detections with equal scores at IoU 0.95, matched as COCOeval does: an id of 0 means none."""
    matched = {}
    good = []
    for detection in found:
        best = 0
        for one in truth:
            a, b = one["mask"], detection["mask"]
            same = one["image_id"] == detection["image_id"] and one["category_id"] == detection["category_id"]
            if same and one["id"] not in matched and (a & b).sum() >= 0.95 * (a | b).sum():
                best = one["id"]
        if best:
            matched[best] = True
        good.append(bool(best))
    return sum(good) / max(len(good), len(truth))


class Coco(datasets.ExportCase):
    def setUp(self):
        super().setUp()
        self.dataset = self.render(datasets.stereo(self.path("scene")))

    def instances(self, folder):
        return load_json(os.path.join(folder, "annotations", "instances_train.json"))

    def test_masks_and_boxes_are_those_of_the_dataset(self):
        for form in ("rle", "polygon"):
            folder, record = self.export(self.dataset, "coco", "--masks", form)
            document = self.instances(folder)
            names = {entry["name"]: (entry["camera"], entry["frame"]) for entry in record["names"]}
            images = {image["id"]: image for image in document["images"]}
            self.assertEqual(len(images), 6)
            with_hole = 0
            for one in document["annotations"]:
                image = images[one["image_id"]]
                ids = datasets.layer_of(self.dataset, "objects", *names["train/" + image["file_name"]])
                shape = one["segmentation"]
                if isinstance(shape, list):
                    mask = drawn(shape, *ids.shape)
                else:
                    mask = decoded(shape)
                    with_hole += form == "polygon"
                self.assertTrue(np.array_equal(mask, ids == one["object_id"]))
                rows, columns = np.nonzero(mask)
                self.assertEqual(one["bbox"], [columns.min(), rows.min(), np.ptp(columns) + 1, np.ptp(rows) + 1])
                self.assertEqual(one["area"], mask.sum())
                amodal = decoded(one["amodal_segmentation"])
                self.assertTrue((amodal | ~mask).all())
                self.assertAlmostEqual(one["visible_fraction"], mask.sum() / amodal.sum())
                one["mask"] = mask
            self.assertEqual(average_precision(document["annotations"], document["annotations"]), 1.0)
            self.assertGreater(min(one["id"] for one in document["annotations"]), 0)
            if form == "polygon":
                self.assertGreater(with_hole, 0)  # the ring and the wall behind it

    def test_classes_and_files(self):
        folder, _ = self.export(self.dataset, "coco", "--image-format", "jpg", "--split", "train=0:0,val=1:2")
        self.assertEqual(sorted(os.listdir(folder)), ["annotations", "export.json", "train", "val"])
        document = self.instances(folder)
        self.assertEqual([c["name"] for c in document["categories"]],
                         [c["name"] for c in load_json(os.path.join(self.dataset, "objects.json"))["classes"]])
        for image in document["images"]:
            with open(os.path.join(folder, "train", image["file_name"]), "rb") as file:
                self.assertEqual(file.read(2), b"\xff\xd8")

    def test_a_picture_without_an_object(self):
        dataset = self.render(datasets.walk(self.path("walk")))
        document = self.instances(self.export(dataset, "coco")[0])
        self.assertEqual(len(document["images"]), 4)
        self.assertEqual({one["image_id"] for one in document["annotations"]}, {1, 2, 3})

    def test_the_referee_finds_what_is_wrong(self):
        folder, _ = self.export(self.dataset, "coco", "--image-format", "jpg")
        name = "annotations/instances_train.json"
        said = self.planted(self.dataset, folder, name, lambda text: text.replace(b'"bbox":[', b'"bbox":[1', 1))
        self.assertIn("layer box", said)
        said = self.planted(self.dataset, folder, name, lambda text: text.replace(b'"area":', b'"area":1', 1))
        self.assertIn("layer area", said)
        said = self.planted(self.dataset, folder, name, lambda text: text.replace(b'"category_id":', b'"category_id":1', 1))
        self.assertIn("layer category", said)
        picture = os.listdir(os.path.join(folder, "train"))[0]
        other = os.path.join(self.dataset, "right.eye", "color", "000002.png")
        with open(other, "rb") as file:
            self.assertIn("check", self.planted(self.dataset, folder, "train/" + picture, lambda old, new=file.read(): new))


if __name__ == "__main__":
    main()
