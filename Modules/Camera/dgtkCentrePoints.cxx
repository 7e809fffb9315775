// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCentrePoints.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr std::size_t mostPixels = std::size_t(1) << 22;
constexpr std::size_t mostTogether = 2 * mostPixels; // of a rig, frame by frame
constexpr std::size_t mostCameras = 64;

struct KnownLens
{
  CameraParameters camera;
  Eigen::Matrix3d K;
  std::shared_ptr<const CentrePoints> points;
  bool isOf(const CameraParameters& other, const Eigen::Matrix3d& matrix) const
  {
    return this->camera.width == other.width && this->camera.height == other.height && this->K == matrix &&
           this->camera.numbers.at("distortion") == other.numbers.at("distortion");
  }
};

std::size_t pixelsOf(const CameraParameters& camera) { return std::size_t(camera.width) * std::size_t(camera.height); }
} // namespace

CentrePoints::CentrePoints(int width, int height)
  : Width(width)
  , Height(height)
  , Points(new Eigen::Vector2d[std::size_t(width) * std::size_t(height)])
  , Known(std::size_t(height))
{
}

std::shared_ptr<const CentrePoints> CentrePoints::of(const CameraParameters& camera, const Eigen::Matrix3d& K)
{
  static std::mutex mutex;
  static std::vector<KnownLens> lenses; // the one asked for last is the last
  if (pixelsOf(camera) > mostPixels)
  {
    return std::make_shared<const CentrePoints>(0, 0);
  }
  const std::lock_guard<std::mutex> lock(mutex);
  const auto known =
    std::find_if(lenses.begin(), lenses.end(), [&](const KnownLens& lens) { return lens.isOf(camera, K); });
  if (known != lenses.end())
  {
    std::rotate(known, known + 1, lenses.end());
    return lenses.back().points;
  }
  std::size_t cameras = 1;
  std::size_t pixels = pixelsOf(camera);
  const auto fits = [&](const KnownLens& lens)
  { return ++cameras <= mostCameras && (pixels += pixelsOf(lens.camera)) <= mostTogether; };
  lenses.erase(lenses.begin(), std::find_if_not(lenses.rbegin(), lenses.rend(), fits).base());
  lenses.push_back({ camera, K, std::make_shared<const CentrePoints>(camera.width, camera.height) });
  return lenses.back().points;
}

} // namespace dgtk
