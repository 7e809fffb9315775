// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkGltfMaker.h"
#include "dgtkModelChecks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

using namespace dgtk::test;
using Json = nlohmann::json;

namespace
{
/// A triangle of one primitive, whose attributes are yet to be named.
GltfMaker bare()
{
  GltfMaker maker;
  maker.json["scenes"] = { { { "nodes", { 0 } } } };
  maker.json["nodes"] = { { { "mesh", 0 } } };
  maker.json["meshes"] = { { { "primitives", { { { "attributes", Json::object() }, { "material", 0 } } } } } };
  maker.json["materials"] = { { { "name", "m" } } };
  return maker;
}

Json& attributesOf(GltfMaker& maker) { return maker.json["meshes"][0]["primitives"][0]["attributes"]; }

const std::vector<float> corners{ 0, 0, 0, 1, 0, 0, 0, 1, 0 };

/// Colours of the corners, in the order of the triangle.
std::vector<std::array<std::uint8_t, 4>> colorsOf(const GltfMaker& maker)
{
  const auto model = readBytes("glb", maker.glb());
  EXPECT_THAT(model->warnings, testing::IsEmpty());
  EXPECT_EQ(brokenPromise(*model), "");
  std::vector<std::array<std::uint8_t, 4>> all;
  for (const std::uint32_t vertex : model->triangles.at(0))
  {
    all.push_back(model->colors.at(vertex));
  }
  return all;
}
} // namespace

