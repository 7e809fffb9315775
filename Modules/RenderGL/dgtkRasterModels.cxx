// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterModels.h"

#include "dgtkColorMap.h"
#include "dgtkPhongProperty.h"
#include "dgtkRasterTexture.h"

#include <algorithm>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOpenGLProperty.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLTexture.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

namespace dgtk
{
namespace
{

/// Colours of the vertices that are drawn, or null. A table is looked up at the vertices.
vtkSmartPointer<vtkUnsignedCharArray> colorsOf(const Model& model, const RasterTopology& topology)
{
  if (model.colors.empty() && !model.colorMap)
  {
    return nullptr;
  }
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetNumberOfComponents(4);
  colors->SetNumberOfTuples(vtkIdType(topology.source.size()));
  vtkIdType at = 0;
  for (const std::uint32_t vertex : topology.source)
  {
    colors->SetTypedTuple(at++, vertexColor(model, vertex).data());
  }
  return colors;
}

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

void fill(RasterGeometry& shared, std::shared_ptr<const Geometry> geometry)
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

void measure(const RasterGeometry& shared, RasterChunk& chunk)
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

} // namespace

RasterModels::RasterModels(vtkOpenGLRenderWindow* window, RasterFrame& frame)
  : Window(window)
  , Frame(frame)
{
  auto white = std::make_shared<Image>();
  white->width = white->height = 1;
  white->rgba.assign(4, 255);
  this->White = white;
}

RasterModels::~RasterModels()
{
  for (const auto& model : this->Models)
  {
    model->used = false;
  }
  this->drop();
  for (const auto& textures : this->Textures)
  {
    for (const auto& entry : textures)
    {
      entry.second->ReleaseGraphicsResources(this->Window);
    }
  }
}

void RasterModels::begin(const SceneState& state)
{
  // Translucent surfaces are sorted by their numbers.
  const auto isTranslucent = [](const Instance& instance)
  {
    return hasTranslucentColors(*instance.model) || std::any_of(instance.materials->begin(), instance.materials->end(),
                                                      [](const Material& material) { return material.opacity < 1; });
  };
  this->StateNumbered = this->Numbered || std::any_of(state.instances.begin(), state.instances.end(), isTranslucent);
  for (const auto& model : this->Models)
  {
    model->used = this->fits(*model) && std::any_of(state.instances.begin(), state.instances.end(),
                                          [&model](const Instance& instance) {
                                            return model->geometry->geometry == instance.geometry &&
                                                   model->materials == instance.materials;
                                          });
  }
}

void RasterModels::drop()
{
  for (const auto& made : this->Models)
  {
    if (!made->used)
    {
      for (const RasterChunk& chunk : made->chunks)
      {
        chunk.mapper->ReleaseGraphicsResources(this->Window);
      }
    }
  }
  this->Models.erase(std::remove_if(this->Models.begin(), this->Models.end(),
                       [](const std::unique_ptr<RasterModel>& made) { return !made->used; }),
    this->Models.end());
  for (auto& textures : this->Textures)
  {
    for (auto entry = textures.begin(); entry != textures.end();)
    {
      if (!entry->first.expired())
      {
        ++entry;
        continue;
      }
      entry->second->ReleaseGraphicsResources(this->Window);
      entry = textures.erase(entry);
    }
  }
  this->Maps.drop();
}

const RasterModel& RasterModels::of(const Instance& instance)
{
  for (const auto& made : this->Models)
  {
    if (this->fits(*made) && made->geometry->geometry == instance.geometry && made->geometry->model == instance.model &&
        made->materials == instance.materials)
    {
      made->used = true;
      return *made;
    }
  }
  // A deformed model takes over the buffers of an instant that is over.
  for (const auto& made : this->Models)
  {
    if (!made->used && this->fits(*made) && made->geometry.use_count() == 1 &&
        made->geometry->model == instance.model && made->materials == instance.materials)
    {
      fill(*made->geometry, instance.geometry);
      for (RasterChunk& chunk : made->chunks)
      {
        measure(*made->geometry, chunk);
      }
      made->used = true;
      return *made;
    }
  }
  this->Models.push_back(this->make(instance));
  return *this->Models.back();
}

std::shared_ptr<RasterGeometry> RasterModels::geometryOf(const Instance& instance)
{
  for (const auto& made : this->Models)
  {
    if (this->fits(*made) && made->geometry->geometry == instance.geometry && made->geometry->model == instance.model)
    {
      return made->geometry;
    }
  }
  auto shared = std::make_shared<RasterGeometry>();
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
  if (const vtkSmartPointer<vtkUnsignedCharArray> colors = colorsOf(*instance.model, *shared->topology))
  {
    shared->data->GetPointData()->SetScalars(colors);
  }
  fill(*shared, instance.geometry);
  return shared;
}

std::shared_ptr<const RasterTopology> RasterModels::topologyOf(const std::shared_ptr<const Model>& model)
{
  for (const auto& made : this->Models)
  {
    if (this->fits(*made) && made->geometry->model == model)
    {
      return made->geometry->topology;
    }
  }
  return std::make_shared<const RasterTopology>(rasterTopology(*model, this->StateNumbered));
}

std::unique_ptr<RasterModel> RasterModels::make(const Instance& instance)
{
  auto made = std::make_unique<RasterModel>();
  made->geometry = this->geometryOf(instance);
  made->materials = instance.materials;
  made->used = true;
  for (const Part& part : instance.model->parts)
  {
    for (std::uint32_t done = 0; done < part.triangles; done += mostTriangles)
    {
      made->chunks.push_back(
        this->makeChunk(*made, part, part.firstTriangle + done, std::min(mostTriangles, part.triangles - done)));
    }
  }
  return made;
}

RasterChunk RasterModels::makeChunk(const RasterModel& made, const Part& part, std::uint32_t first, std::uint32_t count)
{
  const Model& model = *made.geometry->model;
  const Material& material = made.materials->at(std::size_t(part.material));
  RasterChunk chunk;
  chunk.firstTriangle = first;
  chunk.triangles = count;
  chunk.emission = floats(material.emission);
  chunk.translucent = material.opacity < 1 || hasTranslucentColors(model);
  measure(*made.geometry, chunk);
  ShaderVariant shader;
  shader.specular = !material.specular.isZero(0);
  shader.colored = !model.colors.empty() || model.colorMap;
  if (material.texture >= 0 && !model.uvs.empty() && model.textures.at(std::size_t(material.texture)).image)
  {
    shader.textured = true;
    shader.cutOut = material.cutOut;
    shader.wraps[ShaderVariant::Base] = model.textures[std::size_t(material.texture)].wrap;
    chunk.texture = this->textureOf(model.textures[std::size_t(material.texture)].image, material.cutOut);
  }
  chunk.surface = this->Maps.parameters(model, material);
  shader.physical = material.physical && material.physical->wanted;
  shader.normalMap = chunk.surface.normalMap != 0;
  shader.bumpMap = chunk.surface.bumpMap != 0;
  shader.metallicRoughnessMap = chunk.surface.metallicRoughnessMap != 0;
  shader.emissionMap = chunk.surface.emissionMap != 0;
  if (material.emissionMap >= 0 && !shader.emissionMap)
  {
    chunk.emission = {}; // where it glows is not known
  }
  shader.occlusionMap = chunk.surface.occlusionMap != 0;
  const std::pair<ShaderVariant::Picture, int> maps[] = { { ShaderVariant::Normal, material.normalMap },
    { ShaderVariant::Bump, material.bumpMap }, { ShaderVariant::MetallicRoughness, material.metallicRoughnessMap },
    { ShaderVariant::Emission, material.emissionMap }, { ShaderVariant::Occlusion, material.occlusionMap } };
  for (const auto& [picture, index] : maps)
  {
    shader.wraps[picture] = index >= 0 ? model.textures[std::size_t(index)].wrap : shader.wraps[picture];
  }
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
    const auto& corners = made.geometry->topology->triangles[t];
    indices.insert(indices.end(), corners.begin(), corners.end());
  }
  chunk.property = vtkSmartPointer<vtkOpenGLProperty>::New();
  setProperty(material, *chunk.property);
  chunk.mapper = vtkSmartPointer<PartMapper>::New();
  chunk.mapper->configure(&this->Frame, shader, int(first), std::move(indices));
  chunk.mapper->SetInputData(made.geometry->data);
  return chunk;
}

vtkSmartPointer<vtkOpenGLTexture> RasterModels::textureOf(const std::shared_ptr<const Image>& image, bool cutOut)
{
  vtkSmartPointer<vtkOpenGLTexture>& texture = this->Textures[cutOut][image];
  if (!texture)
  {
    texture = makeTexture(*image, cutOut);
  }
  return texture;
}

} // namespace dgtk
