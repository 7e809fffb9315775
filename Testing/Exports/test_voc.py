# SPDX-License-Identifier: BSD-3-Clause
"""Pascal VOC sets, read as torchvision does: XML by ElementTree, codes of the palette pictures."""
import json
import os
import struct
import xml.etree.ElementTree as ElementTree
import zlib

import numpy as np

import datasets
from datasets import layer_of, load_json, main

LAYERS = "color,objects,boxes"


def read_palette(path):
    """Codes and colours of a palette PNG of 8 bits."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed, palette = 8, b"", None
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(kind + body)
        if kind == b"IHDR":
            width, height, bits, color = struct.unpack(">IIBB", body[:10])
        elif kind == b"PLTE":
            palette = np.frombuffer(body, np.uint8).reshape(-1, 3)
        packed += body if kind == b"IDAT" else b""
        at += 12 + size
    assert (bits, color) == (8, 3), path
    raw = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, width + 1)
    rows, above = [], np.zeros(width, np.uint8)
    for kind, line in zip(raw[:, 0], raw[:, 1:]):
        assert kind in (0, 1, 2), kind
        above = line if kind == 0 else np.cumsum(line, dtype=np.uint8) if kind == 1 else line + above
        rows.append(above)
    return np.array(rows), palette


class Voc(datasets.ExportCase):
    def test_annotations_and_masks(self):
        dataset = self.render(datasets.stereo(self.path("scene")), LAYERS)
        folder, record = self.export(dataset, "voc", "--split", "train=0:1,val=2:2")
        self.assertEqual(sorted(os.listdir(folder)), ["Annotations", "ImageSets", "JPEGImages", "SegmentationClass", "SegmentationObject", "export.json"])
        with open(os.path.join(folder, "ImageSets", "Main", "val.txt")) as file:
            self.assertEqual(file.read(), "left_eye_000002\nright_eye_000002\n")
        classes = [one["name"] for one in load_json(os.path.join(dataset, "objects.json"))["classes"]]
        cut, hidden = 0, 0
        for entry in record["names"]:
            stem = os.path.splitext(os.path.basename(entry["name"]))[0]
            ids = layer_of(dataset, "objects", entry["camera"], entry["frame"])
            root = ElementTree.parse(os.path.join(folder, "Annotations", stem + ".xml")).getroot()
            self.assertEqual(root.findtext("filename"), stem + ".jpg")
            with open(os.path.join(folder, "JPEGImages", stem + ".jpg"), "rb") as file:
                data = file.read()
            self.assertEqual(data[:2], b"\xff\xd8")
            frame = data[data.index(b"\xff\xc0") + 4:]  # bits, height, width, components: of each a number, its sampling and its table
            self.assertEqual((frame[5], frame[7:15:3]), (3, b"\x11" * 3))
            kinds, palette = read_palette(os.path.join(folder, "SegmentationClass", stem + ".png"))
            instances, _ = read_palette(os.path.join(folder, "SegmentationObject", stem + ".png"))
            self.assertEqual(palette[[0, 1, 2, 15, 255]].tolist(), [[0, 0, 0], [128, 0, 0], [0, 128, 0], [192, 128, 128], [224, 224, 192]])
            seen = [i for i in np.unique(ids) if i]
            self.assertEqual(len(root.findall("object")), len(seen))
            self.assertTrue(np.array_equal(instances == 0, ids == 0))
            for number, (one, i) in enumerate(zip(root.findall("object"), seen), 1):
                y, x = np.nonzero(ids == i)
                box = [int(one.find("bndbox").findtext(key)) for key in ("xmin", "ymin", "xmax", "ymax")]
                self.assertEqual(box, [x.min() + 1, y.min() + 1, x.max() + 1, y.max() + 1])
                self.assertTrue(np.array_equal(instances == number, ids == i))
                self.assertEqual(set(kinds[ids == i]), {classes.index(one.findtext("name")) + 1})
                cut += int(one.findtext("truncated"))
                hidden += int(one.findtext("occluded"))
        self.assertGreater(cut, 0)
        self.assertGreater(hidden, 0)
        name = "Annotations/left_eye_000000.xml"
        self.assertIn("layer box", self.planted(dataset, folder, name, lambda text: text.replace(b"<xmin>", b"<xmin>1", 1)))
        self.assertIn("layer category", self.planted(dataset, folder, name, lambda text: text.replace(b"<name>wall", b"<name>ring", 1)))
        with open(os.path.join(folder, "SegmentationClass", "left_eye_000002.png"), "rb") as file:
            said = self.planted(dataset, folder, "SegmentationClass/left_eye_000000.png", lambda old, new=file.read(): new)
        self.assertIn("layer codes", said)

    def test_an_object_without_a_class(self):
        """A reader that finds no text has no name at all."""
        dataset = self.render(datasets.street(self.path("scene")), LAYERS + ",amodal")
        folder, record = self.export(dataset, "voc")
        names = set()
        for entry in record["names"]:
            stem = os.path.splitext(os.path.basename(entry["name"]))[0]
            names.update(one.findtext("name") for one in ElementTree.parse(os.path.join(folder, "Annotations", stem + ".xml")).getroot().findall("object"))
        self.assertEqual(names, {"wall", "Car", "delivery van", "object"})
        with open(os.path.join(self.export(dataset, "coco")[0], "annotations", "instances_train.json"), encoding="utf-8") as file:
            self.assertEqual({one["name"] for one in json.load(file)["categories"]}, names)
        with open(os.path.join(self.export(dataset, "yolo")[0], "data.yaml"), encoding="utf-8") as file:
            self.assertIn(': "object"\n', file.read())

    def test_letters_digits_and_minus_are_what_names_keep(self):
        path = datasets.stereo(self.path("scene"), 1)
        with open(path, encoding="utf-8") as file:
            scene = json.load(file)
        for camera, name in zip(scene["cameras"], ("AZaz09-", "[`{;.=")):
            camera["name"] = name
        folder, _ = self.export(self.render(datasets._write(os.path.dirname(path), "names", scene), LAYERS), "voc")
        self.assertEqual(sorted(os.listdir(os.path.join(folder, "JPEGImages"))), ["AZaz09-_000000.jpg", "_______000000.jpg"])

    def test_an_empty_picture(self):
        dataset = self.render(datasets.walk(self.path("scene")), LAYERS)
        folder, _ = self.export(dataset, "voc")
        root = ElementTree.parse(os.path.join(folder, "Annotations", "Kamera_1_000003.xml")).getroot()
        self.assertEqual(root.findall("object"), [])


if __name__ == "__main__":
    main()
