# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that an adversary would try exports with. Each function writes a scene into a folder and returns its path."""
from datasets import _camera, _objects, _write

DATASET = {"name": "Ä \"set\": of <things> & 'more', #1", "description": "lines: - [a, b] {c} %d \\ | > \u2028 end", "license": "CC-BY-4.0: \"x\"",
           "citation": "@misc{a, title = {Ü & \"b\"}}", "author": "Jörg O'Neil, #2", "version": "1.0", "url": "https://example.org/?a=1&b=\"2\""}
CAMERAS = ("Käm 1.left", "b&w 'c\" <d>")


def hostile(folder):
    """A wall, a ring with a hole and blocks of one model in four sizes, at the border and beyond it; names and words to escape. One frame,
    number 7, of two cameras."""
    objects = _objects()
    for object_, class_ in zip(objects, ("wall: 'a' # b", "ring \"r\" & <s>\\", "yes", "yes")):
        object_["class"] = class_
    objects[2]["name"] = "- block: {1} \"q\" \\n"
    objects += [{"name": "speck", "model": "block.obj", "position": [-1.3, 1.2, 1], "class": "null", "scale": 0.05},
                {"name": "beyond", "model": "block.obj", "position": [40, 0, 0], "class": "~"},
                {"name": "behind wall", "model": "block.obj", "position": [0, 0, -6], "class": "~", "scale": [2, 2, 2]},
                {"name": "ümlaut.a", "model": "block.obj", "position": [-2.2, -1.5, 0.5], "class": "größe\u2028XL\u0085", "scale": 1.7}]
    cameras = [_camera(name, {"keys": [[7, [x, 0.2, 4.5]]]}, [x, 0.2, 0]) for name, x in zip(CAMERAS, (-0.06, 0.06))]
    return _write(folder, "hostile", {"dataset": DATASET, "objects": objects, "cameras": cameras})


def flat(folder):
    """A wall straight ahead: every pixel has one depth."""
    return _write(folder, "flat", {"objects": _objects()[:1], "cameras": [
        _camera("ahead", [0, 0, 2], [0, 0, 0]), _camera("beside", [0.2, 0, 2], [0.2, 0, 0])]})


def nothing(folder):
    """A camera, and no object: no class, no track, no box."""
    return _write(folder, "nothing", {"objects": [], "cameras": [_camera("alone", [0, 0, 4], [0, 0, 0])]})
