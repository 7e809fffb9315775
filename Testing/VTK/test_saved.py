# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots that are written and read again, and that several threads ask at once."""
import os
import sys
import tempfile
import unittest
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk

sys.path.insert(0, os.path.join(os.environ["DGTK_BUILD"], "lib", "python3", "dist-packages"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import dgtk
import vtk

import scenes

SIZE = (60, 45)


class Saved(unittest.TestCase):
    def both(self, renderer):
        """The colours of a snapshot, and of what it is when it was written and read again."""
        shot = dgtk.snapshot(renderer, SIZE)
        with tempfile.TemporaryDirectory() as folder:
            with warnings.catch_warnings(record=True) as self.said:
                warnings.simplefilter("always")
                shot.save(folder + "/scene.json")
            again = dgtk.render(dgtk.load(folder + "/scene.json"), "color", renderer="ray")
        return dgtk.render(shot, "color", renderer="ray").astype(int), again.astype(int)

    def assert_said(self, lines):
        self.assertEqual([str(one.message) for one in self.said], lines)
        self.assertTrue(all(os.path.samefile(one.filename, __file__) for one in self.said))

    def test_scalars_beyond_their_range(self):
        renderer = scenes.contour()
        for actor in renderer.GetActors():
            actor.GetMapper().SetScalarRange(0.3, 0.7)
            actor.GetMapper().InterpolateScalarsBeforeMappingOn()
        shot, again = self.both(renderer)
        self.assertGreater((shot.max(-1) > 20).mean(), 0.1)
        self.assertLess(numpy.abs(shot - again).mean(), 1)
        self.assert_said(["saved otherwise: actor-1: its texture coordinates are places in its map of colours"])
        with tempfile.TemporaryDirectory() as folder, self.assertWarnsRegex(UserWarning, "map of colours") as said:
            dgtk.generate(dgtk.snapshot(renderer, SIZE), folder, layers="depth")
        self.assertTrue(os.path.samefile(said.filename, __file__))

    def test_few_colours_keep_their_borders(self):
        """Of five bands across the picture, only the pixels that a border passes through are mixed."""
        wall = vtk.vtkPlaneSource()
        wall.Update()
        data = wall.GetOutput()
        data.GetPointData().SetScalars(numpy_to_vtk(numpy.array([0.0, 1, 0, 1]), deep=1))
        table = vtk.vtkLookupTable()
        table.SetNumberOfTableValues(5)
        table.SetRange(0, 1)
        table.Build()
        made = scenes.actor(data)
        made.GetProperty().LightingOff()
        made.GetMapper().InterpolateScalarsBeforeMappingOn()
        made.GetMapper().SetLookupTable(table)
        shot, again = self.both(scenes.renderer(made, eye=(0, 0, 2)))
        seen = (shot != shot[0, 0]).any(-1).sum(0).max()
        self.assertGreater(seen, 30)
        self.assertLessEqual(((numpy.abs(shot - again) > 8).any(-1)).sum(), 4 * seen)

    def test_a_texture_of_nearest_texels(self):
        image = vtk.vtkImageData()
        image.SetDimensions(2, 3, 1)
        image.GetPointData().SetScalars(numpy_to_vtk(255 * (numpy.arange(6)[:, None] >> numpy.arange(3) & 1).astype(numpy.uint8), deep=1))
        texture = vtk.vtkTexture()
        texture.SetInputData(image)
        made = scenes.actor(vtk.vtkPlaneSource())
        made.SetTexture(texture)
        made.GetProperty().LightingOff()
        shot, again = self.both(scenes.renderer(made, eye=(0, 0, 2)))
        seen = (shot != shot[0, 0]).any(-1).sum(0).max()
        self.assertGreater(seen, 30)
        self.assertLessEqual((numpy.abs(shot - again) > 8).any(-1).sum(), 10 * seen)  # two pixels along borders and rim
        self.assert_said([])

    def test_a_physically_based_surface_without_texture_coordinates(self):
        """VTK darkens all of it, which a picture says."""
        cube = vtk.vtkCubeSource()
        cube.Update()
        data = cube.GetOutput()
        data.GetPointData().SetTCoords(None)
        made = scenes.actor(data)
        made.GetProperty().SetInterpolationToPBR()
        made.GetProperty().SetMetallic(0.2)
        made.GetProperty().SetRoughness(0.5)
        shot, again = self.both(scenes.renderer(made, eye=(2, 1, 3)))
        self.assertLessEqual(numpy.abs(shot - again).max(), 1)

    def test_what_cannot_be_seen(self):
        ball, cube = scenes.actor(vtk.vtkSphereSource()), scenes.actor(vtk.vtkCubeSource(), color=(0.9, 0.2, 0.1))
        ball.SetPosition(0, 0, 2)
        ball.GetProperty().SetOpacity(0)
        shot, again = self.both(scenes.renderer(ball, cube, eye=(0.3, 0.4, 5)))
        self.assertLessEqual(numpy.abs(shot - again).max(), 1)


class Threads(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        sphere = vtk.vtkSphereSource()
        renderer = scenes.renderer(*[scenes.actor(sphere) for _ in range(30)], eye=(0, 0, 3))
        cls.shots = []
        for _ in range(4):
            cls.shots.append(dgtk.snapshot(renderer, size=(12, 9)))
            renderer.GetActiveCamera().Azimuth(7)
        cls.pairs = [dgtk.correspond(cls.shots[0], shot) for shot in cls.shots]
        cls.counts = dgtk.visible_cells(cls.shots[0])

    def at_once(self, ask):
        """Often, in four threads that take turns as often as they can."""
        interval = sys.getswitchinterval()
        sys.setswitchinterval(1e-6)
        try:
            with ThreadPoolExecutor(4) as pool:
                list(pool.map(ask, 50 * [0, 1, 2, 3]))
        finally:
            sys.setswitchinterval(interval)

    def test_pairs_of_one_snapshot(self):
        def ask(number):
            for found, right in zip(dgtk.correspond(self.shots[0], self.shots[number]), self.pairs[number]):
                numpy.testing.assert_array_equal(found, right)
        self.at_once(ask)

    def test_cells_of_one_snapshot(self):
        def ask(_):
            for found, right in zip(dgtk.visible_cells(self.shots[0]), self.counts, strict=True):
                numpy.testing.assert_array_equal(found, right)
        self.at_once(ask)

    def test_methods_without_turns(self):
        """What one thread has not written to its end, another one does not put away."""
        self.at_once(lambda number: self.assertTrue(self.shots[0].Correspond(self.shots[number])))
        self.at_once(lambda _: self.assertTrue(self.shots[0].CountCells()))


if __name__ == "__main__":
    unittest.main()
