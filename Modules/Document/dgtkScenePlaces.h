// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkScenePlaces_h
#define dgtkScenePlaces_h

#include "dgtkDocumentModule.h"

#include "dgtkCameraModel.h"
#include "dgtkModelLibrary.h"
#include "dgtkSceneEdits.h"

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace dgtk
{

/// An axis-parallel box in the world; empty while min > max.
struct DGTKDOCUMENT_EXPORT WorldBox
{
  Eigen::Vector3d min{ 1, 1, 1 };
  Eigen::Vector3d max{ -1, -1, -1 };
  bool empty() const { return (this->min.array() > this->max.array()).any(); }
  void add(const Eigen::Vector3d& point);
  void add(const WorldBox& box);
  Eigen::Vector3d center() const { return (this->min + this->max) / 2; }
  double diagonal() const { return this->empty() ? 0.0 : (this->max - this->min).norm(); }
};

/// An object of the scene at a frame.
struct ObjectPlace
{
  Instance instance; ///< model null: nothing to show
  bool visible = true;
  Affine3 world_from_parent;
  WorldBox box; ///< of its vertices, world
  /// World, the middle of its vertices' box in its own axes; its origin where both differ by rounding only, and of what
  /// has no vertices.
  Eigen::Vector3d center{ 0, 0, 0 };
};

/// A camera at a frame as it is drawn.
struct CameraPlace
{
  bool valid = false; ///< false where its pose is undefined
  View view;
  Eigen::Vector3d center{ 0, 0, 0 };
};

/// Where everything of a scene is at a frame; indices as in the description.
struct DGTKDOCUMENT_EXPORT ScenePlaces
{
  double frame = 0;
  std::vector<ObjectPlace> objects;
  std::vector<CameraPlace> cameras;
  std::vector<Eigen::Vector3d> lights;
  WorldBox box; ///< of all that is visible, cameras' centres and lights that have a place
  /// Lights, background, environment and fog as Stage::at() has them; no instances. Never null.
  std::shared_ptr<const SceneState> surroundings;

  WorldBox boxOf(const SceneItem& item) const;
};

constexpr int usualImageSize[2] = { 640, 480 }; ///< pixels, of a camera that has none
constexpr int largestImage = 1 << 20;           ///< pixels a side
/// The vertical field of view, degrees, of a camera with a matrix K, by its model: the angle between the middles of the
/// upper and the lower side were the principal point in the middle, without the distortion; 180 and more of lenses that
/// see so much. Nothing where the lens does not see those places. Parameters with keys are those of frame 0.
DGTKDOCUMENT_EXPORT std::optional<double> fieldOfViewOf(const CameraDescription& camera);

/// A scale of 0 is no error: what it flattens has a place, too.
DGTKDOCUMENT_EXPORT ScenePlaces placeScene(const SceneDescription& scene, const ModelLibrary& models, double frame);

/// x_in_world(t) = origin + t * direction, least < t < most.
struct WorldRay
{
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
  double least = 0;
  double most = std::numeric_limits<double>::infinity();
};

/// The first visible object that a ray meets, exactly by its triangles, or a camera or light whose place the ray passes
/// within `reach` (world units at parameter 1 of the ray if it widens, everywhere otherwise). What is at the ray's
/// beginning is not met: it may be the camera that one looks through.
struct PickReach
{
  double constant = 0;
  double slope = 0; ///< for each unit of the parameter
};
DGTKDOCUMENT_EXPORT std::optional<SceneItem> pickItem(
  const ScenePlaces& places, const WorldRay& ray, const PickReach& reach);

} // namespace dgtk

#endif
