// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleTree.h"

#include "dgtkText.h"

#include <algorithm>

namespace dgtk::sampletree
{

namespace
{
JsonNode vectorNode(const Eigen::Vector3d& v, int line)
{
  JsonNode list(JsonNode::Type::Array);
  list.line = line;
  for (int i = 0; i < 3; ++i)
  {
    list.children.push_back(JsonNode::of(v[i]));
    list.children.back().line = line;
  }
  return list;
}

JsonNode* memberOf(JsonNode& object, const std::string& key) { return const_cast<JsonNode*>(object.find(key)); }

void aim(JsonNode& at)
{
  if (at.type == JsonNode::Type::String)
  {
    at = nodeOf({ false, at.text, { 0, 0, 0 }, 0 }, at.line);
  }
}
} // namespace

bool isAmong(const std::string& word, const std::vector<std::string>& words)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string escaped(const std::string& name)
{
  std::string out;
  for (const char c : name)
  {
    out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  }
  return out;
}

std::vector<JsonNode>& itemsOf(JsonNode& root, const std::string& list)
{
  static thread_local std::vector<JsonNode> none;
  JsonNode* const items = memberOf(root, list);
  none.clear();
  return items != nullptr && items->type == JsonNode::Type::Array ? items->children : none;
}

void setMember(JsonNode& object, const std::string& key, JsonNode value)
{
  if (JsonNode* const known = memberOf(object, key))
  {
    *known = std::move(value);
    return;
  }
  object.add(key, std::move(value));
}

void removeMember(JsonNode& object, const std::string& key)
{
  for (std::size_t i = 0; i + 1 < object.children.size(); i += 2)
  {
    if (object.children[i].text == key)
    {
      object.children.erase(
        object.children.begin() + std::ptrdiff_t(i), object.children.begin() + std::ptrdiff_t(i + 2));
      return;
    }
  }
}

std::string textOf(const JsonNode& node)
{
  switch (node.type)
  {
    case JsonNode::Type::Null:
      return "null";
    case JsonNode::Type::Boolean:
      return node.boolean ? "true" : "false";
    case JsonNode::Type::Number:
      return plainNumber(node.number);
    case JsonNode::Type::String:
      return jsonString(node.text);
    default:
      break;
  }
  const bool object = node.type == JsonNode::Type::Object;
  std::string text;
  for (std::size_t i = 0; i < node.children.size(); ++i)
  {
    const bool isValue = object && i % 2 == 1;
    text += (isValue ? ": " : i == 0 ? "" : ", ") + textOf(node.children[i]);
  }
  return (object ? "{ " : "[") + text + (object ? " }" : "]");
}

JsonNode keysNode(const std::vector<Key<Eigen::Vector3d>>& keys)
{
  JsonNode list(JsonNode::Type::Array);
  for (const Key<Eigen::Vector3d>& key : keys)
  {
    JsonNode entry(JsonNode::Type::Array);
    entry.children.push_back(JsonNode::of(double(key.frame)));
    entry.children.push_back(vectorNode(key.value, 0));
    list.children.push_back(std::move(entry));
  }
  JsonNode track(JsonNode::Type::Object);
  track.add("keys", std::move(list));
  return track;
}

bool hasGeometry(const JsonNode& node)
{
  return isGeometryPoint(node) || std::any_of(node.children.begin(), node.children.end(), hasGeometry);
}

void replacePoints(JsonNode& node, const std::string& path, const PointVisitor& visit)
{
  if (isGeometryPoint(node))
  {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    if (visit(node, path, x))
    {
      node = vectorNode(x, node.line);
    }
    return;
  }
  const bool object = node.type == JsonNode::Type::Object;
  for (std::size_t i = object; i < node.children.size(); i += 1 + object)
  {
    const std::string below =
      object ? (path.empty() ? "" : ".") + node.children[i - 1].text : '[' + std::to_string(i) + ']';
    replacePoints(node.children[i], path + below, visit);
  }
}

void aimAtNames(JsonNode& item, const std::string& key)
{
  if (JsonNode* const at = memberOf(item, key))
  {
    aim(*at);
  }
}

void aimPathAtNames(JsonNode& path)
{
  if (JsonNode* const orbit = memberOf(path, "orbit"))
  {
    aimAtNames(*orbit, "center");
  }
  if (JsonNode* const walk = memberOf(path, "walk"))
  {
    aimAtNames(*walk, "start");
  }
  if (JsonNode* const spline = memberOf(path, "spline"))
  {
    std::vector<JsonNode>& points = itemsOf(*spline, "points");
    std::for_each(points.begin(), points.end(), aim);
  }
}

JsonNode objectsAlone(const JsonNode& root)
{
  JsonNode alone(JsonNode::Type::Object);
  for (const char* key : { "upAxis", "units", "metresPerUnit", "fps", "keyFrames", "objects" })
  {
    if (const JsonNode* const value = root.find(key))
    {
      alone.add(key, *value);
      alone.children.back().line = value->line;
    }
  }
  replacePoints(alone, {},
    [](const JsonNode&, const std::string&, Eigen::Vector3d& x)
    {
      x.setOnes();
      return true;
    });
  return alone;
}

void removeItems(JsonNode& root, const std::string& list, const std::set<std::size_t>& out)
{
  std::vector<JsonNode>& items = itemsOf(root, list);
  for (auto i = out.rbegin(); i != out.rend(); ++i)
  {
    items.erase(items.begin() + std::ptrdiff_t(*i));
  }
}

void removeWords(JsonNode& root, const std::string& word, const std::set<std::size_t>& out)
{
  std::size_t index = 0;
  std::vector<JsonNode>& order = itemsOf(root, "order");
  order.erase(std::remove_if(order.begin(), order.end(),
                [&](const JsonNode& entry) { return entry.text == word && out.count(index++) != 0; }),
    order.end());
}

std::set<std::size_t> withChildren(const SceneDescription& scene, const std::set<std::size_t>& objects)
{
  std::set<std::size_t> all = objects;
  std::set<std::string> names;
  for (const std::size_t object : objects)
  {
    names.insert(scene.objects[object].name);
  }
  for (bool grows = true; grows;)
  {
    grows = false;
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
    {
      if (names.count(scene.objects[i].parent) != 0 && all.insert(i).second)
      {
        names.insert(scene.objects[i].name);
        grows = true;
      }
    }
  }
  return all;
}

} // namespace dgtk::sampletree
