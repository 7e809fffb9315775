# SPDX-License-Identifier: BSD-3-Clause
"""Colours of POV-Ray: places in the world as the layer `position` has them, light and material as VTK shades them."""
import json
import os
import shutil

import numpy

import pictures
from harness import SCENES, SOURCE, load_json, main, needs_povray
from many_runs import ManyCase
from pov_scene import ids_of, read_pnm

MODELS = os.path.join(SOURCE, "Data", "Models")
# Of a 16-bit level: half of one is rounding; single precision of vertices and of POV-Ray's colours needs the rest.
POSITION_TOLERANCE = 0.55
# Mean absolute difference inside surfaces, of 255 (the aim of the project).
COLOR_TOLERANCE = 2.0
PICTURES = os.path.join(os.environ.get("DGTK_BUILD", ""), "Testing", "pov_color")

LIGHTS = {
    "point": {"kind": "point", "position": [2, 4, 3]},
    "attenuated point": {"kind": "point", "position": [2, 3, 3], "attenuation": [0.4, 0, 0.04], "diffuse": [1, 0.9, 0.7]},
    "directional": {"kind": "directional", "position": [3, 5, 4], "target": [0, 0, 0], "diffuse": [0.9, 0.95, 1]},
    "spot": {"kind": "spot", "position": [1.5, 5, 3], "target": [0, 0.5, 0], "coneAngle": 30, "exponent": 8},
    "head": {"kind": "head"},
    "fog": {"kind": "directional", "position": [3, 5, 4], "target": [0, 0, 0]},
}
MATT = {"diffuse": [0.8, 0.5, 0.3], "ambient": [0.3, 0.3, 0.3], "specular": [0, 0, 0], "texture": ""}
SHINY = {"diffuse": [0.2, 0.4, 0.7], "ambient": [0.1, 0.1, 0.1], "specular": [0.8, 0.8, 0.8], "shininess": 30, "texture": ""}


def inside(ids):
    """Pixels whose eight neighbours show the same object."""
    padded = numpy.pad(ids, 1, mode="edge")
    height, width = ids.shape
    same = numpy.all([padded[y:y + height, x:x + width] == ids for y in range(3) for x in range(3)], axis=0)
    return same & (ids > 0)


def coarse_ball(segments, rings, top=None):
    """A ball of few, smooth triangles as .obj, or its lower rings up to `top`."""
    rows = rings if top is None else top
    points = [(numpy.sin(t) * numpy.cos(a), -numpy.cos(t), -numpy.sin(t) * numpy.sin(a))
              for t in numpy.pi * numpy.arange(rows + 1) / rings for a in 2 * numpy.pi * numpy.arange(segments) / segments]
    lines = [f"{kind} {x:.9f} {y:.9f} {z:.9f}" for kind in ("v", "vn") for x, y, z in points]
    for row in range(rows):
        for i in range(segments):
            a, b = row * segments + i + 1, row * segments + (i + 1) % segments + 1
            lines += [f"f {a}//{a} {b}//{b} {b + segments}//{b + segments}"] * (row > 0)
            lines += [f"f {a}//{a} {b + segments}//{b + segments} {a + segments}//{a + segments}"] * (row < rings - 1)
    return "\n".join(lines) + "\n"


