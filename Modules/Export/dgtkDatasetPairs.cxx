// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetView.h"
#include "dgtkFolder.h"
#include "dgtkLongDocuments.h"

#include <algorithm>
#include <deque>
#include <limits>

namespace dgtk
{

namespace
{
/// Lengths between cameras are as exact as the places that they are differences of.
double roundingBetween(const CameraRecord& a, const CameraRecord& b)
{
  return 4 * std::numeric_limits<double>::epsilon() * (a.t.norm() + b.t.norm());
}

/// The baseline of a left and a right camera at one frame, when they are rectified: as the layer `disparity` has it.
std::optional<double> baselineOf(const CameraRecord& left, const CameraRecord& right)
{
  constexpr double same = 1e-9;
  if (!isPinhole(left) || !isPinhole(right) || left.width != right.width || left.height != right.height)
  {
    return std::nullopt;
  }
  Eigen::Matrix3d K = left.K - right.K;
  K(0, 2) = 0;
  const Eigen::Vector3d apart = left.t - right.t; // the right centre in the left camera's axes
  const double rounding = roundingBetween(left, right);
  const bool rectified = K.cwiseAbs().maxCoeff() <= same * left.K(0, 0) &&
                         (left.R - right.R).cwiseAbs().maxCoeff() <= same && apart.x() > rounding &&
                         apart.tail<2>().cwiseAbs().maxCoeff() <= same * apart.x() + rounding;
  return rectified ? std::optional<double>(apart.x()) : std::nullopt;
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
    double nearest = 0;
    for (const CameraRecord* const other : at[shot.frame()])
    {
      const std::optional<double> right = baselineOf(shot.camera, *other);
      const std::optional<double> baseline = right ? right : baselineOf(*other, shot.camera);
      if (baseline && (partner.empty() || *baseline < nearest * (1 - 1e-9) - 2 * roundingBetween(shot.camera, *other)))
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
