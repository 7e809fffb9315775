// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkGltfMaker.h"
#include "dgtkModelChecks.h"
#include "dgtkTestSupport.h"
#include "dgtkTextureFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

using namespace dgtk::test;
using Json = nlohmann::json;

namespace
{
/// A 2 x 1 PNG: opaque red, and green of alpha 102 (0.4).
const unsigned char tinyPng[] = { 0x89, 0x50, 0x4e, 0x47, 0xd, 0xa, 0x1a, 0xa, 0x0, 0x0, 0x0, 0xd, 0x49, 0x48, 0x44,
  0x52, 0x0, 0x0, 0x0, 0x2, 0x0, 0x0, 0x0, 0x1, 0x8, 0x6, 0x0, 0x0, 0x0, 0xf4, 0x22, 0x7f, 0x8a, 0x0, 0x0, 0x0, 0xf,
  0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0xf8, 0xcf, 0xc0, 0xf0, 0x1f, 0x8, 0xd3, 0x0, 0x10, 0x5f, 0x3, 0x64, 0x41,
  0x7a, 0x91, 0x26, 0x0, 0x0, 0x0, 0x0, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82 };

/// A triangle with two sets of coordinates: (0, 0), (1, 0), (0, 1), v down, and (0.5, 0.25) everywhere.
GltfMaker placed(const Json& info, const Json& others = Json::object())
{
  Json material = others;
  material["name"] = "paint";
  material["pbrMetallicRoughness"]["baseColorTexture"] = info;
  GltfMaker maker = plain(material);
  const int second = maker.floats("VEC2", { 0.5, 0.25, 0.5, 0.25, 0.5, 0.25 });
  maker.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = second;
  maker.json["images"] = { { { "uri", "paint.png" } } };
  maker.json["textures"] = { { { "source", 0 } } };
  return maker;
}

Json transformed(const Json& how) { return { { "index", 0 }, { "extensions", { { "KHR_texture_transform", how } } } }; }
} // namespace

TEST(Gltf, MetalRoughnessMaterial)
{
  const auto model = readBytes("gltf",
    plain({ { "name", "m" }, { "doubleSided", true }, { "alphaMode", "BLEND" }, { "emissiveFactor", { 0, 1, 0 } },
            { "pbrMetallicRoughness",
              { { "baseColorFactor", { 1, 0.5, 0, 0.25 } }, { "metallicFactor", 0 }, { "roughnessFactor", 1 } } } })
      .gltf());
  const dgtk::Material& m = model->materials[0];
  EXPECT_NEAR(m.diffuse[1], 0.735357, 1e-6); // sRGB of 0.5
  EXPECT_EQ(m.diffuse[0], 1);
  EXPECT_EQ(m.emission, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(m.specular, Eigen::Vector3d(0, 0, 0)); // fully rough
  EXPECT_DOUBLE_EQ(m.opacity, 0.25);
  EXPECT_TRUE(m.twoSided);
  EXPECT_EQ(model->twoSidedTriangles, 1u);
}

TEST(Gltf, MaterialsAreCountedAsInTheFile)
{
  GltfMaker maker = plain({ { "name", "one" } });
  EXPECT_EQ(readBytes("gltf", maker.gltf())->declaredMaterials, 1u);
  maker.json["materials"] = { { { "name", "one" } }, { { "name", "as one" } }, { { "name", "unused" } } };
  EXPECT_EQ(readBytes("glb", maker.glb())->declaredMaterials, 3u);
  maker.json.erase("materials");
  maker.json["meshes"][0]["primitives"][0].erase("material");
  EXPECT_EQ(readBytes("gltf", maker.gltf())->declaredMaterials, 0u);
}

TEST(Gltf, MapsOfAPhysicallyBasedMaterial)
{
  const std::string png(reinterpret_cast<const char*>(tinyPng), sizeof tinyPng);
  GltfMaker maker = plain({ { "normalTexture", { { "index", 0 }, { "scale", 0.5 } } },
    { "occlusionTexture", { { "index", 1 }, { "strength", 0.25 } } }, { "emissiveTexture", { { "index", 0 } } },
    { "emissiveFactor", { 1, 1, 1 } },
    { "pbrMetallicRoughness", { { "metallicFactor", 0.75 }, { "roughnessFactor", 0.5 },
                                { "metallicRoughnessTexture", { { "index", 2 } } } } } });
  maker.json["textures"] = Json::array();
  maker.json["images"] = Json::array();
  for (int i = 0; i < 3; ++i)
  {
    maker.json["images"].push_back(
      { { "name", "picture" + std::to_string(i) }, { "mimeType", "image/png" }, { "bufferView", maker.view(png) } });
    maker.json["textures"].push_back({ { "source", i } });
  }
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("m.glb"), maker.glb());
  const auto model = dgtk::readModel(folder.path("m.glb"));
  const dgtk::Material& m = model->materials[0];
  ASSERT_TRUE(m.physical);
  EXPECT_NEAR(m.physical->metallic, 0.75, 1e-7);
  EXPECT_NEAR(m.physical->roughness, 0.5, 1e-7);
  EXPECT_FALSE(m.physical->wanted);
  EXPECT_NEAR(m.normalScale, 0.5, 1e-7);
  EXPECT_NEAR(m.occlusionStrength, 0.25, 1e-7);
  EXPECT_EQ(m.texture, -1);
  ASSERT_GE(m.normalMap, 0);
  ASSERT_GE(m.occlusionMap, 0);
  ASSERT_GE(m.metallicRoughnessMap, 0);
  EXPECT_EQ(m.emissionMap, m.normalMap);
  EXPECT_NE(m.occlusionMap, m.normalMap);
  EXPECT_NE(m.metallicRoughnessMap, m.normalMap);
  for (const int map : { m.normalMap, m.occlusionMap, m.metallicRoughnessMap })
  {
    EXPECT_TRUE(model->textures.at(static_cast<std::size_t>(map)).image) << map;
  }
}

