# SPDX-License-Identifier: BSD-3-Clause
"""dgtk report: its numbers against the dataset's files read with NumPy, its pages in a headless browser, datasets of strangers."""
import base64
import json
import os
import re
import shutil
import zlib

import numpy as np

from browser import Browser, chromium
from harness import SCENES, SOURCE, load_json, main
from many_runs import ManyCase
from pictures import read_png

HOSTILE = "</script><img src=x onerror=\"document.title='bad'\">&'\""


def model_of(page):
    with open(page, encoding="utf-8") as file:
        text = file.read()
    return json.loads(re.search(r'<script type="application/json" id="model">(.*?)</script>', text, re.S).group(1))


def block_of(page, layer, shown):
    """Head, values and pixels of a picture on the sheet."""
    with open(page, encoding="utf-8") as file:
        head, png, packed = re.search(rf'id="d{layer}-{shown}">([^<]*)</script>', file.read()).group(1).split("|")
    width, height, full_width, full_height, channels = map(int, head.split()[:5])
    kind = np.dtype(head.split()[5])
    planes = np.frombuffer(zlib.decompress(base64.b64decode(packed)), np.uint8).reshape(kind.itemsize, -1)
    values = np.ascontiguousarray(planes.T).view(kind).reshape(height, width, channels)
    assert base64.b64decode(png).startswith(b"\x89PNG")
    return (full_width, full_height), values


