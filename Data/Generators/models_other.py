# SPDX-License-Identifier: BSD-3-Clause
"""Models in 3DS (rocket, chair), POV (vase) and OBJ (column)."""

import math

import pov
import tds
from geometry import Mesh, box, lathe, number, tube, turned
from models_still import column
from pictures import Canvas, mix, scale, smoothstep
from random_numbers import fractal_noise


def rocket_skin(width=256, height=256):
    """Round the hull (u) and up it (v): white with a checkered band, red stripes, rivets and three portholes' rims."""
    dirt = fractal_noise(width, height, 6, 6, 601, 4)

    def pixel(x, y):
        u, v = (x + 0.5) / width, 1 - (y + 0.5) / height
        colour = (0.93, 0.93, 0.91)
        if v > 0.80 or 0.10 < v < 0.13 or 0.72 < v < 0.735:
            colour = (0.80, 0.13, 0.10)
        elif 0.15 < v < 0.25:
            colour = (0.10, 0.10, 0.12) if (int(u * 16) + int((v - 0.15) / 0.05)) % 2 else (0.95, 0.95, 0.93)
        for centre in (1 / 6, 0.5, 5 / 6):
            d = math.hypot((u - centre) * 3.0, v - 0.56)
            colour = mix((0.22, 0.38, 0.55), mix((0.55, 0.57, 0.60), colour, smoothstep(0.093, 0.10, d)), smoothstep(0.065, 0.072, d))
        if abs(v - 0.40) < 0.004 or abs(v - 0.10) < 0.004:
            colour = scale(colour, 0.6)
        if math.hypot((u * 32) % 1 - 0.5, (v - 0.415) * 48) < 0.28:
            colour = scale(colour, 0.65)
        return scale(colour, 0.88 + 0.18 * dirt[y][x])

    return Canvas.from_function(width, height, pixel)


def rocket():
    """1.8 m from the fins' tips to the nose. The fins are single two-sided polygons (A081)."""
    names = ["HULL", "FINS", "STEEL"]
    materials = [tds.material("HULL", (1, 1, 1), 0.6, 0.5, texture="ROCKET.PNG"),
                 tds.material("FINS", (0.80, 0.13, 0.10), 0.4, 0.4, two_sided=True),
                 tds.material("STEEL", (0.45, 0.46, 0.50), 0.9, 0.7)]
    profile = [(0.15, 0.28), (0.20, 0.40), (0.235, 0.58), (0.25, 0.78), (0.245, 0.98), (0.22, 1.18), (0.18, 1.36),
               (0.125, 1.54), (0.06, 1.70), (0.0, 1.80)]
    hull = lathe(profile, 24, 0, lambda s, t: (s, (profile[round(t * 9)][1] - 0.28) / 1.52))
    fins = Mesh()
    for k in range(4):
        outline = [(0.17, 0.30), (0.42, 0.0), (0.47, 0.02), (0.44, 0.42), (0.24, 0.74)]
        fins.polygon([turned((r, y, 0), "y", 90 * k + 45) for r, y in outline], material=1)
    nozzle = lathe([(0.0, 0.2), (0.10, 0.16), (0.13, 0.12), (0.14, 0.12), (0.12, 0.2), (0.11, 0.28), (0.15, 0.28)], 18, 2)
    return tds.document(materials, [tds.mesh("HULL", hull, names), tds.mesh("FINS", fins, names, False),
                                    tds.mesh("NOZZLE", nozzle, names, False)])


