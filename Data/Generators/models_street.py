# SPDX-License-Identifier: BSD-3-Clause
"""AC3D models of a street for recipes: road, cars, signs. Metres, Y up; cars look along -z."""

import ac3d
from geometry import Mesh, box, lathe, rotation
from models_parts import regular, slab

GLASS, RUBBER, LAMPS = 1, 2, 3


def paints(colour):
    return [ac3d.material("paint", colour, 0.5, 60), ac3d.material("glass", (0.1, 0.12, 0.15), 0.8, 80),
            ac3d.material("rubber", (0.06, 0.06, 0.06)), ac3d.material("lamps", (0.95, 0.93, 0.8), 0.4, 40)]


def shell(profile, width, windows):
    """A body from its outline (z, y) seen from the right, `width` across; sides `windows` of the outline are glass."""
    half, mesh = width / 2, Mesh()
    mesh.polygon([(half, y, z) for z, y in profile])
    mesh.polygon([(-half, y, z) for z, y in reversed(profile)])
    for k, ((z0, y0), (z1, y1)) in enumerate(zip(profile, profile[1:] + profile[:1])):
        mesh.polygon([(-half, y0, z0), (-half, y1, z1), (half, y1, z1), (half, y0, z0)], material=GLASS if k in windows else 0)
    return mesh


def pane(points, x):
    """A window on both sides of a body: points (z, y)."""
    mesh = Mesh()
    mesh.polygon([(x, y, z) for z, y in points], material=GLASS)
    mesh.polygon([(-x, y, z) for z, y in reversed(points)], material=GLASS)
    return mesh


def wheels(axles, width, radius):
    nodes = []
    tyre = lathe([(0.0, 0.0), (0.75 * radius, 0.0), (radius, 0.04), (radius, 0.16), (0.75 * radius, 0.2), (0.0, 0.2)], 24, RUBBER)
    for k, (x, z) in enumerate((s * width / 2, z) for z in axles for s in (-1, 1)):
        turn = rotation("z", -90)
        nodes.append(ac3d.Node(f"wheel{k}", tyre, place=(x - 0.1, radius, z), turn=turn, crease=40))
    return nodes


def vehicle(profile, width, windows, panes, axles, radius, colour, lamps):
    mesh = shell(profile, width, windows)
    for points in panes:
        mesh.append(pane(points, width / 2 + 0.004))
    for x in (-0.36 * width, 0.36 * width):
        low, high = lamps
        mesh.append(box((x - 0.12, low, profile[0][0] - 0.02), (x + 0.12, high, profile[0][0] + 0.03), LAMPS))
    return ac3d.document(paints(colour), [ac3d.Node("body", mesh, crease=25), *wheels(axles, width, radius)])


def car():
    """4.3 x 1.75 x 1.45 m."""
    profile = [(-2.15, 0.35), (2.1, 0.35), (2.15, 0.75), (2.05, 0.95), (1.35, 1.42), (-0.25, 1.45), (-1.0, 0.95), (-2.05, 0.8)]
    panes = [[(0.1, 0.98), (1.7, 0.98), (1.25, 1.36), (0.1, 1.38)], [(-0.85, 0.98), (0.02, 0.98), (0.02, 1.38), (-0.25, 1.38)]]
    return vehicle(profile, 1.75, (3, 5), panes, (-1.3, 1.3), 0.32, (0.7, 0.08, 0.06), (0.55, 0.7))


def van():
    """5.2 x 1.95 x 2.2 m."""
    profile = [(-2.6, 0.4), (2.6, 0.4), (2.6, 2.15), (2.5, 2.2), (-1.3, 2.2), (-2.1, 1.2), (-2.55, 1.05)]
    panes = [[(-1.75, 1.2), (-0.95, 1.2), (-0.95, 1.95), (-1.15, 1.95)]]
    return vehicle(profile, 1.95, (4,), panes, (-1.7, 1.7), 0.36, (0.85, 0.85, 0.82), (0.65, 0.85))


def road():
    """120 m of road of 7 m along z with a broken line, kerbs and pavements of 2.5 m."""
    materials = [ac3d.material("asphalt", (0.5, 0.5, 0.52)), ac3d.material("paving", (0.8, 0.78, 0.74)), ac3d.material("line", (0.92, 0.92, 0.9)),
                 ac3d.material("kerb", (0.6, 0.6, 0.58))]
    lane, paving, lines, kerbs = Mesh(), Mesh(), Mesh(), Mesh()
    lane.polygon([(-3.5, 0, 60), (3.5, 0, 60), (3.5, 0, -60), (-3.5, 0, -60)], [(0, 0), (3, 0), (3, 48), (0, 48)], material=0)
    for side in (-1, 1):
        x0, x1 = sorted((side * 3.62, side * 6.0))
        paving.polygon([(x0, 0.12, 60), (x1, 0.12, 60), (x1, 0.12, -60), (x0, 0.12, -60)], [(0, 0), (1, 0), (1, 48), (0, 48)], material=1)
        x0, x1 = sorted((side * 3.5, side * 3.62))
        kerbs.append(box((x0, -0.05, -60), (x1, 0.12, 60), 3, 2.0))
    for k in range(20):
        z = -58 + 6 * k
        lines.polygon([(-0.07, 0.004, z + 3), (0.07, 0.004, z + 3), (0.07, 0.004, z), (-0.07, 0.004, z)], material=2)
    return ac3d.document(materials, [ac3d.Node("lane", lane, "../Textures/stone.png"), ac3d.Node("paving", paving, "../Textures/bricks.png"),
                                     ac3d.Node("kerbs", kerbs), ac3d.Node("lines", lines)])


def sign():
    """A round sign of 0.6 m at 2.2 m on a post."""
    materials = [ac3d.material("post", (0.6, 0.61, 0.62), 0.3, 30), ac3d.material("plate", (0.1, 0.2, 0.75), 0.2, 20),
                 ac3d.material("rim", (0.95, 0.95, 0.95), 0.2, 20)]
    mesh = lathe([(0.0, 0.0), (0.03, 0.0), (0.03, 2.45), (0.0, 2.45)], 12, 0)
    mesh.append(slab(regular(28, 0.3), 0.0, 0.02, 2), lambda p: (p[0], 2.2 - p[2], 0.03 + p[1]))
    mesh.append(slab(regular(28, 0.26), 0.02, 0.024, 1), lambda p: (p[0], 2.2 - p[2], 0.03 + p[1]))
    return ac3d.document(materials, [ac3d.Node("sign", mesh, crease=40)])
