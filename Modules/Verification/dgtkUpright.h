// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkUpright_h
#define dgtkUpright_h

#include <Eigen/Geometry>

#include <cmath>

namespace dgtk
{

/// Cosines between axes: up to the first an object is not sheared for certain, from the second on it is.
constexpr double upright = 5e-10;
constexpr double leaning = 2e-9;

/// Between two columns of a matrix; not-a-number where one has no length.
inline double largestCosine(const Eigen::Matrix3d& axes)
{
  double largest = 0;
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d a = axes.col(i);
    const Eigen::Vector3d b = axes.col((i + 1) % 3);
    const double cosine = std::abs(a.dot(b)) / (a.norm() * b.norm());
    largest = std::isnan(cosine) || cosine > largest ? cosine : largest;
  }
  return largest;
}

/// Whether a document may say, or leave out, that an object's axes are a rotation and factors.
inline bool maySay(bool rotation, double cosine) { return rotation ? cosine < leaning : !(cosine < upright); }

} // namespace dgtk

#endif
