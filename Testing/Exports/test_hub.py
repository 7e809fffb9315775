# SPDX-License-Identifier: BSD-3-Clause
"""WebDataset and ImageFolder: tars read by Python's tarfile and grouped as the format says, cards by PyYAML, Croissant by its structure."""
import fnmatch
import hashlib
import io
import json
import os
import re
import shutil
import tarfile

import numpy as np
import yaml

import datasets
from datasets import cameras_of, layer_of, load_json, main, read_png

LAYERS = "color,depth,objects,classes,boxes,amodal,disparity,flow_forward,normal,alpha,tiles,correspondence"
INFO = {"name": "Ringe & Blöcke: ein \"Satz\"", "license": "CC0-1.0", "author": "A. Nobody", "description": "Two: # and more",
        "citation": "@misc{x, title={Y}}", "url": "https://example.org/x", "version": "1.2.0"}


def with_info(scene, info):
    document = load_json(scene)
    document["dataset"] = info
    with open(scene, "w") as file:
        json.dump(document, file)
    return scene


def base_plus_ext(path):
    """WebDataset: the key is all up to the first dot of the base name."""
    match = re.match(r"^((?:.*/|)[^.]+)[.]([^/]*)$", path)
    return match.groups() if match else (None, None)


def group_by_keys(tar):
    """WebDataset: files with one key that stand next to each other are a sample."""
    sample = {}
    for member in tar:
        key, extension = base_plus_ext(member.name)
        if sample and sample["__key__"] != key:
            yield sample
            sample = {}
        sample["__key__"] = key
        assert extension not in sample, member.name
        sample[extension] = tar.extractfile(member).read()
    yield sample


class Hub(datasets.ExportCase):
    def png(self, data):
        return read_png(self.write("member.png", data))

    def head(self, folder):
        with open(os.path.join(folder, "README.md"), encoding="utf-8") as file:
            _, head, body = file.read().split("---\n", 2)
        return yaml.safe_load(head), body

    def croissant(self, folder):
        """The document, after what mlcroissant demands of one: context, ids, references, hashes, patterns that fit files."""
        document = load_json(os.path.join(folder, "croissant.json"))
        context = document["@context"]
        self.assertEqual(context["@vocab"], "https://schema.org/")
        self.assertEqual((context["cr"], context["conformsTo"]), ("http://mlcommons.org/croissant/", "dct:conformsTo"))
        self.assertEqual((document["@type"], document["conformsTo"]), ("sc:Dataset", "http://mlcommons.org/croissant/1.0"))
        self.assertNotIn("datePublished", document)
        ids, names = set(), []
        for one in document["distribution"]:
            self.assertNotIn(one["@id"], ids)
            ids.add(one["@id"])
            if one["@type"] == "cr:FileObject":
                with open(os.path.join(folder, one["contentUrl"]), "rb") as file:
                    data = file.read()
                self.assertEqual((one["sha256"], one["contentSize"]), (hashlib.sha256(data).hexdigest(), f"{len(data)} B"))
                if one["encodingFormat"] == "application/x-tar":
                    with tarfile.open(fileobj=io.BytesIO(data)) as tar:
                        names += tar.getnames()
        for place, _, files in os.walk(folder):
            names += [os.path.relpath(os.path.join(place, name), folder) for name in files]
        found = {}
        for one in document["distribution"]:
            if one["@type"] == "cr:FileSet":
                self.assertLessEqual({holder["@id"] for holder in one.get("containedIn", [])}, ids)
                found[one["@id"]] = fnmatch.filter(names, one["includes"])
                self.assertTrue(found[one["@id"]], one)
        for records in document["recordSet"]:
            self.assertEqual([field["name"] for field in records["field"]], ["key", "content"])
            for field in records["field"]:
                self.assertTrue(field["@id"].startswith(records["@id"] + "/"))
                files = found[field["source"]["fileSet"]["@id"]]
                self.assertIn(field["dataType"], ("sc:Text", "sc:ImageObject"))
                if "transform" in field["source"]:
                    keys = [re.search(field["source"]["transform"]["regex"], name).group(1) for name in files]
                    self.assertEqual(len(set(keys)), len(files))
        return document, found


