# SPDX-License-Identifier: BSD-3-Clause
"""Ground truth of a VTK scene that somebody has: truth, snapshot, correspond, visible_cells."""
import warnings

import numpy
import vtkmodules.vtkRenderingCore as vtkcore
from vtkmodules.util.numpy_support import vtk_to_numpy

from . import _check
from ._render import render, turn
from ._scenes import Scene
from .dgtkFromVTK import dgtkSnapshot

_HOLDERS = ("renderer", "ren_win", "render_window", "window")  # PyVista, vedo, Mayavi's scenes and figures
_CONTAINERS = ("scene", "plotter", "_vtk_obj")
_MOST_HOLDERS = 50  # objects that are looked into: some make attributes without end


class Snapshot(dgtkSnapshot):
    """What a VTK view showed, frozen; see snapshot()."""

    cameras = Scene.cameras
    objects = Scene.objects
    frames = Scene.frames

    def save(self, path):
        """Writes the snapshot as a .json scene, with its models as OBJ and their textures in a folder `models` beside it.

        Warns of what these files have otherwise.
        """
        write_files(self, _check.path("path", path), 3)


def write_files(shot, path, level):
    """Saves a snapshot, and warns of what the files have otherwise, where the caller that many levels above is."""
    with turn(shot):
        if not shot.Save(path):
            _check.raise_error(shot)
        changes = shot.GetChanges().splitlines()
    for line in changes:
        warnings.warn(f"saved otherwise: {line}", stacklevel=level)


def _renderer_of_window(window):
    """The one renderer of a window that shows props; ValueError where there are more."""
    renderers = [renderer for renderer in window.GetRenderers()]
    shown = [renderer for renderer in renderers if any(prop.GetVisibility() for prop in renderer.GetViewProps())] or renderers
    if len(shown) != 1:
        raise ValueError(f"view: the window has {len(shown)} renderers that show something (expected one; give that renderer)")
    return shown[0]


def _renderer(view):
    """The vtkRenderer of what the user calls a view."""
    seen, queue = set(), [view]
    while queue and len(seen) < _MOST_HOLDERS:
        found = queue.pop(0)
        if isinstance(found, vtkcore.vtkRenderer):
            return found
        if isinstance(found, vtkcore.vtkRenderWindow):
            return _renderer_of_window(found)
        if isinstance(found, vtkcore.vtkRenderWindowInteractor):
            found = found.GetRenderWindow()
            if found is not None:
                return _renderer_of_window(found)
        if found is None or id(found) in seen or isinstance(found, (str, bytes, int, float, list, tuple, dict)):
            continue
        seen.add(id(found))
        for name in _HOLDERS + _CONTAINERS:
            try:
                queue.append(getattr(found, name, None))
            except Exception:  # properties of strangers may fail
                continue
    raise ValueError(f"view: no vtkRenderer in {type(view).__name__} (expected a vtkRenderer, a vtkRenderWindow, or an object that has one "
                     f"as {', '.join(_HOLDERS + _CONTAINERS)})")


def snapshot(view, size=None, unsupported="refuse"):
    """Freezes what a VTK view shows: a scene of one camera ("camera"), one frame (0) and an object for each visible actor.

    view: a vtkRenderer, a vtkRenderWindow, or an object that has one (PyVista, vedo, Mayavi); it needs no display and need
    not have been drawn. size: (width, height) in pixels, default the renderer's. What is no surface (lines, points, volumes,
    two-dimensional props) or cannot be honoured raises ValueError with its name, or is left out with a warning where
    unsupported is "skip". What the view's objects do afterwards does not change the snapshot.

    Returns a Snapshot, which render() takes as a scene. Its save("scene.json") writes it with its models, for generate().
    """
    return _snapshot(view, size, unsupported, 3)


def _snapshot(view, size, unsupported, level):
    if not isinstance(unsupported, str) or unsupported not in ("refuse", "skip"):
        _check.fail("unsupported", "refuse or skip", unsupported)
    width, height = _check.size(size)
    made = Snapshot()
    made.SetSkipUnsupported(unsupported == "skip")
    if not made.Take(_renderer(view), width, height):
        _check.raise_error(made)
    for line in made.GetLeftOut().splitlines():
        warnings.warn(f"left out: {line}", stacklevel=level)
    return made


