// SPDX-License-Identifier: BSD-3-Clause
// What pictures of Collada files drive, where they lie, and how they go on.
#include "dgtkFile.h"
#include "dgtkModelChecks.h"
#include "dgtkModelReader.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

using namespace dgtk::test;
using testing::ElementsAre;
using testing::IsEmpty;

namespace
{
const std::string black = "<color>0 0 0 1</color>";
const std::string unreadPlaces = "material \"m\" has pictures in several places: all lie where the first does";

std::string pictureOf(const std::string& sampler, const std::string& channel = "UV", const std::string& extra = {})
{
  return "<texture texture='" + sampler + "' texcoord='" + channel + "'" + (extra.empty() ? "/>" : '>' + extra) +
         (extra.empty() ? "" : "</texture>");
}

std::string mayasWords(const std::string& said)
{
  return "<extra><technique profile='MAYA'>" + said + "</technique></extra>";
}

/// An image, its surface (of the image's id and an s) and its sampler, with what it says.
std::string parametersOf(const std::string& image, const std::string& sampler, const std::string& said = {})
{
  return "<newparam sid='" + image + "s'><surface type='2D'><init_from>" + image + "</init_from></surface></newparam>" +
         "<newparam sid='" + sampler + "'><sampler2D><source>" + image + "s</source>" + said +
         "</sampler2D></newparam>";
}

const std::string both = parametersOf("own", "a") + parametersOf("other", "b");

/// A triangle whose corners have (0.25, 0.5) of set 0 and (0.75, 1) of set 1, and the images own.ppm and other.tga.
std::string paintedDae(const std::string& phong, const std::string& parameters = both, const std::string& extra = {},
  const std::string& bindings = {}, const std::string& version = "1.4.1", const std::string& open = {},
  const std::string& close = {})
{
  const auto coordinates = [](const std::string& id, const std::string& uv)
  {
    return "<source id='" + id + "'><float_array id='" + id + "a' count='2'>" + uv +
           "</float_array><technique_common><accessor source='#" + id +
           "a' count='1' stride='2'><param name='S' type='float'/><param name='T' type='float'/></accessor>"
           "</technique_common></source>";
  };
  const auto image = [&](const std::string& id, const std::string& name)
  { return "<image id='" + id + "'><init_from>" + open + name + close + "</init_from></image>"; };
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='" + version +
         "'><library_images>" + image("own", "own.ppm") + image("other", "other.tga") +
         "</library_images><library_effects><effect id='e'><profile_COMMON>" + parameters +
         "<technique sid='c'><phong>" + phong + "</phong>" + extra +
         "</technique></profile_COMMON></effect></library_effects><library_materials><material id='m' name='m'>"
         "<instance_effect url='#e'/></material></library_materials><library_geometries><geometry id='g'><mesh>"
         "<source id='p'><float_array id='pa' count='9'>0 0 0 1 0 0 0 1 0</float_array><technique_common>"
         "<accessor source='#pa' count='3' stride='3'><param name='X' type='float'/><param name='Y' type='float'/>"
         "<param name='Z' type='float'/></accessor></technique_common></source>" +
         coordinates("t", "0.25 0.5") + coordinates("u", "0.75 1") +
         "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices><triangles material='m' count='1'>"
         "<input semantic='VERTEX' source='#v' offset='0'/><input semantic='TEXCOORD' source='#t' offset='1' set='0'/>"
         "<input semantic='TEXCOORD' source='#u' offset='1' set='1'/><p>0 0 1 0 2 0</p></triangles></mesh></geometry>"
         "</library_geometries><library_visual_scenes><visual_scene id='s'><node id='n'><instance_geometry url='#g'>"
         "<bind_material><technique_common><instance_material symbol='m' target='#m'>" +
         bindings +
         "</instance_material></technique_common></bind_material></instance_geometry></node></visual_scene>"
         "</library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

/// The same, its pictures decoded. own.ppm: white, black; other.tga: white of alpha 255, black of 255, white of 0.
std::shared_ptr<const dgtk::Model> readPainted(const std::string& text)
{
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("a.dae"), text);
  dgtk::writeFile(folder.path("own.ppm"), std::string("P6\n2 1\n255\n") + "\xff\xff\xff" + std::string(3, '\0'));
  dgtk::writeFile(folder.path("other.tga"), std::string("\0\0\2\0\0\0\0\0\0\0\0\0\3\0\1\0\x20\x28", 18) +
                                              std::string("\xff\xff\xff\xff\0\0\0\xff\xff\xff\xff\0", 12));
  return dgtk::readModel(folder.path("a.dae"));
}

std::vector<int> alphaOfPainted(const std::string& phong)
{
  const auto model = readPainted(paintedDae(phong));
  EXPECT_THAT(model->warnings, IsEmpty());
  EXPECT_EQ(model->materials.at(0).opacity, 1);
  std::vector<int> alpha;
  const dgtk::Texture& texture = model->textures.at(std::size_t(model->materials.at(0).texture));
  for (std::size_t i = 3; texture.image && i < texture.image->rgba.size(); i += 4)
  {
    alpha.push_back(texture.image->rgba[i]);
  }
  return alpha;
}

std::string nameOf(const dgtk::Model& model, int texture)
{
  return texture < 0 ? std::string() : model.textures.at(std::size_t(texture)).name;
}

Eigen::Vector2d placeOfFirst(const dgtk::Model& model) { return model.uvs.at(model.triangles.at(0)[0]); }
} // namespace

