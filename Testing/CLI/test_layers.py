# SPDX-License-Identifier: BSD-3-Clause
"""Layers read back from disk against closed forms, and the files of a dataset against the conventions."""
import hashlib
import json
import math
import os
import struct

from harness import SCENES, Case, load_json, main

PLANE = "v -1e5 0 -1e5\nv 1e5 0 -1e5\nv 1e5 0 1e5\nv -1e5 0 1e5\nf 4 3 2 1\n"


class ClosedForms(Case):
    def render_plane(self, **camera):
        self.write("plane.obj", PLANE)
        scene = {"objects": [{"name": "ground", "model": "plane.obj"}],
                 "cameras": [{"name": "c", "near": 0.1, "far": 1e5, "width": 160, "height": 120, "eye": [0, 1.6, 0],
                              "lookAt": [0, 1.6, -1], "up": [0, 1, 0], "fovY": 60, **camera}]}
        self.write("s.json", json.dumps(scene))
        self.dgtk("render", self.path("s.json"), "-o", self.path("out"), "--quiet", "--layers",
                  "depth,distance,normal,position,objects,parts,triangles", "--depth-format", "npy,dgd,pfm",
                  "--objects-format", "npy,ppm")

    def test_ground_plane_to_the_horizon(self):
        import numpy

        for engine in ("c",):
            self.render_plane()
            read = lambda layer: numpy.load(self.path("out", engine, layer, "000000.npy"))
            depth, objects = read("depth"), read("objects")
            f = 60 / math.tan(math.radians(30))
            rows = numpy.arange(120) + 0.5 - 60
            with numpy.errstate(divide="ignore"):
                expected = numpy.where(rows > 0, 1.6 * f / rows, numpy.inf)
            expected = numpy.repeat(expected[:, None], 160, axis=1)
            self.assertTrue(((objects > 0) == (expected < 1e5)).all())
            seen = objects > 0
            self.assertLess(numpy.abs(depth[seen] / expected[seen] - 1).max(), 1e-12)
            self.assertTrue(numpy.isinf(depth[~seen]).all())
            x = (numpy.arange(160) + 0.5 - 80) / f
            y = rows / f
            length = numpy.sqrt(1 + x[None, :] ** 2 + y[:, None] ** 2)
            self.assertLess(numpy.abs(read("distance")[seen] / (expected * length)[seen] - 1).max(), 1e-12)
            normal = read("normal")[seen]
            self.assertLess(numpy.abs(normal - [0, -1, 0]).max(), 1e-6)  # camera frame: y down
            position = read("position")[seen]
            self.assertLess(numpy.abs(position[:, 1]).max(), 1e-9)
            self.assertTrue(numpy.isnan(read("normal")[~seen]).all())

    def test_thesis_files(self):
        import numpy

        self.render_plane()
        depth = numpy.load(self.path("out", "c", "depth", "000000.npy"))
        with open(self.path("out", "c", "depth", "000000.dgd"), "rb") as file:
            data = file.read()
        projection = numpy.frombuffer(data, "<f8", 16).reshape(4, 4).T
        model_view = numpy.frombuffer(data, "<f8", 16, 128).reshape(4, 4).T
        self.assertEqual(struct.unpack_from("<ii", data, 256), (160, 120))
        numpy.testing.assert_array_equal(numpy.frombuffer(data, "<f8", -1, 264).reshape(120, 160), depth)
        # gluProject of a pixel's world position is the pixel's centre, y up
        position = numpy.load(self.path("out", "c", "position", "000000.npy"))
        clip = projection @ model_view @ numpy.append(position[100, 30], 1)
        window = (clip[:2] / clip[3] + 1) / 2 * [160, 120]
        numpy.testing.assert_allclose(window, [30.5, 120 - 100.5], atol=1e-9)
        with open(self.path("out", "c", "objects", "000000.ppm"), "rb") as file:
            header, pixels = file.read().split(b"255\n", 1)
        self.assertEqual(header.split(), [b"P6", b"160", b"120"])
        ids = numpy.frombuffer(pixels, "u1").reshape(120, 160, 3).astype(int)
        numpy.testing.assert_array_equal(ids @ [65536, 256, 1], numpy.load(self.path("out", "c", "objects", "000000.npy")))
        with open(self.path("out", "c", "depth", "000000.pfm"), "rb") as file:
            kind, size, scale, rest = file.read().split(b"\n", 3)
        self.assertEqual((kind, size, float(scale)), (b"Pf", b"160 120", -1.0))
        numpy.testing.assert_array_equal(numpy.frombuffer(rest, "<f4").reshape(120, 160)[::-1], depth.astype("f4"))


