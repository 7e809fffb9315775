// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceKey_h
#define dgtkSurfaceKey_h

#include "dgtkRigid3.h"

#include <cstdint>
#include <utility>
#include <vector>

class vtkActor;

namespace dgtk
{

struct SurfacePiece;
struct ActorStyle;

/// 128 bits.
using SurfaceKey = std::pair<std::uint64_t, std::uint64_t>;

/// A fingerprint of all that surfaceModel(), or with `copies` glyphCopies(), makes a model of: points, cells, colours
/// and pictures by their bytes, since they may be written to without telling VTK, settings by the time of their last
/// change. It takes a small part of the time that making the model takes.
SurfaceKey surfaceKey(vtkActor& actor, const std::vector<SurfacePiece>& pieces, const ActorStyle& style, bool copies);

} // namespace dgtk

#endif
