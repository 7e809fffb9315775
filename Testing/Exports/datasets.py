# SPDX-License-Identifier: BSD-3-Clause
"""Scenes and datasets that exports are tried with: everything that formats stumble over.

Each function writes a scene into a folder and returns its path; render() makes a dataset of one. Names have spaces, dots and letters
beyond ASCII; the ring has a hole in its mask; objects are truncated by the border, equal models stand in two sizes.
"""
import hashlib
import json
import math
import os
import re
import shutil
import tempfile

import numpy as np

from harness import load_json, main  # noqa: F401: for the tests
from many_runs import ManyCase
from pictures import read_png  # noqa: F401

LAYERS = "color,depth,objects,classes,boxes,amodal"


def _obj(path, vertices, faces, color):
    """A Wavefront model with a material of its own."""
    stem = os.path.splitext(os.path.basename(path))[0]
    with open(os.path.join(os.path.dirname(path), stem + ".mtl"), "w") as file:
        file.write(f"newmtl m\nKd {color[0]} {color[1]} {color[2]}\n")
    with open(path, "w") as file:
        file.write(f"mtllib {stem}.mtl\nusemtl m\n")
        file.writelines("v %.9g %.9g %.9g\n" % tuple(v) for v in vertices)
        file.writelines("f " + " ".join(str(i + 1) for i in f) + "\n" for f in faces)


def ring(path, major=1.0, minor=0.35, around=24, across=12, color=(0.8, 0.3, 0.2)):
    """A torus around z: its mask has a hole."""
    vertices, faces = [], []
    for i in range(around):
        a = 2 * math.pi * i / around
        for j in range(across):
            b = 2 * math.pi * j / across
            r = major + minor * math.cos(b)
            vertices.append((r * math.cos(a), r * math.sin(a), minor * math.sin(b)))
            right, up = (i + 1) % around, (j + 1) % across
            faces.append((i * across + j, right * across + j, right * across + up, i * across + up))
    _obj(path, vertices, faces, color)


def block(path, size=(1, 1, 1), color=(0.3, 0.6, 0.8)):
    """A box around the origin."""
    x, y, z = (s / 2 for s in size)
    corners = [(a, b, c) for a in (-x, x) for b in (-y, y) for c in (-z, z)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    _obj(path, corners, faces, color)


def _models(folder):
    ring(os.path.join(folder, "ring.obj"))
    block(os.path.join(folder, "block.obj"), (1.0, 0.8, 0.6))
    block(os.path.join(folder, "wall.obj"), (9, 6, 0.2), (0.7, 0.7, 0.6))


def _write(folder, name, scene):
    os.makedirs(folder, exist_ok=True)
    _models(folder)
    path = os.path.join(folder, name + ".json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump({"version": 1, "units": "metre", "fps": 25, "background": [0.2, 0.3, 0.4],
                   "lights": [{"name": "lamp", "kind": "directional", "position": [1, 2, 4], "target": [0, 0, 0],
                               "diffuse": [0.8, 0.8, 0.8], "ambient": [0.2, 0.2, 0.2]}], **scene,
                   "cameras": [_without_view(camera) for camera in scene["cameras"]]}, file, ensure_ascii=False)
    return path


def _camera(name, eye, at, **more):
    return {"name": name, "width": 96, "height": 72, "fovY": 45, "near": 0.1, "far": 100, "eye": eye, "lookAt": at, **more}


def _objects():
    """A wall, a ring with a hole, a block that covers a part of it, its equal at another scale at the border."""
    return [{"name": "back wall", "model": "wall.obj", "position": [0, 0, -3], "class": "wall"},
            {"name": "röter Ring.v2", "model": "ring.obj", "position": [-0.4, 0.1, 0], "class": "ring",
             "orientation": [0.980067, 0, 0.198669, 0]},
            {"name": "block", "model": "block.obj", "position": [0.7, -0.3, 0.8], "class": "block"},
            {"name": "block, kleiner & schräg", "model": "block.obj", "position": [2.0, 0.9, 0.2], "class": "block",
             "scale": [0.6, 0.6, 0.6], "orientation": [0.92388, 0, 0, 0.382683]}]


