// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraArray.h"

#include "dgtkCameraModel.h"
#include "dgtkError.h"
#include "dgtkPortableMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>

namespace dgtk
{

namespace
{
constexpr double goldenAngle = 2.39996322972865332; // pi (3 - sqrt 5)
constexpr int mostCameras = 10000;
constexpr double leastHeight = 1e-3; // sine of the elevation of the hemisphere's highest gap to its pole

void check(const CameraArrayOptions& options)
{
  const CameraArrayKind kind = options.kind;
  if (isCounted(kind) && (options.count < 1 || options.count > mostCameras))
  {
    throw UsageError("number of cameras: expected 1 to 10000");
  }
  const long gridCameras = long(options.columns) * options.rows;
  if (kind == CameraArrayKind::Grid && (options.columns < 1 || options.rows < 1 || gridCameras > mostCameras))
  {
    throw UsageError("columns and rows: expected 1 to 10000 cameras in all");
  }
  if (isSpaced(kind) && !(options.spacing > 0))
  {
    throw UsageError("spacing: expected a number above 0");
  }
}

CameraDescription placed(const CameraArrayOptions& options, const Eigen::Vector3d& eye, const Eigen::Vector3d& lookAt,
  const std::string& suffix)
{
  CameraDescription camera = options.first;
  camera.name += '-' + suffix;
  camera.eye = eye;
  camera.lookAt = lookAt;
  return camera;
}

/// About `lookAt`: directions from it, of the length of the eye's.
std::vector<CameraDescription> around(const CameraArrayOptions& options, const std::vector<Eigen::Vector3d>& directions)
{
  std::vector<CameraDescription> cameras;
  for (const Eigen::Vector3d& direction : directions)
  {
    const Eigen::Vector3d lookAt = options.first.lookAt.value;
    cameras.push_back(placed(options, lookAt + direction, lookAt, std::to_string(cameras.size() + 1)));
  }
  return cameras;
}

std::vector<CameraDescription> along(const CameraArrayOptions& options)
{
  const std::vector<Eigen::Vector3d>& eyes = options.path.eyes;
  const std::vector<Eigen::Vector3d>& targets = options.path.targets;
  std::vector<double> ends{ 0 }; // length of the path up to each point
  for (std::size_t i = 1; i < eyes.size(); ++i)
  {
    ends.push_back(ends.back() + (eyes[i] - eyes[i - 1]).norm());
  }
  if (eyes.size() < 2 || targets.size() != eyes.size() || !(ends.back() > 0))
  {
    throw UsageError("path: expected at least two different points");
  }
  std::vector<CameraDescription> cameras;
  for (int i = 0; i < options.count; ++i)
  {
    const double at = options.count == 1 ? 0.0 : ends.back() * i / (options.count - 1);
    std::size_t segment = 1;
    while (segment + 1 < ends.size() && ends[segment] < at)
    {
      ++segment;
    }
    const double length = ends[segment] - ends[segment - 1];
    const double u = length > 0 ? std::min(1.0, (at - ends[segment - 1]) / length) : 0.0;
    const Eigen::Vector3d eye = eyes[segment - 1] + u * (eyes[segment] - eyes[segment - 1]);
    const Eigen::Vector3d target = targets[segment - 1] + u * (targets[segment] - targets[segment - 1]);
    lookAtPose(eye, target, options.first.up.value); // throws where there is no pose
    cameras.push_back(placed(options, eye, target, std::to_string(i + 1)));
  }
  return cameras;
}
} // namespace

CameraPath keyFramePath(const CameraDescription& camera)
{
  std::set<int> frames;
  const auto collect = [&](const auto& track)
  {
    for (const auto& key : track.keys)
    {
      frames.insert(key.frame);
    }
  };
  collect(camera.posed ? camera.position : camera.eye);
  collect(camera.lookAt);
  collect(camera.orientation);
  CameraPath path;
  for (const int frame : frames)
  {
    const Eigen::Vector3d eye = (camera.posed ? camera.position : camera.eye).at(frame);
    path.eyes.push_back(eye);
    path.targets.push_back(
      camera.posed ? Eigen::Vector3d(eye + camera.orientation.at(frame).matrix().col(2)) : camera.lookAt.at(frame));
  }
  return path;
}

std::vector<CameraDescription> cameraArray(const CameraArrayOptions& options)
{
  check(options);
  if (options.kind == CameraArrayKind::Path)
  {
    return along(options);
  }
  const Eigen::Vector3d eye = options.first.eye.value;
  const Eigen::Vector3d lookAt = options.first.lookAt.value;
  const Eigen::Vector3d up = options.first.up.value.normalized();
  const Eigen::Matrix3d R = lookAtPose(eye, lookAt, up).rotation; // throws where there is no pose
  const Eigen::Vector3d right = R.row(0).transpose();
  const Eigen::Vector3d down = R.row(1).transpose();
  const Eigen::Vector3d arm = eye - lookAt;
  std::vector<Eigen::Vector3d> directions;
  switch (options.kind)
  {
    case CameraArrayKind::Ring:
      for (int i = 0; i < options.count; ++i)
      {
        directions.push_back(Eigen::AngleAxisd(2 * pi * i / options.count, up) * arm);
      }
      return around(options, directions);
    case CameraArrayKind::Hemisphere:
      for (int i = 0; i < options.count; ++i)
      {
        // Equal steps in height are equal areas.
        const double height = std::min((i + 0.5) / options.count, 1 - leastHeight);
        const Eigen::Vector3d level = Eigen::AngleAxisd(goldenAngle * i, up) * right;
        directions.push_back(arm.norm() * (height * up + std::sqrt(1 - height * height) * level));
      }
      return around(options, directions);
    case CameraArrayKind::Grid:
    {
      std::vector<CameraDescription> cameras;
      for (int row = 0; row < options.rows; ++row)
      {
        for (int column = 0; column < options.columns; ++column)
        {
          const Eigen::Vector3d step = options.spacing * ((column - (options.columns - 1) / 2.0) * right +
                                                           (row - (options.rows - 1) / 2.0) * down);
          cameras.push_back(placed(options, eye + step, lookAt + step, std::to_string(cameras.size() + 1)));
        }
      }
      return cameras;
    }
    default:
    {
      const Eigen::Vector3d step = options.spacing / 2 * right;
      return { placed(options, eye - step, lookAt - step, "left"),
        placed(options, eye + step, lookAt + step, "right") };
    }
  }
}

} // namespace dgtk
