# SPDX-License-Identifier: BSD-3-Clause
"""The referee is refereed: of every row of the report of dgtk verify an error of 10 times its tolerance is planted and must
be named by that row and no other, and one of a tenth of it must pass.

One dataset of all layers, all formats and all kinds of cameras is rendered once; errors of different rows are planted in it
together, each at a pixel of its own, so that a few runs of verify judge them all."""
import itertools
import json
import os
import shutil
import struct
import subprocess
import tempfile

import numpy as np

from dataset_edits import Edits
from harness import DGTK, SOURCE, Case, main

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
        inside = ids[..., 0] > 0
        for y, x in itertools.product(range(5), repeat=2):
            inside &= (ids == around[y:y + height, x:x + width]).all(axis=-1)
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


def geometry():
    # Channels, and what a residual of 1 is worth: positions are compared with their distance from the camera or the world's
    # origin, texture coordinates with the largest of their triangle.
    layers = {"distance": (1, None), "inversedepth": (1, None), "position": (3, 4.5), "objectcoords": (3, 4.5),
              "shadingnormal": (3, 1), "uv": (2, 2), "barycentrics": (3, 1)}
    for layer, (channels, unit) in layers.items():
        step = part if unit is None else lambda tolerance, unit=unit: absolute(tolerance * unit)
        also = {}
        if layer == "position":
            also = {("calibration", "cv::projectPoints"): "projects positions", ("calibration", "thesis"): "likewise"}
        yield Plant("geometry", layer, 1e-9, by(f"{layer}.npy", step(1e-9)), also, small=not also)
        for kind in ("exr", "pfm") if channels == 1 else ("exr",):
            narrow = 1e-6 if layer in ("objectcoords", "barycentrics") else 1e-7
            yield Plant("geometry", f"{layer}.{kind}", narrow, by(f"{layer}.{kind}", step(narrow)), small=False)
    for kind in ("npy", "exr"):
        yield Plant("geometry", "normal", 1e-7, by(f"normal.{kind}", absolute(1e-7)), small=False)
    for layer, tolerance in (("normal", 1e-7), ("shadingnormal", 1e-9)):
        yield Plant("geometry", layer, tolerance, turned_around(f"right/{layer}/000000.npy"), small=False)
    # A surface where there is none.
    for layer in ("distance", "inversedepth", "position", "normal"):
        yield Plant("geometry", layer, 1e-7 if layer == "normal" else 1e-9, background(f"left/{layer}/000000.npy"), small=False,
                    also={("calibration", "cv::projectPoints"): "projects positions",
                          ("calibration", "thesis"): "likewise"} if layer == "position" else None)
    # What is too small as well as what is too large.
    yield Plant("geometry", "distance", 1e-9, by("distance.npy", part(-1e-9), "right"))
    yield Plant("geometry", "inversedepth", 1e-9, by("inversedepth.npy", part(-1e-9), "parallel"))


def number(kind, at, step, factor):
    def edit(data):
        struct.pack_into(kind, data, at, struct.unpack_from(kind, data, at)[0] + step * factor)

    return edit


def depths():
    yield Plant("depth", "depth", 1e-9, by("depth.npy", part(1e-9), frame=1),
                {("ldi", "first = depth"): "compares the same numbers"}, small=False)
    yield Plant("depth", "depth", 1e-9, by("depth.dgd", part(1e-9)))
    for kind in ("exr", "pfm"):
        yield Plant("depth", f"depth.{kind}", 1e-7, by(f"depth.{kind}", part(1e-7)), small=False)
    # The first entry of either matrix; the largest of the projection is some 3, that of the pose some 5.
    for name, at, unit in (("right/depth/000000.dgd", 0, 3e-12), ("moving/depth/000001.dgd", 128, 5e-12)):
        yield Plant("depth", "depth.dgd", 1e-12,
                    lambda data, factor, n=name, a=at, u=unit: data.bytes(n, number("<d", a, u, factor)))


def labels():
    for layer, kinds in (("objects", ("npy", "png", "ppm")), ("parts", ("npy",)), ("triangles", ("npy",))):
        for kind in kinds:
            also = {}
            if (layer, kind) == ("objects", "npy"):
                also = {("partition", "classes"): "the class of another object",
                        ("partition", "visible within amodal"): "another object's mask", ("boxes", "masks"): "counts pixels"}
            channel = 2 if kind == "ppm" else 0
            yield Plant("objects", layer, 0, by(f"{layer}.{kind}", other, "right", 1, channel), also)
    for kind in ("npy", "png"):
        yield Plant("partition", "classes", 0, by(f"classes.{kind}", other))
    yield Plant("partition", "objects", 0, by("objects.npy", lambda *_: 100, "parallel", 1),
                {("objects", "objects"): "not what Embree meets", ("partition", "classes"): "the class of no object",
                 ("partition", "visible within amodal"): "the mask of no object", ("boxes", "masks"): "counts pixels"})
    for kind in ("npy", "png"):
        yield Plant("edges", "edges", 0, by(f"edges.{kind}", lambda value, _: 128 - value))
    yield Plant("edges", "edges", 0, silhouette_lost)


def silhouette_lost(data, _):
    """A pixel beside another object that is marked as one in the middle of a surface."""
    image = data.load("matrix/edges/000000.png")[..., 0]
    rows, columns = np.nonzero(image == 255)
    return data.change("matrix/edges/000000.png", (int(columns[0]), int(rows[0])), lambda values: values * 0)


def record_of(data, camera, frame):
    with open(data.path("cameras.json"), encoding="utf-8") as file:
        cameras = json.load(file)["cameras"]
    return next({key: np.array(c[key]) for key in ("K", "R", "t")} for c in cameras if (c["name"], c["frame"]) == (camera, frame))