def stereo(folder, frames=3):
    """A rectified pair with moving objects and a moving rig: 'left eye' and 'right.eye'."""
    last = frames - 1
    objects = _objects()
    if last > 0:
        objects[2]["position"] = {"keys": [[0, [0.7, -0.3, 0.8]], [last, [0.5, -0.25, 1.0]]]}
        objects[3]["orientation"] = {"keys": [[0, [0.92388, 0, 0, 0.382683]], [last, [0.887011, 0, 0, 0.461749]]]}

    def moving(x):
        move = [[0, [x, 0.2, 4.5]], [last, [x + 0.05, 0.2, 4.4]]]
        look = [[0, [x, 0.2, 0]], [last, [x + 0.05, 0.2, 0]]]
        return ({"keys": move}, {"keys": look}) if last > 0 else (move[0][1], look[0][1])

    return _write(folder, "stereo", {"objects": objects,
                                     "cameras": [_camera("left eye", *moving(-0.06)), _camera("right.eye", *moving(0.06))]})


def walk(folder, frames=4, empty=True):
    """One camera that moves through what stands still; at the last frame it sees nothing."""
    last = frames - 1
    eyes = [[f, [1.2 * f / last - 0.5, 0.3, 4.5]] for f in range(frames)]
    looks = [[f, [0, 0, 0] if f < last or not empty else [0, 0, 9]] for f in range(frames)]
    return _write(folder, "walk", {"objects": _objects()[:3] if empty else _objects(),
                                   "cameras": [_camera("Kamera 1", {"keys": eyes}, {"keys": looks})]})


def many(folder, cameras=30):
    """Cameras around what stands still, one frame."""
    around = [_camera(f"cam {i}", [4.5 * math.sin(0.05 * i - 0.7), 0.3, 4.5 * math.cos(0.05 * i - 0.7)], [0, 0, 0])
              for i in range(cameras)]
    return _write(folder, "many", {"objects": _objects(), "cameras": around})


def lenses(folder):
    """A pinhole, one with distortion (OpenCV's 8 coefficients), and a fisheye."""
    K = [[80, 0, 47.3], [0, 82, 36.9], [0, 0, 1]]
    return _write(folder, "lenses", {"objects": _objects(), "cameras": [
        _camera("plain", [0, 0.2, 4.5], [0, 0, 0]),
        _without_view({**_camera("radial", [0.3, 0.2, 4.5], [0, 0, 0]), "K": K,
                       "distortion": [-0.2, 0.05, 0.001, -0.002, 0.003, 0.01, 0.002, 0.001]}),
        _without_view({**_camera("mild", [0.1, 0.2, 4.5], [0, 0, 0]), "K": K, "distortion": [-0.2, 0.05, 0.001, -0.002]}),
        _without_view({**_camera("fish", [-0.3, 0.2, 4.2], [0, 0, 0]), "model": "fisheye", "K": [[40, 0, 47.5], [0, 40, 36.2], [0, 0, 1]],
                       "distortion": [0.02, -0.004, 0.0006, -5e-05]})]})


def room(folder):
    """Two fisheyes of more than 180 degrees in a closed room: a part of what they see is behind them."""
    fish = {"model": "fisheye", "K": [[18, 0, 47], [0, 19, 36.5], [0, 0, 1]], "distortion": [0.02, -0.004, 0.001, 0]}
    return _write(folder, "room", {
        "objects": [{"name": "room", "model": "block.obj", "scale": [6, 6, 6], "class": "room"},
                    {"name": "block", "model": "block.obj", "position": [0.9, -0.4, -1], "class": "block"}],
        "cameras": [_without_view({**_camera("wide", [0, 0, 0], [0.3, 0, -1]), **fish}),
                    _without_view({**_camera("beside", [-0.5, 0.3, 0.3], [0.2, 0, -1]), **fish})]})


