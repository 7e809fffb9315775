// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleExpansion.h"

#include "dgtkError.h"
#include "dgtkSampleTree.h"
#include "dgtkSceneRandom.h"
#include "dgtkText.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr Range counts{ 0, 100000, false, false, "a whole number from 0 to 100000" };
constexpr std::size_t notCounted = std::size_t(-1);

bool isAmong(const std::string& word, const std::vector<std::string>& words)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A name as part of a path, as JSON pointers have it.
std::string escaped(const std::string& name)
{
  std::string out;
  for (const char c : name)
  {
    out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  }
  return out;
}

/// What an entry of a list is called in paths: key frames by their frame, so that another one changes none.
std::string elementName(const std::string& key, const JsonNode& element, std::size_t index)
{
  const bool isKeyFrame = key == "keys" && element.type == JsonNode::Type::Array && !element.children.empty() &&
                          element.children[0].type == JsonNode::Type::Number;
  return isKeyFrame ? '@' + plainNumber(element.children[0].number) : std::to_string(index);
}
} // namespace

SampleExpansion::At SampleExpansion::At::below(const std::string& key, const std::string& shownKey) const
{
  At at = *this;
  at.path += (at.path.empty() ? "" : "/") + escaped(key);
  at.shared += (at.shared.empty() ? "" : "/") + escaped(key);
  const bool isIndex = !shownKey.empty() && shownKey[0] == '[';
  at.shown += (at.shown.empty() || isIndex ? "" : ".") + shownKey;
  return at;
}

SampleExpansion::SampleExpansion(const RandomScene& scene, const SampleDraws& draws, std::vector<SampleValue>* values)
  : Scene(scene)
  , Draws(draws)
  , Values(values)
{
  const JsonNode& root = scene.document().root;
  if (const JsonNode* const parameters = root.find("parameters"))
  {
    if (parameters->type != JsonNode::Type::Object)
    {
      this->fail(*parameters, At{ {}, {}, "parameters" }, "has the wrong type", "an object", parameters->described());
    }
    for (std::size_t i = 0; i + 1 < parameters->children.size(); i += 2)
    {
      this->Parameters[parameters->children[i].text].first = Drawn::Never;
    }
  }
  const JsonNode* const objects = root.find("objects");
  for (std::size_t i = 0; objects != nullptr && objects->type == JsonNode::Type::Array && i < objects->children.size();
       ++i)
  {
    const JsonNode* const name = objects->children[i].find("name");
    if (name != nullptr && name->type == JsonNode::Type::String)
    {
      this->Objects.emplace(name->text, &objects->children[i]);
      this->Shown.emplace(name->text, "objects[" + std::to_string(i) + ']');
    }
  }
  const JsonNode* const cameras = root.find("cameras");
  this->CameraList = cameras != nullptr && cameras->type == JsonNode::Type::Array ? cameras : nullptr;
}

void SampleExpansion::fail(const JsonNode& node, const At& at, const std::string& what, const std::string& expected,
  const std::string& found) const
{
  throw InputError(
    this->Scene.document().file, node.line, at.shown.empty() ? what : at.shown + ' ' + what, expected, found);
}

JsonDocument SampleExpansion::documentOf(JsonNode node, const At& at) const
{
  const long line = node.line;
  return { std::move(node), this->Scene.document().file, at.shown, line };
}

JsonNode SampleExpansion::value(const JsonNode& node, const std::string& key, const At& at)
{
  if (node.type == JsonNode::Type::String && !node.text.empty() && node.text[0] == '$')
  {
    return this->parameter(node, at);
  }
  const std::string word = randomWordOf(key, node);
  if (!word.empty())
  {
    JsonNode drawn = this->random(word, node, at);
    this->tell(at.path, drawn);
    return drawn;
  }
  if (node.type == JsonNode::Type::Object)
  {
    return this->members(node, at, {});
  }
  if (node.type != JsonNode::Type::Array)
  {
    return node;
  }
  JsonNode list(JsonNode::Type::Array);
  list.line = node.line;
  list.children.reserve(node.children.size());
  for (std::size_t i = 0; i < node.children.size(); ++i)
  {
    const JsonNode& element = node.children[i];
    list.children.push_back(
      this->value(element, {}, at.below(elementName(key, element, i), '[' + std::to_string(i) + ']')));
  }
  return list;
}

void SampleExpansion::tell(const std::string& path, const JsonNode& drawn)
{
  if (this->Values == nullptr || sampletree::hasGeometry(drawn))
  {
    return;
  }
  const auto [at, isNew] = this->Told.emplace(path, this->Values->size());
  if (isNew)
  {
    this->Values->push_back({ path, {} });
  }
  (*this->Values)[at->second].value = sampletree::textOf(drawn);
}

