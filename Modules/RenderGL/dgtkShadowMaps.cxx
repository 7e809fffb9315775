// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkShadowMaps.h"

#include "dgtkError.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <string>
#include <vtk_glew.h>

namespace dgtk
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double LargestCone = 60; // degrees, half the opening of a light with a single map
constexpr double Nearest = 1e-4;   // of the reach of a light
constexpr double Margin = 1.0 + 1e-6;

/// View axes as OpenGL's, looking along `axis`.
Eigen::Matrix4d lookAlong(const Eigen::Vector3d& eye, const Eigen::Vector3d& axis, const Eigen::Vector3d& up)
{
  const Eigen::Vector3d z = -axis.normalized();
  const Eigen::Vector3d x = up.cross(z).normalized();
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.block<1, 3>(0, 0) = x.transpose();
  m.block<1, 3>(1, 0) = z.cross(x).transpose();
  m.block<1, 3>(2, 0) = z.transpose();
  m.topRightCorner<3, 1>() = -m.topLeftCorner<3, 3>() * eye;
  return m;
}

/// The world axis that is most across `axis`.
Eigen::Vector3d across(const Eigen::Vector3d& axis)
{
  Eigen::Vector3d::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  return Eigen::Vector3d::Unit(least);
}

void setDepths(RasterCamera& camera, double near, double far, bool zeroToOne)
{
  camera.near = near;
  camera.far = far;
  Eigen::Matrix4d& clip = camera.clip_from_view;
  clip.row(2).setZero();
  const double scale = camera.perspective ? near : 1.0;
  clip(2, 2) = scale / (far - near);
  clip(2, 3) = scale * far / (far - near);
  if (!zeroToOne)
  {
    clip.row(2) = 2 * clip.row(2) - clip.row(3);
  }
}

ShadowView parallelView(const LightState& light, const BoundingBall& ball, bool zeroToOne)
{
  ShadowView view;
  view.size = light.shadowSize;
  const Eigen::Vector3d axis = (light.target - light.position).normalized();
  const double reach = ball.radius * Margin;
  view.camera.perspective = false;
  view.camera.view_from_world = lookAlong(ball.centre - axis * (2 * reach), axis, across(axis));
  view.camera.clip_from_view.setZero();
  view.camera.clip_from_view(0, 0) = view.camera.clip_from_view(1, 1) = 1 / reach;
  view.camera.clip_from_view(3, 3) = 1;
  setDepths(view.camera, reach, 3 * reach, zeroToOne);
  view.camera.focal = view.size / (2 * reach);
  view.texel = 2 * reach / view.size;
  return view;
}

ShadowView perspectiveView(const LightState& light, const BoundingBall& ball, const Eigen::Vector3d& axis,
  const Eigen::Vector3d& up, double halfAngle, bool zeroToOne)
{
  ShadowView view;
  view.size = light.shadowSize;
  const double far = ((ball.centre - light.position).norm() + ball.radius) * Margin;
  const double slope = std::tan(halfAngle * Pi / 180);
  view.camera.perspective = true;
  view.camera.view_from_world = lookAlong(light.position, axis, up);
  view.camera.clip_from_view.setZero();
  view.camera.clip_from_view(0, 0) = view.camera.clip_from_view(1, 1) = 1 / slope;
  view.camera.clip_from_view(3, 2) = -1;
  setDepths(view.camera, far * Nearest, far, zeroToOne);
  view.camera.focal = view.size / (2 * slope);
  view.texel = 2 * slope / view.size;
  return view;
}

void addViews(const LightState& light, const BoundingBall& ball, bool zeroToOne, std::vector<ShadowView>& views)
{
  if (light.kind == LightState::Kind::Directional)
  {
    views.push_back(parallelView(light, ball, zeroToOne));
    return;
  }
  if (light.kind == LightState::Kind::Spot && light.coneAngle <= LargestCone)
  {
    const Eigen::Vector3d axis = light.target - light.position;
    // A rim of a texel or two, so that the comparisons at the cone's border find neighbours.
    const double rim = light.coneAngle + 2.0 * light.coneAngle / light.shadowSize;
    views.push_back(perspectiveView(light, ball, axis, across(axis), rim, zeroToOne));
    return;
  }
  for (int face = 0; face < 6; ++face)
  {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(face / 2) * (face % 2 == 0 ? 1.0 : -1.0);
    views.push_back(perspectiveView(
      light, ball, axis, Eigen::Vector3d::Unit((face / 2 + 1) % 3), 45.0 + 180.0 / light.shadowSize, zeroToOne));
    views.back().cube = true;
  }
}

} // namespace

