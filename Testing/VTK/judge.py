# SPDX-License-Identifier: BSD-3-Clause
"""What a renderer shows, by NumPy alone: a ray through every pixel's centre against every triangle of the cells in the world."""
import numpy
import vtk

EDGE = 1 / 128  # pixels: nearer to an edge, either side is right


def matrix_of(vtk_matrix):
    return numpy.array([[vtk_matrix.GetElement(i, j) for j in range(4)] for i in range(4)])


def visible_actors(renderer):
    """(actor, matrix of the world) of the leaves that are seen, in their order."""
    found = []
    for prop in renderer.GetViewProps():
        if not prop.GetVisibility():
            continue
        prop.InitPathTraversal()
        path = prop.GetNextPath()
        while path:
            node = path.GetLastNode()
            if node.GetViewProp().GetVisibility():
                found.append((node.GetViewProp(), matrix_of(node.GetMatrix())))
            path = prop.GetNextPath()
    return found


def fan(ids):
    return [(ids[0], ids[i], ids[i + 1]) for i in range(1, len(ids) - 1)]


def polygon_triangles(poly, cell):
    """Of one cell: a fan, as VTK draws it; a polygon that is not convex stays whole."""
    ids = [cell.GetPointId(i) for i in range(cell.GetNumberOfPoints())]
    if cell.GetCellType() == vtk.VTK_TRIANGLE_STRIP:
        return [(ids[j], ids[j + 1 + j % 2], ids[j + 1 + (j + 1) % 2]) for j in range(len(ids) - 2)]
    p = numpy.array([poly.GetPoint(i) for i in ids])
    normals = numpy.array([numpy.cross(p[i] - p[0], p[i + 1] - p[0]) for i in range(1, len(ids) - 1)])
    if len(ids) <= 3 or (normals @ normals.sum(0) >= 0).all():
        return fan(ids)
    return [tuple(ids)]


def triangles_of(poly, first=0, numbers=None):
    """Triangles, and polygons that are not convex, and their cells; vtkPolyData numbers vertices and lines before them."""
    corners, cells = [], []
    for number in range(poly.GetNumberOfCells()):
        cell = poly.GetCell(number)
        if cell.GetCellDimension() < 2:
            continue
        for t in polygon_triangles(poly, cell):
            corners.append(numpy.array([poly.GetPoint(i) for i in t]))
            cells.append(first + (number if numbers is None else int(numbers.GetTuple1(number))))
    return corners, cells


def glyphs_of(mapper):
    """As vtkGlyph3D copies them, one point at a time."""
    data = mapper.GetInput()
    corners, cells = [], []
    for point in range(data.GetNumberOfPoints()):
        one = vtk.vtkPolyData()
        points = vtk.vtkPoints()
        points.InsertNextPoint(data.GetPoint(point))
        one.SetPoints(points)
        normal = vtk.vtkFloatArray()
        normal.SetNumberOfComponents(3)
        normal.InsertNextTuple(data.GetPointData().GetArray("Normals").GetTuple(point))
        one.GetPointData().SetVectors(normal)
        glyph = vtk.vtkGlyph3D()
        glyph.SetInputData(one)
        shape = data.GetPointData().GetArray("shape")
        size = mapper.GetScaleFactor() * numpy.ones(3) * data.GetPointData().GetArray("size").GetTuple(point)
        scale = vtk.vtkTransform()
        scale.Scale(size)
        scaled = vtk.vtkTransformPolyDataFilter()
        scaled.SetInputData(mapper.GetSource(int(shape.GetTuple1(point)) if shape else 0))
        scaled.SetTransform(scale)
        scaled.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
        glyph.SetSourceConnection(scaled.GetOutputPort())
        glyph.SetVectorModeToUseVector()
        glyph.ScalingOff()
        glyph.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
        glyph.Update()
        own, _ = triangles_of(glyph.GetOutput())
        corners += own
        cells += [point] * len(own)
    return corners, cells


def leaves(mapper, data, first=0):
    """(data set, number of its first cell) of composite data, seen or not."""
    if not isinstance(data, vtk.vtkMultiBlockDataSet):
        return [(data, first)]
    found = []
    for i in range(data.GetNumberOfBlocks()):
        for leaf, number in leaves(mapper, data.GetBlock(i), first):
            found.append((leaf, number))
            first = number + leaf.GetNumberOfCells()
    return found


