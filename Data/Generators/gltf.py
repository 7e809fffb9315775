# SPDX-License-Identifier: BSD-3-Clause
"""glTF 2 files with everything but the textures embedded."""

import base64
import json
import struct


def _short(value):
    """A number with few bits, so that no last bit of a sine reaches the file."""
    return round(value * 4096) / 4096


class Document:
    def __init__(self, generator):
        self.data = b""
        self.json = {"asset": {"version": "2.0", "generator": generator}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [],
                     "meshes": [], "materials": [], "accessors": [], "bufferViews": [], "buffers": []}

    def add(self, kind, item):
        """Appends to one of the lists; the index."""
        self.json.setdefault(kind, []).append(item)
        return len(self.json[kind]) - 1

    def _accessor(self, rows, shape, component, code, target=None):
        packed = b"".join(struct.pack(f"<{len(r)}{code}", *r) for r in rows)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)}
        if target:
            view["target"] = target
        self.data += packed + bytes(-len(packed) % 4)
        item = {"bufferView": self.add("bufferViews", view), "componentType": component, "count": len(rows), "type": shape}
        if component == 5126:
            item["min"] = [min(c) for c in zip(*rows)]
            item["max"] = [max(c) for c in zip(*rows)]
        return self.add("accessors", item)

    def floats(self, rows, target=None):
        rows = [tuple(_short(c) for c in r) for r in rows]
        return self._accessor(rows, {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}[len(rows[0])], 5126, "f", target)

    def indices(self, values):
        return self._accessor([(v,) for v in values], "SCALAR", 5123, "H", 34963)

    def texture(self, uri):
        image = self.add("images", {"uri": uri})
        if "samplers" not in self.json:
            self.add("samplers", {"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497})
        return self.add("textures", {"source": image, "sampler": 0})

    def material(self, name, colour, texture=None, double_sided=False):
        surface = {"baseColorFactor": list(colour) + [1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8}
        if texture is not None:
            surface["baseColorTexture"] = {"index": texture}
        return self.add("materials", {"name": name, "pbrMetallicRoughness": surface, "doubleSided": double_sided})

    def mesh(self, name, mesh, materials, targets=()):
        """A mesh; faces of one material are one primitive; targets: functions that move a vertex."""
        normals, primitives = mesh.vertex_normals(), []
        for k, material in enumerate(materials):
            points, index, order = [], {}, []
            for face, corners in mesh.triangles():
                if face.material != k:
                    continue
                for vertex, uv in corners:
                    key = (vertex, tuple(round(c, 4) for c in uv))
                    if key not in index:
                        index[key] = len(points)
                        points.append(key)
                    order.append(index[key])
            if not order:
                continue
            places = [mesh.vertices[v] for v, _ in points]
            primitive = {"attributes": {"POSITION": self.floats(places, 34962),
                                        "NORMAL": self.floats([normals[v] for v, _ in points], 34962),
                                        "TEXCOORD_0": self.floats([(u, 1 - v) for _, (u, v) in points], 34962)},
                         "indices": self.indices(order), "material": material}
            if targets:
                moved = [[tuple(b - a for a, b in zip(p, target(p))) for p in places] for target in targets]
                primitive["targets"] = [{"POSITION": self.floats(rows, 34962)} for rows in moved]
            primitives.append(primitive)
        item = {"name": name, "primitives": primitives}
        if targets:
            item["weights"] = [0.0] * len(targets)
        return self.add("meshes", item)

    def text(self):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        self.json["buffers"] = [{"byteLength": len(self.data), "uri": uri}]
        return json.dumps(self.json, indent=1) + "\n"