TEST(ColladaPictures, WhatGlowsByAPicture)
{
  const auto model =
    readBytes("dae", paintedDae("<emission>" + pictureOf("b") + "</emission><diffuse>" + black + "</diffuse>"));
  EXPECT_EQ(brokenPromise(*model), "");
  const dgtk::Material& material = model->materials.at(0);
  EXPECT_EQ(material.emission, Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(material.diffuse, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(nameOf(*model, material.emissionMap), "other.tga");
  EXPECT_EQ(material.texture, -1);
  EXPECT_EQ(placeOfFirst(*model), Eigen::Vector2d(0.25, 0.5));
}

TEST(ColladaPictures, ThoseThatAreNotDrawnLightNothing)
{
  const std::string diffuse = "<diffuse>" + pictureOf("a") + "</diffuse>";
  const std::string shines = "<shininess><float>20</float></shininess>";
  for (const std::string name : { "ambient", "specular", "reflective" })
  {
    const auto model =
      readBytes("dae", paintedDae('<' + name + '>' + pictureOf("b") + "</" + name + '>' + diffuse + shines));
    EXPECT_THAT(model->warnings, testing::Contains("pictures of \"" + name + "\" are not drawn"));
    EXPECT_EQ(model->materials.at(0).ambient, Eigen::Vector3d(0, 0, 0)) << name;
    EXPECT_EQ(model->materials.at(0).specular, Eigen::Vector3d(0, 0, 0)) << name;
    EXPECT_EQ(nameOf(*model, model->materials.at(0).texture), "own.ppm");
  }
  const std::string bump =
    "<extra><technique profile='FCOLLADA'><bump>" + pictureOf("b") + "</bump></technique></extra>";
  EXPECT_THAT(readPainted(paintedDae(diffuse + "<specular>" + pictureOf("b") + "</specular>", both, bump))->warnings,
    ElementsAre("pictures of \"bump\", \"specular\" are not drawn"));
}

TEST(ColladaPictures, AmbientLightOfThePictureOfColour)
{
  const auto model =
    readPainted(paintedDae("<ambient>" + pictureOf("a") + "</ambient><diffuse>" + pictureOf("a") + "</diffuse>"));
  EXPECT_THAT(model->warnings, IsEmpty());
  EXPECT_EQ(model->materials.at(0).ambient, Eigen::Vector3d(1, 1, 1)) << "times the picture";
}

TEST(ColladaPictures, Masks)
{
  const std::string color = "<diffuse>" + pictureOf("a") + "</diffuse>";
  EXPECT_THAT(alphaOfPainted(color + "<transparent>" + pictureOf("b") + "</transparent>"), ElementsAre(255, 255, 0));
  EXPECT_THAT(alphaOfPainted("<transparent opaque='A_ONE'>" + pictureOf("a") + "</transparent>"), ElementsAre(255, 0))
    << "it has no alpha";
  EXPECT_THAT(alphaOfPainted(color + "<transparent opaque='RGB_ONE'>" + pictureOf("b") + "</transparent>"),
    ElementsAre(255, 0, 255));
  EXPECT_THAT(
    alphaOfPainted(color + "<transparent opaque='A_ONE'>" + pictureOf("a") + "</transparent>"), ElementsAre(255, 255))
    << "its own alpha counts";
}

TEST(ColladaPictures, MasksOfWhatIsNotThere)
{
  const std::string color = "<diffuse>" + pictureOf("a") + "</diffuse>";
  for (const std::string& extra : { std::string(), mayasWords("<weighting>1</weighting>") })
  {
    const auto alphaOf = [&](const std::string& opaque, const std::string& picture)
    {
      return alphaOfPainted(
        color + "<transparent opaque='" + opaque + "'>" + pictureOf(picture, "UV", extra) + "</transparent>");
    };
    EXPECT_THAT(alphaOf("A_ZERO", "b"), ElementsAre(0, 0, 255));
    EXPECT_THAT(alphaOf("RGB_ZERO", "b"), ElementsAre(0, 255, 0));
    EXPECT_THAT(alphaOf("RGB_ZERO", "a"), ElementsAre(0, 255)) << "that of its colour, too";
  }
  const auto alphaBeside = [&](const std::string& transparency)
  {
    return alphaOfPainted(color + "<transparent opaque='RGB_ZERO'>" + pictureOf("b") +
                          "</transparent><transparency><float>" + transparency + "</float></transparency>");
  };
  EXPECT_THAT(alphaBeside("1"), ElementsAre(0, 255, 0));
  EXPECT_THAT(alphaBeside("0.25"), ElementsAre(191, 255, 191)) << "times the mask";
  EXPECT_THAT(alphaBeside("0"), ElementsAre(255, 255)) << "its own alpha counts";
}

TEST(ColladaPictures, LongNamesAndManyWordsDoNotGrow)
{
  const std::string color = "<diffuse>" + pictureOf("a") + "</diffuse>";
  std::string words;
  for (int i = 0; i < 20000; ++i)
  {
    words += "<wrap_s>CLAMP</wrap_s><wrap_s>MIRROR</wrap_s>";
  }
  std::string many;
  for (int i = 0; i < 2000; ++i)
  {
    many += "<texture texture='a' texcoord='UV'/>";
  }
  const auto model = readBytes("dae", paintedDae(color, parametersOf("own", "a", words),
                                        "<extra><technique profile='X'>" + many + "</technique></extra>"));
  EXPECT_EQ(model->textures.at(0).wrap, (dgtk::TextureWraps{ dgtk::TextureWrap::Mirror, dgtk::TextureWrap::Repeat }));
  const std::string longName(100000, 'x');
  readBytes("dae", paintedDae(color, parametersOf(longName, "a", ""),
                     "<extra><technique profile='X'>" + many + "</technique></extra>"));
}

TEST(ColladaPictures, SamplersSayHowTheyGoOn)
{
  using Wrap = dgtk::TextureWrap;
  const auto wrapOf = [](const std::string& said, const std::string& extra = {})
  {
    const auto model = readBytes(
      "dae", paintedDae("<diffuse>" + pictureOf("a", "UV", extra) + "</diffuse>", parametersOf("own", "a", said)));
    return model->textures.at(0).wrap;
  };
  const std::pair<const char*, Wrap> all[] = { { "WRAP", Wrap::Repeat }, { "MIRROR", Wrap::Mirror },
    { "CLAMP", Wrap::Clamp }, { "BORDER", Wrap::Clamp }, { "NONE", Wrap::Clamp } };
  for (const auto& [word, wrap] : all)
  {
    const std::string name = word;
    EXPECT_THAT(wrapOf("<wrap_s>" + name + "</wrap_s>"), ElementsAre(wrap, Wrap::Repeat)) << name;
    EXPECT_THAT(wrapOf("<wrap_s>CLAMP</wrap_s><wrap_t> " + name + " </wrap_t>"), ElementsAre(Wrap::Clamp, wrap))
      << name;
  }
  EXPECT_THAT(wrapOf("<wrap_s>CLAMP</wrap_s>", mayasWords("<wrapU>1</wrapU><mirrorU>1</mirrorU>")),
    ElementsAre(Wrap::Mirror, Wrap::Repeat))
    << "the picture's own word";
}

TEST(ColladaPictures, ParametersOfTheNamesOfImages)
{
  const std::string sampler = "<sampler2D><source>s</source></sampler2D></newparam>";
  const auto model = readBytes("dae",
    paintedDae("<diffuse>" + pictureOf("own") + "</diffuse>",
      "<newparam sid='s'><surface type='2D'><init_from>own</init_from></surface></newparam><newparam sid='own'>" +
        sampler));
  EXPECT_EQ(nameOf(*model, model->materials.at(0).texture), "own.ppm");
  EXPECT_EQ(nameOf(*readBytes("dae", paintedDae("<diffuse>" + pictureOf("other") + "</diffuse>")), 0), "other.tga")
    << "none at all";
}

TEST(ColladaPictures, ImagesOfVersion15)
{
  const std::string parameters =
    "<newparam sid='own'><sampler2D><instance_image url='#own'/><wrap_t>CLAMP</wrap_t></sampler2D></newparam>";
  for (const std::string version : { "1.5.0", "1.4.1" })
  {
    const auto model = readBytes(
      "dae", paintedDae("<diffuse>" + pictureOf("own") + "</diffuse>", parameters, "", "", version, "<ref>", "</ref>"));
    ASSERT_EQ(model->textures.size(), 1u);
    EXPECT_EQ(model->textures[0].name, "own.ppm");
    EXPECT_EQ(model->textures[0].wrap[1], dgtk::TextureWrap::Clamp);
  }
}

TEST(ColladaPictures, MayasPlaces)
{
  const auto placed = [](const std::string& said, const std::string& beside)
  {
    return readPainted(paintedDae("<emission>" + pictureOf("b", "UV", mayasWords(beside)) + "</emission><diffuse>" +
                                  pictureOf("a", "UV", mayasWords(said)) + "</diffuse>"));
  };
  const std::string said = "<repeatU>2</repeatU><repeatV>4</repeatV><offsetU>0.25</offsetU><offsetV>-1</offsetV>";
  const auto model = placed(said, said);
  EXPECT_THAT(model->warnings, IsEmpty());
  EXPECT_EQ(placeOfFirst(*model), Eigen::Vector2d(0.75, 1));
  const auto apart = placed("<offsetU>0.5</offsetU>", "<offsetU>1</offsetU>");
  EXPECT_THAT(apart->warnings, ElementsAre(unreadPlaces));
  EXPECT_EQ(placeOfFirst(*apart), Eigen::Vector2d(0.75, 0.5));
  EXPECT_THAT(placed("<repeatU>2</repeatU>", "<repeatU>1</repeatU>")->warnings, ElementsAre(unreadPlaces));
  const auto turned = placed("<rotateUV>0.5</rotateUV>", "");
  EXPECT_THAT(turned->warnings, ElementsAre("material \"m\" turns its pictures: they are drawn without that"));
  EXPECT_EQ(placeOfFirst(*turned), Eigen::Vector2d(0.25, 0.5));
}

TEST(ColladaPictures, SetsOfCoordinatesOfThoseThatGlow)
{
  const auto bound = [](const std::string& channel, int set)
  {
    return "<bind_vertex_input semantic='" + channel + "' input_semantic='TEXCOORD' input_set='" + std::to_string(set) +
           "'/>";
  };
  const std::string glows = "<emission>" + pictureOf("b", "E") + "</emission>";
  const auto alone = readPainted(paintedDae(glows, both, "", bound("E", 1)));
  EXPECT_THAT(alone->warnings, IsEmpty());
  EXPECT_EQ(placeOfFirst(*alone), Eigen::Vector2d(0.75, 1));
  const std::string paints = glows + "<diffuse>" + pictureOf("a", "D") + "</diffuse>";
  const auto apart = readPainted(paintedDae(paints, both, "", bound("E", 0) + bound("D", 1)));
  EXPECT_THAT(
    apart->warnings, ElementsAre("materials bind their pictures to several sets of texture coordinates: one is drawn"));
  EXPECT_EQ(placeOfFirst(*apart), Eigen::Vector2d(0.75, 1)) << "that of colour";
  const auto together = readPainted(paintedDae(paints, both, "", bound("E", 1) + bound("D", 1)));
  EXPECT_THAT(together->warnings, IsEmpty());
  EXPECT_EQ(placeOfFirst(*together), Eigen::Vector2d(0.75, 1));
}
