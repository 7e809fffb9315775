// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFile.h"
#include "dgtkSceneJsonRows.h"

#include <set>

namespace dgtk::scenefile
{

namespace
{
constexpr std::uint64_t largestFile = std::uint64_t(64) << 20;

ClassDescription readClass(const JsonCursor& at, const std::string& name)
{
  ClassDescription one;
  if (at.node().type == JsonNode::Type::Object) // room for more than the number
  {
    readFields(at, classFields(), one);
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

void writeClasses(const SceneDescription& scene, const char* key, JsonNode& node)
{
  if (!scene.classFile.empty())
  {
    node.add(key, JsonNode::of(scene.classFile));
    return;
  }
  JsonNode table(JsonNode::Type::Object);
  for (const ClassDescription& one : scene.classes)
  {
    table.add(one.name, JsonNode::of(double(one.id)));
  }
  if (!table.children.empty())
  {
    node.add(key, std::move(table));
  }
}
} // namespace

const std::vector<JsonField<ClassDescription>>& classFields()
{
  static const std::vector<JsonField<ClassDescription>> fields{ row<&ClassDescription::id, rules::classId>("id") };
  return fields;
}

JsonField<SceneDescription> classesRow() { return { "classes", readClasses, writeClasses }; }

void readClassFile(SceneDescription& scene)
{
  if (!scene.classFile.empty())
  {
    const std::string path = scene.resolve(scene.classFile);
    const JsonDocument document = parseJson(path, readFile(path, largestFile));
    scene.classes = readTable(JsonCursor(document));
  }
}

} // namespace dgtk::scenefile
