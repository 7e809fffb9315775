// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelChecks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// The scene description language, word by word.

namespace
{
const std::string rightHandedCamera = "camera { right -x }\n";

/// The first corner of the first triangle, in the scene's axes.
Eigen::Vector3d corner(const std::string& begin, const std::string& first, const std::string& end = "")
{
  const auto model =
    readBytes("pov", rightHandedCamera + begin + "mesh { triangle { " + first + ", <9,0,0>, <0,9,0> } " + end + " }");
  return model->rest->positions[model->triangles.at(0)[0]];
}

double value(const std::string& expression) { return corner("", "<7, " + expression + ", 8>").y(); }

struct Drawn
{
  dgtk::Material material;
  std::string texture;
  std::vector<Eigen::Vector2d> uvs; ///< of the corners
  std::vector<std::string> warnings;
};

/// A mesh of one triangle <0,0,0>, <4,0,0>, <0,4,0> and what stands behind it; `before` may declare something.
Drawn drawn(const std::string& modifiers, const std::string& before = "", const std::string& ofTriangle = "")
{
  const auto model = readBytes(
    "pov", rightHandedCamera + before + "\nmesh { triangle { 0, 4*x, 4*y " + ofTriangle + " } " + modifiers + " }");
  Drawn found;
  found.material = model->materials.at(static_cast<std::size_t>(model->parts.at(0).material));
  found.texture =
    found.material.texture < 0 ? "" : model->textures[static_cast<std::size_t>(found.material.texture)].name;
  for (const std::uint32_t vertex : model->triangles.at(0))
  {
    found.uvs.push_back(model->uvs.empty() ? Eigen::Vector2d(0, 0) : model->uvs[vertex]);
  }
  for (const std::string& warning : model->warnings)
  {
    if (warning.find("no part of the model") == std::string::npos && warning.find("not found") == std::string::npos)
    {
      found.warnings.push_back(warning);
    }
  }
  return found;
}

void expectNear(const Eigen::VectorXd& expected, const Eigen::VectorXd& found, const std::string& what)
{
  EXPECT_LE((expected - found).cwiseAbs().maxCoeff(), 1e-12) << what << ": " << found.transpose();
}
} // namespace

TEST(PovTables, Expressions)
{
  const std::pair<const char*, double> table[] = { { "1e2", 100 }, { ".5", 0.5 }, { "1.5e-1", 0.15 }, { "1+2*3", 7 },
    { "(1+2)*3", 9 }, { "8/4/2", 1 }, { "7-3-2", 2 }, { "7-(3-2)", 6 }, { "-2*3", -6 }, { "2*-3", -6 }, { "+4", 4 },
    { "--4", 4 }, { "!0", 1 }, { "!3", 0 }, { "!!3", 1 }, { "!-3", 0 }, { "-!0", -1 }, { "-!3", 0 }, { "<1,2,3>.x", 1 },
    { "<1,2,3>.y", 2 }, { "<1,2,3>.z", 3 }, { "<1,2,3,4>.t", 4 }, { "<1,2,3,4,5>.transmit", 5 },
    { "<1,2,3,4,5>.filter", 4 }, { "<1,2,3>.red", 1 }, { "<1,2,3>.green", 2 }, { "<1,2,3>.blue", 3 }, { "<6,7>.u", 6 },
    { "<6,7>.v", 7 }, { "<6,7>.z", 0 }, { "(5).z", 5 }, { "(2*x+3*y+5*z).y", 3 }, { "(x+4).y", 4 },
    { "(<1,2,3>*<4,5,6>).z", 18 }, { "(<1,2,3>/<4,8,6>).z", 0.5 }, { "(<1,2,3>-1).z", 2 }, { "(8/<1,2,4>).z", 2 },
    { "(<1,2,3>/<0,8,6>).y", 0.25 }, { "u.x", 1 }, { "v.y", 1 }, { "t.t", 1 }, { "x.y", 0 },
    { "pi", 3.14159265358979323846 }, { "tau/pi", 2 }, { "true", 1 }, { "false", 0 }, { "yes", 1 }, { "no", 0 },
    { "on", 1 }, { "off", 0 }, { "clock", 0 }, { "clock_delta", 1 }, { "clock_on", 0 }, { "frame_number", 1 },
    { "initial_frame", 1 }, { "final_frame", 1 }, { "initial_clock", 0 }, { "final_clock", 0 }, { "image_width", 160 },
    { "image_height", 120 }, { "version", 3.7 }, { "unix", 1 }, { "(1 < 2)", 1 }, { "(2 < 2)", 0 }, { "(2 > 1)", 1 },
    { "(2 > 2)", 0 }, { "(2 = 2)", 1 }, { "(2 = 1)", 0 }, { "(2 != 2)", 0 }, { "(2 != 1)", 1 }, { "(1 & 2)", 1 },
    { "(1 & 0)", 0 }, { "(0 | 3)", 1 }, { "(0 | 0)", 0 }, { "(1+1 = 2 & 1)", 1 }, { "(0 ? 3 : 1 ? 4 : 5)", 4 },
    { "(2 ? 0 ? 3 : 6 : 5)", 6 }, { "(1 = 2 | 2 = 2 ? 8 : 9)", 8 } };
  for (const auto& [expression, expected] : table)
  {
    EXPECT_DOUBLE_EQ(value(expression), expected) << expression;
  }
}

