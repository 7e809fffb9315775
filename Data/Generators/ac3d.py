# SPDX-License-Identifier: BSD-3-Clause
"""AC3D files."""

from geometry import number


class Node:
    """An object of an AC3D file: a mesh with a texture, where it stands in its parent, and its kids."""

    def __init__(self, name, mesh=None, texture=None, repeat=None, place=None, turn=None, crease=None, kids=()):
        self.name, self.mesh, self.texture, self.repeat = name, mesh, texture, repeat
        self.place, self.turn, self.crease, self.kids = place, turn, crease, list(kids)


def material(name, colour, specular=0.0, shine=10, opacity=1.0, ambient=None, emission=(0, 0, 0)):
    def three(c):
        return " ".join(number(v, 3) for v in c)

    return (f'MATERIAL "{name}" rgb {three(colour)} amb {three(ambient or tuple(0.3 * c for c in colour))} emis {three(emission)} '
            f"spec {three((specular,) * 3)} shi {shine} trans {number(1 - opacity, 3)}")


def _lines(node, digits):
    yield "OBJECT group" if node.mesh is None else "OBJECT poly"
    yield f'name "{node.name}"'
    if node.place:
        yield "loc " + " ".join(number(v, digits) for v in node.place)
    if node.turn:
        yield "rot " + " ".join(number(v, 6) for row in zip(*node.turn) for v in row)
    if node.texture:
        yield f'texture "{node.texture}"'
    if node.repeat:
        yield "texrep " + " ".join(number(v) for v in node.repeat)
    if node.crease:
        yield f"crease {number(node.crease)}"
    if node.mesh is not None:
        yield f"numvert {len(node.mesh.vertices)}"
        for v in node.mesh.vertices:
            yield " ".join(number(c, digits) for c in v)
        yield f"numsurf {len(node.mesh.faces)}"
        for f in node.mesh.faces:
            yield f"SURF 0x{(4 if f.strip else 0) | (0x10 if f.smooth else 0) | (0x20 if f.two_sided else 0):x}"
            yield f"mat {f.material}"
            yield f"refs {len(f.corners)}"
            for index, (u, v) in f.corners:
                yield f"{index} {number(u)} {number(v)}"
    yield f"kids {len(node.kids)}"
    for kid in node.kids:
        yield from _lines(kid, digits)


def document(materials, nodes, digits=4):
    """The text of an AC3D file."""
    lines = ["AC3Db", *materials, "OBJECT world", f"kids {len(nodes)}"]
    for node in nodes:
        lines += _lines(node, digits)
    return "\n".join(lines) + "\n"
