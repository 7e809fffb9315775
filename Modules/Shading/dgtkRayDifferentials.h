// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRayDifferentials_h
#define dgtkRayDifferentials_h

// Private to Shading.

#include "dgtkCameraModel.h"

#include <vector>

namespace dgtk
{

/// A ray through a pixel's centre and how it changes to its neighbours (Igehy 1999, Tracing Ray Differentials).
struct PixelRay
{
  const CameraRay* own;
  const CameraRay* right; ///< differences
  const CameraRay* down;
};

/// Rays of pixels of one row of an image, functions of the pixel alone. One thread.
class RayDifferentials
{
public:
  explicit RayDifferentials(const CameraModel& model);
  /// Of columns [first, first + count) of row y, until the next row.
  const std::vector<PixelRay>& row(int y, int first, int count);
  /// Of all pixels, where the camera is linear.
  const CameraRay& right() const { return this->Right; }
  const CameraRay& down() const { return this->Down; }

private:
  void linearRow(int y, int first, std::size_t count);
  void generalRow(int y, int first, int count);

  const CameraModel& Model;
  bool Linear;
  CameraRay Right; ///< linear: everywhere the same
  CameraRay Down;
  int RowFirst = 0; ///< linear: of Row, which differs from the next only in the rays themselves
  std::vector<Eigen::Vector2d> Pixels;
  std::vector<CameraRay> Own;
  std::vector<CameraRay> Below;
  int BelowRow = -1; ///< of the image; rows are mostly asked for one after another
  int BelowLow = 0;
  std::size_t BelowWide = 0;
  std::vector<CameraRay> Differences; ///< general: right and down of each pixel
  std::vector<PixelRay> Row;
};

} // namespace dgtk

#endif
