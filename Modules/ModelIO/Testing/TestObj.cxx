// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelChecks.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

using namespace dgtk::test;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace
{
const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string quad = "mtllib quad.mtl\no Quad\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                         "vt 0 1\nvn 0 0 1\nusemtl red\nf 1/1/1 2/2/1 3/3/1 4/4/1\nl 1 2 3\n";
const std::string quadMtl = "newmtl red\nKa 0.1 0.1 0.1\nKd 1 0.5 0\nKs 0.5 0.5 0.5\nNs 20\nd 0.5\nmap_Kd Tex.PPM\n";

using Corners = std::vector<std::vector<double>>;

/// Position, normal and texture coordinate of each corner, in the order of the triangles.
Corners cornersOf(const dgtk::Model& model)
{
  Corners all;
  for (const auto& t : model.triangles)
  {
    for (const std::uint32_t v : t)
    {
      const Eigen::Vector3d& p = model.rest->positions[v];
      const Eigen::Vector3f& n = model.rest->normals[v];
      all.push_back({ p[0], p[1], p[2], double(n[0]), double(n[1]), double(n[2]) });
      if (!model.uvs.empty())
      {
        all.back().insert(all.back().end(), { model.uvs[v][0], model.uvs[v][1] });
      }
    }
  }
  return all;
}

/// A folder with a model and what it names.
class ObjFolder
{
public:
  void write(const std::string& name, const std::string& text) { dgtk::writeFile(this->Folder.path(name), text); }
  std::string path(const std::string& name) const { return this->Folder.path(name); }
  std::shared_ptr<const dgtk::Model> read(const std::string& text)
  {
    this->write("a.obj", text);
    return dgtk::readModel(this->path("a.obj"));
  }
  /// The material of the only face.
  dgtk::Material material(const std::string& statements)
  {
    this->write("a.mtl", "newmtl m\n" + statements + '\n');
    const auto model = this->read("mtllib a.mtl\n" + triangle + "usemtl m\nf 1 2 3\n");
    return model->materials.at(static_cast<std::size_t>(model->parts.at(0).material));
  }

private:
  TemporaryFolder Folder;
};
} // namespace

TEST(Obj, MaterialAndTextureFoundInAnyCase)
{
  ObjFolder folder;
  folder.write("QUAD.MTL", quadMtl);
  folder.write("Quad.Mtl", "");
  folder.write("tex.ppm", std::string("P6 1 1 255\n") + "abc");
  const auto model = folder.read(quad);
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_EQ(model->format, "obj");
  EXPECT_THAT(model->warnings, IsEmpty());
  EXPECT_THAT(model->companions, ElementsAre(folder.path("QUAD.MTL")));
  ASSERT_EQ(model->triangles.size(), 2u);
  EXPECT_EQ(model->sourceVertices, 4u);
  EXPECT_EQ(model->lines, 2u);
  EXPECT_EQ(model->declaredMaterials, 1u);
  ASSERT_EQ(model->materials.size(), 1u);
  ASSERT_EQ(model->parts.size(), 1u);
  EXPECT_EQ(model->parts[0].name, "Quad");
  const dgtk::Material& red = model->materials[0];
  EXPECT_EQ(red.name, "red");
  EXPECT_EQ(red.diffuse, Eigen::Vector3d(1, 0.5, 0));
  EXPECT_EQ(red.ambient, Eigen::Vector3d(0.1, 0.1, 0.1));
  EXPECT_EQ(red.shininess, 20);
  EXPECT_EQ(red.opacity, 0.5);
  ASSERT_EQ(red.texture, 0);
  const dgtk::Texture& texture = model->textures[0];
  EXPECT_EQ(texture.path, folder.path("tex.ppm"));
  ASSERT_TRUE(texture.image);
  EXPECT_EQ(texture.image->rgba, (std::vector<std::uint8_t>{ 'a', 'b', 'c', 255 }));
  EXPECT_EQ(
    cornersOf(*model), (Corners{ { 0, 0, 0, 0, 0, 1, 0, 0 }, { 1, 0, 0, 0, 0, 1, 1, 0 }, { 1, 1, 0, 0, 0, 1, 1, 1 },
                         { 0, 0, 0, 0, 0, 1, 0, 0 }, { 1, 1, 0, 0, 0, 1, 1, 1 }, { 0, 1, 0, 0, 0, 1, 0, 1 } }));
}

