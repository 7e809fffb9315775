// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFile.h"
#include "dgtkModelChecks.h"
#include "dgtkModelReader.h"
#include "dgtkTestSupport.h"

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
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

TEST(ObjMaterials, APictureIsNotTintedWhereNoColourIsSaid)
{
  const auto diffuse = [](const std::string& statements)
  {
    const auto model = readWithLibrary(
      "newmtl m\n" + statements + '\n', "mtllib a.mtl\nvt 0 0\n" + threeCorners + "usemtl m\nf 1/1 2/1 3/1\n");
    return model->materials.at(std::size_t(model->parts.at(0).material)).diffuse;
  };
  EXPECT_EQ(diffuse("map_Kd p.png"), Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(diffuse("Ka 1 1 1\nKd xyz 1 1 1\nmap_Kd p.png"), Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(diffuse("map_Kd p.png\nKd 0.6 0.6 0.6"), Eigen::Vector3d(0.6, 0.6, 0.6));
  EXPECT_EQ(diffuse("map_d p.png"), Eigen::Vector3d(0.6, 0.6, 0.6));
}

TEST(ObjMaterials, PicturesLieBesideTheirLibraryFirst)
{
  const TemporaryFolder folder;
  const auto path = [&folder](const std::string& name) { return folder.path("model/" + name); };
  const auto put = [&path](const std::string& name) { dgtk::writeFile(path(name), "P3 1 1 255 9 9 9\n"); };
  for (const char* const made : { "mats/deep", "deep", "more" })
  {
    std::filesystem::create_directories(path(made));
  }
  const std::string library = "\nmap_Kd skin.ppm\nnorm deep\\other.ppm\n";
  dgtk::writeFile(path("mats/a.mtl"), "newmtl m" + library);
  dgtk::writeFile(path("more/b.mtl"), "newmtl n" + library);
  dgtk::writeFile(path("a.obj"), "mtllib mats/a.mtl\nmtllib more\\b.mtl\nvt 0 0\n" + threeCorners +
                                   "usemtl m\nf 1/1 2/1 3/1\nusemtl n\nf 1/1 2/1 3/1\n");
  const auto found = [&path](std::size_t part, int dgtk::Material::*map)
  {
    const auto model = dgtk::readModel(path("a.obj"));
    const dgtk::Material& material = model->materials.at(std::size_t(model->parts.at(part).material));
    const std::string file = model->textures.at(std::size_t(material.*map)).path;
    return file.empty() ? file : std::filesystem::relative(file, path("")).string();
  };
  put("mats/SKIN.PPM");
  EXPECT_EQ(found(0, &dgtk::Material::texture), "mats/SKIN.PPM") << "there is no other";
  put("skin.ppm");
  put("other.ppm");
  EXPECT_EQ(found(0, &dgtk::Material::texture), "skin.ppm") << "as it is written";
  put("mats/skin.ppm");
  EXPECT_EQ(found(0, &dgtk::Material::texture), "mats/skin.ppm");
  EXPECT_EQ(found(1, &dgtk::Material::texture), "skin.ppm") << "of another library";
  EXPECT_EQ(found(0, &dgtk::Material::normalMap), "other.ppm");
  put("deep/other.ppm");
  EXPECT_EQ(found(0, &dgtk::Material::normalMap), "deep/other.ppm") << "from the model's folder, too";
  put("mats/deep/other.ppm");
  EXPECT_EQ(found(0, &dgtk::Material::normalMap), "mats/deep/other.ppm");
}

TEST(ObjMaterials, ColoursThatAreNotReadHaveAWarning)
{
  const std::string library =
    "newmtl m\nKd xyz 0.2 0.2 0.2\nKs spectral foo.rfl 1\nKa 1 1 1\nnewmtl other\nKd xyz 1 1 1\n";
  const auto model = readWithLibrary(library, "mtllib a.mtl\n" + threeCorners + "usemtl m\nf 1 2 3\n");
  EXPECT_THAT(model->warnings, testing::ElementsAre("material 'm': a colour of 'Kd xyz' is not read",
                                 "material 'm': a colour of 'Ks spectral' is not read"));
}

TEST(ObjMaterials, ColoursOfVerticesAboveWhiteHaveAWarning)
{
  const auto warnings = [](const std::string& color)
  { return readWithLibrary("", threeCorners + "v 0 0 1 " + color + "\nf 1 2 4\n")->warnings; };
  EXPECT_THAT(warnings("128 0 0"), testing::ElementsAre("colours of vertices above 1 are drawn as 1, which is white"));
  EXPECT_THAT(warnings("0 0 1.0001"), testing::IsEmpty());
}

TEST(ObjMaterials, OtherFilesAndProgramsThatAreCalledHaveAWarning)
{
  const auto warnings = [](const std::string& calls)
  { return readWithLibrary("", threeCorners + calls + "f 1 2 3\n")->warnings; };
  EXPECT_THAT(warnings("call other.obj 1\n"),
    testing::ElementsAre("1 statement that puts in what another file or program says (call, csh) is not followed"));
  EXPECT_THAT(warnings("call other.obj\ncsh -ls\n"),
    testing::ElementsAre("2 statements that put in what other files or programs say (call, csh) are not followed"));
}
