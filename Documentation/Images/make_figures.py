#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the thesis's figures 4.5, 4.6, 5.1 and 5.3 anew, as fig_4_5.png ... beside it: for each scene the built-in
renderer's picture, POV-Ray's, the depth map and the object map; and pictures.png, what light, lens and shutter do.

    Documentation/Images/make_figures.py build/release/bin/dgtk build/figures [fig_4_6 pictures ...]
"""

import pathlib
import subprocess
import sys

import numpy as np

import png_files
from png_files import write

HERE = pathlib.Path(__file__).resolve().parent
SCENES = HERE.parents[1] / "Data" / "Scenes"
FIGURES = {"fig_4_5": "fig_4_5_bump_mapping", "fig_4_6": "fig_4_6_ray_traced", "fig_5_1": "fig_5_1_four_pictures",
           "fig_5_3": "fig_5_3_terrain_grass"}
GAP = 6


def read(path):
    """Rows x columns x RGB, uint8."""
    pixels = png_files.read(path)
    return np.repeat(pixels, 3, axis=2) if pixels.shape[2] == 1 else pixels


def depth_picture(path):
    """Brighter nearer, on a logarithmic scale over what is seen."""
    depth = np.load(path)
    seen = np.isfinite(depth)
    near, far = np.log(depth[seen].min()), np.log(depth[seen].max())
    gray = np.zeros(depth.shape)
    gray[seen] = 255 - 215 * (np.log(depth[seen]) - near) / max(far - near, 1e-9)
    return np.repeat(gray.astype(np.uint8)[..., None], 3, axis=2)


def object_picture(path):
    """A colour of its own for each id; black where nothing is."""
    ids = np.load(path)
    hue = ids * 0.61803398875 % 1  # the golden ratio keeps neighbours apart
    value = 150 + 105 * (ids * 0.7548776662 % 1)
    wheel = np.abs((hue[..., None] * 6 + [0, 4, 2]) % 6 - 3) - 1
    colours = np.clip(wheel * 0.75 + 0.25, 0.1, 1) * value[..., None]
    return np.where(ids[..., None] > 0, colours, 0).astype(np.uint8)


def tiled(pictures, columns):
    height, width, _ = pictures[0].shape
    rows = (len(pictures) + columns - 1) // columns
    sheet = np.full((rows * (height + GAP) - GAP, columns * (width + GAP) - GAP, 3), 255, np.uint8)
    for i, picture in enumerate(pictures):
        y, x = i // columns * (height + GAP), i % columns * (width + GAP)
        sheet[y:y + height, x:x + width] = picture
    return sheet


def main(arguments):
    names = arguments[2:] or [*FIGURES, "pictures"]
    if len(arguments) < 2 or not set(names) <= {*FIGURES, "pictures"}:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    dgtk, folder = arguments[0], pathlib.Path(arguments[1])

    def render(scene, name, *options):
        subprocess.run([dgtk, "render", str(SCENES / f"{scene}.json"), "-o", str(folder / name), "--quiet", "--samples", "3", *options],
                       check=True)
        return folder / name

    for figure in (name for name in names if name in FIGURES):
        scene = FIGURES[figure]
        size = ["--size", "400x200" if figure == "fig_4_5" else "400x300"]
        built_in = render(scene, figure, "--layers", "color,depth,objects", "--objects-format", "npy", *size)
        traced = render(scene, figure + "_povray", "--layers", "color", "--renderer", "povray", "--pov-shadows", *size)
        color = "camera/color/000000.png"
        write(HERE / f"{figure}.png", tiled([read(built_in / color), read(traced / color), depth_picture(built_in / "camera/depth/000000.npy"),
                                             object_picture(built_in / "camera/objects/000000.npy")], 2))
    if "pictures" in names:
        size = ["--size", "400x300", "--layers", "color"]
        materials = render("materials_environment", "materials", *size)
        blurred = render("lens_and_shutter", "blurred", "--frames", "2", *size)
        pictures = [materials / "camera", blurred / "shutter", blurred / "lens", blurred / "both"]
        write(HERE / "pictures.png", tiled([read(next((picture / "color").glob("*.png"))) for picture in pictures], 2))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
