// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewLines.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr double cellsAcross = 20;
constexpr double frustumShare = 0.04; // of the scene's diagonal
constexpr double lightShare = 0.012;
constexpr double lightMargin = 1.4; // of the box about a light
constexpr double smallestExtent = 1;

double extentOf(const ScenePlaces& places) { return std::max(places.box.diagonal(), smallestExtent); }
} // namespace

void addBox(LineList& lines, const WorldBox& box)
{
  const auto corner = [&](int i)
  {
    return Eigen::Vector3d(
      (i & 1 ? box.max : box.min).x(), (i & 2 ? box.max : box.min).y(), (i & 4 ? box.max : box.min).z());
  };
  for (int i = 0; i < 8; ++i)
  {
    for (const int bit : { 1, 2, 4 })
    {
      if ((i & bit) == 0)
      {
        lines.emplace_back(corner(i), corner(i | bit));
      }
    }
  }
}

namespace
{
/// Where the picture ends on the way from the middle of the image to a point of it.
CameraRay outermostRay(const CameraModel& model, const Eigen::Vector2d& pixel)
{
  const Eigen::Vector2d middle(model.width() / 2.0, model.height() / 2.0);
  CameraRay found = model.rayThrough(pixel);
  double inside = 0;
  double outside = 1;
  for (int i = 0; i < 20 && !model.rayThrough(pixel).exists(); ++i)
  {
    const double half = (inside + outside) / 2;
    const CameraRay ray = model.rayThrough(middle + half * (pixel - middle));
    found = ray.exists() ? ray : found;
    (ray.exists() ? inside : outside) = half;
  }
  return found;
}

/// The border of what a lens sees, at a distance, and its corners.
void addLens(LineList& lines, const View& view, double length)
{
  constexpr int parts = 12; // of a side of the image
  const CameraModel& model = *view.model;
  const Rigid3 world_from_camera = view.camera_from_world.inverse();
  const Eigen::Vector2d corners[4] = { { 0, 0 }, { model.width(), 0 }, { model.width(), model.height() },
    { 0, model.height() } };
  std::vector<Eigen::Vector3d> border;
  for (int i = 0; i < 4 * parts; ++i)
  {
    const double part = double(i % parts) / parts;
    const CameraRay ray = outermostRay(model, (1 - part) * corners[i / parts] + part * corners[(i / parts + 1) % 4]);
    border.push_back(world_from_camera * (ray.origin + length * ray.direction));
    if (i % parts == 0)
    {
      lines.emplace_back(world_from_camera * ray.origin, border.back());
    }
  }
  for (std::size_t i = 0; i < border.size(); ++i)
  {
    lines.emplace_back(border[i], border[(i + 1) % border.size()]);
  }
}
} // namespace

void addFrustum(LineList& lines, const CameraPlace& camera, double length)
{
  if (!camera.valid)
  {
    return;
  }
  if (!camera.view.model->linear())
  {
    addLens(lines, camera.view, length);
    return;
  }
  const Rigid3 world_from_camera = camera.view.camera_from_world.inverse();
  const double width = camera.view.model->width();
  const double height = camera.view.model->height();
  const std::array<Eigen::Vector2d, 5> pixels{ Eigen::Vector2d(0, 0), Eigen::Vector2d(width, 0),
    Eigen::Vector2d(width, height), Eigen::Vector2d(0, height), Eigen::Vector2d(width / 2, -height / 4) };
  std::array<Eigen::Vector3d, 5> near;
  std::array<Eigen::Vector3d, 5> far;
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    const CameraRay ray = camera.view.model->rayThrough(pixels[i]);
    near[i] = world_from_camera * ray.origin;
    far[i] = world_from_camera * (ray.origin + length * ray.direction);
  }
  for (std::size_t i = 0; i < 4; ++i)
  {
    lines.emplace_back(near[i], far[i]);
    lines.emplace_back(far[i], far[(i + 1) % 4]);
    if (near[i] != near[(i + 1) % 4])
    {
      lines.emplace_back(near[i], near[(i + 1) % 4]);
    }
  }
  lines.emplace_back(far[0], far[4]);
  lines.emplace_back(far[1], far[4]);
}

double frustumLength(const ScenePlaces& places) { return frustumShare * extentOf(places); }
double lightRadius(const ScenePlaces& places) { return lightShare * extentOf(places); }

WorldBox drawnBox(const ScenePlaces& places, const SceneItem& item)
{
  WorldBox box = places.boxOf(item);
  if (item.kind == SceneItem::Kind::Object || box.empty())
  {
    return box;
  }
  LineList lines;
  if (item.kind == SceneItem::Kind::Camera)
  {
    addFrustum(lines, places.cameras[item.index], frustumLength(places));
  }
  for (const auto& [from, to] : lines)
  {
    box.add(from);
    box.add(to);
  }
  if (lines.empty())
  {
    // A light, or a camera whose pose is undefined.
    box.min.array() -= frustumLength(places);
    box.max.array() += frustumLength(places);
  }
  return box;
}

LineList selectionLines(const ScenePlaces& places, const SceneItems& selected)
{
  LineList lines;
  for (const SceneItem& item : selected)
  {
    WorldBox box = places.boxOf(item);
    if (item.kind == SceneItem::Kind::Camera && item.index < places.cameras.size())
    {
      addFrustum(lines, places.cameras[item.index], frustumLength(places));
    }
    else if (!box.empty())
    {
      const double margin = item.kind == SceneItem::Kind::Light ? lightMargin * lightRadius(places) : 0.0;
      box.min.array() -= margin;
      box.max.array() += margin;
      addBox(lines, box);
    }
  }
  return lines;
}

double gridStep(double extent)
{
  const double wanted = extent / cellsAcross;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  const double digit = wanted / power;
  return power * (digit > 5 ? 10 : digit > 2 ? 5 : digit > 1 ? 2 : 1);
}

void addGrid(
  LineList& lines, const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v, double extent)
{
  const double step = gridStep(extent);
  const int cells = static_cast<int>(std::ceil(extent / step / 2));
  const double end = cells * step;
  for (int i = -cells; i <= cells; ++i)
  {
    lines.emplace_back(origin + i * step * u - end * v, origin + i * step * u + end * v);
    lines.emplace_back(origin + i * step * v - end * u, origin + i * step * v + end * u);
  }
}

} // namespace dgtk
