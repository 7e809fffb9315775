# SPDX-License-Identifier: BSD-3-Clause
"""Layered depth images, read back from disk, and the views that `dgtk warp` makes of them."""
import json
import math
import os
import shutil
import struct
import subprocess
import tempfile
import zlib

import numpy

from harness import DGTK, SCENES, copy_scenes, load_json, main
from many_runs import ManyCase
from pictures import read_png

RECORD = numpy.dtype([("rgba", "u1", 4), ("depth", "<f8"), ("splat", "<u4")])


def read_ldi(path):
    """Counts (H x W) and the records of all pixels in turn."""
    with open(path, "rb") as file:
        data = file.read()
    width, height = struct.unpack_from("<ii", data)
    counts, parts, at = numpy.zeros(width * height, int), [], 8
    for i in range(width * height):
        (counts[i],) = struct.unpack_from("<I", data, at)
        parts.append(data[at + 4:at + 4 + 16 * counts[i]])
        at += 4 + 16 * counts[i]
    assert at == len(data)
    return counts.reshape(height, width), numpy.frombuffer(b"".join(parts), RECORD)


def unpack_zip(data, size):
    """Undoes the ZIP compression of OpenEXR."""
    if len(data) == size:
        return data
    raw = numpy.frombuffer(zlib.decompress(data), numpy.uint8).astype(int)
    raw[1:] -= 128
    raw = (numpy.cumsum(raw) % 256).astype(numpy.uint8)
    out = numpy.empty(size, numpy.uint8)
    out[0::2], out[1::2] = raw[:(size + 1) // 2], raw[(size + 1) // 2:]
    return out.tobytes()


def read_deep_exr(path):
    """Counts (H x W) and channel name -> samples of all pixels in turn, by the format's description."""
    with open(path, "rb") as file:
        data = file.read()
    magic, version = struct.unpack_from("<II", data)
    assert magic == 20000630 and version & 0x800, "not a deep file of one part"
    at, header = 8, {}
    while data[at]:
        name, kind = data[at:].split(b"\0", 2)[:2]
        at += len(name) + len(kind) + 2
        (size,) = struct.unpack_from("<I", data, at)
        header[name.decode()] = data[at + 4:at + 4 + size]
        at += 4 + size
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    channels, rest = [], header["channels"]
    while rest[0]:
        name, rest = rest.split(b"\0", 1)
        channels.append((name.decode(), {0: "<u4", 1: "<f2", 2: "<f4"}[struct.unpack_from("<I", rest)[0]]))
        rest = rest[16:]
    counts, samples = numpy.zeros((height, width), int), {name: [] for name, _ in channels}
    for offset in struct.unpack_from(f"<{height}Q", data, at + 1):
        y, packed_table, packed, size = struct.unpack_from("<iQQQ", data, offset)
        offset += 28
        table = numpy.frombuffer(unpack_zip(data[offset:offset + packed_table], 4 * width), "<i4")
        line = unpack_zip(data[offset + packed_table:offset + packed_table + packed], size)
        counts[y] = numpy.diff(table, prepend=0)
        begin = 0
        for name, kind in channels:
            samples[name].append(numpy.frombuffer(line, kind, table[-1], begin))
            begin += table[-1] * numpy.dtype(kind).itemsize
    return counts, {name: numpy.concatenate(lines) for name, lines in samples.items()}


def read_ids(path, shape):
    with open(path, "rb") as file:
        rgb = numpy.frombuffer(file.read()[-3 * shape[0] * shape[1]:], numpy.uint8).reshape(*shape, 3).astype(int)
    return (rgb[..., 0] << 16) + (rgb[..., 1] << 8) + rgb[..., 2]


def firsts(counts):
    """Mask of the pixels with a surface, index of their first record."""
    flat = counts.reshape(-1)
    begin = numpy.cumsum(flat) - flat
    return counts > 0, begin[flat > 0]


def turned(camera, degrees, depth):
    """The camera, turned about the point at a depth on its axis."""
    R, t = numpy.array(camera["R"]), numpy.array(camera["t"])
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    about_y = numpy.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    pivot = numpy.array([0, 0, depth])
    return {"K": camera["K"], "R": (about_y @ R).tolist(), "t": (about_y @ (t - pivot) + pivot).tolist(),
            "width": camera["width"], "height": camera["height"]}


class Layers(ManyCase):
    def render(self, scene, name, *options, layers="color,depth,objects,parts,triangles,ldi", run=None):
        (run or self.dgtk)("render", os.path.join(SCENES, scene), "-o", self.path(name), "--quiet", "--layers", layers, *options)
        return self.path(name)

    def check_first(self, folder, frame):
        """Record 0 of every pixel is what depth, objects, parts, triangles and color say. Returns the counts."""
        file = lambda layer, extension: os.path.join(folder, layer, f"{frame:06d}.{extension}")
        counts, records = read_ldi(file("ldi", "ldi"))
        seen, first = firsts(counts)
        depth = numpy.load(file("depth", "npy"))
        self.assertTrue((seen == numpy.isfinite(depth)).all())
        self.assertTrue((records["depth"][first] == depth[seen]).all())
        same_pixel = numpy.diff(numpy.repeat(numpy.arange(counts.size), counts.reshape(-1))) == 0
        self.assertTrue((numpy.diff(records["depth"])[same_pixel] >= 0).all())
        deep_counts, deep = read_deep_exr(file("ldi", "exr"))
        self.assertTrue((deep_counts == counts).all())
        self.assertTrue((deep["Z"] == records["depth"].astype(numpy.float32)).all())
        self.assertTrue((deep["id"][first] == read_ids(file("objects", "ppm"), depth.shape)[seen]).all())
        self.assertTrue((deep["part"][first] == numpy.load(file("parts", "npy"))[seen]).all())
        self.assertTrue((deep["triangle"][first] == numpy.load(file("triangles", "npy"))[seen]).all())
        self.assertLess(records["splat"].max(), 2048)
        if os.path.exists(file("color", "png")):
            self.check_colors(counts, records, read_png(file("color", "png")), deep["A"])
        return counts

    def check_colors(self, counts, records, color, alpha):
        seen, first = firsts(counts)
        opaque = records["rgba"][first, 3] == 255
        self.assertTrue((records["rgba"][first, :3] == color[seen])[opaque].all())
        self.assertTrue((numpy.round(alpha * 255) == records["rgba"][:, 3]).all())
        # through what is not opaque one sees the records behind it
        rows, columns = numpy.nonzero(seen)
        for i in numpy.nonzero(~opaque)[0]:
            value, through, white = numpy.zeros(3), 1.0, False
            for record in records[first[i]:first[i] + counts[rows[i], columns[i]]]:
                opacity = record["rgba"][3] / 255
                value += through * opacity * record["rgba"][:3]
                white = white or record["rgba"][:3].max() == 255
                through *= 1 - opacity
            if through < 1e-6 and not white:  # records are cut off at white, what they make the picture of is not
                self.assertLess(abs(value - color[rows[i], columns[i]]).max(), 3)  # of 255: each record is rounded

    def test_first_layer_is_what_the_other_layers_say(self):
        """One run for all: what deep files need takes longer to load than to write them."""
        seen = {"demo": "left", "fig_5_2_trees_grass": "camera", "fig_4_7_stereo": "left", "glass": "c"}

        def frame_1_of_one_camera(scene):
            scene["keyFrames"] = [0, 1]
            scene["cameras"] = [camera for camera in scene["cameras"] if camera["name"] in seen.values()]

        copy_scenes(self.folder, frame_1_of_one_camera, lambda name: os.path.splitext(name)[0] in seen)
        scene = {"keyFrames": [0, 1],
                 "objects": [{"name": "room", "model": "../Models/room.ac"},
                             {"name": "ball", "model": "../Models/ball.ac", "position": [0, 0.6, 0.6],
                              "scale": [2, 2, 2], "materials": {"*": {"opacity": 0.4}}},
                             {"name": "crate", "model": "../Models/crate.ac", "position": [0.2, 0, -0.6]}],
                 "cameras": [{"name": "c", "eye": [0, 1.2, 2.2], "lookAt": [0, 0.6, 0], "fovY": 50, "near": 0.1, "far": 50}]}
        self.write(os.path.join("Scenes", "glass.json"), json.dumps(scene))
        folder = self.render(self.path("Scenes"), "d", "--frames", 1, "--size", "100x75", "--ldi-format", "ldi,exr", "--triangles-format", "npy")
        for name, camera in seen.items():
            with self.subTest(scene=name):
                counts = self.check_first(os.path.join(folder, name, camera), 1)
                print(f"{name}: {counts.sum()} surfaces, at most {counts.max()} in a pixel")
                self.assertGreater(counts.max(), 3)
        # glass is a surface with a shade and an opacity of its own
        counts, records = read_ldi(os.path.join(folder, "glass", "c", "ldi", "000001.ldi"))
        self.assertGreater((records["rgba"][:, 3] == 102)[firsts(counts)[1]].sum(), 200)

    def test_bytes_do_not_depend_on_threads_tiles_or_time(self):
        """Of images of several canonical tiles, too."""
        options = ("--cameras", "left", "--frames", "2", "--size", "4200x12", "--ldi-format", "ldi,exr")
        layers = "depth,objects,parts,triangles,ldi"
        one = self.render("demo.json", "one", "--threads", "1", *options, layers=layers, run=self.alone)
        two = self.render("demo.json", "two", "--threads", "5", "--tile", "33x17", *options, layers=layers)
        self.assert_same_files(one, two)
        self.check_first(os.path.join(one, "left"), 2)

    def test_one_pass_and_many_passes_give_the_same(self):
        """OpenGL without storage buffers draws a rank at a time."""
        options = ("render", os.path.join(SCENES, "demo.json"), "--quiet", "--cameras", "left", "--frames", "1", "--size", "80x60",
                   "--layers", "ldi", "--renderer", "vtk")
        self.dgtk(*options, "-o", self.path("one"))
        self.dgtk(*options, "-o", self.path("many"),
                  environment={"MESA_EXTENSION_OVERRIDE": "-GL_ARB_shader_storage_buffer_object"})
        self.assert_same_files(self.path("one"), self.path("many"))

    def test_first_surface_is_exact_with_many_samples(self):
        folder = self.render("demo.json", "s", "--cameras", "left", "--frames", "0", "--size", "120x90", "--samples", "3",
                             layers="color,depth,ldi")
        counts, records = read_ldi(os.path.join(folder, "left", "ldi", "000000.ldi"))
        depth = numpy.load(os.path.join(folder, "left", "depth", "000000.npy"))
        seen, first = firsts(counts)
        self.assertTrue((records["depth"][first] == depth[seen]).all())

    def test_first_surface_has_its_own_colour_where_a_lens_blurs(self):
        folder = self.render("lens_and_shutter.json", "l", "--cameras", "lens", "--frames", "0", "--size", "80x60",
                             layers="color,color_sharp,ldi")
        counts, records = read_ldi(os.path.join(folder, "lens", "ldi", "000000.ldi"))
        blurred, sharp = (read_png(os.path.join(folder, "lens", layer, "000000.png")) for layer in ("color", "color_sharp"))
        seen, first = firsts(counts)
        opaque = records["rgba"][first, 3] == 255
        self.assertGreater(opaque.sum(), 3000)
        self.assertTrue((records["rgba"][first, :3] == sharp[seen])[opaque].all())
        self.assertGreater((blurred != sharp).any(axis=-1).mean(), 0.5)

    def test_first_surface_is_the_same_whichever_engine_decides(self):
        """Rays decide above."""
        folder = self.render("demo.json", "d", "--cameras", "left", "--frames", "1", "--size", "80x60", "--ldi-format", "ldi,exr",
                             "--triangles-format", "npy", "--visibility", "raster")
        self.check_first(os.path.join(folder, "left"), 1)


class Warp(ManyCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.dataset = tempfile.mkdtemp(prefix="dgtk-cli-")
        cls.addClassCleanup(shutil.rmtree, cls.dataset, ignore_errors=True)
        subprocess.run([DGTK, "render", os.path.join(SCENES, "fig_4_7_stereo.json"), "-o", cls.dataset, "--quiet", "--layers",
                        "color,depth,ldi", "--size", "200x150"], check=True, capture_output=True)

    def setUp(self):
        super().setUp()
        shutil.copytree(self.dataset, self.path("d"))
        self.ldi = self.path("d", "left", "ldi", "000000.ldi")

    def warp(self, to, *options):
        done = self.dgtk("warp", self.ldi, "--to", to, "-o", self.path("o.png"), *options)
        holes, rest = done.stdout.split(" of ")
        self.assertEqual(rest, "30000 pixels without a sample (holes)\n")
        return int(holes), read_png(self.path("o.png"))

    def camera(self, degrees):
        with open(self.path("d", "cameras.json"), encoding="utf-8") as file:
            cameras = json.load(file)
        depth = numpy.load(self.path("d", "left", "depth", "000000.npy"))
        left = self.find_left(cameras)
        return self.write(f"turned{degrees}.json", json.dumps(turned(left, degrees, float(numpy.median(depth)))))

    def find_left(self, value):
        """The first camera of the file."""
        if isinstance(value, dict):
            if "K" in value:
                return value
            value = list(value.values())
        for item in value if isinstance(value, list) else []:
            found = self.find_left(item)
            if found:
                return found
        return None

    def test_to_its_own_camera_it_is_the_picture(self):
        counts, records = read_ldi(self.ldi)
        seen, first = firsts(counts)
        holes, picture = self.warp("left", "--mask", self.path("m.png"))
        color = read_png(self.path("d", "left", "color", "000000.png"))
        opaque = numpy.zeros(seen.shape, bool)
        opaque[seen] = records["rgba"][first, 3] == 255
        self.assertGreater(opaque.mean(), 0.9)
        self.assertLess((picture != color)[opaque].any(axis=1).mean(), 0.01)  # layers close behind one another blend
        self.assertEqual(holes, (~seen).sum())
        self.assertTrue(((read_png(self.path("m.png"))[..., 0] == 255) == ~seen).all())

    def test_layers_leave_fewer_holes_than_a_depth_map(self):
        to = self.camera(5)
        layered, picture = self.warp(to)
        single, _ = self.warp(to, "--layers", "1")
        print(f"5 degrees away: {single} holes of the depth map, {layered} of the layered depth image")
        self.assertLess(layered, 0.5 * single)
        self.assertGreater(single, 300)

    def test_the_other_camera_sees_what_is_rendered_there(self):
        _, picture = self.warp("right@0")
        holes = self.path("m.png")
        self.warp("right", "--mask", holes)
        color = read_png(self.path("d", "right", "color", "000000.png"))
        filled = read_png(holes)[..., 0] == 0
        difference = abs(picture - color).max(axis=2)[filled]
        self.assertLess(numpy.median(difference), 6)
        self.assertLess((difference > 60).mean(), 0.05)

    def test_layers_are_those_that_are_asked_for(self):
        """To its own camera: --layers N leaves what the first N records of each pixel are."""
        counts, records = read_ldi(self.ldi)
        starts = numpy.cumsum(counts.ravel()) - counts.ravel()
        with open(self.ldi, "rb") as file:
            head = file.read(8)
        pictures = {layers: self.warp("left", "--layers", str(layers))[1] for layers in (0, 1, 2)}
        for layers, picture in pictures.items():
            kept = [records[start:start + (min(count, layers) if layers else count)] for start, count in zip(starts, counts.ravel())]
            with open(self.ldi, "wb") as file:
                file.write(head + b"".join(struct.pack("<I", len(pixel)) + pixel.tobytes() for pixel in kept))
            self.assertTrue((picture == self.warp("left")[1]).all(), layers)

    def test_limits_of_a_camera_file(self):
        """Samples nearer than near, or beyond far, are left out."""
        with open(self.path("d", "cameras.json"), encoding="utf-8") as file:
            left = self.find_left(json.load(file))
        depth = numpy.load(self.path("d", "left", "depth", "000000.npy"))
        middle = float(numpy.median(depth[numpy.isfinite(depth)]))
        camera = {key: left[key] for key in ("K", "R", "t", "width", "height")}
        everything, _ = self.warp(self.write("all.json", json.dumps(camera)))
        beyond, _ = self.warp(self.write("near.json", json.dumps({**camera, "near": middle})))
        before, _ = self.warp(self.write("far.json", json.dumps({**camera, "far": middle})))
        self.assertEqual(everything, (~numpy.isfinite(depth)).sum())
        self.assertLess(everything, beyond)
        self.assertGreaterEqual(before, (depth > middle).sum())

    def test_refusals(self):
        out = ("-o", self.path("o.png"))
        self.refused("warp", self.ldi, *out, status=2, says="--to")
        self.refused("warp", self.ldi, "--to", "left", status=2, says="-o")
        self.refused("warp", self.ldi, "--to", "left", "-o", self.path("a.jpg"), status=2, says="a.jpg: a picture is written as .png")
        self.refused("warp", self.ldi, "--to", "middle", *out, status=2, says="middle")
        self.refused("warp", self.ldi, "--to", "left@9", *out, status=2, says="frame 9")
        self.refused("warp", self.write("x.ldi", ""), "--to", "left", *out, status=2, says="DIR/CAMERA/ldi/FRAME.ldi")
        self.refused("warp", self.path("d", "left", "ldi", "000001.ldi"), "--to", "left", *out, status=3, says="000001.ldi")
        for text, says in (("[]", "expected an object"), ("{", "is not valid JSON"), ('{"K": 3}', "K has the wrong type"),
                           (json.dumps({"K": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "R": [[2, 0, 0], [0, 2, 0], [0, 0, 2]],
                                        "t": [0, 0, 0], "width": 4, "height": 4}), "not a rotation"),
                           (json.dumps({"K": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "R": [[-1, 0, 0], [0, 1, 0], [0, 0, 1]],
                                        "t": [0, 0, 0], "width": 4, "height": 4}), "not a rotation"),
                           (json.dumps({"K": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "R": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
                                        "t": [0, 0, 0], "width": 0, "height": 4}), "width is out of range")):
            self.refused("warp", self.ldi, "--to", self.write("c.json", text), *out, status=3, says=["c.json", says])
        other = next(row["path"] for row in load_json(self.path("d", "manifest.json"))["files"] if row["path"].endswith(".png"))
        for name in (other, "left/more.png"):
            self.refused("warp", self.ldi, "--to", "left", "-o", self.path("d", name), status=2, says=f"{name}: lies in the dataset in")
        mask, here = self.path("m.png"), os.path.relpath(self.path("m.png"))
        before = os.path.getsize(self.ldi)
        for picture, holes in ((mask, here), (self.ldi, mask), (mask, self.ldi)):
            self.refused("warp", self.ldi, "--to", "left", "-o", picture, "--mask", holes, status=2, says="names of their own")
        self.assertEqual((os.path.getsize(self.ldi), os.path.exists(mask)), (before, False))
        with open(self.ldi, "rb+") as file:
            file.truncate(os.path.getsize(self.ldi) - 1)
        self.refused("warp", self.ldi, "--to", "left", *out, status=3, says="000000.ldi")
        self.assertFalse(os.path.exists(self.path("o.png")))


class WarpToOthers(ManyCase):
    """A wall before cameras of several kinds, the first of which moves."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.dataset = tempfile.mkdtemp(prefix="dgtk-cli-")
        cls.addClassCleanup(shutil.rmtree, cls.dataset, ignore_errors=True)
        with open(os.path.join(cls.dataset, "wall.obj"), "w", encoding="ascii") as file:
            file.write("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n")
        common = {"width": 32, "height": 24, "near": 1, "far": 50, "eye": [0, 0, 5], "lookAt": [0, 0, 0]}
        cameras = [{**common, "name": "moving", "eye": {"keys": [[0, [1, 0, 5]], [1, [0, 0, 5]]]},
                    "lookAt": {"keys": [[0, [1, 0, 0]], [1, [0, 0, 0]]]}},
                   {**common, "name": "bent", "distortion": [0.1, 0, 0, 0]}, {**common, "name": "flat", "model": "orthographic", "viewHeight": 4},
                   {**common, "name": "round", "model": "fisheye", "fovY": 120}, {**common, "name": "panorama", "model": "equirectangular"},
                   {**common, "name": "rolling", "rollingShutter": {"duration": 0.5, "direction": "down"}}]
        scene = os.path.join(cls.dataset, "s.json")
        with open(scene, "w", encoding="utf-8") as file:
            json.dump({"objects": [{"model": "wall.obj"}], "cameras": cameras}, file)
        for name, *options in (("d", "ldi", "--cameras", "moving"), ("all", "depth", "--frames", "1")):
            subprocess.run([DGTK, "render", scene, "-o", os.path.join(cls.dataset, name), "--quiet", "--visibility", "ray", "--layers", *options],
                           check=True, capture_output=True)

    def setUp(self):
        super().setUp()
        shutil.copytree(self.dataset, self.folder, dirs_exist_ok=True)
        self.ldi = self.path("d", "moving", "ldi", "000001.ldi")

    def entries(self, folder):
        with open(self.path(folder, "cameras.json"), encoding="utf-8") as file:
            return json.load(file)

    def warp(self, to, name="o.png"):
        self.dgtk("warp", self.ldi, "--to", to, "-o", self.path(name))
        return read_png(self.path(name))

    def test_a_camera_without_a_frame_is_at_that_of_the_image(self):
        first, second = self.warp("moving@0"), self.warp("moving@1")
        self.assertTrue((first != second).any())
        self.assertTrue((self.warp("moving") == second).all())

    def test_an_image_of_another_size_than_its_camera(self):
        whole = self.entries("d")
        for side in ("width", "height"):
            other = {"cameras": [{**entry, side: entry[side] - 1} for entry in whole["cameras"]]}
            self.write("d/cameras.json", json.dumps(other))
            self.refused("warp", self.ldi, "--to", "moving", "-o", self.path("o.png"), status=3, says="has another size than its camera")

    def test_an_entry_of_cameras_json_is_a_camera_file(self):
        entries = {entry["name"]: entry for entry in self.entries("all")["cameras"]}
        expected = self.warp("moving")
        for far in (50, None):
            self.assertTrue((self.warp(self.write("c.json", json.dumps({**entries["moving"], "far": far}))) == expected).all())
        for name in ("bent", "flat", "round", "panorama"):
            self.assertTrue(self.warp(self.write("c.json", json.dumps(entries[name]))).any(), name)

        def refused(entry, status, *says):
            self.refused("warp", self.ldi, "--to", self.write("c.json", json.dumps(entry)), "-o", self.path("no.png"), status=status, says=says)
        refused(entries["rolling"], 2, "rolling shutter")
        moving = entries["moving"]
        for key, value in (("distorsion", [0.1, 0, 0, 0]), ("fovY", 60), ("viewHeight", 4)):
            refused({**moving, key: value}, 3, f"c.json:1: {key} is an unknown key (expected one of name, frame, ")
        refused({**entries["flat"], "distortion": [0.1, 0, 0, 0]}, 3, "distortion is an unknown key")
        refused({**entries["panorama"], "K": moving["K"]}, 3, "K is an unknown key")
        refused({**moving, "near": -5, "far": -7}, 3, "near is out of range (expected a number above 0, found -5)")
        refused({**moving, "near": 0}, 3, "near is out of range")
        for far in (1, -7):
            refused({**moving, "far": far}, 3, f"far is not beyond near (expected more than 1, found {far})")
        self.assertFalse(os.path.exists(self.path("no.png")))


if __name__ == "__main__":
    main()
