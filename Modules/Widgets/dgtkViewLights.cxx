// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewLights.h"

#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <Eigen/Core>

namespace dgtk
{

namespace
{
constexpr double fill = 0.3;      // of the head light beside the scene's lights
constexpr double pointCone = 180; // degrees: VTK's word for a light in all directions
} // namespace

ViewLights::ViewLights(vtkRenderer* renderer)
  : Renderer(renderer)
{
  renderer->AutomaticLightCreationOff();
  this->addHead(1);
}

void ViewLights::addHead(double intensity)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToHeadlight();
  light->SetIntensity(intensity);
  this->Renderer->AddLight(light);
}

void ViewLights::add(const LightDescription& light, const Eigen::Vector3d& position, double frame)
{
  vtkNew<vtkLight> added;
  if (light.kind == LightKind::Head)
  {
    added->SetLightTypeToHeadlight();
  }
  else
  {
    const Eigen::Vector3d target = light.target.at(frame);
    added->SetLightTypeToSceneLight();
    added->SetPositional(light.kind != LightKind::Directional);
    added->SetConeAngle(light.kind == LightKind::Spot ? light.coneAngle : pointCone);
    added->SetPosition(position.x(), position.y(), position.z());
    added->SetFocalPoint(target.x(), target.y(), target.z());
  }
  added->SetExponent(light.exponent);
  added->SetAttenuationValues(light.attenuation.x(), light.attenuation.y(), light.attenuation.z());
  added->SetDiffuseColor(light.diffuse.x(), light.diffuse.y(), light.diffuse.z());
  added->SetSpecularColor(light.specular.x(), light.specular.y(), light.specular.z());
  added->SetIntensity(light.intensity);
  this->Renderer->AddLight(added);
}

/// VTK compiles its shaders anew for each number of lights, and keeps them all: dark lights make it a power of two.
void ViewLights::fillUp()
{
  const int lights = this->Renderer->GetLights()->GetNumberOfItems();
  int wanted = 1;
  while (wanted < lights)
  {
    wanted *= 2;
  }
  for (int i = lights; i < wanted; ++i)
  {
    vtkNew<vtkLight> dark;
    dark->SetLightTypeToSceneLight();
    dark->SetColor(0, 0, 0);
    this->Renderer->AddLight(dark);
  }
}

void ViewLights::show(const SceneDescription& scene, const ScenePlaces& places)
{
  const bool any = this->OfScene && !scene.lights.empty();
  if (!any && this->Renderer->GetLights()->GetNumberOfItems() == 1)
  {
    vtkLight* const only = vtkLight::SafeDownCast(this->Renderer->GetLights()->GetItemAsObject(0));
    only->SetIntensity(1);
    return;
  }
  this->Renderer->RemoveAllLights();
  this->addHead(any ? fill : 1.0);
  for (std::size_t i = 0; i < scene.lights.size() && any; ++i)
  {
    if (scene.lights[i].enabled)
    {
      this->add(scene.lights[i], places.lights[i], places.frame);
    }
  }
  this->fillUp();
}

} // namespace dgtk