// KHR_texture_transform: scaled, turned counter-clockwise as the picture is seen, moved; v down. Checked against what
// Blender's importer and Khronos' viewer make of it.
TEST(Gltf, TexturesLieWhereMaterialsPlaceThem)
{
  const auto corners = [](const GltfMaker& maker)
  {
    const auto model = readBytes("glb", maker.glb());
    std::vector<Eigen::Vector2d> all; // v down
    for (const std::uint32_t vertex : model->triangles.at(0))
    {
      all.emplace_back(model->uvs.at(vertex).x(), 1 - model->uvs.at(vertex).y());
    }
    return std::make_pair(all, model->warnings);
  };
  const auto expect = [&corners](const GltfMaker& maker, const std::vector<Eigen::Vector2d>& expected)
  {
    const auto [found, warnings] = corners(maker);
    for (const std::string& warning : warnings)
    {
      EXPECT_THAT(warning, testing::HasSubstr("not found"));
    }
    // the node is mirrored: so is the order of the corners
    for (const Eigen::Vector2d& uv : expected)
    {
      EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const auto& f) { return (f - uv).norm() < 1e-6; }))
        << uv.transpose();
    }
  };
  expect(placed({ { "index", 0 } }), { { 0, 0 }, { 1, 0 }, { 0, 1 } });
  expect(placed(transformed({ { "offset", { 0.25, 7.5 } } })), { { 0.25, 7.5 }, { 1.25, 7.5 }, { 0.25, 8.5 } });
  expect(placed(transformed({ { "scale", { 2, -3 } } })), { { 0, 0 }, { 2, 0 }, { 0, -3 } });
  const double quarter = 1.57079632679489661923;
  expect(placed(transformed({ { "rotation", quarter } })), { { 0, 0 }, { 0, -1 }, { 1, 0 } });
  expect(placed(transformed({ { "rotation", quarter }, { "scale", { 2, 3 } }, { "offset", { 0.5, 0.25 } } })),
    { { 0.5, 0.25 }, { 0.5, -1.75 }, { 3.5, 0.25 } });
  expect(placed({ { "index", 0 }, { "texCoord", 1 } }), { { 0.5, 0.25 } });
  expect(placed(transformed({ { "texCoord", 1 }, { "scale", { 2, 2 } } })), { { 1, 0.5 } });
  Json back = transformed({ { "texCoord", 0 }, { "scale", { 2, 2 } } });
  back["texCoord"] = 1;
  expect(placed(back), { { 0, 0 }, { 2, 0 }, { 0, 2 } });
  GltfMaker twice = placed(transformed({ { "scale", { 2, 2 } } }));
  twice.json["nodes"].push_back({ { "mesh", 0 } });
  twice.json["scenes"][0]["nodes"].push_back(2);
  expect(twice, { { 0, 0 }, { 2, 0 }, { 0, 2 } });

  const Json other = { { "emissiveTexture", { { "index", 0 } } } };
  EXPECT_THAT(corners(placed(transformed({ { "scale", { 2, 2 } } }), other)).second,
    testing::Contains("material \"paint\" has pictures in several places: all lie where the first does"));
  EXPECT_THAT(corners(placed(transformed({ { "scale", "large" } }))).second,
    testing::Contains(testing::HasSubstr("places of textures do not count: ")));
  GltfMaker alone = placed({ { "index", 0 } }, { { "normalTexture", transformed({ { "scale", { 2, 2 } } }) } });
  alone.json["materials"][0]["pbrMetallicRoughness"].erase("baseColorTexture");
  expect(alone, { { 0, 0 }, { 2, 0 }, { 0, 2 } });
  alone.json["materials"][0]["normalTexture"] = { { "index", 0 }, { "texCoord", 1 } };
  expect(alone, { { 0.5, 0.25 } });
}

