// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEye_h
#define dgtkEye_h

#include "dgtkCameraModel.h"
#include "dgtkDatasetDocuments.h"
#include "dgtkEyeLens.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace dgtk
{

/// A camera of cameras.json with arithmetic of its own: rays and projections of the linear models, projections of the
/// lenses that EyeLens knows. A lens is asked for its rays (which a check projects) and its domain; a model of a
/// program of its own for all.
class Eye
{
public:
  /// `model` is used unless the record says a camera without a lens, "pinhole" or "orthographic". Throws UsageError for
  /// a K that no camera has.
  Eye(const CameraRecord& record, std::shared_ptr<const CameraModel> model);

  const CameraRecord& record() const { return this->Record; }
  int width() const { return this->Record.width; }
  int height() const { return this->Record.height; }
  bool linear() const { return this->Pinhole || this->Parallel; }
  bool pinhole() const { return this->Pinhole; }
  /// Null for the linear models and those of a program of its own.
  const EyeLens* lens() const { return this->Lens.get(); }

  /// Origin and direction in the camera frame; direction.z is 1 for the linear models.
  CameraRay ray(const Eigen::Vector2d& pixel) const;
  /// The point of the pixel's ray at a depth, camera frame.
  Eigen::Vector3d at(const Eigen::Vector2d& pixel, double depth) const;
  Eigen::Vector3d toWorld(const Eigen::Vector3d& x_in_camera) const
  {
    return this->Record.R.transpose() * (x_in_camera - this->Record.t);
  }
  Eigen::Vector3d toCamera(const Eigen::Vector3d& x_in_world) const
  {
    return this->Record.R * x_in_world + this->Record.t;
  }
  /// False behind the camera.
  bool project(const Eigen::Vector3d& x_in_camera, Eigen::Vector2d& pixel) const;
  /// What near and far bound of a point and the pixel that it is projected to: its depth, or the distance of a model
  /// that is not linear.
  double range(const Eigen::Vector2d& pixel, const Eigen::Vector3d& x_in_camera) const;
  /// Pixels that a small angle turns a ray by, at most about; of a parallel projection, that a small part of the depth
  /// is.
  Eigen::Vector2d reach(double angle, const Eigen::Vector3d& x_in_camera) const;
  /// Inside the image, and between near and far.
  bool sees(const Eigen::Vector2d& pixel, const Eigen::Vector3d& x_in_camera) const;

  /// What a residual at a depth is divided by. Numbers of the world have 16 digits: of a camera a million times as far
  /// from the world's origin as from what it sees, ten are left. 1 up to a thousand times.
  double farness(double depth) const
  {
    constexpr double most = 1000;
    return std::max(1.0, this->Record.t.norm() / (most * std::abs(depth)));
  }
  /// The same of a point, camera frame: of a model that is not linear its distance counts, as its depth may be 0.
  double farness(const Eigen::Vector3d& x_in_camera) const
  {
    return this->farness(this->linear() ? x_in_camera.z() : x_in_camera.norm());
  }

  /// The same camera elsewhere.
  Eye movedTo(const Rigid3& camera_from_world) const
  {
    Eye moved = *this;
    moved.Record.R = camera_from_world.rotation;
    moved.Record.t = camera_from_world.translation;
    moved.TheView.camera_from_world = camera_from_world;
    return moved;
  }

  /// For the ray engine.
  const View& view() const { return this->TheView; }

private:
  CameraRecord Record;
  bool Pinhole;
  bool Parallel;
  std::shared_ptr<const EyeLens> Lens;
  View TheView;
};

/// Centre of a pixel.
inline Eigen::Vector2d centreOf(int x, int y) { return { x + 0.5, y + 0.5 }; }

} // namespace dgtk

#endif
