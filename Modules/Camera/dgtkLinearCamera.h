// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLinearCamera_h
#define dgtkLinearCamera_h

// Private to Camera: what the linear models share, and what is checked of every camera.

#include "dgtkCameraEntry.h"
#include "dgtkImagePlane.h"

namespace dgtk
{

/// They differ in what the inverse of K gives, a direction or an origin.
class LinearCamera : public CameraModel
{
public:
  /// Throws UsageError for a size or a K that no camera has.
  LinearCamera(int width, int height, const Eigen::Matrix3d& K, bool perspective);
  std::optional<LinearProjection> linear() const override
  {
    return LinearProjection{ this->Plane.matrix(), this->Perspective };
  }

protected:
  Eigen::Vector2d onPlane(const Eigen::Vector2d& pixel) const { return this->Plane.onPlane(pixel); }
  Eigen::Vector2d inImage(double x, double y) const { return this->Plane.inImage(x, y); }

private:
  ImagePlane Plane;
  bool Perspective;
};

/// Throws UsageError unless 1 <= width, height <= 2^20.
void checkCameraSize(int width, int height);

} // namespace dgtk

#endif