TEST(Gltf, SamplersSayHowPicturesGoOn)
{
  using dgtk::TextureWrap;
  const std::string png(reinterpret_cast<const char*>(tinyPng), sizeof tinyPng);
  GltfMaker maker = plain({ { "emissiveTexture", { { "index", 1 } } }, { "occlusionTexture", { { "index", 2 } } },
    { "pbrMetallicRoughness", { { "baseColorTexture", { { "index", 0 } } } } } });
  maker.json["images"] = { { { "name", "picture" }, { "mimeType", "image/png" }, { "bufferView", maker.view(png) } },
    { { "uri", "other.png" } } };
  maker.json["samplers"] = { { { "wrapS", 33071 }, { "wrapT", 33648 } }, { { "magFilter", 9728 } } };
  maker.json["textures"] = { { { "source", 0 }, { "sampler", 0 } }, { { "source", 0 }, { "sampler", 1 } },
    { { "source", 1 }, { "sampler", 0 } } };
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("m.glb"), maker.glb());
  const auto model = dgtk::readModel(folder.path("m.glb"));
  const dgtk::Material& m = model->materials.at(0);
  const auto texture = [&model](int index) { return model->textures.at(static_cast<std::size_t>(index)); };
  EXPECT_EQ(texture(m.texture).wrap, (std::array{ TextureWrap::Clamp, TextureWrap::Mirror }));
  EXPECT_EQ(texture(m.emissionMap).wrap, (std::array{ TextureWrap::Repeat, TextureWrap::Repeat }));
  EXPECT_EQ(texture(m.occlusionMap).wrap, (std::array{ TextureWrap::Clamp, TextureWrap::Mirror }));
  ASSERT_TRUE(texture(m.texture).image);
  ASSERT_TRUE(texture(m.emissionMap).image);
  EXPECT_EQ(texture(m.emissionMap).image->rgba[0], 255);
  const std::string warning = "pictures whose magFilter is NEAREST are interpolated between their texels all the same";
  EXPECT_EQ(std::count(model->warnings.begin(), model->warnings.end(), warning), 1);
  maker.json["samplers"][1]["magFilter"] = 9729;
  EXPECT_THAT(readBytes("glb", maker.glb())->warnings, testing::Not(testing::Contains(warning)));
  maker.json["samplers"][1]["magFilter"] = 9728;
  maker.json["textures"][1]["sampler"] = 0; // nothing uses it
  EXPECT_THAT(readBytes("glb", maker.glb())->warnings, testing::Not(testing::Contains(warning)));
}

