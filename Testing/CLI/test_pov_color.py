# SPDX-License-Identifier: BSD-3-Clause
"""Colours of POV-Ray: places in the world as the layer `position` has them, light and material as VTK shades them."""
import json
import os
import shutil
from concurrent.futures import ThreadPoolExecutor

import numpy

import pictures
from harness import SCENES, SOURCE, Case, main, needs_povray
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


@needs_povray
class Color(Case):
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
        for camera, size in (("matrix", "200x125"), ("orthographic", "150x150"), ("zoom", "200x150")):
            with self.subTest(camera):
                folder = self.render(self.write("p.json", json.dumps(scene)), camera, "--renderer", "povray", "--layers", "color,position,objects",
                                     "--pov-position-colors=" + ",".join(map(str, box)), "--cameras", camera, "--frames", "3", "--size", size)
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
        with ThreadPoolExecutor(len(LIGHTS)) as pool:
            drawn = dict(zip(LIGHTS, pool.map(self.draw_both, LIGHTS)))
        for kind, (vtk, pov) in drawn.items():
            with self.subTest(kind):
                a, b = (pictures.read_png(os.path.join(folder, "c", "color", "000000.png"), (16, 3)) / 257 for folder in (vtk, pov))
                within = inside(ids_of(read_pnm(os.path.join(vtk, "c", "objects", "000000.ppm"))))
                self.keep(vtk, pov)
                difference = abs(a - b)[within]
                print(f"{kind}: {difference.mean():.3f} of 255 in the mean, {(difference > 8).mean() * 100:.2f} % above 8, most {difference.max():.1f}")
                self.assertGreater(a[within].std(), 10)
                self.assertLess(difference.mean(), COLOR_TOLERANCE)

    def draw_both(self, kind):
        name = kind.replace(" ", "_")
        scene = self.write(name + ".json", json.dumps(self.lit(LIGHTS[kind])))
        return (self.render(scene, name + "_vtk", "--layers", "color,objects", "--visibility", "ray"),
                self.render(scene, name + "_pov", "--layers", "color", "--renderer", "povray"))

    def keep(self, *folders):
        """Leaves the pictures in the build folder, for looking."""
        os.makedirs(PICTURES, exist_ok=True)
        for folder in folders:
            shutil.copy(os.path.join(folder, "c", "color", "000000.png"), os.path.join(PICTURES, os.path.basename(folder) + ".png"))


if __name__ == "__main__":
    main()
