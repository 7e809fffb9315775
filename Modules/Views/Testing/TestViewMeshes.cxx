// SPDX-License-Identifier: BSD-3-Clause
// The meshes and pictures that all views share, as VTK has them.
#include "dgtkMeshClusters.h"
#include "dgtkSyntheticScene.h"
#include "dgtkViewChecks.h"
#include "dgtkViewMeshes.h"

#include <vtkCellArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <functional>
#include <memory>
#include <vector>

namespace
{
using namespace dgtk;
using test::viewTolerance;
using V = Eigen::Vector3d;

/// `normal`: of a vertex.
template <typename Triangles>
void expectMesh(vtkPolyData* found, const std::vector<V>& positions, const Triangles& triangles,
  const std::function<Eigen::Vector3f(std::size_t)>& normal)
{
  ASSERT_EQ(found->GetNumberOfPoints(), vtkIdType(positions.size()));
  ASSERT_EQ(found->GetNumberOfPolys(), vtkIdType(triangles.size()));
  vtkIdType count = 0;
  const vtkIdType* corners = nullptr;
  found->GetPolys()->InitTraversal();
  for (std::size_t t = 0; found->GetPolys()->GetNextCell(count, corners); ++t)
  {
    ASSERT_EQ(count, 3);
    for (std::size_t k = 0; k < 3; ++k)
    {
      ASSERT_EQ(corners[k], vtkIdType(triangles[t][k]));
    }
  }
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    ASSERT_LT((V(found->GetPoint(vtkIdType(i))) - positions[i]).norm(), 1e-6);
    ASSERT_LT((V(found->GetPointData()->GetNormals()->GetTuple3(vtkIdType(i))) - normal(i).cast<double>()).norm(),
      viewTolerance);
  }
}

TEST(ViewMeshes, EveryLevelOfASphere)
{
  const auto model = test::makeSphere();
  const auto state = test::SceneBuilder().add(model).state();
  const Instance& instance = state->instances[0];
  EXPECT_EQ(ViewMeshes::pixels(0), 0);
  EXPECT_EQ(ViewMeshes::pixels(1), 56);
  EXPECT_EQ(ViewMeshes::pixels(2), 22);
  ViewMeshes meshes;
  vtkPolyData* const all = meshes.part(instance, 0);
  EXPECT_EQ(all, meshes.part(instance, 0)) << "made once";
  EXPECT_EQ(all, meshes.part(*instance.geometry, *model, 0, 0));
  const auto& normals = model->rest->normals;
  expectMesh(all, model->rest->positions, model->triangles, [&](std::size_t i) { return normals[i]; });
  const double cells[] = { 0, 14, 6 };
  for (int level = 1; level < 3; ++level)
  {
    const auto fewer = clusterPart(*instance.geometry, *model, model->parts[0], cells[level]);
    ASSERT_TRUE(fewer.has_value());
    expectMesh(meshes.part(*instance.geometry, *model, 0, level), fewer->positions, fewer->triangles,
      [&](std::size_t i) { return normals[fewer->sources[i]]; });
  }
  // A box has no fewer triangles.
  const auto box = test::SceneBuilder().add(test::makeBox()).state();
  vtkPolyData* const own = meshes.part(box->instances[0], 0);
  EXPECT_EQ(meshes.part(*box->instances[0].geometry, *box->instances[0].model, 0, 2), own);
}

TEST(ViewMeshes, PicturesAreFromBelow)
{
  ViewMeshes meshes;
  auto image = std::make_shared<Image>();
  EXPECT_EQ(meshes.picture(nullptr, false), nullptr);
  EXPECT_EQ(meshes.picture(image, false), nullptr);
  image->width = 2;
  image->height = 2;
  image->rgba = { 1, 2, 3, 255, 4, 5, 6, 255, 7, 8, 9, 255, 10, 11, 12, 200 };
  vtkImageData* const plain = meshes.picture(image, false);
  vtkImageData* const cut = meshes.picture(image, true);
  EXPECT_NE(plain, cut);
  EXPECT_EQ(meshes.picture(image, false), plain);
  ASSERT_EQ(plain->GetNumberOfScalarComponents(), 3);
  ASSERT_EQ(cut->GetNumberOfScalarComponents(), 4);
  const auto* rgb = static_cast<const unsigned char*>(plain->GetScalarPointer());
  EXPECT_EQ(std::vector<int>(rgb, rgb + 12), (std::vector<int>{ 7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6 }));
}
} // namespace
