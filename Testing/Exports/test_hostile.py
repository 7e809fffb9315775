# SPDX-License-Identifier: BSD-3-Clause
"""Files that are made to harm: `dgtk verify --export` ends soon, in one line that names the file, whatever an export holds."""
import hashlib
import io
import os
import re
import resource
import shutil
import struct
import subprocess
import zipfile

import numpy as np

import datasets
from datasets import load_json, main, sealed
from harness import DGTK

FORMATS = "hdf5,tapvid,voc,rosbag,bop"
BAG_HEAD = 13 + 4096
MOST = 4 << 30  # bytes of memory


def nodes(kind, at, value):
    """Writes into the first tree of a kind of an HDF5 file; its level is at 5, what it leads to or its first key behind 24."""
    def edit(data):
        tree = data.index(b"TREE" + kind)
        new = struct.pack("<Q", tree if value is None else value)
        return data[:tree + 5] + bytes([value is None]) + data[tree + 6:tree + at] + new + data[tree + at + 8:]

    return edit


def described(pattern, place, code, value):
    """A number of the first array of 24 x 18 and 4 bytes: of where it lies, or how large it is."""
    def edit(data):
        at = re.search(pattern, data, re.DOTALL).start() + place
        return data[:at] + struct.pack(code, value) + data[at + struct.calcsize(code):]

    return edit


LAYOUT = re.escape(b"\3\2\3") + b"." * 8 + re.escape(struct.pack("<3I", 18, 24, 4))
SPACE = re.escape(b"\1\2" + bytes(6) + struct.pack("<2Q", 18, 24))


def archive(data):
    """Tracks of which there are many, and none has a number."""
    arrays = {"points": np.zeros((1000, 2, 2), "<f4"), "occluded": np.zeros((1000, 2), "|b1"), "query_points": np.zeros((1000, 0), "<f4"),
              "track": np.zeros((1000, 0), "<i8"), "object": np.zeros((1000, 0), "<i8")}
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_STORED) as new:
        for name, array in arrays.items():
            one = io.BytesIO()
            np.lib.format.write_array(one, array, version=(1, 0))
            new.writestr(name + ".npy", one.getvalue())
    return file.getvalue()


def of_itself(data):
    """A type of which each field is of the type, in a definition as long as it was."""
    header = b"uint32 seq\ntime stamp\nstring frame_id\n"
    begin = data.index(b"Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian")
    old = data[begin:data.index(header, begin) + len(header)]
    new = b"A a\n" * (len(old) // 8) + b"MSG: x/A\n"
    new += b"A a\n" * ((len(old) - len(new)) // 4)
    return data.replace(old, new.ljust(len(old), b"\n"))


def record(data, **fields):
    head = b"".join(struct.pack("<I", len(key) + 1 + len(value)) + key.encode() + b"=" + value for key, value in fields.items())
    return struct.pack("<I", len(head)) + head + struct.pack("<I", len(data)) + data


def empty_chunk(data):
    one = struct.pack("<I", 1)
    return (data[:BAG_HEAD] + record(b"", op=b"\5", compression=b"none", size=bytes(4)) +
            record(b"", op=b"\6", ver=one, chunk_pos=struct.pack("<Q", BAG_HEAD), start_time=bytes(8), end_time=bytes(8), count=bytes(4)))


def png_chunk(data):
    """Behind the head one that ends before it begins, of 32 bits."""
    return data[:33] + struct.pack(">I", 0xfffffff4) + b"tEXt" + data[33:]


def ply(*lines):
    return lambda data: "\n".join(("ply", "format binary_little_endian 1.0", *lines, "end_header", "")).encode() + b"\0"


class Hostile(datasets.ExportCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.dataset = cls.rendered_once(lambda folder: datasets.street(folder, width=24, height=18), "--for", FORMATS)

    def ends(self, form, name, edit, says, of_record=None):
        """The file with an edit, of which export.json knows."""
        folder = self.path("export")
        shutil.rmtree(folder, ignore_errors=True)
        self.dgtk("export", self.dataset, "--format", form, "-o", folder, "--cameras", "cam L", "--quiet")
        path = os.path.join(folder, name)
        with open(path, "rb") as file:
            data = edit(file.read())
        document = load_json(os.path.join(folder, "export.json"))
        next(one for one in document["files"] if one["path"] == name).update(sha256=hashlib.sha256(data).hexdigest(), bytes=len(data))
        if of_record:
            of_record(document)
        self.written({path: data, os.path.join(folder, "export.json"): sealed(document)})
        with self.subTest(name=name, says=says):
            done = subprocess.run([DGTK, "verify", self.dataset, "--export", folder], capture_output=True, text=True, timeout=60,
                                  preexec_fn=None if os.environ.get("DGTK_TEST_SANITIZED") else lambda: resource.setrlimit(resource.RLIMIT_AS, (MOST, MOST)))
            self.assertIn(done.returncode, (1, 3), done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            for word in (name, says):
                self.assertIn(word, done.stderr)

    def test_hdf5(self):
        for edit, says in ((nodes(b"\0", 32, None), "several nodes"), (nodes(b"\1", 24 + 8 + 8 * 3, None), "several nodes"),
                           (nodes(b"\1", 24 + 8, 1), "of another size, or elsewhere"),
                           (described(LAYOUT, 2, "<B", 1), "none of its array"), (described(LAYOUT, 2, "<B", 0), "none of its array"),
                           (described(LAYOUT, 11, "<I", 1 << 31), "none of its array"),
                           (described(SPACE, 8, "<Q", 1 << 40), "more than the file holds"), (described(SPACE, 8, "<Q", 0), "has no numbers")):
            self.ends("hdf5", "0.hdf5", edit, says)

    def test_tracks(self):
        self.ends("tapvid", "cam_L/tracks.npz", archive, "too short")
        self.ends("tapvid", "tapvid.pkl", lambda data: b"\x80\x04" + b"(" * 400000 + b"t" * 400000 + b".", "no pickle of videos")

    def test_pictures(self):
        name = "SegmentationClass/cam_L_000000.png"
        self.ends("voc", name, png_chunk, "no gray PNG")
        self.ends("voc", name, lambda data: data[:16] + struct.pack(">2I", 1 << 30, 1 << 30) + data[24:], "no gray PNG")

    def test_recordings(self):
        def ghosts(document):
            own = [(one["frame"], one["name"]) for one in document["names"]]
            document["names"] += [{"camera": "ghost", "frame": frame, "name": re.sub(":.*@", ":ghost@", name)} for frame, name in own]

        self.ends("rosbag", "dataset.bag", lambda data: data, "(of pictures)", ghosts)
        self.ends("rosbag", "dataset.bag", of_itself, "recording")
        self.ends("rosbag", "dataset.bag", empty_chunk, "a chunk without messages")
        self.ends("rosbag", "dataset.bag", lambda data: data.replace(b"plumb_bob\5\0\0\0", b"plumb_bob\xff\xff\xff\xff"), "ends too early")

    def test_models(self):
        for lines in (("element vertex 1", "property uchar x"), ("element vertex 400000000000",),
                      ("element vertex 1", "property float x", *("property double " + name for name in "yzw"))):
            self.ends("bop", "models/obj_000001.ply", ply(*lines), "do not begin with three doubles")


if __name__ == "__main__":
    main()
