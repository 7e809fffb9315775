# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of the datasets of standard kinds, Data/Datasets."""

import math

from scene_text import product, quaternion
from scenes import base, camera, model, upright

DARK = {"background": [0.25, 0.27, 0.3]}
LAMP = [{"name": "lamp", "kind": "directional", "position": [1, 2, 4], "target": [0, 0, 0], "diffuse": [0.8, 0.8, 0.8],
         "ambient": [0.1, 0.1, 0.1]}]


def stereo():
    """A rectified pair in front of speckled surfaces at several depths."""
    objects = [
        model("wall", "speckled_wall.ac", (0, 0, -1.2), class_name="wall", scale=[1.6] * 3),
        model("floor", "speckled_wall.ac", (0, -0.75, 0), class_name="wall", orientation=list(quaternion("x", -72))),
        model("box", "speckled_box.ac", (-0.55, -0.25, 0.2), turn=28, class_name="thing", scale=[0.7] * 3),
        model("ball", "speckled_ball.ac", (0.6, -0.1, 0.35), class_name="thing", scale=[0.8] * 3),
    ]
    cameras = [camera(name, (x, 0.1, 3.2), (x, 0, 0), 320, 240, 42) for name, x in (("left", -0.06), ("right", 0.06))]
    return base(objects, cameras, LAMP, **DARK)


def flow():
    """Three frames: a turning box, a ball that comes nearer, a deforming flag and a creature, a camera that moves."""
    objects = [
        model("wall", "speckled_wall.ac", (0, 0, -1.2), scale=[1.6] * 3),
        model("box", "speckled_box.ac", (-0.6, -0.2, 0.2), scale=[0.7] * 3) | {
            "orientation": {"keys": [[0, list(quaternion("y", 28))], [2, list(quaternion("y", 33))]]}},
        model("ball", "speckled_ball.ac") | {
            "position": {"keys": [[0, [0.55, 0.1, 0.2]], [2, [0.52, 0.13, 0.27]]]},
            "scale": {"keys": [[0, [0.7, 0.7, 0.7]], [2, [0.72, 0.7, 0.7]]]}},
        upright("creature", "creature.md2", (0.1, -0.75, 0.7), -30, 0.012) | {"animation": {"sequence": "walk", "rate": 1}},
        upright("flag", "flag.md2", (-0.1, 0.15, 0.1), 20, 0.008),
        model("windmill", "windmill.gltf", (0.95, -0.8, -0.5), scale=[0.12] * 3, animation={"rate": 0.6}),
    ]
    eye = {"keys": [[0, [0, 0.1, 3.2]], [2, [0.02, 0.11, 3.17]]]}
    return base(objects, [camera("camera", (0, 0, 0), (0, 0, 0), 320, 240, 42) | {"eye": eye}], LAMP, **DARK)


def chessboard():
    """Forty poses of a chessboard before a camera whose fx, fy, cx and cy all differ from the plain case."""
    keys, places = [], []
    for k in range(40):
        a = 2 * math.pi * k / 40
        tilt = quaternion((math.cos(7 * a), math.sin(7 * a), 0), 24 + 8 * (k % 3))
        keys.append([k, list(product(tilt, quaternion("z", 9 * (k % 5) - 18)))])
        places.append([k, [0.03 * math.cos(a), 0.02 * math.sin(a), 0.03 * math.cos(3 * a) - 0.02]])
    board = model("board", "chessboard.ac") | {"position": {"keys": places}, "orientation": {"keys": keys}}
    view = camera("camera", (0, 0, 0.37), (0, 0, 0), 1280, 960)
    del view["fovY"]
    view["K"] = [[824, 0, 653], [0, 812, 466.5], [0, 0, 1]]
    return base([board], [view], LAMP, **DARK)


FILES = {f"dataset_{make.__name__}.json": make for make in (stereo, flow, chessboard)}