TEST(PovTables, ExpressionsThatAreRefused)
{
  const std::pair<const char*, const char*> table[] = { { "1/0", "division by zero" }, { "A", "undeclared name 'A'" },
    { "wave(1)", "function or macro 'wave' is not evaluated" }, { "<1>.x", "vector is too short" },
    { "<1,2,3,4,5,6>.x", "vector is too long" }, { "<1,2,3>.w", "cannot understand the component of a vector" },
    { "(1 ? 2)", "cannot understand a choice" }, { "*3", "cannot understand a value" },
    { "(1", "cannot understand an expression" } };
  for (const auto& [expression, what] : table)
  {
    EXPECT_THAT(refusal("pov", std::string("mesh { triangle { <7, ") + expression + ", 8>, x, y } }"), HasSubstr(what))
      << expression;
  }
}

TEST(PovTables, Transforms)
{
  const std::string named = "#declare T = transform { scale 2 translate x }\n";
  const std::pair<const char*, Eigen::Vector3d> table[] = { { "transform T", { 3, 4, 6 } },
    { "transform { T }", { 3, 4, 6 } }, { "transform { T inverse }", { 0, 1, 1.5 } },
    { "transform { translate x T }", { 5, 4, 6 } }, { "transform { scale <-2,1,1> inverse }", { -0.5, 2, 3 } },
    { "transform { scale <0,1,1> inverse }", { 1, 2, 3 } }, { "rotate -90*y", { -3, 2, 1 } },
    { "rotate 450*z", { -2, 1, 3 } }, { "rotate 180*x", { 1, -2, -3 } },
    { "matrix <0,1,0, 1,0,0, 0,0,2, 5,0,0>", { 7, 1, 6 } }, { "scale <-1,1,1> rotate 90*z", { -2, -1, 3 } } };
  for (const auto& [transforms, expected] : table)
  {
    expectNear(expected, corner(named, "<1,2,3>", transforms), transforms);
  }
}