def twins(folder):
    """A fisheye that moves, and beside another pinhole one that goes its way."""
    eyes, looks = {"keys": [[0, [-0.3, 0.2, 4.2]], [1, [-0.1, 0.2, 4.1]]]}, {"keys": [[0, [0, 0, 0]], [1, [0.1, 0, 0]]]}
    return _write(folder, "twins", {"objects": _objects(), "cameras": [
        _without_view({**_camera("fish.auge", eyes, looks), "model": "fisheye", "K": [[40, 0, 47.5], [0, 40, 36.2], [0, 0, 1]],
                       "distortion": [0.02, -0.004, 0.0006, -5e-05]}),
        _camera("a wider view", [-0.3, 0.2, 5.2], [0, 0, 0]), _camera("fish flach", eyes, looks)]})


def street(folder, frames=2, **size):
    """What stands upright before an upright rectified pair: turned about the vertical alone, cut off by the border, in two sizes."""
    last = frames - 1
    objects = [{"name": "back wall", "model": "wall.obj", "position": [0, 0, -3], "class": "wall"},
               {"name": "car, röt", "model": "block.obj", "position": {"keys": [[0, [0.4, -0.2, 0]], [last, [0.6, -0.2, 0.3]]]},
                "class": "Car", "orientation": [0.955336, 0, 0.29552, 0]},
               {"name": "van", "model": "block.obj", "position": [-1.9, 0, 0.4], "class": "delivery van", "scale": [1.5, 1.5, 1.5],
                "orientation": [0.5, 0, -0.866025, 0]},
               {"name": "hidden", "model": "block.obj", "position": [0.7, -0.1, -1.2], "class": "Car"},
               {"name": "nameless", "model": "ring.obj", "position": [-0.3, 0.6, -1]}]
    return _write(folder, "street", {"objects": objects, "cameras": [
        _camera("cam L", {"keys": [[0, [-0.1, 0.2, 4.5]], [last, [-0.1, 0.2, 4.3]]]}, {"keys": [[0, [-0.1, 0.2, 0]], [last, [-0.1, 0.2, -0.2]]]}, **size),
        _camera("cam R", {"keys": [[0, [0.1, 0.2, 4.5]], [last, [0.1, 0.2, 4.3]]]}, {"keys": [[0, [0.1, 0.2, 0]], [last, [0.1, 0.2, -0.2]]]}, **size)]})


def far_away(path, by):
    """A scene's file again, all of it elsewhere. Its path."""
    def moved(value):
        return {"keys": [[f, moved(v)] for f, v in value["keys"]]} if isinstance(value, dict) else [a + b for a, b in zip(value, by)]

    scene = load_json(path)
    for one in scene["objects"] + scene["cameras"] + scene["lights"]:
        one.update({key: moved(one[key]) for key in ("position", "eye", "lookAt", "target") if key in one})
    with open(path, "w", encoding="utf-8") as file:
        json.dump(scene, file, ensure_ascii=False)
    return path


def in_units(path, metres=None):
    """A scene's file again, in units of so many metres; None: nobody says how long they are. Its path."""
    scene = load_json(path)
    del scene["units"]
    with open(path, "w", encoding="utf-8") as file:
        json.dump(scene if metres is None else {**scene, "metresPerUnit": metres}, file, ensure_ascii=False)
    return path


def _without_view(camera):
    """K says the view: neither is given twice."""
    return {key: value for key, value in camera.items() if key != "fovY" or "K" not in camera}


