# SPDX-License-Identifier: BSD-3-Clause
"""AC3D models of things that stand still: table, crate, terrain, ball, house. Metres, Y up."""

import math

import ac3d
from geometry import Face, Mesh, box, ellipsoid, grid, lathe, rotation
from random_numbers import fractal_noise

WHITE = ac3d.material("white", (1, 1, 1))


def table():
    """1.6 x 0.9 m, top at 0.75 m. The legs are placed and turned by their own loc and rot."""
    materials = [ac3d.material("polished wood", (1, 1, 1), 0.35, 40), ac3d.material("dark wood", (0.62, 0.55, 0.5), 0.2, 30)]
    leg = lathe([(0.0, 0), (0.022, 0), (0.028, 0.02), (0.022, 0.05), (0.026, 0.25), (0.042, 0.5), (0.046, 0.55),
                 (0.03, 0.575), (0.046, 0.6), (0.046, 0.66), (0.0, 0.66)], 12, 1, lambda s, t: (t * 2, s * 0.4))
    legs = [ac3d.Node(f"leg{k}", leg, "../Textures/wood.png", crease=50, place=(x, 0, z), turn=rotation("y", 90 * k))
            for k, (x, z) in enumerate(((-0.7, -0.35), (0.7, -0.35), (0.7, 0.35), (-0.7, 0.35)))]
    top = Mesh()
    rim = [(-0.01, 0.0), (0.0, 0.012), (0.0, 0.03), (-0.012, 0.04)]
    rings = []
    for inset, height in rim:
        x, z = 0.8 + inset, 0.45 + inset
        rings.append([top.vertex((a * x, 0.71 + height, b * z)) for a, b in ((-1, 1), (1, 1), (1, -1), (-1, -1))])

    def uv(index):
        v = top.vertices[index]
        return (v[0] * 0.9 + 0.5, v[2] * 1.1 + v[1])

    for low, high in zip(rings, rings[1:]):
        for k in range(4):
            corners = (low[k], low[(k + 1) % 4], high[(k + 1) % 4], high[k])
            top.faces.append(Face([(i, uv(i)) for i in corners], 0, True))
    top.faces.append(Face([(i, uv(i)) for i in rings[-1]], 0, True))
    top.faces.append(Face([(i, uv(i)) for i in reversed(rings[0])], 0, True))
    apron = Mesh()
    for low, high in (((-0.68, 0.62, 0.335), (0.68, 0.71, 0.36)), ((-0.68, 0.62, -0.36), (0.68, 0.71, -0.335)),
                      ((-0.715, 0.62, -0.33), (-0.69, 0.71, 0.33)), ((0.69, 0.62, -0.33), (0.715, 0.71, 0.33))):
        apron.append(box(low, high, 1, 0.8))
    return ac3d.document(materials, [ac3d.Node("table", kids=[
        ac3d.Node("top", top, "../Textures/wood.png", crease=40), ac3d.Node("apron", apron, "../Textures/wood.png"),
        *legs])])


def crate():
    """A cube of 1 m standing on the ground: panels between twelve beams."""
    materials = [ac3d.material("planks", (1, 1, 1)), ac3d.material("beams", (0.78, 0.72, 0.64), 0.05, 10)]
    panels = box((-0.46, 0.04, -0.46), (0.46, 0.96, 0.46), 0, 0.92)
    beams, w = Mesh(), 0.1
    for a in (-0.5, 0.5 - w):
        for b in (-0.5, 0.5 - w):
            beams.append(box((a, 0, b), (a + w, 1, b + w), 1, 0.7))
            beams.append(box((-0.5 + w, a + 0.5, b), (0.5 - w, a + 0.5 + w, b + w), 1, 0.7))
            beams.append(box((a, b + 0.5, -0.5 + w), (a + w, b + 0.5 + w, 0.5 - w), 1, 0.7))
    return ac3d.document(materials, [ac3d.Node("panels", panels, "../Textures/planks.png"),
                                     ac3d.Node("beams", beams, "../Textures/wood.png")])


