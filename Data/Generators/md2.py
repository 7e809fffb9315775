# SPDX-License-Identifier: BSD-3-Clause
"""MD2 files (Quake II): X forward, Y left, Z up, triangles clockwise from outside, one skin, byte coordinates a frame."""

import math
import struct




def document(triangles, uvs, frames, skin, skin_size):
    """triangles: lists of three (vertex, uv index), counter-clockwise from outside; uvs: (u, v), v up;
    frames: (name, positions in X forward, Y left, Z up)."""
    width, height = skin_size
    count = len(frames[0][1])
    frame_size = 40 + 4 * count
    skins_at = 68
    uvs_at = skins_at + 64
    triangles_at = uvs_at + 4 * len(uvs)
    frames_at = triangles_at + 12 * len(triangles)
    end = frames_at + frame_size * len(frames)
    data = struct.pack("<4s16i", b"IDP2", 8, width, height, frame_size, 1, count, len(uvs), len(triangles), 0, len(frames),
                       skins_at, uvs_at, triangles_at, frames_at, end, end)
    data += struct.pack("<64s", skin.encode())
    for u, v in uvs:
        data += struct.pack("<2h", round(u * width), round((1 - v) * height))
    for corners in triangles:
        (a, s), (b, t), (c, r) = corners
        data += struct.pack("<6H", a, c, b, s, r, t)
    for name, positions in frames:
        low = [min(p[k] for p in positions) for k in range(3)]
        size = [max((max(p[k] for p in positions) - low[k]) / 255, 1e-6) for k in range(3)]
        # numbers of few digits, so that no last bit of a sine reaches the file
        low = [math.floor(v * 64) / 64 for v in low]
        size = [math.ceil((s + 1 / 64 / 255) * 65536) / 65536 for s in size]
        data += struct.pack("<6f16s", *size, *low, name.encode())
        for p in positions:
            data += bytes(min(255, max(0, round((p[k] - low[k]) / size[k]))) for k in range(3)) + b"\0"
    return data
