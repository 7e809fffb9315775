// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneSamples.h"

#include "dgtkSceneJson.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
/// Without those of the model of TestSceneCameras.cxx.
std::set<std::string> asSet(const std::vector<std::string>& keys)
{
  std::set<std::string> set(keys.begin(), keys.end());
  set.erase(set.lower_bound("odd"), set.lower_bound("ode"));
  return set;
}

std::set<std::string> keysOfSchema(const nlohmann::json& definition)
{
  std::set<std::string> keys;
  for (const auto& property : definition.at("properties").items())
  {
    keys.insert(property.key());
  }
  return keys;
}

/// A scene whose one item, or which itself, has keys at frames 5 and 8 for one property, `inner` of `property` where
/// that is not empty.
std::string sceneWithKeys(
  const std::string& kind, const std::string& property, const std::string& inner, const std::string& track)
{
  using nlohmann::json;
  static const std::map<std::string, json> values{ { "booleanTrack", true }, { "colorTrack", { 1, 0, 1 } },
    { "lightColorTrack", { 1, 2, 3 } }, { "rotationTrack", { 1, 0, 0, 0 } }, { "scaleTrack", { 1, 2, 3 } },
    { "vectorTrack", { 1, 2, 3 } } };
  const json value = values.count(track) != 0 ? values.at(track) : json(1);
  const json keys{ { "keys", { { 5, value }, { 8, value } } } };
  json item = json::object();
  if (kind == "object")
  {
    item["model"] = "a.ac";
  }
  else if (kind == "camera" && (property == "position" || property == "orientation"))
  {
    item = { { "position", { 0, 0, 5 } }, { "orientation", { 1, 0, 0, 0 } } };
  }
  else if (kind == "camera")
  {
    const std::map<std::string, std::string> models{ { "viewHeight", "orthographic" }, { "xi", "omnidirectional" },
      { "alpha", "eucm" }, { "beta", "eucm" } };
    item = { { "model", models.count(property) != 0 ? models.at(property) : "pinhole" }, { "eye", { 9, 0, 0 } },
      { "lookAt", { 0, 0, 0 } } };
  }
  item[property] = inner.empty() ? keys : json{ { inner, keys } };
  if (kind == "scene")
  {
    return item.dump();
  }
  if (kind == "material")
  {
    return json{ { "objects", { { { "model", "a.ac" }, { "materials", { { "*", item } } } } } } }.dump();
  }
  return json{ { kind + 's', { item } } }.dump();
}

/// The text between the first fence of this kind after a heading and its end.
std::string fenced(const std::string& page, const std::string& heading, const std::string& kind)
{
  const std::size_t section = page.find("\n" + heading + "\n");
  const std::size_t fence = page.find("```" + kind + "\n", section);
  if (section == std::string::npos || fence == std::string::npos)
  {
    ADD_FAILURE() << heading << ' ' << kind;
    return {};
  }
  const std::size_t start = fence + 4 + kind.size();
  return page.substr(start, page.find("```", start) - start);
}
} // namespace

TEST(SceneSchema, HasTheKeysOfTheReader)
{
  const nlohmann::json schema =
    nlohmann::json::parse(contentsOf(sourceFile("Documentation/Formats/scene.schema.json")));
  for (const auto& [name, keys] : scenefile::jsonSceneKeys())
  {
    SCOPED_TRACE(name);
    if (name == "keys") // one definition a type of value
    {
      for (const char* type :
        { "numberTrack", "vectorTrack", "scaleTrack", "rotationTrack", "booleanTrack", "unitTrack", "colorTrack",
          "lightColorTrack", "lightNumberTrack", "exponentTrack", "notNegativeTrack", "coneAngleTrack" })
      {
        EXPECT_EQ(keysOfSchema(schema.at("$defs").at(type).at("anyOf").at(1)), asSet(keys)) << type;
      }
      continue;
    }
    const nlohmann::json& definition = name == "scene" ? schema : schema.at("$defs").at(name);
    EXPECT_EQ(keysOfSchema(definition), asSet(keys));
    EXPECT_FALSE(definition.at("additionalProperties").get<bool>());
  }
}

TEST(SceneSchema, EveryTrackHasKeyFrames)
{
  const nlohmann::json schema =
    nlohmann::json::parse(contentsOf(sourceFile("Documentation/Formats/scene.schema.json")));
  const nlohmann::json& definitions = schema.at("$defs");
  const TemporaryFolder folder;
  int tracks = 0;
  const auto check =
    [&](const std::string& kind, const std::string& property, const std::string& inner, const nlohmann::json& value)
  {
    const std::string type = value.value("$ref", "");
    if (type.size() > 5 && type.substr(type.size() - 5) == "Track")
    {
      const std::string text = sceneWithKeys(kind, property, inner, type.substr(type.rfind('/') + 1));
      EXPECT_EQ(readText(folder, "a.json", text).keyFrames(), (std::vector<int>{ 5, 8 })) << text;
      ++tracks;
    }
  };
  for (const std::string kind : { "scene", "object", "material", "light", "camera" })
  {
    for (const auto& property : (kind == "scene" ? schema : definitions.at(kind)).at("properties").items())
    {
      check(kind, property.key(), {}, property.value());
      const std::string type = property.value().value("$ref", "");
      const nlohmann::json& inner = type.empty() ? property.value() : definitions.at(type.substr(type.rfind('/') + 1));
      const nlohmann::json parts = inner.value("properties", nlohmann::json::object());
      for (const auto& one : parts.items())
      {
        check(kind, property.key(), one.key(), one.value());
      }
    }
  }
  EXPECT_EQ(tracks, 4 + 4 + 9 + 11 + 15) << "tracks of the scene, objects, materials, lights and cameras";
}

TEST(SceneSchema, EveryReferenceHasADefinition)
{
  const nlohmann::json schema =
    nlohmann::json::parse(contentsOf(sourceFile("Documentation/Formats/scene.schema.json")));
  EXPECT_EQ(schema.at("$schema"), "https://json-schema.org/draft/2020-12/schema");
  const nlohmann::json flat = schema.flatten();
  for (const auto& [path, value] : flat.items())
  {
    if (path.size() > 5 && path.substr(path.size() - 5) == "/$ref")
    {
      const std::string reference = value.get<std::string>();
      EXPECT_TRUE(schema.contains(nlohmann::json::json_pointer(reference.substr(1)))) << reference;
    }
  }
}

TEST(SceneSchema, TheExamplesOfTheDocumentationAreRead)
{
  const std::string page = contentsOf(sourceFile("Documentation/Formats/scene.md"));
  const TemporaryFolder folder;
  const SceneDescription json = readText(folder, "a.json", fenced(page, "## `.json`", "jsonc"));
  EXPECT_EQ(json.objects.size(), 3u);
  EXPECT_EQ(json.cameras.size(), 3u);
  EXPECT_NO_THROW(toJson(json, folder.path()));
  const SceneDescription thesis = readText(folder, "a.scene", fenced(page, "## `.scene`", "text"));
  EXPECT_EQ(thesis.objects.size(), 1u);
  EXPECT_EQ(thesis.lights.size(), 1u);
  EXPECT_EQ(thesis.cameras.size(), 1u);
}

TEST(SceneSchema, TheDocumentationNamesEveryKey)
{
  const std::string page = contentsOf(sourceFile("Documentation/Formats/scene.md"));
  for (const auto& [name, keys] : scenefile::jsonSceneKeys())
  {
    for (const std::string& key : asSet(keys))
    {
      EXPECT_NE(page.find('`' + key + '`'), std::string::npos) << name << ' ' << key;
    }
  }
}
