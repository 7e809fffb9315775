# SPDX-License-Identifier: BSD-3-Clause
"""dgtk.truth() of glyphs: copies of shapes, and how they are turned."""
import os
import sys
import unittest

import numpy

sys.path.insert(0, os.path.join(os.environ["DGTK_BUILD"], "lib", "python3", "dist-packages"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import dgtk
import vtk

import scenes

SIZE = (60, 45)


class Glyphs(unittest.TestCase):
    """Glyphs share the models of their shapes, but where something cuts single triangles: both are the same object."""
    LAYERS = ("objects", "parts", "triangles", "depth", "normal", "shadingnormal", "objectcoords", "position", "color", "color_rgba", "alpha",
              "coverage", "edges", "classes", "boxes", "amodal", "ldi", "matting", "barycentrics", "points")

    def leaves(self, output, name=""):
        if isinstance(output, (dict, list, tuple)):
            for key, value in output.items() if isinstance(output, dict) else enumerate(output):
                yield from self.leaves(value, f"{name}/{key}")
        else:
            yield name, output

    def outputs(self, shot, layer):
        options = {"matte": ["actor-1"]} if layer == "matting" else {}
        return dict(self.leaves(dgtk.render(shot, layer, samples=2, **options)))

    def test_copies_are_what_they_are_written_out(self):
        for scene in ("glyph_mapper", "hedgehog", "two_shapes"):
            renderer = scenes.ALL[scene]()
            copies = dgtk.snapshot(renderer, SIZE)
            plane = vtk.vtkPlane()
            plane.SetOrigin(0, 0, -1000)  # far away
            for actor in renderer.GetActors():
                actor.GetMapper().AddClippingPlane(plane)
            whole = dgtk.snapshot(renderer, SIZE)
            for layer in self.LAYERS:
                with self.subTest(scene=scene, layer=layer):
                    one, other = self.outputs(copies, layer), self.outputs(whole, layer)
                    self.assertEqual(list(one), list(other))
                    for name, value in one.items():
                        if isinstance(value, str):
                            self.assertEqual(value, other[name])
                        else:
                            rounding = 1 if numpy.asarray(value).dtype == numpy.uint16 else 1e-6
                            numpy.testing.assert_allclose(value, other[name], rtol=1e-6, atol=rounding, err_msg=name)
            for one, other in zip(dgtk.visible_cells(copies), dgtk.visible_cells(whole)):
                numpy.testing.assert_array_equal(one, other)
            centres = numpy.stack(numpy.meshgrid(numpy.arange(SIZE[0]) + 0.5, numpy.arange(SIZE[1]) + 0.5), -1)
            for first, second in ((copies, whole), (whole, copies), (copies, copies)):
                xy, classes = dgtk.correspond(first, second)
                self.assertEqual(set(numpy.unique(classes)), {0, 1})
                numpy.testing.assert_allclose(xy[classes == 1], centres[classes == 1], atol=1e-9)

    def test_arrays_shorter_than_the_points(self):
        """VTK reads beyond their ends."""
        for name in ("size", "shape", "Normals", "shade"):
            with self.subTest(name):
                renderer = scenes.glyph_mapper()
                data = next(iter(renderer.GetViewProps())).GetMapper().GetInputDataObject(0, 0).GetPointData()
                data.GetArray(name).SetNumberOfTuples(3)
                with self.assertRaisesRegex(ValueError, "actor-1: arrays of its glyphs that are shorter than its points"):
                    dgtk.truth(renderer, "depth", size=(32, 24))

    def test_quaternions_of_any_length(self):
        """VTK turns by their directions, and draws nothing where one is zero."""
        points = vtk.vtkPolyData()
        points.SetPoints(vtk.vtkPoints())
        for x in (-0.5, 0, 0.5):
            points.GetPoints().InsertNextPoint(x, 0, 0)
        turn = vtk.vtkTransform()
        turn.RotateWXYZ(70, 1, 2, 3)
        quaternion = numpy.concatenate([[numpy.cos(numpy.radians(35))], numpy.sin(numpy.radians(35)) * numpy.array([1, 2, 3]) / numpy.sqrt(14)])
        turns = vtk.vtkDoubleArray()
        turns.SetName("turn")
        turns.SetNumberOfComponents(4)
        for length in (1, 2.5, 0):
            turns.InsertNextTuple(length * quaternion)
        points.GetPointData().AddArray(turns)
        mapper = vtk.vtkGlyph3DMapper()
        mapper.SetInputData(points)
        shape = vtk.vtkConeSource()
        shape.SetHeight(0.7)
        shape.SetRadius(0.2)
        mapper.SetSourceConnection(shape.GetOutputPort())
        mapper.SetOrientationArray("turn")
        mapper.SetOrientationModeToQuaternion()
        mapper.ScalingOff()
        glyphs = vtk.vtkActor()
        glyphs.SetMapper(mapper)
        turned = [scenes.actor(shape), scenes.actor(shape)]
        for one, x in zip(turned, (-0.5, 0)):
            one.SetUserTransform(turn)
            one.SetPosition(turn.GetInverse().TransformPoint(x, 0, 0))
        found, expected = (dgtk.truth(scenes.renderer(*actors, eye=(0, 0, 3)), ["depth", "cells"], size=SIZE) for actors in ([glyphs], turned))
        self.assertGreater(numpy.isfinite(expected["depth"]).sum(), 100)
        numpy.testing.assert_allclose(found["depth"], expected["depth"], rtol=1e-9)
        self.assertEqual(set(found["cells"][found["cells"] >= 0]), {0, 1})

    @unittest.skipIf(os.environ.get("DGTK_TEST_SANITIZED"), "measures memory, which sanitizers change")
    def test_many_take_little_memory(self):
        def used():
            with open("/proc/self/statm", encoding="ascii") as file:
                return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        sphere = vtk.vtkSphereSource()
        sphere.SetThetaResolution(25)
        sphere.SetPhiResolution(22)
        sphere.SetRadius(0.02)
        cloud = vtk.vtkPointSource()
        cloud.SetNumberOfPoints(20000)
        cloud.SetRadius(1)
        cloud.SetRandomSequence(vtk.vtkMinimalStandardRandomSequence())
        mapper = vtk.vtkGlyph3DMapper()
        mapper.SetInputConnection(cloud.GetOutputPort())
        mapper.SetSourceConnection(sphere.GetOutputPort())
        mapper.Update()
        made = vtk.vtkActor()
        made.SetMapper(mapper)
        before = used()
        counted = dgtk.visible_cells(scenes.renderer(made), size=SIZE)[0]
        self.assertEqual(len(counted), 20000)
        self.assertGreater((counted > 0).sum(), 300)
        self.assertLess(used() - before, 200e6)  # written out, 2.6 GB


if __name__ == "__main__":
    unittest.main()
