#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares a rendered dataset with its baseline.

usage: check_baseline.py DATASET BASELINE FAILURES [--update]

Exact layers, and colour shaded where rays hit, must have the bytes whose SHA-256 stands in BASELINE/exact.sha256. Colour drawn by OpenGL must be near the pictures kept in
BASELINE: mean difference at most MEAN steps of 8 bits, at most PART of the values differing by more than FAR steps. What fails is
left in FAILURES: the result, the baseline where it is kept, and the difference. --update writes the baseline instead.
"""
import json
import os
import shutil
import struct
import sys
import zlib

import numpy

MEAN, FAR, PART = 0.5, 8, 0.01
COLOURS = {"color", "tiles", "matting", "ldi"}  # layers that hold colours


def read_png(path):
    """8-bit gray, RGB or RGBA as an array of rows."""
    data = open(path, "rb").read()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            assert depth == 8, path
            channels = {0: 1, 2: 3, 6: 4}[colour]
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    raw, stride = zlib.decompress(packed), width * channels
    above, rows = bytearray(stride), []
    for y in range(height):
        kind, own = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        if kind == 2:
            own = bytearray((a + b) & 255 for a, b in zip(own, above))
        elif kind:
            for x in range(stride):
                left = own[x - channels] if x >= channels else 0
                own[x] = (own[x] + predicted(kind, left, above[x], above[x - channels] if x >= channels else 0)) & 255
        rows.append(bytes(own))
        above = own
    return numpy.frombuffer(b"".join(rows), numpy.uint8).reshape(height, width, channels).astype(numpy.int32)


def predicted(kind, left, up, corner):
    """PNG's filters Sub, Average and Paeth."""
    if kind == 1:
        return left
    if kind == 3:
        return (left + up) // 2
    p = left + up - corner
    to_left, to_up, to_corner = abs(p - left), abs(p - up), abs(p - corner)
    return left if to_left <= to_up and to_left <= to_corner else up if to_up <= to_corner else corner


def write_png(path, image):
    height, width, channels = image.shape
    raw = b"".join(b"\0" + row.astype(numpy.uint8).tobytes() for row in image)
    with open(path, "wb") as file:
        def chunk(kind, body):
            file.write(struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)))
        file.write(b"\x89PNG\r\n\x1a\n")
        chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0))
        chunk(b"IDAT", zlib.compress(raw))
        chunk(b"IEND", b"")


def split(dataset):
    """({path: hash} of exact files, paths of one picture a camera)."""
    with open(os.path.join(dataset, "manifest.json"), encoding="utf-8") as file:
        manifest = json.load(file)
    files = manifest["files"]
    drawn = manifest["request"]["visibility"] == "raster"  # by OpenGL, whose edges may move with its release
    coloured = set() if manifest["request"].get("renderer") == "ray" else COLOURS
    exact = {f["path"]: f["sha256"] for f in files
             if f.get("layer") and f["layer"].split("_")[0] not in coloured and (not drawn or f["layer"] == "calibration")}
    pictures, cameras = [], set()
    for f in sorted(files, key=lambda f: f["path"]):
        if f.get("layer") == "color" and f["camera"] not in cameras:
            cameras.add(f["camera"])
            pictures.append(f["path"])
    return exact, pictures[:2]


def kept_name(path):
    return path.replace("/", "_")


def update(dataset, baseline):
    shutil.rmtree(baseline, ignore_errors=True)
    os.makedirs(baseline)
    exact, pictures = split(dataset)
    with open(os.path.join(baseline, "exact.sha256"), "w", encoding="utf-8") as file:
        file.writelines(f"{exact[path]}  {path}\n" for path in sorted(exact))
    for path in pictures:
        shutil.copyfile(os.path.join(dataset, path), os.path.join(baseline, kept_name(path)))


def compare_exact(dataset, baseline, failures):
    with open(os.path.join(baseline, "exact.sha256"), encoding="utf-8") as file:
        expected = {line[66:].rstrip("\n"): line[:64] for line in file}
    found, _ = split(dataset)
    wrong = []
    for path in sorted(set(expected) | set(found)):
        if expected.get(path) == found.get(path):
            continue
        wrong.append(f"{path}: {'is missing' if path not in found else 'is not in the baseline' if path not in expected else 'other bytes'}")
        if path in found:
            shutil.copyfile(os.path.join(dataset, path), os.path.join(failures, "result_" + kept_name(path)))
    return len(expected), wrong


def compare_picture(dataset, baseline, failures, path):
    result, kept = read_png(os.path.join(dataset, path)), read_png(os.path.join(baseline, kept_name(path)))
    if result.shape != kept.shape:
        return f"{path}: size {result.shape}, baseline {kept.shape}"
    difference = numpy.abs(result - kept)
    mean, part = difference.mean(), (difference > FAR).mean()
    print(f"{path}: mean difference {mean:.4f} of 255, {100 * part:.3f} % differ by more than {FAR}")
    if mean <= MEAN and part <= PART:
        return None
    for kind, image in (("result", result), ("baseline", kept), ("difference", numpy.minimum(255, 8 * difference))):
        write_png(os.path.join(failures, f"{kind}_{kept_name(path)}"), image)
    return f"{path}: mean difference {mean:.3f}, {100 * part:.2f} % beyond {FAR} steps"


def main(arguments):
    if len(arguments) not in (3, 4) or arguments[3:] not in ([], ["--update"]):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    dataset, baseline, failures = arguments[:3]
    if arguments[3:]:
        update(dataset, baseline)
        return 0
    shutil.rmtree(failures, ignore_errors=True)
    os.makedirs(failures)
    count, wrong = compare_exact(dataset, baseline, failures)
    print(f"{count} exact files, {len(wrong)} of them differ")
    wrong += filter(None, (compare_picture(dataset, baseline, failures, path) for path in split(dataset)[1]))
    for line in wrong:
        print(line, file=sys.stderr)
    if wrong:
        print(f"results, baselines and differences are in {failures}", file=sys.stderr)
    else:
        os.rmdir(failures)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
