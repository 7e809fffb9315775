# SPDX-License-Identifier: BSD-3-Clause
"""Procedural textures; all but the pictures with a fixed layout repeat at their borders."""

import math

from pictures import Canvas, clamp, mix, scale, smoothstep
from random_numbers import Lcg, fractal_noise, lattice_noise


def wood(size=256, seed=11, light=(0.72, 0.50, 0.29), dark=(0.44, 0.26, 0.12)):
    """Four boards along u, with grain, joints and a few knots."""
    warp = fractal_noise(size, size, 2, 4, seed, 3)
    fine = fractal_noise(size, size, 4, 64, seed + 1, 2)
    tone = [Lcg(seed + 7 + k).between(-0.10, 0.10) for k in range(4)]

    def pixel(x, y):
        board = y * 4 // size
        across = (y * 4 / size) % 1
        rings = math.sin(2 * math.pi * (across * 5 + 5 * warp[y][(x + 61 * board) % size] + board * 0.37))
        t = 0.5 + 0.28 * rings + 0.9 * (fine[y][x] - 0.5)
        colour = scale(mix(dark, light, clamp(t)), 1 + tone[board])
        return scale(colour, 0.45 + 0.55 * smoothstep(0.0, 0.05, min(across, 1 - across)))

    return Canvas.from_function(size, size, pixel)


def planks(size=256, seed=23):
    """A crate's panel: six upright planks with nails, framed by nothing."""
    grain = fractal_noise(size, size, 24, 2, seed, 4)
    blot = fractal_noise(size, size, 4, 4, seed + 5, 3)

    def pixel(x, y):
        plank = x * 6 // size
        across = (x * 6 / size) % 1
        tone = 0.86 + 0.28 * Lcg(seed + 31 + plank).unit()
        t = grain[(y + 53 * plank) % size][x]
        colour = mix((0.36, 0.22, 0.10), (0.80, 0.60, 0.36), clamp(0.15 + 0.9 * t))
        colour = scale(colour, tone * (0.82 + 0.36 * blot[y][x]))
        colour = scale(colour, 0.3 + 0.7 * smoothstep(0.0, 0.07, min(across, 1 - across)))
        for nail in (0.06, 0.94):
            d = math.hypot((across - 0.5) * size / 6, (y / size - nail) * size)
            colour = mix((0.18, 0.17, 0.17), colour, smoothstep(2.0, 3.4, d))
        return colour

    return Canvas.from_function(size, size, pixel)


def bricks(size=256, seed=37):
    rough = fractal_noise(size, size, 16, 16, seed, 3)
    blot = fractal_noise(size, size, 3, 3, seed + 3, 3)

    def pixel(x, y):
        row = y * 8 // size
        shift = x / size * 4 + (0.5 if row % 2 else 0)
        column = int(shift) % 4
        u, v = shift % 1, (y * 8 / size) % 1
        edge = min(min(u, 1 - u) * 2, min(v, 1 - v)) + 0.10 * (rough[y][x] - 0.5)
        random = Lcg(seed + 17 * row + column)
        brick = mix((0.52, 0.20, 0.13), (0.72, 0.36, 0.24), random.unit())
        brick = scale(brick, 0.72 + 0.5 * rough[y][x] + 0.25 * (blot[y][x] - 0.5))
        mortar = scale((0.70, 0.67, 0.61), 0.8 + 0.35 * rough[y][x])
        return mix(mortar, brick, smoothstep(0.07, 0.14, edge))

    return Canvas.from_function(size, size, pixel)