void SampleExpansion::forget(const std::string& camera)
{
  while (this->Values != nullptr && !this->Values->empty() && this->Values->back().path.rfind(camera + '/', 0) == 0)
  {
    this->Told.erase(this->Values->back().path);
    this->Values->pop_back();
  }
}

JsonNode SampleExpansion::members(const JsonNode& node, const At& at, const std::vector<std::string>& without)
{
  JsonNode object(JsonNode::Type::Object);
  object.line = node.line;
  for (std::size_t i = 0; i + 1 < node.children.size(); i += 2)
  {
    const std::string& key = node.children[i].text;
    if (!key.empty() && key[0] == '$')
    {
      this->fail(node.children[i + 1], at.below(key, key), "is not known", "a key that does not begin with $");
    }
    if (!isAmong(key, without))
    {
      object.children.push_back(node.children[i]);
      object.children.push_back(this->value(node.children[i + 1], key, at.below(key, key)));
    }
  }
  return object;
}

JsonNode SampleExpansion::parameter(const JsonNode& node, const At& at)
{
  const std::string name = node.text.substr(1);
  if (!name.empty() && name[0] == '$') // a text that begins with $
  {
    JsonNode text = node;
    text.text = name;
    return text;
  }
  const auto found = this->Parameters.find(name);
  if (found == this->Parameters.end())
  {
    std::vector<std::string> names;
    for (const auto& one : this->Parameters)
    {
      names.push_back(one.first);
    }
    const std::string near = nearest(name, names);
    this->fail(
      node, at, "names no parameter", near.empty() ? "a key of parameters" : "perhaps $" + near, quoted(node.text));
  }
  auto& [drawn, value] = found->second;
  if (drawn == Drawn::Now)
  {
    this->fail(node, at, "depends on itself", "parameters without a circle", quoted(node.text));
  }
  if (drawn == Drawn::Never)
  {
    drawn = Drawn::Now;
    const std::uint32_t attempt = std::exchange(this->Attempt, 0);
    At place;
    place = place.below("parameters", "parameters").below(name, name);
    value = this->value(*this->Scene.document().root.find("parameters")->find(name), {}, place);
    this->Attempt = attempt;
    drawn = Drawn::Done;
    this->tell(place.path, value);
  }
  JsonNode copy = value;
  copy.line = node.line;
  return copy;
}

ValueUniforms SampleExpansion::uniforms(const JsonNode& node, const At& at, bool mayStratify)
{
  if (!at.named)
  {
    this->fail(
      node, at, "is random, but what it belongs to has no name", "\"name\": a text, by which draws are told apart");
  }
  bool stratify = this->Scene.stratify();
  if (const JsonNode* const own = node.find("stratify"))
  {
    if (own->type != JsonNode::Type::Boolean)
    {
      this->fail(*own, at.below("stratify", "stratify"), "has the wrong type", "true or false", own->described());
    }
    stratify = own->boolean;
  }
  return ValueUniforms(this->Draws, at.path, this->Attempt, stratify && mayStratify);
}

JsonNode SampleExpansion::arguments(const JsonNode& node, const At& at)
{
  JsonNode object(JsonNode::Type::Object);
  object.line = node.line;
  for (std::size_t i = 0; i + 1 < node.children.size(); i += 2)
  {
    const std::string& key = node.children[i].text;
    object.children.push_back(node.children[i]);
    object.children.push_back(
      key == "stratify" ? node.children[i + 1] : this->value(node.children[i + 1], key, at.below(key, key)));
  }
  return object;
}

JsonNode SampleExpansion::random(const std::string& word, const JsonNode& node, const At& at)
{
  if (word == "choice")
  {
    return this->choice(node, at);
  }
  if (word == "permutation")
  {
    return this->permutation(node, at);
  }
  const ValueUniforms uniform = this->uniforms(node, at);
  const JsonDocument document = this->documentOf(this->arguments(node, at), at);
  return drawnValue(word, JsonCursor(document), uniform, this->Scene.upAxis());
}

