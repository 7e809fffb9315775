// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRigid3_h
#define dgtkRigid3_h

#include <Eigen/Core>

namespace dgtk
{

/// A rigid transform `target_from_source`: x_in_target = rotation * x_in_source + translation.
/// `rotation` is a proper orthonormal 3x3 matrix; `translation` is in the units of the scene.
struct Rigid3
{
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& x_in_source) const
  {
    return this->rotation * x_in_source + this->translation;
  }
  /// c_from_a = c_from_b * b_from_a
  Rigid3 operator*(const Rigid3& other) const
  {
    return { this->rotation * other.rotation, this->rotation * other.translation + this->translation };
  }
  Rigid3 inverse() const { return { this->rotation.transpose(), -(this->rotation.transpose() * this->translation) }; }
};

/// An affine transform `target_from_source` (rotation, scale and shear): x_in_target = linear * x_in_source +
/// translation.
struct Affine3
{
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& x_in_source) const
  {
    return this->linear * x_in_source + this->translation;
  }
  Affine3 operator*(const Affine3& other) const
  {
    return { this->linear * other.linear, this->linear * other.translation + this->translation };
  }
  friend Affine3 operator*(const Rigid3& c_from_b, const Affine3& b_from_a)
  {
    return { c_from_b.rotation * b_from_a.linear, c_from_b.rotation * b_from_a.translation + c_from_b.translation };
  }
  bool operator==(const Affine3& other) const
  {
    return this->linear == other.linear && this->translation == other.translation;
  }
};

} // namespace dgtk

#endif
