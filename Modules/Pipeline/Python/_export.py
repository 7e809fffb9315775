# SPDX-License-Identifier: BSD-3-Clause
"""Datasets in the formats of other people's tools."""
import json
import os

from . import _check
from ._generate import frames_of, wait_for
from ._render import with_options
from .dgtkPipeline import dgtkDatasetExporter


def export(dataset, format, folder, cameras=None, frames=None, progress=None, resume=False, replace=False, **options):
    """Writes a dataset in another format: what `dgtk export` does, to the byte.

    dataset: the folder of a finished dataset, str or path-like. format: the name of a format, see `exporters()`.
    folder: where the export goes. cameras: a name or a list of names; default: all. frames: an integer, (first, last)
    or (first, last, step), both ends included, a range, or a list of frames one step
    apart; default: all. progress: called in this thread as
    progress(done, total), as in generate().
    resume: complete an interrupted export of the same request. replace: remove another export, or an interrupted one,
    that the folder holds; not with resume. Options, which are listed below, are those of `dgtk export`; those of other
    formats are refused.

    Returns export.json as a dict; Documentation/Formats/exports/index.md says what it holds. Raises ValueError for what
    the format cannot say and for a folder that holds something else, and RuntimeError for what the machine cannot do,
    one line each. Other threads run meanwhile.
    """
    exporter = dgtkDatasetExporter()
    exporter.SetDataset(_check.path("dataset", dataset))
    exporter.SetFolder(_check.path("folder", folder))
    exporter.SetFormat(_check.text("format", format))
    written = _check.absolute("folder", folder)
    if cameras is not None:
        exporter.SetOption("cameras", _check.names("cameras", cameras))
    if frames is not None:
        exporter.SetFrames(*frames_of(frames))
    if progress is not None and not callable(progress):
        _check.fail("progress", "something to call", progress)
    exporter.SetResume(_check.switch("resume", resume))
    exporter.SetReplace(_check.switch("replace", replace))
    for name, value in _check.options(options):
        exporter.SetOption(name, value)
    wait_for(exporter, progress)
    with open(os.path.join(written, b"export.json"), encoding="utf-8") as file:
        return json.load(file)


def exporters():
    """The formats of `export()`: a dict of name to (list of the layers that a dataset must have, description)."""
    rows = [line.split("\t") for line in dgtkDatasetExporter.GetFormats().splitlines()]
    return {name: (layers.split(",") if layers else [], description) for name, layers, description in rows}


with_options(export, "\n".join(line for line in dgtkDatasetExporter.GetOptions().splitlines() if not line.startswith("cameras\t")) + "\n")
