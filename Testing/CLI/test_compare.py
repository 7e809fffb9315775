# SPDX-License-Identifier: BSD-3-Clause
"""`dgtk compare` with tolerances: at the limit two datasets pass, just beyond it the layer is named."""
import json
import os
import shutil
import struct
import zlib

import numpy
from harness import SCENES, Case, main
from pictures import read_png, write_png

WIDTH, HEIGHT = 40, 25  # 1000 pixels: a share of 0.01 is 10 of them


class Tolerances(Case):
    def setUp(self):
        super().setUp()
        self.one, self.other = self.path("one"), self.path("other")
        self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", self.one, "--quiet", "--layers", "color,depth,objects",
                  "--objects-format", "npy", "--size", f"{WIDTH}x{HEIGHT}", "--frames", "0", "--cameras", "left")
        shutil.copytree(self.one, self.other)

    def change(self, layer, pixels, by):
        """Adds `by` to the first `pixels` pixels of a layer of the other dataset."""
        path = os.path.join(self.other, "left", layer, "000000.png" if layer == "color" else "000000.npy")
        values = read_png(path) if layer == "color" else numpy.load(path)
        flat = values.reshape(WIDTH * HEIGHT, -1)
        flat[:] = numpy.where(flat < 128, flat, 100) if layer == "color" else flat
        flat[:pixels] += by
        if layer == "color":
            write_png(path, values)
            clean = values.copy()
            clean.reshape(WIDTH * HEIGHT, -1)[:pixels] -= by
            write_png(os.path.join(self.one, "left", "color", "000000.png"), clean)
        else:
            numpy.save(path, values)

    def compare(self, *tolerances, status=0, json_too=False):
        words = [word for tolerance in tolerances for word in ("--tolerance", tolerance)]
        return self.dgtk("compare", self.one, self.other, *words, *(["--json"] if json_too else []), status=status).stdout

    def test_value_and_share_of_colour(self):
        self.change("color", 10, 3)
        self.assertIn("left/color/000000.png: 10 of 1000 pixels differ", self.compare(status=1))
        self.compare("color:value=3")
        self.assertIn("within the tolerance of color (10 by more than 2.9, at most 0.01 of all)", self.compare("color:value=2.9,share=0.01"))
        self.assertIn("left/color/000000.png: 10 of 1000 pixels differ, the first at (0, 0); largest difference 3 at (0, 0); beyond "
                      "the tolerance of color (10 by more than 2, at most 0.0099 of all)", self.compare("color:value=2,share=0.0099", status=1))
        self.compare("color:value=2,pixels=10")
        self.compare("color:value=2,pixels=9", status=1)
        self.compare("color:value=2,pixels=9,share=0.5", status=1)
        self.compare("color:value=2,pixels=500,share=0.009", status=1)
        self.compare("color:pixels=10,share=0.01")
        self.compare("color:share=0.0099", status=1)

    def test_other_layers_stay_exact(self):
        self.change("color", 10, 3)
        self.change("depth", 1, 1e-9)
        said = self.compare("color:value=3", status=1)
        self.assertIn("left/depth/000000.npy: 1 of 1000 pixels differ", said)
        self.assertIn("2 differ, 1 of these within tolerances", said)
        self.compare("color:value=3", "depth:value=2e-9")
        self.compare("color:value=3", "depth:value=2e-10", status=1)

    def test_a_lost_surface_is_beyond_every_value(self):
        values = numpy.load(os.path.join(self.one, "left/depth/000000.npy"))
        self.assertTrue(numpy.isfinite(values).any())
        values[:] = numpy.inf
        numpy.save(os.path.join(self.other, "left/depth/000000.npy"), values)
        self.compare("depth:value=1e300", status=1)
        self.compare("depth:share=1")

    def test_ids_have_a_share(self):
        self.change("objects", 10, 1)
        self.compare("objects:share=0.01")
        self.compare("objects:share=0.009", status=1)
        self.refused("compare", self.one, self.other, "--tolerance", "objects:value=1", status=2, says="values are names")

    def test_names_beside_numbers_have_a_share(self):
        made = self.path("made")
        self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", made, "--quiet", "--layers", "coverage,tracks", "--size", "8x6",
                  "--frames", "0:1", "--cameras", "left")
        for layer in ("coverage", "tracks"):
            self.dgtk("compare", made, made, "--tolerance", f"{layer}:share=0.01")
            self.refused("compare", made, made, "--tolerance", f"{layer}:value=0.1", status=2, says="its values are names, or some of them")
        self.refused("compare", made, made, "--tolerance", "tracks:share=1,share=.5", status=2, says="--tolerance: share twice in ")

    def test_json(self):
        self.change("color", 10, 3)
        document = json.loads(self.compare("color:value=3", json_too=True))
        self.assertTrue(document["equal"])
        row = document["differing"][0]
        self.assertEqual((row["layer"], row["equal"], row["differing"], row["beyond"], row["largest"]), ("color", True, 10, 0, 3.0))
        self.assertFalse(json.loads(self.compare("color:value=2", json_too=True, status=1))["equal"])

    def test_two_files(self):
        self.change("depth", 10, 1)
        files = [os.path.join(folder, "left", "depth", "000000.npy") for folder in (self.one, self.other)]
        self.dgtk("compare", *files, status=1)
        self.assertIn("within the tolerance (0 by more than 1, at most 0)", self.dgtk("compare", *files, "--tolerance", "value=1").stdout)
        self.assertIn("beyond the tolerance (", self.dgtk("compare", *files, "--tolerance", "pixels=1", status=1).stdout)
        self.refused("compare", *files, "--tolerance", "depth:value=1", status=2, says="two files have no layers")

    def test_pictures_that_no_layer_has(self):
        """With a palette, as exports and textures are: their bytes decide."""
        def chunk(kind, body):
            return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        names = [self.path(name) for name in ("one.png", "same.png", "other.png")]
        for name, index in zip(names, b"\0\0\1"):
            with open(name, "wb") as file:
                file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 3, 0, 0, 0)) +
                           chunk(b"PLTE", bytes(6)) + chunk(b"IDAT", zlib.compress(bytes([0, index]))) + chunk(b"IEND", b""))
        self.dgtk("compare", names[0], names[1])
        self.assertIn("the bytes differ", self.dgtk("compare", names[0], names[2], status=1).stdout)
        layer = os.path.join(self.one, "left", "color", "000000.png")
        self.refused("compare", names[0], layer, status=3, says="one.png")

    def test_folders_of_other_scenes(self):
        os.mkdir(self.path("scenes"))
        for number, name in enumerate("ab"):
            self.write(f"scenes/{name}.json", json.dumps({"objects": [], "cameras": [{"eye": [0, 0, 5], "lookAt": [0, 0, 0]}]}))
            self.dgtk("render", self.path("scenes"), "-o", self.path(f"{number + 1}"), "--layers", "depth", "--size", "8x6", "--quiet")
        for one, other in ("12", "21"):
            said = self.dgtk("compare", self.path(one), self.path(other), status=1).stdout
            self.assertEqual(said, f"{self.path(one)} and {self.path(other)}: the scenes differ\n")
        self.dgtk("compare", self.path("2"), self.path("2"))

    def test_wrong_usage(self):
        for wrong in ("color", "color:", "color:2", "color:value", "color:value=", "color:value=-1", "color:value=nan", "color:share=1.1",
                      "color:pixels=0.5", "color:value=1,", "color:values=1", "color:value=1,pixels=2,", "color:share=1,e=3", "color:value=1 "):
            self.refused("compare", self.one, self.other, "--tolerance", wrong, status=2, says="expected [LAYER:]value=V,pixels=N,share=S")
        self.refused("compare", self.one, self.other, "--tolerance", "colour:value=1", status=2,
                     says=["'colour'", "it has color, depth, objects"])
        self.refused("compare", self.one, self.other, "--tolerance", "value=1", status=2, says="datasets need the layer")
        self.refused("compare", self.one, self.other, "--tolerance", "color:value=1", "--tolerance", "color:share=1", status=2, says="two for")
        os.mkdir(self.path("folder"))
        self.refused("compare", self.one, self.path("folder"), "--tolerance", "color:value=1", status=2, says=["folder has no manifest.json"])
        self.refused("compare", self.one, self.path("nothing"), status=3, says=["nothing", "does not exist"])
        self.refused("compare", self.path("nothing"), self.one, status=3, says=["nothing", "does not exist"])


if __name__ == "__main__":
    main()
