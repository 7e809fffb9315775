// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneJson.h"

#include "dgtkError.h"
#include "dgtkSceneRandom.h"
#include "dgtkSceneText.h"
#include "dgtkSensorDescription.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace dgtk::scenefile
{

namespace
{
using Scene = SceneDescription;
constexpr int schemaVersion = 1;
constexpr Range versionRange{ schemaVersion, schemaVersion, false, false, "1" };

const std::vector<std::string>& axisWords()
{
  static const std::vector<std::string> words{ "y", "z" };
  return words;
}

const std::vector<std::string>& itemWords()
{
  static const std::vector<std::string> words{ "object", "light", "camera" };
  return words;
}

void readSchema(const JsonCursor& at, Scene&) { at.string(); }
void writeNothing(const Scene&, const char*, JsonNode&) {}

void readVersion(const JsonCursor& at, Scene&) { at.wholeNumber(versionRange); }
void writeVersion(const Scene&, const char* key, JsonNode& node) { node.add(key, JsonNode::of(double(schemaVersion))); }

void readUnits(const JsonCursor& at, Scene& scene) { scene.units = at.string(); }
void writeUnits(const Scene& scene, const char* key, JsonNode& node)
{
  if (!scene.units.empty())
  {
    node.add(key, JsonNode::of(scene.units));
  }
}

void readUpAxis(const JsonCursor& at, Scene& scene) { scene.upAxis = static_cast<UpAxis>(at.oneOf(axisWords())); }
void writeUpAxis(const Scene& scene, const char* key, JsonNode& node)
{
  if (scene.upAxis != UpAxis::Y)
  {
    node.add(key, JsonNode::of(axisWords()[static_cast<std::size_t>(scene.upAxis)]));
  }
}

void readFps(const JsonCursor& at, Scene& scene) { scene.fps = at.number(rules::fps); }
void writeFps(const Scene& scene, const char* key, JsonNode& node)
{
  if (scene.fps != Scene().fps)
  {
    node.add(key, JsonNode::of(scene.fps));
  }
}

void readSeed(const JsonCursor& at, Scene& scene)
{
  scene.seed = static_cast<std::uint64_t>(at.wholeNumber(rules::seed));
}
void writeSeed(const Scene& scene, const char* key, JsonNode& node)
{
  if (scene.seed != 0)
  {
    node.add(key, JsonNode::of(double(scene.seed)));
  }
}

void readKeyFrames(const JsonCursor& at, Scene& scene)
{
  for (std::size_t i = 0, n = at.listSize(); i < n; ++i)
  {
    const JsonCursor element = at.element(i);
    const int frame = static_cast<int>(element.wholeNumber(rules::frame));
    if (i > 0 && frame <= scene.extraKeyFrames.back())
    {
      element.fail(
        "is out of order", "more than " + std::to_string(scene.extraKeyFrames.back()), std::to_string(frame));
    }
    scene.extraKeyFrames.push_back(frame);
  }
}
void writeKeyFrames(const Scene& scene, const char* key, JsonNode& node)
{
  JsonNode list(JsonNode::Type::Array);
  for (const int frame : scene.extraKeyFrames)
  {
    list.children.push_back(JsonNode::of(double(frame)));
  }
  if (!list.children.empty())
  {
    node.add(key, std::move(list));
  }
}

void readObject(const JsonCursor& at, const Scene&, ObjectDescription& object)
{
  readFields(at, objectFields(), object);
  if (object.model.empty())
  {
    at.fail("has no model", "\"model\": a file");
  }
}
void readLight(const JsonCursor& at, const Scene&, LightDescription& light) { readFields(at, lightFields(), light); }
void readSceneCamera(const JsonCursor& at, const Scene& scene, CameraDescription& camera)
{
  readCamera(at, scene.upAxis, camera);
}

template <auto Member, auto ReadItem>
void readItems(const JsonCursor& at, Scene& scene)
{
  auto& items = scene.*Member;
  const std::size_t n = at.listSize();
  items.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const JsonCursor element = at.element(i);
    ReadItem(element, scene, items[i]);
    items[i].line = element.node().line;
  }
}

template <typename Item, typename Write>
void writeItems(const std::vector<Item>& items, const char* key, JsonNode& node, const Write& write)
{
  JsonNode list(JsonNode::Type::Array);
  for (const Item& item : items)
  {
    list.children.push_back(write(item));
  }
  if (!items.empty())
  {
    node.add(key, std::move(list));
  }
}

void writeObjects(const Scene& scene, const char* key, JsonNode& node)
{
  writeItems(scene.objects, key, node, [](const ObjectDescription& o) { return writeFields(o, objectFields()); });
}
void writeLights(const Scene& scene, const char* key, JsonNode& node)
{
  writeItems(scene.lights, key, node, [](const LightDescription& l) { return writeFields(l, lightFields()); });
}
void writeCameras(const Scene& scene, const char* key, JsonNode& node)
{
  writeItems(scene.cameras, key, node, [&](const CameraDescription& c) { return writeCamera(c, scene.upAxis); });
}

void readOrder(const JsonCursor& at, Scene& scene)
{
  std::size_t counts[3] = { 0, 0, 0 };
  for (std::size_t i = 0, n = at.listSize(); i < n; ++i)
  {
    const std::size_t kind = at.element(i).oneOf(itemWords());
    scene.order.push_back({ static_cast<SceneItem::Kind>(kind), counts[kind]++ });
  }
}
void writeOrder(const Scene& scene, const char* key, JsonNode& node)
{
  Scene plain;
  plain.objects.resize(scene.objects.size());
  plain.lights.resize(scene.lights.size());
  plain.cameras.resize(scene.cameras.size());
  if (scene.items() == plain.items())
  {
    return;
  }
  JsonNode list(JsonNode::Type::Array);
  for (const SceneItem& item : scene.order)
  {
    list.children.push_back(JsonNode::of(itemWords()[static_cast<std::size_t>(item.kind)]));
  }
  node.add(key, std::move(list));
}

void checkOrder(const JsonCursor& root, std::size_t pair, const Scene& scene)
{
  const std::size_t expected[3] = { scene.objects.size(), scene.lights.size(), scene.cameras.size() };
  for (std::size_t kind = 0; kind < 3; ++kind)
  {
    const auto listed = std::size_t(std::count_if(scene.order.begin(), scene.order.end(),
      [kind](const SceneItem& item) { return static_cast<std::size_t>(item.kind) == kind; }));
    if (listed != expected[kind])
    {
      const JsonCursor at = root.member(pair);
      at.fail("does not list every " + itemWords()[kind], std::to_string(expected[kind]), std::to_string(listed));
    }
  }
}

/// Places in a parsed document.
Place locate(const JsonNode& root, SceneItem::Kind kind, std::size_t index, const std::string& property)
{
  const std::string list = itemWords()[static_cast<std::size_t>(kind)] + 's';
  const JsonNode& item = root.find(list)->children[index];
  const JsonNode* value = item.find(property);
  return { value ? value->line : item.line, list + '[' + std::to_string(index) + "]." + property };
}

void forgetLines(JsonNode& node)
{
  node.line = 0;
  std::for_each(node.children.begin(), node.children.end(), forgetLines);
}
} // namespace

