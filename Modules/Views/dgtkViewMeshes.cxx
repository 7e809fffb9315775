// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewMeshes.h"

#include "dgtkMeshClusters.h"
#include "dgtkMippedTexture.h"
#include "dgtkRasterTexture.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <vector>

namespace dgtk
{

struct ViewMeshes::Mesh
{
  std::shared_ptr<const Geometry> geometry;
  std::shared_ptr<const Model> model;
  vtkSmartPointer<vtkPoints> points;
  vtkSmartPointer<vtkFloatArray> normals;
  vtkSmartPointer<vtkFloatArray> uvs;
  std::vector<vtkSmartPointer<vtkPolyData>> parts[levels];

  vtkSmartPointer<vtkPolyData> with(vtkCellArray* triangles) const;
};

vtkSmartPointer<vtkPolyData> ViewMeshes::Mesh::with(vtkCellArray* triangles) const
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(this->points);
  data->GetPointData()->SetNormals(this->normals);
  if (this->uvs != nullptr)
  {
    data->GetPointData()->SetTCoords(this->uvs);
  }
  data->SetPolys(triangles);
  return data;
}

struct ViewMeshes::Picture
{
  std::shared_ptr<const Image> image;
  vtkSmartPointer<vtkImageData> data;
  std::shared_ptr<const SmallerPictures> smaller;
};

namespace
{
constexpr double coarsePixels[ViewMeshes::levels] = { 0, 56, 22 };
constexpr double coarseCells[ViewMeshes::levels] = { 0, 14, 6 }; // along a box's diagonal: about four pixels each

vtkSmartPointer<vtkPoints> pointsOf(const Geometry& geometry)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToFloat();
  points->SetNumberOfPoints(static_cast<vtkIdType>(geometry.positions.size()));
  for (std::size_t i = 0; i < geometry.positions.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), geometry.positions[i].data());
  }
  return points;
}

vtkSmartPointer<vtkFloatArray> normalsOf(const Geometry& geometry)
{
  auto normals = vtkSmartPointer<vtkFloatArray>::New();
  normals->SetName("normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(static_cast<vtkIdType>(geometry.normals.size()));
  for (std::size_t i = 0; i < geometry.normals.size(); ++i)
  {
    normals->SetTypedTuple(static_cast<vtkIdType>(i), geometry.normals[i].data());
  }
  return normals;
}

vtkSmartPointer<vtkFloatArray> uvsOf(const Model& model)
{
  auto uvs = vtkSmartPointer<vtkFloatArray>::New();
  uvs->SetName("uv");
  uvs->SetNumberOfComponents(2);
  uvs->SetNumberOfTuples(static_cast<vtkIdType>(model.uvs.size()));
  for (std::size_t i = 0; i < model.uvs.size(); ++i)
  {
    const float uv[2] = { static_cast<float>(model.uvs[i].x()), static_cast<float>(model.uvs[i].y()) };
    uvs->SetTypedTuple(static_cast<vtkIdType>(i), uv);
  }
  return uvs;
}

vtkSmartPointer<vtkCellArray> trianglesOf(const Model& model, const Part& part)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->AllocateExact(part.triangles, 3 * static_cast<vtkIdType>(part.triangles));
  for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangles; ++t)
  {
    const vtkIdType corners[3] = { model.triangles[t][0], model.triangles[t][1], model.triangles[t][2] };
    cells->InsertNextCell(3, corners);
  }
  return cells;
}

