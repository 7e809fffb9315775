# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that an adversary would try exports with: names that no text format likes, pictures with nothing in them, objects of a pixel
or less, frames that start late and leave gaps, cameras of several sizes. Each function writes a scene into a folder and returns its path.
"""
import math

from datasets import _camera, _objects, _write

DATASET = {"name": "Ä \"set\": of <things> & 'more', #1", "description": "lines: - [a, b] {c} %d \\ | > \u2028 end", "license": "CC-BY-4.0: \"x\"",
           "citation": "@misc{a, title = {Ü & \"b\"}}", "author": "Jörg O'Neil, #2", "version": "1.0", "url": "https://example.org/?a=1&b=\"2\""}
CAMERAS = ("Käm 1.left", "b&w 'c\" <d>")


def _hostile():
    """A wall, a ring with a hole and blocks of one model in four sizes, at the border and beyond it, with names and classes to escape."""
    objects = _objects()
    for object_, class_ in zip(objects, ("wall: 'a' # b", "ring \"r\" & <s>\\", "yes", "yes")):
        object_["class"] = class_
    objects[2]["name"] = "- block: {1} \"q\" \\n"
    objects += [{"name": "speck", "model": "block.obj", "position": [-1.3, 1.2, 1], "class": "null", "scale": 0.05},
                {"name": "beyond", "model": "block.obj", "position": [40, 0, 0], "class": "~"},
                {"name": "behind wall", "model": "block.obj", "position": [0, 0, -6], "class": "~", "scale": [2, 2, 2]},
                {"name": "ümlaut.a", "model": "block.obj", "position": [-2.2, -1.5, 0.5], "class": "größe\u2028XL\u0085", "scale": 1.7}]
    return objects


def hostile(folder, frames=(7, 16)):
    """A moving rig of a rectified pair; at the last frame it looks up, at nothing. Names and words of all kinds."""
    first, last = frames
    objects = _hostile()
    objects[2]["position"] = {"keys": [[first, [0.7, -0.3, 0.8]], [last, [0.5, -0.25, 1.0]]]}
    cameras = []
    for name, x in zip(CAMERAS, (-0.06, 0.06)):
        eyes, looks = [[first, [x, 0.2, 4.5]]], [[first, [x, 0.2, 0]]]
        if last > first:
            eyes += [[last - 1, [x + 0.05, 0.2, 4.4]], [last, [x + 0.05, 0.2, 4.4]]]
            looks += [[last - 1, [x + 0.05, 0.2, 0]], [last, [x + 0.05, 9, 2]]]
        cameras.append(_camera(name, {"keys": eyes}, {"keys": looks}))
    return _write(folder, "hostile", {"dataset": DATASET, "objects": objects, "cameras": cameras})


def empty(folder):
    """One camera that never sees anything, at two frames."""
    return _write(folder, "empty", {"objects": _objects()[:3], "cameras": [
        _camera("only", {"keys": [[0, [0, 0, 5]], [1, [0.1, 0, 5]]]}, {"keys": [[0, [0, 0, 9]], [1, [0.1, 0, 9]]]})]})


def sizes(folder, cameras=30):
    """Thirty cameras of three sizes around what stands still."""
    around = [{**_camera(f"cam {i}.ü", [4.5 * math.sin(0.05 * i - 0.7), 0.3, 4.5 * math.cos(0.05 * i - 0.7)], [0, 0, 0]),
               "width": (96, 64, 51)[i % 3], "height": (72, 64, 37)[i % 3]} for i in range(cameras)]
    return _write(folder, "sizes", {"dataset": DATASET, "objects": _hostile(), "cameras": around})


def specks(folder, count=300):
    """More objects than a byte counts, each a pixel or less, some in front of others; one frame, number 5."""
    objects = [{"name": f"speck {i}", "model": "block.obj", "class": f"class {i % 7}", "scale": 0.04 + 0.002 * (i % 9),
                "position": [-1.9 + 0.19 * (i % 21) + 0.003 * i / 21, -1.3 + 0.18 * (i // 21), 0.01 * (i % 5)]} for i in range(count)]
    return _write(folder, "specks", {"objects": objects, "keyFrames": [5],
                                     "cameras": [_camera("left", [-0.05, 0, 4.5], [-0.05, 0, 0]), _camera("right", [0.05, 0, 4.5], [0.05, 0, 0])]})


def walking(folder):
    """One camera, frames 3 to 9 with another number of them, through what stands still."""
    return _write(folder, "walking", {"objects": _hostile()[:6], "cameras": [
        _camera("Gang & Weg", {"keys": [[3, [-0.5, 0.3, 4.5]], [9, [0.7, 0.4, 4.4]]]}, {"keys": [[3, [0, 0, 0]], [9, [0.1, 0, 0]]]})]})


def fisheye(folder):
    """A fisheye that moves, beyond its image circle in the corners."""
    return _write(folder, "fisheye", {"objects": _hostile(), "cameras": [
        {"name": "Fisch auge", "width": 96, "height": 80, "near": 0.1, "far": 100, "eye": {"keys": [[0, [-0.3, 0.2, 4.2]], [1, [-0.1, 0.2, 4.1]]]},
         "lookAt": {"keys": [[0, [0, 0, 0]], [1, [0.1, 0, 0]]]}, "model": "fisheye", "K": [[30, 0, 47.5], [0, 31, 40.2], [0, 0, 1]],
         "distortion": [0.02, -0.004, 0.0006, -5e-05]}]})


def flat(folder):
    """A wall straight ahead: every pixel has one depth."""
    return _write(folder, "flat", {"objects": _objects()[:1], "cameras": [
        _camera("ahead", [0, 0, 2], [0, 0, 0]), _camera("beside", [0.2, 0, 2], [0.2, 0, 0])]})
