# SPDX-License-Identifier: BSD-3-Clause
"""Models for datasets of standard kinds: a chessboard for calibration, speckled surfaces for matching."""

import ac3d
from geometry import Mesh, box, ellipsoid
from pictures import Canvas
from random_numbers import fractal_noise, lattice_noise

SQUARE = 0.03
COLUMNS, ROWS = 10, 7  # squares; 9 x 6 inner corners


def chessboard():
    """10 x 7 squares of 30 mm in the plane z = 0 with a white margin of one square; the middle is the origin. Self-lit."""
    black = ac3d.material("black", (0, 0, 0), ambient=(0, 0, 0))
    white = ac3d.material("white", (0, 0, 0), ambient=(0, 0, 0), emission=(0.9, 0.9, 0.9))
    mesh = Mesh()
    for j in range(-1, ROWS + 1):
        for i in range(-1, COLUMNS + 1):
            inside = 0 <= i < COLUMNS and 0 <= j < ROWS
            x, y = (i - COLUMNS / 2) * SQUARE, (j - ROWS / 2) * SQUARE
            mesh.polygon([(x, y, 0), (x + SQUARE, y, 0), (x + SQUARE, y + SQUARE, 0), (x, y + SQUARE, 0)],
                         material=0 if inside and (i + j) % 2 == 0 else 1, two_sided=True)
    return ac3d.document([black, white], [ac3d.Node("board", mesh)])


def speckle_picture(size=256, seed=911):
    """Grey noise of many sizes: something to match everywhere and at every distance."""
    coarse = fractal_noise(size, size, 16, 16, seed, 3)
    fine = lattice_noise(size, size, 128, 128, seed + 1)

    def pixel(x, y):
        value = 0.5 + 1.3 * (coarse[y][x] - 0.5) + 0.8 * (fine[y][x] - 0.5)
        return (min(max(value, 0.04), 0.96),) * 3

    return Canvas.from_function(size, size, pixel)


def _self_lit(name, mesh):
    return ac3d.document([ac3d.material("speckled", (0.6, 0.6, 0.6), ambient=(0, 0, 0), emission=(0.5, 0.5, 0.5))],
                         [ac3d.Node(name, mesh, "../Textures/speckles.png", crease=40)])


def speckled_wall():
    """4 x 3 m in the plane z = 0, seen from +z; a picture for each metre."""
    mesh = Mesh()
    mesh.polygon([(-2, -1.5, 0), (2, -1.5, 0), (2, 1.5, 0), (-2, 1.5, 0)], [(0, 0), (4, 0), (4, 3), (0, 3)], two_sided=True)
    return _self_lit("wall", mesh)


def speckled_box():
    return _self_lit("box", box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5), 0, 1.0))


def speckled_ball():
    return _self_lit("ball", ellipsoid((0, 0, 0), (0.5, 0.5, 0.5), 32, 20))
