// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCofactors_h
#define dgtkCofactors_h

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace dgtk
{

/// The matrix of cofactors: det(m) times the inverse transpose, which turns normals as m turns points, times a factor
/// that is negative where m mirrors. There is one of a singular m, too.
inline Eigen::Matrix3d cofactorsOf(const Eigen::Matrix3d& m)
{
  Eigen::Matrix3d cofactors;
  for (int c = 0; c < 3; ++c)
  {
    cofactors.col(c) = m.col((c + 1) % 3).cross(m.col((c + 2) % 3));
  }
  return cofactors;
}

} // namespace dgtk

#endif
