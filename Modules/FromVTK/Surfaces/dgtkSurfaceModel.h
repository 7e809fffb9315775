// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceModel_h
#define dgtkSurfaceModel_h

#include "dgtkSurfacePieces.h"
#include "dgtkUnsupported.h"

#include "dgtkModel.h"
#include "dgtkModelSource.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

class vtkActor;

namespace dgtk
{

/// A polygon that was cut otherwise than into a fan.
struct PolygonCut
{
  std::uint32_t first = 0;                             ///< number of its first triangle, of all of them
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< corners of the polygon

  bool operator==(const PolygonCut& other) const
  {
    return this->first == other.first && this->triangles == other.triangles;
  }
};

/// A model in memory, and where its triangles come from.
struct SurfaceModel
{
  std::shared_ptr<const Model> model; ///< with copies: of the first one
  std::vector<std::int64_t> cells;    ///< of the mapper's input, one a triangle; with copies, one a copy
  /// Numbers, in the order of all triangles, of those that were left out for their points; not of copies.
  std::vector<std::uint32_t> leftOut;
  std::vector<PolygonCut> cuts; ///< ascending; not of copies
  /// What it is made of instead, in the order of their triangles; null: `model`.
  std::shared_ptr<const std::vector<ModelCopy>> copies;
  std::vector<std::array<std::uint8_t, 4>> tints; ///< R, G, B, A of the copies, or none
  Unsupported left;                               ///< what of the actor cannot be honoured

  /// How many triangles copies have.
  static std::uint64_t triangles(const std::vector<ModelCopy>& copies)
  {
    return std::uint64_t(copies.back().firstTriangle) + copies.back().model->triangles.size();
  }
  std::uint64_t triangles() const { return this->copies ? triangles(*this->copies) : this->cells.size(); }
  /// Index of the copy that has a triangle.
  std::size_t copyOf(std::uint32_t triangle) const
  {
    const auto after = std::upper_bound(this->copies->begin(), this->copies->end(), triangle,
      [](std::uint32_t wanted, const ModelCopy& copy) { return wanted < copy.firstTriangle; });
    return std::size_t(after - this->copies->begin()) - 1;
  }
  std::int64_t cellOf(std::uint32_t triangle) const
  {
    return this->cells[this->copies ? this->copyOf(triangle) : triangle];
  }
};

/// How an actor's surface becomes a model.
struct ActorStyle
{
  Affine3 bake;          ///< applied to the points
  bool lit = true;       ///< the renderer has lights
  bool mirrored = false; ///< what places the model turns left to right
};

/// The triangles of pieces in their order: polygons before strips, as VTK numbers cells. A polygon is cut as VTK draws
/// it, a fan from its first corner, where that covers the polygon; others, which VTK draws wrongly, by ears. Triangles
/// of which two corners coincide, as in VTK, or with a coordinate that is no finite number, are left out.
/// Materials are the actor's. Throws InputError for cells and arrays that do not fit the points.
SurfaceModel surfaceModel(vtkActor& actor, const std::vector<SurfacePiece>& pieces, const ActorStyle& style);

} // namespace dgtk

#endif
