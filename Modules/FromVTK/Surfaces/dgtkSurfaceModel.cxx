// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceModel.h"

#include "dgtkActorMaterial.h"
#include "dgtkError.h"
#include "dgtkSurfaceMaterial.h"
#include "dgtkTriangulate.h"

#include <Eigen/Geometry>
#include <vtkAOSDataArrayTemplate.h>
#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkTexture.h>
#include <vtkTransform.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
constexpr std::size_t mostWork = std::size_t(1) << 32; ///< of cutting ears, in steps
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
/// Of a vertex whose block has no scalars, in the map of others' colours.
const Eigen::Vector2d unmapped(std::numeric_limits<double>::quiet_NaN(), 0);

/// How the normals of a piece come about, as VTK's mapper has it.
enum class Normals
{
  OfPoints,
  OfCells,
  OfTriangles
};

/// Tuples of an array as numbers in double precision, out of its memory where it is of one of the usual kinds.
class Tuples
{
public:
  explicit Tuples(vtkDataArray* array)
    : Array(array)
    , Components(array != nullptr ? array->GetNumberOfComponents() : 0)
  {
    if (auto* const floats = vtkAOSDataArrayTemplate<float>::FastDownCast(array))
    {
      this->Floats = floats->GetPointer(0);
    }
    else if (auto* const doubles = vtkAOSDataArrayTemplate<double>::FastDownCast(array))
    {
      this->Doubles = doubles->GetPointer(0);
    }
  }

  explicit operator bool() const { return this->Array != nullptr; }
  int components() const { return this->Components; }

  double number(vtkIdType tuple, int component) const
  {
    const vtkIdType at = tuple * this->Components + component;
    return this->Floats != nullptr    ? double(this->Floats[at])
           : this->Doubles != nullptr ? this->Doubles[at]
                                      : this->Array->GetComponent(tuple, component);
  }

  /// Of an array with three components.
  Eigen::Vector3d vector(vtkIdType tuple) const
  {
    return { this->number(tuple, 0), this->number(tuple, 1), this->number(tuple, 2) };
  }

private:
  vtkDataArray* Array;
  int Components;
  const float* Floats = nullptr;
  const double* Doubles = nullptr;
};

/// Appends the triangles of one piece to a model.
class PieceReader
{
public:
  PieceReader(SurfaceModel& to, Model& model, Geometry& geometry, vtkActor& actor, const SurfacePiece& piece,
    const ActorStyle& style)
    : To(to)
    , ToModel(model)
    , ToGeometry(geometry)
    , Piece(piece)
    , Mirrored(style.mirrored)
    , Physical(isPhysical(actor, style.lit))
    , Data(*piece.data)
    , PointCount(Data.GetPoints() != nullptr ? Data.GetNumberOfPoints() : 0)
    , Points(Data.GetPoints() != nullptr ? Data.GetPoints()->GetData() : nullptr)
    , PointNormals(asLong(Data.GetPointData()->GetNormals(), PointCount))
    , CellNormals(asLong(Data.GetCellData()->GetNormals(), Data.GetNumberOfCells()))
    , Uvs(asLong(Data.GetPointData()->GetTCoords(), PointCount))
  {
    const bool ofCells = piece.colorsOfCells;
    if ((piece.colors && !asLong(piece.colors, ofCells ? Data.GetNumberOfCells() : PointCount)) ||
        (piece.colorMapAt && !asLong(piece.colorMapAt, PointCount)))
    {
      fail("scalars are fewer than what they colour");
    }
    const bool flat = actor.GetProperty()->GetInterpolation() == VTK_FLAT;
    this->Kind = flat                 ? Normals::OfTriangles
                 : this->PointNormals ? Normals::OfPoints
                 : this->CellNormals  ? Normals::OfCells
                                      : Normals::OfTriangles;
    this->Split = this->Kind != Normals::OfPoints || piece.colorsOfCells;
    if (actor.GetTexture() != nullptr && actor.GetTexture()->GetTransform() != nullptr)
    {
      this->Transform = actor.GetTexture()->GetTransform()->GetMatrix();
    }
  }

  void readAll(const Affine3& bake)
  {
    this->reserve();
    if (!this->Piece.isGlyph)
    {
      this->read(bake, nullptr);
      return;
    }
    for (const GlyphPlace& place : this->Piece.glyphs)
    {
      this->read(bake * place.mapper_from_glyph, &place);
    }
  }

private:
  [[noreturn]] static void fail(const std::string& what)
  {
    throw InputError("VTK scene", "has data that do not hold together: " + what);
  }

