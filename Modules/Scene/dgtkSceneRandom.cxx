// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneRandom.h"

#include <algorithm>

namespace dgtk
{

namespace
{
bool isAmong(const std::string& word, const std::vector<std::string>& words)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Objects whose keys are names of the user's, or, as those of an environment, say something else.
bool hasOwnKeys(const std::string& key)
{
  static const std::vector<std::string> names{ "materials", "classes", "keypoints", "environment", "parameters" };
  return isAmong(key, names);
}

std::optional<JsonCursor> randomBelow(const JsonCursor& at, const std::string& key)
{
  if (!randomWordOf(key, at.node()).empty())
  {
    return at;
  }
  std::optional<JsonCursor> found;
  if (at.node().type == JsonNode::Type::Object)
  {
    for (std::size_t i = 0, n = at.memberCount(); i < n && !found; ++i)
    {
      found = randomBelow(at.member(i), at.key(i));
    }
  }
  else if (at.node().type == JsonNode::Type::Array)
  {
    for (std::size_t i = 0, n = at.listSize(); i < n && !found; ++i)
    {
      found = randomBelow(at.element(i), {});
    }
  }
  return found;
}

std::optional<JsonCursor> keyAmong(const JsonCursor& at, const std::vector<std::string>& keys)
{
  for (std::size_t i = 0; at.node().type == JsonNode::Type::Object && i < at.memberCount(); ++i)
  {
    if (isAmong(at.key(i), keys))
    {
      return at.member(i);
    }
  }
  return {};
}

std::optional<JsonCursor> keyOfItems(
  const JsonCursor& root, const std::string& list, const std::vector<std::string>& keys)
{
  if (!root.has(list) || root[list].node().type != JsonNode::Type::Array)
  {
    return {};
  }
  std::optional<JsonCursor> found;
  for (const JsonCursor& item : root[list].items())
  {
    found = found ? found : keyAmong(item, keys);
  }
  return found;
}
} // namespace

const std::vector<std::string>& randomWords()
{
  static const std::vector<std::string> words{ "uniform", "normal", "logUniform", "integer", "choice", "permutation",
    "rotation", "inBox", "inSphere", "shell", "onSurface", "centerOf" };
  return words;
}

std::string randomWordOf(const std::string& key, const JsonNode& node)
{
  if (node.type != JsonNode::Type::Object || hasOwnKeys(key))
  {
    return {};
  }
  const bool alone = node.children.size() <= 2 || (node.children.size() == 4 && node.find("stratify") != nullptr);
  for (std::size_t i = 0; i + 1 < node.children.size(); i += 2)
  {
    const std::string& word = node.children[i].text;
    // Somebody may write these for an orientation or a map of normals.
    const bool isMeant = alone || (word != "rotation" && word != "normal");
    if (isMeant && isAmong(word, randomWords()))
    {
      return word;
    }
  }
  return {};
}

const std::vector<std::string>& randomSceneKeys()
{
  static const std::vector<std::string> keys{ "parameters", "stratify" };
  return keys;
}

const std::vector<std::string>& randomObjectKeys()
{
  static const std::vector<std::string> keys{ "count", "place" };
  return keys;
}

const std::vector<std::string>& randomCameraKeys()
{
  static const std::vector<std::string> keys{ "path", "require", "rig" };
  return keys;
}

std::optional<JsonCursor> firstRandom(const JsonDocument& document)
{
  const JsonCursor root(document);
  if (root.node().type != JsonNode::Type::Object)
  {
    return {};
  }
  std::optional<JsonCursor> found = keyAmong(root, randomSceneKeys());
  found = found ? found : keyOfItems(root, "objects", randomObjectKeys());
  found = found ? found : keyOfItems(root, "cameras", randomCameraKeys());
  return found ? found : randomBelow(root, {});
}

} // namespace dgtk