def along_epipolar_line(data, first, second, pixel):
    """Unit direction, in the second image, of the ray of a pixel of the first (pinholes of frame 0)."""
    a, b = record_of(data, first, 0), record_of(data, second, 0)
    ray = np.linalg.inv(a["K"]) @ [pixel[0] + 0.5, pixel[1] + 0.5, 1]
    places = []
    for depth in (3, 6):
        place = b["K"] @ (b["R"] @ (a["R"].T @ (depth * ray - a["t"])) + b["t"])
        places.append(place[:2] / place[2])
    direction = places[1] - places[0]
    return direction / np.linalg.norm(direction)


def beside(folder, tolerance, across):
    """Moves a visible correspondence along its epipolar line, or across it, in pixels."""
    camera, layer = folder.split("/")
    name, target = f"{folder}/000000.npy", layer.split("_")[1]

    def edit(data, factor):
        visible = data.load(f"{folder}/000000.png")[..., 0] == 1
        pixel = data.spot(camera, 0, visible)
        step = along_epipolar_line(data, camera, target, pixel)
        step = np.array([-step[1], step[0]]) if across else step
        return data.change(name, pixel, lambda values: values + tolerance * factor * step)

    return edit


def hidden_instead(folder, frame=0):
    """Visible becomes hidden by another object."""
    camera = folder.split("/")[0]
    name = f"{folder}/{frame:06d}.png"

    def edit(data, _):
        visible = data.load(name)[..., 0] == 1
        return data.change(name, data.spot(camera, frame, visible), lambda values: values + 1)

    return edit


def flow_that_returns(data):
    """Pixels of the moving camera whose target at the next frame is well inside the same triangle."""
    now, then = data.ids("moving", 0), data.ids("moving", 1)
    inside = data.interior("moving", 0) & (now == then).all(axis=-1) & data.interior("moving", 1)
    return inside & (np.abs(data.load("moving/flow_forward/000000.npy")).max(axis=-1) < 1.5) & (
        data.load("moving/flow_forward/000000.png")[..., 0] == 1)


def pairs():
    same = {("motion", "flow_forward"): "compares the same numbers with the surfaces"}
    # Out of the image there is no way back.
    yield Plant("motion", "flow_forward", 1e-9,
                by("flow_forward.npy", absolute(1e-9), "moving",
                   where=of_class("moving/flow_forward", 4)))
    yield Plant("forward-backward", "flow", 1e-9, by("flow_forward.npy", absolute(1e-9), "moving", where=flow_that_returns), same)
    yield Plant("motion", "flow_backward", 1e-9, by("flow_backward.npy", absolute(1e-9), "matrix", 1),
                {("forward-backward", "flow"): "the loops through this pixel do not close"}, small=False)
    # The residual is in pixels: f / depth of the left camera is some 20 a scene unit.
    yield Plant("motion", "sceneflow", 1e-9, by("sceneflow.npy", absolute(1e-9 / 20)))
    for camera in ("left", "right"):
        yield Plant("motion", "disparity", 1e-9, by("disparity.npy", absolute(1e-9), camera))
        yield Plant("motion", "disparity_forward", 1e-9, by("disparity_forward.npy", absolute(1e-9), camera))
        yield Plant("motion", "disparity_backward", 1e-9, by("disparity_backward.npy", absolute(1e-9), camera, 1))
    for layer, kinds, frame in (("flow_forward", ("flo", "exr"), 0), ("flow_backward", ("flo", "exr"), 1),
                                ("disparity", ("pfm", "exr"), 0), ("disparity_forward", ("pfm", "exr"), 0),
                                ("disparity_backward", ("pfm", "exr"), 1), ("sceneflow", ("exr",), 0)):
        for kind in kinds:
            camera = "left" if layer.startswith("disparity") else "moving"
            yield Plant("motion", layer, 1e-9, by(f"{layer}.{kind}", ulps, camera, frame,
                                                  where=moving_pixels(layer, kind, frame)), small=False)
    numbers = "compares the same numbers with the surfaces"
    for layer in ("correspondence_right", "correspondence_matrix"):
        yield Plant("motion", layer, 1e-9, by(f"{layer}.npy", absolute(1e-9), where=of_class(f"left/{layer}", 4)))
        yield Plant("epipolar", layer, 1e-9, beside(f"left/{layer}", 1e-9, True), {("motion", layer): numbers})
    # A part of the scene's size, some 9, in pixels: f b / z^2 of these pairs.
    for layer, pixels in (("correspondence_right", 0.4), ("correspondence_matrix", 5)):
        yield Plant("triangulation", layer, 1e-10, beside(f"left/{layer}", 9e-10 * pixels, False), {("motion", layer): numbers})
    yield Plant("epipolar", "correspondence_moving", 1e-9,
                by("correspondence_moving.npy", absolute(1e-9), "parallel", channel=1,
                   where=of_class("parallel/correspondence_moving", 1)),
                {("motion", "correspondence_moving"): numbers})
    yield Plant("motion", "correspondence_moving", 1e-9,
                by("correspondence_moving.npy", absolute(1e-9), "parallel", where=of_class("parallel/correspondence_moving", 4)))
    yield Plant("motion", "correspondence_left+1", 1e-9, by("correspondence_left+1.npy", absolute(1e-9), "moving"))
    for folder, frame in (("left/flow_forward", 0), ("left/flow_backward", 1), ("left/disparity", 0),
                          ("left/disparity_forward", 0), ("right/disparity_backward", 1),
                          ("left/correspondence_right", 0), ("left/correspondence_matrix", 0),
                          ("parallel/correspondence_moving", 0), ("moving/correspondence_left+1", 0)):
        yield Plant("class", folder.split("/")[1], 0, hidden_instead(folder, frame))