  /// An array that has a tuple for each of so many, or null.
  static vtkDataArray* asLong(vtkDataArray* array, vtkIdType count)
  {
    return array != nullptr && array->GetNumberOfTuples() >= count ? array : nullptr;
  }

  /// For triangles; what other polygons have more grows by itself.
  void reserve()
  {
    const auto drawn = this->Piece.isGlyph ? this->Piece.glyphs.size() : std::size_t(1);
    const auto triangles = drawn * std::size_t(this->Data.GetNumberOfPolys());
    const auto vertices = this->Split ? 3 * triangles : drawn * std::size_t(this->PointCount);
    const auto more = [](auto& list, std::size_t count) { list.reserve(list.size() + count); };
    more(this->ToModel.triangles, triangles);
    more(this->To.cells, triangles);
    more(this->ToGeometry.positions, vertices);
    more(this->ToGeometry.normals, vertices);
    more(this->ToModel.sourceVertex, vertices);
  }

  void read(const Affine3& place, const GlyphPlace* glyph)
  {
    this->Place = place;
    this->Turn = normalMatrix(place.linear);
    // A triangle's own normal goes by the order of its corners, which a mirror turns. VTK turns the others by that
    // order.
    this->TurnOfTriangle = place.linear.determinant() < 0 ? Eigen::Matrix3d(-this->Turn) : this->Turn;
    if (this->Mirrored)
    {
      this->Turn = -this->Turn;
    }
    this->Glyph = glyph;
    this->VertexOf.assign(this->Split ? 0 : std::size_t(this->PointCount), none);
    vtkIdType cell = this->Data.GetNumberOfVerts() + this->Data.GetNumberOfLines();
    this->forCells(
      this->Data.GetPolys(), cell, [this](vtkIdType n, const vtkIdType* points) { this->polygon(n, points); });
    this->forCells(
      this->Data.GetStrips(), cell, [this](vtkIdType n, const vtkIdType* points) { this->strip(n, points); });
  }

  template <class Body>
  void forCells(vtkCellArray* cells, vtkIdType& cell, const Body& body)
  {
    if (cells == nullptr)
    {
      return;
    }
    const auto at = vtk::TakeSmartPointer(cells->NewIterator());
    for (at->GoToFirstCell(); !at->IsDoneWithTraversal(); at->GoToNextCell(), ++cell)
    {
      vtkIdType count = 0;
      const vtkIdType* points = nullptr;
      at->GetCurrentCell(count, points);
      this->Cell = cell;
      if (std::any_of(points, points + count, [this](vtkIdType p) { return p < 0 || p >= this->PointCount; }))
      {
        fail("cell " + std::to_string(cell) + " has a point that does not exist");
      }
      body(count, points);
    }
  }

  void polygon(vtkIdType count, const vtkIdType* points)
  {
    if (count <= 3 || this->isFan(count, points))
    {
      for (vtkIdType i = 1; i + 1 < count; ++i)
      {
        this->triangle({ points[0], points[i], points[i + 1] });
      }
      return;
    }
    std::vector<Eigen::Vector3d> corners;
    for (vtkIdType i = 0; i < count; ++i)
    {
      corners.push_back(this->point(points[i]));
    }
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangulate(corners, triangles, this->Work, mostWork);
    this->To.cuts.push_back({ std::uint32_t(this->To.cells.size() + this->To.leftOut.size()), triangles });
    for (const auto& t : triangles)
    {
      this->triangle({ points[t[0]], points[t[1]], points[t[2]] });
    }
  }

  /// Whether the triangles of a fan all turn as the polygon does.
  bool isFan(vtkIdType count, const vtkIdType* points) const
  {
    const Eigen::Vector3d first = this->point(points[0]);
    const auto normal = [&](vtkIdType i)
    { return Eigen::Vector3d((this->point(points[i]) - first).cross(this->point(points[i + 1]) - first)); };
    Eigen::Vector3d sum(0, 0, 0);
    for (vtkIdType i = 1; i + 1 < count; ++i)
    {
      sum += normal(i);
    }
    bool same = true;
    for (vtkIdType i = 1; same && i + 1 < count; ++i)
    {
      same = !(normal(i).dot(sum) < 0); // as VTK where a point is no number
    }
    return same;
  }

  void strip(vtkIdType count, const vtkIdType* points)
  {
    for (vtkIdType j = 0; j + 2 < count; ++j)
    {
      this->triangle({ points[j], points[j + 1 + j % 2], points[j + 1 + (j + 1) % 2] });
    }
  }

