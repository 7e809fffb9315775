# SPDX-License-Identifier: BSD-3-Clause
"""windmill.gltf: node animation turns the sails, a morph target fills them with wind. Metres, Y up, sails towards +z."""

import math

from geometry import Mesh, box, ellipsoid, grid, lathe, turned, tube
from gltf import Document


def _tower():
    mesh = lathe([(1.62, 0.0), (1.55, 0.4), (1.4, 1.6), (1.27, 2.8), (1.16, 4.0), (1.1, 4.6)], 24, 0,
                 lambda s, t: (4 * s, 2.0 * t))
    mesh.append(lathe([(1.16, 4.6), (1.3, 4.6), (1.3, 4.72), (1.12, 4.75)], 24, 1, smooth=False))
    mesh.append(lathe([(1.12, 4.75), (1.1, 5.0), (0.98, 5.35), (0.75, 5.68), (0.4, 5.9), (0.0, 6.0)], 24, 2,
                      lambda s, t: (6 * s, 1.6 * t)))
    mesh.append(tube([(0, 5.1, 0.7), (0, 5.1, 1.62)], [0.14, 0.11], 10, 1))
    mesh.append(box((-0.45, 0.0, 1.25), (0.45, 1.7, 1.6), 1, 1.0))
    mesh.append(box((-0.36, 0.0, 1.5), (0.36, 1.6, 1.63), 3, 1.0))
    for angle, y in ((0, 3.2), (90, 2.2), (-90, 3.4), (180, 2.6)):
        r = 1.62 - 0.115 * y
        mesh.append(box((-0.26, y - 0.34, r - 0.3), (0.26, y + 0.34, r + 0.04), 1, 1.0), lambda p, a=angle: turned(p, "y", a))
        mesh.append(box((-0.19, y - 0.27, r - 0.3), (0.19, y + 0.27, r + 0.06), 4, 1.0), lambda p, a=angle: turned(p, "y", a))
    return mesh


def _rotor():
    mesh = ellipsoid((0, 0, 0.05), (0.24, 0.24, 0.2), 14, 8, 0)
    for k in range(4):
        arm = box((-0.05, 0.1, -0.03), (0.05, 3.3, 0.05), 0, 1.0)
        for j in range(8):
            arm.append(box((0.0, 0.75 + 0.34 * j, 0.0), (0.72, 0.79 + 0.34 * j, 0.025), 0, 1.0))
        arm.append(box((0.69, 0.72, 0.0), (0.74, 3.2, 0.03), 0, 1.0))
        mesh.append(arm, lambda p, k=k: turned(p, "z", 90 * k))
    return mesh


def _sails():
    mesh = Mesh()
    for k in range(4):
        cloth = grid(4, 8, lambda s, t: (0.06 + 0.62 * s, 0.78 + 2.35 * t, 0.045), lambda s, t: (s, 3 * t), 0, two_sided=True)
        mesh.append(cloth, lambda p, k=k: turned(p, "z", 90 * k))
    return mesh


def _filled(p):
    """The sail's point when the wind fills it: a bulge forward between its edges."""
    radius_x, radius_y = max(((p[0], p[1]), (p[1], -p[0]), (-p[0], -p[1]), (-p[1], p[0])),
                             key=lambda q: q[1] if 0 <= q[0] <= 0.75 else -1)
    s, t = (radius_x - 0.06) / 0.62, (radius_y - 0.78) / 2.35
    bulge = max(0.0, math.sin(math.pi * s)) * max(0.0, math.sin(math.pi * t)) ** 0.5
    return (p[0], p[1], p[2] + 0.3 * bulge)


def windmill():
    doc = Document("DGTk Data/Generators")
    stone, roof, wood = (doc.texture(f"../Textures/{n}.png") for n in ("stone", "roof", "wood"))
    white = doc.material("stone", (1, 1, 1), stone)
    timber = doc.material("timber", (0.8, 0.72, 0.62), wood)
    tiles = doc.material("tiles", (1, 1, 1), roof)
    door = doc.material("door", (0.22, 0.36, 0.30))
    glass = doc.material("glass", (0.22, 0.28, 0.36))
    linen = doc.material("linen", (0.95, 0.92, 0.84), None, True)
    tower = doc.add("nodes", {"name": "tower", "mesh": doc.mesh("tower", _tower(), [white, timber, tiles, door, glass])})
    sails = doc.add("nodes", {"name": "sails", "mesh": doc.mesh("sails", _sails(), [linen], [_filled])})
    rotor = doc.add("nodes", {"name": "rotor", "mesh": doc.mesh("rotor", _rotor(), [timber]), "translation": [0, 5.1, 1.62],
                              "children": [sails]})
    doc.json["scenes"][0]["nodes"] = [tower, rotor]
    times = doc.floats([(float(k),) for k in range(9)])
    turns = doc.floats([(0.0, 0.0, math.sin(math.pi * k / 8), math.cos(math.pi * k / 8)) for k in range(9)])
    weights = doc.floats([(0.5 - 0.5 * math.cos(2 * math.pi * k / 4),) for k in range(9)])
    doc.add("animations", {"name": "turn", "samplers": [
        {"input": times, "output": turns, "interpolation": "LINEAR"},
        {"input": times, "output": weights, "interpolation": "LINEAR"}],
        "channels": [{"sampler": 0, "target": {"node": rotor, "path": "rotation"}},
                     {"sampler": 1, "target": {"node": sails, "path": "weights"}}]})
    return doc.text()
