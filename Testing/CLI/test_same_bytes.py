# SPDX-License-Identifier: BSD-3-Clause
"""The same request gives the same bytes: threads, order of frames, first or second run; with each back end and tiling."""
import os
import shutil

from harness import SCENES, digests, main
from many_runs import ManyCase
from test_tiles import PIXEL_LAYERS, without_tiles

# What needs neighbours, other views, every surface along the ray or many samples a pixel: small pictures of one scene, with more than 2^14 pixels
# where pairs and layers of surfaces are made in strips of so many.
WIDE_LAYERS = ("edges,correspondence,disparity,disparity_forward,disparity_backward,flow_forward,flow_backward,sceneflow,ldi,alpha,coverage,"
               "boxes,amodal,points,tiles")

os.environ["DGTK_CACHE"] = "0"  # what runs have read of models is compared, too


class SameBytes(ManyCase):
    def test_layers_that_need_more_than_their_pixel(self):
        for samples, layers, part in ((1, WIDE_LAYERS, ("--size", "172x96", "--frames", "1")), (2, "color,alpha,coverage,tiles", ("--size", "96x72", "--frames", "0:1"))):
            common = ("render", os.path.join(SCENES, "demo.json"), "--quiet", *part)
            one = self.path(f"one{samples}")
            self.alone(*common, "-o", one, "--layers", layers, "--samples", samples, "--threads", 1, "--gl", "egl")
            for threads, gl, tile in ((2, "osmesa", "640x480"), (5, "egl", "37x23")):
                with self.subTest(samples=samples, threads=threads, gl=gl, tile=tile):
                    other = self.path("other")
                    self.dgtk(*common, "-o", other, "--layers", layers, "--samples", samples, "--threads", threads,
                              "--gl", gl, "--tile", tile)
                    self.assertEqual(without_tiles(one), without_tiles(other))
                    if tile == "640x480":
                        self.assert_same_files(one, other)
                    shutil.rmtree(other)

    def test_threads_frames_and_repetition(self):
        scene = os.path.join(SCENES, "demo.json")
        for engine in ("raster", "ray"):
            common = ("render", scene, "--quiet", "--layers", PIXEL_LAYERS, "--size", "64x48", "--visibility", engine)
            self.alone(*common, "-o", self.path(engine), "--threads", 1)
            for name, run, options in (("again", self.dgtk, ()), ("five", self.alone, ("--threads", 5))):  # OpenGL's threads are of a process
                run(*common, "-o", self.path(engine + name), *options)
                self.assert_same_files(self.path(engine), self.path(engine + name))
            self.alone(*common, "-o", self.path(engine + "last"), "--frames", "2")
            self.dgtk(*common, "-o", self.path(engine + "first"), "--frames", "0")
            whole = digests(self.path(engine))
            for part in ("last", "first"):
                for name, digest in digests(self.path(engine + part)).items():
                    if name.count("/") == 2:
                        self.assertEqual(whole[name], digest, name)

    def test_samples_and_16_bits(self):
        scene = os.path.join(SCENES, "demo.json")
        common = ("render", scene, "--quiet", "--layers", "color", "--size", "160x120", "--frames", "0", "--samples", 3,
                  "--color-bits", 16, "--color-format", "png,exr")
        self.alone(*common, "-o", self.path("one"), "--threads", 1)
        self.dgtk(*common, "-o", self.path("two"), "--threads", 2, "--gl", "osmesa")
        self.assert_same_files(self.path("one"), self.path("two"))


if __name__ == "__main__":
    main()
