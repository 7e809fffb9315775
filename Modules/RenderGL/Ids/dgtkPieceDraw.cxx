// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPieceDraw.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderProperty.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

namespace dgtk
{
namespace
{

constexpr const char* triangleArray = "dgtkTriangle";

template <typename T>
void copy(const std::vector<T>& values, vtkDataArray* target)
{
  target->SetNumberOfTuples(vtkIdType(values.size()) / target->GetNumberOfComponents());
  std::memcpy(target->GetVoidPointer(0), values.data(), values.size() * sizeof(T));
  target->Modified();
}

vtkSmartPointer<vtkFloatArray> arrayOf(int components)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetNumberOfComponents(components);
  return array;
}

} // namespace

PieceRange pieceRange(const RasterModel& model, const RasterChunk& chunk, const Eigen::Matrix4d& view_from_local)
{
  const RasterGeometry& shared = *model.geometry;
  PieceRange range;
  range.model = shared.model.get();
  range.geometry = shared.geometry.get();
  range.first = chunk.firstTriangle;
  range.count = chunk.triangles;
  range.least = 1e300;
  range.largest = -1e300;
  double reach = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d local((corner & 1 ? chunk.boxMax : chunk.boxMin).x(),
      (corner & 2 ? chunk.boxMax : chunk.boxMin).y(), (corner & 4 ? chunk.boxMax : chunk.boxMin).z());
    const Eigen::Vector3d arm = view_from_local.topLeftCorner<3, 3>() * local;
    const double depth = -(arm.z() + view_from_local(2, 3));
    range.least = std::min(range.least, depth);
    range.largest = std::max(range.largest, depth);
    reach = std::max(reach, arm.norm());
  }
  range.extent = reach + view_from_local.topRightCorner<3, 1>().norm();
  Eigen::Matrix4d local_from_object = Eigen::Matrix4d::Identity();
  local_from_object.topRightCorner<3, 1>() = -shared.origin;
  range.view_from_object = view_from_local * local_from_object;
  return range;
}

PieceDraw::PieceDraw(vtkOpenGLRenderWindow* window, RasterFrame& frame, vtkOpenGLShaderProperty* shaders,
  const RasterModel& model, const RasterChunk& chunk)
  : Window(window)
{
  this->Data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetData(arrayOf(3));
  this->Data->SetPoints(points);
  this->Data->GetPointData()->SetNormals(arrayOf(3));
  if (!model.geometry->model->uvs.empty())
  {
    this->Data->GetPointData()->SetTCoords(arrayOf(2));
  }
  ShaderVariant variant = chunk.mapper->material();
  variant.pieces = true;
  if (variant.colored)
  {
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetNumberOfComponents(4);
    this->Data->GetPointData()->SetScalars(colors);
  }
  const auto triangles = arrayOf(1);
  triangles->SetName(triangleArray);
  this->Data->GetPointData()->AddArray(triangles);
  this->Mapper = vtkSmartPointer<PartMapper>::New();
  this->Mapper->configure(&frame, variant, 0, {});
  this->Mapper->SetInputData(this->Data);
  this->Mapper->MapDataArrayToVertexAttribute(
    triangleArray, triangleArray, vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  this->Actor = vtkSmartPointer<PartActor>::New();
  this->Actor->SetShaderProperty(shaders);
  this->Actor->ForceOpaqueOn();
  this->Actor->SetMapper(this->Mapper);
}

PieceDraw::~PieceDraw() { this->Mapper->ReleaseGraphicsResources(this->Window); }

void PieceDraw::fill(const Pieces& pieces, const RasterCamera& camera, PartActor& whole)
{
  copy(pieces.positions, this->Data->GetPoints()->GetData());
  this->Data->GetPoints()->Modified();
  copy(pieces.normals, this->Data->GetPointData()->GetNormals());
  if (this->Data->GetPointData()->GetTCoords())
  {
    copy(pieces.uvs, this->Data->GetPointData()->GetTCoords());
  }
  if (this->Data->GetPointData()->GetScalars())
  {
    copy(pieces.colors, this->Data->GetPointData()->GetScalars());
  }
  copy(pieces.triangles, this->Data->GetPointData()->GetArray(triangleArray));
  this->Data->Modified();
  std::vector<unsigned int> indices(pieces.triangles.size());
  std::iota(indices.begin(), indices.end(), 0u);
  this->Mapper->setIndices(std::move(indices));

  PartActor& actor = *this->Actor;
  actor.SetProperty(whole.GetProperty());
  actor.SetTexture(whole.GetTexture());
  actor.number = whole.number;
  actor.emission = whole.emission;
  actor.surface = whole.surface;
  actor.mirrored = whole.mirrored;
  actor.normal_view_from_object = whole.normal_view_from_object;
  const Eigen::Matrix4f clip = camera.clip_from_view.cast<float>();
  const Eigen::Matrix4f view = Eigen::Matrix4f::Identity();
  std::copy_n(clip.data(), 16, actor.clip_from_object.begin());
  std::copy_n(view.data(), 16, actor.view_from_object.begin());
  whole.runs = pieces.others;
  whole.nothing = pieces.others.empty();
}

} // namespace dgtk