def terrain_heights(count=64, size=40.0, seed=211):
    """Heights of a count x count grid: gentle hills, flat (height 0) within 7 m of the middle."""
    hills = fractal_noise(count, count, 3, 3, seed, 4)
    rows = []
    for j in range(count):
        row = []
        for i in range(count):
            x, z = (i / (count - 1) - 0.5) * size, (j / (count - 1) - 0.5) * size
            away = max(0.0, min(1.0, (math.hypot(x, z) - 7) / 9))
            bumps = 0.08 * math.sin(1.3 * x) * math.sin(1.1 * z)
            row.append((7.0 * (hills[j][i] - 0.38) + bumps) * away * away * (3 - 2 * away))
        rows.append(row)
    return rows


def height_at(x, z, heights=[], size=40.0):
    """Height of the terrain's triangles at (x, z)."""
    if not heights:
        heights += terrain_heights()
    count = len(heights)
    s, t = ((c / size + 0.5) * (count - 1) for c in (x, z))
    i, j = (min(count - 2, max(0, int(c))) for c in (s, t))
    s, t = s - i, t - j
    a, b, c, d = heights[j][i], heights[j][i + 1], heights[j + 1][i], heights[j + 1][i + 1]
    # the strip's diagonal runs from (i, j) ... (i + 1, j + 1): see terrain()
    return a + (b - a) * s + (d - b) * t if s > t else a + (d - c) * s + (c - a) * t


def terrain():
    """40 x 40 m of 64 x 64 points as one triangle strip a row."""
    heights = terrain_heights()
    count, mesh = len(heights), Mesh()
    for j, row in enumerate(heights):
        for i, y in enumerate(row):
            mesh.vertex(((i / (count - 1) - 0.5) * 40, y, (j / (count - 1) - 0.5) * 40))
    for j in range(count - 1):
        corners = []
        for i in range(count):
            for k in (j, j + 1):
                corners.append((k * count + i, (round(20 * i / (count - 1), 2), round(20 * k / (count - 1), 2))))
        mesh.faces.append(Face(corners, 0, True, strip=True))
    return ac3d.document([WHITE], [ac3d.Node("terrain", mesh, "../Textures/grass.png", crease=180)], 3)


def ground():
    """One square of 2000 m at y = 0, a repeat of the checker every 4 m."""
    mesh = Mesh()
    mesh.polygon([(-1000, 0, 1000), (1000, 0, 1000), (1000, 0, -1000), (-1000, 0, -1000)], [(0, 0), (1, 0), (1, 1), (0, 1)])
    return ac3d.document([WHITE], [ac3d.Node("ground", mesh, "../Textures/checker.png", repeat=(500, 500))])


def floor():
    """6 x 6 m of boards with a low rim of stone."""
    boards = Mesh()
    boards.polygon([(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)], [(0, 0), (4, 0), (4, 4), (0, 4)])
    rim = Mesh()
    for low, high in (((-3.1, -0.1, -3.1), (3.1, 0.03, -3)), ((-3.1, -0.1, 3), (3.1, 0.03, 3.1)), ((-3.1, -0.1, -3), (-3, 0.03, 3)),
                      ((3, -0.1, -3), (3.1, 0.03, 3))):
        rim.append(box(low, high, 0, 1.0))
    return ac3d.document([WHITE], [ac3d.Node("boards", boards, "../Textures/wood.png"), ac3d.Node("rim", rim, "../Textures/stone.png")])