vtkSmartPointer<vtkPolyData> dataOf(const ClusteredPart& part, const Geometry& geometry, const Model& model)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToFloat();
  auto normals = vtkSmartPointer<vtkFloatArray>::New();
  normals->SetName("normals");
  normals->SetNumberOfComponents(3);
  auto uvs = vtkSmartPointer<vtkFloatArray>::New();
  uvs->SetName("uv");
  uvs->SetNumberOfComponents(2);
  for (std::size_t i = 0; i < part.positions.size(); ++i)
  {
    points->InsertNextPoint(part.positions[i].data());
    normals->InsertNextTypedTuple(geometry.normals[part.sources[i]].data());
    if (!model.uvs.empty())
    {
      const Eigen::Vector2f uv = model.uvs[part.sources[i]].cast<float>();
      uvs->InsertNextTypedTuple(uv.data());
    }
  }
  auto triangles = vtkSmartPointer<vtkCellArray>::New();
  for (const std::array<std::uint32_t, 3>& t : part.triangles)
  {
    const vtkIdType corners[3] = { t[0], t[1], t[2] };
    triangles->InsertNextCell(3, corners);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->GetPointData()->SetNormals(normals);
  if (!model.uvs.empty())
  {
    data->GetPointData()->SetTCoords(uvs);
  }
  data->SetPolys(triangles);
  return data;
}
} // namespace

ViewMeshes::ViewMeshes() = default;
ViewMeshes::~ViewMeshes() = default;

vtkPolyData* ViewMeshes::part(const Instance& instance, std::size_t part)
{
  std::unique_ptr<Mesh>& mesh = this->Meshes[instance.geometry.get()];
  if (mesh == nullptr)
  {
    mesh = std::make_unique<Mesh>();
    mesh->geometry = instance.geometry;
    mesh->model = instance.model;
    mesh->points = pointsOf(*instance.geometry);
    mesh->normals = normalsOf(*instance.geometry);
    if (!instance.model->uvs.empty())
    {
      mesh->uvs = uvsOf(*instance.model);
    }
    for (auto& parts : mesh->parts)
    {
      parts.resize(instance.model->parts.size());
    }
  }
  vtkSmartPointer<vtkPolyData>& data = mesh->parts[0][part];
  if (data == nullptr)
  {
    data = mesh->with(trianglesOf(*instance.model, instance.model->parts[part]));
  }
  return data;
}

double ViewMeshes::pixels(int level) { return coarsePixels[level]; }

vtkPolyData* ViewMeshes::part(const Geometry& geometry, const Model& model, std::size_t part, int level)
{
  Mesh& mesh = *this->Meshes.at(&geometry);
  vtkSmartPointer<vtkPolyData>& data = mesh.parts[level][part];
  if (data == nullptr && level > 0)
  {
    const std::optional<ClusteredPart> fewer = clusterPart(geometry, model, model.parts[part], coarseCells[level]);
    data = fewer ? dataOf(*fewer, geometry, model).Get() : this->part(geometry, model, part, level - 1);
  }
  return data;
}

vtkImageData* ViewMeshes::picture(const std::shared_ptr<const Image>& image, bool cutOut)
{
  if (image == nullptr || image->rgba.empty())
  {
    return nullptr;
  }
  std::unique_ptr<Picture>& picture = this->Pictures[{ image.get(), cutOut }];
  if (picture == nullptr)
  {
    picture = std::make_unique<Picture>();
    picture->image = image;
    picture->data = makePicture(*image, cutOut);
  }
  return picture->data;
}

vtkSmartPointer<vtkTexture> ViewMeshes::texture(const std::shared_ptr<const Image>& image, bool cutOut)
{
  vtkImageData* const data = this->picture(image, cutOut);
  if (data == nullptr)
  {
    return nullptr;
  }
  std::shared_ptr<const SmallerPictures>& smaller = this->Pictures.at({ image.get(), cutOut })->smaller;
  if (smaller == nullptr)
  {
    smaller = std::make_shared<const SmallerPictures>(smallerPictures(*data));
  }
  const auto texture = vtkSmartPointer<MippedTexture>::New();
  texture->setPicture(data, smaller);
  return texture;
}

void ViewMeshes::forgetUnused()
{
  for (auto at = this->Meshes.begin(); at != this->Meshes.end();)
  {
    const Mesh& mesh = *at->second;
    const bool used = mesh.geometry == mesh.model->rest ? mesh.model.use_count() > 1 : mesh.geometry.use_count() > 1;
    at = used ? std::next(at) : this->Meshes.erase(at);
  }
  for (auto at = this->Pictures.begin(); at != this->Pictures.end();)
  {
    at = at->second->image.use_count() > 1 ? std::next(at) : this->Pictures.erase(at);
  }
}

} // namespace dgtk
