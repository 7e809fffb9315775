// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterScene.h"

#include "dgtkDrawOrder.h"
#include "dgtkError.h"
#include "dgtkSurfaceMaterial.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <vtkOpenGLCamera.h>
#include <vtkOpenGLLight.h>
#include <vtkOpenGLProperty.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLShaderProperty.h>
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

template <typename Array, typename Matrix>
void store(Array& target, const Matrix& source)
{
  for (std::size_t i = 0; i < target.size(); ++i)
  {
    target[i] = float(source.data()[i]);
  }
}

} // namespace

RasterScene::RasterScene(vtkOpenGLRenderWindow* window)
  : Window(window)
  , Models(window, this->Frame)
  , Lighting(this->Frame)
{
  this->Window->AddRenderer(this->Renderer);
  vtkNew<vtkOpenGLCamera> camera;
  this->Renderer->SetActiveCamera(camera);
  // VTK lights a surface only where there is a light; its own one is not used otherwise.
  vtkNew<vtkOpenGLLight> light;
  this->Renderer->AddLight(light);
  this->Renderer->UpdateLights();
}

RasterScene::~RasterScene()
{
  this->Window->MakeCurrent();
  for (const Draw& draw : this->Draws)
  {
    draw.actor->SetMapper(nullptr);
  }
  this->Draws.clear();
  this->Window->RemoveRenderer(this->Renderer);
}

void RasterScene::setState(std::shared_ptr<const SceneState> state, const View& view)
{
  this->Lighting.setView(view);
  if (state == this->State)
  {
    return;
  }
  this->Models.begin(*state);
  this->State = std::move(state);
  this->Lighting.setState(this->State);
  this->makeDraws();
  this->Models.drop();
}

void RasterScene::makeDraws()
{
  this->Translucent = false;
  this->FirstHits = std::make_shared<std::vector<Hit>>(1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < this->State->instances.size(); ++i)
  {
    const Instance& instance = this->State->instances[i];
    if (!instance.visible)
    {
      continue;
    }
    const RasterModel& model = this->Models.of(instance);
    for (const RasterChunk& chunk : model.chunks)
    {
      if (count == this->Draws.size())
      {
        this->Draws.emplace_back();
        this->Draws.back().actor = vtkSmartPointer<PartActor>::New();
        this->Draws.back().actor->SetShaderProperty(this->ShaderProperty);
        this->Draws.back().actor->ForceOpaqueOn();
      }
      Draw& draw = this->Draws[count++];
      if (draw.chunk != &chunk)
      {
        draw.pieces.reset();
      }
      draw.instance = i;
      draw.model = &model;
      draw.chunk = &chunk;
      draw.actor->SetMapper(chunk.mapper);
      draw.actor->SetProperty(chunk.property);
      draw.actor->SetTexture(chunk.texture);
      draw.actor->number = float(count);
      draw.actor->emission = chunk.emission;
      draw.actor->surface = &chunk.surface;
      draw.actor->mirrored = instance.world_from_object.linear.determinant() < 0;
      this->FirstHits->push_back({ std::uint32_t(i + 1), chunk.firstTriangle });
      this->Translucent = this->Translucent || chunk.translucent;
    }
  }
  this->Draws.resize(count);
  if (count >= RasterModels::mostTriangles)
  {
    throw UsageError("more than 16,777,215 parts of objects cannot be drawn at once");
  }
}

void RasterScene::place(const RasterCamera& camera)
{
  std::vector<ViewBox> boxes;
  std::vector<std::size_t> visible;
  for (Draw& draw : this->Draws)
  {
    const Instance& instance = this->State->instances[draw.instance];
    const Eigen::Matrix4d world_from_local = matrixOf(instance.world_from_object, draw.model->geometry->origin);
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
  this->Lighting.aim(camera);
}

/// Cuts the triangles of a draw that OpenGL would draw in the wrong place.
void RasterScene::cutDraw(Draw& draw, const RasterCamera& camera, const Eigen::Matrix4d& view_from_local)
{
  const PieceRange range = pieceRange(*draw.model, *draw.chunk, view_from_local);
  if (!mayNeedPieces(range, camera))
  {
    return;
  }
  makePieces(range, camera, this->Cut);
  draw.cut = !this->Cut.empty();
  if (draw.cut)
  {
    if (!draw.pieces)
    {
      draw.pieces =
        std::make_unique<PieceDraw>(this->Window, this->Frame, this->ShaderProperty, *draw.model, *draw.chunk);
    }
    draw.pieces->fill(this->Cut, camera, *draw.actor);
  }
}

void RasterScene::prepareLight(bool zeroToOne)
{
  this->Lighting.prepare(zeroToOne, [this](const RasterCamera& camera, int size) { this->drawShadows(camera, size); });
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
  this->Lighting.bind();
  glActiveTexture(GL_TEXTURE0);
  state->ResetGLActiveTexture();
}

void RasterScene::drawColor(Surfaces surfaces)
{
  this->setUpState();
  if (surfaces != Surfaces::Translucent && this->Layer == 0 && this->Lighting.environment().background())
  {
    vtkOpenGLState* state = this->Window->GetState();
    this->Window->GetShaderCache()->ReleaseCurrentShader();
    state->vtkglDisable(GL_DEPTH_TEST);
    this->Lighting.environment().drawBackground(this->Camera, this->Width, this->Height, RasterUnits::background);
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
        draw.pieces->actor().RenderOpaqueGeometry(this->Renderer);
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
      this->drawIdsOf(draw.pieces->mapper(), draw.pieces->actor(), *draw.chunk);
    }
  }
  glBindVertexArray(0);
  glUseProgram(0);
}

void RasterScene::drawIdsOf(PartMapper& mapper, PartActor& actor, const RasterChunk& chunk)
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
