// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkViewLines_h
#define dgtkViewLines_h

#include "dgtkScenePlaces.h"

#include <utility>
#include <vector>

namespace dgtk
{

using LineList = std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;

/// The 12 edges of a box.
void addBox(LineList& lines, const WorldBox& box);
/// A camera: its pyramid (or parallel beam) up to `length`, with a mark above the image.
void addFrustum(LineList& lines, const CameraPlace& camera, double length);
/// How long frusta are drawn, and how large lights.
double frustumLength(const ScenePlaces& places);
double lightRadius(const ScenePlaces& places);
/// About an item as it is drawn: an object, a camera with its frustum, a light with room about it.
WorldBox drawnBox(const ScenePlaces& places, const SceneItem& item);
/// Boxes about what is selected; of cameras their frusta.
LineList selectionLines(const ScenePlaces& places, const SceneItems& selected);
/// Squares of 1, 2 or 5 times a power of ten in the plane of two axes through `origin`.
void addGrid(
  LineList& lines, const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v, double extent);
/// Side of the squares of a grid that covers `extent`.
double gridStep(double extent);

} // namespace dgtk

#endif
