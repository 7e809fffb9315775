# SPDX-License-Identifier: BSD-3-Clause
"""What the cases about POV-Ray share: running it, and the triangles of a scene that dgtk wrote for it, by numpy."""
import os
import re
import subprocess

import numpy

# Pixels whose centre lies this near to an edge may go either way: two engines round differently.
EDGE = 1 / 64
# Of a depth: what lies deeper than this behind a surface is hidden by it.
HIDDEN = 1e-6


def read_pnm(path):
    """Rows x columns x channels (1 for gray), as integers; 8 or 16 bits."""
    with open(path, "rb") as file:
        data = file.read()
    kind, width, height, top = re.match(rb"(P[56])\s(?:#.*\n)*(\d+)\s+(\d+)\s+(\d+)\s", data).groups()
    channels, kind = (3 if kind == b"P6" else 1), (numpy.dtype(">u2") if int(top) > 255 else numpy.dtype("u1"))
    count = int(width) * int(height) * channels
    values = numpy.frombuffer(data[-count * kind.itemsize:], kind)
    return values.reshape(int(height), int(width), channels).astype(int)


def draw(scene, bits=8, folder=None):
    """What POV-Ray makes of a scene; its size stands in the file's second line."""
    with open(scene, encoding="utf-8") as file:
        options = file.read().split("\n")[1].split()[2:-1]
    target = os.path.splitext(os.path.abspath(scene))[0] + ".drawn.ppm"
    done = subprocess.run(["povray", *(o for o in options if not o.startswith("+FN")), f"+FP{bits}", f"+I{scene}", f"+O{target}",
                           "-D", "-V", "-GA", "+WT1"], capture_output=True, text=True, cwd=folder or os.path.dirname(scene), timeout=120)
    if done.returncode != 0:
        raise AssertionError(done.stderr[-2000:])
    return read_pnm(target)


def ids_of(rgb):
    return (rgb[..., 0] << 16) + (rgb[..., 1] << 8) + rgb[..., 2]


class Mesh:
    """Vertices, triangles, and for each triangle its texture coordinates and mask where texels are missing."""

    def __init__(self, text, folder):
        def numbers(name, width):
            found = re.search(name + r" \{ \d+(.*?)\n  \}", text, re.S)
            values = re.findall(r"-?\d[\d.]*(?:e[-+]?\d+)?", found.group(1)) if found else []
            return numpy.array(values, float).reshape(-1, width)

        self.vertices, self.uvs = numbers("vertex_vectors", 3), numbers("uv_vectors", 2)
        faces = re.search(r"face_indices \{ \d+(.*?)\n  \}", text, re.S).group(1)
        rows = re.findall(r"<(\d+), (\d+), (\d+)>(?:, (\d+))?", faces)
        self.triangles = numpy.array([row[:3] for row in rows], int).reshape(-1, 3)
        self.textures = [int(row[3] or 0) for row in rows]
        listed = re.search(r"texture_list \{ \d+(.*?)\n  \}\n", text, re.S)
        pigments = [p for p in listed.group(1).split("\n    ") if p.strip(" ,\n")] if listed else []
        self.masks = []
        for pigment in pigments:
            name = re.search(r'image_pattern \{ pgm "([^"]*)"', pigment)
            self.masks.append(read_pnm(os.path.join(folder, name.group(1)))[..., 0] > 127 if name else None)


class Scene:
    """All triangles of a .pov, in the world's units, in the order of the objects."""

    def __init__(self, path):
        folder = os.path.dirname(path)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        for name in re.findall(r'#include "([^"]*)"', text):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                text = file.read() + text
        declared = dict(re.findall(r"#declare (\w+) = mesh2 (\{.*?\n\})", text, re.S))
        meshes = {name: Mesh(body, folder) for name, body in declared.items()}
        corners, self.uvs, self.masks = [], [], []
        for name, matrix in re.findall(r"object \{\n  (\w+)\n  matrix <([^>]*)>", text):
            mesh, rows = meshes[name], numpy.array(matrix.split(","), float).reshape(4, 3)
            corners.append((mesh.vertices @ rows[:3] + rows[3])[mesh.triangles])
            for triangle, texture in zip(mesh.triangles, mesh.textures):
                mask = mesh.masks[texture] if mesh.masks else None
                self.masks.append(mask)
                self.uvs.append(mesh.uvs[triangle] if mask is not None else None)
        self.corners = numpy.concatenate(corners) if corners else numpy.zeros((0, 3, 3))


