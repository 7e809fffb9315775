// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkShadowMaps.h"

#include "dgtkError.h"

#include <algorithm>
#include <string>
#include <vtk_glew.h>

namespace dgtk
{
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
    values.insert(values.end(), { float(view.texel), float(view.size), view.cube ? 1.0f : 0.0f, float(view.nested) });
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
