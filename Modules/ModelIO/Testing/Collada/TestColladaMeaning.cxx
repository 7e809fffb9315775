// SPDX-License-Identifier: BSD-3-Clause
// What Collada files mean where Assimp by itself takes them for something else.
#include "dgtkModelChecks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace dgtk::test;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{
const std::string identity = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
const std::string instance = "<instance_geometry url='#g'/>";

std::string source(const std::string& id, const std::string& type, int count, int stride, const std::string& values)
{
  const std::string size = std::to_string(count * stride);
  std::string text = "<source id='" + id + "'><" + type + "_array id='" + id + "a' count='" + size + "'>" + values +
                     "</" + type + "_array><technique_common><accessor source='#" + id + "a' count='" +
                     std::to_string(count) + "' stride='" + std::to_string(stride) + "'>";
  for (int i = 0; i < (stride == 16 ? 1 : stride); ++i)
  {
    text += std::string("<param name='") + "XYZ"[i % 3] + "' type='" + (stride == 16 ? "float4x4" : "float") + "'/>";
  }
  return text + "</accessor></technique_common></source>";
}

/// A triangle, drawn by `nodes`; `inputs` and `corners` are what it has beside its vertices.
std::string dae(const std::string& nodes, const std::string& libraries = {}, const std::string& sources = {},
  const std::string& inputs = {}, const std::string& corners = "0 1 2")
{
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>" +
         libraries + "<library_geometries><geometry id='g'><mesh>" + source("p", "float", 3, 3, "0 0 0 1 0 0 0 1 0") +
         sources +
         "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices><triangles material='m' count='1'>"
         "<input semantic='VERTEX' source='#v' offset='0'/>" +
         inputs + "<p>" + corners + "</p></triangles></mesh></geometry></library_geometries>" +
         "<library_visual_scenes><visual_scene id='s'>" + nodes + "</visual_scene></library_visual_scenes>" +
         "<scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

/// From 0 to 1 in a second.
std::string animation(const std::string& target, const std::string& between = "LINEAR")
{
  return "<library_animations><animation id='A'>" + source("i", "float", 2, 1, "0 1") +
         source("o", "float", 2, 1, "0 1") + source("n", "Name", 2, 1, between + ' ' + between) +
         "<sampler id='S'><input semantic='INPUT' source='#i'/><input semantic='OUTPUT' source='#o'/>"
         "<input semantic='INTERPOLATION' source='#n'/></sampler><channel source='#S' target='" +
         target + "'/></animation></library_animations>";
}

/// The triangle as it hangs on one joint, j; `shape` is what the skin begins with.
std::string skin(const std::string& shape = {})
{
  return "<library_controllers><controller id='c'><skin source='#g'>" + shape + source("j", "Name", 1, 1, "j") +
         source("b", "float", 1, 16, identity) + source("w", "float", 1, 1, "1") +
         "<joints><input semantic='JOINT' source='#j'/><input semantic='INV_BIND_MATRIX' source='#b'/></joints>"
         "<vertex_weights count='3'><input semantic='JOINT' source='#j' offset='0'/>"
         "<input semantic='WEIGHT' source='#w' offset='1'/><vcount>1 1 1</vcount><v>0 0 0 0 0 0</v></vertex_weights>"
         "</skin></controller></library_controllers>";
}

const std::string drawnSkin = "<instance_controller url='#c'><skeleton>#r</skeleton></instance_controller>";

std::vector<Eigen::Vector3d> inTheMiddle(const dgtk::Model& model)
{
  std::vector<Eigen::Vector3d> positions;
  if (model.deformation)
  {
    model.deformation->positionsAt(0, 0.5 * model.animations.at(0).fps, positions);
  }
  return positions;
}

std::vector<std::string> partsOf(const dgtk::Model& model)
{
  std::vector<std::string> names;
  for (const dgtk::Part& part : model.parts)
  {
    names.push_back(part.name);
  }
  return names;
}

void expectClose(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  EXPECT_LT((a - b).norm(), 1e-6) << a.transpose() << " instead of " << b.transpose();
}
} // namespace

TEST(ColladaMeaning, NodesWithoutNamesMove)
{
  const auto model = readBytes("dae",
    dae("<node><node id='a'><translate sid='t'>0 0 0</translate>" + instance + "</node></node>", animation("a/t.Z")));
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_THAT(partsOf(*model), ElementsAre("$ColladaAutoName$_1"));
  const auto positions = inTheMiddle(*model);
  ASSERT_EQ(positions.size(), 3u);
  expectClose(positions[0], { 0, 0, 0.5 });
}

