// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDistortion_h
#define dgtkDistortion_h

#include "dgtkGrowing.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace dgtk
{

/// OpenCV's distortion of the plane at distance 1 (calib3d, "Detailed Description"): radial, tangential, thin prism,
/// and the tilt of the sensor. Its domain is the largest disc on which steps towards any side go on towards that side
/// by more than leastStretch of their length (the symmetric part of the derivative is larger than that): there each
/// distorted point is that of one point. The tilt, which is a perspective map, has its own limit, where it meets
/// infinity.
class Distortion
{
public:
  /// 4, 5, 8, 12 or 14 numbers: k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tx, ty (radians). Points are mostly
  /// asked for up to `usual` from the middle, after the distortion. Throws UsageError where there is no domain.
  Distortion(const std::vector<double>& numbers, double usual);
  static bool isNone(const std::vector<double>& numbers);

  /// False beyond the domain.
  bool apply(const Eigen::Vector2d& point, Eigen::Vector2d& distorted) const;
  /// False where no point of the domain is distorted to.
  bool undo(const Eigen::Vector2d& distorted, Eigen::Vector2d& point) const;

private:
  struct Mapped
  {
    Eigen::Vector2d point;
    Eigen::Matrix2d slope;
  };
  /// r, to r * (1 + k1 r^2 + ..) / (1 + k4 r^2 + ..).
  class Radial
  {
  public:
    explicit Radial(const std::array<double, 14>& k)
      : K(k)
      , HasPoles(k[5] != 0 || k[6] != 0 || k[7] != 0)
    {
    }
    /// The factor and its slope, of r^2.
    ValueSlope factor(double square) const;
    ValueSlope operator()(double radius) const;

  private:
    std::array<double, 14> K;
    bool HasPoles; ///< or may have: k4, k5 or k6 is not 0
  };
  Mapped map(const Eigen::Vector2d& point) const; ///< without the tilt
  double leastStretchAt(double radius) const;
  double domainRadius() const;
  bool descend(const Eigen::Vector2d& wanted, Eigen::Vector2d& point) const;

  std::array<double, 14> K{};
  Radial Rule;
  bool OnlyRadial;
  bool Tilted;
  Eigen::Matrix3d Tilt = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d Untilt = Eigen::Matrix3d::Identity();
  std::unique_ptr<Growing<Radial>> Radius;
};

} // namespace dgtk

#endif
