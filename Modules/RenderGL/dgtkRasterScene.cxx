// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterScene.h"

#include "dgtkError.h"
#include "dgtkRasterTexture.h"
#include "dgtkSurfaceMaterial.h"

#include <Eigen/LU>

#include <algorithm>
#include <vtkFloatArray.h>
#include <vtkOpenGLCamera.h>
#include <vtkOpenGLLight.h>
#include <vtkOpenGLProperty.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOpenGLShaderProperty.h>
#include <vtkOpenGLTexture.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtk_glew.h>

namespace dgtk
{
namespace
{

constexpr std::uint32_t maxChunk = 1u << 24; // triangle numbers are exact in float

std::array<float, 3> floats(const Eigen::Vector3d& v) { return { float(v.x()), float(v.y()), float(v.z()) }; }

Eigen::Vector3d middleOf(const std::vector<Eigen::Vector3d>& positions)
{
  if (positions.empty())
  {
    return Eigen::Vector3d::Zero();
  }
  Eigen::Vector3d low = positions[0];
  Eigen::Vector3d high = positions[0];
  for (const Eigen::Vector3d& x : positions)
  {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return (low + high) / 2;
}

} // namespace

RasterScene::RasterScene(vtkOpenGLRenderWindow* window)
  : Window(window)
{
  auto white = std::make_shared<Image>();
  white->width = white->height = 1;
  white->rgba.assign(4, 255);
  this->White = white;
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
    if (draw.pieces)
    {
      draw.pieces->mapper->ReleaseGraphicsResources(this->Window);
    }
  }
  this->Draws.clear();
  for (const auto& variant : this->Variants)
  {
    for (const Chunk& chunk : variant->chunks)
    {
      chunk.mapper->ReleaseGraphicsResources(this->Window);
    }
  }
  for (const auto& entry : this->Textures)
  {
    entry.second->ReleaseGraphicsResources(this->Window);
  }
  glDeleteTextures(1, &this->LightTexture);
  glDeleteBuffers(1, &this->LightBuffer);
  this->Window->RemoveRenderer(this->Renderer);
}

void RasterScene::setState(std::shared_ptr<const SceneState> state, const View& view)
{
  this->setView(view);
  if (state == this->State)
  {
    return;
  }
  for (const auto& variant : this->Variants)
  {
    variant->used = false;
    for (const Instance& instance : state->instances)
    {
      variant->used =
        variant->used || (variant->shared->geometry == instance.geometry && variant->materials == instance.materials);
    }
  }
  this->State = std::move(state);
  this->EnvironmentReady = this->ShadowsReady = false;
  this->FirstShadows.clear();
  this->makeDraws();
  this->dropUnused();
}

void RasterScene::makeDraws()
{
  this->Translucent = false;
  this->FirstHits = std::make_shared<std::vector<Hit>>(1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < this->State->instances.size(); ++i)
  {
    const Instance& instance = this->State->instances[i];
    const Variant& variant = this->variantOf(instance);
    for (const Chunk& chunk : variant.chunks)
    {
      if (count == this->Draws.size())
      {
        this->Draws.emplace_back();
        this->Draws.back().actor = vtkSmartPointer<PartActor>::New();
        this->Draws.back().actor->SetShaderProperty(this->ShaderProperty);
        this->Draws.back().actor->ForceOpaqueOn();
      }
      Draw& draw = this->Draws[count++];
      if (draw.pieces && draw.chunk != &chunk)
      {
        draw.pieces->mapper->ReleaseGraphicsResources(this->Window);
        draw.pieces.reset();
      }
      draw.instance = i;
      draw.variant = &variant;
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
  for (std::size_t i = count; i < this->Draws.size(); ++i)
  {
    if (this->Draws[i].pieces)
    {
      this->Draws[i].pieces->mapper->ReleaseGraphicsResources(this->Window);
    }
  }
  this->Draws.resize(count);
  if (count >= maxChunk)
  {
    throw UsageError("more than 16,777,215 parts of objects cannot be drawn at once");
  }
}

void RasterScene::dropUnused()
{
  for (const auto& variant : this->Variants)
  {
    if (!variant->used)
    {
      for (const Chunk& chunk : variant->chunks)
      {
        chunk.mapper->ReleaseGraphicsResources(this->Window);
      }
    }
  }
  this->Variants.erase(std::remove_if(this->Variants.begin(), this->Variants.end(),
                         [](const std::unique_ptr<Variant>& variant) { return !variant->used; }),
    this->Variants.end());
}

RasterScene::Variant& RasterScene::variantOf(const Instance& instance)
{
  for (const auto& variant : this->Variants)
  {
    if (variant->shared->geometry == instance.geometry && variant->shared->model == instance.model &&
        variant->materials == instance.materials)
    {
      variant->used = true;
      return *variant;
    }
  }
  // A deformed model takes over the buffers of an instant that is over.
  for (const auto& variant : this->Variants)
  {
    if (!variant->used && variant->shared.use_count() == 1 && variant->shared->model == instance.model &&
        variant->materials == instance.materials)
    {
      fill(*variant->shared, instance.geometry);
      for (Chunk& chunk : variant->chunks)
      {
        measure(*variant->shared, chunk);
      }
      variant->used = true;
      return *variant;
    }
  }
  this->Variants.push_back(this->makeVariant(instance));
  return *this->Variants.back();
}

std::shared_ptr<RasterScene::Shared> RasterScene::sharedOf(const Instance& instance)
{
  for (const auto& variant : this->Variants)
  {
    if (variant->shared->geometry == instance.geometry && variant->shared->model == instance.model)
    {
      return variant->shared;
    }
  }
  auto shared = std::make_shared<Shared>();
  shared->model = instance.model;
  shared->topology = this->topologyOf(instance.model);
  shared->origin = middleOf(instance.model->rest->positions);
  shared->points = vtkSmartPointer<vtkFloatArray>::New();
  shared->points->SetNumberOfComponents(3);
  shared->normals = vtkSmartPointer<vtkFloatArray>::New();
  shared->normals->SetNumberOfComponents(3);
  shared->data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetData(shared->points);
  shared->data->SetPoints(points);
  shared->data->GetPointData()->SetNormals(shared->normals);
  if (!instance.model->uvs.empty())
  {
    vtkNew<vtkFloatArray> uvs;
    uvs->SetNumberOfComponents(2);
    uvs->SetNumberOfTuples(vtkIdType(shared->topology->source.size()));
    float* target = uvs->GetPointer(0);
    for (const std::uint32_t vertex : shared->topology->source)
    {
      *target++ = float(instance.model->uvs[vertex].x());
      *target++ = float(instance.model->uvs[vertex].y());
    }
    shared->data->GetPointData()->SetTCoords(uvs);
  }
  fill(*shared, instance.geometry);
  return shared;
}

std::shared_ptr<const RasterTopology> RasterScene::topologyOf(const std::shared_ptr<const Model>& model)
{
  for (const auto& variant : this->Variants)
  {
    if (variant->shared->model == model)
    {
      return variant->shared->topology;
    }
  }
  // Translucent surfaces are sorted by their numbers.
  const auto isTranslucent = [](const Instance& instance)
  {
    return std::any_of(instance.materials->begin(), instance.materials->end(),
      [](const Material& material) { return material.opacity < 1; });
  };
  const bool numbered =
    this->Numbered || std::any_of(this->State->instances.begin(), this->State->instances.end(), isTranslucent);
  return std::make_shared<const RasterTopology>(rasterTopology(*model, numbered));
}

void RasterScene::fill(Shared& shared, std::shared_ptr<const Geometry> geometry)
{
  const std::size_t count = shared.topology->source.size();
  shared.points->SetNumberOfTuples(vtkIdType(count));
  shared.normals->SetNumberOfTuples(vtkIdType(count));
  float* point = shared.points->GetPointer(0);
  float* normal = shared.normals->GetPointer(0);
  for (const std::uint32_t vertex : shared.topology->source)
  {
    const Eigen::Vector3d x = geometry->positions[vertex] - shared.origin;
    for (int c = 0; c < 3; ++c)
    {
      *point++ = float(x[c]);
      *normal++ = geometry->normals[vertex][c];
    }
  }
  shared.points->Modified();
  shared.normals->Modified();
  shared.data->Modified();
  shared.geometry = std::move(geometry);
}

void RasterScene::measure(const Shared& shared, Chunk& chunk)
{
  const auto* triangles = shared.model->triangles.data() + chunk.firstTriangle;
  chunk.boxMin.setConstant(1e300);
  chunk.boxMax.setConstant(-1e300);
  for (std::uint32_t t = 0; t < chunk.triangles; ++t)
  {
    for (const std::uint32_t corner : triangles[t])
    {
      const Eigen::Vector3d x = shared.geometry->positions[corner] - shared.origin;
      chunk.boxMin = chunk.boxMin.cwiseMin(x);
      chunk.boxMax = chunk.boxMax.cwiseMax(x);
    }
  }
}

std::unique_ptr<RasterScene::Variant> RasterScene::makeVariant(const Instance& instance)
{
  auto variant = std::make_unique<Variant>();
  variant->shared = this->sharedOf(instance);
  variant->materials = instance.materials;
  variant->used = true;
  for (const Part& part : instance.model->parts)
  {
    for (std::uint32_t done = 0; done < part.triangles; done += maxChunk)
    {
      variant->chunks.push_back(
        this->makeChunk(*variant, part, part.firstTriangle + done, std::min(maxChunk, part.triangles - done)));
    }
  }
  return variant;
}

RasterScene::Chunk RasterScene::makeChunk(
  const Variant& variant, const Part& part, std::uint32_t first, std::uint32_t count)
{
  const Model& model = *variant.shared->model;
  const Material& material = variant.materials->at(std::size_t(part.material));
  Chunk chunk;
  chunk.firstTriangle = first;
  chunk.triangles = count;
  chunk.emission = floats(material.emission);
  chunk.translucent = material.opacity < 1;
  measure(*variant.shared, chunk);
  ShaderVariant shader;
  shader.specular = !material.specular.isZero(0);
  if (material.texture >= 0 && !model.uvs.empty() && model.textures.at(std::size_t(material.texture)).image)
  {
    shader.textured = true;
    shader.cutOut = material.cutOut;
    chunk.texture = this->textureOf(model.textures[std::size_t(material.texture)].image, material.cutOut);
  }
  chunk.surface = this->Maps.parameters(model, material);
  shader.physical = material.physical && material.physical->wanted;
  shader.normalMap = chunk.surface.normalMap != 0;
  shader.bumpMap = chunk.surface.bumpMap != 0;
  shader.metallicRoughnessMap = chunk.surface.metallicRoughnessMap != 0;
  shader.emissionMap = chunk.surface.emissionMap != 0;
  shader.occlusionMap = chunk.surface.occlusionMap != 0;
  if (chunk.surface.hasMaps() && !shader.textured)
  {
    // VTK passes texture coordinates on where there is a texture.
    shader.textured = true;
    chunk.texture = this->textureOf(this->White, false);
  }
  std::vector<unsigned int> indices;
  indices.reserve(std::size_t(count) * 3);
  for (std::uint32_t t = first; t < first + count; ++t)
  {
    const auto& corners = variant.shared->topology->triangles[t];
    indices.insert(indices.end(), corners.begin(), corners.end());
  }
  chunk.property = vtkSmartPointer<vtkOpenGLProperty>::New();
  setProperty(material, *chunk.property);
  chunk.mapper = vtkSmartPointer<PartMapper>::New();
  chunk.mapper->configure(&this->Frame, shader, int(first), std::move(indices));
  chunk.mapper->SetInputData(variant.shared->data);
  return chunk;
}

vtkSmartPointer<vtkOpenGLTexture> RasterScene::textureOf(const std::shared_ptr<const Image>& image, bool cutOut)
{
  vtkSmartPointer<vtkOpenGLTexture>& texture = this->Textures[{ image, cutOut }];
  if (!texture)
  {
    texture = makeTexture(*image, cutOut);
  }
  return texture;
}

} // namespace dgtk
