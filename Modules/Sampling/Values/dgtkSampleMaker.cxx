// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleMaker.h"

#include "dgtkCameraPath.h"
#include "dgtkCameraRequirement.h"
#include "dgtkCameraRig.h"
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

void SampleMaker::failName(const JsonNode& node, const std::string& path, const std::string& name) const
{
  const bool isOfNone = this->Expansion.isOfNone(name);
  this->fail(node, path, isOfNone ? "names an object whose count is 0" : "names no object",
    isOfNone ? "one of which there are some" : "the name of an object of the scene", quoted(name));
}

std::string SampleMaker::pathOf(const std::string& shown) const
{
  const std::size_t dot = shown.find("].");
  const std::string list = shown.substr(0, shown.find_first_of(".["));
  if (dot == std::string::npos || (list != "objects" && list != "lights" && list != "cameras"))
  {
    return list;
  }
  const std::size_t index = std::stoul(shown.substr(list.size() + 1));
  const JsonNode* const items = this->Tree.find(list); // without cameras
  const JsonNode* const name = items == nullptr ? nullptr : items->children.at(index).find("name");
  const std::string item = items == nullptr
                             ? this->Expansion.pathOfCamera(index)
                             : list + '/' + (name == nullptr ? std::to_string(index) : escaped(name->text));
  return item + '/' + shown.substr(dot + 2, shown.find_first_of(".[", dot + 2) - dot - 2);
}

std::string SampleMaker::whyAbsent(const std::string& pattern) const
{
  if (!objectsLike(this->Gone, pattern).empty())
  {
    return quoted(pattern) + " is left out of the sample";
  }
  return this->Expansion.mayLack(pattern) ? quoted(pattern) + " has no instance in this sample" : std::string();
}

std::string SampleMaker::whyUnsupported(const JsonNode& rule) const
{
  const JsonNode* const on = rule.find("on");
  const JsonNode* const support = on == nullptr ? rule.find("in") : on;
  return support != nullptr && support->type == JsonNode::Type::String &&
             objectsLike(objectNamesOf(this->Objects), support->text).empty()
           ? this->whyAbsent(support->text)
           : std::string();
}

SceneDescription SampleMaker::readTree(const JsonNode& tree) const
{
  const JsonDocument document{ tree, this->Scene.document().file };
  return readSceneTree(document, this->Scene.file(), this->Scene.folder());
}

void SampleMaker::readObjects()
{
  this->Geometry.reset();
  this->Objects = this->readTree(objectsAlone(this->Tree));
  this->Geometry.emplace(this->Objects, this->Models);
}

