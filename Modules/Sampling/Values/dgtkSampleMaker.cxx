// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleMaker.h"

#include "dgtkCameraPath.h"
#include "dgtkCameraRequirement.h"
#include "dgtkError.h"
#include "dgtkPlacement.h"
#include "dgtkSampleTree.h"
#include "dgtkSceneRandom.h"

#include <algorithm>
#include <utility>

namespace dgtk
{

using namespace sampletree;

SampleMaker::SampleMaker(
  const RandomScene& scene, std::uint64_t seed, std::uint64_t sample, SampleModels& models, const SampleWatch& watch)
  : Scene(scene)
  , Draws(seed, sample)
  , Models(models)
  , Watch(watch)
  , Expansion(scene, this->Draws, watch.values)
{
}

void SampleMaker::checkWanted() const
{
  if (this->Watch.outdated && this->Watch.outdated())
  {
    throw SampleStopped();
  }
}

void SampleMaker::fail(const JsonNode& node, const std::string& path, const std::string& what,
  const std::string& expected, const std::string& found) const
{
  throw InputError(this->Scene.document().file, node.line, path + ' ' + what, expected, found);
}

SceneDescription SampleMaker::readTree(const JsonNode& tree) const
{
  const JsonDocument document{ tree, this->Scene.document().file };
  return readSceneTree(document, this->Scene.file(), this->Scene.folder());
}

bool SampleMaker::settle(JsonNode& node, const std::string& shown, const std::set<std::size_t>& waiting)
{
  bool all = true;
  replacePoints(node, shown,
    [&](const JsonNode& at, const std::string& path, Eigen::Vector3d& x)
    {
      if (!this->Known)
      {
        this->Objects = this->readTree(objectsAlone(this->Tree));
        this->Known = true;
      }
      const GeometryPoint point = geometryPointOf(at);
      const std::vector<std::string> names = objectNamesOf(this->Objects);
      const std::vector<std::size_t> found = objectsLike(names, point.object);
      if (found.empty() && !objectsLike(this->Gone, point.object).empty())
      {
        throw SampleRefused(path, quoted(point.object) + " is left out of the sample", 1);
      }
      if (found.empty() || (point.onSurface && found.size() > 1))
      {
        this->fail(at, path, found.empty() ? "names no object" : "names more than one object",
          "the name of an object of the scene", quoted(point.object));
      }
      const bool waits =
        std::any_of(found.begin(), found.end(), [&](std::size_t object) { return waiting.count(object) != 0; });
      all = all && !waits;
      if (!waits)
      {
        x = SampleGeometry(this->Objects, this->Models).at(point, found);
      }
      return !waits;
    });
  return all;
}

/// Those whose place is not known yet: what geometry decides, what is placed later, and what hangs on these.
std::set<std::size_t> SampleMaker::waitingObjects(bool placed)
{
  std::set<std::size_t> waiting;
  const std::vector<JsonNode>& items = itemsOf(this->Tree, "objects");
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    if (hasGeometry(items[i]))
    {
      waiting.insert(i);
    }
  }
  for (const Rule& rule : this->Rules)
  {
    if (!placed)
    {
      waiting.insert(rule.index);
    }
  }
  return withChildren(this->Objects, waiting);
}

void SampleMaker::settleObjects(bool placed)
{
  for (;;)
  {
    std::vector<JsonNode>& items = itemsOf(this->Tree, "objects");
    if (std::none_of(items.begin(), items.end(), hasGeometry))
    {
      return;
    }
    this->Objects = this->readTree(objectsAlone(this->Tree));
    this->Known = true;
    const std::set<std::size_t> waiting = this->waitingObjects(placed);
    bool moved = false;
    for (std::size_t i = 0; i < items.size(); ++i)
    {
      if (hasGeometry(items[i]))
      {
        JsonNode settled = items[i];
        moved = this->settle(settled, "objects[" + std::to_string(i) + ']', waiting) || moved;
        items[i] = std::move(settled);
      }
    }
    if (moved)
    {
      this->Known = false;
      continue;
    }
    for (std::size_t i = 0; i < items.size(); ++i)
    {
      if (hasGeometry(items[i]))
      {
        this->fail(items[i], "objects[" + std::to_string(i) + ']', "stands where an object is that has no place yet",
          "no circle, and no object that is placed later", quoted(this->Objects.objects[i].name));
      }
    }
  }
}

void SampleMaker::place()
{
  if (this->Rules.empty())
  {
    return;
  }
  this->Objects = this->readTree(objectsAlone(this->Tree));
  std::vector<SampleRule> rules;
  for (Rule& rule : this->Rules)
  {
    rules.push_back({ rule.index, rule.path, std::move(rule.rule) });
  }
  const std::vector<PlaceOutcome> placed = placeObjects(this->Objects, rules, this->Draws, this->Models);
  // As a scene is written, so that what was measured is what is read.
  const JsonDocument written = parseJson("placed", toJson(this->Objects, this->Objects.folder));
  std::vector<JsonNode>& items = itemsOf(this->Tree, "objects");
  for (const PlaceOutcome& one : placed)
  {
    this->Notes.push_back(one.note);
    if (!one.note.kept)
    {
      this->Out.insert(one.index);
      continue;
    }
    for (const char* key : { "position", "orientation" })
    {
      if (const JsonNode* const value = written.root.find("objects")->children[one.index].find(key))
      {
        JsonNode copy = *value;
        copy.line = items[one.index].line;
        setMember(items[one.index], key, std::move(copy));
      }
    }
  }
}