def of_class(folder, kind):
    return lambda data: data.load(f"{folder}/000000.png")[..., 0] == kind


def moving_pixels(layer, kind, frame):
    """A displacement of 0 has no last digit."""
    camera = "left" if layer.startswith("disparity") else "moving"
    return lambda data: np.abs(data.load(f"{camera}/{layer}/{frame:06d}.{kind}")[..., 0]) > 1e-4


def calibrations():
    # A pixel is some z / f = 4.5 / 90 scene units, a hundredth of what the check of positions allows. The camera with a
    # skew is not OpenCV's.
    yield Plant("calibration", "cv::projectPoints", 1e-9, by("position.npy", absolute(5e-11), "right"),
                {("calibration", "thesis"): "projects the same point"})
    yield Plant("calibration", "thesis", 1e-9,
                lambda data, factor: ("matrix/calibration/000000.txt",
                                      by("position.npy", absolute(5e-11), "matrix")(data, factor)[1]))
    # A number of K is some 2, one of t some 5; the viewport is of whole numbers.
    for camera, line, column, step in (("left", 1, 0, 3e-9), ("right", 7, 3, 6e-9), ("parallel", 9, 1, 0.1)):
        yield Plant("calibration", "calibration", 1e-9, entry_of_calibration(camera, line, column, step),
                    {("calibration", "thesis"): "projects by this file"}, small=False)


def entry_of_calibration(camera, line, column, step):
    """Adds to a number of a line of the text."""
    name = f"{camera}/calibration/000000.txt"

    def edit(data, factor):
        def text(content):
            lines = bytes(content).decode().split("\n")
            numbers = lines[line].split(" ")
            value = float(numbers[column]) + step * factor
            numbers[column] = repr(int(value) if line == 9 else value)
            lines[line] = " ".join(numbers)
            return "\n".join(lines).encode()

        return data.bytes(name, text)[0], None

    return edit


def layered():
    depths_of = lambda data: data.layers_of("right/ldi/000000.ldi")
    ldi = "right/ldi/000000.ldi"

    def hidden(change):
        def edit(data, factor):
            return data.layered(ldi, data.spot("right", 0, depths_of(data) >= 3), lambda records: change(records, factor))

        return edit

    # What an LDI is for: a hidden surface that is missing, displaced or invented, the first one being right.
    yield Plant("ldi", "surfaces", 0, hidden(lambda records, _: records[:1] + records[2:]))
    yield Plant("ldi", "surfaces", 0, hidden(lambda records, _: records[:-1]))
    yield Plant("ldi", "surfaces", 0, hidden(lambda records, _: records + [[*records[-1][:4], 90.0, 0]]))
    # Where the floor's plane would be met, far from where the floor ends.
    yield Plant("ldi", "surfaces", 0, beyond_the_floor)
    yield Plant("ldi", "surfaces", 1e-9, hidden(lambda r, f: r[:-1] + [[*r[-1][:4], r[-1][4] * (1 + 1e-9 * f), r[-1][5]]]),
                shown=0)
    yield Plant("ldi", "order", 0, hidden(lambda records, _: [records[0], records[2], records[1], *records[3:]]))
    # The last digit of the first record.
    yield Plant("ldi", "first = depth", 0,
                hidden(lambda r, _: [[*r[0][:4], float(np.nextafter(r[0][4], 0)), r[0][5]], *r[1:]]))


def beyond_the_floor(data, _):
    """A record more behind the others, in the plane of the boards (y = 0, up to 3 from the middle), which end before."""
    camera = record_of(data, "right", 0)
    layers = data.layers_of("right/ldi/000000.ldi")
    v, u = np.indices(layers.shape) + 0.5
    rays = np.stack([u, v, np.ones_like(u)], axis=-1) @ np.linalg.inv(camera["K"]).T @ camera["R"]
    centre = -camera["R"].T @ camera["t"]
    depth = -centre[1] / rays[..., 1]
    place = centre + depth[..., None] * rays
    x, y = data.spot("right", 0, (layers > 0) & (depth > 8) & (depth < 90) & (np.abs(place[..., 2]) > 3.5))
    return data.layered("right/ldi/000000.ldi", (x, y), lambda records: records + [[*records[-1][:4], depth[y, x], 0]])


def divided(data, camera, frame=0):
    """Pixels (x, y) of two objects and no background, with the ids of both by their shares."""
    ranks = data.load(f"{camera}/coverage/{frame:06d}.exr")  # a, b, g, r of the first two ranks, then of the next
    alpha = data.load(f"{camera}/alpha/{frame:06d}.png")
    whole = ranks[..., 2] == 1
    known = dict(zip(ranks[..., 3][whole].tolist(), alpha[..., 2][whole].tolist()))
    for y, x in zip(*np.nonzero((ranks[..., 0] > 0) & (ranks[..., 6] == 0))):
        first, second = (known.get(float(ranks[y, x, c]), 0) for c in (3, 1))
        if first and second:
            yield (int(x), int(y)), first, second


