# SPDX-License-Identifier: BSD-3-Clause
"""POV-Ray scenes: what POV-Ray draws is what the object map says, and our own reader gets the triangles back."""
import json
import os
import re
import subprocess

import numpy

from harness import SCENES, SOURCE, WHOLE, digests, main, needs_povray
from many_runs import ManyCase
from pictures import read_png

MODELS = os.path.join(SOURCE, "Data", "Models")
# Pixels whose centre lies this near to an edge may go either way: two engines round differently.
EDGE = 1 / 64
# Difference of the mean colour inside surfaces from the built-in picture's, of 255. Pixel by pixel textures differ more,
# because VTK minifies them and POV-Ray does not. Measured: below 1.
COLOR_TOLERANCE = 2


def read_ppm(path):
    with open(path, "rb") as file:
        data = file.read()
    width, height = map(int, re.match(rb"P6\s(?:#.*\n)*(\d+)\s+(\d+)\s+255\s", data).groups())
    return numpy.frombuffer(data[-width * height * 3:], numpy.uint8).reshape(height, width, 3).astype(int)


def read_ids(path):
    rgb = read_ppm(path)
    return (rgb[..., 0] << 16) + (rgb[..., 1] << 8) + rgb[..., 2]


def moved(camera, x, y):
    """The camera with its image moved by (x, y) pixels."""
    changed = dict(camera)
    if "K" in camera:
        changed["K"] = [row[:] for row in camera["K"]]
        changed["K"][0][2] += x
        changed["K"][1][2] += y
        return changed
    eye, to = numpy.array(camera["eye"], float), numpy.array(camera["lookAt"], float)
    right = numpy.cross(to - eye, [0, 1, 0])
    down = numpy.cross(to - eye, right)
    pixel = camera["viewHeight"] / camera["height"]
    step = -pixel * (x * right / numpy.linalg.norm(right) + y * down / numpy.linalg.norm(down))
    changed["eye"], changed["lookAt"] = (eye + step).tolist(), (to + step).tolist()
    return changed


