// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGlyphCopies_h
#define dgtkGlyphCopies_h

#include "dgtkSurfaceModel.h"

#include <memory>
#include <vector>

class vtkActor;

namespace dgtk
{

/// Whether glyphs can share the models of their shapes: nothing cuts or culls single triangles, and each keeps its
/// extent in every direction, so that rays can be turned into its axes.
bool canBeCopies(vtkActor& actor, const std::vector<SurfacePiece>& pieces, const Affine3& bake);

/// The same surface as surfaceModel() makes of glyphs, with one model for each shape (two, where glyphs mirror it) and
/// a copy for each glyph. Throws InputError as surfaceModel() does, and for more triangles than have numbers.
SurfaceModel glyphCopies(vtkActor& actor, const std::vector<SurfacePiece>& pieces, const ActorStyle& style);

/// A surface of copies as one model, as files have it.
std::shared_ptr<const Model> writtenOut(const SurfaceModel& surface);

} // namespace dgtk

#endif
