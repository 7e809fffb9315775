// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRaySettle_h
#define dgtkRaySettle_h

#include "dgtkRayPacket.h"

namespace dgtk
{

class ThreadPool;

/// Decides in double precision the pixels that are marked doubtful, and those beside a nearer surface that contains
/// them. What single precision decided otherwise, differently from one width of vector units to another, is undone.
void settleMarked(
  const RayScene& scene, const View& view, const RayMarks& marks, VisibilityBuffer& buffer, ThreadPool& pool);

} // namespace dgtk

#endif
