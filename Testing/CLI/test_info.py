# SPDX-License-Identifier: BSD-3-Clause
"""`dgtk info` of models, compared with counts made by independent parsers, and of scenes."""
import base64
import json
import math
import os
import struct

import numpy
from harness import EXTRA, SCENES, SOURCE, load_json, main, needs_samples
from many_runs import ManyCase

TRUTH = os.path.join(EXTRA, "TRUTH.json")


def rounded(value):
    return float(f"{value:.4g}")


class Models(ManyCase):
    def info(self, path):
        return json.loads(self.dgtk("info", path, "--json").stdout)

    def check_against_truth(self, name, truth):
        found = self.info(os.path.join(EXTRA, name))
        self.assertEqual(found["format"], truth["format"])
        self.assertEqual(found["triangles"], truth["triangles"])
        for key in ("materials", "lines", "frames"):
            if key in truth:
                self.assertEqual(found[key], truth[key], key)
        bounds = truth.get("bounds", truth.get("bounds_frame0"))
        if bounds:
            size = max(abs(v) for corner in bounds for v in corner)
            for mine, theirs in zip(found["bounds"], bounds):
                for a, b in zip(mine, theirs):
                    self.assertLessEqual(abs(a - b), 6e-4 * max(abs(b), 1e-2 * size), f"{found['bounds']} {bounds}")
        if "sequences" in truth:
            sequences = [(a["name"], a["last"] - a["first"] + 1) for a in found["animations"]]
            expected = [entry.rsplit(":", 1) for entry in truth["sequences"].split(",")]
            self.assertEqual([count for _, count in sequences], [int(count) for _, count in expected])
            for (mine, _), (theirs, _) in zip(sequences, expected):  # the parser kept separators at the end of a name
                self.assertEqual(mine.rstrip("_. "), theirs.rstrip("_. "))

    @needs_samples
    def test_counts_equal_those_of_independent_parsers(self):
        skipped_pov = {"pov/asteroids/aster3.pov", "pov/povray-examples/chesmsh.pov"}  # counted there without their includes
        for name, truth in load_json(TRUTH).items():
            with self.subTest(name):
                if os.path.getsize(os.path.join(EXTRA, name)) == 0:
                    self.refused("info", os.path.join(EXTRA, name), "--json", status=3, says=os.path.basename(name))
                elif name not in skipped_pov:
                    self.check_against_truth(name, truth)

    @needs_samples
    def test_included_triangles_are_drawn(self):
        self.assertEqual(self.info(os.path.join(EXTRA, "pov/asteroids/aster3.pov"))["triangles"], 1536)

    def test_sequences_end_where_their_keys_do(self):
        spans = [(0, 1, 4.25), (1, 2, 3.5), (0, 1 / 240, 1 / 120)]  # times of keys, seconds
        numbers = [0, 0, 0, 1, 0, 0, 0, 1, 0] + [time for times in spans for time in times] + [0, 0, 0, 1, 0, 0, 2, 0, 0]
        data = struct.pack(f"<{len(numbers)}f", *numbers)
        buffer = {"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}
        views = [{"buffer": 0, "byteOffset": 4 * at, "byteLength": 4 * count} for at, count in ((0, 9), (9, 3), (12, 3), (15, 3), (18, 9))]
        kinds = ["VEC3", "SCALAR", "SCALAR", "SCALAR", "VEC3"]
        path = self.write("moves.gltf", json.dumps({
            "asset": {"version": "2.0"}, "buffers": [buffer], "bufferViews": views,
            "accessors": [{"bufferView": i, "componentType": 5126, "count": 3, "type": kind} for i, kind in enumerate(kinds)],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}],
            "animations": [{"name": str(i), "samplers": [{"input": 1 + i, "output": 4}],
                            "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]} for i in range(3)]}))
        found = self.info(path)["animations"]
        self.assertEqual([(a["first"], a["last"]) for a in found], [(0, 128), (0, 105), (0, 0)])
        for sequence, times in zip(found, spans):
            self.assertAlmostEqual(sequence["end"] / sequence["fps"], times[-1], places=6)

    def test_textures_are_found_where_they_exist(self):
        own = os.path.join(SOURCE, "Data", "Models")
        for root, _, names in os.walk(own):
            for name in names:
                if name.rsplit(".", 1)[-1] in ("ac", "md2", "3ds", "pov", "obj", "gltf"):
                    with self.subTest(name):
                        found = self.info(os.path.join(root, name))
                        self.assertGreater(found["triangles"], 0)
                        self.assertEqual([t["name"] for t in found["textures"] if not t["found"]], [])
                        self.assertEqual(found["warnings"], [])


    def test_everything_that_is_told_of_a_model(self):
        """Two flat squares across an edge: six vertices, of which the edge's two have two normals, so that eight are drawn."""
        model = self.write("roof.ac", 'AC3Db\nMATERIAL "" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n'
                           "OBJECT poly\ntexture \"none.png\"\nnumvert 6\n0 0 0\n2 0 0\n2 3 0\n0 3 0\n2 0 -1\n2 3 -1\nnumsurf 5\n"
                           "SURF 0x20\nmat 0\nrefs 4\n0 0 0\n1 0 0\n2 0 0\n3 0 0\nSURF 0x00\nmat 0\nrefs 4\n1 0 0\n4 0 0\n5 0 0\n2 0 0\n"
                           "SURF 0x02\nrefs 2\n0 0 0\n2 0 0\n" + 2 * "SURF 0x02\nrefs 2\n0 0 0\n1 0 0\n" + "kids 0\n")
        found = self.info(model)
        self.assertIn("none.png", found.pop("warnings")[0])
        self.assertEqual(found, {
            "file": model, "format": "ac3d", "triangles": 4, "drawn_triangles": 4, "vertices": 6, "parts": 1, "materials": 1,
            "textures": [{"name": "none.png", "found": False}], "bounds": [[0, 0, -1], [2, 3, 0]], "two_sided_triangles": 2,
            "two_sided_surfaces": 1, "lines": 3, "frames": 1, "animations": [], "animations_beside": []})


class Scenes(ManyCase):
    def test_cameras_are_those_of_the_first_frame(self):
        self.write("q.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n")
        scene = self.write("s.json", json.dumps({
            "objects": [{"name": "o", "model": "q.obj", "class": "thing"}],
            "lights": [{"name": "sun", "kind": "directional", "position": [0, 1, 0]}, {"name": "lamp", "enabled": False},
                       {"name": "head", "kind": "head"}, {"name": "cone", "kind": "spot", "position": [0, 1, 0]}],
            "cameras": [{"name": "c", "width": 64, "height": 48, "near": 1, "far": 50, "lookAt": [0, 0, 0],
                         "eye": {"keys": [[3, [0, 0, 5]], [7, [0, 0, 9]]]}},
                        {"name": "rolling", "eye": [0, 0, 5], "lookAt": [0, 0, 0], "rollingShutter": {"duration": 0.25, "direction": "left"}}]}))
        found = json.loads(self.dgtk("info", scene, "--json").stdout)
        self.assertEqual((found["first_frame"], found["last_frame"], found["key_frames"]), (3, 7, [3, 7]))
        camera = found["cameras"][0]
        self.assertEqual((camera["t"], camera["R"]), ([0, 0, 5], [[1, 0, 0], [0, -1, 0], [0, 0, -1]]))
        self.assertEqual([camera[key] for key in ("name", "model", "width", "height", "near", "far")], ["c", "pinhole", 64, 48, 1, 50])
        self.assertNotIn("rollingShutter", camera)
        self.assertEqual(found["cameras"][1]["rollingShutter"], {"duration": 0.25, "direction": "left"})
        self.assertEqual([(light["name"], light["kind"], light["enabled"]) for light in found["lights"]],
                         [("sun", "directional", True), ("lamp", "point", False), ("head", "head", True), ("cone", "spot", True)])
        self.assertEqual(found["objects"], [{"id": 1, "name": "o", "class": "thing", "class_id": 1, "model": self.path("q.obj"),
                                             "triangles": 1}])
        self.assertEqual(found["classes"], [{"id": 1, "name": "thing"}])
        smaller = json.loads(self.dgtk("info", scene, "--json", "--size", "32x24").stdout)["cameras"][0]
        self.assertEqual((smaller["width"], smaller["height"]), (32, 24))
        self.assertAlmostEqual(smaller["K"][0][0], camera["K"][0][0] / 2, delta=1e-12)

    def test_resolution_by_equations_4_1_and_4_2(self):
        scene = self.write("s.json", json.dumps({"objects": [], "cameras": [
            {"name": "c", "fovY": 60, "near": 0.5, "far": 100.5, "width": 640, "height": 480,
             "eye": [0, 0, 5], "lookAt": [0, 0, 0], "up": [0, 1, 0]}]}))
        camera = json.loads(self.dgtk("info", scene, "--json").stdout)["cameras"][0]
        expected = 2 * 100 * math.tan(math.radians(30)) / 480
        self.assertAlmostEqual(camera["resolution"]["x"], expected, delta=1e-12)
        self.assertAlmostEqual(camera["resolution"]["y"], expected, delta=1e-12)
        self.assertAlmostEqual(camera["resolution"]["far_plane"]["y"], 2 * 100.5 * math.tan(math.radians(30)) / 480, delta=1e-12)
        self.assertAlmostEqual(camera["K"][0][0], 240 / math.tan(math.radians(30)), delta=1e-9)
        self.assertEqual(camera["K"][0][2], 320)
        self.assertEqual(camera["t"], [0, 0, 5])

    def test_everything_that_is_told_of_a_dataset(self):
        out = self.path("out")
        self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", out, "--quiet", "--size", "16x12", "--frames", "1:2", "--cameras", "right",
                  "--layers", "depth,objects", "--depth-format", "npy,pfm", "--visibility", "ray")
        found = json.loads(self.dgtk("info", out, "--json").stdout)
        manifest = load_json(os.path.join(out, "manifest.json"))
        classes = load_json(os.path.join(out, "objects.json"))["classes"]
        self.assertEqual(found, {
            "dataset": out, "version": manifest["version"], "cameras": ["right"], "first_frame": 1, "last_frame": 2, "frames": 2,
            "files": len(manifest["files"]), "bytes": sum(file["bytes"] for file in manifest["files"]), "units": manifest["units"],
            "layers": [{"name": row["name"], "format": row["format"], "type": row["type"] if row["format"] != "pfm" else "float32",
                        "channels": 1, "unit": row["unit"], "files": 4 if row["name"] == "depth" else 2} for row in manifest["layers"]],
            "classes": classes, "request": manifest["request"]})
        self.assertEqual([(row["name"], row["format"]) for row in found["layers"]], [("depth", "npy"), ("depth", "pfm"), ("objects", "ppm")])

    def test_layers_have_the_type_of_their_files(self):
        self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", self.path("out"), "--quiet", "--size", "16x12", "--frames", "0",
                  "--cameras", "left", "--layers", "depth,flow_forward", "--depth-format", "npy,exr,pfm,dgd")
        layers = json.loads(self.dgtk("info", self.path("out"), "--json").stdout)["layers"]
        self.assertEqual({(layer["name"], layer["format"]): layer["type"] for layer in layers},
                         {("depth", "npy"): "float64", ("depth", "dgd"): "float64", ("depth", "exr"): "float32", ("depth", "pfm"): "float32",
                          ("flow_forward", "flo"): "float32", ("flow_forward_class", "png"): "uint8"})

    def test_matrices_are_of_real_numbers(self):
        """As NumPy takes them: of an axis-parallel camera, too, whose R is whole."""
        scene = self.write("s.json", json.dumps({"objects": [{"name": "o", "model": "q.obj", "position": [1, 0, 0]}], "cameras": [
            {"name": "c", "width": 64, "height": 48, "eye": [0, 0, 5], "lookAt": [0, 0, 0]}]}))
        self.write("q.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n")
        self.dgtk("render", scene, "-o", self.path("out"), "--quiet", "--layers", "boxes")
        camera = load_json(self.path("out", "cameras.json"))["cameras"][0]
        info = json.loads(self.dgtk("info", scene, "--json").stdout)["cameras"][0]
        box = load_json(self.path("out", "c", "boxes", "000000.json"))["objects"][0]
        for document, keys in ((camera, "KRt"), (info, "KRt"), (box, ("R", "t", "scale", "matrix", "box3d", "box_projected"))):
            for key in keys:
                self.assertEqual(numpy.array(document[key]).dtype, numpy.float64, f"{key}: {document[key]}")
        self.assertEqual(numpy.array(box["box_visible"]).dtype, numpy.int64)  # the borders of a part of the picture

    def test_surfaces_of_a_plane_seen_squarely(self):
        scene = self.write("plane.obj", "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3 4\n") and self.write(
            "s.json", json.dumps({"objects": [{"name": "p", "model": "plane.obj"}], "cameras": [
                {"name": "c", "fovY": 60, "near": 0.5, "far": 100, "width": 64, "height": 48,
                 "eye": [0, 0, 5], "lookAt": [0, 0, 0], "up": [0, 1, 0]}]}))
        camera = json.loads(self.dgtk("info", scene, "--json", "--surfaces").stdout)["cameras"][0]
        pixel = 2 * 5 * math.tan(math.radians(30)) / 48
        for key in ("smallest", "median", "largest"):
            self.assertAlmostEqual(camera["surfaces"][key], pixel, delta=1e-9 * pixel)

    def test_every_scene_of_the_toolkit(self):
        for name in sorted(os.listdir(SCENES)):
            if name.endswith((".scene", ".json")):
                with self.subTest(name):
                    found = json.loads(self.dgtk("info", os.path.join(SCENES, name), "--json").stdout)
                    for key in ("objects", "cameras", "lights", "first_frame", "last_frame", "key_frames"):
                        self.assertIn(key, found)
                    self.assertTrue(self.dgtk("info", os.path.join(SCENES, name)).stdout)


if __name__ == "__main__":
    main()
