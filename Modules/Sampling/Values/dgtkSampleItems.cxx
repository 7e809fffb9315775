// SPDX-License-Identifier: BSD-3-Clause
// Objects, lights and cameras of a random scene.
#include "dgtkSampleExpansion.h"

#include "dgtkError.h"
#include "dgtkSampleGeometry.h"
#include "dgtkSampleTree.h"
#include "dgtkSceneRandom.h"

#include <algorithm>

namespace dgtk
{

using sampletree::escaped;
using sampletree::isAmong;

namespace
{
constexpr Range counts{ 0, 100000, false, false, "a whole number from 0 to 100000" };
constexpr std::size_t notCounted = std::size_t(-1);

/// Whether a count is random, or a parameter that is.
bool isDrawn(const JsonNode& count, const JsonNode& root)
{
  const JsonNode* const parameters = root.find("parameters");
  const bool named = count.type == JsonNode::Type::String && parameters != nullptr;
  const JsonNode* const value = named ? parameters->find(count.text.substr(count.text.empty() ? 0 : 1)) : &count;
  return value != nullptr && value->type != JsonNode::Type::Number;
}
} // namespace

std::string SampleExpansion::nameOf(const JsonNode& item, const At& at) const
{
  const JsonNode* const name = item.find("name");
  if (name == nullptr)
  {
    return {};
  }
  if (name->type != JsonNode::Type::String || (!name->text.empty() && name->text[0] == '$'))
  {
    this->fail(*name, at.below("name", "name"), "cannot be random",
      "a text that does not begin with $, by which draws are told apart", name->described());
  }
  return name->text;
}

std::string SampleExpansion::parentOf(const JsonNode& item)
{
  const JsonNode* const parent = item.find("parent");
  return parent != nullptr && parent->type == JsonNode::Type::String ? parent->text : std::string();
}

std::size_t SampleExpansion::countOf(const std::string& name)
{
  const auto item = this->Objects.find(name);
  if (name.empty() || item == this->Objects.end())
  {
    return notCounted;
  }
  auto& [drawn, count] = this->Counts.emplace(name, std::pair(Drawn::Never, notCounted)).first->second;
  At at{ "objects/" + escaped(name), "objects/" + escaped(name), this->Shown.at(name) };
  const JsonNode* const own = item->second->find("count");
  if (drawn == Drawn::Never)
  {
    drawn = Drawn::Now; // parents in a circle are refused by whoever reads the plain scene
    const std::string parent = parentOf(*item->second);
    count = this->countOf(parent);
    if (own != nullptr ? isDrawn(*own, this->Scene.document().root) : this->Varying.count(parent) != 0)
    {
      this->Varying.insert(name);
    }
    if (own != nullptr)
    {
      at = at.below("count", "count");
      if (count != notCounted)
      {
        this->fail(*own, at, "is not wanted", "none: it is repeated with its parent");
      }
      const JsonDocument document = this->documentOf(this->value(*own, "count", at), at);
      count = std::size_t(JsonCursor(document).wholeNumber(counts));
    }
    drawn = Drawn::Done;
  }
  return count;
}

/// A place sets the position, and a fall the key frames of the orientation, which begins as it is said.
void SampleExpansion::refusePose(const JsonNode& item, const At& at, const JsonNode& place) const
{
  if (const JsonNode* const position = item.find("position"))
  {
    this->fail(
      *position, at.below("position", "position"), "stands beside a place", "one of position and place", "both");
  }
  const JsonNode* const orientation = item.find("orientation");
  if (orientation != nullptr && orientation->find("keys") != nullptr && place.find("drop") != nullptr)
  {
    this->fail(*orientation, at.below("orientation", "orientation"), "has key frames beside a place with drop",
      "the orientation in which it begins to fall", "key frames");
  }
}

void SampleExpansion::addObjects(const JsonNode& item, const At& at, std::vector<Rule>& rules, JsonNode& list)
{
  const std::string name = this->nameOf(item, at);
  if (name.empty() && item.find("count") != nullptr)
  {
    this->fail(*item.find("count"), at.below("count", "count"), "repeats an object without a name", "\"name\": a text");
  }
  const std::size_t count = this->countOf(name);
  const bool parentCounted = count != notCounted && this->countOf(parentOf(item)) != notCounted;
  this->Instances.push_back(count == notCounted ? 1 : count);
  for (std::size_t k = 1; k <= this->Instances.back(); ++k)
  {
    const std::string suffix = count == notCounted ? std::string() : '#' + std::to_string(k);
    At place{ "objects/" + escaped(name) + suffix, "objects/" + escaped(name), at.shown, count == notCounted ? 0 : k,
      !name.empty() };
    JsonNode object = this->members(item, place, { "count", "place", parentCounted ? "parent" : "count" });
    for (std::size_t i = 0; !suffix.empty() && i + 1 < object.children.size(); i += 2)
    {
      if (object.children[i].text == "name")
      {
        object.children[i + 1].text += suffix;
      }
    }
    if (parentCounted)
    {
      JsonNode parent = *item.find("parent");
      parent.text += suffix;
      object.add("parent", parent);
    }
    if (const JsonNode* const rule = item.find("place"))
    {
      const At ruleAt = place.below("place", "place");
      if (name.empty())
      {
        this->fail(*rule, ruleAt, "is of an object without a name", "\"name\": a text");
      }
      this->refusePose(item, place, *rule);
      rules.push_back(
        { list.children.size(), ruleAt.path, this->documentOf(this->value(*rule, "place", ruleAt), ruleAt) });
    }
    list.children.push_back(std::move(object));
  }
}

void SampleExpansion::addItems(const JsonNode& list, const std::string& key, std::vector<Rule>& rules, JsonNode& root)
{
  const At listAt{ key, key, key };
  if (!randomWordOf(key, list).empty() || list.type == JsonNode::Type::String)
  {
    this->fail(list, listAt, "cannot be random as a whole", "a list");
  }
  JsonNode out(list.type);
  out.line = list.line;
  if (list.type != JsonNode::Type::Array)
  {
    out = list; // whoever reads it refuses it
  }
  for (std::size_t i = 0; list.type == JsonNode::Type::Array && i < list.children.size(); ++i)
  {
    const JsonNode& item = list.children[i];
    const At at{ key, key, key + '[' + std::to_string(i) + ']' };
    if (!randomWordOf({}, item).empty() || item.type == JsonNode::Type::String)
    {
      this->fail(item, at, "cannot be random as a whole", "an object");
    }
    if (item.type != JsonNode::Type::Object)
    {
      out.children.push_back(item);
      continue;
    }
    if (key == "objects")
    {
      this->addObjects(item, at, rules, out);
      continue;
    }
    const std::string name = this->nameOf(item, at);
    const std::string path = key + '/' + escaped(name);
    out.children.push_back(this->members(item, At{ path, path, at.shown, 0, !name.empty() }, {}));
  }
  root.add(key, std::move(out));
}

void SampleExpansion::addOrder(const JsonNode& order, JsonNode& root)
{
  JsonNode out(order.type);
  out.line = order.line;
  std::size_t object = 0;
  for (const JsonNode& word : order.children)
  {
    const bool isObject = word.type == JsonNode::Type::String && word.text == "object";
    const std::size_t times = isObject && object < this->Instances.size() ? this->Instances[object] : 1;
    object += isObject ? 1 : 0;
    out.children.insert(out.children.end(), times, word);
  }
  root.add("order", std::move(out));
}

JsonNode SampleExpansion::world(std::vector<Rule>& rules)
{
  const JsonNode& scene = this->Scene.document().root;
  JsonNode root(JsonNode::Type::Object);
  root.line = scene.line;
  const JsonNode* order = nullptr;
  for (std::size_t i = 0; i + 1 < scene.children.size(); i += 2)
  {
    const std::string& key = scene.children[i].text;
    const JsonNode& node = scene.children[i + 1];
    if (isAmong(key, { "parameters", "stratify", "$schema", "cameras" }))
    {
      continue;
    }
    if (key == "objects" || key == "lights")
    {
      this->addItems(node, key, rules, root);
    }
    else if (key == "order")
    {
      order = &node;
    }
    else if (isAmong(key, { "seed", "upAxis", "version" }))
    {
      root.add(key, node);
    }
    else
    {
      root.add(key, this->value(node, key, At{ key, key, key }));
    }
  }
  if (order != nullptr)
  {
    this->addOrder(*order, root);
  }
  // Parameters that nothing uses are checked, too.
  for (const auto& one : this->Parameters)
  {
    JsonNode use = JsonNode::of('$' + one.first);
    use.line = scene.line;
    this->parameter(use, At{ {}, {}, "parameters" });
  }
  return root;
}

bool SampleExpansion::mayLack(const std::string& pattern) const
{
  const std::size_t hash = pattern.rfind('#');
  const std::string instance = hash == std::string::npos ? "#1" : pattern.substr(hash);
  return std::any_of(this->Varying.begin(), this->Varying.end(),
    [&](const std::string& name) { return !objectsLike({ name + instance }, pattern).empty(); });
}

bool SampleExpansion::isOfNone(const std::string& pattern) const
{
  return std::any_of(this->Counts.begin(), this->Counts.end(),
    [&](const auto& one) { return one.second.second == 0 && !objectsLike({ one.first }, pattern).empty(); });
}

std::string SampleExpansion::pathOfCamera(std::size_t index) const
{
  const At at{ "cameras", "cameras", "cameras[" + std::to_string(index) + ']' };
  return "cameras/" + escaped(this->nameOf(this->CameraList->children[index], at));
}

JsonNode SampleExpansion::camera(std::size_t index, std::uint32_t attempt, std::map<std::string, Rule>& rules)
{
  const JsonNode& item = this->CameraList->children[index];
  const At at{ "cameras", "cameras", "cameras[" + std::to_string(index) + ']' };
  if (!randomWordOf({}, item).empty() || item.type == JsonNode::Type::String)
  {
    this->fail(item, at, "cannot be random as a whole", "an object");
  }
  if (item.type != JsonNode::Type::Object)
  {
    return item;
  }
  this->Attempt = attempt;
  const std::string name = this->nameOf(item, at);
  const std::string path = "cameras/" + escaped(name);
  const At place{ path, path, at.shown, 0, !name.empty() };
  this->forget(path);
  JsonNode camera = this->members(item, place, randomCameraKeys());
  for (const std::string& key : randomCameraKeys())
  {
    if (const JsonNode* const rule = item.find(key))
    {
      const At ruleAt = place.below(key, key);
      if (name.empty())
      {
        this->fail(*rule, ruleAt, "is of a camera without a name", "\"name\": a text");
      }
      rules[key] = { index, ruleAt.path, this->documentOf(this->value(*rule, key, ruleAt), ruleAt) };
    }
  }
  this->Attempt = 0;
  return camera;
}

} // namespace dgtk
