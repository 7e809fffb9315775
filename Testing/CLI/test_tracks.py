#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Light, background, fog, materials and visibility with key frames: each frame is that of a scene without them."""
import copy
import json
import os

import numpy as np

import pictures
from harness import SOURCE, Case, load_json, main

LAST = 4
MODELS = os.path.join(SOURCE, "Data", "Models")
CAMERA = {"name": "c", "eye": [0.5, 2.5, 5], "lookAt": [0, 0.5, 0], "width": 64, "height": 48}
# a crate whose opacity changes, behind it a ball that goes and comes back, both with shadows on a floor
SCENE = {
    "keyFrames": [0, LAST],
    "background": {"keys": [[0, [0, 0, 0]], [4, [0.5, 0.25, 1]]]},
    "fog": {"color": {"keys": [[0, [1, 0, 0]], [4, [0, 0, 1]]]}, "density": {"keys": [[1, 0], [3, 0.1]]},
            "start": {"keys": [[0, 1], [4, 3]]}},
    "objects": [
        {"name": "floor", "model": os.path.join(MODELS, "floor.ac")},
        {"name": "ball", "model": os.path.join(MODELS, "ball.ac"), "position": [0.75, 0.5, -0.75], "scale": 4,
         "visible": {"keys": [[0, True], [2, False], [3, True]]}},
        {"name": "crate", "model": os.path.join(MODELS, "crate.ac"), "position": [-0.5, 0, 0],
         "materials": {"*": {"opacity": {"keys": [[0, 1], [2, 0.5], [4, 1]], "interpolation": "step"},
                             "diffuse": {"keys": [[0, [1, 1, 1]], [4, [1, 0, 0.5]]]},
                             "ambient": {"keys": [[0, [0, 0, 0]], [4, [0, 1, 0]]]},
                             "specular": {"keys": [[0, [1, 1, 1]], [4, [0, 0, 0]]]},
                             "emission": {"keys": [[0, [0, 0, 0]], [4, [0, 0, 0.5]]]},
                             "shininess": {"keys": [[0, 4], [4, 128]]}}}}],
    "lights": [
        {"name": "lamp", "position": [2, 5, 3], "shadows": True, "intensity": {"keys": [[0, 0.25], [4, 1]]},
         "diffuse": {"keys": [[0, [1, 1, 1]], [4, [1, 0.5, 0]]]}, "ambient": {"keys": [[0, [0, 0, 0]], [4, [0.5, 0.5, 0]]]}},
        {"name": "spot", "kind": "spot", "position": [-3, 6, 1], "target": [0, 0.25, 0], "shadows": True,
         "enabled": {"keys": [[0, False], [1, True], [4, False]]}, "coneAngle": {"keys": [[0, 10], [4, 40]]},
         "exponent": {"keys": [[0, 0], [4, 8]]}, "specular": {"keys": [[0, [0, 0, 0]], [4, [2, 2, 2]]]}}],
    "cameras": [CAMERA]}


def at(track, frame):
    """The value of an object {"keys", "interpolation"} at a frame."""
    keys = track["keys"]
    before = [key for key in keys if key[0] <= frame]
    after = [key for key in keys if key[0] > frame]
    if not before or not after or track.get("interpolation") == "step" or isinstance(keys[0][1], bool):
        return before[-1][1] if before else keys[0][1]
    (f, a), (g, b) = before[-1], after[0]
    u = (frame - f) / (g - f)
    return [x + (y - x) * u for x, y in zip(a, b)] if isinstance(a, list) else a + (b - a) * u


def constant(value, frame):
    """A scene, or a part of it, with the values of a frame in place of its tracks."""
    if isinstance(value, dict) and "keys" in value:
        return at(value, frame)
    if isinstance(value, dict):
        return {key: constant(part, frame) for key, part in value.items() if key != "keyFrames"}
    return [constant(part, frame) for part in value] if isinstance(value, list) else value


