// SPDX-License-Identifier: BSD-3-Clause
#include "Files/dgtkGeometryHash.h"

#include "dgtkFile.h"
#include "dgtkModelSource.h"
#include "dgtkSyntheticScene.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace dgtk;

namespace
{
using Change = std::function<void(Model&, std::vector<Material>&)>;

/// One model, with materials of its own or of the scene.
class OneModel : public ModelSource
{
public:
  OneModel(std::shared_ptr<const Model> model, std::vector<Material> materials)
    : Look{ std::move(model), std::make_shared<const std::vector<Material>>(std::move(materials)), false }
  {
  }
  ObjectLook lookOf(const SceneDescription&, const ObjectDescription&) const override { return this->Look; }
  std::shared_ptr<const EnvironmentState> environment(const SceneDescription&) const override { return nullptr; }
  std::shared_ptr<GeometryCache> geometries() const override { return std::make_shared<GeometryCache>(); }

private:
  ObjectLook Look;
};

std::shared_ptr<const Image> picture(int width, int height, std::uint8_t first = 1)
{
  Image image{ width, height, false, std::vector<std::uint8_t>(std::size_t(width * height) * 4, 9) };
  image.rgba[0] = first;
  return std::make_shared<const Image>(std::move(image));
}

/// Of a triangle and its back in two parts; pictures 0 and 1 are in memory, 2 is a file.
std::string hashOf(const std::string& file, const Change& change)
{
  auto model = std::make_shared<Model>();
  model->materials.resize(2);
  model->textures.resize(3);
  model->textures[0].image = picture(2, 1);
  model->textures[1].image = picture(2, 1, 77);
  model->textures[2].image = picture(1, 1);
  model->textures[2].path = file;
  model->parts = { { "front", 0, 0, 1 }, { "back", 1, 1, 1 } };
  model->triangles = { { 0, 1, 2 }, { 0, 2, 1 } };
  auto rest = std::make_shared<Geometry>();
  rest->positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  rest->normals.resize(3, { 0, 0, 1 });
  model->rest = rest;
  std::vector<Material> materials(2);
  materials[0].physical = Material::Physical();
  materials[0].texture = 0;
  change(*model, materials);
  SceneDescription scene;
  scene.objects.resize(1);
  scene.objects[0].name = "it";
  scene.objects[0].model = "it";
  return geometryHashes(*Stage::make(scene, OneModel(model, materials))).at(0);
}

Change material(const std::function<void(Material&)>& change)
{
  return [change](Model&, std::vector<Material>& materials) { change(materials[0]); };
}
Change model(const std::function<void(Model&)>& change)
{
  return [change](Model& model, std::vector<Material>&) { change(model); };
}
Change rest(const std::function<void(Geometry&)>& change)
{
  return model(
    [change](Model& model)
    {
      auto own = std::make_shared<Geometry>(*model.rest);
      change(*own);
      model.rest = own;
    });
}
} // namespace

