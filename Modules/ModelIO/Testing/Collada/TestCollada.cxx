// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkModelChecks.h"

#include <gtest/gtest.h>

#include <regex>
#include <string>

namespace
{
using dgtk::test::brokenPromise;
using dgtk::test::readBytes;

/// A quad of two triangles, its picture and its colours named by elements, its attributes with what XML allows there.
const char* const pictured = R"(<?xml version="1.0"?>
<!-- it's: a > b < <color> 7 -->
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><contributor><authoring_tool><![CDATA[ " <color>  x</color> > ]]></authoring_tool></contributor>
<unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_images><image id="i" name="i"><init_from>a picture.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON>
<newparam sid="su"><surface type="2D"><init_from>i</init_from></surface></newparam>
<newparam sid="sa"><sampler2D><source>su</source></sampler2D></newparam>
<technique sid="c"><phong><emission><color>0.5 0.25 0 1</color></emission>
<diffuse><texture texture="sa" texcoord="UV"/></diffuse><specular><color>.25 0.5 +0.75 1</color></specular>
<shininess><float>12</float></shininess></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name='"a" > b'><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g" name="it's"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array><technique_common>
<accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<source id="t"><float_array id="ta" count="8">0 0 1 0 1 1 0 0.5</float_array><technique_common>
<accessor source="#ta" count="4" stride="2"><param name="S" type="float"/><param name="T" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist material="m" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#t" offset="1" set="0"/><vcount>4</vcount><p>0 0 1 1 2 2 3 3</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="place">
<matrix>1 0 0 10 0 1 0 20 0 0 1 30 0 0 0 1</matrix><scale>2 3 4</scale>
<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="m" target="#m"/>
</technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";

void expectPictured(const std::string& text)
{
  const auto model = readBytes("dae", text);
  EXPECT_EQ(brokenPromise(*model), "");
  ASSERT_EQ(model->triangles.size(), 2u);
  EXPECT_EQ(model->boundsMin, Eigen::Vector3d(10, 20, 30));
  EXPECT_EQ(model->boundsMax, Eigen::Vector3d(12, 23, 30));
  ASSERT_EQ(model->parts.size(), 1u);
  EXPECT_EQ(model->parts[0].name, "place");
  const dgtk::Material& material = model->materials[std::size_t(model->parts[0].material)];
  EXPECT_EQ(material.name, "\"a\" > b");
  EXPECT_LT((material.emission - Eigen::Vector3d(0.5, 0.25, 0)).norm(), 1e-6);
  EXPECT_LT((material.specular - Eigen::Vector3d(0.25, 0.5, 0.75)).norm(), 1e-6);
  EXPECT_EQ(material.shininess, 12);
  ASSERT_EQ(material.texture, 0);
  EXPECT_EQ(model->textures[0].name, "a picture.png");
}

/// White space before and behind what each element holds.
std::string spaced(const std::string& text, const std::string& before, const std::string& behind)
{
  static const std::regex held(R"((<(\w+)[^<>]*>)([^<>]+)(</\2>))");
  return std::regex_replace(text, held, "$1" + before + "$3" + behind + "$4");
}

TEST(Collada, WhiteSpaceAroundWhatElementsHoldDoesNotCount)
{
  expectPictured(pictured);
  for (const char* const space : { " ", "\n", "\t", "\r\n  " })
  {
    const std::string text = spaced(pictured, space, "");
    ASSERT_NE(text.find("<color>" + std::string(space) + "0.5 0.25"), std::string::npos);
    expectPictured(text);
    expectPictured(spaced(pictured, "", space));
    expectPictured(spaced(pictured, space, space));
  }
}

/// A unit of length says how large the numbers are elsewhere; they are kept, to the bit.
TEST(Collada, UnitsDoNotScale)
{
  const std::string text = pictured;
  const std::string unit = R"(<unit name="meter" meter="1"/>)";
  for (const char* const other : { "", R"(<unit meter="0.01" name="centimeter"/>)", "<unit meter = '0.0254'/>",
         R"(<unit meter="0,010000"></unit>)", "<unit\nmeter='1e3' />" })
  {
    expectPictured(std::string(text).replace(text.find(unit), unit.size(), other));
  }
}

TEST(Collada, TextThatEndsAnywhereIsRefused)
{
  const std::string whole = pictured;
  for (std::size_t size = 0; size < whole.size(); size += 97)
  {
    EXPECT_THROW(readBytes("dae", whole.substr(0, size)), dgtk::InputError) << size;
  }
  for (const std::string last :
    { "<", "<?xml", "<!", "<!-- it", "<![CDATA[ \"", "<unit", "<unit name=\"m", "</", "name='" })
  {
    EXPECT_THROW(readBytes("dae", whole.substr(0, whole.find(last) + last.size())), dgtk::InputError) << last;
  }
}
} // namespace

TEST(Collada, PicturesOfWhichTheFileSaysNothingAreNotFound)
{
  std::string text = pictured;
  const std::string said = "<init_from>a picture.png</init_from>";
  text.replace(text.find(said), said.size(), "<!-- " + said + " -->");
  const auto model = readBytes("dae", text);
  EXPECT_EQ(model->triangles.size(), 2u);
  ASSERT_EQ(model->textures.size(), 1u);
  EXPECT_EQ(model->textures[0].name, "i");
}