def surface(actor):
    mapper = actor.GetMapper()
    mapper.Update()
    if isinstance(mapper, vtk.vtkGlyph3DMapper):
        return glyphs_of(mapper)
    data = mapper.GetInputDataObject(0, 0)
    attributes = getattr(mapper, "GetCompositeDataDisplayAttributes", lambda: None)()
    parts = []
    for leaf, first in leaves(mapper, data):
        if attributes and attributes.HasBlockVisibility(leaf) and not attributes.GetBlockVisibility(leaf):
            continue
        numbers = None
        if not isinstance(leaf, vtk.vtkPolyData):
            surface_filter = vtk.vtkGeometryFilter()
            surface_filter.SetInputData(leaf)
            surface_filter.PassThroughCellIdsOn()
            surface_filter.Update()
            leaf = surface_filter.GetOutput()
            numbers = leaf.GetCellData().GetArray("vtkOriginalCellIds")
        parts.append(triangles_of(leaf, first, numbers))
    return sum((part[0] for part in parts), []), sum((part[1] for part in parts), [])


def newell(p):
    """Twice the area of a polygon, along its normal."""
    return numpy.cross(p, numpy.roll(p, -1, 0)).sum(0)


def inside(p, normal, at):
    """Whether points in the plane of a polygon are in it: a ray in the plane crosses its sides an odd number of times."""
    axes = [axis for axis in range(3) if axis != numpy.abs(normal).argmax()]
    x, y = at[:, axes[0]], at[:, axes[1]]
    odd = numpy.zeros(len(at), bool)
    for a, b in zip(p[:, axes], numpy.roll(p, -1, 0)[:, axes]):
        if a[1] != b[1]:
            odd ^= ((a[1] > y) != (b[1] > y)) & (x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
    return odd


class Judge:
    """Per pixel: object, cell, depth, normal and position of what is seen, and whether the centre is too near to an edge."""

    def __init__(self, renderer, width, height):
        self.width, self.height = width, height
        if not renderer.IsActiveCameraCreated():
            renderer.ResetCamera()  # as VTK does when it draws
        camera = renderer.GetActiveCamera()
        self.clip = matrix_of(camera.GetCompositeProjectionTransformMatrix(width / height, -1, 1))
        self.view = matrix_of(camera.GetViewTransformMatrix())
        self.find(renderer)

    def rays(self):
        """Two points of the world on each ray."""
        x, y = numpy.meshgrid((numpy.arange(self.width) + 0.5) / self.width * 2 - 1, 1 - (numpy.arange(self.height) + 0.5) / self.height * 2)
        ends = []
        for z in (-0.9, 0.7):
            p = numpy.stack([x.ravel(), y.ravel(), numpy.full(x.size, z), numpy.ones(x.size)], -1) @ numpy.linalg.inv(self.clip).T
            ends.append(p[:, :3] / p[:, 3:])
        return ends

    def project(self, points):
        p = numpy.concatenate([points, numpy.ones(points.shape[:-1] + (1,))], -1) @ self.clip.T
        return (p[..., :2] / p[..., 3:] * [1, -1] + 1) / 2 * [self.width, self.height]

    def around(self, polygon):
        """The pixels in which a polygon may be: all, where it reaches behind the camera; else a pixel more than its corners span."""
        if (polygon @ self.clip[3, :3] + self.clip[3, 3] <= 0).any():
            return numpy.arange(self.width * self.height)
        corners = self.project(polygon)
        low = numpy.clip(numpy.floor(corners.min(0)) - 1, 0, [self.width, self.height]).astype(int)
        high = numpy.clip(numpy.ceil(corners.max(0)) + 1, 0, [self.width, self.height]).astype(int)
        return (numpy.arange(low[1], high[1])[:, None] * self.width + numpy.arange(low[0], high[0])).ravel()

    def find(self, renderer):
        start, end = self.rays()
        direction = end - start
        count = len(start)
        best = numpy.full(count, numpy.inf)
        self.objects = numpy.zeros(count, numpy.uint32)
        self.cells = numpy.full(count, -1, numpy.int64)
        self.position = numpy.full((count, 3), numpy.nan)
        self.plane = numpy.full((count, 3), numpy.nan)
        self.near_edge = numpy.zeros(count, bool)
        self.polygons, self.polygon = {}, numpy.full(count, -1)
        centre = numpy.stack(numpy.meshgrid(numpy.arange(self.width) + 0.5, numpy.arange(self.height) + 0.5), -1).reshape(-1, 2)
        for number, (actor, world) in enumerate(visible_actors(renderer), 1):
            corners, cells = surface(actor)
            planes = actor.GetMapper().GetClippingPlanes()
            cull = actor.GetProperty().GetFrontfaceCulling() - actor.GetProperty().GetBackfaceCulling()
            self.polygons[number] = [polygon @ world[:3, :3].T + world[:3, 3] for polygon in corners]
            for index, (p, cell) in enumerate(zip(self.polygons[number], cells)):
                normal = newell(p - p[0])
                area = normal @ normal
                if area == 0:
                    continue
                where = self.around(p)
                along = direction[where] @ normal
                with numpy.errstate(divide="ignore", invalid="ignore"):
                    t = ((p[0] - start[where]) @ normal) / along
                    at = start[where] + t[:, None] * direction[where]
                    within = inside(p, normal, at)
                shown = numpy.ones(len(where), bool)
                if cull:
                    shown &= (along < 0) if cull < 0 else (along > 0)
                edges = self.close_to(self.project(p), centre[where])
                if planes:
                    for i in range(planes.GetNumberOfItems()):
                        plane = planes.GetItem(i)
                        height = (at - plane.GetOrigin()) @ numpy.array(plane.GetNormal())
                        shown &= height >= 0
                        edges |= within & (numpy.abs(height) < 1e-3)
                self.near_edge[where] |= edges
                hit = within & shown & (t < best[where])
                seen = where[hit]
                best[seen] = t[hit]
                self.objects[seen], self.cells[seen] = number, cell
                self.polygon[seen] = index
                self.position[seen], self.plane[seen] = at[hit], normal / numpy.sqrt(area)
        self.direction = direction

    def close_to(self, corners, centre):
        close = numpy.zeros(len(centre), bool)
        for p, q in zip(corners, numpy.roll(corners, -1, 0)):
            along = q - p
            length = along @ along
            if length == 0 or not numpy.isfinite(length):
                continue
            part = numpy.clip((centre - p) @ along / length, 0, 1)
            away = centre - p - part[:, None] * along
            close |= (away ** 2).sum(-1) < EDGE ** 2
        return close

    def follow(self, other):
        """Where what the pixels see is in another view of the same cells, and its class; every cell is a triangle."""
        places = numpy.full((len(self.objects), 2), numpy.nan)
        classes = numpy.zeros(len(self.objects), numpy.uint8)
        for i in numpy.flatnonzero(self.objects):
            number, index = self.objects[i], self.polygon[i]
            a, b, c = self.polygons[number][index]
            v, w = numpy.linalg.lstsq(numpy.stack([b - a, c - a], -1), self.position[i] - a, rcond=None)[0]
            a, b, c = other.polygons[number][index]
            point = a + v * (b - a) + w * (c - a)
            if other.clip[3] @ numpy.append(point, 1) <= 0:
                classes[i] = 5
                continue
            places[i] = other.project(point)
            inside = (places[i] >= 0).all() and (places[i] <= [other.width, other.height]).all()
            classes[i] = other.hides(number, index, point) if inside else 4
        return places, classes

    def hides(self, number, index, point):
        """1 where nothing is before a point of a triangle, 2 for another object, 3 for its own."""
        eye = numpy.linalg.inv(self.view)[:3, 3]
        first, found = 1 - 1e-9, 1
        for other, polygons in self.polygons.items():
            p = numpy.array(polygons)
            e1, e2, d = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0], point - eye
            n = numpy.cross(e1, e2)
            with numpy.errstate(divide="ignore", invalid="ignore"):
                t = ((p[:, 0] - eye) * n).sum(-1) / (n @ d)
                at = eye + t[:, None] * d - p[:, 0]
                area = (n * n).sum(-1)
                v = (numpy.cross(at, e2) * n).sum(-1) / area
                w = (numpy.cross(e1, at) * n).sum(-1) / area
                hit = (v >= 0) & (w >= 0) & (v + w <= 1) & (t > 1e-9) & (t < 1 - 1e-9)
            if other == number:
                hit[index] = False
            if hit.any() and t[hit].min() < first:
                first, found = t[hit].min(), 2 if other != number else 3
        return found
