# SPDX-License-Identifier: BSD-3-Clause
"""Datasets that Python reads back: every layer in every format is what is rendered."""
import json
import multiprocessing
import os
import pickle
import threading

import numpy
from harness import Case, main
from python_package import DEMO, dgtk

SIZE = (40, 30)
OPTIONS = {"matte": "house", "samples": 2}
UNREAD = {"ldi": "deep OpenEXR", "depth": "a picture of them", "depth_noisy": "a picture of them"}


def formats_of_layers():
    """Every layer's formats, as the options have them; of the others there is one."""
    rows = (line.split("\t") for line in dgtk.dgtkRenderer.GetOptions().splitlines())
    return {name[:-len("_format")]: text.split("of the layer, of ")[1].split(",") for name, value, _, text in rows if name.endswith("_format")}


def same(found, expected):
    """What was read, against what was rendered; a file may hold fewer digits."""
    if isinstance(expected, dict):
        return set(found) == set(expected) and all(same(found[key], expected[key]) for key in expected)
    if isinstance(expected, list):
        return len(found) == len(expected) and all(map(same, found, expected))
    if not isinstance(expected, numpy.ndarray):
        return found == expected
    floats = found.dtype.kind == "f"
    return found.shape == expected.shape and found.dtype.kind == expected.dtype.kind and numpy.array_equal(found, expected.astype(found.dtype), equal_nan=floats)


