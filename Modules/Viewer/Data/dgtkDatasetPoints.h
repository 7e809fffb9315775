// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDatasetPoints_h
#define dgtkDatasetPoints_h

#include "dgtkViewerModule.h"

#include "dgtkCameraModel.h"
#include "dgtkPictureValues.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// The camera of an entry of cameras.json. Throws InputError for a model that is not known, UsageError for parameters
/// that no camera of the model has.
DGTKVIEWER_EXPORT View viewOf(const CameraRecord& record);

/// The camera of an entry of cameras.json at the times of its pixels: with a rolling shutter, or a table of rays with
/// times, it is then where scene.json says.
class DGTKVIEWER_EXPORT PixelCamera
{
public:
  /// Throws as viewOf().
  PixelCamera(const DatasetPictures& dataset, const CameraRecord& record);
  /// Whether at() has a view: scene.json has the camera where the entry says that it is at the picture's own time, or
  /// the entries of the frames before and after have it in the same place.
  bool knowsPlace() const { return this->Motion || this->OnePlace; }
  /// When it sees the centre of the pixel in column x and row y, until the next call; null where that is not known.
  const View* at(int x, int y);

private:
  View Seen;
  int Frame;
  bool OnePlace;                           ///< of all pixels, where the motion is not known
  std::optional<CameraDescription> Motion; ///< its pose alone
};

/// Whether world points follow from the values of a layer: depth, depth_noisy, distance, inversedepth, position.
DGTKVIEWER_EXPORT bool givesPoints(const LayerSpec& spec);
/// The world point seen by the centre of the pixel in column x and row y. `values`: the pixel's channels. Nothing where
/// they say that there is none. Positions need no view.
DGTKVIEWER_EXPORT std::optional<Eigen::Vector3d> pointOf(
  const LayerSpec& spec, const View& view, int x, int y, const double* values);

/// Points in the world with their colours.
struct PointCloud
{
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint8_t, 3>> colors;
};

/// The label of the layer from which a camera's points come at a frame: positions, depth, or the next best; "" for
/// none. Of a lens that is not known, and of a rolling shutter whose motion is not, only position.
DGTKVIEWER_EXPORT std::string pointLayer(const DatasetPictures& dataset, const std::string& camera, int frame);

/// Adds what a camera sees at a frame: the points of its depth in the colours of `colorLayer` (a label; "" for the
/// first picture; where the camera has no such picture they are gray), of every n-th pixel, so that there are at most
/// `most`. Throws InputError for damaged files and a camera that is not in cameras.json. `goOn`: as in PictureRead.
DGTKVIEWER_EXPORT void addPoints(PointCloud& cloud, const DatasetPictures& dataset, const std::string& camera,
  int frame, const std::string& colorLayer, std::size_t most, const std::function<bool()>& goOn = {});

} // namespace dgtk

#endif
