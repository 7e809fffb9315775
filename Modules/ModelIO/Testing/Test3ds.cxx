// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelChecks.h"
#include "dgtkModelSeeds.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

using namespace dgtk::test;
using dgtk::Model;
using testing::Contains;
using testing::HasSubstr;

namespace
{
std::string text3ds(const std::string& value) { return value + std::string(1, '\0'); }

/// A file of one object with these chunks in its mesh.
std::string meshFile(const std::string& chunks, const std::string& materials = {})
{
  return chunk3ds(0x4d4d, chunk3ds(0x3d3d, materials + chunk3ds(0x4000, text3ds("thing") + chunk3ds(0x4100, chunks))));
}

std::string vertices(const std::vector<float>& values)
{
  std::string out = u16(static_cast<unsigned>(values.size() / 3));
  for (const float v : values)
  {
    out += f32(v);
  }
  return chunk3ds(0x4110, out);
}

std::string faces3ds(const std::vector<unsigned>& indices, const std::string& more = {})
{
  std::string out = u16(static_cast<unsigned>(indices.size() / 3));
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    out += u16(indices[i]) + (i % 3 == 2 ? u16(0) : "");
  }
  return chunk3ds(0x4120, out + more);
}

const std::vector<float> roof = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, -1, 1, 1, -1 };
const std::vector<unsigned> roofFaces = { 0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2 };
} // namespace

TEST(Studio3ds, Seed)
{
  const std::shared_ptr<const Model> model = readBytes("3ds", seed3ds());
  EXPECT_EQ(model->format, "3ds");
  ASSERT_EQ(model->triangles.size(), 6u);
  EXPECT_EQ(model->declaredMaterials, 2u);
  EXPECT_EQ(model->twoSidedTriangles, 2u);
  EXPECT_EQ(model->boundsMax, Eigen::Vector3d(2, 1, 6)) << "the vertex at 2e35 is not referenced";
  EXPECT_EQ(model->sourceVertices, 9u);
  ASSERT_EQ(model->parts.size(), 3u);
  EXPECT_EQ(model->parts[0].name, "quad");
  const dgtk::Material& wall = model->materials[static_cast<std::size_t>(model->parts[0].material)];
  EXPECT_EQ(wall.name, "wall");
  EXPECT_TRUE(wall.twoSided);
  EXPECT_DOUBLE_EQ(wall.opacity, 0.75);
  EXPECT_DOUBLE_EQ(wall.diffuse[1], 128 / 255.0);
  EXPECT_DOUBLE_EQ(wall.specular[0], 0.4);
  EXPECT_DOUBLE_EQ(wall.shininess, 64);
  EXPECT_EQ(model->textures.at(0).name, "WALL.TGA");
  EXPECT_EQ(model->uvs[2], Eigen::Vector2d(1, 1));
  // faces 0 to 2 of the solid name no material, the last one names "plain"
  EXPECT_EQ(model->parts[1].triangles, 3u);
  EXPECT_EQ(model->materials[static_cast<std::size_t>(model->parts[2].material)].name, "plain");
  EXPECT_THAT(model->warnings, testing::ElementsAre(HasSubstr("texture 'WALL.TGA' not found")));
}

TEST(Studio3ds, VerticesAreDrawnAsTheyAre)
{
  std::string matrix;
  for (int i = 0; i < 12; ++i)
  {
    matrix += f32(i == 0 ? -3.0f : static_cast<float>(i));
  }
  const auto model = readBytes("3ds", meshFile(vertices(roof) + chunk3ds(0x4160, matrix) + faces3ds(roofFaces)));
  EXPECT_EQ(model->boundsMin, Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(model->boundsMax, Eigen::Vector3d(1, 1, 0));
  const auto& p = model->rest->positions;
  const auto& t = model->triangles[0];
  EXPECT_EQ((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]), Eigen::Vector3d(0, 0, 1));
}

