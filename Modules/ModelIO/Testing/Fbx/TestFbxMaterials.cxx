// SPDX-License-Identifier: BSD-3-Clause
// FBX: materials and their pictures.
#include "dgtkFbxMaker.h"
#include "dgtkModelChecks.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

using namespace dgtk::test;

namespace
{
using FbxNumbers = FbxMaker::Numbers;
constexpr double quarterTurn = 3.14159265358979323846 / 2;
} // namespace

TEST(Fbx, MaterialsByPolygon)
{
  FbxMaker maker;
  const std::int64_t node = maker.model();
  const std::int64_t mesh = maker.mesh(node, { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 0, 1, -3, 0, 1, -3, 0, 1, -3, 0, 1, -3 });
  maker.item(mesh).children.push_back(fbxLayer(
    "LayerElementMaterial", "ByPolygon", "IndexToDirect", { { "Materials", { FbxMaker::Integers{ 1, 0, 1, 9 } } } }));
  EXPECT_EQ(readChecked(maker)->materials.size(), 1u) << "a grey one";
  const std::int64_t red = maker.add("Material", "", {}, "red");
  maker.set(red, "DiffuseColor", { 1, 0.5, 0 });
  maker.set(red, "DiffuseFactor", FbxNumbers{ 0.5 });
  maker.set(red, "AmbientColor", { 0.5, 0.5, 0.5 });
  maker.set(red, "EmissiveColor", { 0, 0.25, 0 });
  maker.set(red, "SpecularColor", { 1, 1, 1 });
  maker.set(red, "SpecularFactor", FbxNumbers{ 0.25 });
  maker.set(red, "ShininessExponent", FbxNumbers{ 20 });
  maker.set(red, "TransparentColor", { 1, 1, 1 });
  maker.set(red, "TransparencyFactor", FbxNumbers{ 0.25 });
  maker.connect(red, node);
  const std::int64_t plain = maker.add("Material", "", {}, "plain");
  maker.set(plain, "Maya|baseColor", { 0.5, 0.25, 1 });
  maker.set(plain, "Maya|base", FbxNumbers{ 0.5 });
  maker.set(plain, "SpecularColor", { 1, 1, 1 });
  maker.set(plain, "TransparencyFactor", FbxNumbers{ 1 });
  maker.set(plain, "Opacity", FbxNumbers{ 0.5 });
  maker.connect(plain, node);
  const auto model = readChecked(maker);
  ASSERT_EQ(model->parts.size(), 3u);
  EXPECT_EQ(model->parts[0].triangles, 2u);
  EXPECT_EQ(model->parts[2].material, model->parts[1].material) << "what names no material has the first";
  const auto materialOf = [&model](std::size_t part) -> const dgtk::Material&
  { return model->materials.at(std::size_t(model->parts[part].material)); };
  EXPECT_EQ(materialOf(0).name, "plain");
  expectNear(materialOf(0).diffuse, { 0.25, 0.125, 0.5 });
  expectNear(materialOf(0).specular, { 0, 0, 0 });
  EXPECT_EQ(materialOf(0).opacity, 0.5);
  EXPECT_EQ(materialOf(1).name, "red");
  expectNear(materialOf(1).diffuse, { 0.5, 0.25, 0 });
  expectNear(materialOf(1).ambient, { 0.5, 0.5, 0.5 });
  expectNear(materialOf(1).emission, { 0, 0.25, 0 });
  expectNear(materialOf(1).specular, { 0.25, 0.25, 0.25 });
  EXPECT_EQ(materialOf(1).shininess, 20);
  EXPECT_EQ(materialOf(1).opacity, 0.75);
}

TEST(Fbx, ExponentsOfTheOtherName)
{
  FbxMaker maker;
  const std::int64_t node = maker.model();
  maker.mesh(node);
  const std::int64_t shiny = maker.add("Material", "");
  maker.set(shiny, "SpecularColor", { 1, 1, 1 });
  maker.set(shiny, "Shininess", FbxNumbers{ 20 });
  maker.connect(shiny, node);
  const auto model = readChecked(maker);
  EXPECT_EQ(model->materials.at(0).shininess, 20);
  expectNear(model->materials[0].specular, { 1, 1, 1 });
}

namespace
{
/// A triangle with a picture.
class FbxPictures : public testing::Test
{
protected:
  FbxPictures()
  {
    const std::int64_t node = this->Maker.model();
    const std::int64_t mesh = this->Maker.mesh(node);
    const auto set = [this, mesh](const std::string& name, const FbxNumbers& uvs)
    {
      this->Maker.item(mesh).children.push_back(
        fbxLayer("LayerElementUV", "ByPolygonVertex", "Direct", { { "Name", { name } }, { "UV", { uvs } } }));
    };
    set("first", { 0.25, 0.5, 0, 0, 1, 1 });
    set("second", { 0.75, 0.125, 0, 0, 1, 1 });
    this->Material = this->Maker.add("Material", "");
    this->Maker.connect(this->Material, node);
    this->Texture = this->Maker.add("Texture", "");
    this->Maker.item(this->Texture).children = { { "FileName", { std::string("C:\\far\\away.png") } },
      { "RelativeFilename", { std::string("maps\\own.png") } } };
  }
  void use(const std::string& property = "DiffuseColor")
  {
    this->Maker.connect(this->Texture, this->Material, property);
  }

  FbxMaker Maker;
  std::int64_t Material;
  std::int64_t Texture;
};
} // namespace

TEST_F(FbxPictures, AreNamedByTheTexture)
{
  this->use();
  const auto model = readChecked(this->Maker);
  ASSERT_EQ(model->textures.size(), 1u);
  EXPECT_EQ(model->textures[0].name, "maps\\own.png");
  EXPECT_EQ(model->textures[0].wrap, (dgtk::TextureWraps{}));
  EXPECT_EQ(model->uvs[model->triangles[0][0]], Eigen::Vector2d(0.25, 0.5));
}

