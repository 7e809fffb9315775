// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPortableMath.h"
#include "dgtkSurfacePieces.h"

#include <Eigen/Geometry>
#include <vtkActor.h>
#include <vtkBitArray.h>
#include <vtkDataSet.h>
#include <vtkGlyph3DMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// The arrays of a glyph mapper's input by their roles, which VTK keeps to the mappers that are derived from it.
class GlyphArrays : public vtkGlyph3DMapper
{
public:
  using Find = vtkDataArray* (vtkGlyph3DMapper::*)(vtkDataSet*);
  static Find scale() { return &GlyphArrays::GetScaleArray; }
  static Find orientation() { return &GlyphArrays::GetOrientationArray; }
  static Find source() { return &GlyphArrays::GetSourceIndexArray; }
  static Find mask() { return &GlyphArrays::GetMaskArray; }
};

/// A half turn about the bisector of the x axis and the direction, as VTK turns glyphs along vectors.
Eigen::Matrix3d alongDirection(const Eigen::Vector3d& v)
{
  if (v.y() == 0 && v.z() == 0)
  {
    return Eigen::Vector3d(v.x() < 0 ? -1 : 1, 1, v.x() < 0 ? -1 : 1).asDiagonal(); // about y: x alone is turned
  }
  const Eigen::Vector3d axis = (v + v.norm() * Eigen::Vector3d::UnitX()).normalized();
  return 2 * axis * axis.transpose() - Eigen::Matrix3d::Identity();
}

class Glyphs
{
public:
  Glyphs(vtkGlyph3DMapper& mapper, vtkDataSet& points, double opacity)
    : Mapper(mapper)
    , Points(points)
    , Scale((mapper.*GlyphArrays::scale())(&points))
    , Orientation((mapper.*GlyphArrays::orientation())(&points))
    , Source((mapper.*GlyphArrays::source())(&points))
    , Mask(vtkArrayDownCast<vtkBitArray>((mapper.*GlyphArrays::mask())(&points)))
  {
    mapColors(mapper, points, this->Colors, opacity); // which VTK has in the colours of glyphs, too
  }

  /// Whether each point has a place in the arrays that say how its glyph is, beyond whose end VTK reads.
  bool areWhole() const
  {
    const vtkIdType count = this->Points.GetNumberOfPoints();
    const auto isShort = [count](const vtkAbstractArray* array)
    { return array != nullptr && array->GetNumberOfTuples() < count; };
    return !isShort(this->Scale) && !isShort(this->Orientation) && !isShort(this->Source) && !isShort(this->Mask) &&
           (this->Colors.colorsOfCells || !isShort(this->Colors.colors));
  }

  /// VTK draws nothing where a quaternion is no turn.
  bool isThere(vtkIdType point) const
  {
    return (this->Mask == nullptr || this->Mask->GetValue(point) != 0) &&
           (this->Mapper.GetOrientationMode() != vtkGlyph3DMapper::QUATERNION || this->Orientation == nullptr ||
             normOf(*this->Orientation, point) > 0);
  }

  std::size_t sourceOf(vtkIdType point, std::size_t sources) const
  {
    const double index = this->Source == nullptr ? 0 : normOf(*this->Source, point);
    return index > 0 ? std::size_t(std::min(index, double(sources - 1))) : 0; // NaN: the first one
  }

  GlyphPlace place(vtkIdType point) const
  {
    GlyphPlace place;
    place.point = point;
    double at[3];
    this->Points.GetPoint(point, at);
    place.mapper_from_glyph = { this->turn(point), Eigen::Vector3d(at[0], at[1], at[2]) };
    if (this->Mapper.GetScaling())
    {
      place.mapper_from_glyph.linear = place.mapper_from_glyph.linear * this->scale(point).asDiagonal();
    }
    if (this->Colors.colors != nullptr && !this->Colors.colorsOfCells)
    {
      this->Colors.colors->GetTypedTuple(point, place.color.emplace().data());
    }
    return place;
  }

private:
  static double normOf(vtkDataArray& array, vtkIdType tuple)
  {
    double sum = 0;
    for (int i = 0; i < array.GetNumberOfComponents(); ++i)
    {
      sum += array.GetComponent(tuple, i) * array.GetComponent(tuple, i);
    }
    return std::sqrt(sum);
  }

