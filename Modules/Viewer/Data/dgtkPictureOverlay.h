// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureOverlay_h
#define dgtkPictureOverlay_h

#include "dgtkViewerModule.h"

#include "dgtkDatasetPictures.h"

#include <Eigen/Core>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dgtk
{

/// What a dataset knows of the image of a camera at a frame beside pixels. Places are image points in pixels.
struct PictureOverlay
{
  struct Box
  {
    std::uint32_t id = 0;
    std::string name;
    std::optional<Eigen::Vector4d> visible; ///< [x0, y0, x1, y1]; nothing where no pixel is
    std::optional<Eigen::Vector4d> amodal;
  };
  struct Point
  {
    Eigen::Vector2d pixel{ 0, 0 };
    std::uint32_t object = 0;
  };
  std::vector<Box> boxes;
  std::vector<Point> points;
};

/// Those of a frame, by camera.
struct FrameOverlays
{
  int frame = 0;
  std::map<std::string, PictureOverlay> cameras;
  std::vector<std::string> problems; ///< a line for each file that could not be read
};

struct OverlayAsk
{
  std::set<std::string> cameras;
  int frame = 0;
  bool boxes = false;  ///< of the layer `boxes`
  bool points = false; ///< of the layer `points`
};

/// Empty where the dataset has no such file, or a damaged one, which is among the problems then.
DGTKVIEWER_EXPORT FrameOverlays readOverlays(const DatasetPictures& dataset, const OverlayAsk& ask);

} // namespace dgtk

#endif