TEST(Studio3ds, MotionHasAWarning)
{
  const std::string object =
    chunk3ds(0x3d3d, chunk3ds(0x4000, text3ds("thing") + chunk3ds(0x4100, vertices(roof) + faces3ds(roofFaces))));
  const auto track = [](std::uint16_t id, unsigned keys) { return chunk3ds(id, u16(0) + u32(0) + u32(0) + u32(keys)); };
  const auto warnings = [&](const std::string& nodes)
  { return readBytes("3ds", chunk3ds(0x4d4d, object + chunk3ds(0xb000, nodes)))->warnings; };
  const std::string still = chunk3ds(0xb002, track(0xb020, 1) + track(0xb021, 1) + track(0xb022, 1));
  EXPECT_THAT(warnings(still + chunk3ds(0xb002, chunk3ds(0xb020, u16(0)))), testing::IsEmpty());
  EXPECT_THAT(warnings(chunk3ds(0xb003, track(0xb020, 2))), testing::IsEmpty()) << "a camera";
  EXPECT_THAT(warnings(still + chunk3ds(0xb002, track(0xb020, 1) + track(0xb021, 2)) +
                       chunk3ds(0xb002, track(0xb022, 3)) + chunk3ds(0xb002, track(0xb020, 2))),
    testing::ElementsAre("3 objects move: the motion of 3DS files is not read"));
  for (const std::uint16_t id : { 0xb021, 0xb026 })
  {
    EXPECT_THAT(warnings(chunk3ds(0xb002, track(id, 2))),
      testing::ElementsAre("1 object moves: the motion of 3DS files is not read"))
      << id;
  }
}

TEST(Studio3ds, SmoothingGroups)
{
  const auto normals = [](const std::vector<unsigned long>& groups)
  {
    std::string chunk;
    for (const unsigned long g : groups)
    {
      chunk += u32(g);
    }
    return readBytes("3ds", meshFile(vertices(roof) + faces3ds(roofFaces, chunk3ds(0x4150, chunk))))->rest->normals;
  };
  EXPECT_EQ(normals({ 1, 1, 1, 1 }).size(), 6u);
  EXPECT_EQ(normals({ 1, 1, 2, 2 }).size(), 8u);
  // at vertex 2 the triangle of both groups joins with each of the other two, which do not join
  EXPECT_EQ(normals({ 1, 3, 2, 2 }).size(), 9u);
  EXPECT_EQ(normals({ 0, 0, 0, 0 }).size(), 8u) << "flat, but coplanar triangles share corners";
  const float h = std::sqrt(0.5f);
  // at vertex 1 one triangle of the first square and two of the second
  EXPECT_LT((normals({ 1, 1, 1, 1 })[1] - Eigen::Vector3f(2, 0, 1).normalized()).norm(), 1e-6f);
  EXPECT_LT((normals({ 1, 1, 1, 1 })[2] - Eigen::Vector3f(h, 0, h)).norm(), 0.4f);
}

TEST(Studio3ds, LargeFacesOfASmoothingGroupCountMore)
{
  // an upright and a flat triangle along the x axis, of areas 1 and 3
  const auto model = readBytes("3ds", meshFile(vertices({ 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, -1 }) +
                                               faces3ds({ 0, 1, 2, 1, 0, 3 }, chunk3ds(0x4150, u32(1) + u32(1)))));
  EXPECT_LT((model->rest->normals[0] - Eigen::Vector3f(0, -1, 3).normalized()).norm(), 1e-6f);
}

TEST(Studio3ds, SmoothingJoinsVerticesAtOnePlace)
{
  // the same roof with its own vertices for each square, as along a seam of the texture
  std::vector<float> split = roof;
  split.insert(split.end(), { 1, 0, 0, 1, 1, 0 });
  const std::string groups = chunk3ds(0x4150, u32(1) + u32(1) + u32(1) + u32(1));
  const auto model =
    readBytes("3ds", meshFile(vertices(split) + faces3ds({ 0, 1, 2, 0, 2, 3, 6, 4, 5, 6, 5, 7 }, groups)));
  ASSERT_EQ(model->rest->normals.size(), 8u);
  for (std::size_t a = 0; a < 8; ++a)
  {
    for (std::size_t b = 0; b < 8; ++b)
    {
      EXPECT_TRUE(
        model->rest->positions[a] != model->rest->positions[b] || model->rest->normals[a] == model->rest->normals[b]);
    }
  }
}