TEST(PovTables, Colours)
{
  struct Row
  {
    const char* pigment;
    Eigen::Vector3d color;
    double opacity;
  };
  const Row table[] = { { "rgb 0.5", { 0.5, 0.5, 0.5 }, 1 }, { "color rgb <1, 0.5, 0.25>", { 1, 0.5, 0.25 }, 1 },
    { "srgb <1, 0.5, 0.25>", { 1, 0.5, 0.25 }, 1 }, { "colour <0.25, 0.5, 1>", { 0.25, 0.5, 1 }, 1 },
    { "rgbt <1, 0.5, 0.25, 0.25>", { 1, 0.5, 0.25 }, 0.75 }, { "rgbf <1, 0.5, 0.25, 0.5>", { 1, 0.5, 0.25 }, 0.5 },
    { "srgbt <1, 0.5, 0.25, 0.25>", { 1, 0.5, 0.25 }, 0.75 }, { "srgbf <1, 0.5, 0.25, 0.5>", { 1, 0.5, 0.25 }, 0.5 },
    { "rgbft <1, 0.5, 0.25, 0.25, 0.5>", { 1, 0.5, 0.25 }, 0.25 }, { "red 1 green 0.5 blue 0.25", { 1, 0.5, 0.25 }, 1 },
    { "rgb <0.5,0,1> transmit 0.5", { 0.5, 0, 1 }, 0.5 }, { "rgb 1 filter 0.25 transmit 0.5", { 1, 1, 1 }, 0.25 },
    { "Teal transmit 0.5", { 0, 0.5, 0.5 }, 0.5 }, { "color Teal filter 0.5", { 0, 0.5, 0.5 }, 0.25 },
    { "rgb 0 green 0.5", { 0, 0.5, 0 }, 1 }, { "Teal", { 0, 0.5, 0.5 }, 0.75 }, { "color Teal", { 0, 0.5, 0.5 }, 0.75 },
    { "Teal*0.5", { 0, 0.25, 0.25 }, 0.875 },
    { "gradient x color_map { [0 rgb <1, 0, 0>] [1 Teal] }", { 0.5, 0.25, 0.25 }, 1 },
    { "checker rgb <1, 0, 1> rgb <0, 0, 0.5>", { 0.5, 0, 0.75 }, 1 }, { "Paint", { 0.25, 0.5, 0.75 }, 0.5 },
    { "rgb 1 quick_color rgb 0", { 1, 1, 1 }, 1 }, { "bozo", { 0.8, 0.8, 0.8 }, 1 },
    { "gradient x color_map { [0 rgb <1, 0, 0>] [0.5 rgb f(1)] [1 rgb <0, 0, 1>] }", { 0.5, 0, 0.5 }, 1 },
    { "gradient x color_map { [0 rgb f(1)] }", { 0.8, 0.8, 0.8 }, 1 }, { "rgbt f(1)", { 0.8, 0.8, 0.8 }, 1 },
    { "checker rgb f(1) rgbt <0.5, 1, 0, 0.25>", { 0.5, 1, 0 }, 0.75 } };
  for (const Row& row : table)
  {
    const Drawn found = drawn(std::string("pigment { ") + row.pigment + " }",
      "#declare Teal = rgbt <0, 0.5, 0.5, 0.25>; #declare Paint = pigment { rgbf <0.25, 0.5, 0.75, 0.5> }");
    expectNear(row.color, found.material.diffuse, row.pigment);
    EXPECT_DOUBLE_EQ(found.material.opacity, row.opacity) << row.pigment;
  }
}

TEST(PovTables, PatternsAreSaidToBeDrawnInTheirMean)
{
  EXPECT_THAT(drawn("pigment { rgb 1 }").warnings, IsEmpty());
  for (const char* pigment :
    { "checker rgb 1 rgb 0", "gradient x color_map { [0 rgb 1] }", "bozo colour_map { [0 rgb 1] }" })
  {
    EXPECT_THAT(drawn(std::string("pigment { ") + pigment + " }").warnings,
      ElementsAre(HasSubstr(":3: a pattern of colours is drawn in their mean")))
      << pigment;
  }
}

