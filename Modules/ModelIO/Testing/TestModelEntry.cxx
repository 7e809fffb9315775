// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelEntry.h"

#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <functional>
#include <sstream>
#include <string>
#include <vector>

using namespace dgtk;

namespace
{
Material fullMaterial()
{
  Material m;
  m.name = "copper";
  m.ambient = { 0.01, 0.02, 0.03 };
  m.diffuse = { 0.04, 0.05, 0.06 };
  m.specular = { 0.07, 0.08, 0.09 };
  m.emission = { 0.11, 0.12, 0.13 };
  m.shininess = 17;
  m.opacity = 0.75;
  m.twoSided = true;
  m.texture = 0;
  m.cutOut = true;
  m.physical = Material::Physical{ 0.6, 0.4, true };
  m.normalMap = 1;
  m.bumpMap = 2;
  m.metallicRoughnessMap = 3;
  m.emissionMap = 4;
  m.occlusionMap = 5;
  m.normalScale = 1.5;
  m.bumpScale = 2.5;
  m.occlusionStrength = 0.35;
  return m;
}

/// Of two materials and two parts; no value is what it is by default.
ModelEntry fullEntry()
{
  auto rest = std::make_shared<Geometry>();
  rest->positions = { { 1, 2, 3 }, { 4, 5, 6 }, { 7, 8, 10 } };
  rest->normals = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  auto model = std::make_shared<Model>();
  model->format = "obj";
  model->materials = { fullMaterial(), Material() };
  model->parts = { { "lid", 1, 0, 1 }, { "pot", 0, 1, 2 } };
  model->triangles = { { 0, 1, 2 }, { 2, 1, 0 }, { 1, 2, 0 } };
  model->rest = rest;
  model->uvs = { { 0.1, 0.2 }, { 0.3, 0.4 }, { 0.5, 0.6 } };
  model->colors = { { 1, 2, 3, 4 }, { 5, 6, 7, 8 }, { 9, 10, 11, 12 } };
  model->sourceVertex = { 3, 1, 2 };
  model->sourceVertices = 4;
  model->sourceOf = { 0, 1, 2, 3, 1 };
  model->isNumbered = false;
  model->normalGroup = { 2, 0, 1 };
  model->animations = { { "walk", 2, 9, 12.5, true, 6.75 } };
  model->frames = 11;
  model->lines = 12;
  model->declaredTriangles = 13;
  model->twoSidedTriangles = 14;
  model->twoSidedSurfaces = 15;
  model->declaredMaterials = 16;
  model->boundsMin = { -1, -2, -3 };
  model->boundsMax = { 11, 12, 13 };
  ModelEntry entry;
  entry.contents.model = model;
  entry.contents.pictures.resize(6);
  entry.contents.pictures[1] = { "a.png", "b.png", "c d.png", "png", 2, 3, { 1, 2, 3, 4, 5 }, 0,
    { TextureWrap::Clamp, TextureWrap::Mirror } };
  entry.contents.alpha = { { AlphaUse::CutOff, 0.25 }, { AlphaUse::Nothing, 0.5, 3, MaskValue::Blue } };
  entry.contents.notes = { { "a line", 5 }, { "decoding", ModelNote::ofDecoding }, { "another", ModelNote::none } };
  entry.contents.moreNotes = 17;
  entry.contents.dependencies = { { ModelDependency::Kind::Program, "blender", "DGTK_BLENDER" },
    { ModelDependency::Kind::Beside, "a.mtl", "A.MTL" } };
  entry.contents.keptFrom = 18;
  entry.identities = { "one", "two" };
  return entry;
}

/// All that is in an entry, in words.
std::string said(const ModelEntry& entry)
{
  std::ostringstream out;
  const auto list = [&out](const auto& values)
  {
    out << values.size() << ':';
    for (const auto& value : values)
    {
      for (const auto number : value)
      {
        out << ' ' << double(number);
      }
    }
    out << '\n';
  };
  const Model& m = *entry.contents.model;
  for (const Material& x : m.materials)
  {
    out << x.name << '\n';
    list(std::vector<Eigen::Vector3d>{ x.ambient, x.diffuse, x.specular, x.emission });
    out << x.shininess << ' ' << x.opacity << ' ' << x.twoSided << ' ' << x.texture << ' ' << x.cutOut << '\n';
    const Material::Physical none{ -1, -1, false };
    const Material::Physical p = x.physical.value_or(none);
    out << p.metallic << ' ' << p.roughness << ' ' << p.wanted << '\n';
    out << x.normalMap << ' ' << x.bumpMap << ' ' << x.metallicRoughnessMap << ' ' << x.emissionMap << ' '
        << x.occlusionMap << ' ' << x.normalScale << ' ' << x.bumpScale << ' ' << x.occlusionStrength << '\n';
  }
  for (const Part& x : m.parts)
  {
    out << x.name << ' ' << x.material << ' ' << x.firstTriangle << ' ' << x.triangles << '\n';
  }
  for (const Animation& x : m.animations)
  {
    out << x.name << ' ' << x.first << ' ' << x.last << ' ' << x.fps << ' ' << x.beside << ' ' << x.length << '\n';
  }
  list(m.triangles), list(m.rest->positions), list(m.rest->normals), list(m.uvs), list(m.colors);
  list(std::vector<std::vector<std::uint32_t>>{ m.sourceVertex, m.sourceOf, m.normalGroup });
  list(std::vector<Eigen::Vector3d>{ m.boundsMin, m.boundsMax });
  out << m.format << ' ' << m.sourceVertices << ' ' << m.isNumbered << ' ' << m.frames << ' ' << m.lines << ' '
      << m.declaredTriangles << ' ' << m.twoSidedTriangles << ' ' << m.twoSidedSurfaces << ' ' << m.declaredMaterials
      << '\n';
  const ModelContents& c = entry.contents;
  for (const ModelPicture& x : c.pictures)
  {
    out << x.name << '|' << x.alternative << '|' << x.unescaped << '|' << x.type << ' ' << x.width << ' ' << x.height;
    list(std::vector<std::vector<std::uint8_t>>{ x.bytes });
    out << x.same << ' ' << int(x.wrap[0]) << ' ' << int(x.wrap[1]) << '\n';
  }
  for (const MaterialAlpha& x : c.alpha)
  {
    out << int(x.use) << ' ' << x.cutOff << ' ' << x.mask << ' ' << int(x.value) << '\n';
  }
  for (const ModelNote& x : c.notes)
  {
    out << x.text << ' ' << x.picture << '\n';
  }
  for (const ModelDependency& x : c.dependencies)
  {
    out << int(x.kind) << ' ' << x.name << ' ' << x.found << '\n';
  }
  for (const std::string& x : entry.identities)
  {
    out << x << '\n';
  }
  out << c.moreNotes << ' ' << c.keptFrom;
  return out.str();
}
} // namespace

