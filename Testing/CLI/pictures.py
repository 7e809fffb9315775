# SPDX-License-Identifier: BSD-3-Clause
"""PNG and OpenEXR files, read and written without the libraries under test."""
import struct
import zlib

import numpy as np


def read_png(path, wanted=None):
    """8- and 16-bit PNG as (H, W, C), without the library under test. `wanted`: (bits a channel, channels) that it must have."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, bits, color = struct.unpack(">IIBB", body[:10])
        packed += body if kind == b"IDAT" else b""
        at += 12 + size
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    if wanted not in (None, (bits, channels)):
        raise AssertionError(f"{path}: {bits} bits, {channels} channels")
    step = channels * bits // 8
    raw = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + width * step)
    rows = unfiltered(raw[:, 0], raw[:, 1:].reshape(height, width, step))
    kind = np.dtype(">u2") if bits == 16 else np.dtype(np.uint8)
    return rows.view(kind).reshape(height, width, channels).astype(np.int64)


def unfiltered(kinds, differences):
    """The bytes of a PNG, of what its filters left of them (rows x columns x bytes of a pixel)."""
    height, width, step = differences.shape
    if kinds.max() < 3:
        rows = differences.copy()
        for y, kind in enumerate(kinds):
            rows[y] = np.cumsum(rows[y], axis=0, dtype=np.uint8) if kind == 1 else rows[y] + rows[y - 1] if kind == 2 and y else rows[y]
        return rows.reshape(height, width * step)
    y, x = np.mgrid[:height, :width]
    # a row for each rising diagonal, whose pixels need those of the two before: left, above, corner
    skew = np.zeros((height + width + 1, height + 1, step), np.int16)
    skew[y + x + 2, y + 1] = differences
    kinds = kinds[:, None]
    for i in range(height + width - 1):
        first, end = max(0, i - width + 1), min(height, i + 1)
        kind, a, b, c = kinds[first:end], skew[i + 1, first + 1:end + 1], skew[i + 1, first:end], skew[i, first:end]
        pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
        paeth = np.where((pa <= pb) & (pa <= pc), a, np.where(pb <= pc, b, c))
        guess = np.where(kind == 4, paeth, np.where(kind == 3, (a + b) >> 1, np.where(kind == 2, b, np.where(kind == 1, a, 0))))
        skew[i + 2, first + 1:end + 1] = (skew[i + 2, first + 1:end + 1] + guess) & 255
    return skew[y + x + 2, y + 1].astype(np.uint8).reshape(height, width * step)


def read_exr(path):
    """Header and channels of a float OpenEXR file, ZIP-compressed or not compressed."""
    with open(path, "rb") as file:
        data = file.read()
    at, header = 8, {}
    while data[at]:
        end = data.index(b"\0", at)
        name, at = data[at:end].decode(), end + 1
        end = data.index(b"\0", at)
        size = struct.unpack("<i", data[end + 1:end + 5])[0]
        header[name] = data[end + 5:end + 5 + size]
        at = end + 5 + size
    float_channel = b"\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0"
    names = [n.rstrip(b"\0").decode() for n in header["channels"].split(float_channel)[:-1]]
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    lines = 1 if header["compression"] == b"\0" else 16
    chunks = (height + lines - 1) // lines
    offsets = struct.unpack(f"<{chunks}Q", data[at + 1:at + 1 + 8 * chunks])
    image = np.zeros((height, len(names), width), np.float32)
    for offset in offsets:
        y, size = struct.unpack("<ii", data[offset:offset + 8])
        rows = min(lines, height - y)
        raw = rows * len(names) * width * 4
        body = data[offset + 8:offset + 8 + size]
        if size < raw:
            delta = np.frombuffer(zlib.decompress(body), np.uint8).astype(np.int64)
            delta[1:] -= 128
            split = np.cumsum(delta).astype(np.uint8)
            even = (raw + 1) // 2
            joined = np.empty(raw, np.uint8)
            joined[0::2], joined[1::2] = split[:even], split[even:]
            body = joined.tobytes()
        image[y:y + rows] = np.frombuffer(body, "<f4").reshape(rows, len(names), width)
    return header, {n: image[:, i, :] for i, n in enumerate(names)}


def write_png(path, pixels):
    """Rows x columns, or rows x columns x 1 to 4; uint8 or uint16."""
    pixels = np.asarray(pixels)
    bits = 16 if pixels.dtype == np.uint16 else 8
    pixels = np.ascontiguousarray(pixels, ">u2" if bits == 16 else np.uint8)
    height, width = pixels.shape[:2]
    color = {1: 0, 2: 4, 3: 2, 4: 6}[pixels.size // (height * width)]

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, color, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def write_exr(path, rgb):
    """An EXR of channels B, G, R."""
    write_exr_channels(path, {name: np.asarray(rgb)[..., i] for i, name in enumerate("RGB")})


def write_exr_channels(path, channels):
    """An uncompressed scan-line EXR of float32 channels by name (the format's public description)."""
    names = sorted(channels)
    rows = np.stack([np.asarray(channels[name], "<f4") for name in names], axis=1)
    height, _, width = rows.shape

    def attribute(name, kind, data):
        return name.encode() + b"\0" + kind.encode() + b"\0" + len(data).to_bytes(4, "little") + data

    listed = b"".join(name.encode() + b"\0" + (2).to_bytes(4, "little") + bytes(4) + (1).to_bytes(4, "little") * 2
                      for name in names) + b"\0"
    box = np.array([0, 0, width - 1, height - 1], "<i4").tobytes()
    header = b"\x76\x2f\x31\x01" + (2).to_bytes(4, "little") + attribute("channels", "chlist", listed) + attribute(
        "compression", "compression", b"\0") + attribute("dataWindow", "box2i", box) + attribute(
        "displayWindow", "box2i", box) + attribute("lineOrder", "lineOrder", b"\0") + attribute(
        "pixelAspectRatio", "float", np.array([1], "<f4").tobytes()) + attribute(
        "screenWindowCenter", "v2f", bytes(8)) + attribute(
        "screenWindowWidth", "float", np.array([1], "<f4").tobytes()) + b"\0"
    size = width * 4 * len(names)
    start = len(header) + 8 * height
    with open(path, "wb") as file:
        file.write(header)
        file.write((start + np.arange(height, dtype="<u8") * (size + 8)).astype("<u8").tobytes())
        for y in range(height):
            file.write(np.array([y, size], "<i4").tobytes())
            file.write(rows[y].tobytes())