class Dataset(Case):
    def test_manifest_names_every_file_with_its_hash(self):
        out = self.path("out")
        self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", out, "--quiet", "--size", "160x120", "--layers", "all",
                  "--contact-sheet")
        manifest = load_json(os.path.join(out, "manifest.json"))
        named = {entry["path"]: entry for entry in manifest["files"]}
        there = {os.path.relpath(os.path.join(root, name), out) for root, _, names in os.walk(out) for name in names}
        self.assertEqual(set(named) | {"manifest.json"}, there)
        for path, entry in named.items():
            with open(os.path.join(out, path), "rb") as file:
                data = file.read()
            self.assertEqual(entry["bytes"], len(data), path)
            self.assertEqual(entry["sha256"], hashlib.sha256(data).hexdigest(), path)
        self.assertIn("contact.png", named)
        objects = load_json(os.path.join(out, "objects.json"))
        self.assertTrue(objects)

    def test_parts_and_triangles_as_png(self):
        import numpy

        self.write("q.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n")
        self.write("s.json", json.dumps({"objects": [{"name": "q", "model": "q.obj"}], "cameras": [
            {"name": "c", "width": 40, "height": 30, "eye": [0, 0, 5], "lookAt": [0, 0, 0]}]}))
        out = self.path("out")
        self.dgtk("render", self.path("s.json"), "-o", out, "--quiet", "--layers", "depth,objects,parts,triangles", "--parts-format",
                  "npy,png", "--triangles-format", "npy,png")
        invalid = {(r["name"], r["format"]): r["invalid"] for r in load_json(os.path.join(out, "manifest.json"))["layers"]}
        for layer in ("parts", "triangles"):
            ids = numpy.load(os.path.join(out, "c", layer, "000000.npy"))
            self.assertEqual(set(ids.flat) - {0, 1}, {4294967295})
            self.assertEqual((invalid[layer, "npy"], invalid[layer, "png"]), ("4294967295", "65535"))
            png = os.path.join(out, "c", layer, "000000.png")
            self.dgtk("compare", png, os.path.join(out, "c", layer, "000000.npy"))
        self.dgtk("verify", out)

    def test_ids_that_do_not_fit_are_refused_before_anything_is_written(self):
        rows = 182  # 2 x 182 x 182 = 66248 triangles
        lines = [f"v {x} {y} 0" for y in range(rows + 1) for x in range(rows + 1)]
        corner = lambda x, y: y * (rows + 1) + x + 1
        for y in range(rows):
            for x in range(rows):
                a, b, c, d = corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)
                lines += [f"f {a} {b} {c}", f"f {a} {c} {d}"]
        self.write("grid.obj", "\n".join(lines) + "\n")
        self.write("s.json", json.dumps({"objects": [{"name": "g", "model": "grid.obj"}], "cameras": [
            {"name": "c", "width": 8, "height": 6, "eye": [0, 0, 500], "lookAt": [0, 0, 0]}]}))
        self.refused("render", self.path("s.json"), "-o", self.path("out"), "--quiet", "--layers", "depth,triangles",
                     "--triangles-format", "png", status=2, says=["layer triangles", "66247", "largest 65534", ".npy"])
        self.assertFalse(os.path.exists(self.path("out")))

    def test_all_layers_are_those_of_a_format_too(self):
        self.write("quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n")
        scene = self.write("scene.json", json.dumps({
            "objects": [{"name": "quad", "model": "quad.obj"}], "cameras": [{"name": "c", "eye": [0, 0, 5], "lookAt": [0, 0, 0], "width": 16, "height": 12}]}))
        self.dgtk("render", scene, "-o", self.path("out"), "--layers", "all", "--for", "coco", "--quiet")
        self.dgtk("export", self.path("out"), "--format", "coco", "-o", self.path("coco"), "--quiet")

    def test_orientation(self):
        """A red quad in the upper left of the view is in the upper left of the picture."""
        self.write("q.obj", "mtllib q.mtl\nusemtl red\nv -3 1 0\nv -1 1 0\nv -1 2 0\nv -3 2 0\nf 1 2 3 4\n")
        self.write("q.mtl", "newmtl red\nKd 1 0 0\nKa 1 0 0\n")
        self.write("s.json", json.dumps({"objects": [{"name": "q", "model": "q.obj"}], "cameras": [
            {"name": "c", "fovY": 60, "near": 0.1, "far": 100, "width": 120, "height": 120, "eye": [0, 0, 5], "lookAt": [0, 0, 0],
             "up": [0, 1, 0]}]}))
        self.dgtk("render", self.path("s.json"), "-o", self.path("out"), "--quiet", "--objects-format", "npy")
        import numpy

        rows, columns = numpy.nonzero(numpy.load(self.path("out", "c", "objects", "000000.npy")))
        f = 60 / math.tan(math.radians(30))
        self.assertEqual((columns.min(), columns.max()), (max(0, math.ceil(60 - 3 * f / 5 - 0.5)), math.floor(60 - f / 5 - 0.5)))
        self.assertEqual((rows.min(), rows.max()), (math.ceil(60 - 2 * f / 5 - 0.5), math.floor(60 - f / 5 - 0.5)))


class FlowOfEverySecondFrame(Case):
    def test_the_run_says_where_it_leads(self):
        words = ("render", os.path.join(SCENES, "demo.json"), "--size", "16x12", "--cameras", "left", "--layers", "flow_forward,depth")
        said = self.dgtk(*words, "-o", self.path("second"), "--frames", "0:2:2").stderr
        self.assertEqual(said.count("layer flow_forward leads to the scene's frame one later"), 1, said)
        self.assertIn("NAME:NAME+2", said)
        self.assertNotIn("leads", self.dgtk(*words, "-o", self.path("each"), "--frames", "0:2").stderr)


if __name__ == "__main__":
    main()
