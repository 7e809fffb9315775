# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots that are written and read again, and that several threads ask at once."""
import os
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy

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
            shot.save(folder + "/scene.json")
            again = dgtk.render(dgtk.load(folder + "/scene.json"), "color", renderer="ray")
        return dgtk.render(shot, "color", renderer="ray").astype(int), again.astype(int)

    def test_scalars_beyond_their_range(self):
        renderer = scenes.contour()
        for actor in renderer.GetActors():
            actor.GetMapper().SetScalarRange(0.3, 0.7)
            actor.GetMapper().InterpolateScalarsBeforeMappingOn()
        shot, again = self.both(renderer)
        self.assertGreater((shot.max(-1) > 20).mean(), 0.1)
        self.assertLess(numpy.abs(shot - again).mean(), 1)

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