class Tracks(Case):
    def render(self, scene, name, *options):
        path = self.write(name + ".json", json.dumps(scene))
        self.dgtk("render", path, "-o", self.path(name), "--quiet", "--threads", 2, *options)
        return self.path(name)

    def file(self, folder, layer, frame, kind):
        return os.path.join(folder, "c", layer, f"{frame:06}.{kind}")

    def content(self, *place):
        with open(self.file(*place), "rb") as file:
            return file.read()

    def frames_alone(self, name, *options):
        """Datasets of the scene as it is in each frame, by one run."""
        os.mkdir(self.path(name))
        for frame in range(LAST + 1):
            self.write(os.path.join(name, f"{frame}.json"), json.dumps(constant(SCENE, frame)))
        out = self.path(name + "-out")
        self.dgtk("render", self.path(name), "-o", out, "--quiet", "--threads", 2, *options)
        return [os.path.join(out, str(frame)) for frame in range(LAST + 1)]

    def test_each_frame_is_that_of_a_scene_without_tracks(self):
        for renderer in ("ray", "vtk"):
            options = ("--renderer", renderer, "--layers", "color,depth,normal")
            whole = self.render(SCENE, "whole-" + renderer, *options)
            seen = set()
            for frame, plain in enumerate(self.frames_alone(renderer, *options)):
                for layer, kind in (("color", "png"), ("depth", "npy"), ("normal", "npy")):
                    with self.subTest(renderer=renderer, frame=frame, layer=layer):
                        self.assertEqual(self.content(whole, layer, frame, kind), self.content(plain, layer, 0, kind))
                seen.add(self.content(whole, "color", frame, "png"))
            self.assertEqual(len(seen), LAST + 1, "all frames differ")
            # the order of frames is nothing to the pictures
            for frame in (2, 3):
                with self.subTest(renderer=renderer, frame=frame):
                    part = self.render(SCENE, f"{renderer}-{frame}", "--renderer", renderer, "--layers", "color", "--frames", frame)
                    self.assertEqual(self.content(part, "color", frame, "png"), self.content(whole, "color", frame, "png"))

    def test_ids_stay_while_an_object_is_away(self):
        for engine in ("ray", "raster"):
            with self.subTest(engine=engine):
                out = self.render(SCENE, engine, "--visibility", engine, "--layers", "all", "--matte", "ball",
                                  "--objects-format", "npy")
                self.assertNotIn("BREACH", self.dgtk("verify", out).stdout)
                self.assertEqual([(o["id"], o["name"]) for o in load_json(os.path.join(out, "objects.json"))["objects"]],
                                 [(1, "floor"), (2, "ball"), (3, "crate")])
                for frame in range(LAST + 1):
                    ids = np.load(self.file(out, "objects", frame, "npy"))
                    self.assertEqual(set(np.unique(ids)) - {0}, {1, 3} if frame == 2 else {1, 2, 3})
                    ball = load_json(self.file(out, "boxes", frame, "json"))["objects"][1]
                    self.assertEqual((ball["id"], ball["name"]), (2, "ball"))
                    self.assertEqual(ball["pixels_visible"] > 0, frame != 2)
                    self.assertEqual(ball["pixels_amodal"] > 0, frame != 2)
                    self.assertEqual(ball["box_amodal"] is None, frame == 2)
                    self.assertIsNotNone(ball["R"])

    def test_what_is_no_longer_there_has_a_place_and_class_0(self):
        scene = copy.deepcopy(SCENE)
        scene["objects"][1]["position"] = {"keys": [[0, [0.75, 0.5, -0.75]], [4, [0.75, 1.5, -0.75]]]}
        out = self.render(scene, "out", "--layers", "objects,flow_forward,flow_backward",
                          "--flow-forward-format", "npy", "--flow-backward-format", "npy",
                          "--objects-format", "npy")
        self.assertNotIn("BREACH", self.dgtk("verify", out).stdout)
        for layer, frame in (("flow_forward", 1), ("flow_backward", 3)):
            with self.subTest(layer=layer):
                ball = np.load(self.file(out, "objects", frame, "npy")) == 2
                self.assertGreater(ball.sum(), 9)
                classes = pictures.read_png(self.file(out, layer, frame, "png"))[:, :, 0]
                flow = np.load(self.file(out, layer, frame, "npy"))
                self.assertEqual(set(classes[ball]), {0})
                up = flow[ball][:, 1] * (1 if layer == "flow_forward" else -1)
                self.assertTrue((up < -1).all(), "it goes up, where it would be seen")
                self.assertTrue((classes[np.load(self.file(out, "objects", frame, "npy")) == 1] > 0).all())
        y, x = np.argwhere(np.load(self.file(out, "objects", 1, "npy")) == 2)[0]
        self.write("points.txt", f"{x + 0.5} {y + 0.5}\n")
        point = json.loads(self.dgtk("correspond", self.path("out.json"), "--from", "c@1", "--to", "c@2", "--points",
                                     self.path("points.txt"), "--json").stdout)
        self.assertIn("no surface", json.dumps(point))
        self.assertIn("ball", json.dumps(point))

    def test_scenes_of_pov_ray_have_the_meshes_of_the_frame(self):
        def meshes(folder, frame):
            return [line for line in self.content(folder, "pov", frame, "pov").decode().splitlines()
                    if line.startswith("#include")]

        whole = self.render(SCENE, "whole", "--layers", "pov")
        for frame, plain in enumerate(self.frames_alone("pov", "--layers", "pov")):
            self.assertEqual(len(meshes(whole, frame)), 2 if frame == 2 else 3)
            self.assertEqual(meshes(whole, frame), meshes(plain, 0), frame)

    def test_values_beyond_their_range_are_refused_at_every_key(self):
        scene = copy.deepcopy(SCENE)
        scene["lights"][0]["intensity"]["keys"][1][1] = -1
        self.refused("render", self.write("bad.json", json.dumps(scene)), "-o", self.path("bad"), status=3,
                     says="lights[0].intensity.keys[1][1] is out of range")
        self.refused("convert", self.write("good.json", json.dumps(SCENE)), self.path("good.scene"), status=3,
                     says="cannot be said in .scene")

    def test_what_is_written_is_the_same_scene(self):
        self.dgtk("convert", self.write("a.json", json.dumps(SCENE)), self.path("b.json"))
        self.dgtk("convert", self.path("b.json"), self.path("c.json"))
        written = load_json(self.path("b.json"))
        self.assertEqual(load_json(self.path("c.json")), written)
        for part in ("background", "fog", "lights"):
            self.assertEqual(written[part], SCENE[part])
        self.assertEqual(written["objects"][1]["visible"], SCENE["objects"][1]["visible"])
        self.assertEqual(written["objects"][2]["materials"], SCENE["objects"][2]["materials"])


if __name__ == "__main__":
    main()