def image_of(points, camera):
    """(x, y, z) of points in the world: pixels and depth. Points at or behind the camera keep their sign of z."""
    x = points @ numpy.array(camera["R"]).T + numpy.array(camera["t"])
    K, z = numpy.array(camera["K"]), x[..., 2:]
    if camera["model"] == "orthographic":
        return numpy.concatenate([x[..., :2] @ K[:2, :2].T + K[:2, 2], z], -1)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        return numpy.concatenate([(x / z @ K.T)[..., :2], z], -1)


class Screen:
    """The triangles of a scene in a camera's image."""

    def __init__(self, scene, camera):
        self.scene, self.orthographic = scene, camera["model"] == "orthographic"
        world = cut(scene.corners, camera)
        self.owner = world[1]
        self.image = image_of(world[0], camera)
        self.barycentric = world[2]

    def weights(self, pixel):
        """Weights of the corners of all triangles at a pixel, and their depths there."""
        a, b, c = (self.image[:, i, :2] for i in range(3))
        cross = lambda u, v: u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
        with numpy.errstate(divide="ignore", invalid="ignore"):
            area = cross(b - a, c - a)
            w = numpy.stack([cross(b - pixel, c - pixel), cross(c - pixel, a - pixel), cross(a - pixel, b - pixel)], -1) / area[:, None]
            if self.orthographic:
                return w, (w * self.image[..., 2]).sum(-1)
            w = w / self.image[..., 2]
            z = 1 / w.sum(-1)
            return w * z[:, None], z

    def near_edge(self, pixel):
        """Whether an edge that can be seen passes within EDGE of the pixel."""
        weights, depth = self.weights(pixel)
        start, end = self.image[:, :, :2], numpy.roll(self.image, -1, 1)[:, :, :2]
        along = end - start
        with numpy.errstate(divide="ignore", invalid="ignore"):
            s = numpy.clip(((pixel - start) * along).sum(-1) / (along ** 2).sum(-1), 0, 1)
        s = numpy.nan_to_num(s)
        distance = numpy.linalg.norm(start + s[..., None] * along - pixel, axis=-1)
        close = (distance <= EDGE).any(1)
        # triangles that fill the surroundings of the pixel, without holes, hide what lies behind
        fills = (weights > 0).all(1) & ~close & numpy.array([self.scene.masks[i] is None for i in self.owner], bool)
        wall = depth[fills].min() * (1 + HIDDEN) if fills.any() else numpy.inf
        nearest = self.image[:, :, 2].min(1)
        return bool((close & (nearest <= wall)).any())

    def near_texel(self, pixel):
        """Whether the border of a missing texel passes within EDGE of the pixel, on any triangle."""
        found = {}
        for x in (-EDGE, 0, EDGE):
            for y in (-EDGE, 0, EDGE):
                weights, _ = self.weights(pixel + (x, y))
                for piece in numpy.nonzero((weights > -0.5).all(1))[0]:
                    triangle = self.owner[piece]
                    mask = self.scene.masks[triangle]
                    if mask is not None:
                        u, v = weights[piece] @ self.barycentric[piece] @ self.scene.uvs[triangle]
                        column, row = int(numpy.floor(u * mask.shape[1])), int(numpy.floor((1 - v) * mask.shape[0]))
                        found.setdefault(piece, set()).add(bool(mask[row % mask.shape[0], column % mask.shape[1]]))
        return any(len(values) > 1 for values in found.values())


def cut(corners, camera):
    """Triangles cut at the near and the far plane: corners, index of the triangle, weights of its corners."""
    R, t = numpy.array(camera["R"]), numpy.array(camera["t"])
    z = corners @ R[2] + t[2]
    inside = (z >= camera["near"]).all(1) & (z <= camera["far"]).all(1)
    points, owner, weights = list(corners[inside]), list(numpy.nonzero(inside)[0]), [numpy.eye(3)] * int(inside.sum())
    for i in numpy.nonzero(~inside & (z.max(1) > camera["near"]) & (z.min(1) < camera["far"]))[0]:
        polygon = list(numpy.eye(3))
        for sign, limit in ((1, camera["near"]), (-1, -camera["far"])):
            kept = []
            for p, q in zip(polygon, polygon[1:] + polygon[:1]):
                dp, dq = sign * (p @ z[i]) - limit, sign * (q @ z[i]) - limit
                if dp >= 0:
                    kept.append(p)
                if (dp >= 0) != (dq >= 0):
                    kept.append(p + (q - p) * (dp / (dp - dq)))
            polygon = kept
        for k in range(1, len(polygon) - 1):
            w = numpy.array([polygon[0], polygon[k], polygon[k + 1]])
            points.append(w @ corners[i])
            owner.append(i)
            weights.append(w)
    return numpy.array(points).reshape(-1, 3, 3), owner, numpy.array(weights).reshape(-1, 3, 3)