  void triangle(const std::array<vtkIdType, 3>& points)
  {
    const Eigen::Vector3d p[3] = { this->point(points[0]), this->point(points[1]), this->point(points[2]) };
    const bool finite = p[0].allFinite() && p[1].allFinite() && p[2].allFinite();
    if (!finite || p[0] == p[1] || p[1] == p[2] || p[0] == p[2])
    {
      this->To.leftOut.push_back(std::uint32_t(this->To.cells.size() + this->To.leftOut.size()));
      return;
    }
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      corners[i] = this->vertex(points[i], p, i);
    }
    this->ToModel.triangles.push_back(corners);
    this->ToModel.unplaced.push_back(this->Uvs ? 0 : 1);
    this->To.cells.push_back(this->cellNumber());
  }

  std::int64_t cellNumber() const
  {
    return this->Glyph != nullptr ? this->Glyph->point
           : this->Piece.cells    ? this->Piece.firstCell + std::int64_t(this->Piece.cells->GetComponent(this->Cell, 0))
                                  : this->Piece.firstCell + this->Cell;
  }

  Eigen::Vector3d point(vtkIdType index) const { return this->Points.vector(index); }

  /// Of a triangle with these corners. Where the data have no direction for its normal, it has the triangle's, alone.
  std::uint32_t vertex(vtkIdType index, const Eigen::Vector3d (&triangle)[3], std::size_t corner)
  {
    if (!this->Split && this->VertexOf[std::size_t(index)] != none)
    {
      return this->VertexOf[std::size_t(index)];
    }
    const auto made = std::uint32_t(this->ToGeometry.positions.size());
    Eigen::Vector3d normal = this->normalOfData(index);
    const bool isOwn = direct(normal);
    if (!isOwn)
    {
      normal = this->TurnOfTriangle * (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
      normal = direct(normal) ? normal : Eigen::Vector3d(0, 0, 1);
    }
    this->ToGeometry.positions.push_back(this->Place * triangle[corner]);
    this->ToGeometry.normals.emplace_back(normal.cast<float>());
    this->ToModel.sourceVertex.push_back(made);
    this->addLooks(index);
    if (!this->Split && isOwn)
    {
      this->VertexOf[std::size_t(index)] = made;
    }
    return made;
  }

  /// 0 where there are none.
  Eigen::Vector3d normalOfData(vtkIdType index) const
  {
    const bool ofPoint = this->Kind == Normals::OfPoints;
    return this->Kind == Normals::OfTriangles
             ? Eigen::Vector3d(0, 0, 0)
             : this->Turn * (ofPoint ? this->PointNormals : this->CellNormals).vector(ofPoint ? index : this->Cell);
  }

  /// Makes it a direction; false where it has none.
  static bool direct(Eigen::Vector3d& normal)
  {
    const double size = normal.norm();
    normal /= size;
    return size > 0 && std::isfinite(size);
  }

  void addLooks(vtkIdType index)
  {
    if (!this->ToModel.uvs.empty() || this->Uvs)
    {
      this->ToModel.uvs.resize(this->ToGeometry.positions.size() - 1, Eigen::Vector2d(0, 0));
      this->ToModel.uvs.push_back(this->uv(index));
    }
    std::array<std::uint8_t, 4> color{ 255, 255, 255, 255 };
    bool colored = false;
    if (this->Piece.colors)
    {
      this->Piece.colors->GetTypedTuple(this->Piece.colorsOfCells ? this->Cell : index, color.data());
      colored = true;
    }
    else if (this->Glyph != nullptr && this->Glyph->color)
    {
      color = *this->Glyph->color;
      colored = true;
    }
    if (colored && this->Physical)
    {
      toDisplay(color);
    }
    if (colored || !this->ToModel.colors.empty())
    {
      this->ToModel.colors.resize(this->ToGeometry.positions.size() - 1, { 255, 255, 255, 255 });
      this->ToModel.colors.push_back(color);
    }
    if (this->Piece.colorMapAt)
    {
      std::vector<Eigen::Vector2d>& places = this->ToModel.colorMapAt;
      places.resize(this->ToGeometry.positions.size() - 1, unmapped);
      places.emplace_back(
        this->Piece.colorMapAt->GetComponent(index, 0), this->Piece.colorMapAt->GetComponent(index, 1));
    }
  }

  Eigen::Vector2d uv(vtkIdType index) const
  {
    if (!this->Uvs)
    {
      return { 0, 0 };
    }
    const double v = this->Uvs.components() > 1 ? this->Uvs.number(index, 1) : 0.0;
    const double written[4] = { this->Uvs.number(index, 0), v, 0, 1 };
    if (this->Transform == nullptr)
    {
      return { written[0], written[1] };
    }
    double moved[4];
    this->Transform->MultiplyPoint(written, moved);
    return { moved[0] / moved[3], moved[1] / moved[3] };
  }

  SurfaceModel& To;
  Model& ToModel;
  Geometry& ToGeometry;
  const SurfacePiece& Piece;
  bool Mirrored;
  bool Physical;
  vtkPolyData& Data;
  vtkIdType PointCount;
  Tuples Points;
  Tuples PointNormals;
  Tuples CellNormals;
  Tuples Uvs;
  vtkMatrix4x4* Transform = nullptr; ///< of texture coordinates
  Normals Kind = Normals::OfTriangles;
  bool Split = true; ///< every triangle has vertices of its own
  Affine3 Place;
  Eigen::Matrix3d Turn = Eigen::Matrix3d::Identity(); ///< of the data's normals
  Eigen::Matrix3d TurnOfTriangle = Eigen::Matrix3d::Identity();
  const GlyphPlace* Glyph = nullptr;
  vtkIdType Cell = 0;
  std::uint64_t Work = 0;
  std::vector<std::uint32_t> VertexOf; ///< by point
};

