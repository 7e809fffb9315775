// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelChecks.h"
#include "dgtkPovContents.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>

using namespace dgtk::test;
using testing::Contains;
using testing::HasSubstr;

namespace
{
const std::string rightHanded = "camera { location <0,0,5> right <-1.33,0,0> look_at 0 }\n";
const std::string oneTriangle = "triangle { <0,0,1>, <2,0,1>, <0,3,1> }\n";

const char* const mesh2Scene = R"pov(
#version 3.7;
#declare Half = 0.5;  // a comment
#declare Skin = texture { pigment { color rgbt <1, Half, 0.25, 0.2> } finish { ambient 0.1 diffuse 0.8 specular 0.4 roughness 0.05 } }
/* nested /* comment */ */
#declare Body = mesh2 {
  vertex_vectors { 4, <0,0,0>, <1,0,0>, x+y, -1*-y }
  normal_vectors { 1, <0,0,1> }
  uv_vectors { 4, <0,0>, <1,0>, <1,1>, <0,1> }
  texture_list { 2, texture { Skin } texture { pigment { rgb 0.5 } } }
  face_indices { 2, <0,1,2>, 0, <0,2,3>, 1 }
  normal_indices { 2, <0,0,0>, <0,0,0> }
  inside_vector <0,0,1>
}
light_source { <0,10,0> color rgb 1 }
object { Body scale 2 rotate <0,0,90> translate <10,0,0> }
)pov";

Eigen::Vector3d corner(const dgtk::Model& model, std::size_t triangle, std::size_t i)
{
  return model.rest->positions[model.triangles[triangle][i]];
}

std::string writeFiles(const TemporaryFolder& folder, const std::map<std::string, std::string>& files)
{
  for (const auto& [name, text] : files)
  {
    std::filesystem::create_directories(std::filesystem::path(folder.path(name)).parent_path());
    dgtk::writeFile(folder.path(name), text);
  }
  return folder.path("scene.pov");
}
} // namespace

