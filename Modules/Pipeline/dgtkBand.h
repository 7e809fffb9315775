// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkBand_h
#define dgtkBand_h

// Private to Pipeline.

#include "dgtkMattingSource.h"

#include "dgtkLayer.h"
#include "dgtkRasterSource.h"
#include "dgtkVisibility.h"

#include <functional>
#include <mutex>
#include <vector>

namespace dgtk
{

/// A horizontal band of an image: one row of canonical tiles, full width.
struct Band
{
  PixelRect rect;
  std::vector<Hit> hits;    ///< empty unless asked for
  std::vector<float> rgb;   ///< display-referred; empty unless asked for
  std::vector<float> sharp; ///< colours of the frame's own instant and the lens's centre; empty unless asked for
  /// Surfaces behind one another as OpenGL peels them, for each tile from left to right the ranks from near to far;
  /// empty unless asked for.
  std::vector<std::vector<SurfaceLayer>> peeled;
  std::vector<MattePixels> mattes; ///< one for each of LayerNeeds::mattes
};

/// A band as drawing leaves it.
class DrawnBand
{
public:
  Band band;
  std::function<void()> rest = [] {}; ///< to be done until `band` is whole; waits for no other job

  std::function<void()> color = [] {}; ///< to be done until Band::rgb is there, where that takes longer than the rest

  /// Does the rest when it is called first, in whichever thread. With `colored`, Band::rgb is there as well.
  const Band& whole(bool colored = true)
  {
    std::call_once(this->Once, this->rest);
    if (colored)
    {
      std::call_once(this->ColorOnce, this->color);
    }
    return this->band;
  }

private:
  std::once_flag Once;
  std::once_flag ColorOnce;
};

} // namespace dgtk

#endif