def covered():
    coverage, alpha = "left/coverage/000000.exr", "left/alpha/000000.png"

    def most_of_one(data):
        """Alpha of a half is rounded by all that it may be; of three quarters there is room."""
        ranks = data.load(coverage)
        return next((x, y) for (x, y), _, _ in divided(data, "left") if ranks[y, x, 2] > 0.7)

    def shares(first, second):
        def edit(data, factor):
            pixel = most_of_one(data)
            step = np.zeros(data.load(coverage).shape[2], np.float32)
            step[2], step[0] = first * factor, second * factor
            return data.change(coverage, pixel, lambda values: values + step)

        return edit

    yield Plant("alpha", "coverage", 1e-7, shares(1e-7, 0), {("alpha", "samples"): "one share is wrong"}, small=False)
    def swapped(data, _):
        """The smaller share first."""
        return data.change(coverage, most_of_one(data), lambda v: v[[2, 3, 0, 1, *range(4, len(v))]])

    def unknown(data, _):
        """The object of the smaller share becomes one that there is not."""
        alpha_image, ranks = data.load(alpha), data.load(coverage)
        for (x, y), first, _ in divided(data, "left"):
            if alpha_image[y, x, 2] == first and ranks[y, x, 2] > 0.7:
                return data.change(coverage, (x, y), lambda v: np.where(np.arange(len(v)) == 1, np.float32(1.5), v))

    yield Plant("alpha", "coverage", 1e-7, swapped, small=False)
    yield Plant("alpha", "coverage", 1e-7, unknown, {("alpha", "samples"): "nothing is left for the true object"}, small=False)
    yield Plant("alpha", "samples", 1e-7, shares(1e-7, -1e-7), bad=2, small=False)
    yield Plant("alpha", "alpha", 1e-7,
                lambda data, _: data.change(alpha, most_of_one(data), lambda v: v + [0, 0, 0, 2]),
                {("alpha", "nearest"): "the same share counted anew"}, small=False)

    def other_object(data, _):
        """The object behind, with its own share."""
        image, ranks = data.load("right/alpha/000000.png"), data.load("right/coverage/000000.exr")
        for (x, y), first, second in divided(data, "right"):
            shown = image[y, x, 2]
            share = ranks[y, x, 2 if shown == second else 0]
            value = [0, 0, first if shown == second else second, int(255 * share + 0.5)]
            return data.change("right/alpha/000000.png", (x, y), lambda _: np.array(value))

    yield Plant("alpha", "nearest", 1e-7, other_object, small=False)


def pictures_without_background():
    name = "right/color_rgba/000000.png"

    def share(data, _):
        """A pixel that is wholly covered, of those that are looked at."""
        rows, columns = np.nonzero(data.interior("right", 0)[::4, ::4])
        return data.change(name, (4 * int(columns[0]), 4 * int(rows[0])), lambda v: v - [0, 0, 0, 1])

    yield Plant("rgba", "color_rgba alpha", 1e-7, share, small=False)
    yield Plant("rgba", "color_rgba", 2, lambda data, _: data.change(name, data.spot("right", 0), lambda v: v + np.where(v < 128, [4, 0, 0, 0], [-4, 0, 0, 0])), small=False)