TEST(Studio3ds, TexturesAreScaledAndMoved)
{
  const std::string map = chunk3ds(0xa300, text3ds("T.PNG")) + chunk3ds(0xa356, f32(2)) + chunk3ds(0xa354, f32(3)) +
                          chunk3ds(0xa358, f32(0.5f)) + chunk3ds(0xa35a, f32(0.25f));
  const std::string material = chunk3ds(0xafff, chunk3ds(0xa000, text3ds("m")) + chunk3ds(0xa200, map));
  const std::string uvs = chunk3ds(0x4140, u16(3) + f32(0) + f32(0) + f32(1) + f32(0) + f32(1) + f32(1));
  const std::string use = chunk3ds(0x4130, text3ds("m") + u16(1) + u16(0));
  const auto model =
    readBytes("3ds", meshFile(vertices({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }) + uvs + faces3ds({ 0, 1, 2 }, use), material));
  EXPECT_EQ(model->uvs[0], Eigen::Vector2d(0.5, 0.25));
  EXPECT_EQ(model->uvs[2], Eigen::Vector2d(2.5, 3.25));
}

TEST(Studio3ds, AnglesOfTexturesHaveAWarning)
{
  const auto warnings = [](float angle)
  {
    const std::string map = chunk3ds(0xa300, text3ds("T.PNG")) + chunk3ds(0xa35c, f32(angle));
    const std::string material = chunk3ds(0xafff, chunk3ds(0xa000, text3ds("m")) + chunk3ds(0xa200, map));
    return readBytes("3ds", meshFile(vertices(roof) + faces3ds(roofFaces), material))->warnings;
  };
  EXPECT_THAT(warnings(30), Contains("1 texture(s) are drawn without the angle that their material says"));
  EXPECT_THAT(warnings(0), testing::Not(Contains(HasSubstr("angle"))));
}

TEST(Studio3ds, PicturesOfOtherMapsHaveAWarning)
{
  const auto warnings = [](const std::string& maps, const char* used)
  {
    const std::string material =
      chunk3ds(0xafff, chunk3ds(0xa000, text3ds("m")) + maps) + chunk3ds(0xafff, chunk3ds(0xa000, text3ds("plain")));
    const std::string use = chunk3ds(0x4130, text3ds(used) + u16(1) + u16(0));
    return readBytes("3ds", meshFile(vertices(roof) + faces3ds(roofFaces, use), material))->warnings;
  };
  const auto map = [](std::uint16_t id, const char* name = "T.PNG")
  { return chunk3ds(id, chunk3ds(0x0030, u16(50)) + chunk3ds(0xa300, text3ds(name))); };
  EXPECT_THAT(
    warnings(map(0xa230) + map(0xa220), "m"), testing::ElementsAre("pictures of bump, reflection are not drawn"));
  EXPECT_THAT(warnings(map(0xa204) + map(0xa33a) + map(0xa33c) + map(0xa33d), "m"),
    testing::ElementsAre("pictures of second texture, self-illumination, shininess, specular are not drawn"));
  EXPECT_THAT(warnings(map(0xa230), "plain"), testing::IsEmpty()) << "of a material that no face has";
  EXPECT_THAT(warnings(map(0xa230, "") + chunk3ds(0xa220, chunk3ds(0x0030, u16(50))), "m"), testing::IsEmpty());
}

TEST(Studio3ds, TexturesRepeatAreMirroredOrEnd)
{
  using dgtk::TextureWrap;
  for (const auto& [flags, wrap] : { std::pair(0, TextureWrap::Repeat), std::pair(2, TextureWrap::Mirror),
         std::pair(16, TextureWrap::Clamp), std::pair(64, TextureWrap::Repeat) })
  {
    const std::string map = chunk3ds(0xa300, text3ds("T.PNG")) + chunk3ds(0xa351, u16(std::uint16_t(flags)));
    const std::string material = chunk3ds(0xafff, chunk3ds(0xa000, text3ds("m")) + chunk3ds(0xa200, map));
    const std::string use = chunk3ds(0x4130, text3ds("m") + u16(1) + u16(0));
    const auto model =
      readBytes("3ds", meshFile(vertices({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }) + faces3ds({ 0, 1, 2 }, use), material));
    ASSERT_EQ(model->textures.size(), 1u);
    EXPECT_EQ(model->textures[0].wrap, (std::array{ wrap, wrap })) << flags;
  }
}

