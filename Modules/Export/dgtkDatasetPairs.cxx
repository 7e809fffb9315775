// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetView.h"
#include "dgtkFolder.h"
#include "dgtkLongDocuments.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace dgtk
{

namespace
{
bool isSame(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b, double scale)
{
  constexpr double rounding = 1e-9;
  return (a - b).cwiseAbs().maxCoeff() <= rounding * std::max(scale, 1.0);
}

/// The baseline of a left and a right camera at one frame, when they are rectified.
std::optional<double> baselineOf(const CameraRecord& left, const CameraRecord& right)
{
  const bool like = isPinhole(left) && isPinhole(right) && left.width == right.width && left.height == right.height;
  if (!like || !isSame(left.R, right.R, 1) || !isSame(left.K.leftCols(2), right.K.leftCols(2), left.K(0, 0)) ||
      std::abs(left.K(1, 2) - right.K(1, 2)) > 1e-9 * left.K(1, 1))
  {
    return std::nullopt;
  }
  const Eigen::Vector3d apart = left.t - right.t; // the right centre in the left camera's axes
  const double size = std::max({ left.t.norm(), right.t.norm(), 1e-300 });
  const bool along = std::abs(apart.y()) <= 1e-9 * size && std::abs(apart.z()) <= 1e-9 * size;
  return along && apart.x() > 1e-9 * size ? std::optional<double>(apart.x()) : std::nullopt;
}

/// The same at the last frame of the left camera, when they are rectified at all of them.
std::optional<double> lastBaseline(
  const std::vector<const DatasetShot*>& left, const std::vector<const DatasetShot*>& right)
{
  std::optional<double> baseline;
  auto other = right.begin();
  for (const DatasetShot* shot : left)
  {
    other = std::find_if(other, right.end(), [&](const DatasetShot* one) { return one->frame() >= shot->frame(); });
    const bool there = other != right.end() && (*other)->frame() == shot->frame();
    baseline = there ? baselineOf(shot->camera, (*other)->camera) : std::nullopt;
    if (!baseline)
    {
      break;
    }
  }
  return baseline;
}
} // namespace

std::vector<std::string> DatasetView::disparityPartners() const
{
  const std::vector<std::string> selected = this->cameras();
  const std::vector<int> frames = this->frames();
  std::deque<CameraRecord> others;
  readCameras(dgtk::Folder(this->Folder).fileAt("cameras.json"),
    [&](CameraRecord&& camera)
    {
      camera.name = this->nameOf(camera.name);
      if (isPinhole(camera) && !std::binary_search(selected.begin(), selected.end(), camera.name) &&
          std::binary_search(frames.begin(), frames.end(), camera.frame))
      {
        others.push_back(std::move(camera));
      }
    });
  std::map<int, std::vector<const CameraRecord*>> at;
  for (const DatasetShot& shot : this->Shots)
  {
    at[shot.frame()].push_back(&shot.camera);
  }
  for (const CameraRecord& camera : others)
  {
    at[camera.frame].push_back(&camera);
  }
  for (auto& [frame, cameras] : at)
  {
    std::sort(
      cameras.begin(), cameras.end(), [](const CameraRecord* a, const CameraRecord* b) { return a->name < b->name; });
  }
  std::vector<std::string> partners;
  for (const DatasetShot& shot : this->Shots)
  {
    std::string partner;
    double nearest = std::numeric_limits<double>::infinity();
    for (const CameraRecord* const other : at[shot.frame()])
    {
      const std::optional<double> right = baselineOf(shot.camera, *other);
      const std::optional<double> baseline = right ? right : baselineOf(*other, shot.camera);
      if (baseline && *baseline < nearest * (1 - 1e-9))
      {
        nearest = *baseline;
        partner = other->name;
      }
    }
    partners.push_back(std::move(partner));
  }
  return partners;
}

std::vector<RectifiedPair> DatasetView::rectifiedPairs() const
{
  std::vector<std::vector<const DatasetShot*>> cameras;
  for (const std::string& camera : this->cameras())
  {
    cameras.push_back(this->shotsOf(camera));
  }
  std::vector<RectifiedPair> pairs;
  for (const std::vector<const DatasetShot*>& left : cameras)
  {
    for (const std::vector<const DatasetShot*>& right : cameras)
    {
      const std::optional<double> baseline = &left == &right ? std::nullopt : lastBaseline(left, right);
      if (baseline)
      {
        pairs.push_back({ left[0]->name(), right[0]->name(), *baseline });
      }
    }
  }
  return pairs;
}

} // namespace dgtk