TEST(Pov, BareTrianglesAreDrawnMirrored)
{
  const auto model = readBytes("pov", oneTriangle);
  EXPECT_EQ(brokenPromise(*model), "");
  ASSERT_EQ(model->triangles.size(), 1u);
  EXPECT_EQ(model->twoSidedTriangles, 1u);
  expectNear({ 0, 0, -1 }, corner(*model, 0, 0));
  expectNear({ 0, 3, -1 }, corner(*model, 0, 1)); // the winding turns with the mirror
  EXPECT_EQ(model->rest->normals[0], Eigen::Vector3f(0, 0, -1));
  // bounds are in the file's axes
  EXPECT_EQ(model->boundsMin, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(model->boundsMax, Eigen::Vector3d(2, 3, 1));
}

TEST(Pov, CameraWithNegativeRightIsRightHanded)
{
  const auto model = readBytes("pov", rightHanded + oneTriangle);
  expectNear({ 2, 0, 1 }, corner(*model, 0, 1));
  EXPECT_EQ(model->rest->normals[0], Eigen::Vector3f(0, 0, 1));
  const auto declared =
    readBytes("pov", "#declare C = camera { right -x*image_width/image_height }\ncamera { C }" + oneTriangle);
  expectNear({ 2, 0, 1 }, corner(*declared, 0, 1));
  expectNear({ 0, 0, -1 }, corner(*readBytes("pov", "camera { right 1.33*y }" + oneTriangle), 0, 0));
}

TEST(Pov, Mesh2WithTexturesNormalsAndTransforms)
{
  const auto model = readBytes("pov", rightHanded + mesh2Scene);
  EXPECT_EQ(brokenPromise(*model), "");
  ASSERT_EQ(model->triangles.size(), 2u);
  EXPECT_EQ(model->sourceVertices, 4u);
  ASSERT_EQ(model->parts.size(), 2u);
  EXPECT_EQ(model->parts[0].name, "Body");
  // scale, then a quarter turn about z, then the translation: (x, y) -> (10 - 2 y, 2 x)
  expectNear({ 10, 0, 0 }, corner(*model, 0, 0));
  expectNear({ 10, 2, 0 }, corner(*model, 0, 1));
  expectNear({ 8, 2, 0 }, corner(*model, 0, 2));
  expectNear({ 8, 0, 0 }, corner(*model, 1, 2));
  const dgtk::Material& skin = model->materials[static_cast<std::size_t>(model->parts[0].material)];
  EXPECT_EQ(skin.name, "Skin");
  EXPECT_EQ(skin.diffuse, Eigen::Vector3d(0.8, 0.4, 0.2));
  expectNear({ 0.1, 0.05, 0.025 }, skin.ambient);
  expectNear({ 0.4, 0.4, 0.4 }, skin.specular);
  EXPECT_DOUBLE_EQ(skin.shininess, 20);
  EXPECT_DOUBLE_EQ(skin.opacity, 0.8);
  EXPECT_EQ(
    model->materials[static_cast<std::size_t>(model->parts[1].material)].diffuse, Eigen::Vector3d(0.5, 0.5, 0.5));
  // without indices of their own, texture coordinates follow the vertices
  EXPECT_EQ(model->uvs[model->triangles[1][2]], Eigen::Vector2d(0, 1));
}

TEST(Pov, MapsOfTexturesAreDrawnInTheirFirstOne)
{
  const std::string begin = "#declare A = texture { pigment { rgb <1, 0, 0.5> } finish { diffuse 0.5 } }\n"
                            "#declare B = texture { A finish { diffuse 0, 0.5 } }\n"
                            "mesh2 { vertex_vectors { 3, 0, x, y } texture_list { 2, texture { A } texture { ";
  const std::string end = " } } face_indices { 2, <0,1,2>, 0, <0,2,1>, 1 } }";
  const auto declared =
    readBytes("pov", begin + "function { select(x - 0.5, 0, 1) } texture_map { [0.5 A] [0.5 B] }" + end);
  EXPECT_EQ(declared->parts.size(), 1u); // the same material
  EXPECT_EQ(declared->materials[0].diffuse, Eigen::Vector3d(0.5, 0, 0.25));
  EXPECT_EQ(declared->warnings.size(), 1u);
  const auto inPlace = readBytes(
    "pov", begin + "gradient x texture_map { [0 pigment { rgb <0, 1, 0> } finish { diffuse 1 } scale 2] [1 B] }" + end);
  ASSERT_EQ(inPlace->parts.size(), 2u);
  EXPECT_EQ(inPlace->materials[static_cast<std::size_t>(inPlace->parts[1].material)].diffuse, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(readBytes("pov", begin + "gradient x texture_map { Known }" + end)->triangles.size(), 2u);
  EXPECT_THROW(readBytes("pov", begin + "gradient x texture_map { [0 A"), dgtk::InputError);
  EXPECT_THROW(readBytes("pov", begin + "gradient x texture_map { [0 A] "), dgtk::InputError);
}

TEST(Pov, NormalsDecideWhichSideIsOutside)
{
  const auto model = readBytes("pov", rightHanded + "mesh { smooth_triangle { <0,0,0>,<0,0,-2>, <1,0,0>,<0,0,-2>, "
                                                    "<0,1,0>,<0,0,-2> } texture { pigment { rgb 1 } } }");
  ASSERT_EQ(model->triangles.size(), 1u);
  expectNear({ 0, 1, 0 }, corner(*model, 0, 1));
  EXPECT_EQ(model->rest->normals[0], Eigen::Vector3f(0, 0, -1));
}

TEST(Pov, TransformsMultiplyInTheOrderWritten)
{
  const auto at = [](const std::string& transforms)
  {
    return corner(
      *readBytes("pov", rightHanded + "mesh { triangle { <1,2,3>, <1,0,0>, <0,1,0> } " + transforms + " }"), 0, 0);
  };
  expectNear({ 11, 2, 3 }, at("translate 10*x"));
  expectNear({ 22, 4, 6 }, at("translate <10,0,0> scale 2"));
  expectNear({ 12, 4, 6 }, at("scale 2 translate 10*x"));
  expectNear({ 1, -3, 2 }, at("rotate 90*x"));
  expectNear({ 3, 2, -1 }, at("rotate <0,90,0>"));
  expectNear({ -2, 1, 3 }, at("rotate z*90"));
  // rows of the matrix are the images of x, y, z and the translation
  expectNear({ 1 * 1 + 2 * 4 + 3 * 7 + 10, 1 * 2 + 2 * 5 + 3 * 8 + 11, 1 * 3 + 2 * 6 + 3 * 9 + 12 },
    at("matrix <1,2,3, 4,5,6, 7,8,9, 10,11,12>"));
  const double c = std::cos(0.5235987755982988);
  expectNear({ 1 * c - 2 * 0.5, 1 * 0.5 + 2 * c, 3 }, at("transform { rotate 30*z }"));
  expectNear({ 1, 2, 3 }, at("rotate 30*z transform { rotate 30*z inverse }"));
}

TEST(Pov, RotationsAreAboutXThenYThenZAndNothingIsScaledByZero)
{
  const auto at = [](const std::string& transforms)
  {
    return corner(
      *readBytes("pov", rightHanded + "mesh { triangle { <1,2,3>, <1,0,0>, <0,1,0> } " + transforms + " }"), 0, 0);
  };
  expectNear({ 3, 1, 2 }, at("rotate <90,0,90>"));
  expectNear({ 2, -3, -1 }, at("rotate <90,90,0>"));
  expectNear({ 2, 2, 9 }, at("scale <2,0,3>"));
}

TEST(Pov, ATextureOfTheObjectReplacesThatOfItsMeshButNotThoseOfAUnion)
{
  const std::string green = " texture { pigment { rgb <0,1,0> } } }";
  const auto diffuse = [&](const std::string& text)
  {
    const auto model =
      readBytes("pov", "#declare A = mesh { " + oneTriangle + "texture { pigment { rgb <1,0,0> } } }\n" + text + green);
    return model->materials[static_cast<std::size_t>(model->parts[0].material)].diffuse.normalized();
  };
  EXPECT_EQ(diffuse("object { A"), Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(diffuse("union { object { A }"), Eigen::Vector3d(1, 0, 0));
}

TEST(Pov, FacesOfSeveralTexturesAreDrawnWithTheirFirstOne)
{
  const auto model =
    readBytes("pov", "mesh2 { vertex_vectors { 3, 0, x, y } texture_list { 2, texture { pigment { rgb "
                     "<1,0,0> } } texture { pigment { rgb <0,1,0> } } } face_indices { 1, <0,1,2>, 0, 1, 1 } }");
  const dgtk::Material& drawn = model->materials[static_cast<std::size_t>(model->parts[0].material)];
  EXPECT_EQ(drawn.diffuse.normalized(), Eigen::Vector3d(1, 0, 0));
  EXPECT_THAT(model->warnings, Contains(HasSubstr("faces of several textures are drawn with their first one")));
}

TEST(Pov, NormalsStayAcrossTrianglesThatAreStretched)
{
  const auto model = readBytes("pov", rightHanded + "mesh { smooth_triangle { <0,0,0>,<1,1,0>, <1,-1,0>,<1,1,0>, "
                                                    "<0,0,1>,<1,1,0> scale <2,1,1> } }");
  EXPECT_LT((model->rest->normals[0] - Eigen::Vector3f(1, 2, 0).normalized()).norm(), 1e-6f);
  // (1, 1, 0) is across (1, -1, 0) and z: turned, and sheared so that y leans to x
  for (const auto& [transform, expected] : { std::pair("rotate 90*z", Eigen::Vector3f(-1, 1, 0)),
         std::pair("matrix <1,0,0, 1,1,0, 0,0,1, 5,5,5>", Eigen::Vector3f(1, 0, 0)) })
  {
    const auto moved = readBytes("pov", rightHanded +
                                          "mesh { smooth_triangle { <0,0,0>,<1,1,0>, <1,-1,0>,<1,1,0>, "
                                          "<0,0,1>,<1,1,0> " +
                                          transform + " } }");
    EXPECT_LT((moved->rest->normals[0] - expected.normalized()).norm(), 1e-6f) << transform;
  }
}

TEST(Pov, DeclaredMeshesOnlyAreDrawnOnce)
{
  const auto model = readBytes(
    "pov", "#declare A = mesh { " + oneTriangle + "}\n#declare B = union { object { A } object { A translate 5*x } }");
  ASSERT_EQ(model->triangles.size(), 2u);
  EXPECT_EQ(model->parts.size(), 2u);
  EXPECT_EQ(model->boundsMax.x(), 7);
}

TEST(Pov, TrianglesOfAMeshThatIsDrawnTwiceAreCountedOnceAsWritten)
{
  const std::string mesh = "#declare A = mesh { " + oneTriangle + oneTriangle + "}\nobject { A }\n";
  const auto model = readBytes("pov", mesh + "object { A translate 5*x }");
  EXPECT_EQ(model->triangles.size(), 4u);
  EXPECT_EQ(model->declaredTriangles, 2u);
  EXPECT_EQ(readBytes("pov", mesh)->declaredTriangles, 0u);
}

TEST(Pov, CornersBeyondAListThatFollowsTheVerticesHaveNone)
{
  const TemporaryFolder folder;
  const std::string scene =
    writeFiles(folder, { { "scene.pov", "mesh2 { vertex_vectors { 3, 0, x, y } normal_vectors { 2, <0,1,1>, <0,1,1> } "
                                        "uv_vectors { 2, <.5,.5>, <1,0> } face_indices { 1, <0,1,2> } }" } });
  const dgtk::PovContents contents = dgtk::readPovContents(scene);
  EXPECT_EQ(contents.shape.at(0).mesh->faces.at(0).uv, (std::array{ 0, 1, -1 }));
  EXPECT_EQ(contents.shape.at(0).mesh->faces.at(0).normal, (std::array{ 0, 1, -1 }));
}

TEST(Pov, DeclarationsSeeOnlyWhatStandsBeforeThem)
{
  const auto model = readBytes("pov", "#declare A = 1 #declare B = A + 1\n#local A = 5;\n"
                                      "triangle { <0,0,0>, <B,0,0>, <0,A,0> }");
  EXPECT_EQ(model->boundsMax, Eigen::Vector3d(2, 5, 0));
}

TEST(Pov, ConditionsAreFollowed)
{
  const auto model = readBytes("pov", "#ifndef (Size) #declare Size = 3; #else #declare Size = 4; #end\n"
                                      "#if (Size > 2 & Size != 4) #declare Far = Size*2; #else #error \"no\" #end\n"
                                      "#ifdef (Nothing) #while (1) mesh { #end #end\n"
                                      "triangle { 0, Far*x, Size*y }");
  EXPECT_EQ(model->boundsMax, Eigen::Vector3d(6, 3, 0));
}

TEST(Pov, ComparisonsThatIncludeEquality)
{
  for (const auto& [condition, holds] : std::vector<std::pair<std::string, bool>>{ { "1 <= 2", true },
         { "2 <= 2", true }, { "3 <= 2", false }, { "1 >= 2", false }, { "2 >= 2", true }, { "3 >= 2", true } })
  {
    const auto model =
      readBytes("pov", "#if (" + condition + ") #declare S = 3; #else #declare S = 4; #end triangle { 0, S*x, S*y }");
    EXPECT_EQ(model->boundsMax.x(), holds ? 3 : 4) << condition;
  }
}

TEST(Pov, ChoicesBetweenTwoValues)
{
  const auto model = readBytes("pov", "triangle { 0, (1 > 2 ? 3 : 4)*x, - -(2 > 1 ? 5 : 6)*y }");
  EXPECT_EQ(model->boundsMax, Eigen::Vector3d(4, 5, 0));
}

TEST(Pov, FilterAndTransmitOfColours)
{
  const auto model = readBytes("pov", "#declare T = rgbt <1,2,3,4>; #declare F = rgbf <1,2,3,5>;\n"
                                      "triangle { 0, <T.transmit,0,T.filter>, <0,F.filter,F.transmit> }");
  EXPECT_EQ(model->boundsMax, Eigen::Vector3d(4, 5, 0));
}

TEST(Pov, IncludesAreFoundBesideTheFileThenInTheLibrary)
{
  const TemporaryFolder folder;
  const std::string scene = writeFiles(folder,
    { { "scene.pov",
        "#include \"sub/a.inc\"\n#include \"lib.inc\"\n#include \"gone.inc\"\nobject { Inner pigment { White } }" },
      { "sub/a.inc", "#include \"b.inc\"\n" }, { "sub/b.inc", "#declare Inner = mesh { #include \"c.inc\" }" },
      { "sub/c.inc", oneTriangle }, { "library/lib.inc", "#declare White = rgb 1;" } });
  const auto without = dgtk::readModel(scene);
  EXPECT_THAT(without->warnings, Contains(HasSubstr("scene.pov:2: #include 'lib.inc' not found")));
  EXPECT_THAT(without->warnings, Contains(HasSubstr("scene.pov:4: 'White' is not declared: drawn without")));
  ::setenv("POVINC", ("/nowhere:" + folder.path("library")).c_str(), 1);
  const auto model = dgtk::readModel(scene);
  ::unsetenv("POVINC");
  EXPECT_EQ(model->triangles.size(), 1u);
  EXPECT_EQ(model->materials[0].diffuse, Eigen::Vector3d(1, 1, 1));
  EXPECT_THAT(model->warnings, Contains(HasSubstr("scene.pov:3: #include 'gone.inc' not found")));
}

TEST(Pov, IncludesElsewhereAreRefusedAndNothingOfThemIsSaid)
{
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("secret.txt"), "password");
  const auto refusalOf = [&folder](const std::string& name) -> std::string
  {
    writeFiles(folder,
      { { "scenes/scene.pov", "#include \"" + name + "\"\n" + oneTriangle }, { "scenes/own.inc", oneTriangle } });
    std::string text = thrownBy<dgtk::InputError>([&] { dgtk::readModel(folder.path("scenes/scene.pov")); });
    EXPECT_THAT(text, testing::Not(HasSubstr("password")));
    return text;
  };
  EXPECT_THAT(refusalOf("../secret.txt"), HasSubstr("scene.pov:1: #include '../secret.txt' lies outside"));
  EXPECT_THAT(refusalOf(folder.path("secret.txt")), HasSubstr("lies outside of the scene's folder and POVINC"));
  EXPECT_EQ(refusalOf(folder.path("scenes/own.inc")), "");
}

TEST(Pov, WhatAMeshDoesNotDependOnIsSkippedWithAWarning)
{
  const auto model =
    readBytes("pov", "#macro Lamp(P) light_source { P color rgb 1 } #end\n"
                     "#declare i = 0;\n#while (i < 3) light_source { <i,0,0> } #declare i = i + 1; #end\n"
                     "Lamp(<1,2,3>)\nsphere { 0, 1 }\ndifference { box { 0, 1 } sphere { 0, 1 } }\n"
                     "#declare Ball = sphere { 0, 1 };\nobject { Ball translate Foo(1) }\nbackground { rgb 1 }\n" +
                       oneTriangle);
  EXPECT_EQ(model->triangles.size(), 1u);
  const std::vector<std::string>& warnings = model->warnings;
  EXPECT_THAT(warnings, Contains(HasSubstr(":3: #while is not evaluated: left out")));
  EXPECT_THAT(warnings, Contains(HasSubstr(":4: macro 'Lamp' is not evaluated: left out")));
  EXPECT_THAT(warnings, Contains(HasSubstr(":5: sphere is not made of triangles: left out")));
  EXPECT_THAT(warnings, Contains(HasSubstr(":6: difference is not evaluated: left out")));
  EXPECT_THAT(warnings, Contains(HasSubstr("no part of the model, left out: background")));
}

TEST(Pov, WhatAMeshDependsOnIsRefusedWithItsPlace)
{
  const auto expectRefusal = [](const std::string& text, const std::string& what)
  { EXPECT_THAT(refusal("pov", text), HasSubstr(what)); };
  expectRefusal("\n#declare i=0; #while (i<2) " + oneTriangle + "#declare i=i+1; #end",
    ":2: #while is not evaluated, and a mesh depends on it ('triangle', line 2)");
  expectRefusal(
    "#macro M()\n" + oneTriangle + "#end\n\nM()", ":5: macro 'M' is not evaluated, and a mesh depends on it");
  expectRefusal("triangle { <0,0,0>, <wave(1),0,0>, <0,1,0> }", ":1: function or macro 'wave' is not evaluated");
  expectRefusal("mesh { " + oneTriangle + "\n translate Away }", ":3: undeclared name 'Away'");
  expectRefusal("#declare i=0; #while (i<2) #declare i=i+1; #end\nmesh { " + oneTriangle + " translate i*x }",
    ":1: #while is not evaluated, and a mesh depends on it");
  expectRefusal("difference { mesh { " + oneTriangle + " }\n sphere { 0, 1 } }",
    ":1: difference is not evaluated, and it stands in one object with a mesh");
  expectRefusal("union { mesh { " + oneTriangle + " }\n sphere { 0, 1 } }",
    ":3: sphere is not made of triangles, and it stands in one object with a mesh");
  expectRefusal("mesh { " + oneTriangle + " clipped_by { plane { x, 0 } } }", ":2: clipped_by is not evaluated");
  expectRefusal("\nsphere { 0, 1 }", ":2: sphere is not made of triangles, and the file has no mesh");
  expectRefusal("camera { location 0 }", "has no mesh");
  expectRefusal("mesh {\n#include \"none.inc\"\n}", ":2: #include 'none.inc' not found");
  expectRefusal("#if (rand(S) > 0.5) " + oneTriangle + "#end", ":1: #if is not evaluated");
}

TEST(Pov, DamageIsRefusedWithItsPlace)
{
  const auto expectRefusal = [](const std::string& text, const std::string& what)
  { EXPECT_THAT(refusal("pov", text), HasSubstr(what)); };
  const std::string vertices = "mesh2 { vertex_vectors { 3, <0,0,0>, <1,0,0>, <0,1,0> } ";
  expectRefusal(
    "mesh2 {\nvertex_vectors { 4, <0,0,0>, <1,0,0> } }", ":2: vertex_vectors has a wrong count (expected 4, found 2)");
  expectRefusal(vertices + "face_indices { 1, <0,1,3> } }",
    "face_indices point outside vertex_vectors (expected below 3, found 3)");
  expectRefusal(vertices + "face_indices { 1, <0,1,2>, 0 } }", "face_indices point outside texture_list");
  expectRefusal(vertices + "face_indices { 1, <0,1,-2> } }", "is no index or count");
  const std::string face = "face_indices { 1, <0,1,2> } ";
  const std::string two = "{ 2, <0,0,1>, <0,0,1> } ";
  expectRefusal(vertices + "normal_vectors " + two + face + "normal_indices { 1, <0,1,2> } }",
    "normal_indices point outside their list (expected below 2, found 2)");
  expectRefusal(vertices + "uv_vectors { 2, <0,0>, <1,0> } " + face + "uv_indices { 1, <0,2,1> } }",
    "uv_indices point outside their list (expected below 2, found 2)");
  expectRefusal(vertices + "normal_vectors " + two + face + "normal_indices { 2, <0,1,1>, <0,1,1> } }",
    "normal_indices do not match the faces (expected 1, found 2)");
  expectRefusal(vertices + "face_indices { 4000000000, <0,1,2> } }", "is no index or count");
  expectRefusal("mesh { triangle { <0,0,0>, <1,0",
    ":1: cannot understand a value (expected a number or vector, found end of file)");
  expectRefusal("mesh { triangle { <0,0,0>, <1,0,0>, }", "ends inside triangle");
  expectRefusal("/* open", ":1: comment is not closed");
  expectRefusal("#declare A = \"open", ":1: text is not closed");
  expectRefusal(std::string(100000, '('), "cannot be understood here");
  std::string deep;
  for (int i = 0; i < 100000; ++i)
  {
    deep += "union{";
  }
  expectRefusal(deep, "nests too deeply");
  deep = "#declare A = ";
  deep.append(100000, '(');
  expectRefusal(deep, "nests too deeply");
}

TEST(Pov, RepetitionIsBounded)
{
  std::string text = "#declare A0 = mesh { " + oneTriangle + "}\n";
  for (int i = 1; i < 40; ++i)
  {
    const std::string before = "A" + std::to_string(i - 1);
    text += "#declare A" + std::to_string(i) + " = union { object { " + before + " } object { " + before + " } }\n";
  }
  EXPECT_THAT(refusal("pov", text), HasSubstr("has too many objects"));
  std::string copies = "#declare A = mesh { " + oneTriangle + "}\n#declare B = union {";
  for (int i = 0; i < 1000; ++i)
  {
    copies += " object { A }";
  }
  copies += " }\n";
  for (int i = 0; i < 50; ++i)
  {
    copies += "#declare B" + std::to_string(i) + " = B\n";
  }
  EXPECT_THAT(refusal("pov", copies), HasSubstr("has too many objects"));
  const TemporaryFolder folder;
  const std::string scene = writeFiles(folder, { { "scene.pov", "#include \"scene.pov\"\n" } });
  EXPECT_THAT(
    thrownBy<dgtk::InputError>([&] { dgtk::readModel(scene); }), HasSubstr("scene.pov:1: #include nests too deeply"));
}

TEST(Pov, ImageMapsGiveTextureCoordinates)
{
  const auto planar = readBytes("pov",
    rightHanded +
      "mesh { triangle { <0,0,0>, <4,0,0>, <0,4,0> } pigment { image_map { png \"a.png\" } scale 4 } translate 7*z }");
  ASSERT_EQ(planar->textures.size(), 1u);
  EXPECT_EQ(planar->textures[0].name, "a.png");
  EXPECT_EQ(planar->uvs[planar->triangles[0][1]], Eigen::Vector2d(1, 0));
  EXPECT_EQ(planar->uvs[planar->triangles[0][2]], Eigen::Vector2d(0, 1));
  const auto mapped = readBytes(
    "pov", rightHanded + "mesh { triangle { <0,0,0>, <4,0,0>, <0,4,0> uv_vectors <0.5,0>, <1,0>, <1,0.25> } uv_mapping "
                         "texture { uv_mapping pigment { image_map { jpeg \"b.jpg\" interpolate 2 } } } }");
  EXPECT_EQ(mapped->uvs[mapped->triangles[0][2]], Eigen::Vector2d(1, 0.25));
}

/// Triangles as drawn: what a file includes is counted with it, and an object placed twice counts twice.
TEST(Pov, RealFilesHaveTheTrianglesThatAreDrawn)
{
  const std::string folder = extraModels();
  if (folder.empty() || !std::filesystem::exists(folder + "/TRUTH.json"))
  {
    GTEST_SKIP() << withoutExtraModels;
  }
  // the reference counts the words in each file: nothing for scenes that only include, two meshes that are placed twice
  const std::map<std::string, std::size_t> drawn = { { "aster3.pov", 1536 }, { "chesmsh.pov", 737 },
    { "mesh2.pov", 96 } };
  const nlohmann::json truth = nlohmann::json::parse(contentsOf(folder + "/TRUTH.json"));
  int compared = 0;
  for (const auto& [name, t] : truth.items())
  {
    if (t["format"] == "pov")
    {
      const auto model = dgtk::readModel(folder + "/" + name);
      EXPECT_EQ(brokenPromise(*model), "") << name;
      const auto special = drawn.find(name.substr(name.find_last_of('/') + 1));
      EXPECT_EQ(model->triangles.size(), special == drawn.end() ? t["triangles"].get<std::size_t>() : special->second)
        << name;
      ++compared;
    }
  }
  EXPECT_GE(compared, 5);
}

TEST(Pov, Fuzz)
{
  fuzzReader("pov",
    { mesh2Scene,
      rightHanded + "mesh { smooth_triangle { <0,0,0>,<0,0,-2>, <1,0,0>,<0,0,-2>, <0,1,0>,<0,0,-2> } }\nunion { " +
        oneTriangle + "rotate 30*x }\n#if (1) #declare A = mesh { " + oneTriangle + "} #end object { A }" });
}
TEST(Pov, FuzzReal)
{
  std::vector<std::string> seeds;
  for (const std::string& seed : extraSeeds("pov"))
  {
    if (refusal("pov", seed).empty()) // some need a file that they include
    {
      seeds.push_back(seed);
    }
  }
  if (seeds.empty())
  {
    GTEST_SKIP() << withoutExtraModels;
  }
  fuzzReader("pov", seeds);
}
