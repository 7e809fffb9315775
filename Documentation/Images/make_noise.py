#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes noise.png beside it: each effect of a sensor, low and high, six pictures a row in the order of the scenes; the last
row is depth, nearer brighter, magenta where the sensor gives none.

    build/release/bin/dgtk render Data/Scenes/noise_color.json -o build/noise_color --layers color,color_noisy
    build/release/bin/dgtk render Data/Scenes/noise_depth.json -o build/noise_depth --layers depth,depth_noisy
    Documentation/Images/make_noise.py build/noise_color build/noise_depth
"""

import json
import pathlib
import sys

import numpy as np

from png_files import read, write

COLUMNS = 6
LEFT, TOP, WIDTH, HEIGHT = 36, 50, 160, 120  # of each picture


def color(path):
    return read(path)[:, :, :3] / 255


def depth(path):
    z = np.load(path)
    there = np.isfinite(z)
    shade = np.clip((6.5 - np.where(there, z, 0)) / 4.5, 0, 1)
    return np.where(there[..., None], shade[..., None], [0.8, 0, 0.6])


def panels(folder, layer, extension, read):
    for camera in json.loads((folder / "scene.json").read_text())["cameras"]:
        yield read(folder / camera["name"] / layer / f"000000.{extension}")[TOP:TOP + HEIGHT, LEFT:LEFT + WIDTH]


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    all_panels = [*panels(pathlib.Path(arguments[0]), "color_noisy", "png", color),
                  *panels(pathlib.Path(arguments[1]), "depth_noisy", "npy", depth)]
    rows = [np.hstack(all_panels[i:i + COLUMNS]) for i in range(0, len(all_panels), COLUMNS)]
    pixels = (np.clip(np.vstack(rows), 0, 1) * 255 + 0.5).astype(np.uint8)
    write(pathlib.Path(__file__).resolve().parent / "noise.png", pixels)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
