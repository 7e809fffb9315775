// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewOutputs.h"

#include "dgtkError.h"
#include "dgtkOption.h"

#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr const char* cellsLayer = "cells";

void draw(const ViewRequest& request, dgtkScene& scene, const std::string& layers, ViewOutputs& to)
{
  vtkNew<dgtkRenderer> renderer;
  renderer->SetScene(&scene);
  if (!request.renderer) // a snapshot has one camera, one frame and one size
  {
    renderer->SetCamera(request.camera);
    renderer->SetSize(request.width, request.height);
    if (request.frameSet)
    {
      renderer->SetFrame(request.frame);
    }
  }
  for (const auto& [name, value] : request.options)
  {
    renderer->SetOption(name, value);
  }
  if (!renderer->RenderLayers(layers))
  {
    throw UsageError(renderer->GetErrorMessage());
  }
  to.width = renderer->GetWidth();
  to.height = renderer->GetHeight();
  for (int i = 0; i < renderer->GetNumberOfOutputs(); ++i)
  {
    if (!renderer->IsOutputImage(i) || !renderer->GetOutputPart(i).empty())
    {
      throw UsageError("the layer " + std::string(renderer->GetOutput(i)->GetName()) + " is no picture");
    }
    to.arrays.emplace_back(renderer->GetOutput(i));
  }
}
} // namespace

vtkDataArray* ViewOutputs::find(const char* name) const
{
  const auto found = std::find_if(this->arrays.begin(), this->arrays.end(),
    [name](const vtkSmartPointer<vtkDataArray>& array) { return std::string(array->GetName()) == name; });
  return found != this->arrays.end() ? found->Get() : nullptr;
}

ViewOutputs outputsOf(const ViewRequest& request)
{
  std::vector<std::string> names = splitNames(request.layers, "layers");
  const std::string first = names.front();
  const auto cells = std::find(names.begin(), names.end(), cellsLayer);
  const bool wantsCells = request.renderer && cells != names.end();
  if (wantsCells)
  {
    names.erase(cells);
  }
  ViewOutputs to;
  vtkSmartPointer<dgtkScene> scene = request.scene;
  if (request.renderer)
  {
    to.shot = vtkSmartPointer<dgtkSnapshot>::New();
    to.shot->SetSkipUnsupported(request.skip);
    if (!to.shot->Take(request.renderer, request.width, request.height))
    {
      throw UsageError(to.shot->GetErrorMessage());
    }
    scene = to.shot;
  }
  if (!scene)
  {
    throw UsageError("there is neither a renderer nor a scene");
  }
  if (!names.empty())
  {
    draw(request, *scene, joinedNames(names), to);
  }
  if (wantsCells)
  {
    to.width = to.shot->GetWidth();
    to.height = to.shot->GetHeight();
    to.arrays.emplace_back(to.shot->TraceCells());
    if (to.arrays.back() == nullptr)
    {
      throw MachineError(to.shot->GetErrorMessage());
    }
  }
  const auto rank = [&first](const vtkSmartPointer<vtkDataArray>& array)
  {
    const std::string name = array->GetName();
    return name == first ? 0 : name.compare(0, first.size() + 1, first + '_') == 0 ? 1 : 2;
  };
  std::stable_sort(
    to.arrays.begin(), to.arrays.end(), [&rank](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return to;
}

vtkMTimeType modifiedTime(vtkRenderer& renderer)
{
  vtkMTimeType latest = renderer.GetMTime();
  if (renderer.IsActiveCameraCreated() != 0)
  {
    latest = std::max(latest, renderer.GetActiveCamera()->GetMTime());
  }
  vtkCollectionSimpleIterator at = nullptr;
  renderer.GetLights()->InitTraversal(at);
  while (vtkLight* const light = renderer.GetLights()->GetNextLight(at))
  {
    latest = std::max(latest, light->GetMTime());
  }
  renderer.GetViewProps()->InitTraversal(at);
  while (vtkProp* const prop = renderer.GetViewProps()->GetNextProp(at))
  {
    latest = std::max({ latest, prop->GetMTime(), prop->GetRedrawMTime() });
  }
  return std::max(latest, renderer.GetViewProps()->GetMTime());
}

} // namespace dgtk
