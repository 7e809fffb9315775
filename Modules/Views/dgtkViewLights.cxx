// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewLights.h"

#include "dgtkEnvironmentLight.h"
#include "dgtkPhongProperty.h"
#include "dgtkPortableMath.h"
#include "dgtkSurfaceMaterial.h"

#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkNew.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkSkybox.h>
#include <vtkTexture.h>
#include <vtkUniforms.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace dgtk
{

namespace
{
constexpr double pointCone = 180;   // degrees: VTK's word for a light in all directions
constexpr double usualCosine = 0.7; // between a surface's normal and the viewer
constexpr double displayGamma = 2.2;
constexpr int skyWidth = 1024; // pixels all around
// Of the light at the eye.
constexpr double headAmbient = 0.25;
constexpr double headDiffuse = 0.85;
constexpr double headSpecular = 0.5;

/// Of a lobe as wide as that of facets.
double phongPower(double roughness) { return std::max(1.0, 2 / std::max(std::pow(roughness, 4), 1e-3) - 2); }

/// With an environment the renderer adds lights linearly. A product of display-referred colours is nearly that of
/// linear ones.
constexpr const char* environmentCode = R"(
  vec3 dgtkSurface = dgtkToDisplay(dgtkToLinear(diffuseColor) + dgtkToLinear(specularColorUniform));
  vec3 dgtkLight = (gl_FragData[0].rgb - ambientColor) / max(dgtkSurface, vec3(0.004));
  vec3 dgtkAll = dgtkLight + dgtkIrradianceFrom(normalize(dgtkImageFromView * normalVCVSOutput));
  gl_FragData[0].rgb = ambientColor + dgtkSurface * dgtkToDisplay(dgtkAll);
)";
} // namespace

ViewLights::ViewLights(vtkRenderer* renderer)
  : Renderer(renderer)
{
  renderer->GetBackground(this->OwnBackground[0].data());
  renderer->GetBackground2(this->OwnBackground[1].data());
  renderer->AutomaticLightCreationOff();
  this->addHead();
}

ViewLights::~ViewLights() = default;

void ViewLights::addHead()
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToHeadlight();
  this->Renderer->AddLight(light);
}

void ViewLights::add(const LightState& light)
{
  vtkNew<vtkLight> added;
  const LightTraits& kind = traitsOf(light.kind);
  added->SetPositional(kind.near);
  added->SetConeAngle(kind.cone ? light.coneAngle : pointCone);
  if (!kind.placed)
  {
    added->SetLightTypeToHeadlight();
  }
  else
  {
    added->SetLightTypeToSceneLight();
    added->SetPosition(light.position.x(), light.position.y(), light.position.z());
    added->SetFocalPoint(light.target.x(), light.target.y(), light.target.z());
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

bool ViewLights::show(
  const SceneState& surroundings, std::shared_ptr<const EnvironmentLight> environment, const ViewCamera& usual)
{
  this->Renderer->RemoveAllLights();
  Look look;
  look.ofScene = this->OfScene;
  if (!this->OfScene)
  {
    this->addHead();
  }
  else
  {
    look.environment = std::move(environment);
    look.ambient.setConstant(look.environment != nullptr ? 0.0 : worldAmbient);
    double diffuse = 0;
    double specular = 0;
    for (const LightState& light : surroundings.lights)
    {
      this->add(light);
      diffuse += light.intensity * light.diffuse.sum();
      specular += light.intensity * light.specular.sum();
      look.ambient += light.intensity * light.ambient;
    }
    look.shine = diffuse > 0 ? std::min(specular / diffuse, 1.0) : 1.0;
  }
  this->fillUp();
  this->showBackground(surroundings, usual);
  if (surroundings.environment != nullptr)
  {
    this->image_from_world = surroundings.environment->image_from_world;
  }
  const bool other = !(look == this->Now);
  this->Now = std::move(look);
  if (other)
  {
    this->Shadings.clear();
  }
  return other;
}

void ViewLights::showBackground(const SceneState& surroundings, const ViewCamera& usual)
{
  Eigen::Vector3d bottom = this->OwnBackground[0];
  const bool sky = this->OfScene && surroundings.environment != nullptr && surroundings.environment->background;
  if (this->OfScene)
  {
    // All of a parallel view looks the same way.
    bottom = backgroundOf(surroundings, usual.forward()).cwiseMin(1.0);
  }
  this->Renderer->SetBackground(bottom.data());
  this->Renderer->SetGradientBackground(!this->OfScene);
  if (sky && !usual.parallel())
  {
    this->showSky(surroundings);
  }
  else if (this->Sky != nullptr)
  {
    this->Sky->VisibilityOff();
  }
}

void ViewLights::showSky(const SceneState& surroundings)
{
  if (this->Sky == nullptr)
  {
    this->Sky = vtkSmartPointer<vtkSkybox>::New();
    this->Sky->SetProjectionToSphere();
    this->Renderer->AddActor(this->Sky);
  }
  this->Sky->VisibilityOn();
  if (this->SkyOf == surroundings.environment)
  {
    return;
  }
  this->SkyOf = surroundings.environment;
  vtkNew<vtkImageData> picture;
  picture->SetDimensions(skyWidth, skyWidth / 2, 1);
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* to = static_cast<std::uint8_t*>(picture->GetScalarPointer());
  for (int row = 0; row < skyWidth / 2; ++row)
  {
    // VTK's sphere: rows from below, the world's -z in the middle, its x to the right of that.
    const double height = ((row + 0.5) / (skyWidth / 2) - 0.5) * pi;
    for (int column = 0; column < skyWidth; ++column)
    {
      const double around = ((column + 0.5) / skyWidth - 0.5) * 2 * pi;
      const Eigen::Vector3d color = backgroundOf(
        surroundings, { std::cos(height) * std::sin(around), std::sin(height), -std::cos(height) * std::cos(around) });
      for (int c = 0; c < 3; ++c)
      {
        *to++ = static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[c], 0.0, 1.0)));
      }
    }
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(picture);
  texture->SetColorModeToDirectScalars();
  texture->InterpolateOn();
  this->Sky->SetTexture(texture);
}