const std::vector<JsonField<Scene>>& sceneFields()
{
  static const std::vector<JsonField<Scene>> fields{
    { "$schema", readSchema, writeNothing },
    { "version", readVersion, writeVersion },
    datasetRow(),
    { "units", readUnits, writeUnits },
    metresRow(),
    { "upAxis", readUpAxis, writeUpAxis },
    { "fps", readFps, writeFps },
    backgroundRow(),
    environmentRow(),
    fogRow(),
    { "seed", readSeed, writeSeed },
    { "keyFrames", readKeyFrames, writeKeyFrames },
    classesRow(),
    { "objects", readItems<&Scene::objects, readObject>, writeObjects },
    { "lights", readItems<&Scene::lights, readLight>, writeLights },
    { "cameras", readItems<&Scene::cameras, readSceneCamera>, writeCameras },
    { "order", readOrder, writeOrder },
  };
  return fields;
}

namespace
{
Scene readTree(const JsonDocument& document, const std::string& file, const std::string& folder)
{
  Scene scene;
  scene.file = file;
  scene.folder = folder;
  const JsonCursor at(document);
  for (std::size_t i = 0, n = at.memberCount(); i < n; ++i)
  {
    if (at.key(i) == "upAxis") // cameras need it
    {
      readUpAxis(at.member(i), scene);
    }
  }
  readFields(at, sceneFields(), scene);
  for (std::size_t i = 0, n = at.memberCount(); i < n; ++i)
  {
    if (at.key(i) == "order")
    {
      checkOrder(at, i, scene);
    }
  }
  // Only the frames at which no track has a key are extra.
  const std::vector<int> listed = std::exchange(scene.extraKeyFrames, {});
  const std::vector<int> frames = scene.keyFrames();
  std::set_difference(
    listed.begin(), listed.end(), frames.begin(), frames.end(), std::back_inserter(scene.extraKeyFrames));
  nameAll(scene);
  readClassFile(scene);
  validateRelations(scene, [&at](SceneItem::Kind kind, std::size_t index, const std::string& property)
    { return locate(at.node(), kind, index, property); });
  return scene;
}
} // namespace

