// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColmap.h"

#include "dgtkColmapRigs.h"
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkMovingObjects.h"

#include <algorithm>

namespace dgtk::colmap
{

namespace
{
[[noreturn]] void refuse(const CameraRecord& camera, const std::string& format, const std::string& what)
{
  throw UsageError(format + ": camera " + quoted(camera.name) + " has " + what +
                   ", which COLMAP has no model for; render a twin of it");
}

/// OpenCV's order k1 k2 p1 p2 k3 k4 k5 k6, then thin prisms and tilts.
CameraModel brown(const CameraRecord& camera, const std::string& format)
{
  constexpr std::size_t few = 4;
  constexpr std::size_t many = 8;
  std::vector<double> k = distortionOf(camera);
  if (k.empty())
  {
    return {};
  }
  if (std::any_of(k.begin() + std::ptrdiff_t(std::min(many, k.size())), k.end(), [](double c) { return c != 0; }))
  {
    refuse(camera, format, "thin prisms or a tilted sensor");
  }
  const bool simple =
    std::all_of(k.begin() + std::ptrdiff_t(std::min(few, k.size())), k.end(), [](double c) { return c == 0; });
  k.resize(simple ? few : many);
  return simple ? CameraModel{ 4, "OPENCV", k } : CameraModel{ 6, "FULL_OPENCV", k };
}

CameraModel fisheye(const CameraRecord& camera)
{
  std::vector<double> k = distortionOf(camera);
  k.resize(4);
  return { 5, "OPENCV_FISHEYE", k };
}
} // namespace

CameraModel modelOf(const CameraRecord& camera, PixelCentre centre, const std::string& format)
{
  if (camera.model != "pinhole" && camera.model != "fisheye")
  {
    refuse(camera, format, "the model " + camera.model);
  }
  if (camera.rollingShutter.duration != 0)
  {
    refuse(camera, format, "a rolling shutter");
  }
  const Eigen::Matrix3d K = intrinsicsOf(camera, centre);
  if (K(0, 1) != 0)
  {
    refuse(camera, format, "a skew");
  }
  CameraModel model = camera.model == "fisheye" ? fisheye(camera) : brown(camera, format);
  model.numbers.insert(model.numbers.begin(), { K(0, 0), K(1, 1), K(0, 2), K(1, 2) });
  return model;
}

const ChoiceOption& modelFormat()
{
  static const ChoiceOption row("model_format", { "bin", "txt" }, "files of COLMAP's models");
  return row;
}

const ChoiceOption& moving()
{
  static const ChoiceOption row("moving", { "mask", "frame" },
    "mask: one model of what stands still, the rest is masked; frame: a model for every frame");
  return row;
}

const ChoiceOption& pictureNames()
{
  static const ChoiceOption row(
    "picture_names", { "folders", "flat" }, "a folder for each camera, or CAMERA_FRAME beside each other");
  return row;
}

std::vector<const OptionRow*> optionRows() { return { &modelFormat(), &moving(), &pictureNames(), &rigs() }; }

std::vector<std::shared_ptr<const Views>> viewsOf(
  const DatasetView& dataset, const OptionValues& options, PixelCentre centre)
{
  const std::string between = pictureNames().of(options) == "flat" ? "_" : "/";
  const std::string extension = '.' + pictureExtension(options);
  const auto name = [names = safeNamesOf(dataset), between, extension](const DatasetShot& shot)
  { return names->known(shot.name()) + between + padded(shot.frame(), 6) + extension; };
  std::map<int, std::shared_ptr<Views>> byFrame;
  for (const DatasetShot& shot : dataset.shots())
  {
    std::shared_ptr<Views>& views = byFrame[moving().of(options) == "frame" ? shot.frame() : 0];
    if (!views)
    {
      views = std::make_shared<Views>(Views{ {}, name, centre });
    }
    views->shots.push_back(&shot);
  }
  std::vector<std::shared_ptr<const Views>> all;
  all.reserve(byFrame.size());
  for (const auto& [frame, views] : byFrame)
  {
    all.push_back(views);
  }
  return all;
}

std::optional<int> frameOf(const Views& views)
{
  const int first = views.shots.front()->frame();
  const bool same = std::all_of(
    views.shots.begin(), views.shots.end(), [first](const DatasetShot* shot) { return shot->frame() == first; });
  return same ? std::optional<int>(first) : std::nullopt;
}

std::vector<std::uint32_t> leftOut(const DatasetView& dataset, const Views& views)
{
  return frameOf(views) ? std::vector<std::uint32_t>() : movingObjects(dataset);
}

} // namespace dgtk::colmap