TEST(Studio3ds, TheFirstColourAndTheFirstMaterialOfANameAreMeant)
{
  const auto material = [](float red, float green)
  {
    const std::string colors = chunk3ds(0x0010, f32(red) + f32(green) + f32(0)) + // and the same, linear
                               chunk3ds(0x0013, f32(0.25f) + f32(0.25f) + f32(0.25f));
    return chunk3ds(0xafff, chunk3ds(0xa000, text3ds("m")) + chunk3ds(0xa020, colors));
  };
  const std::string use = chunk3ds(0x4130, text3ds("m") + u16(1) + u16(0));
  const auto model = readBytes("3ds",
    meshFile(vertices({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }) + faces3ds({ 0, 1, 2 }, use), material(1, 0) + material(0, 1)));
  ASSERT_EQ(model->parts.size(), 1u);
  EXPECT_EQ(model->materials[static_cast<std::size_t>(model->parts[0].material)].diffuse, Eigen::Vector3d(1, 0, 0));
}

TEST(Studio3ds, PercentagesAreSharesOrOfAHundred)
{
  for (const auto& [written, share] : { std::pair(1.0f, 1.0), std::pair(0.5f, 0.5), std::pair(50.0f, 0.5) })
  {
    const std::string glow = chunk3ds(0xa084, chunk3ds(0x0031, f32(written)));
    const std::string diffuse = chunk3ds(0xa020, chunk3ds(0x0010, f32(1) + f32(0.5f) + f32(0)));
    const auto model =
      readBytes("3ds", meshFile(vertices({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }) +
                                  faces3ds({ 0, 1, 2 }, chunk3ds(0x4130, text3ds("m") + u16(1) + u16(0))),
                         chunk3ds(0xafff, chunk3ds(0xa000, text3ds("m")) + diffuse + glow)));
    EXPECT_EQ(
      model->materials[static_cast<std::size_t>(model->parts[0].material)].emission, share * Eigen::Vector3d(1, 0.5, 0))
      << written;
  }
}

TEST(Studio3ds, ChunksOfMaterials)
{
  const auto of = [](const std::string& chunks)
  {
    const auto model =
      readBytes("3ds", meshFile(vertices({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }) +
                                  faces3ds({ 0, 1, 2 }, chunk3ds(0x4130, text3ds("m") + u16(1) + u16(0))),
                         chunk3ds(0xafff, chunk3ds(0xa000, text3ds("m")) + chunks)));
    return model->materials.at(static_cast<std::size_t>(model->parts.at(0).material));
  };
  const std::string real = f32(0.25f) + f32(0.5f) + f32(1);
  const std::string bytes = { '\x33', '\x66', '\xff' };
  const Eigen::Vector3d realColor(0.25, 0.5, 1), byteColor(0.2, 0.4, 1);
  for (const auto& [id, contents, color] : { std::tuple(0x0010, real, realColor), { 0x0013, real, realColor },
         { 0x0011, bytes, byteColor }, { 0x0012, bytes, byteColor } })
  {
    const std::string chunk = chunk3ds(static_cast<std::uint16_t>(id), contents);
    EXPECT_EQ(of(chunk3ds(0xa010, chunk)).ambient, color) << id;
    EXPECT_EQ(of(chunk3ds(0xa020, chunk)).diffuse, color) << id;
    EXPECT_EQ(of(chunk3ds(0xa030, chunk)).specular, color) << id;
  }
  const std::string white = chunk3ds(0xa030, chunk3ds(0x0010, f32(1) + f32(1) + f32(1)));
  const std::string quarter = chunk3ds(0x0030, u16(25));
  EXPECT_EQ(of(chunk3ds(0xa040, quarter)).shininess, 32);
  EXPECT_EQ(of(white + chunk3ds(0xa041, quarter)).specular, Eigen::Vector3d(0.25, 0.25, 0.25));
  EXPECT_EQ(of(chunk3ds(0xa050, quarter)).opacity, 0.75);
  EXPECT_EQ(of(chunk3ds(0xa020, chunk3ds(0x0010, real)) + chunk3ds(0xa084, quarter)).emission, realColor / 4);
  EXPECT_TRUE(of(chunk3ds(0xa081, "")).twoSided);
  const dgtk::Material usual = of("");
  EXPECT_FALSE(usual.twoSided);
  EXPECT_EQ(usual.opacity, 1);
  EXPECT_EQ(usual.emission, Eigen::Vector3d(0, 0, 0));
}

