# SPDX-License-Identifier: BSD-3-Clause
"""Datasets on disk."""
import json
import os
import tempfile

import numpy

from . import _check
from ._render import require_scene, with_options
from ._vtk import write_files
from .dgtkFromVTK import dgtkSnapshot
from .dgtkPipeline import dgtkDatasetGenerator

_PATIENCE = 100  # milliseconds until an interrupt is noticed


def frames_of(value):
    """first, last, step."""
    try:
        if isinstance(value, range) and value and value.step > 0:  # however many
            return value[0], value[-1], value.step
        if isinstance(value, (list, numpy.ndarray)):
            frames = [_check.integer("frames", one) for one in value]
            step = frames[1] - frames[0] if len(frames) > 1 else 1
            if step > 0 and frames and frames == list(range(frames[0], frames[0] + step * len(frames), step)):
                return frames[0], frames[-1], step
        else:
            numbers = [_check.integer("frames", one) for one in (value if isinstance(value, tuple) else (value,))]
            first, last, step = (numbers * 2 if len(numbers) == 1 else numbers) + [1] * (len(numbers) < 3)
            if first <= last and step >= 1:
                return first, last, step
    except (TypeError, ValueError):  # of numbers that are none, or of another number of them
        pass
    return _check.fail("frames", "an integer, (first, last) or (first, last, step) with first <= last and step >= 1, a range, "
                       "or a list of frames one step apart", value)


def wait_for(generator, progress):
    """Waits for the end; whatever is raised meanwhile ends the run, and is raised on."""
    told = None
    try:
        generator.Start()
        while generator.IsRunning():
            if generator.Wait(_PATIENCE) and progress is not None:
                done, total = generator.GetDone(), generator.GetTotal()
                if told is None and done > 0:
                    progress(0, total)
                if told != (done, total):
                    told = done, total
                    progress(done, total)
    except BaseException:
        generator.Cancel()
        while generator.IsRunning():
            generator.Wait(_PATIENCE)
        raise
    if generator.GetErrorCode():
        _check.raise_error(generator)


def _generate_packed(shot, folder, *arguments, pack=True, **options):
    """Of a snapshot: of the files that it is saved as, which the dataset has copies of."""
    if not _check.switch("pack", pack):
        raise ValueError("pack: a snapshot has no files of its own: its dataset has them (expected True, or nothing)")
    try:
        folder_of_files = tempfile.TemporaryDirectory(prefix="dgtk-snapshot-")
    except OSError as error:
        raise RuntimeError(f"scene: no folder for the files of the snapshot: {error.strerror}") from None
    with folder_of_files as saved:
        file = os.path.join(saved, "scene.json")
        write_files(shot, os.fsencode(file), 4)
        return generate(file, folder, *arguments, pack=True, **options)


def generate(scene, folder, layers=None, frames=None, cameras=None, size=None, progress=None, resume=False, replace=False, formats=None, classes=None, **options):
    """Writes a dataset: what `dgtk render` does, to the byte.

    scene: the path of a .json or .scene file, or of a folder of them, a Scene, or a Snapshot of a VTK view. A Scene of
    a file is read again with its models, as these are now; the file must not have changed since. One of a description
    is in the dataset as scene.json, and its model files are read again; a Snapshot is in the dataset with its models and textures, as the scene
    that its save() writes is with pack=True. Each scene of a folder becomes a dataset in folder/<its name>; progress counts
    scenes then, and the manifest names the datasets. folder: where the dataset goes, str or path-like. layers: a name or a list of names, "all", or the usual ones. frames: an
    integer, (first, last) or (first, last, step), both ends included, a range, or a list of frames
    one step apart; default: all. cameras: a name or a list of names;
    default: all. size: (width, height) in pixels; default: each camera's own, else 640 x 480. progress: called in this
    thread as progress(done, total), pictures (one camera at one frame): with 0, as they are done, and with all.
    resume: complete an interrupted run of the same request. replace: remove the dataset of another request, or an
    interrupted run, that the folder holds; not with resume. formats: a name or a list of names of exports, whose layers and
    options are added; without layers they are all there are. classes: the path of a file of the numbers of the classes,
    for scenes that fix none; default: the scene's own, or of all scenes of the folder together. Options, which are listed below, are those of
    `dgtk render`: numbers, names, lists of names or numbers, and True for a switch.

    Returns the manifest as a dict; Documentation/Formats/dataset.md says what it holds. Raises ValueError for a wrong
    request, an input that cannot be used, and a folder that holds something else, and RuntimeError for what the machine
    cannot do (no space, no permission), one line each. What `progress` raises, and an interrupt by Ctrl-C, ends the run
    and is raised on; `resume=True` then completes it to the same bytes. Other threads run meanwhile.
    """
    if isinstance(scene, dgtkSnapshot):
        return _generate_packed(scene, folder, layers, frames, cameras, size, progress, resume, replace, formats, classes, **options)
    generator = dgtkDatasetGenerator()
    if isinstance(scene, (str, os.PathLike)):
        generator.SetSceneFile(_check.path("scene", scene))
    else:
        require_scene(scene)
        generator.SetScene(scene)
    generator.SetFolder(_check.path("folder", folder))
    written = _check.absolute("folder", folder)
    if layers is not None:
        generator.SetLayers(_check.names("layers", layers))
    if formats is not None:
        generator.SetFormats(_check.names("formats", formats))
    if classes is not None:
        generator.SetClassFile(_check.path("classes", classes))
    if cameras is not None:
        generator.SetCameras(_check.names("cameras", cameras))
    if frames is not None:
        generator.SetFrames(*frames_of(frames))
    if progress is not None and not callable(progress):
        _check.fail("progress", "something to call", progress)
    generator.SetSize(*_check.size(size))
    generator.SetResume(_check.switch("resume", resume))
    generator.SetReplace(_check.switch("replace", replace))
    for name, value in _check.options(options):
        generator.SetOption(name, value)
    wait_for(generator, progress)
    with open(os.path.join(written, b"manifest.json"), encoding="utf-8") as file:
        return json.load(file)


with_options(generate, dgtkDatasetGenerator.GetOptions())
