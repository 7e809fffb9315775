// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDrawOrder.h"
#include "dgtkRasterScene.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkOpenGLTexture.h>
#include <vtk_glew.h>

namespace dgtk
{
namespace
{

Eigen::Matrix4d matrixOf(const Affine3& transform, const Eigen::Vector3d& origin)
{
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = transform.linear;
  m.topRightCorner<3, 1>() = transform * origin;
  return m;
}

/// False when the box is wholly outside one plane of the frustum.
bool maySee(const Eigen::Matrix4d& clip_from_object, const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
  unsigned int outsideAll = 63;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector4d x(
      (corner & 1 ? high : low).x(), (corner & 2 ? high : low).y(), (corner & 4 ? high : low).z(), 1);
    const Eigen::Vector4d clip = clip_from_object * x;
    const double w = clip.w() + std::abs(clip.w()) * 1e-6;
    const double back = -std::abs(clip.w()) * 1e-6 - std::abs(w); // [-1, 1] or [0, 1]: not sharper than needed
    outsideAll &= (clip.x() > w ? 1u : 0u) | (-clip.x() > w ? 2u : 0u) | (clip.y() > w ? 4u : 0u) |
                  (-clip.y() > w ? 8u : 0u) | (clip.z() > w ? 16u : 0u) | (clip.z() < back ? 32u : 0u);
  }
  return outsideAll == 0;
}

/// A box that is turned, a little larger than needed: surfaces at the same place may be rounded apart.
ViewBox turned(const Eigen::Matrix4d& matrix, const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
  const Eigen::Matrix3d linear = matrix.topLeftCorner<3, 3>();
  const Eigen::Vector3d center = linear * ((low + high) / 2) + matrix.topRightCorner<3, 1>();
  Eigen::Vector3d half = linear.cwiseAbs() * ((high - low) / 2);
  half.array() += 1e-6 * (half.maxCoeff() + center.cwiseAbs().maxCoeff());
  return { center - half, center + half };
}

/// Normals' matrix: the cofactors, which also exist where the matrix has no inverse; scaled to about 1.
Eigen::Matrix3d normalMatrix(const Eigen::Matrix3d& m)
{
  Eigen::Matrix3d cofactors;
  for (int c = 0; c < 3; ++c)
  {
    cofactors.col(c) = m.col((c + 1) % 3).cross(m.col((c + 2) % 3));
  }
  const double size = cofactors.cwiseAbs().maxCoeff();
  return cofactors * ((m.determinant() < 0 ? -1.0 : 1.0) / (size > 0 ? size : 1.0));
}

template <typename Array, typename Matrix>
void store(Array& target, const Matrix& source)
{
  for (std::size_t i = 0; i < target.size(); ++i)
  {
    target[i] = float(source.data()[i]);
  }
}

} // namespace

void RasterScene::place(const RasterCamera& camera)
{
  std::vector<ViewBox> boxes;
  std::vector<std::size_t> visible;
  for (Draw& draw : this->Draws)
  {
    const Instance& instance = this->State->instances[draw.instance];
    const Eigen::Matrix4d world_from_local = matrixOf(instance.world_from_object, draw.variant->shared->origin);
    const Eigen::Matrix4d view_from_local = camera.view_from_world * world_from_local;
    const Eigen::Matrix4d clip_from_local = camera.clip_from_view * view_from_local;
    draw.visible = maySee(clip_from_local, draw.chunk->boxMin, draw.chunk->boxMax);
    store(draw.actor->clip_from_object, clip_from_local);
    store(draw.actor->view_from_object, view_from_local);
    store(draw.actor->normal_view_from_object, normalMatrix(view_from_local.topLeftCorner<3, 3>()));
    draw.cut = false;
    draw.actor->runs.clear();
    draw.actor->nothing = false;
    if (draw.visible)
    {
      this->cutDraw(draw, camera, view_from_local);
      visible.push_back(std::size_t(&draw - this->Draws.data()));
      boxes.push_back(turned(view_from_local, draw.chunk->boxMin, draw.chunk->boxMax));
    }
  }
  this->Order = drawOrder(boxes);
  for (std::size_t& i : this->Order)
  {
    i = visible[i];
  }
}

void RasterScene::aim(const RasterCamera& camera, int width, int height)
{
  this->place(camera);
  this->Camera = camera;
  this->Width = width;
  this->Height = height;
  this->Frame.parallel = !camera.perspective;
  this->Frame.lights = rasterLights(this->State->lights, camera.view_from_world, this->FirstShadows);
  this->Shadows.aim(camera.view_from_world);
  this->Environment.aim(camera.view_from_world);
  this->Frame.shadows = !this->Shadows.empty();
  this->Frame.environment = this->Environment.exists();
  this->Frame.imageFromView = this->Environment.imageFromView();
  this->Frame.irradiance = this->Environment.irradiance();
  const Eigen::Matrix3d worldFromView = camera.view_from_world.topLeftCorner<3, 3>().transpose();
  store(this->Frame.worldFromView, worldFromView);
  const FogState& fog = this->State->fog;
  this->Frame.fog = fog.density > 0;
  store(this->Frame.fogColor, fog.color);
  this->Frame.fogDensity = { float(fog.density), float(fog.start) };
  ++this->Frame.lightsVersion;
}

void RasterScene::setView(const View& view)
{
  const Rigid3& before = this->Seen.camera_from_world;
  const Rigid3& now = view.camera_from_world;
  const bool same = this->Seen.model == view.model && before.rotation == now.rotation &&
                    before.translation == now.translation && this->Seen.near == view.near && this->Seen.far == view.far;
  this->ShadowsReady = this->ShadowsReady && same;
  this->Seen = view;
}