TEST(Gltf, AlphaOfAnEmbeddedPicture)
{
  const std::string png(reinterpret_cast<const char*>(tinyPng), sizeof tinyPng);
  const auto read = [&png](const Json& mode, double opacity = 1, std::uint64_t bytes = 1000)
  {
    Json material = mode;
    material["pbrMetallicRoughness"] = { { "baseColorTexture", { { "index", 0 } } },
      { "baseColorFactor", { 1, 1, 1, opacity } } };
    GltfMaker maker = plain(material);
    maker.json["images"] = { { { "name", "picture" }, { "mimeType", "image/png" },
      { "bufferView", maker.view(png) } } };
    maker.json["textures"] = { { { "source", 0 } } };
    const TemporaryFolder folder;
    dgtk::writeFile(folder.path("m.glb"), maker.glb());
    dgtk::ReadOptions options;
    options.textures = std::make_shared<dgtk::TextureStore>(bytes);
    return dgtk::readModel(folder.path("m.glb"), options);
  };
  const auto alphas = [](const dgtk::Model& model)
  {
    const dgtk::Material& m = model.materials[0];
    const auto& image = model.textures.at(static_cast<std::size_t>(m.texture)).image;
    return image ? std::pair<int, int>(image->rgba[3], image->rgba[7]) : std::pair<int, int>(-1, -1);
  };
  ASSERT_THAT(read({})->warnings, testing::IsEmpty());
  const auto opaque = read({ { "alphaMode", "OPAQUE" } });
  EXPECT_EQ(alphas(*opaque), std::pair(255, 255));
  EXPECT_FALSE(opaque->materials[0].cutOut);
  const auto mask = read({ { "alphaMode", "MASK" } });
  EXPECT_EQ(alphas(*mask), std::pair(255, 102));
  EXPECT_TRUE(mask->materials[0].cutOut);
  const auto low = read({ { "alphaMode", "MASK" }, { "alphaCutoff", 0.25 } });
  EXPECT_EQ(alphas(*low), std::pair(255, 255)); // 0.4 is above the file's cut-off: it stays
  EXPECT_FALSE(low->materials[0].cutOut);
  const auto gone = read({ { "alphaMode", "MASK" }, { "alphaCutoff", 1.5 } });
  EXPECT_EQ(alphas(*gone), std::pair(1, 0)); // as a file, 0 everywhere would be no alpha
  EXPECT_TRUE(gone->materials[0].cutOut);
  // the factor counts, too: 0.6 and 0.24; 0.4 and 0.16
  EXPECT_EQ(alphas(*read({ { "alphaMode", "MASK" } }, 0.6)), std::pair(255, 0));
  EXPECT_EQ(alphas(*read({ { "alphaMode", "MASK" }, { "alphaCutoff", 0.2 } }, 0.6)), std::pair(255, 255));
  EXPECT_EQ(alphas(*read({ { "alphaMode", "MASK" }, { "alphaCutoff", 0.2 } }, 0.4)), std::pair(255, 0));
  EXPECT_EQ(read({ { "alphaMode", "MASK" } }, 0.6)->materials[0].opacity, 1);
  // A picture that is made anew takes memory as one that is decoded: two pixels of four bytes.
  EXPECT_NO_THROW(read({ { "alphaMode", "MASK" } }, 1, 8));
  EXPECT_NO_THROW(read({ { "alphaMode", "MASK" } }, 0.6, 16));
  EXPECT_THROW(read({ { "alphaMode", "MASK" } }, 0.6, 15), dgtk::MachineError);
}