class WebDataset(Hub):
    def samples(self, folder, names):
        found = {}
        for name in names:
            with tarfile.open(os.path.join(folder, name)) as tar:
                for member in tar.getmembers():
                    self.assertTrue(member.isfile())
                    self.assertEqual((member.mtime, member.uid, member.gid, member.mode, member.uname), (0, 0, 0, 0o644, ""))
                for sample in group_by_keys(tar):
                    self.assertNotIn(sample["__key__"], found)
                    found[sample["__key__"]] = sample
        return found

    def test_all_layers(self):
        dataset = self.render(with_info(datasets.stereo(self.path("scene")), INFO), LAYERS)
        folder, record = self.export(dataset, "webdataset", "--samples-per-shard", 4)
        self.assertEqual(sorted(os.listdir(folder)),
                         ["README.md", "croissant.json", "export.json", "objects.json", "train-000000.tar", "train-000001.tar"])
        samples = self.samples(folder, ["train-000000.tar", "train-000001.tar"])
        self.assertEqual(sorted(samples), sorted(one["name"] for one in record["names"]))
        cameras = cameras_of(dataset)
        poses = load_json(os.path.join(dataset, "poses.json"))["poses"]
        for one in record["names"]:
            camera, frame, sample = one["camera"], one["frame"], samples[one["name"]]
            raw = lambda layer, end: open(os.path.join(dataset, camera, layer, f"{frame:06d}.{end}"), "rb").read()  # noqa: E731, B023, SIM115
            self.assertEqual(sample["color.png"], raw("color", "png"))
            self.assertEqual(sample["amodal.json"], raw("amodal", "json"))
            self.assertEqual(sample["disparity_class.png"], raw("disparity", "png"))
            for layer in ("depth", "normal", "disparity"):
                array = np.load(io.BytesIO(sample[layer + ".npy"]))
                expected = layer_of(dataset, layer, camera, frame)
                self.assertEqual((array.dtype, array.tobytes()), (expected.dtype, expected.tobytes()))
            self.assertTrue(np.array_equal(self.png(sample["objects.png"])[..., 0], layer_of(dataset, "objects", camera, frame)))
            self.assertEqual("flow_forward.npy" in sample, frame < 2)
            if frame < 2:
                flow = np.load(io.BytesIO(sample["flow_forward.npy"]))
                plain = np.frombuffer(raw("flow_forward", "flo")[12:], "<f4").reshape(72, 96, 2)
                self.assertTrue(np.array_equal(flow, np.where(np.abs(plain) < 1e9, plain, np.nan), equal_nan=True))
            document = json.loads(sample["json"])
            self.assertTrue(np.array_equal(document["camera"]["K"], cameras[camera, frame]["K"]))
            self.assertEqual(document["camera"]["name"], camera)
            self.assertEqual(document["poses"], [pose for pose in poses if pose["frame"] == frame])
            self.assertEqual(document["boxes"], json.loads(raw("boxes", "json"))["objects"])
            self.assertEqual((document["seconds"], document["metres_per_unit"]), (frame / 25, 1))
            self.assertEqual(set(document["members"]) | {"json", "__key__"}, set(sample))
            there = {os.path.join(root, name) for root, _, names in os.walk(os.path.join(dataset, camera)) for name in names if f"{frame:06d}" in name}
            named = {os.path.join(dataset, path) for path in document["members"].values()}
            self.assertEqual({path for path in there - named if "/boxes/" not in path}, set())
        head, body = self.head(folder)
        self.assertEqual((head["license"], head["pretty_name"]), ("cc0-1.0", INFO["name"]))
        self.assertEqual(head["configs"], [{"config_name": "default", "data_files": [{"split": "train", "path": "train-*.tar"}]}])
        self.assertIn(INFO["citation"], body)
        document, sets = self.croissant(folder)
        for key, value in {"name": "name", "url": "url", "version": "version", "citeAs": "citation", "license": "license"}.items():
            self.assertEqual(document[key], INFO[value])
        self.assertEqual(len(sets["json-files"]), 6)
        self.assertEqual(len(sets["flow_forward.npy-files"]), 4)
        kinds = {one["@id"]: one["encodingFormat"] for one in document["distribution"]}
        self.assertEqual((kinds["json-files"], kinds["color.png-files"]), ("application/json", "image/png"))

    def test_parts_and_pictures_that_lack_layers(self):
        dataset = self.render(datasets.stereo(self.path("scene")), "color,flow_forward,objects")
        folder, _ = self.export(dataset, "webdataset", "--uniform", "--split", "train=0:1,val=2:2")
        parts = {part: self.samples(folder, [part + "-000000.tar"]) for part in ("train", "val")}
        self.assertEqual([len(samples) for samples in parts.values()], [4, 2])
        self.assertEqual(len({frozenset(sample) for samples in parts.values() for sample in samples.values()}), 1)
        self.assertEqual([one["split"] for one in self.head(folder)[0]["configs"][0]["data_files"]], ["train", "val"])
        self.croissant(folder)
        folder, record = self.export(dataset, "webdataset", "--image-format", "jpg", "--quality", 80)
        self.assertGreater(record["layers"][0]["largest_rounding"], 0)
        sample = self.samples(folder, ["train-000000.tar"])["left_eye_000000"]
        self.assertEqual(sample["color.jpg"][:3], b"\xff\xd8\xff")

    def test_ids_beyond_sixteen_bits_are_numbers(self):
        """Where an object's id does not fit into a PNG's sample, all are numbers of 32 bits."""
        dataset = self.render(datasets.stereo(self.path("scene")), "color,objects")
        path, manifest = (os.path.join(dataset, name) for name in ("objects.json", "manifest.json"))
        document = load_json(path)
        document["objects"].append({**document["objects"][0], "name": "late", "id": 65536})
        hashes = []
        for text in (None, json.dumps(document)):
            if text:
                self.write(path, text)
            with open(path, "rb") as file:
                hashes.append(hashlib.sha256(file.read()).hexdigest())
        with open(manifest, encoding="utf-8") as file:
            self.write(manifest, file.read().replace(*hashes))
        self.dgtk("export", dataset, "--format", "webdataset", "-o", self.path("large"), "--quiet")
        sample = self.samples(self.path("large"), ["train-000000.tar"])["left_eye_000001"]
        found = np.load(io.BytesIO(sample["objects.npy"]))
        self.assertEqual(found.dtype, np.uint32)
        self.assertTrue(np.array_equal(found, layer_of(dataset, "objects", "left eye", 1)))

    def test_many_cameras_lenses_and_an_empty_frame(self):
        many = self.render(datasets.many(self.path("many")), "color,objects")
        folder, _ = self.export(many, "webdataset", "--samples-per-shard", 7)
        self.assertEqual(len(self.samples(folder, [f"train-{i:06d}.tar" for i in range(5)])), 30)
        for scene in (datasets.lenses(self.path("lenses")), datasets.walk(self.path("walk"))):
            self.export(self.render(scene), "webdataset")

    def breaches(self, dataset, folder, change):
        """Layers that the referee finds wrong when a shard is changed, and all hashes with it."""
        copy = self.path(f"changed-{len(os.listdir(self.folder))}")
        shutil.copytree(folder, copy)
        path = os.path.join(copy, "train-000000.tar")
        with open(path, "rb") as file:
            old = file.read()
        new = change(old)
        self.assertNotEqual(old, new)
        with open(path, "wb") as file:
            file.write(new)

        def digest(data):
            return hashlib.sha256(data).hexdigest().encode()

        with open(os.path.join(copy, "croissant.json"), "rb") as file:
            card = file.read()
        mended = card.replace(digest(old), digest(new)).replace(b'"%d B"' % len(old), b'"%d B"' % len(new))
        record = load_json(os.path.join(copy, "export.json"))
        for row in record["files"]:
            for name, data in (("train-000000.tar", new), ("croissant.json", mended)):
                if row["path"] == name:
                    row.update(sha256=digest(data).decode(), bytes=len(data))
        for name, data in (("croissant.json", mended), ("export.json", datasets.sealed(record))):
            with open(os.path.join(copy, name), "wb") as file:
                file.write(data)
        return {row["layer"] for row in self.referee(dataset, copy, status=1)["residuals"] if row["breach"]}

    def test_the_referee_finds_what_is_wrong(self):
        dataset = self.render(datasets.stereo(self.path("scene")), LAYERS)
        folder, _ = self.export(dataset, "webdataset")
        with tarfile.open(os.path.join(folder, "train-000000.tar")) as tar:
            offsets = {one.name: one.offset_data for one in tar}

        def flipped(at):
            return lambda data: data[:at] + bytes([data[at] ^ 1]) + data[at + 1:]

        for member, layer in (("left_eye_000001.depth.npy", "depth"), ("right_eye_000002.disparity.npy", "disparity"),
                              ("left_eye_000000.color.png", "color")):
            self.assertEqual(self.breaches(dataset, folder, flipped(offsets[member] + 3000)), {layer})
        self.assertEqual(self.breaches(dataset, folder, flipped(offsets["left_eye_000000.objects.png"] + 100)), {"documents"})
        for old, new, layer in ((b'"seconds":0.04', b'"seconds":0.05', "time"), (b'"K":[[86', b'"K":[[87', "camera"),
                                (b'"pixels_visible":1', b'"pixels_visible":2', "boxes"), (b'"t":[0.7,', b'"t":[0.8,', "poses")):
            self.assertEqual(self.breaches(dataset, folder, lambda text, old=old, new=new: text.replace(old, new, 1)), {layer})
        self.assertIn("documents", self.breaches(dataset, folder, flipped(147)))
        self.assertIn("documents", self.breaches(dataset, folder, lambda text: text[:-1024]))
        self.assertIn("layer croissant", self.planted(dataset, folder, "croissant.json", lambda text: text.replace(b'"sha256": "', b'"sha256": "0', 1)))
        self.assertIn("layer parts", self.planted(dataset, folder, "README.md", lambda text: text.replace(b"train-*", b"trian-*")))

    def test_refusals(self):
        dataset = self.render(datasets.walk(self.path("scene")), "color")
        self.refused("export", dataset, "--format", "webdataset", "-o", self.path("no"), "--split", "my-train=0:2", status=2, says="letters, digits and _")
        self.refused("export", self.render(self.path("scene", "walk.json"), "depth"), "--format", "webdataset", "-o", self.path("no"), status=2, says="lacks layers")
        long = datasets.walk(self.path("long"))
        document = load_json(long)
        document["cameras"][0]["name"] = "x" * 95
        with open(long, "w") as file:
            json.dump(document, file)
        self.refused("export", self.render(long, "color"), "--format", "webdataset", "-o", self.path("no"), status=2, says="100 bytes")
        self.assertFalse(os.path.exists(self.path("no")))


