// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewMeshes.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <set>
#include <unordered_map>
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
};

namespace
{
constexpr double coarsePixels[ViewMeshes::levels] = { 0, 56, 22 };
constexpr double coarseCells[ViewMeshes::levels] = { 0, 14, 6 }; // along a box's diagonal: about four pixels each
constexpr double leastArea = 0.5;                                // of the triangles that are left
constexpr double mostLeft = 0.7;                                 // triangles; otherwise it is not worth it

double areaOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  return (b - a).cross(c - a).norm() / 2;
}

/// For each vertex the first one in its cell of a grid (Rossignac and Borrel 1993).
std::vector<std::uint32_t> clusters(const Geometry& geometry, double cells)
{
  Eigen::Vector3d low = geometry.positions.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& position : geometry.positions)
  {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  const double cell = (high - low).norm() / cells;
  std::unordered_map<std::uint32_t, std::uint32_t> first;
  std::vector<std::uint32_t> to(geometry.positions.size());
  for (std::uint32_t i = 0; i < to.size(); ++i)
  {
    const Eigen::Vector3d at = (geometry.positions[i] - low) / (cell > 0 ? cell : 1.0);
    const auto key = static_cast<std::uint32_t>(at.x()) + 64 * static_cast<std::uint32_t>(at.y()) +
                     4096 * static_cast<std::uint32_t>(at.z());
    to[i] = first.try_emplace(key, i).first->second;
  }
  return to;
}

/// Triangles between the first vertices of cells; null where they would be hardly fewer, or much would vanish.
vtkSmartPointer<vtkCellArray> clusteredTriangles(
  const Geometry& geometry, const Model& model, const Part& part, double cells)
{
  const std::vector<std::uint32_t> to = clusters(geometry, cells);
  const std::vector<Eigen::Vector3d>& p = geometry.positions;
  std::set<std::array<std::uint32_t, 3>> left;
  double before = 0;
  double after = 0;
  for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangles; ++t)
  {
    const std::array<std::uint32_t, 3>& own = model.triangles[t];
    const std::array<std::uint32_t, 3> moved{ to[own[0]], to[own[1]], to[own[2]] };
    before += areaOf(p[own[0]], p[own[1]], p[own[2]]);
    if (moved[0] != moved[1] && moved[1] != moved[2] && moved[2] != moved[0] && left.insert(moved).second)
    {
      after += areaOf(p[moved[0]], p[moved[1]], p[moved[2]]);
    }
  }
  if (after < leastArea * before || double(left.size()) > mostLeft * part.triangles)
  {
    return nullptr;
  }
  auto triangles = vtkSmartPointer<vtkCellArray>::New();
  for (const std::array<std::uint32_t, 3>& t : left)
  {
    const vtkIdType corners[3] = { t[0], t[1], t[2] };
    triangles->InsertNextCell(3, corners);
  }
  return triangles;
}

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

vtkSmartPointer<vtkImageData> dataOf(const Image& image, bool cutOut)
{
  auto data = vtkSmartPointer<vtkImageData>::New();
  const int channels = cutOut ? 4 : 3;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
  auto* to = static_cast<std::uint8_t*>(data->GetScalarPointer());
  for (int row = image.height - 1; row >= 0; --row)
  {
    const std::uint8_t* from = image.rgba.data() + 4 * std::size_t(row) * std::size_t(image.width);
    for (int column = 0; column < image.width; ++column, from += 4, to += channels)
    {
      std::memcpy(to, from, 3);
      if (cutOut)
      {
        to[3] = from[3] < 128 ? 0 : 255;
      }
    }
  }
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
    const vtkSmartPointer<vtkCellArray> cells =
      clusteredTriangles(geometry, model, model.parts[part], coarseCells[level]);
    data = cells == nullptr ? this->part(geometry, model, part, level - 1) : mesh.with(cells).Get();
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
    picture->data = dataOf(*image, cutOut);
  }
  return picture->data;
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
