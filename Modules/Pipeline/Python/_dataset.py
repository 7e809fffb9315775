# SPDX-License-Identifier: BSD-3-Clause
"""Datasets on disk, as arrays."""
import functools
import json
import os

import numpy

from . import _check
from ._outputs import outputs_of
from .dgtkPipeline import dgtkDatasetReader

_MATRICES = ("K", "R", "t", "matrix", "scale", "distortion")


def _record(one):
    """An entry of a document whose matrices and vectors are arrays."""
    return {key: numpy.array(value, dtype=float) if key in _MATRICES else value for key, value in one.items()}


class Dataset:
    """A finished dataset, from `dataset()`.

    It reads what it is asked for, stands for its folder where a path does, and keeps nothing of it; files that change meanwhile are another dataset. Threads may
    share it, and forked processes. Pickled, it is its folder.
    """

    def __init__(self, reader, folder):
        self._reader = reader
        self._folder = folder

    @property
    def folder(self):
        """Where it is: an absolute path."""
        return os.fsdecode(self._folder)

    @functools.cached_property
    def pictures(self):
        """All pictures as (camera, frame), sorted: a list."""
        return [(self._reader.GetPictureCamera(i), self._reader.GetPictureFrame(i)) for i in range(self._reader.GetNumberOfPictures())]

    @property
    def cameras(self):
        """The names of the cameras, sorted: a list of str."""
        return sorted({camera for camera, _ in self.pictures})

    @property
    def frames(self):
        """The frames of which some camera has a picture, sorted: a list of int."""
        return sorted({frame for _, frame in self.pictures})

    @functools.cached_property
    def layers(self):
        """The layers of which some picture has a file: a dict of name to list of its outputs, as `read()` calls them."""
        return {layer: outputs for layer, *outputs in (line.split("\t") for line in self._reader.GetLayers().splitlines())}

    @property
    def objects(self):
        """The objects, as objects.json says them: a list of dicts; `objects[i]` has id i + 1 in the layer `objects`."""
        return self._document("objects.json")["objects"]

    @property
    def classes(self):
        """The classes, as objects.json says them: a list of dicts of `id` and `name`."""
        return self._document("objects.json").get("classes", [])

    @property
    def manifest(self):
        """manifest.json: a dict. Documentation/Formats/dataset.md says what it holds."""
        return self._document("manifest.json")

    def camera(self, camera=None, frame=None):
        """What cameras.json says of a picture's camera, its matrices as arrays: a dict.

        camera: a name; default: that of the first picture. frame: an integer; default: the camera's first. `K` is 3 x 3
        and missing for models without one; x_camera = `R` x_world + `t`, x right, y down, z forward, scene units; the
        centre of the first pixel is (0.5, 0.5). Raises ValueError for a picture that there is not.
        """
        name, number = self._picture(camera, frame)
        found = self._cameras.get((name, number))
        if found is None:
            raise ValueError(f"the dataset has no picture of camera '{name}' at frame {number}")
        return _record(found)

    def poses(self, frame=None):
        """The poses of all objects at a frame, as poses.json says them, matrices as arrays: a list of dicts.

        frame: an integer; default: the first. `matrix` is 3 x 4, x_world = matrix (x_object, 1), scene units. Raises
        ValueError for a frame of which there is no picture.
        """
        at = self.frames[0] if frame is None else _check.integer("frame", frame)
        if at not in self.frames:
            raise ValueError(f"the dataset has no picture at frame {at}")
        return [_record(pose) for pose in self._poses.get(at, [])]

    def read(self, layers, camera=None, frame=None):
        """Reads one layer, or several, of one picture: what `render()` gives for it.

        layers: a name ("depth"), or a list of names; a single output of a layer may be named, too
        ("flow_forward_class"). camera: a name; default: that of the first picture. frame: an integer; default: the
        camera's first.

        A list of names gives a dict of outputs by name; one name gives its output, or a dict where the layer has
        several. Arrays have the values of the file, and its type ("flow_forward" of a .flo is float32), whichever of
        its formats is there: ids are uint32, whether a .ppm, .png or .npy holds them. `tracks` is a table, points x
        (u, v, class). All are the caller's. Raises ValueError for what the picture does not have, for files that cannot
        be read, for values that are there as pictures alone (a depth .png) and for deep OpenEXR, and RuntimeError for
        what the machine cannot do.
        """
        name, number = self._picture(camera, frame)
        reader = dgtkDatasetReader()  # threads share nothing but the open dataset
        reader.ShallowCopy(self._reader)
        if not reader.Read(name, number, _check.names("layers", layers)):
            _check.raise_error(reader)
        outputs = outputs_of(reader)
        return next(iter(outputs.values())) if isinstance(layers, str) and len(outputs) == 1 else outputs

    def _picture(self, camera, frame):
        name = self.pictures[0][0] if camera is None else _check.text("camera", camera)
        if frame is not None:
            return name, _check.integer("frame", frame)
        return name, next((at for own, at in self.pictures if own == name), self.pictures[0][1])

    def _document(self, name):
        try:
            with open(os.path.join(self._folder, name.encode()), encoding="utf-8") as file:
                return json.load(file)
        except (OSError, ValueError) as error:
            raise ValueError(f"{os.path.join(self.folder, name)}: cannot be read: {error}") from None

    @functools.cached_property
    def _cameras(self):
        return {(one["name"], one["frame"]): one for one in self._document("cameras.json")["cameras"]}

    @functools.cached_property
    def _poses(self):
        poses = {}
        there = os.path.exists(os.path.join(self._folder, b"poses.json"))  # not of earlier versions
        for one in self._document("poses.json")["poses"] if there else []:
            poses.setdefault(one["frame"], []).append(one)
        return poses

    def __fspath__(self):
        return self.folder

    def __reduce__(self):
        return dataset, (self.folder,)

    def __repr__(self):
        return f"<dgtk.Dataset {self.folder!r}: {len(self.pictures)} pictures>"


def dataset(folder):
    """Opens a finished dataset, such as `generate()` and `dgtk render` write.

    folder: str or path-like.

    Returns a Dataset. Raises ValueError for a folder that holds none, or an unfinished one, and RuntimeError for what
    the machine cannot do.
    """
    path = _check.absolute("folder", folder)
    reader = dgtkDatasetReader()
    if not reader.Open(path):
        _check.raise_error(reader)
    return Dataset(reader, path)
