// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkColmap_h
#define dgtkColmap_h

// Private to Export: models as COLMAP has them (src/base/reconstruction.cc, camera_models.h, "Output Format").

#include "dgtkExporter.h"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dgtk::colmap
{

/// How a camera projects, in COLMAP's terms.
struct CameraModel
{
  int id = 1; ///< as in binary files
  std::string name = "PINHOLE";
  std::vector<double> numbers; ///< fx fy cx cy, then what the model adds
};
/// Throws a UsageError that begins with the format's name for lenses, skew and shutters that COLMAP cannot say.
CameraModel modelOf(const CameraRecord& camera, PixelCentre centre, const std::string& format);

/// Pictures that one model joins.
struct Views
{
  std::vector<const DatasetShot*> shots;
  std::function<std::string(const DatasetShot&)> name; ///< of a shot's picture, relative to images/
  PixelCentre centre = PixelCentre::Half;
};

/// "bin" or "txt"
const ChoiceOption& modelFormat();
/// What becomes of objects that move: "mask" or "frame"
const ChoiceOption& moving();
/// "folders" or "flat"
const ChoiceOption& pictureNames();
/// These rows, and rigs() of dgtkColmapRigs.h.
std::vector<const OptionRow*> optionRows();

/// Pictures by model: all of them, or those of each frame.
std::vector<std::shared_ptr<const Views>> viewsOf(
  const DatasetView& dataset, const OptionValues& options, PixelCentre centre);
/// The frame of a model's pictures; none where they are of several.
std::optional<int> frameOf(const Views& views);
/// Ids of the objects that a model of these pictures does not hold: they move between them.
std::vector<std::uint32_t> leftOut(const DatasetView& dataset, const Views& views);

/// cameras, images, points3D in a folder ("sparse/0/"). Points are those of the layer `tracks` that two or more of the
/// pictures see, of objects that do not move between the pictures; their numbers are their places in the dataset's
/// list, from 1. In memory are the points, and a bounded number of places.
ExportItem modelItem(const DatasetView& dataset, const std::shared_ptr<const Views>& views, const std::string& folder,
  const OptionValues& options);

} // namespace dgtk::colmap

#endif
