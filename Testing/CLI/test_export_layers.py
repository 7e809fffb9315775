# SPDX-License-Identifier: BSD-3-Clause
"""What exporters to other people's formats read: boxes with what the image cuts off, disparities of the
frames beside, from files on disk by plain numpy."""
import json
import os

import numpy as np

from harness import SCENES, SOURCE, Case, load_json, main
from pictures import read_png

MODELS = os.path.join(SOURCE, "Data", "Models")
DEMO = os.path.join(SCENES, "demo.json")
SIZE = {"width": 96, "height": 72, "near": 0.5, "far": 60}


def model(name, file, **more):
    return {"name": name, "model": os.path.join(MODELS, file), **more}


def wide(camera):
    """A camera whose image is the canvas around that of another one."""
    width, height = camera["width"], camera["height"]
    more = {**camera, "name": camera["name"] + " wide", "width": 3 * width, "height": 3 * height}
    if "K" in camera:
        (a, s, x), (_, b, y), last = camera["K"]
        more["K"] = [[a, s, x + width], [0, b, y + height], last]
    else:
        more["viewHeight"] = 3 * camera["viewHeight"]
    return more


class WholeBoxes(Case):
    SCENE = {
        "version": 1,
        "objects": [
            model("floor", "floor.ac", scale=[9, 1, 9]),
            model("crate", "crate.ac", scale=[1.2, 1.2, 1.2], position=[-1.7, 0.03, 0.3]),
            model("creature", "creature.md2", position=[0.75, 0.03, 0.2], scale=[0.02, 0.02, 0.02],
                  orientation=[0.541675, -0.541675, -0.454519, -0.454519], animation={"sequence": "walk"}),
            model("grass", "grass.ac", position=[1.9, 0.03, 1.0], scale=[2, 2, 2]),
            model("away", "crate.ac", position=[40, 0, 0]),
            model("hidden", "crate.ac", scale=[0.3, 0.3, 0.3], position=[-1.7, 0.2, -1.5])],
        "lights": [],
        "cameras": [
            {"name": "plain", "K": [[90, 0, 48], [0, 90, 36], [0, 0, 1]], "eye": [0, 1.4, 4], "lookAt": [0, 0.6, 0], **SIZE},
            {"name": "skew", "K": [[90, 3, 40], [0, 85, 30], [0, 0, 1]], "eye": [1.5, 0.8, 2.5], "lookAt": [0, 0.7, 0],
             **SIZE},
            {"name": "parallel", "model": "orthographic", "viewHeight": 1.7, "eye": [2, 3, 5], "lookAt": [0, 0.5, 0], **SIZE}]}

    def boxes(self, scene, *options):
        path = self.write("scene.json", json.dumps(scene))
        self.dgtk("render", path, "-o", self.path("out"), "--layers", "boxes,objects,amodal", "--quiet", *options)
        self.dgtk("verify", self.path("out"), "--check", "boxes,partition")
        return {c["name"]: load_json(self.path("out", c["name"], "boxes", "000000.json"))["objects"]
                for c in scene["cameras"]}

    def test_the_canvas_is_the_image_of_a_wider_camera(self):
        cameras = self.SCENE["cameras"]
        found = self.boxes({**self.SCENE, "cameras": cameras + [wide(c) for c in cameras]}, "--frames", "0")
        reaching = set()
        for camera in (c["name"] for c in cameras):
            for near, far in zip(found[camera], found[camera + " wide"]):
                self.assertEqual(near["pixels_whole"], far["pixels_amodal"], (camera, near["name"]))
                box = far["box_amodal"]
                self.assertEqual(near["box_whole"], box and np.subtract(box, [96, 72, 96, 72]).tolist())
                if near["pixels_whole"] > near["pixels_amodal"] > 0:
                    reaching.add((camera, near["name"]))
            away = [o for o in found[camera] if o["name"] == "away"][0]
            self.assertEqual((away["pixels_whole"], away["box_whole"]), (0, None))
        for camera in ("plain", "skew", "parallel"):
            self.assertTrue({(camera, "floor"), (camera, "crate")} & reaching, reaching)
        hidden = [o for o in found["plain"] if o["name"] == "hidden"][0]
        self.assertEqual(hidden["pixels_visible"], 0)  # behind the crate
        self.assertGreater(hidden["pixels_whole"], 20)

    def test_what_is_wholly_in_the_image_is_amodal(self):
        self.dgtk("render", DEMO, "-o", self.path("out"), "--layers", "boxes", "--size", "160x120", "--frames", "0", "--quiet",
                  "--cameras", "left")
        inside = 0
        for o in load_json(self.path("out/left/boxes/000000.json"))["objects"]:
            box = o["box_projected"]
            self.assertGreaterEqual(o["pixels_whole"], o["pixels_amodal"])
            if min(box[:2]) >= 0 and box[2] <= 160 and box[3] <= 120:
                self.assertEqual((o["pixels_whole"], o["box_whole"]), (o["pixels_amodal"], o["box_amodal"]), o["name"])
                inside += 1
        self.assertGreater(inside, 5)

    def test_lenses_and_rolling_shutters(self):
        """Where a lens has a ray beyond its border, what is there counts; nothing is around a panorama."""
        pose = {"eye": [0, 1.4, 3], "lookAt": [0, 0.6, 0], **SIZE}
        focal = [[60, 0, 48], [0, 60, 36], [0, 0, 1]]
        cameras = [
            {"name": "fish", "model": "fisheye", "K": focal, "distortion": [0, 0, 0, 0], **pose},
            {"name": "straight", "model": "pinhole", "K": focal, **pose},
            {"name": "bent", "model": "pinhole", "K": focal, "distortion": [1e-12, 0, 0, 0], **pose},
            {"name": "rolling", "model": "pinhole", "K": focal, "rollingShutter": {"duration": 0.5, "direction": "down"}, **pose},
            {"name": "panorama", "model": "equirectangular", **pose}]
        found = self.boxes({**self.SCENE, "cameras": cameras}, "--frames", "0")
        counts = {name: [o["pixels_whole"] for o in objects] for name, objects in found.items()}
        self.assertEqual(counts["bent"], counts["straight"])
        self.assertGreater(counts["straight"][0], 10000)
        self.assertEqual(counts["panorama"], [o["pixels_amodal"] for o in found["panorama"]])
        crates = [found[name][1] for name in ("fish", "straight")]
        self.assertTrue(all(o["pixels_whole"] > o["pixels_amodal"] for o in crates))
        self.assertNotEqual(counts["fish"][1], counts["straight"][1])
        # nothing of the rigid scene moves: time does not matter
        self.assertEqual(counts["rolling"][:2] + counts["rolling"][3:], counts["straight"][:2] + counts["straight"][3:])


