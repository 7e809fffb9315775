# SPDX-License-Identifier: BSD-3-Clause
"""The layer tracks from the files on disk: points where their objects take them, seen or hidden as other layers say,
sampled once; the same bytes for any threads and after an interruption."""
import copy
import json
import os

import numpy as np

from harness import SOURCE, Case, digests, load_json, main

MODELS = os.path.join(SOURCE, "Data", "Models")
WIDTH, HEIGHT, STEP = 160, 120, 8
FRAMES = 6
PATH = np.array([[0.0, 0.3, 0.2], [1.2, 0.5, -0.4]])  # of the crate, at the frames 0 and FRAMES - 1


def scene():
    """A floor and a stone that stay, a crate that is moved, a creature that walks on the spot, one that goes and comes."""
    last = FRAMES - 1
    objects = [
        {"name": "floor", "model": "floor.ac"},
        {"name": "crate", "model": "crate.ac", "position": {"keys": [[0, PATH[0].tolist()], [last, PATH[1].tolist()]]}},
        {"name": "creature", "model": "creature.md2", "position": [-0.9, 0.03, 0.2], "scale": [0.02, 0.02, 0.02],
         "orientation": [0.541675, -0.541675, -0.454519, -0.454519], "animation": {"sequence": "walk"}},
        {"name": "stone", "model": "crate.ac", "position": [0.9, 0.1, 1.1], "scale": [0.3, 0.4, 0.3]},
        {"name": "blink", "model": "crate.ac", "position": [-0.2, 0.1, 1.4], "scale": [0.3, 0.3, 0.3],
         "visible": {"keys": [[0, True], [2, False], [4, True]]}}]
    for item in objects:
        item["model"] = os.path.join(MODELS, item["model"])
    plain = {"width": WIDTH, "height": HEIGHT, "near": 0.1, "far": 100}
    cameras = [{"name": "walk", "fovY": 50, "eye": {"keys": [[0, [-0.6, 1.2, 3.6]], [last, [0.6, 1.5, 2.6]]]},
                "lookAt": [0, 0.4, 0], **plain},
               {"name": "back", "fovY": 60, "eye": [0.4, 1.6, -3], "lookAt": [0, 0.3, 0], **plain},
               {"name": "away", "fovY": 60, "eye": [0, 1, 3], "lookAt": [0, 1.5, 9], **plain}]
    return {"version": 1, "objects": objects, "cameras": cameras}


