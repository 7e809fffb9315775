// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPlaceRule.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr Range atLeastZero{ 0, 1e9, false, false, "a number of at least 0" };
constexpr Range aboveZero{ 0, 1e9, true, false, "a number above 0" };

void checkKeys(const JsonCursor& at, const std::vector<std::string>& known)
{
  for (std::size_t i = 0; i < at.memberCount(); ++i)
  {
    if (std::find(known.begin(), known.end(), at.key(i)) == known.end())
    {
      std::string words;
      for (const std::string& word : known)
      {
        words += (words.empty() ? "" : ", ") + word;
      }
      at.fail("has a key " + quoted(at.key(i)) + " that is not known", words);
    }
  }
}

std::size_t objectOf(const JsonCursor& at, const SceneDescription& scene, std::size_t self)
{
  const std::string& name = at.string(false);
  const auto found = std::find_if(scene.objects.begin(), scene.objects.end(),
    [&name](const ObjectDescription& object) { return object.name == name; });
  if (found == scene.objects.end() || std::size_t(found - scene.objects.begin()) == self)
  {
    at.fail("is not another object's name", "the name of an object", quoted(name));
  }
  return std::size_t(found - scene.objects.begin());
}

template <typename Box, typename Vector>
Box boxOf(const JsonCursor& at)
{
  at.listSize(2);
  const Box box(at.element(0).matrix<Vector>(), at.element(1).matrix<Vector>());
  if (box.isEmpty())
  {
    at.fail("has a smallest corner beyond its largest");
  }
  return box;
}

DropRule readDrop(const JsonCursor& at)
{
  checkKeys(at, { "height", "friction", "restitution", "seconds", "bake", "from" });
  DropRule drop;
  const auto number = [&](const char* key, const Range& range, double& value)
  { value = at.has(key) ? at[key].number(range) : value; };
  number("height", atLeastZero, drop.height);
  number("friction", { 0, 10, false, false, "a number from 0 to 10" }, drop.friction);
  number("restitution", { 0, 1, false, false, "a number from 0 to 1" }, drop.restitution);
  number("seconds", { 0, 600, true, false, "a number above 0 and up to 600" }, drop.seconds);
  drop.keys = at.has("bake") && at["bake"].oneOf({ "pose", "keys" }) == 1;
  if (at.has("from"))
  {
    drop.from = int(at["from"].wholeNumber({ 0, double(largestFrame), false, false, "a frame from 0 to 999999" }));
  }
  return drop;
}
} // namespace

PlaceRule readPlaceRule(const SampleRule& rule, const SceneDescription& scene)
{
  const JsonCursor at(rule.rule);
  checkKeys(at, { "on", "in", "region", "drop", "proxy", "clearance", "attempts", "otherwise", "tolerance" });
  PlaceRule place;
  place.path = rule.path;
  place.object = rule.index;
  place.lacks = rule.lacks;
  if (!scene.objects[rule.index].parent.empty())
  {
    at.fail("is of an object with a parent, which is where its parent is");
  }
  if (at.has("on") == at.has("in"))
  {
    at.fail("must have one of the keys 'on' and 'in'");
  }
  place.in = at.has("in");
  const JsonCursor where = at[place.in ? "in" : "on"];
  if (place.in && where.node().type == JsonNode::Type::Array)
  {
    place.box = boxOf<Eigen::AlignedBox3d, Eigen::Vector3d>(where);
  }
  else if (rule.lacks.empty())
  {
    place.support = objectOf(where, scene, rule.index);
    if (!scene.objects[*place.support].parent.empty())
    {
      where.fail("names an object with a parent", "the object at the root, which stands for all that hangs on it");
    }
  }
  if (at.has("region"))
  {
    place.region = boxOf<Eigen::AlignedBox2d, Eigen::Vector2d>(at["region"]);
  }
  if (at.has("drop"))
  {
    place.drop = readDrop(at["drop"]);
  }
  if (at.has("proxy"))
  {
    if (!place.drop)
    {
      at["proxy"].fail("is of what falls", "'drop' beside it");
    }
    place.proxy = scene.resolve(at["proxy"].string(false));
  }
  place.clearance = at.has("clearance") ? at["clearance"].number(atLeastZero) : 0;
  if (at.has("attempts"))
  {
    place.attempts = int(at["attempts"].wholeNumber({ 1, 1e6, false, false, "a whole number from 1 to 1000000" }));
  }
  place.refuses = at.has("otherwise") && at["otherwise"].oneOf({ "omit", "refuse" }) == 1;
  if (at.has("tolerance"))
  {
    place.tolerance = at["tolerance"].number(aboveZero);
  }
  return place;
}

} // namespace dgtk
