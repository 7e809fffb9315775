// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovCamera.h"

#include "dgtkError.h"
#include "dgtkPovText.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// Distances of the written scene stay below; POV-Ray's largest is 1e7, lights stand at 4 radii.
constexpr double mostDistance = 1 << 17;
constexpr int blurSamples = 128;
} // namespace

double povSceneScale(const View& view, const PovBall& ball)
{
  const double reach = (view.camera_from_world * ball.centre).norm() + ball.radius;
  return std::ldexp(1.0, std::clamp(std::ilogb(mostDistance / reach), -1000, 1000));
}

/// A ray is location + direction + a right + b up; a from -1/2 at the image's left side to 1/2 at its right, b upwards.
/// Written in axes x left, y up, z forward, which `matrix` turns into the world: a right-handed frame, in which `right`
/// has a negative x, by which readers know that the world is right-handed.
std::string povCamera(const View& view, const PovRows& rows, const std::optional<PovLens>& lens, double scale)
{
  const auto linear = view.model->linear();
  if (!linear)
  {
    const std::string model = view.model->name();
    throw UsageError("camera " + quoted(view.name) + " (" + model + (model == "pinhole" ? " with distortion" : "") +
                     ") cannot be written for POV-Ray");
  }
  const double width = view.model->width();
  const double top = rows.first;
  const double bottom = rows.count > 0 ? rows.first + rows.count : view.model->height();
  const auto at = [&](double u, double v) -> Eigen::Vector3d
  {
    const CameraRay ray = view.model->rayThrough({ u, v });
    const Eigen::Vector3d& on = linear->perspective ? ray.direction : ray.origin;
    return { -on.x(), -on.y(), on.z() };
  };
  const Eigen::Vector3d middle = at(width / 2, (top + bottom) / 2);
  const Rigid3 world_from_camera = view.camera_from_world.inverse();
  Affine3 world_from_pov{ world_from_camera.rotation, world_from_camera.translation };
  world_from_pov.linear.leftCols<2>() *= -1;
  const Eigen::Vector3d location = linear->perspective ? Eigen::Vector3d(0, 0, 0) : middle;
  const Eigen::Vector3d direction = linear->perspective ? middle : Eigen::Vector3d(0, 0, 1);
  const Eigen::Vector3d right = at(width, top) - at(0, top);
  const Eigen::Vector3d up = at(width / 2, top) - at(width / 2, bottom);
  std::string text = std::string("camera {\n  ") + (linear->perspective ? "perspective" : "orthographic") +
                     "\n  location " + povVector(location) + "\n  direction " + povVector(direction) + "\n  right " +
                     povVector(right) + "\n  up " + povVector(up);
  if (lens)
  {
    text += "\n  aperture " + povNumber(lens->aperture * scale) + " focal_point " +
            povVector(Eigen::Vector3d(0, 0, lens->focus)) + " blur_samples " + std::to_string(blurSamples) +
            " variance 0";
  }
  return text + "\n  " + povMatrix(world_from_pov) + povScale(scale) + "\n}\n";
}

} // namespace dgtk
