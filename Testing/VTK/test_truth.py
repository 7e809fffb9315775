# SPDX-License-Identifier: BSD-3-Clause
"""dgtk.truth() of scenes of VTK against rays in NumPy; what VTK's own window draws; what is refused."""
import contextlib
import io
import os
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
import warnings

import numpy

sys.path.insert(0, os.path.join(os.environ["DGTK_BUILD"], "lib", "python3", "dist-packages"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import dgtk
import vtk
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

import judge
import scenes

SIZE = (60, 45)


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



class Pairs(unittest.TestCase):
    """Two snapshots of the same actors: the camera, an actor and points of its data move between them."""
    SIZE = (48, 36)

    def follow(self, renderer, move):
        first, right = dgtk.snapshot(renderer, self.SIZE), judge.Judge(renderer, *self.SIZE)
        move()
        second, moved = dgtk.snapshot(renderer, self.SIZE), judge.Judge(renderer, *self.SIZE)
        xy, classes = dgtk.correspond(first, second)
        places, expected = right.follow(moved)
        xy, classes, sure = xy.reshape(-1, 2), classes.ravel(), ~right.near_edge
        self.assertGreater((sure & (expected > 0)).sum(), 100)
        numpy.testing.assert_allclose(xy[sure], places[sure], atol=1e-6)
        numpy.testing.assert_array_equal(classes[sure], expected[sure])
        return set(expected[sure])

    def actors(self):
        ball = vtk.vtkSphereSource()
        ball.SetThetaResolution(12)
        ball.SetPhiResolution(10)
        ball.Update()
        data = vtk.vtkPolyData()
        data.DeepCopy(ball.GetOutput())
        wall = vtk.vtkPlaneSource()
        wall.SetOrigin(-1.5, -1, -1)
        wall.SetPoint1(1.5, -1, -1)
        wall.SetPoint2(-1.5, 1, -1)
        wall.SetResolution(3, 2)
        triangles = vtk.vtkTriangleFilter()
        triangles.SetInputConnection(wall.GetOutputPort())
        triangles.Update()
        return scenes.actor(data), scenes.actor(triangles.GetOutput())

    def test_a_camera_moves(self):
        renderer = scenes.renderer(*self.actors(), eye=(0.2, 0.3, 3))
        classes = self.follow(renderer, lambda: renderer.GetActiveCamera().SetPosition(1.4, 0.8, 2.5))
        self.assertLessEqual({0, 1, 2, 3}, classes)

    def test_an_actor_moves(self):
        ball, wall = self.actors()
        renderer = scenes.renderer(ball, wall, eye=(0.2, 0.3, 3))

        def move():
            ball.RotateY(70)
            ball.SetScale(1.1, 0.8, 1)
            wall.SetPosition(0.6, 0, -0.5)
        self.assertLessEqual({0, 1, 2, 3, 4}, self.follow(renderer, move))

    def test_points_meet_and_part(self):
        """Triangles without area are none, but the others keep their numbers."""
        ball, wall = self.actors()
        points = wall.GetMapper().GetInput().GetPoints()
        apart, neighbour = points.GetPoint(0), points.GetPoint(1)

        def put(place):
            points.SetPoint(0, *place)
            points.Modified()
        put(neighbour)
        renderer = scenes.renderer(wall, ball, eye=(0.2, 0.3, 3))
        together = dgtk.snapshot(renderer, self.SIZE)
        self.follow(renderer, lambda: put(apart))
        shown = dgtk.truth(renderer, ["objects", "cells"], size=self.SIZE)
        _, classes = dgtk.correspond(dgtk.snapshot(renderer, self.SIZE), together)
        gone = (shown["objects"] == 1) & (shown["cells"] == 0)
        self.assertGreater(gone.sum(), 10)
        self.assertEqual(set(classes[gone]), {0})
        self.assertEqual(set(classes[(shown["objects"] == 1) & ~gone]), {1})

    def test_points_of_the_data_move(self):
        ball, wall = self.actors()
        renderer = scenes.renderer(ball, wall, eye=(0.2, 0.3, 3))

        def move():
            data = ball.GetMapper().GetInput()
            for i in range(data.GetNumberOfPoints()):
                x, y, z = data.GetPoint(i)
                data.GetPoints().SetPoint(i, x + 0.3 * y * y, y - 0.2 * x, z + 0.1 * x)
            data.GetPoints().Modified()
        self.follow(renderer, move)

    def test_what_the_second_view_is_not_shown_is_nowhere(self):
        ball, wall = self.actors()
        renderer = scenes.renderer(ball, wall, eye=(0.2, 0.3, 3))
        first = dgtk.snapshot(renderer, self.SIZE)
        plane = vtk.vtkPlane()
        plane.SetNormal(1, 0, 0)
        ball.GetMapper().AddClippingPlane(plane)
        second = dgtk.snapshot(renderer, self.SIZE)
        objects, x = (dgtk.render(first, name) for name in ("objects", "position"))
        xy, classes = dgtk.correspond(first, second)
        on_ball = objects == 1
        away = numpy.abs(x[..., 0]) > 1e-6
        numpy.testing.assert_array_equal(classes[on_ball & away], numpy.where(x[on_ball & away][:, 0] > 0, 1, 0))
        back, seen = dgtk.correspond(second, first)
        centres = numpy.stack(numpy.meshgrid(numpy.arange(self.SIZE[0]) + 0.5, numpy.arange(self.SIZE[1]) + 0.5), -1)
        cut = dgtk.render(second, "objects") == 1
        self.assertGreater(cut.sum(), 50)
        numpy.testing.assert_allclose(back[cut & (seen == 1)], centres[cut & (seen == 1)], atol=1e-9)
        ball.VisibilityOff()
        self.assertEqual(set(dgtk.correspond(first, dgtk.snapshot(renderer, self.SIZE))[1][on_ball]), {0})

    def test_other_cells_are_refused(self):
        ball, wall = self.actors()
        renderer = scenes.renderer(ball, wall, eye=(0.2, 0.3, 3))
        first = dgtk.snapshot(renderer, self.SIZE)
        ball.GetMapper().SetInputDataObject(wall.GetMapper().GetInput())
        with self.assertRaisesRegex(ValueError, "actor-1 has other cells in the second view"):
            dgtk.correspond(first, dgtk.snapshot(renderer, self.SIZE))
        with self.assertRaisesRegex(ValueError, "two snapshots"):
            dgtk.correspond(first, renderer)


class Snapshots(unittest.TestCase):
    def test_what_changes_afterwards_does_not_count(self):
        renderer = scenes.transforms()
        shot = dgtk.snapshot(renderer, SIZE)
        before = dgtk.render(shot, ["depth", "color", "objects"])
        for actor in renderer.GetActors():
            actor.SetPosition(3, 3, 3)
            actor.GetProperty().SetColor(0, 1, 0)
            actor.GetMapper().GetInputAlgorithm().SetCenter(1, 1, 1)
        renderer.GetActiveCamera().SetPosition(9, 9, 9)
        renderer.RemoveAllViewProps()
        for name, array in dgtk.render(shot, ["depth", "color", "objects"]).items():
            numpy.testing.assert_array_equal(array, before[name])

    def test_ids_are_in_the_order_of_the_props(self):
        renderer = scenes.robot_arm()
        renderer.GetActors()
        truth = dgtk.truth(renderer, ["objects"], size=SIZE)
        self.assertEqual([p is q for p, (q, _) in zip(truth.props, judge.visible_actors(renderer))], [True] * 5)
        self.assertEqual(set(numpy.unique(truth["objects"])), {0, 1, 2, 3, 4, 5})

    def test_visible_cells_count_pixels(self):
        renderer = scenes.blocks()
        truth = dgtk.truth(renderer, ["objects", "cells"], size=SIZE)
        counted = dgtk.visible_cells(renderer, size=SIZE)
        self.assertEqual(len(counted), 1)
        cells = truth["cells"][truth["objects"] == 1]
        numpy.testing.assert_array_equal(counted[0], numpy.bincount(cells, minlength=len(counted[0])))
        self.assertEqual(counted[0].dtype, numpy.uint32)

    def test_every_cell_of_the_input_is_counted(self):
        points = vtk.vtkPoints()
        for x, y in ((0, 0), (1, 0), (0, 1), (1, 1)):
            points.InsertNextPoint(x, y, 0)
        data = vtk.vtkPolyData()
        data.SetPoints(points)
        data.Allocate()
        for corners in ((0, 1, 2), (1, 1, 2), (3, 3, 3)):  # the last two have no area
            data.InsertNextCell(vtk.VTK_TRIANGLE, 3, corners)
        cells = dgtk.visible_cells(scenes.renderer(scenes.actor(data), eye=(0.5, 0.5, 3), target=(0.5, 0.5, 0)), size=SIZE)
        self.assertEqual([len(one) for one in cells], [3])
        self.assertGreater(cells[0][0], 10)
        self.assertEqual(list(cells[0][1:]), [0, 0])
        glyphs = scenes.glyph_mapper()
        mapper = next(iter(glyphs.GetActors())).GetMapper()
        self.assertEqual(len(dgtk.visible_cells(glyphs, size=SIZE)[0]), mapper.GetInput().GetNumberOfPoints())

    def test_a_saved_snapshot_is_the_same_scene(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, make in scenes.ALL.items():
                with self.subTest(scene=name):
                    shot = dgtk.snapshot(make(), SIZE)
                    self.assertEqual((len(shot.cameras), len(shot.objects), list(shot.frames)), (1, shot.GetNumberOfObjects(), [0]))
                    path = os.path.join(folder, name, "scene.json")
                    os.mkdir(os.path.dirname(path))
                    shot.save(path)
                    again = dgtk.load(path)
                    for layer in ("objects", "depth", "color"):
                        one, other = dgtk.render(shot, layer), dgtk.render(again, layer)
                        if layer == "color":
                            self.assertLess(numpy.abs(one.astype(int) - other).mean(), 1)
                        else:
                            numpy.testing.assert_allclose(one, other, rtol=1e-12)

    def test_a_ball_throws_a_shadow(self):
        """From straight above onto a plane: a disc of its radius."""
        ball, floor, light = vtk.vtkSphereSource(), vtk.vtkPlaneSource(), vtk.vtkLight()
        ball.SetCenter(0, 0, 2)
        ball.SetThetaResolution(60)
        ball.SetPhiResolution(60)
        floor.SetOrigin(-2, -2, 0)
        floor.SetPoint1(2, -2, 0)
        floor.SetPoint2(-2, 2, 0)
        light.SetLightTypeToSceneLight()
        light.SetPosition(0, 0, 9)
        renderer = scenes.renderer(scenes.actor(ball), scenes.actor(floor), eye=(6, 0, 3))
        renderer.AddLight(light)
        renderer.UseShadowsOn()
        truth = dgtk.truth(renderer, ["objects", "position", "color"], size=SIZE)
        seen = truth["objects"] == 2
        away, bright = numpy.linalg.norm(truth["position"][seen][:, :2], axis=-1), truth["color"][seen].max(-1)
        self.assertGreater((away < 0.48).sum(), 10)
        self.assertEqual(bright[away < 0.48].max(), 0)
        self.assertEqual(bright[away > 0.5].min(), 255)

    def test_colours_that_need_more_light_than_files_have(self):
        renderer = scenes.contour()
        for actor in renderer.GetActors():
            actor.GetProperty().LightingOff()
            actor.GetProperty().SetAmbient(0.5)
        shot = dgtk.snapshot(renderer, SIZE)
        with tempfile.TemporaryDirectory() as folder:
            shot.save(folder + "/scene.json")
            again = dgtk.render(dgtk.load(folder + "/scene.json"), "color").astype(int)
        self.assertLessEqual(numpy.abs(again - dgtk.render(shot, "color")).max(), 1)


class Datasets(unittest.TestCase):
    """generate() of a snapshot: the dataset of the scene that save() writes, packed, wherever that was."""

    def files(self, folder):
        found = {}
        for place, _, names in os.walk(folder):
            for name in names:
                with open(os.path.join(place, name), "rb") as file:
                    found[os.path.relpath(os.path.join(place, name), folder)] = file.read()
        return found

    def test_a_dataset_of_a_snapshot(self):
        request = {"layers": ["color", "depth", "objects", "normal", "boxes"], "samples": 2}
        for name in ("earth", "blocks", "cut_open", "glyph_mapper"):
            with self.subTest(scene=name), tempfile.TemporaryDirectory() as folder:
                renderer = scenes.ALL[name]()
                shot = dgtk.snapshot(renderer, SIZE)
                done = []
                manifest = dgtk.generate(shot, folder + "/out", progress=lambda *now: done.append(now), **request)
                self.assertEqual(done[-1], (1, 1))
                os.mkdir(folder + "/elsewhere")
                shot.save(folder + "/elsewhere/scene.json")
                self.assertEqual(manifest, dgtk.generate(folder + "/elsewhere/scene.json", folder + "/saved", pack=True, **request))
                self.assertEqual(self.files(folder + "/out"), self.files(folder + "/saved"))
                self.assertEqual(sorted(os.listdir(folder)), ["elsewhere", "out", "saved"])
                verified = subprocess.run([os.environ["DGTK"], "verify", folder + "/out"], capture_output=True, text=True, timeout=120)
                self.assertEqual(verified.returncode, 0, verified.stdout + verified.stderr)
                depth = numpy.load(folder + "/out/camera/depth/000000.npy")
                numpy.testing.assert_allclose(depth, dgtk.truth(renderer, "depth", size=SIZE)["depth"], rtol=1e-9)

    def test_an_interrupted_run_is_completed(self):
        class Stop(Exception):
            pass

        def stop(*_):
            raise Stop
        with tempfile.TemporaryDirectory() as folder:
            shot = dgtk.snapshot(scenes.solids(), SIZE)
            with self.assertRaises(Stop):
                dgtk.generate(shot, folder + "/out", layers="depth", progress=stop)
            manifest = dgtk.generate(shot, folder + "/out", layers="depth", resume=True)
            self.assertEqual(manifest, dgtk.generate(shot, folder + "/again", layers="depth"))

    def test_what_a_snapshot_cannot_be(self):
        with tempfile.TemporaryDirectory() as folder:
            shot = dgtk.snapshot(scenes.solids(), SIZE)
            for wrong, words in (({"pack": False}, "pack: a snapshot has no files of its own"), ({"layers": "cells"}, "'cells'"),
                                 ({"scene": dgtk.Snapshot()}, "no renderer was taken"), ({"frames": 3}, "frames 0 to 0")):
                with self.subTest(wrong), self.assertRaisesRegex(ValueError, words):
                    dgtk.generate(**{"scene": shot, "folder": folder + "/out", **wrong})
            self.assertEqual(os.listdir(folder), [])


class Known(unittest.TestCase):
    """What did not change is known again, what did is not, whether VTK was told or not."""

    def test_writing_without_telling_vtk_is_seen(self):
        sphere = vtk.vtkSphereSource()
        sphere.SetThetaResolution(30)
        sphere.Update()
        data = vtk.vtkPolyData()
        data.DeepCopy(sphere.GetOutput())
        renderer = scenes.renderer(scenes.actor(data), eye=(0, 0, 4))
        points = vtk_to_numpy(data.GetPoints().GetData())
        shot = dgtk.snapshot(renderer, SIZE)
        before = dgtk.truth(renderer, ["depth", "cells"], size=SIZE)
        counted = dgtk.visible_cells(renderer, size=SIZE)[0]
        points *= 0.5
        after = dgtk.truth(renderer, ["depth", "cells"], size=SIZE)
        self.assertLess(numpy.isfinite(after["depth"]).sum(), 0.5 * numpy.isfinite(before["depth"]).sum())
        self.assertLess(dgtk.visible_cells(renderer, size=SIZE)[0].sum(), 0.5 * counted.sum())
        numpy.testing.assert_array_equal(dgtk.render(shot, "depth"), before["depth"])  # which does not change
        points *= 2
        numpy.testing.assert_array_equal(dgtk.truth(renderer, "depth", size=SIZE)["depth"], before["depth"])

    def test_every_setting_counts(self):
        quad = vtk.vtkPlaneSource()
        made = scenes.actor(quad, color=(0.5, 0.5, 0.5))
        made.SetTexture(scenes.picture())
        renderer = scenes.renderer(made, eye=(0, 0, 3))
        texels = vtk_to_numpy(made.GetTexture().GetInput().GetPointData().GetScalars())

        heights = vtk.vtkImageData()
        heights.SetDimensions(4, 4, 1)
        heights.GetPointData().SetScalars(numpy_to_vtk(numpy.arange(16.0), deep=1))
        mapped, table, turn = vtk.vtkTexture(), vtk.vtkLookupTable(), vtk.vtkTransform()
        mapped.SetInputData(heights)
        table.SetRange(0, 15)
        table.Build()
        mapped.SetLookupTable(table)
        mapped.SetTransform(turn)

        def darken():
            texels[:] //= 2

        def look():
            truth = dgtk.truth(renderer, ["color", "cells"], size=SIZE)
            return numpy.dstack([truth["color"], truth["cells"]])
        seen = look()
        for change in (lambda: made.GetProperty().SetColor(0.9, 0.2, 0.1), lambda: made.GetProperty().SetAmbient(0.4), darken,
                       lambda: made.GetTexture().InterpolateOff(), lambda: made.SetTexture(mapped), lambda: [table.SetTableValue(i, 1, 1, 1, 1) for i in range(120, 256)],
                       lambda: turn.Scale(2, 1, 1), lambda: made.SetTexture(None), lambda: quad.SetResolution(2, 3),
                       lambda: made.SetPosition(0.3, 0, 0), lambda: renderer.SetBackground(0.1, 0.2, 0.3)):
            change()
            now = look()
            self.assertTrue((now != seen).any())
            seen = now


class Refused(unittest.TestCase):
    def refused(self, prop, words):
        ball = scenes.actor(vtk.vtkSphereSource())
        renderer = scenes.renderer(ball, prop, eye=(0, 0, 5))
        with self.assertRaisesRegex(ValueError, words):
            dgtk.truth(renderer, "depth", size=SIZE)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            truth = dgtk.truth(renderer, ["objects"], size=SIZE, unsupported="skip")
        self.assertRegex(" ".join(str(one.message) for one in told), words)
        self.assertIs(truth.props[0], ball)
        return truth

    def test_what_is_no_surface(self):
        line = vtk.vtkLineSource()
        self.assertEqual(len(self.refused(scenes.actor(line), "actor-2: lines of its data").props), 1)
        points = vtk.vtkPointSource()
        self.refused(scenes.actor(points), "actor-2: points of its data")
        wire = scenes.actor(vtk.vtkCubeSource())
        wire.GetProperty().SetRepresentationToWireframe()
        self.refused(wire, "drawn as Wireframe")
        self.refused(vtk.vtkTextActor(), r"vtkTextActor \(prop 2\)")
        self.refused(vtk.vtkVolume(), r"vtkVolume \(prop 2\)")
        self.refused(vtk.vtkAxesActor(), r"vtkAxesActor \(prop 2\)")
        self.refused(vtk.vtkCubeAxesActor(), r"vtkCubeAxesActor \(prop 2\)")

    def test_what_cannot_be_honoured(self):
        edges = scenes.actor(vtk.vtkCubeSource())
        edges.GetProperty().EdgeVisibilityOn()
        self.assertEqual(len(self.refused(edges, "actor-2: visible edges").props), 2)
        back = scenes.actor(vtk.vtkCubeSource())
        back.SetBackfaceProperty(vtk.vtkProperty())
        self.refused(back, "back faces")
        squeezed = scenes.actor(vtk.vtkCubeSource())
        matrix = vtk.vtkMatrix4x4()
        matrix.SetElement(3, 0, 0.2)
        squeezed.SetUserMatrix(matrix)
        self.refused(squeezed, "projective matrix")

    def test_pictures_that_cannot_be_honoured(self):
        for words, change in (("a gradient background", lambda r: r.GradientBackgroundOn()), ("image based lighting", lambda r: r.UseImageBasedLightingOn()),
                              ("ambient occlusion of screen space", lambda r: r.UseSSAOOn()),
                              ("a render pass", lambda r: r.SetPass(vtk.vtkSSAOPass())), ("a renderer that does not draw", lambda r: r.DrawOff())):
            renderer = scenes.quad_sphere()
            change(renderer)
            with self.assertRaisesRegex(ValueError, words):
                dgtk.truth(renderer, "color", size=SIZE)

    def test_data_that_do_not_hold_together(self):
        def view(change):
            data = vtk.vtkPolyData()
            points = vtk.vtkPoints()
            for x, y in ((0, 0), (1, 0), (0, 1)):
                points.InsertNextPoint(x, y, 0)
            data.SetPoints(points)
            data.Allocate()
            data.InsertNextCell(vtk.VTK_TRIANGLE, 3, (0, 1, 2))
            change(data)
            return scenes.renderer(scenes.actor(data), eye=(0.3, 0.3, 3), target=(0.3, 0.3, 0))
        cells = vtk.vtkCellArray()
        cells.InsertNextCell(3, (0, 1, 7))
        for change in (lambda data: data.SetPolys(cells), lambda data: data.SetPoints(None)):
            with self.assertRaisesRegex(ValueError, "cell 0 has a point that does not exist"):
                dgtk.truth(view(change), "depth", size=SIZE)
        few = vtk.vtkFloatArray()
        few.SetNumberOfTuples(2)
        few.Fill(0)
        with self.assertRaisesRegex(ValueError, "scalars are fewer"):
            dgtk.truth(view(lambda data: data.GetPointData().SetScalars(few)), "depth", size=SIZE)
        nowhere = dgtk.truth(view(lambda data: data.GetPoints().SetPoint(1, float("nan"), 0, 0)), "objects", size=SIZE)
        self.assertEqual(nowhere["objects"].max(), 0)
        self.assertEqual(dgtk.truth(view(lambda data: None), "objects", size=SIZE)["objects"].max(), 1)

    def test_cameras(self):
        renderer = scenes.parallel()
        renderer.GetActiveCamera().SetViewShear(0.2, 0, 1)
        with self.assertRaisesRegex(ValueError, "VTK scene: its camera leans"):
            dgtk.snapshot(renderer, SIZE)
        mirrored = scenes.transforms()
        mirror = vtk.vtkTransform()
        mirror.Scale(-1, 1, 1)
        mirrored.GetActiveCamera().SetUserTransform(mirror)
        with self.assertRaisesRegex(ValueError, "its camera mirrors"):
            dgtk.snapshot(mirrored, SIZE)

    def test_what_is_no_view(self):
        for view in (None, 3, "renderer", object(), {}, vtk.vtkActor(), unittest.mock.Mock()):
            with self.assertRaises(ValueError):
                dgtk.truth(view, "depth")
        renderer = scenes.transforms()
        for size in ((0, 5), (-1, 4), (3.5, 4), (1 << 21, 1), ("a", 1), (4,), 7):
            with self.assertRaises((ValueError, TypeError, IndexError)):
                dgtk.truth(renderer, "depth", size=size)
        with self.assertRaisesRegex(ValueError, "refuse or skip"):
            dgtk.snapshot(renderer, unsupported="maybe")
        with self.assertRaises((ValueError, RuntimeError)):
            dgtk.truth(renderer, ["depht"], size=SIZE)
        shot = dgtk.snapshot(renderer, SIZE)
        for call in (lambda **more: dgtk.truth(shot, "cells", **more), lambda **more: dgtk.visible_cells(shot, **more)):
            for name, value in (("size", SIZE), ("unsupported", "skip"), ("unsupported", "maybe")):
                with self.assertRaisesRegex(ValueError, rf"\A{name}: expected none beside a snapshot, found "):
                    call(**{name: value})
            call(size=None, unsupported="refuse")
        with self.assertRaisesRegex(ValueError, r"\Anonsense: expected no option of render\(\) beside cells alone, found 3\Z"):
            dgtk.truth(shot, "cells", nonsense=3)

    def test_an_empty_renderer(self):
        truth = dgtk.truth(vtk.vtkRenderer(), ["objects", "depth", "cells", "color"], size=(4, 3))
        self.assertEqual((truth["objects"].max(), truth["cells"].max(), len(truth.props)), (0, -1, 0))


class Guide(unittest.TestCase):
    def test_the_page_runs_as_it_stands(self):
        with open(os.path.join(os.environ["DGTK_SOURCE"], "Documentation", "UserGuide", "vtk.md"), encoding="utf-8") as file:
            blocks = re.findall(r"^```python\n(.*?)^```$", file.read(), re.MULTILINE | re.DOTALL)
        self.assertGreater(len(blocks), 3)
        said = io.StringIO()
        with contextlib.redirect_stdout(said), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            exec("\n".join(blocks), {})  # pylint: disable=exec-used
        self.assertIn("(240, 320) 3 True", said.getvalue())
        self.assertIn("vtkTextActor (prop 2)", said.getvalue())
        self.assertIn("pixels are seen again\n(0.0, 1.0)", said.getvalue())


if __name__ == "__main__":
    unittest.main()
