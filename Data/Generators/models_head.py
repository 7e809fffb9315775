# SPDX-License-Identifier: BSD-3-Clause
"""head.pov: a head for figure B.1, a sphere whose radius is a sum of soft bumps, with a painted skin.

Directions are given in degrees: `a` to the head's left of straight ahead (+z), `e` up. Units: about a decimetre."""

import math

import pov
from geometry import grid, turned
from pictures import Canvas, mix, scale, smoothstep
from random_numbers import fractal_noise

COLUMNS, ROWS = 58, 56
NECK = -58.0  # the sphere's lower limit, degrees
EYE_A, EYE_E = 19.0, 9.0


def _bump(a, e, at_a, at_e, wide, tall, power=1.0):
    """A bell of height 1 around (+-at_a, at_e)."""
    return math.exp(-((((abs(a) - at_a) / wide) ** 2 + ((e - at_e) / tall) ** 2) ** power))


def _radius(a, e):
    r = 1.0
    # skull: longer backwards, flat at the sides, narrower towards the jaw
    side = math.sin(math.radians(min(abs(a), 180)))
    r *= 1 - 0.17 * side**2 * math.cos(math.radians(e)) ** 2
    r += 0.13 * smoothstep(90, 180, abs(a)) * _bump(0, e, 0, 22, 1, 42)
    r += 0.10 * math.exp(-((e - 80) / 45) ** 2)
    front = math.exp(-(a / 62) ** 2)
    r += front * (0.04 * math.exp(-((e - 36) / 20) ** 2) - 0.03 * math.exp(-((e + 8) / 14) ** 2))
    # face: brows, sockets, cheeks
    r += 0.050 * _bump(a, e, 15, 19, 15, 6)
    r += 0.030 * _bump(a, e, 0, 20, 9, 7)
    r -= 0.095 * _bump(a, e, EYE_A - 1, EYE_E, 11.5, 7.5)
    r += 0.060 * _bump(a, e, EYE_A, EYE_E, 7.5, 5.2, 1.6)
    r += 0.060 * _bump(a, e, 31, -6, 13, 9)
    r -= 0.035 * _bump(a, e, 34, -24, 12, 11)
    # nose: bridge, tip, wings
    ridge = smoothstep(18, -8, e) if e > -8 else 1.0
    r += (0.055 + 0.20 * ridge) * math.exp(-((abs(a) / (4.6 + 2.2 * ridge)) ** 2)) * smoothstep(22, 10, e) * smoothstep(-15.5, -8.5, e)
    r += 0.075 * _bump(a, e, 7.2, -9.5, 4.2, 3.8)
    # mouth and chin
    r += 0.055 * _bump(a, e, 0, -26, 19, 11)
    r += 0.050 * _bump(a, e, 0, -21.4, 11, 2.7)
    r += 0.055 * _bump(a, e, 0, -28.0, 10, 3.0)
    r -= 0.045 * math.exp(-((e + 24.4) / 1.2) ** 2) * math.exp(-((a / 14) ** 4))
    r -= 0.022 * _bump(a, e, 14.5, -24.4, 2.5, 2.5)
    r -= 0.020 * _bump(a, e, 0, -17.5, 2.0, 2.6)
    r -= 0.035 * _bump(a, e, 0, -33, 11, 3.2)
    r += 0.17 * _bump(a, e, 0, -40, 14, 7)
    r += 0.035 * _bump(a, e, 48, -34, 22, 11)
    return r


def _point(a, e):
    r = _radius(a, e)
    ar, er = math.radians(a), math.radians(e)
    x, y, z = r * math.cos(er) * math.sin(ar), r * math.sin(er), r * math.cos(er) * math.cos(ar)
    if e < -38:
        # neck: an upright tube of radius 0.5 a little behind
        back = 0.5 - 0.5 * math.cos(ar)
        t = smoothstep(-44 + 8 * back, NECK, e)
        sink = -0.80 - 0.55 * smoothstep(-44, NECK, e)
        wide = 0.50 + 0.06 * smoothstep(-50, NECK, e)
        x, y, z = mix((x, y, z), (wide * math.sin(ar), sink, wide * math.cos(ar) - 0.2), t)
    return (x, y * 1.16, z)


def _directions():
    """Columns and rows of directions, denser in front and around the face."""
    columns = []
    for i in range(COLUMNS):
        s = 2 * i / COLUMNS - 1
        columns.append(180 * (0.42 * s + 0.58 * s**3))
    rows = []
    for j in range(ROWS + 1):
        t = j / ROWS
        rows.append(NECK + (90 - NECK) * (0.72 * t + 0.28 * t**3.2))
    return columns, rows


def _ear(side):
    """A shallow shell at the side of the head."""
    def shell(s, t):
        angle = 2 * math.pi * s
        radius = (0.0, 0.35, 0.62, 0.80, 0.92, 1.0, 1.0, 0.93, 0.72, 0.0)[round(t * 9)]
        depth = (0.05, 0.045, 0.05, 0.085, 0.125, 0.125, 0.09, 0.045, 0.0, -0.02)[round(t * 9)]
        lobe = 1 - 0.25 * smoothstep(0.2, -1.0, math.sin(angle))
        return (depth * side, 0.30 * radius * math.sin(angle) + (0.02 if t else 0.02),
                side * 0.19 * radius * lobe * math.cos(angle) * side)

    mesh = grid(18, 9, shell, lambda s, t: (0.02 + 0.05 * (1 if side > 0 else 0) + 0.02 * s, 0.03 + 0.03 * t), 0, closed=True)
    if side > 0:
        for f in mesh.faces:
            f.corners.reverse()
    return mesh.moved(lambda p: tuple(0.85 * c + d for c, d in zip(turned(turned(p, "y", -26 * side), "x", 10), (0.835 * side, 0.06, -0.10))))


