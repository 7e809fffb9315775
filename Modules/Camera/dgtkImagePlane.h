// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkImagePlane_h
#define dgtkImagePlane_h

#include <Eigen/Core>

namespace dgtk
{

/// The plane at distance 1 (of lenses: any plane of theirs) and the image of it that K = [fx s cx; 0 fy cy; 0 0 1]
/// makes.
class ImagePlane
{
public:
  /// Throws UsageError unless K has that form, all its values are finite and fx, fy > 0.
  explicit ImagePlane(const Eigen::Matrix3d& K);
  const Eigen::Matrix3d& matrix() const { return this->K; }
  Eigen::Vector2d onPlane(const Eigen::Vector2d& pixel) const
  {
    const double y = (pixel.y() - this->K(1, 2)) / this->K(1, 1);
    return { (pixel.x() - this->K(0, 2) - this->K(0, 1) * y) / this->K(0, 0), y };
  }
  Eigen::Vector2d inImage(double x, double y) const
  {
    return { this->K(0, 0) * x + this->K(0, 1) * y + this->K(0, 2), this->K(1, 1) * y + this->K(1, 2) };
  }

private:
  Eigen::Matrix3d K;
};

/// K of an image that is `viewHeight` high and `aspect` times as wide on the plane; square pixels unless aspect > 0.
/// Throws UsageError for an aspect that is not finite.
Eigen::Matrix3d centredK(int width, int height, double viewHeight, double aspect);

} // namespace dgtk

#endif
