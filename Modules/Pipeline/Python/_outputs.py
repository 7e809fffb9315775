# SPDX-License-Identifier: BSD-3-Clause
"""What a renderer has drawn, as NumPy arrays and as what its documents say."""
import json

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy


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


def _tracked(cloud, tracks):
    """A point cloud with the tracks of its points, and what else their document says."""
    points = tracks.pop("points")
    return {**cloud, **tracks, "track": [numpy.array(point["track"]) for point in points]}


def outputs_of(renderer):
    """The outputs by name. Arrays share the memory of what was drawn, which lives as long as they do."""
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
            outputs[array.GetName()] = _tracked(outputs[array.GetName()], values)
        else:
            outputs[array.GetName()] = values
    return outputs
