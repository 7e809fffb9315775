// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTrack_h
#define dgtkTrack_h

#include "dgtkPortableMath.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <vector>

namespace dgtk
{

/// A rotation as unit quaternion w + xi + yj + zk. Values read from a file are kept as written, so that they can be
/// written back; whoever computes with one normalises it.
struct Quaternion
{
  double w = 1;
  double x = 0;
  double y = 0;
  double z = 0;

  double norm() const
  {
    return std::sqrt(this->w * this->w + this->x * this->x + this->y * this->y + this->z * this->z);
  }
  double dot(const Quaternion& o) const { return this->w * o.w + this->x * o.x + this->y * o.y + this->z * o.z; }
  Quaternion scaled(double s) const { return { s * this->w, s * this->x, s * this->y, s * this->z }; }
  Quaternion operator+(const Quaternion& o) const
  {
    return { this->w + o.w, this->x + o.x, this->y + o.y, this->z + o.z };
  }
  Quaternion operator-(const Quaternion& o) const { return *this + o.scaled(-1); }
  Quaternion operator*(double s) const { return this->scaled(s); }
  bool operator==(const Quaternion& o) const
  {
    return this->w == o.w && this->x == o.x && this->y == o.y && this->z == o.z;
  }
  bool operator!=(const Quaternion& o) const { return !(*this == o); }

  /// Rotation matrix of the normalised quaternion; norm() > 0.
  Eigen::Matrix3d matrix() const
  {
    const Quaternion q = this->scaled(1 / this->norm());
    Eigen::Matrix3d m;
    m << 1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y - q.w * q.z), 2 * (q.x * q.z + q.w * q.y), //
      2 * (q.x * q.y + q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z - q.w * q.x),    //
      2 * (q.x * q.z - q.w * q.y), 2 * (q.y * q.z + q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y);
    return m;
  }
};

/// Spherical linear interpolation along the shorter arc (Shoemake 1985), u in [0, 1]; unit length.
inline Quaternion slerp(Quaternion a, Quaternion b, double u)
{
  a = a.scaled(1 / a.norm());
  b = b.scaled(1 / b.norm());
  if (a.dot(b) < 0)
  {
    b = b.scaled(-1);
  }
  // The half angle from the chord: exact also where the cosine is nearly 1.
  const double chord = (b - a).norm();
  const double angle = 2 * portable::asin(std::min(1.0, chord / 2));
  const double sine = portable::sin(angle);
  const Quaternion q = sine < 1e-9
                         ? a.scaled(1 - u) + b.scaled(u)
                         : a.scaled(portable::sin((1 - u) * angle) / sine) + b.scaled(portable::sin(u * angle) / sine);
  return q.scaled(1 / q.norm());
}

enum class Interpolation
{
  Linear, ///< thesis equation 4.13; slerp for rotations
  Step,   ///< the value of the last key frame
  Smooth  ///< Catmull-Rom through the keys, tangents by uneven key frames; of rotations the components, normalised
};

template <typename T>
struct Key
{
  int frame = 0;
  T value;
  std::optional<Interpolation> interpolation = std::nullopt; ///< up to the next key; none: the track's
  bool operator==(const Key& o) const
  {
    return this->frame == o.frame && this->value == o.value && this->interpolation == o.interpolation;
  }
};

/// A value over time. Without keys it is `value` at every frame; with keys `value` has no effect (it is kept because a
/// .scene camera has both). Keys ascend strictly. Outside of them the nearest key's value holds; at a key frame at()
/// is exactly that key's value. What is true or false has steps, whatever is asked for.
template <typename T>
struct Track
{
  T value;
  std::vector<Key<T>> keys;
  Interpolation interpolation = Interpolation::Linear; ///< of the keys that name none

  /// 0, or the identity.
  Track()
  {
    if constexpr (std::is_same_v<T, Eigen::Vector3d>)
    {
      this->value.setZero();
    }
    else
    {
      this->value = T();
    }
  }
  Track(const T& v)
    : value(v)
  {
  }

