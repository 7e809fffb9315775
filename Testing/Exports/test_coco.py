# SPDX-License-Identifier: BSD-3-Clause
"""COCO instances, keypoints and panoptic segments, read from the format's description: masks, boxes and average precision of the ground truth against itself."""
import json
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


def panoptic_quality(truth, found, categories):
    """PQ of Kirillov et al. 2019, mean over the categories that are there. Both are lists of pictures: (codes, {code: category}), 0 is VOID.

    Segments of one category match above an IoU of 0.5, the truth's VOID left out of the union; what is found mostly there counts for nothing."""
    qualities = []
    for category in categories:
        overlap, matches, missed, wrong = 0.0, 0, 0, 0
        for (codes, segments), (other, guesses) in zip(truth, found):
            left = {number for number, kind in guesses.items() if kind == category}
            for number in (number for number, kind in segments.items() if kind == category):
                mine = codes == number
                ratio = {guess: (mine & (other == guess)).sum() / (mine | (other == guess) & (codes != 0)).sum() for guess in left}
                best = max(ratio, key=ratio.get, default=None)
                if best is not None and ratio[best] > 0.5:
                    overlap, matches = overlap + ratio[best], matches + 1
                    left.remove(best)
                else:
                    missed += 1
            wrong += sum((codes[other == guess] == 0).mean() <= 0.5 for guess in left)
        if matches + missed + wrong:
            qualities.append(overlap / (matches + missed / 2 + wrong / 2))
    return np.mean(qualities)


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

    def test_licence_and_supercategories(self):
        scene = load_json(datasets.walk(self.path("scene"), empty=False))
        scene["dataset"] = {"name": "Walk", "license": "CC0-1.0", "licenseUrl": "https://example.org/cc0", "author": "Ä. B."}
        scene["classes"] = {"wall": {"id": 7, "supercategory": "building", "thing": False}, "ring": 2, "block": {"id": 9, "supercategory": "toy"}}
        document = self.instances(self.export(self.render(self.write("scene/named.json", json.dumps(scene))), "coco")[0])
        self.assertEqual(document["info"]["contributor"], "Ä. B.")
        self.assertEqual(document["licenses"], [{"id": 1, "name": "CC0-1.0", "url": "https://example.org/cc0"}])
        self.assertEqual({image["license"] for image in document["images"]}, {1})
        self.assertEqual([(c["id"], c["supercategory"]) for c in document["categories"]], [(2, ""), (7, "building"), (9, "toy")])


class Keypoints(datasets.ExportCase):
    CORNERS = {"low": [-0.5, -0.4, 0.3], "high": [0.5, 0.4, 0.3], "back": [-0.5, -0.4, -0.3]}

    def test_points_are_projections(self):
        scene = load_json(datasets.stereo(self.path("scene")))
        scene["classes"] = {"wall": 1, "ring": 2, "block": {"id": 3, "keypoints": ["low", "high", "tail", "back"], "skeleton": [[1, 2], [2, 4]]}}
        for one in scene["objects"][2:]:
            one["keypoints"] = self.CORNERS
        dataset = self.render(self.write("scene/pointed.json", json.dumps(scene)))
        folder, record = self.export(dataset, "coco")
        document = load_json(os.path.join(folder, "annotations", "person_keypoints_train.json"))
        self.assertEqual([(c["name"], c["keypoints"], c["skeleton"]) for c in document["categories"]],
                         [("block", ["low", "high", "tail", "back"], [[1, 2], [2, 4]])])
        names = {entry["name"]: (entry["camera"], entry["frame"]) for entry in record["names"]}
        images = {image["id"]: names["train/" + image["file_name"]] for image in document["images"]}
        cameras = datasets.cameras_of(dataset)
        poses = {(pose["frame"], pose["id"]): np.array(pose["matrix"]).reshape(3, 4) for pose in load_json(os.path.join(dataset, "poses.json"))["poses"]}
        codes = set()
        for one in document["annotations"]:
            self.assertEqual(one["category_id"], 3)
            camera = cameras[images[one["image_id"]]]
            points = np.array(one["keypoints"]).reshape(4, 3)
            self.assertEqual(points[2].tolist(), [0, 0, 0])
            self.assertEqual(one["num_keypoints"], np.count_nonzero(points[:, 2]))
            for (x, y, v), name in zip(points, ("low", "high", None, "back")):
                codes.add(v)
                if v:
                    world = poses[images[one["image_id"]][1], one["object_id"]] @ [*self.CORNERS[name], 1]
                    pixel = camera["K"] @ (camera["R"] @ world + camera["t"])
                    self.assertLess(np.abs(pixel[:2] / pixel[2] - 0.5 - [x, y]).max(), 1e-9)
        self.assertEqual(codes, {0, 1, 2})
        said = self.planted(dataset, folder, "annotations/person_keypoints_train.json", lambda text: text.replace(b'"keypoints":[', b'"keypoints":[1', 1))
        self.assertIn("layer keypoints", said)


