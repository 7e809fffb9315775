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
from harness import SCENES, Case, load_json, main
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
            json.dump(document, file)
    for name in ("objects.json", "scene.json"):
        shutil.copy(os.path.join(source, name), target)


class Report(Case):
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
        self.assertAlmostEqual(found["most"], np.nanmax(length), delta=1e-6)

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
        self.assertEqual(sum(row["pixels"] for row in model["seen"]["classes"]), sum(int((picture > 0).sum()) for picture in ids.values()))
        for picture in model["pictures"]:
            self.assertAlmostEqual(picture["covered"], (ids[f"{picture['camera']}/objects/{picture['frame']:06d}.ppm"] > 0).mean(), places=12)
        emptiest = [picture["covered"] for picture in model["frames"]["emptiest"]]
        self.assertEqual(emptiest, sorted(emptiest))

        boxes = [box for path in paths if "/boxes/" in path for box in load_json(os.path.join(folder, path))["objects"]]
        shares = [box["pixels_visible"] / box["pixels_amodal"] for box in boxes if box["pixels_amodal"] > 0]
        self.assertEqual(model["seen"]["boxes"]["shares"]["bins"], np.histogram(shares, 20, (0, 1))[0].tolist())
        self.assertEqual(model["seen"]["boxes"]["hidden"], sum(box["pixels_visible"] == 0 for box in boxes))

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
            np.testing.assert_allclose(camera["places"][0][4:], [forward[0], forward[2]], atol=1e-5)
            self.assertEqual(camera["model"], record["model"])
            self.assertAlmostEqual(camera["half"], np.arctan(record["width"] / 2 / record["K"][0][0]), places=5)

    def test_fewer_samples_than_pixels(self):
        folder = self.path("large")
        self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", folder, "--quiet", "--layers", "depth", "--size", "1500x300", "--cameras", "left", "--frames", "0")
        size, values = block_of(self.report(folder), 0, 0)
        self.assertEqual((size, values.shape), ((1500, 300), (128, 640, 1)))
        file = np.load(os.path.join(folder, "left/depth/000000.npy"))
        np.testing.assert_array_equal(values[..., 0], file[np.ix_(middles(128, 300), middles(640, 1500))].astype(np.float32))

    def test_subset_and_same_bytes(self):
        folder = self.render(layers="depth,objects")
        whole = model_of(self.report(folder))
        self.assertEqual((whole["dataset"]["pictures"], whole["dataset"]["shown"]), (6, 6))
        page = self.report(folder, "--pictures", "2", "--read", "3", "--threads", "1")
        model = model_of(page)
        self.assertEqual((model["dataset"]["read"], model["dataset"]["shown"]), (3, 2))
        self.assertEqual(model["layers"][0]["pictures"], 3)
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
            {"sample": 5, "refused": {"path": "objects/bowl/place", "why": "no room", "attempts": 20}}, {"sample": 6, "file": "000006.json"}]}))
        os.makedirs(self.path("scenes", "broken"))
        self.write("scenes/broken/manifest.json", "{")
        model = model_of(self.report(self.path("scenes")))
        self.assertEqual((model["dataset"]["scenesFound"], model["dataset"]["scenes"], model["dataset"]["pictures"]), (3, 2, 12))
        self.assertEqual([names["name"] for names in model["names"].values()], ["000000", "000001"])
        self.assertEqual(model["samples"]["reasons"], [{"path": "objects/bowl/place", "why": "no room", "times": 1, "example": "5"},
                                                       {"path": "objects/cup#1/place", "why": "no room <b>here</b>", "times": 1, "example": "4"}])
        self.assertEqual((model["samples"]["samples"], model["samples"]["touched"]), (3, 2))
        self.assertIn("broken", model["notes"][0])
        self.assertEqual(model["seen"]["objects"][0]["scenes"], 2)

    def test_documents_beside(self):
        folder = self.render(layers="color,depth,objects,classes,boxes,amodal", more=("--frames", "0"))
        self.dgtk("verify", folder, "--write")
        self.dgtk("export", folder, "--format", "coco", "-o", self.path("coco"), "--quiet")
        model = model_of(self.report(folder, "--export", self.path("coco")))
        self.assertTrue(model["verification"]["passed"])
        self.assertEqual(len(model["verification"]["residuals"]), len(load_json(os.path.join(folder, "verification.json"))["residuals"]))
        stated = load_json(self.path("coco", "export.json"))
        self.assertEqual((model["exports"][0]["format"], len(model["exports"][0]["layers"])), ("coco", len(stated["layers"])))

    def test_refusals(self):
        page = self.path("page.html")
        self.refused("report", self.path("nothing"), "-o", page, status=3, says="is not a dataset")
        self.refused("report", self.path("."), status=2, says="-o FILE.html")
        folder = self.render(layers="depth", more=("--frames", "0"))
        self.refused("report", folder, "-o", self.path("no", "where", "page.html"), status=4, says="page.html")
        self.refused("report", folder, "-o", page, "--verification", os.path.join(folder, "objects.json"), status=3, says="is not what a verification")
        self.refused("report", folder, "-o", page, "--pictures", "0", status=2, says="--pictures")
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


class Page(Report):
    """The same datasets in a browser."""
    test_numbers = test_fewer_samples_than_pixels = test_subset_and_same_bytes = test_folder_of_scenes = test_documents_beside = test_refusals = None

    def setUp(self):
        super().setUp()
        self.assertTrue(chromium(), "Chromium is not installed (Utilities/Setup/packages.txt)")

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
        with Browser(1400, 900) as browser:
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
        for width in (360, 1920):
            with Browser(width, 800, dark=True) as browser:
                browser.open(page)
                self.assertEqual(browser.evaluate("document.documentElement.scrollWidth"), width)

    def test_ten_thousand_pictures(self):
        """The work and the page do not grow with the dataset; the time that the page's own clock says is printed."""
        small = self.render("small", layers="color,depth,objects", more=("--frames", "0"))
        large = self.path("large")
        many_frames(small, large, 10_000)
        page = self.report(large)
        self.assertEqual(model_of(page)["dataset"]["pictures"], 10_000)
        self.assertEqual(model_of(page)["layers"][1]["pictures"], 240)
        self.assertLess(os.path.getsize(page), 12_000_000)
        with Browser(1400, 900) as browser:
            browser.open(page)
            browser.until("document.querySelectorAll('.shot img').length > 0")
            self.assertEqual(browser.evaluate("document.querySelectorAll('.shot').length"), 48)
            self.assertLess(browser.evaluate("document.querySelectorAll('.shot img').length"), 48)  # the others wait until they are near
            print("opened in", browser.evaluate("performance.getEntriesByType('navigation')[0].loadEventEnd"), "ms")
            self.assertEqual(browser.problems, [])


if __name__ == "__main__":
    main()