TEST(PovTables, ColoursOfTheLibraryThatIsNotAtHand)
{
  const std::pair<const char*, Eigen::Vector3d> table[] = { { "Red", { 1, 0, 0 } }, { "Green", { 0, 1, 0 } },
    { "Blue", { 0, 0, 1 } }, { "Yellow", { 1, 1, 0 } }, { "Cyan", { 0, 1, 1 } }, { "Magenta", { 1, 0, 1 } },
    { "White", { 1, 1, 1 } }, { "Black", { 0, 0, 0 } }, { "Gray05", { 0.05, 0.05, 0.05 } },
    { "Grey95", { 0.95, 0.95, 0.95 } }, { "Gray50", { 0.5, 0.5, 0.5 } } };
  for (const auto& [name, color] : table)
  {
    expectNear(color, drawn(std::string("pigment { ") + name + " }", "#include \"colors.inc\"").material.diffuse, name);
  }
  const std::string own = "#declare Red = rgb 0.5; #include \"colors.inc\"";
  expectNear(Eigen::Vector3d(0.5, 0.5, 0.5), drawn("pigment { Red }", own).material.diffuse, "one's own");
}

TEST(PovTables, Finishes)
{
  struct Row
  {
    const char* finish;
    double ambient, diffuse, emission, specular, shininess;
  };
  const Row table[] = { { "", 0.2, 1, 0, 0, 0 }, { "ambient 0.5", 0.5, 1, 0, 0, 0 }, { "ambient 0", 0, 1, 0, 0, 0 },
    { "diffuse 0.25", 0.2, 0.25, 0, 0, 0 }, { "diffuse albedo 0.25", 0.2, 0.25, 0, 0, 0 },
    { "emission 0.5", 0.2, 1, 0.5, 0, 0 }, { "specular 0.5 roughness 0.1", 0.2, 1, 0, 0.5, 10 },
    { "specular 0.5 roughness 0", 0.2, 1, 0, 0.5, 128 }, { "phong 0.25 phong_size 30", 0.2, 1, 0, 0.25, 30 },
    { "phong 0.25 phong_size 30 specular 0.5 roughness 0.125", 0.2, 1, 0, 0.5, 8 },
    { "phong 0.25", 0.2, 1, 0, 0.25, 40 }, { "specular 0.5", 0.2, 1, 0, 0.5, 20 },
    { "reflection { 0, 1 metallic } brilliance 2 ambient 0.25", 0.25, 1, 0, 0, 0 },
    { "Dull", 0.25, 0.5, 0.125, 0.75, 20 }, { "Dull ambient 1", 1, 0.5, 0.125, 0.75, 20 },
    { "diffuse Half", 0.2, 0.5, 0, 0, 0 } };
  for (const Row& row : table)
  {
    const dgtk::Material found = drawn(std::string("pigment { rgb 1 } finish { ") + row.finish + " }",
      "#declare Half = 0.5; #declare Dull = finish { ambient 0.25 diffuse 0.5 emission 0.125 phong 0.75 phong_size 20 "
      "}")
                                   .material;
    EXPECT_EQ(found.ambient, row.ambient * Eigen::Vector3d(1, 1, 1)) << row.finish;
    EXPECT_EQ(found.diffuse, row.diffuse * Eigen::Vector3d(1, 1, 1)) << row.finish;
    EXPECT_EQ(found.emission, row.emission * Eigen::Vector3d(1, 1, 1)) << row.finish;
    EXPECT_EQ(found.specular, row.specular * Eigen::Vector3d(1, 1, 1)) << row.finish;
    EXPECT_NEAR(found.shininess, row.shininess, 1e-12) << row.finish;
  }
}

