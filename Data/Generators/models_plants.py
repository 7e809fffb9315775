# SPDX-License-Identifier: BSD-3-Clause
"""AC3D plants: a tree and a fir with cut-out leaves, grass as cut-out cards and as thin polygons. Metres, Y up."""

import math

import ac3d
from geometry import Mesh, add, card, cross, times, tube, turned, unit
from random_numbers import Lcg

WOOD = ac3d.material("bark", (1, 1, 1))
LEAF = ac3d.material("leaves", (1, 1, 1), ambient=(0.45, 0.45, 0.45))


def tree(seed=307):
    """A broad-leaved tree of 5.4 m: trunk, branches, and crossed leaf cards around their ends."""
    random = Lcg(seed)
    wood, crown = Mesh(), Mesh()
    trunk = [(0, -0.1, 0), (0.02, 0.5, 0.01), (0.07, 1.2, -0.03), (0.03, 2.0, 0.03), (0.0, 2.9, 0.06), (0.05, 3.9, 0.0)]
    wood.append(tube(trunk, [0.24, 0.17, 0.15, 0.13, 0.09, 0.04], 9, 0, 0.9))
    ends = [(trunk[-1], 0.5)]
    for k in range(11):
        angle = 2.4 * k + random.between(-0.3, 0.3)
        start = trunk[3] if k < 4 else trunk[4] if k < 8 else trunk[5]
        start = add(start, (0, random.between(-0.4, 0.1), 0))
        reach, rise = random.between(0.9, 1.45) * (1.0 if k < 8 else 0.65), random.between(0.45, 1.0)
        out = (math.cos(angle), 0, math.sin(angle))
        middle = add(start, add(times(out, 0.55 * reach), (0, 0.35 * rise, 0)))
        end = add(start, add(times(out, reach), (0, rise, 0)))
        wood.append(tube([start, middle, end], [0.06, 0.04, 0.015], 6, 0, 0.6))
        ends += [(end, 0.42), (middle, 0.34)]
    for centre, spread in ends:
        for k in range(5):
            at = add(centre, tuple(random.between(-spread, spread) for _ in range(3)))
            yaw, pitch, size = random.between(0, 360), random.between(-55, 55), random.between(0.46, 0.66)
            across = turned(turned((size, 0, 0), "z", random.between(-180, 180)), "x", pitch)
            upwards = turned(turned((0, size, 0), "z", random.between(-25, 25)), "x", pitch)
            upwards = times(unit(cross(cross(across, upwards), across)), size)
            crown.append(card(at, turned(across, "y", yaw), turned(upwards, "y", yaw)))
    for f in crown.faces:
        f.material = 1
    return ac3d.document([WOOD, LEAF], [ac3d.Node("wood", wood, "../Textures/bark.png", crease=90),
                                        ac3d.Node("crown", crown, "../Textures/leaves.png")], 3)


def fir(seed=311):
    """A fir of 6 m: whorls of drooping cut-out branches."""
    random = Lcg(seed)
    wood, needles = Mesh(), Mesh()
    wood.append(tube([(0, -0.1, 0), (0, 2.0, 0), (0.02, 4.2, 0.01), (0, 5.9, 0)], [0.15, 0.11, 0.06, 0.01], 8, 0, 0.7))
    whorls = 15
    for k in range(whorls):
        t = k / (whorls - 1)
        height, reach = 0.75 + 4.8 * t, 1.75 * (1 - t) ** 0.85 + 0.22
        count = 8 if t < 0.5 else 6
        for j in range(count):
            yaw = 360 * j / count + 41 * k + random.between(-10, 10)
            droop = random.between(8, 20) * (1 - t) - 22 * t
            size = reach * random.between(0.88, 1.1)
            out = turned(turned((1, 0, 0), "z", -droop), "y", yaw)
            aside = turned((0, 0, 1), "y", yaw)
            centre = add((0, height, 0), times(out, size / 2))
            tilt = add(times(aside, math.cos(0.5)), times(cross(out, aside), math.sin(0.5) * (1 if j % 2 else -1)))
            needles.append(card(centre, times(out, size / 2), times(tilt, size * 0.42), 1))
    top = [card((0, 5.85, 0), turned((0, 0.35, 0), "y", 0), turned((0.16, 0, 0), "y", a), 1) for a in (0, 90)]
    for mesh in top:
        needles.append(mesh)
    return ac3d.document([WOOD, LEAF], [ac3d.Node("wood", wood, "../Textures/bark.png", crease=90),
                                        ac3d.Node("needles", needles, "../Textures/pine.png")], 3)


def grass(seed=313):
    """A tuft 0.9 m wide of crossed cut-out cards."""
    random, mesh = Lcg(seed), Mesh()
    for k in range(7):
        yaw = 180 * k / 7 + random.between(-8, 8)
        wide, tall = random.between(0.36, 0.46), random.between(0.16, 0.23)
        x, z = random.between(-0.1, 0.1), random.between(-0.1, 0.1)
        lean = random.between(-0.06, 0.06)
        mesh.append(card((x, tall - 0.02, z), turned((wide, 0, 0), "y", yaw), turned((0, tall, lean), "y", yaw)))
    return ac3d.document([LEAF], [ac3d.Node("grass", mesh, "../Textures/blades.png")], 3)


def reeds(seed=317):
    """Ninety single blades, each a bent strip of thin polygons that ends in a point."""
    random, mesh = Lcg(seed), Mesh()
    greens = [ac3d.material(f"green{k}", (0.24 + 0.09 * k, 0.42 + 0.08 * k, 0.10 + 0.04 * k)) for k in range(4)]
    for _ in range(90):
        angle, radius = random.between(0, 2 * math.pi), 0.42 * math.sqrt(random.unit())
        root = (radius * math.cos(angle), 0, radius * math.sin(angle))
        lean = random.between(0, 2 * math.pi)
        out = (math.cos(lean), 0, math.sin(lean))
        side = times(cross(out, (0, 1, 0)), random.between(0.006, 0.011))
        tall, bend, shade = random.between(0.35, 0.8), random.between(0.05, 0.35), random.index(4)
        spine = [add(root, add((0, tall * t, 0), times(out, bend * t * t))) for t in (0, 0.35, 0.7, 1)]
        for k in range(3):
            a, b = 1 - k / 3, 1 - (k + 1) / 3
            points = [add(spine[k], times(side, a)), add(spine[k], times(side, -a))]
            points += [add(spine[k + 1], times(side, -b)), add(spine[k + 1], times(side, b))] if k < 2 else [spine[3]]
            mesh.polygon(points, material=shade, two_sided=True)
    return ac3d.document(greens, [ac3d.Node("reeds", mesh)], 3)