def head_mesh():
    columns, rows = _directions()
    bottom, span = rows[0], 90 - rows[0]

    def uv(s, t):
        i = round(s * COLUMNS)
        a = 180.0 if i == COLUMNS else columns[i]
        return (a / 360 + 0.5, 0.1 + 0.9 * (rows[round(t * ROWS)] - bottom) / span)

    mesh = grid(COLUMNS, ROWS, lambda s, t: _point(columns[round(s * COLUMNS) % COLUMNS], rows[round(t * ROWS)]) if t < 1
                else (0.0, _point(0, 90)[1], 0.0), uv, 0, closed=True)
    for side in (-1, 1):
        mesh.append(_ear(side))
    return mesh


def head_skin(size=448, seed=701):
    """u: direction around, v: up, as head_mesh maps them; the lowest tenth is the ears' plain skin."""
    tone, fine = fractal_noise(size, size, 5, 5, seed, 4), fractal_noise(size, size, 40, 40, seed + 1, 3)
    strands = fractal_noise(size, size, 110, 5, seed + 2, 3)
    skin, hair = (0.86, 0.64, 0.51), (0.23, 0.14, 0.085)

    def haired(colour, a, e, x, y):
        wave = 5 * (tone[y][x] - 0.5) + 3 * (fine[y][x] - 0.5)
        line = 44 - 0.0040 * a * a + 8 * smoothstep(20, 45, abs(a)) * smoothstep(75, 50, abs(a)) + wave
        line = mix(line, -28 + wave, smoothstep(76, 92, abs(a)))
        return mix(colour, scale(hair, 0.55 + 1.0 * strands[y][x]), smoothstep(-1.6, 1.6, e - line))

    def shaded(colour, e):
        return scale(colour, 1 - 0.18 * smoothstep(-40, -56, e))

    def pixel(x, y):
        u, v = (x + 0.5) / size, 1 - (y + 0.5) / size
        base = scale(skin, 0.93 + 0.10 * tone[y][x] + 0.06 * (fine[y][x] - 0.5))
        if v < 0.1:
            return mix(base, (0.84, 0.52, 0.42), 0.25)
        a, e = (u - 0.5) * 360, NECK + (90 - NECK) * (v - 0.1) / 0.9
        if abs(a) > 45 or e > 35:
            return shaded(haired(base, a, e, x, y), e)
        colour = mix(base, (0.86, 0.48, 0.40), 0.35 * _bump(a, e, 30, -8, 13, 9) + 0.22 * _bump(a, e, 0, -7, 8, 8))
        # lips
        upper = -22.0 + 0.9 * math.exp(-((abs(a) - 3.5) / 2.5) ** 2) - 0.014 * a * a
        lower = -30.0 + 0.030 * a * a
        lips = smoothstep(-0.6, 0.6, min(upper + 1.6 - e, e - lower)) * smoothstep(15.5, 13.5, abs(a))
        colour = mix(colour, (0.70, 0.33, 0.30), 0.85 * lips)
        colour = mix(colour, (0.30, 0.12, 0.11), 0.85 * math.exp(-((e + 24.4 + 0.006 * a * a) / 0.75) ** 2) * smoothstep(16, 13, abs(a)))
        # eyes: white, iris, pupil inside the lids
        dx, dy = abs(a) - EYE_A, e - EYE_E
        lid_up, lid_down = 3.3 * max(0.0, 1 - (dx / 8.2) ** 2) ** 0.8, -2.6 * max(0.0, 1 - (dx / 8.2) ** 2) ** 0.9
        inside = smoothstep(-0.35, 0.35, min(lid_up - dy, dy - lid_down)) if abs(dx) < 8.2 else 0.0
        iris = math.hypot(dx, dy * 0.98 - 0.3)
        eye = mix((0.30, 0.45, 0.52), (0.94, 0.93, 0.91), smoothstep(2.7, 3.2, iris))
        eye = mix((0.03, 0.03, 0.04), eye, smoothstep(1.1, 1.5, iris))
        eye = mix((1, 1, 1), eye, smoothstep(0.45, 0.75, math.hypot(a - math.copysign(EYE_A, a) + 1.0, dy - 1.2)))
        eye = scale(eye, 0.72 + 0.28 * smoothstep(0.0, 1.8, lid_up - dy))
        colour = mix(colour, eye, inside)
        if abs(dx) < 9.5:
            lash = max(math.exp(-((dy - lid_up) / 0.55) ** 2), 0.35 * math.exp(-((dy - lid_down) / 0.4) ** 2))
            colour = mix(colour, (0.16, 0.09, 0.07), 0.85 * lash * smoothstep(9.2, 7.2, abs(dx)))
        # brows and hair
        arch = 17.8 + 1.8 * (1 - ((abs(a) - 19) / 13) ** 2)
        brow = smoothstep(1.6, 0.5, abs(e - arch)) * smoothstep(7, 9.5, abs(a)) * smoothstep(33, 26, abs(a))
        colour = mix(colour, hair, 0.8 * brow * (0.55 + 0.6 * strands[y][(x * 3) % size]))
        return shaded(haired(colour, a, e, x, y), e)

    return Canvas.from_function(size, size, pixel)


def head():
    return pov.document("A head: 3.3 thousand vertices, looking along -z in POV-Ray's left-handed axes.", "Head", head_mesh(),
                        pov.image_texture("../Textures/head.png", 0.12))
