# SPDX-License-Identifier: BSD-3-Clause
"""AC3D models of things to put and to drop: bowl, bottle, bin, torus, brick. Metres, Y up, closed surfaces standing on y = 0."""

import math

import ac3d
from geometry import box, grid, lathe


def _turned(profile, segments):
    return lathe([(round(r, 6), round(y, 6)) for r, y in profile], segments)


def bowl():
    """0.14 m wide, 0.06 m high, walls of 4 mm; a sphere of 0.066 m within, on a foot."""
    outside = [(0.0, 0.0), (0.028, 0.0), (0.03, 0.004)]
    outside += [(0.07 * math.sin(math.radians(a)), 0.07 - 0.07 * math.cos(math.radians(a))) for a in (30, 42, 54, 66, 81.8)]
    inside = [(0.066 * math.sin(math.radians(a)), 0.07 - 0.066 * math.cos(math.radians(a))) for a in (81.3, 66, 54, 42, 30, 20, 10, 0)]
    inside[-1] = (0.0, inside[-1][1])
    return ac3d.document([ac3d.material("glaze", (0.35, 0.5, 0.62), 0.5, 60)], [ac3d.Node("bowl", _turned(outside + inside, 24), crease=40)], 6)


def bottle():
    """0.2 m high, 0.064 m wide, closed by its cap."""
    profile = [(0.0, 0.004), (0.022, 0.004), (0.026, 0.0), (0.032, 0.006), (0.032, 0.11), (0.028, 0.128), (0.016, 0.148), (0.0125, 0.165),
               (0.0125, 0.178), (0.0145, 0.18), (0.0145, 0.2), (0.0, 0.2)]
    return ac3d.document([ac3d.material("green glass", (0.15, 0.4, 0.2), 0.8, 90)], [ac3d.Node("bottle", _turned(profile, 20), crease=40)], 6)


def torus():
    """A ring that lies flat, 0.1 m wide, 0.026 m high."""
    def point(s, t):
        a, b = 2 * math.pi * s, 2 * math.pi * t
        radius = 0.037 + 0.013 * math.cos(b)
        return (round(-radius * math.sin(a), 6), round(0.013 + 0.013 * math.sin(b), 6), round(-radius * math.cos(a), 6))

    return ac3d.document([ac3d.material("rubber", (0.75, 0.3, 0.1), 0.1, 20)], [ac3d.Node("torus", grid(28, 12, point, closed=True), crease=40)], 6)


def brick():
    """A block of 0.1 x 0.05 x 0.06 m."""
    return ac3d.document([ac3d.material("clay", (0.6, 0.3, 0.22))], [ac3d.Node("brick", box((-0.05, 0, -0.03), (0.05, 0.05, 0.03)))], 6)


def bin_():
    """An open box, 0.6 x 0.4 m and 0.3 m high within, with walls and floor of 1 cm: one closed surface."""
    x, y, z, w = 0.3, 0.31, 0.2, 0.01
    mesh = box((-x - w, 0, -z - w), (x + w, y, z + w))
    mesh.faces = [f for f in mesh.faces if not all(mesh.vertices[i][1] == y for i, _ in f.corners)]
    within = box((-x, w, -z), (x, y, z))
    within.faces = [f for f in within.faces if not all(within.vertices[i][1] == y for i, _ in f.corners)]
    for face in within.faces:
        face.corners.reverse()
    mesh.append(within)
    outer, inner = [((-x - w, -z - w), (x + w, -z - w), (x + w, z + w), (-x - w, z + w)), ((-x, -z), (x, -z), (x, z), (-x, z))]
    for k in range(4):
        n = (k + 1) % 4
        mesh.polygon([(p[0], y, p[1]) for p in (outer[k], inner[k], inner[n], outer[n])])
    return ac3d.document([ac3d.material("grey plastic", (0.5, 0.52, 0.55), 0.2, 20)], [ac3d.Node("bin", mesh)], 6)
