# SPDX-License-Identifier: BSD-3-Clause
"""Single values of a dataset's files, changed without the libraries under test."""
import hashlib
import json
import os
import struct

import numpy as np

import pictures


def contents(path):
    with open(path, "rb") as file:
        return file.read()


def replace(path, data):
    with open(path, "wb") as file:
        file.write(data)


def plainer(md2, triangles):
    """An MD2 model, its bytes, without skins and with its first triangles alone."""
    return md2[:20] + bytes(4) + md2[24:32] + triangles.to_bytes(4, "little") + md2[36:]


class Edits:
    """A dataset on disk. accept() makes its manifest agree with the files that were changed."""

    def __init__(self, root):
        self.root = root
        self.changed = set()

    def path(self, name):
        return os.path.join(self.root, name)

    def touch(self, name):
        self.changed.add(name)
        return self.path(name)

    def load(self, name):
        """Rows x columns x channels; of EXR in the order of the channels' names."""
        path = self.path(name)
        kind = name.rsplit(".", 1)[1]
        if kind == "npy":
            image = np.load(path)
        elif kind == "png":
            image = pictures.read_png(path)
        elif kind == "exr":
            channels = pictures.read_exr(path)[1]
            image = np.stack([channels[c] for c in sorted(channels)], axis=-1)
        else:
            head, image = self._raw(path, kind)
        return image.reshape(*image.shape[:2], -1)

    @staticmethod
    def _raw(path, kind):
        data = contents(path)
        if kind == "pfm":
            _, size, _, _ = data.split(b"\n", 3)
            width, height = map(int, size.split())
            head = len(data) - 4 * width * height
            return data[:head], np.frombuffer(data, "<f4", offset=head).reshape(height, width)[::-1].copy()
        if kind == "ppm":
            width, height = map(int, data.split(b"\n", 2)[1].split())
            head = len(data) - 3 * width * height
            return data[:head], np.frombuffer(data, "u1", offset=head).reshape(height, width, 3).copy()
        head, kind, channels = {"flo": (12, "<f4", 2), "dgd": (264, "<f8", 1)}[kind]
        width, height = struct.unpack_from("<ii", data, head - 8)
        return data[:head], np.frombuffer(data, kind, offset=head).reshape(height, width, channels).copy()

    def change(self, name, pixel, edit):
        """Replaces the values v of a pixel (x, y), an array of its channels, by edit(v)."""
        x, y = pixel
        path, kind = self.touch(name), name.rsplit(".", 1)[1]
        image = self.load(name)
        image[y, x] = edit(image[y, x].copy())
        if kind == "npy":
            np.save(path, image.reshape(np.load(path).shape))
        elif kind == "png":
            bits = contents(path)[24]
            pictures.write_png(path, image.astype(np.uint16 if bits == 16 else np.uint8))
        elif kind == "exr":
            names = sorted(pictures.read_exr(path)[1])
            pictures.write_exr_channels(path, {n: image[..., i] for i, n in enumerate(names)})
        else:
            head, _ = self._raw(path, kind)
            replace(path, head + (image[::-1] if kind == "pfm" else image).tobytes())
        return name, list(pixel)

    def document(self, name, edit):
        """Replaces a JSON document by what `edit` makes of it."""
        with open(self.touch(name), encoding="utf-8") as file:
            document = json.load(file)
        edit(document)
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(json.dumps(document))
        return name, None

    def bytes(self, name, edit):
        data = bytearray(contents(self.touch(name)))
        replace(self.path(name), edit(data) or data)
        return name, None

    def layered(self, name, pixel, edit):
        """Replaces the records [r, g, b, a, depth, splat] of a pixel by edit(records)."""
        data = contents(self.touch(name))
        width, _ = struct.unpack_from("<ii", data)
        at, index = 8, pixel[1] * width + pixel[0]
        for _ in range(index):
            at += 4 + 16 * struct.unpack_from("<I", data, at)[0]
        count = struct.unpack_from("<I", data, at)[0]
        records = [list(struct.unpack_from("<4BdI", data, at + 4 + 16 * i)) for i in range(count)]
        records = edit(records)
        new = struct.pack("<I", len(records)) + b"".join(struct.pack("<4BdI", *r) for r in records)
        replace(self.path(name), data[:at] + new + data[at + 4 + 16 * count:])
        return name, list(pixel)

    def layers_of(self, name):
        """The number of records of each pixel, rows x columns."""
        data = contents(self.path(name))
        width, height = struct.unpack_from("<ii", data)
        counts, at = [], 8
        for _ in range(width * height):
            counts.append(struct.unpack_from("<I", data, at)[0])
            at += 4 + 16 * counts[-1]
        return np.array(counts).reshape(height, width)

    def accept(self):
        manifest = self.path("manifest.json")
        with open(manifest, encoding="utf-8") as file:
            document = json.load(file)
        for entry in document["files"]:
            if entry["path"] in self.changed:
                data = contents(self.path(entry["path"]))
                entry["bytes"], entry["sha256"] = len(data), hashlib.sha256(data).hexdigest()
        with open(manifest, "w", encoding="utf-8") as file:
            file.write(json.dumps(document))
        self.changed.clear()
