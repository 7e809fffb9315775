# SPDX-License-Identifier: BSD-3-Clause
"""Figure B.1 of the thesis: 48 cameras on a half circle around a head, all looking at its middle.

    python3 Data/Generators/half_circle.py > my.scene        prints the scene; paths are relative to Data/Scenes
"""

import math

from scene_text import ThesisScene


def half_circle(model="../Models/head.pov", cameras=48, radius=4.2, height=0.05, middle=(0.0, -0.05, 0.0), fov=40.0):
    scene = ThesisScene()
    scene.model("AC", model, lambda frame: ((0, 0, 0), (1, 0, 0, 0)))
    for k in range(cameras):
        angle = math.pi * k / (cameras - 1)
        eye = (middle[0] + radius * math.cos(angle), middle[1] + height, middle[2] + radius * math.sin(angle))
        scene.camera(fov, 0.1, 100, 4 / 3, eye, middle)
    return scene.text([0, 2])


if __name__ == "__main__":
    print(half_circle(), end="")