class Datasets(Case):
    """dgtk.dataset()"""

    def generated(self, name="out", **more):
        return dgtk.generate(DEMO, self.path(name), size=SIZE, frames=(0, 1), **{"layers": ["depth", "objects", "flow_forward"], **more})

    def test_every_layer_in_every_format_is_what_is_rendered(self):
        scene, keep = dgtk.load(DEMO), dgtk.dgtkRenderer()
        formats = formats_of_layers()
        self.assertGreater(len(formats), 20)
        refused, seen = set(), set()
        for turn in range(max(map(len, formats.values()))):
            chosen = {f"{layer}_format": names[turn] for layer, names in formats.items() if turn < len(names)}
            layers = "all" if turn == 0 else [name[:-len("_format")] for name in chosen if name != "color_sharp_format"]
            folder = f"turn{turn}"
            manifest = self.generated(folder, layers=layers, **chosen, **OPTIONS)
            data = dgtk.dataset(self.path(folder))
            empty = {one["layer"] for one in manifest["empty"] if one["pictures"] == one["of"]}
            written = {record["name"] for record in manifest["layers"]} - empty
            self.assertLessEqual({name for name in written if name in data.layers or name in formats}, set(data.layers))
            self.assertTrue(all(outputs for outputs in data.layers.values()))
            for layer in data.layers:
                for camera, frame in data.pictures:
                    self.check(data, layer, camera, frame, scene, keep, chosen, refused, seen)
        self.assertEqual({layer for layer, _ in refused}, set(UNREAD))
        self.assertEqual({layer for layer, _ in seen}, set(dgtk.dataset(self.path("turn0")).layers))
        for layer, names in formats.items():
            for name in names:
                self.assertTrue(layer == "color_sharp" or (layer, name) in seen | refused, (layer, name))

    def check(self, data, layer, camera, frame, scene, keep, chosen, refused, seen):
        name = chosen.get(f"{layer}_format", "")
        try:
            expected = dgtk.render(scene, layer, camera=camera, frame=frame, size=SIZE, keep=keep, **chosen, **OPTIONS)
        except ValueError as error:
            if "it needs" in str(error):  # what this picture lacks
                with self.assertRaisesRegex(ValueError, f"there is no layer '{layer}' of camera '{camera}' at frame {frame} .expected some of "):
                    data.read(layer, camera, frame)
                return
            expected = None  # files only
        try:
            found = data.read(layer, camera, frame)
        except ValueError as error:
            self.assertIn(UNREAD.get(layer, "?"), str(error))
            refused.add((layer, name))
            return
        seen.add((layer, name))
        if expected is None:
            self.assertIn((layer, found.shape[1:], found.dtype), (("tracks", (3,), numpy.float64), ("tiles", (40, 3), numpy.uint8)))
            return
        self.assertTrue(same(found, expected), (layer, name, camera, frame))
        for output in found if isinstance(found, dict) and set(found) == set(data.layers[layer]) else ():
            self.assertTrue(same(data.read(output, camera, frame), found if output == layer else found[output]), output)

    def test_what_a_dataset_says(self):
        manifest = self.generated()
        data = dgtk.dataset(self.path("out"))
        self.assertEqual(data.pictures, [("left", 0), ("left", 1), ("right", 0), ("right", 1)])
        self.assertEqual((data.cameras, data.frames), (["left", "right"], [0, 1]))
        self.assertEqual(data.layers, {"depth": ["depth"], "objects": ["objects"], "flow_forward": ["flow_forward", "flow_forward_class"]})
        self.assertEqual(data.manifest, manifest)
        self.assertEqual([one["name"] for one in data.objects], dgtk.load(DEMO).objects)
        self.assertEqual(data.folder, self.path("out"))
        both = data.read(["objects", "flow_forward_class"], "right", 0)
        self.assertEqual({name: (values.shape, values.dtype) for name, values in both.items()},
                         {"objects": ((30, 40), numpy.uint32), "flow_forward_class": ((30, 40), numpy.uint8)})

        # A pixel's point of the world lies where depth and camera say, and on the pose's object.
        camera, depth, ids = data.camera("right", 1), data.read("depth", "right", 1), data.read("objects", "right", 1)
        position = dgtk.render(dgtk.load(DEMO), "position", camera="right", frame=1, size=SIZE)
        y, x = numpy.argwhere(ids == 2)[0]
        ray = numpy.linalg.solve(camera["K"], [x + 0.5, y + 0.5, 1])
        numpy.testing.assert_allclose(camera["R"].T @ (ray * depth[y, x] - camera["t"]), position[y, x], rtol=0, atol=1e-12)
        pose = next(one for one in data.poses(1) if one["id"] == 2)
        self.assertEqual((pose["matrix"].shape, len(data.poses())), ((3, 4), len(data.objects)))
        self.assertEqual(data.camera()["name"], "left")
        self.assertEqual(os.fspath(data), data.folder)
        with self.assertRaisesRegex(ValueError, "gltf: the dataset has no model of object"):
            dgtk.export(data, "gltf", self.path("model"))  # it stands for its folder

    def test_threads_and_processes_share_it(self):
        self.generated()
        data = dgtk.dataset(self.path("out"))
        expected = {picture: data.read("depth", *picture) for picture in data.pictures}
        wrong = []

        def reads():
            for picture in data.pictures * 5:
                if not numpy.array_equal(data.read("depth", *picture), expected[picture]):
                    wrong.append(picture)
        threads = [threading.Thread(target=reads) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])
        again = pickle.loads(pickle.dumps(data))
        self.assertEqual((again.folder, again.pictures), (data.folder, data.pictures))
        for way in ("fork", "spawn"):
            with multiprocessing.get_context(way).Pool(1) as pool:
                numpy.testing.assert_array_equal(pool.apply(dgtk.Dataset.read, (data, "depth", "left", 1)), expected[("left", 1)])

    def test_refusals(self):
        self.generated()
        data = dgtk.dataset(self.path("out"))
        for wrong, says in ((lambda: dgtk.dataset(self.path("none")), "none: is not a dataset"),
                            (lambda: dgtk.dataset(7), "folder: expected a path, found 7"),
                            (lambda: data.read("depht"), "there is no layer 'depht' of camera 'left' at frame 0 .expected some of depth, objects, flow_forward."),
                            (lambda: data.read("depth", "middle"), "the dataset has no camera 'middle' .it has left,right."),
                            (lambda: data.read("depth", "left", 7), "the dataset has no picture of camera 'left' at frame 7"),
                            (lambda: data.camera("left", 7), "the dataset has no picture of camera 'left' at frame 7"),
                            (lambda: data.poses(7), "the dataset has no picture at frame 7"),
                            (lambda: data.read("depth", frame="x"), "frame: expected an integer, found 'x'"),
                            (lambda: data.read([]), "layers: expected a name or a list of names")):
            with self.assertRaisesRegex(ValueError, says):
                wrong()
        self.generated("cut", layers="tiles", tile="20x30")
        with self.assertRaisesRegex(ValueError, "layer tiles as png: several files hold one picture"):
            dgtk.dataset(self.path("cut")).read("tiles")
        depth = self.path("out", "left", "depth", "000000.npy")
        with open(depth, "r+b") as file:
            file.truncate(1000)
        with self.assertRaisesRegex(ValueError, "left/depth/000000.npy: is not the file that the manifest lists: its size differs"):
            data.read("depth", "left", 0)
        os.remove(depth)
        os.symlink(self.path("out", "left", "depth", "000001.npy"), depth)
        with self.assertRaisesRegex(ValueError, "left/depth/000000.npy"):
            data.read("depth", "left", 0)
        depth = self.path("out", "left", "depth", "000001.npy")
        numpy.save(depth, numpy.load(depth).reshape(60, 20))
        with self.assertRaisesRegex(ValueError, "has another size than the picture .expected 40 x 30, found 20 x 60."):
            data.read("depth", "left", 1)
        os.rename(self.path("out", "manifest.json"), self.path("out", "manifest.json.gone"))
        with self.assertRaisesRegex(ValueError, "is not a dataset"):
            dgtk.dataset(self.path("out"))

    def test_no_poses_of_earlier_versions(self):
        self.generated()
        os.remove(self.path("out", "poses.json"))
        self.assertEqual(dgtk.dataset(self.path("out")).poses(), [])
        self.write("out/poses.json", json.dumps({"poses": 3})[:-2])
        with self.assertRaisesRegex(ValueError, "poses.json: cannot be read"):
            dgtk.dataset(self.path("out")).poses()


if __name__ == "__main__":
    main()
