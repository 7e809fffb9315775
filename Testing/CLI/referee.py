# SPDX-License-Identifier: BSD-3-Clause
"""The dataset of test_referee.py, and what plants an error in it."""
import json
import os
import subprocess

import numpy as np

from dataset_edits import Edits
from harness import DGTK, SOURCE

MODELS = os.path.join(SOURCE, "Data", "Models")
PINHOLE = {"width": 96, "height": 72, "near": 0.1, "far": 100}


def model(name, file, kind, **more):
    return {"name": name, "model": os.path.join(MODELS, file), "class": kind, **more}


SCENE = {
    "version": 1, "units": "m", "background": [0.5, 0.6, 0.7],
    "dataset": {"name": "Refereed", "license": "CC0-1.0"},
    "classes": {"ground": {"id": 1, "supercategory": "place", "thing": False},
                "box": {"id": 2, "color": [200, 120, 40], "keypoints": ["lid", "side"], "skeleton": [[1, 2]]},
                "animal": 3, "plant": 4, "vessel": 5},
    "objects": [
        model("floor", "floor.ac", "ground"),
        model("crate", "crate.ac", "box", scale=[1.2, 1.2, 1.2], keypoints={"lid": [0.1, 1, 0.1], "side": [0.3, 0.4, 0.5]},
              position={"keys": [[0, [-0.9, 0.03, 0.3]], [1, [-0.86, 0.03, 0.33]]]},
              orientation={"keys": [[0, [0.98, 0, 0.2, 0]], [1, [0.975, 0, 0.222, 0]]]}),
        model("creature", "creature.md2", "animal", position=[0.75, 0.03, 0.2], scale=[0.02, 0.02, 0.02],
              orientation=[0.541675, -0.541675, -0.454519, -0.454519], animation={"sequence": "walk"},
              keypoints={"vertex": 7}),
        model("grass", "grass.ac", "plant", position=[0.2, 0.03, 1.0]),
        model("vase", "vase.pov", "vessel", position=[-0.9, 1.23, 0.3])],
    "lights": [{"name": "sun", "kind": "directional", "position": [-6, 10, 8], "target": [0, 0, 0],
                "diffuse": [0.9, 0.9, 0.9]}],
    "cameras": [
        {"name": "left", "fovY": 44, "eye": [-0.06, 1.4, 4], "lookAt": [-0.06, 0.6, 0], **PINHOLE},
        {"name": "right", "fovY": 44, "eye": [0.06, 1.4, 4], "lookAt": [0.06, 0.6, 0], **PINHOLE},
        {"name": "matrix", "K": [[90, 3, 40], [0, 85, 30], [0, 0, 1]], "eye": [1.5, 1.8, 3.5], "lookAt": [0, 0.5, 0],
         **PINHOLE},
        {"name": "parallel", "model": "orthographic", "viewHeight": 3.2, "eye": [2, 3, 5], "lookAt": [0, 0.5, 0], **PINHOLE},
        {"name": "moving", "fovY": 50, "position": {"keys": [[0, [-1, 1.2, 4]], [1, [-0.97, 1.21, 3.97]]]},
         "orientation": [0.05, 0.99875, 0, 0], "lens": {"aperture": 0.02, "focus": 4, "exposures": 4}, **PINHOLE}]}
OPTIONS = ["--layers", "all", "--models", "--frames", "0:1", "--samples", "2", "--matte", "crate", "--points-step", "2", "--tracks-step", "6",
           "--tracks-every", "2", "--pairs",
           "left:right,left:matrix,parallel:moving,moving:left+1"]
# Inside a box there is no background, which PNG could not say of parts and triangles; with one sample a pixel, colour is
# that of the first record of ldi.
CLOSED = {**SCENE, "objects": [model("box", "crate.ac", "box", scale=[6, 4, 6], position=[0, -1, 2]), *SCENE["objects"][1:]],
          "cameras": SCENE["cameras"][:1]}
CLOSED_OPTIONS = ["--layers", "color,depth,ldi,objects,parts,triangles", "--frames", "0", "--parts-format", "png,npy",
                  "--triangles-format", "png,npy", "--objects-format", "png,npy"]
# Only their hashes are known to be right: colour and noise have no second renderer, pictures of depth are for people.
NOT_CHECKED = ("color", "color_noisy", "color_sharp", "depth png", "depth_noisy", "ldi exr", "pov", "tiles")
# Rows whose values are left open more often than 2 in 1000, and why.
OPEN = {("forward-backward", "flow"): 0.5,  # no four pixels on one triangle
        ("ldi", "surfaces"): 4e-3,  # every surface along the ray may have an edge there
        ("alpha", "samples"): 0.05, ("alpha", "nearest"): 0.05, ("matting", "matting_crate alpha"): 0.05,  # divided pixels
        ("rgba", "color_rgba alpha"): 0.05, ("rgba", "color_rgba"): 0.05,
        ("points", "colors"): 0.05}  # borders of texels