TEST(Obj, WithoutItsMaterials)
{
  const auto model = readBytes("obj", quad);
  EXPECT_EQ(model->triangles.size(), 2u);
  EXPECT_THAT(model->warnings, ElementsAre("file quad.mtl not found"));
  ASSERT_EQ(model->materials.size(), 1u);
  EXPECT_EQ(model->materials[0].name, "red");
  EXPECT_EQ(model->materials[0].diffuse, Eigen::Vector3d(0.6, 0.6, 0.6));
  EXPECT_EQ(model->materials[0].ambient, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(model->declaredMaterials, 0u);
  EXPECT_EQ(readBytes("obj", triangle + "f 1 2 3\n")->materials.at(0).name, "DefaultMaterial");
}

TEST(Obj, CoordinatesAreThoseOfTheText)
{
  const auto model = readBytes("obj", "v 500000.123 0.1 -3e-3\nv +1 .5 2.\nv 1e400 0 0\nv 4 8 2 2\nv 3 3 3 1 1 1\n"
                                      "f 1 2 4\nf 1 2 5\nf 1 2 3\nf 1 2 7\n");
  EXPECT_EQ(model->rest->positions[0], Eigen::Vector3d(500000.123, 0.1, -0.003)) << "in double precision";
  EXPECT_EQ(model->rest->positions[1], Eigen::Vector3d(1, 0.5, 2));
  EXPECT_EQ(model->rest->positions[2], Eigen::Vector3d(2, 4, 1)) << "a weight divides";
  EXPECT_EQ(model->rest->positions.back(), Eigen::Vector3d(3, 3, 3)) << "a colour does not";
  EXPECT_EQ(readBytes("obj", "v 1 2 3 0\nv 2 2 3 0\nv 1 3 3 0\nf 1 2 3\n")->boundsMin, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(model->triangles.size(), 2u);
  EXPECT_THAT(model->warnings, ElementsAre("1 surface left out: a vertex that does not exist",
                                 "1 surface left out: a coordinate that is not a finite number"));
}

TEST(Obj, ColoursOfVerticesAreThoseOfTheirCorners)
{
  using Colors = std::vector<std::array<std::uint8_t, 4>>;
  const auto colors = [](const std::string& color)
  { return readBytes("obj", triangle + "v 1 1 1 " + color + "\nf 1 2 4\n")->colors; };
  const std::array<std::uint8_t, 4> white{ 255, 255, 255, 255 };
  EXPECT_EQ(colors("0.5 1 1"), Colors({ white, white, { 128, 255, 255, 255 } }));
  EXPECT_EQ(colors("1 0.2 1"), Colors({ white, white, { 255, 51, 255, 255 } }));
  EXPECT_EQ(colors("1 1 0"), Colors({ white, white, { 255, 255, 0, 255 } }));
  EXPECT_EQ(colors("1 1 1 0.4"), Colors({ white, white, { 255, 255, 255, 102 } }));
  EXPECT_EQ(colors("2 -1 nan"), Colors({ white, white, { 255, 0, 0, 255 } })) << "cut off";
  EXPECT_TRUE(colors("1 1 1").empty());
  EXPECT_TRUE(colors("1").empty());
  const auto seam = readBytes("obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 0 0 0 0 0 1\nv 1 0 0 0 0 1\n"
                                     "v 0 -1 0 0 0 1\nf 1 2 3\nf 5 4 6\n");
  EXPECT_EQ(seam->colors.size(), 6u) << "vertices at one place keep their colours";
}

TEST(Obj, ConcavePolygonsAndTheOrderOfObjects)
{
  const auto model =
    readBytes("obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nv 9 9 9\ng b\nf 1 2 3 4 5\ng a\nf 1 2 6\n");
  ASSERT_EQ(model->triangles.size(), 4u);
  ASSERT_EQ(model->parts.size(), 2u);
  EXPECT_EQ(model->parts[0].name, "b");
  EXPECT_EQ(model->parts[1].name, "a");
  EXPECT_EQ(model->fileVertices(), 6u);
  double area = 0;
  for (std::size_t t = 0; t < 3; ++t)
  {
    const auto& p = model->rest->positions;
    const auto& c = model->triangles[t];
    area +=
      0.5 * ((p[c[1]] - p[c[0]]).x() * (p[c[2]] - p[c[0]]).y() - (p[c[1]] - p[c[0]]).y() * (p[c[2]] - p[c[0]]).x());
  }
  EXPECT_DOUBLE_EQ(area, 16 - 6); // the notch is a triangle of area 6
}

TEST(Obj, WaysToNameACorner)
{
  const std::string values = triangle + "vt 0.25 0.5\nvt 0.75 1 9\nvn 0 3 0\nvn 0 0 -2\n";
  const auto corners = [&values](const std::string& face) { return cornersOf(*readBytes("obj", values + face)); };
  const Corners whole{ { 0, 0, 0, 0, 1, 0, 0.25, 0.5 }, { 1, 0, 0, 0, 0, -1, 0.75, 1 },
    { 0, 1, 0, 0, 1, 0, 0.25, 0.5 } };
  EXPECT_EQ(corners("f 1/1/1 2/2/2 3/1/1\n"), whole);
  EXPECT_EQ(corners("f -3/-2/-2 -2/-1/-1 -1/-2/-2\n"), whole);
  EXPECT_EQ(corners("f 1/1/1  2/2/2\t3/1/1 \r\n"), whole);
  EXPECT_EQ(corners("f 1/1/1 \\\n 2/2/2 \\\r\n3/1/1"), whole) << "a statement on three lines";
  EXPECT_EQ(corners("fo 1/1/1 2/2/2 3/1/1\n"), whole) << "the old word";
  EXPECT_EQ(corners("f 1/1/1 2/2/2 3/1/1 # three\n"), whole);
  const Corners plain{ { 0, 0, 0, 0, 0, 1 }, { 1, 0, 0, 0, 0, 1 }, { 0, 1, 0, 0, 0, 1 } };
  EXPECT_EQ(corners("f 1 2 3\n"), plain);
  EXPECT_EQ(corners("f 1/ 2/ 3/\n"), plain);
  EXPECT_EQ(corners("f 1// 2// 3//\n"), plain);
  EXPECT_EQ(
    corners("f 1//2 2//2 3//1\n"), (Corners{ { 0, 0, 0, 0, 0, -1 }, { 1, 0, 0, 0, 0, -1 }, { 0, 1, 0, 0, 1, 0 } }));
  EXPECT_EQ(corners("o a\nf 1//1 2//1 3//1\no b\nf 1//1 2//1 3//1\n").at(5), (std::vector<double>{ 0, 1, 0, 0, 1, 0 }));
  EXPECT_EQ(corners("f 1/1 2/2 3/2\n"),
    (Corners{ { 0, 0, 0, 0, 0, 1, 0.25, 0.5 }, { 1, 0, 0, 0, 0, 1, 0.75, 1 }, { 0, 1, 0, 0, 0, 1, 0.75, 1 } }));
}

TEST(Obj, RelativeCornersCountFromTheirOwnPlaceAndAbsoluteOnesMayComeFirst)
{
  const Corners two{ { 0, 0, 0, 0, 0, 1 }, { 1, 0, 0, 0, 0, 1 }, { 0, 1, 0, 0, 0, 1 }, { 0, 0, 5, 0, 0, 1 },
    { 1, 0, 5, 0, 0, 1 }, { 0, 1, 5, 0, 0, 1 } };
  const std::string later = "v 0 0 5\nv 1 0 5\nv 0 1 5\n";
  EXPECT_EQ(cornersOf(*readBytes("obj", triangle + "f -3 -2 -1\n" + later + "f -3 -2 -1\n")), two);
  EXPECT_EQ(cornersOf(*readBytes("obj", "f 1 2 3\nf 4 5 6\n" + triangle + later)), two);
}

TEST(Obj, WhatDoesNotExist)
{
  const std::string values = triangle + "vt 0.5 0.5\nvn 0 1 0\n";
  const auto model =
    readBytes("obj", values + "f 1 2 4\nf 0 1 2\nf -4 1 2\nf 1/2/1 2/1/2 3/-2/-2\nf 1 2 99999999999999999999\n");
  EXPECT_THAT(model->warnings, ElementsAre("4 corners name texture coordinates or normals that do not exist",
                                 "4 surfaces left out: a vertex that does not exist"));
  EXPECT_EQ(cornersOf(*model),
    (Corners{ { 0, 0, 0, 0, 1, 0, 0, 0 }, { 1, 0, 0, 0, 0, 1, 0.5, 0.5 }, { 0, 1, 0, 0, 0, 1, 0, 0 } }));
  EXPECT_THAT(readBytes("obj", values + "f 1/2 2 3\n")->warnings,
    ElementsAre("1 corner names a texture coordinate or normal that does not exist"));
}

TEST(Obj, PointsLinesAndFreeForms)
{
  const auto model = readBytes("obj", triangle + "p 1 2\nf 3\nl 1 2 3\nl 1 3\nf 1 2\ncurv 0 1 1 2\nsurf 0 1 0 1 1\n");
  EXPECT_EQ(model->lines, 4u);
  EXPECT_EQ(model->triangles.size(), 0u);
  EXPECT_EQ(model->boundsMax, Eigen::Vector3d(1, 1, 0));
  EXPECT_THAT(model->warnings, ElementsAre("3 points are not drawn", "2 free-form curves and surfaces are not drawn"));
  EXPECT_THAT(readBytes("obj", triangle + "p 1\nf 1 2 3\ncurv2 1 2\n")->warnings,
    ElementsAre("1 point is not drawn", "1 free-form curve or surface is not drawn"));
}

TEST(Obj, ObjectsGroupsAndMaterialsMakeParts)
{
  ObjFolder folder;
  folder.write("a.mtl", "newmtl dark red\nKd 0.5 0 0\nnewmtl blue\nKd 0 0 1\nnewmtl unused\nnewmtl blue\nKd 1 1 1\n");
  const auto model = folder.read(
    "mtllib a.mtl\n" + triangle +
    "f 1 2 3\no first thing \nusemtl dark red\nf 1 2 3\nusemtl blue\nf 1 2 3\n"
    "usemtl dark red\nf 1 2 3\ng\nf 1 2 3\ng second\no second\nf 1 2 3\nusemtl\nf 1 2 3\nusemtl pink\nf 1 2 3\n");
  std::vector<std::string> parts;
  for (const dgtk::Part& part : model->parts)
  {
    parts.push_back(part.name + '/' + model->materials[static_cast<std::size_t>(part.material)].name + ' ' +
                    std::to_string(part.triangles));
  }
  EXPECT_THAT(parts, ElementsAre("defaultobject/DefaultMaterial 1", "first thing/dark red 2", "first thing/blue 1",
                       "default/dark red 1", "second/dark red 1", "second/DefaultMaterial 1", "second/pink 1"));
  EXPECT_EQ(model->declaredMaterials, 3u);
  EXPECT_EQ(model->materials.size(), 4u) << "those that are used, each once";
  EXPECT_EQ(model->materials[2].diffuse, Eigen::Vector3d(0, 0, 1)) << "the first of a name counts";
  EXPECT_THAT(model->warnings, ElementsAre("material 'pink' is not defined: drawn grey"));
}

TEST(Obj, VerticesAtOnePlaceAreOne)
{
  // a roof of 40 degrees whose two halves name vertices of their own
  const std::string roof = "v 0 0 0\nv 0 2 0\nv -1 0 -0.36\nv 0 0 0\nv -0 2 0\nv 1 0 -0.36\n";
  const auto normals = [&roof](const std::string& group)
  {
    const auto model = readBytes("obj", roof + group + "f 1 2 3\nf 4 6 5\n");
    EXPECT_EQ(model->fileVertices(), 6u) << group;
    return cornersOf(*model)[0];
  };
  EXPECT_EQ(normals("")[3], 0) << "smooth along the ridge";
  EXPECT_EQ(normals("s 1\n")[3], 0);
  EXPECT_EQ(normals("s off\ns 2\n")[3], 0);
  EXPECT_LT(normals("s off\n")[3], -0.3) << "flat";
  EXPECT_LT(normals("s 0\n")[3], -0.3);
}

TEST(Obj, StatementsOfMaterials)
{
  ObjFolder folder;
  const dgtk::Material all =
    folder.material("Ka 0.1 0.2 0.3\nKd 0.4 0.5 0.6\nKs 0.7 0.8 0.9\nKe 0.2 0.4 0.8\nNs 20\nd 0.25");
  EXPECT_EQ(all.ambient, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(all.diffuse, Eigen::Vector3d(0.4, 0.5, 0.6));
  EXPECT_EQ(all.specular, Eigen::Vector3d(0.7, 0.8, 0.9));
  EXPECT_EQ(all.emission, Eigen::Vector3d(0.2, 0.4, 0.8));
  EXPECT_EQ(all.shininess, 20);
  EXPECT_EQ(all.opacity, 0.25);
  EXPECT_EQ(all.name, "m");
  EXPECT_EQ(all.texture, -1);
  EXPECT_FALSE(all.twoSided);
  EXPECT_FALSE(all.physical);
  const dgtk::Material unsaid = folder.material("");
  EXPECT_EQ(unsaid.ambient, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(unsaid.diffuse, Eigen::Vector3d(0.6, 0.6, 0.6));
  EXPECT_EQ(unsaid.emission, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(unsaid.opacity, 1);
  EXPECT_EQ(folder.material("Ks 1 1 1\nNs 0").specular, Eigen::Vector3d(0, 0, 0))
    << "an exponent of 0 would shine everywhere";
  EXPECT_EQ(folder.material("Ks 1 1 1\nNs 1000").shininess, 128);
  EXPECT_EQ(folder.material("Tr 0.25").opacity, 0.75);
  EXPECT_EQ(folder.material("d -halo 0.5").opacity, 0.5);
  EXPECT_EQ(folder.material("d 0").opacity, 1);
  EXPECT_EQ(folder.material("Kd 0.25").diffuse, Eigen::Vector3d(0.25, 0.25, 0.25)) << "red alone is grey";
  EXPECT_EQ(folder.material("Kd spectral a.rfl\nKd xyz 1 1 1").diffuse, Eigen::Vector3d(0.6, 0.6, 0.6));
  EXPECT_EQ(
    folder.material("Kd 0 1 0\nillum 2\nNi 1.5\nmap_Bump x.png\n\n# Kd 1 1 1").diffuse, Eigen::Vector3d(0, 1, 0));
  folder.write("a.mtl", "newmtl m\nd 0\n");
  EXPECT_THAT(folder.read("mtllib a.mtl\n" + triangle + "usemtl m\nf 1 2 3\n")->warnings,
    ElementsAre("material 'm' has opacity 0: drawn opaque"));
}

TEST(Obj, PicturesBehindOptions)
{
  ObjFolder folder;
  for (const char* options : { "", "-s 2 2 2 ", "-s 2 ", "-o 0.5 0.5 ", "-clamp on -blendu off ", "-mm 0 1 -bm 2 ",
         "-imfchan l -texres 64 -t 1 ", "-imfchan l ", "-texres 64 ", "-clamp on ", "-blendu off ", "-blendv off ",
         "-boost 1 ", "-type sphere ", "-cc on ", "-colorspace sRGB ", "\t" })
  {
    folder.write("a.mtl", std::string("newmtl m\nmap_Kd ") + options + "my stone.png \n");
    const auto model = folder.read("mtllib a.mtl\nvt 0 0\n" + triangle + "usemtl m\nf 1/1 2/1 3/1\n");
    ASSERT_EQ(model->textures.size(), 1u) << options;
    EXPECT_EQ(model->textures[0].name, "my stone.png") << options;
    EXPECT_THAT(model->warnings, ElementsAre(HasSubstr("texture 'my stone.png' not found"))) << options;
  }
  folder.write("a.mtl", "newmtl m\nmap_Kd \"my stone.png\"\n");
  EXPECT_EQ(folder.read("mtllib a.mtl\n" + triangle + "usemtl m\nf 1 2 3\n")->textures[0].name, "my stone.png");
}

TEST(Obj, PicturesAreScaledAndMoved)
{
  using dgtk::TextureWrap;
  ObjFolder folder;
  const auto read = [&folder](const std::string& options)
  {
    folder.write("a.mtl", "newmtl n\nmap_Kd p.png\nnewmtl m\nmap_Kd " + options + "p.png\n");
    return folder.read("mtllib a.mtl\nvt 0.5 0.25\n" + triangle + "usemtl m\nf 1/1 2/1 3/1\nusemtl n\nf 1/1 2/1 3/1\n");
  };
  const auto placed = [&read](const std::string& options)
  {
    const auto model = read(options);
    EXPECT_EQ(model->uvs[model->triangles[1][0]], Eigen::Vector2d(0.5, 0.25)) << "of the other material";
    return Eigen::Vector2d(model->uvs[model->triangles[0][0]]);
  };
  EXPECT_EQ(placed(""), Eigen::Vector2d(0.5, 0.25));
  EXPECT_EQ(placed("-s 2 4 8 "), Eigen::Vector2d(1, 1));
  EXPECT_EQ(placed("-s 2 "), Eigen::Vector2d(1, 0.25));
  EXPECT_EQ(placed("-o 0.25 -1 "), Eigen::Vector2d(0.75, -0.75));
  EXPECT_EQ(placed("-o 0.25 -s -2 2 1 "), Eigen::Vector2d(-0.75, 0.5)) << "scaled, then moved";
  EXPECT_EQ(placed("-t 2 2 2 -mm 2 3 "), Eigen::Vector2d(0.5, 0.25));
  const auto two = read("-clamp on ");
  ASSERT_EQ(two->textures.size(), 2u);
  const auto wrapOf = [&two](std::size_t part)
  { return two->textures[std::size_t(two->materials[std::size_t(two->parts[part].material)].texture)].wrap; };
  EXPECT_EQ(wrapOf(0), (std::array{ TextureWrap::Clamp, TextureWrap::Clamp }));
  EXPECT_EQ(wrapOf(1), (std::array{ TextureWrap::Repeat, TextureWrap::Repeat }));
  EXPECT_THAT(two->warnings, ElementsAre(HasSubstr("texture 'p.png' not found"))) << "said once";
  EXPECT_EQ(read("-clamp off ")->textures.size(), 1u);
}

TEST(Obj, PicturesOfWhatGlowsAndOfNormals)
{
  ObjFolder folder;
  const auto read = [&folder](const std::string& statements)
  {
    folder.write("a.mtl", "newmtl m\n" + statements);
    folder.write("p.ppm", "P3 1 1 255 9 9 9\n");
    folder.write("q.ppm", "P3 1 1 255 8 8 8\n");
    return folder.read("mtllib a.mtl\nvt 0.5 0.25\n" + triangle + "usemtl m\nf 1/1 2/1 3/1\n");
  };
  const auto both = read("map_KD p.ppm\nKe 0.5 0 0\nmap_ke -clamp on q.ppm\nnorm q.ppm\nPm 0.25\nPr 2\nmap_Ka p.ppm\n");
  EXPECT_THAT(both->warnings, ElementsAre());
  const dgtk::Material& material = both->materials[0];
  const auto nameOf = [&both](int texture) { return both->textures.at(std::size_t(texture)).name; };
  EXPECT_EQ(nameOf(material.texture), "p.ppm");
  EXPECT_EQ(nameOf(material.emissionMap), "q.ppm");
  EXPECT_EQ(both->textures[std::size_t(material.emissionMap)].wrap[0], dgtk::TextureWrap::Clamp);
  EXPECT_EQ(nameOf(material.normalMap), "q.ppm");
  EXPECT_EQ(both->textures[std::size_t(material.normalMap)].wrap[0], dgtk::TextureWrap::Repeat);
  EXPECT_EQ(material.emission, Eigen::Vector3d(0.5, 0, 0));
  ASSERT_TRUE(material.physical);
  EXPECT_EQ(material.physical->metallic, 0.25);
  EXPECT_EQ(material.physical->roughness, 1) << "at most";
  EXPECT_FALSE(material.physical->wanted);

  const auto glow = read("map_Ke -s 2 4 1 p.ppm\n");
  EXPECT_EQ(glow->materials[0].emission, Eigen::Vector3d(1, 1, 1)) << "nothing else is said";
  EXPECT_EQ(Eigen::Vector2d(glow->uvs.at(glow->triangles[0][0])), Eigen::Vector2d(1, 1)) << "where its picture lies";
  EXPECT_EQ(read("Ke 0 0 0\nmap_Ke p.ppm\n")->materials[0].emission, Eigen::Vector3d(1, 1, 1));
  folder.write("a.mtl", "newmtl m\nnewmtl n\nmap_Bump p.ppm\n");
  const auto bare = folder.read("mtllib a.mtl\n" + triangle + "usemtl m\nf 1 2 3\n");
  EXPECT_THAT(bare->warnings, ElementsAre()) << "of a material that is not used";
  const auto apart = read("norm -s 2 2 2 q.ppm\nmap_Kd -o 0.25 p.ppm\n");
  EXPECT_THAT(
    apart->warnings, ElementsAre("material 'm' has pictures in several places: all lie where the first does"));
  EXPECT_EQ(Eigen::Vector2d(apart->uvs.at(apart->triangles[0][0])), Eigen::Vector2d(0.75, 0.25));
  EXPECT_THAT(read("norm -s 2 2 2 q.ppm\nmap_Ke -s 2 2 p.ppm\n")->warnings, ElementsAre());
  EXPECT_THAT(
    read("map_Bump -bm 2 p.ppm\nbump p.ppm\nmap_Ks q.ppm\nmap_Kd p.ppm\nrefl q.ppm\nmap_Bump p.ppm\n")->warnings,
    ElementsAre("pictures of 'bump', 'map_Bump', 'map_Ks', 'refl' are not drawn"));
  std::string many;
  for (char c = 'a'; c <= 'z'; ++c)
  {
    many += std::string("map_x") + c + " p.ppm\n";
  }
  EXPECT_THAT(read(many)->warnings,
    ElementsAre(
      "pictures of 'map_xa', 'map_xb', 'map_xc', 'map_xd', 'map_xe', 'map_xf', 'map_xg', 'map_xh', ... are not drawn"));
}

TEST(Obj, LibrariesByTheirNames)
{
  ObjFolder folder;
  folder.write("one.mtl", "newmtl one\nKd 1 0 0\n");
  folder.write("my two.mtl", "newmtl two\nKd 0 1 0\n");
  const auto diffuse = [&folder](const std::string& libraries, const std::string& name)
  { return folder.read(libraries + triangle + "usemtl " + name + "\nf 1 2 3\n")->materials.at(0).diffuse; };
  EXPECT_EQ(diffuse("mtllib one.mtl\nmtllib my two.mtl\n", "one"), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(diffuse("mtllib one.mtl\nmtllib my two.mtl\n", "two"), Eigen::Vector3d(0, 1, 0));
  folder.write("two.mtl", "newmtl two\nKd 0 0 1\n");
  EXPECT_EQ(diffuse("mtllib one.mtl two.mtl\n", "two"), Eigen::Vector3d(0, 0, 1));
  EXPECT_THAT(folder.read("mtllib one.mtl three.mtl\n" + triangle + "f 1 2 3\n")->warnings,
    ElementsAre("file three.mtl not found"));
  folder.write("a.mtl", "newmtl own\nKd 0 1 1\n");
  EXPECT_EQ(diffuse("mtllib three.mtl\n", "own"), Eigen::Vector3d(0, 1, 1)) << "the model's own name";
  const auto both = folder.read("mtllib one.mtl\nmtllib a.mtl\nmtllib one.mtl\n" + triangle + "f 1 2 3\n");
  EXPECT_THAT(both->companions, ElementsAre(folder.path("a.mtl"), folder.path("one.mtl")));
  EXPECT_EQ(both->declaredMaterials, 2u);
}

TEST(Obj, LibrariesOutsideOfTheModelsFolderAreRefused)
{
  ObjFolder folder;
  std::filesystem::create_directories(folder.path("model/parts"));
  folder.write("quad.mtl", quadMtl);
  folder.write("model/parts/quad.mtl", quadMtl);
  const auto refusalOf = [&folder](const std::string& library) -> std::string
  {
    folder.write("model/b.obj", "mtllib " + library + '\n' + triangle + "usemtl red\nf 1 2 3\n");
    return thrownBy<dgtk::InputError>([&] { dgtk::readModel(folder.path("model/b.obj")); });
  };
  EXPECT_EQ(refusalOf(folder.path("quad.mtl")), "") << "it is taken as relative";
  EXPECT_THAT(dgtk::readModel(folder.path("model/b.obj"))->warnings, Contains(HasSubstr("quad.mtl not found")));
  EXPECT_THAT(
    refusalOf("../quad.mtl"), HasSubstr("names the file '../quad.mtl', which lies outside of the model's folder"));
  EXPECT_EQ(refusalOf("/nowhere/quad.mtl"), "");
  EXPECT_EQ(refusalOf("parts/quad.mtl"), "");
  EXPECT_EQ(dgtk::readModel(folder.path("model/b.obj"))->materials.back().name, "red");
  folder.write("model/quad.mtl", quadMtl);
  EXPECT_EQ(refusalOf("../quad.mtl"), "") << "its base name is beside the model";
}

TEST(Obj, Refusals)
{
  EXPECT_EQ(refusal("obj", triangle + "v 1 x 2\n"), "model.obj:4: v: is no number (expected a number, found 'x')");
  EXPECT_EQ(refusal("obj", "vt 1,5 0\n"), "model.obj:1: vt: is no number (expected a number, found '1,5')");
  EXPECT_EQ(refusal("obj", "# a\n\n\\\nvn 1 1 1f\n"), "model.obj:3: vn: is no number (expected a number, found '1f')");
  for (const char* word : { "a", "1/a", "1.5", "1/1/1/1", "1:2", "/1", "1/1/x" })
  {
    EXPECT_EQ(refusal("obj", triangle + "f 1 2 " + word + "\n"),
      std::string("model.obj:4: f: is no corner (expected vertex/texture/normal, found '") + word + "')");
  }
  EXPECT_EQ(refusal("obj", "<html>\n"),
    "model.obj: has nothing of a Wavefront OBJ file (expected statements such as v and f, found none)");
  EXPECT_EQ(refusal("obj", "\n# empty\n"), refusal("obj", "\n"));
  ObjFolder folder;
  folder.write("a.mtl", "newmtl m\nKd 1 green 0\n");
  EXPECT_THAT(thrownBy<dgtk::InputError>([&] { folder.read("mtllib a.mtl\n" + triangle); }),
    HasSubstr("a.mtl:2: Kd: is no number (expected a number, found 'green')"));
}

TEST(Obj, TextsOfOtherSystems)
{
  EXPECT_EQ(readBytes("obj", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r")->triangles.size(), 1u);
  EXPECT_EQ(readBytes("obj", "\xef\xbb\xbf" + triangle + "f 1 2 3")->triangles.size(), 1u);
  EXPECT_EQ(readBytes("obj", triangle + "o caf\xe9\nf 1 2 3")->parts[0].name, "caf\xc3\xa9");
}

TEST(Obj, LimitsOfWorkAndMemory)
{
  const std::string many(3'000'000, '1');
  ASSERT_TRUE(readWithinLimits("obj", triangle + "f 1 2 " + many + "\nf 1 2 3\n"));
  ASSERT_TRUE(readWithinLimits("obj", triangle + "v 0 0." + many + " 0\nf 1 2 3\n"));
  std::string vertices;
  std::string faces = triangle;
  std::string objects = triangle;
  std::string turns = triangle;
  for (int i = 0; i < 500'000; ++i)
  {
    vertices += "v 0 0 0\n";
    faces += "f 1 2 3\n";
    objects += i < 50'000 ? "g " + std::to_string(i) + "\nf 1 2 3\n" : "";
    turns += i < 20'000 ? "usemtl " + std::to_string(i % 7) + "\nf 1 2 3\n" : "";
  }
  ASSERT_TRUE(readWithinLimits("obj", vertices));
  EXPECT_FALSE(readWithinLimits("obj", faces)) << "faces without vertices of their own";
  ASSERT_TRUE(readWithinLimits("obj", faces.substr(0, triangle.size() + 8 * 200'000)));
  ASSERT_TRUE(readWithinLimits("obj", objects));
  ASSERT_TRUE(readWithinLimits("obj", turns));
  ASSERT_TRUE(readWithinLimits("obj", triangle + std::string(4'000'000, '\n') + "f 1 2 3\n"));
  std::string continued = triangle + "f";
  for (int i = 0; i < 500'000; ++i)
  {
    continued += " \\\n";
  }
  ASSERT_TRUE(readWithinLimits("obj", continued + "1 2 3\n"));
}

TEST(Obj, Fuzz)
{
  fuzzReader("obj", { quad, triangle + "s 1\ng a b\nf -3//1 -2// -1\nl 1 2\nvn 0 1 0\np 1\n" }, 2000, false);
}
