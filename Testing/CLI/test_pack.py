# SPDX-License-Identifier: BSD-3-Clause
"""Packed datasets: moved, with the originals gone, they are verified and rendered again."""
import json
import os
import shutil
import signal
import struct
import subprocess

from harness import DGTK, digests, load_json, main
from many_runs import ManyCase

MESH = "vt 0 0\nvt 1 0\nvt 1 1\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1/1 2/2 3/3\n"
LAYERS = ("--layers", "color,depth,objects,classes,pov", "--size", "48x36", "--quiet")


def ppm(red, green, blue):
    return b"P6\n1 1\n255\n" + bytes([red, green, blue])


def gltf():
    points = struct.pack("<9f", -1, -1, 0, 1, -1, 0, 1, 1, 0)
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                               "min": [-1, -1, 0], "max": [1, 1, 0]}],
                "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"uri": "parts/points.bin", "byteLength": 36}]}
    return json.dumps(document), points


class Pack(ManyCase):
    def put(self, name, contents):
        path = self.path("home", name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(contents if isinstance(contents, bytes) else contents.encode())
        return path

    def obj(self, name, texture):
        stem = os.path.splitext(os.path.basename(name))[0]
        self.put(name, f"mtllib {stem}.mtl\nusemtl m\n" + MESH)
        self.put(os.path.splitext(name)[0] + ".mtl", f"newmtl m\nKa 1 1 1\nKd 1 1 1\nmap_Kd {texture}\n")

    def setUp(self):
        super().setUp()
        self.obj("red/box.obj", "skins/wood.ppm")
        self.put("red/skins/wood.ppm", ppm(255, 0, 0))
        self.obj("green/box.obj", "skins/wood.ppm")
        self.put("green/skins/wood.ppm", ppm(0, 255, 0))
        self.obj("a b/with blank.obj", "../textures of all/b l.ppm")
        self.put("textures of all/b l.ppm", ppm(0, 0, 255))
        document, points = gltf()
        self.put("scene/models/tri.gltf", document)
        self.put("scene/models/parts/points.bin", points)
        self.put("scene/plain.pov", '#include "sub/mesh.inc"\nobject { M }\n')
        self.put("scene/sub/mesh.inc", "#declare M = mesh { triangle { <-1,-1,0>, <1,-1,0>, <1,1,0> } }\n")
        self.put("pictures/other.ppm", ppm(255, 255, 0))
        self.put("pictures/sky.ppm", ppm(9, 9, 90))
        self.put("classes.json", '{ "box": 7, "": 9 }')
        models = ["../red/box.obj", "../green/box.obj", "../a b/with blank.obj", "models/tri.gltf", "plain.pov",
                  self.path("home", "red/box.obj")]
        objects = [{"model": m, "class": "box" if "box" in m else "", "position": [2.2 * (i % 3) - 2, 2.2 * (i // 3) - 1, 0]}
                   for i, m in enumerate(models)]
        objects[3]["materials"] = {"*": {"texture": "../pictures/other.ppm"}}
        objects[1]["materials"] = {"*": {"bump": "not there.png"}}
        scene = {"classes": "../classes.json", "environment": {"image": "../pictures/sky.ppm"}, "objects": objects,
                 "keyFrames": [0, 1], "cameras": [{"name": "c", "eye": [0, 0, 9], "lookAt": [0, 0, 0]}]}
        self.scene = self.put("scene/the scene.json", json.dumps(scene))

    def test_a_packed_dataset_moves(self):
        self.dgtk("render", self.scene, "-o", self.path("plain"), *LAYERS)
        self.dgtk("render", self.scene, "-o", self.path("packed"), "--pack", *LAYERS)
        plain, packed = digests(self.path("plain")), digests(self.path("packed"))
        for name, digest in plain.items():
            if name not in ("manifest.json", "scene.json", "objects.json"):
                self.assertEqual(packed[name], digest, name)
        added = sorted(name for name in packed if name not in plain)
        self.assertEqual(added, sorted("inputs/" + name for name in (
            "scene/the scene.json", "above/classes.json", "red/box.obj", "red/box.mtl", "red/skins/wood.ppm", "green/box.obj",
            "green/box.mtl", "green/skins/wood.ppm", "above/a b/with blank.obj", "above/a b/with blank.mtl",
            "above/textures of all/b l.ppm", "models/tri.gltf", "models/parts/points.bin", "scene/plain.pov",
            "scene/sub/mesh.inc", "pictures/other.ppm", "pictures/sky.ppm")))
        manifest = load_json(self.path("packed", "manifest.json"))
        self.assertEqual(sorted(entry["path"] for entry in manifest["inputs"]), added)
        self.assertEqual({f["path"]: f["sha256"] for f in manifest["files"] if f["path"].startswith("inputs/")},
                         {name: packed[name] for name in added})
        text = json.dumps(load_json(self.path("packed", "scene.json")))
        self.assertNotIn("..", text)
        self.assertNotIn(self.folder, text)

        before = digests(self.path("packed"))
        for more in ((), ("--pack",), ("--replace",), ("--resume",)):
            self.refused("render", self.path("packed", "scene.json"), "-o", self.path("packed"), *LAYERS, *more, status=2,
                         says="what the scene is loaded from")
        self.assertEqual(digests(self.path("packed")), before)

        os.makedirs(self.path("far", "away"))
        shutil.move(self.path("packed"), self.path("far", "away", "moved"))
        shutil.rmtree(self.path("home"))
        self.dgtk("verify", self.path("far", "away", "moved"))
        self.dgtk("verify", self.path("plain"), status=1)
        self.dgtk("render", self.path("far", "away", "moved", "scene.json"), "-o", self.path("again"), "--pack", *LAYERS)
        again = digests(self.path("again"))
        for name, digest in plain.items():
            if name not in ("manifest.json", "scene.json", "objects.json"):
                self.assertEqual(again[name], digest, name)
        self.dgtk("verify", self.path("again"))

    def test_where_the_scene_is_makes_no_difference(self):
        self.dgtk("render", self.scene, "-o", self.path("one"), "--pack", *LAYERS)
        os.makedirs(self.path("x"))
        os.rename(self.path("home"), self.path("x", "house"))
        scene = load_json(self.path("x", "house", "scene", "the scene.json"))
        self.assertTrue(os.path.isabs(scene["objects"][-1]["model"]))
        scene["objects"][-1]["model"] = self.path("x", "house", "red/box.obj")
        with open(self.path("x", "house", "scene", "the scene.json"), "w") as file:
            json.dump(scene, file)
        subprocess.run([DGTK, "render", "the scene.json", "-o", self.path("two"), "--pack", *LAYERS], check=True,
                       cwd=self.path("x", "house", "scene"))
        self.assert_same_files(self.path("one"), self.path("two"),
                               ignore=("manifest.json", "inputs/scene/the scene.json"))

    def test_an_interrupted_packed_run_is_resumed(self):
        self.dgtk("render", self.scene, "-o", self.path("whole"), "--pack", *LAYERS)
        out = self.path("cut")
        self.interrupted(["render", self.scene, "-o", out, "--pack", *LAYERS], out, signal.SIGKILL,
                         lambda: os.path.exists(os.path.join(out, "inputs", "pictures", "sky.ppm")))
        self.refused("render", self.scene, "-o", out, "--resume", *LAYERS, status=2, says="cut")
        self.dgtk("render", self.scene, "-o", out, "--pack", "--resume", *LAYERS)
        self.assert_same_files(self.path("whole"), out)

    def test_a_model_that_names_a_file_absolutely_is_refused(self):
        self.put("scene/abs.pov", f'#include "{self.path("home", "scene/sub/mesh.inc")}"\nobject {{ M }}\n')
        scene = self.put("scene/abs.json", json.dumps({"objects": [{"model": "abs.pov"}],
                                                       "cameras": [{"name": "c", "eye": [0, 0, 9], "lookAt": [0, 0, 0]}]}))
        self.refused("render", scene, "-o", self.path("out"), "--pack", *LAYERS, status=3, says=["abs.json", "cannot be packed"])

    def test_what_models_include_is_an_input_without_packing_too(self):
        self.dgtk("render", self.scene, "-o", self.path("out"), *LAYERS)
        inputs = {entry["path"] for entry in load_json(self.path("out", "manifest.json"))["inputs"]}
        for name in ("red/box.mtl", "scene/models/parts/points.bin", "scene/sub/mesh.inc"):
            self.assertIn("../home/" + name, inputs)
        self.put("red/box.mtl", "newmtl m\nKd 0 0 1\n")
        self.dgtk("verify", self.path("out"), status=1)


if __name__ == "__main__":
    main()