TEST(PovTables, TexturesOfManySources)
{
  const std::string declared = "#declare P = pigment { rgb <1, 0.5, 0> }\n#declare F = finish { diffuse 0.5 }\n"
                               "#declare T = texture { pigment { P } finish { F } }\n#default { pigment { rgb <0, 0.5, "
                               "1> } finish { diffuse 0.75 } }\n"
                               "#declare Layers = texture { T } texture { pigment { P } }\n";
  const std::pair<const char*, Eigen::Vector3d> table[] = { { "", { 0, 0.375, 0.75 } },
    { "texture { T }", { 0.5, 0.25, 0 } }, { "texture { T finish { diffuse 1 } }", { 1, 0.5, 0 } },
    { "texture { pigment { P } }", { 0.75, 0.375, 0 } }, { "pigment { P }", { 0.75, 0.375, 0 } },
    { "pigment { P } finish { F }", { 0.5, 0.25, 0 } }, { "finish { F }", { 0, 0.25, 0.5 } },
    { "material { texture { T } }", { 0.5, 0.25, 0 } }, { "texture { T } pigment { rgb 1 }", { 0.5, 0.5, 0.5 } },
    { "texture { finish { F } } texture { T }", { 0.5, 0.25, 0 } }, { "texture { Layers }", { 0.75, 0.375, 0 } },
    { "pigment { P } texture { finish { F } }", { 0, 0.25, 0.5 } } };
  for (const auto& [modifiers, color] : table)
  {
    expectNear(color, drawn(modifiers, declared).material.diffuse, modifiers);
  }
  EXPECT_THAT(drawn("texture { Unknown }").warnings, ElementsAre(HasSubstr("texture 'Unknown' is not declared")));
  EXPECT_THAT(drawn("pigment { Unknown }").warnings, ElementsAre(HasSubstr("'Unknown' is not declared")));
}

TEST(PovTables, WhatReplacesThePictureOfADeclaredTexture)
{
  const std::string declared = "#declare B = texture { pigment { image_map { png \"a.png\" } } }\n";
  const std::tuple<const char*, const char*, Eigen::Vector3d> table[] = { { "B", "a.png", { 1, 1, 1 } },
    { "B pigment { rgb <1, 0, 0> }", "", { 1, 0, 0 } }, { "B pigment { B rgb <1, 0, 0> }", "", { 1, 0, 0 } },
    { "B pigment { checker rgb <1, 0, 0> rgb <0, 0, 1> }", "", { 0.5, 0, 0.5 } },
    { "B pigment { image_map { png \"b.png\" } }", "b.png", { 1, 1, 1 } },
    { "B pigment { rgb <1, 0, 0> image_map { png \"b.png\" } }", "b.png", { 1, 1, 1 } },
    { "B pigment { quick_color rgb 0 }", "a.png", { 1, 1, 1 } }, { "B finish { ambient 0 }", "a.png", { 1, 1, 1 } } };
  for (const auto& [body, picture, color] : table)
  {
    const Drawn found = drawn(std::string("texture { ") + body + " }", declared);
    EXPECT_EQ(found.texture, picture) << body;
    expectNear(color, found.material.diffuse, body);
  }
}

TEST(PovTables, PlacesOfPictures)
{
  const std::string picture = " { image_map { png \"a.png\" } } ";
  const std::string scaled = " { image_map { png \"a.png\" } scale 4 } ";
  struct Row
  {
    std::string modifiers;
    std::string ofTriangle;
    Eigen::Vector2d first, second, third;
  };
  const Row table[] = { { "pigment" + picture, "", { 0, 0 }, { 4, 0 }, { 0, 4 } },
    { "pigment" + scaled, "", { 0, 0 }, { 1, 0 }, { 0, 1 } },
    { "pigment" + picture + "translate 2*x", "", { 0, 0 }, { 4, 0 }, { 0, 4 } },
    { "translate 2*x pigment" + picture, "", { 2, 0 }, { 6, 0 }, { 2, 4 } },
    { "translate 2*x texture { pigment" + picture + "translate y }", "", { 2, -1 }, { 6, -1 }, { 2, 3 } },
    { "translate 2*x pigment { rgb 1 }", "pigment" + picture, { 0, 0 }, { 4, 0 }, { 0, 4 } },
    { "pigment { uv_mapping image_map { png \"a.png\" } }", "uv_vectors <0.5,0>, <1,0>, <1,0.25>", { 0.5, 0 }, { 1, 0 },
      { 1, 0.25 } },
    { "pigment { uv_mapping image_map { png \"a.png\" } scale 0.5 translate y }", "uv_vectors <0.5,0>, <1,0>, <1,0.25>",
      { 1, -2 }, { 2, -2 }, { 2, -1.5 } },
    { "pigment { Map }", "", { 0, 0 }, { 2, 0 }, { 0, 2 } },
    { "texture { Skin }", "", { -0.5, 0 }, { 0.5, 0 }, { -0.5, 1 } } };
  for (const Row& row : table)
  {
    const Drawn found = drawn(row.modifiers,
      "#declare Map = pigment { image_map { png \"a.png\" } scale 2 } #declare Skin = texture { Map translate x scale "
      "2 }",
      row.ofTriangle);
    EXPECT_EQ(found.texture, "a.png") << row.modifiers;
    EXPECT_THAT(found.uvs, ElementsAre(row.first, row.second, row.third)) << row.modifiers << row.ofTriangle;
    EXPECT_EQ(found.material.diffuse, Eigen::Vector3d(1, 1, 1)) << row.modifiers;
  }
}