SceneDescription readJsonScene(const std::string& file, const std::string& folder, const std::string& contents)
{
  Scene untitled;
  untitled.file = file;
  JsonDocument document = parseJson(untitled.title(), contents);
  if (file.empty())
  {
    forgetLines(document.root);
  }
  if (const std::optional<JsonCursor> random = firstRandom(document))
  {
    random->fail("makes the scene random", "a plain scene, as dgtk sample makes of it");
  }
  return readTree(document, file, folder);
}

std::map<std::string, std::vector<std::string>> jsonSceneKeys()
{
  std::map<std::string, std::vector<std::string>> keys{
    { "scene", keysOf(sceneFields()) },
    { "object", keysOf(objectFields()) },
    { "animation", keysOf(animationFields()) },
    { "material", keysOf(materialFields()) },
    { "light", keysOf(lightFields()) },
    { "camera", keysOf(cameraFields()) },
    { "class", keysOf(classFields()) },
    { "dataset", datasetWords() },
    { "environment", keysOf(environmentFields()) },
    { "fog", keysOf(fogFields()) },
    { "shutter", keysOf(shutterFields()) },
    { "rollingShutter", keysOf(rollingShutterFields()) },
    { "lens", keysOf(lensFields()) },
    { "unused", keysOf(unusedFields()) },
    { "keys", { "value", "keys", "interpolation" } },
  };
  for (const CameraRow& row : cameraRows())
  {
    for (const CameraParameter& parameter : ownParameters(row.model))
    {
      keys["camera"].push_back(parameter.name);
    }
  }
  keys.merge(sensorKeys());
  return keys;
}

} // namespace dgtk::scenefile

namespace dgtk
{

using namespace scenefile;

SceneDescription readSceneTree(const JsonDocument& document, const std::string& file, const std::string& folder)
{
  return readTree(document, file, folder);
}

std::string toJson(const SceneDescription& scene, const std::string& newFolder)
{
  SceneDescription moved = scene;
  nameAll(moved);
  validate(moved);
  Relocation place(scene.folder, newFolder);
  for (ObjectDescription& object : moved.objects)
  {
    object.model = place.of(object.model);
    for (MaterialOverride& material : object.materials)
    {
      for (const auto picture : materialPictures)
      {
        std::optional<std::string>& path = material.*picture;
        if (path)
        {
          path = place.of(*path);
        }
      }
    }
  }
  for (CameraDescription& camera : moved.cameras)
  {
    for (auto& [name, value] : camera.parameters)
    {
      value.file = place.of(value.file);
    }
  }
  moved.environment.image = place.of(moved.environment.image);
  moved.classFile = place.of(moved.classFile);
  return printJson(writeFields(moved, sceneFields()));
}

} // namespace dgtk