TEST(ColladaMeaning, TheNodeOfAChannelsIdMovesWhateverOthersAreNamed)
{
  const std::string text =
    dae("<node id='a' name='part'><translate sid='t'>5 0 0</translate>" + instance + "</node><node id='x' name='b'>" +
          "<translate sid='t'>6 0 0</translate>" + instance +
          "</node><node id='b' name='part'><translate sid='t'>7 0 0</translate>" + instance + "</node>",
      animation("b/t.Z"));
  const auto model = readBytes("dae", text);
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_THAT(partsOf(*model), ElementsAre("part", "b", "part"));
  const auto positions = inTheMiddle(*model);
  ASSERT_EQ(positions.size(), 9u);
  expectClose(positions[0], { 5, 0, 0 });
  expectClose(positions[3], { 6, 0, 0 });
  expectClose(positions[6], { 7, 0, 0.5 });
}

TEST(ColladaMeaning, SkinsFollowJointsWithoutNames)
{
  for (const std::string names : { "", " id='r'", " name='j'", " name='j' id='r'" })
  {
    const auto model = readBytes("dae",
      dae("<node id='z' name='j'/><node" + names +
            " sid='j' type='JOINT'><translate>0 0 2</translate></node><node id='d' name='d'>" + drawnSkin + "</node>",
        skin()));
    EXPECT_EQ(model->boundsMin, Eigen::Vector3d(0, 0, 2)) << names;
    EXPECT_EQ(model->boundsMax, Eigen::Vector3d(1, 1, 2)) << names << ": without a bind_shape_matrix";
    EXPECT_TRUE(model->warnings.empty()) << names;
  }
}

