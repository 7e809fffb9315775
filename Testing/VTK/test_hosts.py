# SPDX-License-Identifier: BSD-3-Clause
"""dgtk.truth() inside the packages that people script VTK with: vedo, Mayavi, and what looks like a plotter of PyVista."""
import importlib.util
import os
import sys
import unittest

import numpy

sys.path.insert(0, os.path.join(os.environ["DGTK_BUILD"], "lib", "python3", "dist-packages"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
import dgtk
import vtk

import judge
import scenes

SIZE = (80, 60)


def there(name):
    return unittest.skipUnless(importlib.util.find_spec(name), f"{name} is left out: it is not installed")


class Hosts(unittest.TestCase):
    def compare(self, view, renderer, least=1):
        truth = dgtk.truth(view, ["objects", "cells", "depth"], size=SIZE)
        right = judge.Judge(renderer, *SIZE)
        sure = ~right.near_edge
        self.assertGreaterEqual(truth["objects"].max(), least)
        numpy.testing.assert_array_equal(truth["objects"].ravel()[sure], right.objects[sure])
        numpy.testing.assert_array_equal(truth["cells"].ravel()[sure], right.cells[sure])
        seen = sure & (right.objects > 0)
        depth = right.position[seen] @ truth.R[2] + truth.t[2]
        numpy.testing.assert_allclose(truth["depth"].ravel()[seen], depth, rtol=1e-9)
        return truth

    @there("vedo")
    def test_vedo(self):
        import vedo
        plotter = vedo.Plotter(offscreen=True, size=SIZE)
        sphere = vedo.Sphere(res=8).cmap("viridis", numpy.arange(vedo.Sphere(res=8).npoints))
        cube = vedo.Cube().pos(1.5, 0.2, 0).rotate_z(20).c("tomato")
        plotter.show(sphere, cube, viewup="y", interactive=False)
        truth = self.compare(plotter, plotter.renderer, 2)
        self.assertIs(truth.props[1], cube)
        self.assertEqual(len(dgtk.visible_cells(plotter, size=SIZE)[1]), cube.ncells)
        plotter.close()

    @there("vedo")
    def test_vedo_that_was_not_shown(self):
        import vedo
        plotter = vedo.Plotter(offscreen=True, size=SIZE)
        plotter.add(vedo.Torus(res=12))
        plotter.renderer.ResetCamera()
        self.compare(plotter, plotter.renderer)
        plotter.close()

    @there("mayavi")
    def test_mayavi(self):
        from mayavi import mlab
        mlab.options.offscreen = True
        figure = mlab.figure(size=SIZE)
        x, y = numpy.mgrid[-2:2:12j, -2:2:14j]
        mlab.surf(x, y, numpy.cos(x) * numpy.sin(y))
        mlab.view(40, 60, 8)
        renderer = figure.scene.renderer._vtk_obj
        truth = self.compare(figure.scene, renderer)
        numpy.testing.assert_array_equal(truth["objects"], dgtk.truth(figure, "objects", size=SIZE)["objects"])
        mlab.close(all=True)

    def test_an_object_like_a_plotter(self):
        class Plotter:
            def __init__(self):
                self.renderer = scenes.robot_arm()
                self.ren_win = vtk.vtkRenderWindow()
                self.ren_win.SetOffScreenRendering(1)
                self.ren_win.SetSize(*SIZE)
                self.ren_win.AddRenderer(self.renderer)

            @property
            def scene(self):
                raise RuntimeError("not shown yet")
        plotter = Plotter()
        truth = self.compare(plotter, plotter.renderer, 5)
        numpy.testing.assert_array_equal(truth["depth"], dgtk.truth(plotter.ren_win, "depth")["depth"])
        moved = dgtk.snapshot(plotter)
        plotter.renderer.GetActiveCamera().Azimuth(15)
        xy, classes = dgtk.correspond(moved, dgtk.snapshot(plotter))
        self.assertEqual(xy.shape, (*SIZE[::-1], 2))
        self.assertIn(1, classes)


class Views(unittest.TestCase):
    def test_an_interactor(self):
        renderer = scenes.transforms()
        interactor = vtk.vtkRenderWindowInteractor()
        with self.assertRaisesRegex(ValueError, "no vtkRenderer in vtk.*RenderWindowInteractor "):
            dgtk.truth(interactor, "depth")
        window = vtk.vtkRenderWindow()
        window.AddRenderer(renderer)
        interactor.SetRenderWindow(window)
        numpy.testing.assert_array_equal(dgtk.truth(interactor, "depth", size=SIZE)["depth"], dgtk.truth(renderer, "depth", size=SIZE)["depth"])
        window.RemoveRenderer(renderer)

    def test_cameras_that_see_nothing(self):
        for words, change in (("has a position, a focal point or a view up that is no number", lambda c: c.SetPosition(0, float("nan"), 1)),
                              ("stands in its focal point", lambda c: c.SetPosition(c.GetFocalPoint())),
                              ("looks along its view up", lambda c: c.SetViewUp(c.GetDirectionOfProjection())),
                              ("has a parallel scale of 0", lambda c: (c.ParallelProjectionOn(), c.SetParallelScale(0)))):
            renderer = scenes.transforms()
            change(renderer.GetActiveCamera())
            with self.assertRaisesRegex(ValueError, f"VTK scene: its camera {words}"):
                dgtk.snapshot(renderer, SIZE)


if __name__ == "__main__":
    unittest.main()
