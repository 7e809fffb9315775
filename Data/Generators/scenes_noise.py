# SPDX-License-Identifier: BSD-3-Clause
"""Scenes whose cameras stand at one place and have one effect of their sensor each, low and high."""

from scenes import SUN, base, camera, model, upright

COLOR = {
    "psf": ({"psf": {"gaussian": 0.8}}, {"psf": {"disc": 3.5}}),
    "vignetting": ({"vignetting": {"cos4": 1}}, {"vignetting": {"polynomial": [-0.3, -0.5, 0]}}),
    "shot": ({"fullWell": 2000, "shotNoise": True}, {"fullWell": 60, "shotNoise": True}),
    "fixed": ({"prnu": 0.04, "dsnu": 40}, {"prnu": 0.1, "dsnu": 150, "rowNoise": 200, "columnNoise": 300}),
    "read": ({"readNoise": 100, "bits": 8}, {"readNoise": 500, "bits": 4}),
    "bayer": ({"bayer": "RGGB"}, {"bayer": "GBRG", "shotNoise": True, "fullWell": 150}),
    "salt": ({"salt": 0.01, "pepper": 0.01}, {"salt": 0.1, "pepper": 0.1}),
    "jpeg": ({"jpegQuality": 50, "jpegChroma": "4:4:4"}, {"jpegQuality": 8}),
    "texture": ({"texture": {"amplitude": 0.3, "period": 24}}, {"texture": {"amplitude": 0.9, "period": 48, "octaves": 5}}),
}

DEPTH = {
    "kinect": ({"kinect": {"axial": 1, "lateral": 1}}, {"kinect": {"axial": 5, "lateral": 2}}),
    "stereo": ({"stereo": {"baseline": 0.1, "subpixel": 0.25}}, {"stereo": {"baseline": 0.1, "subpixel": 1, "sigma": 0.4}, "dropout": {"occluded": 1}}),
    "dropout": ({"dropout": {"edge": 0.5, "grazing": 0.3}},
                {"least": 1, "most": 4.8, "dropout": {"edge": 1, "edgeRadius": 2, "grazing": 0.9, "grazingAngle": 65, "random": 0.05}}),
}


def scene(part, effects):
    objects = [model("floor", "floor.ac"), model("table", "table.ac", (0.2, 0, -0.2), turn=-12),
               model("vase", "vase.pov", (0.55, 0.75, -0.3)), model("ball", "ball.ac", (-0.15, 0.87, 0.05)),
               model("crate", "crate.ac", (-1.35, 0, -0.2), turn=25, scale=[0.8] * 3),
               upright("creature", "creature.md2", (-0.75, 0, 1.0), -55, 0.016)]
    cameras = [camera(f"{name}_{strength}", (0, 1.6, 3.6), (-0.15, 0.65, 0), 240, 180, 42, sensor={part: sensor})
               for name, pair in effects.items() for strength, sensor in zip(("low", "high"), pair)]
    return base(objects, cameras, [SUN], seed=7)


FILES = {"noise_color.json": lambda: scene("color", COLOR), "noise_depth.json": lambda: scene("depth", DEPTH)}
