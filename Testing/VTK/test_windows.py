# SPDX-License-Identifier: BSD-3-Clause
"""Colours of dgtk.truth() beside what vtkRenderWindow draws of the same renderer; windows, viewports, sizes and z-buffers."""
import os
import sys
import unittest

import numpy

sys.path.insert(0, os.path.join(os.environ["DGTK_BUILD"], "lib", "python3", "dist-packages"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import dgtk
import vtk
from vtkmodules.util.numpy_support import vtk_to_numpy

import scenes

SIZE = (300, 225)


def window(*renderers, size=SIZE):
    made = vtk.vtkRenderWindow()
    made.SetOffScreenRendering(1)
    made.SetMultiSamples(0)
    made.SetSize(*size)
    for renderer in renderers:
        made.AddRenderer(renderer)
    return made


def drawn(shown):
    shown.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(shown)
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1, :, :3]


class Colours(unittest.TestCase):
    def compare(self, renderer, mean=0.3, unlike=0.002):
        shown = window(renderer)
        ours = dgtk.truth(renderer, "color", size=SIZE)["color"].astype(int)
        if renderer.IsActiveCameraCreated():
            renderer.ResetCameraClippingRange()
        theirs = drawn(shown).astype(int)
        away = numpy.abs(ours - theirs)
        self.assertGreater((theirs.max(-1) > 20).mean(), 0.02)
        self.assertLess(away.mean(), mean)
        self.assertLess((away.max(-1) > 2).mean(), unlike)

    def test_every_scene(self):
        for name, make in scenes.ALL.items():
            if name != "star":  # VTK fills what is outside of polygons that are not convex, and ignores its camera's aspect
                with self.subTest(scene=name):
                    self.compare(make())

    def test_lights_of_every_kind(self):
        for kind in ("Headlight", "CameraLight", "SceneLight"):
            for positional in (False, True):
                with self.subTest(kind=kind, positional=positional):
                    renderer = scenes.transforms()
                    renderer.AutomaticLightCreationOff()
                    light = vtk.vtkLight()
                    getattr(light, "SetLightTypeTo" + kind)()
                    light.SetPosition(0.6, 1.5, 1.2)
                    light.SetFocalPoint(0, 0, 0)
                    light.SetPositional(positional)
                    light.SetConeAngle(40)
                    light.SetExponent(3)
                    light.SetAttenuationValues(0.4, 0.1, 0.1)
                    light.SetColor(1, 0.9, 0.7)
                    light.SetIntensity(0.9)
                    renderer.AddLight(light)
                    other = vtk.vtkLight()
                    other.SetLightTypeToSceneLight()
                    other.SetPosition(-3, 2, -1)
                    other.SetIntensity(0.4)
                    renderer.AddLight(other)
                    self.compare(renderer)

    def test_without_lights(self):
        renderer = scenes.contour()
        renderer.AutomaticLightCreationOff()
        self.compare(renderer)
        unlit = scenes.quad_sphere()
        for actor in unlit.GetActors():
            actor.GetProperty().LightingOff()
        self.compare(unlit)

    def test_a_light_kit_and_a_background(self):
        renderer = scenes.robot_arm()
        vtk.vtkLightKit().AddLightsToRenderer(renderer)
        renderer.SetBackground(0.2, 0.3, 0.4)
        self.compare(renderer)

    def test_scalars_that_are_interpolated_before_they_are_mapped(self):
        renderer = scenes.contour()
        for actor in renderer.GetActors():
            table = vtk.vtkLookupTable()
            table.SetNumberOfTableValues(12)
            table.SetHueRange(0, 0.7)
            table.Build()
            actor.GetMapper().SetLookupTable(table)
            actor.GetMapper().InterpolateScalarsBeforeMappingOn()
        self.compare(renderer, unlike=0.01)

    def test_translucent_actors(self):
        renderer = scenes.transforms()
        for actor in renderer.GetActors():
            actor.GetProperty().SetOpacity(0.5)
        renderer.SetUseDepthPeeling(True)
        renderer.SetMaximumNumberOfPeels(20)
        renderer.SetOcclusionRatio(0)
        shown = window(renderer)
        shown.SetAlphaBitPlanes(1)
        ours = dgtk.truth(renderer, "color", size=SIZE)["color"].astype(int)
        renderer.ResetCameraClippingRange()
        away = numpy.abs(ours - drawn(shown).astype(int))
        self.assertLess(away.mean(), 0.3)

    def test_textures_by_their_filter(self):
        for interpolate, mipmap in ((0, 0), (1, 0), (1, 1)):
            with self.subTest(interpolate=interpolate, mipmap=mipmap):
                renderer = scenes.earth()
                for actor in renderer.GetActors():
                    actor.GetTexture().SetInterpolate(interpolate)
                    actor.GetTexture().SetMipmap(mipmap)
                self.compare(renderer, mean=0.6, unlike=0.05)


class Windows(unittest.TestCase):
    def test_a_renderer_has_its_viewports_size(self):
        left, right = scenes.transforms(), scenes.blocks()
        left.SetViewport(0, 0, 0.4, 1)
        right.SetViewport(0.4, 0, 1, 1)
        shown = window(left, right, size=(200, 90))
        picture = drawn(shown)
        for renderer, columns in ((left, slice(0, 80)), (right, slice(80, 200))):
            ours = dgtk.truth(renderer, "color")["color"]
            self.assertEqual(ours.shape, (90, columns.stop - columns.start, 3))
            self.assertLess(numpy.abs(ours.astype(int) - picture[:, columns]).mean(), 0.3)
        with self.assertRaisesRegex(ValueError, "2 renderers"):
            dgtk.truth(shown, "depth")
        right.RemoveAllViewProps()
        self.assertEqual(dgtk.truth(shown, "depth")["depth"].shape, (90, 80))

    def test_near_and_far_are_those_of_the_picture(self):
        renderer = scenes.quad_sphere()
        shown = window(renderer)
        shown.Render()
        renderer.GetActiveCamera().SetClippingRange(renderer.GetActiveCamera().GetDistance() - 0.3, 100)
        picture = drawn(shown)
        ours = dgtk.truth(renderer, ["color", "depth"])
        self.assertLess(numpy.abs(ours["color"].astype(int) - picture).mean(), 0.1)
        self.assertGreaterEqual(ours["depth"].min(), renderer.GetActiveCamera().GetClippingRange()[0])


if __name__ == "__main__":
    unittest.main()