  Eigen::Vector3d scale(vtkIdType point) const
  {
    Eigen::Vector3d scale(1, 1, 1);
    const int mode = this->Mapper.GetScaleMode();
    if (this->Scale != nullptr && mode != vtkGlyph3DMapper::NO_DATA_SCALING)
    {
      for (int i = 0; i < 3; ++i)
      {
        const bool own = mode == vtkGlyph3DMapper::SCALE_BY_COMPONENTS && this->Scale->GetNumberOfComponents() == 3;
        scale[i] = own                                            ? this->Scale->GetComponent(point, i)
                   : mode == vtkGlyph3DMapper::SCALE_BY_MAGNITUDE ? normOf(*this->Scale, point)
                                                                  : 1.0;
        if (this->Mapper.GetClamping())
        {
          const double* const range = this->Mapper.GetRange();
          const double width = range[1] != range[0] ? range[1] - range[0] : 1.0;
          scale[i] = (std::clamp(scale[i], range[0], std::max(range[0], range[1])) - range[0]) / width;
        }
      }
    }
    scale *= this->Mapper.GetScaleFactor();
    constexpr double least = 1e-10; // as VTK has it
    return scale.unaryExpr([](double s) { return s == 0 ? least : s; });
  }

  Eigen::Matrix3d turn(vtkIdType point) const
  {
    const int mode = this->Mapper.GetOrientationMode();
    const int wanted = mode == vtkGlyph3DMapper::QUATERNION ? 4 : 3;
    if (this->Orientation == nullptr || this->Orientation->GetNumberOfComponents() != wanted)
    {
      return Eigen::Matrix3d::Identity();
    }
    double o[4] = { 0, 0, 0, 0 };
    this->Orientation->GetTuple(point, o);
    if (mode == vtkGlyph3DMapper::QUATERNION)
    {
      return Eigen::Quaterniond(o[0], o[1], o[2], o[3]).normalized().toRotationMatrix(); // of any length, as in VTK
    }
    if (mode == vtkGlyph3DMapper::DIRECTION)
    {
      return alongDirection({ o[0], o[1], o[2] });
    }
    const auto about = [&o](int axis)
    {
      const int y = (axis + 1) % 3;
      const int z = (axis + 2) % 3;
      Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
      turn(y, y) = turn(z, z) = portable::cos(o[axis] * pi / 180);
      turn(z, y) = portable::sin(o[axis] * pi / 180);
      turn(y, z) = -turn(z, y);
      return turn;
    };
    return about(2) * about(0) * about(1);
  }

  vtkGlyph3DMapper& Mapper;
  vtkDataSet& Points;
  vtkDataArray* Scale;
  vtkDataArray* Orientation;
  vtkDataArray* Source;
  vtkBitArray* Mask;
  SurfacePiece Colors;
};
} // namespace

DrawnSurface glyphPieces(const ViewActor& actor, vtkMapper& mapper, Unsupported& unsupported)
{
  auto& glyphs = dynamic_cast<vtkGlyph3DMapper&>(mapper);
  vtkDataSet* const points = vtkDataSet::SafeDownCast(mapper.GetInputDataObject(0, 0));
  if (points == nullptr || glyphs.GetUseSourceTableTree())
  {
    unsupported.add(actor.name + ": vtkGlyph3DMapper of composite data");
    return {};
  }
  if (glyphs.GetCullingAndLOD())
  {
    unsupported.add(actor.name + ": levels of detail of its glyphs");
    return {};
  }
  std::vector<SurfacePiece> pieces;
  for (int i = 0; i < glyphs.GetNumberOfInputConnections(1); ++i)
  {
    SurfacePiece piece;
    piece.isGlyph = true;
    piece.data = glyphs.GetSource(i);
    if (piece.data != nullptr && piece.data->GetNumberOfVerts() + piece.data->GetNumberOfLines() > 0)
    {
      unsupported.add(actor.name + ": points or lines of its glyph");
    }
    pieces.push_back(piece);
  }
  if (pieces.empty())
  {
    unsupported.add(actor.name + ": lines, which are vtkGlyph3DMapper's glyph where it has none");
    return {};
  }
  const Glyphs places(glyphs, *points, actor.actor->GetProperty()->GetOpacity());
  if (!places.areWhole())
  {
    unsupported.add(actor.name + ": arrays of its glyphs that are shorter than its points");
    return {};
  }
  for (vtkIdType point = 0; point < points->GetNumberOfPoints(); ++point)
  {
    if (places.isThere(point))
    {
      pieces[places.sourceOf(point, pieces.size())].glyphs.push_back(places.place(point));
    }
  }
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(),
                 [](const SurfacePiece& piece) { return piece.data == nullptr || piece.glyphs.empty(); }),
    pieces.end());
  return { std::move(pieces), points->GetNumberOfPoints() };
}

} // namespace dgtk
