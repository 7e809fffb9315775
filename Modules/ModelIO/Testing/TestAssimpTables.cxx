// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFile.h"
#include "dgtkGltfMaker.h"
#include "dgtkModelChecks.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk::test;
using Json = nlohmann::json;

namespace
{
/// Numbers of the file are 32-bit floats.
constexpr double tableTolerance = 1e-6;

/// One triangle (1, 0, 0), (0, 1, 0), (0, 0, 1) in node 0.
GltfMaker triangle()
{
  GltfMaker maker;
  const int positions = maker.floats("VEC3", { 1, 0, 0, 0, 1, 0, 0, 0, 1 });
  maker.json["scenes"] = { { { "nodes", { 0 } } } };
  maker.json["nodes"] = { { { "mesh", 0 } } };
  maker.json["meshes"] = { { { "primitives", { { { "attributes", { { "POSITION", positions } } } } } } } };
  return maker;
}

/// An animation of a property of node 0.
void animate(GltfMaker& maker, const char* path, int times, int values, const char* how = "LINEAR")
{
  maker.json["animations"] = {
    { { "channels", { { { "sampler", 0 }, { "target", { { "node", 0 }, { "path", path } } } } } },
      { "samplers", { { { "input", times }, { "output", values }, { "interpolation", how } } } } }
  };
}

/// Index of an accessor of normalised numbers of a component type.
template <typename T>
int normalised(GltfMaker& maker, int componentType, const char* type, const std::vector<T>& values, int width)
{
  const int view = maker.view(std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
  maker.json["accessors"].push_back({ { "bufferView", view }, { "componentType", componentType }, { "type", type },
    { "count", values.size() / std::size_t(width) }, { "normalized", true } });
  return static_cast<int>(maker.json["accessors"].size()) - 1;
}

Eigen::Vector3d cornerAt(const GltfMaker& maker, double frame, std::size_t corner = 0)
{
  const auto model = readBytes("gltf", maker.gltf());
  if (!model->deformation)
  {
    ADD_FAILURE() << "nothing moves";
    return {};
  }
  std::vector<Eigen::Vector3d> positions;
  model->deformation->positionsAt(0, frame, positions);
  return positions.at(corner);
}

double displayed(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }
} // namespace

// Reflectance 0.04 of what is no metal, the colour of what is, both fading with roughness; 2 / roughness^4 - 2.
TEST(GltfTables, MetalAndRoughnessAsHighlights)
{
  struct Row
  {
    double metal, rough;
    double red, green; ///< of the highlight, linear; the base colour is (0.5, 0.25, 0)
    double shininess;
  };
  const Row table[] = { { 0, 0, 0.04, 0.04, 128 }, { 1, 0, 0.5, 0.25, 128 }, { 0.5, 0, 0.27, 0.145, 128 },
    { 1, 0.5, 0.25, 0.125, 30 }, { 0, 0.75, 0.01, 0.01, 2 / std::pow(0.75, 4) - 2 }, { 1, 1, 0, 0, 0 } };
  for (const Row& row : table)
  {
    GltfMaker maker = triangle();
    maker.json["materials"] = { { { "emissiveFactor", { 0.5, 0, 1 } },
      { "pbrMetallicRoughness", { { "baseColorFactor", { 0.5, 0.25, 0, 1 } }, { "metallicFactor", row.metal },
                                  { "roughnessFactor", row.rough } } } } };
    maker.json["meshes"][0]["primitives"][0]["material"] = 0;
    const dgtk::Material m = readBytes("gltf", maker.gltf())->materials.at(0);
    EXPECT_NEAR(m.specular[0], displayed(row.red), tableTolerance) << row.metal << ' ' << row.rough;
    EXPECT_NEAR(m.specular[1], displayed(row.green), tableTolerance) << row.metal << ' ' << row.rough;
    EXPECT_NEAR(m.shininess, row.shininess, 1e-4) << row.rough;
    EXPECT_NEAR(m.diffuse[0], displayed(0.5), tableTolerance);
    EXPECT_NEAR(m.diffuse[1], displayed(0.25), tableTolerance);
    EXPECT_NEAR(m.ambient[0], 0.2 * displayed(0.5), tableTolerance);
    EXPECT_NEAR(m.emission[0], displayed(0.5), tableTolerance);
    EXPECT_EQ(m.emission[2], 1);
    EXPECT_NEAR(m.physical->metallic, row.metal, tableTolerance);
    EXPECT_NEAR(m.physical->roughness, row.rough, tableTolerance);
    EXPECT_EQ(m.opacity, 1);
  }
}

// A turn about z whose quaternion is written in each type of component; and the largest number of each is 1.
TEST(GltfTables, ScalesOfMapsAreKeptWithinTheirLimits)
{
  const std::tuple<double, double, double, double> table[] = { { -2, -2, 0.25, 0.25 }, { 0.5, 0.5, 0, 0 },
    { 5000, 1000, 2, 1 }, { -5000, -1000, -1, 0 } };
  for (const auto& [scale, expectedScale, strength, expectedStrength] : table)
  {
    GltfMaker maker = triangle();
    maker.json["images"] = { { { "uri", "none.png" } } };
    maker.json["textures"] = { { { "source", 0 } } };
    maker.json["materials"] = { { { "normalTexture", { { "index", 0 }, { "scale", scale } } },
      { "occlusionTexture", { { "index", 0 }, { "strength", strength } } } } };
    maker.json["meshes"][0]["primitives"][0]["material"] = 0;
    const dgtk::Material m = readBytes("gltf", maker.gltf())->materials.at(0);
    EXPECT_NEAR(m.normalScale, expectedScale, tableTolerance);
    EXPECT_NEAR(m.occlusionStrength, expectedStrength, tableTolerance);
  }
}

TEST(GltfTables, NormalisedNumbersOfEveryType)
{
  const double c = std::cos(0.5), s = std::sin(0.5);
  const auto turned = [&](int componentType, auto one, double steps)
  {
    using T = decltype(one);
    GltfMaker maker = triangle();
    const int times = maker.floats("SCALAR", { 0 });
    const auto word = [&](double value) { return static_cast<T>(std::lround(value * steps)); };
    animate(maker, "rotation", times, normalised<T>(maker, componentType, "VEC4", { T(0), T(0), word(s), word(c) }, 4));
    const Eigen::Vector3d found = cornerAt(maker, 0);
    EXPECT_NEAR(found.x(), std::cos(1), 2 / steps) << componentType;
    EXPECT_NEAR(found.y(), std::sin(1), 2 / steps) << componentType;
  };
  turned(5120, std::int8_t(0), 127);
  turned(5121, std::uint8_t(0), 255);
  turned(5122, std::int16_t(0), 32767);
  turned(5123, std::uint16_t(0), 65535);
  const auto weighted = [&](int componentType, auto value)
  {
    GltfMaker maker = triangle();
    const int target = maker.floats("VEC3", { 0, 0, 8, 0, 0, 0, 0, 0, 0 });
    maker.json["meshes"][0]["primitives"][0]["targets"] = { { { "POSITION", target } } };
    const int times = maker.floats("SCALAR", { 0 });
    animate(maker, "weights", times, normalised<decltype(value)>(maker, componentType, "SCALAR", { value }, 1));
    return cornerAt(maker, 0).z() / 8;
  };
  EXPECT_EQ(weighted(5120, std::int8_t(127)), 1);
  EXPECT_EQ(weighted(5120, std::int8_t(-127)), -1);
  EXPECT_EQ(weighted(5120, std::int8_t(-128)), -1);
  EXPECT_EQ(weighted(5121, std::uint8_t(255)), 1);
  EXPECT_EQ(weighted(5121, std::uint8_t(51)), 0.2);
  EXPECT_EQ(weighted(5122, std::int16_t(32767)), 1);
  EXPECT_EQ(weighted(5122, std::int16_t(-32768)), -1);
  EXPECT_EQ(weighted(5123, std::uint16_t(65535)), 1);
  EXPECT_EQ(weighted(5123, std::uint16_t(13107)), 0.2);
  EXPECT_EQ(weighted(5126, 0.25f), 0.25);
}

// Of a node that is moved, turned and scaled at rest, one property is animated: the others stay.
TEST(GltfTables, WhatIsNotAnimatedStaysAsTheNodeHasIt)
{
  const float half = std::sqrt(0.5f);
  const auto of = [&](const char* path, const char* type, const std::vector<float>& values)
  {
    GltfMaker maker = triangle();
    maker.json["nodes"][0]["translation"] = { 1, 2, 3 };
    maker.json["nodes"][0]["rotation"] = { 0, 0, half, half }; // a quarter turn about z: x to y
    maker.json["nodes"][0]["scale"] = { 4, 5, 6 };
    const int times = maker.floats("SCALAR", { 0 });
    animate(maker, path, times, maker.floats(type, values));
    return cornerAt(maker, 0);
  };
  const auto near = [](const Eigen::Vector3d& found, const Eigen::Vector3d& expected)
  { EXPECT_LE((found - expected).norm(), 5 * tableTolerance) << found.transpose(); };
  near(of("translation", "VEC3", { 7, 8, 9 }), { 7, 8 + 4, 9 });
  near(of("scale", "VEC3", { 7, 8, 9 }), { 1, 2 + 7, 3 });
  near(of("rotation", "VEC4", { 0, 0, 0, 1 }), { 1 + 4, 2, 3 });
  near(of("rotation", "VEC4", { 0, half, 0, half }), { 1, 2, 3 - 4 }); // about y: x to -z
}

TEST(GltfTables, InterpolationsBetweenKeys)
{
  const auto at = [](const char* how, const std::vector<float>& rows, double frame)
  {
    GltfMaker maker = triangle();
    const int times = maker.floats("SCALAR", { 0, 2 });
    animate(maker, "translation", times, maker.floats("VEC3", rows), how);
    return cornerAt(maker, frame).x() - 1;
  };
  const std::vector<float> rows{ 0, 0, 0, 8, 0, 0 };
  for (const auto& [frame, linear, step] :
    { std::tuple(0.0, 0.0, 0.0), { 15.0, 2.0, 0.0 }, { 45.0, 6.0, 0.0 }, { 60.0, 8.0, 8.0 } }) // 30 frames a second
  {
    EXPECT_NEAR(at("LINEAR", rows, frame), linear, tableTolerance) << frame;
    EXPECT_NEAR(at("STEP", rows, frame), step, tableTolerance) << frame;
  }
  // In-tangent, value, out-tangent of each key: Hermite's form with tangents times the two seconds between.
  const std::vector<float> spline{ 9, 0, 0, 0, 0, 0, 1, 0, 0, 3, 0, 0, 8, 0, 0, 9, 0, 0 };
  for (const double s : { 0.25, 0.5, 0.75 })
  {
    const double expected =
      (s * s * s - 2 * s * s + s) * 2 * 1 + (3 * s * s - 2 * s * s * s) * 8 + (s * s * s - s * s) * 2 * 3;
    EXPECT_NEAR(at("CUBICSPLINE", spline, 60 * s), expected, 4 * tableTolerance) << s;
  }
}