JsonNode SampleExpansion::choice(const JsonNode& node, const At& at)
{
  const ValueUniforms uniform = this->uniforms(node, at);
  const At inner = at.below("choice", "choice");
  for (std::size_t i = 0; i + 1 < node.children.size(); i += 2)
  {
    const std::string& key = node.children[i].text;
    if (!isAmong(key, { "choice", "weights", "stratify" }))
    {
      this->fail(node.children[i + 1], at.below(key, key), "is not known", "one of choice, weights, stratify");
    }
  }
  const JsonNode* written = node.find("choice");
  JsonNode drawn; // of a parameter that is a list
  const bool isDrawn = written->type == JsonNode::Type::String;
  if (isDrawn)
  {
    drawn = this->value(*written, {}, inner);
    written = &drawn;
  }
  const JsonNode* weightNode = node.find("weights");
  JsonNode options(JsonNode::Type::Array);
  if (written->type == JsonNode::Type::Object)
  {
    for (std::size_t i = 0; i + 1 < written->children.size(); i += 2)
    {
      const std::string& key = written->children[i].text;
      if (!isAmong(key, { "files", "weights" }))
      {
        this->fail(written->children[i + 1], inner.below(key, key), "is not known", "one of files, weights");
      }
    }
    weightNode = written->find("weights") != nullptr ? written->find("weights") : weightNode;
    if (written->find("files") == nullptr)
    {
      this->fail(*written, inner, "names nothing", "a list, or \"files\": a pattern");
    }
    const At filesAt = inner.below("files", "files");
    const JsonDocument pattern = this->documentOf(this->value(*written->find("files"), {}, filesAt), filesAt);
    for (const std::string& path : this->Scene.files(JsonCursor(pattern).string(false)))
    {
      options.children.push_back(JsonNode::of(path));
      options.children.back().line = node.line;
    }
    if (options.children.empty())
    {
      this->fail(
        pattern.root, filesAt, "names no file", "a pattern of files that are there", quoted(pattern.root.text));
    }
  }
  else if (written->type == JsonNode::Type::Array)
  {
    options = *written;
  }
  if (options.children.empty())
  {
    this->fail(*written, inner, "has nothing to choose from", "a list that is not empty", written->described());
  }
  std::vector<double> weights;
  if (weightNode != nullptr)
  {
    const At weightsAt = at.below("weights", "weights");
    const JsonDocument list = this->documentOf(this->value(*weightNode, {}, weightsAt), weightsAt);
    const JsonCursor cursor(list);
    cursor.listSize(options.children.size());
    constexpr Range weight{ 0, 1e15, false, false, "a number from 0 to 1e15" };
    for (const JsonCursor& one : cursor.items())
    {
      weights.push_back(one.number(weight));
    }
    if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; }))
    {
      cursor.fail("chooses nothing", "a weight above 0");
    }
  }
  const std::size_t index = chosen(uniform(0), options.children.size(), weights);
  const JsonNode& option = options.children[index];
  const std::string name = std::to_string(index);
  const bool isPlain = isDrawn || written->type == JsonNode::Type::Object;
  return isPlain ? option : this->value(option, {}, inner.below(name, '[' + name + ']'));
}

JsonNode SampleExpansion::permutation(const JsonNode& node, const At& at)
{
  At shared = at;
  shared.path = at.instance > 0 ? at.shared : at.path;
  const ValueUniforms uniform = this->uniforms(node, shared, false);
  for (std::size_t i = 0; i + 1 < node.children.size(); i += 2)
  {
    const std::string& key = node.children[i].text;
    if (!isAmong(key, { "permutation", "stratify" }))
    {
      this->fail(node.children[i + 1], at.below(key, key), "is not known", "one of permutation, stratify");
    }
  }
  const At inner = shared.below("permutation", "permutation");
  const JsonNode* written = node.find("permutation");
  JsonNode drawn;
  const bool isDrawn = written->type == JsonNode::Type::String;
  if (isDrawn)
  {
    drawn = this->value(*written, {}, inner);
    written = &drawn;
  }
  if (written->type != JsonNode::Type::Array)
  {
    this->fail(*written, inner, "has the wrong type", "a list", written->described());
  }
  const std::vector<std::size_t> order = shuffled(written->children.size(), uniform);
  const auto element = [&](std::size_t i)
  {
    const std::string name = std::to_string(order[i]);
    const JsonNode& one = written->children[order[i]];
    return isDrawn ? one : this->value(one, {}, inner.below(name, '[' + name + ']'));
  };
  if (at.instance > 0)
  {
    if (at.instance > order.size())
    {
      this->fail(*written, inner, "has too few values", "one for each of the instances",
        std::to_string(order.size()) + " for instance " + std::to_string(at.instance));
    }
    return element(at.instance - 1);
  }
  JsonNode list(JsonNode::Type::Array);
  list.line = node.line;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    list.children.push_back(element(i));
  }
  return list;
}

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
    count = this->countOf(parentOf(*item->second));
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
