// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRendererLights.h"

#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>

namespace dgtk
{

namespace
{
constexpr double wholeCone = 90; ///< degrees: from here on VTK's light has none

std::vector<vtkLight*> lightsOf(vtkRenderer& renderer)
{
  std::vector<vtkLight*> lights;
  vtkLightCollection* const all = renderer.GetLights();
  vtkCollectionSimpleIterator at = nullptr;
  all->InitTraversal(at);
  while (vtkLight* const light = all->GetNextLight(at))
  {
    if (light->GetSwitch() != 0)
    {
      lights.push_back(light);
    }
  }
  return lights;
}

Eigen::Vector3d moved(vtkMatrix4x4* matrix, const double* point)
{
  double from[4] = { point[0], point[1], point[2], 1 };
  if (matrix != nullptr)
  {
    matrix->MultiplyPoint(from, from);
  }
  return Eigen::Vector3d(from[0], from[1], from[2]) / from[3];
}

/// Where it is the only one, VTK lights from the camera, wherever the light is and whether or not it follows.
bool isPlainHeadlight(vtkLight& light) { return light.LightTypeIsHeadlight() != 0 && light.GetPositional() == 0; }

LightDescription describe(vtkLight& light, vtkCamera& camera, vtkRenderer& renderer, bool alone)
{
  LightDescription to;
  const bool plain = alone && isPlainHeadlight(light);
  const bool follows = plain || renderer.GetLightFollowCamera() != 0;
  const bool head = light.LightTypeIsHeadlight() != 0 && follows;
  const bool carried = light.LightTypeIsCameraLight() != 0 && follows;
  vtkMatrix4x4* const matrix = plain     ? nullptr
                               : carried ? camera.GetCameraLightTransformMatrix()
                                         : light.GetTransformMatrix();
  to.position = moved(matrix, head ? camera.GetPosition() : light.GetPosition());
  to.target = moved(matrix, head ? camera.GetFocalPoint() : light.GetFocalPoint());
  const bool cone = light.GetConeAngle() < wholeCone;
  to.kind = light.GetPositional() != 0  ? (cone ? LightKind::Spot : LightKind::Point)
            : head && matrix == nullptr ? LightKind::Head
                                        : LightKind::Directional;
  const double* const color = light.GetDiffuseColor();
  to.diffuse = Eigen::Vector3d(color[0], color[1], color[2]);
  to.specular = to.diffuse; // VTK has no other for highlights
  to.intensity = light.GetIntensity();
  const double* const fading = light.GetAttenuationValues();
  to.attenuation = Eigen::Vector3d(fading[0], fading[1], fading[2]);
  to.coneAngle = cone ? light.GetConeAngle() : 30.0;
  to.exponent = light.GetExponent();
  to.shadows = renderer.GetUseShadows() != 0 && traitsOf(to.kind).shadows;
  return to;
}
} // namespace

bool isLit(vtkRenderer& renderer)
{
  return renderer.GetAutomaticLightCreation() != 0 || !lightsOf(renderer).empty(); // VTK makes one where none is on
}

LightDescription headLight()
{
  LightDescription head;
  head.name = "head";
  head.kind = LightKind::Head;
  return head;
}

std::vector<LightDescription> rendererLights(vtkRenderer& renderer, vtkCamera& camera)
{
  std::vector<LightDescription> lights;
  const std::vector<vtkLight*> all = lightsOf(renderer);
  for (vtkLight* const light : all)
  {
    lights.push_back(describe(*light, camera, renderer, all.size() == 1));
    lights.back().name = "light-" + std::to_string(lights.size());
  }
  return lights;
}

} // namespace dgtk
