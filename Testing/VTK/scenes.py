# SPDX-License-Identifier: BSD-3-Clause
"""Scenes as people who script VTK have them; each function returns a renderer that was never drawn."""
import math

import numpy
import vtk
from vtkmodules.util.numpy_support import numpy_to_vtk

ALL = {}


def scene(function):
    ALL[function.__name__] = function
    return function


def actor(source, mapper=None, color=None):
    mapper = mapper or vtk.vtkPolyDataMapper()
    if isinstance(source, vtk.vtkDataObject):
        mapper.SetInputDataObject(source)
    else:
        mapper.SetInputConnection(source.GetOutputPort())
    made = vtk.vtkActor()
    made.SetMapper(mapper)
    if color:
        made.GetProperty().SetColor(*color)
    return made


def renderer(*actors, eye=None, target=(0, 0, 0), up=(0, 1, 0)):
    made = vtk.vtkRenderer()
    for one in actors:
        made.AddViewProp(one)
    if eye:
        camera = made.GetActiveCamera()
        camera.SetPosition(*eye)
        camera.SetFocalPoint(*target)
        camera.SetViewUp(*up)
    return made


def picture(width=64, height=32):
    """A smooth picture with a hard edge."""
    x, y = numpy.meshgrid(numpy.arange(width), numpy.arange(height))
    rgb = numpy.stack([127 + 120 * numpy.sin(6.28 * x / width), 255 * y / height, numpy.where(x < width // 2, 60, 180)], -1)
    image = vtk.vtkImageData()
    image.SetDimensions(width, height, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(rgb.astype(numpy.uint8).reshape(-1, 3), deep=1))
    texture = vtk.vtkTexture()
    texture.SetInputData(image)
    texture.InterpolateOn()
    return texture


@scene
def contour():
    """A surface of equal value, coloured by another scalar through a lookup table: points."""
    quadric = vtk.vtkQuadric()
    quadric.SetCoefficients(0.5, 1, 0.2, 0, 0.1, 0, 0, 0.2, 0, 0)
    sample = vtk.vtkSampleFunction()
    sample.SetImplicitFunction(quadric)
    sample.SetSampleDimensions(18, 18, 18)
    surface = vtk.vtkContourFilter()
    surface.SetInputConnection(sample.GetOutputPort())
    surface.SetValue(0, 0.4)
    elevation = vtk.vtkElevationFilter()
    elevation.SetInputConnection(surface.GetOutputPort())
    elevation.SetLowPoint(-1, -1, -1)
    elevation.SetHighPoint(1, 1, 1)
    made = actor(elevation)
    made.GetMapper().SetScalarRange(0.2, 0.8)
    return renderer(made, eye=(2.5, 1.6, 3.1))


@scene
def transforms():
    """Position, origin, orientation, scale, a user's matrix and a mirror; a material that shines."""
    cone = vtk.vtkConeSource()
    cone.SetResolution(12)
    one = actor(cone, color=(0.9, 0.4, 0.2))
    one.SetOrigin(0.3, 0.1, 0)
    one.SetScale(1.5, 0.7, 1)
    one.RotateX(30)
    one.RotateZ(50)
    one.SetPosition(-0.8, 0.2, 0)
    one.GetProperty().SetSpecular(0.5)
    one.GetProperty().SetSpecularPower(20)
    one.GetProperty().SetAmbient(0.3)
    cube = actor(vtk.vtkCubeSource(), color=(0.2, 0.6, 0.9))
    matrix = vtk.vtkMatrix4x4()
    for i, row in enumerate(((0.7, 0.4, 0, 0.9), (-0.2, 0.6, 0.3, 0), (0.1, 0, -0.8, 0.2))):
        for j, value in enumerate(row):
            matrix.SetElement(i, j, value)
    cube.SetUserMatrix(matrix)
    return renderer(one, cube, eye=(0.4, 1, 4))


@scene
def spikes():
    """The spheres and cones of a hedgehog by the filter that copies them."""
    sphere = vtk.vtkSphereSource()
    sphere.SetThetaResolution(8)
    sphere.SetPhiResolution(8)
    cone = vtk.vtkConeSource()
    cone.SetResolution(6)
    glyphs = vtk.vtkGlyph3D()
    glyphs.SetInputConnection(sphere.GetOutputPort())
    glyphs.SetSourceConnection(cone.GetOutputPort())
    glyphs.SetVectorModeToUseNormal()
    glyphs.SetScaleModeToScaleByVector()
    glyphs.SetScaleFactor(0.25)
    return renderer(actor(sphere, color=(1, 0.8, 0.6)), actor(glyphs, color=(0.4, 0.7, 0.3)))


def glyphs_by_arrays(points, shapes, **arrays):
    """A mapper of glyphs that are chosen, turned and scaled by arrays of the points: shape, Normals and size."""
    for name, values in arrays.items():
        array = numpy_to_vtk(values.astype(float), deep=1)
        array.SetName(name)
        points.GetPointData().AddArray(array)
    mapper = vtk.vtkGlyph3DMapper()
    mapper.SetInputData(points)
    for index, source in enumerate(shapes):
        source.Update()
        mapper.SetSourceData(index, source.GetOutput())
    mapper.SetOrientationArray("Normals")
    mapper.SetScaleArray("size")
    mapper.SetScaleModeToScaleByMagnitude()
    mapper.SetSourceIndexArray("shape")
    mapper.SourceIndexingOn()
    return mapper


@scene
def glyph_mapper():
    """The same by the mapper: two shapes, chosen, turned, scaled and coloured by arrays of the points."""
    sphere = vtk.vtkSphereSource()
    sphere.SetThetaResolution(7)
    sphere.SetPhiResolution(6)
    sphere.Update()
    points = vtk.vtkPolyData()
    points.DeepCopy(sphere.GetOutput())
    count = points.GetNumberOfPoints()
    mapper = glyphs_by_arrays(points, (vtk.vtkArrowSource(), vtk.vtkCubeSource()),
                              size=numpy.linspace(0.5, 1.5, count), shape=numpy.arange(count) % 2, shade=numpy.cos(numpy.arange(count)))
    points.GetPointData().SetActiveScalars("shade")
    mapper.SetScaleFactor(0.2)
    mapper.SetScalarRange(-1, 1)
    made = vtk.vtkActor()
    made.SetMapper(mapper)
    return renderer(made, eye=(1.2, 0.9, 1.4))


@scene
def two_shapes():
    """Glyphs of two shapes, of which one has coordinates of the texture: VTK draws the other without it."""
    points = vtk.vtkPolyData()
    points.SetPoints(vtk.vtkPoints())
    for i in range(12):
        points.GetPoints().InsertNextPoint(i % 4 - 1.5, i // 4 - 1, 0.1 * (i % 3))
    count = numpy.arange(12)
    mapper = glyphs_by_arrays(points, (vtk.vtkConeSource(), vtk.vtkPlaneSource()), shape=count % 2, size=0.8 + 0.05 * count,
                              Normals=numpy.stack([1 + 0 * count, 0.25 * (count % 3), 0.125 * count], -1))
    made = vtk.vtkActor()
    made.SetMapper(mapper)
    made.SetTexture(picture())
    return renderer(made, eye=(0.5, 0.4, 5))


@scene
def partly_textured():
    """Blocks of one actor with a texture: a plane that has coordinates of it, and a cone that has none."""
    parts = vtk.vtkMultiBlockDataSet()
    for i, source in enumerate((vtk.vtkConeSource(), vtk.vtkPlaneSource())):
        source.SetCenter(0.7 * i, 0, 0)
        source.Update()
        parts.SetBlock(i, source.GetOutput())
    made = actor(parts, vtk.vtkCompositePolyDataMapper2(), color=(0.4, 0.9, 0.5))
    made.SetTexture(picture())
    return renderer(made, eye=(0.5, 0.4, 3))


@scene
def partly_mapped():
    """Blocks of which one has scalars, which are interpolated before they are mapped; the others have the actor's colour."""
    parts = vtk.vtkMultiBlockDataSet()
    for i, source in enumerate((vtk.vtkConeSource(), vtk.vtkPlaneSource(), vtk.vtkSphereSource())):
        source.SetCenter(0.8 * i - 0.8, 0, 0)
        source.Update()
        parts.SetBlock(i, source.GetOutput())
    values = numpy_to_vtk(numpy.array([0.0, 1.1, 2.2, 2.9]), deep=1)
    values.SetName("height")
    parts.GetBlock(1).GetPointData().SetScalars(values)
    mapper = vtk.vtkCompositePolyDataMapper2()
    mapper.InterpolateScalarsBeforeMappingOn()
    mapper.SetScalarRange(0, 3)
    return renderer(actor(parts, mapper, color=(0.4, 0.9, 0.5)), eye=(0.5, 0.4, 4))


@scene
def hedgehog():
    """Spikes of one cone by the mapper: turned by vectors, scaled by three numbers each, of which some mirror."""
    sphere = vtk.vtkSphereSource()
    sphere.SetThetaResolution(9)
    sphere.SetPhiResolution(7)
    sphere.Update()
    points = vtk.vtkPolyData()
    points.DeepCopy(sphere.GetOutput())
    count = numpy.arange(points.GetNumberOfPoints())
    size = numpy_to_vtk(numpy.stack([0.3 + 0.02 * (count % 5), numpy.where(count % 3, 0.15, -0.2), 0.1 + 0.01 * (count % 7)], -1), deep=1)
    size.SetName("size")
    points.GetPointData().AddArray(size)
    shade = numpy_to_vtk(count.astype(float), deep=1)
    shade.SetName("shade")
    points.GetPointData().SetScalars(shade)
    cone = vtk.vtkConeSource()
    cone.SetResolution(5)
    cone.SetCenter(0.5, 0.1, 0)
    cone.SetDirection(1, 0.2, 0)
    mapper = vtk.vtkGlyph3DMapper()
    mapper.SetInputData(points)
    mapper.SetSourceConnection(cone.GetOutputPort())
    mapper.SetOrientationArray("Normals")
    mapper.SetScaleArray("size")
    mapper.SetScaleModeToScaleByVectorComponents()
    mapper.SetScalarRange(0, len(count))
    made = vtk.vtkActor()
    made.SetMapper(mapper)
    return renderer(actor(sphere, color=(1, 0.8, 0.6)), made, eye=(1.5, 1, 2))


def quarter(radius, height):
    """Control points of a quarter of a circle, as Newell has it."""
    return [(radius, 0, height), (radius, 0.56 * radius, height), (0.56 * radius, radius, height), (0, radius, height)]


def patch(net, steps):
    """Points of a bicubic Bezier patch of 4 x 4 control points."""
    t = numpy.linspace(0, 1, steps + 1)[:, None]
    basis = numpy.concatenate([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t ** 2 * (1 - t), t ** 3], 1)
    return numpy.einsum("ui,vj,ijk->uvk", basis, basis, numpy.array(net, float))


def tube(rows):
    """Patches of one side of handle or spout: rows of x and z of the inner and of the outer edge, and half the width."""
    return [[(inner[0], 0, inner[1]), (inner[0], width, inner[1]), (outer[0], width, outer[1]), (outer[0], 0, outer[1])]
            for inner, outer, width in rows]


@scene
def teapot():
    """Martin Newell's teapot by its Bezier patches: quads of which those at the poles have corners that coincide."""
    profiles = [[(1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4)], [(1.5, 2.4), (1.75, 1.875), (2, 1.35), (2, 0.9)],
                [(2, 0.9), (2, 0.45), (1.5, 0.225), (1.5, 0.15)], [(0, 3.15), (0.8, 3.15), (0, 2.85), (0.2, 2.7)],
                [(0.2, 2.7), (0.4, 2.55), (1.3, 2.55), (1.3, 2.4)], [(0, 0), (1.425, 0), (1.5, 0.075), (1.5, 0.15)]]
    nets = [numpy.array([quarter(*row) for row in profile]) * (x, y, 1) for profile in profiles for x in (1, -1) for y in (1, -1)]
    handle = tube([((-1.6, 2.025), (-1.5, 2.25), 0.3), ((-2.3, 2.025), (-2.5, 2.25), 0.3), ((-2.7, 2.025), (-3, 2.25), 0.3), ((-2.7, 1.8), (-3, 1.8), 0.3),
                   ((-2.7, 1.575), (-3, 1.35), 0.3), ((-2.5, 1.125), (-2.65, 0.9375), 0.3), ((-2, 0.9), (-1.9, 0.6), 0.3)])
    spout = tube([((1.7, 1.425), (1.7, 0.6), 0.66), ((2.6, 1.425), (3.1, 0.825), 0.66), ((2.3, 2.1), (2.4, 2.025), 0.25), ((2.7, 2.4), (3.3, 2.4), 0.25),
                  ((2.8, 2.475), (3.525, 2.49375), 0.25), ((2.9, 2.475), (3.45, 2.5125), 0.15), ((2.8, 2.4), (3.2, 2.4), 0.15)])
    nets += [numpy.array(rows[first:first + 4]) * (1, side, 1) for rows in (handle, spout) for first in (0, 3) for side in (1, -1)]
    steps = 4
    points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
    for net in nets:
        first = points.GetNumberOfPoints()
        for point in patch(net, steps).reshape(-1, 3):
            points.InsertNextPoint(point)
        for u in range(steps):
            for v in range(steps):
                corner = first + u * (steps + 1) + v
                cells.InsertNextCell(4, (corner, corner + 1, corner + steps + 2, corner + steps + 1))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(cells)
    return renderer(actor(data, color=(0.8, 0.6, 0.3)), eye=(3, -7, 5), target=(0.3, 0, 1.4), up=(0, 0, 1))


@scene
def earth():
    """A picture on a sphere."""
    sphere = vtk.vtkTexturedSphereSource()
    sphere.SetThetaResolution(24)
    sphere.SetPhiResolution(12)
    made = actor(sphere)
    made.SetTexture(picture())
    made.RotateX(-60)
    return renderer(made)


@scene
def robot_arm():
    """Assemblies of assemblies, one of whose parts is used twice."""
    def link(color):
        cylinder = vtk.vtkCylinderSource()
        cylinder.SetResolution(10)
        cylinder.SetRadius(0.15)
        made = actor(cylinder, color=color)
        made.SetPosition(0, 0.5, 0)
        return made
    joint = vtk.vtkSphereSource()
    joint.SetRadius(0.22)
    shared = actor(joint, color=(0.9, 0.8, 0.2))
    hand = vtk.vtkAssembly()
    hand.AddPart(link((0.3, 0.3, 0.9)))
    hand.AddPart(shared)
    hand.SetPosition(0, 1, 0)
    hand.RotateZ(-60)
    arm = vtk.vtkAssembly()
    arm.AddPart(link((0.8, 0.3, 0.3)))
    arm.AddPart(shared)
    arm.AddPart(hand)
    arm.RotateZ(25)
    floor = vtk.vtkPlaneSource()
    floor.SetOrigin(-2, -0.3, -2)
    floor.SetPoint1(-2, -0.3, 2)
    floor.SetPoint2(2, -0.3, -2)
    return renderer(actor(floor, color=(0.7, 0.7, 0.7)), arm, eye=(1.5, 2, 4.5), target=(0.2, 0.6, 0))


@scene
def quad_sphere():
    """Quads and triangles, with normals of points, shaded smoothly."""
    sphere = vtk.vtkSphereSource()
    sphere.LatLongTessellationOn()
    sphere.SetThetaResolution(14)
    sphere.SetPhiResolution(9)
    made = actor(sphere, color=(0.7, 0.5, 0.9))
    made.GetProperty().SetInterpolationToPhong()
    made.GetProperty().SetSpecular(0.4)
    made.GetProperty().SetSpecularPower(30)
    return renderer(made)


@scene
def strips():
    """Strips of triangles, coloured by a scalar of the cells."""
    torus = vtk.vtkParametricTorus()
    source = vtk.vtkParametricFunctionSource()
    source.SetParametricFunction(torus)
    source.SetUResolution(16)
    source.SetVResolution(10)
    source.SetWResolution(4)
    source.GenerateNormalsOff()
    stripper = vtk.vtkStripper()
    stripper.SetInputConnection(source.GetOutputPort())
    stripper.Update()
    data = vtk.vtkPolyData()
    data.DeepCopy(stripper.GetOutput())
    data.GetPointData().SetScalars(None)
    shade = numpy_to_vtk(numpy.arange(data.GetNumberOfCells()).astype(float), deep=1)
    shade.SetName("shade")
    data.GetCellData().SetScalars(shade)
    made = actor(data)
    made.GetMapper().SetScalarRange(0, data.GetNumberOfCells())
    return renderer(made, eye=(2, 2, 4))


@scene
def blocks():
    """Composite data: a block of another colour, one that is not seen, one in a block of blocks."""
    def ball(x, resolution):
        sphere = vtk.vtkSphereSource()
        sphere.SetCenter(x, 0, 0)
        sphere.SetThetaResolution(resolution)
        sphere.SetPhiResolution(resolution)
        sphere.Update()
        return sphere.GetOutput()
    inner = vtk.vtkMultiBlockDataSet()
    inner.SetBlock(0, ball(1.2, 10))
    inner.SetBlock(1, ball(2.4, 9))
    data = vtk.vtkMultiBlockDataSet()
    data.SetBlock(0, ball(-1.2, 8))
    data.SetBlock(1, ball(0, 12))
    data.SetBlock(2, inner)
    mapper = vtk.vtkCompositePolyDataMapper2()
    attributes = vtk.vtkCompositeDataDisplayAttributes()
    mapper.SetCompositeDataDisplayAttributes(attributes)
    made = actor(data, mapper, color=(0.6, 0.6, 0.6))
    attributes.SetBlockColor(data.GetBlock(1), (0.9, 0.2, 0.2))
    attributes.SetBlockVisibility(inner.GetBlock(1), False)
    return renderer(made, eye=(0.5, 1.5, 6))


@scene
def solids():
    """The surface of hexahedra and tetrahedra, coloured by the cells' own scalar."""
    points = vtk.vtkPoints()
    grid = vtk.vtkUnstructuredGrid()
    for z in range(3):
        for y in range(3):
            for x in range(4):
                points.InsertNextPoint(x + 0.2 * math.sin(y), y, z + 0.1 * x)
    grid.SetPoints(points)
    at = lambda x, y, z: x + 4 * (y + 3 * z)
    for z in range(2):
        for y in range(2):
            for x in range(3):
                c = [at(x, y, z), at(x + 1, y, z), at(x + 1, y + 1, z), at(x, y + 1, z)]
                c += [i + 12 for i in c]
                if (x + y + z) % 2:
                    grid.InsertNextCell(vtk.VTK_HEXAHEDRON, 8, c)
                else:
                    grid.InsertNextCell(vtk.VTK_TETRA, 4, [c[0], c[1], c[3], c[4]])
    values = numpy_to_vtk(numpy.arange(grid.GetNumberOfCells()).astype(float), deep=1)
    values.SetName("number")
    grid.GetCellData().SetScalars(values)
    made = actor(grid, vtk.vtkDataSetMapper())
    made.GetMapper().SetScalarRange(0, grid.GetNumberOfCells())
    made.GetProperty().SetInterpolationToFlat()
    return renderer(made, eye=(6, 5, 7), target=(1.5, 1, 1))


@scene
def cut_open():
    """Planes of the mapper and culling of back faces."""
    sphere = vtk.vtkSphereSource()
    sphere.SetThetaResolution(16)
    sphere.SetPhiResolution(16)
    made = actor(sphere, color=(0.8, 0.7, 0.3))
    for normal in ((0.3, -1, 0.1), (-1, 0.2, 0.4)):
        plane = vtk.vtkPlane()
        plane.SetOrigin(0.05, 0.1, 0)
        plane.SetNormal(normal)
        made.GetMapper().AddClippingPlane(plane)
    culled = actor(vtk.vtkCubeSource(), color=(0.3, 0.8, 0.8))
    culled.SetPosition(1.2, 0, 0)
    culled.RotateY(20)
    culled.GetProperty().FrontfaceCullingOn()
    return renderer(made, culled, eye=(0.7, 1.5, 3), target=(0.5, 0, 0))


@scene
def parallel():
    """A parallel view with a window centre."""
    made = robot_arm()
    camera = made.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(1.7)
    camera.SetWindowCenter(0.15, -0.1)
    return made


@scene
def off_centre():
    """A perspective with a window centre, a horizontal view angle, shear and a user's transform."""
    made = transforms()
    camera = made.GetActiveCamera()
    camera.SetWindowCenter(0.2, 0.1)
    camera.UseHorizontalViewAngleOn()
    camera.SetViewAngle(40)
    camera.SetViewShear(0.1, -0.05, 1.0)
    move = vtk.vtkTransform()
    move.Translate(0.1, 0.05, 0)
    move.Scale(1.1, 0.9, 1)
    camera.SetUserTransform(move)
    return made


@scene
def star():
    """A polygon that is not convex, one with a hole by a bridge; an aspect of the camera's own."""
    points = vtk.vtkPoints()
    data = vtk.vtkPolyData()
    cells = vtk.vtkCellArray()

    def polygon(corners):
        cells.InsertNextCell(len(corners))
        for x, y, z in corners:
            cells.InsertCellPoint(points.InsertNextPoint(x, y, z))
    polygon([((1 if k % 2 else 0.4) * math.cos(k * 0.6283) - 1.1, (1 if k % 2 else 0.4) * math.sin(k * 0.6283), 0) for k in range(10)])
    polygon([(0.2, -1, 0), (2.2, -1, 0), (2.2, 1, 0), (0.2, 1, 0), (0.2, -1, 0),
             (0.7, -0.5, 0), (0.7, 0.5, 0), (1.7, 0.5, 0), (1.7, -0.5, 0), (0.7, -0.5, 0)])
    data.SetPoints(points)
    data.SetPolys(cells)
    made = renderer(actor(data, color=(0.9, 0.6, 0.1)), eye=(0.5, 0.4, 5))
    made.GetActiveCamera().SetUseExplicitAspectRatio(True)
    made.GetActiveCamera().SetExplicitAspectRatio(1.1)
    return made
