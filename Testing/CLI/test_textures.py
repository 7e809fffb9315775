#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How textures are sampled: repeated, bilinear where they are enlarged, mip-mapped and anisotropic where reduced."""
import base64
import json
import os
import resource
import struct
import subprocess
import unittest

import numpy as np

import harness
import pictures
from test_image_formation import camera, encoded


def bilinear(texture, u, v):
    """Of rows from the top; v = 0 is the lower edge; texels have their centres at half numbers."""
    rows, columns = texture.shape[:2]
    x, y = u * columns - 0.5, (1 - v) * rows - 0.5
    x0, y0 = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = (x - x0)[..., None], (y - y0)[..., None]

    def at(row, column):
        return texture[row % rows, column % columns]
    return ((at(y0, x0) * (1 - fx) + at(y0, x0 + 1) * fx) * (1 - fy) +
            (at(y0 + 1, x0) * (1 - fx) + at(y0 + 1, x0 + 1) * fx) * fy)


class Textures(harness.Case):
    def square(self, texture, repeat=1.0, **placed):
        """A square of side 2 that shows the texture's own values."""
        pictures.write_png(self.path("texture.png"), texture)
        self.write("square.mtl", "newmtl m\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nmap_Kd texture.png\n")
        uv = "".join(f"vt {x * repeat} {y * repeat}\n" for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
        self.write("square.obj", "mtllib square.mtl\nusemtl m\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n" + uv +
                   "vn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n")
        return {"model": "square.obj", **placed}

    def picture(self, scene):
        path = self.write("scene.json", json.dumps(scene))
        out = self.path(f"out{len(os.listdir(self.path('')))}")
        self.dgtk("render", path, "-o", out, "--layers", "color,objects", "--color-format", "exr,png", "--color-bits", 16,
                  "--quiet")
        _, channels = pictures.read_exr(os.path.join(out, "c", "color", "000000.exr"))
        return (encoded(np.stack([channels[c] for c in "RGB"], -1)),
                pictures.read_png(os.path.join(out, "c", "color", "000000.png")))

    def test_enlarged_textures_are_bilinear_to_the_last_bit_of_16(self):
        random = np.random.default_rng(7)
        for rows, columns in ((8, 8), (5, 12)):
            texture = random.integers(0, 256, (rows, columns, 3)).astype(np.uint8)
            shown = self.square(texture, repeat=1.5)
            image, png = self.picture({"objects": [shown], "cameras": [camera(240, 240, 2)]})
            center = (np.arange(240) + 0.5) / 240 * 1.5
            u, v = np.meshgrid(center, center[::-1])
            expected = bilinear(texture / 255.0, u, v)
            np.testing.assert_allclose(image, expected, atol=2e-5)
            self.assertGreater(len(np.unique(png)), 20000)

    @harness.measures
    def test_without_memory_no_texture_and_no_model_is_called_damaged(self):
        """Whatever the limit of addresses is: all is there, or memory is named, with exit code 4."""
        header = struct.pack(">HBBHHHHLL", 474, 0, 1, 3, 64, 64, 3, 0, 255).ljust(512, b"\0")
        with open(self.path("texture.rgb"), "wb") as file:
            file.write(header + bytes(3 * 64 * 64))
        self.square(np.zeros((2, 2, 3), np.uint8))
        self.write("square.mtl", "newmtl m\nKd 1 1 1\nmap_Kd texture.rgb\n")
        self.write("triangle.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," + base64.b64encode(
                struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)).decode()}]}))
        scene = self.write("scene.json", json.dumps({"objects": [{"model": "square.obj"}, {"model": "triangle.gltf"}], "cameras": [camera(16, 16, 2)]}))
        ends = set()
        for mebibytes in range(260, 660, 40):
            limit = mebibytes << 20
            done = subprocess.run([harness.DGTK, "render", scene, "-o", self.path("out"), "--replace", "--layers", "color", "--no-cache"],
                                  capture_output=True, text=True, check=False, preexec_fn=lambda limit=limit: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
            with self.subTest(mebibytes=mebibytes, says=done.stderr):
                self.assertIn(done.returncode, (0, 4))
                self.assertNotIn("damaged", done.stderr)
            ends.add(done.returncode)
        self.assertEqual(ends, {0, 4})

    def test_what_most_textures_are_needs_the_quick_decoder_alone(self):
        nowhere = {"DGTK_PICTURE_ANY": self.path("nowhere")}
        options = ("--layers", "color,objects", "--frames", "0", "--size", "64x48", "--quiet")
        self.dgtk("render", os.path.join(harness.SCENES, "demo.json"), "-o", self.path("out"), *options, environment=nowhere)
        light = self.write("light.json", json.dumps({"environment": {"image": "light.hdr"}, "cameras": [camera(8, 8, 2)]}))
        self.write("light.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + bytes([128, 128, 128, 128] * 2))
        self.dgtk("render", light, "-o", self.path("light"), *options, environment=nowhere, status=4)
        self.dgtk("render", light, "-o", self.path("light"), *options)

    def test_reduced_textures_keep_their_mean(self):
        texture = np.zeros((256, 256, 3), np.uint8)
        texture[::2, ::2] = texture[1::2, 1::2] = 255
        image, _ = self.picture({"objects": [self.square(texture)], "cameras": [camera(64, 64, 4)]})
        inside = image[20:44, 20:44]
        self.assertLess(np.abs(inside - 0.5).max(), 0.01)

    def test_stripes_seen_aslant_stay_stripes(self):
        # Across the stripes a pixel is a texel, along them three: a filter as wide as long would leave little.
        texture = np.zeros((256, 256, 3), np.uint8)
        texture[:, np.arange(256) % 4 < 2] = 255
        turn = np.radians(70.5) / 2
        shown = self.square(texture, orientation=[np.cos(turn), np.sin(turn), 0, 0])
        image, _ = self.picture({"objects": [shown], "cameras": [
            camera(256, 256, 2, distance=100)]})
        row = image[128, 64:192, 1]
        # a head light: the brightness is the cosine of the slant
        self.assertGreater((row.max() - row.min()) / row.max(), 0.8)

    def test_the_seam_of_a_repeated_texture_is_not_seen(self):
        x = np.arange(64)
        texture = np.repeat((127.5 + 127 * np.sin(2 * np.pi * (x + 0.5) / 64)).round().astype(np.uint8)[None, :, None],
                            64, 0).repeat(3, 2)
        image, _ = self.picture({"objects": [self.square(texture, repeat=4.0)], "cameras": [camera(200, 20, 2 / 10)]})
        row = image[10, :, 0]
        expected = 0.5 + 127 / 255 * np.sin(2 * np.pi * 4 * (np.arange(200) + 0.5) / 200)
        self.assertLess(np.abs(row - expected).max(), 0.01)

    def test_one_that_ends_its_decoder_costs_itself(self):
        shown = self.square(np.full((4, 4, 3), 200, np.uint8))
        # a run of five pixels in a row of two: OpenImageIO 2.4 ends the process that reads it
        header = struct.pack(">hBBHHHHii", 474, 1, 1, 2, 2, 1, 1, 0, 255) + bytes(492)
        self.write("deadly.rgb", header + struct.pack(">II", 520, 3) + bytes([0x85, 1, 2]))
        self.write("square.mtl", "newmtl m\nmap_Kd deadly.rgb\n")
        scene = self.write("s.json", json.dumps({"objects": [shown], "cameras": [camera(24, 24, 2)]}))
        done = self.dgtk("render", scene, "-o", self.path("d"), "--layers", "depth")
        said = [line for line in done.stderr.splitlines() if "deadly.rgb" in line]
        self.assertEqual(len(said), 1, done.stderr)
        self.assertIn("cannot be decoded: is damaged: its decoder ended abnormally (signal 6", said[0])

    def test_more_memory_than_all_may_take_is_the_machines_fault(self):
        shown = self.square(np.full((600, 600, 3), 200, np.uint8))
        scene = self.write("s.json", json.dumps({"objects": [shown], "cameras": [camera(24, 24, 2)]}))
        done = self.dgtk("render", scene, "-o", self.path("d"), "--layers", "depth", status=4,
                         environment={"DGTK_TEXTURE_MEMORY": "1"})
        self.assertRegex(done.stderr, r"^dgtk: .*texture.png: a texture of 600 x 600 pixels; with it, all textures take "
                                      r"2 MiB of memory, more than the 1 MiB that they may \(DGTK_TEXTURE_MEMORY raises it\)\n$")
        self.assertFalse(os.path.exists(self.path("d", "manifest.json")))


if __name__ == "__main__":
    unittest.main()
