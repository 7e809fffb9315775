// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTracedView_h
#define dgtkTracedView_h

#include "dgtkFrozenView.h"
#include "dgtkVisibility.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace dgtk
{

/// Traces a stage's view at frame 0, tile by tile, each of which `look` is shown in this thread.
void traceTiles(const Stage& stage, const View& view, const std::function<void(const VisibilityBuffer&)>& look);

/// What every pixel of a stage's view sees at frame 0, rows top to bottom.
std::vector<Hit> traceView(const Stage& stage, const View& view);

/// The cell of the mapper's input that a hit of the view is of; -1 for nothing.
inline std::int64_t cellOf(const FrozenView& view, const Hit& hit)
{
  if (hit.object == 0)
  {
    return -1;
  }
  return view.actors[view.actorOf(hit)].cell(hit);
}

} // namespace dgtk

#endif
