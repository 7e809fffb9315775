// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPixelText_h
#define dgtkPixelText_h

#include "dgtkViewerModule.h"

#include "dgtkPictureValues.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace dgtk
{

/// A number of a picture: an integer, or the shortest text that reads back to the same value of the file's type.
DGTKVIEWER_EXPORT std::string numberText(double value, PixelType type);

/// What a picture says at a pixel that it kept, with units and names, in the language of the window: "3.25 scene
/// units", "3 windmill", "(0.5, -2) pixels, 2.0616 long", "2 occluded by another object", the records of a layered
/// depth image. Empty outside.
DGTKVIEWER_EXPORT std::string valueText(const DatasetPictures& dataset, const PictureValues& picture, int x, int y);

/// The world point of a pixel, from the picture's own values. Nothing where they do not say it, and for a camera that
/// cameras.json does not have or whose model is not known.
DGTKVIEWER_EXPORT std::optional<Eigen::Vector3d> worldPoint(
  const DatasetPictures& dataset, const PictureKey& key, const PictureValues& picture, int x, int y);

/// "(1.25, -3, 0.5)", to six digits.
DGTKVIEWER_EXPORT std::string pointText(const Eigen::Vector3d& point);

} // namespace dgtk

#endif
