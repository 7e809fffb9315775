# SPDX-License-Identifier: BSD-3-Clause
"""Errors in documents, masks, clouds and tracks, for test_referee.py."""
import json
import shutil
import struct

import numpy as np

from planted_pixels import record_of
from referee import Plant


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

    def mirrored(document):
        turned = document["objects"][0]
        turned["R"] = (-np.array(turned["R"])).tolist()
        turned["scale"] = (-np.array(turned["scale"])).tolist()

    def left_out(document):
        document["objects"][0].update(R=None, t=None, scale=None)

    for edit in (mirrored, left_out):
        yield Plant("boxes", "pose", 1e-12, lambda data, _, edit=edit: data.document("parallel/boxes/000000.json", edit), small=False)


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

    def stray(data, _):
        """A model of no object."""
        name = "models/stray.ply"
        shutil.copyfile(data.path(data.object(1)["geometry_file"]), data.touch(name))
        data.document("manifest.json", lambda document: document["files"].append({"path": name}))
        return "objects.json", None

    yield Plant("models", "shapes", 0, stray, small=False)


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
        """Farther along the ray of its only pixel, in both files."""
        document = points(data)
        index = [i for i, point in enumerate(document["points"]) if len(point["track"]) == 1][30]
        point = document["points"][index]
        camera = record_of(data, document["cameras"][point["track"][0][0]], 0)
        centre = -camera["R"].T @ camera["t"]
        moved = (centre + (1 + 1e-9 * factor) * (np.array(point["x"]) - centre)).tolist()

        def push(changed):
            changed["points"][index]["x"] = moved

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
                if i > max(seeing) and camera != "parallel" and place[2] > 0.1 and 0 < u < 96 and 0 < v < 72 and index > 150:
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