TEST(Gltf, EachCutOffHasAPictureOfItsOwn)
{
  const TemporaryFolder folder;
  const std::string png(reinterpret_cast<const char*>(tinyPng), sizeof tinyPng);
  dgtk::writeFile(folder.path("paint.png"), png);
  GltfMaker maker = placed({ { "index", 0 } }, { { "alphaMode", "MASK" }, { "alphaCutoff", 0.3 } });
  maker.json["materials"].push_back(maker.json["materials"][0]);
  maker.json["materials"][1]["alphaCutoff"] = 0.9;
  Json& primitives = maker.json["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[1]["material"] = 1;
  dgtk::writeFile(folder.path("m.glb"), maker.glb());
  const auto model = dgtk::readModel(folder.path("m.glb"));
  ASSERT_EQ(model->parts.size(), 2u);
  for (const std::size_t part : { 0, 1 })
  {
    const dgtk::Material& m = model->materials.at(std::size_t(model->parts[part].material));
    const dgtk::Texture& texture = model->textures.at(std::size_t(m.texture));
    EXPECT_EQ(int(texture.image->rgba[7]), part == 0 ? 255 : 0);
    EXPECT_TRUE(model->holds(texture)) << "it is not what the file has";
    EXPECT_EQ(m.cutOut, part == 1);
  }
  EXPECT_EQ(model->textures[0].path, folder.path("paint.png"));
}

TEST(Gltf, WhatIsBelowTheCutOffEverywhereIsGone)
{
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("paint.ppm"), "P6 1 1 255\nabc");
  const auto isGone = [&folder](double opacity, double cutOff)
  {
    GltfMaker maker = placed({ { "index", 0 } }, { { "alphaMode", "MASK" }, { "alphaCutoff", cutOff } });
    maker.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = { 1, 1, 1, opacity };
    maker.json["images"][0]["uri"] = "paint.ppm";
    dgtk::writeFile(folder.path("m.glb"), maker.glb());
    const auto model = dgtk::readModel(folder.path("m.glb"));
    const dgtk::Material& m = model->materials.at(0);
    EXPECT_EQ(int(model->textures.at(std::size_t(m.texture)).image->rgba[3]), m.cutOut ? 1 : 255);
    return m.cutOut;
  };
  EXPECT_TRUE(isGone(0.25, 0.5));
  EXPECT_TRUE(isGone(1, 1.5));
  EXPECT_FALSE(isGone(0.5, 0.25));
  EXPECT_FALSE(isGone(0.25, 0.25));
}

TEST(Gltf, MaterialsOfExtensions)
{
  const auto materialOf = [](const Json& material)
  {
    GltfMaker maker = plain(material);
    for (const auto& [name, extension] : material.at("extensions").items())
    {
      maker.json["extensionsUsed"].push_back(name);
      maker.json["extensionsRequired"].push_back(name);
    }
    maker.json["images"] = { { { "uri", "glow.png" } } };
    maker.json["textures"] = { { { "source", 0 } } };
    const auto model = readBytes("gltf", maker.gltf());
    EXPECT_THAT(model->warnings, testing::IsEmpty());
    return model->materials.at(0);
  };
  const Json surface = { { "baseColorFactor", { 1, 0.5, 0.25, 0.5 } }, { "metallicFactor", 0 } };
  const Json none = Json::object();
  const dgtk::Material unlit =
    materialOf({ { "pbrMetallicRoughness", surface }, { "extensions", { { "KHR_materials_unlit", none } } } });
  EXPECT_NEAR(unlit.emission[1], 0.7354, 1e-4) << "sRGB of 0.5";
  EXPECT_EQ(unlit.emission[0], 1);
  EXPECT_TRUE(unlit.diffuse.isZero() && unlit.ambient.isZero() && unlit.specular.isZero());
  EXPECT_FALSE(unlit.physical);
  EXPECT_EQ(
    materialOf({ { "emissiveTexture", { { "index", 0 } } }, { "extensions", { { "KHR_materials_unlit", none } } } })
      .emissionMap,
    -1);
  const dgtk::Material glossy = materialOf({ { "pbrMetallicRoughness", surface },
    { "extensions", { { "KHR_materials_pbrSpecularGlossiness",
                      { { "diffuseFactor", { 0.5, 1, 0.25, 1 } }, { "specularFactor", { 1, 0.25, 0.5 } },
                        { "glossinessFactor", 0.5 } } } } } });
  EXPECT_NEAR(glossy.diffuse[0], 0.7354, 1e-4);
  EXPECT_EQ(glossy.diffuse[1], 1);
  EXPECT_NEAR(glossy.specular[0], 0.7354, 1e-4) << "half as much at a gloss of a half";
  EXPECT_NEAR(glossy.shininess, 30, 1e-4) << "2 / 0.5^4 - 2";
  EXPECT_FALSE(glossy.physical);
}

