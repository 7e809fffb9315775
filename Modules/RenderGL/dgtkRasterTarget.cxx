// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterTarget.h"

#include "dgtkError.h"

#include <string>
#include <vtk_glew.h>

namespace dgtk
{
namespace
{

void allocateTexture(unsigned int texture, GLint internal, GLenum format, int width, int height)
{
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, internal, width, height, 0, format, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
}

} // namespace

RasterTarget::RasterTarget(bool withDepthInIds)
  : WithDepth(withDepthInIds)
{
}

RasterTarget::~RasterTarget() { this->release(); }

void RasterTarget::release()
{
  if (this->Framebuffer)
  {
    glDeleteFramebuffers(1, &this->Framebuffer);
    glDeleteTextures(3, this->Textures.data());
    this->Framebuffer = 0;
    this->AllocatedWidth = 0;
    this->AllocatedHeight = 0;
  }
}

void RasterTarget::resize(int width, int height)
{
  if (!this->Framebuffer || width > this->AllocatedWidth || height > this->AllocatedHeight)
  {
    this->allocate(width, height);
  }
  this->Width = width;
  this->Height = height;
}

void RasterTarget::allocate(int width, int height)
{
  this->release();
  while (glGetError() != GL_NO_ERROR)
  {
  }
  glGenTextures(3, this->Textures.data());
  glActiveTexture(GL_TEXTURE0);
  allocateTexture(this->Textures[0], GL_RGBA32F, GL_RGBA, width, height);
  allocateTexture(
    this->Textures[1], this->WithDepth ? GL_RGBA32F : GL_RG32F, this->WithDepth ? GL_RGBA : GL_RG, width, height);
  allocateTexture(this->Textures[2], GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, width, height);
  glBindTexture(GL_TEXTURE_2D, 0);
  glGenFramebuffers(1, &this->Framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, this->Textures[0], 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, this->Textures[1], 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, this->Textures[2], 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || glGetError() != GL_NO_ERROR)
  {
    this->release();
    throw MachineError("OpenGL has no framebuffer of " + std::to_string(width) + " x " + std::to_string(height) +
                       " pixels with two float colours and float depth");
  }
  this->AllocatedWidth = width;
  this->AllocatedHeight = height;
}

void RasterTarget::bind(bool color, bool ids)
{
  glBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
  const GLenum buffers[2] = { GLenum(color ? GL_COLOR_ATTACHMENT0 : GL_NONE),
    GLenum(ids ? GL_COLOR_ATTACHMENT1 : GL_NONE) };
  glDrawBuffers(2, buffers);
}

void RasterTarget::clear(const std::array<float, 4>& color, float idDepth)
{
  const float nothing[4] = { 0, 0, idDepth, 0 };
  const float farthest = 0; // depth is reversed
  const bool isPart = this->Width != this->AllocatedWidth || this->Height != this->AllocatedHeight;
  std::array<GLint, 4> scissor{};
  if (isPart)
  {
    glGetIntegerv(GL_SCISSOR_BOX, scissor.data());
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, this->Width, this->Height);
  }
  glClearBufferfv(GL_COLOR, 0, color.data());
  glClearBufferfv(GL_COLOR, 1, nothing);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  if (isPart)
  {
    glDisable(GL_SCISSOR_TEST);
    // VTK remembers what it set, and would not set it again.
    glScissor(scissor[0], scissor[1], scissor[2], scissor[3]);
  }
}

void RasterTarget::copyDepthFrom(const RasterTarget& other)
{
  glBindFramebuffer(GL_READ_FRAMEBUFFER, other.Framebuffer);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->Framebuffer);
  glBlitFramebuffer(0, 0, this->Width, this->Height, 0, 0, this->Width, this->Height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
}

void RasterTarget::readColor(std::vector<float>& rgba)
{
  rgba.resize(std::size_t(this->Width) * this->Height * 4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, this->Framebuffer);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, this->Width, this->Height, GL_RGBA, GL_FLOAT, rgba.data());
}

void RasterTarget::readIds(std::vector<float>& ids)
{
  ids.resize(std::size_t(this->Width) * this->Height * 2);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, this->Framebuffer);
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, this->Width, this->Height, GL_RG, GL_FLOAT, ids.data());
}

} // namespace dgtk
