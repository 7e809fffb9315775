// SPDX-License-Identifier: BSD-3-Clause
// Pictures that say where a surface is: map_d of Wavefront libraries, opacity maps of 3DS.
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelChecks.h"
#include "dgtkModelSeeds.h"
#include "dgtkTestSupport.h"
#include "dgtkTextureFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace dgtk::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace
{
using Bytes = std::vector<std::uint8_t>;

std::string textOf(const Bytes& bytes) { return { bytes.begin(), bytes.end() }; }

/// Rows of RGB.
std::string ppm(int width, const Bytes& rgb)
{
  return "P6\n" + std::to_string(width) + ' ' + std::to_string(rgb.size() / 3 / std::size_t(width)) + "\n255\n" +
         textOf(rgb);
}

/// One row of RGBA, as a TGA file.
std::string tga(const Bytes& rgba)
{
  Bytes bytes{ 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, std::uint8_t(rgba.size() / 4), 0, 1, 0, 32, 0x28 };
  for (std::size_t i = 0; i < rgba.size(); i += 4)
  {
    bytes.insert(bytes.end(), { rgba[i + 2], rgba[i + 1], rgba[i], rgba[i + 3] });
  }
  return textOf(bytes);
}

/// A model of a triangle for each of `materials`.
class Masks : public testing::Test
{
protected:
  void write(const std::string& name, const std::string& text) { dgtk::writeFile(this->Folder.path(name), text); }
  std::shared_ptr<const dgtk::Model> read(
    const std::string& library, const std::string& materials = "m", const dgtk::ReadOptions& options = {})
  {
    this->write("a.mtl", library);
    std::string text = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.25\n";
    for (const char material : materials)
    {
      text += std::string("usemtl ") + material + "\nf 1/1 2/1 3/1\n";
    }
    this->write("a.obj", text);
    return dgtk::readModel(this->Folder.path("a.obj"), options);
  }
  static const dgtk::Texture& textureOf(const dgtk::Model& model, std::size_t material = 0)
  {
    return model.textures.at(std::size_t(model.materials.at(material).texture));
  }
  static std::vector<int> channel(const dgtk::Texture& texture, std::size_t c)
  {
    std::vector<int> values;
    for (std::size_t i = c; i < texture.image->rgba.size(); i += 4)
    {
      values.push_back(texture.image->rgba[i]);
    }
    return values;
  }
  /// Alpha of what "map_d <statement>" makes of two texels.
  std::vector<int> alphaOf(const std::string& statement)
  {
    return channel(textureOf(*this->read("newmtl m\nmap_Kd own.ppm\nmap_d " + statement + "\n")), 3);
  }

  TemporaryFolder Folder;
};
} // namespace

TEST_F(Masks, CutHolesIntoThePictureOfTheMaterial)
{
  this->write("own.ppm", ppm(2, { 10, 20, 30, 40, 50, 60 }));
  this->write("mask.ppm", ppm(2, { 255, 255, 255, 0, 0, 0 }));
  const auto model = this->read("newmtl m\nmap_Kd own.ppm\nmap_d mask.ppm\n");
  EXPECT_THAT(model->warnings, IsEmpty());
  ASSERT_EQ(model->textures.size(), 3u) << "both, whose files count, and what is made of them";
  const dgtk::Texture& made = textureOf(*model);
  EXPECT_EQ(made.image->rgba, (Bytes{ 10, 20, 30, 255, 40, 50, 60, 0 }));
  EXPECT_TRUE(made.image->hasAlpha);
  EXPECT_TRUE(model->holds(made)) << "it is in no file";
  EXPECT_EQ(made.name, "own.ppm");
  EXPECT_TRUE(model->materials[0].cutOut);
  EXPECT_EQ(model->textures[0].image->rgba[7], 255) << "as its file has it";
}