def all_formats():
    """--X-format with every format that X has; parts and triangles cannot be PNG where there is background."""
    listing = subprocess.run([DGTK, "list", "layers"], capture_output=True, text=True, check=True).stdout
    for line in listing.splitlines():
        name, formats = line.split()[:2]
        if "," in formats and name not in ("parts", "triangles"):
            yield from (f"--{name}-format", formats)


class Sound(Edits):
    """The dataset as rendered, and pixels of it where nothing but an edit can be to blame."""

    def __init__(self, root):
        super().__init__(root)
        self.used = {}

    def ids(self, camera, frame):
        parts = [self.load(f"{camera}/{layer}/{frame:06d}.npy")[..., 0].astype(np.int64)
                 for layer in ("objects", "parts", "triangles")]
        return np.stack(parts, axis=-1)

    def object(self, number):
        with open(self.path("objects.json"), encoding="utf-8") as file:
            return json.load(file)["objects"][number]

    def interior(self, camera, frame):
        """Pixels whose neighbours, two all around, show the same triangle."""
        ids = self.ids(camera, frame)
        height, width, _ = ids.shape
        around = np.pad(ids, ((2, 2), (2, 2), (0, 0)), mode="edge")
        alike = [(around[:, 2:2 + width] == around[:, x:x + width]).all(axis=-1) for x in range(5)]
        rows, inside = np.logical_and.reduce(alike), ids[..., 0] > 0
        for y in range(5):
            inside &= rows[y:y + height] & (ids == around[y:y + height, 2:2 + width]).all(axis=-1)
        return inside

    def spot(self, camera, frame, where=None):
        """The next unused pixel (x, y) inside a triangle, of those that `where`, rows x columns, allows."""
        inside = self.interior(camera, frame)
        rows, columns = np.nonzero(inside if where is None else inside & where)
        used = self.used.setdefault((camera, frame), set())
        for x, y in zip(columns.tolist(), rows.tolist()):
            if all(abs(x - i) > 4 or abs(y - j) > 4 for i, j in used):
                used.add((x, y))
                return x, y
        raise AssertionError(f"no pixel left of {camera} {frame}")


class Plant:
    """One planted error. `edit(data, factor)` plants it and returns the file and pixel that must be named; factor is 10 or
    0.1 of the tolerance. `also`: rows that see it by their nature, with the reason. `bad`: values that are then wrong.
    `small`: whether a tenth of the tolerance can be planted. `shown`: the tolerance of the report, where a row says only
    whether values are right."""

    def __init__(self, check, layer, tolerance, edit, also=None, bad=1, small=None, shown=None):
        self.row = (check, layer)
        self.tolerance = tolerance
        self.shown = tolerance if shown is None else shown
        self.edit = edit
        self.also = also or {}
        self.bad = bad
        self.small = tolerance > 0 if small is None else small

    def rows(self):
        return {self.row, *self.also}


def by(file, step, camera="left", frame=0, channel=0, where=None):
    """Adds step(value, factor) to a channel of a pixel of a file of a camera and frame, "depth.npy"."""
    layer, kind = file.rsplit(".", 1)
    name = f"{camera}/{layer}/{frame:06d}.{kind}"

    def edit(data, factor):
        def moved(values):
            values[channel] = values[channel] + step(float(values[channel]), factor)
            return values

        return data.change(name, data.spot(camera, frame, where(data) if where else None), moved)

    return edit


def part(tolerance):
    return lambda value, factor: value * tolerance * factor


def absolute(tolerance):
    return lambda value, factor: tolerance * factor


def ulps(value, _):
    """Two units in the last place of float32: what is beyond the file's own rounding."""
    narrow = np.float32(value)
    return float(np.nextafter(np.nextafter(narrow, np.float32(np.inf)), np.float32(np.inf))) - float(narrow)


def other(value, _):
    return 1 if value == 0 else -1


def turned_around(name):
    """The other side, which only a side that is known can betray."""
    return lambda data, _: data.change(name, data.spot("right", 0), lambda values: -values)


def background(name):
    """A number in all channels of a pixel without a surface."""
    def edit(data, _):
        rows, columns = np.nonzero(data.load("left/objects/000000.npy")[..., 0] == 0)
        return data.change(name, (int(columns[0]), int(rows[0])), lambda values: np.full_like(values, 0.5))

    return edit
