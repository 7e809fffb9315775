// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkPovMaterials.h"
#include "dgtkPovMeshes.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// A surface this near to the near or far plane, in parts of its depth, is taken as beyond it and cut.
constexpr double PlaneSlack = 1e-6;

struct Depths
{
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
};

Depths depthsOf(const Instance& instance, const View& view)
{
  Depths depths;
  for (const Eigen::Vector3d& position : instance.geometry->positions)
  {
    const double z = (view.camera_from_world * (instance.world_from_object * position)).z();
    depths.least = std::min(depths.least, z);
    depths.most = std::max(depths.most, z);
  }
  return depths;
}

std::string plane(const Eigen::Vector3d& normal, double distance)
{
  return "plane { " + povVector(normal) + ", " + povNumber(distance) + " } ";
}
} // namespace

/// Half spaces that keep what lies between the near and the far plane, of an instance that crosses them.
std::string PovObjects::clipping(const Instance& instance) const
{
  const Rigid3& camera_from_world = this->TheView.camera_from_world;
  const Eigen::Vector3d forward = camera_from_world.rotation.row(2).transpose();
  const double offset = camera_from_world.translation.z();
  const Depths depths = depthsOf(instance, this->TheView);
  std::string planes;
  if (depths.least < this->TheView.near * (1 + PlaneSlack))
  {
    planes += plane(-forward, offset - this->TheView.near);
  }
  if (depths.most > this->TheView.far * (1 - PlaneSlack))
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

void PovObjects::add(const Instance& instance, std::uint32_t id)
{
  if (instance.model->triangles.empty())
  {
    return;
  }
  const std::string mesh = this->Meshes.declare(instance, id);
  this->Text << "// object " + std::to_string(id) + ": " + quoted(instance.name) + "\nobject {\n  " + mesh + "\n  " +
                  povMatrix(instance.world_from_object) + '\n' + this->clipping(instance) + this->texture(id) +
                  (this->Options.shadows ? "" : "  no_shadow\n") +
                  (this->Scale == 1 ? "" : " " + povScale(this->Scale) + '\n') + "}\n\n";
}

} // namespace dgtk