TEST(ColladaMeaning, SkinsHaveTheirOwnPlaceOfTheShape)
{
  const auto model =
    readBytes("dae", dae("<node id='r' sid='j' type='JOINT'/><node id='d'>" + drawnSkin + "</node>",
                       skin("<bind_shape_matrix>1 0 0 4 0 1 0 5 0 0 1 6 0 0 0 1</bind_shape_matrix>")));
  EXPECT_EQ(model->boundsMin, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(model->boundsMax, Eigen::Vector3d(5, 6, 6));
}

TEST(ColladaMeaning, SeveralJointsOfOneSidHaveAWarning)
{
  const auto model = readBytes("dae",
    dae("<node id='r' sid='j' type='JOINT'/><node id='q' sid='j' type='JOINT'/><node id='d'>" + drawnSkin + "</node>",
      skin()));
  EXPECT_THAT(model->warnings, ElementsAre("several joints have the same sid: skins follow the first one"));
}

TEST(ColladaMeaning, AxesHaveAnyLength)
{
  const double c = std::cos(M_PI / 6);
  for (const std::string axis : { "0 0 1", "0 0 2", " 0 0.0 1e-3", "0 0 +7.5e3" })
  {
    const auto model =
      readBytes("dae", dae("<node id='a' name='a'><rotate>" + axis + " 30</rotate>" + instance + "</node>"));
    expectClose(model->boundsMax, { c, c, 0 });
    expectClose(model->boundsMin, { -0.5, 0, 0 });
  }
}

/// A place that looks along x, its upper side leaning: y is up, z points back.
TEST(ColladaMeaning, TheUpperSideOfAPlaceNeedNotBePerpendicular)
{
  for (const std::string up : { "0 1 0", "3 4 0" })
  {
    const auto model =
      readBytes("dae", dae("<node id='a' name='a'><lookat>1 2 3 5 2 3 " + up + "</lookat>" + instance + "</node>"));
    expectClose(model->boundsMin, { 1, 2, 3 });
    expectClose(model->boundsMax, { 1, 3, 4 });
  }
}

TEST(ColladaMeaning, MaterialsSayWhichTextureCoordinatesTheyHave)
{
  struct Row
  {
    const char* channel;
    const char* other; ///< set of coordinates that are all 0.25, or ""
    const char* set;   ///< that of the drawn ones
  };
  for (const Row& row : { Row{ "UV", "", "0" }, { "UV", "0", "1" }, { "UV", "1", "0" }, { "UV", "3", "7" },
         { "CHANNEL1", "", "0" }, { "CHANNEL1", "", "1" }, { "CHANNEL1", "0", "1" }, { "CHANNEL1", "1", "0" } })
  {
    const std::string effect =
      std::string("<library_images><image id='i'><init_from>i.png</init_from></image></library_images>"
                  "<library_effects><effect id='e'><profile_COMMON><newparam sid='u'><surface type='2D'>"
                  "<init_from>i</init_from></surface></newparam><newparam sid='w'><sampler2D><source>u</source>"
                  "</sampler2D></newparam><technique sid='c'><lambert><diffuse><texture texture='w' texcoord='") +
      row.channel +
      "'/></diffuse></lambert></technique></profile_COMMON></effect></library_effects><library_materials>"
      "<material id='M'><instance_effect url='#e'/></material></library_materials>";
    const std::string bound =
      std::string("<instance_geometry url='#g'><bind_material><technique_common><instance_material symbol='m' "
                  "target='#M'><bind_vertex_input semantic='") +
      row.channel + "' input_semantic='TEXCOORD' input_set='" + row.set +
      "'/></instance_material></technique_common></bind_material></instance_geometry>";
    const bool hasOther = row.other[0] != '\0';
    const std::string other =
      hasOther ? std::string("<input semantic='TEXCOORD' source='#f' offset='1' set='") + row.other + "'/>" : "";
    const auto model = readBytes(
      "dae", dae("<node id='a' name='a'>" + bound + "</node>", effect,
               source("t", "float", 3, 2, "0 0 1 0 0.5 1") + source("f", "float", 3, 2, ".25 .25 .25 .25 .25 .25"),
               other + "<input semantic='TEXCOORD' source='#t' offset='1' set='" + row.set + "'/>", "0 0 1 1 2 2"));
    const std::string text = std::string(row.channel) + ' ' + row.other + ' ' + row.set;
    ASSERT_EQ(model->uvs.size(), 3u) << text;
    EXPECT_NEAR(model->uvs[1].x(), 1, 1e-6) << text;
    EXPECT_NEAR(model->uvs[2].x(), 0.5, 1e-6) << text;
  }
}

TEST(ColladaMeaning, ShadingModelsReflectNothingButWhatTheySay)
{
  const auto material = [](const std::string& shading)
  {
    const auto model = readBytes(
      "dae", dae("<node><instance_geometry url='#g'><bind_material><technique_common><instance_material symbol='m' "
                 "target='#M'/></technique_common></bind_material></instance_geometry></node>",
               "<library_effects><effect id='e'><profile_COMMON><technique sid='t'>" + shading +
                 "</technique></profile_COMMON></effect></library_effects><library_materials><material id='M'>"
                 "<instance_effect url='#e'/></material></library_materials>"));
    return model->materials.at(std::size_t(model->parts.at(0).material));
  };
  const Eigen::Vector3d black(0, 0, 0);
  const Eigen::Vector3d half(0.5, 0.25, 1);
  const auto part = [](const std::string& name)
  { return '<' + name + "><color>0.5 0.25 1 1</color></" + name + ">\n"; };
  for (const std::string model : { "lambert", "phong", "blinn" })
  {
    const dgtk::Material bare = material("<" + model + ">" + part("diffuse") + "</" + model + ">");
    EXPECT_EQ(bare.diffuse, half) << model;
    EXPECT_EQ(bare.ambient, black) << model;
    EXPECT_EQ(bare.specular, black) << model;
    const dgtk::Material full = material("<" + model + ">" + part("ambient") + part("specular") +
                                         "<shininess><float>7</float></shininess></" + model + ">");
    EXPECT_EQ(full.ambient, half) << model;
    EXPECT_EQ(full.specular, half) << model;
    EXPECT_EQ(full.shininess, 7) << model;
  }
  for (const std::string& glow : { "<constant>" + part("emission") + "</constant>", std::string("<constant/>") })
  {
    const dgtk::Material constant = material(glow);
    EXPECT_EQ(constant.diffuse, black) << glow;
    EXPECT_EQ(constant.ambient, black) << glow;
    EXPECT_EQ(constant.specular, black) << glow;
    EXPECT_EQ(constant.emission, glow == "<constant/>" ? black : half);
  }
}

TEST(ColladaMeaning, NodesWithoutMeshesDrawNothing)
{
  std::string text = dae("<node id='a' name='a'><node id='b' name='b'><translate>1 0 0</translate></node></node>");
  EXPECT_EQ(readBytes("dae", text)->triangles.size(), 0u);
  const std::size_t begin = text.find("<library_geometries>");
  text.erase(begin, text.find("<library_visual_scenes>") - begin);
  EXPECT_EQ(readBytes("dae", text)->triangles.size(), 0u);
}

TEST(ColladaMeaning, WhatIsNotReadIsSaid)
{
  const std::string node = "<node id='a' name='a'><translate sid='t'>0 0 0</translate>" + instance + "</node>";
  EXPECT_TRUE(readBytes("dae", dae(node, animation("a/t.Z")))->warnings.empty());
  for (const char* const between : { "STEP", "BEZIER", "HERMITE" })
  {
    EXPECT_THAT(readBytes("dae", dae(node, animation("a/t.Z", between)))->warnings,
      ElementsAre("steps and curves between keys of animations are played as straight lines"));
  }
  EXPECT_THAT(refusal("dae", dae("<node id='a' name='a'><skew>30 1 0 0 0 1 0</skew>" + instance + "</node>")),
    HasSubstr("cannot be read: skewed nodes are not read"));
  EXPECT_THAT(refusal("dae", dae(node, "<library_controllers><controller id='c'><morph source='#g'/></controller>"
                                       "</library_controllers>")),
    HasSubstr("cannot be read: morph controllers are not read"));
  std::string holed = dae(node);
  holed.replace(holed.find("<p>"), 12, "<ph><p>0 1 2</p><h>0 1 2</h></ph>");
  EXPECT_THAT(refusal("dae", holed), HasSubstr("cannot be read: polygons with holes (<ph>) are not read"));
}

TEST(ColladaMeaning, WhatStandsBesideTheModelIsPassedOver)
{
  const std::string node = "<node id='a' name='a'><rotate>0 0 2 90</rotate>" + instance + "</node>";
  const std::string more = "<extra><extra/><technique profile='x'><skew>30</skew><h>0</h><morph/></technique></extra>";
  std::string text = dae(node, "<library_animations/>" + more);
  text.insert(text.find("<COLLADA"), "<!DOCTYPE COLLADA [ <!-- Bob's --> <!ENTITY e '>' > ]>");
  const auto model = readBytes("dae", text);
  EXPECT_THAT(model->warnings, ElementsAre());
  ASSERT_EQ(model->triangles.size(), 1u);
  EXPECT_NEAR(model->boundsMax.x(), 0, 1e-6); // turned, and not stretched
  EXPECT_NEAR(model->boundsMax.y(), 1, 1e-6);
}

namespace
{
/// A quarter turn in a second, of each of the targets.
std::string turns(const std::vector<std::string>& targets)
{
  std::string text = "<library_animations>";
  for (std::size_t i = 0; i < targets.size(); ++i)
  {
    const std::string n = std::to_string(i);
    text += "<animation id='A" + n + "'>" + source("i" + n, "float", 2, 1, "0 1") +
            source("o" + n, "float", 2, 1, "0 90") + source("n" + n, "Name", 2, 1, "LINEAR LINEAR") + "<sampler id='S" +
            n + "'><input semantic='INPUT' source='#i" + n + "'/><input semantic='OUTPUT' source='#o" + n +
            "'/><input semantic='INTERPOLATION' source='#n" + n + "'/></sampler><channel source='#S" + n +
            "' target='" + targets[i] + "'/></animation>";
  }
  return text + "</library_animations>";
}

const double half = std::sqrt(0.5);

/// A quarter turn about (2, 0, 0).
const std::string pivot = "<translate sid='a'>2 0 0</translate><rotate sid='z'>0 0 1 0</rotate>"
                          "<translate sid='b'>-2 0 0</translate>";

/// What is said of a node that is left as it is.
std::string straight(const std::string& id)
{
  return "node \"" + id + "\" turns about a pivot or several axes: its way between keys is a straight line";
}
} // namespace

TEST(ColladaMeaning, AnimationsThatNoClipNamesAreOneSequence)
{
  // `last` seconds, in which each target goes to 8
  const auto part = [](const std::string& n, const std::string& last, const std::vector<std::string>& targets)
  {
    std::string text = "<animation><animation id='" + n + "'>" + source("i" + n, "float", 2, 1, "0 " + last) +
                       source("o" + n, "float", 2, 1, "0 8") + source("n" + n, "Name", 2, 1, "LINEAR LINEAR");
    for (const std::string& target : targets)
    {
      const std::string sampler = 'S' + n + target[0];
      text += "<sampler id='" + sampler + "'><input semantic='INPUT' source='#i" + n +
              "'/><input semantic='OUTPUT' source='#o" + n + "'/><input semantic='INTERPOLATION' source='#n" + n +
              "'/></sampler><channel source='#" + sampler + "' target='" + target + "'/>";
    }
    return text + "</animation></animation>";
  };
  std::string nodes;
  for (const std::string id : { "a", "b", "c" })
  {
    nodes += "<node id='" + id + "'><translate sid='t'>0 0 0</translate>" + instance + "</node>";
  }
  const std::string animations = "<library_animations><animation id='none'/>" + part("1", "1", { "a/t.X", "b/t.X" }) +
                                 part("2", "2", { "a/t.Z" }) + part("3", "4", { "b/t.Y", "c/t.Y" }) +
                                 "</library_animations>";
  const auto model = readBytes("dae", dae(nodes, animations));
  ASSERT_EQ(model->animations.size(), 1u);
  EXPECT_EQ(model->animations[0].last, 4 * model->animations[0].fps);
  const auto p = inTheMiddle(*model);
  ASSERT_EQ(p.size(), 9u);
  expectClose(p[0], { 4, 0, 2 });
  expectClose(p[3], { 4, 1, 0 });
  expectClose(p[6], { 0, 1, 0 });
  const std::string clips = "<library_animation_clips><animation_clip id='first'><instance_animation url='#1'/>"
                            "</animation_clip><animation_clip id='other'><instance_animation url='#3'/>"
                            "</animation_clip></library_animation_clips>";
  EXPECT_EQ(readBytes("dae", dae(nodes, clips + animations))->animations.size(), 3u); // as they stand
}

TEST(ColladaMeaning, WhatTurnsAboutAPivotStaysAtItsDistance)
{
  const std::string nodes = "<node id='n' name='Door'><translate sid='a'>2 0 0</translate>"
                            "<rotate sid='z'>0 0 1 0</rotate><translate sid='b'>-2 0 0</translate><extra/>" +
                            instance + "<node id='child' name='Knob'>" + instance + "</node></node>";
  const auto model = readBytes("dae", dae(nodes, turns({ "n/z.ANGLE" })));
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_THAT(partsOf(*model), ElementsAre("Door", "Knob"));
  EXPECT_THAT(model->warnings, testing::IsEmpty());
  const auto p = inTheMiddle(*model);
  ASSERT_EQ(p.size(), 6u);
  expectClose(p[0], { 2 - 2 * half, -2 * half, 0 });
  expectClose(p[1], { 2 - half, -half, 0 });
  expectClose(p[3], p[0]);
}

TEST(ColladaMeaning, TurnsAboutSeveralAxesAreThoseOfTheirAngles)
{
  const std::string axes = "<rotate sid='z'>0 0 1 0</rotate><rotate sid='x'>1 0 0 0</rotate>";
  const auto expectTurned = [](const dgtk::Model& model)
  {
    const auto p = inTheMiddle(model);
    ASSERT_EQ(p.size(), 3u);
    expectClose(p[1], { half, half, 0 });
    expectClose(p[2], { -0.5, 0.5, half });
  };
  expectTurned(
    *readBytes("dae", dae("<node id='n'>" + axes + instance + "</node>", turns({ "n/z.ANGLE", "n/x.ANGLE" }))));
  // a skin finds its joint
  const auto skinned = readBytes(
    "dae", dae("<node id='r' sid='j' name='Joint' type='JOINT'>" + axes + "</node><node>" + drawnSkin + "</node>",
             turns({ "r/z.ANGLE", "r/x.ANGLE" }) + skin()));
  expectTurned(*skinned);
}

TEST(ColladaMeaning, WhatElseANodeSaysStaysAsItIs)
{
  const std::string place = "<translate sid='t'>0 0 0</translate><rotate sid='z'>0 0 1 0</rotate>";
  const auto both = inTheMiddle(
    *readBytes("dae", dae("<node id='n'>" + place + instance + "</node>", turns({ "n/t.Y", "n/z.ANGLE" }))));
  ASSERT_EQ(both.size(), 3u);
  expectClose(both[1], { half, 45 + half, 0 });
  // a node that others stand for cannot be taken apart
  const std::string twice = "<node id='n'><rotate sid='z'>0 0 1 0</rotate><translate>1 0 0</translate>" + instance +
                            "</node><node><instance_node url='#n'/></node>";
  EXPECT_THAT(readBytes("dae", dae(twice, turns({ "n/z.ANGLE" })))->warnings, ElementsAre(straight("n")));
}

TEST(ColladaMeaning, IdsOfWhatTurnsHaveQuotes)
{
  const auto model =
    readBytes("dae", dae("<node id='n\"x'>" + pivot + instance + "</node>", turns({ "n\"x/z.ANGLE" })));
  const auto p = inTheMiddle(*model);
  ASSERT_EQ(p.size(), 3u);
  expectClose(p[0], { 2 - 2 * half, -2 * half, 0 });
}

/// Where taking it apart would leave what it draws outside, or write a long id many times.
TEST(ColladaMeaning, SomeNodesThatTurnAreLeftAsTheyAre)
{
  for (const std::string& content : { instance, std::string("<node id='c'>") + instance + "</node>" })
  {
    const auto model = readBytes("dae", dae("<node id='n'>" + content + pivot + "</node>", turns({ "n/z.ANGLE" })));
    EXPECT_THAT(model->warnings, ElementsAre(straight("n")));
    const auto p = inTheMiddle(*model);
    ASSERT_EQ(p.size(), 3u);
    expectClose(p[0], { 1, -1, 0 });
  }
  for (const std::size_t length : { 1000, 1001 })
  {
    const std::string id(length, 'n');
    const auto model =
      readBytes("dae", dae("<node id='" + id + "'>" + pivot + instance + "</node>", turns({ id + "/z.ANGLE" })));
    EXPECT_EQ(model->warnings.size(), length - 1000);
    EXPECT_THAT(model->warnings, testing::Each(straight(id.substr(0, 200))));
  }
}

TEST(ColladaMeaning, TheMotionOfNodesInLibrariesIsNotRead)
{
  const std::string turn = "<rotate sid='z'>0 0 1 0</rotate>";
  const auto warnings = [](const std::string& nodes, const std::string& target)
  {
    return readBytes("dae",
      dae("<node><instance_node url='#l'/></node>", "<library_nodes>" + nodes + "</library_nodes>" + turns({ target })))
      ->warnings;
  };
  const auto unread = ElementsAre("node \"n\" of library_nodes moves: its motion is not read");
  for (const std::string& transforms : { pivot, turn })
  {
    const std::string content = transforms + instance + "</node>";
    EXPECT_THAT(warnings("<node id='l'>" + content, "l/z.ANGLE"),
      ElementsAre("node \"l\" of library_nodes moves: its motion is not read"));
    EXPECT_THAT(warnings("<node id='l'><node id='n'>" + content + "</node>", "n/z.ANGLE"), unread);
    EXPECT_THAT(warnings("<node id='l'>" + content, "l/other"), testing::IsEmpty());
  }
  // beside such libraries nodes move
  const auto model = readBytes("dae", dae("<node id='n'>" + pivot + instance + "</node>",
                                        "<library_nodes/><library_nodes></library_nodes>" + turns({ "n/z.ANGLE" })));
  EXPECT_THAT(model->warnings, testing::IsEmpty());
}

TEST(ColladaMeaning, WhatTurnsInsideASizeIsSkewed)
{
  const std::string turn = "<rotate sid='z'>0 0 1 0</rotate>";
  const std::string size = "<scale>2 1 1</scale>";
  const std::string matrix = "<matrix>2 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>";
  for (const std::string& transforms : { size + turn, matrix + turn, size + "<rotate>0 0 1 0</rotate>" + turn })
  {
    const auto model =
      readBytes("dae", dae("<node id='n'>" + transforms + instance + "</node>", turns({ "n/z.ANGLE" })));
    EXPECT_THAT(model->warnings, testing::IsEmpty());
    const auto p = inTheMiddle(*model);
    ASSERT_EQ(p.size(), 3u);
    expectClose(p[1], { 2 * half, half, 0 });
    expectClose(p[2], { -2 * half, half, 0 });
  }
  // a size inside a turn is none, unless another turn is inside it
  const auto model = readBytes("dae",
    dae("<node id='n'>" + turn + size + "<rotate>0 0 1 45</rotate>" + instance + "</node>", turns({ "n/z.ANGLE" })));
  const auto p = inTheMiddle(*model);
  ASSERT_EQ(p.size(), 3u);
  expectClose(p[1], { 0.5, 1.5, 0 });
}
