// SPDX-License-Identifier: BSD-3-Clause
// Surfaces without texture coordinates have no pictures, whatever other surfaces of the model have.
#include "dgtkFile.h"
#include "dgtkGltfMaker.h"
#include "dgtkModelChecks.h"
#include "dgtkModelReader.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace dgtk::test;
using testing::Contains;
using testing::IsEmpty;

namespace
{
const std::string corners = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0.5 0.25\nusemtl m\n";

std::shared_ptr<const dgtk::Model> readObj(const std::string& statements, const std::string& faces)
{
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("p.ppm"), "P3 1 1 255 9 9 9\n");
  dgtk::writeFile(folder.path("a.mtl"), "newmtl m\nKd 1 0.5 0\nd 0.75\n" + statements);
  dgtk::writeFile(folder.path("a.obj"), corners + faces);
  auto model = dgtk::readModel(folder.path("a.obj"));
  EXPECT_EQ(brokenPromise(*model), "");
  return model;
}

const dgtk::Material& materialOf(const dgtk::Model& model, std::size_t part)
{
  return model.materials.at(static_cast<std::size_t>(model.parts.at(part).material));
}

void expectBare(const dgtk::Material& material)
{
  for (const auto texture : dgtk::materialTextures)
  {
    EXPECT_EQ(material.*texture, -1);
  }
  EXPECT_FALSE(material.cutOut);
}
} // namespace

TEST(UnplacedSurfaces, HaveACopyOfTheirMaterialWithoutPictures)
{
  const auto model = readObj("Pm 0.5\nmap_Kd p.ppm\nnorm p.ppm\n", "f 1 2 3\nf 2/1 4/1 3/1\nf 1 2 4\n");
  ASSERT_EQ(model->parts.size(), 2u);
  EXPECT_EQ(model->parts[0].triangles, 2u);
  const dgtk::Material& bare = materialOf(*model, 0);
  expectBare(bare);
  EXPECT_EQ(bare.name, "m");
  EXPECT_EQ(bare.diffuse, Eigen::Vector3d(1, 0.5, 0));
  EXPECT_EQ(bare.opacity, 0.75);
  EXPECT_EQ(bare.physical->metallic, 0.5);
  EXPECT_GE(materialOf(*model, 1).texture, 0);
  EXPECT_GE(materialOf(*model, 1).normalMap, 0);
  EXPECT_THAT(model->warnings,
    testing::ElementsAre("2 triangles have pictures but no texture coordinates: drawn without pictures"));
}

TEST(UnplacedSurfaces, AreNotThoseWhoseCoordinatesAreAllZero)
{
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                          "property float z\nproperty float s\nproperty float t\nelement face 1\n"
                          "property list uchar int vertex_indices\nend_header\n";
  GltfMaker gltf;
  const int positions = gltf.floats("VEC3", { 0, 0, 0, 1, 0, 0, 0, 1, 0 });
  const int below = gltf.floats("VEC2", { 0, 1, 0, 1, 0, 1 }); // its rows go down
  gltf.json["meshes"] = {
    { { "primitives", { { { "attributes", { { "POSITION", positions }, { "TEXCOORD_0", below } } } } } } }
  };
  gltf.json["nodes"] = { { { "mesh", 0 } } };
  gltf.json["scenes"] = { { { "nodes", { 0 } } } };
  const std::pair<std::string, std::string> files[] = {
    { "obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n" },
    { "ply", ply + "0 0 0 0 0\n1 0 0 0 0\n0 1 0 0 0\n3 0 1 2\n" },
    { "off", "STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 0 0\n0 1 0 0 0\n3 0 1 2\n" },
    { "pov", "mesh { triangle { <0,0,0>, <1,0,0>, <0,1,0> uv_vectors <0,0>, <0,0>, <0,0> } texture { uv_mapping "
             "pigment { rgb 1 } } }" },
    { "gltf", gltf.gltf() },
  };
  for (const auto& [extension, text] : files)
  {
    const auto model = readBytes(extension, text);
    EXPECT_THAT(model->uvs, testing::Each(Eigen::Vector2d(0, 0))) << extension;
    EXPECT_TRUE(model->hasUvs(0)) << extension;
  }
}