class Pov(ManyCase):
    def povray(self, scene):
        """What POV-Ray makes of a scene; its size stands in the file's second line."""
        with open(scene, encoding="utf-8") as file:
            options = file.read().split("\n")[1].split()[2:-1]
        target = os.path.splitext(scene)[0] + ".drawn.ppm"
        done = subprocess.run(["povray", *options, "+FP8", f"+I{scene}", f"+O{target}", "-D", "-V", "-GA"], capture_output=True,
                              text=True, cwd=os.path.dirname(scene), timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        return read_ppm(target)

    def scene(self, name, camera, change=None):
        """A sample scene, the camera first and changed."""
        with open(os.path.join(SCENES, name), encoding="utf-8") as file:
            scene = json.load(file)
        scene["cameras"].sort(key=lambda c: c["name"] != camera)  # the others keep the range of frames
        for thing in scene["objects"]:
            thing["model"] = os.path.join(SCENES, thing["model"])
        scene["cameras"][0].update(change or {})
        return scene

    def render(self, scene, name, frame, cameras, layers="objects,triangles"):
        self.dgtk("render", self.write(name + ".json", json.dumps(scene)), "-o", self.path(name), "--quiet", "--visibility",
                  "ray" if "color" not in layers else "auto", "--layers", layers, "--frames", frame, "--cameras", ",".join(cameras))

    def ids(self, folder, frame):
        """Object and triangle of every pixel."""
        objects = read_ids(os.path.join(folder, "objects", f"{frame:06d}.ppm"))
        return objects, numpy.load(os.path.join(folder, "triangles", f"{frame:06d}.npy"))

    def check(self, scene, frame):
        camera = scene["cameras"][0]
        corners = [(-EDGE, -EDGE), (-EDGE, EDGE), (EDGE, -EDGE), (EDGE, EDGE)]  # some corner lies beyond any near edge
        near_by = [{**moved(camera, x, y), "name": f"moved{i}"} for i, (x, y) in enumerate(corners)]
        self.write("exact.json", json.dumps(scene))
        self.render({**scene, "cameras": [*scene["cameras"], *near_by]}, "near", frame, [camera["name"], *(other["name"] for other in near_by)])
        expected, triangles = self.ids(self.path("near", camera["name"]), frame)
        near = numpy.zeros(expected.shape, bool)
        for other in near_by:
            ids, piece = self.ids(self.path("near", other["name"]), frame)
            near |= (ids != expected) | (piece != triangles)
        pov = self.path("flat.pov")
        self.dgtk("convert", self.path("exact.json"), pov, "--flat-ids", "--camera", camera["name"], "--frame", frame)
        rgb = self.povray(pov)
        drawn = (rgb[..., 0] << 16) + (rgb[..., 1] << 8) + rgb[..., 2]
        differing = drawn != expected
        print(f"{camera['name']}: {differing.sum()} of {differing.size} pixels differ, {near.sum()} are within 1/64 pixel of an edge")
        self.assertGreater(len(numpy.unique(expected)), 4)
        self.assertLess(near.mean(), 0.2)
        far = differing & ~near
        self.assertFalse(far.any(), numpy.argwhere(far)[:8])
        self.compare_color(scene, frame, expected)

    def compare_color(self, scene, frame, expected):
        name = scene["cameras"][0]["name"]
        self.render(scene, "color", frame, [name], layers="color")
        color = read_png(self.path("color", name, "color", f"{frame:06d}.png"))
        self.dgtk("convert", self.path("exact.json"), self.path("lit.pov"), "--frame", frame)
        drawn = self.povray(self.path("lit.pov"))
        padded = numpy.pad(expected, 1, mode="edge")
        height, width = expected.shape
        inside = numpy.all([padded[y:y + height, x:x + width] == expected for y in range(3) for x in range(3)], axis=0)
        differences = (drawn - color)[inside & (expected > 0)]
        print(f"    colour inside surfaces, of 255: means differ by {differences.mean(axis=0).round(2)}, pixels by "
              f"{abs(differences).mean():.2f}")
        self.assertLess(abs(differences.mean(axis=0)).max(), COLOR_TOLERANCE)
        nothing = inside & (expected == 0)
        if nothing.sum() > 9:
            self.assertLess(numpy.median(abs(drawn - color)[nothing]), 1.5)

    @needs_povray
    def test_centred(self):
        f = 240 / 2 / numpy.tan(numpy.radians(22))
        change = {"width": 320, "height": 240, "K": [[f, 0, 160], [0, f, 120], [0, 0, 1]]}
        scene = self.scene("fig_4_7_stereo.json", "left", change)
        del scene["cameras"][0]["fovY"]
        self.check(scene, 0)

    @needs_povray
    def test_off_centre_with_unequal_focal_lengths(self):
        change = {"width": 320, "height": 200, "K": [[350, 12, 125], [0, 280, 130], [0, 0, 1]]}
        self.check(self.scene("cameras_all_kinds.json", "matrix", change), 3)  # a frame within the creature's motion

    @needs_povray
    def test_orthographic(self):
        self.check(self.scene("cameras_all_kinds.json", "orthographic", {"width": 240, "height": 240}), 2)

    def info(self, path):
        return json.loads(self.dgtk("info", path, "--json").stdout)

    def test_read_back(self):
        for name in ("fig_4_7_stereo.json", "demo.json", "fig_5_2_trees_grass.json"):
            with self.subTest(name):
                with open(os.path.join(SCENES, name), encoding="utf-8") as file:
                    things = json.load(file)["objects"]
                # info counts a mesh that is drawn more than once as it is declared: once
                meshes = {(thing["model"], *(json.dumps(thing.get(key)) for key in ("materials", "animation", "skin")))
                          for thing in things}
                self.dgtk("convert", os.path.join(SCENES, name), self.path("s.pov"))
                self.assertEqual(self.info(self.path("s.pov"))["triangles"],
                                 sum(self.info(os.path.join(SCENES, mesh[0]))["triangles"] for mesh in meshes))

    def test_models_keep_triangles_and_bounds(self):
        """Of each format the three largest; what POV-Ray draws of all models is compared elsewhere."""
        models = {}
        for name in sorted(os.listdir(MODELS), key=lambda name: -os.path.getsize(os.path.join(MODELS, name))):
            models.setdefault(os.path.splitext(name)[1], []).append(name)
        for kind in (".ac", ".acc", ".md2", ".3ds", ".obj", ".gltf"):
            self.assertTrue(models[kind])
            for name in models[kind] if WHOLE else models[kind][:3]:
                with self.subTest(name):
                    self.dgtk("convert", os.path.join(MODELS, name), self.path("m.pov"))
                    before, after = self.info(os.path.join(MODELS, name)), self.info(self.path("m.pov"))
                    self.assertEqual(before["triangles"], after["triangles"])
                    self.assertLess(abs(numpy.array(before["bounds"]) - numpy.array(after["bounds"])).max(), 1e-6)

    def test_same_bytes(self):
        for folder, run in (("one", self.alone), ("two", self.dgtk)):
            os.mkdir(self.path(folder))
            run("convert", os.path.join(SCENES, "cameras_all_kinds.json"), self.path(folder, "s.pov"))
        self.assertGreater(len(digests(self.path("one"))), 2)
        self.assert_same_files(self.path("one"), self.path("two"))

    def test_what_is_read_stays(self):
        self.write("ball.pov", "mesh { triangle { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> } }")
        scene = {"objects": [{"model": "ball.pov", "class": "ball"}], "cameras": [{"eye": [0, 0, 5], "lookAt": [0, 0, 0]}]}
        for name in ("json", "pov"):
            self.write(f"classes.{name}", '{"ball": 1}')
            self.write(f"{name}.json", json.dumps({**scene, "classes": f"classes.{name}"}))
        os.symlink("json.json", self.path("link.json"))
        os.symlink(".", self.path("here"))
        before = digests(self.folder)
        for source, to in (("ball.pov", "ball.pov"), ("json.json", "here/ball.pov"), ("pov.json", "classes.pov"), ("json.json", "json.json"),
                           ("json.json", "link.json"), ("json.json", "classes.json")):
            self.refused("convert", self.path(source), self.path(to), status=2,
                         says=f"{to}: is one of the files that are read for it; name another file")
        self.assertEqual(digests(self.folder), before)

    def test_refusals(self):
        scene, out = os.path.join(SCENES, "demo.json"), self.path("x.pov")
        self.refused("convert", scene, out, "--camera", "lefd", status=2, says=["lefd", "did you mean 'left'"])
        self.refused("convert", scene, out, "--frame", "99999", status=2, says="--frame")
        self.refused("convert", scene, self.path("x.json"), "--frame", "1", status=2, says="--frame")
        self.refused("convert", os.path.join(MODELS, "ball.ac"), out, "--camera", "left", status=2, says="--camera")
        self.refused("convert", os.path.join(MODELS, "ball.ac"), self.path("x.json"), status=3, says="is no scene")
        self.refused("convert", self.path("none.json"), out, status=3, says="none.json")
        self.refused("convert", scene, self.path("no", "x.pov"), status=4, says="x.pov")
        self.refused("convert", self.write("c.json", '{"objects": []}'), out, status=3, says="camera")
        for model, called, distortion in (("pinhole", "pinhole with distortion", [-0.2, 0.05, 0, 0]), ("fisheye", "fisheye", [0, 0, 0, 0])):
            camera = {"name": "lens", "model": model, "width": 64, "height": 48, "K": [[60, 0, 32], [0, 60, 24], [0, 0, 1]],
                      "eye": [0, 0, 5], "lookAt": [0, 0, 0], "distortion": distortion}
            lens = self.write("lens.json", json.dumps({"objects": [], "cameras": [camera]}))
            self.refused("convert", lens, out, status=2, says=f"camera 'lens' ({called}) cannot be written for POV-Ray")
        self.assertFalse(os.path.exists(out))


if __name__ == "__main__":
    main()
