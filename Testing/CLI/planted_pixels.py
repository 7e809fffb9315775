# SPDX-License-Identifier: BSD-3-Clause
"""Errors in pixels, for test_referee.py."""
import json
import struct

import numpy as np

from referee import Plant, absolute, background, by, other, part, turned_around, ulps


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

    def nothing(data, _):
        """Where nothing is there is no colour."""
        rows, columns = np.nonzero(data.load(name)[..., 3] == 0)
        return data.change(name, (int(columns[0]), int(rows[0])), lambda v: v + [0, 4, 0, 0])

    yield Plant("rgba", "color_rgba alpha", 1e-7, share, small=False)
    yield Plant("rgba", "color_rgba", 2, nothing, small=False)
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


def closed():
    yield Plant("ldi", "first = color", 0,
                lambda data, _: data.layered("left/ldi/000000.ldi", data.spot("left", 0),
                                             lambda r: [[r[0][0] ^ 1, *r[0][1:]], *r[1:]]))
    for layer in ("objects", "parts", "triangles"):
        yield Plant("objects", layer, 0, by(f"{layer}.png", other))
