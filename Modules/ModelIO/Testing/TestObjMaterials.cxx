// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFile.h"
#include "dgtkModelChecks.h"
#include "dgtkModelReader.h"
#include "dgtkTestSupport.h"

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

using namespace dgtk::test;

namespace
{
const std::string threeCorners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::shared_ptr<const dgtk::Model> readWithLibrary(const std::string& library, const std::string& text)
{
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("a.mtl"), library);
  dgtk::writeFile(folder.path("a.obj"), text);
  return dgtk::readModel(folder.path("a.obj"));
}
} // namespace

TEST(ObjMaterials, LibrariesMayStandBehindTheirUses)
{
  const auto model = readWithLibrary("newmtl red\nKd 1 0 0\n", threeCorners + "usemtl red\nf 1 2 3\nmtllib a.mtl\n");
  EXPECT_EQ(model->materials.at(std::size_t(model->parts.at(0).material)).diffuse, Eigen::Vector3d(1, 0, 0));
  EXPECT_THAT(model->warnings, testing::IsEmpty());
  EXPECT_EQ(model->companions.size(), 1u);
  EXPECT_EQ(readWithLibrary("", "mtllib a.mtl\n")->triangles.size(), 0u) << "a file of nothing else is one";
}

TEST(ObjMaterials, IlluminationModelsWithoutHighlights)
{
  const auto specular = [](const std::string& statements)
  {
    const auto model =
      readWithLibrary("newmtl m\n" + statements + '\n', "mtllib a.mtl\n" + threeCorners + "usemtl m\nf 1 2 3\n");
    return model->materials.at(std::size_t(model->parts.at(0).material)).specular[0];
  };
  EXPECT_EQ(specular("Ks 1 1 1\nNs 10\nillum 0"), 0);
  EXPECT_EQ(specular("illum 1 # diffuse\nKs 1 1 1\nNs 10"), 0);
  for (const char* const model : { "", "illum", "illum 2", "illum 3", "illum 10" })
  {
    EXPECT_EQ(specular(std::string("Ks 1 1 1\nNs 10\n") + model), 1) << model;
  }
}