void RasterScene::prepareLight(bool zeroToOne)
{
  if (!this->EnvironmentReady)
  {
    this->Environment.set(this->State->environment);
    this->EnvironmentReady = true;
  }
  if (!this->ShadowsReady)
  {
    std::vector<ShadowView> views = shadowViews(*this->State, this->Seen, zeroToOne, this->FirstShadows);
    this->Shadows.update(
      std::move(views), zeroToOne, [this](const RasterCamera& camera, int size) { this->drawShadows(camera, size); });
    this->ShadowsReady = true;
  }
}

/// Depths of what is not translucent to the bound framebuffer.
void RasterScene::drawShadows(const RasterCamera& camera, int size)
{
  this->Window->GetState()->vtkglViewport(0, 0, size, size);
  this->place(camera);
  this->Layer = 0;
  this->Frame.peel = false;
  this->setUpState();
  const float farthest = 0;
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  this->drawAllIds(false);
}

void RasterScene::peelBehind(unsigned int layer)
{
  this->Layer = layer;
  this->Frame.peel = layer != 0;
  this->Frame.layerUnit = RasterUnits::layer;
}

void RasterScene::uploadLights()
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

/// What VTK's cache of OpenGL's state must know is set through it.
void RasterScene::setUpState()
{
  vtkOpenGLState* state = this->Window->GetState();
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDisable(GL_CULL_FACE);
  state->vtkglDisable(GL_MULTISAMPLE);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_GREATER);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  if (this->Layer)
  {
    glActiveTexture(GL_TEXTURE0 + RasterUnits::layer);
    glBindTexture(GL_TEXTURE_2D, this->Layer);
  }
  this->uploadLights();
  if (!this->Shadows.empty())
  {
    this->Shadows.bind(RasterUnits::shadowMaps, RasterUnits::shadowData);
  }
  if (this->Environment.exists())
  {
    this->Environment.bind(RasterUnits::radiance, RasterUnits::reflectance);
  }
  glActiveTexture(GL_TEXTURE0);
  state->ResetGLActiveTexture();
}

void RasterScene::drawColor(Surfaces surfaces)
{
  this->setUpState();
  if (surfaces != Surfaces::Translucent && this->Layer == 0 && this->Environment.background())
  {
    vtkOpenGLState* state = this->Window->GetState();
    this->Window->GetShaderCache()->ReleaseCurrentShader();
    state->vtkglDisable(GL_DEPTH_TEST);
    this->Environment.drawBackground(this->Camera, this->Width, this->Height, RasterUnits::background);
    state->ResetGLActiveTexture();
    state->vtkglEnable(GL_DEPTH_TEST);
  }
  this->drawAll(surfaces);
}

void RasterScene::drawAll(Surfaces surfaces)
{
  this->Frame.uploaded.clear();
  for (const std::size_t i : this->Order)
  {
    Draw& draw = this->Draws[i];
    if ((surfaces == Surfaces::All || draw.chunk->translucent == (surfaces == Surfaces::Translucent)))
    {
      if (!draw.actor->nothing)
      {
        draw.actor->RenderOpaqueGeometry(this->Renderer);
      }
      if (draw.cut)
      {
        draw.pieces->actor->RenderOpaqueGeometry(this->Renderer);
      }
    }
  }
}

void RasterScene::drawFragments(int width, int first, int last)
{
  vtkOpenGLState* state = this->Window->GetState();
  this->Frame.collect = true;
  this->setUpState();
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(0, first, width, last - first);
  this->drawAll(Surfaces::All);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglEnable(GL_DEPTH_TEST);
  this->Frame.collect = false;
}

void RasterScene::drawIds()
{
  this->setUpState();
  this->drawAllIds(true);
}

void RasterScene::drawAllIds(bool translucent)
{
  this->Window->GetShaderCache()->ReleaseCurrentShader();
  this->CurrentIds = nullptr;
  for (const std::size_t i : this->Order)
  {
    Draw& draw = this->Draws[i];
    if (draw.chunk->translucent && !translucent)
    {
      continue;
    }
    if (!draw.actor->nothing)
    {
      this->drawIdsOf(*draw.chunk->mapper, *draw.actor, *draw.chunk);
    }
    if (draw.cut)
    {
      this->drawIdsOf(*draw.pieces->mapper, *draw.pieces->actor, *draw.chunk);
    }
  }
  glBindVertexArray(0);
  glUseProgram(0);
}

void RasterScene::drawIdsOf(PartMapper& mapper, PartActor& actor, const Chunk& chunk)
{
  mapper.prepare(this->Renderer, &actor);
  ShaderVariant variant = mapper.material();
  variant.peel = this->Frame.peel;
  const IdPrograms::Program& program = this->Ids.program(variant);
  if (&program != this->CurrentIds)
  {
    glUseProgram(program.name);
    this->CurrentIds = &program;
    glUniform1i(program.layer, this->Frame.layerUnit);
  }
  glBindVertexArray(this->Ids.vertexArray());
  glUniformMatrix4fv(program.matrix, 1, GL_FALSE, actor.clip_from_object.data());
  glUniform2f(program.draw, actor.number, 0);
  glUniform1i(program.first, mapper.firstTriangle());
  if (variant.cutOut)
  {
    chunk.texture->Render(this->Renderer);
    glUniform1i(program.picture, chunk.texture->GetTextureUnit());
  }
  mapper.drawBare(actor);
  if (variant.cutOut)
  {
    chunk.texture->PostRender(this->Renderer);
  }
}

} // namespace dgtk
