// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkWarp_h
#define dgtkWarp_h

#include "dgtkGroundTruthModule.h"

#include "dgtkCameraModel.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace dgtk
{

/// A surface that a layered depth image holds at a pixel.
struct WarpSample
{
  std::array<std::uint8_t, 4> rgba{}; ///< display-referred, A opacity, not premultiplied
  double depth = 0;             ///< z in the frame of the camera of the layered depth image; of a lens along the ray
  std::uint32_t splatIndex = 0; ///< splatIndex()
};

/// Calls its argument for every sample of every pixel (column, row), in an order that is always the same.
using WarpSource = std::function<void(const std::function<void(int, int, const WarpSample&)>&)>;

/// A novel view.
struct WarpedImage
{
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;   ///< 3 per pixel, rows top to bottom; black in holes
  std::vector<std::uint8_t> holes; ///< 1 per pixel: 255 where no sample fell, or no ray is, else 0
  std::uint64_t holeCount = 0;
};

/// Forward warping: every sample is moved into the other view and drawn as a rectangle as large as the picture there of
/// its pixel on the surface, by the plane through the sample with the splat index's normal; the first surface of each
/// pixel by a z-buffer, samples of one surface blended by their distance from the pixel's centre. Samples that are not
/// opaque are laid over what is behind them, or over black. `source` is called twice. Cameras of any model.
DGTKGROUNDTRUTH_EXPORT WarpedImage warpLayeredDepth(const WarpSource& source, const View& from, const View& to);

} // namespace dgtk

#endif
