# SPDX-License-Identifier: BSD-3-Clause
"""Sample models of every format render: something is seen, and raster and ray agree on the object but at edges."""
import json
import os
import time

from harness import EXTRA, SOURCE, WHOLE, Case, main

MODEL_FORMATS = ("ac", "acc", "md2", "3ds", "pov", "obj", "gltf", "glb", "ply", "stl")


def sample_models():
    for base in (os.path.join(SOURCE, "Data", "Models"), EXTRA):
        for root, _, names in os.walk(base):
            for name in sorted(names):
                if name.rsplit(".", 1)[-1].lower() in MODEL_FORMATS:
                    yield os.path.join(root, name)


def some_of(models):
    """Of each format six, from the smallest to the largest."""
    kinds = {}
    for model in sorted(models, key=os.path.getsize):
        kinds.setdefault(model.rsplit(".", 1)[-1].lower(), []).append(model)
    return sorted({group[i * (len(group) - 1) // 5] for group in kinds.values() for i in range(6)})


class Models(Case):
    def framed(self, model, info):
        """A scene that shows the whole model from a corner."""
        low, high = info["bounds"]
        centre = [(a + b) / 2 for a, b in zip(low, high)]
        size = max(max(b - a for a, b in zip(low, high)), 1e-6)
        z_up = info["format"] in ("md2", "3ds")
        offset = [1.1, -1.3, 0.9] if z_up else [1.1, 0.9, 1.3]
        return {"objects": [{"name": "model", "model": model}],
                "background": [0.2, 0.25, 0.3],
                "cameras": [{"name": "view", "fovY": 40, "near": 0.01 * size, "far": 100 * size,
                             "eye": [c + size * o for c, o in zip(centre, offset)], "lookAt": centre,
                             "up": [0, 0, 1] if z_up else [0, 1, 0]}]}

    def test_models_are_kept(self):
        """By contents, for the user alone, unless that is not wanted; and nothing depends on what is kept."""
        model = os.path.join(self.folder, "tiles.ply")
        with open(model, "w", encoding="ascii") as file:
            file.write("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                       "element face 50000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0.5\n"
                       + "3 0 1 2\n" * 50000)
        time.sleep(0.1)
        caches = os.path.join(self.folder, "caches")
        kept = os.path.join(caches, "dgtk")
        environment = {"XDG_CACHE_HOME": caches, "DGTK_CACHE": "", "HOME": self.folder}
        plain = self.dgtk("info", model, "--json", "--no-cache", environment=environment).stdout
        self.assertEqual(self.dgtk("info", model, "--json", environment=dict(environment, DGTK_CACHE="0")).stdout, plain)
        self.assertFalse(os.path.exists(caches))
        self.assertEqual(self.dgtk("info", model, "--json", environment=environment).stdout, plain)
        [entry] = os.listdir(kept)
        self.assertEqual(os.stat(kept).st_mode & 0o777, 0o700)
        self.assertEqual(self.dgtk("info", model, "--json", environment=environment).stdout, plain)
        with open(os.path.join(kept, entry), "r+b") as file:
            file.seek(1000)
            file.write(b"damage")
        self.assertEqual(self.dgtk("info", model, "--json", environment=environment).stdout, plain)
        self.assertEqual(os.listdir(kept), [entry])
        os.chmod(kept, 0)
        self.assertEqual(self.dgtk("info", model, "--json", environment=environment).stdout, plain)
        os.chmod(kept, 0o700)
        self.assertEqual(self.dgtk("info", model, status=2, environment=dict(environment, DGTK_CACHE="much")).stderr,
                         "dgtk: DGTK_CACHE is not a number of MiB: 'much'\n")

    def test_every_model_renders(self):
        """Each in a scene of its own, all scenes by one process an engine."""
        import numpy

        os.mkdir(self.path("scenes"))
        models = {}
        filled = [model for model in sample_models() if os.path.getsize(model) > 0]
        for model in filled if WHOLE else some_of(filled):
            info = json.loads(self.dgtk("info", model, "--json").stdout)
            if info["triangles"] > 0:
                name = f"{len(models):03}"
                models[name] = model
                self.write(f"scenes/{name}.json", json.dumps(self.framed(model, info)))
        self.assertGreater(len(models), 5)
        for engine, layers in (("raster", "color,depth,objects"), ("ray", "depth,objects")):
            self.dgtk("render", self.path("scenes"), "-o", self.path(engine), "--quiet", "--size", "200x200", "--visibility", engine,
                      "--layers", layers, "--objects-format", "npy")
        for name, model in models.items():
            with self.subTest(model):
                raster, ray = (numpy.load(self.path(engine, name, "view", "objects", "000000.npy")) for engine in ("raster", "ray"))
                self.assertGreater((ray > 0).sum(), 40, "hardly anything is seen")
                self.assertLess((raster != ray).sum(), 60)


if __name__ == "__main__":
    main()