def roof(size=256, seed=41):
    """Rows of rounded tiles, lower rows under the upper ones' rims."""
    rough = fractal_noise(size, size, 16, 16, seed, 3)

    def pixel(x, y):
        row = y * 8 // size
        shift = x / size * 8 + (0.5 if row % 2 else 0)
        u, v = shift % 1 - 0.5, (y * 8 / size) % 1
        rim = 1.0 - 0.42 * (1 - math.sqrt(max(0.0, 1 - 3.6 * u * u)))
        below = v > rim
        random = Lcg(seed + 13 * row + int(shift) % 8)
        tile = mix((0.46, 0.15, 0.10), (0.66, 0.27, 0.17), random.unit())
        shade = (0.62 + 0.42 * v) * (1 - 0.9 * u * u) * (0.8 + 0.4 * rough[y][x])
        if below:
            return scale((0.20, 0.08, 0.06), 0.9 + 0.2 * rough[y][x])
        return scale(tile, shade * (0.55 + 0.45 * smoothstep(0.0, 0.06, min(0.5 - abs(u), 0.5))))

    return Canvas.from_function(size, size, pixel)


def grass(size=256, seed=53):
    """Turf from above: thousands of short strokes over mottled ground."""
    patches = fractal_noise(size, size, 4, 4, seed, 4)
    fine = fractal_noise(size, size, 64, 64, seed + 1, 2)
    canvas = Canvas.from_function(size, size, lambda x, y: scale(
        mix((0.20, 0.30, 0.09), (0.38, 0.46, 0.16), patches[y][x]), 0.7 + 0.6 * fine[y][x]))
    random = Lcg(seed + 2)
    for _ in range(5200):
        x, y = random.unit() * size, random.unit() * size
        angle, steps = random.between(-1.2, 1.2) - math.pi / 2, 4 + random.index(6)
        colour = mix((0.22, 0.38, 0.08), (0.62, 0.70, 0.28), random.unit() ** 1.6)
        colour = scale(colour, 0.75 + 0.5 * patches[int(y)][int(x)])
        for k in range(steps):
            canvas.blend(int(x + k * math.cos(angle)), int(y + k * math.sin(angle)), colour, 0.65, wrap=True)
    return canvas


def bark(width=128, height=256, seed=61):
    ridges = fractal_noise(width, height, 10, 3, seed, 4, 0.6)
    warp = fractal_noise(width, height, 3, 6, seed + 1, 3)

    def pixel(x, y):
        r = ridges[y][int(x + 14 * warp[y][x]) % width]
        crack = smoothstep(0.0, 0.16, abs(r - 0.5))
        colour = mix((0.17, 0.11, 0.07), (0.50, 0.40, 0.30), clamp(0.15 + 0.75 * crack * (0.5 + r)))
        return scale(mix(colour, (0.36, 0.40, 0.24), 0.35 * smoothstep(0.55, 0.75, warp[y][x])), 0.95)

    return Canvas.from_function(width, height, pixel)


