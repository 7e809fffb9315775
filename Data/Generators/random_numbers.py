# SPDX-License-Identifier: BSD-3-Clause
"""Repeatable random numbers and periodic noise, the same on every Python."""


class Lcg:
    """A 64-bit linear congruential generator (Knuth's MMIX constants); the upper 31 bits are used."""

    def __init__(self, seed):
        self.state = (seed * 2862933555777941757 + 3037000493) % 2**64
        self.next()

    def next(self):
        """An integer in [0, 2^31)."""
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
        return self.state >> 33

    def unit(self):
        """A number in [0, 1)."""
        return self.next() / 2**31

    def between(self, low, high):
        return low + (high - low) * self.unit()

    def index(self, count):
        return self.next() % count


def lattice_noise(width, height, cells_x, cells_y, seed):
    """Rows of smooth value noise in [0, 1] that repeats at the borders."""
    random = Lcg(seed)
    lattice = [[random.unit() for _ in range(cells_x)] for _ in range(cells_y)]
    columns = []
    for x in range(width):
        at = x * cells_x / width
        cell = int(at)
        t = at - cell
        columns.append((cell % cells_x, (cell + 1) % cells_x, t * t * (3 - 2 * t)))
    rows = []
    for y in range(height):
        at = y * cells_y / height
        cell = int(at)
        t = at - cell
        t = t * t * (3 - 2 * t)
        upper, lower = lattice[cell % cells_y], lattice[(cell + 1) % cells_y]
        line = [a + (b - a) * t for a, b in zip(upper, lower)]
        rows.append([line[i] + (line[j] - line[i]) * s for i, j, s in columns])
    return rows


def fractal_noise(width, height, cells_x, cells_y, seed, octaves=4, gain=0.5):
    """Octaves of lattice noise, each with twice the cells, scaled to [0, 1]."""
    total = [[0.0] * width for _ in range(height)]
    amplitude, sum_of_amplitudes = 1.0, 0.0
    for octave in range(octaves):
        layer = lattice_noise(width, height, cells_x << octave, cells_y << octave, seed + 101 * octave)
        total = [[value + amplitude * more for value, more in zip(row, extra)] for row, extra in zip(total, layer)]
        sum_of_amplitudes += amplitude
        amplitude *= gain
    return [[value / sum_of_amplitudes for value in row] for row in total]