TEST_F(Masks, AreWhiteWhereTheMaterialHasNoPicture)
{
  this->write("mask.ppm", ppm(2, { 255, 255, 255, 0, 0, 0 }));
  const auto model = this->read("newmtl m\nKd 0.1 0.2 0.3\nmap_d -s 2 4 -clamp on mask.ppm\n");
  EXPECT_EQ(textureOf(*model).image->rgba, (Bytes{ 255, 255, 255, 255, 255, 255, 255, 0 }));
  EXPECT_EQ(textureOf(*model).wrap[0], dgtk::TextureWrap::Clamp);
  expectNear(model->materials[0].diffuse, { 0.1, 0.2, 0.3 });
  EXPECT_EQ(Eigen::Vector2d(model->uvs.at(model->triangles[0][0])), Eigen::Vector2d(1, 1)) << "where the mask lies";
}

TEST_F(Masks, SayByWhichValue)
{
  this->write("own.ppm", ppm(2, { 10, 20, 30, 40, 50, 60 }));
  this->write("mask.ppm", ppm(2, { 200, 100, 50, 0, 250, 0 }));
  this->write("mask.tga", tga({ 200, 100, 50, 255, 0, 250, 0, 25 }));
  EXPECT_THAT(this->alphaOf("mask.ppm"), ElementsAre(118, 179)) << "0.2126 R + 0.7152 G + 0.0722 B";
  EXPECT_THAT(this->alphaOf("mask.tga"), ElementsAre(255, 25)) << "its alpha, where it has one";
  EXPECT_THAT(this->alphaOf("-imfchan r mask.tga"), ElementsAre(200, 0));
  EXPECT_THAT(this->alphaOf("-imfchan g mask.tga"), ElementsAre(100, 250));
  EXPECT_THAT(this->alphaOf("-imfchan b mask.tga"), ElementsAre(50, 0));
  EXPECT_THAT(this->alphaOf("-imfchan m mask.tga"), ElementsAre(255, 25));
  EXPECT_THAT(this->alphaOf("-imfchan l mask.tga"), ElementsAre(118, 179));
  EXPECT_THAT(this->alphaOf("-imfchan b own.ppm"), ElementsAre(30, 60)) << "of its own picture";
}

TEST_F(Masks, OfAnotherSizeAreInterpolated)
{
  this->write("own.ppm", ppm(1, { 0, 0, 0, 100, 0, 0 }));
  this->write("mask.ppm", ppm(4, { 0, 0, 0, 255, 255, 255, 0, 0, 0, 255, 255, 255 }));
  const auto wide = this->read("newmtl m\nmap_Kd own.ppm\nmap_d mask.ppm\n");
  EXPECT_EQ(textureOf(*wide).image->width, 4);
  EXPECT_EQ(textureOf(*wide).image->height, 2);
  EXPECT_THAT(channel(textureOf(*wide), 3), ElementsAre(0, 255, 0, 255, 0, 255, 0, 255));
  EXPECT_THAT(channel(textureOf(*wide), 0), ElementsAre(0, 0, 0, 0, 100, 100, 100, 100));
  this->write("mask.ppm", ppm(1, { 0, 0, 0, 200, 200, 200 }));
  this->write("own.ppm", ppm(1, Bytes(std::size_t(3) * 4, 9)));
  EXPECT_THAT(this->alphaOf("mask.ppm"), ElementsAre(0, 50, 150, 200)) << "between the middles of the texels";
}

TEST_F(Masks, OneOfItsOwnNameIsItsAlpha)
{
  this->write("own.tga", tga({ 1, 2, 3, 255, 4, 5, 6, 0 }));
  const auto model = this->read("newmtl m\nmap_Kd own.tga\nmap_d own.tga\n");
  ASSERT_EQ(model->textures.size(), 1u);
  EXPECT_TRUE(model->materials[0].cutOut);
  this->write("own.ppm", ppm(1, { 0, 0, 0 }));
  EXPECT_FALSE(this->read("newmtl m\nmap_Kd own.ppm\nmap_d own.ppm\n")->materials[0].cutOut) << "black is no hole";
}