class TrackLayer(Case):
    def render(self, folder, *options, description=None):
        path = self.write("scene.json", json.dumps(description or scene()))
        self.dgtk("render", path, "-o", self.path(folder), "--quiet", "--layers", "tracks,depth,objects",
                  "--tracks-step", STEP, "--tracks-every", 2, "--objects-format", "npy", *options)
        self.points = load_json(self.path(folder, "tracks", "points.json"))["points"]
        self.cameras = {(c["name"], c["frame"]): c for c in load_json(self.path(folder, "cameras.json"))["cameras"]}
        self.set = self.path(folder)

    def places(self, camera, frame):
        array = np.load(os.path.join(self.set, camera, "tracks", f"{frame:06}.npy"))
        self.assertEqual((array.shape, array.dtype), ((len(self.points), 3), np.float64))
        return array

    def layer(self, camera, layer, frame):
        return np.load(os.path.join(self.set, camera, layer, f"{frame:06}.npy"))

    def of_object(self, number):
        return np.array([point["object"] == number for point in self.points])

    def project(self, camera, frame, x):
        """Pixels and depths of points x (N, 3)."""
        record = self.cameras[camera, frame]
        there = x @ np.array(record["R"]).T + record["t"]
        with np.errstate(divide="ignore", invalid="ignore"):
            pixels = there @ np.array(record["K"]).T
            return pixels[:, :2] / pixels[:, 2:], there[:, 2]

    def test_points_are_where_their_objects_take_them(self):
        self.render("set")
        self.assertGreater(len(self.points), 150)
        self.assertEqual([point["static"] for point in self.points], [point["object"] in (1, 4, 5) for point in self.points])
        start = np.array([point["x"] for point in self.points])
        rigid = ~self.of_object(3)
        self.assertGreater(np.count_nonzero(~rigid), 3)
        classes = set()
        for camera, frame in self.cameras:
            x = start + np.outer(self.of_object(2), (PATH[1] - PATH[0]) * frame / (FRAMES - 1))
            pixels, depth = self.project(camera, frame, x)
            places = self.places(camera, frame)
            classes |= set(places[:, 2].tolist())
            behind, gone = depth <= 0, self.of_object(5) & (frame in (2, 3))
            np.testing.assert_array_equal(places[rigid, 2] == 0, gone[rigid])
            np.testing.assert_array_equal(places[rigid, 2] == 5, (behind & ~gone)[rigid])
            np.testing.assert_array_equal(np.isnan(places[rigid, 0]), (behind | gone)[rigid])
            there = rigid & ~behind & ~gone
            size = 1 + np.abs(pixels).max(axis=1, keepdims=True) / WIDTH
            np.testing.assert_allclose((places[:, :2] / size ** 2)[there], (pixels / size ** 2)[there], rtol=0, atol=1e-9)
            inside = (pixels >= 0).all(axis=1) & (pixels[:, 0] <= WIDTH) & (pixels[:, 1] <= HEIGHT)
            np.testing.assert_array_equal((places[:, 2] == 4)[there], ~inside[there])
            self.seen_as_depth_says(camera, frame, places, depth, there & inside)
        self.assertEqual(classes, {0, 1, 2, 3, 4, 5})

    def seen_as_depth_says(self, camera, frame, places, depth, inside):
        """Where the four pixels around are smooth, what is visible is at their depth, what is hidden behind it."""
        image, ids = self.layer(camera, "depth", frame), self.layer(camera, "objects", frame)
        compared = 0
        for i in np.nonzero(inside)[0]:
            u, v = (int(part) for part in places[i, :2])
            around = np.s_[max(0, v - 1):v + 2, max(0, u - 1):u + 2]
            patch = image[around]
            if not np.isfinite(patch).all() or np.ptp(patch) > 0.02 * patch.mean() or np.ptp(ids[around]) > 0:
                continue
            compared += 1
            own = ids[v, u] == self.points[i]["object"]
            if places[i, 2] == 1:
                self.assertTrue(own)
                self.assertLess(abs(depth[i] - image[v, u]), 0.03 * depth[i])
            else:
                self.assertEqual(places[i, 2], 3 if own else 2)
                self.assertGreater(depth[i], patch.min() * (0.97 if own else 0.999))
        self.assertGreater(compared, -1 if camera == "away" else 30)

    def test_points_are_followed_as_pixels_are(self):
        """A point's place one frame after its own is what the dense correspondence of its pixel says, to the bit."""
        description = scene()
        path = self.write("dense.json", json.dumps(description))
        self.render("set", "--frames", "0:1", "--tracks-every", 1)
        self.dgtk("render", path, "-o", self.path("dense"), "--quiet", "--layers", "correspondence", "--frames", "0:1",
                  "--pairs", "walk:walk+1,walk:back,back:walk+1")
        compared = 0
        for first, other, frame in (("walk", "walk", 1), ("walk", "back", 0), ("back", "walk", 1)):
            folder = self.path("dense", first, f"correspondence_{other}" + ("+1" if frame else ""))
            pixels = np.load(os.path.join(folder, "000000.npy"))
            own, places = self.places(first, 0), self.places(other, frame)
            for i, point in enumerate(self.points):
                if (point["camera"], point["frame"]) == (first, 0):
                    u, v = (int(part) for part in own[i, :2])
                    self.assertEqual((own[i, 0] - u, own[i, 1] - v, own[i, 2]), (0.5, 0.5, 1))
                    if places[i, 2] not in (0, 5):
                        self.assertEqual(places[i, :2].tolist(), pixels[v, u].tolist())
                        compared += 1
        self.assertGreater(compared, 150)

    def test_no_surface_is_sampled_twice_and_none_is_left_out(self):
        self.render("set")
        views = [(frame, camera) for frame in range(FRAMES) for camera in ("walk", "back", "away")]
        order = [views.index((point["frame"], point["camera"])) for point in self.points]
        self.assertEqual(order, sorted(order))
        self.assertEqual({point["frame"] for point in self.points}, {0, 2, 4})
        columns = np.arange(STEP // 2, WIDTH, STEP) + 0.5
        rows = np.arange(STEP // 2, HEIGHT, STEP) + 0.5
        grid = np.stack(np.meshgrid(columns, rows), axis=-1).reshape(-1, 2)
        for number, (frame, camera) in enumerate(views):
            if frame % 2:
                continue
            places, ids = self.places(camera, frame), self.layer(camera, "objects", frame)
            earlier = places[(np.array(order) < number) & (places[:, 2] == 1), :2]
            near = np.linalg.norm(grid[:, None] - earlier, axis=-1).min(axis=1, initial=np.inf) <= STEP / 2
            shows = np.array([ids[int(v), int(u)] > 0 for u, v in grid])
            own = [i for i, view in enumerate(order) if view == number]
            np.testing.assert_array_equal(places[own, :2], grid[shows & ~near], err_msg=f"{camera} {frame}")
            for i in own:
                u, v = places[i, :2]
                self.assertEqual(self.points[i]["object"], ids[int(v), int(u)])

    def test_the_same_bytes_for_any_threads_and_after_an_interruption(self):
        self.render("one", "--threads", 1)
        self.render("five", "--threads", 5)
        self.assert_same_files(self.path("one"), self.path("five"))
        manifest = load_json(self.path("five", "manifest.json"))
        shared = [entry for entry in manifest["files"] if entry["path"] == "tracks/points.json"]
        self.assertEqual([(entry["layer"], "camera" in entry, "frame" in entry) for entry in shared], [("tracks", False, False)])
        for lost in ("back/tracks/000003.npy", "tracks/points.json", None):
            with self.subTest(lost=lost):
                self.unfinish(manifest, lost)
                self.dgtk("render", self.path("scene.json"), "-o", self.path("five"), "--quiet", "--resume", "--layers",
                          "tracks,depth,objects", "--tracks-step", STEP, "--tracks-every", 2, "--objects-format", "npy")
                self.assert_same_files(self.path("one"), self.path("five"))

    def unfinish(self, manifest, lost):
        """What a run that was killed leaves, without a file."""
        for name in ("manifest.json", "cameras.json", "objects.json", "poses.json", "scene.json", *([lost] if lost else [])):
            os.remove(self.path("five", name))
        with open(self.path("five", ".dgtk-journal"), "w", encoding="utf-8") as journal:
            journal.write(f"DGTk journal 1 {manifest['request_hash']}\n")
            for f in manifest["files"]:
                if f.get("layer") and f["path"] != lost:
                    journal.write("\t".join([f["sha256"], str(f["bytes"]), str(f.get("frame", -1)), f["layer"],
                                             f.get("camera", ""), f["path"]]) + "\n")

    def test_one_view_and_none_with_a_surface(self):
        self.render("one", "--frames", "3", "--cameras", "walk")
        self.assertEqual({(point["camera"], point["frame"]) for point in self.points}, {("walk", 3)})
        self.assertEqual(set(self.places("walk", 3)[:, 2].tolist()), {1})
        self.dgtk("verify", self.path("one"))
        description = copy.deepcopy(scene())
        for item in description["objects"]:
            item["visible"] = False
        self.render("none", "--frames", "0:1", description=description)
        self.assertEqual(self.points, [])
        self.assertEqual(self.places("back", 1).shape, (0, 3))
        report = json.loads(self.dgtk("verify", self.path("none"), "--json").stdout)
        self.assertTrue(report["passed"])
        self.render("coarse", "--frames", "0", "--tracks-step", 4 * WIDTH)
        self.assertEqual(self.points, [])

    def test_a_grid_that_the_next_step_would_leave_at_the_pictures_border(self):
        width, height = STEP // 2 + 19 * STEP, STEP // 2 + 14 * STEP
        self.render("border", "--frames", "0:2", "--size", f"{width}x{height}", "--cameras", "walk")
        own = [(point["camera"], point["frame"]) == ("walk", 0) for point in self.points]
        places = self.places("walk", 0)[own, :2]
        self.assertGreater(len(places), 100)
        self.assertTrue((places < [width, height]).all())
        self.dgtk("verify", self.path("border"))

    def test_datasets_are_verified(self):
        self.render("set")
        report = json.loads(self.dgtk("verify", self.path("set"), "--json").stdout)
        rows = {row["layer"]: row for row in report["residuals"] if row["check"] == "tracks"}
        self.assertEqual(set(rows), {"points", "places", "classes", "static", "samples", "colors"})
        for name, row in rows.items():
            self.assertGreater(row["count"], 100, name)
        self.assertNotIn("tracks", {kind["layer"] for kind in report["not_checked"]})
        self.assertEqual(self.dgtk("compare", self.path("set"), self.path("set")).returncode, 0)
        os.remove(self.path("set", "back", "tracks", "000002.npy"))
        self.dgtk("verify", self.path("set"), status=1)

    def test_options_are_refused_in_words(self):
        path = self.write("scene.json", json.dumps(scene()))
        for option, value in (("--tracks-step", 0), ("--tracks-every", 0), ("--tracks-step", "x")):
            self.refused("render", path, "-o", self.path("out"), "--layers", "tracks", option, value, status=2,
                         says=(option, str(value)))
        self.assertFalse(os.path.exists(self.path("out")))
        self.assertEqual(digests(self.folder).keys(), {"scene.json"})


if __name__ == "__main__":
    main()