bool SampleMaker::settle(JsonNode& node, const std::string& shown, const std::set<std::size_t>& waiting)
{
  bool all = true;
  replacePoints(node, shown,
    [&](const JsonNode& at, const std::string& path, Eigen::Vector3d& x)
    {
      if (!this->Geometry)
      {
        this->readObjects();
      }
      const GeometryPoint point = geometryPointOf(at);
      const std::vector<std::size_t>& found = this->Geometry->like(point.object);
      const std::string absent = found.empty() ? this->whyAbsent(point.object) : std::string();
      if (!absent.empty())
      {
        throw SampleRefused(this->pathOf(path), absent, 1);
      }
      if (found.empty())
      {
        this->failName(at, path, point.object);
      }
      if (point.onSurface && found.size() > 1)
      {
        this->fail(at, path, "names more than one object", "the name of an object of the scene", quoted(point.object));
      }
      const bool waits =
        std::any_of(found.begin(), found.end(), [&](std::size_t object) { return waiting.count(object) != 0; });
      all = all && !waits;
      if (!waits)
      {
        x = this->Geometry->at(point, found);
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
    this->readObjects();
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
      this->Geometry.reset();
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
  this->readObjects();
  this->Geometry.reset(); // which move now
  std::vector<SampleRule> rules;
  for (const Rule& rule : this->Rules)
  {
    rules.push_back({ rule.index, rule.path, rule.rule, this->whyUnsupported(rule.rule.root) });
  }
  const std::vector<PlaceOutcome> placed = placement().placeObjects(this->Objects, rules, this->Draws, this->Models);
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
      removeMember(items[one.index], key); // what is written without is its default
      if (const JsonNode* const value = written.root.find("objects")->children[one.index].find(key))
      {
        JsonNode copy = *value;
        copy.line = items[one.index].line;
        items[one.index].add(key, std::move(copy));
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
  this->Geometry.reset();
}

SampleWorld& SampleMaker::world()
{
  if (!this->World)
  {
    this->World = std::make_unique<SampleWorld>(this->readTree(objectsAlone(this->Tree)), this->Models);
  }
  return *this->World;
}

CameraDescription SampleMaker::cameraAlone(const JsonNode& camera) const
{
  JsonNode tree(JsonNode::Type::Object);
  if (const JsonNode* const up = this->Tree.find("upAxis"))
  {
    tree.add("upAxis", *up);
  }
  JsonNode list(JsonNode::Type::Array);
  list.children.push_back(camera);
  tree.add("cameras", std::move(list));
  return this->readTree(tree).cameras.front();
}

void SampleMaker::refusePose(const JsonNode& camera, const std::vector<const char*>& keys, const std::string& shown,
  const std::string& beside) const
{
  for (const char* key : keys)
  {
    if (const JsonNode* const pose = camera.find(key))
    {
      this->fail(*pose, shown + '.' + key, "stands beside a " + beside, beside + " or a pose of its own", "both");
    }
  }
}

void SampleMaker::travel(
  std::size_t index, std::uint32_t attempt, const SampleRule& path, JsonNode& camera, SampleNote& note)
{
  const std::string shown = "cameras[" + std::to_string(index) + ']';
  this->refusePose(camera, { "eye", "position", "orientation" }, shown, "path");
  SampleRule settled = path;
  aimPathAtNames(settled.rule.root);
  this->settle(settled.rule.root, shown + ".path", {});
  const bool looks = camera.find("lookAt") != nullptr;
  const TravelledPath baked = bakedPath(settled, this->world(), this->Scene.upAxis(), this->Draws, attempt, looks);
  setMember(camera, "eye", keysNode(baked.eye));
  if (!looks)
  {
    setMember(camera, "lookAt", keysNode(baked.lookAt));
  }
  note.path = path.path;
  note.attempts = baked.attempts;
}

void SampleMaker::mount(std::size_t index, const JsonDocument& rig, JsonNode& camera) const
{
  const std::string shown = "cameras[" + std::to_string(index) + ']';
  this->refusePose(camera, { "eye", "lookAt", "up", "position", "orientation" }, shown, "rig");
  for (const auto& base : this->Cameras)
  {
    if (base.second.find("name") != nullptr && base.second.find("name")->text == rig.root.find("camera")->text)
    {
      mountOn(camera, rig, this->cameraAlone(base.second));
      return;
    }
  }
}

bool SampleMaker::makeCamera(std::size_t index, std::uint32_t attempt, JsonNode& camera, SampleNote& note)
{
  const std::string shown = "cameras[" + std::to_string(index) + ']';
  std::map<std::string, Rule> rules;
  camera = this->Expansion.camera(index, attempt, rules);
  aimAtNames(camera, "lookAt");
  this->settle(camera, shown, {});
  const auto path = rules.find("path");
  const auto rig = rules.find("rig");
  if (rig != rules.end())
  {
    if (path != rules.end())
    {
      this->fail(path->second.rule.root, shown + ".path", "stands beside a rig", "one of path and rig", "both");
    }
    this->mount(index, rig->second.rule, camera);
  }
  if (path != rules.end())
  {
    this->travel(index, attempt, { index, path->second.path, path->second.rule }, camera, note);
  }
  const auto require = rules.find("require");
  if (require == rules.end())
  {
    return true;
  }
  note.path = require->second.path;
  note.attempts = int(attempt) + 1;
  SceneDescription alone;
  alone.cameras = { this->cameraAlone(camera) };
  std::vector<int> frames = alone.keyFrames();
  frames.insert(frames.end(), this->KeyFrames.begin(), this->KeyFrames.end());
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  const CameraRequirement wanted = CameraRequirement::read(require->second.rule);
  for (const CameraRequirement::Visible& one : wanted.visible)
  {
    if (!objectsLike(objectNamesOf(this->world().scene()), one.pattern).empty())
    {
      continue;
    }
    const std::string absent = this->whyAbsent(one.pattern);
    if (!absent.empty())
    {
      note.why = absent;
      return false;
    }
    const JsonNode& visible = *require->second.rule.root.find("visible");
    this->failName(*visible.find(one.pattern), shown + ".require.visible", one.pattern);
  }
  const CameraFit fit = fitOf(wanted, alone.cameras.front(), frames, this->world());
  note.measured = fit.measured;
  note.why = fit.why;
  return fit.fits;
}

void SampleMaker::leaveOutRig(const std::vector<std::size_t>& rig, std::size_t because, const SampleNote& note)
{
  const JsonNode* const name = this->Scene.document().root.find("cameras")->children[because].find("name");
  for (const std::size_t index : rig)
  {
    this->Cameras.erase(index);
    this->Out.insert(index);
    this->CameraNotes[index] = { this->Expansion.pathOfCamera(index) + "/rig", false,
      (name == nullptr ? std::string() : quoted(name->text)) + " of its rig is left out of the sample", note.attempts,
      {} };
  }
  this->CameraNotes[because] = note;
  this->CameraNotes[because].kept = false;
}

void SampleMaker::addRig(const std::vector<std::size_t>& rig)
{
  int attempts = 1;
  std::set<std::size_t> mayGo;     // where a requirement cannot be kept
  std::set<std::size_t> mayGoLost; // where there is no way
  for (const std::size_t index : rig)
  {
    std::map<std::string, Rule> rules;
    this->Expansion.camera(index, 0, rules);
    if (const auto require = rules.find("require"); require != rules.end())
    {
      const CameraRequirement wanted = CameraRequirement::read(require->second.rule);
      attempts = std::max(attempts, wanted.attempts);
      mayGo.insert(wanted.omit ? index : this->Expansion.cameras());
    }
    const auto path = rules.find("path");
    const JsonNode* const otherwise = path == rules.end() ? nullptr : path->second.rule.root.find("otherwise");
    mayGoLost.insert(otherwise != nullptr && otherwise->text == "omit" ? index : this->Expansion.cameras());
  }
  std::size_t failing = 0;
  SampleNote note;
  for (int attempt = 0; attempt < attempts; ++attempt)
  {
    this->checkWanted();
    bool fits = true;
    for (std::size_t i = 0; i < rig.size() && fits; ++i)
    {
      failing = rig[i];
      JsonNode camera;
      note = {};
      try
      {
        fits = this->makeCamera(failing, std::uint32_t(attempt), camera, note);
      }
      catch (const SampleRefused& refused)
      {
        if (mayGoLost.count(failing) == 0)
        {
          throw;
        }
        this->leaveOutRig(rig, failing, { refused.path(), false, refused.why(), refused.attempts(), {} });
        return;
      }
      this->Cameras[failing] = std::move(camera);
      if (!note.path.empty())
      {
        this->CameraNotes[failing] = note;
      }
    }
    if (fits)
    {
      return;
    }
  }
  if (mayGo.count(failing) == 0)
  {
    throw SampleRefused(note.path, note.why, note.attempts);
  }
  this->leaveOutRig(rig, failing, note);
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
    for (const std::vector<std::size_t>& rig : rigsOf(this->Scene.document()))
    {
      this->addRig(rig);
    }
    for (auto& camera : this->Cameras)
    {
      cameras.children.push_back(std::move(camera.second));
    }
    for (auto& note : this->CameraNotes)
    {
      this->Notes.push_back(std::move(note.second));
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
