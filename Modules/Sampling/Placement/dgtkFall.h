// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFall_h
#define dgtkFall_h

#include "dgtkPlaceBody.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace dgtk
{

/// How a body falls and what it is made of.
struct FallMatter
{
  double friction = 0.6;    ///< on what stands still; between two that fall, the product
  double restitution = 0.1; ///< [0, 1]
};

struct FallSettings
{
  Eigen::Vector3d down{ 0, -1, 0 }; ///< unit vector
  double gravity = 9.81;            ///< scene units / s^2
  double frameTime = 0.04;          ///< seconds between two frames, at which poses are kept
  double size = 0.1;                ///< of what falls, scene units: Bullet's unit of length
};

/// Bodies that fall onto others that stand still: one world of Bullet, in double precision, on the calling thread, with
/// a fixed step. The same calls give the same poses.
class Fall
{
public:
  /// Both must outlive it; `falling` have pieces, in the order of their names.
  Fall(const FallSettings& settings, const std::vector<const PlaceBody*>& still, const std::vector<PlaceBody*>& falling,
    const std::vector<FallMatter>& matter);
  ~Fall();

  /// Goes on until everything rests, at most up to a time since the beginning in seconds. Bodies whose middle is more
  /// than `depth` below `lowest` along `down` are taken out on the way.
  void run(double until, double lowest);
  void remove(std::size_t body);
  bool isIn(std::size_t body) const;
  bool rests(std::size_t body) const;
  /// Seconds that have passed.
  double time() const;
  Rigid3 pose(std::size_t body) const;
  /// Poses of a body at frames 0, 1, ... of the fall.
  const std::vector<Rigid3>& poses(std::size_t body) const;

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
