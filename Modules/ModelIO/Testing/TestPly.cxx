// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelChecks.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

using namespace dgtk::test;
using testing::HasSubstr;

namespace
{
const char* const asciiQuad = "ply\nformat ascii 1.0\ncomment made by a test\n"
                              "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                              "property float nx\nproperty float ny\nproperty float nz\n"
                              "property float s\nproperty float t\n"
                              "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                              "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                              "0 0 2 0 0 1 0 0 255 51 0\n1 0 2 0 0 1 1 0 255 51 0\n"
                              "1 1 2 0 0 1 1 1 255 51 0\n0 1 2 0 0 1 0 1 255 51 0\n4 0 1 2 3\n";

template <class T>
void put(std::string& to, T value, bool big)
{
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  if (big)
  {
    std::reverse(bytes, bytes + sizeof value);
  }
  to.append(bytes, sizeof value);
}

/// The same quad with other types, another order of properties, and an element nobody knows, on a little-endian
/// machine.
std::string binaryQuad(bool big)
{
  std::string text = std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
                     "_endian 1.0\r\nelement face 1\r\nproperty uchar flags\r\n"
                     "property list uint ushort vertex_index\r\nelement camera 1\r\nproperty list uchar short odd\r\n"
                     "element vertex 4\r\nproperty double z\r\nproperty short x\r\nproperty int8 y\r\n"
                     "property float texture_u\r\nproperty float texture_v\r\nend_header\r\n";
  put<std::uint8_t>(text, 7, big);
  put<std::uint32_t>(text, 4, big);
  for (std::uint16_t i = 0; i < 4; ++i)
  {
    put(text, i, big);
  }
  put<std::uint8_t>(text, 2, big);
  put<std::int16_t>(text, 5, big);
  put<std::int16_t>(text, -5, big);
  const std::int16_t corners[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
  for (const auto& corner : corners)
  {
    put<double>(text, 2, big);
    put<std::int16_t>(text, corner[0], big);
    put<std::int8_t>(text, static_cast<std::int8_t>(corner[1]), big);
    put<float>(text, corner[0], big);
    put<float>(text, corner[1], big);
  }
  return text;
}

void expectQuad(const dgtk::Model& model)
{
  EXPECT_EQ(brokenPromise(model), "");
  ASSERT_EQ(model.triangles.size(), 2u);
  EXPECT_EQ(model.sourceVertices, 4u);
  EXPECT_EQ(model.boundsMin, Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(model.boundsMax, Eigen::Vector3d(1, 1, 2));
  ASSERT_EQ(model.uvs.size(), model.rest->positions.size());
  for (std::size_t i = 0; i < model.uvs.size(); ++i)
  {
    EXPECT_EQ(model.uvs[i], Eigen::Vector2d(model.rest->positions[i].head<2>()));
    EXPECT_EQ(model.rest->normals[i], Eigen::Vector3f(0, 0, 1));
  }
}

std::string changed(std::string text, const std::string& from, const std::string& to)
{
  const std::size_t at = text.find(from);
  return at == std::string::npos ? "" : text.replace(at, from.size(), to);
}
} // namespace

TEST(Ply, AsciiWithNormalsUvsAndOneColour)
{
  const auto model = readBytes("ply", asciiQuad);
  expectQuad(*model);
  EXPECT_EQ(model->materials[0].diffuse, Eigen::Vector3d(1, 0.2, 0));
  EXPECT_LT((model->materials[0].ambient - Eigen::Vector3d(0.2, 0.04, 0)).norm(), 1e-15);
  EXPECT_TRUE(model->warnings.empty());
}

TEST(Ply, BinaryOfBothByteOrdersWithFacesFirst)
{
  expectQuad(*readBytes("ply", binaryQuad(false)));
  expectQuad(*readBytes("ply", binaryQuad(true)));
}

namespace
{
/// Three vertices (0, 0, 0), (100, 0, 0), (0, 100, 0) whose coordinates have a type, and lists of it as well.
template <class T>
void expectType(const std::vector<const char*>& names)
{
  for (const char* name : names)
  {
    for (const bool big : { false, true })
    {
      std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                          "_endian 1.0\nelement vertex 3\nproperty " + name + " x\nproperty " + name +
                          " y\nproperty uchar z\nelement face 1\nproperty list uchar " + name +
                          " vertex_indices\nend_header\n";
      for (const int corner : { 0, 1, 2 })
      {
        put<T>(bytes, T(corner == 1 ? 100 : 0), big);
        put<T>(bytes, T(corner == 2 ? 100 : 0), big);
        put<std::uint8_t>(bytes, 0, big);
      }
      put<std::uint8_t>(bytes, 3, big);
      for (const int corner : { 0, 1, 2 })
      {
        put<T>(bytes, T(corner), big);
      }
      const auto model = readBytes("ply", bytes);
      ASSERT_EQ(model->triangles.size(), 1u) << name << big;
      EXPECT_EQ(model->boundsMax, Eigen::Vector3d(100, 100, 0)) << name << big;
      EXPECT_EQ(model->boundsMin, Eigen::Vector3d(0, 0, 0)) << name << big;
    }
  }
}
} // namespace

TEST(Ply, NumbersOfEveryTypeAndByteOrder)
{
  expectType<std::int8_t>({ "char", "int8" });
  expectType<std::uint8_t>({ "uchar", "uint8" });
  expectType<std::int16_t>({ "short", "int16" });
  expectType<std::uint16_t>({ "ushort", "uint16" });
  expectType<std::int32_t>({ "int", "int32" });
  expectType<std::uint32_t>({ "uint", "uint32" });
  expectType<float>({ "float", "float32" });
  expectType<double>({ "double", "float64" });
  EXPECT_THAT(refusal("ply", changed(asciiQuad, "property float x", "property half x")), HasSubstr("unknown type"));
}

TEST(Ply, NamesOfPropertiesInManyDialects)
{
  const std::vector<std::vector<const char*>> uvs{ { "s", "t" }, { "u", "v" }, { "texture_u", "texture_v" },
    { "texture_s", "texture_t" } };
  for (const auto& names : uvs)
  {
    const std::string text = changed(asciiQuad, "property float s\nproperty float t\n",
      std::string("property float ") + names[0] + "\nproperty float " + names[1] + '\n');
    expectQuad(*readBytes("ply", text));
  }
  const std::vector<std::vector<const char*>> colors{ { "r", "g", "b" },
    { "diffuse_red", "diffuse_green", "diffuse_blue" } };
  for (const auto& names : colors)
  {
    std::string text = changed(asciiQuad, "uchar red", std::string("uchar ") + names[0]);
    text = changed(text, "uchar green", std::string("uchar ") + names[1]);
    text = changed(text, "uchar blue", std::string("uchar ") + names[2]);
    EXPECT_EQ(readBytes("ply", text)->materials[0].diffuse, Eigen::Vector3d(1, 0.2, 0)) << names[0];
  }
}

using Colors = std::vector<std::array<std::uint8_t, 4>>;

TEST(Ply, ColoursThatVaryAreOfTheVertices)
{
  const auto model = readBytes("ply", changed(asciiQuad, "1 0 255 51 0", "1 0 0 51 0"));
  EXPECT_THAT(model->warnings, testing::IsEmpty());
  EXPECT_EQ(model->materials[0].diffuse, Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(
    model->colors, Colors({ { 255, 51, 0, 255 }, { 0, 51, 0, 255 }, { 255, 51, 0, 255 }, { 255, 51, 0, 255 } }));
  EXPECT_TRUE(readBytes("ply", asciiQuad)->colors.empty()) << "one colour is the material's";
}

TEST(Ply, ColoursMayBeTranslucent)
{
  for (const char* name : { "alpha", "diffuse_alpha", "a" })
  {
    std::string text = changed(asciiQuad, "uchar blue", std::string("uchar blue\nproperty uchar ") + name);
    for (const char* row : { "0 0 255 51 0", "1 0 255 51 0", "1 1 255 51 0", "0 1 255 51 0" })
    {
      text = changed(text, row, std::string(row) + " 128");
    }
    EXPECT_EQ(readBytes("ply", text)->colors, Colors(4, { 255, 51, 0, 128 })) << name;
  }
}

TEST(Ply, TheFirstVertexMayHaveAColourOfItsOwn)
{
  const auto model = readBytes("ply", changed(asciiQuad, "1 0 0 255 51 0", "1 0 0 0 51 0"));
  ASSERT_EQ(model->colors.size(), 4u);
  EXPECT_EQ(model->colors.front(), (std::array<std::uint8_t, 4>{ 0, 51, 0, 255 }));
}

TEST(Ply, WedgesOfAnotherCountAreNotUsed)
{
  const auto model =
    readBytes("ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                     "element face 1\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
                     "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 4 .5 .5 .5 .5\n");
  EXPECT_EQ(model->triangles.size(), 1u);
  EXPECT_TRUE(model->uvs.empty());
}

TEST(Ply, PointsAloneAreAModelWithoutTriangles)
{
  const auto model = readBytes("ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                                      "property float z\nend_header\n1 2 3\n4 5 6");
  EXPECT_EQ(model->triangles.size(), 0u);
  EXPECT_EQ(model->sourceVertices, 2u);
  EXPECT_THAT(model->warnings, testing::ElementsAre(HasSubstr("points are not drawn")));
}

TEST(Ply, StripsEdgesAndWedges)
{
  const auto model = readBytes("ply",
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element tristrips 1\nproperty list int int vertex_indices\nelement edge 1\nproperty int vertex1\n"
    "property int vertex2\nelement face 1\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
    "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n0 3\n3 0 1 3 6 0 0 .5 0 .5 .25\n");
  EXPECT_EQ(brokenPromise(*model), "");
  ASSERT_EQ(model->triangles.size(), 3u);
  EXPECT_EQ(model->lines, 1u);
  for (const Eigen::Vector3f& normal : model->rest->normals)
  {
    EXPECT_EQ(normal, Eigen::Vector3f(0, 0, 1)); // both triangles of the strip face the same way
  }
  EXPECT_EQ(model->uvs[model->triangles[2][2]], Eigen::Vector2d(0.5, 0.25));
}

TEST(Ply, ThePictureThatACommentNames)
{
  const std::pair<const char*, const char*> table[] = { { "skin.png", "skin.png" }, { "skin.png \t", "skin.png" },
    { "my skin.png", "my skin.png" }, { "  my skin.png \t", "my skin.png" }, { "\"my skin.png\"", "my skin.png" } };
  for (const auto& [written, name] : table)
  {
    const std::string comment = std::string("comment TextureFile ") + written + "\nelement vertex";
    const auto model = readBytes("ply", changed(asciiQuad, "element vertex", comment));
    ASSERT_EQ(model->textures.size(), 1u) << written;
    EXPECT_EQ(model->textures[0].name, name);
  }
}

TEST(Ply, HowThePictureGoesOn)
{
  using dgtk::TextureWrap;
  const auto wrapOf = [](const std::string& comments)
  {
    const auto model = readBytes("ply", changed(asciiQuad, "element vertex", comments + "element vertex"));
    return model->textures.at(0).wrap;
  };
  const std::string first = "comment TextureFile a.png\n";
  const std::string second = "comment TextureFile b.png\n";
  const std::string wrap = "comment TextureWrap clamp mirror\n";
  EXPECT_EQ(wrapOf(first), (std::array{ TextureWrap::Repeat, TextureWrap::Repeat }));
  EXPECT_EQ(wrapOf(first + wrap + second), (std::array{ TextureWrap::Clamp, TextureWrap::Mirror }));
  EXPECT_EQ(wrapOf(first + second + wrap), (std::array{ TextureWrap::Repeat, TextureWrap::Repeat })) << "the second's";
}

namespace
{
/// Three triangles side by side, what stands behind the indices of each, and comments.
std::string threeFaces(const std::string& properties, const std::array<std::string, 3>& ends,
  const std::string& comments = "", const std::string& ofVertices = "", const std::string& vertexEnd = "")
{
  std::string text = "ply\nformat ascii 1.0\n" + comments +
                     "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n" + ofVertices +
                     "element face 3\nproperty list uchar int vertex_indices\n" + properties + "end_header\n";
  for (const char* vertex : { "0 0 0", "0 1 0", "1 0 0", "1 1 0", "2 0 0" })
  {
    text += vertex + vertexEnd + '\n';
  }
  return text + "3 0 2 1 " + ends[0] + "\n3 1 2 3 " + ends[1] + "\n3 2 4 3 " + ends[2] + '\n';
}

const std::string twoPictures =
  "comment TextureFile a.png\ncomment TextureFile b.png\ncomment TextureWrap clamp mirror\n";
} // namespace

TEST(Ply, EachFaceHasThePictureOfItsNumber)
{
  const auto model = readBytes("ply", threeFaces("property int texnumber\n", { "1", "0", "-1" }, twoPictures,
                                        "property float s\nproperty float t\n", " 0 0"));
  ASSERT_EQ(model->parts.size(), 3u);
  const auto pictureOf = [&model](std::size_t part)
  {
    const int texture = model->materials.at(std::size_t(model->parts[part].material)).texture;
    return texture < 0 ? std::string() : model->textures.at(std::size_t(texture)).name;
  };
  EXPECT_EQ(pictureOf(0), "b.png");
  EXPECT_EQ(pictureOf(1), "a.png");
  EXPECT_EQ(pictureOf(2), "");
  EXPECT_EQ(model->textures[0].wrap, (std::array{ dgtk::TextureWrap::Clamp, dgtk::TextureWrap::Mirror }));
  EXPECT_EQ(model->textures[1].wrap, dgtk::TextureWraps());
  EXPECT_THAT(model->warnings, testing::Each(HasSubstr("not found")));
  const auto lost = readBytes("ply", threeFaces("property int texnumber\n", { "2", "0", "7" }, twoPictures));
  EXPECT_THAT(lost->warnings, testing::Contains("2 face(s) name a picture that does not exist"));
  EXPECT_EQ(lost->parts.size(), 2u);
  const auto bare = readBytes("ply", threeFaces("property int texnumber\n", { "0", "0", "7" }));
  EXPECT_THAT(bare->warnings, testing::IsEmpty());
  const auto first = readBytes("ply", threeFaces("", { "", "", "" }, twoPictures));
  EXPECT_EQ(first->textures.size(), 1u);
  EXPECT_THAT(first->warnings, testing::Contains("faces have no texnumber: all have the first picture of 2"));
}

TEST(Ply, ColoursOfFacesAreOfTheirCorners)
{
  const std::string rgb = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const auto model = readBytes("ply", threeFaces(rgb, { "255 0 0", "0 255 0", "0 255 0" }));
  EXPECT_THAT(model->warnings, testing::IsEmpty());
  EXPECT_EQ(model->materials.at(0).diffuse, Eigen::Vector3d(1, 1, 1));
  ASSERT_EQ(model->colors.size(), model->rest->positions.size());
  for (std::size_t t = 0; t < 3; ++t)
  {
    for (const std::uint32_t vertex : model->triangles[t])
    {
      const int red = t == 0 ? 255 : 0;
      EXPECT_EQ(
        model->colors[vertex], (std::array<std::uint8_t, 4>{ std::uint8_t(red), std::uint8_t(255 - red), 0, 255 }));
    }
  }
  const auto both = readBytes("ply", threeFaces(rgb, { "255 0 0", "0 255 0", "0 255 0" }, "", rgb, " 255 51 0"));
  EXPECT_EQ(both->materials[0].diffuse, Eigen::Vector3d(1, 0.2, 0));
  EXPECT_TRUE(both->colors.empty());
  EXPECT_THAT(both->warnings, testing::ElementsAre("colours of faces are not drawn: vertices have their own"));
}

TEST(Ply, NumbersBeyondADoubleAreNotFinite)
{
  const auto model = readBytes("ply", changed(asciiQuad, "\n1 1 2 0", "\n1e400 1 2 0"));
  EXPECT_TRUE(model->triangles.empty());
  EXPECT_THAT(model->warnings, testing::Contains("1 surface left out: a coordinate that is not a finite number"));
  expectQuad(*readBytes("ply", changed(asciiQuad, "\n0 0 2 0", "\n-1e-400 0 2 0")));
}

TEST(Ply, ColoursOfOtherTypes)
{
  const std::pair<std::string, std::string> table[] = { { "ushort ", " 65535 13107 0\n" },
    { "uint ", " 4294967295 858993459 0\n" }, { "float ", " 1 0.2 0\n" }, { "double ", " 1 0.2 0\n" } };
  for (const auto& [type, color] : table)
  {
    std::string text = asciiQuad;
    for (const char* name : { "red", "green", "blue" })
    {
      text = changed(text, std::string("uchar ") + name, type + name);
    }
    for (int i = 0; i < 4; ++i)
    {
      text = changed(text, " 255 51 0\n", color);
    }
    EXPECT_EQ(readBytes("ply", text)->materials[0].diffuse, Eigen::Vector3d(1, 0.2, 0)) << type;
  }
}

TEST(Ply, ColoursThatHardlyHaveTheRangeOfTheirTypeAreWarnedOf)
{
  const auto warnings = [](const std::string& type, const std::string& color)
  {
    const std::string rgb = type + "red\n" + type + "green\n" + type + "blue\n";
    auto ofFaces = readBytes("ply", threeFaces(rgb, { color, color, color }))->warnings;
    EXPECT_EQ(readBytes("ply", threeFaces("", { "", "", "" }, "", rgb, " " + color))->warnings, ofFaces);
    return ofFaces;
  };
  EXPECT_THAT(warnings("property int ", "255 51 0"),
    testing::ElementsAre("colours are all but black: white is 4294967295 for their type"));
  EXPECT_THAT(warnings("property ushort ", "0 255 0"),
    testing::ElementsAre("colours are all but black: white is 65535 for their type"));
  EXPECT_THAT(warnings("property ushort ", "0 256 0"), testing::IsEmpty());
  EXPECT_THAT(warnings("property ushort ", "0 0 0"), testing::IsEmpty());
  EXPECT_THAT(warnings("property uchar ", "0 255 0"), testing::IsEmpty());
  EXPECT_THAT(warnings("property float ", "0 1.0001 0"), testing::IsEmpty());
  EXPECT_THAT(warnings("property float ", "0 255 0"),
    testing::ElementsAre("colours above 1 are drawn as 1, which is white for numbers with fractions"));
}

TEST(Ply, APictureIsNotTintedWhereTheFileSaysNoColour)
{
  const auto diffuse = [](const std::string& comments, const std::string& ofVertices, const std::string& vertexEnd)
  {
    const auto model = readBytes("ply", threeFaces("", { "", "", "" }, comments, ofVertices, vertexEnd));
    return model->materials.at(std::size_t(model->parts.at(0).material)).diffuse;
  };
  const std::string picture = "comment TextureFile a.png\n";
  const std::string uv = "property float s\nproperty float t\n";
  const std::string rgb = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  EXPECT_EQ(diffuse(picture, uv, " 0 0"), Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(diffuse("", uv, " 0 0"), Eigen::Vector3d(0.8, 0.8, 0.8));
  EXPECT_EQ(diffuse(picture, uv + rgb, " 0 0 255 51 0"), Eigen::Vector3d(1, 0.2, 0));
}

TEST(Ply, StripsBeginAnewWithTheirOwnTurn)
{
  const auto model = readBytes("ply",
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n"
    "8 0 1 2 3 -1 0 1 2\n");
  ASSERT_EQ(model->triangles.size(), 3u);
  for (const auto& t : model->triangles)
  {
    const auto& p = model->rest->positions;
    EXPECT_EQ((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]), Eigen::Vector3d(0, 0, 1));
  }
}

TEST(Ply, VerticesThatAStripRepeatsOnlySteerIt)
{
  const auto model = readBytes("ply",
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n"
    "5 0 1 2 2 3\n");
  EXPECT_EQ(model->triangles.size(), 1u);
}

TEST(Ply, FacesThatNameNoVertexAreCounted)
{
  const auto model = readBytes("ply", changed(asciiQuad, "4 0 1 2 3", "4 0 1 2 9"));
  EXPECT_EQ(model->triangles.size(), 0u);
  EXPECT_THAT(model->warnings, testing::Contains("1 surface left out: a vertex that does not exist"));
}

TEST(Ply, LyingCountsAreRefusedBeforeAnythingIsAllocated)
{
  resetPeak();
  const std::size_t before = peakBytes();
  EXPECT_THAT(refusal("ply", changed(asciiQuad, "vertex 4", "vertex 4000000000")),
    HasSubstr("has fewer bytes than element 'vertex' needs (expected 4000000000 times at least 22, found "));
  EXPECT_THAT(refusal("ply", changed(asciiQuad, "vertex 4", "vertex 99999999999999999999")),
    HasSubstr(":4: element has no count"));
  EXPECT_THAT(refusal("ply", changed(asciiQuad, "4 0 1 2 3", "2000000000 0 1")),
    HasSubstr(":23: list 'vertex_indices' has an impossible count"));
  EXPECT_LT(peakBytes() - before, 1u << 20);
}

TEST(Ply, RefusalsNameTheLine)
{
  EXPECT_THAT(refusal("ply", "plx\n"), HasSubstr(":1: is not a PLY file (expected ply, found 'plx')"));
  EXPECT_THAT(refusal("ply", "\n"), HasSubstr("is not a PLY file"));
  EXPECT_THAT(refusal("ply", "ply\nformat ascii 1.0\nelement vertex 1\n"),
    HasSubstr("header ends too soon (expected end_header, found end of file)"));
  EXPECT_THAT(refusal("ply", changed(asciiQuad, "format ascii", "format utf8")), HasSubstr(":2: unknown format"));
  EXPECT_THAT(refusal("ply", changed(asciiQuad, "float x", "quad x")), HasSubstr(":5: unknown type"));
  EXPECT_THAT(refusal("ply", changed(asciiQuad, "1 1 2", "1 one 2")), HasSubstr(":21: is no number"));
  EXPECT_THAT(refusal("ply", changed(asciiQuad, "4 0 1 2 3", "3 0 1 ")), HasSubstr(":24: ends too soon"));
  EXPECT_THAT(refusal("ply", "ply\nformat ascii 1.0\nend_header\n"), HasSubstr("has no vertices"));
  const std::string binary = binaryQuad(false);
  EXPECT_THAT(refusal("ply", binary.substr(0, binary.size() - 1)), HasSubstr("found end of file"));
}

TEST(Ply, FuzzAscii) { fuzzReader("ply", { asciiQuad }); }
TEST(Ply, FuzzBinary) { fuzzReader("ply", { binaryQuad(false), binaryQuad(true) }); }
