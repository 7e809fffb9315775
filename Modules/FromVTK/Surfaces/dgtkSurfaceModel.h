// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceModel_h
#define dgtkSurfaceModel_h

// Private to FromVTK.

#include "dgtkSurfacePieces.h"
#include "dgtkUnsupported.h"

#include "dgtkModel.h"

#include <cstdint>
#include <memory>
#include <vector>

class vtkActor;

namespace dgtk
{

/// A model in memory, and where its triangles come from.
struct SurfaceModel
{
  std::shared_ptr<const Model> model;
  std::vector<std::int64_t> cells; ///< of the mapper's input, one a triangle
  Unsupported left;                ///< what of the actor cannot be honoured
};

/// The triangles of pieces in their order: polygons before strips, as VTK numbers cells. A polygon is cut as VTK draws
/// it, a fan from its first corner, where that covers the polygon; others, which VTK draws wrongly, by ears. Triangles
/// of which two corners coincide, as in VTK, or with a coordinate that is no finite number, are left out. `bake` is
/// applied to the points. Materials are the actor's; `lit` says whether the renderer has lights. Throws InputError for
/// cells and arrays that do not fit the points.
SurfaceModel surfaceModel(vtkActor& actor, const std::vector<SurfacePiece>& pieces, const Affine3& bake, bool lit);

} // namespace dgtk

#endif
