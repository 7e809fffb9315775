// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEdges_h
#define dgtkEdges_h

#include "dgtkGroundTruthModule.h"

#include "dgtkSurfaceRows.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dgtk
{

/// Values of an image of edges; the larger one wins.
constexpr std::uint8_t noEdge = 0;
constexpr std::uint8_t depthEdge = 128;  ///< a neighbour of the same object lies off the plane, and vice versa
constexpr std::uint8_t objectEdge = 255; ///< a neighbour has another object

/// A pixel's surface: its point and the plane of its triangle in the camera frame of the time at which it is seen.
struct PixelPlane
{
  std::uint32_t object = 0; ///< 0: no surface
  Eigen::Vector3d point{ 0, 0, 0 };
  Eigen::Vector3d normal{ 0, 0, 0 }; ///< unit length
  double range = 0;                  ///< SurfaceRows::t: depth, or the distance of a lens
};

/// What two neighbouring pixels are to one another. A depth edge: either point is off the other's tangent plane by more
/// than 1 % of the smaller range.
DGTKGROUNDTRUTH_EXPORT std::uint8_t edgeBetween(const PixelPlane& a, const PixelPlane& b);

/// The pixels' planes of one row of surfaces, or a part of one.
DGTKGROUNDTRUTH_EXPORT std::vector<PixelPlane> pixelPlanes(const SurfaceRows& row);

/// Marks the pixels of an image with the largest edge to their four neighbours. Two rows are known at a time: a row's
/// marks are there when the one below it is.
class DGTKGROUNDTRUTH_EXPORT EdgeRows
{
public:
  /// The next row, from the top; all have one width. The marks of the row above it, empty for the first row.
  std::vector<std::uint8_t> next(std::vector<PixelPlane> row);
  /// The marks of the last row.
  std::vector<std::uint8_t> last() { return std::move(this->Marks); }

private:
  std::vector<PixelPlane> Above;
  std::vector<std::uint8_t> Marks; // of the row of Above
};

} // namespace dgtk

#endif
