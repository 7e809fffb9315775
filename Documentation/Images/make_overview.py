#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes overview.png beside it, the README's picture, from rendered data: colour, depth and object ids above, normals,
texture coordinates and triangle ids below.

    build/release/bin/dgtk render Data/Scenes/demo.json -o build/overview --layers all --frames 1 --cameras left --size 400x300
    Documentation/Images/make_overview.py build/overview/left
"""

import pathlib
import sys

import numpy as np

from png_files import read, write

FRAME = "000001"


def color(folder):
    return read(folder / "color" / f"{FRAME}.png")[:, :, :3] / 255


def readable(ids, there):
    """Numbers as colours that differ: hues by the plastic ratio."""
    phase = ids[..., None] * 0.754878 + np.array([0, 1 / 3, 2 / 3])
    picture = 0.55 + 0.4 * np.cos(2 * np.pi * phase) * (0.7 + 0.3 * np.cos(ids[..., None] * 2.4))
    return np.where(there[..., None], picture, 0.12)


def panels(folder):
    depth, normal, uv, triangles = (np.load(folder / name / f"{FRAME}.npy") for name in ("depth", "normal", "uv", "triangles"))
    there = np.isfinite(depth)
    near = np.where(there, 1 / np.where(there, depth, 1), 0)
    near = (near / near.max()) ** 0.6
    height, width = depth.shape
    ppm = (folder / "objects" / f"{FRAME}.ppm").read_bytes()[-3 * width * height:]
    rgb = np.frombuffer(ppm, np.uint8).reshape(height, width, 3).astype(int)
    objects = (rgb[..., 0] << 16) + (rgb[..., 1] << 8) + rgb[..., 2]
    facing = np.where(there[..., None], np.nan_to_num(normal) * [0.5, -0.5, -0.5] + 0.5, 0.12)
    mapped = np.nan_to_num(uv) % 1
    mapped = np.where(np.isfinite(uv).all(axis=2)[..., None], np.dstack([mapped, np.full(depth.shape, 0.4)]), 0.12)
    return [[color(folder), np.dstack([near] * 3), readable(objects, objects > 0)],
            [facing, mapped, readable(triangles % 9973, there)]]


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    picture = np.vstack([np.hstack(row) for row in panels(pathlib.Path(arguments[0]))])
    pixels = (np.clip(picture, 0, 1) * 255 + 0.5).astype(np.uint8)
    write(pathlib.Path(__file__).resolve().parent / "overview.png", pixels)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
