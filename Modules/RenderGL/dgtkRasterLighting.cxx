// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterLighting.h"

#include "dgtkShadowViews.h"

#include <algorithm>
#include <vtk_glew.h>

namespace dgtk
{

RasterLighting::~RasterLighting()
{
  glDeleteTextures(1, &this->LightTexture);
  glDeleteBuffers(1, &this->LightBuffer);
}

void RasterLighting::setState(std::shared_ptr<const SceneState> state)
{
  this->State = std::move(state);
  this->EnvironmentReady = this->ShadowsReady = false;
  this->FirstShadows.clear();
}

void RasterLighting::setView(const View& view)
{
  const Rigid3& before = this->Seen.camera_from_world;
  const Rigid3& now = view.camera_from_world;
  const bool same = this->Seen.model == view.model && before.rotation == now.rotation &&
                    before.translation == now.translation && this->Seen.near == view.near && this->Seen.far == view.far;
  this->ShadowsReady = this->ShadowsReady && same;
  this->Seen = view;
}

void RasterLighting::prepare(bool zeroToOne, const std::function<void(const RasterCamera&, int)>& draw)
{
  if (!this->EnvironmentReady)
  {
    this->Environment.set(this->State->environment);
    this->EnvironmentReady = true;
  }
  if (!this->ShadowsReady)
  {
    std::vector<ShadowView> views = shadowViews(*this->State, this->Seen, zeroToOne, this->FirstShadows);
    this->Shadows.update(std::move(views), zeroToOne, draw);
    this->ShadowsReady = true;
  }
}

void RasterLighting::aim(const RasterCamera& camera)
{
  this->Frame.lights = rasterLights(this->State->lights, camera.view_from_world, this->FirstShadows);
  this->Shadows.aim(camera.view_from_world);
  this->Environment.aim(camera.view_from_world);
  this->Frame.shadows = !this->Shadows.empty();
  this->Frame.environment = this->Environment.exists();
  this->Frame.imageFromView = this->Environment.imageFromView();
  this->Frame.irradiance = this->Environment.irradiance();
  const Eigen::Matrix3d worldFromView = camera.view_from_world.topLeftCorner<3, 3>().transpose();
  Eigen::Map<Eigen::Matrix3f>(this->Frame.worldFromView.data()) = worldFromView.cast<float>();
  const FogState& fog = this->State->fog;
  this->Frame.fog = fog.density > 0;
  Eigen::Map<Eigen::Vector3f>(this->Frame.fogColor.data()) = fog.color.cast<float>();
  this->Frame.fogDensity = { float(fog.density), float(fog.start) };
  ++this->Frame.lightsVersion;
}

void RasterLighting::uploadLights()
{
  if (this->Frame.lights.count() <= this->Frame.maxUniformLights)
  {
    return;
  }
  if (!this->LightTexture)
  {
    glGenBuffers(1, &this->LightBuffer);
    glGenTextures(1, &this->LightTexture);
  }
  const auto& values = this->Frame.lights.values;
  glBindBuffer(GL_TEXTURE_BUFFER, this->LightBuffer);
  glBufferData(GL_TEXTURE_BUFFER, GLsizeiptr(values.size() * sizeof(values[0])), values.data(), GL_STREAM_DRAW);
  glActiveTexture(GL_TEXTURE0 + RasterUnits::lights);
  glBindTexture(GL_TEXTURE_BUFFER, this->LightTexture);
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, this->LightBuffer);
  this->Frame.lightsUnit = RasterUnits::lights;
}

void RasterLighting::bind()
{
  this->uploadLights();
  if (!this->Shadows.empty())
  {
    this->Shadows.bind(RasterUnits::shadowMaps, RasterUnits::shadowData);
  }
  if (this->Environment.exists())
  {
    this->Environment.bind(RasterUnits::radiance, RasterUnits::reflectance);
  }
}

} // namespace dgtk
