# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that show light, lens and shutter, and the thesis's figures about POV-Ray; an environment."""

import math

from pictures import Canvas, clamp, radiance
from random_numbers import Lcg, fractal_noise
from scene_text import quaternion
from scenes import base, camera, model, upright

LAMP = {"name": "lamp", "kind": "point", "position": [-2.2, 3.2, 2.6], "diffuse": [0.85, 0.82, 0.76], "ambient": [0.15, 0.15, 0.17]}


def heights(width=256, height=128, seed=45):
    """What makes the sphere of figure 4.5 rough: dents of several sizes. It repeats around."""
    noise = fractal_noise(width, height, 16, 8, seed, 4)

    def pixel(x, y):
        v = clamp(0.5 + 1.6 * abs(noise[y][x] - 0.5) - 0.35)
        return (v, v, v)

    return Canvas.from_function(width, height, pixel)


def evening(width=256, height=128):
    """A sky: the sun stands 32 degrees high, to the left behind the camera of the scenes here."""
    sun = (-0.55, 0.53, 0.65)
    size = math.sqrt(sum(c * c for c in sun))
    sun = [c / size for c in sun]

    def pixel(x, y):
        around, down = ((x + 0.5) / width - 0.5) * 2 * math.pi, (y + 0.5) / height * math.pi
        d = (math.sin(down) * math.sin(around), math.cos(down), -math.sin(down) * math.cos(around))
        near = sum(a * b for a, b in zip(d, sun))
        if d[1] < 0:
            return [c * (0.6 + 0.4 * (1 + d[1])) for c in (0.13, 0.11, 0.09)]
        haze = (1 - d[1]) ** 3
        glow = max(0.0, near) ** 12
        light = [a + haze * b + glow * c for a, b, c in zip((0.16, 0.30, 0.62), (0.62, 0.50, 0.36), (0.9, 0.62, 0.32))]
        return [c + s for c, s in zip(light, (24.0, 20.0, 14.0))] if near > 0.9945 else light

    return radiance(width, height, pixel)


def bump_mapping():
    """Figure 4.5: a smooth sphere, and the same with a bump map."""
    plain = {"texture": "", "ambient": [0.16, 0.11, 0.05], "diffuse": [0.86, 0.58, 0.24], "specular": [0.35, 0.35, 0.35], "shininess": 40}
    objects = [model("smooth", "ball.ac", (-0.15, 0, 0), materials={"*": plain}),
               model("bumpy", "ball.ac", (0.15, 0, 0), materials={"*": dict(plain, bump="../Textures/heights.png", bumpScale=0.012)})]
    light = {"name": "sun", "kind": "directional", "position": [-3, 4, 4], "target": [0, 0, 0]}
    return base(objects, [camera("camera", (0, 0, 1.2), (0, 0, 0), 640, 320, 15)], [light], background=[0.1, 0.1, 0.12])


def ray_traced():
    """Figure 4.6: a simple scene for both renderers."""
    objects = [model("floor", "floor.ac"), model("table", "table.ac", (0, 0, 0), turn=20), model("vase", "vase.pov", (0.28, 0.75, -0.1)),
               model("ball", "ball.ac", (-0.2, 0.87, 0.1), orientation=list(quaternion("x", 60))),
               upright("chair", "chair.3ds", (-0.75, 0, 0.35), 115, 1)]
    return base(objects, [camera("camera", (1.6, 1.7, 2.6), (-0.1, 0.6, 0), fov=40)], [LAMP], background=[0.45, 0.5, 0.58])


def four_pictures():
    """Figure 5.1: colour, ray-traced colour, depth and objects of one view."""
    objects = [model("terrain", "terrain.acc", class_name="ground"), model("house", "house.ac", (-1.5, 0, -6), turn=30, class_name="building"),
               model("tree", "tree.ac", (3.6, 0, -3.2), class_name="plant"), model("fir", "fir.ac", (-5.2, 0, -2.5), class_name="plant"),
               model("crate", "crate.ac", (1.2, 0, 0.4), turn=20, scale=[0.8] * 3, class_name="box"),
               model("crate two", "crate.ac", (1.25, 0.8, 0.35), turn=-15, scale=[0.5] * 3, class_name="box"),
               upright("creature", "creature.md2", (-0.6, 0, 1.3), -60, 0.02, class_name="animal")]
    sun = {"name": "sun", "kind": "directional", "position": [-6.0, 7.0, 5.0], "target": [0, 0, 0], "diffuse": [0.95, 0.91, 0.82],
           "ambient": [0.20, 0.22, 0.26]}
    return base(objects, [camera("camera", (1.0, 1.9, 6.2), (0.1, 1.35, 0), fov=46)], [sun])


def materials():
    """Metal and roughness in the light of an environment, with shadows of the sun."""
    objects = [model("floor", "floor.ac", scale=[0.6, 1, 0.6], materials={"*": {"roughness": 0.55}})]
    colours = ((0.80, 0.22, 0.16), (0.98, 0.80, 0.42), (0.95, 0.95, 0.96))
    for row, (colour, metallic) in enumerate(zip(colours, (0, 1, 1))):
        for column in range(5):
            objects.append(model(f"ball {row + 1} {column + 1}", "ball.ac", (-0.68 + 0.34 * column, 0.14, 0.34 - 0.34 * row), scale=[1.15] * 3,
                                 materials={"*": {"texture": "", "diffuse": list(colour), "metallic": metallic, "roughness": column / 4}}))
    sun = {"name": "sun", "kind": "directional", "position": [-0.55, 0.53, 0.65], "target": [0, 0, 0], "diffuse": [0.55, 0.46, 0.34],
           "specular": [0, 0, 0], "shadows": True}
    return base(objects, [camera("camera", (0.25, 0.68, 1.8), (0, 0.1, 0), fov=40)], [sun], environment={"image": "../Textures/evening.hdr"})


def lens_and_shutter():
    """A rolling ball before a row of crates: motion blur by one camera, depth of field by another, both and fog by a third."""
    random = Lcg(47)
    objects = [model("floor", "floor.ac", scale=[2, 1, 4])]
    for k in range(7):
        objects.append(model(f"crate {k + 1}", "crate.ac", (-0.5 + 0.22 * k + random.between(-0.05, 0.05), 0, 0.9 - 0.9 * k), turn=random.between(0, 90),
                             scale=[0.35] * 3))
    objects.append(model("ball", "ball.ac") | {
        "position": {"keys": [[0, [-0.75, 0.12, 1.2]], [4, [0.75, 0.12, 1.2]]]},
        "orientation": {"keys": [[k, list(quaternion("z", -179.0 * k))] for k in range(5)]}})
    lamp = dict(LAMP, shadows=True, position=[-1.5, 4, 3])
    eye, target = (0.1, 0.75, 3.0), (0.15, 0.2, 0)
    shutter = {"open": -0.25, "close": 0.25, "exposures": 32}
    lens = {"aperture": 0.09, "focus": 2.3, "exposures": 48}
    cameras = [camera("shutter", eye, target, fov=36, shutter=shutter), camera("lens", eye, target, fov=36, lens=lens),
               camera("both", eye, target, fov=36, shutter=shutter, lens=lens)]
    return base(objects, cameras, [lamp], background=[0.5, 0.55, 0.62], fog={"color": [0.5, 0.55, 0.62], "density": 0.08, "start": 2})


FILES = {"fig_4_5_bump_mapping.json": bump_mapping, "fig_4_6_ray_traced.json": ray_traced, "fig_5_1_four_pictures.json": four_pictures,
         "materials_environment.json": materials, "lens_and_shutter.json": lens_and_shutter}