// KHR_materials_emissive_strength, of a material that two meshes have.
TEST(Gltf, StrengthOfWhatGlows)
{
  const auto emissionOf = [](const Json& extensions)
  {
    GltfMaker maker = plain({ { "emissiveFactor", { 1, 0.5, 0 } }, { "extensions", extensions } });
    maker.json["extensionsUsed"] = maker.json["extensionsRequired"] = { "KHR_materials_emissive_strength" };
    Json& primitives = maker.json["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    const auto model = readBytes("gltf", maker.gltf());
    EXPECT_THAT(model->warnings, testing::IsEmpty());
    return model->materials.at(0).emission;
  };
  const char* name = "KHR_materials_emissive_strength";
  const Json none = Json::object();
  EXPECT_NEAR(emissionOf({ { name, none } })[1], 0.735357, 1e-6) << "sRGB of 0.5: a strength of 1 is the usual one";
  const Eigen::Vector3d four = emissionOf({ { name, { { "emissiveStrength", 4 } } } });
  EXPECT_NEAR(four[0], 1.824796, 1e-6) << "1.055 4^(1 / 2.4) - 0.055";
  EXPECT_NEAR(four[1], 1.353256, 1e-6) << "of 2";
  EXPECT_EQ(four[2], 0);
  EXPECT_NEAR(emissionOf({ { name, { { "emissiveStrength", 0.5 } } } })[0], 0.735357, 1e-6);
  EXPECT_TRUE(emissionOf({ { name, { { "emissiveStrength", 0 } } } }).isZero());
  EXPECT_EQ(emissionOf({ { name, { { "emissiveStrength", 1e30 } } } })[0], 1000);
  EXPECT_EQ(emissionOf({ { name, { { "emissiveStrength", 4 } } }, { "KHR_materials_unlit", none } })[0], 1)
    << "its colour, whatever it is that glows";
}

TEST(Gltf, TexturesThatAreNotReadHaveAWarning)
{
  GltfMaker maker = placed({ { "index", 0 } }, { { "emissiveTexture", { { "index", 1 } } } });
  maker.json["extensionsUsed"] = { "MSFT_texture_dds" };
  const Json source = { { "MSFT_texture_dds", { { "source", 0 } } } };
  const auto warningsOf = [&maker](const Json& texture)
  {
    maker.json["textures"] = { { { "source", 0 } }, texture };
    auto warnings = readBytes("gltf", maker.gltf())->warnings;
    warnings.erase(std::remove_if(warnings.begin(), warnings.end(),
                     [](const std::string& line) { return line.find("paint.png") != std::string::npos; }),
      warnings.end());
    return warnings;
  };
  EXPECT_THAT(warningsOf({ { "extensions", source } }),
    testing::ElementsAre("pictures of the glTF extension \"MSFT_texture_dds\" are not read"));
  EXPECT_THAT(warningsOf({ { "source", 0 }, { "extensions", source } }), testing::IsEmpty());
  maker.json["images"].push_back({ { "uri", "data:image/png,%89PNG%0D%0A" } });
  EXPECT_THAT(
    warningsOf({ { "source", 1 } }), testing::ElementsAre("pictures in the file that are not base64 are not read"));
}