TEST(GeometryHash, IsOfWhatCanBeSeen)
{
  const test::TemporaryFolder folder;
  const std::string file = folder.path("a.png");
  writeFile(file, "a picture");
  writeFile(folder.path("same.png"), "a picture");
  writeFile(folder.path("other.png"), "another picture");
  const auto none = [](Model&, std::vector<Material>&) {};
  std::vector<std::pair<std::string, Change>> rows{
    { "nothing", none },
    { "a corner", rest([](Geometry& g) { g.positions[2].z() = 1e-300; }) },
    { "a normal", rest(
                    [](Geometry& g) {
                      g.normals[2] = { 1, 0, 0 };
                    }) },
    { "the order of corners", model(
                                [](Model& m) {
                                  m.triangles[0] = { 1, 2, 0 };
                                }) },
    { "texture coordinates", model(
                               [](Model& m) {
                                 m.uvs = { { 0, 0 }, { 1, 0 }, { 0, 1 } };
                               }) },
    { "triangles without them", model(
                                  [](Model& m)
                                  {
                                    m.uvs = { { 0, 0 }, { 1, 0 }, { 0, 1 } };
                                    m.unplaced = { 0, 1 };
                                  }) },
    { "colours", model([](Model& m) { m.colors.resize(4); }) },
    { "as many bytes of places of colours", model(
                                              [](Model& m) {
                                                m.colorMapAt.resize(1, { 0, 0 });
                                              }) },
    { "a picture of colours", model([](Model& m) { m.colorMap = picture(2, 1); }) },
    { "a wider one", model([](Model& m) { m.colorMap = picture(4, 1); }) },
    { "of as many pixels", model([](Model& m) { m.colorMap = picture(1, 2); }) },
    { "of other pixels", model([](Model& m) { m.colorMap = picture(2, 1, 2); }) },
    { "triangles of a part", model(
                               [](Model& m)
                               {
                                 m.parts[0].triangles = 2;
                                 m.parts[1] = { "back", 1, 2, 0 };
                               }) },
    { "a part's material", model([](Model& m) { m.parts[0].material = 1; }) },
    { "the other material", [](Model&, std::vector<Material>& all) { all[1].diffuse.x() = 0.5; } },
    { "a filter", model([](Model& m) { m.textures[0].filter = TextureFilter::Nearest; }) },
    { "a border", model([](Model& m) { m.textures[0].wrap[0] = TextureWrap::Clamp; }) },
    { "another border", model([](Model& m) { m.textures[0].wrap[1] = TextureWrap::Clamp; }) },
    { "a mirror", model([](Model& m) { m.textures[0].wrap[0] = TextureWrap::Mirror; }) },
    { "a texture's pixels", model([](Model& m) { m.textures[0].image = picture(2, 1, 5); }) },
    { "its shape", model([](Model& m) { m.textures[0].image = picture(1, 2); }) },
    { "no pixels", model([](Model& m) { m.textures[0].image = nullptr; }) },
    { "cut out", material([](Material& m) { m.cutOut = true; }) },
    { "not physical", material([](Material& m) { m.physical.reset(); }) },
    { "metal", material([](Material& m) { m.physical->metallic = 0.5; }) },
    { "rough", material([](Material& m) { m.physical->roughness = 0.5; }) },
    { "wanted", material([](Material& m) { m.physical->wanted = true; }) },
  };
  for (Eigen::Vector3d Material::*const color :
    { &Material::ambient, &Material::diffuse, &Material::specular, &Material::emission })
  {
    for (int c = 0; c < 3; ++c)
    {
      rows.emplace_back("a colour", material([=](Material& m) { (m.*color)[c] = 0.125; }));
    }
  }
  for (double Material::*const number : { &Material::shininess, &Material::opacity, &Material::normalScale,
         &Material::bumpScale, &Material::occlusionStrength })
  {
    rows.emplace_back("a number", material([=](Material& m) { m.*number = 0.125; }));
  }
  for (int Material::*const map : { &Material::texture, &Material::normalMap, &Material::bumpMap,
         &Material::metallicRoughnessMap, &Material::emissionMap, &Material::occlusionMap })
  {
    rows.emplace_back("a picture in memory", material([=](Material& m) { m.*map = 1; }));
    rows.emplace_back("a file", material([=](Material& m) { m.*map = 2; }));
  }
  std::vector<std::string> hashes;
  for (const auto& [what, change] : rows)
  {
    hashes.push_back(hashOf(file, change));
    EXPECT_EQ(std::count(hashes.begin(), hashes.end(), hashes.back()), 1) << what;
    EXPECT_EQ(hashOf(file, change), hashes.back()) << what;
  }

  // Names and places of files are not seen, nor is what counts for the shading of nothing.
  const Change unseen[] = { model([](Model& m) { m.parts[0].name = m.materials[0].name = m.path = "another"; }),
    material([](Material& m) { m.name = "another"; }), material([](Material& m) { m.twoSided = true; }),
    model([](Model& m) { m.textures[0].name = "another"; }), model([](Model& m) { m.textures[2].path = "unused"; }) };
  for (const Change& change : unseen)
  {
    EXPECT_EQ(hashOf(file, change), hashes[0]) << &change - unseen;
  }
  const Change ofFile = material([](Material& m) { m.texture = 2; });
  EXPECT_EQ(hashOf(folder.path("same.png"), ofFile), hashOf(file, ofFile));
  EXPECT_NE(hashOf(folder.path("other.png"), ofFile), hashOf(file, ofFile));
}
