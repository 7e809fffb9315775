# SPDX-License-Identifier: BSD-3-Clause
"""The two AC3D models of the example scene of the thesis's appendix B.3: tuxedo.ac, a penguin, and world.ac around it.

The penguin stands 3 units tall around the origin and looks at the example's camera; the ground lies at y = -1.5."""

import math

import ac3d
from geometry import Mesh, ellipsoid, grid, lathe, turned
from pictures import Canvas, mix, smoothstep
from random_numbers import fractal_noise

GROUND = -1.5
FACING = 160.0  # degrees about y from +z: towards the camera at (2.45, 0, -7.25)


def tuxedo_skin(width=256, height=256):
    """Round the body (u, 0.5 in front) and up it (v): black coat, white front, grey sheen."""
    cloth = fractal_noise(width, height, 16, 16, 401, 3)

    def pixel(x, y):
        u, v = (x + 0.5) / width - 0.5, 1 - (y + 0.5) / height
        coat = mix((0.035, 0.04, 0.055), (0.10, 0.11, 0.14), cloth[y][x])
        shirt = mix((0.90, 0.89, 0.86), (0.99, 0.98, 0.96), cloth[y][x])
        inside = math.hypot(u / 0.19, (v - 0.34) / 0.36)
        return mix(shirt, coat, smoothstep(0.95, 1.05, inside))

    return Canvas.from_function(width, height, pixel)


def face_skin(width=256, height=128):
    """The head: black, with two white patches that meet above the beak."""
    def pixel(x, y):
        u, v = (x + 0.5) / width - 0.5, 1 - (y + 0.5) / height
        patch = min(math.hypot((abs(u) - 0.075) / 0.085, (v - 0.56) / 0.20), math.hypot(u / 0.13, (v - 0.36) / 0.14))
        return mix((0.97, 0.96, 0.94), (0.05, 0.055, 0.07), smoothstep(0.93, 1.06, patch))

    return Canvas.from_function(width, height, pixel)


def tuxedo():
    materials = [ac3d.material("feathers", (1, 1, 1), 0.25, 30), ac3d.material("beak", (0.98, 0.66, 0.10), 0.3, 30),
                 ac3d.material("eye white", (1, 1, 1), 0.5, 60), ac3d.material("pupil", (0.03, 0.03, 0.03), 0.9, 100),
                 ac3d.material("coat", (0.07, 0.075, 0.095), 0.25, 30), ac3d.material("bow tie", (0.75, 0.07, 0.10), 0.3, 30)]
    body = lathe([(0.0, -1.36), (0.45, -1.33), (0.72, -1.2), (0.88, -0.95), (0.94, -0.65), (0.9, -0.3), (0.79, 0.05),
                  (0.66, 0.35), (0.55, 0.58), (0.48, 0.72), (0.0, 0.8)], 28)
    body = body.moved(lambda p: (p[0], p[1], p[2] * 0.9 + (0.10 if p[1] < 0 else 0.0) * -min(1.0, -p[1])))
    head = ellipsoid((0, 0.93, 0.02), (0.54, 0.57, 0.52), 28, 18)
    parts = Mesh()
    for side in (-1, 1):
        parts.append(ellipsoid((0.17 * side, 1.06, 0.45), (0.135, 0.175, 0.09), 14, 8, 2))
        parts.append(ellipsoid((0.145 * side, 1.05, 0.525), (0.06, 0.085, 0.03), 12, 6, 3))
        foot = ellipsoid((0, 0, 0), (0.3, 0.1, 0.46), 18, 8, 1)
        toes = foot.moved(lambda p: (p[0] * (1 + 0.45 * p[2]) * (1 + 0.12 * math.cos(14 * p[0]) * max(0.0, p[2])), p[1], p[2]))
        parts.append(toes, lambda p, side=side: turned((p[0] + 0.42 * side, p[1] - 1.4, p[2] + 0.28), "y", 12 * side))
        wing = ellipsoid((0, -0.55, 0), (0.11, 0.66, 0.27), 14, 10, 4)

        def place(p, side=side):
            x, y, z = turned(p, "z", 24 * side)
            x, y, z = turned((x, y, z), "x", -12)
            return (x + 0.62 * side, y + 0.42, z)

        parts.append(wing, place)
        parts.append(ellipsoid((0.15 * side, 0.47, 0.56), (0.16, 0.11, 0.06), 14, 10, 5))
    parts.append(ellipsoid((0, 0.47, 0.585), (0.06, 0.07, 0.06), 10, 8, 5))
    parts.append(ellipsoid((0, 0.84, 0.55), (0.24, 0.085, 0.26), 20, 10, 1))
    parts.append(ellipsoid((0, 0.765, 0.51), (0.19, 0.06, 0.20), 20, 10, 1))
    tail = ellipsoid((0, -1.22, -0.78), (0.22, 0.09, 0.3), 14, 8, 4)
    parts.append(tail)
    def facing(p):
        return turned(p, "y", FACING)
    nodes = [ac3d.Node("body", body.moved(facing), "../Textures/tuxedo.png", crease=90),
             ac3d.Node("head", head.moved(facing), "../Textures/face.png", crease=90),
             ac3d.Node("parts", parts.moved(facing), crease=80)]
    return ac3d.document(materials, [ac3d.Node("tuxedo", kids=nodes)], 3)


def world():
    """A disc of ground, 90 units in radius, rising into hills, under a dome of sky of 100 units."""
    materials = [ac3d.material("ground", (1, 1, 1), ambient=(0.7, 0.7, 0.7)),
                 ac3d.material("sky", (0, 0, 0), ambient=(0, 0, 0), emission=(1, 1, 1))]
    hills = fractal_noise(72, 24, 6, 2, 419, 3)

    def land(s, t):
        radius, angle = 90 * t**1.7, 2 * math.pi * s
        i, j = round(s * 72) % 72, min(23, round(t * 23))
        rise = max(0.0, (radius - 14) / 76)
        return (radius * math.sin(angle), GROUND + 22 * rise**1.5 * hills[j][i] if t else GROUND, radius * math.cos(angle))

    ground = grid(72, 26, land, None, 0, closed=True)
    for f in ground.faces:
        f.corners = [(i, (ground.vertices[i][0] / 4, ground.vertices[i][2] / 4)) for i, _ in f.corners]

    def dome(s, t):
        angle, up = 2 * math.pi * s, -0.06 + 1.63 * t
        radius = 0.0 if t == 1 else 100 * math.cos(up)
        return (radius * math.cos(angle), GROUND + 100 * math.sin(min(up, math.pi / 2)), radius * math.sin(angle))

    sky = grid(36, 10, dome, lambda s, t: (2 * s, max(0.01, min(0.995, t))), 1, closed=True)
    return ac3d.document(materials, [ac3d.Node("ground", ground, "../Textures/grass.png", crease=180),
                                     ac3d.Node("sky", sky, "../Textures/sky.png", crease=180)], 2)
