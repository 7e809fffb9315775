# SPDX-License-Identifier: BSD-3-Clause
"""Colours of dgtk.truth() beside what vtkRenderWindow draws of the same renderer; windows, viewports and sizes."""
import functools
import os
import sys
import tempfile
import unittest

import numpy

sys.path.insert(0, os.path.join(os.environ["DGTK_BUILD"], "lib", "python3", "dist-packages"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import dgtk
import vtk
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

import random_scenes
import scenes
from window_grabs import SIZE, drawn, window


class Colours(unittest.TestCase):
    def compare(self, renderer, mean=0.3, unlike=0.002, least=0.02):
        shown = window(renderer)
        ours = dgtk.truth(renderer, "color", size=SIZE)["color"].astype(int)
        if renderer.IsActiveCameraCreated():
            renderer.ResetCameraClippingRange()
        theirs = drawn(shown).astype(int)
        away = numpy.abs(ours - theirs)
        self.assertGreaterEqual((theirs.max(-1) > 20).mean(), least)
        self.assertLess(away.mean(), mean)
        self.assertLess((away.max(-1) > 2).mean(), unlike)

    def test_every_scene(self):
        for name, make in scenes.ALL.items():
            if name != "star":  # VTK fills what is outside of polygons that are not convex, and ignores its camera's aspect
                with self.subTest(scene=name):
                    self.compare(make())

    def test_random_scenes(self):
        refused, seeds = 0, 60 if os.environ.get("DGTK_TEST_WHOLE") else 24
        for seed in range(seeds):
            with self.subTest(seed=seed):
                renderer = random_scenes.make(seed)
                try:
                    self.compare(renderer, unlike=0.01, least=0)
                except RuntimeError as error:
                    self.assertIn("a texture beside scalars that are interpolated", str(error))
                    refused += 1
        self.assertLess(refused, seeds // 6)

    def test_lights_of_every_kind(self):
        turn = vtk.vtkTransform()
        turn.RotateY(25)
        for kind, moved in (("Headlight", False), ("Headlight", True), ("CameraLight", False), ("SceneLight", False), ("SceneLight", True)):
            for positional in (False, True):
                with self.subTest(kind=kind, moved=moved, positional=positional):
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
                    light.SetTransformMatrix(turn.GetMatrix() if moved else None)
                    renderer.AddLight(light)
                    other = vtk.vtkLight()
                    other.SetLightTypeToSceneLight()
                    other.SetPosition(-3, 2, -1)
                    other.SetIntensity(0.4)
                    renderer.AddLight(other)
                    self.compare(renderer)

    def test_a_headlight_that_does_not_follow_the_camera(self):
        renderer = scenes.quad_sphere()
        renderer.AutomaticLightCreationOff()
        renderer.LightFollowCameraOff()
        for kind, place in (("Headlight", (3, 1.5, -1.2)), ("SceneLight", (-3, 2, -1))):
            light = vtk.vtkLight()
            getattr(light, "SetLightTypeTo" + kind)()
            light.SetPosition(*place)
            renderer.AddLight(light)
        self.compare(renderer)

    def test_a_headlight_alone_is_in_the_camera(self):
        turned = vtk.vtkTransform()
        turned.RotateY(25)
        for follows, matrix in ((False, None), (False, turned.GetMatrix()), (True, turned.GetMatrix())):
            with self.subTest(follows=follows, moved=matrix is not None):
                renderer = scenes.quad_sphere()
                renderer.AutomaticLightCreationOff()
                renderer.SetLightFollowCamera(follows)
                light = vtk.vtkLight()
                light.SetLightTypeToHeadlight()
                light.SetPosition(3, 1.5, -1.2)
                light.SetTransformMatrix(matrix)
                renderer.AddLight(light)
                self.compare(renderer)

    def test_textures_of_one_row_or_layer(self):
        texels = numpy.uint8([[250, 20, 20], [20, 250, 20], [20, 20, 250], [250, 250, 20]])
        for sides in ((4, 1, 1), (1, 4, 1), (1, 1, 4), (1, 2, 2), (2, 1, 2), (2, 2, 1)):
            with self.subTest(sides=sides):
                image = vtk.vtkImageData()
                image.SetDimensions(*sides)
                image.GetPointData().SetScalars(numpy_to_vtk(texels, deep=1))
                texture = vtk.vtkTexture()
                texture.SetInputData(image)
                made = scenes.actor(vtk.vtkPlaneSource())
                made.SetTexture(texture)
                made.GetProperty().LightingOff()
                self.compare(scenes.renderer(made, eye=(0, 0, 2.2)), unlike=0.01)

    def test_a_texture_that_does_not_repeat(self):
        """Its border goes on: in its colours, and in its holes, which are exact ground truth."""
        texels = numpy.full((4, 4, 4), 255, numpy.uint8)
        texels[..., 0] = 60 * numpy.arange(4)
        texels[1:, :2, 3] = 0
        image = vtk.vtkImageData()
        image.SetDimensions(4, 4, 1)
        image.GetPointData().SetScalars(numpy_to_vtk(texels.reshape(-1, 4), deep=1))
        wall = vtk.vtkPlaneSource()
        wall.Update()
        data = wall.GetOutput()
        data.GetPointData().SetTCoords(numpy_to_vtk(3 * vtk_to_numpy(data.GetPointData().GetTCoords()) - 1, deep=1))
        shown = {}
        for wrap in (vtk.vtkTexture.Repeat, vtk.vtkTexture.ClampToEdge, vtk.vtkTexture.MirroredRepeat):
            texture = vtk.vtkTexture()
            texture.SetInputData(image)
            texture.SetWrap(wrap)
            made = scenes.actor(data)
            made.SetTexture(texture)
            made.GetProperty().LightingOff()
            renderer = scenes.renderer(made, eye=(0, 0, 2.2))
            self.compare(renderer, unlike=0.01)
            shot = dgtk.snapshot(renderer, SIZE)
            exact = dgtk.render(shot, ["objects", "color"])
            shown[wrap] = (exact["objects"] > 0).tobytes()
            drawn_by_opengl = dgtk.render(shot, ["objects", "color"], visibility="raster", renderer="vtk")
            self.assertLess((exact["objects"] != drawn_by_opengl["objects"]).mean(), 0.001)
            self.assertLess(numpy.abs(exact["color"].astype(int) - drawn_by_opengl["color"]).mean(), 3)
            with tempfile.TemporaryDirectory() as folder:
                if wrap == vtk.vtkTexture.MirroredRepeat:
                    with self.assertRaisesRegex(ValueError, "actor-1 has a texture that does not repeat, which its files cannot say"):
                        shot.save(folder + "/scene.json")
                    self.assertEqual(os.listdir(folder), [])
                else:
                    shot.save(folder + "/scene.json")
                    saved = dgtk.render(dgtk.load(folder + "/scene.json"), ["objects"])
                    self.assertTrue((saved["objects"] == exact["objects"]).all(), wrap)
        self.assertEqual(len(set(shown.values())), 3)

    def test_smooth_surfaces_that_are_cut(self):
        cone = vtk.vtkConeSource()
        cone.SetResolution(5)
        smooth = vtk.vtkPolyDataNormals()
        smooth.SetInputConnection(cone.GetOutputPort())
        smooth.SplittingOff()
        made = scenes.actor(smooth)
        made.RotateY(40)
        plane = vtk.vtkPlane()
        plane.SetOrigin(0.05, 0, 0)
        plane.SetNormal(1, 0.3, 0.2)
        made.GetMapper().AddClippingPlane(plane)
        self.compare(scenes.renderer(made, eye=(0.7, 0.5, 1.5)), mean=0.01)

    def physical(self, change):
        sphere = vtk.vtkTexturedSphereSource()
        sphere.SetThetaResolution(40)
        sphere.SetPhiResolution(30)
        made = scenes.actor(sphere, color=(0.7, 0.4, 0.2))
        made.GetProperty().SetInterpolationToPBR()
        change(made.GetProperty())
        renderer = scenes.renderer(made, eye=(0.4, 0.3, 2.2))
        renderer.AutomaticLightCreationOff()
        light = vtk.vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(2, 1, 1)
        light.SetIntensity(2)
        renderer.AddLight(light)
        return renderer

    def test_physically_based_surfaces(self):
        """Also where no light falls, which is dark without an environment."""
        for metallic, roughness in ((0, 0.5), (0.6, 0.35), (1, 0.6)):
            with self.subTest(metallic=metallic, roughness=roughness):
                def change(of):
                    of.SetMetallic(metallic)
                    of.SetRoughness(roughness)
                renderer = self.physical(change)
                truth = dgtk.truth(renderer, ["color", "objects"], size=SIZE)
                self.assertEqual(truth["color"][truth["objects"] == 1].min(), 0)
                self.compare(renderer, mean=1.5, unlike=0.4)  # VTK takes the power 2.2 for sRGB

    def test_their_scalars_and_a_light_in_the_eye(self):
        """Scalars' colours are linear; a head light alone is where the camera is."""
        for before in (False, True):
            with self.subTest(interpolated=before):
                renderer = scenes.contour()
                made = next(iter(renderer.GetActors()))
                made.GetProperty().SetInterpolationToPBR()
                made.GetProperty().SetRoughness(0.4)
                made.GetMapper().SetInterpolateScalarsBeforeMapping(before)
                self.compare(renderer, mean=1.7, unlike=0.5)
                renderer.AddActor(scenes.actor(vtk.vtkCubeSource()))
                with self.assertRaisesRegex(ValueError, "physically based surfaces beside others"):
                    dgtk.snapshot(renderer, SIZE)
        glyphs = scenes.glyph_mapper()
        next(iter(glyphs.GetActors())).GetProperty().SetInterpolationToPBR()
        self.compare(glyphs, mean=1.7, unlike=0.5)

    def test_their_textures(self):
        def picture(srgb, *channels):
            made = scenes.picture()
            texels = vtk_to_numpy(made.GetInput().GetPointData().GetScalars())
            for channel, value in channels:
                texels[:, channel] = value
            made.SetUseSRGBColorSpace(srgb)
            return made
        for name, change in (("albedo", lambda of: of.SetBaseColorTexture(picture(True))),
                             ("material", lambda of: (of.SetORMTexture(picture(False, (0, 255))), of.SetMetallic(1), of.SetRoughness(1))),
                             ("emissive", lambda of: of.SetEmissiveTexture(picture(True)))):
            with self.subTest(texture=name):
                self.compare(self.physical(change), mean=1.5, unlike=0.3)

    def bumpy(self, scale=1.0, tangents=True, change=lambda tangents, coordinates: None):
        """A wall with a picture of normals."""
        renderer = self.physical(lambda of: of.SetRoughness(0.5))
        made = next(iter(renderer.GetActors()))
        x = numpy.linspace(0, 6 * numpy.pi, 64)
        slopes = numpy.stack([numpy.tile(0.3 * numpy.sin(x), (64, 1)), numpy.tile(0.3 * numpy.cos(x)[:, None], (1, 64)), numpy.ones((64, 64))], -1)
        slopes /= numpy.linalg.norm(slopes, axis=-1, keepdims=True)
        image = vtk.vtkImageData()
        image.SetDimensions(64, 64, 1)
        image.GetPointData().SetScalars(numpy_to_vtk(numpy.round(127.5 + 127.5 * slopes).astype(numpy.uint8).reshape(-1, 3), deep=1))
        texture = vtk.vtkTexture()
        texture.SetInputData(image)
        texture.InterpolateOn()
        made.GetProperty().SetNormalTexture(texture)
        made.GetProperty().SetNormalScale(scale)
        made.RotateX(25)
        wall = vtk.vtkPlaneSource()
        wall.SetResolution(6, 5)
        triangles = vtk.vtkTriangleFilter()
        triangles.SetInputConnection(wall.GetOutputPort())
        along = vtk.vtkPolyDataTangents()
        along.SetInputConnection(triangles.GetOutputPort())
        along.Update()
        data = along.GetOutput()
        change(vtk_to_numpy(data.GetPointData().GetTangents()), vtk_to_numpy(data.GetPointData().GetTCoords()))
        if not tangents:
            data.GetPointData().SetTangents(None)
        made.GetMapper().SetInputDataObject(data)
        return renderer

    def test_their_normals(self):
        plain = dgtk.truth(self.bumpy(tangents=False), "color", size=SIZE)["color"].astype(int)  # VTK wants tangents
        for scale in (1, 0.4):
            with self.subTest(scale=scale):
                self.compare(self.bumpy(scale), mean=1.5, unlike=0.5)
                self.assertGreater(numpy.abs(dgtk.truth(self.bumpy(scale), "color", size=SIZE)["color"] - plain).mean(), 2)
        self.compare(self.bumpy(tangents=False), mean=1.5, unlike=0.5)
        def turn(tangents, _):
            tangents[:] = tangents[:, [1, 0, 2]]

        def mirror(_, coordinates):
            coordinates[:, 1] *= -1
        for change in (turn, mirror):
            with self.assertRaisesRegex(ValueError, "tangents that are not those of its texture coordinates"):
                dgtk.snapshot(self.bumpy(change=change), SIZE)

    def test_what_of_them_cannot_be_honoured(self):
        def picture(srgb=False, turn=None):
            made = scenes.picture()
            made.SetUseSRGBColorSpace(srgb)
            made.SetTransform(turn)
            return made
        for words, change in (("a coat", lambda of: of.SetCoatStrength(0.5)), ("anisotropy", lambda of: of.SetAnisotropy(0.5)),
                              ("anisotropyTex", lambda of: of.SetAnisotropyTexture(picture())),
                              ("occlusion in the texture materialTex", lambda of: of.SetORMTexture(picture())),
                              ("index of refraction", lambda of: of.SetBaseIOR(1.8)), ("an edge tint", lambda of: of.SetEdgeTint(1, 0.5, 0.5)),
                              ("an emissive factor", lambda of: (of.SetEmissiveTexture(picture(True)), of.SetEmissiveFactor(0.5, 0.5, 0.5))),
                              ("a transform of the texture albedoTex", lambda of: of.SetBaseColorTexture(picture(True, vtk.vtkTransform())))):
            with self.subTest(words), self.assertRaisesRegex(ValueError, words):
                dgtk.snapshot(self.physical(change), SIZE)

    def test_a_saved_one(self):
        def change(of):
            of.SetMetallic(0.3)
            of.SetRoughness(0.4)
            texture = scenes.picture()
            texture.SetUseSRGBColorSpace(True)
            of.SetBaseColorTexture(texture)
        for name, renderer in (("colours", self.physical(change)), ("normals", self.bumpy(0.4))):
            shot = dgtk.snapshot(renderer, SIZE)
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                shot.save(folder + "/scene.json")
                again = dgtk.render(dgtk.load(folder + "/scene.json"), "color").astype(int)
                self.assertLess(numpy.abs(again - dgtk.render(shot, "color")).mean(), 0.2)

    def test_without_lights(self):
        renderer = scenes.contour()
        off = vtk.vtkLight()
        off.SwitchOff()
        renderer.AddLight(off)
        self.compare(renderer)  # VTK makes one
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
        glyphs = scenes.glyph_mapper  # whose opacity VTK takes twice
        for make, opacities in ((scenes.transforms, (0.5, 0.5)), (scenes.transforms, (0, 1)), (scenes.transforms, (0.5, 0)), (scenes.transforms, (0, 0)),
                                (glyphs, (0.6,))):
            with self.subTest(opacities=opacities):
                renderer = make()
                renderer.SetBackground(0.2, 0.4, 0.6)
                for actor, opacity in zip(renderer.GetActors(), opacities):
                    actor.GetProperty().SetOpacity(opacity)
                renderer.SetUseDepthPeeling(True)
                renderer.SetMaximumNumberOfPeels(20)
                renderer.SetOcclusionRatio(0)
                shown = window(renderer)
                shown.SetAlphaBitPlanes(1)
                truth = dgtk.truth(renderer, ["color", "objects"], size=SIZE)
                renderer.ResetCameraClippingRange()
                away = numpy.abs(truth["color"].astype(int) - drawn(shown).astype(int))
                self.assertLess(away.mean(), 0.3)
                self.assertEqual(set(numpy.unique(truth["objects"])), set(range(len(opacities) + 1)))  # what cannot be seen is a surface

    def ball(self, change):
        sphere = vtk.vtkTexturedSphereSource()
        sphere.SetThetaResolution(20)
        sphere.SetPhiResolution(12)
        made = scenes.actor(sphere, color=(0.8, 0.5, 0.3))
        change(made)
        return scenes.renderer(made, eye=(0.6, 0.5, 2.2))

    def test_what_vtk_does_its_own_way(self):
        """A mirrored actor's normals, both cullings at once, light above 1 behind opacity, a colour of field data, sRGB."""
        def bright(actor):
            actor.GetProperty().SetAmbient(0.6)
            actor.GetProperty().SetOpacity(0.5)
            actor.GetProperty().BackfaceCullingOn()

        def cull(actor):
            actor.GetProperty().BackfaceCullingOn()
            actor.GetProperty().FrontfaceCullingOn()

        def texture(actor):
            actor.SetTexture(scenes.picture())
            actor.GetTexture().SetUseSRGBColorSpace(True)

        def field(actor):
            data = vtk.vtkPolyData()
            actor.GetMapper().Update()
            data.ShallowCopy(actor.GetMapper().GetInput())
            colors = numpy_to_vtk(numpy.array([[255, 0, 0], [40, 200, 90]], numpy.uint8), deep=1)
            colors.SetName("colors")
            data.GetFieldData().AddArray(colors)
            actor.GetMapper().SetInputDataObject(data)
            actor.GetMapper().SetScalarModeToUseFieldData()
            actor.GetMapper().SelectColorArray("colors")
            actor.GetMapper().SetFieldDataTupleId(1)
        for name, change in (("cull", cull), ("bright", bright), ("sRGB", texture), ("field", field)):
            with self.subTest(name):
                self.compare(self.ball(change), mean=0.6, unlike=0.05)
        for scale in ((-1, 1, 1), (-1, -0.7, -1)):
            with self.subTest(scale=scale):
                dark = scenes.ALL["quad_sphere"]()
                next(iter(dark.GetActors())).SetScale(*scale)
                dark.AddActor(scenes.actor(vtk.vtkPlaneSource()))
                self.compare(dark)

    def test_textures_that_cannot_be_honoured(self):
        def change(actor, **settings):
            actor.SetTexture(scenes.picture())
            for name, value in settings.items():
                getattr(actor.GetTexture(), "Set" + name)(value)

        def scalars(actor):
            change(actor)
            elevation = vtk.vtkElevationFilter()
            elevation.SetInputConnection(actor.GetMapper().GetInputConnection(0, 0))
            actor.GetMapper().SetInputConnection(elevation.GetOutputPort())
            actor.GetMapper().InterpolateScalarsBeforeMappingOn()

        def seeThrough(actor):
            change(actor, PremultipliedAlpha=True)
            texels = numpy.full((4, 4), 200, numpy.uint8)
            image = vtk.vtkImageData()
            image.SetDimensions(2, 2, 1)
            image.GetPointData().SetScalars(numpy_to_vtk(texels, deep=1))
            actor.GetTexture().SetInputData(image)

        def forced(actor):
            actor.GetProperty().SetOpacity(0.5)
            actor.ForceOpaqueOn()
        for words, make in (("a border", lambda a: change(a, Wrap=vtk.vtkTexture.ClampToBorder)),
                            ("multiplied by its alpha", seeThrough), ("interpolated before they are mapped", scalars), ("forced to be opaque", forced),
                            ("replaced shaders", lambda a: a.GetShaderProperty().AddFragmentShaderReplacement("//VTK::Light::Impl", True, "", False))):
            with self.subTest(words), self.assertRaisesRegex(ValueError, words):
                dgtk.snapshot(self.ball(make), SIZE)

    def test_what_changes_beside_the_data_is_seen(self):
        """What is known of a surface that was looked at does not hide what cannot be honoured since."""
        def turned(actor):
            tangents = vtk_to_numpy(actor.GetMapper().GetInput().GetPointData().GetTangents())
            tangents[:] = tangents[:, [1, 0, 2]]
        half = functools.partial(self.ball, lambda actor: actor.GetProperty().SetOpacity(0.5))
        for words, make, change in (("forced to be opaque", half, lambda a: a.ForceOpaqueOn()), ("tangents", self.bumpy, turned),
                                    ("replaced shaders", half, lambda a: a.GetShaderProperty().AddFragmentShaderReplacement("//VTK::Light::Impl", True, "", False))):
            renderer = make()
            before = dgtk.snapshot(renderer, SIZE)
            change(next(iter(renderer.GetActors())))
            with self.subTest(words), self.assertRaisesRegex(ValueError, words):
                dgtk.snapshot(renderer, SIZE)
            self.assertEqual(before.GetNumberOfProps(), 1)

    def test_textures_by_their_filter(self):
        colors = []
        for interpolate, mipmap in ((0, 0), (0, 1), (1, 0), (1, 1)):
            with self.subTest(interpolate=interpolate, mipmap=mipmap):
                renderer = scenes.earth()
                for actor in renderer.GetActors():
                    actor.GetTexture().SetInterpolate(interpolate)
                    actor.GetTexture().SetMipmap(mipmap)
                self.compare(renderer, mean=0.6, unlike=0.05)
                colors.append(dgtk.truth(renderer, "color", size=SIZE)["color"])
        numpy.testing.assert_array_equal(colors[0], colors[1])  # to VTK a mipmap that is not interpolated is none
        self.assertFalse(numpy.array_equal(colors[2], colors[3]))


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
