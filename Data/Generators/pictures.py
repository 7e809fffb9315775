# SPDX-License-Identifier: BSD-3-Clause
"""Small pictures: a canvas of sRGB (and alpha) in [0, 1], written as PNG or PCX."""

import math
import struct
import zlib

LEVEL = 9  # of compression


def clamp(value, low=0.0, high=1.0):
    return low if value < low else high if value > high else value


def mix(a, b, t):
    """Colour or number between a (t = 0) and b (t = 1)."""
    if isinstance(a, tuple):
        if len(a) == len(b) == 3:  # thrice as quick as what follows
            p, q, r = a
            u, v, w = b
            return p + (u - p) * t, q + (v - q) * t, r + (w - r) * t
        return tuple(p + (q - p) * t for p, q in zip(a, b))
    return a + (b - a) * t


def smoothstep(low, high, value):
    t = clamp((value - low) / (high - low))
    return t * t * (3 - 2 * t)


def scale(colour, factor):
    if len(colour) == 3:
        r, g, b = colour
        return r * factor, g * factor, b * factor
    return tuple(c * factor for c in colour)


class Canvas:
    """Rows from the top; a pixel is a tuple of 3 or 4 numbers in [0, 1]."""

    def __init__(self, width, height, fill):
        self.width, self.height = width, height
        self.rows = [[fill] * width for _ in range(height)]

    @classmethod
    def from_function(cls, width, height, function):
        """function(x, y) -> colour, for every pixel."""
        canvas = cls(width, height, None)
        canvas.rows = [[function(x, y) for x in range(width)] for y in range(height)]
        return canvas

    def blend(self, x, y, colour, amount, wrap=False):
        """Draws over a pixel; on a canvas with alpha, alpha grows and colour moves to `colour`."""
        if wrap:
            x, y = x % self.width, y % self.height
        if amount <= 0 or not (0 <= x < self.width and 0 <= y < self.height):
            return
        amount = min(amount, 1.0)
        old = self.rows[y][x]
        new = mix(old[:3], colour, amount)
        self.rows[y][x] = new + (old[3] + (1 - old[3]) * amount,) if len(old) == 4 else new

    def disc(self, cx, cy, rx, ry, colour, soft=1.0, angle=(1.0, 0.0), wrap=False):
        """A filled ellipse with a soft rim of `soft` pixels; angle = (cos, sin) of its long axis."""
        reach = int(max(rx, ry) + soft + 1)
        cos, sin = angle
        for y in range(int(cy) - reach, int(cy) + reach + 1):
            for x in range(int(cx) - reach, int(cx) + reach + 1):
                dx, dy = x + 0.5 - cx, y + 0.5 - cy
                along, across = dx * cos + dy * sin, dy * cos - dx * sin
                distance = ((along / rx) ** 2 + (across / ry) ** 2) ** 0.5
                self.blend(x, y, colour, clamp((1 - distance) * min(rx, ry) / soft + 0.5), wrap)

    def leaf(self, x0, y0, x1, y1, width, colour, rib=None):
        """A pointed leaf or blade from (x0, y0) to its tip (x1, y1); `width` at its widest, a third along."""
        length = ((x1 - x0) ** 2 + (y1 - y0) ** 2) ** 0.5
        cos, sin = (x1 - x0) / length, (y1 - y0) / length
        margin = int(width) + 2
        for y in range(int(min(y0, y1)) - margin, int(max(y0, y1)) + margin + 1):
            for x in range(int(min(x0, x1)) - margin, int(max(x0, x1)) + margin + 1):
                dx, dy = x + 0.5 - x0, y + 0.5 - y0
                t = (dx * cos + dy * sin) / length
                if not 0 <= t <= 1:
                    continue
                across = dy * cos - dx * sin
                half = width * 0.5 * 2.6 * t**0.5 * (1 - t)
                amount = clamp(half - abs(across) + 0.5)
                if amount > 0:
                    tone = scale(colour, 0.82 + 0.3 * t + (0.1 if across > 0 else -0.06))
                    if rib and abs(across) < 0.8:
                        tone = rib
                    self.blend(x, y, tone, amount)

    def bleed(self, background):
        """Colours of empty pixels become those of their surroundings, so that no fringe shows at cut-outs."""
        known = [[p[3] > 0.02 for p in row] for row in self.rows]
        colours = [[p[:3] for p in row] for row in self.rows]
        for _ in range(6):
            grown = []
            for y in range(self.height):
                for x in range(self.width):
                    if known[y][x]:
                        continue
                    near = [colours[j][i] for j in (y - 1, y, y + 1) for i in (x - 1, x, x + 1)
                            if 0 <= j < self.height and 0 <= i < self.width and known[j][i]]
                    if near:
                        grown.append((x, y, tuple(sum(c) / len(near) for c in zip(*near))))
            for x, y, colour in grown:
                known[y][x], colours[y][x] = True, colour
        self.rows = [[(colours[y][x] if known[y][x] else background) + (self.rows[y][x][3],)
                      for x in range(self.width)] for y in range(self.height)]

    def bytes_of_rows(self):
        return [bytes([int((0.0 if c < 0.0 else 1.0 if c > 1.0 else c) * 255 + 0.5) for pixel in row for c in pixel]) for row in self.rows]


