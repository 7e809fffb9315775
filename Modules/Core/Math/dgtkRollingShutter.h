// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRollingShutter_h
#define dgtkRollingShutter_h

#include <Eigen/Core>

#include <algorithm>
#include <string>
#include <vector>

namespace dgtk
{

/// When the rows or columns of an image are seen: one after another, from the image's one border to the other.
struct RollingShutter
{
  enum class Direction
  {
    Down, ///< the top row first
    Up,
    Right, ///< the left column first
    Left
  };
  double duration = 0; ///< frames from border to border, [0, 1000]; 0: all at once
  Direction direction = Direction::Down;

  /// When an image point of an image of some size is seen, frames after the image's own; points beside the image as
  /// its border.
  double timeAt(const Eigen::Vector2d& pixel, int width, int height) const
  {
    const bool rows = this->direction == Direction::Down || this->direction == Direction::Up;
    const bool reversed = this->direction == Direction::Up || this->direction == Direction::Left;
    const double part = rows ? pixel.y() / height : pixel.x() / width;
    const double time = this->duration * (std::min(std::max(part, 0.0), 1.0) - 0.5);
    return reversed ? -time : time;
  }
  bool operator==(const RollingShutter& o) const
  {
    return this->duration == o.duration && this->direction == o.direction;
  }
};

/// Words of files, in the order of RollingShutter::Direction.
inline const std::vector<std::string>& rollingDirections()
{
  static const std::vector<std::string> words{ "down", "up", "right", "left" };
  return words;
}

} // namespace dgtk

#endif
