// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEpipolarLine_h
#define dgtkEpipolarLine_h

#include "dgtkLiveModule.h"

#include "dgtkCameraModel.h"

#include <Eigen/Core>

#include <optional>

namespace dgtk
{

/// The line (a, b, c), a x + b y + c = 0 and a^2 + b^2 = 1, pixels of `to`, on which the image of everything lies that
/// `from` sees at `pixel`. With o + s d the pixel's ray in the frame of `to`, the line joins K o and K d, also where
/// one of them is a point at infinity (Hartley and Zisserman, Multiple View Geometry, 9.2; the same for parallel
/// projections). Nothing where the ray's image is a point: it passes through the centre of `to`, or is parallel to the
/// view of a parallel projection. Nothing for cameras that are not linear(), or have a
/// rolling shutter.
DGTKLIVE_EXPORT std::optional<Eigen::Vector3d> epipolarLine(
  const View& from, const Eigen::Vector2d& pixel, const View& to);

/// The part of a line inside a picture, none when it passes beside.
struct LinePart
{
  Eigen::Vector2d begin;
  Eigen::Vector2d end;
};
DGTKLIVE_EXPORT std::optional<LinePart> clippedLine(const Eigen::Vector3d& line, double width, double height);

} // namespace dgtk

#endif
