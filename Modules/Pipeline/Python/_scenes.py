# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of files and of descriptions."""
import json
import math
import os
import warnings

import numpy

from . import _check
from .dgtkPipeline import dgtkScene

_DEEPEST = 32
_LONGEST = 1_000_000  # of a range: it has its numbers for nothing, a list has paid for them


def _folder(scene_):
    return os.fsdecode(scene_.GetFolder())  # VTK has bytes for what is no UTF-8


class Scene(dgtkScene):
    """A loaded scene, from `load()` or `scene()`. It does not change: another description makes another scene.

    It is a VTK object and has the methods of `dgtkScene`, too. Pickled, it is its description and its folder: who
    unpickles it loads the models.
    """

    @property
    def cameras(self):
        """The names of the cameras, in the scene's order: a list of str."""
        return [self.GetCameraName(i) for i in range(self.GetNumberOfCameras())]

    @property
    def objects(self):
        """The names of the objects with geometry: a list of str. `objects[i]` has id i + 1 in the layer `objects`."""
        return [self.GetObjectName(i) for i in range(self.GetNumberOfObjects())]

    @property
    def frames(self):
        """The scene's frames, from its first to its last key frame: a range."""
        return range(self.GetFirstFrame(), self.GetLastFrame() + 1)

    @property
    def folder(self):
        """Where the relative paths of the description start: an absolute path."""
        return _folder(self)

    def description(self):
        """The scene as a dict, as in a .json file: what `scene()` takes.

        Only values that are not the default are there, and every object, light and camera has a name. The dict is the
        caller's; changing it does not change the scene.
        """
        return json.loads(self.GetDescription() or "{}")

    def __reduce__(self):
        return (scene, (self.description(), self.folder)) if self.folder else (Scene, ())


def _loaded(scene_, done):
    if not done:
        _check.raise_error(scene_)
    for line in scene_.GetWarnings().splitlines():
        warnings.warn(line, stacklevel=3)
    return scene_


def load(path):
    """Loads a scene with its models.

    path: a .json or .scene file, str or path-like.

    Returns a Scene; textures that are missing are warnings. Raises ValueError, one line with file, line and what is
    wrong, for a file that cannot be used, and RuntimeError for what the machine cannot do (memory).
    """
    loaded = Scene()
    return _loaded(loaded, loaded.Load(_check.path("path", path)))


def scene(description, folder=None, like=None):
    """Makes a scene of a description, and loads its models.

    description: a dict as in a .json file (Documentation/Formats/scene.md); NumPy scalars and arrays may stand where
    numbers and lists do, and path-like objects where paths do. folder: where its relative paths start, str or path-like;
    default: the current folder, or that of `like`. like: another Scene; models and pictures that it has loaded are not
    read again, whatever became of their files, and what a kept renderer made of them is used again. `like` does not change.

        more = scene.description()
        more["objects"][0]["position"] = [0, 2, 0]
        moved = dgtk.scene(more, like=scene)

    Returns a Scene; textures that are missing are warnings. Raises ValueError, one line that names the value ("scene:
    objects[2].position[1] has the wrong type (expected a number from -1e15 to 1e15, found 'far')"), and RuntimeError for
    what the machine cannot do.
    """
    if not isinstance(description, dict):
        _check.fail("description", "a dict", description)
    if like is not None and not isinstance(like, dgtkScene):
        _check.fail("like", "a scene", like)
    if folder is None:
        folder = (_folder(like) if like else "") or "."
    text = json.dumps(_plain(description, ""), allow_nan=False)
    made = Scene()
    return _loaded(made, made.LoadTextLike(text, _check.absolute("folder", folder), like))


def _fail(path, expected, value, what="has the wrong type"):
    """As the reader of scenes says it."""
    raise ValueError(f"scene: {path + ' ' if path else ''}{what} (expected {expected}, found {_check.found(value)})")


def _plain(value, path, depth=0):
    """The value in the types of the json module."""
    if depth > _DEEPEST:
        _fail("", f"at most {_DEEPEST} lists and dicts in one another", value, "is nested too deeply")
    if isinstance(value, (numpy.ndarray, numpy.generic)):
        value = value.tolist()
    if isinstance(value, numpy.floating):  # longer than Python has them
        value = float(value)
    if isinstance(value, dict):
        for key in value:
            if not isinstance(key, str):
                _fail(path, "text", key, "has a key that is none")
        return {key: _plain(one, f"{path}.{key}" if path else key, depth + 1) for key, one in value.items()}
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, range) and value[_LONGEST:]:
        _fail(path, f"at most {_LONGEST} numbers", value, "is too long")
    if isinstance(value, (list, tuple, range)):
        return [_plain(one, f"{path}[{i}]", depth + 1) for i, one in enumerate(value)]
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, str):
        return _text(value, path)
    if isinstance(value, (int, float)):
        return _number(value, path)
    return _fail(path, "a number, text, True or False, a list or a dict", value)


def _text(value, path):
    try:
        value.encode()
    except UnicodeEncodeError:
        _fail(path, "text of Unicode", value, "has no meaning")
    return value


def _number(value, path):
    try:
        if math.isfinite(float(value)):
            return value
    except OverflowError:
        pass
    return _fail(path, "a finite number", value, "is out of range")
