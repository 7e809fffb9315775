# SPDX-License-Identifier: BSD-3-Clause
"""Textures lie where strangers' models place them, and go on beyond their border as these say: coordinates and holes against closed
forms, pixel by pixel; and all of it is there again in the dataset's own models and in their glTF."""
import base64
import itertools
import json
import os
import shutil
import struct

import numpy as np

from dataset_edits import Edits
from datasets import ExportCase, main
from pictures import write_png
from test_metadata import read_ply

WIDTH, HEIGHT = 240, 160
MODES = {"repeat": 10497, "clamp": 33071, "mirror": 33648}
STEP = 1.9 / HEIGHT  # of pixels, on the square
K = [[3 / STEP, 0, WIDTH / 2], [0, 3 / STEP, HEIGHT / 2], [0, 0, 1]]
CORNERS = [(-1, -1), (1, -1), (1, 1), (-1, 1)]


def wrapped(texel, size, mode):
    """OpenGL's wrap modes (OpenGL 4.6, table 8.20)."""
    if mode == "clamp":
        return np.clip(texel, 0, size - 1)
    around = texel % size
    return np.where((texel // size) % 2 == 1, size - 1 - around, around) if mode == "mirror" else around


class TexturePlaces(ExportCase):
    def setUp(self):
        super().setUp()
        self.texels = np.random.default_rng(5).integers(0, 256, (5, 3, 4), dtype=np.uint8)
        self.texels[..., 3] = np.where(np.random.default_rng(6).random((5, 3)) < 0.4, 0, 255)
        write_png(self.path("t.png"), self.texels)

    def gltf(self, name, modes, transform, inside):
        """A square of side 2; coordinates of its corners, v down, are those of CORNERS."""
        positions = struct.pack("<12f", *(x for u, v in CORNERS for x in (u, -v, 0)))
        uvs = struct.pack("<8f", *(x for corner in CORNERS for x in corner))
        indices = struct.pack("<6H", 0, 2, 1, 0, 3, 2)
        with open(self.path("t.png"), "rb") as file:
            png = file.read()
        buffer = positions + uvs + indices
        info = {"index": 0, **({"extensions": {"KHR_texture_transform": transform}} if transform else {})}
        views = [(0, 48), (48, 32), (80, 12)]
        document = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
            "materials": [{"alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorTexture": info, "metallicFactor": 0}}],
            "textures": [{"source": 0, "sampler": 0}], "samplers": [{"wrapS": MODES[modes[0]], "wrapT": MODES[modes[1]]}],
            "images": [{"uri": "data:image/png;base64," + base64.b64encode(png).decode() if inside else "t.png"}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
                          {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
                          {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": length} for at, length in views],
            "buffers": [{"byteLength": len(buffer), "uri": "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()}]}
        return self.write(name + ".gltf", json.dumps(document))

    def obj(self, name, options):
        self.write(name + ".mtl", f"newmtl m\nKd 1 1 1\nmap_Kd {options} t.png\n")
        corners = "".join(f"v {u} {-v} 0\nvt {u} {v}\n" for u, v in CORNERS)
        return self.write(name + ".obj", f"mtllib {name}.mtl\n{corners}usemtl m\nf 1/1 4/4 3/3 2/2\n")

    def drawn(self, name, model, layers="uv,objects,points", *options):
        camera = {"name": "c", "width": WIDTH, "height": HEIGHT, "K": K, "eye": [0, 0, 3],
                  "lookAt": [0, 0, 0], "near": 0.1, "far": 10}
        self.write(name + ".json", json.dumps({"version": 1, "units": "m", "objects": [{"name": "o", "model": model}], "cameras": [camera]}))
        self.dgtk("render", self.path(name + ".json"), "-o", self.path(name), "--layers", layers, "--objects-format", "npy", "--quiet", *options)
        self.dgtk("verify", self.path(name))
        return [np.load(self.path(name, "c", layer, "000000.npy")) for layer in ("uv", "objects")]

    def expected(self, place, modes, down):
        """Coordinates (v up) and whether a texel is there, at all pixels. `place`: of coordinates that are written."""
        x, y = np.meshgrid((np.arange(WIDTH) + 0.5 - WIDTH / 2) * STEP, (np.arange(HEIGHT) + 0.5 - HEIGHT / 2) * STEP)
        u, v = place(x, y)
        v = 1 - v if down else v
        column = wrapped(np.floor(u * 3).astype(int), 3, modes[0])
        row = 4 - wrapped(np.floor(v * 5).astype(int), 5, modes[1])
        edge = np.minimum(abs(u * 3 - np.round(u * 3)), abs(v * 5 - np.round(v * 5))) < 1e-5
        inside = (abs(x) < 1) & (abs(y) < 1)
        return np.stack([u, v], -1), inside & (self.texels[row, column, 3] > 0), edge

    def compare(self, found, place, modes, down=True):
        uv, there, edge = self.expected(place, modes, down)
        self.assertTrue((((found[1] > 0) == there) | edge).all())
        self.assertLess(edge.mean(), 0.05)
        np.testing.assert_allclose(found[0][found[1] > 0], uv[found[1] > 0], atol=2e-6)

    def test_gltf(self):
        transforms = [{}, {"offset": [0.3, -1.4]}, {"scale": [2, -0.7]}, {"rotation": 0.6}, {"offset": [-0.2, 0.9], "rotation": -2.1, "scale": [1.6, 0.8]}]
        for number, (modes, transform) in enumerate(zip(itertools.product(MODES, MODES), 2 * transforms)):
            with self.subTest(modes=modes, transform=transform):
                s, o, angle = transform.get("scale", (1, 1)), transform.get("offset", (0, 0)), transform.get("rotation", 0)
                cosine, sine = np.cos(angle), np.sin(angle)

                def place(x, y):
                    return (cosine * s[0] * x + sine * s[1] * y + o[0], -sine * s[0] * x + cosine * s[1] * y + o[1])
                model = self.gltf(f"m{number}", modes, transform, number % 2 == 0)
                self.compare(self.drawn(f"d{number}", model), place, modes)

    def test_obj(self):
        for number, (options, place, mode) in enumerate((
                ("", lambda x, y: (x, y), "repeat"), ("-clamp on", lambda x, y: (x, y), "clamp"),
                ("-s 2 -1.5 -clamp on", lambda x, y: (2 * x, -1.5 * y), "clamp"),
                ("-o 0.25 -0.5 1 -s 0.5 3 1", lambda x, y: (0.5 * x + 0.25, 3 * y - 0.5), "repeat"))):
            with self.subTest(options=options):
                self.compare(self.drawn(f"d{number}", self.obj(f"m{number}", options)), place, (mode, mode), down=False)

    def test_models_of_datasets_and_their_gltf(self):
        """Pictures that a model's file holds are files beside the dataset's models, too."""
        for number, modes in enumerate((("clamp", "mirror"), ("repeat", "repeat"), ("mirror", "repeat"))):
            for inside in (True, False):
                with self.subTest(modes=modes, inside=inside):
                    name = f"d{number}{inside}"
                    found = self.drawn(name, self.gltf(f"m{number}{inside}", modes, {"rotation": 0.5}, inside), "uv,objects,points", "--models")
                    plys = [file for file in os.listdir(self.path(name, "models")) if file.endswith(".ply")]
                    comments = read_ply(self.path(name, "models", plys[0]))[0]
                    self.assertEqual(comments, [f"TextureFile {plys[0][:-4]}_0.png"] +
                                     ([] if modes == ("repeat", "repeat") else ["TextureWrap " + " ".join(modes)]))
                    export, _ = self.export(self.path(name), "gltf")
                    ply = self.drawn(name + "-p", self.path(name, "models", plys[0]))
                    np.testing.assert_array_equal(ply[1] > 0, found[1] > 0)
                    np.testing.assert_allclose(ply[0], found[0], atol=1e-6)
                    with open(os.path.join(export, "scene.gltf"), encoding="utf-8") as file:
                        document = json.load(file)
                    samplers = [{"wrapS": MODES[modes[0]], "wrapT": MODES[modes[1]]}]
                    self.assertEqual(document.get("samplers", []), [] if modes == ("repeat", "repeat") else samplers)
                    self.assertEqual(len(document["textures"]), 1)

    def test_the_referee_reads_them(self):
        model = self.gltf("m", ("clamp", "mirror"), {}, True)
        self.drawn("d", model, "uv,objects,points", "--models")
        ply = next("models/" + file for file in os.listdir(self.path("d", "models")) if file.endswith(".ply"))
        png = ply[:-4] + "_0.png"

        def edited(name, change, says):
            shutil.copytree(self.path("d"), self.path("p"))
            edits = Edits(self.path("p"))
            change(edits, name)
            edits.accept()
            self.assertIn(says, self.dgtk("verify", self.path("p"), status=1).stderr)
            shutil.rmtree(self.path("p"))

        edited(ply, lambda edits, name: edits.bytes(name, lambda data: data.replace(b"clamp mirror", b"clamp repeat")), "wrapped 'clamp repeat'")
        edited(ply, lambda edits, name: edits.bytes(name, lambda data: data.replace(b"comment TextureWrap clamp mirror\n", b"")), "wrapped ''")
        edited(png, lambda edits, name: edits.change(name, (1, 1), lambda value: value ^ 1), "picture '" + os.path.basename(png))
        export, _ = self.export(self.path("d"), "gltf")
        for old, new in ((b'"wrapT": 33648', b'"wrapT": 10497'), (b'"wrapS": 33071', b'"wrapS": 33648')):
            self.assertIn("textures", self.planted(self.path("d"), export, "scene.gltf", lambda data, old=old, new=new: data.replace(old, new)))


if __name__ == "__main__":
    main()
