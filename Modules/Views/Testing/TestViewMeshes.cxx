// SPDX-License-Identifier: BSD-3-Clause
// The meshes and pictures that all views share, as VTK has them.
#include "dgtkMeshClusters.h"
#include "dgtkMippedTexture.h"
#include "dgtkSyntheticScene.h"
#include "dgtkViewChecks.h"
#include "dgtkViewMeshes.h"

#include <vtkCellArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
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

/// Half as many texels along an even side are means of two; along an odd one each lies between two, by its place.
TEST(ViewMeshes, SmallerPicturesAreLinear)
{
  vtkNew<vtkImageData> picture;
  picture->SetDimensions(5, 4, 1);
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* texels = static_cast<unsigned char*>(picture->GetScalarPointer());
  for (int i = 0; i < 5 * 4 * 3; ++i)
  {
    texels[i] = static_cast<unsigned char>(i * 37 % 251);
  }
  const auto at = [&](int column, int row, int c) { return double(texels[(row * 5 + column) * 3 + c]); };
  const SmallerPictures smaller = smallerPictures(*picture);
  ASSERT_EQ(smaller.size(), 2u);
  ASSERT_EQ(smaller[0].size(), 2u * 2 * 3);
  ASSERT_EQ(smaller[1].size(), 3u);
  for (int c = 0; c < 3; ++c)
  {
    double sum = 0;
    for (int row = 0; row < 2; ++row)
    {
      for (int column = 0; column < 2; ++column)
      {
        const int first = 3 * column; // at 0.75 and 3.25 of the five
        const double weight = column == 0 ? 0.75 : 0.25;
        const auto along = [&](int y) { return (1 - weight) * at(first, y, c) + weight * at(first + 1, y, c); };
        const double expected = (along(2 * row) + along(2 * row + 1)) / 2;
        const int found = smaller[0][std::size_t((row * 2 + column) * 3 + c)];
        EXPECT_NEAR(found, expected, 0.5 + viewTolerance);
        sum += found;
      }
    }
    EXPECT_NEAR(smaller[1][std::size_t(c)], sum / 4, 0.5 + viewTolerance);
  }
}

TEST(ViewMeshes, TexturesShareAPictureWithItsMipMaps)
{
  ViewMeshes meshes;
  auto image = std::make_shared<Image>();
  EXPECT_EQ(meshes.texture(image, false), nullptr);
  image->width = image->height = 4;
  image->rgba.assign(64, 200);
  const vtkSmartPointer<vtkTexture> one = meshes.texture(image, true);
  const vtkSmartPointer<vtkTexture> other = meshes.texture(image, true);
  EXPECT_NE(one, other) << "a view has its own";
  EXPECT_EQ(one->GetInput(), meshes.picture(image, true));
  EXPECT_EQ(other->GetInput(), meshes.picture(image, true));
  EXPECT_NE(MippedTexture::SafeDownCast(one), nullptr);
}
} // namespace
