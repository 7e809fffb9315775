# SPDX-License-Identifier: BSD-3-Clause
"""3DS files: chunks, Z up, vertices in world space."""

import struct


def _chunk(kind, *parts):
    body = b"".join(parts)
    return struct.pack("<HI", kind, 6 + len(body)) + body


def _text(text):
    return text.encode() + b"\0"


def _colour(kind, colour):
    return _chunk(kind, _chunk(0x0011, bytes(round(255 * c) for c in colour)))


def _percent(kind, part):
    return _chunk(kind, _chunk(0x0030, struct.pack("<h", round(100 * part))))


def _short(value):
    """A coordinate with few bits, so that no last bit of a sine reaches the file."""
    return round(value * 4096) / 4096


def material(name, colour, specular=0.0, shininess=0.2, opacity=1.0, two_sided=False, texture=None):
    parts = [_chunk(0xA000, _text(name)), _colour(0xA010, tuple(0.4 * c for c in colour)), _colour(0xA020, colour),
             _colour(0xA030, (specular,) * 3), _percent(0xA040, shininess), _percent(0xA050, 1 - opacity)]
    if two_sided:
        parts.append(_chunk(0xA081))
    if texture:
        parts.append(_chunk(0xA200, struct.pack("<HIh", 0x0030, 8, 100), _chunk(0xA300, _text(texture))))
    return _chunk(0xAFFF, *parts)


def mesh(name, shape, names, with_uv=True):
    """An object; shape is Y up and becomes Z up; names: of the materials, by index."""
    vertices, index, faces = [], {}, []
    for face, corners in shape.triangles():
        row = []
        for vertex, uv in corners:
            key = (vertex, tuple(round(c, 4) for c in uv))
            if key not in index:
                index[key] = len(vertices)
                vertices.append(key)
            row.append(index[key])
        faces.append((row, face))
    points = b"".join(struct.pack("<3f", _short(x), _short(-z), _short(y)) for x, y, z in (shape.vertices[v] for v, _ in vertices))
    uvs = b"".join(struct.pack("<2f", _short(u), _short(v)) for _, (u, v) in vertices)
    parts = [_chunk(0x4110, struct.pack("<H", len(vertices)), points)]
    if with_uv:
        parts.append(_chunk(0x4140, struct.pack("<H", len(vertices)), uvs))
    parts.append(_chunk(0x4160, struct.pack("<12f", 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0)))
    groups = []
    for k, material_name in enumerate(names):
        used = [i for i, (_, face) in enumerate(faces) if face.material == k]
        if used:
            groups.append(_chunk(0x4130, _text(material_name), struct.pack(f"<{len(used) + 1}H", len(used), *used)))
    smoothing = _chunk(0x4150, b"".join(struct.pack("<I", 1 if face.smooth else 0) for _, face in faces))
    rows = b"".join(struct.pack("<4H", *row, 7) for row, _ in faces)
    parts.append(_chunk(0x4120, struct.pack("<H", len(faces)), rows, *groups, smoothing))
    return _chunk(0x4000, _text(name), _chunk(0x4100, *parts))


def document(materials, objects):
    editor = _chunk(0x3D3D, _chunk(0x3D3E, struct.pack("<I", 3)), *materials, _chunk(0x0100, struct.pack("<f", 1)), *objects)
    return _chunk(0x4D4D, _chunk(0x0002, struct.pack("<I", 3)), editor)
