// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCentrePoints_h
#define dgtkCentrePoints_h

#include "dgtkCameraModel.h"

#include <Eigen/Core>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

namespace dgtk
{

/// The points of the plane that a lens shows at the centres of an image's pixels, each row computed when it is first
/// asked for. Models of the same lens share them, so that a camera that does not change from frame to frame computes
/// them once. Thread-safe.
class CentrePoints
{
public:
  /// Those of a camera by its size, K and distortion; of one that was asked for lately they are there already. None of
  /// images so large that they would take more than 64 MiB, and no more than 128 MiB together.
  static std::shared_ptr<const CentrePoints> of(const CameraParameters& camera, const Eigen::Matrix3d& K);
  CentrePoints(int width, int height);

  /// What undo(pixel, point), bool, gives, of any image point.
  template <class Undo>
  bool point(const Eigen::Vector2d& pixel, const Undo& undo, Eigen::Vector2d& point) const
  {
    const Eigen::Vector2d* const known = this->find(pixel, undo);
    if (!known)
    {
      return undo(pixel, point);
    }
    point = *known;
    return !std::isnan(point.x());
  }

private:
  /// Not-a-number where there is none; null where `pixel` is no centre.
  template <class Undo>
  const Eigen::Vector2d* find(const Eigen::Vector2d& pixel, const Undo& undo) const
  {
    if (!(pixel.x() >= 0 && pixel.x() < this->Width && pixel.y() >= 0 && pixel.y() < this->Height))
    {
      return nullptr;
    }
    const int x = static_cast<int>(pixel.x());
    const int y = static_cast<int>(pixel.y());
    if (pixel.x() != x + 0.5 || pixel.y() != y + 0.5)
    {
      return nullptr;
    }
    Eigen::Vector2d* const row = this->Points.get() + std::size_t(y) * std::size_t(this->Width);
    if (!this->Known[std::size_t(y)].load(std::memory_order_acquire))
    {
      this->compute(row, y, undo);
    }
    return row + x;
  }
  template <class Undo>
  void compute(Eigen::Vector2d* row, int y, const Undo& undo) const
  {
    const std::lock_guard<std::mutex> lock(this->Mutexes[std::size_t(y) % std::size(this->Mutexes)]);
    for (int x = 0; x < this->Width && !this->Known[std::size_t(y)]; ++x)
    {
      if (!undo(Eigen::Vector2d(x + 0.5, y + 0.5), row[x]))
      {
        row[x].setConstant(std::numeric_limits<double>::quiet_NaN());
      }
    }
    this->Known[std::size_t(y)].store(true, std::memory_order_release);
  }

  int Width;
  int Height;
  std::unique_ptr<Eigen::Vector2d[]> Points;
  mutable std::mutex Mutexes[16];               ///< of rows, so that threads compute different ones
  mutable std::vector<std::atomic<bool>> Known; ///< rows
};

} // namespace dgtk

#endif
