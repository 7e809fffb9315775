# SPDX-License-Identifier: BSD-3-Clause
"""AC3D models of small things for recipes: machine parts for a bin, crockery for a table. Metres, Y up, closed surfaces."""

import math

import ac3d
from geometry import Face, Mesh, add, box, lathe, tube


def steel(colour=(0.55, 0.56, 0.58)):
    return [ac3d.material("steel", colour, 0.6, 60)]


def regular(corners, radius, turn=0.0):
    """Points of a regular polygon about the y axis, counter-clockwise seen from above."""
    return [(radius * math.cos(turn + 2 * math.pi * k / corners), -radius * math.sin(turn + 2 * math.pi * k / corners))
            for k in range(corners)]


def on_sides(outline, each):
    """The outline with its sides cut in `each` pieces."""
    points = []
    for (x0, z0), (x1, z1) in zip(outline, outline[1:] + outline[:1]):
        points += [(x0 + (x1 - x0) * k / each, z0 + (z1 - z0) * k / each) for k in range(each)]
    return points


def slab(outline, low, high, material=0):
    """An upright prism of an outline (x, z), counter-clockwise seen from above; it may be concave."""
    mesh = Mesh()
    mesh.polygon([(x, high, z) for x, z in outline], material=material)
    mesh.polygon([(x, low, z) for x, z in reversed(outline)], material=material)
    for (x0, z0), (x1, z1) in zip(outline, outline[1:] + outline[:1]):
        mesh.polygon([(x0, low, z0), (x1, low, z1), (x1, high, z1), (x0, high, z0)], material=material)
    return mesh


def ring(outer, inner, low, high, material=0):
    """A prism with a hole: as many points outside as inside, side by side."""
    mesh, count = Mesh(), len(outer)
    for k in range(count):
        (a, b), (c, d) = outer[k], outer[(k + 1) % count]
        (e, f), (g, h) = inner[k], inner[(k + 1) % count]
        mesh.polygon([(a, high, b), (c, high, d), (g, high, h), (e, high, f)], material=material)
        mesh.polygon([(e, low, f), (g, low, h), (c, low, d), (a, low, b)], material=material)
        mesh.polygon([(a, low, b), (c, low, d), (c, high, d), (a, high, b)], material=material)
        mesh.polygon([(g, low, h), (e, low, f), (e, high, f), (g, high, h)], material=material)
    return mesh


def bolt():
    """A hexagonal head of 36 mm on a shaft of 20 mm, 90 mm long in all."""
    mesh = slab(regular(6, 0.018), 0.078, 0.09)
    mesh.append(lathe([(0.0, 0.0), (0.008, 0.0), (0.01, 0.002), (0.01, 0.078), (0.0, 0.078)], 20))
    return ac3d.document(steel(), [ac3d.Node("bolt", mesh, crease=40)], 6)


def nut():
    """A hexagon of 40 mm across its corners with a hole of 20 mm, 16 mm high."""
    mesh = ring(on_sides(regular(6, 0.02), 4), regular(24, 0.01), 0.0, 0.016)
    return ac3d.document(steel((0.68, 0.6, 0.36)), [ac3d.Node("nut", mesh, crease=20)], 6)


def bracket():
    """An angle of 60 x 60 x 40 mm, 6 mm thick, with a rib."""
    profile = [(0, 0), (0.06, 0), (0.06, 0.006), (0.006, 0.006), (0.006, 0.06), (0, 0.06)]
    mesh = slab([(x, -z) for x, z in profile], 0.0, 0.04)
    rib = slab([(x, -z) for x, z in ((0.006, 0.006), (0.036, 0.006), (0.006, 0.036))], 0.017, 0.023)
    return ac3d.document(steel((0.42, 0.46, 0.52)), [ac3d.Node("bracket", mesh.append(rib), crease=20)], 6)


def gear():
    """Sixteen teeth, 56 mm across, 14 mm thick, with a bore of 20 mm."""
    outer = []
    for k in range(16):
        for part, radius in ((0.0, 0.0235), (0.28, 0.0235), (0.4, 0.028), (0.7, 0.028), (0.82, 0.0235), (0.91, 0.0235)):
            angle = 2 * math.pi * (k + part) / 16
            outer.append((radius * math.cos(angle), -radius * math.sin(angle)))
    inner = [(0.01 * x / math.hypot(x, z), 0.01 * z / math.hypot(x, z)) for x, z in outer]
    return ac3d.document(steel((0.5, 0.44, 0.4)), [ac3d.Node("gear", ring(outer, inner, 0.0, 0.014), crease=20)], 6)


def cup():
    """A cup of 85 mm with a handle; open above, its wall 4 mm thick."""
    body = lathe([(0.0, 0.0), (0.028, 0.0), (0.036, 0.012), (0.04, 0.04), (0.0425, 0.085), (0.0385, 0.085), (0.036, 0.04),
                  (0.032, 0.014), (0.0, 0.006)], 32)
    middle, bow = (0.039, 0.045, 0.0), []
    for k in range(13):
        angle = math.radians(-100 + 200 * k / 12)
        bow.append(add(middle, (0.026 * math.cos(angle), 0.026 * math.sin(angle), 0.0)))
    handle = tube(bow, [0.005] * 13, 10)
    for ring_of, turned in ((range(10), True), (range(len(handle.vertices) - 10, len(handle.vertices)), False)):
        corners = [(i, (0, 0)) for i in ring_of]
        handle.faces.append(Face(corners[::-1] if turned else corners))
    return ac3d.document([ac3d.material("glaze", (0.9, 0.9, 0.86), 0.5, 50)],
                         [ac3d.Node("body", body, crease=50), ac3d.Node("handle", handle, crease=50)], 6)


def plate():
    """A plate of 240 mm."""
    body = lathe([(0.0, 0.0), (0.07, 0.0), (0.075, 0.004), (0.12, 0.02), (0.119, 0.0235), (0.08, 0.011), (0.07, 0.006), (0.0, 0.006)], 40)
    return ac3d.document([ac3d.material("glaze", (0.93, 0.93, 0.9), 0.5, 50)], [ac3d.Node("plate", body, crease=50)], 6)


def book():
    """A book of 150 x 210 x 30 mm that lies on its back; its cover is a material of its own."""
    mesh = box((-0.072, 0.003, -0.102), (0.074, 0.027, 0.102), 1, 0.1)
    for low, high in ((0.0, 0.003), (0.027, 0.03)):
        mesh.append(box((-0.075, low, -0.105), (0.075, high, 0.105), 0, 0.1))
    mesh.append(box((-0.075, 0.003, -0.105), (-0.072, 0.027, 0.105), 0, 0.1))
    return ac3d.document([ac3d.material("cover", (0.7, 0.15, 0.12), 0.1, 20), ac3d.material("pages", (0.92, 0.9, 0.82))],
                         [ac3d.Node("book", mesh, crease=20)], 6)
