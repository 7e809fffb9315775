// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewActors.h"

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>

namespace dgtk
{

vtkSmartPointer<vtkPolyDataMapper> ViewActors::mapperOf(vtkPolyData* data)
{
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(data);
  mapper->StaticOn(); // there is no pipeline to ask before each of many drawings
  return mapper;
}

void ViewActors::chooseDetail(const ViewCamera& camera, double height)
{
  for (Shown& shown : this->Objects)
  {
    const double unit = camera.unit(shown.box.center(), height);
    const double pixels = unit > 0 ? shown.box.diagonal() / unit : height;
    int level = 0;
    while (level + 1 < ViewMeshes::levels && pixels < ViewMeshes::pixels(level + 1))
    {
      ++level;
    }
    for (std::size_t i = 0; i < shown.actors.size() && level != shown.level; ++i)
    {
      Surface& surface = *shown.surfaces[i];
      if (surface.mappers[level] == nullptr)
      {
        surface.mappers[level] = mapperOf(this->Meshes->part(*surface.geometry, *surface.model, surface.part, level));
      }
      shown.actors[i]->SetMapper(surface.mappers[level]);
    }
    shown.level = level;
  }
}

} // namespace dgtk
