# SPDX-License-Identifier: BSD-3-Clause
"""The chessboard of Data/Scenes, seen through lenses.

usage: chessboards.py DATA SCENE.json
"""
import json
import os
import sys

DATA, TARGET = sys.argv[1:]
SIZE = 448, 336
K = [[288.4, 0, 228.52], [0, 284.2, 163.28], [0, 0, 1]]
LENSES = {
    "five": {"K": K, "distortion": [-0.28, 0.09, 0.0012, -0.0008, -0.01]},
    "eight": {"K": K, "distortion": [0.4, 0.05, 0.0008, -0.0011, 0.004, 0.62, 0.11, 0.008]},
    "fisheye": {"model": "fisheye", "K": [[266, 0, 228.52], [0, 263.2, 163.28], [0, 0, 1]],
                "distortion": [-0.02, 0.006, -0.004, 0.0008]},
}

with open(os.path.join(DATA, "Scenes", "dataset_chessboard.json"), encoding="utf-8") as file:
    scene = json.load(file)
scene["objects"][0]["model"] = os.path.join(DATA, "Models", "chessboard.ac")
pose = {key: scene["cameras"][0][key] for key in ("eye", "lookAt", "near", "far")}
scene["cameras"] = [{"name": name, "width": SIZE[0], "height": SIZE[1], **pose, **lens} for name, lens in LENSES.items()]
with open(TARGET, "w", encoding="utf-8") as file:
    json.dump(scene, file)
