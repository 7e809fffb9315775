# SPDX-License-Identifier: BSD-3-Clause
"""Debian's python3 imports dgtk and renders a scene into numpy arrays: the values of the command line's files."""
import os
import sys

from harness import SCENES, Case, main

sys.path.insert(0, os.path.join(os.environ["DGTK_BUILD"], "lib", "python3", "dist-packages"))


class Python(Case):
    def test_arrays_equal_the_files(self):
        import dgtk
        import numpy

        path = os.path.join(SCENES, "demo.json")
        scene = dgtk.load(path)
        camera = scene.GetCameraName(0)
        self.dgtk("render", path, "-o", self.path("out"), "--quiet", "--layers", "color,depth,objects,normal", "--size", "160x120",
                  "--frames", "1", "--cameras", camera, "--objects-format", "npy")
        images = dgtk.render(scene, ["color", "depth", "objects", "normal"], camera=camera, frame=1, size=(160, 120),
                             visibility="raster")
        self.assertEqual(images["color"].shape, (120, 160, 3))
        self.assertEqual(images["color"].dtype, numpy.uint8)
        self.assertGreater(len(numpy.unique(images["color"])), 20)
        for layer in ("depth", "objects", "normal"):
            file = numpy.load(self.path("out", camera, layer, "000001.npy"))
            self.assertEqual(file.dtype, images[layer].dtype)
            numpy.testing.assert_array_equal(file, images[layer])
        self.assertTrue(numpy.isfinite(images["depth"][images["objects"] > 0]).all())

    def test_failures_raise_one_line(self):
        import dgtk

        with self.assertRaisesRegex(ValueError, "nothing.json"):
            dgtk.load("/nothing.json")
        scene = dgtk.load(os.path.join(SCENES, "demo.json"))
        with self.assertRaisesRegex(RuntimeError, "unknown layer"):
            dgtk.render(scene, "depht")


if __name__ == "__main__":
    main()