class Truth(dict):
    """Outputs by name, and what they mean: props[id - 1] is the vtkProp of an object, K, R and t the camera (x right, y down,
    z forward; x_camera = R x_world + t; pixels from the image's top-left corner, centres at .5)."""

    def __init__(self, shot):
        super().__init__()
        self.props = [shot.GetProp(i) for i in range(shot.GetNumberOfProps())]
        K, R, t = [0.0] * 9, [0.0] * 9, [0.0] * 3
        shot.GetK(K)
        shot.GetR(R)
        shot.GetT(t)
        self.K, self.R, self.t = numpy.array(K).reshape(3, 3), numpy.array(R).reshape(3, 3), numpy.array(t)


def _cells(shot):
    with turn(shot):
        cells = shot.TraceCells()
        if cells is None:
            _check.raise_error(shot)
        return vtk_to_numpy(cells)


def _is_snapshot(view, size, unsupported):
    """What a snapshot was taken with is not said again."""
    if not isinstance(view, dgtkSnapshot):
        return False
    if size is not None:
        _check.fail("size", "none beside a snapshot", size)
    if not isinstance(unsupported, str) or unsupported != "refuse":
        _check.fail("unsupported", "none beside a snapshot", unsupported)
    return True


def truth(view, layers, size=None, unsupported="refuse", **options):
    """Exact ground truth of what a VTK view shows.

    layers: a name or a list of names of render(), and "cells": for each pixel the cell of the input of its actor's mapper
    (int64, -1 nothing; of composite data counted through its blocks, of glyphs the point that they stand at). Object ids are
    1, 2, ... in the order of the view's visible actors that have triangles, assemblies flattened. view: as in snapshot(), or
    a Snapshot. size and unsupported as in snapshot(), and not beside a Snapshot; options as in render(), and not where cells
    are all that is asked for. Returns a Truth: a dict of outputs, height x width, rows from the top. Raises ValueError for
    what cannot be honoured, with its name.
    """
    _check.names("layers", layers)
    names = [layers] if isinstance(layers, str) else list(layers)
    others = [name for name in names if name != "cells"]
    for name, value in () if others else options.items():
        _check.fail(name, "no option of render() beside cells alone", value)
    shot = view if _is_snapshot(view, size, unsupported) else _snapshot(view, size, unsupported, 3)
    outputs = Truth(shot)
    if others:
        outputs.update(render(shot, others, **options))
    if "cells" in names:
        outputs["cells"] = _cells(shot).reshape(shot.GetHeight(), shot.GetWidth())
    return outputs


def correspond(first, second):
    """Where the surface points that the pixels of a snapshot see are in another one: (xy, visibility).

    xy: height x width x 2, float64, pixels of the second image; NaN where it is nowhere. visibility: uint8, 0 no surface, or
    no longer there, 1 visible, 2 hidden by another object, 3 by its own, 4 outside the image, 5 behind the camera. The
    camera, actors and the points of their data may have moved; actors are the same objects, with the same cells.
    """
    for shot in (first, second):
        if not isinstance(shot, dgtkSnapshot):
            raise ValueError(f"expected two snapshots, found {type(shot).__name__}")
    shape = (first.GetHeight(), first.GetWidth())
    with turn(first):
        if not first.Correspond(second):
            _check.raise_error(first)
        return vtk_to_numpy(first.GetPositions()).reshape(shape + (2,)), vtk_to_numpy(first.GetClasses()).reshape(shape)


def visible_cells(view, size=None, unsupported="refuse"):
    """For each prop, in the order of their ids, the number of pixels that see each cell of its mapper's input (uint32).

    view, size and unsupported as in truth().
    """
    shot = view if _is_snapshot(view, size, unsupported) else _snapshot(view, size, unsupported, 3)
    with turn(shot):
        if not shot.CountCells():
            _check.raise_error(shot)
        return [vtk_to_numpy(shot.CountPixels(i)) for i in range(shot.GetNumberOfProps())]
