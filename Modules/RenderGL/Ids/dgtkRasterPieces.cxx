// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterScene.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <vtkFloatArray.h>
#include <vtkOpenGLProperty.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOpenGLShaderProperty.h>
#include <vtkOpenGLTexture.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace dgtk
{
namespace
{

constexpr const char* TriangleArray = "dgtkTriangle";

void copy(const std::vector<float>& values, vtkDataArray* array)
{
  auto* target = static_cast<vtkFloatArray*>(array);
  target->SetNumberOfTuples(vtkIdType(values.size()) / target->GetNumberOfComponents());
  std::memcpy(target->GetPointer(0), values.data(), values.size() * sizeof(float));
  target->Modified();
}

vtkSmartPointer<vtkFloatArray> arrayOf(int components)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetNumberOfComponents(components);
  return array;
}

} // namespace

/// Cuts the triangles of a draw that OpenGL would draw in the wrong place.
void RasterScene::cutDraw(Draw& draw, const RasterCamera& camera, const Eigen::Matrix4d& view_from_local)
{
  const Shared& shared = *draw.variant->shared;
  const Chunk& chunk = *draw.chunk;
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
  if (!mayNeedPieces(range, camera))
  {
    return;
  }
  Eigen::Matrix4d local_from_object = Eigen::Matrix4d::Identity();
  local_from_object.topRightCorner<3, 1>() = -shared.origin;
  range.view_from_object = view_from_local * local_from_object;
  makePieces(range, camera, this->Cut);
  if (!this->Cut.empty())
  {
    this->fillPieces(draw, camera);
  }
}

/// Hands the pieces in Cut to VTK.
void RasterScene::fillPieces(Draw& draw, const RasterCamera& camera)
{
  if (!draw.pieces)
  {
    draw.pieces = std::make_unique<PieceDraw>();
    PieceDraw& made = *draw.pieces;
    made.data = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> points;
    points->SetData(arrayOf(3));
    made.data->SetPoints(points);
    made.data->GetPointData()->SetNormals(arrayOf(3));
    if (!draw.variant->shared->model->uvs.empty())
    {
      made.data->GetPointData()->SetTCoords(arrayOf(2));
    }
    const auto triangles = arrayOf(1);
    triangles->SetName(TriangleArray);
    made.data->GetPointData()->AddArray(triangles);
    made.mapper = vtkSmartPointer<PartMapper>::New();
    ShaderVariant variant = draw.chunk->mapper->material();
    variant.pieces = true;
    made.mapper->configure(&this->Frame, variant, 0, {});
    made.mapper->SetInputData(made.data);
    made.mapper->MapDataArrayToVertexAttribute(
      TriangleArray, TriangleArray, vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
    made.actor = vtkSmartPointer<PartActor>::New();
    made.actor->SetShaderProperty(this->ShaderProperty);
    made.actor->ForceOpaqueOn();
    made.actor->SetMapper(made.mapper);
  }
  PieceDraw& pieces = *draw.pieces;
  copy(this->Cut.positions, pieces.data->GetPoints()->GetData());
  pieces.data->GetPoints()->Modified();
  copy(this->Cut.normals, pieces.data->GetPointData()->GetNormals());
  if (pieces.data->GetPointData()->GetTCoords())
  {
    copy(this->Cut.uvs, pieces.data->GetPointData()->GetTCoords());
  }
  copy(this->Cut.triangles, pieces.data->GetPointData()->GetArray(TriangleArray));
  pieces.data->Modified();
  std::vector<unsigned int> indices(this->Cut.triangles.size());
  std::iota(indices.begin(), indices.end(), 0u);
  pieces.mapper->setIndices(std::move(indices));

  PartActor& actor = *pieces.actor;
  actor.SetProperty(draw.chunk->property);
  actor.SetTexture(draw.chunk->texture);
  actor.number = draw.actor->number;
  actor.emission = draw.actor->emission;
  actor.surface = draw.actor->surface;
  actor.mirrored = draw.actor->mirrored;
  actor.normal_view_from_object = draw.actor->normal_view_from_object;
  const Eigen::Matrix4f clip = camera.clip_from_view.cast<float>();
  const Eigen::Matrix4f view = Eigen::Matrix4f::Identity();
  std::copy_n(clip.data(), 16, actor.clip_from_object.begin());
  std::copy_n(view.data(), 16, actor.view_from_object.begin());
  draw.cut = true;
  draw.actor->runs = this->Cut.others;
  draw.actor->nothing = this->Cut.others.empty();
}

} // namespace dgtk
