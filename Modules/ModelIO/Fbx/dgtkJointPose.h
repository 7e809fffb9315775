// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJointPose_h
#define dgtkJointPose_h

#include <array>
#include <cstdint>

namespace dgtk::import
{

/// An affine transform on column vectors, row-major, in the arithmetic that dgtk-import and the library share.
class Transform
{
public:
  Transform() = default;
  explicit Transform(const std::array<double, 16>& matrix)
    : M(matrix)
  {
  }
  static Transform shift(const std::array<double, 3>& by);
  static Transform scale(const std::array<double, 3>& by);
  /// Turns about three axes, degrees; about axis `order[0]` first.
  static Transform turn(const std::array<double, 3>& degrees, const std::array<std::int32_t, 3>& order);

  const std::array<double, 16>& matrix() const { return this->M; }
  double operator()(std::size_t row, std::size_t column) const { return this->M[4 * row + column]; }
  bool isIdentity() const { return this->M == Transform().M; }
  Transform operator*(const Transform& b) const;
  /// Of a singular one: the identity.
  Transform inverse() const;

private:
  std::array<double, 16> M{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
};

} // namespace dgtk::import

#endif