def checker(size=128):
    def pixel(x, y):
        light = (x * 8 // size + y * 8 // size) % 2 == 0
        return (0.92, 0.91, 0.88) if light else (0.16, 0.19, 0.24)

    return Canvas.from_function(size, size, pixel)


def sky(width=512, height=256, seed=71):
    """From the horizon (bottom) to the zenith (top), with clouds; u goes once round."""
    clouds = fractal_noise(width, height, 5, 4, seed, 5, 0.55)

    def pixel(x, y):
        up = 1 - (y + 0.5) / height
        blue = mix((0.78, 0.87, 0.95), (0.20, 0.42, 0.78), up**0.6)
        cover = smoothstep(0.52, 0.74, clouds[y][x]) * smoothstep(0.02, 0.2, up) * (1 - 0.5 * smoothstep(0.6, 1.0, up))
        grey = mix((0.99, 0.99, 0.99), (0.80, 0.84, 0.90), smoothstep(0.66, 0.9, clouds[(y - 6) % height][x]))
        return mix(blue, grey, 0.9 * cover)

    return Canvas.from_function(width, height, pixel)


def leaves(size=256, seed=83):
    """A cluster of twigs and leaves; cut-out alpha."""
    canvas = Canvas(size, size, (0.25, 0.38, 0.10, 0.0))
    random = Lcg(seed)
    for _ in range(14):
        angle = random.between(0, 2 * math.pi)
        reach = size * random.between(0.2, 0.42)
        for k in range(int(reach)):
            t = k / reach
            canvas.disc(size / 2 + k * math.cos(angle + 0.4 * t), size / 2 + k * math.sin(angle + 0.4 * t),
                        1.6 - t, 1.6 - t, (0.30, 0.21, 0.12))
    for k in range(210):
        depth = k / 210
        radius = size * 0.40 * math.sqrt(random.unit()) * (1 - 0.15 * depth)
        angle = random.between(0, 2 * math.pi)
        x, y = size / 2 + radius * math.cos(angle), size / 2 + radius * math.sin(angle)
        turn = angle + random.between(-1.1, 1.1)
        reach = size * random.between(0.075, 0.125)
        colour = mix((0.13, 0.26, 0.06), (0.45, 0.60, 0.18), clamp(0.75 * depth + random.between(0, 0.3)))
        canvas.leaf(x, y, x + reach * math.cos(turn), y + reach * math.sin(turn), reach * 0.5, colour,
                    scale(colour, 1.25))
    canvas.bleed((0.25, 0.38, 0.10))
    return canvas


def pine(size=256, seed=89):
    """A fir's branch, its stem at the left edge's middle, needles to both sides; cut-out alpha."""
    canvas = Canvas(size, size, (0.12, 0.24, 0.12, 0.0))
    random = Lcg(seed)

    def twig(x, y, angle, reach, width):
        steps = int(reach)
        for k in range(0, steps, 2):
            t = k / reach
            px, py = x + k * math.cos(angle), y + k * math.sin(angle)
            canvas.disc(px, py, 1.8 - t, 1.8 - t, (0.30, 0.20, 0.12))
            for side in (-1, 1):
                lean = angle + side * random.between(0.5, 0.9)
                size_of = width * (1 - 0.7 * t) * random.between(0.8, 1.2)
                colour = mix((0.06, 0.17, 0.08), (0.24, 0.42, 0.17), random.unit() * (0.5 + 0.5 * t))
                canvas.leaf(px, py, px + size_of * math.cos(lean), py + size_of * math.sin(lean), 2.6, colour)

    for k in range(9):
        t = 0.06 + 0.1 * k
        for side in (-1, 1):
            twig(size * t, size / 2, side * 0.85, size * (0.52 - 0.42 * t), 15)
    twig(0, size / 2, 0, size * 0.97, 15)
    canvas.bleed((0.12, 0.24, 0.12))
    return canvas


def blades(width=256, height=128, seed=97):
    """Blades of grass, roots at the bottom; cut-out alpha."""
    canvas = Canvas(width, height, (0.30, 0.42, 0.12, 0.0))
    random = Lcg(seed)
    for k in range(70):
        depth = k / 70
        x = random.between(0.1, 0.9) * width
        reach = height * random.between(0.55, 0.97) * (1 - 0.35 * depth)
        lean = (x / width - 0.5) * 0.9 + random.between(-0.35, 0.35)
        colour = mix((0.15, 0.28, 0.06), (0.62, 0.72, 0.28), clamp(0.65 * depth + random.between(0, 0.35)))
        tip = clamp(x + lean * reach, 3, width - 3)
        canvas.leaf(x, height + 12, tip, height - reach, 9 - 3 * depth, colour, scale(colour, 1.2))
    canvas.bleed((0.30, 0.42, 0.12))
    return canvas


def fabric(size=128, seed=103):
    """A woven cloth with coloured stripes."""
    fuzz = lattice_noise(size, size, 64, 64, seed)

    def pixel(x, y):
        over = (x // 2 + y // 2) % 2 == 0
        stripe = (y * 4 // size) % 2 == 0
        warp = (0.78, 0.72, 0.60) if (x * 8 // size) % 2 else (0.70, 0.20, 0.18)
        weft = (0.18, 0.30, 0.50) if stripe else (0.80, 0.75, 0.64)
        thread = warp if over else weft
        return scale(thread, 0.72 + 0.26 * ((x % 2) ^ (y % 2)) + 0.3 * (fuzz[y][x] - 0.5))

    return Canvas.from_function(size, size, pixel)


def stone(size=256, seed=107):
    body = fractal_noise(size, size, 4, 4, seed, 6, 0.6)
    veins = fractal_noise(size, size, 3, 3, seed + 9, 4, 0.55)

    def pixel(x, y):
        vein = 1 - smoothstep(0.0, 0.035, abs(veins[y][x] - 0.5))
        colour = mix((0.56, 0.53, 0.48), (0.86, 0.83, 0.77), smoothstep(0.25, 0.75, body[y][x]))
        return mix(colour, (0.42, 0.38, 0.34), 0.55 * vein)

    return Canvas.from_function(size, size, pixel)


def ball(width=256, height=128):
    """A beach ball: six coloured gores and two white caps."""
    colours = [(0.86, 0.16, 0.13), (0.96, 0.95, 0.91), (0.10, 0.38, 0.72), (0.96, 0.95, 0.91), (0.97, 0.76, 0.12),
               (0.96, 0.95, 0.91)]

    def pixel(x, y):
        up = abs((y + 0.5) / height - 0.5) * 2
        u = (x + 0.5) / width * 6
        seam = smoothstep(0.0, 0.06, min(u % 1, 1 - u % 1))
        colour = mix(scale(colours[int(u) % 6], 0.75), colours[int(u) % 6], seam)
        return mix(colour, (0.93, 0.92, 0.89), smoothstep(0.86, 0.89, up))

    return Canvas.from_function(width, height, pixel)


def vase(width=256, height=256, seed=113):
    """White glaze with bands of blue: a meander, waves and leaves."""
    blot = fractal_noise(width, height, 6, 6, seed, 3)
    blue, white = (0.10, 0.20, 0.52), (0.93, 0.93, 0.90)
    meander = ("11111111", "10000001", "10111101", "10100101", "10110101", "10010101", "11110111", "00000000")

    def pixel(x, y):
        v, u = (y + 0.5) / height, (x + 0.5) / width
        amount = 0.0
        if any(abs(v - line) < 0.007 for line in (0.10, 0.135, 0.30, 0.73, 0.865, 0.90)):
            amount = 1.0
        elif 0.135 < v < 0.30:
            amount = float(meander[int((v - 0.15) / 0.135 * 8) % 8][int(u * 96) % 8]) if 0.15 < v < 0.285 else 0.0
        elif 0.30 < v < 0.73:
            s, t = (u * 8) % 1 - 0.5, (v - 0.515) / 0.19
            petal = abs(s) * 2 - 0.85 * max(0.0, 1 - t * t) ** 0.8
            amount = 1 - smoothstep(0.0, 0.08, abs(petal)) if abs(t) < 1 else 0.0
            amount = max(amount, 1 - smoothstep(0.10, 0.16, math.hypot(s * 2, t * 0.7)))
            edge = math.hypot((((u * 8 + 0.5) % 1) - 0.5) * 1.6, (abs(t) - 0.86) * 0.8)
            amount = max(amount, 1 - smoothstep(0.09, 0.13, edge))
        elif 0.73 < v < 0.865:
            amount = 1 - smoothstep(0.010, 0.016, abs(v - 0.80 - 0.035 * math.sin(2 * math.pi * u * 16)))
        tone = 0.9 + 0.2 * blot[y][x]
        return mix(white, scale(blue, tone), 0.95 * amount)

    return Canvas.from_function(width, height, pixel)


ALL = {
    "wood.png": wood, "planks.png": planks, "bricks.png": bricks, "roof.png": roof, "grass.png": grass,
    "bark.png": bark, "checker.png": checker, "sky.png": sky, "leaves.png": leaves, "pine.png": pine,
    "blades.png": blades, "fabric.png": fabric, "stone.png": stone, "ball.png": ball, "vase.png": vase,
}