TEST(UnplacedSurfaces, AreToldTriangleByTriangle)
{
  const std::string faces = "f 1 2 3\nf 2/1 4/1 3/1\nf 1 2 4\n";
  const auto plain = readObj("", faces);
  EXPECT_EQ(plain->parts.size(), 1u);
  EXPECT_THAT(plain->unplaced, testing::ElementsAre(1, 0, 1));
  EXPECT_FALSE(plain->hasUvs(0));
  EXPECT_TRUE(plain->hasUvs(1));
  EXPECT_THAT(readObj("map_Kd p.ppm\n", faces)->unplaced, testing::ElementsAre(1, 1, 0)); // as the parts are
  EXPECT_THAT(readObj("", "f 1 2 3\nf 2/1 4/1 3/1\n")->unplaced, testing::ElementsAre(1, 0));
  const auto placed = readObj("", "f 2/1 4/1 3/1\n");
  EXPECT_THAT(placed->unplaced, IsEmpty());
  EXPECT_TRUE(placed->hasUvs(0));
  const auto none = readObj("", "f 1 2 3\n");
  EXPECT_THAT(none->unplaced, IsEmpty());
  EXPECT_FALSE(none->hasUvs(0));
}

TEST(UnplacedSurfaces, DoNotGlowWhereThePictureSays)
{
  const auto model = readObj("Ke 1 1 1\nmap_Ke p.ppm\n", "f 2/1 4/1 3/1\nf 1 2 3\n");
  EXPECT_EQ(materialOf(*model, 0).emission, Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(materialOf(*model, 1).emission, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(
    materialOf(*readObj("Ke 1 1 1\nmap_Kd p.ppm\n", "f 2/1 4/1 3/1\nf 1 2 3\n"), 1).emission, Eigen::Vector3d(1, 1, 1));
}

TEST(UnplacedSurfaces, HaveNoMasks)
{
  const auto model = readObj("map_d p.ppm\n", "f 2/1 4/1 3/1\nf 1 2 3\n");
  ASSERT_EQ(model->parts.size(), 2u);
  EXPECT_TRUE(materialOf(*model, 0).texture >= 0);
  expectBare(materialOf(*model, 1));
}

TEST(UnplacedSurfaces, KeepTheirMaterialWhereNoneIsPlaced)
{
  const auto alone = readObj("map_Kd p.ppm\n", "f 1 2 3\nf 2 4 3\n");
  EXPECT_EQ(alone->parts.size(), 1u);
  EXPECT_EQ(alone->materials.size(), 1u);
  EXPECT_TRUE(alone->uvs.empty());
  EXPECT_THAT(alone->warnings,
    testing::ElementsAre("2 triangles have pictures but no texture coordinates: drawn without pictures"));
  const auto plain = readObj("", "f 2/1 4/1 3/1\nf 1 2 3\n");
  EXPECT_EQ(plain->parts.size(), 1u) << "a material without pictures";
  EXPECT_EQ(plain->materials.size(), 1u);
  EXPECT_THAT(plain->warnings, IsEmpty());
  const auto some = readObj("map_Kd p.ppm\n", "f 2/1 4 3\n");
  EXPECT_GE(materialOf(*some, 0).texture, 0) << "a corner has a coordinate";
}

TEST(UnplacedSurfaces, OfGltf)
{
  GltfMaker maker;
  const int positions = maker.floats("VEC3", { 0, 0, 0, 1, 0, 0, 0, 1, 0 });
  const int uvs = maker.floats("VEC2", { 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f });
  maker.json["scenes"] = { { { "nodes", { 0 } } } };
  maker.json["nodes"] = { { { "mesh", 0 } } };
  maker.json["meshes"] = {
    { { "primitives", { { { "attributes", { { "POSITION", positions }, { "TEXCOORD_0", uvs } } }, { "material", 0 } },
                        { { "attributes", { { "POSITION", positions } } }, { "material", 0 } } } } }
  };
  maker.json["materials"] = { { { "alphaMode", "MASK" }, { "alphaCutoff", 0.25 },
    { "pbrMetallicRoughness",
      { { "baseColorFactor", { 1, 1, 1, 0.5 } }, { "baseColorTexture", { { "index", 0 } } } } } } };
  maker.json["textures"] = { { { "source", 0 } } };
  maker.json["images"] = { { { "uri", "leaves.png" } } };
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("leaves.png"), dgtk::readFile(sourceFile("Data/Textures/leaves.png")));
  dgtk::writeFile(folder.path("a.gltf"), maker.gltf());
  const auto model = dgtk::readModel(folder.path("a.gltf"));
  ASSERT_EQ(model->parts.size(), 2u);
  EXPECT_TRUE(materialOf(*model, 0).cutOut);
  expectBare(materialOf(*model, 1));
  EXPECT_EQ(materialOf(*model, 1).opacity, 1) << "MASK";
  EXPECT_THAT(model->warnings, Contains("1 triangle has pictures but no texture coordinates: drawn without pictures"));
}