TEST_F(FbxPictures, LieWhereTheTextureSays)
{
  this->use();
  this->Maker.setText(this->Texture, "UVSet", "second");
  this->Maker.set(this->Texture, "WrapModeU", FbxNumbers{ 1 });
  EXPECT_EQ(readChecked(this->Maker)->textures[0].wrap[0], dgtk::TextureWrap::Clamp);
  EXPECT_EQ(readChecked(this->Maker)->textures[0].wrap[1], dgtk::TextureWrap::Repeat);
  EXPECT_EQ(readChecked(this->Maker)->uvs[0], Eigen::Vector2d(0.75, 0.125));
  this->Maker.set(this->Texture, "Translation", { 0.25, 0.5, 0 });
  this->Maker.set(this->Texture, "Scaling", { 2, 4, 1 });
  this->Maker.set(this->Texture, "Rotation", { 0, 0, 90 });
  const auto expectLying = [this](const Eigen::Vector2d& scalePivot, const Eigen::Vector2d& turnPivot)
  {
    Eigen::Affine2d uv_from_picture = Eigen::Affine2d(Eigen::Translation2d(0.25, 0.5)) *
                                      Eigen::Translation2d(turnPivot) * Eigen::Rotation2Dd(quarterTurn) *
                                      Eigen::Translation2d(-turnPivot);
    uv_from_picture =
      uv_from_picture * Eigen::Translation2d(scalePivot) * Eigen::Scaling(2., 4.) * Eigen::Translation2d(-scalePivot);
    const Eigen::Vector2d expected = uv_from_picture.inverse() * Eigen::Vector2d(0.75, 0.125);
    EXPECT_LT((readChecked(this->Maker)->uvs[0] - expected).norm(), 1e-6);
  };
  expectLying({ 0, 0 }, { 0, 0 });
  this->Maker.set(this->Texture, "TextureScalingPivot", { 0.5, 0.25, 0 });
  this->Maker.set(this->Texture, "TextureRotationPivot", { 0.125, 1, 0 });
  expectLying({ 0.5, 0.25 }, { 0.125, 1 });
}

TEST_F(FbxPictures, OfOtherMaterialsAndLayers)
{
  this->use("Maya|baseColor");
  EXPECT_EQ(readChecked(this->Maker)->textures.size(), 1u);
  FbxMaker& maker = this->Maker;
  const std::int64_t layered = maker.add("LayeredTexture", "");
  maker.connect(layered, this->Material, "DiffuseColor");
  const std::int64_t other = maker.add("Texture", "", { { "FileName", { std::string("under.png") } } });
  maker.connect(other, layered);
  const auto model = readChecked(maker);
  EXPECT_EQ(model->textures.at(0).name, "under.png") << "the first one of a layered texture, and its colour first";
}

TEST_F(FbxPictures, TakeThePlaceOfTheColoursThatTheyDrive)
{
  FbxMaker& maker = this->Maker;
  maker.set(this->Material, "DiffuseColor", { 0.5, 0.5, 0.25 });
  maker.set(this->Material, "DiffuseFactor", FbxNumbers{ 0.75 });
  maker.set(this->Material, "EmissiveColor", { 0, 0, 0 });
  maker.set(this->Material, "EmissiveFactor", FbxNumbers{ 0.5 });
  this->use();
  maker.connect(
    maker.add("Texture", "", { { "FileName", { std::string("glow.png") } } }), this->Material, "EmissiveColor");
  maker.connect(
    maker.add("Texture", "", { { "FileName", { std::string("normals.png") } } }), this->Material, "NormalMap");
  const auto model = readChecked(maker);
  const dgtk::Material& material = model->materials.at(0);
  expectNear(material.diffuse, { 0.75, 0.75, 0.75 });
  expectNear(material.emission, { 0.5, 0.5, 0.5 });
  ASSERT_EQ(model->textures.size(), 3u);
  EXPECT_EQ(model->textures[std::size_t(material.texture)].name, "maps\\own.png");
  EXPECT_EQ(model->textures[std::size_t(material.emissionMap)].name, "glow.png");
  EXPECT_EQ(model->textures[std::size_t(material.normalMap)].name, "normals.png");
}

TEST_F(FbxPictures, InsideTheFile)
{
  this->use();
  std::string png = "\x89PNG\r\n\x1a\n";
  const std::int64_t video =
    this->Maker.add("Video", "Clip", { { "RelativeFilename", { std::string("own.png") } }, { "Content", { png } } });
  this->Maker.connect(video, this->Texture);
  const auto model = readBytes("fbx", this->Maker.binary());
  ASSERT_EQ(model->textures.size(), 1u);
  EXPECT_TRUE(model->holds(model->textures[0]));
  EXPECT_EQ(model->textures[0].name, "own.png");
  this->Maker.item(video).children[1].values = { std::string("iVBORw0K"), std::string("Ggo=") }; // the same in base64
  const auto text = readChecked(this->Maker);
  EXPECT_TRUE(text->holds(text->textures.at(0)));
}

TEST_F(FbxPictures, InsideTheFileButOfOtherKindsAreLookedForBesideIt)
{
  this->use();
  const std::int64_t video = this->Maker.add("Video", "Clip", { { "Content", { std::string("II*") + "AAAA" } } });
  this->Maker.connect(video, this->Texture);
  for (const std::string& bytes : { this->Maker.binary(), this->Maker.text() })
  {
    const auto model = readBytes("fbx", bytes);
    ASSERT_EQ(model->textures.size(), 1u);
    EXPECT_EQ(model->textures[0].name, "maps\\own.png");
  }
}