TEST(GltfMeshes, ColoursOfVertices)
{
  using Colors = std::vector<std::array<std::uint8_t, 4>>;
  GltfMaker floats = bare();
  attributesOf(floats)["POSITION"] = floats.floats("VEC3", corners);
  attributesOf(floats)["COLOR_0"] = floats.floats("VEC3", { 1, 0, 0, 0.5f, 2, -1, 0, 0, 0.25f });
  EXPECT_EQ(colorsOf(floats), (Colors{ { 255, 0, 0, 255 }, { 188, 255, 0, 255 }, { 0, 0, 137, 255 } })) << "sRGB";

  GltfMaker bytes = bare();
  attributesOf(bytes)["POSITION"] = bytes.floats("VEC3", corners);
  attributesOf(bytes)["COLOR_0"] = bytes.bytes("VEC4", { 255, 0, 0, 51, 0, 255, 0, 102, 0, 0, 255, 255 });
  bytes.json["accessors"][std::size_t(attributesOf(bytes)["COLOR_0"])]["normalized"] = true;
  EXPECT_EQ(colorsOf(bytes), (Colors{ { 255, 0, 0, 255 }, { 0, 255, 0, 255 }, { 0, 0, 255, 255 } }));
  bytes.json["materials"][0]["alphaMode"] = "BLEND";
  EXPECT_EQ(colorsOf(bytes), (Colors{ { 255, 0, 0, 51 }, { 0, 255, 0, 102 }, { 0, 0, 255, 255 } }));

  bytes.json["extensionsUsed"] = { "KHR_materials_unlit" };
  bytes.json["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
  const auto lit = readBytes("glb", bytes.glb());
  EXPECT_EQ(lit->materials.at(0).diffuse, Eigen::Vector3d(1, 1, 1));
  EXPECT_TRUE(lit->materials[0].emission.isZero());
  EXPECT_THAT(
    lit->warnings, testing::ElementsAre("material \"m\" is lit: an unlit one would not show the colours of vertices"));

  const auto sparse = [](std::uint16_t place) // black but there
  {
    GltfMaker maker = bare();
    attributesOf(maker)["POSITION"] = maker.floats("VEC3", corners);
    const auto view = [&maker](int accessor) { return maker.json["accessors"][std::size_t(accessor)]["bufferView"]; };
    const Json values = view(maker.floats("VEC3", { 1, 1, 1 }));
    const Json places = view(maker.shorts("SCALAR", { place }));
    maker.json["accessors"].push_back({ { "componentType", 5126 }, { "type", "VEC3" }, { "count", 3 },
      { "sparse", { { "count", 1 }, { "indices", { { "bufferView", places }, { "componentType", 5123 } } },
                    { "values", { { "bufferView", values } } } } } });
    attributesOf(maker)["COLOR_0"] = maker.json["accessors"].size() - 1;
    return maker;
  };
  EXPECT_EQ(colorsOf(sparse(2)), (Colors{ { 0, 0, 0, 255 }, { 0, 0, 0, 255 }, { 255, 255, 255, 255 } }));
  GltfMaker pairs = bare();
  attributesOf(pairs)["POSITION"] = pairs.floats("VEC3", corners);
  attributesOf(pairs)["COLOR_0"] = pairs.floats("VEC2", { 1, 1, 1, 1, 1, 1 });
  EXPECT_THAT(readBytes("glb", pairs.glb())->warnings,
    testing::ElementsAre(
      "colours of vertices and places of textures do not count: an accessor is of an unexpected type"));
  EXPECT_THROW(readBytes("glb", sparse(3).glb()), dgtk::InputError);
}

namespace
{
/// A triangle whose corner `place` is said to be (1, 0, 0) by its sparse values.
GltfMaker sparse(int place, int stride)
{
  GltfMaker maker = bare();
  const int rows = maker.floats("VEC3", { 0, 0, 0, 7, 7, 7, 9, 9, 9, 7, 7, 7, 0, 1, 0, 7, 7, 7 });
  const auto viewOf = [&](int accessor) { return maker.json["accessors"][std::size_t(accessor)]["bufferView"]; };
  const Json places = viewOf(maker.shorts("SCALAR", { std::uint16_t(place) }));
  const Json values = viewOf(maker.floats("VEC3", { 1, 0, 0 }));
  Json& accessor = maker.json["accessors"][std::size_t(rows)];
  accessor["count"] = 3;
  accessor["sparse"] = { { "count", 1 }, { "indices", { { "bufferView", places }, { "componentType", 5123 } } },
    { "values", { { "bufferView", values } } } };
  maker.json["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteStride"] = stride;
  attributesOf(maker)["POSITION"] = rows;
  return maker;
}
} // namespace

TEST(GltfMeshes, SparseOverRowsWithGaps)
{
  GltfMaker maker = sparse(1, 24);
  const auto model = readBytes("glb", maker.glb());
  EXPECT_EQ(brokenPromise(*model), "");
  const auto& t = model->triangles.at(0);
  EXPECT_EQ(model->rest->positions[t[0]], Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(model->rest->positions[t[1]], Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(model->rest->positions[t[2]], Eigen::Vector3d(0, 1, 0));

  maker.json["skins"] = { { { "joints", { 1 } } } }; // without matrices: Assimp may not see it either
  maker.json["nodes"] = { { { "mesh", 0 }, { "skin", 0 } }, { { "translation", { 0, 0, 2 } } } };
  maker.json["scenes"] = { { { "nodes", { 0, 1 } } } };
  attributesOf(maker)["JOINTS_0"] = maker.bytes("VEC4", std::vector<unsigned char>(12));
  attributesOf(maker)["WEIGHTS_0"] = maker.floats("VEC4", { 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 });
  const auto cornerOf = [&]
  {
    const auto skinned = readBytes("glb", maker.glb());
    return skinned->rest->positions.at(skinned->triangles.at(0)[1]);
  };
  EXPECT_EQ(cornerOf(), Eigen::Vector3d(1, 0, 2));
  maker.json["accessors"].push_back({ { "bufferView", 99 }, { "sparse", Json::object() } }); // that nothing uses
  EXPECT_EQ(cornerOf(), Eigen::Vector3d(1, 0, 2));
  maker.json["accessors"][attributesOf(maker)["POSITION"].get<std::size_t>()].erase("sparse");
  EXPECT_EQ(cornerOf(), Eigen::Vector3d(9, 9, 11));
}

TEST(GltfMeshes, SparseValuesThatCannotBeRead)
{
  const auto refusal = [](const std::string& bytes)
  {
    try
    {
      readBytes("glb", bytes);
      return std::string("read");
    }
    catch (const std::exception& error)
    {
      return std::string(error.what());
    }
  };
  const std::string unread = "its sparse values cannot be read: ";
  EXPECT_THAT(refusal(sparse(3, 12).glb()), testing::HasSubstr("Invalid sparse accessor")); // there is no fourth one
  EXPECT_THAT(refusal(sparse(3, 24).glb()), testing::HasSubstr(unread + "an accessor changes what is not there"));
  GltfMaker named = sparse(1, 24);
  named.json["nodes"][0]["name"] = "a name";
  std::string latin = named.glb();
  latin[latin.find("a name") + 1] = '\xe9';
  EXPECT_THAT(refusal(latin), testing::HasSubstr(unread));
  GltfMaker indexed = sparse(1, 24);
  const Json ones = indexed.json["accessors"][attributesOf(indexed)["POSITION"].get<std::size_t>()]["sparse"];
  const std::size_t corner = std::size_t(indexed.shorts("SCALAR", { 0, 9, 1, 9, 2, 9 }));
  Json& indices = indexed.json["accessors"][corner];
  indices["count"] = 3;
  indices["sparse"] = { { "count", 1 }, { "indices", ones["indices"] }, { "values", ones["indices"] } };
  indexed.json["bufferViews"][indices["bufferView"].get<std::size_t>()]["byteStride"] = 4;
  indexed.json["meshes"][0]["primitives"][0]["indices"] = corner;
  EXPECT_THAT(refusal(indexed.glb()), testing::HasSubstr(unread + "they are indices"));
  GltfMaker moved = sparse(1, 24);
  Json& primitive = moved.json["meshes"][0]["primitives"][0];
  const Json good = primitive["attributes"]["POSITION"];
  Json bad = moved.json["accessors"][good.get<std::size_t>()];
  bad["sparse"]["count"] = 9;
  moved.json["accessors"].push_back(bad);
  primitive["targets"] = { { { "NORMAL", moved.json["accessors"].size() - 1 } } };
  primitive["attributes"]["NORMAL"] = moved.floats("VEC3", { 0, 0, 1, 0, 0, 1, 0, 0, 1 });
  moved.json["meshes"][0]["weights"] = { 1 };
  EXPECT_THAT(refusal(moved.glb()), testing::HasSubstr(unread));
}

TEST(GltfMeshes, NamesHaveNoOrderAndExtrasAnyType)
{
  GltfMaker maker = bare();
  attributesOf(maker)["POSITION"] = maker.floats("VEC3", corners);
  attributesOf(maker)["TEXCOORD_0"] = maker.floats("VEC2", { 0.5f, 1, 0, 1, 0, 1 });
  attributesOf(maker)["TEXCOORD_1"] = maker.floats("VEC2", { 0.25f, 1, 0, 1, 0, 1 });
  maker.json["nodes"][0]["extras"] = { { "kept", 1 } };
  const auto read = [](const char* extension, const std::string& bytes)
  {
    const auto model = readBytes(extension, bytes);
    EXPECT_THAT(model->warnings, testing::IsEmpty());
    EXPECT_EQ(model->rest->positions[model->triangles.at(0)[1]], Eigen::Vector3d(1, 0, 0));
    return model->uvs.at(model->triangles[0][0])[0];
  };
  const auto swapped = [](std::string bytes)
  {
    const std::string names[] = { "TEXCOORD_0", "TEXCOORD_1" };
    const std::size_t at[] = { bytes.find(names[0]), bytes.find(names[1]) };
    bytes.replace(at[0], names[0].size(), names[1]);
    bytes.replace(at[1], names[0].size(), names[0]);
    return bytes;
  };
  EXPECT_EQ(read("gltf", maker.gltf()), 0.5);
  EXPECT_EQ(read("gltf", swapped(maker.gltf())), 0.25);
  EXPECT_EQ(read("glb", swapped(maker.glb())), 0.25);
  for (const Json& extras : { Json(3), Json("text"), Json::array({ 1 }), Json(nullptr) })
  {
    maker.json["meshes"][0]["extras"] = extras;
    maker.json["nodes"][0]["extras"] = extras;
    maker.json["materials"][0]["extras"] = extras;
    EXPECT_EQ(read("gltf", maker.gltf()), 0.5) << extras;
    EXPECT_EQ(read("glb", swapped(maker.glb())), 0.25) << extras;
  }
}

TEST(GltfMeshes, TargetsOfOtherTypesThanTheirMesh)
{
  for (const bool stored : { false, true })
  {
    GltfMaker maker = bare();
    const int floats = maker.floats("VEC3", corners);
    const int bytes = maker.bytes("VEC4", { 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0 }); // the same
    maker.json["accessors"][std::size_t(bytes)]["type"] = "VEC3";
    maker.json["accessors"][std::size_t(bytes)]["min"] = { 0, 0, 0 };
    maker.json["accessors"][std::size_t(bytes)]["max"] = { 1, 1, 0 };
    maker.json["bufferViews"].back()["byteStride"] = 4;
    attributesOf(maker)["POSITION"] = stored ? bytes : floats;
    maker.json["meshes"][0]["primitives"][0]["targets"] = { { { "POSITION", stored ? floats : bytes } },
      { { "NORMAL", floats } } };
    maker.json["meshes"][0]["weights"] = { 0.5, 1 };
    maker.json["extensionsUsed"] = { "KHR_mesh_quantization" };
    const auto model = readBytes("glb", maker.glb());
    const auto& t = model->triangles.at(0);
    EXPECT_EQ(model->rest->positions[t[1]], Eigen::Vector3d(1.5, 0, 0)) << stored;
    EXPECT_EQ(model->rest->positions[t[2]], Eigen::Vector3d(0, 1.5, 0)) << stored;
  }
}

TEST(GltfMeshes, QuantizedAttributes)
{
  GltfMaker maker = bare();
  maker.json["extensionsRequired"] = { "KHR_mesh_quantization" };
  maker.json["extensionsUsed"] = { "KHR_mesh_quantization" };
  maker.json["nodes"][0]["scale"] = { 0.5, 0.5, 0.5 };
  const auto padded = [](const std::vector<std::uint16_t>& rows) // vertices begin at multiples of 4 bytes
  {
    std::vector<std::uint16_t> all;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      all.push_back(rows[i]);
      if (i % 3 == 2)
      {
        all.push_back(0);
      }
    }
    return all;
  };
  const auto strided = [&](const std::vector<std::uint16_t>& rows)
  {
    const int accessor = maker.shorts("VEC4", padded(rows));
    Json& made = maker.json["accessors"][std::size_t(accessor)];
    made["type"] = "VEC3";
    made["min"] = { 0, 0, 0 };
    made["max"] = { 65535, 65535, 65535 };
    maker.json["bufferViews"][made["bufferView"].get<std::size_t>()]["byteStride"] = 8;
    return accessor;
  };
  attributesOf(maker)["POSITION"] = strided({ 0, 0, 4, 8, 0, 4, 0, 6, 4 }); // as they are
  const int uvs = maker.shorts("VEC2", { 0, 0, 65535, 0, 0, 65535 });
  maker.json["accessors"][std::size_t(uvs)]["normalized"] = true;
  attributesOf(maker)["TEXCOORD_0"] = uvs;
  const int normals = maker.bytes("VEC4", { 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0 });
  Json& normal = maker.json["accessors"][std::size_t(normals)];
  normal["type"] = "VEC3";
  normal["componentType"] = 5120;
  normal["normalized"] = true;
  maker.json["bufferViews"][normal["bufferView"].get<std::size_t>()]["byteStride"] = 4;
  attributesOf(maker)["NORMAL"] = normals;
  maker.json["meshes"][0]["primitives"][0]["targets"] = { { { "POSITION", strided({ 2, 0, 0, 0, 0, 0, 0, 0, 2 }) } } };
  maker.json["meshes"][0]["weights"] = { 0.5 };
  const auto model = readBytes("glb", maker.glb());
  EXPECT_THAT(model->warnings, testing::IsEmpty());
  ASSERT_EQ(model->triangles.size(), 1u);
  const auto& t = model->triangles[0];
  const auto& at = model->rest->positions;
  EXPECT_EQ(at[t[0]], Eigen::Vector3d(0.5, 0, 2)) << "half of a target that moves it by 2";
  EXPECT_EQ(at[t[1]], Eigen::Vector3d(4, 0, 2));
  EXPECT_EQ(at[t[2]], Eigen::Vector3d(0, 3, 2.5));
  EXPECT_EQ(model->rest->normals[t[0]], Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(model->uvs[t[0]], Eigen::Vector2d(0, 1));
  EXPECT_EQ(model->uvs[t[1]], Eigen::Vector2d(1, 1));
  EXPECT_EQ(model->uvs[t[2]], Eigen::Vector2d(0, 0));
  maker.json["accessors"][std::size_t(attributesOf(maker)["NORMAL"])]["componentType"] = 1;
  EXPECT_THROW(readBytes("glb", maker.glb()), dgtk::InputError);
}

TEST(GltfMeshes, WeightsOfBytes)
{
  GltfMaker maker = bare();
  attributesOf(maker)["POSITION"] = maker.floats("VEC3", corners);
  attributesOf(maker)["JOINTS_0"] = maker.bytes("VEC4", { 0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0 });
  const int weights = maker.bytes("VEC4", { 255, 0, 0, 0, 255, 0, 0, 0, 51, 204, 0, 0 });
  maker.json["accessors"][std::size_t(weights)]["normalized"] = true;
  attributesOf(maker)["WEIGHTS_0"] = weights;
  maker.json["nodes"] = { { { "mesh", 0 }, { "skin", 0 } }, { { "name", "a" } },
    { { "name", "b" }, { "translation", { 0, 0, 10 } } } };
  maker.json["scenes"][0]["nodes"] = { 0, 1, 2 };
  const int inverse = maker.floats("MAT4", { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, // both at the origin
                                             1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 });
  maker.json["skins"] = { { { "joints", { 1, 2 } }, { "inverseBindMatrices", inverse } } };
  const auto model = readBytes("glb", maker.glb());
  EXPECT_THAT(model->warnings, testing::IsEmpty());
  const auto& t = model->triangles.at(0);
  EXPECT_EQ(model->rest->positions[t[0]], Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(model->rest->positions[t[1]], Eigen::Vector3d(1, 0, 10));
  EXPECT_NEAR(model->rest->positions[t[2]].z(), 8, 1e-6) << "four fifths of the way";
}

TEST(GltfMeshes, ARotationOfAnotherLengthThanOneDoesNotScale)
{
  GltfMaker maker = bare();
  attributesOf(maker)["POSITION"] = maker.floats("VEC3", corners);
  maker.json["nodes"][0]["rotation"] = { 0, 0, 2, 2 };
  const auto model = readBytes("glb", maker.glb());
  const auto& t = model->triangles.at(0);
  expectNear({ 0, 1, 0 }, model->rest->positions[t[1]]);
  expectNear({ -1, 0, 0 }, model->rest->positions[t[2]]);
}

TEST(GltfMeshes, ExtensionsThatAFileNeeds)
{
  GltfMaker maker = bare();
  attributesOf(maker)["POSITION"] = maker.floats("VEC3", corners);
  maker.json["extensionsRequired"] = { "KHR_texture_basisu" };
  EXPECT_THAT(readBytes("glb", maker.glb())->warnings,
    testing::ElementsAre("the glTF extension \"KHR_texture_basisu\", which the file needs, is not read"));
  maker.json["extensionsRequired"] = { "KHR_node_visibility" };
  maker.json["extensionsUsed"] = { "EXT_mesh_gpu_instancing", "KHR_node_visibility", "KHR_materials_clearcoat" };
  EXPECT_THAT(readBytes("glb", maker.glb())->warnings,
    testing::ElementsAre("the glTF extension \"KHR_node_visibility\", which the file needs, is not read",
      "the glTF extension \"EXT_mesh_gpu_instancing\", which says what is there or moves, is not read"));
  maker.json["extensionsRequired"] = { "EXT_meshopt_compression" };
  try
  {
    readBytes("glb", maker.glb());
    FAIL();
  }
  catch (const dgtk::InputError& error)
  {
    EXPECT_THAT(
      error.what(), testing::HasSubstr("needs the glTF extension EXT_meshopt_compression, which is not read"));
  }
}

TEST(GltfMeshes, TrianglesOfVerticesThatDoNotExist)
{
  for (const auto& [mode, indices, left] :
    { std::tuple(4, std::vector<std::uint8_t>{ 0, 1, 2, 0, 1, 9, 9, 1, 2, 0 }, "2 surfaces"),
      { 5, { 0, 1, 2, 9 }, "1 surface" }, { 6, { 0, 1, 2, 9 }, "1 surface" }, { 4, { 0, 1, 2, 0 }, "" } })
  {
    GltfMaker maker = bare();
    attributesOf(maker)["POSITION"] = maker.floats("VEC3", corners);
    maker.json["meshes"][0]["primitives"][0]["indices"] = maker.bytes("SCALAR", indices);
    maker.json["meshes"][0]["primitives"][0]["mode"] = mode;
    maker.json["nodes"] = { { { "mesh", 0 } }, { { "mesh", 0 } } };
    maker.json["scenes"][0]["nodes"] = { 0, 1 };
    const auto model = readBytes("glb", maker.glb());
    EXPECT_EQ(model->triangles.size(), 2u);
    const std::string warning = std::string(left) + " left out: a vertex that does not exist";
    EXPECT_THAT(model->warnings, testing::ElementsAreArray(std::vector<std::string>(*left == '\0' ? 0 : 1, warning)));
  }
}

TEST(GltfMeshes, PlacesOfNodesAreNotRounded)
{
  GltfMaker maker = bare();
  attributesOf(maker)["POSITION"] = maker.floats("VEC3", corners);
  maker.json["nodes"] = { { { "translation", { 500000.123, 4649776.456, 0 } }, { "children", { 1 } } },
    { { "matrix", { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -500000.1, -4649776.4, 0.1, 1 } }, { "mesh", 0 } } };
  const auto model = readBytes("glb", maker.glb());
  EXPECT_LT((model->boundsMin - Eigen::Vector3d(0.023, 0.056, 0.1)).norm(), 1e-8);
  // two thirds of a turn about (1, 1, 1), of what is scaled
  maker.json["nodes"] = { { { "translation", { 0.1, 0, 0 } }, { "rotation", { 0.5, 0.5, 0.5, 0.5 } },
    { "scale", { 3, 0.7, 2 } }, { "mesh", 0 } } };
  const auto turned = readBytes("glb", maker.glb());
  const auto& t = turned->triangles.at(0);
  expectNear(turned->rest->positions[t[1]], { 0.1, 3, 0 });
  expectNear(turned->rest->positions[t[2]], { 0.1, 0, 0.7 });
}

/// A library of nodes, as it may be.
TEST(GltfMeshes, WithoutScenesAllNodesAreThere)
{
  GltfMaker maker = bare();
  attributesOf(maker)["POSITION"] = maker.floats("VEC3", corners);
  maker.json["nodes"] = { { { "mesh", 0 }, { "translation", { 5, 0, 0 } } },
    { { "children", { 0 } }, { "translation", { 0, 7, 0 } } }, { { "mesh", 0 } } };
  maker.json.erase("scenes");
  for (const auto& model : { readBytes("glb", maker.glb()), readBytes("gltf", maker.gltf()) })
  {
    EXPECT_EQ(model->triangles.size(), 2u);
    EXPECT_EQ(model->boundsMax, Eigen::Vector3d(6, 8, 0));
    EXPECT_THAT(model->warnings, testing::IsEmpty());
  }
}

TEST(GltfMeshes, AlphaOfColoursOfWhatIsAMask)
{
  GltfMaker maker = bare();
  attributesOf(maker)["POSITION"] = maker.floats("VEC3", corners);
  attributesOf(maker)["COLOR_0"] = maker.floats("VEC4", { 1, 1, 1, 1, 1, 1, 1, 0.25, 1, 1, 1, 1 });
  const auto warningsOf = [&maker](const char* mode)
  {
    maker.json["materials"][0]["alphaMode"] = mode;
    return readBytes("glb", maker.glb())->warnings;
  };
  EXPECT_THAT(warningsOf("MASK"),
    testing::ElementsAre("the alpha of colours of vertices does not count where alphaMode is MASK"));
  EXPECT_THAT(warningsOf("BLEND"), testing::IsEmpty());
  EXPECT_THAT(warningsOf("OPAQUE"), testing::IsEmpty());
}

TEST(GltfMeshes, PrimitivesWithoutASurfaceAreLeftOut)
{
  GltfMaker maker = bare();
  const int places = maker.floats("VEC3", corners);
  const int two = maker.floats("VEC3", { 0, 0, 0, 1, 0, 0 });
  attributesOf(maker)["POSITION"] = places;
  struct Row
  {
    Json primitive;
    const char* surfaces; ///< that are left out
  };
  const auto indices = [&maker](const std::vector<std::uint16_t>& list) { return maker.shorts("SCALAR", list); };
  const Json own = { { "POSITION", places } };
  const Row rows[] = { { { { "attributes", { { "POSITION", two } } } }, "" },
    { { { "attributes", own }, { "indices", indices({ 0, 1 }) } }, "" },
    { { { "attributes", own }, { "indices", indices({ 0, 1, 3 }) } }, "1 surface" },
    { { { "attributes", own }, { "indices", indices({ 0, 1, 65535, 2, 0 }) }, { "mode", 5 } }, "3 surfaces" },
    { { { "attributes", own }, { "indices", indices({ 3, 0, 1, 2, 0 }) }, { "mode", 6 } }, "3 surfaces" },
    { { { "attributes", { { "NORMAL", two } } }, { "indices", indices({ 0, 1, 2 }) },
        { "targets", { { { "POSITION", two } } } } },
      "1 surface" } };
  for (const Row& row : rows)
  {
    maker.json["meshes"][0]["primitives"][1] = row.primitive;
    std::vector<std::string> expected{ "1 primitive left out: nothing to draw" };
    if (*row.surfaces != '\0')
    {
      expected.insert(expected.begin(), std::string(row.surfaces) + " left out: a vertex that does not exist");
    }
    for (const auto& [extension, bytes] : { std::pair{ "gltf", maker.gltf() }, std::pair{ "glb", maker.glb() } })
    {
      const auto model = readBytes(extension, bytes);
      EXPECT_EQ(brokenPromise(*model), "");
      EXPECT_EQ(model->triangles.size(), 1u) << row.primitive;
      EXPECT_THAT(model->warnings, testing::ElementsAreArray(expected)) << row.primitive;
    }
  }
  // one that is not as it may be leaves the others
  Json& primitives = maker.json["meshes"][0]["primitives"];
  primitives[1] = { { "attributes", own }, { "indices", maker.shorts("VEC2", { 0, 0, 1, 0, 2, 0 }) } };
  primitives[2] = { { "attributes", own }, { "indices", indices({ 0, 1 }) } };
  const auto model = readBytes("gltf", maker.gltf());
  EXPECT_EQ(model->triangles.size(), 2u);
  EXPECT_THAT(model->warnings, testing::ElementsAre("1 primitive left out: nothing to draw"));
  primitives = Json::array({ rows[5].primitive });
  EXPECT_THAT(refusal("gltf", maker.gltf()), testing::HasSubstr("has no faces"));
}