  bool animated() const { return !this->keys.empty(); }
  T at(double frame) const;
  /// How the value goes from a key to the next; key < keys.size().
  Interpolation interpolationAfter(std::size_t key) const
  {
    return std::is_same_v<T, bool> ? Interpolation::Step : this->keys[key].interpolation.value_or(this->interpolation);
  }
};

/// Whether it is true at some frame.
inline bool isEver(const Track<bool>& track)
{
  return track.animated() ? std::any_of(track.keys.begin(), track.keys.end(), [](const auto& key) { return key.value; })
                          : track.value;
}

namespace detail
{
inline void alignTo(const Quaternion& reference, Quaternion& q)
{
  q = q.scaled((reference.dot(q) < 0 ? -1 : 1) / q.norm());
}
template <typename T>
void alignTo(const T&, T&)
{
}

inline double& component(double& value, int) { return value; }
inline double& component(Eigen::Vector3d& value, int i) { return value[i]; }

/// Cubic Hermite between keys i and i + 1 with Catmull-Rom tangents, one-sided at the ends.
template <typename T>
T smooth(const std::vector<Key<T>>& keys, std::size_t i, double u)
{
  Key<T> k[4] = { keys[i == 0 ? 0 : i - 1], keys[i], keys[i + 1], keys[std::min(i + 2, keys.size() - 1)] };
  for (const int j : { 1, 0, 2, 3 })
  {
    alignTo(k[j == 3 ? 2 : 1].value, k[j].value);
  }
  const double h = double(k[2].frame) - k[1].frame;
  const T m0 = (k[2].value - k[0].value) * (h / (double(k[2].frame) - k[0].frame));
  const T m1 = (k[3].value - k[1].value) * (h / (double(k[3].frame) - k[1].frame));
  const T d = k[2].value - k[1].value;
  return k[1].value + (m0 + (d * 3.0 - m0 * 2.0 - m1 + (m0 + m1 - d * 2.0) * u) * u) * u;
}
} // namespace detail

template <typename T>
T Track<T>::at(double frame) const
{
  if (this->keys.empty())
  {
    return this->value;
  }
  const auto after = std::upper_bound(
    this->keys.begin(), this->keys.end(), frame, [](double f, const Key<T>& key) { return f < key.frame; });
  if (after == this->keys.begin())
  {
    return this->keys.front().value;
  }
  const std::size_t i = std::size_t(after - this->keys.begin()) - 1;
  const Key<T>& a = this->keys[i];
  const Interpolation how = this->interpolationAfter(i);
  if (after == this->keys.end() || frame == a.frame || how == Interpolation::Step)
  {
    return a.value;
  }
  const double u = (frame - a.frame) / (double(after->frame) - a.frame);
  if constexpr (std::is_same_v<T, bool>)
  {
    return a.value;
  }
  else if constexpr (std::is_same_v<T, Quaternion>)
  {
    const Quaternion q =
      how == Interpolation::Smooth ? detail::smooth(this->keys, i, u) : slerp(a.value, after->value, u);
    return q.scaled(1 / q.norm());
  }
  else
  {
    return how == Interpolation::Smooth ? detail::smooth(this->keys, i, u) : T(a.value + (after->value - a.value) * u);
  }
}

/// at(), but never beyond the smallest and the largest key, each component by itself: for values with a range, which a
/// smooth curve could leave between keys.
template <typename T>
T boundedAt(const Track<T>& track, double frame)
{
  T value = track.at(frame);
  if (!track.animated())
  {
    return value;
  }
  T least = track.keys.front().value;
  T most = least;
  for (int i = 0; i < (std::is_same_v<T, double> ? 1 : 3); ++i)
  {
    for (Key<T> key : track.keys)
    {
      const double number = detail::component(key.value, i);
      detail::component(least, i) = std::min(detail::component(least, i), number);
      detail::component(most, i) = std::max(detail::component(most, i), number);
    }
    double& number = detail::component(value, i);
    number = std::clamp(number, detail::component(least, i), detail::component(most, i));
  }
  return value;
}

} // namespace dgtk

#endif