class Panoptic(datasets.ExportCase):
    def test_every_pixel_has_its_segment(self):
        """As pq_compute reads a set and compares it with itself: PQ is 1."""
        dataset = self.render(datasets.stereo(self.path("scene")), "color,objects")
        folder, record = self.export(dataset, "coco-panoptic", "--stuff", "wall,block")
        document = load_json(os.path.join(folder, "annotations", "panoptic_train.json"))
        things = {c["id"]: c["isthing"] for c in document["categories"]}
        self.assertEqual([(c["name"], c["isthing"]) for c in document["categories"]], [("wall", 0), ("ring", 1), ("block", 0)])
        colors = {tuple(c["color"]) for c in document["categories"]}  # panopticapi's converters want one of each
        self.assertEqual((len(colors), {len(color) for color in colors}), (3, {3}))
        self.assertTrue(all(0 <= value < 256 for color in colors for value in color))
        names = {entry["name"]: (entry["camera"], entry["frame"]) for entry in record["names"]}
        images = {image["id"]: names["train/" + image["file_name"]] for image in document["images"]}
        classes = {o["id"]: o["class_id"] for o in load_json(os.path.join(dataset, "objects.json"))["objects"]}
        self.assertEqual(len(document["annotations"]), 6)
        for one in document["annotations"]:
            colors = datasets.read_png(os.path.join(folder, "annotations", "panoptic_train", one["file_name"])).astype(int)
            codes = colors[..., 0] + 256 * colors[..., 1] + 65536 * colors[..., 2]
            segments = {segment["id"]: segment for segment in one["segments_info"]}
            self.assertEqual(set(np.unique(codes)) - {0}, set(segments))
            ids = datasets.layer_of(dataset, "objects", *images[one["image_id"]])
            self.assertTrue(np.array_equal(codes == 0, ids == 0))
            seen = [segment["category_id"] for segment in segments.values()]
            self.assertEqual(len([c for c in seen if not things[c]]), len({c for c in seen if not things[c]}), "stuff is one segment")
            for number, segment in segments.items():
                rows, columns = np.nonzero(codes == number)
                self.assertEqual(segment["area"], len(rows))
                self.assertEqual(segment["bbox"], [columns.min(), rows.min(), np.ptp(columns) + 1, np.ptp(rows) + 1])
                self.assertEqual({classes[i] for i in np.unique(ids[codes == number])}, {segment["category_id"]})
        self.quality(folder, document)
        said = self.planted(dataset, folder, "annotations/panoptic_train.json", lambda text: text.replace(b'"area":', b'"area":1', 1))
        self.assertIn("layer area", said)
        other = os.path.join(folder, "annotations", "panoptic_train", "right_eye_000002.png")
        with open(other, "rb") as file:
            said = self.planted(dataset, folder, "annotations/panoptic_train/left_eye_000000.png", lambda old, new=file.read(): new)
        self.assertIn("layer objects", said)

    def quality(self, folder, document):
        """1 against itself; of damaged sets what the ring's pixels, the one category that is damaged, come to."""
        pictures = []
        for one in document["annotations"]:
            colors = datasets.read_png(os.path.join(folder, "annotations", "panoptic_train", one["file_name"])).astype(int)
            pictures.append((colors @ [1, 256, 65536], {segment["id"]: segment["category_id"] for segment in one["segments_info"]}))
        categories = {c["name"]: c["id"] for c in document["categories"]}
        self.assertEqual(panoptic_quality(pictures, pictures, categories.values()), 1)

        def kept(share):
            """Of each ring the first pixels only."""
            damaged, left = [], []
            for codes, segments in pictures:
                [ring] = [number for number, kind in segments.items() if kind == categories["ring"]]
                codes, places = codes.copy(), np.flatnonzero(codes == ring)
                left.append(int(share * len(places)) / len(places))
                codes.flat[places[int(share * len(places)):]] = 0
                damaged.append((codes, segments))
            return panoptic_quality(pictures, damaged, categories.values()), np.mean(left)

        for share in (0.9, 0.6):
            found, ring = kept(share)
            self.assertAlmostEqual(found, (1 + 1 + ring) / 3, places=12)
        self.assertAlmostEqual(kept(0.4)[0], 2 / 3, places=12)  # matched no more
        renamed = [(codes, {n: categories["block"] if kind == categories["ring"] else kind for n, kind in segments.items()}) for codes, segments in pictures]
        # of the block 6 are matched and 6 too many; of the ring 6 are missed
        self.assertAlmostEqual(panoptic_quality(pictures, renamed, categories.values()), (1 + 0 + 6 / (6 + 6 / 2)) / 3, places=12)

    def test_things_of_the_dataset_and_refusals(self):
        scene = load_json(datasets.walk(self.path("scene")))  # its last frame is empty
        scene["classes"] = {"wall": {"id": 7, "thing": False, "color": [1, 2, 3]}, "ring": 2, "block": 9}
        dataset = self.render(self.write("scene/named.json", json.dumps(scene)), "color,objects")
        folder, _ = self.export(dataset, "coco-panoptic", "--split", "train=0:1,val=2:3")
        document = load_json(os.path.join(folder, "annotations", "panoptic_val.json"))
        self.assertEqual([c["isthing"] for c in document["categories"]], [1, 0, 1])
        self.assertEqual(document["annotations"][1]["segments_info"], [])
        self.refused("export", dataset, "--format", "coco-panoptic", "-o", self.path("no"), "--stuff", "wal", status=2, says=("stuff", "wall"))
        self.assertFalse(os.path.exists(self.path("no")))


if __name__ == "__main__":
    main()
