# SPDX-License-Identifier: BSD-3-Clause
"""What datasets hand on to other people's formats: metres, frames a second, licence, classes, poses, which objects move and which
models are the same, models as files, keypoints. Compared with numbers that are worked out here from the scene."""
import json
import os
import re
import shutil

import numpy as np

from harness import SOURCE, Case, load_json, main

MODELS = os.path.join(SOURCE, "Data", "Models")
CAMERA = {"name": "left", "eye": [0, 0.5, 8], "lookAt": [0, 0.5, 0], "width": 64, "height": 48, "fovY": 60}


def model(file):
    return os.path.join(MODELS, file)


def read_ply(path):
    """Comments, vertices (a structured array) and faces (rows of the properties, without the count)."""
    with open(path, "rb") as file:
        head, body = file.read().split(b"end_header\n", 1)
    kinds = {"double": "<f8", "float": "<f4", "uchar": "u1", "int": "<i4"}
    lines = head.decode().splitlines()
    counts = [int(line.split()[2]) for line in lines if line.startswith("element")]
    faces = next(i for i, line in enumerate(lines) if line.startswith("element face"))
    vertex = np.dtype([(line.split()[2], kinds[line.split()[1]]) for line in lines[:faces] if line.startswith("property")])
    more = [line.split()[2] for line in lines[faces:] if re.match(r"property int ", line)]
    face = np.dtype([("n", "u1"), ("v", "<i4", 3), *((name, "<i4") for name in more)])
    vertices = np.frombuffer(body, vertex, counts[0])
    triangles = np.frombuffer(body, face, counts[1], offset=vertex.itemsize * counts[0])
    assert len(body) == vertex.itemsize * counts[0] + face.itemsize * counts[1]
    return [line.split(" ", 1)[1] for line in lines if line.startswith("comment")], vertices, triangles


