# SPDX-License-Identifier: BSD-3-Clause
"""The sources of VTK pipelines, and depth from z-buffers."""
import os
import sys
import tempfile
import unittest

import numpy

sys.path.insert(0, os.path.join(os.environ["DGTK_BUILD"], "lib", "python3", "dist-packages"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import dgtk
import vtk
from vtkmodules.util.numpy_support import vtk_to_numpy

import judge
import scenes
from window_grabs import grabbed, window


class Pipelines(unittest.TestCase):
    """The sources of VTK pipelines."""

    def test_ground_truth_source(self):
        renderer = scenes.robot_arm()
        source = dgtk.dgtkGroundTruthSource()
        source.SetRenderer(renderer)
        source.SetLayers("depth,objects,cells,normal,color")
        source.SetSize(90, 70)
        flip = vtk.vtkImageFlip()
        flip.SetInputConnection(source.GetOutputPort())
        flip.SetFilteredAxis(1)
        flip.Update()
        self.assertEqual(flip.GetOutput().GetDimensions(), (90, 70, 1))
        flipped = vtk_to_numpy(flip.GetOutput().GetPointData().GetScalars()).reshape(70, 90)
        numpy.testing.assert_array_equal(flipped, dgtk.truth(renderer, "depth", size=(90, 70))["depth"])
        truth = dgtk.truth(renderer, ["depth", "objects", "cells", "normal", "color"], size=(90, 70))
        image = source.GetOutput()
        self.assertEqual(image.GetPointData().GetScalars().GetName(), "depth")
        source.SetRenderer(renderer)
        source.SetCamera("of a scene")  # is none of a renderer's
        source.Update()
        for name, expected in truth.items():
            found = vtk_to_numpy(image.GetPointData().GetArray(name))
            self.assertEqual(found.dtype, expected.dtype)
            numpy.testing.assert_array_equal(found.reshape(expected.shape)[::-1], expected)

    def test_it_executes_again_when_something_was_modified(self):
        renderer = scenes.robot_arm()
        source = dgtk.dgtkGroundTruthSource()
        source.SetRenderer(renderer)
        source.SetLayers("depth,color")
        source.SetSize(60, 40)
        runs = []
        source.AddObserver("EndEvent", lambda *_: runs.append(1))

        def executes(change):
            source.Update()
            before = len(runs)
            source.Update()
            self.assertEqual(len(runs), before, "nothing was modified")
            change()
            source.Update()
            return len(runs) - before
        actor = next(iter(renderer.GetViewProps()))
        camera = renderer.GetActiveCamera()
        light = vtk.vtkLight()
        renderer.AddLight(light)
        for change in (lambda: camera.Azimuth(5), lambda: actor.SetPosition(0.1, 0, 0), lambda: actor.GetProperty().SetColor(1, 0, 0),
                       lambda: actor.GetMapper().GetInputAlgorithm().SetNormal(0, 1, 0.2), lambda: light.SetIntensity(0.4),
                       lambda: renderer.SetBackground(0, 0, 1), lambda: actor.VisibilityOff(), lambda: source.SetLayers("depth")):
            self.assertEqual(executes(change), 1)

    def test_a_pipeline_that_failed_is_refused(self):
        """Its data are empty as if they were meant to be; an actor without any data is nothing."""
        vtk.vtkObject.GlobalWarningDisplayOff()
        self.addCleanup(vtk.vtkObject.GlobalWarningDisplayOn)
        for reader, drawn, says in ((vtk.vtkSTLReader, True, "vtkSTLReader failed .CannotOpenFileError"),
                                    (vtk.vtkOBJReader, False, "its pipeline failed"),
                                    (vtk.vtkXMLPolyDataReader, True, "its pipeline failed")):
            renderer = scenes.robot_arm()
            before = dgtk.truth(renderer, "objects", size=(40, 30))["objects"]
            lost = reader()
            lost.SetFileName("/nowhere/part")
            smooth = vtk.vtkPolyDataNormals()
            smooth.SetInputConnection(lost.GetOutputPort())
            actor = vtk.vtkActor()
            actor.SetMapper(vtk.vtkPolyDataMapper())
            renderer.AddActor(actor)
            numpy.testing.assert_array_equal(before, dgtk.truth(renderer, "objects", size=(40, 30))["objects"])
            actor.GetMapper().SetInputConnection(smooth.GetOutputPort())
            if drawn:
                smooth.Update()  # as a window does
            with self.assertRaisesRegex(ValueError, says):
                dgtk.truth(renderer, "objects", size=(40, 30))
            if reader is vtk.vtkSTLReader:  # others tell once or twice
                with self.assertWarnsRegex(UserWarning, says):
                    found = dgtk.truth(renderer, "objects", size=(40, 30), unsupported="skip")["objects"]
                numpy.testing.assert_array_equal(before, found)

        # One that works again is none, whatever code VTK keeps.
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "ball.stl")
            writer = vtk.vtkSTLWriter()
            ball = vtk.vtkSphereSource()
            writer.SetInputConnection(ball.GetOutputPort())
            writer.SetFileName(path)
            writer.Write()
            again = vtk.vtkSTLReader()
            again.SetFileName("/nowhere/part")
            again.Update()
            again.SetFileName(path)
            mapper, actor, renderer = vtk.vtkPolyDataMapper(), vtk.vtkActor(), vtk.vtkRenderer()
            mapper.SetInputConnection(again.GetOutputPort())
            actor.SetMapper(mapper)
            renderer.AddActor(actor)
            self.assertGreater(dgtk.truth(renderer, "objects", size=(40, 30))["objects"].max(), 0)
            self.assertNotEqual(again.GetErrorCode(), 0)

    def test_it_sees_what_actors_do_not_know_of(self):
        """Blocks and their colours, the shape of a glyph, the picture of a texture, a plane: each change is in the next output."""
        blocks, glyphs = scenes.blocks(), scenes.glyph_mapper()
        blocked = next(iter(blocks.GetViewProps()))
        data = blocked.GetMapper().GetInputDataObject(0, 0)
        attributes = blocked.GetMapper().GetCompositeDataDisplayAttributes()
        glyphed = next(iter(glyphs.GetViewProps()))
        shape = vtk.vtkSphereSource()
        glyphed.GetMapper().SetSourceConnection(1, shape.GetOutputPort())
        textured = scenes.actor(vtk.vtkPlaneSource())
        textured.SetTexture(scenes.picture())
        plane = vtk.vtkPlane()
        plane.SetOrigin(-9, 0, 0)
        plane.SetNormal(1, 0, 0)
        textured.GetMapper().AddClippingPlane(plane)

        def move_a_point():
            data.GetBlock(0).GetPoints().SetPoint(0, -1.2, 0, 3)
            data.GetBlock(0).GetPoints().Modified()

        def paint():
            picture = textured.GetTexture().GetInput()
            picture.GetPointData().GetScalars().Fill(90)
            picture.GetPointData().GetScalars().Modified()
        following, faced = vtk.vtkFollower(), vtk.vtkCamera()
        following.SetMapper(scenes.actor(vtk.vtkCubeSource()).GetMapper())
        faced.SetPosition(1, 1, 4)
        following.SetCamera(faced)
        mapped, table = scenes.actor(vtk.vtkPlaneSource()), vtk.vtkLookupTable()
        mapped.SetTexture(scenes.picture())
        mapped.GetTexture().SetLookupTable(table)
        mapped.GetTexture().SetColorModeToMapScalars()
        table.Build()
        through, lens, model = scenes.renderer(scenes.actor(vtk.vtkCubeSource()), eye=(1, 1, 3)), vtk.vtkTransform(), vtk.vtkMatrix4x4()
        through.GetActiveCamera().SetUserTransform(lens)
        through.GetActiveCamera().SetModelTransformMatrix(model)
        for name, renderer, change in (("camera of a follower", scenes.renderer(following, eye=(0, 0, 5)), lambda: faced.SetPosition(3, 1, 2)),
                                       ("table of a texture", scenes.renderer(mapped, eye=(0, 0, 3)), lambda: table.SetHueRange(0.2, 0.3) or table.Build()),
                                       ("transform of a camera", through, lambda: lens.Scale(2, 1, 1)),
                                       ("model transform of a camera", through, lambda: model.SetElement(0, 3, 0.3)), ("point of a block", blocks, move_a_point),
                                       ("colour of a block", blocks, lambda: attributes.SetBlockColor(data.GetBlock(0), (1, 0, 0))),
                                       ("shape of a glyph", glyphs, lambda: shape.SetRadius(0.9)),
                                       ("picture", scenes.renderer(textured, eye=(0, 0, 3)), paint),
                                       ("plane", scenes.renderer(textured, eye=(0, 0, 3)), lambda: plane.SetOrigin(0, 0, 0))):
            with self.subTest(name):
                source = dgtk.dgtkGroundTruthSource()
                source.SetRenderer(renderer)
                source.SetLayers("color,depth")
                source.SetSize(60, 40)

                def output():
                    source.Update()
                    return [vtk_to_numpy(source.GetOutput().GetPointData().GetArray(layer)).copy() for layer in ("color", "depth")]
                before = output()
                change()
                self.assertTrue(any((old != new).any() for old, new in zip(before, output())))

    def test_of_a_scene(self):
        scene = dgtk.load(os.path.join(os.environ["DGTK_SOURCE"], "Data", "Scenes", "demo.json"))
        source = dgtk.dgtkGroundTruthSource()
        source.SetScene(scene)
        source.SetCamera("right")
        source.SetFrame(1)
        source.SetSize(80, 60)
        source.SetLayers("flow_forward")
        source.Update()
        expected = dgtk.render(scene, "flow_forward", camera="right", frame=1, size=(80, 60))
        for name, array in expected.items():
            found = vtk_to_numpy(source.GetOutput().GetPointData().GetArray(name))
            numpy.testing.assert_array_equal(found.reshape(array.shape)[::-1], array)

    def test_of_a_scene_that_is_loaded_anew(self):
        def text(width):
            return ('{"cameras": [{"name": "c", "width": %d, "height": 8, "eye": [0, 0, 5], "lookAt": [0, 0, 0], "fovY": 40, "near": 1, "far": 9}]}'
                    % width)
        scene, source = dgtk.dgtkScene(), dgtk.dgtkGroundTruthSource()
        source.SetScene(scene)
        source.SetLayers("depth")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.json")
            for width, load in ((8, scene.LoadText), (12, scene.Load), (16, scene.Load), (20, scene.LoadText)):
                with open(path, "w", encoding="ascii") as file:
                    file.write(text(width))
                self.assertTrue(load(path) if load == scene.Load else load(text(width), folder), scene.GetErrorMessage())
                source.Update()
                self.assertEqual(source.GetOutput().GetDimensions()[0], width)
        source.AddObserver("ErrorEvent", lambda *_: None)
        source.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
        for layers, points in (("depht", 0), ("depth", 160), ("", 0), ("depth", 160)):  # nothing of an earlier update stays
            source.SetLayers(layers)
            source.Update()
            self.assertEqual(source.GetOutput().GetNumberOfPoints(), points, layers)

    def test_pieces_and_what_they_are_drawn_in(self):
        """Sub-pieces save memory while VTK draws: all of them are what a mapper shows."""
        def seen(pieces, piece, parts):
            sphere, mapper, actor, renderer = vtk.vtkSphereSource(), vtk.vtkPolyDataMapper(), vtk.vtkActor(), vtk.vtkRenderer()
            sphere.SetThetaResolution(32)
            mapper.SetInputConnection(sphere.GetOutputPort())
            mapper.SetNumberOfPieces(pieces)
            mapper.SetPiece(piece)
            mapper.SetNumberOfSubPieces(parts)
            actor.SetMapper(mapper)
            renderer.AddActor(actor)
            renderer.GetActiveCamera().SetPosition(0, 0, 3)
            renderer.GetActiveCamera().SetClippingRange(1, 9)
            return (dgtk.truth(renderer, "objects", size=(60, 60))["objects"] > 0).sum()
        whole, half = seen(1, 0, 1), seen(2, 1, 1)
        self.assertLess(half, whole)
        self.assertEqual((seen(1, 0, 4), seen(2, 1, 3)), (whole, half))

    def test_failures_are_errors_of_the_pipeline(self):
        for source, words in ((dgtk.dgtkGroundTruthSource(), "neither a renderer nor a scene"), (dgtk.dgtkDepthFromZBuffer(), "")):
            told = []
            source.AddObserver("ErrorEvent", lambda *_: told.append(1))
            executive = source.GetExecutive()
            executive.AddObserver("ErrorEvent", lambda *_: told.append(1))
            if not words:
                source.SetInputDataObject(vtk.vtkImageData())
            source.Update()
            self.assertTrue(told)

    def test_point_cloud(self):
        renderer = scenes.cut_open()
        source = dgtk.dgtkPointCloudSource()
        source.SetRenderer(renderer)
        source.SetSize(80, 60)
        source.Update()
        cloud = source.GetOutput()
        truth = dgtk.truth(renderer, ["position", "objects", "cells", "color", "normal"], size=(80, 60))
        seen = truth["objects"] > 0
        self.assertEqual(cloud.GetNumberOfPoints(), seen.sum())
        self.assertEqual(cloud.GetNumberOfVerts(), seen.sum())
        arrays = {name: vtk_to_numpy(cloud.GetPointData().GetArray(name)) for name in ("objects", "cells", "Colors", "Normals", "pixels")}
        numpy.testing.assert_array_equal(vtk_to_numpy(cloud.GetPoints().GetData()), truth["position"][seen])
        for name, layer in (("objects", "objects"), ("cells", "cells"), ("Colors", "color")):
            numpy.testing.assert_array_equal(arrays[name], truth[layer][seen])
        numpy.testing.assert_allclose(arrays["Normals"], truth["normal"][seen] @ truth.R, atol=1e-6)
        in_camera = truth["position"][seen] @ truth.R.T + truth.t
        pixels = in_camera @ truth.K.T
        numpy.testing.assert_allclose(arrays["pixels"], pixels[:, :2] / pixels[:, 2:], atol=1e-9)


class ZBuffers(unittest.TestCase):
    SIZE = (48, 36)

    def test_the_exact_depth_lies_within_the_half_width(self):
        for name, make in scenes.ALL.items():
            if name != "star":
                with self.subTest(scene=name):
                    self.look(make())

    def look(self, renderer):
        shown = window(renderer, size=self.SIZE)
        right = judge.Judge(renderer, *self.SIZE)
        renderer.ResetCameraClippingRange()
        grab = grabbed(shown)
        grab.SetInputBufferTypeToZBuffer()
        depth = dgtk.dgtkDepthFromZBuffer()
        depth.SetInputConnection(grab.GetOutputPort())
        depth.SetCamera(renderer.GetActiveCamera())
        depth.Update()
        arrays = depth.GetOutput().GetPointData()
        found, half = (vtk_to_numpy(arrays.GetArray(name)).reshape(self.SIZE[::-1])[::-1] for name in ("depth", "half_width"))
        exact = dgtk.truth(renderer, "depth")["depth"]
        sure = ~right.near_edge.reshape(exact.shape)
        numpy.testing.assert_array_equal(numpy.isinf(found[sure]), numpy.isinf(exact[sure]))
        seen = sure & numpy.isfinite(exact)
        self.assertGreater(seen.sum(), 100)
        away = numpy.abs(found[seen] - exact[seen])
        self.assertLessEqual((away / half[seen]).max(), 1)
        self.assertLess(numpy.median(half[seen] / exact[seen]), 1e-2)
        self.assertGreater((away / half[seen]).max(), 1e-3, "the half-width is not far too large")

    def test_closed_forms(self):
        image = vtk.vtkImageData()
        image.SetDimensions(3, 1, 1)
        image.AllocateScalars(vtk.VTK_DOUBLE, 1)
        for x, z in enumerate((0.0, 0.5, 1.0)):
            image.SetScalarComponentFromDouble(x, 0, 0, 0, z)
        camera = vtk.vtkCamera()
        camera.SetClippingRange(2, 10)
        for parallel, expected, slope in ((False, (2, 1 / (0.5 / 2 + 0.5 / 10), numpy.inf), (2 * 2 * 8 / 20.0, (10 / 3) ** 2 * 8 / 20, numpy.inf)),
                                          (True, (2, 6, numpy.inf), (8, 8, numpy.inf))):
            camera.SetParallelProjection(parallel)
            source = dgtk.dgtkDepthFromZBuffer()
            source.SetInputData(image)
            source.SetCamera(camera)
            source.SetSubpixelBits(16)
            source.SetRoundingSteps(0)
            source.SetDepthBits(8)
            source.Update()
            arrays = source.GetOutput().GetPointData()
            depth, half = (vtk_to_numpy(arrays.GetArray(name)) for name in ("depth", "half_width"))
            numpy.testing.assert_allclose(depth, expected, rtol=1e-12)
            numpy.testing.assert_allclose(half, numpy.array(slope) * 2 ** -9, rtol=5e-3)


if __name__ == "__main__":
    unittest.main()
