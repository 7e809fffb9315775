// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPairValues_h
#define dgtkPairValues_h

#include "dgtkGroundTruthModule.h"

#include "dgtkCorrespondence.h"

namespace dgtk
{

/// What relates the pixels (x, y) of a view with where their surface points (x', y') are in another.
enum class PairValue
{
  Position,     ///< (x', y'), pixels
  Displacement, ///< (x', y') - (x, y), pixels
  FromLeft,     ///< x - x', pixels: disparity of the left camera of a rectified pair
  FromRight,    ///< x' - x, pixels: of the right one
  Motion        ///< of the surface point in the axes of the camera, scene units
};

/// Values a pixel: 2, 1 for disparities, 3 for motion.
DGTKGROUNDTRUTH_EXPORT int channelsOf(PairValue value);

/// One value, other than motion, of rows of full width: channelsOf(value) numbers a pixel in `values`, NaN where there
/// is none. `pixels` is what correspondRows() gives. `own`, likewise: where the points are in the own camera at the
/// time of the other view, in place of (x, y); null for the pixels' centres.
DGTKGROUNDTRUTH_EXPORT void pairRows(
  const PixelRect& rect, const double* pixels, PairValue value, double* values, const double* own = nullptr);

/// Centre of camera b on the x axis of camera a, when the two are a rectified pair: two perspectives of one size, the
/// same K but for the column of the principal point, one orientation, displaced along x only (to 1e-9, and the rounding
/// of their places). Otherwise 0.
DGTKGROUNDTRUTH_EXPORT double rectifiedBaseline(const View& a, const View& b);
/// How far the rounding of their places may move one centre in the axes of the other.
DGTKGROUNDTRUTH_EXPORT double baselineRounding(const View& a, const View& b);

} // namespace dgtk

#endif
