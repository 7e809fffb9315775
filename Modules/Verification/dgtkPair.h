// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPair_h
#define dgtkPair_h

#include "dgtkPicture.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// What the values of a layer between two views mean.
enum class PairKind
{
  Place,        ///< (x', y')
  Displacement, ///< (x' - x, y' - y)
  FromLeft,     ///< x - x'
  FromRight,    ///< x' - x
  Motion        ///< of the point in the world, in the axes of the first camera
};

/// A layer of a picture that relates it to another view.
struct Pair
{
  std::string layer; ///< its folder
  PairKind kind = PairKind::Place;
  std::string camera;                 ///< the other one
  int frame = 0;                      ///< the other one
  std::shared_ptr<const Sight> other; ///< at the other frame's own time
  /// Fundamental matrices and triangulation hold: nothing moves in between.
  bool sameFrame = false;
  std::shared_ptr<const TimedSight> timed = nullptr; ///< the other one with the times of its pixels
  /// The picture's own camera at the other frame: a disparity of then. Null for one of the pixels.
  std::shared_ptr<const Sight> ownThen = nullptr;
};

/// The layers of a picture that relate it to other views, of those that the dataset has.
std::vector<Pair> pairsOf(Picture& picture);

/// The values of a pair, and its class image; null where there is none.
PicturePointer pairValues(Picture& picture, const Pair& pair);
PicturePointer pairClasses(Picture& picture, const Pair& pair);

/// Where the surface point of a pixel is seen in the other view, derived anew.
struct Target
{
  bool surface = false;             ///< the pixel shows something
  bool ok = false;                  ///< its object can be carried
  bool projects = false;            ///< not behind the other camera
  Eigen::Vector3d here{ 0, 0, 0 };  ///< the point at this frame, this camera
  Eigen::Vector3d world{ 0, 0, 0 }; ///< the point at the other frame
  Eigen::Vector3d there{ 0, 0, 0 }; ///< the point at the other frame, other camera
  Eigen::Vector2d pixel{ 0, 0 };    ///< its projection, where it projects
  double time = 0;                  ///< when it is seen there, frames after the other picture's own
  bool timed = true;                ///< that is known; false where it does not settle
  double slack = 0;                 ///< pixels, of one that does not: what its time may be off
};

class PairTargets
{
public:
  /// Prepares the picture's surfaces and points.
  PairTargets(Picture& picture, const Pair& pair);
  Target at(int x, int y) const { return this->at(x, y, this->hit(x, y)); }
  Target at(int x, int y, const Hit& hit) const;
  /// What a target moves while the time at which a rolling shutter sees it may be off: in pixels, or of a motion in
  /// scene units.
  double moves(int x, int y, const Hit& hit, const Target& target) const;
  const Hit& hit(int x, int y) const { return this->Seen.hits[this->Seen.index(x, y)]; }

private:
  bool findTime(int x, int y, const Hit& hit, Target& target) const;

  Picture& Owner;
  const Surfaces& Seen;
  const Pair& ThePair;
  PicturePointer Values; ///< places of which the other camera's times are taken
};

} // namespace dgtk

#endif
