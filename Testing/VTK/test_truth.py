# SPDX-License-Identifier: BSD-3-Clause
"""dgtk.truth() of scenes of VTK against rays in NumPy; what VTK's own window draws; what is refused."""
import os
import sys
import unittest
import warnings

import numpy

sys.path.insert(0, os.path.join(os.environ["DGTK_BUILD"], "lib", "python3", "dist-packages"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import dgtk
import vtk

import judge
import scenes

SIZE = (72, 54)


class Truth(unittest.TestCase):
    def test_every_scene_is_what_rays_in_numpy_find(self):
        for name, make in scenes.ALL.items():
            with self.subTest(scene=name):
                renderer = make()
                truth = dgtk.truth(renderer, ["objects", "cells", "depth", "normal", "position", "distance"], size=SIZE)
                right = judge.Judge(renderer, *SIZE)
                self.compare(truth, right)

    def compare(self, truth, right):
        flat = {name: array.reshape(SIZE[0] * SIZE[1], -1).squeeze() for name, array in truth.items()}
        sure = ~right.near_edge
        self.assertGreater(sure.mean(), 0.5)
        self.assertGreater((right.objects > 0).mean(), 0.05)
        numpy.testing.assert_array_equal(flat["objects"][sure], right.objects[sure])
        numpy.testing.assert_array_equal(flat["cells"][sure], right.cells[sure])
        seen = sure & (right.objects > 0)
        position = right.position[seen]
        numpy.testing.assert_allclose(flat["position"][seen], position, rtol=0, atol=1e-9 * numpy.abs(position).max())
        in_camera = position @ truth.R.T + truth.t
        numpy.testing.assert_allclose(flat["depth"][seen], in_camera[:, 2], rtol=1e-9)
        self.assertTrue(numpy.isinf(flat["depth"][sure & (right.objects == 0)]).all())
        turned = right.plane[seen] @ truth.R.T
        ahead = right.direction[seen] @ truth.R.T
        turned = numpy.where(((turned * ahead).sum(-1) > 0)[:, None], -turned, turned)
        numpy.testing.assert_allclose(flat["normal"][seen], turned, atol=1e-6)
        pixels = in_camera @ truth.K.T
        pixels = pixels[:, :2] / pixels[:, 2:] if abs(right.clip[3, :3]).max() > 0 else in_camera[:, :2] @ truth.K[:2, :2].T + truth.K[:2, 2]
        x, y = numpy.meshgrid(numpy.arange(SIZE[0]) + 0.5, numpy.arange(SIZE[1]) + 0.5)
        numpy.testing.assert_allclose(pixels, numpy.stack([x.ravel(), y.ravel()], -1)[seen], atol=1e-7)


if __name__ == "__main__":
    unittest.main()
