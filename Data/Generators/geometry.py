# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of polygons and the shapes that the models are put together from. Y up, counter-clockwise from outside."""

import math


def number(value, digits=4):
    """A number in few characters, the same everywhere: fixed digits, no trailing zeros, no minus zero."""
    text = f"{value:.{digits}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text in ("-0", "") else text


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    size = length(a)
    return times(a, 1 / size) if size > 0 else (0.0, 1.0, 0.0)


def rotation(axis, degrees):
    """Rows of the matrix that turns about the x, y or z axis, right-handed."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return {"x": ((1, 0, 0), (0, c, -s), (0, s, c)),
            "y": ((c, 0, s), (0, 1, 0), (-s, 0, c)),
            "z": ((c, -s, 0), (s, c, 0), (0, 0, 1))}[axis]


def turned(point, axis, degrees):
    return tuple(dot(row, point) for row in rotation(axis, degrees))


class Face:
    """A polygon: corners are (index of the vertex, (u, v))."""

    __slots__ = ("corners", "material", "smooth", "two_sided", "strip")

    def __init__(self, corners, material=0, smooth=False, two_sided=False, strip=False):
        self.corners, self.material, self.smooth = corners, material, smooth
        self.two_sided, self.strip = two_sided, strip


class Mesh:
    def __init__(self):
        self.vertices = []
        self.faces = []

    def vertex(self, point):
        self.vertices.append(tuple(float(c) for c in point))
        return len(self.vertices) - 1

    def polygon(self, points, uvs=None, **kind):
        """A polygon with vertices of its own."""
        uvs = uvs or [(0, 0)] * len(points)
        self.faces.append(Face([(self.vertex(p), uv) for p, uv in zip(points, uvs)], **kind))

    def append(self, other, place=lambda p: p):
        """Another mesh, its vertices moved by `place`."""
        base = len(self.vertices)
        self.vertices += [tuple(place(v)) for v in other.vertices]
        for f in other.faces:
            self.faces.append(Face([(i + base, uv) for i, uv in f.corners], f.material, f.smooth, f.two_sided, f.strip))
        return self

    def moved(self, place):
        return Mesh().append(self, place)

    def triangles(self):
        """Fans of the polygons: (face, three corners)."""
        for face in self.faces:
            c = face.corners
            for k in range(1, len(c) - 1):
                yield face, (c[0], c[k], c[k + 1])

    def vertex_normals(self):
        """Unit normals, faces weighted by area."""
        sums = [(0.0, 0.0, 0.0)] * len(self.vertices)
        for _, corners in self.triangles():
            a, b, c = (self.vertices[i] for i, _ in corners)
            n = cross(sub(b, a), sub(c, a))
            for i, _ in corners:
                sums[i] = add(sums[i], n)
        return [unit(s) for s in sums]


def box(low, high, material=0, tile=1.0):
    """An axis-aligned box; one repeat of the texture is `tile` units on every side."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    mesh = Mesh()
    sides = [
        ([(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)], (0, 1)),
        ([(x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)], (0, 1)),
        ([(x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)], (2, 1)),
        ([(x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)], (2, 1)),
        ([(x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)], (0, 2)),
        ([(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)], (0, 2)),
    ]
    for points, (a, b) in sides:
        mesh.polygon(points, [((p[a] - low[a]) / tile, (p[b] - low[b]) / tile) for p in points], material=material)
    return mesh


def grid(columns, rows, point, uv=None, material=0, closed=False, **kind):
    """Quads of a (columns + 1) x (rows + 1) grid: point(i / columns, j / rows); closed joins the last column to the first.

    Counter-clockwise seen from where column x row points up: outside when i runs left to right and j upwards."""
    uv = uv or (lambda s, t: (s, t))
    mesh = Mesh()
    across = columns if closed else columns + 1
    index = [[mesh.vertex(point(i / columns, j / rows)) for i in range(across)] for j in range(rows + 1)]
    for j in range(rows):
        for i in range(columns):
            corners = []
            for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)):
                vertex = index[j + dj][(i + di) % across]
                if not any(mesh.vertices[vertex] == mesh.vertices[k] for k, _ in corners):
                    corners.append((vertex, uv((i + di) / columns, (j + dj) / rows)))
            if len(corners) > 2:
                mesh.faces.append(Face(corners, material, True, kind.get("two_sided", False)))
    return weld_poles(mesh)


def weld_poles(mesh):
    """Vertices at one place become one, so that poles and seams shade smoothly."""
    first, rename = {}, []
    for i, v in enumerate(mesh.vertices):
        rename.append(first.setdefault(v, i))
    kept = sorted(set(rename))
    place = {old: new for new, old in enumerate(kept)}
    mesh.vertices = [mesh.vertices[i] for i in kept]
    for f in mesh.faces:
        f.corners = [(place[rename[i]], uv) for i, uv in f.corners]
    return mesh


def lathe(profile, segments, material=0, uv=None, smooth=True):
    """A profile of (radius, height), from the bottom to the top, turned about the y axis. Seen from outside u runs to
    the right; u = 0.5 looks along +z."""
    count = len(profile) - 1

    def point(s, t):
        radius, height = profile[round(t * count)]
        angle = 2 * math.pi * s
        if radius == 0:
            return (0.0, height, 0.0)
        return (-radius * math.sin(angle), height, -radius * math.cos(angle))

    mesh = grid(segments, count, point, uv, material, closed=True)
    for f in mesh.faces:
        f.smooth = smooth
    return mesh


def ellipsoid(centre, radii, segments=16, rings=10, material=0, uv=None):
    profile = [(math.sin(math.pi * k / rings) if 0 < k < rings else 0.0, -math.cos(math.pi * k / rings))
               for k in range(rings + 1)]
    ball = lathe(profile, segments, material, uv)
    return ball.moved(lambda p: tuple(c + r * x for c, r, x in zip(centre, radii, p)))


def tube(path, radii, sides, material=0, repeat=1.0, cap=False):
    """A tube along a path of points; one repeat of the texture is `repeat` units along it."""
    directions = [unit(sub(path[min(k + 1, len(path) - 1)], path[max(k - 1, 0)])) for k in range(len(path))]
    aside = unit(cross((0.0, 0.0, 1.0), directions[0]) if abs(directions[0][2]) < 0.9 else cross((1.0, 0, 0), directions[0]))
    frames, run = [], [0.0]
    for k, forward in enumerate(directions):
        aside = unit(sub(aside, times(forward, dot(aside, forward))))
        frames.append((aside, cross(forward, aside)))
        if k:
            run.append(run[-1] + length(sub(path[k], path[k - 1])))

    def point(s, t):
        k = round(t * (len(path) - 1))
        a, b = frames[k]
        angle = 2 * math.pi * s
        return add(path[k], add(times(a, radii[k] * math.cos(angle)), times(b, radii[k] * math.sin(angle))))

    mesh = grid(sides, len(path) - 1, point, lambda s, t: (s, run[round(t * (len(path) - 1))] / repeat), material, closed=True)
    if cap:
        ring = [(len(mesh.vertices) - sides + i, (0.5, 0.5)) for i in range(sides)]
        mesh.faces.append(Face(ring, material))
    return mesh


def card(centre, half_width, half_height, material=0):
    """A two-sided upright picture: centre, half its width as a vector, half its height as a vector."""
    mesh = Mesh()
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    mesh.polygon([add(centre, add(times(half_width, a), times(half_height, b))) for a, b in corners],
                 [((a + 1) / 2, (b + 1) / 2) for a, b in corners], material=material, two_sided=True)
    return mesh