def room():
    """A room of 5 x 4.4 x 2.8 m, open towards +z: tiles, plaster, a skirting and a striped back wall."""
    materials = [WHITE, ac3d.material("plaster", (0.88, 0.84, 0.74)), ac3d.material("skirting", (0.95, 0.94, 0.9))]
    w, h, d = 2.5, 2.8, 2.2
    tiles, walls = Mesh(), Mesh()
    tiles.polygon([(-w, 0, d), (w, 0, d), (w, 0, -d), (-w, 0, -d)], [(0, 0), (w / 2, 0), (w / 2, d / 2), (0, d / 2)])
    for points in ([(-w, 0, -d), (w, 0, -d), (w, h, -d), (-w, h, -d)], [(-w, 0, d), (-w, 0, -d), (-w, h, -d), (-w, h, d)],
                   [(w, 0, -d), (w, 0, d), (w, h, d), (w, h, -d)]):
        walls.polygon(points, material=1)
    walls.append(box((-w, 0, -d), (w, 0.1, -d + 0.02), 2)).append(box((-w, 0, -d), (-w + 0.02, 0.1, d), 2))
    walls.append(box((w - 0.02, 0, -d), (w, 0.1, d), 2)).append(box((-w, h - 0.06, -d), (w, h, -d + 0.04), 2))
    picture = Mesh()
    picture.append(box((0.55, 1.3, -d), (1.75, 2.15, -d + 0.03), 2))
    view = Mesh()
    view.polygon([(0.62, 1.37, -d + 0.035), (1.68, 1.37, -d + 0.035), (1.68, 2.08, -d + 0.035), (0.62, 2.08, -d + 0.035)],
                 [(0.05, 0.03), (0.6, 0.03), (0.6, 0.8), (0.05, 0.8)])
    return ac3d.document(materials, [ac3d.Node("tiles", tiles, "../Textures/checker.png"), ac3d.Node("walls", walls),
                                     ac3d.Node("frame", picture, "../Textures/wood.png"), ac3d.Node("picture", view, "../Textures/sky.png")])


def ball():
    """Radius 0.12 m around the origin."""
    mesh = ellipsoid((0, 0, 0), (0.12, 0.12, 0.12), 32, 20)
    return ac3d.document([ac3d.material("rubber", (1, 1, 1), 0.6, 60)],
                         [ac3d.Node("ball", mesh, "../Textures/ball.png", crease=90)])


