// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkBand_h
#define dgtkBand_h

#include "dgtkSurfaceLists.h"

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
  /// Surfaces behind one another, one for each tile from left to right; empty unless asked for.
  std::vector<SurfaceLists> peeled;
  std::vector<MattePixels> mattes; ///< one for each of LayerNeeds::mattes
};

} // namespace dgtk

#endif
