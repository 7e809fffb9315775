// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkBand_h
#define dgtkBand_h

#include "dgtkSurfaceLayer.h"

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

} // namespace dgtk

#endif