void ViewLights::fill(const Material& material, vtkProperty& property) const
{
  setProperty(material, property);
  property.SetSpecularPower(std::max(material.shininess, 1.0));
  // VTK adds the ambient colour without light: it holds the emission, and what the lights' ambient light makes of it.
  Eigen::Vector3d glow = material.emission;
  if (this->Now.ofScene)
  {
    glow += this->Now.ambient.cwiseProduct(material.ambient);
    property.SetSpecular(this->Now.shine);
  }
  else
  {
    glow += headAmbient * material.diffuse;
    property.SetDiffuse(headDiffuse);
    property.SetSpecular(headSpecular);
  }
  glow = glow.cwiseMin(1.0);
  property.SetAmbientColor(glow.data());
  if (this->Now.environment != nullptr)
  {
    const FacetedSurface facets = facetsOf(material);
    const Eigen::Vector3d diffuse = (1 - facets.metallic) * material.diffuse;
    const Eigen::Vector3d base = material.diffuse.array().pow(displayGamma);
    const Eigen::Vector3d f0 = (1 - facets.metallic) * facets.f0 + facets.metallic * base;
    const Eigen::Vector2d table = reflectanceOf(usualCosine, facets.roughness);
    const Eigen::Vector3d mirrored = (f0.array() * table.x() + table.y()).pow(1 / displayGamma);
    property.SetDiffuseColor(diffuse.x(), diffuse.y(), diffuse.z());
    property.SetSpecularColor(mirrored.x(), mirrored.y(), mirrored.z());
    property.SetSpecularPower(phongPower(facets.roughness));
  }
}

vtkSmartPointer<vtkShaderProperty> ViewLights::makeShading(bool glows)
{
  auto shading = vtkSmartPointer<vtkShaderProperty>::Take(vtkShaderProperty::New());
  const bool environment = this->Now.environment != nullptr;
  const std::string tag = "//VTK::Light::Impl";
  const std::string code = (glows ? "  ambientColor = dgtkGlow;\n" : "") + tag + (environment ? environmentCode : "");
  if (environment)
  {
    const std::string declarations = "//VTK::Light::Dec";
    shading->AddFragmentShaderReplacement(
      declarations, true, declarations + transferShader() + irradianceShader(), false);
    float irradiance[9][3];
    Eigen::Map<Eigen::Matrix<float, 3, 9>> columns(irradiance[0]);
    for (int i = 0; i < 9; ++i)
    {
      columns.col(i) = this->Now.environment->irradiance[std::size_t(i)].cast<float>();
    }
    shading->GetFragmentCustomUniforms()->SetUniform3fv("dgtkIrradiance", 9, irradiance);
    this->Shadings.insert(shading);
  }
  if (glows || environment)
  {
    shading->AddFragmentShaderReplacement(tag, true, code, false);
  }
  // What is cut out is not there; the rest is not mixed with what is drawn behind it later.
  const std::string texel = "//VTK::TCoord::Impl";
  shading->AddFragmentShaderReplacement(texel, true,
    texel + "\n  if (gl_FragData[0].a < 0.5 * opacity) { discard; }\n  gl_FragData[0].a = opacity;\n", false);
  return shading;
}

void ViewLights::setGlow(vtkShaderProperty& shading, vtkProperty& property)
{
  float glow[3];
  for (int c = 0; c < 3; ++c)
  {
    glow[c] = static_cast<float>(property.GetAmbient() * property.GetAmbientColor()[c]);
  }
  shading.GetFragmentCustomUniforms()->SetUniform3f("dgtkGlow", glow);
}

void ViewLights::aim(const ViewCamera& camera)
{
  if (this->Shadings.empty())
  {
    return;
  }
  Eigen::Matrix3d world_from_view;
  world_from_view.col(2) = -camera.forward();
  world_from_view.col(0) = camera.up().cross(world_from_view.col(2)).normalized();
  world_from_view.col(1) = world_from_view.col(2).cross(world_from_view.col(0));
  Eigen::Matrix3f image_from_view = (this->image_from_world * world_from_view).cast<float>();
  for (vtkShaderProperty* const shading : this->Shadings)
  {
    shading->GetFragmentCustomUniforms()->SetUniformMatrix3x3("dgtkImageFromView", image_from_view.data());
  }
}

} // namespace dgtk
