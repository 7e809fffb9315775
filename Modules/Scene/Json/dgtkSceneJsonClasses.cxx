// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkSceneFile.h"
#include "dgtkSceneJsonRows.h"

#include <algorithm>
#include <set>

namespace dgtk::scenefile
{

namespace
{
constexpr std::uint64_t largestClasses = std::uint64_t(64) << 20;

void readKeypointNames(const JsonCursor& at, ClassDescription& one)
{
  std::set<std::string_view> known;
  for (const JsonCursor& name : at.items())
  {
    const std::string& text = name.string(false);
    if (!known.insert(text).second)
    {
      name.fail("is named twice", "names of which each is another", quoted(text));
    }
    one.keypoints.push_back(text);
  }
}

void readSkeleton(const JsonCursor& at, ClassDescription& one)
{
  for (const JsonCursor& pair : at.items())
  {
    pair.listSize(2);
    one.skeleton.push_back({ static_cast<int>(pair.element(0).wholeNumber(rules::keypoint)),
      static_cast<int>(pair.element(1).wholeNumber(rules::keypoint)) });
  }
}

void checkSkeleton(const JsonCursor& at, const ClassDescription& one)
{
  const int count = static_cast<int>(one.keypoints.size());
  for (const std::array<int, 2>& pair : one.skeleton)
  {
    if (pair[0] == pair[1] || std::max(pair[0], pair[1]) > count)
    {
      at.fail("has a skeleton that joins no keypoints",
        "pairs of different numbers from 1 to " + std::to_string(count) + ", of \"keypoints\"",
        '[' + std::to_string(pair[0]) + ", " + std::to_string(pair[1]) + ']');
    }
  }
}

template <auto Member>
void writeList(const ClassDescription& one, const char* key, JsonNode& node)
{
  JsonNode list(JsonNode::Type::Array);
  for (const auto& item : one.*Member)
  {
    list.children.push_back(writeValue(item));
  }
  if (!list.children.empty())
  {
    node.add(key, std::move(list));
  }
}

bool isMoreThanNumber(const ClassDescription& one)
{
  return !one.supercategory.empty() || one.thing || one.color || !one.keypoints.empty() || !one.skeleton.empty();
}

ClassDescription readClass(const JsonCursor& at, const std::string& name)
{
  ClassDescription one;
  if (at.node().type == JsonNode::Type::Object)
  {
    readFields(at, classFields(), one);
    checkSkeleton(at, one);
    if (one.id == 0)
    {
      at.fail("has no number", "\"id\": " + std::string(rules::classId.text));
    }
  }
  else
  {
    one.id = static_cast<int>(at.wholeNumber(rules::classId));
  }
  const std::string fault = faultOfText(name, true);
  if (!fault.empty())
  {
    at.fail("has a name that cannot be used", fault);
  }
  one.name = name;
  return one;
}

std::vector<ClassDescription> readTable(const JsonCursor& at)
{
  std::vector<ClassDescription> table;
  std::set<int> ids;
  std::set<std::string> names; // twice only in a scene made by program
  for (std::size_t i = 0, n = at.memberCount(); i < n; ++i)
  {
    const JsonCursor member = at.member(i);
    table.push_back(readClass(member, at.key(i)));
    if (!ids.insert(table.back().id).second || !names.insert(table.back().name).second)
    {
      member.fail("is taken", "a number and a name that no other class has", std::to_string(table.back().id));
    }
  }
  if (table.empty())
  {
    at.fail("names no class", "\"NAME\": NUMBER");
  }
  return table;
}

void readClasses(const JsonCursor& at, SceneDescription& scene)
{
  if (at.node().type == JsonNode::Type::String)
  {
    scene.classFile = at.string(false);
  }
  else if (at.node().type == JsonNode::Type::Object)
  {
    scene.classes = readTable(at);
  }
  else
  {
    at.failType("an object of names and numbers, or the name of a file that holds one");
  }
}

JsonNode tableOf(const std::vector<ClassDescription>& classes)
{
  JsonNode table(JsonNode::Type::Object);
  for (const ClassDescription& one : classes)
  {
    table.add(one.name, isMoreThanNumber(one) ? writeFields(one, classFields()) : JsonNode::of(double(one.id)));
  }
  return table;
}

void writeClasses(const SceneDescription& scene, const char* key, JsonNode& node)
{
  if (!scene.classFile.empty())
  {
    node.add(key, JsonNode::of(scene.classFile));
    return;
  }
  JsonNode table = tableOf(scene.classes);
  if (!table.children.empty())
  {
    node.add(key, std::move(table));
  }
}
} // namespace

const std::vector<JsonField<ClassDescription>>& classFields()
{
  using Class = ClassDescription;
  static const std::vector<JsonField<Class>> fields{ row<&Class::id, rules::classId>("id"),
    row<&Class::supercategory>("supercategory"), row<&Class::thing>("thing"),
    row<&Class::color, rules::colorByte>("color"), { "keypoints", readKeypointNames, writeList<&Class::keypoints> },
    { "skeleton", readSkeleton, writeList<&Class::skeleton> } };
  return fields;
}

JsonField<SceneDescription> classesRow() { return { "classes", readClasses, writeClasses }; }

void readClassFile(SceneDescription& scene)
{
  if (!scene.classFile.empty())
  {
    scene.classes = dgtk::readClassFile(scene.resolve(scene.classFile));
  }
}

void readClassesOf(const JsonCursor& at, SceneDescription& scene)
{
  if (at.has("classes"))
  {
    readClasses(at["classes"], scene);
    readClassFile(scene);
  }
}

} // namespace dgtk::scenefile

namespace dgtk
{

std::vector<ClassDescription> readClassFile(const std::string& path)
{
  const JsonDocument document = parseJson(path, readFile(path, largestClasses));
  return scenefile::readTable(JsonCursor(document));
}

std::string classesText(const std::vector<ClassDescription>& classes)
{
  std::string text = scenefile::printJson(scenefile::tableOf(classes));
  for (std::size_t end; (end = text.find('\n')) != std::string::npos;)
  {
    const std::size_t next = text.find_first_not_of("\n ", end);
    text.replace(end, next - end, next == std::string::npos || end == 1 || text[next] == '}' ? "" : " ");
  }
  return text;
}

} // namespace dgtk
