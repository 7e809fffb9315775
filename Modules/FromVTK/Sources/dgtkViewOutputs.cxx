// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewOutputs.h"

#include "dgtkError.h"
#include "dgtkOption.h"
#include "dgtkRendererProps.h"
#include "dgtkUnsupported.h"

#include <vtkActor.h>
#include <vtkAlgorithm.h>
#include <vtkCamera.h>
#include <vtkCompositeDataDisplayAttributes.h>
#include <vtkCompositeDataSet.h>
#include <vtkCompositePolyDataMapper2.h>
#include <vtkDataObjectTreeRange.h>
#include <vtkFollower.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkProp.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>
#include <vtkScalarsToColors.h>
#include <vtkTexture.h>
#include <vtkTransform.h>

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
  if (names.empty())
  {
    throw UsageError("no layers are set");
  }
  const std::string first = names.front();
  const auto cells = request.renderer ? std::remove(names.begin(), names.end(), cellsLayer) : names.end();
  const bool wantsCells = cells != names.end();
  names.erase(cells, names.end());
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

namespace
{
/// Of a data object and of the blocks in it, of which a composite one does not know.
vtkMTimeType timeOf(vtkDataObject& data)
{
  vtkMTimeType latest = data.GetMTime();
  if (auto* const tree = vtkDataObjectTree::SafeDownCast(&data))
  {
    for (vtkDataObject* const block : vtk::Range(tree))
    {
      latest = std::max(latest, block->GetMTime());
    }
  }
  return latest;
}

vtkMTimeType timeOf(vtkObject* object) { return object != nullptr ? object->GetMTime() : 0; }

/// With what its own time leaves out.
vtkMTimeType timeOfCamera(vtkCamera& camera)
{
  return std::max({ camera.GetMTime(), timeOf(camera.GetUserTransform()), timeOf(camera.GetModelTransformMatrix()),
    timeOf(camera.GetExplicitProjectionTransformMatrix()) });
}

/// Of all that an algorithm is given, brought up to date.
vtkMTimeType timeOfInputs(vtkAlgorithm& algorithm)
{
  vtkMTimeType latest = algorithm.GetMTime();
  for (int port = 0; port < algorithm.GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < algorithm.GetNumberOfInputConnections(port); ++i)
    {
      algorithm.GetInputAlgorithm(port, i)->Update();
      vtkDataObject* const data = algorithm.GetInputDataObject(port, i);
      latest = data != nullptr ? std::max(latest, timeOf(*data)) : latest;
    }
  }
  return latest;
}

vtkMTimeType timeOfTexture(vtkTexture& texture)
{
  return std::max({ timeOfInputs(texture), timeOf(texture.GetTransform()), timeOf(texture.GetLookupTable()) });
}

/// Of what an actor's own time leaves out: all inputs of its mapper, its textures' pictures, planes, attributes of
/// blocks, and the camera that a follower faces.
vtkMTimeType timeOfParts(vtkActor& actor)
{
  vtkMapper& mapper = *actor.GetMapper();
  vtkMTimeType latest = timeOfInputs(mapper);
  if (actor.GetTexture() != nullptr)
  {
    latest = std::max(latest, timeOfTexture(*actor.GetTexture()));
  }
  for (const auto& named : actor.GetProperty()->GetAllTextures())
  {
    latest = named.second != nullptr ? std::max(latest, timeOfTexture(*named.second)) : latest;
  }
  if (auto* const follower = vtkFollower::SafeDownCast(&actor))
  {
    latest = std::max(latest, timeOf(follower->GetCamera()));
  }
  vtkPlaneCollection* const planes = mapper.GetClippingPlanes();
  for (int i = 0; planes != nullptr && i < planes->GetNumberOfItems(); ++i)
  {
    latest = std::max(latest, planes->GetItem(i)->GetMTime());
  }
  auto* const composite = vtkCompositePolyDataMapper2::SafeDownCast(&mapper);
  if (composite != nullptr && composite->GetCompositeDataDisplayAttributes() != nullptr)
  {
    latest = std::max(latest, composite->GetCompositeDataDisplayAttributes()->GetMTime());
  }
  return latest;
}
} // namespace

vtkMTimeType modifiedTime(vtkRenderer& renderer)
{
  vtkMTimeType latest = renderer.GetMTime();
  if (renderer.IsActiveCameraCreated() != 0)
  {
    latest = std::max(latest, timeOfCamera(*renderer.GetActiveCamera()));
  }
  vtkCollectionSimpleIterator at = nullptr;
  renderer.GetLights()->InitTraversal(at);
  while (vtkLight* const light = renderer.GetLights()->GetNextLight(at))
  {
    latest = std::max({ latest, light->GetMTime(), timeOf(light->GetTransformMatrix()) });
  }
  renderer.GetViewProps()->InitTraversal(at);
  while (vtkProp* const prop = renderer.GetViewProps()->GetNextProp(at))
  {
    latest = std::max({ latest, prop->GetMTime(), prop->GetRedrawMTime() });
  }
  Unsupported unsupported;
  for (const ViewActor& actor : rendererActors(renderer, unsupported))
  {
    latest = std::max(latest, timeOfParts(*actor.actor));
  }
  return std::max(latest, renderer.GetViewProps()->GetMTime());
}

} // namespace dgtk