TEST(Studio3ds, DamageThatRealFilesHave)
{
  const auto badIndex = readBytes("3ds", meshFile(vertices(roof) + faces3ds({ 0, 1, 2, 0, 1, 99 })));
  EXPECT_EQ(badIndex->triangles.size(), 1u);
  EXPECT_THAT(badIndex->warnings, Contains(HasSubstr("1 surface left out: a vertex that does not exist")));

  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto notFinite =
    readBytes("3ds", meshFile(vertices({ 0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0 }) + faces3ds({ 0, 1, 2, 0, 1, 3 })));
  EXPECT_EQ(notFinite->triangles.size(), 1u);
  EXPECT_THAT(notFinite->warnings, Contains(HasSubstr("not a finite number")));

  std::string longer = seed3ds();
  longer.replace(2, 4, u32(longer.size() + 100));
  const auto cut = readBytes("3ds", longer);
  EXPECT_EQ(cut->triangles.size(), 6u);
  EXPECT_THAT(cut->warnings, Contains(HasSubstr("1 chunk(s) are longer")));

  EXPECT_EQ(readBytes("3ds", seed3ds() + "trailing")->triangles.size(), 6u);
  EXPECT_EQ(readBytes("3ds", chunk3ds(0x4d4d, chunk3ds(0x3d3d, "")))->triangles.size(), 0u);
  EXPECT_THAT(readBytes("3ds",
                meshFile(vertices(roof) + faces3ds({ 0, 1, 2 }, chunk3ds(0x4130, text3ds("no") + u16(1) + u16(0)))))
                ->warnings,
    Contains(HasSubstr("name a material that does not exist")));

  const auto badFace = readBytes(
    "3ds", meshFile(vertices(roof) + faces3ds({ 0, 1, 2 }, chunk3ds(0x4130, text3ds("m") + u16(2) + u16(0) + u16(99))),
             chunk3ds(0xafff, chunk3ds(0xa000, text3ds("m")))));
  EXPECT_EQ(badFace->materials.at(std::size_t(badFace->parts.at(0).material)).name, "m");
  EXPECT_THAT(badFace->warnings, Contains(HasSubstr("1 entries of materials name a face that does not exist")));
}

TEST(Studio3ds, Refusals)
{
  EXPECT_EQ(refusal("3ds", ""), "model.3ds: is empty (expected a model, found 0 bytes)");
  EXPECT_EQ(refusal("3ds", "PK\x03\x04zzzz"), "model.3ds: is not a 3DS file (expected a chunk 4D4D at its start)");
  EXPECT_THAT(refusal("3ds", chunk3ds(0x4d4d, "")), HasSubstr("no model in the file at byte 6"));
  EXPECT_THAT(refusal("3ds", chunk3ds(0x4d4d, u16(0x3d3d) + u32(2))),
    HasSubstr("bad chunk at byte 6 (expected a length of at least 6, found 2)"));
  EXPECT_THAT(
    refusal("3ds", meshFile(chunk3ds(0x4110, u16(1000) + f32(0)))), HasSubstr("vertices are cut short at byte"));
  EXPECT_THAT(
    refusal("3ds", meshFile(vertices(roof) + chunk3ds(0x4120, u16(9)))), HasSubstr("faces are cut short at byte"));
  EXPECT_THAT(refusal("3ds", chunk3ds(0x4d4d, chunk3ds(0x3d3d, chunk3ds(0x4000, "no end")))),
    HasSubstr("a name does not end in its chunk at byte"));
}
