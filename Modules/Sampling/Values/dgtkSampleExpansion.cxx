// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleExpansion.h"

#include "dgtkError.h"
#include "dgtkRuleValues.h"
#include "dgtkSampleTree.h"
#include "dgtkSceneRandom.h"
#include "dgtkText.h"

#include <algorithm>

namespace dgtk
{

using sampletree::escaped;
using sampletree::isAmong;

namespace
{
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
  if (this->Values == nullptr)
  {
    return;
  }
  // Those of other cameras of its rig may stand behind them.
  const auto end = std::remove_if(
    this->Values->begin(), this->Values->end(), [&](const auto& one) { return one.path.rfind(camera + '/', 0) == 0; });
  if (end == this->Values->end())
  {
    return;
  }
  this->Values->erase(end, this->Values->end());
  this->Told.clear();
  for (std::size_t i = 0; i < this->Values->size(); ++i)
  {
    this->Told.emplace((*this->Values)[i].path, i);
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
    for (const JsonCursor& one : cursor.items())
    {
      weights.push_back(one.number(samplerule::notNegative));
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

} // namespace dgtk