/// Vertices that have no place in the map of colours get one: a row of white above its others.
void mapAll(Model& model)
{
  const auto isUnmapped = [](const Eigen::Vector2d& place) { return std::isnan(place.x()); };
  std::vector<Eigen::Vector2d>& places = model.colorMapAt;
  if (!model.colorMap || std::none_of(places.begin(), places.end(), isUnmapped))
  {
    return;
  }
  auto map = std::make_shared<Image>(*model.colorMap);
  const double rows = map->height++;
  map->rgba.insert(map->rgba.begin(), 4 * std::size_t(map->width), 255);
  for (Eigen::Vector2d& place : places)
  {
    const double row = std::min(place.y() * rows, rows - 0.5); // above the highest one it went on
    place = isUnmapped(place) ? Eigen::Vector2d(0, 1) : Eigen::Vector2d(place.x(), row / (rows + 1));
  }
  model.colorMap = map;
}

void complete(Model& model, Geometry& geometry)
{
  const std::size_t vertices = geometry.positions.size();
  model.sourceVertices = vertices;
  model.colorMapAt.resize(model.colorMapAt.empty() ? 0 : vertices, unmapped);
  mapAll(model);
  if (!model.colors.empty())
  {
    model.colors.resize(vertices, { 255, 255, 255, 255 });
  }
  const bool maps = std::any_of(model.materials.begin(), model.materials.end(),
    [](const Material& material) { return material.occlusionMap >= 0; });
  if (!model.uvs.empty() || maps)
  {
    model.uvs.resize(vertices, Eigen::Vector2d(0, 0));
  }
  if (model.uvs.empty() || std::find(model.unplaced.begin(), model.unplaced.end(), 1) == model.unplaced.end())
  {
    std::vector<std::uint8_t>().swap(model.unplaced);
  }
  for (const Eigen::Vector3d& p : geometry.positions)
  {
    const bool first = model.boundsMin.x() > model.boundsMax.x();
    model.boundsMin = first ? p : Eigen::Vector3d(model.boundsMin.cwiseMin(p));
    model.boundsMax = first ? p : Eigen::Vector3d(model.boundsMax.cwiseMax(p));
  }
}
} // namespace

SurfaceModel surfaceModel(vtkActor& actor, const std::vector<SurfacePiece>& pieces, const ActorStyle& style)
{
  auto model = std::make_shared<Model>();
  auto geometry = std::make_shared<Geometry>();
  model->format = "vtk";
  SurfaceModel made;
  for (const SurfacePiece& piece : pieces)
  {
    const std::string name = "material-" + std::to_string(model->materials.size() + 1);
    const auto first = std::uint32_t(model->triangles.size());
    PieceReader(made, *model, *geometry, actor, piece, style).readAll(style.bake);
    const auto count = std::uint32_t(model->triangles.size()) - first;
    if (count > 0)
    {
      model->materials.push_back(actorMaterial(actor, piece, style.lit, name, *model, made.left));
      model->parts.push_back(
        { "part-" + std::to_string(model->parts.size() + 1), int(model->materials.size()) - 1, first, count });
    }
    if (piece.colorMap && !model->colorMap)
    {
      model->colorMap = imageOf(*piece.colorMap);
      if (model->colorMap && isPhysical(actor, style.lit))
      {
        const auto shown = std::make_shared<Image>(*model->colorMap);
        toDisplay(*shown);
        model->colorMap = shown;
      }
    }
  }
  if (model->colorMap && !model->colors.empty())
  {
    made.left.add("colours of some blocks beside scalars of others that are interpolated before they are mapped");
  }
  complete(*model, *geometry);
  model->rest = geometry;
  made.model = model;
  return made;
}

} // namespace dgtk