class ExportCase(ManyCase):
    """Cases that render a scene once for all tests of a class, export and have the referee read it back."""

    @classmethod
    def rendered_once(cls, make, *options):
        """A dataset for all cases of a class, of the scene that `make(folder)` writes."""
        folder = tempfile.mkdtemp(prefix="dgtk-exports-")
        cls.addClassCleanup(shutil.rmtree, folder, ignore_errors=True)
        dataset = os.path.join(folder, "dataset")
        done = cls.ran("render", make(folder), "-o", dataset, "--quiet", *options)
        if done.returncode:
            raise RuntimeError(done.stderr)
        return dataset

    def render(self, scene, layers=LAYERS, *options):
        folder = self.path("dataset-" + str(len(os.listdir(self.folder))))
        self.dgtk("render", scene, "-o", folder, "--layers", layers, "--quiet", *options)
        return folder

    def export(self, dataset, form, *options, verify=True):
        """The folder of the export, read back by the referee, and its export.json."""
        folder = self.path(f"{form}-{len(os.listdir(self.folder))}")
        self.dgtk("export", dataset, "--format", form, "-o", folder, "--quiet", *options)
        record = load_json(os.path.join(folder, "export.json"))
        self.assertEqual(record["exporter"], form)
        if verify:
            self.referee(dataset, folder)
        return folder, record

    def rates(self, *export):
        """What `dgtk export` says of pictures a second, line by line."""
        said = self.dgtk("export", *export, environment={"DGTK_PROGRESS": "0.01"}).stderr
        return [float(rate) for rate in re.findall(r"(?m)^\d+/\d+ pictures, ([\d.]+)/s, ", said)]

    def referee(self, dataset, folder, status=0):
        """The rows of `dgtk verify --export`."""
        done = self.dgtk("verify", dataset, "--export", folder, "--json", status=status)
        return json.loads(done.stdout)

    def planted(self, dataset, folder, names, change, rows=False):
        """Changes a file of an export, or several alike, hash and size in export.json with it; the referee must find it. Its breach in words,
        or all of its rows."""
        record = os.path.join(folder, "export.json")
        with open(record, encoding="utf-8") as file:
            whole = file.read()
        mended = json.loads(whole)
        old, new = {record: whole.encode()}, {}
        for name in [names] if isinstance(names, str) else names:
            path = os.path.join(folder, name)
            with open(path, "rb") as file:
                old[path] = file.read()
            new[path] = change(old[path])
            self.assertNotEqual(old[path], new[path])
            row = next(one for one in mended["files"] if one["path"] == name)
            self.assertEqual((row["sha256"], row["bytes"]), (hashlib.sha256(old[path]).hexdigest(), len(old[path])))
            row.update(sha256=hashlib.sha256(new[path]).hexdigest(), bytes=len(new[path]))
        new[record] = sealed(mended)
        try:
            self.written(new)
            return self.referee(dataset, folder, status=1) if rows else self.dgtk("verify", dataset, "--export", folder, status=1).stderr
        finally:
            self.written(old)

    @staticmethod
    def written(files):
        """Puts new files where others lay, which may be linked from elsewhere."""
        for path, data in files.items():
            os.remove(path)
            with open(path, "wb") as file:
                file.write(data)


def sealed(record):
    """The bytes of export.json with its hash of itself."""
    head = json.dumps({key: value for key, value in record.items() if key != "sha256"}, indent=2).removesuffix("\n  ]\n}")
    return (head + '\n  ],\n  "sha256": "' + hashlib.sha256(head.encode()).hexdigest() + '"\n}\n').encode()


def cameras_of(dataset):
    """(camera, frame) -> entry of cameras.json, with arrays."""
    found = {}
    for entry in load_json(os.path.join(dataset, "cameras.json"))["cameras"]:
        found[entry["name"], entry["frame"]] = {key: np.array(value) if key in ("K", "R", "t") else value for key, value in entry.items()}
    return found


def layer_of(dataset, layer, camera, frame):
    """A layer's pixels: .npy, .pfm (top row first), .ppm as ids, or .png."""
    stem = os.path.join(dataset, camera, layer, f"{frame:06d}")
    if os.path.exists(stem + ".npy"):
        return np.load(stem + ".npy")
    if os.path.exists(stem + ".pfm"):
        with open(stem + ".pfm", "rb") as file:
            kind, size, _, data = file.read().split(b"\n", 3)
        width, height = map(int, size.split())
        return np.frombuffer(data, "<f4").reshape(height, width, *([3] if kind == b"PF" else []))[::-1]
    if os.path.exists(stem + ".ppm"):
        with open(stem + ".ppm", "rb") as file:
            _, size, _, data = file.read().split(b"\n", 3)
        width, height = map(int, size.split())
        return np.frombuffer(data, np.uint8).reshape(height, width, 3).astype(np.uint32) @ np.array([65536, 256, 1], np.uint32)
    return read_png(stem + ".png")