TEST(PovTables, PicturesOnOtherThanPlanesAreNotDrawnInTheirPlace)
{
  const std::string wrong = "image_map 'a.png' of that map_type is not drawn in its place";
  const auto warningsOf = [](const std::string& pigment)
  {
    return drawn("pigment { " + pigment + " }",
      "#declare Ball = pigment { image_map { png \"a.png\" map_type 1 } } #declare One = 1; #declare Name = \"a.png\";")
      .warnings;
  };
  EXPECT_THAT(warningsOf("image_map { png \"a.png\" map_type 1 }"), ElementsAre(wrong));
  EXPECT_THAT(warningsOf("image_map { png Name map_type One once }"), ElementsAre(wrong));
  EXPECT_THAT(warningsOf("Ball"), ElementsAre(wrong));
  EXPECT_THAT(warningsOf("image_map { png \"a.png\" map_type 0 once interpolate 2 }"), IsEmpty());
  EXPECT_THAT(warningsOf("uv_mapping image_map { png \"a.png\" map_type 1 }"), IsEmpty());
}

TEST(PovTables, ObjectsThatAreNotMadeOfTriangles)
{
  for (const char* word :
    { "bicubic_patch", "blob", "box", "cone", "cubic", "cylinder", "disc", "height_field", "isosurface",
      "julia_fractal", "lathe", "lemon", "ovus", "parametric", "plane", "poly", "polygon", "polynomial", "prism",
      "quadric", "quartic", "sor", "sphere", "sphere_sweep", "superellipsoid", "text", "torus" })
  {
    EXPECT_THAT(drawn("", std::string(word) + " { <1,2,3>, 1 texture { Some { deep } } }").warnings,
      ElementsAre(testing::EndsWith(std::string(":2: ") + word + " is not made of triangles: left out")));
    EXPECT_THAT(refusal("pov", std::string("union { triangle { 0, x, y } ") + word + " { 1 } }"),
      HasSubstr(std::string(word) + " is not made of triangles, and it stands in one object with a mesh"));
    EXPECT_THAT(refusal("pov", std::string(word) + " { mesh { triangle { 0, x, y } } }"), HasSubstr("cannot be read"));
  }
  for (const char* word : { "atmosphere", "background", "fog", "global_settings", "light_source", "looks_like", "media",
         "photons", "radiosity", "rainbow", "sky_sphere", "interior", "density", "atmospheric_media", "camera" })
  {
    const auto model = readBytes("pov", std::string(word) + " { <1,2,3> { x } }\ntriangle { 0, x, y }");
    EXPECT_THAT(model->warnings, ElementsAre("no part of the model, left out: " + std::string(word)));
  }
}