def chair():
    """Seat at 0.45 m, facing +z in a scene with Y up (-Y in the file)."""
    names = ["WOOD", "CLOTH"]
    materials = [tds.material("WOOD", (0.85, 0.75, 0.65), 0.2, 0.3, texture="../Textures/wood.png"),
                 tds.material("CLOTH", (1, 1, 1), texture="../Textures/fabric.png")]
    frame = Mesh()
    for x in (-0.2, 0.2):
        frame.append(tube([(x, 0, 0.2), (x, 0.43, 0.19)], [0.017, 0.024], 8, 0, 0.3))
        frame.append(tube([(x, 0, -0.23), (x, 0.43, -0.19), (x, 0.7, -0.2), (x, 0.95, -0.26)], [0.017, 0.024, 0.022, 0.016], 8, 0, 0.3, True))
        frame.append(box((x - 0.012, 0.2, -0.19), (x + 0.012, 0.23, 0.19), 0, 0.5))
    frame.append(box((-0.21, 0.40, -0.21), (0.21, 0.44, 0.21), 0, 0.5))
    for y, z in ((0.62, -0.2), (0.73, -0.205), (0.84, -0.23)):
        frame.append(box((-0.2, y, z - 0.012), (0.2, y + 0.06, z + 0.012), 0, 0.5))
    seat = Mesh()
    cushion = lathe([(0.0, 0.435), (0.21, 0.435), (0.225, 0.45), (0.21, 0.475), (0.0, 0.49)], 24, 1)
    seat.append(cushion)
    for f in seat.faces:
        f.corners = [(i, (seat.vertices[i][0] * 2.2, seat.vertices[i][2] * 2.2)) for i, _ in f.corners]
    return tds.document(materials, [tds.mesh("FRAME", frame, names), tds.mesh("SEAT", seat, names)])


VASE = [(0.0, 0.0), (0.060, 0.0), (0.066, 0.004), (0.062, 0.012), (0.064, 0.02), (0.090, 0.055), (0.112, 0.10), (0.122, 0.145),
        (0.118, 0.19), (0.098, 0.235), (0.072, 0.27), (0.052, 0.30), (0.046, 0.325), (0.050, 0.345), (0.064, 0.365),
        (0.068, 0.370), (0.064, 0.371), (0.046, 0.345), (0.040, 0.325), (0.044, 0.30), (0.06, 0.27), (0.08, 0.22), (0.0, 0.20)]


def vase():
    """0.37 m high; glazed outside and in the neck."""
    top = max(h for _, h in VASE)
    mesh = lathe(VASE, 36, 0, lambda s, t: (s, 0.02 + 0.96 * VASE[round(t * (len(VASE) - 1))][1] / top))
    return pov.document("A vase, 0.37 m high.", "Vase", mesh, pov.image_texture("../Textures/vase.png", 0.6), 4)


def obj_column():
    """(column.obj, column.mtl): a stone column of 2.4 m in four groups."""
    lines, base_v, base_t = ["# A fluted stone column, 2.4 m high.", "mtllib column.mtl"], 1, 1
    for name, mesh in column().items():
        lines += [f"g {name}", "usemtl stone" if name == "shaft" else "usemtl trim"]
        uvs = {}
        for f in mesh.faces:
            for _, uv in f.corners:
                uvs.setdefault(tuple(number(c) for c in uv), len(uvs) + base_t)
        lines += ["v " + " ".join(number(c) for c in v) for v in mesh.vertices]
        lines += ["vt " + " ".join(uv) for uv in uvs]
        smooth = None
        for f in mesh.faces:
            if f.smooth != smooth:
                smooth = f.smooth
                lines.append("s 1" if smooth else "s off")
            lines.append("f " + " ".join(f"{i + base_v}/{uvs[tuple(number(c) for c in uv)]}" for i, uv in f.corners))
        base_v, base_t = base_v + len(mesh.vertices), base_t + len(uvs)
    material = []
    for name, colour in (("stone", "1 1 1"), ("trim", "0.85 0.83 0.8")):
        material += [f"newmtl {name}", "Ka 0.2 0.2 0.2", f"Kd {colour}", "Ks 0.1 0.1 0.1", "Ns 20", "d 1", "illum 2",
                     "map_Kd ../Textures/stone.png", ""]
    return "\n".join(lines) + "\n", "\n".join(material)
