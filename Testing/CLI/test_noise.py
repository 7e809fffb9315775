# SPDX-License-Identifier: BSD-3-Clause
"""color_noisy and depth_noisy, read back from disk: statistics over a million pixels against the formulas of
Documentation/Formats/sensor.md, and what must not change. Relative standard errors over a million pixels: 0.08 % of a variance
of three channels, 0.14 % of one, 0.2 % of a rate of 0.2; the limit of 1 % is five of them or more."""
import json
import os

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

from harness import SCENES, SOURCE, digests, load_json, main
from many_runs import ManyCase
from pictures import read_exr

ONE_PERCENT = 0.01
WIDTH, HEIGHT = 1250, 800  # a million pixels
DEMO = os.path.join(SCENES, "demo.json")
FLOOR = os.path.join(SOURCE, "Data", "Models", "floor.ac")


def read_png(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[::-1].astype(np.float64) / (65535 if pixels.dtype == np.uint16 else 255)


def camera(name, **more):
    """Looks down on the floor, which fills its image, from a height of 3."""
    return {"name": name, "width": WIDTH, "height": HEIGHT, "fovY": 40, "eye": [0, 3, 0], "lookAt": [0, 0, 0], "up": [0, 0, -1],
            **more}


def linear(**more):
    return {"color": {"response": "linear", **more}}


class Noise(ManyCase):
    def scene(self, name, cameras, **more):
        return self.write(name, json.dumps({"background": [1, 1, 1], **more, "cameras": cameras}))

    def render(self, scene, folder, *options, run=None):
        (run or self.dgtk)("render", scene, "-o", self.path(folder), "--quiet", *options)
        return self.path(folder)

    def color(self, folder, name, frame=0):
        return read_png(os.path.join(folder, name, "color_noisy", f"{frame:06}.png"))

    def near(self, found, expected, limit=ONE_PERCENT):
        self.assertLess(abs(found / expected - 1), limit, f"{found} {expected}")

    def test_variance_against_mean_is_the_photon_transfer_line(self):
        full_well, read = 5000, 10
        exposures = {"dim": 0.1, "medium": 0.3, "bright": 0.6}
        cameras = [camera(name, sensor=linear(exposure=e, fullWell=full_well, shotNoise=True, readNoise=read, bits=16))
                   for name, e in exposures.items()]
        out = self.render(self.scene("a.json", cameras), "out", "--layers", "color_noisy", "--color-bits", "16")
        means, variances = [], []
        for name, exposure in exposures.items():
            picture = self.color(out, name)
            means.append(picture.mean())
            variances.append(picture.var())
            self.near(means[-1], exposure)
            self.near(variances[-1], (exposure * full_well + read**2) / full_well**2)
            rest = picture - means[-1]
            for a, b in ((rest[:, 1:], rest[:, :-1]), (rest[1:], rest[:-1]), (rest[..., 1:], rest[..., :-1])):
                self.assertLess(abs((a * b).mean() / variances[-1]), 0.005)  # five standard errors
        slope, offset = np.polyfit(means, variances, 1)
        self.near(slope, 1 / full_well)

    def test_fixed_pattern_salt_and_pepper(self):
        cameras = [camera("fixed", sensor=linear(exposure=0.5, prnu=0.02, dsnu=30, columnNoise=20)),
                   camera("read", sensor=linear(exposure=0.5, readNoise=40)),
                   camera("salt", sensor=linear(exposure=0.5, salt=0.2, pepper=0.3))]
        out = self.render(self.scene("a.json", cameras, keyFrames=[0, 1]), "out", "--layers", "color_noisy", "--color-bits", "16")
        first, second = (self.color(out, "fixed", frame) for frame in (0, 1))
        self.assertTrue((first == second).all())
        columns = first.mean(axis=(0, 2))
        own = first - columns[None, :, None]
        self.near(own.std(), np.hypot(0.02 * 0.5, 30 / 10000))
        self.assertLess(abs(columns.std() / (20 / 10000) - 1), 5 / np.sqrt(2 * WIDTH))
        first, second = (self.color(out, "read", frame) - 0.5 for frame in (0, 1))
        self.near(first.std(), 40 / 10000)
        self.assertLess(abs((first * second).mean() / first.var()), 0.005)
        picture = self.color(out, "salt")
        self.near((picture == 1).all(axis=2).mean(), 0.2)
        self.near((picture == 0).all(axis=2).mean(), 0.3)

    def test_depth_noise_is_that_of_its_formulas(self):
        sensors = {"kinect": {"kinect": {"axial": 1}}, "gaussian": {"gaussian": [0.01, 0.002, 0.001]},
                   "stereo": {"stereo": {"baseline": 0.1, "sigma": 0.1, "subpixel": 0.125}}, "dropout": {"dropout": {"random": 0.2}},
                   "range": {"gaussian": [0.1, 0, 0], "least": 2.9, "most": 3.2}}
        cameras = [camera(name, sensor={"depth": sensor}) for name, sensor in sensors.items()]
        scene = self.scene("a.json", cameras, objects=[{"model": FLOOR}])
        out = self.render(scene, "out", "--layers", "depth,depth_noisy")
        depth = {name: np.load(os.path.join(out, name, "depth_noisy", "000000.npy")) for name in sensors}
        exact = np.load(os.path.join(out, "kinect", "depth", "000000.npy"))
        self.assertEqual((exact.dtype, depth["kinect"].dtype), (np.float64, np.float64))
        self.assertTrue((abs(exact - 3) < 1e-9).all())
        self.near(depth["kinect"].std(), 0.0012 + 0.0019 * 2.6**2)
        self.near(depth["kinect"].mean(), 3, 0.0001)
        self.near(depth["gaussian"].std(), 0.01 + 0.006 + 0.009)
        focal = HEIGHT / 2 / np.tan(np.radians(20))
        disparity = focal * 0.1 / depth["stereo"]
        self.assertLess(abs(disparity * 8 - np.rint(disparity * 8)).max(), 1e-9)
        self.near(disparity.var(), 0.1**2 + 0.125**2 / 12)
        self.near(np.isinf(depth["dropout"]).mean(), 0.2)
        self.assertTrue((depth["dropout"][np.isfinite(depth["dropout"])] == exact[np.isfinite(depth["dropout"])]).all())
        there = np.isfinite(depth["range"])
        self.assertTrue((depth["range"][there] >= 2.9).all() and (depth["range"][there] <= 3.2).all())
        self.near(there.mean(), 0.841345 - (1 - 0.977250))  # from one deviation below to two above

    def test_rays_and_focal_lengths_are_those_of_the_lens(self):
        """A wide camera over a floor that it sees from the side: angles are those of its rays, which get longer to the border."""
        width, height = 96, 64
        common = {"width": width, "height": height, "fovY": 60, "eye": [0, 1, 0.4], "lookAt": [0, 0, 0]}
        cameras = [{**common, "name": "color", "sensor": linear(vignetting={"cos4": 1})},
                   {**common, "name": "grazing", "sensor": {"depth": {"dropout": {"grazing": 1, "grazingAngle": 35}}}},
                   {**common, "name": "stereo", "aspect": 2, "sensor": {"depth": {"stereo": {"baseline": 0.1, "subpixel": 0.125}}}}]
        cameras[0].update(lookAt=[0, 2, 0.4], up=[0, 0, 1])  # where there is the background only
        out = self.render(self.scene("a.json", cameras, objects=[{"model": FLOOR}]), "out", "--layers", "color_noisy,depth,depth_noisy",
                          "--color-bits", "16")
        focal = height / 2 / np.tan(np.radians(30))
        y, x = np.mgrid[0:height, 0:width] + 0.5
        rays = np.stack([(x - width / 2) / focal, (y - height / 2) / focal, np.ones(x.shape)], axis=-1)
        length = np.linalg.norm(rays, axis=-1)
        read = lambda name: [np.load(os.path.join(out, name, layer, "000000.npy")) for layer in ("depth", "depth_noisy")]
        with self.subTest("vignetting"):
            self.assertLess(abs(self.color(out, "color") - length[..., None] ** -4).max(), 1e-4)
        with self.subTest("grazing"):
            normal = np.array([0, -0.4, -1]) / np.hypot(0.4, 1)  # the floor's, in the camera's axes: x right, y down
            angle = np.degrees(np.arccos(-(rays @ normal) / length))
            exact, seen = read("grazing")
            self.assertTrue(np.isfinite(exact).all())
            sure = abs(angle - 35) > 1e-3
            self.assertTrue((np.isfinite(seen) == (angle <= 35))[sure].all())
            self.assertTrue(0.1 < np.isfinite(seen).mean() < 0.9)
        with self.subTest("stereo"):
            exact, seen = read("stereo")
            scale = width / (2 * 2 * np.tan(np.radians(30))) * 0.1 / 0.125  # fx of a view twice as wide as high, steps
            steps = scale / seen
            self.assertLess(abs(steps - np.rint(steps)).max(), 1e-9)
            self.assertLess(abs(steps - scale / exact).max(), 0.5 + 1e-9)
            self.assertGreater(len(np.unique(np.rint(steps))), 3)

    def test_what_the_right_camera_cannot_see_is_what_rays_say(self):
        scene = load_json(os.path.join(SCENES, "fig_4_7_stereo.json"))  # parallel cameras 0.12 apart
        for item in scene["objects"]:
            item["model"] = os.path.join(SCENES, item["model"])
        scene["cameras"][0]["sensor"] = {"depth": {"stereo": {"baseline": 0.12}, "dropout": {"occluded": 1}}}
        out = self.render(self.write("stereo.json", json.dumps(scene)), "out", "--layers", "depth_noisy,correspondence",
                          "--pairs", "left:right", "--frames", "0")
        hidden = np.isinf(np.load(os.path.join(out, "left", "depth_noisy", "000000.npy")))
        classes = np.rint(read_png(os.path.join(out, "left", "correspondence_right", "000000.png"))[..., 0] * 255)
        there = (classes > 0) & (classes < 4)  # inside the right picture
        hidden, occluded = hidden[there], ((classes == 2) | (classes == 3))[there]
        self.assertGreater(occluded.sum(), 9000)
        # They part at the pixels along edges, and where what hides is itself not in the left picture.
        self.assertLess((hidden != occluded).mean(), 0.005)
        self.assertGreater((hidden & occluded).sum(), 0.88 * occluded.sum())
        self.assertGreater((hidden & occluded).sum(), 0.95 * hidden.sum())

    def test_the_layers_without_noise_are_untouched(self):
        common = ("--size", "160x120", "--frames", "0", "--visibility", "raster")
        plain = self.render(DEMO, "plain", "--layers", "color,depth,objects", *common)
        noisy = self.render(DEMO, "noisy", "--layers", "color,depth,objects,color_noisy,depth_noisy", "--seed", "5", *common)
        before, after = digests(plain), digests(noisy)
        for name in before:
            if name.count("/") == 2:
                self.assertEqual(before[name], after[name], name)
        self.assertNotEqual(after["left/color/000000.png"], after["left/color_noisy/000000.png"])
        depth, measured = (np.load(os.path.join(noisy, "left", layer, "000000.npy")) for layer in ("depth", "depth_noisy"))
        self.assertTrue(np.isinf(measured[np.isinf(depth)]).all())
        self.assertFalse((measured == depth)[np.isfinite(measured)].any())

    def test_a_sensor_without_effects_changes_nothing(self):
        scene = load_json(DEMO)
        for item in scene["objects"]:
            item["model"] = os.path.join(SCENES, item["model"])
        for item in scene["cameras"]:
            item["sensor"] = {"color": {}, "depth": {}}
        out = self.render(self.write("ideal.json", json.dumps(scene)), "out", "--layers", "color,depth,color_noisy,depth_noisy",
                          "--size", "320x240", "--frames", "0", "--depth-format", "npy,exr", "--depth_noisy-format", "npy,exr")
        found = digests(out)
        for name in ("color/000000.png", "depth/000000.npy", "depth/000000.exr"):
            layer, file = name.split("/")
            self.assertEqual(found[f"left/{layer}/{file}"], found[f"left/{layer}_noisy/{file}"])

    def test_exr_holds_linear_light_or_the_camera_s_own_values(self):
        scene = load_json(DEMO)
        for item in scene["objects"]:
            item["model"] = os.path.join(SCENES, item["model"])
        scene["cameras"][0]["sensor"] = {"color": {}}
        scene["cameras"][1]["sensor"] = linear()
        out = self.render(self.write("exr.json", json.dumps(scene)), "out", "--layers", "color,color_noisy", "--size", "320x240",
                          "--frames", "0", "--color-format", "exr", "--color_noisy-format", "png,exr", "--color-bits", "16")
        for name in ("left", "right"):  # without effects both are the light
            files = (read_exr(os.path.join(out, name, layer, "000000.exr"))[1] for layer in ("color", "color_noisy"))
            light, noisy = (np.dstack([channels[c] for c in "RGB"]) for channels in files)
            self.assertLess(abs(np.minimum(light, 1) - noisy).max(), 1e-6)  # a sensor is full at white
        self.assertLess(abs(self.color(out, "right") - noisy).max(), 0.51 / 65535)
        layers = load_json(os.path.join(out, "manifest.json"))["layers"]
        types = {layer["format"]: layer["type"] for layer in layers if layer["name"] == "color_noisy"}
        self.assertEqual(types, {"png": "uint16", "exr": "float32"})

    def test_the_same_bytes_for_threads_tiles_frames_and_other_layers(self):
        scene = os.path.join(SCENES, "noise_color.json")
        depth = os.path.join(SCENES, "noise_depth.json")
        one = self.render(scene, "one", "--layers", "color_noisy", "--size", "120x90", "--threads", "1", run=self.alone)
        many = self.render(scene, "many", "--layers", "color_noisy", "--size", "120x90", "--threads", "5", "--tile", "61x47")
        self.assert_same_files(one, many)
        one = self.render(depth, "one_depth", "--layers", "depth_noisy", "--threads", "1", run=self.alone)
        many = self.render(depth, "many_depth", "--layers", "depth_noisy", "--threads", "5")
        self.assert_same_files(one, many)
        options = ("--layers", "color_noisy,depth_noisy", "--size", "160x120", "--cameras", "left")
        both = digests(self.render(DEMO, "both", *options, "--frames", "0:1"))
        alone = digests(self.render(DEMO, "alone", *options, "--frames", "1"))
        for name in ("left/color_noisy/000001.png", "left/depth_noisy/000001.npy"):
            self.assertEqual(both[name], alone[name])
        self.assertNotEqual(both["left/depth_noisy/000000.npy"], both["left/depth_noisy/000001.npy"])

    def test_a_run_that_goes_on_gives_the_same_bytes(self):
        scene = os.path.join(SCENES, "noise_color.json")
        options = ("--layers", "color,color_noisy", "--cameras", "shot_high,fixed_high,jpeg_high")
        whole = self.render(scene, "whole", *options)
        broken = self.render(scene, "broken", *options)
        os.remove(os.path.join(broken, "fixed_high", "color_noisy", "000000.png"))
        self.render(scene, "broken", *options, "--resume")
        self.assert_same_files(whole, broken)

    def test_beyond_an_image_circle_it_is_dark(self):
        """What a point spread brings there too, where vignetting leaves nothing beyond 90 degrees."""
        lens = {"name": "c", "model": "fisheye", "K": [[9, 0, 32], [0, 9, 32], [0, 0, 1]], "width": 64, "height": 64, "eye": [0, 0, 1],
                "lookAt": [0, 0, 0], "sensor": linear(psf={"gaussian": 2}, vignetting={"cos4": 1})}
        out = self.render(self.scene("a.json", [lens]), "circle", "--layers", "color,color_noisy")
        seen = read_png(os.path.join(out, "c", "color", "000000.png"))[..., 0] > 0
        self.assertTrue(not seen[0, 0] and seen[32, 32])
        self.assertEqual(self.color(out, "c")[~seen].max(), 0)
        self.assertGreater(self.color(out, "c")[32, 32].min(), 0.9)

    def test_seeds(self):
        cameras = [{"name": "a", "width": 64, "height": 48, "eye": [0, 0, 1], "lookAt": [0, 0, 0],
                    "sensor": linear(exposure=0.5, shotNoise=True)}]
        cameras.append({**cameras[0], "name": "b"})
        pictures = {}
        for seed, option in ((0, 0), (0, 3), (3, 0), (1, 2), (2**53 - 1, 7)):
            out = self.render(self.scene("a.json", cameras, seed=seed), f"{seed}-{option}", "--layers", "color_noisy", "--seed", option)
            request = load_json(os.path.join(out, "manifest.json"))["request"]
            self.assertEqual(request["noise_seed"], str(seed + option))
            self.assertEqual(request["color_noisy_default_sensor"], "none")
            pictures[seed, option] = {name: self.color(out, name).tobytes() for name in "ab"}
        self.assertNotEqual(pictures[0, 0]["a"], pictures[0, 0]["b"])
        self.assertNotEqual(pictures[0, 0], pictures[0, 3])
        self.assertEqual(pictures[0, 3], pictures[3, 0])
        self.assertEqual(pictures[0, 3], pictures[1, 2])
        self.assertNotEqual(pictures[0, 3], pictures[2**53 - 1, 7])

    def test_the_manifest_names_cameras_with_the_default_sensor(self):
        out = self.render(DEMO, "out", "--layers", "color_noisy,depth_noisy", "--size", "64x48", "--frames", "0")
        manifest = load_json(os.path.join(out, "manifest.json"))
        self.assertEqual(manifest["request"]["color_noisy_default_sensor"], "left,right")
        self.assertEqual(manifest["request"]["depth_noisy_default_sensor"], "left,right")
        self.assertEqual(manifest["request"]["noise_seed"], "1")  # the scene's

    def test_refusals(self):
        pose = {"width": 32, "height": 24, "eye": [0, 0, 1], "lookAt": [0, 0, 0]}
        for sensor, says in (({"colour": {}}, "perhaps 'color'"), ({"color": {"bits": 12.5}}, "whole number"),
                             ({"color": {"psf": {"gaussian": 1, "disc": 2}}}, "one of gaussian, disc and kernel"),
                             ({"color": {"psf": {"kernel": [1, 1]}}}, "n odd"), ({"color": {"bayer": "RGBG"}}, "RGGB"),
                             ({"color": {"response": "table"}}, "at least two"), ({"color": {"salt": 0.6, "pepper": 0.6}}, "at most 1"),
                             ({"depth": {"least": 3, "most": 2}}, "more than least"), ({"depth": {"gaussian": [1, 2]}}, "list of 3"),
                             ({"depth": {"dropout": {"occluded": 1}}}, "stereo.baseline")):
            with self.subTest(sensor=sensor):
                line = self.refused("info", self.scene("bad.json", [{**pose, "sensor": sensor}]), status=3, says=says)
                self.assertIn("cameras[0].sensor", line)
        flat = {**pose, "model": "orthographic", "name": "flat", "sensor": {"depth": {"stereo": {"baseline": 0.1}}}}
        self.refused("render", self.scene("flat.json", [flat]), "-o", self.path("flat"), "--layers", "depth_noisy", status=2,
                     says=("flat", "focal length"))
        self.assertFalse(os.path.exists(self.path("flat", "manifest.json")))
        posed = self.scene("posed.json", [{**pose, "width": 0, "height": 0, "sensor": {}}], background=[0, 0, 0])
        self.refused("convert", posed, self.path("a.scene"), status=3, says="sensor cannot be said in .scene")


if __name__ == "__main__":
    main()