def house():
    """6 x 5 m on the ground, door towards +z. The front is one concave polygon around door and windows' bays."""
    materials = [WHITE, ac3d.material("plaster", (0.93, 0.9, 0.82)), ac3d.material("glass", (0.35, 0.45, 0.55), 0.9, 90),
                 ac3d.material("door", (0.35, 0.22, 0.14), 0.2, 20), ac3d.material("frame", (0.95, 0.95, 0.93))]
    w, d, h, ridge = 3.0, 2.5, 2.8, 4.9
    walls = Mesh()

    def wall(points):
        axis = 0 if max(p[0] for p in points) - min(p[0] for p in points) > 0.1 else 2
        walls.polygon(points, [(p[axis] * 0.5, p[1] * 0.5) for p in points])

    wall([(-w, 0, d), (-0.55, 0, d), (-0.55, 2.1, d), (0.55, 2.1, d), (0.55, 0, d), (w, 0, d), (w, h, d), (-w, h, d)])
    wall([(w, 0, -d), (-w, 0, -d), (-w, h, -d), (w, h, -d)])
    wall([(w, 0, d), (w, 0, -d), (w, h, -d), (w, ridge, 0), (w, h, d)])
    wall([(-w, 0, -d), (-w, 0, d), (-w, h, d), (-w, ridge, 0), (-w, h, -d)])
    walls.append(box((1.4, 3.2, -1.4), (2.0, 5.4, -0.8), 0, 2.0))
    details = Mesh()
    details.polygon([(-0.55, 0, d - 0.12), (0.55, 0, d - 0.12), (0.55, 2.1, d - 0.12), (-0.55, 2.1, d - 0.12)], material=3)
    for low, high in (((-0.62, 0, d - 0.15), (-0.5, 2.16, d + 0.03)), ((0.5, 0, d - 0.15), (0.62, 2.16, d + 0.03)),
                      ((-0.62, 2.04, d - 0.15), (0.62, 2.16, d + 0.03)), ((-0.8, 0, d), (0.8, 0.12, d + 0.5)),
                      ((1.35, 5.4, -1.45), (2.05, 5.5, -0.75))):
        details.append(box(low, high, 1 if high[1] < 1 or low[1] > 3 else 4))
    details.append(ellipsoid((0.4, 1.0, d - 0.09), (0.045, 0.045, 0.045), 8, 6, 2))

    def window(place):
        pane, frame = Mesh(), Mesh()
        pane.polygon([(-0.5, 1.0, 0.02), (0.5, 1.0, 0.02), (0.5, 2.0, 0.02), (-0.5, 2.0, 0.02)], material=2)
        for low, high in (((-0.56, 0.94, 0), (0.56, 1.02, 0.08)), ((-0.56, 1.98, 0), (0.56, 2.06, 0.05)),
                          ((-0.56, 1.0, 0), (-0.48, 2.0, 0.05)), ((0.48, 1.0, 0), (0.56, 2.0, 0.05)),
                          ((-0.03, 1.0, 0), (0.03, 2.0, 0.05)), ((-0.5, 1.48, 0), (0.5, 1.54, 0.05))):
            frame.append(box(low, high, 4))
        details.append(pane, place)
        details.append(frame, place)

    for x in (-1.8, 1.8):
        window(lambda p, x=x: (p[0] + x, p[1], p[2] + d))
        window(lambda p, x=x: (x - p[0], p[1], -d - p[2]))
    window(lambda p: (w + p[2], p[1], -p[0]))
    window(lambda p: (-w - p[2], p[1], p[0]))
    tiles, over, eave = Mesh(), 0.35, 0.45
    slope = (ridge - h) / d
    for side in (1, -1):
        y0, z0 = h - slope * eave + 0.06, (d + eave) * side
        outer = [(-side * (w + over), y0, z0), (side * (w + over), y0, z0), (side * (w + over), ridge + 0.06, 0),
                 (-side * (w + over), ridge + 0.06, 0)]
        run = math.hypot(d + eave, (ridge + 0.06) - y0)
        uv = [(p[0] * 0.5 * side, (0 if abs(p[2]) > 1 else run) * 0.5) for p in outer]
        tiles.polygon(outer, uv, two_sided=True)
        under = [(p[0], p[1] - 0.1, p[2]) for p in outer]
        details.polygon(list(reversed(under)), material=4)
        details.polygon([under[0], under[1], outer[1], outer[0]], material=4)
        details.polygon([under[1], under[2], outer[2], outer[1]], material=4)
        details.polygon([under[3], under[0], outer[0], outer[3]], material=4)
    return ac3d.document(materials, [ac3d.Node("house", kids=[
        ac3d.Node("walls", walls, "../Textures/bricks.png"), ac3d.Node("details", details),
        ac3d.Node("roof", tiles, "../Textures/roof.png")])])


def column():
    """A fluted stone column, 2.4 m: groups of polygons for the OBJ writer."""
    flutes = 16

    def shaft(s, t):
        around = s * flutes * 4
        radius = (0.24 - 0.04 * t) * (1 - 0.10 * math.sin(math.pi * (around / 4 % 1)))
        angle = 2 * math.pi * s
        return (-radius * math.sin(angle), 0.3 + 1.8 * t, -radius * math.cos(angle))

    body = grid(flutes * 4, 6, shaft, lambda s, t: (s * 2, t * 2.4), 0, closed=True)
    base = lathe([(0.36, 0.12), (0.37, 0.16), (0.35, 0.2), (0.29, 0.22), (0.28, 0.25), (0.31, 0.27), (0.3, 0.3),
                  (0.24, 0.3)], 32, 1, lambda s, t: (s * 2, t * 0.4))
    capital = lathe([(0.2, 2.1), (0.23, 2.1), (0.23, 2.13), (0.21, 2.14), (0.26, 2.22), (0.31, 2.27), (0.0, 2.27)], 32, 1,
                    lambda s, t: (s * 2, t * 0.4))
    blocks = box((-0.4, 0, -0.4), (0.4, 0.12, 0.4), 1, 1.0).append(box((-0.34, 2.27, -0.34), (0.34, 2.4, 0.34), 1, 1.0))
    return {"shaft": body, "base": base, "capital": capital, "blocks": blocks}