@needs_povray
class Color(ManyCase):
    def render(self, scene, name, *options):
        self.dgtk("render", scene, "-o", self.path(name), "--quiet", "--color-bits", "16", *options)
        return self.path(name)

    def test_positions(self):
        """Without missing texels: surfaces that have them are drawn whole in the colours of their places."""
        box = (-40.0, -2.0, -60.0, 60.0, 30.0, 45.0)
        low, high = numpy.array(box[:3]), numpy.array(box[3:])
        with open(os.path.join(SCENES, "cameras_all_kinds.json"), encoding="utf-8") as file:
            scene = json.load(file)
        scene["objects"] = [{**thing, "model": os.path.join(SCENES, thing["model"])} for thing in scene["objects"] if thing["name"] != "tree"]
        cameras = ("matrix", "orthographic", "zoom")
        folder = self.render(self.write("p.json", json.dumps(scene)), "p", "--renderer", "povray", "--layers", "color,position,objects",
                             "--pov-position-colors=" + ",".join(map(str, box)), "--cameras", ",".join(cameras), "--frames", "3", "--size", "200x150")
        for camera in cameras:
            with self.subTest(camera):
                color = pictures.read_png(os.path.join(folder, camera, "color", "000003.png"), (16, 3))
                position = numpy.load(os.path.join(folder, camera, "position", "000003.npy"))
                ids = ids_of(read_pnm(os.path.join(folder, camera, "objects", "000003.ppm")))
                self.assertTrue(((position > low) & (position < high))[ids > 0].all())
                levels = (position - low) / (high - low) * 65535
                differences = abs(color - levels)[inside(ids)]
                print(f"{camera}: {len(differences)} pixels, positions differ by at most {differences.max():.4f} of a 16-bit level")
                self.assertGreater(len(differences), 3000)
                self.assertLess(differences.max(), POSITION_TOLERANCE)

    def lit(self, light):
        things = [("floor.ac", [0, 0, 0], MATT), ("ball.ac", [-1.2, 1, 1.5], SHINY), ("ball.ac", [1.2, 1, 1.5], MATT), ("crate.ac", [0, 0, -0.5], MATT)]
        fog = {"fog": {"color": [0.2, 0.3, 0.4], "density": 0.15}} if light == LIGHTS["fog"] else {}
        return {"version": 1, "background": [0.2, 0.3, 0.4], "lights": [{"name": "light", **light}], **fog,
                "objects": [{"name": f"thing {i}", "model": os.path.join(MODELS, model), "position": at, "scale": [7 if model == "ball.ac" else 1] * 3,
                         "materials": {"*": material}}
                            for i, (model, at, material) in enumerate(things)],
                "cameras": [{"name": "c", "width": 160, "height": 120, "fovY": 40, "eye": [3, 3.5, 7], "lookAt": [0, 0.7, 0]}]}

    def test_light_as_vtk_has_it(self):
        os.mkdir(self.path("lit"))
        for kind, light in LIGHTS.items():
            self.write(os.path.join("lit", kind + ".json"), json.dumps(self.lit(light)))
        both = (self.render(self.path("lit"), "vtk", "--layers", "color,objects", "--visibility", "ray"),
                self.render(self.path("lit"), "pov", "--layers", "color", "--renderer", "povray"))
        for kind in LIGHTS:
            with self.subTest(kind):
                vtk, pov = (os.path.join(folder, kind) for folder in both)
                a, b = (pictures.read_png(os.path.join(folder, "c", "color", "000000.png"), (16, 3)) / 257 for folder in (vtk, pov))
                within = inside(ids_of(read_pnm(os.path.join(vtk, "c", "objects", "000000.ppm"))))
                self.keep(vtk, pov)
                difference = abs(a - b)[within]
                print(f"{kind}: {difference.mean():.3f} of 255 in the mean, {(difference > 8).mean() * 100:.2f} % above 8, most {difference.max():.1f}")
                self.assertGreater(a[within].std(), 10)
                self.assertLess(difference.mean(), COLOR_TOLERANCE)

    def test_normals_that_face_away(self):
        """Where the interpolated normal of a coarse model faces away from the viewer: from outside and from inside, mirrored, in
        perspective and parallel projection."""
        self.write("ball.obj", coarse_ball(6, 4))
        self.write("bowl.obj", coarse_ball(7, 5, top=3))
        things = [("ball.obj", [-1.1, 0, 0], [1, 1, 1]), ("ball.obj", [1.2, 0, 0.3], [-1, 1.2, 0.9]), ("bowl.obj", [0, -0.3, 1.4], [0.9, 0.9, 0.9])]
        scene = {"version": 1, "background": [0.2, 0.3, 0.4],
                 "lights": [{"name": "a", "kind": "point", "position": [3, 4, 2]}, {"name": "b", "kind": "directional", "position": [-4, 2, -3], "target": [0, 0, 0]}],
                 "objects": [{"name": f"thing {i}", "model": model, "position": at, "scale": scale, "materials": {"*": {**MATT, "diffuse": [0.5, 0.4, 0.3]}}}
                             for i, (model, at, scale) in enumerate(things)],
                 "cameras": [{"name": "perspective", "width": 320, "height": 240, "fovY": 40, "eye": [1, 2.5, 5], "lookAt": [0, 0, 0.5]},
                             {"name": "parallel", "model": "orthographic", "width": 320, "height": 240, "viewHeight": 4, "eye": [1, 2.5, 5], "lookAt": [0, 0, 0.5]}]}
        vtk, pov = self.draw_away(self.write("away.json", json.dumps(scene)), "away")
        for camera in ("perspective", "parallel"):
            with self.subTest(camera):
                difference, within, away = self.compare_away(vtk, pov, camera)
                self.assertGreater((within & away).sum(), 200)
                self.assertLess(abs(difference)[within & away].mean(), 0.1)
                self.assertLess(abs(difference)[within].max(), 8)

    def test_far_edge_of_a_table(self):
        vtk, pov = self.draw_away(os.path.join(SCENES, "fig_4_6_ray_traced.json"), "table", "--size", "640x480")
        difference, within, away = self.compare_away(vtk, pov, "camera")
        self.assertGreater((within & away).sum(), 100)
        self.assertLess((difference[within & away] < -30).sum(), 10)

    def draw_away(self, scene, name, *options):
        return (self.render(scene, name + "_vtk", "--layers", "color,objects,shadingnormal", "--visibility", "ray", *options),
                self.render(scene, name + "_pov", "--layers", "color", "--renderer", "povray", *options))

    def compare_away(self, vtk, pov, camera):
        """By how much POV-Ray's pixels are brighter, of 255; which lie inside surfaces; and where shading normals face away."""
        a, b = (pictures.read_png(os.path.join(folder, camera, "color", "000000.png"), (16, 3)) / 257 for folder in (vtk, pov))
        normal = numpy.load(os.path.join(vtk, camera, "shadingnormal", "000000.npy"))
        seen = next(c for c in load_json(os.path.join(vtk, "cameras.json"))["cameras"] if c["name"] == camera)
        y, x = numpy.mgrid[:a.shape[0], :a.shape[1]] + 0.5
        ray = numpy.stack([x, y, numpy.ones_like(x)], -1) @ numpy.linalg.inv(numpy.array(seen["K"])).T
        away = ((numpy.array([0, 0, 1]) if seen["model"] == "orthographic" else ray) * normal).sum(-1) > 0
        within = inside(ids_of(read_pnm(os.path.join(vtk, camera, "objects", "000000.ppm"))))
        difference = (b - a).mean(-1)
        print(f"{camera}: {(within & away).sum()} pixels face away, {abs(difference)[within & away].mean():.3f} of 255 in the mean, "
              f"{(difference[within & away] < -30).sum()} much darker; elsewhere {(abs(difference)[within & ~away] > 8).sum()} above 8")
        return difference, within, away

    def keep(self, *folders):
        """Leaves the pictures in the build folder, for looking."""
        os.makedirs(PICTURES, exist_ok=True)
        for folder in folders:
            kind, renderer = os.path.basename(folder).replace(" ", "_"), os.path.basename(os.path.dirname(folder))
            shutil.copy(os.path.join(folder, "c", "color", "000000.png"), os.path.join(PICTURES, f"{kind}_{renderer}.png"))


if __name__ == "__main__":
    main()
