# SPDX-License-Identifier: BSD-3-Clause
"""glTF 2.0, read as the specification says, and by DGTk's own importer."""
import json
import math
import os
import struct

import numpy as np

import datasets
from datasets import layer_of, load_json, main
from harness import SOURCE
from judges import by_blender, by_node

COMPONENTS = {5121: "<u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def rotation(q):
    """Of x y z w."""
    x, y, z, w = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


class Asset:
    def __init__(self, folder):
        self.json = load_json(os.path.join(folder, "scene.gltf"))
        self.buffers = []
        for one in self.json["buffers"]:
            with open(os.path.join(folder, one["uri"]), "rb") as file:
                self.buffers.append(file.read())
            assert len(self.buffers[-1]) == one["byteLength"]
        self.parents = {child: i for i, node in enumerate(self.json["nodes"]) for child in node.get("children", ())}

    def accessor(self, index):
        one = self.json["accessors"][index]
        view = self.json["bufferViews"][one["bufferView"]]
        assert view["byteOffset"] % 4 == 0
        data = self.buffers[view["buffer"]][view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
        values = np.frombuffer(data, COMPONENTS[one["componentType"]], one["count"] * WIDTHS[one["type"]]).reshape(one["count"], -1)
        if "min" in one:
            np.testing.assert_array_equal(values.min(axis=0), np.float32(one["min"]))
            np.testing.assert_array_equal(values.max(axis=0), np.float32(one["max"]))
        return values.astype(float)

    def value(self, index, path, usual, seconds):
        for animation in self.json.get("animations", ()):
            for channel in animation["channels"]:
                if channel["target"] == {"node": index, "path": path}:
                    sampler = animation["samplers"][channel["sampler"]]
                    assert sampler["interpolation"] == "LINEAR"
                    times, values = self.accessor(sampler["input"])[:, 0], self.accessor(sampler["output"])
                    assert (np.diff(times) > 0).all()
                    if path == "rotation":
                        assert (np.sum(values[1:] * values[:-1], axis=1) > 0).all()  # the shorter way
                    return np.array([np.interp(seconds, times, column) for column in values.T])
        return np.array(self.json["nodes"][index].get(path, usual), float)

    def matrix(self, index, seconds):
        """The world's from the node's coordinates."""
        local = np.eye(4)
        local[:3, :3] = rotation(self.value(index, "rotation", (0, 0, 0, 1), seconds)) * self.value(index, "scale", (1, 1, 1), seconds)
        local[:3, 3] = self.value(index, "translation", (0, 0, 0), seconds)
        assert np.linalg.det(local[:3, :3]) > 0
        return self.matrix(self.parents[index], seconds) @ local if index in self.parents else local

    def nodes(self, key):
        return {node["name"]: i for i, node in enumerate(self.json["nodes"]) if key in node}

    def triangles(self, index, seconds):
        """Corners of a node's triangles in the world: (n, 3, 3)."""
        matrix, found = self.matrix(index, seconds), []
        for primitive in self.json["meshes"][self.json["nodes"][index]["mesh"]]["primitives"]:
            points = self.accessor(primitive["attributes"]["POSITION"])
            corners = self.accessor(primitive["indices"])[:, 0].astype(int)
            found.append((points @ matrix[:3, :3].T + matrix[:3, 3])[corners].reshape(-1, 3, 3))
        return np.concatenate(found)


def volume(triangles):
    """Positive where triangles are counter-clockwise from outside."""
    return np.sum(np.cross(triangles[:, 0], triangles[:, 1]) * triangles[:, 2]) / 6


VALIDATE = """
const fs = require("fs"), path = require("path"), file = process.argv[1];
require("gltf-validator").validateBytes(new Uint8Array(fs.readFileSync(file)), {
  externalResourceFunction: (name) => fs.promises.readFile(path.join(path.dirname(file), decodeURIComponent(name))).then((data) => new Uint8Array(data)),
}).then((report) => console.log(JSON.stringify(report)));
"""

BLENDER = """
import bpy, json, numpy, sys
if not hasattr(numpy, "bool"):
    numpy.bool = bool  # Debian 12's NumPy has dropped a name that the importer of its Blender uses
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = 25
bpy.ops.import_scene.gltf(filepath=sys.argv[-1])
found = {}
for frame in range(3):
    bpy.context.scene.frame_set(frame)
    for one in bpy.context.scene.objects:
        matrix = one.matrix_world
        entry = found.setdefault(one.name, {"type": one.type, "matrices": [], "corners": []})
        entry["matrices"].append([list(row) for row in matrix])
        if one.type == "MESH":
            entry["corners"].append([list(matrix @ vertex.co) for vertex in one.data.vertices])
        elif one.type == "CAMERA":
            entry["angle"] = one.data.angle_y
print("RESULT " + json.dumps(found))
"""


class Gltf(datasets.ExportCase):
    METRES = 0.5

    def exported(self, scene, *options):
        dataset = self.render(datasets.in_units(scene), "color,depth,position,objects", "--models")
        folder, record = self.export(dataset, "gltf", "--unit-metres", self.METRES, *options)
        return dataset, folder, Asset(folder), record

    def changed(self, name, change):
        """The scene of a pair after a change."""
        path = datasets.stereo(self.path(name))
        scene = load_json(path)
        change(scene)
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        return path

    def test_pixels_of_cameras(self):
        """What a pixel shows is projected to the pixel's centre by the node, yfov, aspectRatio, and K for the middle."""
        dataset, _, asset, _ = self.exported(datasets.stereo(self.path("scene")))
        largest = 0
        self.assertEqual(sorted(asset.nodes("camera")), ["left eye", "right.eye"])
        for name, index in asset.nodes("camera").items():
            camera = asset.json["cameras"][asset.json["nodes"][index]["camera"]]
            K, width, height = camera["extras"]["K"], camera["extras"]["width"], camera["extras"]["height"]
            half = math.tan(camera["perspective"]["yfov"] / 2)
            for frame in range(3):
                position = layer_of(dataset, "position", name, frame)
                v, u = np.nonzero(np.isfinite(position[..., 0]))
                world = np.vstack([position[v, u].T * self.METRES, np.ones(len(u))])
                x, y, z, _ = np.linalg.inv(asset.matrix(index, frame / 25)) @ world
                self.assertTrue((z < 0).all())
                px = K[0][2] + width / 2 * (x / -z) / (half * camera["perspective"]["aspectRatio"])
                py = K[1][2] - height / 2 * (y / -z) / half
                largest = max(largest, np.abs(px - u - 0.5).max(), np.abs(py - v - 0.5).max())
        self.assertLess(largest, 1e-3)
        print(f"pixels are {largest:.1e} off")

    def test_names_that_are_not_utf8(self):
        """As the page on datasets writes them."""
        def rename(scene):
            scene["cameras"][0]["name"] = "caf\uefe9"
            scene["objects"][1].update(name="a\uefe9", **{"class": "b\uefe9"})
            scene["objects"][2]["name"] = "a\uefea"

        _, _, asset, record = self.exported(self.changed("scene", rename), "--frames", "0")
        self.assertEqual([asset.json["cameras"][0]["name"], *sorted(asset.nodes("camera"))], ["caf\uefe9", "caf\uefe9", "right.eye"])
        self.assertEqual(sorted(asset.nodes("mesh")), ["a\uefe9", "a\uefea", "back wall", "block, kleiner & schräg"])
        self.assertEqual(asset.json["nodes"][asset.nodes("mesh")["a\uefe9"]]["extras"]["class"], "b\uefe9")
        self.assertEqual({one["camera"] for one in record["names"]}, {"caf\uefe9", "right.eye"})

    def test_objects_are_where_they_are(self):
        dataset, _, asset, _ = self.exported(datasets.stereo(self.path("scene")))
        poses = {(one["frame"], one["id"]): np.array(one["matrix"]) for one in load_json(os.path.join(dataset, "poses.json"))["poses"]}
        box = np.array([(a, b, c) for a in (-0.5, 0.5) for b in (-0.4, 0.4) for c in (-0.3, 0.3)])
        nodes = asset.nodes("mesh")
        self.assertEqual(sorted(nodes), ["back wall", "block", "block, kleiner & schräg", "röter Ring.v2"])
        meshes = {name: asset.json["nodes"][index]["mesh"] for name, index in nodes.items()}
        self.assertEqual(meshes["block"], meshes["block, kleiner & schräg"])
        self.assertEqual(len(asset.json["meshes"]), 3)
        for name in ("block", "block, kleiner & schräg"):
            extras = asset.json["nodes"][nodes[name]]["extras"]
            self.assertEqual((extras["class"], extras["visible_frames"], extras["deforming"]), ("block", [[0, 2]], False))
            for frame in range(3):
                matrix = poses[frame, extras["id"]]
                expected = (box @ matrix[:, :3].T + matrix[:, 3]) * self.METRES
                found = asset.triangles(nodes[name], frame / 25)
                self.assertEqual(found.shape, (12, 3, 3))
                apart = np.linalg.norm(found.reshape(-1, 1, 3) - expected, axis=2)
                self.assertLess(apart.min(axis=1).max(), 1e-6)
                self.assertLess(apart.min(axis=0).max(), 1e-6)
        colors = {tuple(np.round(one["pbrMetallicRoughness"]["baseColorFactor"], 2)) for one in asset.json["materials"]}
        self.assertEqual(len(colors), 3)
        light = asset.json["extensions"]["KHR_lights_punctual"]["lights"][0]
        self.assertEqual((light["type"], light["color"]), ("directional", [1, 1, 1]))
        self.assertAlmostEqual(light["intensity"], 0.8 * math.pi)
        along = asset.matrix(asset.nodes("extensions")["lamp"], 0)[:3, :3] @ [0, 0, -1]
        np.testing.assert_allclose(along, -np.array([1, 2, 4]) / math.sqrt(21), atol=1e-12)

    def test_a_scene_far_from_the_origin(self):
        """Keys are float32: the world's node brings them to whole kilometres, and export.json says what is rounded."""
        for up in ("y", "z"):
            path = datasets.far_away(datasets.stereo(self.path(up)), (1000001.25, 60.5, -8400001.75))
            scene = load_json(path)
            scene["upAxis"] = up
            for camera in scene["cameras"]:
                camera["up"] = [0, 1, 0]
            self.write(path, json.dumps(scene))
            dataset, folder, asset, record = self.exported(path)
            far = np.array(asset.json["nodes"][0]["translation"])
            self.assertEqual(far.tolist(), [500000, 0, -4200000] if up == "y" else [500000, -4200000, 0])
            turn = np.eye(3) if up == "y" else np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])
            poses = load_json(os.path.join(dataset, "poses.json"))["poses"]
            largest = 0
            for one in poses:
                name = next(n for n, i in asset.nodes("mesh").items() if asset.json["nodes"][i]["extras"]["id"] == one["id"])
                t = turn @ np.array(one["matrix"])[:, 3] * self.METRES
                largest = max(largest, np.abs(asset.matrix(asset.nodes("mesh")[name], one["frame"] / 25)[:3, 3] - t).max())
            for (name, frame), entry in datasets.cameras_of(dataset).items():
                t = turn @ -(entry["R"].T @ entry["t"]) * self.METRES
                largest = max(largest, np.abs(asset.matrix(asset.nodes("camera")[name], frame / 25)[:3, 3] - t).max())
            self.assertLess(largest, 2e-5)
            rows = {row["unit"]: row for row in record["layers"] if row["layer"] == "poses"}
            self.assertTrue(0 < rows["m"]["largest_rounding"] < 2e-5, rows)
            self.assertTrue(0 < rows["1"]["largest_rounding"] < 1e-7, rows)
            self.assertEqual(rows["m"]["values"], 3 * 3 * 3)  # of two cameras and a block
            again = asset.json["nodes"][0]["translation"]
            said = self.planted(dataset, folder, "scene.gltf", lambda data: data.replace(str(again[0]).encode(), str(again[0] + 0.01).encode(), 1))
            self.assertIn("layer", said)
        self.assertNotIn("translation", self.exported(datasets.stereo(self.path("near")))[2].json["nodes"][0])
        near = datasets.stereo(self.path("one"))
        scene = load_json(near)  # and one that is far off takes nothing from the others
        scene["objects"].append({**scene["objects"][0], "name": "far", "position": [2e7, 0, 0]})
        self.write(near, json.dumps(scene))
        self.assertNotIn("translation", self.exported(near)[2].json["nodes"][0])

    def test_dgtk_reads_it_back(self):
        """The exported scene, drawn by DGTk through the scene's cameras, has the dataset's depth."""
        scene = datasets.stereo(self.path("scene"), frames=1)
        dataset, folder, _, _ = self.exported(scene)
        again = load_json(scene)
        again["objects"] = [{"name": "all", "model": os.path.join(folder, "scene.gltf"), "scale": [1 / self.METRES] * 3}]
        path = self.path("scene", "again.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(again, file)
        other = self.render(path, "depth")
        for camera in ("left eye", "right.eye"):
            a, b = layer_of(dataset, "depth", camera, 0), layer_of(other, "depth", camera, 0)
            same = np.isfinite(a) & np.isfinite(b)
            self.assertGreater(np.count_nonzero(same), 0.99 * np.count_nonzero(np.isfinite(a)))
            apart = np.abs(a - b)[same]
            self.assertLess(np.quantile(apart, 0.995), 1e-5)

    def test_the_validator_of_khronos(self):
        """No error and no warning; and an error where the file is damaged."""
        _, folder, asset, _ = self.exported(datasets.stereo(self.path("scene")))
        report = by_node(self, ["gltf-validator"], VALIDATE, os.path.join(folder, "scene.gltf"))
        self.assertEqual((report["issues"]["numErrors"], report["issues"]["numWarnings"]), (0, 0), report["issues"]["messages"])
        self.assertEqual(report["info"]["animationCount"], 1)
        self.assertEqual(report["info"]["totalTriangleCount"],
                         sum(len(asset.accessor(one["indices"])) // 3 for mesh in asset.json["meshes"] for one in mesh["primitives"]))
        asset.json["nodes"][asset.nodes("mesh")["block"]]["rotation"] = [0, 0, 0, 0.5]
        with open(os.path.join(folder, "damaged.gltf"), "w", encoding="utf-8") as file:
            json.dump(asset.json, file)
        issues = by_node(self, ["gltf-validator"], VALIDATE, os.path.join(folder, "damaged.gltf"))["issues"]
        self.assertEqual([one["code"] for one in issues["messages"] if one["severity"] == 0], ["ROTATION_NON_UNIT"])

    def test_blender_has_the_same_scene(self):
        """Blender's importer turns y up into z up; corners of the objects, places and views of the cameras are the file's at every frame."""
        _, folder, asset, _ = self.exported(datasets.stereo(self.path("scene")))
        found = by_blender(self, BLENDER, os.path.join(folder, "scene.gltf"))
        turned = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
        for name, index in asset.nodes("mesh").items():
            self.assertEqual(found[name]["type"], "MESH")
            for frame in range(3):
                expected = asset.triangles(index, frame / 25).reshape(-1, 3) @ turned.T
                apart = np.linalg.norm(np.array(found[name]["corners"][frame])[:, None] - expected, axis=2)
                self.assertLess(max(apart.min(axis=1).max(), apart.min(axis=0).max()), 1e-5, name)
        for name, index in asset.nodes("camera").items():
            views = [one for one in found.values() if one["type"] == "CAMERA"]
            for frame in range(3):
                expected = asset.matrix(index, frame / 25)
                apart = [np.abs(np.array(one["matrices"][frame])[:3] - np.column_stack([turned @ expected[:3, :3], turned @ expected[:3, 3]])).max() for one in views]
                self.assertLess(min(apart), 1e-5, name)
            yfov = asset.json["cameras"][asset.json["nodes"][index]["camera"]]["perspective"]["yfov"]
            self.assertAlmostEqual(views[int(np.argmin(apart))]["angle"], yfov, places=5)

    def test_mirrored_hidden_and_z_up(self):
        def change(scene):
            scene["upAxis"] = "z"
            for camera in scene["cameras"]:
                camera["up"] = [0, 1, 0]
            scene["objects"][1]["scale"] = [-1, 1.2, 1]
            scene["objects"][0]["visible"] = {"keys": [[0, True], [1, False], [2, True]]}

        _, _, asset, _ = self.exported(self.changed("mirrored", change))
        ring, wall, block = (asset.nodes("mesh")[name] for name in ("röter Ring.v2", "back wall", "block"))
        self.assertTrue(asset.json["nodes"][ring]["extras"]["mirrored"])
        self.assertEqual(np.sign(volume(asset.triangles(ring, 0))), np.sign(volume(asset.triangles(block, 0))) * self.ring_side())
        self.assertEqual(asset.json["nodes"][wall]["extras"]["visible_frames"], [[0, 0], [2, 2]])
        np.testing.assert_allclose(asset.matrix(0, 0)[:3, :3] @ [0, 0, 1], [0, 1, 0], atol=1e-12)

    def ring_side(self):
        """Whether the ring's own triangles are turned as the block's, by a pair without mirrors."""
        asset = self.exported(datasets.stereo(self.path("plain")))[2]
        ring, block = (asset.triangles(asset.nodes("mesh")[name], 0) for name in ("röter Ring.v2", "block"))
        return np.sign(volume(ring)) * np.sign(volume(block))

    def test_pictures(self):
        dataset = self.path("textured")
        self.dgtk("render", os.path.join(SOURCE, "Data", "Scenes", "dataset_stereo.json"), "-o", dataset, "--layers", "depth", "--models",
                  "--size", "64x48", "--quiet")
        folder, _ = self.export(dataset, "gltf", "--unit-metres", 1)
        asset = Asset(folder)
        self.assertGreater(len(asset.json["images"]), 1)
        for image in asset.json["images"]:
            with open(os.path.join(folder, image["uri"]), "rb") as file, \
                    open(os.path.join(dataset, "models", os.path.basename(image["uri"])), "rb") as other:
                self.assertEqual(file.read(), other.read())
        used = {one["pbrMetallicRoughness"].get("baseColorTexture", {}).get("index") for one in asset.json["materials"]}
        self.assertLessEqual(set(range(len(asset.json["textures"]))), used)

    def test_lights(self):
        """Intensities at a metre, and what the record says of lights that the format has not, or not quite."""
        def light(name, kind, **more):
            return {"name": name, "kind": kind, "position": [0, 2, 4], **({"target": [0, 0, 0]} if kind in ("spot", "directional") else {}), **more}

        square, two = {"attenuation": [0, 0, 1]}, {"keys": [[0, [0, 2, 4]], [1, [0, 2, 5]]]}
        lights = [light("sun", "directional", diffuse=[0.5, 0.4, 0.3], intensity=2),
                  light("lamp", "point", **square), light("dull", "point", attenuation=[1, 0.5, 0.25]), light("linear", "point", attenuation=[0, 0.5, 1]),
                  light("cone", "spot", coneAngle=25, exponent=0, **square), light("soft", "spot", coneAngle=90, exponent=3, **square),
                  light("one key", "point", **{**square, "position": {"keys": [[1, [0, 2, 4]]]}}),
                  light("walker", "point", **{**square, "position": two}), light("off", "point", enabled=False), light("mine", "head"),
                  light("blinker", "point", enabled={"keys": [[0, True], [1, False]]}, **square)]
        _, _, asset, record = self.exported(self.changed("lights", lambda scene: scene.update(lights=lights)))
        found = {one["name"]: one for one in asset.json["extensions"]["KHR_lights_punctual"]["lights"]}
        self.assertEqual(list(found), [one["name"] for one in lights if one["name"] not in ("off", "mine")])
        intensities = {"sun": 1, "lamp": 1 / 4, "dull": 1 / 3, "linear": 1 / 5, "cone": 1 / 4, "soft": 1 / 4, "one key": 1 / 4, "walker": 1 / 4, "blinker": 1 / 4}
        for name, share in intensities.items():
            self.assertAlmostEqual(found[name]["intensity"], share * math.pi, msg=name)
            self.assertEqual(found[name]["type"], "directional" if name == "sun" else "spot" if name in ("cone", "soft") else "point")
            self.assertEqual(found[name]["color"], [1, 0.8, 0.6] if name == "sun" else [1, 1, 1])
            self.assertEqual("spot" in found[name], name in ("cone", "soft"))
        self.assertEqual(found["cone"]["spot"]["innerConeAngle"], 0)
        self.assertAlmostEqual(found["cone"]["spot"]["outerConeAngle"], math.radians(25))
        self.assertAlmostEqual(found["soft"]["spot"]["outerConeAngle"], math.pi / 2)
        self.assertEqual((record["conventions"]["approximate_lights"], record["conventions"]["lights_left_out"]),
                         ("dull, linear, soft, walker, blinker", "off, mine"))
        exact = self.exported(self.changed("exact", lambda scene: scene.update(lights=lights[:2])))[3]
        for key in ("approximate_lights", "lights_left_out", "textures_left_out"):
            self.assertNotIn(key, exact["conventions"])

    def test_refusals(self):
        target = self.path("none")

        def sheared(scene):
            scene["objects"][0].update(scale=[1, 2, 1], orientation=[0.92388, 0, 0, 0.382683])
            scene["objects"][2].update(parent="back wall", orientation=[0.92388, 0, 0, 0.382683])

        for says, scene in ((("block", "sheared"), self.changed("sheared", sheared)), ("radial", datasets.lenses(self.path("lenses")))):
            dataset = self.render(scene, "depth", "--models")
            options = ("--cameras", "radial") if says == "radial" else ()
            self.refused("export", dataset, "--format", "gltf", "-o", target, *options, status=2, says=says)
        dataset = self.render(datasets.walk(self.path("walk")), "depth")
        self.refused("export", dataset, "--format", "gltf", "-o", target, status=2, says=("with models", "back wall"))
        dataset = self.render(self.changed("timeless", lambda scene: None), "depth", "--models")
        path = os.path.join(dataset, "manifest.json")
        whole = load_json(path)
        for key, says in (("fps", "how many frames a second"), ("metres_per_unit", "how long its unit is")):
            os.remove(path)
            with open(path, "w", encoding="utf-8") as file:
                json.dump({name: value for name, value in whole.items() if name != key}, file)
            self.refused("export", dataset, "--format", "gltf", "-o", target, status=2, says=says)
        self.assertFalse(os.path.exists(target))

    def test_the_referee_finds(self):
        dataset, folder, asset, _ = self.exported(datasets.stereo(self.path("scene")))

        def document(change):
            def changed(data):
                whole = json.loads(data)
                change(whole)
                return json.dumps(whole).encode()
            return self.planted(dataset, folder, "scene.gltf", changed)

        cameras, objects = asset.nodes("camera"), asset.nodes("mesh")
        self.assertIn("layer field of view", document(lambda one: one["cameras"][0]["perspective"].update(yfov=0.8)))
        self.assertIn("layer intrinsics", document(lambda one: one["cameras"][1]["extras"]["K"][0].__setitem__(2, 47.5)))
        self.assertIn("layer vertices", document(lambda one: one["nodes"][objects["röter Ring.v2"]].update(rotation=[0, 0, 0, 1])))
        self.assertIn("layer asset", document(lambda one: one["nodes"][objects["block"]]["extras"].update(visible_frames=[[0, 1]])))
        self.assertIn("layer colors", document(lambda one: one["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"].__setitem__(0, 0.5)))
        self.assertIn("layer lights", document(lambda one: one["nodes"][asset.nodes("extensions")["lamp"]].update(rotation=[0, 0, 0, 1])))
        channel = next(one for one in asset.json["animations"][0]["channels"] if one["target"]["node"] == cameras["left eye"])
        sampler = asset.json["animations"][0]["samplers"][channel["sampler"]]
        for key, says in (("input", "layer time"), ("output", "layer pose")):
            at = asset.json["bufferViews"][asset.json["accessors"][sampler[key]]["bufferView"]]["byteOffset"]
            change = lambda data, at=at: data[:at + 4] + struct.pack("<f", 0.05) + data[at + 8:]  # noqa: E731
            self.assertIn(says, self.planted(dataset, folder, "scene.bin", change))
        for change in ({"byteLength": 10**9}, {"byteLength": 10}, {"byteLength": 0}, {"byteStride": 16}, {"byteOffset": 10**9}):
            self.assertIn("accessor", document(lambda one, change=change: one["bufferViews"][0].update(change)), msg=change)
        for change in ({"type": "MAT4"}, {"componentType": 5123}, {"count": 1}, {"count": 0}, {"byteOffset": 10**9}):
            self.assertIn("accessor", document(lambda one, change=change: one["accessors"][0].update(change)), msg=change)


if __name__ == "__main__":
    main()
