// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewActors.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <optional>

namespace dgtk
{

namespace
{
constexpr double nearBy = 3; // of its radius: an object that is nearer to the eye may be seen anywhere
constexpr double coarserStep = 2;
constexpr double coarsest = 4;
constexpr double spread = 1.5; // more than a ball farther away grows in the perspective towards the view's corners

/// False only for what is outside of the view.
bool mayBeSeen(const WorldBox& box, const ViewCamera& camera, double width, double height)
{
  const Eigen::Vector3d center = box.center();
  const double radius = box.diagonal() / 2;
  if (!camera.parallel() && (center - camera.eye()).norm() < nearBy * radius)
  {
    return true;
  }
  const std::optional<Eigen::Vector2d> at = camera.pixel(center, width, height);
  const double reach = at ? spread * radius / camera.unit(center, height) : 0.0;
  return at && at->x() > -reach && at->x() < width + reach && at->y() > -reach && at->y() < height + reach;
}
} // namespace

vtkSmartPointer<vtkPolyDataMapper> ViewActors::mapperOf(vtkPolyData* data)
{
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(data);
  mapper->StaticOn(); // there is no pipeline to ask before each of many drawings
  return mapper;
}

vtkPolyDataMapper* ViewActors::mapper(Surface& surface, int level)
{
  if (surface.mappers[level] == nullptr)
  {
    this->Fresh = true;
    surface.mappers[level] = mapperOf(this->Meshes->part(*surface.geometry, *surface.model, surface.part, level));
  }
  return surface.mappers[level];
}

ViewCopies& ViewActors::copies(Surface& surface, int level)
{
  if (surface.copies[level] == nullptr)
  {
    this->Fresh = true;
    surface.copies[level] = std::make_unique<ViewCopies>(this->Renderer,
      this->Meshes->part(*surface.geometry, *surface.model, surface.part, level), surface.property, this->Lighting);
    this->applyStyle(surface, surface.copies[level]->actor());
  }
  return *surface.copies[level];
}

std::size_t ViewActors::chooseLevels(double coarser)
{
  std::size_t triangles = 0;
  for (Shown& shown : this->Objects)
  {
    if (!(shown.pixels > 0))
    {
      continue; // no triangles are made fewer for what nobody sees
    }
    shown.level = 0;
    while (shown.level + 1 < ViewMeshes::levels && shown.pixels < coarser * ViewMeshes::pixels(shown.level + 1))
    {
      ++shown.level;
    }
    for (std::size_t i = 0; i < shown.surfaces.size(); ++i)
    {
      const Surface& surface = *shown.surfaces[i];
      vtkPolyData* const data = this->Meshes->part(*surface.geometry, *surface.model, surface.part, shown.level);
      triangles += static_cast<std::size_t>(data->GetNumberOfPolys());
    }
  }
  return triangles;
}

void ViewActors::chooseDetail(const ViewCamera& camera, double width, double height, std::size_t most)
{
  for (Shown& shown : this->Objects)
  {
    const double unit = camera.unit(shown.box.center(), height);
    const bool seen = shown.visible && mayBeSeen(shown.box, camera, width, height);
    shown.pixels = !seen ? 0 : unit > 0 ? shown.box.diagonal() / unit : height;
  }
  this->Triangles = this->chooseLevels(1);
  for (double coarser = coarserStep; this->Triangles > most && coarser <= coarsest; coarser *= coarserStep)
  {
    this->Triangles = this->chooseLevels(coarser);
  }
  std::vector<std::pair<double, Shown*>> many; // by their depth: what is hidden need not be shaded
  for (Shown& shown : this->Objects)
  {
    for (std::size_t i = 0; i < shown.actors.size() && shown.pixels > 0; ++i)
    {
      if (shown.actors[i] != nullptr)
      {
        shown.actors[i]->SetMapper(this->mapper(*shown.surfaces[i], shown.level));
      }
    }
    if (shown.copy && shown.pixels > 0)
    {
      many.emplace_back((shown.box.center() - camera.eye()).dot(camera.forward()), &shown);
    }
  }
  std::sort(many.begin(), many.end());
  for (const auto& [depth, shown] : many)
  {
    for (std::size_t i = 0; i < shown->actors.size(); ++i)
    {
      if (shown->actors[i] == nullptr)
      {
        shown->surfaces[i]->wanted[shown->level].push_back(*shown->copy);
      }
    }
  }
  for (auto& [key, surface] : this->Surfaces)
  {
    for (int level = 0; level < ViewMeshes::levels; ++level)
    {
      if (surface.copies[level] != nullptr || !surface.wanted[level].empty())
      {
        this->copies(surface, level).show(surface.wanted[level]);
        surface.wanted[level].clear();
      }
    }
  }
}

int ViewActors::actors() const { return this->Renderer->GetActors()->GetNumberOfItems(); }

int ViewActors::coarserMeshes() const
{
  int count = 0;
  for (const auto& [key, surface] : this->Surfaces)
  {
    for (int level = 1; level < ViewMeshes::levels; ++level)
    {
      count += surface.mappers[level] != nullptr || surface.copies[level] != nullptr ? 1 : 0;
    }
  }
  return count;
}

} // namespace dgtk