def middles(samples, pixels):
    """What the format says: the middle of the pixels that a sample stands for."""
    first = np.arange(samples) * pixels // samples
    end = np.maximum(first + 1, (np.arange(samples) + 1) * pixels // samples)
    return (first + end - 1) // 2


def luma_of(path):
    """Of a picture's pixels, 0 to 1, by ITU-R BT.709."""
    return read_png(path).astype(float)[..., :3] @ (0.2126, 0.7152, 0.0722) / 255


def from_above(points, up):
    """Right, down and up of a plan: what points at the reader is up."""
    x, y, z = np.moveaxis(np.asarray(points, float), -1, 0)
    return np.stack((x, -y, z) if up == "z" else (x, z, y), axis=-1)


def ids_of(path):
    with open(path, "rb") as file:
        data = file.read()
    head = re.match(rb"P6\s(?:#.*\n)*(\d+)\s+(\d+)\s+255\s", data)
    pixels = np.frombuffer(data[head.end():], np.uint8).reshape(int(head.group(2)), int(head.group(1)), 3).astype(np.uint32)
    return pixels[..., 0] << 16 | pixels[..., 1] << 8 | pixels[..., 2]


def many_frames(source, target, pictures):
    """The pictures of frame 0 under the names of other frames: hard links, and documents that list them."""
    manifest, cameras, poses = (load_json(os.path.join(source, name + ".json")) for name in ("manifest", "cameras", "poses"))
    first = [file for file in manifest["files"] if file.get("camera") and file["frame"] == 0]
    manifest["files"] = [file for file in manifest["files"] if not file.get("camera")]
    records = [one for one in cameras["cameras"] if one["frame"] == 0]
    frames = range(pictures // len(records))
    for file in first:
        os.makedirs(os.path.join(target, os.path.dirname(file["path"])), exist_ok=True)
    for frame in frames:
        for file in first:
            path = file["path"].replace("000000", f"{frame:06d}")
            os.link(os.path.join(source, file["path"]), os.path.join(target, path))
            manifest["files"].append({**file, "path": path, "frame": frame})
    manifest["files"].sort(key=lambda file: file["path"])
    cameras["cameras"] = [{**one, "frame": frame} for one in records for frame in frames]
    poses["poses"] = [{**one, "frame": frame} for frame in frames for one in poses["poses"] if one["frame"] == 0]
    for name, document in (("manifest", manifest), ("cameras", cameras), ("poses", poses)):
        with open(os.path.join(target, name + ".json"), "w", encoding="utf-8") as file:
            file.write(json.dumps(document))  # many times faster than json.dump()
    for name in ("objects.json", "scene.json"):
        shutil.copy(os.path.join(source, name), target)


class Report(ManyCase):
    def render(self, name="data", layers="color,depth,objects,classes,flow_forward,boxes", scene="demo.json", more=()):
        folder = self.path(name)
        self.dgtk("render", os.path.join(SCENES, scene), "-o", folder, "--quiet", "--layers", layers, "--size", "96x72", *more)
        return folder

    def picture_of(self, page, layer, shown):
        """The pixels that are drawn, (height, width, 3)."""
        with open(page, encoding="utf-8") as file:
            packed = re.search(rf'id="d{layer}-{shown}">[^|]*\|([^|]*)', file.read()).group(1)
        return read_png(self.write("shown.png", base64.b64decode(packed))).astype(int)

    def report(self, folder, *more, name="page.html"):
        self.dgtk("report", folder, "-o", self.path(name), "--quiet", *more)
        return self.path(name)

    def test_numbers(self):
        folder = self.render(layers="color,depth,objects,classes,flow_forward,boxes,normal")
        page = self.report(folder)
        model = model_of(page)
        layers = {layer["label"]: layer for layer in model["layers"]}
        manifest = load_json(os.path.join(folder, "manifest.json"))
        paths = [file["path"] for file in manifest["files"] if file.get("camera")]
        depth = np.stack([np.load(os.path.join(folder, path)) for path in paths if "/depth/" in path])
        found = layers["depth"]["numbers"]
        finite = depth[np.isfinite(depth)]
        self.assertEqual((found["values"], found["nothing"]), (finite.size, depth.size - finite.size))
        self.assertEqual((found["least"], found["most"]), (finite.min(), finite.max()))
        self.assertAlmostEqual(found["mean"], finite.mean(), delta=1e-9 * finite.mean())
        octave = np.floor(np.log2(finite))
        bins, counts = np.unique((octave * 8 + np.floor((finite / 2 ** octave - 1) * 8)).astype(int), return_counts=True)
        self.assertEqual(found["bins"], [[int(a), int(b)] for a, b in zip(bins, counts)])

        flow = [np.frombuffer(open(os.path.join(folder, path), "rb").read()[12:], "<f4").reshape(72, 96, 2) for path in paths if path.endswith(".flo")]
        length = np.hypot(*np.moveaxis(np.stack(flow).astype(float), -1, 0))
        length[length > 1e9] = np.nan
        found = layers["flow_forward"]["numbers"]
        self.assertEqual(found["values"], int(np.isfinite(length).sum()))
        self.assertEqual((found["zero"], found["negative"], found["nothing"]), (int((length == 0).sum()), 0, int(np.isnan(length).sum())))
        self.assertAlmostEqual(found["most"], np.nanmax(length), delta=1e-6)

        luma = {path.replace("/color/", " ")[:-4]: luma_of(os.path.join(folder, path)) for path in paths if "/color/" in path}
        found, values = layers["color"]["brightness"], np.stack(list(luma.values())).ravel()
        self.assertEqual((found["values"], found["zero"], found["one"]), (values.size, int((values <= 0).sum()), int((values >= 1).sum())))
        np.testing.assert_allclose((found["least"], found["most"], found["mean"]), (values.min(), values.max(), values.mean()), rtol=1e-12)
        edges = np.isclose(values * 64, np.round(values * 64), rtol=0, atol=1e-9).sum()
        self.assertLessEqual(np.abs(np.array(found["bins"]) - np.histogram(values, 64, (0, 1))[0]).sum(), 2 * edges)
        darkest = [(picture["camera"], picture["frame"]) for picture in model["frames"]["darkest"]]
        self.assertEqual(darkest, sorted(darkest, key=lambda one: luma[f"{one[0]} {one[1]:06d}"].mean()))
        for picture in model["frames"]["darkest"]:
            self.assertAlmostEqual(picture["brightness"], luma[f"{picture['camera']} {picture['frame']:06d}"].mean(), places=12)

        # legends: one range for all pictures, without the outermost hundredths; the ramp has the pictures' own colours
        self.assertEqual({name: layer["legend"]["kind"] for name, layer in layers.items()},
                         {"color": "picture", "depth": "ramp", "objects": "ids", "classes": "ids", "flow_forward": "wheel", "flow_forward_class": "ids", "normal": "axes"})
        longest = np.sort(length[np.isfinite(length)].ravel())
        self.assertAlmostEqual(layers["flow_forward"]["legend"]["high"], longest[-1 - longest.size // 100], delta=1e-6)
        ramp, ordered = layers["depth"]["legend"], np.sort(finite).astype(np.float32)
        self.assertTrue(ramp["log"])
        np.testing.assert_allclose((ramp["low"], ramp["high"]), (ordered[finite.size // 100], ordered[-1 - finite.size // 100]), rtol=1e-6)
        stops = np.array([[int(color[i:i + 2], 16) for i in (1, 3, 5)] for color in ramp["colors"]])
        for shown in range(len(model["pictures"])):
            _, values = block_of(page, list(layers).index("depth"), shown)
            places = 24 * np.log(np.clip(values[..., 0], ramp["low"], ramp["high"]) / ramp["low"]) / np.log(ramp["high"] / ramp["low"])
            seen = np.isfinite(values[..., 0])
            want = np.stack([np.interp(places[seen], np.arange(25), stops[:, c]) for c in range(3)], axis=-1)
            self.assertLess(np.abs(want - self.picture_of(page, list(layers).index("depth"), shown)[seen]).max(), 8)

        ids = {path: ids_of(os.path.join(folder, path)) for path in paths if path.endswith(".ppm")}
        rows = {row["id"]: row for row in model["seen"]["objects"]}
        for one in load_json(os.path.join(folder, "objects.json"))["objects"]:
            pixels = [int((picture == one["id"]).sum()) for picture in ids.values()]
            self.assertEqual((rows[one["id"]]["pixels"], rows[one["id"]]["pictures"]), (sum(pixels), sum(n > 0 for n in pixels)), one["name"])
        self.assertEqual(list(rows), sorted(rows, key=lambda one: (-rows[one]["pixels"], -rows[one]["pictures"], one)))
        listed = [one["class"] for one in load_json(os.path.join(folder, "objects.json"))["objects"]]
        self.assertEqual({row["name"]: row["members"] for row in model["seen"]["classes"]}, {name: listed.count(name) for name in listed})
        self.assertEqual(sum(row["pixels"] for row in model["seen"]["classes"]), sum(int((picture > 0).sum()) for picture in ids.values()))
        for picture in model["pictures"]:
            self.assertAlmostEqual(picture["covered"], (ids[f"{picture['camera']}/objects/{picture['frame']:06d}.ppm"] > 0).mean(), places=12)
        emptiest = [picture["covered"] for picture in model["frames"]["emptiest"]]
        self.assertEqual(emptiest, sorted(emptiest))
        sizes = {}
        for file in manifest["files"]:
            if file.get("camera"):
                place = (file["camera"], file["frame"])
                sizes[place] = sizes.get(place, 0) + file["bytes"]
        self.assertEqual([picture["bytes"] for picture in model["frames"]["largest"]], sorted(sizes.values(), reverse=True))
        self.assertEqual({(one["camera"], one["frame"]): (one["bytes"], one["shown"]) for one in model["pictures"]},
                         {place: (sizes[place], i) for i, place in enumerate(sorted(sizes))})
        data = model["dataset"]
        self.assertEqual((data["cameras"], data["files"], data["bytes"]), (2, len(paths), sum(sizes.values())))

        boxes = [box for path in paths if "/boxes/" in path for box in load_json(os.path.join(folder, path))["objects"]]
        shares = [box["pixels_visible"] / box["pixels_amodal"] for box in boxes if box["pixels_amodal"] > 0]
        self.assertEqual(model["seen"]["boxes"]["shares"]["bins"], np.histogram(shares, 20, (0, 1))[0].tolist())
        found = model["seen"]["boxes"]["shares"]
        self.assertEqual((found["values"], found["zero"], found["one"]), (len(shares), shares.count(0), shares.count(1)))
        self.assertEqual(model["seen"]["boxes"]["hidden"], sum(box["pixels_visible"] == 0 for box in boxes))
        sides = [max(b[2] - b[0], b[3] - b[1]) for b in (box["box_visible"] for box in boxes) if b]
        found = model["seen"]["boxes"]["sizes"]
        self.assertEqual((found["values"], found["least"], found["most"]), (len(sides), min(sides), max(sides)))
        self.assertEqual(model["seen"]["boxes"]["pictures"], 6)

        # what is read out is the dataset's pixel
        order = list(layers)
        for shown, picture in enumerate(model["pictures"]):
            size, values = block_of(page, order.index("depth"), shown)
            file = np.load(os.path.join(folder, f"{picture['camera']}/depth/{picture['frame']:06d}.npy"))
            np.testing.assert_array_equal(values[..., 0], file[np.ix_(middles(values.shape[0], 72), middles(values.shape[1], 96))].astype(np.float32))
            self.assertEqual(size, (96, 72))

        # cameras from above: the centre, z down
        for camera in model["plans"][0]["cameras"]:
            record = next(one for one in load_json(os.path.join(folder, "cameras.json"))["cameras"] if (one["name"], one["frame"]) == (camera["name"], camera["places"][0][0]))
            centre = -np.array(record["R"]).T @ np.array(record["t"])
            np.testing.assert_allclose(camera["places"][0][1:4], [centre[0], centre[2], centre[1]], atol=1e-5)
            forward = np.array(record["R"])[2]
            np.testing.assert_allclose(camera["places"][0][4:6], [forward[0], forward[2]], atol=1e-5)
            self.assertEqual(camera["model"], record["model"])

    def test_pictures_that_cannot_be_read(self):
        """A layer of nothing else has no numbers, not those of nothing."""
        folder = self.render(layers="color,depth")
        for row in load_json(os.path.join(folder, "manifest.json"))["files"]:
            if row.get("camera"):
                self.write(os.path.join(folder, row["path"]), "no picture")
        layers = model_of(self.report(folder))["layers"]
        self.assertEqual([(one["label"], one["pictures"], "numbers" in one or "brightness" in one) for one in layers], [("color", 0, False), ("depth", 0, False)])

    def test_fewer_samples_than_pixels(self):
        folder = self.path("large")
        self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", folder, "--quiet", "--layers", "color,depth", "--size", "1500x300", "--cameras", "left", "--frames", "0",
                  "--color-format", "exr,png", "--depth-format", "png,npy")
        page = self.report(folder)
        color, depth = model_of(page)["layers"]
        self.assertEqual(("brightness" in color, "numbers" in depth), (True, True), "pictures of colours, and depths as numbers")
        size, values = block_of(page, 1, 0)
        self.assertEqual((size, values.shape), ((1500, 300), (128, 640, 1)))
        file = np.load(os.path.join(folder, "left/depth/000000.npy"))
        np.testing.assert_array_equal(values[..., 0], file[np.ix_(middles(128, 300), middles(640, 1500))].astype(np.float32))
        # colours are read out as they are, and drawn as averages
        color = read_png(os.path.join(folder, "left/color/000000.png"))
        np.testing.assert_array_equal(block_of(page, 0, 0)[1], color[np.ix_(middles(128, 300), middles(640, 1500))])
        drawn = self.picture_of(page, 0, 0)
        for j, i in ((0, 0), (40, 100), (127, 639), (77, 320)):
            area = color[j * 300 // 128:(j + 1) * 300 // 128, i * 1500 // 640:(i + 1) * 1500 // 640]
            self.assertLessEqual(np.abs(drawn[j, i] - area.mean(axis=(0, 1))).max(), 1, (j, i))

    def test_all_pictures_together_are_of_three_million_samples(self):
        folder = self.path("several")
        self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", folder, "--quiet", "--size", "320x240", "--visibility", "ray",
                  "--layers", "depth,distance,objects,classes,normal,position,uv")
        page = self.path("page.html")
        self.alone("report", folder, "-o", page, "--quiet")  # to the end of its process, which the others do not reach
        sizes = {block_of(page, layer, shown)[1].shape[:2] for layer in range(7) for shown in range(6)}
        [(height, width)] = sizes
        self.assertEqual((width % 8, height), (0, width * 3 // 4))
        self.assertLessEqual(42 * width * height, 3e6)
        self.assertGreater(42 * (width + 8) * (height + 6), 3e6)
        # a narrow picture does not make the others larger
        cameras = [{"name": f"c{i}", "width": 400, "height": 400, "fovY": 40, "near": 0.1, "far": 50, "eye": [i, 1, 5], "lookAt": [0, 0, 0]} for i in range(3)]
        cameras.append({**cameras[0], "name": "narrow", "width": 1000, "height": 10})
        scene = self.write("narrow.json", json.dumps({"version": 1, "objects": [{"name": "crate", "model": os.path.join(SOURCE, "Data/Models/crate.ac")}], "cameras": cameras}))
        self.dgtk("render", scene, "-o", self.path("narrow"), "--quiet", "--visibility", "ray", "--layers", "depth,distance,objects,classes,normal,position,uv")
        page = self.report(self.path("narrow"))
        sizes = [block_of(page, layer, shown)[1].shape[:2] for layer in range(7) for shown in range(4)]
        side = int((3e6 / 7 / (3 + 0.01)) ** 0.5) // 8 * 8
        self.assertEqual(set(sizes), {(side, side), (round(10 * side / 1000), side)})
        self.assertLessEqual(sum(height * width for height, width in sizes), 3e6)

    def test_subset_and_same_bytes(self):
        folder = self.render(layers="depth,objects")
        whole = model_of(self.report(folder))
        self.assertEqual((whole["dataset"]["pictures"], whole["dataset"]["shown"]), (6, 6))
        page = self.report(folder, "--pictures", "2", "--read", "3", "--threads", "1")
        model = model_of(page)
        self.assertEqual((model["dataset"]["read"], model["dataset"]["shown"]), (3, 2))
        self.assertEqual(model["layers"][0]["pictures"], 3)
        fewer = model_of(self.report(folder, "--pictures", "3", "--read", "1", name="fewer.html"))["dataset"]
        self.assertEqual((fewer["read"], fewer["shown"]), (3, 3))
        self.assertEqual(model_of(self.report(folder, "--pictures", "all", "--read", "3", name="all.html"))["dataset"]["shown"], 6)
        again = self.report(folder, "--pictures", "2", "--read", "3", "--threads", "2", name="again.html")
        with open(page, "rb") as one, open(again, "rb") as other:
            self.assertEqual(one.read(), other.read())
        chosen = {(p["camera"], p["frame"]) for p in model["pictures"]}
        others = [{(p["camera"], p["frame"]) for p in model_of(self.report(folder, "--pictures", "2", "--read", "3", "--seed", seed))["pictures"]} for seed in range(1, 6)]
        self.assertTrue(any(other != chosen for other in others))

    def test_folder_of_scenes(self):
        for name in ("000000", "000001"):
            self.render(f"scenes/{name}", layers="color,objects")
        os.symlink(self.path("scenes", "000000"), self.path("scenes", "linked"))
        self.write("scenes/manifest.json", "{}")
        self.write("scenes/samples.json", json.dumps({"version": 1, "samples": [
            {"sample": 4, "file": "000004.json", "notes": [{"path": "objects/cup#1/place", "kept": False, "why": "no room <b>here</b>", "attempts": 9}, {"path": "cameras/left/require", "kept": True, "attempts": 2}]},
            {"sample": 5, "refused": {"path": "objects/bowl/place", "why": "no room", "attempts": 20}}, {"sample": 6, "file": "000006.json"},
            {"sample": 7, "file": "000007.json", "notes": [{"path": "objects/cup#1/place", "why": "no room <b>here</b>"}]}]}))
        os.makedirs(self.path("scenes", "broken"))
        self.write("scenes/broken/manifest.json", "{")
        model = model_of(self.report(self.path("scenes")))
        self.assertEqual((model["dataset"]["scenesFound"], model["dataset"]["scenes"], model["dataset"]["pictures"]), (3, 2, 12))
        self.assertEqual([names["name"] for names in model["names"].values()], ["000000", "000001"])
        self.assertEqual(model["samples"]["reasons"], [{"path": "objects/cup#1/place", "why": "no room <b>here</b>", "times": 2, "example": "4"},
                                                       {"path": "objects/bowl/place", "why": "no room", "times": 1, "example": "5"}])
        self.assertEqual((model["samples"]["samples"], model["samples"]["touched"], model["samples"]["reasonCount"]), (4, 3, 2))
        self.assertIn("broken", model["notes"][0])
        self.assertEqual(model["seen"]["objects"][0]["scenes"], 2)
        self.assertEqual(model_of(self.report(self.path("scenes"), "--pictures", "1", name="scenes/page.html"))["dataset"]["scenes"], 2)  # the numbers are of more than what is shown

    def test_a_verification_of_a_folder_of_datasets(self):
        scene = load_json(os.path.join(SCENES, "demo.json"))
        os.mkdir(self.path("of"))
        for name in ("a", "b"):
            self.write(f"of/{name}.json", json.dumps({**scene, "objects": [{**one, "model": os.path.join(SCENES, one["model"])} for one in scene["objects"]]}))
        folder = self.path("many")
        self.dgtk("render", self.path("of"), "-o", folder, "--layers", "depth,color", "--frames", "0", "--size", "32x24", "--quiet")
        said = json.loads(self.dgtk("verify", folder, "--json").stdout)

        def shown(**changes):
            file = self.write("verification.json", json.dumps({**said, **changes}))
            return model_of(self.report(folder, "--verification", file))["verification"]

        def counts(rows):
            return {(row["check"], row["layer"]): row["count"] for row in rows}
        sound = shown()
        self.assertEqual((sound["passed"], sound["same"]), (True, True))
        one, other = counts(said["a"]["residuals"]), counts(said["b"]["residuals"])
        self.assertEqual(counts(sound["residuals"]), {key: one[key] + other[key] for key in one})
        self.assertEqual(sound["unchecked"], [{**row, "files": 2 * row["files"]} for row in said["a"]["not_checked"]])
        broken = json.loads(json.dumps(said["b"]))
        broken["passed"] = False
        broken["residuals"][3].update(breach=True, largest=7.0)
        breach = shown(b=broken)
        self.assertEqual((breach["passed"], breach["same"]), (False, True))
        self.assertEqual([(row["largest"], row["dataset"]) for row in breach["residuals"] if row["breach"]], [(7.0, "b")])
        del said["b"]
        self.assertFalse(shown()["same"])
        self.assertFalse(shown(b={**broken, "dataset_manifest": "0" * 64})["same"])
        self.assertFalse(shown(b=broken, c=broken)["same"])

    def test_documents_beside(self):
        folder = self.render(layers="color,depth,objects,classes,boxes,amodal", more=("--frames", "0"))
        self.dgtk("verify", folder, "--write")
        self.dgtk("export", folder, "--format", "coco", "-o", self.path("coco"), "--quiet")
        model = model_of(self.report(folder, "--export", self.path("coco")))
        self.assertTrue(model["verification"]["passed"])
        self.assertEqual((model["verification"]["same"], model["exports"][0]["same"]), (True, True))
        verification = load_json(os.path.join(folder, "verification.json"))
        for here, there in (("residuals", "residuals"), ("unchecked", "not_checked")):
            self.assertEqual(model["verification"][here], [{key: None if isinstance(value, (list, dict)) else value for key, value in row.items()}
                                                           for row in verification[there]])
        stated = load_json(self.path("coco", "export.json"))
        self.assertEqual((model["exports"][0]["format"], model["exports"][0]["files"]), ("coco", len(stated["files"])))
        self.assertEqual([(one["layer"], one["largest"], one["values"], one["withoutCode"]) for one in model["exports"][0]["layers"]],
                         [(one["layer"], one["largest_rounding"], one["values"], one["without_code"]) for one in stated["layers"]])
        # of another state of the dataset, and of nobody knows which
        with open(os.path.join(folder, "manifest.json"), "a", encoding="utf-8") as file:
            file.write("\n")
        later = model_of(self.report(folder, "--export", self.path("coco")))
        self.assertEqual((later["verification"]["same"], later["exports"][0]["same"]), (False, False))
        del verification["dataset_manifest"]
        older = self.write("older.json", json.dumps(verification))
        self.assertIsNone(model_of(self.report(folder, "--verification", older))["verification"]["same"])

    def test_plans(self):
        """Cameras and objects from above, with the directions from which objects are seen, for both axes that may be up."""
        for up in "yz":
            scene = self.write("scene.json", json.dumps({
                "version": 1, "units": "metre", "upAxis": up,
                "objects": [{"name": "crate", "model": os.path.join(SOURCE, "Data/Models/crate.ac"), "position": [0.5, 0.25, -0.5], "orientation": [0.8, 0.4, 0.2, -0.4]},
                            {"name": "brick", "model": os.path.join(SOURCE, "Data/Models/brick.ac"), "position": {"keys": [[0, [-1, 0, 0]], [59, [1.5, 1, 0.5]]]}, "scale": [1, 2, 3]},
                            {"name": "gone", "model": os.path.join(SOURCE, "Data/Models/gear.ac"), "position": {"keys": [[0, [0, 1, 0]], [59, [0, -1, 0]]]},
                             "visible": {"keys": [[0, True], [20, False]]}}],
                "cameras": [{"name": "a", "width": 24, "height": 18, "fovY": 50, "near": 0.1, "far": 50, "eye": {"keys": [[0, [1, 2, 6]], [59, [-4, 3, 5]]]}, "lookAt": [0, 0, 0]},
                            {"name": "round", "model": "equirectangular", "width": 24, "height": 12, "near": 0.1, "far": 50, "eye": [0, 0.5, 2], "lookAt": [3, 0, 3.5]}]}))
            folder = self.path("data-" + up)
            self.dgtk("render", scene, "-o", folder, "--quiet", "--layers", "objects,boxes,depth", "--visibility", "ray")
            model = model_of(self.report(folder, "--pictures", "3"))
            plan, cameras, poses = model["plans"][0], *(load_json(os.path.join(folder, name + ".json"))[name] for name in ("cameras", "poses"))
            frames = [i * 59 // 47 for i in range(48)]  # evenly, with both ends
            self.assertEqual((plan["up"], plan["units"], plan["frames"]), (up, "metre", frames))
            self.assertEqual((plan["allFrames"], plan["allCameras"], plan["allObjects"]), (60, 2, 3))
            eyes = {(one["name"], one["frame"]): -np.array(one["R"]).T @ one["t"] for one in cameras}
            for camera in plan["cameras"]:
                np.testing.assert_allclose([place[1:4] for place in camera["places"]], [from_above(eyes[camera["name"], frame], up) for frame in frames], atol=1e-5)
                ahead = [next(one["R"][2] for one in cameras if (one["name"], one["frame"]) == (camera["name"], frame)) for frame in frames]
                np.testing.assert_allclose([place[4:6] for place in camera["places"]], from_above(ahead, up)[:, :2], atol=1e-5)
            self.assertEqual({len(place) for place in plan["cameras"][1]["places"]}, {6})
            for place in plan["cameras"][0]["places"]:
                record = next(one for one in cameras if (one["name"], one["frame"]) == ("a", place[0]))
                corners = np.array([[x, y, 1] for y in (0, 18) for x in (0, 24)]) @ np.linalg.inv(record["K"]).T @ record["R"]
                seen = from_above(corners / np.linalg.norm(corners, axis=1, keepdims=True), up)[:, :2]
                np.testing.assert_allclose(np.reshape(place[6:], (4, 2)), seen, atol=1e-5)

            # behind a panorama's middle depths are negative
            depth = np.stack([np.load(os.path.join(folder, f"round/depth/{frame:06d}.npy")) for frame in range(60)])
            found = next(layer["numbers"] for layer in model["layers"] if layer["label"] == "depth")
            self.assertEqual(found["negative"], int((depth < 0).sum()))
            self.assertGreater(found["negative"], 0)
            self.assertEqual(found["least"], depth.min())
            self.assertEqual(sum(number for _, number in found["bins"]), found["values"] - found["negative"])

            # boxes of the objects' own axes, as the first list says them
            record = next(one for one in cameras if (one["name"], one["frame"]) == ("a", 0))
            boxes = load_json(os.path.join(folder, "a/boxes/000000.json"))["objects"]
            own = {}
            for box in boxes:
                matrix = np.array(box["matrix"])
                own[box["id"]] = (np.array(box["box3d"]) - matrix[:, 3]) @ np.linalg.inv(matrix[:, :3]).T
            self.assertEqual([(one["id"], one["static"]) for one in plan["objects"]], [(1, True), (2, False), (3, False)])
            placed = {(one["frame"], one["id"]): one for one in poses}
            for one in plan["objects"]:
                shown = [frame for frame in frames if placed[frame, one["id"]]["visible"]][:1 if one["static"] else None]
                self.assertEqual([place[0] for place in one["places"]], shown)
                self.assertEqual(one["hidden"], [frame for frame in frames if not placed[frame, one["id"]]["visible"]])
                for place in one["places"]:
                    matrix = np.array(placed[place[0], one["id"]]["matrix"])
                    np.testing.assert_allclose(place[1:4], from_above(matrix[:, 3], up), atol=1e-5)
                    corners = from_above(own[one["id"]] @ matrix[:, :3].T + matrix[:, 3], up)
                    np.testing.assert_allclose(np.reshape(place[4:], (8, 2)), corners[:, :2], atol=1e-5)

            # directions in the objects' own axes, of the pictures in which they are seen: azimuth, and the sine of elevation
            bins = np.zeros((12, 24), int)
            for (camera, frame), eye in eyes.items():
                ids = ids_of(os.path.join(folder, f"{camera}/objects/{frame:06d}.ppm"))
                for one in (placed[frame, id] for id in range(1, 4) if (ids == id).any()):
                    x, y, z = from_above(np.array(one["R"]).T @ (eye - one["t"]), up)
                    bins[int((z / np.sqrt(x * x + y * y + z * z) + 1) / 2 * 12), int((np.arctan2(-y, x) / (2 * np.pi) + 0.5) * 24)] += 1
            self.assertEqual((model["viewpoints"]["columns"], model["viewpoints"]["rows"], model["viewpoints"]["views"]), (24, 12, bins.sum()))
            np.testing.assert_array_equal(np.reshape(model["viewpoints"]["bins"], (12, 24)), bins)
            self.assertLess(bins.sum(), 2 * 60 * 3)

    def test_what_is_left_out_of_long_lists(self):
        objects = [{"name": f"o{i}", "model": os.path.join(SOURCE, "Data/Models/brick.ac"), "position": [i % 20 - 10, i // 20 - 8, 0], "class": f"c{i}"} for i in range(310)]
        cameras = [{"name": f"c{i:03d}", "width": 8, "height": 6, "fovY": 50, "near": 0.1, "far": 50, "eye": [i / 10 - 5, 0, 20], "lookAt": [0, 0, 0]} for i in range(104)]
        scene = self.write("many.json", json.dumps({"version": 1, "objects": objects, "cameras": cameras}))
        self.dgtk("render", scene, "-o", self.path("many"), "--quiet", "--layers", "objects", "--visibility", "ray")
        self.write("many/samples.json", json.dumps({"samples": [{"refused": {"path": f"objects/o{i}/place", "why": "no room"}} for i in range(104)]}))
        manifest = load_json(self.path("many", "manifest.json"))
        self.write("many/manifest.json", json.dumps({**manifest, "warnings": [f"warning {i}" for i in range(203)]}))
        model = model_of(self.report(self.path("many"), "--pictures", "1"))
        plan, seen = model["plans"][0], model["seen"]
        self.assertEqual((len(plan["cameras"]), plan["allCameras"], len(plan["objects"]), plan["allObjects"]), (100, 104, 300, 310))
        self.assertEqual((len(seen["objects"]), seen["objectCount"], len(seen["classes"]), seen["classCount"]), (200, 310, 200, 310))
        self.assertEqual((len(model["samples"]["reasons"]), model["samples"]["reasonCount"]), (100, 104))
        self.assertEqual((len(model["dataset"]["warnings"]), model["dataset"]["warningCount"]), (200, 203))
        self.assertEqual((len(model["frames"]["emptiest"]), len(model["frames"]["largest"])), (24, 24))
        self.assertEqual([len(model["names"]["0"][key]) for key in ("objects", "classes")], [310, 310])
        self.assertEqual(len(model["colors"]), 256)

    def test_refusals(self):
        page = self.path("page.html")
        self.refused("report", self.path("nothing"), "-o", page, status=3, says="is not a dataset")
        self.refused("report", self.path("."), status=2, says="-o FILE.html")
        folder = self.render(layers="depth", more=("--frames", "0"))
        self.refused("report", folder, "-o", self.path("no", "where", "page.html"), status=4, says="page.html")
        self.refused("report", folder, "-o", page, "--verification", os.path.join(folder, "objects.json"), status=3, says="is not what a verification")
        self.refused("report", folder, "-o", page, "--pictures", "0", status=2, says="--pictures")
        for name in ("manifest.json", "left/depth/000000.npy", "report.html", "left/depth/report.html", "no/where/report.html"):
            self.refused("report", folder, "-o", os.path.join(folder, name), status=2, says=f"{name}: lies in the dataset in")
        for name in ("scene.json", "more.json"):
            self.refused("convert", os.path.join(SCENES, "demo.json"), os.path.join(folder, name), status=2, says=f"{name}: lies in the dataset in")
            os.symlink(os.path.join(folder, name), self.path(f"to_{name}")) # which a scene is written through
            self.refused("convert", os.path.join(SCENES, "demo.json"), self.path(f"to_{name}"), status=2, says=f"{name}: lies in the dataset in")
        self.dgtk("verify", folder)
        # a damaged picture is a note, and the rest is there
        with open(os.path.join(folder, "left/depth/000000.npy"), "r+b") as file:
            file.truncate(100)
        model = model_of(self.report(folder))
        self.assertEqual((model["noteCount"], model["layers"][0]["pictures"]), (1, 1))
        self.assertIn("left/depth/000000.npy", model["notes"][0])
        # links lead nowhere
        os.remove(page)
        os.remove(os.path.join(folder, "left/depth/000000.npy"))
        self.write("outside.npy", "mine")
        os.symlink(self.path("outside.npy"), os.path.join(folder, "left/depth/000000.npy"))
        self.refused("report", folder, "-o", page, status=3, says="link")
        self.assertFalse(os.path.exists(page))

    def test_each_picture_counts_by_its_own_format(self):
        """Grey levels are no depths, and linear light is no brightness."""
        for name, depth, color in (("a", "png", "exr"), ("b", "npy", "png")):
            self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", self.path("scenes", name), "--quiet", "--layers", "color,depth", "--size", "48x36",
                      "--frames", "0", "--cameras", "left", "--depth-format", depth, "--color-format", color)
        model = model_of(self.report(self.path("scenes")))
        layers = {layer["label"]: layer for layer in model["layers"]}
        values = np.load(self.path("scenes", "b", "left/depth/000000.npy"))
        finite, found = values[np.isfinite(values)], layers["depth"]["numbers"]
        self.assertEqual((found["values"], found["nothing"], found["most"]), (finite.size, values.size - finite.size, finite.max()))
        self.assertLessEqual(layers["depth"]["legend"]["high"], finite.max())
        luma = luma_of(self.path("scenes", "b", "left/color/000000.png"))
        self.assertEqual(layers["color"]["brightness"]["values"], luma.size)
        self.assertAlmostEqual(layers["color"]["brightness"]["mean"], luma.mean(), places=12)
        self.assertEqual({name: layer["pictures"] for name, layer in layers.items()}, {"color": 1, "depth": 1})
        self.assertEqual([("covered" in one, "brightness" in one) for one in model["pictures"]], [(False, False), (True, True)])

    def test_surfaces_without_a_value(self):
        """Drop-outs of a sensor, and what is behind the camera at the next frame, are not empty."""
        model = model_of(self.report(self.render(layers="depth_noisy,flow_forward", more=("--frames", "0", "--cameras", "left"))))
        self.assertEqual((["covered" in one for one in model["pictures"]], model["frames"]["emptiest"]), ([False], []))


class Page(Report):
    """The same datasets in a browser."""
    test_numbers = test_pictures_that_cannot_be_read = test_fewer_samples_than_pixels = test_subset_and_same_bytes = test_folder_of_scenes = test_documents_beside = test_refusals = None
    test_all_pictures_together_are_of_three_million_samples = test_plans = test_what_is_left_out_of_long_lists = None
    test_each_picture_counts_by_its_own_format = test_surfaces_without_a_value = None

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        assert chromium(), "Chromium is not installed (Utilities/Setup/packages.txt)"
        cls.browser = cls.enterClassContext(Browser())

    def test_keys_values_and_names(self):
        folder = self.render(layers="color,depth,objects", more=("--frames", "0:1"))
        for name in ("objects.json", "cameras.json"):
            document = load_json(os.path.join(folder, name))
            if name == "objects.json":
                for one in document["objects"]:
                    one["name"] = one["class"] = HOSTILE
                for one in document["classes"]:
                    one["name"] = HOSTILE
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                json.dump(document, file)
        hostile = self.path("<img src=x onerror=alert(1)>")
        os.rename(folder, hostile)
        page = self.report(hostile)
        with self.browser.page(1400, 900) as browser:
            browser.open(page)
            browser.until("document.querySelectorAll('.shot img').length > 0")
            self.assertEqual(browser.evaluate("document.querySelectorAll('.shot').length"), 4)
            self.assertEqual(browser.evaluate("document.querySelectorAll('img[src=x], img[onerror]').length"), 0)
            self.assertIn("onerror", browser.evaluate("document.getElementById('objects-table').textContent"))
            self.assertNotEqual(browser.evaluate("document.title"), "bad")
            # layers by keyboard
            label = "document.querySelector('#layers [aria-checked=true]').textContent"
            self.assertEqual(browser.evaluate(label), "color")
            before = browser.evaluate("document.querySelector('.shot img').src")
            browser.evaluate("document.querySelector('#layers [aria-checked=true]').focus()")
            browser.key("ArrowRight")
            self.assertEqual(browser.evaluate(label), "depth")
            self.assertNotEqual(browser.evaluate("document.querySelector('.shot img').src"), before)
            # pictures by keyboard, the values of a pixel, the way out
            browser.evaluate("document.querySelector('.shot').focus()")
            browser.key("ArrowRight")
            self.assertEqual(browser.evaluate("document.activeElement.dataset.shown"), "1")
            browser.key("Enter")
            browser.until("document.getElementById('view').open && document.querySelectorAll('#view-values tr').length === 3")
            browser.key("ArrowRight")
            browser.key("ArrowDown", shift=True)
            browser.until("document.getElementById('view-place').textContent.includes('(49, 46)')")
            picture = model_of(page)["pictures"][1]
            depth = np.load(os.path.join(hostile, f"{picture['camera']}/depth/{picture['frame']:06d}.npy"))[46, 49]
            browser.until("document.querySelector('#view-values tr.on td').textContent !== ''")
            self.assertAlmostEqual(float(browser.evaluate("document.querySelector('#view-values tr.on td').textContent").split()[0]), depth, delta=1e-6 * depth)
            identity = ids_of(os.path.join(hostile, f"{picture['camera']}/objects/{picture['frame']:06d}.ppm"))[46, 49]
            self.assertTrue(browser.evaluate("document.querySelectorAll('#view-values td')[2].textContent").startswith(f"{identity} {HOSTILE}" if identity else "0 background"))
            browser.key("]")
            self.assertEqual(browser.evaluate(label), "objects")
            browser.key("Escape")
            browser.until("!document.getElementById('view').open")
            self.assertEqual(browser.evaluate("document.activeElement.dataset.shown"), "1")
            # the mouse reads out, too
            x, y = browser.evaluate("(() => { document.querySelector('.hold').scrollIntoView(); const box = document.querySelector('.hold').getBoundingClientRect(); return [box.left + box.width / 2, box.top + box.height / 2]; })()")
            browser.mouse(x, y)
            browser.until("document.getElementById('readout').textContent.includes('objects: ')")
            self.assertEqual(browser.problems, [])
            self.assertEqual([url for url in browser.requests if not url.startswith("data:")], ["file://" + page])
        with self.browser.page(360, 800, dark=True) as browser:
            for width in (360, 1920):
                browser.resize(width, 800)
                browser.open(page)
                self.assertEqual(browser.evaluate("document.documentElement.scrollWidth"), width)

    def changed(self, page, change):
        """The page of another model."""
        model = model_of(page)
        change(model)
        with open(page, encoding="utf-8") as file:
            text = file.read()
        data = json.dumps(model).replace("<", "\\u003c")
        return self.write("changed.html", re.sub(r'(<script type="application/json" id="model">).*?(</script>)', lambda found: found.group(1) + data + found.group(2), text, count=1, flags=re.S))

    def test_filter_charts_and_lists(self):
        def change(model):
            depth = next(layer for layer in model["layers"] if layer["label"] == "depth")
            depth["numbers"]["bins"] = [[i, 3] for i in range(-30, 100)]
            views = model["viewpoints"]
            views.update(views=5 * views["columns"], bins=[0] * (views["columns"] * (views["rows"] - 1)) + [5] * views["columns"])  # all from above
            model["verification"] = {"passed": True, "residuals": [], "unchecked": [{"layer": "masks", "format": "exr", "files": 17}]}
            model["exports"] = [{"format": "coco", "same": False, "files": 1, "layers": []}]
            model["samples"] = {"samples": 300, "touched": 104, "reasonCount": 104, "reasons": [{"path": f"objects/o{i}", "why": "no room", "times": 1, "example": "4"} for i in range(100)]}
            model["dataset"].update(warnings=[f"warning {i}" for i in range(200)], warningCount=203)
        page = self.changed(self.report(self.render(layers="depth,objects", more=("--frames", "0:1"))), change)
        with self.browser.page(1400, 900) as browser:
            browser.open(page)
            # bars: 112 eighths of octaves by twos, what is smaller in the first; the smallest shown is 2^-2 (1 + 4/8)
            card = "[...document.querySelectorAll('#cards .card')].find((one) => one.querySelector('h3').textContent === '%s')"
            counts = browser.evaluate(f"[...({card % 'depth'}).querySelectorAll('rect title')].map((one) => Number(one.textContent))")
            self.assertEqual(counts, [3 * 20] + [6] * 55)
            self.assertEqual(browser.evaluate(f"({card % 'depth'}).querySelector('text').textContent"), "≤ 0.38")
            self.assertIn("eight equal steps an octave", browser.evaluate(f"({card % 'depth'}).querySelector('p').textContent"))
            rows = browser.evaluate(f"[...({card % 'Coverage of viewpoints'}).querySelectorAll('rect')].map((one) => [one.querySelector('title').textContent, Number(one.getAttribute('y'))])")
            self.assertEqual({y for number, y in rows if number == "5"}, {min(y for _, y in rows)})
            listed = browser.evaluate("document.getElementById('check-list').textContent")
            for words in ("Verification: does not say of which dataset – 0", "Export coco: of an earlier state, or of another dataset", "masksexr17", "in 104 of 300 samples, the first 100 of 104 reasons", "Warnings of the renderer (200 of 203)"):
                self.assertIn(words, listed)
            # pictures of one camera: Tab reaches the first of them, and the dialog stays among them
            shown = "[...document.querySelectorAll('.shot')].filter((one) => !one.hidden)"
            for camera in ("left", "right"):
                browser.evaluate("(() => { const list = document.getElementById('filter'); "
                                 f"list.value = [...list.options].find((one) => one.textContent === '{camera}').value; list.dispatchEvent(new Event('change')); }})()")
                self.assertEqual(browser.evaluate(f"{shown}.map((one) => one.getAttribute('aria-label'))"), [f"{camera} · frame 0", f"{camera} · frame 1"])
                self.assertEqual(browser.evaluate("[...document.querySelectorAll('.shot')].filter((one) => one.tabIndex === 0).map((one) => one.getAttribute('aria-label'))"), [f"{camera} · frame 0"])
            browser.evaluate(f"{shown}[0].focus()")
            browser.key("Enter")
            cross = "(({ left, top }) => [left, top].map(parseFloat))(document.querySelector('#view-picture .cross').style)"
            for key in ("ArrowLeft", "ArrowUp"):
                for _ in range(5):
                    browser.key(key, shift=True)
            for frame in (1, 0, 1):
                browser.key("PageDown")
                self.assertEqual(browser.evaluate("document.getElementById('view-title').textContent"), f"right · frame {frame}")
                np.testing.assert_allclose(browser.evaluate(cross), (50 / 96, 50 / 72), rtol=1e-3)  # the corner's pixel, in hundredths
            browser.key("PageUp")
            self.assertEqual(browser.evaluate("document.getElementById('view-title').textContent"), "right · frame 0")
            self.assertEqual(browser.problems, [])

    def test_ten_thousand_pictures(self):
        """The work and the page do not grow with the dataset; the time that the page's own clock says is printed."""
        small = self.render("small", layers="color,depth,objects", more=("--frames", "0"))
        large = self.path("large")
        many_frames(small, large, 10_000)
        page = self.report(large)
        self.assertEqual(model_of(page)["dataset"]["pictures"], 10_000)
        self.assertEqual(model_of(page)["layers"][1]["pictures"], 240)
        self.assertLess(os.path.getsize(page), 12_000_000)
        with self.browser.page(1400, 900) as browser:
            browser.open(page)
            browser.until("document.querySelectorAll('.shot img').length > 0")
            self.assertEqual(browser.evaluate("document.querySelectorAll('.shot').length"), 48)
            self.assertLess(browser.evaluate("document.querySelectorAll('.shot img').length"), 48)  # the others wait until they are near
            print("opened in", browser.evaluate("performance.getEntriesByType('navigation')[0].loadEventEnd"), "ms")
            self.assertEqual(browser.problems, [])

    def test_plan_as_it_is_drawn(self):
        """Angles that pinholes off centre and rolled see from above, no object where it is hidden; and what has no unit."""
        view = {"width": 96, "height": 32, "near": 0.1, "far": 50, "eye": [0, 0, 5], "lookAt": [0, 0, 0]}
        crate = {"name": "crate", "model": os.path.join(SOURCE, "Data/Models/crate.ac"), "visible": {"keys": [[0, True], [2, False], [4, True]]}}
        cameras = [{**view, "name": "aside", "K": [[60, 0, 8], [0, 60, 16], [0, 0, 1]]}, {**view, "name": "rolled", "fovY": 20, "up": [1, 0, 0]}]
        scene, folder = self.write("scene.json", json.dumps({"version": 1, "objects": [crate], "cameras": cameras})), self.path("data")
        self.dgtk("render", scene, "-o", folder, "--quiet", "--visibility", "ray", "--layers", "depth", "--depth-format", "png", "--frames", "0:4")
        self.dgtk("verify", folder, "--check", "hashes", "--write")
        with self.browser.page(1400, 900) as browser:
            browser.open(self.report(folder, "--pictures", "1"))
            eyes = browser.evaluate("[...document.querySelectorAll('#plan-plot .eye')].map((one) => [one.cx, one.cy].map((place) => place.baseVal.value))")
            cones = browser.evaluate("[...document.querySelectorAll('#plan-plot .cone')].map((one) => [...one.points].map(({ x, y }) => [x, y]))")
            for eye, cone, (left, right) in zip(eyes, cones, ((np.arctan(8 / 60), np.arctan(88 / 60)), (np.pi / 18, np.pi / 18)), strict=True):
                rays = np.array(cone) - eye
                x, y = rays[np.hypot(*rays.T) > 1].T
                angles = np.arctan2(x, -y)  # it looks along -z, up in the plan
                np.testing.assert_allclose((angles.min(), angles.max()), (-left, right), atol=1e-4)
            drawn = []
            for frame in range(5):
                browser.evaluate(f"(() => {{ const slider = document.querySelector('#plan-tools input'); slider.value = {frame}; slider.dispatchEvent(new Event('input')); }})()")
                drawn.append(browser.evaluate("document.querySelectorAll('#plan-plot [data-object]').length"))
            self.assertEqual(drawn, [1, 1, 0, 0, 1])
            self.assertIn("Verification: ✓ passed – 3", browser.evaluate("document.getElementById('check-list').textContent"))
            browser.evaluate("document.querySelector('.shot').focus()")
            browser.key("Enter")
            browser.until("document.querySelector('#view-values td') !== null")
            self.assertRegex(browser.evaluate("document.querySelector('#view-values td').textContent"), r"^\d+$")
            self.assertEqual(browser.problems, [])


if __name__ == "__main__":
    main()
