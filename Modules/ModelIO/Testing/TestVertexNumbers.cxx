// SPDX-License-Identifier: BSD-3-Clause
// Numbers of vertices are those of the model's file.
#include "dgtkGltfMaker.h"
#include "dgtkModelChecks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace dgtk::test;
using dgtk::Model;
using testing::ElementsAre;
using Vector = Eigen::Vector3d;

namespace
{
const Vector noTriangle(-1, -1, -1);

/// Where the file's vertices are.
std::vector<Vector> placesOf(const Model& model)
{
  EXPECT_EQ(brokenPromise(model), "");
  EXPECT_TRUE(model.isNumbered);
  std::vector<Vector> places;
  for (std::uint32_t vertex = 0; vertex < model.fileVertices(); ++vertex)
  {
    const auto split = model.splitVertexOf(vertex);
    places.push_back(split ? model.rest->positions[*split] : noTriangle);
  }
  EXPECT_FALSE(model.splitVertexOf(static_cast<std::uint32_t>(places.size())));
  return places;
}

/// The first is of no triangle, the second and the last of the others are at one place.
const std::string fiveOfObj = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv -0 0 0\n";
} // namespace

TEST(VertexNumbers, OfObjWhateverTheOrderOfItsFaces)
{
  const auto model = readBytes("obj", fiveOfObj + "f 4 5 3\n");
  EXPECT_THAT(
    placesOf(*model), ElementsAre(noTriangle, Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 0)));
  EXPECT_EQ(model->rest->positions[0], Vector(0, 1, 0)) << "triangles keep the order of their corners";
}

TEST(VertexNumbers, OfObjOfSeveralObjects)
{
  const auto model = readBytes("obj", fiveOfObj + "v 0 0 1\nv 0 0 2\nv 1e999 0 0\n"
                                                  "g a\nf 4 3 2\ng b\nf 6 5 3\nf 7 4 8\ng c\nl 2 3 4 6\n");
  EXPECT_THAT(placesOf(*model), ElementsAre(noTriangle, Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0),
                                  Vector(0, 0, 0), Vector(0, 0, 1), noTriangle, noTriangle))
    << "lines and surfaces that are left out take none away";
}

TEST(VertexNumbers, TablesStandOnlyWhereVerticesAreOne)
{
  EXPECT_TRUE(readBytes("obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 3 1 2\n")->sourceOf.empty());
  EXPECT_TRUE(readBytes("off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 2 0 1\n")->sourceOf.empty());
  EXPECT_THAT(readBytes("obj", fiveOfObj + "f 4 5 3\n")->sourceOf, ElementsAre(0, 1, 2, 3, 1));
}

TEST(VertexNumbers, OfOffWithVerticesAtOnePlace)
{
  const auto model =
    readBytes("off", "OFF\n6 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 0\n0 0 1\n1 1 1\n3 0 1 2\n3 3 1 4\n3 1 4 5\n");
  EXPECT_THAT(placesOf(*model),
    ElementsAre(Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 0), Vector(0, 0, 1), Vector(1, 1, 1)));
}

TEST(VertexNumbers, OfGltfThatMoves)
{
  GltfMaker maker;
  const int positions = maker.floats("VEC3", { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1 });
  const int indices = maker.shorts("SCALAR", { 0, 1, 2, 4, 3, 5 });
  const int times = maker.floats("SCALAR", { 0, 1 });
  const int moves = maker.floats("VEC3", { 0, 0, 0, 0, 0, 8 });
  maker.json["scenes"] = { { { "nodes", { 0, 1 } } } };
  maker.json["nodes"] = { { { "mesh", 0 } }, { { "mesh", 0 }, { "translation", { 0, 0, 4 } } } };
  maker.json["meshes"] = {
    { { "primitives", { { { "attributes", { { "POSITION", positions } } }, { "indices", indices } } } } }
  };
  maker.json["animations"] = {
    { { "channels", { { { "sampler", 0 }, { "target", { { "node", 0 }, { "path", "translation" } } } } } },
      { "samplers", { { { "input", times }, { "output", moves } } } } }
  };
  const auto model = readBytes("gltf", maker.gltf());
  ASSERT_TRUE(model->deformation);
  const Vector up(0, 0, 4);
  const Vector x(1, 0, 0);
  const Vector y(0, 1, 0);
  const Vector all(1, 1, 1);
  EXPECT_THAT(
    placesOf(*model), ElementsAre(Vector(0, 0, 0), x, y, x, y, all, up, x + up, y + up, x + up, y + up, all + up));
  const auto later = dgtk::geometryAt(*model, 0, model->animations.at(0).last);
  EXPECT_EQ(later->positions[*model->splitVertexOf(3)], Vector(1, 0, 8));
}

TEST(VertexNumbers, OfPovAreThoseOfItsLists)
{
  const std::string list = "mesh2 { vertex_vectors { 4, <9,9,9>, <0,0,0>, <1,0,0>, <0,1,0> }"
                           " face_indices { 1, <3,2,1> } }\n";
  EXPECT_THAT(
    placesOf(*readBytes("pov", list)), ElementsAre(noTriangle, Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0)));
  const std::string loose = "mesh { triangle { <0,0,0>, <1,0,0>, <0,1,0> } }\n";
  EXPECT_FALSE(readBytes("pov", loose + list)->isNumbered);
  EXPECT_FALSE(readBytes("pov", list + loose)->isNumbered);
}