class ImageFolder(Hub):
    def test_pictures_and_metadata(self):
        dataset = self.render(with_info(datasets.walk(self.path("scene")), {**INFO, "license": "My Own", "licenseUrl": "https://example.org/l"}))
        folder, record = self.export(dataset, "imagefolder", "--split", "train=0:1,test=2:3")
        head, _ = self.head(folder)
        self.assertEqual((head["license"], head["license_name"], head["license_link"]), ("other", "my own", "https://example.org/l"))
        self.assertEqual(head["configs"][0]["data_files"], [{"split": "train", "path": "train/**"}, {"split": "test", "path": "test/**"}])
        seen = 0
        for part in ("train", "test"):
            with open(os.path.join(folder, part, "metadata.jsonl"), encoding="utf-8") as file:
                lines = [json.loads(line) for line in file]
            self.assertEqual(sorted(os.listdir(os.path.join(folder, part))), sorted(["metadata.jsonl"] + [line["file_name"] for line in lines]))
            for line in lines:
                frame = line["camera"]["frame"]
                self.assertEqual(record["names"][frame]["name"], f"{part}/{line['file_name']}")
                self.assertTrue(np.array_equal(read_png(os.path.join(folder, part, line["file_name"])), layer_of(dataset, "color", "Kamera 1", frame)))
                ids = layer_of(dataset, "objects", "Kamera 1", frame)
                objects = line["objects"]
                self.assertEqual(set(objects["id"]), set(np.unique(ids)) - {0})
                for number, box in zip(objects["id"], objects["bbox"]):
                    v, u = np.nonzero(ids == number)
                    self.assertEqual(box, [u.min(), v.min(), u.max() + 1 - u.min(), v.max() + 1 - v.min()])
                    seen += 1
        self.assertGreater(seen, 5)
        document, _ = self.croissant(folder)
        self.assertEqual(document["license"], "https://example.org/l")
        for old, new, layer in ((b'"bbox":[[0', b'"bbox":[[1', "box"), (b'"wall"', b'"well"', "category"), (b'"frame":0', b'"frame":1', "camera")):
            self.assertIn("layer " + layer, self.planted(
                dataset, folder, "train/metadata.jsonl",
                lambda text, old=old, new=new: text[::-1].replace(old[::-1], new[::-1], 1)[::-1] if old == b'"wall"' else text.replace(old, new, 1)))

    def test_the_size_is_that_of_all_scenes(self):
        """1000 pictures are no longer fewer than 1K, whatever part of them a scene has."""
        os.makedirs(self.path("scenes"))
        self.write("scenes/quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n")
        for number, last in enumerate((0, 499, 498)):
            eye = {"keys": [[0, [0, 0, 5]], [last, [0, 0, 6]]]} if last else [0, 0, 5]
            self.write(f"scenes/s{number}.json", json.dumps({
                "units": "m", "fps": 10, "objects": [{"name": "quad", "model": "quad.obj"}],
                "cameras": [{"name": "view", "width": 8, "height": 6, "eye": eye, "lookAt": [0, 0, 0]}]}))
        self.dgtk("render", self.path("scenes"), "-o", self.path("all"), "--layers", "color", "--quiet")
        folder, record = self.export(self.path("all"), "imagefolder")
        self.assertEqual(len(record["names"]), 1000)
        self.assertEqual(self.head(folder)[0]["size_categories"], ["1K<n<10K"])

    def test_the_size_is_that_of_the_parts(self):
        path = datasets.walk(self.path("scene"), frames=1000, empty=False)
        dataset = self.render(path, "color", "--size", "8x6")
        for part, size in (("0:998", "n<1K"), ("0:999", "1K<n<10K")):
            folder, _ = self.export(dataset, "webdataset", "--split", "train=" + part)
            self.assertEqual(self.head(folder)[0]["size_categories"], [size])


if __name__ == "__main__":
    main()