TEST(ModelEntry, EveryValueComesBack)
{
  const test::TemporaryFolder folder;
  ModelEntry entry = fullEntry();
  writeModelEntry(folder.path("a.model"), entry);
  ModelEntry again;
  ASSERT_TRUE(readModelEntry(folder.path("a.model"), again));
  EXPECT_EQ(said(again), said(entry));
  EXPECT_FALSE(readModelEntry(folder.path("none.model"), again));
}

TEST(ModelEntry, AnIndexBeyondItsListIsNone)
{
  const test::TemporaryFolder folder;
  struct Row
  {
    const char* what;
    bool sound;
    std::function<void(ModelEntry&)> change;
  };
  const auto model = [](const std::function<void(Model&)>& change)
  { return [change](ModelEntry& entry) { change(*entry.contents.model); }; };
  const auto rest = [](const std::function<void(Geometry&)>& change)
  {
    return [change](ModelEntry& entry)
    {
      auto own = std::make_shared<Geometry>(*entry.contents.model->rest);
      change(*own);
      entry.contents.model->rest = own;
    };
  };
  std::vector<Row> rows{
    { "an identity less", false, [](ModelEntry& e) { e.identities.pop_back(); } },
    { "an alpha more", false, [](ModelEntry& e) { e.contents.alpha.emplace_back(); } },
    { "a note's picture", false, [](ModelEntry& e) { e.contents.notes[0].picture = 6; } },
    { "a note's place", false, [](ModelEntry& e) { e.contents.notes[0].picture = -3; } },
    { "the picture itself", false, [](ModelEntry& e) { e.contents.pictures[1].same = 1; } },
    { "below the first picture", false, [](ModelEntry& e) { e.contents.pictures[1].same = -2; } },
    { "no wrap", false, [](ModelEntry& e) { e.contents.pictures[0].wrap[0] = TextureWrap(3); } },
    { "no wrap of v", false, [](ModelEntry& e) { e.contents.pictures[0].wrap[1] = TextureWrap(3); } },
    { "a part's material", false, model([](Model& m) { m.parts[0].material = 2; }) },
    { "below the first material", false, model([](Model& m) { m.parts[0].material = -1; }) },
    { "a gap before a part", false, model([](Model& m) { m.parts[0].firstTriangle = 1; }) },
    { "parts that overlap", false, model([](Model& m) { m.parts[1].firstTriangle = 0; }) },
    { "triangles of no part", false, model([](Model& m) { m.parts[1].triangles = 1; }) },
    { "more triangles than there are", false, model([](Model& m) { m.parts[1].triangles = 3; }) },
    { "a normal less", false, rest([](Geometry& g) { g.normals.pop_back(); }) },
    { "a texture coordinate less", false, model([](Model& m) { m.uvs.pop_back(); }) },
    { "no texture coordinates", true, model([](Model& m) { m.uvs.clear(); }) },
    { "a colour less", false, model([](Model& m) { m.colors.pop_back(); }) },
    { "no colours", true, model([](Model& m) { m.colors.clear(); }) },
    { "a source less", false, model([](Model& m) { m.sourceVertex.pop_back(); }) },
    { "beyond the sources", false, model([](Model& m) { m.sourceVertex[1] = 4; }) },
    { "a vertex of the file beyond the sources", false, model([](Model& m) { m.sourceOf[4] = 4; }) },
    { "a group less", false, model([](Model& m) { m.normalGroup.pop_back(); }) },
    { "beyond the groups", false, model([](Model& m) { m.normalGroup[0] = 3; }) },
    { "no groups", true, model([](Model& m) { m.normalGroup.clear(); }) },
  };
  for (std::size_t corner = 0; corner < 3; ++corner)
  {
    rows.push_back({ "a corner", false, model([corner](Model& m) { m.triangles[2][corner] = 3; }) });
  }
  for (int Material::*const map : { &Material::texture, &Material::normalMap, &Material::bumpMap,
         &Material::metallicRoughnessMap, &Material::emissionMap, &Material::occlusionMap })
  {
    for (const int index : { -2, -1, 5, 6 })
    {
      rows.push_back({ "a map", index >= -1 && index < 6, model([=](Model& m) { m.materials[0].*map = index; }) });
    }
  }
  for (const Row& row : rows)
  {
    ModelEntry entry = fullEntry();
    row.change(entry);
    writeModelEntry(folder.path("a.model"), entry);
    ModelEntry again;
    EXPECT_EQ(readModelEntry(folder.path("a.model"), again), row.sound) << row.what;
  }
}
