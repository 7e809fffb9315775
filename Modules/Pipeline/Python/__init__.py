# SPDX-License-Identifier: BSD-3-Clause
"""DGTk: images and exact ground truth of described 3D scenes.

    import dgtk
    scene = dgtk.load("scene.json")
    depth = dgtk.render(scene, "depth", camera="left", frame=3)   # numpy, height x width, float64

dgtkScene and dgtkRenderer are VTK classes and can be used as such.
"""
import json
import sys

from ._build import EXECUTABLE, PYTHON, VERSION

__version__ = VERSION
__all__ = ["dgtkRenderer", "dgtkScene", "load", "render"]

if sys.version_info[:2] != PYTHON:
    raise ImportError("dgtk %s is for Python %d.%d (%s), this is %d.%d (%s)" % (VERSION, *PYTHON, EXECUTABLE, *sys.version_info[:2], sys.executable))
try:
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy

    from .dgtkPipeline import dgtkRenderer, dgtkScene
except ImportError as error:
    raise ImportError("dgtk %s needs NumPy and VTK as %s has them (Debian: python3-numpy, python3-vtk9), this is %s: %s"
                      % (VERSION, EXECUTABLE, sys.executable, error)) from None


def load(path):
    """Returns the loaded dgtkScene; raises ValueError with one line when the file cannot be used."""
    scene = dgtkScene()
    if not scene.Load(str(path)):
        raise ValueError(scene.GetErrorMessage())
    return scene


def _numbers(lines):
    return numpy.array([[float(word) for word in line.split()] for line in lines])


def _calibration(text):
    """The thesis's matrices of a calibration file, and what they mean in the axes of the camera (x right, y down, z forward)."""
    lines = text.splitlines()
    projection, pose = _numbers(lines[1:4]), _numbers(lines[5:8])
    x, y, width, height = (int(word) for word in lines[9].split())
    pixels = numpy.array([[0.5 * width, 0, x + 0.5 * width], [0, 0.5 * height, y + 0.5 * height], [0, 0, 1]])
    flip = numpy.diag([1.0, -1.0, -1.0])  # OpenGL's axes
    calibration = {"thesis_K": projection, "thesis_Rt": pose, "viewport": (x, y, width, height)}
    if abs(projection[2, 2] + 1) < 1e-12:  # a perspective: w is the distance in front of the camera
        K = numpy.array([[1, 0, 0], [0, -1, height], [0, 0, 1.0]]) @ pixels @ projection @ flip
        calibration.update(K=K, R=flip @ pose[:, :3], t=flip @ pose[:, 3])
    return calibration


def _points(data):
    """Columns of a binary point cloud as arrays: x (n x 3), normal, color, object, triangle."""
    header, body = data.split(b"end_header\n", 1)
    types = {"double": "<f8", "float": "<f4", "uchar": "u1", "uint": "<u4"}
    columns = [line.split()[1:] for line in header.decode().splitlines() if line.startswith("property ")]
    rows = numpy.frombuffer(body, [(name, types[kind]) for kind, name in columns])
    vectors = {"x": ("x", "y", "z"), "normal": ("nx", "ny", "nz"), "color": ("red", "green", "blue")}
    cloud = {name: numpy.stack([rows[part] for part in parts], axis=-1) for name, parts in vectors.items()}
    return {**cloud, "object": rows["object"].copy(), "triangle": rows["triangle"].copy()}


_READERS = {
    "json": lambda data: json.loads(data),
    "txt": lambda data: _calibration(data.decode()),
    "ply": _points,
}


def _merged(first, second):
    """A dict of columns with what another document says of the same rows, in a list of dicts, and beside."""
    merged = dict(first)
    for key, value in second.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            for column in value[0]:
                merged.setdefault(column, [numpy.array(row[column]) for row in value])
        else:
            merged.setdefault(key, value)
    return merged


def _outputs(renderer):
    outputs = {}
    for i in range(renderer.GetNumberOfOutputs()):
        array = renderer.GetOutput(i)
        values = vtk_to_numpy(array)
        form = renderer.GetOutputFormat(i)
        if form:
            data = values.tobytes()
            values = _READERS[form](data) if form in _READERS else data.decode()
        elif renderer.IsOutputImage(i):
            channels = array.GetNumberOfComponents()
            values = values.reshape((renderer.GetHeight(), renderer.GetWidth()) + ((channels,) if channels > 1 else ()))
        part = renderer.GetOutputPart(i)
        if part:
            outputs.setdefault(array.GetName(), {})[part] = values
        elif array.GetName() in outputs:
            outputs[array.GetName()] = _merged(outputs[array.GetName()], values)
        else:
            outputs[array.GetName()] = values
    return outputs


def _option(value):
    """The text of an option's value, as the command line has it."""
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, str):
        return value
    try:
        words = [str(word) for word in value]
    except TypeError:
        return str(value)
    return ",".join(word.replace("\\", "\\\\").replace(",", "\\,") for word in words)


def render(scene, layers, camera=None, frame=None, size=None, renderer=None, keep=None, **options):
    """Renders one layer, or several, of one camera at one frame.

    layers: a name ("depth"), or a list of names. camera, frame: the scene's first unless said otherwise.
    size: (width, height) in pixels. renderer: the name of what makes colour. keep: a dgtkRenderer to use again, which
    saves loading the scene's geometry; it may be given as `renderer`, too. Options, which are listed below, are those of the command line: numbers, names,
    lists of names or numbers, and True for a switch.

    A list of names gives a dict of outputs by name; one name gives its output, or a dict where the layer has several
    ("flow_forward" and "flow_forward_class"). An image is a numpy array of height x width (x channels) with the values
    of the file that `dgtk render` writes; boxes and amodal are what their JSON says; calibration is a dict of K, R, t,
    the viewport and the thesis's matrices; points a dict of arrays and tracks; ldi a dict of count, rgba, depth and
    splat; pov a string. All are the caller's. Raises RuntimeError with one line on failure. May be called from any
    thread, and in forked processes.
    """
    if isinstance(renderer, str):
        options["renderer"], renderer = renderer, None
    renderer = keep or renderer or dgtkRenderer()
    renderer.SetScene(scene)
    renderer.SetCamera(camera or scene.GetCameraName(0))
    renderer.SetFrame(scene.GetFirstFrame() if frame is None else frame)
    renderer.SetSize(*(size or (0, 0)))
    renderer.ClearOptions()
    for name, value in options.items():
        renderer.SetOption(name, _option(value))
    names = [layers] if isinstance(layers, str) else list(layers)
    if not renderer.RenderLayers(",".join(names)):
        raise RuntimeError(renderer.GetErrorMessage())
    outputs = _outputs(renderer)
    return next(iter(outputs.values())) if isinstance(layers, str) and len(outputs) == 1 else outputs


for _line in dgtkRenderer.GetOptions().splitlines() if render.__doc__ else ():  # none with python -OO
    _name, _value, _default, _help = _line.split("\t")
    render.__doc__ += f"\n    {_name}: {_help}" + (f" [{_default}]" if _value and _default else "")


from ._vtk import (Snapshot, Truth, correspond, dgtkDepthFromZBuffer, dgtkGroundTruthSource, dgtkPointCloudSource,  # noqa: E402: they render
                   dgtkSnapshot, snapshot, truth, visible_cells)

__all__ += ["Snapshot", "Truth", "correspond", "dgtkDepthFromZBuffer", "dgtkGroundTruthSource", "dgtkPointCloudSource", "dgtkSnapshot",
            "snapshot", "truth", "visible_cells"]
