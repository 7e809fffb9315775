// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetView.h"

#include "dgtkError.h"
#include "dgtkText.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace dgtk
{

Eigen::Matrix3d intrinsicsOf(const CameraRecord& camera, PixelCentre centre)
{
  if (!camera.hasK)
  {
    throw UsageError("camera " + quoted(camera.name) + ": no matrix says how model " + camera.model + " projects");
  }
  Eigen::Matrix3d K = camera.K;
  if (centre == PixelCentre::Integer)
  {
    constexpr double half = 0.5;
    K(0, 2) -= half;
    K(1, 2) -= half;
  }
  return K;
}

Rigid3 cameraFromWorld(const CameraRecord& camera) { return { camera.R, camera.t }; }

Rigid3 worldFromCameraGL(const CameraRecord& camera)
{
  const Rigid3 pose = cameraFromWorld(camera).inverse();
  const Eigen::DiagonalMatrix<double, 3> flip(1, -1, -1);
  return { pose.rotation * flip, pose.translation };
}

std::array<std::vector<double>, 4> matrixRows(const Rigid3& pose)
{
  std::array<std::vector<double>, 4> rows;
  for (int i = 0; i < 3; ++i)
  {
    rows[std::size_t(i)] = { pose.rotation(i, 0), pose.rotation(i, 1), pose.rotation(i, 2), pose.translation[i] };
  }
  rows[3] = { 0, 0, 0, 1 };
  return rows;
}

Eigen::Vector4d quaternionOf(const Eigen::Matrix3d& rotation)
{
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  const Eigen::Vector4d wxyz(q.w(), q.x(), q.y(), q.z());
  return wxyz[0] < 0 ? Eigen::Vector4d(-wxyz) : wxyz;
}

std::vector<double> distortionOf(const CameraRecord& camera)
{
  const auto found = camera.numbers.find("distortion");
  std::vector<double> numbers = found == camera.numbers.end() ? std::vector<double>() : found->second;
  const bool none = std::all_of(numbers.begin(), numbers.end(), [](double k) { return k == 0; });
  return none ? std::vector<double>() : numbers;
}

bool isPinhole(const CameraRecord& camera)
{
  return camera.model == "pinhole" && distortionOf(camera).empty() && camera.rollingShutter.duration == 0;
}

std::string lensText(const CameraRecord& camera)
{
  return camera.model + (distortionOf(camera).empty() ? "" : " with distortion") +
         (camera.rollingShutter.duration == 0 ? "" : " with a rolling shutter");
}

void requirePinholes(const DatasetView& dataset, const std::string& format)
{
  for (const DatasetShot& shot : dataset.shots())
  {
    if (!isPinhole(shot.camera))
    {
      throw UsageError(format + ": camera " + quoted(shot.name()) + " is not a plain pinhole (" +
                       lensText(shot.camera) + "), which the format cannot say; render a pinhole twin of it");
    }
  }
}

void requireNoSkew(const DatasetView& dataset, const std::string& format)
{
  for (const DatasetShot& shot : dataset.shots())
  {
    if (shot.camera.K(0, 1) != 0)
    {
      throw UsageError(
        format + ": camera " + quoted(shot.name()) + " has a skew, which the format cannot say; render a twin of it");
    }
  }
}

std::string namedClass(const std::string& name) { return name.empty() ? "object" : name; }

void SafeNames::reserve(const std::string& name) { this->Taken.insert(lower(name)); }

std::string SafeNames::of(const std::string& original)
{
  const auto known = this->Given.find(original);
  if (known != this->Given.end())
  {
    return known->second;
  }
  std::string safe;
  for (const char c : original)
  {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    safe += plain ? c : '_';
  }
  safe = safe.empty() ? "_" : safe;
  std::string unique = safe;
  for (int i = 2; !this->Taken.insert(lower(unique)).second; ++i)
  {
    unique = safe + "_" + std::to_string(i);
  }
  this->Given[original] = unique;
  return unique;
}

std::shared_ptr<const SafeNames> safeNamesOf(const DatasetView& dataset)
{
  auto names = std::make_shared<SafeNames>();
  for (const std::string& camera : dataset.cameras())
  {
    names->of(camera);
  }
  return names;
}

} // namespace dgtk