std::vector<ShadowView> shadowViews(
  const std::vector<LightState>& lights, const BoundingBall& ball, bool zeroToOne, std::vector<int>& firstOfLight)
{
  std::vector<ShadowView> views;
  firstOfLight.clear();
  for (const LightState& light : lights)
  {
    const bool casts = light.shadows && light.kind != LightState::Kind::Head && ball.radius > 0;
    firstOfLight.push_back(casts ? int(views.size()) : -1);
    if (casts)
    {
      addViews(light, ball, zeroToOne, views);
    }
  }
  return views;
}

ShadowMaps::~ShadowMaps()
{
  glDeleteFramebuffers(1, &this->Framebuffer);
  glDeleteTextures(1, &this->Maps);
  glDeleteTextures(1, &this->Data);
  glDeleteBuffers(1, &this->Buffer);
}

void ShadowMaps::allocate(int size, int layers)
{
  if (size == this->Size && layers == this->Layers)
  {
    return;
  }
  if (!this->Maps)
  {
    glGenTextures(1, &this->Maps);
    glGenFramebuffers(1, &this->Framebuffer);
    glGenBuffers(1, &this->Buffer);
    glGenTextures(1, &this->Data);
  }
  while (glGetError() != GL_NO_ERROR)
  {
  }
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, this->Maps);
  glTexImage3D(
    GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT32F, size, size, layers, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
  if (glGetError() != GL_NO_ERROR)
  {
    this->Size = this->Layers = 0;
    throw MachineError("OpenGL cannot hold " + std::to_string(layers) + " shadow maps of " + std::to_string(size) +
                       " x " + std::to_string(size));
  }
  this->Size = size;
  this->Layers = layers;
}

void ShadowMaps::update(
  std::vector<ShadowView> views, bool zeroToOne, const std::function<void(const RasterCamera&, int)>& draw)
{
  this->Views = std::move(views);
  this->ZeroToOne = zeroToOne;
  if (this->Views.empty())
  {
    return;
  }
  int size = 0;
  for (const ShadowView& view : this->Views)
  {
    size = std::max(size, view.size);
  }
  this->allocate(size, int(this->Views.size()));
  for (std::size_t i = 0; i < this->Views.size(); ++i)
  {
    glBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, this->Maps, 0, GLint(i));
    const GLenum none = GL_NONE;
    glDrawBuffers(1, &none);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    {
      throw MachineError(
        "OpenGL cannot draw to a shadow map of " + std::to_string(size) + " x " + std::to_string(size));
    }
    draw(this->Views[i].camera, this->Views[i].size);
  }
}

void ShadowMaps::aim(const Eigen::Matrix4d& view_from_world)
{
  if (this->Views.empty())
  {
    return;
  }
  const Eigen::Matrix3d turn = view_from_world.topLeftCorner<3, 3>();
  Eigen::Matrix4d world_from_view = Eigen::Matrix4d::Identity();
  world_from_view.topLeftCorner<3, 3>() = turn.transpose();
  world_from_view.topRightCorner<3, 1>() = -turn.transpose() * view_from_world.topRightCorner<3, 1>();
  std::vector<float> values;
  for (const ShadowView& view : this->Views)
  {
    Eigen::Matrix4d m = view.camera.clip_from_view * view.camera.view_from_world * world_from_view;
    if (!this->ZeroToOne)
    {
      m.row(2) = (m.row(2) + m.row(3)) / 2;
    }
    for (int i = 0; i < 16; ++i)
    {
      values.push_back(float(m.data()[i]));
    }
    values.insert(values.end(), { float(view.texel), float(view.size), view.cube ? 1.0f : 0.0f, 0.0f });
  }
  glBindBuffer(GL_TEXTURE_BUFFER, this->Buffer);
  glBufferData(GL_TEXTURE_BUFFER, GLsizeiptr(values.size() * sizeof(float)), values.data(), GL_STREAM_DRAW);
}

void ShadowMaps::bind(int mapsUnit, int dataUnit) const
{
  glActiveTexture(GLenum(GL_TEXTURE0 + mapsUnit));
  glBindTexture(GL_TEXTURE_2D_ARRAY, this->Maps);
  glActiveTexture(GLenum(GL_TEXTURE0 + dataUnit));
  glBindTexture(GL_TEXTURE_BUFFER, this->Data);
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, this->Buffer);
}

} // namespace dgtk
