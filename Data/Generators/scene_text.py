# SPDX-License-Identifier: BSD-3-Clause
"""Writing scenes: .json with one thing a line, and the thesis's .scene."""

import json
import math

from geometry import number


def quaternion(axis, degrees):
    """(w, x, y, z) of a turn about a unit axis or "x", "y", "z"."""
    axis = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}.get(axis, axis)
    half = math.radians(degrees) / 2
    return (math.cos(half), *(math.sin(half) * c for c in axis))


def product(p, q):
    """The turn q, then the turn p."""
    (a, b, c, d), (e, f, g, h) = p, q
    return (a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f,
            a * h + b * g - c * f + d * e)


Z_UP = quaternion("x", -90)


def standing(degrees):
    """A model whose axis z points up, stood upright and then turned about the vertical."""
    return product(quaternion("y", degrees), Z_UP)


def rounded(value, digits=6):
    """Numbers with few digits, whole ones without a point."""
    if isinstance(value, float):
        text = number(value, digits)
        return float(text) if "." in text else int(text)
    if isinstance(value, (list, tuple)):
        return [rounded(v, digits) for v in value]
    if isinstance(value, dict):
        return {k: rounded(v, digits) for k, v in value.items()}
    return value


def scene_json(scene):
    """The text of a .json scene: top-level keys one a line, and the things of each list one a line."""
    scene = rounded(scene)
    lines = []
    for key, value in scene.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            body = ",\n".join("    " + json.dumps(item) for item in value)
            lines.append(f"  {json.dumps(key)}: [\n{body}\n  ]")
        else:
            lines.append(f"  {json.dumps(key)}: {json.dumps(value)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _three(v):
    return " ".join(number(c, 6) for c in v)


class ThesisScene:
    """A .scene file: objects and cameras first, then key frames."""

    def __init__(self):
        self.definitions, self.count = [], 0
        self.tracks = []

    def model(self, tag, path, track):
        """track: frame -> (position, quaternion)."""
        self.definitions.append(f"glObject_{tag}: {path}")
        self.count += 1
        self.tracks.append(track)

    def light(self, name, diffuse, specular, ambient, position):
        self.definitions.append(f"glObject_Light: {name} ( {_three(diffuse)}, {_three(specular)}, {_three(ambient)} )")
        self.count += 1
        self.tracks.append(lambda frame: (position, (1, 0, 0, 0)))

    def camera(self, fov, near, far, aspect, eye, look_at, up=(0, 1, 0)):
        self.definitions.append(f"glObject_Camera: ( {number(fov)}, {number(near)}, {number(far)}, {number(aspect, 6)} )")
        self.definitions.append(f"[ {_three(eye)}, {_three(look_at)}, {_three(up)} ]")
        self.count += 1
        still = (1, 0, 0, 0)
        self.tracks += [lambda frame: (eye, still), lambda frame: (look_at, still)]

    def text(self, frames):
        lines = [str(self.count), *self.definitions, str(len(frames))]
        for frame in frames:
            lines.append(str(frame))
            for track in self.tracks:
                position, (w, x, y, z) = track(frame)
                lines.append(f"< {_three(position)} > {{ {number(w, 6)} , < {number(x, 6)}, {number(y, 6)}, {number(z, 6)} > }}")
        return "\n".join(lines) + "\n"