class Metadata(Case):
    def render(self, scene, *options, name="out", status=0):
        path = self.write(f"{name}.json", json.dumps({"version": 1, "cameras": [CAMERA], **scene}))
        self.dgtk("render", path, "-o", self.path(name), "--quiet", *options, status=status)
        return self.path(name)

    def documents(self, folder):
        return [load_json(os.path.join(folder, name + ".json")) for name in ("manifest", "objects", "poses")]

    def test_metres_frames_a_second_and_licence(self):
        ball = {"objects": [{"model": model("ball.ac")}]}
        said = {"name": "Balls", "description": "ten of them", "version": "1.0", "author": "a, b", "license": "CC0-1.0",
                "licenseUrl": "https://x", "citation": "@misc{x}", "url": "https://y"}
        for units, number, expected in (("m", None, 1), ("mm", None, 1e-3), ("Metres", None, 1), ("inch", None, 0.0254),
                                        ("ft", None, 0.3048), ("", None, None), ("", 2.5, 2.5), ("furlong", None, None),
                                        ("furlong", 201.168, 201.168), ("cm", 0.01, 0.01), ("Mm", None, None)):
            with self.subTest(units=units, number=number):
                scene = {**ball, "units": units, "fps": 12.5, "dataset": said}
                if number is not None:
                    scene["metresPerUnit"] = number
                folder = self.render(scene, "--layers", "depth", name="units")
                manifest = load_json(os.path.join(folder, "manifest.json"))
                self.assertEqual((manifest["metres_per_unit"], manifest["fps"], manifest["info"]), (expected, 12.5, said))
                again = load_json(os.path.join(folder, "scene.json"))
                self.assertEqual((again.get("metresPerUnit"), again["dataset"]), (number, said))
                shutil.rmtree(folder)
        manifest = load_json(os.path.join(self.render(ball, "--layers", "depth"), "manifest.json"))
        self.assertEqual((manifest["metres_per_unit"], manifest["fps"], manifest["info"]), (None, 25, {}))

    def test_words_of_scenes_are_checked(self):
        ball = {"version": 1, "objects": [{"model": model("ball.ac"), "class": "ball"}], "cameras": [CAMERA]}

        def of_object(**more):
            return {"objects": [{**ball["objects"][0], **more}]}

        for wrong, says in (
                ({"units": "mm", "metresPerUnit": 1}, ["metresPerUnit contradicts units 'mm'", "0.001", "found 1"]),
                ({"metresPerUnit": 0}, ["metresPerUnit is out of range"]),
                ({"dataset": {"licence": "x"}}, ["dataset.licence is an unknown key", "license"]),
                ({"classes": {"ball": {"id": 1, "color": [0, 0, 256]}}}, ["classes.ball.color[2] is out of range"]),
                ({"classes": {"ball": {"id": 1, "keypoints": ["a", "a"]}}}, ["keypoints[1] is named twice"]),
                ({"classes": {"ball": {"id": 1, "keypoints": ["a"], "skeleton": [[1, 2]]}}}, ["classes.ball", "[1, 2]"]),
                ({"classes": {"ball": {"id": 1, "keypoints": ["nose"]}}, **of_object(keypoints={"nase": 0})},
                 ["objects[0].keypoints names what is none of class 'ball'", "perhaps 'nose'"]),
                (of_object(keypoints={"a": 100000}), ["'ball-1'", "keypoints.a is no vertex of", "below 610"]),
                (of_object(keypoints={"a": 1.5}), ["keypoints.a is not a whole number"]),
                (of_object(keypoints={"a": "b"}), ["keypoints.a has the wrong type"])):
            with self.subTest(says=says):
                self.refused("render", self.write("w.json", json.dumps({**ball, **wrong})), "-o", self.path("w"), status=3,
                             says=says)
        for more, word in (({"metresPerUnit": 1}, "metresPerUnit"), ({"dataset": {"name": "x"}}, "dataset")):
            plain = {"version": 1, "objects": [{"model": "a.ac"}], **more}
            self.refused("convert", self.write("c.json", json.dumps(plain)), self.path("c.scene"), status=3,
                         says=[word + " cannot be said in .scene"])
        self.refused("convert", self.write("c.json", json.dumps({"objects": [{"model": "a.ac", "keypoints": {"a": 0}}]})),
                     self.path("c.scene"), status=3, says=["keypoints cannot be said in .scene"])

    def test_classes(self):
        ball = {"id": 3, "supercategory": "toy", "thing": True, "color": [255, 0, 10], "keypoints": ["top", "tip"],
                "skeleton": [[1, 2]]}
        table = {"ball": ball, "sky": {"id": 2, "thing": False}, "wall": 1}
        objects = [{"model": model("ball.ac"), "class": "ball"}]
        expected = [{"id": 1, "name": "wall"}, {"id": 2, "name": "sky", "thing": False}, {"name": "ball", **ball}]
        folder = self.render({"classes": table, "objects": objects}, "--layers", "depth")
        self.assertEqual(self.documents(folder)[1]["classes"], expected)
        self.assertEqual(load_json(os.path.join(folder, "scene.json"))["classes"], {**table, "sky": {"id": 2, "thing": False}})
        self.write("classes.json", json.dumps(table))
        folder = self.render({"classes": "classes.json", "objects": objects}, "--layers", "depth", name="shared")
        self.assertEqual(self.documents(folder)[1]["classes"], expected)

    def test_poses_and_what_changes(self):
        turn = [0.5, 0.5, 0.5, 0.5]  # x to y to z to x
        scene = {"keyFrames": [0, 4], "objects": [
            {"name": "still", "model": model("ball.ac"), "position": [1, 2, 3], "orientation": turn, "scale": [1, 2, 3]},
            {"name": "same keys", "model": model("ball.ac"), "position": {"keys": [[0, [1, 0, 0]], [4, [1, 0, 0]]]}},
            {"name": "later", "model": model("ball.ac"), "scale": [-1, 1, 1],
             "position": {"keys": [[0, [0, 0, 0]], [3, [0, 0, 0]], [4, [0, 1, 0]]]}},
            {"name": "child", "model": model("ball.ac"), "parent": "later"},
            {"name": "sheared", "model": model("ball.ac"), "parent": "still", "orientation": [0.9, 0.3, 0.3, 0.1]},
            {"name": "flag", "model": model("flag.md2"), "scale": 0.05},
            {"name": "frozen", "model": model("flag.md2"), "scale": 0.05, "animation": {"rate": 0}},
            {"name": "gone", "model": model("ball.ac"), "visible": {"keys": [[0, True], [2, False]]}}]}
        folder = self.render(scene, "--layers", "depth,boxes", "--frames", "0:4:2")
        _, objects, poses = self.documents(folder)
        flags = {o["name"]: (o["static"], o["deforming"]) for o in objects["objects"]}
        self.assertEqual(flags, {"still": (True, False), "same keys": (True, False), "later": (False, False),
                                 "child": (False, False), "sheared": (True, False), "flag": (False, True),
                                 "frozen": (True, False), "gone": (True, False)})
        self.assertEqual([(p["frame"], p["id"]) for p in poses["poses"]], [(f, i) for f in (0, 2, 4) for i in range(1, 9)])
        of = {(p["frame"], p["id"]): p for p in poses["poses"]}
        cycle = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])
        np.testing.assert_allclose(of[2, 1]["R"], cycle, atol=1e-15)
        np.testing.assert_allclose(of[2, 1]["scale"], [1, 2, 3], atol=1e-15)
        np.testing.assert_allclose(of[2, 1]["matrix"], np.c_[cycle * [1, 2, 3], [1, 2, 3]], atol=1e-15)
        self.assertEqual((of[0, 3]["t"], of[2, 3]["t"], of[4, 3]["t"], of[4, 4]["t"]), ([0, 0, 0], [0, 0, 0], [0, 1, 0], [0, 1, 0]))
        self.assertEqual(of[4, 3]["scale"], [-1, 1, 1])
        self.assertIsNone(of[0, 5]["R"])
        self.assertIsNone(of[0, 5]["scale"])
        self.assertEqual([of[f, 8]["visible"] for f in (0, 2, 4)], [True, False, False])
        for camera in load_json(os.path.join(folder, "cameras.json"))["cameras"]:
            for box in load_json(os.path.join(folder, "left", "boxes", f"{camera['frame']:06d}.json"))["objects"]:
                world = np.array(of[camera["frame"], box["id"]]["matrix"])
                seen = camera["R"] @ world + np.c_[np.zeros((3, 3)), camera["t"]]
                np.testing.assert_allclose(seen, box["matrix"], atol=1e-12)
        self.assertIn("poses.json", [file["path"] for file in load_json(os.path.join(folder, "manifest.json"))["files"]])
        self.dgtk("verify", folder)

    def test_models(self):
        for name in ("creature.md2", "creature.png"):
            shutil.copy(model(name), self.path(name))
        os.mkdir(self.path("other"))
        shutil.copy(model("crate.ac"), self.path("other", "box.ac"))
        scene = {"keyFrames": [0, 9], "objects": [
            {"name": "a", "model": model("crate.ac"), "position": [1, 0, 0], "scale": 2},
            {"name": "b", "model": model("crate.ac")},
            {"name": "red", "model": model("crate.ac"), "materials": {"*": {"diffuse": [1, 0, 0]}}},
            {"name": "bare", "model": model("crate.ac"), "materials": {"*": {"texture": ""}}},
            {"name": "now", "model": "creature.md2"},
            {"name": "late", "model": "creature.md2", "animation": {"offset": 3}},
            {"name": "gltf", "model": model("windmill.gltf")}]}
        folder = self.render(scene, "--layers", "depth", "--models", "--frames", "5")
        manifest, objects, _ = self.documents(folder)
        of = {o["name"]: o for o in objects["objects"]}
        self.assertEqual(of["a"]["geometry"], of["b"]["geometry"])
        self.assertEqual(len({o["geometry"] for o in objects["objects"]}), 6)
        self.assertEqual({o["geometry_file"] for o in objects["objects"]},
                         {"models/" + o["geometry"][:16] + ".ply" for o in objects["objects"]})
        listed = {file["path"] for file in manifest["files"]}
        there = {"models/" + name for name in os.listdir(os.path.join(folder, "models"))}
        self.assertEqual(there, {name for name in listed if name.startswith("models/")})
        comments, vertices, faces = read_ply(os.path.join(folder, of["red"]["geometry_file"]))
        self.assertEqual(len(faces), of["red"]["triangles"])
        self.assertEqual({tuple(v) for v in np.c_[vertices["red"], vertices["green"], vertices["blue"]].tolist()}, {(255, 0, 0)})
        stem = of["red"]["geometry"][:16]
        self.assertEqual(comments, [f"TextureFile {stem}_0.png", f"TextureFile {stem}_1.png"])
        for number, texture in enumerate(("planks.png", "wood.png")):
            with open(os.path.join(folder, "models", f"{stem}_{number}.png"), "rb") as one, \
                    open(os.path.join(SOURCE, "Data", "Textures", texture), "rb") as other:
                self.assertEqual(one.read(), other.read())
        self.assertEqual(faces["texnumber"].tolist(), [0] * 12 + [1] * 144)
        self.assertEqual(read_ply(os.path.join(folder, of["bare"]["geometry_file"]))[0], [])
        info = json.loads(self.dgtk("info", model("crate.ac"), "--json").stdout)
        _, vertices, faces = read_ply(os.path.join(folder, of["a"]["geometry_file"]))
        corners = np.stack([vertices[axis] for axis in "xyz"], axis=-1)[faces["v"]].reshape(-1, 3)
        np.testing.assert_allclose([corners.min(axis=0), corners.max(axis=0)], info["bounds"], atol=1e-12)
        back = json.loads(self.dgtk("info", os.path.join(folder, of["a"]["geometry_file"]), "--json").stdout)
        self.assertEqual((back["triangles"], [t["found"] for t in back["textures"]]), (info["triangles"], [True, True]))
        np.testing.assert_allclose(np.linalg.norm([vertices[n] for n in ("nx", "ny", "nz")], axis=0), 1, atol=1e-6)
        self.dgtk("verify", folder)
        self.dgtk("render", self.path("out.json"), "-o", folder, "--layers", "depth", "--models", "--frames", "5", "--resume", "--quiet")
        self.assertEqual(self.documents(folder)[0], manifest)
        elsewhere = self.render({"objects": [{"model": "other/box.ac", "materials": {"*": {"texture": ""}}}]}, "--layers", "depth",
                                name="elsewhere")
        self.assertEqual(self.documents(elsewhere)[1]["objects"][0]["geometry"], of["bare"]["geometry"])
        self.assertNotIn("geometry_file", self.documents(elsewhere)[1]["objects"][0])
        self.assertFalse(os.path.exists(os.path.join(elsewhere, "models")))

    def test_models_whose_faces_have_no_picture(self):
        """Some of them: those without texture coordinates, whatever a scene says."""
        for name in ("wood.png", "planks.png"):
            shutil.copy(os.path.join(SOURCE, "Data", "Textures", name), self.path(name))
        self.write("half.mtl", "newmtl m\nmap_Kd wood.png\n")
        self.write("half.obj", "mtllib half.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl m\nf 1/1 2/2 3/3\nf 1 3 4\n")
        scene = {"cameras": [{"name": "eye", "eye": [0, 0, 3], "lookAt": [0, 0, 0], "near": 1, "far": 9, "width": 64, "height": 48}], "objects": [
            {"name": "half", "model": "half.obj"},
            {"name": "other", "model": "half.obj", "position": [0, 0, -1], "materials": {"m": {"texture": "planks.png"}}}]}
        layers = ("--layers", "color,depth,parts,uv", "--models", "--visibility", "ray")
        folder = self.render(scene, *layers)
        for one in self.documents(folder)[1]["objects"]:
            comments, _, faces = read_ply(os.path.join(folder, one["geometry_file"]))
            self.assertEqual((len(comments), faces["texnumber"].tolist()), (1, [0, -1]), one["name"])
        uv, parts = (np.load(os.path.join(folder, "eye", layer, "000000.npy")) for layer in ("uv", "parts"))
        self.assertEqual({0, 1} - set(parts.ravel().tolist()), set())
        np.testing.assert_array_equal(np.isfinite(uv[..., 0]), parts == 0)
        self.dgtk("verify", folder)
        file = os.path.join(folder, self.documents(folder)[1]["objects"][0]["geometry_file"])
        with open(file, "r+b") as ply:
            ply.seek(-4, os.SEEK_END)
            ply.write(bytes(4))  # the last face has the picture
        self.refused("verify", folder, "--check", "models", status=1, says="looks")

    def test_keypoints(self):
        crate = {"inside": [0, 0.5, 0], "front": [0, 0.5, 0.495], "back": [0, 0.5, -0.5], "beside": [50, 0, 0], "behind": [0, 0, 90]}
        scene = {"keyFrames": [0, 2], "objects": [
            {"name": "crate", "model": model("crate.ac"), "keypoints": crate},
            {"name": "ball", "model": model("ball.ac"), "position": [0, 0.5, 2], "keypoints": {"in": [0, 0, 0.119]},
             "visible": {"keys": [[0, True], [2, False]]}},
            {"name": "flag", "model": model("flag.md2"), "position": [2, 0, 0], "scale": 0.05, "keypoints": {"edge": 30}},
            {"name": "plain", "model": model("ball.ac"), "position": [0, 1.5, 0]}],
            "cameras": [CAMERA, {**CAMERA, "name": "flat", "model": "orthographic"}, {**CAMERA, "name": "rolling",
                        "eye": {"keys": [[0, [0, 0.5, 8]], [2, [0.5, 0.5, 8]]]}, "rollingShutter": {"duration": 0.5}}]}
        scene["cameras"][1].pop("fovY")
        folder = self.render(scene, "--layers", "depth,boxes")
        focal = 24 / np.tan(np.radians(30))
        classes = {}
        for frame in (0, 1, 2):
            objects = load_json(os.path.join(folder, "left", "boxes", f"{frame:06d}.json"))["objects"]
            self.assertNotIn("keypoints", objects[3])
            for point in objects[0]["keypoints"]:
                x, y, z = crate[point["name"]]
                there = [x, 0.5 - y, 8 - z]
                np.testing.assert_allclose(point["x"], there, atol=1e-12)
                if there[2] > 0:
                    np.testing.assert_allclose([point["u"], point["v"]],
                                               [32 + focal * there[0] / there[2], 24 + focal * there[1] / there[2]], atol=1e-9)
                else:
                    self.assertEqual((point["u"], point["v"]), (None, None))
            classes[frame] = [p["visibility"] for o in objects[:2] for p in o["keypoints"]]
        self.assertEqual(classes[0], [2, 2, 2, 4, 5, 1])
        self.assertEqual(classes[2], [3, 1, 3, 4, 5, 0])
        flags = [load_json(os.path.join(folder, "left", "boxes", f"{f:06d}.json"))["objects"][2]["keypoints"][0]["x"] for f in (0, 2)]
        self.assertNotEqual(*flags)  # it goes with the vertex
        self.dgtk("verify", folder)

    def test_keypoints_by_the_numbers_of_files(self):
        points = ["7 7 7", "0 0 0", "1 0 0", "0 1 0", "0 0 0"]  # the first is of no triangle, two are at one place
        files = [self.write("a.obj", "".join(f"v {p}\n" for p in points) + "f 4 5 3\n"),
                 self.write("a.off", "OFF\n5 1 0\n" + "\n".join(points) + "\n3 3 4 2\n")]
        scene = {"objects": [{"model": file, "keypoints": {"x": 2, "y": 3, "first": 1, "last": 4}} for file in files], "cameras": [CAMERA]}
        folder = self.render(scene, "--layers", "boxes")
        for one in load_json(os.path.join(folder, "left", "boxes", "000000.json"))["objects"]:
            np.testing.assert_allclose([p["x"] for p in one["keypoints"]],
                                       [[1, 0.5, 8], [0, -0.5, 8], [0, 0.5, 8], [0, 0.5, 8]], atol=1e-12)
        self.dgtk("verify", folder)
        for file in files:
            self.assertEqual(json.loads(self.dgtk("info", file, "--json").stdout)["vertices"], 5)
            refused = {"objects": [{"model": file, "keypoints": {"unused": 0}}], "cameras": [CAMERA]}
            self.refused("render", self.write("refused.json", json.dumps(refused)), "-o", self.path("no"), status=3,
                         says=["vertex of no triangle"])


if __name__ == "__main__":
    main()