def rig(name, x, **more):
    """A camera of a rig that goes forward (along -z) by 0.3 a frame; keys turn it with the rig."""
    return {"name": name, "K": [[100, 0, 48], [0, 100, 36], [0, 0, 1]], **SIZE, "orientation": [0, 1, 0, 0],
            "position": {"keys": [[0, [x, 1, 4]], [2, [x, 1, 3.4]]]}, **more}


class MovedDisparities(Case):
    """Layers disparity_forward and disparity_backward."""

    def render(self, cameras, *options, frames=2, status=0, layers="disparity,disparity_forward,disparity_backward"):
        crate = model("crate", "crate.ac", scale=[1.2, 1.2, 1.2],
                      position={"keys": [[0, [-0.7, 0.03, 0.3]], [2, [-0.1, 0.03, 0.5]]]},
                      orientation={"keys": [[0, [0.98, 0, 0.2, 0]], [2, [0.9, 0, 0.43, 0]]]})
        objects = [model("floor", "floor.ac", scale=[3, 1, 3]), crate, model("grass", "grass.ac", position=[0.6, 0, 1])]
        scene = {"version": 1, "keyFrames": [0, frames], "objects": objects, "lights": [], "cameras": cameras}
        self.write("scene.json", json.dumps(scene))
        self.dgtk("render", self.path("scene.json"), "-o", self.path("out"), "--layers", layers, "--quiet",
                  "--disparity-format", "npy", "--objects-format", "npy", "--disparity_forward-format", "npy,pfm", "--disparity_backward-format", "npy",
                  *options, status=status)

    def load(self, camera, layer, frame):
        return np.load(self.path("out", camera, layer, f"{frame:06d}.npy"))

    def classes(self, camera, layer, frame):
        return read_png(self.path("out", camera, layer, f"{frame:06d}.png"))[..., 0]

    def files(self, layer, camera="left"):
        folder = self.path("out", camera, layer)
        return sorted(os.listdir(folder)) if os.path.isdir(folder) else []

    def test_they_are_what_correspondences_say(self):
        """The place in the one camera less that in the other, both at the other frame; the class is the partner's."""
        pairs = [f"{a}:{b}{step}" for a, b in (("left", "right"), ("right", "left"), ("left", "left"), ("right", "right"))
                 for step in ("+1", "-1")]
        self.render([rig("left", 0), rig("right", 0.12)], "--pairs", ",".join(pairs),
                    layers="disparity,disparity_forward,disparity_backward,correspondence,objects,depth,flow_forward")
        self.dgtk("verify", self.path("out"))
        seen = set()
        for camera, other, sign in (("left", "right", 1), ("right", "left", -1)):
            self.assertEqual(self.files("disparity_backward", camera)[::2], ["000001.npy", "000002.npy"])
            self.assertEqual(self.files("disparity_forward", camera)[::3], ["000000.npy", "000001.npy"])
            for layer, step, frame in (("disparity_forward", "+1", 0), ("disparity_forward", "+1", 1),
                                       ("disparity_backward", "-1", 1), ("disparity_backward", "-1", 2)):
                found = self.load(camera, layer, frame)
                own = self.load(camera, f"correspondence_{camera}{step}", frame)[..., 0]
                partner = self.load(camera, f"correspondence_{other}{step}", frame)[..., 0]
                np.testing.assert_array_equal(np.isnan(found), np.isnan(partner))
                self.assertLess(np.nanmax(abs(found - sign * (own - partner))), 1e-12)
                kinds = self.classes(camera, layer, frame)
                np.testing.assert_array_equal(kinds, self.classes(camera, f"correspondence_{other}{step}", frame))
                self.assertTrue(np.isnan(found[kinds == 0]).all() and np.isfinite(found[kinds == 1]).all())
                seen |= set(np.unique(kinds).tolist())
        self.assertTrue({0, 1, 2, 4} <= seen, seen)

    def test_of_what_stands_still_it_follows_from_depth(self):
        """The rig goes 0.3 forward: z - 0.3 a frame later, z + 0.3 a frame earlier. Of several partners it is the nearest."""
        self.render([rig("far", -0.3), rig("left", 0), rig("right", 0.12), rig("farther", -0.5)],
                    layers="disparity,disparity_forward,disparity_backward,depth,objects", frames=2)
        still = self.load("left", "objects", 1) != 2
        depth = self.load("left", "depth", 1)
        still &= np.isfinite(depth)
        self.assertGreater(still.sum(), 1000)
        for layer, step in (("disparity", 0), ("disparity_forward", -0.3), ("disparity_backward", 0.3)):
            found = self.load("left", layer, 1)[still]
            np.testing.assert_allclose(found, 100 * 0.12 / (depth[still] + step), rtol=1e-12)

    def test_of_partners_as_near_it_is_the_first(self):
        """The one on the left sees surfaces further right: what is outside its picture leaves it there."""
        self.render([rig("left", -0.12), rig("middle", 0), rig("right", 0.12)], "--frames", "0", layers="disparity,depth")
        depth = self.load("middle", "depth", 0)
        beyond = np.arange(96) + 0.5 + 100 * 0.12 / depth - 96
        sure = np.isfinite(depth) & (abs(beyond) > 1e-9)
        outside = self.classes("middle", "disparity", 0) == 4
        self.assertTrue((outside == (beyond > 0))[sure].all())
        self.assertGreater(outside.sum(), 50)

    def test_cameras_of_the_run_come_first(self):
        """The nearest of these; a camera by itself has that of the scene. Of several as near it is the first by name."""
        cameras = [rig("b", 0.2), rig("far", -0.4), rig("left", 0), rig("right", 0.12), rig("a", -0.12)]
        for names, x in ((("far", "left"), -0.4), (("left", "b", "far"), 0.2), (("left",), -0.12), ((), -0.12)):
            self.render(cameras, "--frames", "0", "--replace", *(("--cameras", ",".join(names)) if names else ()), layers="disparity,depth,objects")
            depth = self.load("left", "depth", 0)
            np.testing.assert_allclose(self.load("left", "disparity", 0)[np.isfinite(depth)], 100 * abs(x) / depth[np.isfinite(depth)], rtol=1e-12)
            outside = self.classes("left", "disparity", 0) == 4
            self.assertEqual(bool(outside[:, :20].any()), x > 0)
            self.assertEqual(bool(outside[:, -20:].any()), x < 0)
            self.dgtk("verify", self.path("out"))

    def test_where_there_is_none(self):
        self.render([rig("left", 0), rig("right", 0.12)], "--frames", "0", layers="disparity,disparity_forward")
        self.assertEqual(self.files("disparity_forward"), ["000000.npy", "000000.pfm", "000000.png"])
        path = self.path("scene.json")
        self.refused("render", path, "-o", self.path("last"), "--layers", "disparity_forward", "--frames", "2", status=2,
                     says=("disparity_forward", "a frame of the scene after"))
        # one that turns away from frame 0 on has no partner then, and none that lies behind a turn
        turning = rig("right", 0.12, orientation={"keys": [[0, [0, 1, 0, 0]], [1, [0.01, 0.99995, 0, 0]], [2, [0, 1, 0, 0]]]})
        scene = load_json(path)
        scene["cameras"][1] = turning
        self.write("scene.json", json.dumps(scene))
        self.refused("render", path, "-o", self.path("turned"), "--layers", "disparity_forward", status=2,
                     says=("disparity_forward", "two cameras side by side at both"))
        self.dgtk("render", path, "-o", self.path("turned"), "--layers", "disparity", "--quiet")
        self.assertEqual(sorted(os.listdir(self.path("turned/left/disparity")))[::2], ["000000.pfm", "000002.pfm"])
        # nor has one that goes over to the other side
        scene["cameras"][1] = rig("right", 0, position={"keys": [[0, [0.12, 1, 4]], [1, [-0.12, 1, 3.7]], [2, [-0.12, 1, 3.4]]]})
        self.write("scene.json", json.dumps(scene))
        self.dgtk("render", path, "-o", self.path("over"), "--layers", "disparity_forward", "--quiet")
        self.assertEqual(sorted(os.listdir(self.path("over/left/disparity_forward"))), ["000001.pfm", "000001.png"])


if __name__ == "__main__":
    main()