TEST(PovTables, DeclarationsThatAreNotMadeOfTriangles)
{
  for (const char* word : { "light_source", "sphere", "box", "plane", "cone", "cylinder", "torus", "disc", "blob",
         "lathe", "prism", "sor", "text", "height_field", "superellipsoid", "isosurface", "parametric", "normal",
         "interior", "media", "density", "fog", "sky_sphere", "rainbow", "color_map", "colour_map", "pigment_map",
         "normal_map", "texture_map", "slope_map", "sphere_sweep", "bicubic_patch", "polygon", "quadric", "cubic",
         "quartic", "poly", "julia_fractal", "background", "ovus", "lemon", "radiosity", "photons" })
  {
    const std::string declared = std::string("#declare A = ") + word + " { [0 rgb 1] { <1,2,3>, 1 } }\n";
    EXPECT_THAT(drawn("", declared).warnings, IsEmpty()) << word;
    EXPECT_THAT(drawn("", declared + "object { A scale 2 }").warnings,
      ElementsAre(HasSubstr(std::string(word) + " is not made of triangles: left out")));
  }
  for (const char* use : { "object { A scale 2 }", "union { A }" })
  {
    EXPECT_THAT(drawn("", std::string("#declare A = \"a.png\";\n") + use).warnings,
      ElementsAre(HasSubstr(":3: 'A' is not made of triangles: left out")));
  }
  EXPECT_EQ(
    readBytes("pov", "#declare A = union { sphere { 0, 1 } }\nmesh { A }\ntriangle { 0, x, y }")->triangles.size(), 1u);
  for (const char* word : { "array", "function", "spline" })
  {
    const std::string declared = std::string("#declare A = ") + word + "(x)[3] { 1, 2, 3 }\n";
    EXPECT_THAT(
      refusal("pov", declared + "triangle { 0, A(1)*x, y }"), HasSubstr(std::string(word) + " is not evaluated"));
  }
}

TEST(PovTables, ModifiersThatDoNotMatter)
{
  for (const char* word : { "normal", "interior", "interior_texture", "photons", "radiosity", "no_shadow",
         "no_reflection", "no_radiosity", "double_illuminate", "hollow", "sturm", "hierarchy", "split_union",
         "bounded_by", "open", "solid", "uv_mapping", "cutaway_textures", "global_lights", "evaluate" })
  {
    for (const char* rest : { "", "{ a { 1 } }", "on", "off", "true", "no", "1" })
    {
      expectNear(Eigen::Vector3d(1, 4, 3), corner("", "<1,2,3>", std::string(word) + ' ' + rest + " scale <1,2,1>"),
        std::string(word) + rest);
    }
  }
  expectNear(Eigen::Vector3d(2, 4, 6), corner("", "<1,2,3>", "inside_vector <0,0,1> inverse scale 2"), "inside_vector");
  EXPECT_THAT(refusal("pov", "mesh { triangle { 0, x, y } no_image }"), HasSubstr("has no mesh"));
  EXPECT_THAT(refusal("pov", "mesh { triangle { 0, x, y no_image } }"), HasSubstr("has no mesh"));
  EXPECT_THAT(refusal("pov", "mesh { triangle { 0, x, y } strange }"), HasSubstr("cannot be understood in a mesh"));
}