def mattes():
    folder = "left/matting_crate/000000"

    def first(data, name, value):
        rows, columns = np.nonzero((data.load(f"{folder}_{name}.png")[..., 0] == value))
        return int(columns[len(rows) // 2]), int(rows[len(rows) // 2])

    yield Plant("matting", "matting_crate", 0,
                lambda data, _: data.change(f"{folder}_composite.png", data.spot("left", 0), lambda v: v + [0, 1, 0]))

    def share(data, _):
        """One step of alpha, and the composite that follows from it."""
        alpha = data.load(f"{folder}_alpha.png")[..., 0]
        rows, columns = np.nonzero((alpha > 0) & (alpha < 65535))
        x, y = int(columns[len(rows) // 2]), int(rows[len(rows) // 2])
        a = alpha[y, x] + 1
        front, back = (data.load(f"{folder}_{name}.png")[y, x] for name in ("foreground", "background"))
        data.change(f"{folder}_composite.png", (x, y), lambda _: (a * front + (65535 - a) * back + 32767) // 65535)
        return data.change(f"{folder}_alpha.png", (x, y), lambda _: np.array([a]))

    yield Plant("matting", "matting_crate alpha", 1e-7, share, small=False)
    for was, now in ((128, 255), (0, 128), (255, 128)):
        yield Plant("matting", "matting_crate trimap", 0,
                    lambda data, _, w=was, n=now: data.change(f"{folder}_trimap.png", first(data, "trimap", w),
                                                              lambda v: v * 0 + n))


def boxes():
    def names(document):
        document["objects"][1]["class"] = "plant"
        document["objects"][2]["name"] = "beast"
        del document["objects"][4]

    yield Plant("boxes", "names", 0, lambda data, _: data.document("left/boxes/000001.json", names), bad=3)

    def masks(document):
        objects = document["objects"]
        objects[0]["pixels_visible"] += 1
        objects[0]["visible_fraction"] = objects[0]["pixels_visible"] / objects[0]["pixels_amodal"]
        objects[1]["pixels_amodal"] += 1
        objects[1]["visible_fraction"] = objects[1]["pixels_visible"] / objects[1]["pixels_amodal"]
        objects[2]["box_visible"][2] += 1
        objects[3]["box_amodal"][1] -= 1
        objects[4]["visible_fraction"] *= 1 - 1e-12

    yield Plant("boxes", "masks", 0, lambda data, _: data.document("moving/boxes/000000.json", masks),
                {("boxes", "whole"): "amodal pixels are whole ones"}, bad=5)

    def whole(document):
        objects = document["objects"]
        objects[0]["pixels_whole"] -= 50  # the floor reaches beyond the picture, and some pixels of its edge are open
        objects[0]["box_whole"][2] += 1
        objects[1]["pixels_whole"] += 1
        objects[2]["box_whole"][1] -= 1

    for camera in ("left", "right", "parallel"):
        yield Plant("boxes", "whole", 0, lambda data, _, c=camera: data.document(f"{c}/boxes/000000.json", whole), bad=4)

    def projected(factor):
        def edit(document):
            document["objects"][1]["box_projected"][0] += 1e-9 * factor

        return edit

    yield Plant("boxes", "projected", 1e-9, lambda data, factor: data.document("right/boxes/000001.json", projected(factor)))

    def pose(factor):
        """The floor's axes are the camera's, but for a turn about x: its first number is alone in its row and column, and
        is seen in R^T R and in R diag(scale)."""
        def edit(document):
            objects, step = document["objects"], 1e-12 * factor
            objects[0]["R"][0][0] += step
            objects[1]["matrix"][2][3] += 5 * step
            objects[2]["t"][2] += 5 * step
            objects[4]["box3d"][3][2] += 5 * step

        return edit

    yield Plant("boxes", "pose", 1e-12, lambda data, factor: data.document("right/boxes/000000.json", pose(factor)), bad=5)

    def scale(factor):
        def edit(document):
            document["objects"][0]["scale"][0] += 1e-12 * factor

        return edit

    yield Plant("boxes", "pose", 1e-12, lambda data, factor: data.document("left/boxes/000000.json", scale(factor)))


def keypoints():
    def places(factor):
        def edit(document):
            lid, side = document["objects"][1]["keypoints"]
            lid["u"] += 1e-9 * factor
            side["x"][2] += 5e-9 * factor

        return edit

    yield Plant("keypoints", "places", 1e-9, lambda data, factor: data.document("right/boxes/000001.json", places(factor)), bad=2)

    def names(document):
        document["objects"][2]["keypoints"][0]["name"] = "nose"
        document["objects"][1]["keypoints"][0]["u"] = document["objects"][1]["keypoints"][0]["v"] = None
        document["objects"][1]["keypoints"][1]["visibility"] = 5

    yield Plant("keypoints", "places", 1e-9, lambda data, _: data.document("parallel/boxes/000000.json", names), bad=2, small=False,
                also={("keypoints", "visible"): "a class of its own"})

    def hidden(document):
        document["objects"][1]["keypoints"][0]["visibility"] = 2

    yield Plant("keypoints", "visible", 0, lambda data, _: data.document("left/boxes/000000.json", hidden))


def metadata():
    def manifest(data, _):
        with open(data.path("manifest.json"), encoding="utf-8") as file:
            document = json.load(file)
        document["metres_per_unit"], document["fps"] = 0.01, 24.0
        document["info"]["license"] = "none"
        document["info"]["author"] = "nobody"
        with open(data.path("manifest.json"), "w", encoding="utf-8") as file:
            json.dump(document, file)
        return "manifest.json", None

    yield Plant("metadata", "manifest", 0, manifest, bad=4)

    def classes(document):
        document["classes"][0]["thing"] = True
        document["classes"][1]["color"][2] += 1

    yield Plant("metadata", "classes", 0, lambda data, _: data.document("objects.json", classes), bad=2)

    def flags(document):
        document["objects"][0]["static"] = False
        document["objects"][1]["static"] = True
        document["objects"][2]["deforming"] = False

    yield Plant("metadata", "flags", 0, lambda data, _: data.document("objects.json", flags), bad=3)

    def identity(document):
        document["objects"][4]["geometry"] = document["objects"][3]["geometry"]

    yield Plant("metadata", "identity", 0, lambda data, _: data.document("objects.json", identity),
                also={("models", "shapes"): "its file has another name"})


def poses():
    def edit(factor):
        """The floor is where the world is: its first number of R is seen in R^T R and in R diag(scale)."""
        def change(document):
            floor, crate, creature = document["poses"][:3]
            step = 1e-12 * factor
            floor["R"][0][0] += step
            crate["matrix"][0][3] += step
            crate["scale"][1] += step
            creature["t"][0] += step
            if factor > 1:
                document["poses"][5]["visible"] = False

        return change

    yield Plant("poses", "poses", 1e-12, lambda data, factor: data.document("poses.json", edit(factor)), bad=0, small=True)
    yield Plant("poses", "poses", 1e-12, lambda data, _: data.document("poses.json", lambda d: d["poses"].pop(7)), bad=0, small=False)


def models():
    def edit(at, kind, step):
        def change(data, _):
            name = data.object(1)["geometry_file"]
            with open(data.path(name), "rb") as file:
                start = file.read().index(b"end_header\n") + 11

            def bytes_of(content):
                value = struct.unpack_from(kind, content, start + at)[0]
                struct.pack_into(kind, content, start + at, value + (-step if value > 128 else step))

            return data.bytes(name, bytes_of)

        return change

    yield Plant("models", "shapes", 0, edit(0, "<d", 1e-14), bad=0)
    yield Plant("models", "looks", 0.500001, edit(52, "B", 2), bad=0, small=False)


def masks():
    def run(camera, inside):
        """The floor's mask: a pixel of background inside, or one of the floor outside."""
        def edit(data, _):
            image = data.load(f"{camera}/objects/000000.npy")[..., 0]
            rows, columns = np.nonzero(image == (0 if inside else 1))
            x, y = (int(columns[5]), int(rows[5])) if inside else data.spot(camera, 0, image == 1)

            def flip(document):
                mask = document["masks"][0]
                flat = np.repeat(np.arange(len(mask["counts"])) % 2, mask["counts"])
                flat[x * image.shape[0] + y] = inside
                edges = np.nonzero(np.diff(flat))[0] + 1
                counts = np.diff([0, *edges, len(flat)]).tolist()
                mask["counts"] = counts if flat[0] == 0 else [0, *counts]

            return data.document(f"{camera}/amodal/000000.json", flip)[0], [x, y]

        return edit

    counts = {("boxes", "masks"): "counts pixels"}
    yield Plant("partition", "amodal", 0, run("parallel", 1), counts)
    yield Plant("partition", "visible within amodal", 0, run("matrix", 0),
                {**counts, ("partition", "amodal"): "a ray through the pixel meets the object"})


def clouds():
    name, ply = "points/000000.json", "points/000000.ply"

    def vertex(data, index):
        """Offset of a vertex of 47 bytes."""
        with open(data.path(ply), "rb") as file:
            return file.read().index(b"end_header\n") + 11 + 47 * index

    def points(data):
        with open(data.path(name), encoding="utf-8") as file:
            return json.load(file)

    def seen_twice(data, skip):
        return [i for i, point in enumerate(points(data)["points"]) if len(point["track"]) > 1][skip]

    def track(data, factor):
        index = seen_twice(data, 10)

        def shift(document):
            document["points"][index]["track"][-1][1] += 1e-8 * factor

        return data.document(name, shift)

    yield Plant("points", "tracks", 1e-8, track)

    def first_place(data, _):
        """Twice the tolerance off the pixel's centre, which does not move the depth by more than surfaces allow."""
        def shift(document):
            document["points"][seen_twice(data, 60)]["track"][0][1] += 2e-8

        return data.document("points/000001.json", shift)

    yield Plant("points", "tracks", 1e-8, first_place, bad=2, small=False)

    def surface(data, factor):
        """Farther along the ray of its first pixel, in both files."""
        document = points(data)
        index = seen_twice(data, 30)
        point = document["points"][index]
        camera = record_of(data, document["cameras"][point["track"][0][0]], 0)
        centre = -camera["R"].T @ camera["t"]
        moved = (centre + (1 + 1e-9 * factor) * (np.array(point["x"]) - centre)).tolist()

        def push(changed):
            changed["points"][index]["x"] = moved
            changed["points"][index]["track"] = point["track"][:1]

        data.bytes(ply, lambda content: struct.pack_into("<3d", content, vertex(data, index), *moved))
        return data.document(name, push)

    yield Plant("points", "surface", 1e-9, surface)

    def visible(data, _):
        """A camera that does not see the point, with the place where it would be."""
        document = points(data)
        for index, point in enumerate(document["points"]):
            seeing = {entry[0] for entry in point["track"]}
            for i, camera in enumerate(document["cameras"]):
                record = record_of(data, camera, 0)
                place = record["K"] @ (record["R"] @ point["x"] + record["t"])
                u, v = place[:2] / place[2]
                if i not in seeing and camera != "parallel" and place[2] > 0.1 and 0 < u < 96 and 0 < v < 72 and index > 150:
                    return data.document(
                        name, lambda changed, p=index, at=[i, u, v]: changed["points"][p]["track"].append(at))

    yield Plant("points", "visible", 0, visible)
    second = "points/000001.ply"
    for row, tolerance, kind, at, step in (("ply", 0, "<d", 0, 1e-14), ("normals", 1e-7, "<f", 24, 1e-7),
                                           ("colors", 0.500001, "B", 36, 0.2)):
        def edit(data, factor, kind=kind, at=at, step=step):
            with open(data.path(second), "rb") as file:
                start = file.read().index(b"end_header\n") + 11 + 47 * (100 + at)
            whole = int if kind == "B" else float

            def change(content):
                value = struct.unpack_from(kind, content, start + at)[0]
                struct.pack_into(kind, content, start + at, whole(value + (-1 if value > 128 else 1) * step * factor))

            return data.bytes(second, change)

        yield Plant("points", row, tolerance, edit, small=False)


def tracks():
    name = "tracks/points.json"

    def points(data):
        with open(data.path(name), encoding="utf-8") as file:
            return json.load(file)["points"]

    def visible(data, camera, frame, skip):
        """A point that a view sees and that is another view's."""
        places = np.load(data.path(f"{camera}/tracks/{frame:06d}.npy"))
        return [i for i, point in enumerate(points(data))
                if places[i, 2] == 1 and (point["camera"], point["frame"]) != (camera, frame)][skip]

    def value(camera, frame, column, edit, skip):
        def plant(data, factor):
            file = f"{camera}/tracks/{frame:06d}.npy"
            index = visible(data, camera, frame, skip)
            return data.change(file, (column, index), lambda v: v + edit(factor))[0], None

        return plant

    def field(skip, edit):
        def plant(data, factor):
            return data.document(name, lambda document: edit(document["points"][skip], factor))

        return plant

    yield Plant("tracks", "places", 1e-8, value("left", 1, 0, lambda factor: 1e-8 * factor, 3))
    yield Plant("tracks", "places", 1e-8, value("parallel", 1, 1, lambda factor: 1e-8 * factor, 3))
    yield Plant("tracks", "places", 1e-8, value("left", 1, 1, lambda factor: float("nan"), 6), small=False)
    yield Plant("tracks", "classes", 0, value("right", 1, 2, lambda factor: 1, 5))
    yield Plant("tracks", "classes", 0, value("moving", 1, 2, lambda factor: 2, 5))
    yield Plant("tracks", "classes", 0, value("moving", 1, 2, lambda factor: 0.5, 9))

    def move(point, factor):
        point["x"] = [x * (1 + 1e-9 * factor) for x in point["x"]]

    def weigh(point, factor):
        point["barycentric"][0] += 1e-9 * factor

    def flip(point, _):
        point["static"] = not point["static"]

    def paint(point, factor):
        point["color"][1] += round(0.2 * factor) * (-1 if point["color"][1] > 128 else 1)

    yield Plant("tracks", "points", 1e-9, field(4, move))
    yield Plant("tracks", "points", 1e-9, field(7, weigh))
    yield Plant("tracks", "static", 0, field(11, flip), bad=2)  # at both frames
    yield Plant("tracks", "colors", 0.500001, field(13, paint), small=False)

    def of_kind(data, static):
        return next(i for i, point in enumerate(points(data)) if point["static"] == static)

    def flip_moving(data, _):
        return data.document(name, lambda document: flip(document["points"][of_kind(data, False)], 0))

    yield Plant("tracks", "static", 0, flip_moving, bad=2)

    def elsewhere(data, _):
        """As if another camera had sampled it: where it was sampled no point is left."""
        index = 20
        point = points(data)[index]
        file = f"{point['camera']}/tracks/000000.npy"
        u, v, _ = np.load(data.path(file))[index]
        data.document(name, lambda document: document["points"][index].update(camera="moving"))
        return file, [int(u), int(v)]

    def unsampled(data, _):
        """As if it had been sampled at a frame that is not."""
        index = len(points(data)) - 1
        camera = points(data)[index]["camera"]
        data.document(name, lambda document: document["points"][index].update(frame=1))
        u, v, _ = np.load(data.path(f"{camera}/tracks/000000.npy"))[index]
        return f"{camera}/tracks/000000.npy", [int(u), int(v)]

    for edit in (elsewhere, unsampled):
        yield Plant("tracks", "samples", 0, edit, bad=None)


def files():
    def flip(data, _):
        path = data.path("left/color_noisy/000000.png")
        with open(path, "r+b") as file:
            file.seek(200)
            byte = file.read(1)[0]
            file.seek(200)
            file.write(bytes([byte ^ 1]))
        return "left/color_noisy/000000.png", None

    def unlisted(data, _):
        with open(data.path("left/notes.txt"), "w", encoding="utf-8") as file:
            file.write("x")
        return "left/notes.txt", None

    def of_input(data, _):
        """As if the input had changed: its bytes are not those that the manifest saw."""
        with open(data.path("manifest.json"), encoding="utf-8") as file:
            manifest = json.load(file)
        manifest["inputs"][0]["sha256"] = "0" * 64
        with open(data.path("manifest.json"), "w", encoding="utf-8") as file:
            json.dump(manifest, file)
        return manifest["inputs"][0]["path"], None

    yield Plant("hashes", "files", 0, flip)
    yield Plant("hashes", "unlisted", 0, unlisted)
    yield Plant("hashes", "inputs", 0, of_input)


def cameras():
    """Documents. All else is derived from them and is wrong with them, so that these rows are asked for alone."""
    def records(factor):
        step = 1e-12 * factor

        def edit(document):
            cameras = document["cameras"]
            cameras[0]["K"][0][2] += step * 100
            cameras[1]["t"][2] += step * 5
            cameras[2]["near"] *= 1 + step
            cameras[3]["far"] *= 1 + step
            # A rotation still: by a small angle about the optical axis.
            turn = np.array([[1, -step, 0], [step, 1, 0], [0, 0, 1]])
            cameras[4]["R"] = (turn @ cameras[4]["R"]).tolist()
            cameras[5]["R"][0] = [number * (1 + step) for number in cameras[5]["R"][0]]
            if factor > 1:
                cameras[6]["model"] = "fisheye"
                cameras[7]["distortion"] = [0.1]

        return lambda data: data.document("cameras.json", edit)

    def objects(document):
        document["objects"][0]["triangles"] += 1
        document["objects"][1]["name"] = "box"
        document["objects"][2]["class"] = "beast"
        document["objects"][3]["id"] = 9
        document["objects"][4]["class_id"] = document["objects"][0]["class_id"]

    # The stretched axis of R is seen by comparison, and by R^T R.
    yield Plant("cameras", "cameras", 1e-12, lambda data, factor: records(factor)(data), bad=9)
    yield Plant("cameras", "objects", 0, lambda data, _: data.document("objects.json", objects), bad=6, small=False)


ALL = [plant for group in (files, depths, labels, calibrations, geometry, pairs, layered, covered, pictures_without_background, mattes, boxes,
                                metadata, poses, models, keypoints, masks, clouds, tracks)
       for plant in group()]


def closed():
    yield Plant("ldi", "first = color", 0,
                lambda data, _: data.layered("left/ldi/000000.ldi", data.spot("left", 0),
                                             lambda r: [[r[0][0] ^ 1, *r[0][1:]], *r[1:]]))
    for layer in ("objects", "parts", "triangles"):
        yield Plant("objects", layer, 0, by(f"{layer}.png", other))


class Referee(Case):
    @classmethod
    def setUpClass(cls):
        cls.folders = tempfile.mkdtemp(prefix="dgtk-referee-")
        cls.addClassCleanup(shutil.rmtree, cls.folders, ignore_errors=True)
        for name, scene, options in (("all", SCENE, [*OPTIONS, *all_formats()]), ("closed", CLOSED, CLOSED_OPTIONS)):
            path = os.path.join(cls.folders, f"{name}.json")
            with open(path, "w", encoding="utf-8") as file:
                json.dump(scene, file)
            done = subprocess.run([DGTK, "render", path, "-o", os.path.join(cls.folders, name), "--quiet", *options],
                                  capture_output=True, text=True)
            if done.returncode:
                raise RuntimeError(done.stderr)

    def verify(self, folder, *options, status):
        report = json.loads(self.dgtk("verify", folder, "--json", *options, status=status).stdout)
        return report, {(row["check"], row["layer"]): row for row in report["residuals"]}

    def copy(self, name, number):
        """A copy beside the rendered one: paths of models stay right."""
        target = os.path.join(self.folders, f"{name}{number}")
        shutil.copytree(os.path.join(self.folders, name), target)
        self.addCleanup(shutil.rmtree, target, ignore_errors=True)
        return Sound(target)

    def test_as_rendered(self):
        """Every row has its plants, with its tolerance; what is left open is bounded; what is not checked is listed."""
        for name, plants in (("all", [*ALL, *cameras()]), ("closed", [*ALL, *cameras(), *closed()])):
            report, rows = self.verify(os.path.join(self.folders, name), status=0)
            table = {plant.row: plant.shown for plant in plants}
            for key, row in rows.items():
                with self.subTest(row=key):
                    self.assertIn(key, set(table), "a row without a planted error")
                    self.assertEqual(row["tolerance"], table[key])
                    self.assertGreater(row["count"], 0)
                    self.assertLessEqual(row["skipped"], OPEN.get(key, 2e-3) * (row["count"] + row["skipped"]))
            if name == "all":
                self.assertEqual(set(rows), {plant.row for plant in plants})
                kinds = {f"{kind['layer']} {kind['format']}" for kind in report["not_checked"]}
                for kind in kinds:
                    self.assertTrue(kind.startswith(NOT_CHECKED), kind)
                for kind in NOT_CHECKED:
                    self.assertTrue(any(k.startswith(kind) for k in kinds), kind)
                self.assertNotIn("depth npy", kinds)

    def judge(self, name, plants):
        """Plants of different rows and files together; each row must name its own file and pixel, and no row another."""
        batches = []
        for plant in plants:
            free = [batch for batch in batches if not any(plant.rows() & other.rows() for other in batch)]
            (free[0] if free else batches.append([]) or batches[-1]).append(plant)
        for number, batch in enumerate(batches):
            data = self.copy(name, number)
            named = [(plant, *plant.edit(data, 10)) for plant in batch]
            data.accept()
            _, rows = self.verify(data.root, status=1)
            wrong = {key for key, row in rows.items() if row["breach"]}
            with self.subTest(batch=number):
                self.assertEqual(wrong, set().union(*(plant.rows() for plant in batch)))
            for plant, file, pixel in named:
                with self.subTest(row=plant.row, file=file):
                    row = rows[plant.row]
                    self.assertEqual(row.get("worst", {}).get("file"), file)
                    self.assertEqual(row["worst"]["pixel"], pixel)
                    self.assertEqual(row["bad"], plant.bad or row["bad"])

    def test_ten_times_the_tolerance_is_named(self):
        self.judge("all", ALL)

    def test_ten_times_the_tolerance_is_named_where_nothing_is_open(self):
        self.judge("closed", list(closed()))

    def test_neighbours_are_no_excuse(self):
        """Where an edge runs beside a pixel, not through its centre, the surface on its other side is wrong there: of ten such
        errors at most one may be left open."""
        data = self.copy("all", "beside")
        ids = data.ids("right", 0)
        moved = []
        for y in range(0, 72, 2):  # a few in 16 rows
            for x in np.nonzero(ids[y, :-1, 0] != ids[y, 1:, 0])[0][:3].tolist():
                moved.append((x, y))
        for layer in ("objects", "parts", "triangles", "depth"):
            image = data.load(f"right/{layer}/000000.npy")
            for x, y in moved:
                data.change(f"right/{layer}/000000.npy", (x, y), lambda _, v=image[y, x + 1]: v)
        classes = data.load("left/correspondence_matrix/000000.png")[..., 0]
        swapped = [(int(x), int(y)) for y, x in zip(*np.nonzero((classes[:, :-1] == 1) & (classes[:, 1:] == 2)))][::4]
        for pixel in swapped:
            data.change("left/correspondence_matrix/000000.png", pixel, lambda v: v + 1)
        grown = []

        def grow(document):
            for mask in document["masks"]:
                flat = np.repeat(np.arange(len(mask["counts"])) % 2, mask["counts"]).reshape(96, 72).T
                rows, columns = np.nonzero((flat[:, :-1] == 1) & (flat[:, 1:] == 0))
                grown.extend(zip(columns[::4].tolist(), rows[::4].tolist()))
                flat[rows[::4], columns[::4] + 1] = 1
                line = flat.T.reshape(-1)
                counts = np.diff([0, *(np.nonzero(np.diff(line))[0] + 1), len(line)]).tolist()
                mask["counts"] = counts if line[0] == 0 else [0, *counts]

        data.document("matrix/amodal/000000.json", grow)
        data.accept()
        _, rows = self.verify(data.root, "--check", "objects,class,partition", status=1)
        for row, planted in ((("objects", "objects"), moved), (("class", "correspondence_matrix"), swapped),
                             (("partition", "amodal"), grown)):
            with self.subTest(row=row):
                self.assertGreater(len(planted), 10)
                self.assertGreaterEqual(rows[row]["bad"], 0.9 * len(planted))

    def test_documents(self):
        for plant in cameras():
            for factor in (10, 0.1) if plant.small else (10,):
                with self.subTest(row=plant.row, factor=factor):
                    data = self.copy("all", plant.row[1])
                    file, _ = plant.edit(data, factor)
                    data.accept()
                    _, rows = self.verify(data.root, "--check", "cameras", status=1 if factor > 1 else 0)
                    self.assertEqual({check for check, _ in rows}, {"cameras"})
                    self.assertEqual({key for key, row in rows.items() if row["breach"]}, {plant.row} if factor > 1 else set())
                    if factor > 1:
                        self.assertEqual(rows[plant.row]["worst"]["file"], file)
                        self.assertEqual(rows[plant.row]["bad"], plant.bad)
                    shutil.rmtree(data.root)

    def test_only_some_checks(self):
        folder = os.path.join(self.folders, "closed")
        report, rows = self.verify(folder, "--check", "depth,ldi", status=0)
        self.assertEqual({check for check, _ in rows}, {"depth", "ldi"})
        self.assertEqual(report["not_checked"], [])
        self.refused("verify", folder, "--check", "depht", status=2, says=["'depht'", "expected one of hashes, cameras"])

    def test_a_tenth_of_the_tolerance_passes(self):
        data = self.copy("all", "small")
        for plant in ALL:
            if plant.small:
                plant.edit(data, 0.1)
        data.accept()
        _, rows = self.verify(data.root, status=0)
        for plant in ALL:
            if plant.small and plant.shown > 0:
                with self.subTest(row=plant.row):
                    self.assertGreater(rows[plant.row]["largest"], 0.02 * plant.tolerance, "the error did not arrive")


if __name__ == "__main__":
    main()