void SampleMaker::leaveOut()
{
  if (this->Out.empty())
  {
    return;
  }
  const std::set<std::size_t> out = withChildren(this->Objects, this->Out);
  for (const std::size_t object : out)
  {
    this->Gone.push_back(this->Objects.objects[object].name);
  }
  removeItems(this->Tree, "objects", out);
  removeWords(this->Tree, "object", out);
  this->Known = false;
}

SampleWorld& SampleMaker::world()
{
  if (!this->World)
  {
    this->World = std::make_unique<SampleWorld>(this->readTree(objectsAlone(this->Tree)), this->Models);
  }
  return *this->World;
}

bool SampleMaker::makeCamera(std::size_t index, std::uint32_t attempt, JsonNode& camera, SampleNote& note)
{
  const std::string shown = "cameras[" + std::to_string(index) + ']';
  std::map<std::string, Rule> rules;
  camera = this->Expansion.camera(index, attempt, rules);
  aimAtNames(camera, "lookAt");
  this->settle(camera, shown, {});
  const auto path = rules.find("path");
  if (path != rules.end())
  {
    for (const char* key : { "eye", "position", "orientation" })
    {
      if (const JsonNode* const pose = camera.find(key))
      {
        this->fail(*pose, shown + '.' + key, "stands beside a path", "path or a pose of its own", "both");
      }
    }
    this->settle(path->second.rule.root, shown + ".path", {});
    const bool looks = camera.find("lookAt") != nullptr;
    const TravelledPath baked = bakedPath({ index, path->second.path, path->second.rule }, this->world(),
      this->Scene.upAxis(), this->Draws, attempt, looks);
    setMember(camera, "eye", keysNode(baked.eye));
    if (!looks)
    {
      setMember(camera, "lookAt", keysNode(baked.lookAt));
    }
    note.path = path->second.path;
    note.attempts = baked.attempts;
  }
  const auto require = rules.find("require");
  if (require == rules.end())
  {
    return true;
  }
  note.path = require->second.path;
  note.attempts = int(attempt) + 1;
  JsonNode tree(JsonNode::Type::Object);
  if (const JsonNode* const up = this->Tree.find("upAxis"))
  {
    tree.add("upAxis", *up);
  }
  JsonNode list(JsonNode::Type::Array);
  list.children.push_back(camera);
  tree.add("cameras", std::move(list));
  const SceneDescription alone = this->readTree(tree);
  std::vector<int> frames = alone.keyFrames();
  frames.insert(frames.end(), this->KeyFrames.begin(), this->KeyFrames.end());
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  const CameraFit fit =
    fitOf(CameraRequirement::read(require->second.rule), alone.cameras.front(), frames, this->world());
  note.measured = fit.measured;
  note.why = fit.why;
  return fit.fits;
}

void SampleMaker::addCamera(std::size_t index, JsonNode& list)
{
  std::map<std::string, Rule> rules;
  this->Expansion.camera(index, 0, rules);
  const bool mayFail = rules.count("require") != 0;
  const CameraRequirement wanted =
    mayFail ? CameraRequirement::read(rules.at("require").rule) : CameraRequirement{ {}, 0, false, 1, false, 1 };
  const bool omitPath = rules.count("path") != 0 && rules.at("path").rule.root.find("otherwise") != nullptr &&
                        rules.at("path").rule.root.find("otherwise")->text == "omit";
  SampleNote note;
  for (int attempt = 0; attempt < wanted.attempts; ++attempt)
  {
    this->checkWanted();
    JsonNode camera;
    note = {};
    try
    {
      if (this->makeCamera(index, std::uint32_t(attempt), camera, note))
      {
        list.children.push_back(std::move(camera));
        if (!note.path.empty())
        {
          this->Notes.push_back(note);
        }
        return;
      }
    }
    catch (const SampleRefused& refused)
    {
      if (!omitPath)
      {
        throw;
      }
      this->Notes.push_back({ refused.path(), false, refused.why(), refused.attempts(), {} });
      this->Out.insert(index);
      return;
    }
  }
  if (!wanted.omit)
  {
    throw SampleRefused(note.path, note.why, note.attempts);
  }
  note.kept = false;
  this->Notes.push_back(note);
  this->Out.insert(index);
}

SceneSample SampleMaker::make()
{
  this->Tree = this->Expansion.world(this->Rules);
  this->settleObjects(false);
  this->checkWanted();
  this->place();
  this->leaveOut();
  for (JsonNode& light : itemsOf(this->Tree, "lights"))
  {
    aimAtNames(light, "target");
  }
  JsonNode rest = this->Tree;
  this->settle(rest, {}, {});
  this->Tree = std::move(rest);
  JsonNode unordered = this->Tree; // there are no cameras yet
  removeMember(unordered, "order");
  this->KeyFrames = this->readTree(unordered).keyFrames();
  this->Out.clear();
  if (this->Expansion.cameras() > 0)
  {
    JsonNode cameras(JsonNode::Type::Array);
    for (std::size_t i = 0; i < this->Expansion.cameras(); ++i)
    {
      this->addCamera(i, cameras);
    }
    this->Tree.add("cameras", std::move(cameras));
    removeWords(this->Tree, "camera", this->Out);
  }
  else if (const JsonNode* const cameras = this->Scene.document().root.find("cameras"))
  {
    this->Tree.add("cameras", *cameras);
  }
  SceneSample sample{ this->readTree(this->Tree), std::move(this->Notes) };
  sample.scene.seed = seedOfSample(this->Draws.seed(), this->Draws.sample());
  return sample;
}

} // namespace dgtk