ABSOLUTE = bytes(v if v < 128 else 256 - v for v in range(256))


def minus(a, b):
    """Differences of bytes, modulo 256, all at once: the upper bits of bytes alone need their own carry."""
    high = int.from_bytes(bytes([128]) * len(a), "little")
    x, y = int.from_bytes(a, "little"), int.from_bytes(b, "little")
    return (((x | high) - (y & ~high)) ^ ((x ^ y ^ high) & high)).to_bytes(len(a), "little")


def png(canvas):
    """The canvas as the bytes of a PNG file, 8 bits a channel."""
    channels = len(canvas.rows[0][0])
    raw, above = bytearray(), bytes(canvas.width * channels)
    for row in canvas.bytes_of_rows():
        left = bytes(channels) + row[:-channels]
        sub, up = minus(row, left), minus(row, above)
        cost = [sum(line.translate(ABSOLUTE)) for line in (sub, up)]
        raw += b"\1" + sub if cost[0] <= cost[1] else b"\2" + up
        above = row
    header = struct.pack(">IIBBBBB", canvas.width, canvas.height, 8, 6 if channels == 4 else 2, 0, 0, 0)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(raw), LEVEL))
            + chunk(b"IEND", b""))


def png_contents(data):
    """Header and uncompressed rows of a PNG file: what stays when another zlib compresses it."""
    at, header, packed = 8, b"", b""
    while at < len(data):
        length, = struct.unpack(">I", data[at:at + 4])
        kind, body = data[at + 4:at + 8], data[at + 8:at + 8 + length]
        header += body if kind == b"IHDR" else b""
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    return header, zlib.decompress(packed)


def pcx(canvas):
    """The canvas as an 8-bit PCX file with a palette of 6 x 7 x 6 colours, ordered dither."""
    levels = (6, 7, 6)
    palette = [(r * 255 // 5, g * 255 // 6, b * 255 // 5) for r in range(6) for g in range(7) for b in range(6)]
    bayer = ((0, 8, 2, 10), (12, 4, 14, 6), (3, 11, 1, 9), (15, 7, 13, 5))
    stride = canvas.width + canvas.width % 2
    data = bytearray(struct.pack("<BBBBHHHHHH48xBBHHHH54x", 10, 5, 1, 8, 0, 0, canvas.width - 1, canvas.height - 1,
                                 72, 72, 0, 1, stride, 1, canvas.width, canvas.height))
    for y, row in enumerate(canvas.rows):
        line = []
        for x, pixel in enumerate(row):
            threshold = (bayer[y % 4][x % 4] + 0.5) / 16
            r, g, b = (min(n - 1, int(clamp(c) * (n - 1) + threshold)) for c, n in zip(pixel, levels))
            line.append((r * 7 + g) * 6 + b)
        line += [0] * (stride - len(line))
        at = 0
        while at < stride:
            run = 1
            while at + run < stride and run < 63 and line[at + run] == line[at]:
                run += 1
            if run > 1 or line[at] >= 0xC0:
                data.append(0xC0 | run)
            data.append(line[at])
            at += run
    data.append(12)
    for r, g, b in palette + [(0, 0, 0)] * (256 - len(palette)):
        data += bytes((r, g, b))
    return bytes(data)


def radiance(width, height, function):
    """The bytes of a Radiance picture (RGBE, not compressed) of function(x, y) -> linear light."""
    body = bytearray()
    for y in range(height):
        for x in range(width):
            colour = [round(c * 1024) / 1024 for c in function(x, y)]  # few bits: no last bit of a sine shows
            largest = max(colour)
            exponent = math.frexp(largest)[1] if largest > 1e-30 else -128
            body += bytes(int(c * 256 / 2.0 ** exponent) for c in colour) + bytes([exponent + 128]) if largest > 1e-30 else bytes(4)
    return f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() + bytes(body)
