// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLayerPicture_h
#define dgtkLayerPicture_h

#include "dgtkDatasetIOModule.h"

#include "dgtkLayer.h"

#include <array>
#include <vector>

namespace dgtk
{

/// A layer in colours to look at.
struct LayerPicture
{
  int width = 0;
  int height = 0;
  std::vector<std::array<std::uint8_t, 3>> pixels; ///< sRGB, rows top to bottom
  double longest = 0;                              ///< of a flow: the length shown in full colour, pixels
};

/// The colours of contact sheets: depth from near (bright) to far, ids in distinct colours, vectors as red, green and
/// blue of their range in these rows, which are a whole picture; dark gray where there is nothing. Only flow differs:
/// it has the colour wheel.
DGTKDATASETIO_EXPORT LayerPicture paintLayer(const Rows& rows, const LayerSpec& spec);

} // namespace dgtk

#endif
