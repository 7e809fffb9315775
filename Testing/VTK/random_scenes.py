# SPDX-License-Identifier: BSD-3-Clause
"""Random renderers: shapes with and without normals, coordinates of textures and scalars, alone, as blocks or as glyphs, under mappers and
properties of many settings. What VTK 9.1 itself draws by chance, or not at all, is left out: flat shading and culling of what is mirrored,
blocks of which some have normals, or scalars that are interpolated before they are mapped (but see scenes.partly_mapped), colours that let
see what is behind."""
import random

import numpy
import vtk
from vtkmodules.util.numpy_support import numpy_to_vtk

import scenes

VTK_FLAT, VTK_PHONG = 0, 2
SHAPES = (vtk.vtkConeSource, vtk.vtkPlaneSource, vtk.vtkSphereSource, vtk.vtkCubeSource, vtk.vtkTexturedSphereSource, vtk.vtkDiskSource,
          vtk.vtkCylinderSource, vtk.vtkArrowSource, vtk.vtkSuperquadricSource)


class Chance(random.Random):
    def happens(self, probability):
        return self.random() < probability


def shape(chance, normals):
    source = chance.choice(SHAPES)()
    source.Update()
    data = vtk.vtkPolyData()
    data.DeepCopy(source.GetOutput())
    if not normals:
        data.GetPointData().SetNormals(None)
    elif data.GetPointData().GetNormals() is None:
        smooth = vtk.vtkPolyDataNormals()
        smooth.SetInputData(data)
        smooth.SplittingOff()
        smooth.Update()
        data = smooth.GetOutput()
    if chance.happens(0.3):
        data.GetPointData().SetTCoords(None)
    for attributes, count, probability in ((data.GetPointData(), data.GetNumberOfPoints(), 0.4), (data.GetCellData(), data.GetNumberOfCells(), 0.3)):
        if chance.happens(probability):
            numbers = numpy.random.RandomState(chance.randrange(1 << 30)).rand(count, 3)
            bytes_ = (255 * numbers[:, :chance.choice((1, 3))]).astype(numpy.uint8)
            attributes.SetScalars(numpy_to_vtk(bytes_ if chance.happens(0.3) else 3 * numbers[:, 0], deep=1))
    return data


def blocks(chance, shapes):
    parts = vtk.vtkMultiBlockDataSet()
    mapper = vtk.vtkCompositePolyDataMapper2()
    mapper.SetCompositeDataDisplayAttributes(vtk.vtkCompositeDataDisplayAttributes())
    for i, data in enumerate(shapes):
        place = vtk.vtkTransform()
        place.Translate(1.1 * i - 0.8, chance.uniform(-0.5, 0.5), chance.uniform(-0.5, 0.5))
        moved = vtk.vtkTransformPolyDataFilter()
        moved.SetInputData(data)
        moved.SetTransform(place)
        moved.Update()
        parts.SetBlock(i, moved.GetOutput())
    mapper.SetInputDataObject(parts)
    for i in range(len(shapes)):
        if chance.happens(0.25):
            mapper.SetBlockColor(i + 1, chance.random(), chance.random(), chance.random())
        if chance.happens(0.15):
            mapper.SetBlockVisibility(i + 1, False)
    return mapper


def glyphs(chance, shapes):
    count = chance.choice((3, 7))
    points = vtk.vtkPolyData()
    points.SetPoints(vtk.vtkPoints())
    for _ in range(count):
        points.GetPoints().InsertNextPoint(chance.uniform(-1.2, 1.2), chance.uniform(-0.9, 0.9), chance.uniform(-1, 1))
    which = numpy_to_vtk(numpy.arange(count) % len(shapes), deep=1)
    which.SetName("shape")
    points.GetPointData().AddArray(which)
    if chance.happens(0.5):
        points.GetPointData().SetScalars(numpy_to_vtk(numpy.linspace(0.1, 2.9, count), deep=1))
    mapper = vtk.vtkGlyph3DMapper()
    mapper.SetInputData(points)
    for i, data in enumerate(shapes):
        mapper.SetSourceData(i, data)
    mapper.SetSourceIndexing(len(shapes) > 1)
    mapper.SetSourceIndexArray("shape")
    mapper.SetRange(0, len(shapes))
    mapper.SetScaleFactor(chance.choice((0.4, 0.7)))
    mapper.SetScaling(chance.happens(0.5))
    return mapper


def actor(chance):
    normals = chance.happens(0.7)
    shapes = [shape(chance, normals) for _ in range(chance.choice((1, 1, 2, 3)))]
    make = chance.choice((blocks, glyphs)) if len(shapes) > 1 else chance.choice((None, None, glyphs))
    if make is None:
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputData(shapes[0])
    else:
        mapper = make(chance, shapes)
    mapper.SetScalarRange(0, 3)
    mapper.SetInterpolateScalarsBeforeMapping(make is not blocks and chance.happens(0.4))
    mapper.SetScalarVisibility(chance.happens(0.8))
    mapper.SetScalarMode(chance.choice((vtk.VTK_SCALAR_MODE_DEFAULT,) * 3 + (vtk.VTK_SCALAR_MODE_USE_CELL_DATA, vtk.VTK_SCALAR_MODE_USE_POINT_DATA)))
    if chance.happens(0.15):
        mapper.SetColorModeToMapScalars()
    made = scenes.actor(vtk.vtkPolyData(), vtk.vtkPolyDataMapper(), [chance.random() for _ in range(3)])
    made.SetMapper(mapper)
    if chance.happens(0.3):
        made.SetTexture(scenes.picture())
    of = made.GetProperty()
    of.SetInterpolation(VTK_FLAT if chance.happens(0.2) else VTK_PHONG)
    of.SetLighting(chance.happens(0.85))
    of.SetBackfaceCulling(chance.happens(0.15))
    of.SetFrontfaceCulling(chance.happens(0.15))
    if chance.happens(0.3):
        of.SetSpecular(0.6)
        of.SetSpecularPower(20)
        of.SetAmbient(0.2)
    if chance.happens(0.2):
        plane = vtk.vtkPlane()
        plane.SetNormal(1, 0.3, 0.2)
        plane.SetOrigin(chance.uniform(-0.3, 0.3), 0, 0)
        mapper.AddClippingPlane(plane)
    made.RotateX(chance.uniform(0, 60))
    made.RotateY(chance.uniform(0, 60))
    whole = not of.GetBackfaceCulling() and not of.GetFrontfaceCulling()
    if normals and whole and of.GetInterpolation() != VTK_FLAT and chance.happens(0.25):
        made.SetScale(1, -1, 1)
    return made


def make(seed):
    chance = Chance(seed)
    return scenes.renderer(*(actor(chance) for _ in range(chance.choice((1, 1, 2)))), eye=(0.7, 0.5, 4.5))
