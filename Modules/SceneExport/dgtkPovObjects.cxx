// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkPovMaterials.h"
#include "dgtkPovMeshes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dgtk
{

namespace
{
/// A surface this near to the near or far plane, in parts of its depth, is taken as beyond it and cut.
constexpr double planeSlack = 1e-6;

/// A half space of the camera frame: normal . x + offset >= 0.
struct HalfSpace
{
  Eigen::Vector3d normal;
  double offset;
};

/// What the image shows, at any depth.
std::vector<HalfSpace> sidesOf(const View& view)
{
  const LinearProjection linear = *view.model->linear();
  const double most[2] = { double(view.model->width()), double(view.model->height()) };
  std::vector<HalfSpace> sides;
  for (int axis = 0; axis < 2; ++axis)
  {
    Eigen::Vector3d pixel = linear.K.row(axis).transpose(); // times depth where it is perspective
    const double offset = linear.perspective ? 0 : pixel.z();
    const Eigen::Vector3d end = linear.perspective ? Eigen::Vector3d(0, 0, most[axis]) : Eigen::Vector3d(0, 0, 0);
    pixel.z() = linear.perspective ? pixel.z() : 0;
    sides.push_back({ pixel, offset });
    sides.push_back({ end - pixel, linear.perspective ? 0 : most[axis] - offset });
  }
  return sides;
}

/// Whether some of a triangle lies in all half spaces.
bool reaches(const std::vector<HalfSpace>& space, std::vector<Eigen::Vector3d> polygon)
{
  for (const HalfSpace& half : space)
  {
    std::vector<Eigen::Vector3d> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Eigen::Vector3d& p = polygon[i];
      const Eigen::Vector3d& q = polygon[(i + 1) % polygon.size()];
      const double dp = half.normal.dot(p) + half.offset;
      const double dq = half.normal.dot(q) + half.offset;
      if (dp >= 0)
      {
        kept.push_back(p);
      }
      if ((dp >= 0) != (dq >= 0))
      {
        kept.push_back(p + (q - p) * (dp / (dp - dq)));
      }
    }
    polygon = std::move(kept);
  }
  return !polygon.empty();
}

/// Whether the image would show some of an instance in a range of depths.
bool showsBetween(const Instance& instance, const View& view, double least, double most)
{
  std::vector<HalfSpace> space{ { { 0, 0, 1 }, -least }, { { 0, 0, -1 }, most } };
  const std::vector<HalfSpace> sides = sidesOf(view);
  space.insert(space.end(), sides.begin(), sides.end());
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& position : instance.geometry->positions)
  {
    points.push_back(view.camera_from_world * (instance.world_from_object * position));
  }
  const auto within = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
  {
    return std::max({ a.z(), b.z(), c.z() }) >= least && std::min({ a.z(), b.z(), c.z() }) <= most &&
           reaches(space, { a, b, c });
  };
  return std::any_of(instance.model->triangles.begin(), instance.model->triangles.end(),
    [&](const auto& triangle) { return within(points[triangle[0]], points[triangle[1]], points[triangle[2]]); });
}

std::string plane(const Eigen::Vector3d& normal, double distance)
{
  return "plane { " + povVector(normal) + ", " + povNumber(distance) + " } ";
}
} // namespace

/// Half spaces that keep what lies between the near and the far plane, of an instance of which there is more in the
/// image.
std::string PovObjects::clipping(const Instance& instance) const
{
  const Rigid3& camera_from_world = this->TheView.camera_from_world;
  const Eigen::Vector3d forward = camera_from_world.rotation.row(2).transpose();
  const double offset = camera_from_world.translation.z();
  std::string planes;
  if (showsBetween(instance, this->TheView, 0, this->TheView.near * (1 + planeSlack)))
  {
    planes += plane(-forward, offset - this->TheView.near);
  }
  if (showsBetween(instance, this->TheView, this->TheView.far * (1 - planeSlack), HUGE_VAL))
  {
    planes += plane(forward, this->TheView.far - offset);
  }
  return planes.empty() ? planes : "  clipped_by { " + planes + "}\n";
}

std::string PovObjects::texture(std::uint32_t id) const
{
  return this->Options.flatIds          ? "  " + povFlatTexture(id) + '\n'
         : this->Options.positionColors ? "  " + povPositionTexture(*this->Options.positionColors) + '\n'
                                        : std::string();
}

/// Where there is light.
PovTurned PovObjects::turned(const Instance& instance, bool shared) const
{
  const bool shaded = this->Options.asSeen && !this->Options.flatIds && !this->Options.positionColors;
  return shaded ? povTurned(instance, this->TheView, shared) : PovTurned();
}

void PovObjects::add(const Instance& instance, std::uint32_t id, bool shared)
{
  if (instance.model->triangles.empty())
  {
    return;
  }
  const std::string mesh = this->Meshes.declare(instance, id, this->turned(instance, shared));
  this->Text << "// object " + std::to_string(id) + ": " + quoted(instance.name) + "\nobject {\n  " + mesh + "\n  " +
                  povMatrix(instance.world_from_object) + '\n' + this->clipping(instance) + this->texture(id) +
                  (this->Options.cast ? "" : "  no_shadow\n") +
                  (this->Scale == 1 ? "" : " " + povScale(this->Scale) + '\n') + "}\n\n";
}

} // namespace dgtk
