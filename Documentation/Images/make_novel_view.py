#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes novel_view.png beside it, the picture of the user guide's page on novel views: the view of a camera 5 degrees
away made of a depth map, of a layered depth image, and as it is rendered there. Prints the numbers of the page.

    Documentation/Images/make_novel_view.py build/release/bin/dgtk build/novel_view
"""

import json
import pathlib
import subprocess
import sys

import numpy as np

from png_files import read, write

HERE = pathlib.Path(__file__).resolve().parent
SCENE = HERE.parents[1] / "Data" / "Scenes" / "fig_4_7_stereo.json"
HOLE = (255, 0, 200)
GAP = 6


def two_cameras(degrees):
    """The figure's scene with its left camera and one that stands `degrees` farther round the point it looks at."""
    scene = json.loads(SCENE.read_text(encoding="utf-8"))
    first = dict(scene["cameras"][0], name="source")
    eye, target = np.array(first["eye"]), np.array(first["lookAt"])
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    away = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]) @ (eye - target)
    scene["cameras"] = [first, dict(first, name="target", eye=(target + away).tolist())]
    for thing in scene["objects"]:
        if "model" in thing and ".." in thing["model"]:
            thing["model"] = str((SCENE.parent / thing["model"]).resolve())
    return scene


def seen_by_source(data):
    """Where the target's surfaces project into the source's image."""
    cameras = {camera["name"]: camera for camera in json.loads((data / "cameras.json").read_text())["cameras"]}
    source = cameras["source"]
    position = np.load(data / "target" / "position" / "000000.npy").astype(float)
    x = position @ np.array(source["R"]).T + source["t"]
    pixel = (x @ np.array(source["K"]).T)[..., :2] / x[..., 2:]
    return ((pixel >= 0) & (pixel < [source["width"], source["height"]])).all(axis=2)


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    dgtk, folder = arguments[0], pathlib.Path(arguments[1])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "scene.json").write_text(json.dumps(two_cameras(5)), encoding="utf-8")
    data = folder / "data"
    subprocess.run([dgtk, "render", folder / "scene.json", "-o", data, "--layers", "color,position,ldi",
                    "--quiet"], check=True)
    inside = seen_by_source(data)
    truth = read(data / "target" / "color" / "000000.png").astype(int)
    panels = []
    for layers, name in (("1", "depth map"), ("0", "layered depth image")):
        subprocess.run([dgtk, "warp", data / "source" / "ldi" / "000000.ldi", "--to", "target", "--layers", layers, "-o",
                        folder / f"{layers}.png", "--mask", folder / f"{layers}_holes.png"], check=True)
        picture = read(folder / f"{layers}.png").copy()
        holes = read(folder / f"{layers}_holes.png")[..., 0] == 255
        error = np.abs(picture - truth).max(axis=2)[~holes]
        print(f"{name}: {holes.sum()} holes ({100 * holes.mean():.2f} %), {(holes & inside).sum()} within the source's field "
              f"of view; elsewhere at most 8 of 255 off the rendering at {100 * (error <= 8).mean():.1f} % of the pixels")
        picture[holes] = HOLE
        panels.append(picture)
    panels.append(truth.astype(np.uint8))
    gap = np.full((truth.shape[0], GAP, 3), 255, np.uint8)
    wide = np.hstack([panels[0], gap, panels[1], gap, panels[2]])
    write(HERE / "novel_view.png", wide)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