TEST_F(Masks, AreMadeOnceAndTakenFromTheBudget)
{
  this->write("own.ppm", ppm(2, { 10, 20, 30, 40, 50, 60 }));
  this->write("mask.ppm", ppm(2, { 255, 255, 255, 0, 0, 0 }));
  const std::string both = "map_Kd own.ppm\nmap_d mask.ppm\n";
  const std::string library = "newmtl m\n" + both + "newmtl n\n" + both + "newmtl o\nmap_d mask.ppm\nnewmtl p\n" +
                              both + "map_d -imfchan r mask.ppm\n";
  const auto model = this->read(library, "mnop");
  EXPECT_EQ(model->textures.size(), 5u);
  EXPECT_EQ(model->materials[0].texture, model->materials[1].texture);
  EXPECT_EQ(
    std::set<int>({ model->materials[0].texture, model->materials[2].texture, model->materials[3].texture }).size(),
    3u);
  dgtk::ReadOptions options;
  options.textures = std::make_shared<dgtk::TextureStore>(24); // 8 bytes each
  EXPECT_NO_THROW(this->read("newmtl m\n" + both, "m", options));
  options.textures = std::make_shared<dgtk::TextureStore>(23);
  EXPECT_THAT(thrownBy<dgtk::MachineError>([&] { this->read("newmtl m\n" + both, "m", options); }),
    HasSubstr("mask.ppm: a texture of 2 x 1 pixels"));
}

TEST_F(Masks, ThatAreMissingOrNotWantedCutNothing)
{
  this->write("own.ppm", ppm(2, { 10, 20, 30, 40, 50, 60 }));
  const auto model = this->read("newmtl m\nmap_Kd own.ppm\nmap_d mask.ppm\n");
  EXPECT_THAT(model->warnings, ElementsAre(HasSubstr("texture 'mask.ppm' not found")));
  EXPECT_EQ(model->materials[0].texture, 0);
  EXPECT_FALSE(model->materials[0].cutOut);
  this->write("mask.ppm", ppm(2, { 255, 255, 255, 0, 0, 0 }));
  dgtk::ReadOptions options;
  options.decodeTextures = false;
  EXPECT_EQ(this->read("newmtl m\nmap_Kd own.ppm\nmap_d mask.ppm\n", "m", options)->textures.size(), 2u);
}

TEST_F(Masks, OpacityMapsOf3ds)
{
  const auto text = [](const std::string& value) { return value + '\0'; };
  const auto map = [&text](const std::string& name) { return chunk3ds(0xa300, text(name)) + chunk3ds(0xa356, f32(3)); };
  this->write("OWN.PPM", ppm(2, { 10, 20, 30, 40, 50, 60 }));
  this->write("MASK.PPM", ppm(2, { 255, 255, 255, 0, 0, 0 }));
  const auto model = [&](const std::string& maps)
  {
    std::string corners = u16(3);
    for (const float v : { 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F })
    {
      corners += f32(v);
    }
    const std::string uvs = chunk3ds(0x4140, u16(3) + f32(1) + f32(0) + f32(1) + f32(0) + f32(1) + f32(1));
    const std::string faces =
      u16(1) + u16(0) + u16(1) + u16(2) + u16(0) + chunk3ds(0x4130, text("m") + u16(1) + u16(0));
    this->write(
      "a.3ds", chunk3ds(0x4d4d,
                 chunk3ds(0x3d3d, chunk3ds(0xafff, chunk3ds(0xa000, text("m")) + maps) +
                                    chunk3ds(0x4000, text("o") + chunk3ds(0x4100, chunk3ds(0x4110, corners) + uvs +
                                                                                    chunk3ds(0x4120, faces))))));
    return dgtk::readModel(this->Folder.path("a.3ds"));
  };
  const auto both = model(chunk3ds(0xa210, chunk3ds(0xa300, text("MASK.PPM"))) + chunk3ds(0xa200, map("OWN.PPM")));
  EXPECT_THAT(both->warnings, IsEmpty());
  EXPECT_EQ(textureOf(*both).image->rgba, (Bytes{ 10, 20, 30, 255, 40, 50, 60, 0 }));
  EXPECT_EQ(both->uvs[0][0], 3) << "where its own picture lies";
  const auto alone = model(chunk3ds(0xa210, map("MASK.PPM")));
  EXPECT_EQ(textureOf(*alone).image->rgba, (Bytes{ 255, 255, 255, 255, 255, 255, 255, 0 }));
  EXPECT_EQ(alone->uvs[0][0], 3);
  EXPECT_EQ(model(chunk3ds(0xa200, map("OWN.PPM")) + chunk3ds(0xa210, map("OWN.PPM")))->textures.size(), 1u);
}
