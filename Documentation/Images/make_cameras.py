#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes cameras.png beside it: one room of checked walls through each camera model, four pictures a row in the order of LENSES;
and rolling_shutter.png: a frame from a passing train, seen at once and by a rolling shutter.

    Documentation/Images/make_cameras.py build/release/bin/dgtk
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

from png_files import read, write

HERE = pathlib.Path(__file__).resolve().parent
COLUMNS, WIDTH, HEIGHT, CELLS = 4, 240, 180, 12
COLORS = ["0.85 0.45 0.35", "0.35 0.6 0.85", "0.9 0.8 0.4", "0.5 0.75 0.5", "0.75 0.55 0.8", "0.6 0.6 0.6"]


def K(focal):
    return [[focal, 0, WIDTH / 2], [0, focal, HEIGHT / 2], [0, 0, 1]]


LENSES = [
    {"name": "pinhole", "fovY": 70},
    {"name": "barrel", "K": K(100), "distortion": [-0.25, 0.045, 0, 0]},
    {"name": "cushion", "K": K(140), "distortion": [0.35, 0.1, 0, 0]},
    {"name": "tilted", "K": K(120), "distortion": [-0.1, 0.01, 0.02, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.25, -0.2]},
    {"name": "fisheye", "model": "fisheye", "K": K(55), "distortion": [0.01, -0.004, 0, 0]},
    {"name": "all around", "model": "fisheye", "K": K(29), "distortion": [0, 0, 0, 0]},
    {"name": "omnidirectional", "model": "omnidirectional", "K": K(130), "xi": 1.7, "distortion": [-0.05, 0, 0, 0]},
    {"name": "double sphere", "model": "double-sphere", "K": K(60), "xi": -0.2, "alpha": 0.6},
    {"name": "enhanced", "model": "eucm", "K": K(70), "alpha": 0.62, "beta": 1.1},
    {"name": "panorama", "model": "equirectangular"},
    {"name": "parallel", "model": "orthographic", "viewHeight": 3.4},
    {"name": "table", "model": "raytable", "rays": "rays.npy"},
]


def wall(axis, side):
    """Corners and triangles of a checked wall of the cube from -2 to 2, light and dark cells."""
    at = np.linspace(-2, 2, CELLS + 1)
    a, b = np.meshgrid(at, at, indexing="ij")
    points = np.empty((CELLS + 1, CELLS + 1, 3))
    points[..., axis], points[..., axis - 1], points[..., axis - 2] = 2 * side, a, b
    corner = np.arange(points[..., 0].size).reshape(points.shape[:2])
    cells = np.stack([corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]], axis=-1)
    return points.reshape(-1, 3), cells


def write_room(folder):
    lines, materials, first = ["mtllib room.mtl"], [], 1
    for i, color in enumerate(COLORS):
        points, cells = wall(i % 3, 1 if i < 3 else -1)
        lines += ["v %g %g %g" % tuple(point) for point in points]
        for dark in (0, 1):
            rgb = " ".join(str(0.35 * float(c)) if dark else c for c in color.split())
            materials.append(f"newmtl m{i}{dark}\nKa {rgb}\nKd {rgb}\nKs 0 0 0\n")
            lines.append(f"usemtl m{i}{dark}")
            lines += ["f " + " ".join(str(first + v) for v in cells[x, y])
                      for x in range(CELLS) for y in range(CELLS) if (x + y) % 2 == dark]
        first += len(points)
    (folder / "room.obj").write_text("\n".join(lines) + "\n")
    (folder / "room.mtl").write_text("\n".join(materials))


def write_rays(folder):
    """A lens that waves."""
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH] + 0.5
    x, y = (x - WIDTH / 2) / 100, (y - HEIGHT / 2) / 100
    np.save(folder / "rays.npy", np.stack([x + 0.08 * np.sin(9 * y), y + 0.08 * np.sin(9 * x), np.ones_like(x)], axis=-1))


def write_scene(folder):
    pose = {"eye": [0.3, 0.2, 0.9], "lookAt": [-0.2, -0.1, -2], "near": 0.01, "far": 100, "width": WIDTH, "height": HEIGHT}
    scene = {"version": 1, "background": [0, 0, 0], "objects": [{"name": "room", "model": "room.obj"}],
             "lights": [{"name": "lamp", "position": [0.5, 1.2, 0.5], "ambient": [0.5, 0.5, 0.5], "diffuse": [0.7, 0.7, 0.7]}],
             "cameras": [{**pose, **lens} for lens in LENSES]}
    (folder / "scene.json").write_text(json.dumps(scene))


def render(dgtk, scene, folder, *options):
    subprocess.run([dgtk, "render", str(scene), "-o", str(folder), "--quiet", "--renderer", "ray", "--samples", "4", "--layers",
                    "color", *options], check=True)


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_room(folder)
        write_rays(folder)
        write_scene(folder)
        render(arguments[0], folder / "scene.json", folder / "set")
        render(arguments[0], HERE.parents[1] / "Data" / "Scenes" / "rolling_shutter.json", folder / "train", "--frames", "2")
        passing = [read(folder / "train" / camera / "color" / "000002.png")[:, :, :3] for camera in ("still", "train")]
        panels = [read(folder / "set" / lens["name"] / "color" / "000000.png")[:, :, :3] for lens in LENSES]
    rows = [np.hstack(panels[i:i + COLUMNS]) for i in range(0, len(panels), COLUMNS)]
    pixels = np.vstack(rows)
    write(HERE / "cameras.png", pixels)
    write(HERE / "rolling_shutter.png", np.hstack(passing))
    return 0


sys.exit(main(sys.argv[1:]))
