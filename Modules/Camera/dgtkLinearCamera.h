// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLinearCamera_h
#define dgtkLinearCamera_h

// Private to Camera: what the linear models share, and what is checked of every camera.

#include "dgtkCameraEntry.h"

namespace dgtk
{

/// They differ in what the inverse of K gives, a direction or an origin.
class LinearCamera : public CameraModel
{
public:
  /// Throws UsageError for a size or a K that no camera has.
  LinearCamera(int width, int height, const Eigen::Matrix3d& K, bool perspective);
  std::optional<LinearProjection> linear() const override { return this->Projection; }

protected:
  Eigen::Vector2d onPlane(const Eigen::Vector2d& pixel) const
  {
    const Eigen::Matrix3d& K = this->Projection.K;
    const double y = (pixel.y() - K(1, 2)) / K(1, 1);
    return { (pixel.x() - K(0, 2) - K(0, 1) * y) / K(0, 0), y };
  }
  Eigen::Vector2d inImage(double x, double y) const
  {
    const Eigen::Matrix3d& K = this->Projection.K;
    return { K(0, 0) * x + K(0, 1) * y + K(0, 2), K(1, 1) * y + K(1, 2) };
  }

private:
  LinearProjection Projection;
};

/// Throws UsageError unless 1 <= width, height <= 2^20.
void checkCameraSize(int width, int height);

/// K of an image that is `viewHeight` high and `aspect` times as wide at distance 1; square pixels unless aspect > 0.
/// Throws UsageError for an aspect that is not finite.
Eigen::Matrix3d centredK(int width, int height, double viewHeight, double aspect);

} // namespace dgtk

#endif