TEST(PovTables, Directives)
{
  const std::pair<const char*, double> table[] = { { "#declare A = 2;", 2 }, { "#local A = 2;", 2 },
    { "# declare A = 2;", 2 }, { "#declare A = 1; #declare A = A + 1;", 2 },
    { "#declare A = 2; #declare A[0] = 3;", 3 }, { "#if (1) #declare A = 2; #else #declare A = 3; #end", 2 },
    { "#if (0) #declare A = 2; #else #declare A = 3; #end", 3 },
    { "#if (0) #declare A = 2; #elseif (1) #declare A = 3; #else #declare A = 4; #end", 3 },
    { "#if (0) #declare A = 2; #elseif (0) #declare A = 3; #else #declare A = 4; #end", 4 },
    { "#if (1) #declare A = 2; #elseif (1) #declare A = 3; #else #declare A = 4; #end", 2 },
    { "#if (0) #if (1) #declare A = 2; #else #declare A = 3; #end #else #declare A = 4; #end", 4 },
    { "#if (0) #while (1) #end #macro M() #end #switch (1) #case (1) #end #else #declare A = 4; #end", 4 },
    { "#if (1) #declare A = 2; #else #if (1) #declare A = 3; #else #declare A = 4; #end #end", 2 },
    { "#declare B = 1; #ifdef (B) #declare A = 2; #else #declare A = 3; #end", 2 },
    { "#ifdef (B) #declare A = 2; #else #declare A = 3; #end", 3 },
    { "#ifndef (B) #declare A = 2; #else #declare A = 3; #end", 2 },
    { "#macro B() #end #ifdef (B) #declare A = 2; #else #declare A = 3; #end", 2 },
    { "#macro B() #end #ifndef (B) #declare A = 2; #else #declare A = 3; #end", 3 },
    { "#declare B = 1; #undef B #ifdef (B) #declare A = 2; #else #declare A = 3; #end", 3 },
    { "#ifdef (B[1]) #declare A = 2; #else #declare A = 3; #end", 3 },
    { "#version 3.7; #debug \"x\" #warning \"y\" #render \"z\" #statistics 1 #declare A = 2;", 2 },
    { "#version unofficial megapov 1.2; #declare A = 2;", 2 }, { "#version version; #declare A = 2;", 2 },
    { "/* #declare A = 3; /* */ #error \"\" */ #declare A = 2; // #declare A = 4;\n", 2 },
    { "/* a // */ #declare A = 2;", 2 }, { "#declare A = 2 // three\n", 2 },
    { "#declare A = 3; #macro M() #declare A = 4; #end", 3 } };
  for (const auto& [directives, expected] : table)
  {
    EXPECT_EQ(corner(std::string(directives) + "\n", "<0, A, 0>").y(), expected) << directives;
  }
  const std::pair<const char*, const char*> refused[] = { { "#error \"stop\"", ":2: #error 'stop'" },
    { "#end", "#end without #if" }, { "#else", "#else without #if" }, { "#if (1)\n#else", "#if is not closed" },
    { "#nonsense", "unknown directive" }, { "#declare 3 = 4;", "cannot understand #declare" },
    { "#include 3", "#include names no file" }, { "#macro M()", "#macro is not closed" } };
  for (const auto& [directives, what] : refused)
  {
    EXPECT_THAT(refusal("pov", "\n" + std::string(directives) + "\ntriangle { 0, x, y }"), HasSubstr(what))
      << directives;
  }
  for (const char* loop : { "#while (A < 3) #declare A = A + 1; #end", "#for (I, 1, 3) #declare A = I; #end",
         "#switch (A) #case (1) #declare A = 2; #break #end", "#fopen F \"x\" read\n", "#read (F, B)\n" })
  {
    EXPECT_THAT(drawn("", std::string("#declare A = 1;\n") + loop).warnings,
      ElementsAre(testing::EndsWith("is not evaluated: left out")))
      << loop;
  }
}

TEST(PovTables, DeclaredObjectsAreDrawnInTheOrderOfTheirDeclarationUnlessTheyAreUsed)
{
  const auto names = [](const std::string& text)
  {
    const auto model = readBytes("pov", text);
    std::vector<std::string> found;
    for (const dgtk::Part& part : model->parts)
    {
      found.push_back(part.name);
    }
    return found;
  };
  const std::string three = "#declare C = mesh { triangle { 0, x, y } } #declare A = mesh { triangle { 0, x, y } } "
                            "#declare B = mesh { triangle { 0, x, y } } ";
  EXPECT_THAT(names(three), ElementsAre("C", "A", "B"));
  EXPECT_THAT(names(three + "#declare D = union { object { C } A }"), ElementsAre("B", "C", "A"));
  EXPECT_THAT(names(three + "object { B }"), ElementsAre("B"));
  EXPECT_THAT(names(three + "mesh { A scale 2 }"), ElementsAre("A"));
  EXPECT_THAT(names("#declare E = union { mesh { triangle { 0, x, y } } triangle { 0, x, z } } object { E }"),
    ElementsAre("E", "E"));
}
