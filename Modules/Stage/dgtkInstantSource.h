// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkInstantSource_h
#define dgtkInstantSource_h

#include "dgtkLayer.h"
#include "dgtkSceneState.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace dgtk
{

/// A camera of a scene, and the scene, at any time. Thread-safe.
class InstantSource
{
public:
  struct Instant
  {
    std::shared_ptr<const SceneState> state;
    Rigid3 camera_from_world;
  };
  struct Point
  {
    Eigen::Vector3d x_in_world{ 0, 0, 0 };
    Rigid3 camera_from_world;
  };

  virtual ~InstantSource() = default;
  /// The picture's own time: that of CameraModel::timeAt() = 0.
  virtual double frame() const = 0;
  /// Throws what Stage::at() and Stage::view() throw. The states of the pixels' own times are kept.
  virtual Instant at(double frame) const = 0;
  /// One object (id >= 1) of at(), for less; not kept.
  virtual Instance instanceAt(double frame, std::uint32_t object) const = 0;
  /// What every object does, by id - 1.
  enum class Motion : std::uint8_t
  {
    None,
    Rigid, ///< only its place changes
    Any
  };
  virtual const std::vector<Motion>& motions() const = 0;
  /// camera_from_world at a frame.
  virtual Rigid3 poseAt(double frame) const = 0;
  /// world_from_object at a frame: that of at(), for less.
  virtual Affine3 placeAt(double frame, std::uint32_t object) const = 0;
  /// Whether an object is there at a frame.
  virtual bool isVisibleAt(double frame, std::uint32_t object) const = 0;
  /// A point of a triangle of an object (id >= 1) by the weights of the second and third corner, and the camera:
  /// those of at(), for less.
  virtual Point pointAt(
    double frame, std::uint32_t object, std::uint32_t triangle, const Eigen::Vector2d& barycentrics) const = 0;
};

/// What is seen of a scene at one instant.
struct SeenInstant
{
  std::shared_ptr<const SceneState> state;
  View view; ///< without `instants`
};

/// What a view with `instants` sees `time` frames after its picture's own.
inline SeenInstant instantOf(const View& view, double time)
{
  InstantSource::Instant now = view.instants->at(view.instants->frame() + time);
  SeenInstant seen{ std::move(now.state), view };
  seen.view.instants = nullptr;
  seen.view.camera_from_world = now.camera_from_world;
  return seen;
}

/// Part of an image whose pixels are seen at one time.
struct TimedRect
{
  PixelRect rect;
  double time = 0; ///< frames after the picture's own
};
/// The parts of a rectangle: whole columns where all rows see them alike, otherwise runs of pixels row by row.
DGTKSTAGE_EXPORT std::vector<TimedRect> timedRects(const CameraModel& model, const PixelRect& rect);
/// Runs of pixels only, row by row.
DGTKSTAGE_EXPORT std::vector<TimedRect> timedRuns(const CameraModel& model, const PixelRect& rect);

} // namespace dgtk

#endif
