#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The built-in renderer's light, lens and shutter against closed forms, from files read back from disk."""
import json
import math
import os
import unittest

import numpy as np

import harness
import pictures
from many_runs import ManyCase

BLACK = {"ambient": [0, 0, 0], "diffuse": [0, 0, 0], "specular": [0, 0, 0]}
GLOWING = {"*": {**BLACK, "emission": [1, 1, 1]}}


def linear(v):
    v = np.asarray(v, float)
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def encoded(v):
    v = np.asarray(v, float)
    return np.where(v <= 0.0031308, 12.92 * v, 1.055 * np.maximum(v, 0) ** (1 / 2.4) - 0.055)


def camera(width, height, height_in_units, distance=10, **more):
    """Looks along -z from z = distance; the plane z = 0 is height_in_units high in the picture."""
    focal = height * distance / height_in_units
    return {"name": "c", "width": width, "height": height, "near": 0.1, "far": 1000,
            "K": [[focal, 0, width / 2], [0, focal, height / 2], [0, 0, 1]],
            "position": [0, 0, distance], "orientation": [0, 1, 0, 0], **more}


class ImageFormation(ManyCase):
    def setUp(self):
        super().setUp()
        # a square of side 2 across z, with texture coordinates 0 to 1
        self.write("square.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
                   "f 1/1/1 2/2/1 3/3/1 4/4/1\n")
        corners = [(math.cos(2 * math.pi * i / 360), math.sin(2 * math.pi * i / 360)) for i in range(360)]
        self.write("disc.obj", "".join(f"v {x:.12f} {y:.12f} 0\n" for x, y in corners) +
                   "f " + " ".join(str(i + 1) for i in range(360)) + "\n")

    def render(self, scene, *options, name="scene", layers="color", threads=2, run=None):
        path = self.write("scene.json", json.dumps(scene))
        out = self.path(name + "_out")
        (run or self.dgtk)("render", path, "-o", out, "--replace", "--layers", layers, "--quiet", "--threads", threads, *options)
        return out

    def picture(self, scene, *options, name="scene"):
        """Linear light, rows x columns x RGB."""
        out = self.render(scene, "--color-format", "exr", *options, name=name)
        return self.read(os.path.join(out, "c", "color", "000000.exr"))

    @staticmethod
    def read(path):
        if path.endswith(".png"):
            return pictures.read_png(path)
        _, channels = pictures.read_exr(path)
        return np.stack([channels[c] for c in "RGB"], -1)

    def test_motion_blur_is_the_trapezoid_of_theory(self):
        width, speed, radius = 200, 40.0, 30.0  # pixels, pixels a frame, pixels
        unit = 1 / 10.0                          # scene units a pixel
        scene = {
            "objects": [{"model": "square.obj", "materials": GLOWING, "scale": radius * unit,
                         "position": {"keys": [[0, [0, 0, 0]], [10, [10 * speed * unit, 0, 0]]]}}],
            "cameras": [camera(width, 41, 41 * unit,
                               shutter={"open": -0.5, "close": 0.5, "exposures": 400})]}
        # frame 5: the square's middle is at 5 * speed from the picture's centre; the camera follows
        scene["cameras"][0]["position"] = [5 * speed * unit, 0, 10]
        out = self.render(scene, "--color-format", "exr", "--frames", 5, layers="color,color_sharp,objects")
        row = self.read(os.path.join(out, "c", "color", "000005.exr"))[20, :, 1]
        x = np.arange(width) + 0.5 - width / 2
        # the share of the time in which the pixel's centre is on the square: |x - speed t| < radius, |t| < 1/2
        low = np.clip((x - radius) / speed, -0.5, 0.5)
        high = np.clip((x + radius) / speed, -0.5, 0.5)
        expected = high - low
        self.assertLess(np.abs(row - expected).max(), 1 / 255)
        self.assertGreater(((row > 0.01) & (row < 0.99)).sum(), 60)
        sharp = self.read(os.path.join(out, "c", "color_sharp", "000005.png"))[20, :, 1]
        self.assertTrue(np.array_equal(sharp > 0, np.abs(x) < radius))
        # ground truth is the frame's own instant, to the byte
        still = dict(scene, cameras=[{**scene["cameras"][0], "shutter": {}}])
        plain = self.render(still, "--frames", 5, layers="color,objects", name="still")
        blurred, unblurred = harness.digests(out), harness.digests(plain)
        self.assertEqual(blurred["c/objects/000005.ppm"], unblurred["c/objects/000005.ppm"])
        self.assertEqual(blurred["c/color_sharp/000005.png"], unblurred["c/color/000005.png"])

    def test_one_exposure_is_a_picture_of_its_time(self):
        """A shutter of one instant, or a lens of one point, is drawn as such, with its sharp picture beside it."""
        self.write("quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n")
        camera = {"name": "c", "eye": [0, 0, 5], "lookAt": [0, 0, 0], "width": 40, "height": 30}
        moving = {"model": "quad.obj", "position": {"keys": [[0, [-2, 0, 0]], [4, [2, 0, 0]]]}}

        def drawn(**parts):
            scene = self.write("one.json", json.dumps({"objects": [moving], "cameras": [{**camera, **parts}]}))
            layers = ["color", "color_sharp"] if parts else ["color"]
            self.dgtk("render", scene, "-o", self.path("one"), "--layers", ",".join(layers), "--frames", "1:2", "--quiet", "--replace")
            return [[pictures.read_png(self.path("one", "c", layer, f"00000{frame}.png")) for frame in (1, 2)] for layer in layers]
        [[first, second]] = drawn()
        self.assertFalse(np.array_equal(first, second))
        for shutter in ({"open": 1, "close": 1}, {"open": 0.5, "close": 1.5, "exposures": 1}):
            later, sharp = drawn(shutter=shutter)
            np.testing.assert_allclose(later[0].astype(int), second, atol=1)
            np.testing.assert_array_equal(sharp, [first, second])
        pinhole, sharp = drawn(lens={"aperture": 1e-9, "exposures": 1})
        np.testing.assert_allclose(np.array(pinhole).astype(int), [first, second], atol=1)
        np.testing.assert_array_equal(sharp, [first, second])

    def test_a_disc_in_motion_keeps_its_light(self):
        """The profile of a disc: the mean over time of the chord; and the sum of light is kept."""
        speed, radius, unit, width = 24.0, 20.0, 0.1, 120
        scene = {"objects": [{"model": "disc.obj", "materials": GLOWING, "scale": radius * unit,
                              "position": {"keys": [[0, [-speed * unit, 0, 0]], [2, [speed * unit, 0, 0]]]}}],
                 "cameras": [camera(width, 61, 61 * unit, shutter={"open": -0.5, "close": 0.5, "exposures": 512})]}
        out = self.render(scene, "--color-format", "exr", "--frames", 1)
        got = self.read(os.path.join(out, "c", "color", "000001.exr"))[..., 0]
        x = np.arange(width) + 0.5 - width / 2
        worst = 0
        for j in range(61):
            y = j + 0.5 - 30.5
            half = math.sqrt(radius ** 2 - y ** 2) if abs(y) < radius - 0.5 else 0
            if not half:
                continue
            expected = np.clip((x + half) / speed, -0.5, 0.5) - np.clip((x - half) / speed, -0.5, 0.5)
            worst = max(worst, np.abs(got[j] - expected).max())
        self.assertLess(worst, 1 / 255)

    def test_out_of_focus_points_have_the_circle_of_the_thin_lens(self):
        aperture, focus, distance = 0.4, 4.0, 10.0
        focal = 300.0
        scene = {"objects": [{"model": "square.obj", "materials": GLOWING, "scale": 0.006}],
                 "cameras": [{**camera(41, 41, 41 * distance / focal, distance),
                              "lens": {"aperture": aperture, "focus": focus, "exposures": 600}}]}
        image = self.picture(scene, "--samples", 4)[..., 0].astype(float)
        x = np.arange(41) + 0.5 - 20.5
        total = image.sum()
        # second moment of a uniform disc of radius r: r^2 / 2
        moment = (image * (x[None, :] ** 2 + x[:, None] ** 2)).sum() / total
        radius = math.sqrt(2 * moment)
        expected = focal * aperture / 2 * abs(1 / focus - 1 / distance)
        self.assertGreater(expected, 8)
        self.assertLess(abs(radius / expected - 1), 0.02)
        # in focus it is a point
        scene["cameras"][0]["lens"].update(focus=distance, exposures=60)
        image = self.picture(scene, "--samples", 4, name="focused")[..., 0].astype(float)
        self.assertEqual((image > 0).sum(), 1)

    def test_48_bits_have_thousands_of_levels(self):
        # a long strip lit by a head light: its brightness falls smoothly
        self.write("bent.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn -1 0 1\nvn 1 0 1\n"
                   "f 1//1 2//2 3//2 4//1\n")
        scene = {"objects": [{"model": "bent.obj", "materials": {"*": {"ambient": [0, 0, 0], "diffuse": [1, 1, 1]}}}],
                 "lights": [{"kind": "directional", "position": [1, 0, 1], "target": [0, 0, 0]}],
                 "cameras": [camera(8192, 2, 2 * 2 / 8192)]}
        scene["objects"][0]["scale"] = [1, 1, 1]
        out = self.render(scene, "--color-bits", 16, name="png16")
        deep = self.read(os.path.join(out, "c", "color", "000000.png"))
        self.assertGreater(deep.max(), 255)
        self.assertGreater(len(np.unique(deep[..., 1])), 5000)
        exr = self.picture(scene, name="exr")
        self.assertGreater(len(np.unique(exr[..., 1])), len(np.unique(deep[..., 1])))
        out = self.render(scene, name="png8")
        plain = self.read(os.path.join(out, "c", "color", "000000.png"))
        self.assertTrue(np.array_equal(plain, np.rint(encoded(exr.astype(float)) * 255)))
        self.assertLessEqual(np.abs(deep.astype(int) - np.rint(plain.astype(float) * 257)).max(), 129)

    def test_shadows_end_where_geometry_says(self):
        floor = {"name": "floor", "model": "square.obj", "scale": 4,
                 "materials": {"*": {"ambient": [0, 0, 0], "diffuse": [1, 1, 1]}}}
        blocker = {"name": "blocker", "model": "square.obj", "scale": 0.5, "position": [0, 0, 1],
                   "materials": {"*": {**BLACK}}}
        # seen from below the blocker's edge: the shadow falls beside it
        view = {**camera(400, 400, 8), "near": 0.1}
        lights = {
            "directional": ({"kind": "directional", "position": [3, 0, 3], "target": [0, 0, 0]}, -1.0, 1.0),
            "point": ({"kind": "point", "position": [2, 0, 3]}, -1.0, 1.5),
            "spot": ({"kind": "spot", "position": [2, 0, 3], "target": [0, 0, 0], "coneAngle": 50, "exponent": 0}, -1.0,
                     1.5),
            "wide spot": ({"kind": "spot", "position": [2, 0, 3], "target": [0, 0, 0], "coneAngle": 80,
                           "exponent": 0}, -1.0, 1.5)}
        for name, (light, middle, size) in lights.items():
            with self.subTest(name):
                scene = {"objects": [floor, blocker], "lights": [{**light, "shadows": True, "shadowSize": 4096}],
                         "cameras": [view]}
                got = self.picture(scene, name=name.replace(" ", ""))[..., 1]
                del scene["lights"][0]["shadows"]
                lit = self.picture(scene, name=name.replace(" ", "") + "lit")[..., 1]
                x = (np.arange(400) + 0.5 - 200) * 8 / 400
                X, Y = np.meshgrid(x, -x)
                inside = np.maximum(np.abs(X - middle), np.abs(Y)) - size / 2
                free = np.maximum(np.abs(X) * 0.9, np.abs(Y) * 0.9) > 0.5  # not behind the blocker itself
                shadow = (inside < -0.03) & free
                outside = (inside > 0.03) & free
                self.assertGreater(shadow.sum(), 500)
                self.assertEqual((got[shadow] > 1e-6).sum(), 0)
                self.assertLess(np.abs(got[outside] - lit[outside]).max(), 1e-6)
                self.assertGreater(lit[outside].max(), 0.1)

    def test_fog_is_exponential_in_distance(self):
        scene = {"objects": [{"model": "square.obj", "scale": 4, "materials": GLOWING}],
                 "fog": {"color": [0.2, 0.4, 0.6], "density": 0.07, "start": 3}, "cameras": [camera(64, 48, 6)]}
        out = self.render(scene, "--color-bits", 16, layers="color,distance")
        distance = np.load(os.path.join(out, "c", "distance", "000000.npy")).astype(float)
        got = self.read(os.path.join(out, "c", "color", "000000.png")) / 65535
        clear = np.exp(-0.07 * (distance - 3))[..., None]
        seen = np.isfinite(distance)
        expected = clear + (1 - clear) * np.array([0.2, 0.4, 0.6])
        self.assertGreater(seen.sum(), 1000)
        self.assertLess(np.abs(got - expected)[seen].max(), 2e-5)
        self.assertGreater(np.ptp(clear[seen]), 0.005)

    @staticmethod
    def reflected(n, v, l, base, metallic, roughness):
        """Cook-Torrance with GGX, in linear light, for a light of strength 1, times pi."""
        h = (v + l) / np.linalg.norm(v + l, axis=-1, keepdims=True)
        nl, nv = np.maximum((n * l).sum(-1), 0), np.maximum((n * v).sum(-1), 1e-4)
        nh, vh = np.maximum((n * h).sum(-1), 0), np.maximum((v * h).sum(-1), 0)
        a2 = roughness ** 4
        d = a2 / (np.pi * (nh ** 2 * (a2 - 1) + 1) ** 2)
        vis = 0.5 / (nl * np.sqrt(nv ** 2 * (1 - a2) + a2) + nv * np.sqrt(nl ** 2 * (1 - a2) + a2))
        f0 = 0.04 * (1 - metallic) + base * metallic
        f = f0 + (1 - f0) * (1 - vh[..., None]) ** 5
        return nl[..., None] * (base * (1 - metallic) * (1 - f) + np.pi * (d * vis)[..., None] * f)

    def plane_points(self, width, height, height_in_units, distance):
        s = height_in_units / height
        X, Y = np.meshgrid((np.arange(width) + 0.5 - width / 2) * s, -(np.arange(height) + 0.5 - height / 2) * s)
        points = np.stack([X, Y, 0 * X], -1)
        v = np.array([0, 0, distance]) - points
        return points, v / np.linalg.norm(v, axis=-1, keepdims=True)

    def test_physically_based_materials_follow_their_formula(self):
        base, kinds = np.array([0.8, 0.5, 0.2]), {"a": (0, 0.3), "b": (1, 0.5), "c": (0.5, 0.8)}
        os.mkdir(self.path("pbr"))
        for name, (metallic, roughness) in kinds.items():
            self.write(f"pbr/{name}.json", json.dumps({"objects": [{"model": "../square.obj", "scale": 4, "materials": {"*": {
                "diffuse": list(base), "metallic": metallic, "roughness": roughness}}}],
                "lights": [{"kind": "point", "position": [1, 0.5, 2], "diffuse": [0.5, 0.5, 0.5], "specular": [0.5, 0.5, 0.5]}],
                "cameras": [camera(80, 60, 4)]}))
        points, v = self.plane_points(80, 60, 4, 10)
        l = np.array([1, 0.5, 2]) - points
        l /= np.linalg.norm(l, axis=-1, keepdims=True)
        n = np.broadcast_to([0.0, 0, 1], l.shape)
        for renderer, white in (("ray", np.inf), ("vtk", 1)):  # rays keep light above white
            self.dgtk("render", self.path("pbr"), "-o", self.path(renderer), "--layers", "color", "--color-format", "exr", "--quiet",
                      "--renderer", renderer)
            for name, (metallic, roughness) in kinds.items():
                with self.subTest((renderer, metallic, roughness)):
                    b = linear(base)
                    f0 = 0.04 * (1 - metallic) + b * metallic
                    expected = 0.5 * self.reflected(n, v, l, b, metallic, roughness) + linear(0.2) * (b * (1 - metallic) + f0)
                    got = self.read(self.path(renderer, name, "c", "color", "000000.exr"))
                    self.assertLess(np.abs(got - np.minimum(expected, white)).max(), 2e-4)
                    self.assertGreater(np.ptp(expected), 0.1)

    def environment(self, name, pixels):
        path = self.path(name + ".exr")
        pictures.write_exr(path, pixels)
        return {"image": name + ".exr"}

    def test_a_uniform_environment_lights_evenly(self):
        light = np.array([0.3, 0.5, 0.7], np.float32)
        base = np.array([0.6, 0.5, 0.4])
        # side by side, a matt one and a white mirror
        objects = [{"model": "square.obj", "position": [x, 0, 0], "materials": {"*": material}} for x, material in (
            (-1.5, {"diffuse": list(base), "metallic": 0, "roughness": 1}),
            (1.5, {"diffuse": [1, 1, 1], "metallic": 1, "roughness": 0}))]
        scene = {"objects": objects, "lights": [{"enabled": False}],
            "environment": self.environment("even", np.broadcast_to(light, (32, 64, 3))),
            "cameras": [camera(60, 60, 6)]}
        got = self.picture(scene)
        self.assertLess(np.abs(got[2, 2] - light).max(), 1e-3)  # the background
        middle = got[30, 15]
        # Lambert's part gives base * light less what is mirrored, and that is mirrored at full strength
        share = (middle - linear(base) * light) / ((1 - linear(base)) * light)
        self.assertTrue(np.all(share > 0.01) and np.all(share < 0.08), share)
        self.assertLess(np.ptp(share), 0.003)  # the same reflectance in every channel
        # all light comes back from a white metal
        self.assertLess(np.abs(got[30, 45] / light - 1).max(), 0.01)

    def test_a_mirror_shows_the_environment_where_it_lies(self):
        height = 128
        y, x = np.mgrid[0:height, 0:2 * height]
        around, down = ((x + 0.5) / height - 1) * np.pi, (y + 0.5) / height * np.pi
        d = np.stack([np.sin(down) * np.sin(around), np.cos(down), -np.sin(down) * np.cos(around)], -1)
        scene = {"objects": [{"model": "square.obj", "scale": 1.0,
                              "materials": {"*": {"diffuse": [1, 1, 1], "metallic": 1, "roughness": 0}}}],
                 "lights": [{"enabled": False}], "environment": self.environment("axes", (d + 1) / 2),
                 "cameras": [camera(120, 120, 8)]}
        scene["environment"]["rotation"] = 50
        got = self.picture(scene)
        _, v = self.plane_points(120, 120, 8, 10)
        turn = math.radians(-50)
        R = np.array([[math.cos(turn), 0, math.sin(turn)], [0, 1, 0], [-math.sin(turn), 0, math.cos(turn)]])
        mirrored = v * [-1, -1, 1]  # of the view vector about +z
        border = np.zeros((120, 120), bool)
        border[40:80, 40:80] = True
        inner = np.zeros_like(border)
        inner[48:72, 48:72] = True
        self.assertLess(np.abs(got - (-v @ R.T + 1) / 2)[~border].max(), 0.004)
        self.assertLess(np.abs(got - (mirrored @ R.T + 1) / 2)[inner].max(), 0.02)

    def test_normal_and_bump_maps_turn_the_normal(self):
        lamp = {"kind": "directional", "position": [1, 2, 3], "target": [0, 0, 0]}
        l = np.array([1.0, 2, 3]) / math.sqrt(14)
        scene = {"objects": [{"model": "square.obj", "materials": {"*": {"ambient": [0, 0, 0],
                                                                         "diffuse": [1, 1, 1]}}}],
                 "lights": [lamp], "cameras": [camera(40, 40, 3)]}
        material = scene["objects"][0]["materials"]["*"]
        for turned in [(0, 0, 1), (0.6, 0, 0.8), (0, -0.6, 0.8), (-0.36, 0.48, 0.8)]:
            code = np.rint(np.array(turned) * 127 + 128).astype(np.uint8)
            pictures.write_png(self.path("normals.png"), np.broadcast_to(code, (4, 4, 3)))
            material["normalMap"] = "normals.png"
            n = (code - 128.0) / 127
            n /= np.linalg.norm(n)
            got = encoded(self.picture(scene, name="normal")[20, 20, 1].astype(float))
            self.assertLess(abs(got - n @ l), 1e-3, turned)
        # the back of the square, seen from behind, is lit from there
        del material["normalMap"]
        # a ramp: the height grows by 1/2 over the square's width of 2
        ramp = np.broadcast_to((np.arange(256) + 0.5)[None, :, None] / 256 * 255, (256, 256, 3)).astype(np.uint8)
        pictures.write_png(self.path("ramp.png"), ramp)
        material.update(bump="ramp.png", bumpScale=0.5)
        image = encoded(self.picture(scene, name="bump")[..., 1].astype(float))
        n = np.array([-0.25, 0, 1]) / math.hypot(0.25, 1)
        self.assertLess(abs(image[10:30, 10:30].mean() - n @ l), 4e-3)
        self.assertGreater(abs(n @ l - l[2]), 0.05)

    def test_normal_maps_lie_on_unit_vectors_along_the_coordinates(self):
        """Stretched, sheared (the tangent keeps v) and mirrored coordinates, and objects that are stretched."""
        lamp = np.array([2.0, 1, 3]) / math.sqrt(14)
        code = np.array([210, 90, 200])
        pictures.write_png(self.path("normals.png"), np.broadcast_to(code, (4, 4, 3)).astype(np.uint8))
        n = (code - 128.0) / 127
        n /= np.linalg.norm(n)
        rows = [((1, 0, 0, 4), (1, 1, 1), (1, 1)), ((20, 0, 0, 1), (1, 1, 1), (1, 1)), ((1, 0.7, 0, 1), (1, 1, 1), (1, 1)),
                ((-1, 0, 0, 3), (1, 1, 1), (-1, 1)), ((1, 0, 0, 1), (1, -2, 1), (1, -1))]
        objects, expected = [], []
        for i, ((ux, uy, vx, vy), scale, (right, up)) in enumerate(rows):
            corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
            self.write(f"mapped{i}.obj", "".join(f"v {x} {y} 0\nvt {ux * x + uy * y} {vx * x + vy * y}\n" for x, y in corners) +
                       "vn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n")
            objects.append({"model": f"mapped{i}.obj", "position": [4 * i - 8, 0, 0], "scale": list(scale),
                            "materials": {"*": {**BLACK, "diffuse": [1, 1, 1], "normalMap": "normals.png"}}})
            expected.append(n * [right, up, 1] @ lamp)
        scene = {"objects": objects, "cameras": [camera(100, 20, 4)],
                 "lights": [{"kind": "directional", "position": lamp.tolist(), "target": [0, 0, 0]}]}
        for renderer in ("ray", "vtk"):
            got = encoded(self.picture(scene, "--renderer", renderer, name=renderer)[10, 10::20, 1].astype(float))
            self.assertLess(np.abs(got - expected).max(), 1e-3, f"{renderer} {got} {expected}")

    def test_bumps_are_slopes_over_a_texel(self):
        """Of a picture that is magnified: what lies a texel to the right less what lies one to the left, over two."""
        heights = np.array([40, 40, 200, 200, 120, 40, 200, 120])
        pictures.write_png(self.path("steps.png"), np.broadcast_to(heights[None, :, None], (8, 8, 3)).astype(np.uint8))
        l = np.array([1.0, 2, 3]) / math.sqrt(14)
        scene = {"objects": [{"model": "square.obj", "materials": {"*": {"ambient": [0, 0, 0], "diffuse": [1, 1, 1], "bump": "steps.png", "bumpScale": 0.2}}}],
                 "lights": [{"kind": "directional", "position": [1, 2, 3], "target": [0, 0, 0]}], "cameras": [camera(40, 40, 3)]}
        x = (np.arange(40) + 0.5 - 20) * 3 / 40
        texel = 8 * (x + 1) / 2 - 0.5

        def height(at):
            low = np.floor(at).astype(int)
            return (heights[low % 8] * (1 - at + low) + heights[(low + 1) % 8] * (at - low)) / 255
        slope = 0.2 * (height(texel + 1) - height(texel - 1)) / 2 * 8 / 2  # 8 texels are 2 units
        expected = (l[2] - slope * l[0]) / np.hypot(slope, 1)
        for renderer in ("ray", "vtk"):
            row = encoded(self.picture(scene, "--renderer", renderer, name=renderer)[20, :, 1].astype(float))
            inside = np.abs(x) < 0.96
            self.assertGreater(np.ptp(expected[inside]), 0.1)
            self.assertLess(np.abs(row - expected)[inside].max(), 4e-3, renderer)

    def test_filters_spread_a_point_by_their_weights(self):
        scene = {"objects": [{"model": "square.obj", "materials": GLOWING, "scale": 0.05}],
                 "cameras": [camera(15, 15, 1.5)]}  # exactly the middle pixel
        radius = {"box": 0, "triangle": 1, "gaussian": 1, "mitchell": 2, "lanczos": 3}
        for name, reach in radius.items():
            out = self.render(scene, "--samples", 4, "--filter", name, "--color-bits", 16, name=name)
            image = self.read(os.path.join(out, "c", "color", "000000.png"))[..., 1] / 65535
            lit = np.argwhere(image > 0)
            self.assertLessEqual(np.abs(lit - 7).max(), reach, name)
            self.assertTrue(np.allclose(image, image.T) and np.allclose(image, image[::-1]), name)
            if name in ("box", "triangle", "gaussian"):
                self.assertAlmostEqual(image.sum(), 1, delta=1e-3)
                self.assertEqual(image[7, 7] == 1, name == "box")
        self.refused("render", self.path("scene.json"), "-o", self.path("no"), "--filter", "gaussian", status=2,
                     says="samples")

    def test_over_its_background_the_cut_out_picture_is_the_picture_again(self):
        scene = {"background": [0.2, 0.4, 0.6], "objects": [{"name": "disc", "model": "disc.obj"}],
                 "lights": [{"kind": "directional", "position": [0, 0, 1], "target": [0, 0, 0], "intensity": 1.6}],
                 "cameras": [{"name": "c", "eye": [0, 0, 4], "lookAt": [0, 0, 0], "width": 48, "height": 36}]}
        for name, options in {"plain": (), "brighter": ("--exposure", 1), "film": ("--exposure", -1, "--tone", "filmic")}.items():
            out = self.render(scene, "--samples", 3, *options, layers="color,color_rgba", name=name)
            color, rgba = (self.read(os.path.join(out, "c", layer, "000000.png")).astype(float) for layer in ("color", "color_rgba"))
            share = rgba[..., 3:] / 255
            self.assertGreater(((share > 0) & (share < 1)).sum(), 20)
            apart = share * rgba[..., :3] + (1 - share) * color[0, 0] - color
            self.assertLessEqual(np.abs(np.where((rgba[..., :3] == 255) & (apart < 0), 0, apart)).max(), 2, name)
            self.dgtk("verify", out)
        # What exposure lifts above white is white behind the object.
        dark = {**scene, "background": [0.9, 0.9, 0.9], "objects": [{"model": "disc.obj", "materials": {"*": {**BLACK, "emission": [0.2, 0.3, 0.1]}}}]}
        out = self.render(dark, "--samples", 3, "--exposure", 1, layers="color,color_rgba", name="white")
        color, rgba = (self.read(os.path.join(out, "c", layer, "000000.png")).astype(float) for layer in ("color", "color_rgba"))
        self.assertEqual(color[0, 0].tolist(), [255] * 3)
        self.assertLessEqual(np.abs(rgba[..., 3:] / 255 * (rgba[..., :3] - 255) + 255 - color).max(), 2)
        self.dgtk("verify", out)
        # Edges that OpenGL rounds to the centres of pixels.
        scene["objects"][0].update(model="square.obj", position=[4 / 32 * 8.50005 - 1, 4 / 32 * 0.49995, 0])
        scene["cameras"][0]["K"] = [[32, 0, 24], [0, 32, 18], [0, 0, 1]]
        out = self.render(scene, "--renderer", "vtk", layers="color,color_rgba", name="drawn")
        color, rgba = (self.read(os.path.join(out, "c", layer, "000000.png")) for layer in ("color", "color_rgba"))
        self.assertTrue(((rgba[..., 3] > 0) != (color != color[0, 0]).any(-1)).any(), "what is drawn differs at some edge")
        self.dgtk("verify", out)
        # Where a lens has no ray the picture is black, and what it shows beside that has the colours of the picture.
        scene.update(background=[0.3, 0.5, 0.8])
        scene["objects"][0].update(model="disc.obj", position=[-8, 0, 3], scale=8)
        scene["cameras"][0].update(model="fisheye", K=[[20, 0, 24], [0, 20, 18], [0, 0, 1]], distortion=[-0.3, 0, 0, 0])
        out = self.render(scene, "--samples", 3, layers="color,color_rgba", name="circle")
        color, rgba = (self.read(os.path.join(out, "c", layer, "000000.png")).astype(float) for layer in ("color", "color_rgba"))
        self.assertEqual(rgba[0, 0].tolist() + color[0, 0].tolist(), [0] * 7)
        self.assertTrue(((rgba[..., 3] == 0) & (color.sum(-1) > 0)).any(), "background in the circle")
        circle = (rgba[..., 3] > 0) & (rgba[..., 3] < 255) & (np.arange(48) < 20)
        self.assertGreater(circle.sum(), 5)
        self.assertLessEqual(np.abs(rgba[circle][:, :3] * rgba[circle][:, 3:] / 255 - color[circle]).max(), 2)
        self.dgtk("verify", out)
        # By a curve, a dark edge may be darker than the background's share.
        del scene["lights"][:]
        scene["objects"][0]["materials"] = {"*": {"ambient": [0, 0, 0], "diffuse": [0, 0, 0]}}
        out = self.render(scene, "--samples", 3, "--tone", "filmic", layers="color,color_rgba", name="dark")
        color, rgba = (self.read(os.path.join(out, "c", layer, "000000.png")).astype(float) for layer in ("color", "color_rgba"))
        edge = (rgba[..., 3] > 0) & (rgba[..., 3] < 255) & (np.hypot(*np.meshgrid(np.arange(48) - 23.5, np.arange(36) - 17.5)) < 12)
        self.assertLess((color[edge] - (1 - rgba[edge][:, 3:] / 255) * color[18, 30]).min(), -3)
        self.dgtk("verify", out)
        said = self.refused("render", self.path("scene.json"), "-o", self.path("no"), "--layers", "color_rgba", "--samples", 2,
                            "--filter", "gaussian", status=2, says="color_rgba")
        self.assertIn("filter box", said)

    def test_nothing_depends_on_threads_and_tiles(self):
        sky = np.zeros((16, 32, 3), np.float32) + np.array([0.2, 0.3, 0.5], np.float32)
        sky[:8] += 0.5
        scene = {
            "objects": [{"model": os.path.join(harness.SOURCE, "Data/Models/table.ac")},
                        {"model": os.path.join(harness.SOURCE, "Data/Models/floor.ac"), "position": [0, 0, 0]},
                        {"name": "moving", "model": os.path.join(harness.SOURCE, "Data/Models/creature.md2"),
                         "position": {"keys": [[0, [0, 1, 0]], [2, [0.3, 1, 0]]]}, "scale": 0.02},
                        {"model": "square.obj", "position": [0.5, 1, 0.5], "scale": 0.3,
                         "materials": {"*": {"metallic": 1, "roughness": 0.2, "opacity": 0.5}}}],
            "lights": [{"kind": "directional", "position": [1, 3, 2], "target": [0, 0, 0], "shadows": True, "shadowSize": 512},
                       {"kind": "point", "position": [-1, 2, 1], "shadows": True, "shadowSize": 256,
                        "attenuation": [1, 0, 0.5]},
                       {"kind": "spot", "position": [0, 3, 0], "target": [0, 0, 0], "shadows": True, "shadowSize": 256}],
            "environment": self.environment("sky", sky), "fog": {"density": 0.05},
            "cameras": [{"name": "c", "eye": [1.5, 2, 3], "lookAt": [0, 0.7, 0], "width": 72, "height": 54,
                         "shutter": {"open": 0, "close": 0.5, "exposures": 4}, "lens": {"aperture": 0.05, "focus": 3}}]}
        scene["cameras"][0]["lens"]["exposures"] = 6
        layers = "color,color_sharp,color_noisy,depth_noisy,tiles,depth,objects,alpha"
        first = self.render(scene, "--tile", "32x24", "--frames", "0:1", "--samples", 2, layers=layers, name="a")
        second = self.render(scene, "--tile", "32x24", "--frames", "0:1", "--samples", 2, layers=layers, name="b", threads=1, run=self.alone)
        self.assert_same_files(first, second)
        third = self.render(scene, "--tile", "19x1000", "--samples", 2, "--frames", "0:1", "--gl", "osmesa", layers=layers, name="c",
                            threads=3)
        names = [n for n in harness.digests(third) if "/tiles/" in n] + [
            n for n in harness.digests(first) if "/tiles/" in n] + ["manifest.json"]
        self.assert_same_files(first, third, ignore=names)
        whole = self.read(os.path.join(first, "c", "color", "000000.png"))
        self.assertTrue(np.array_equal(self.read(os.path.join(first, "c", "tiles", "000000_1_1.png")),
                                       whole[24:48, 32:64]))


if __name__ == "__main__":
    unittest.main()
