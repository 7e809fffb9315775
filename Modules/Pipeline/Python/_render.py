# SPDX-License-Identifier: BSD-3-Clause
"""Layers of a picture as arrays."""
import contextlib
import os
import threading

from . import _check
from ._outputs import outputs_of
from .dgtkPipeline import dgtkRenderer, dgtkScene


def require_scene(scene):
    if not isinstance(scene, dgtkScene):
        _check.fail("scene", "what load() or scene() returns", scene)


def with_options(function, lines):
    """Adds the list of options to a docstring, from lines of name, what stands for a value, default and help."""
    if not function.__doc__:  # python -OO
        return
    function.__doc__ += "\n    Options:\n"
    for line in lines.splitlines():
        name, value, default, text = line.split("\t")
        function.__doc__ += f"\n    {name}: {text}" + (f" [{default}]" if value and default else "")


@contextlib.contextmanager
def turn(shared):
    """Threads that share an object use it one after the other, none of them inside its own use (a signal's handler). A forked process
    has turns of its own."""
    lock, users = shared.__dict__.setdefault(f"_turn{os.getpid()}", (threading.RLock(), []))
    with lock:
        if users:
            raise RuntimeError(f"the {type(shared).__name__} is in use by this thread already (a signal handler needs one of its own)")
        try:
            users.append(None)
            yield
        finally:
            users.clear()


def render(scene, layers, camera=None, frame=None, size=None, renderer=None, keep=None, **options):
    """Renders one layer, or several, of one camera at one frame.

    scene: of `load()` or `scene()`. layers: a name ("depth"), or a list of names. camera: a name; default: the scene's
    first. frame: an integer; default: the scene's first. size: (width, height) in pixels; default: the camera's own,
    else 640 x 480. renderer: the name of what makes colour. keep: a `dgtkRenderer()` to use again, which saves building
    the scene's geometry; it may be given as `renderer`, too. Options, which are listed below, are those of
    `dgtk render`: numbers, names, lists of names or numbers, and True for a switch.

    A list of names gives a dict of outputs by name; one name gives its output, or a dict where the layer has several
    ("flow_forward" and "flow_forward_class"). An image is an array, height x width (x channels), rows from top to
    bottom, with the values of the file that `dgtk render` writes: `depth` float64, z in the camera frame in the scene's
    units, +inf where there is nothing; `objects` uint32 ids, 0 where there is nothing; Documentation/Formats/layers.md
    has type, unit and frame of each. `boxes` and `amodal` are what their JSON says; `calibration` is a dict of `K`, `R`,
    `t` (x_camera = R x_world + t; x right, y down, z forward; an orthographic camera has none of these three),
    `viewport` and the thesis's matrices; `points` a dict of arrays and tracks; `ldi` a dict of `count`, `rgba`, `depth`
    and `splat`; `pov` a string. All are the caller's.

    Raises ValueError for a wrong request and RuntimeError for what the machine cannot do (no OpenGL, no memory), and in
    a signal handler for the renderer of the picture that it interrupts, one line each. Other threads run meanwhile, and
    may render. Works in forked processes, too.
    """
    require_scene(scene)
    if isinstance(renderer, str):
        options["renderer"], renderer = renderer, None
    for name, given in (("renderer", renderer), ("keep", keep)):
        if given is not None and not isinstance(given, dgtkRenderer):
            _check.fail(name, "a dgtkRenderer" + (" or a name" if name == "renderer" else ""), given)
    names = _check.names("layers", layers)
    renderer = keep or renderer or dgtkRenderer()
    with turn(renderer):
        renderer.SetScene(scene)
        renderer.SetCamera(scene.GetCameraName(0) if camera is None else _check.text("camera", camera))
        renderer.SetFrame(scene.GetFirstFrame() if frame is None else _check.integer("frame", frame))
        renderer.SetSize(*_check.size(size))
        renderer.ClearOptions()
        for name, value in _check.options(options):
            renderer.SetOption(name, value)
        if not renderer.RenderLayers(names):
            _check.raise_error(renderer)
        outputs = outputs_of(renderer)
    return next(iter(outputs.values())) if isinstance(layers, str) and len(outputs) == 1 else outputs


with_options(render, dgtkRenderer.GetOptions())
