// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkUnifiedPlane_h
#define dgtkUnifiedPlane_h

#include "dgtkLensCamera.h"

#include <cmath>

namespace dgtk
{

/// (x, y) / (alpha rho + (1 - alpha) z) with rho^2 = beta (x^2 + y^2) + z^2, and the points that are projected so.
class UnifiedPlane
{
public:
  explicit UnifiedPlane(double alpha, double beta = 1)
    : Alpha(alpha)
    , Beta(beta)
    , Behind(alpha > 0.5 ? (1 - alpha) / alpha : alpha / (1 - alpha))
  {
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& point) const
  {
    const double rho = std::sqrt(this->Beta * x.head<2>().squaredNorm() + x.z() * x.z());
    if (!(x.z() > -this->Behind * rho))
    {
      return false;
    }
    const Eigen::Vector2d found = x.head<2>() / (this->Alpha * rho + (1 - this->Alpha) * x.z());
    if (!(this->rootAt(found.squaredNorm()) >= leastStretch * (1 - rootSlack)))
    {
      return false;
    }
    point = found;
    return true;
  }
  /// One of any length, on the ray.
  bool pointOf(const Eigen::Vector2d& plane, Eigen::Vector3d& x) const
  {
    const double square = plane.squaredNorm();
    const double root = this->rootAt(square);
    if (!(root >= leastStretch))
    {
      return false;
    }
    const double z = (1 - this->Beta * this->Alpha * this->Alpha * square) / (this->Alpha * root + 1 - this->Alpha);
    x = { plane.x(), plane.y(), z };
    return true;
  }

private:
  /// Zero where a ray touches the quadric.
  double rootAt(double square) const { return std::sqrt(1 - (2 * this->Alpha - 1) * this->Beta * square); }

  double Alpha;
  double Beta;
  double Behind;
};

inline CameraParameter alphaParameter()
{
  return { "alpha", "", "0: a pinhole's plane; 1: parallel to the axis", { 0, 1, false, false, "a number from 0 to 1" },
    { 0.5 }, { 1 }, true };
}

} // namespace dgtk

#endif
