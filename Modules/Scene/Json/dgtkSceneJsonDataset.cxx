// SPDX-License-Identifier: BSD-3-Clause
// What a scene says of the datasets that are made of it, and of its unit of length.
#include "dgtkSceneJsonRows.h"

#include "dgtkText.h"

#include <algorithm>

namespace dgtk
{

namespace
{
struct Unit
{
  const char* name;
  double metres;
};
/// Symbols are read as they stand: Mm is no mm.
constexpr Unit symbols[] = { { "um", 1e-6 }, { "\xc2\xb5m", 1e-6 }, { "\xce\xbcm", 1e-6 }, { "mm", 1e-3 },
  { "cm", 1e-2 }, { "dm", 1e-1 }, { "m", 1 }, { "km", 1e3 }, { "in", 0.0254 }, { "ft", 0.3048 }, { "yd", 0.9144 },
  { "mi", 1609.344 } };
/// Words in any case.
constexpr Unit words[] = { { "metre", 1 }, { "inch", 0.0254 }, { "foot", 0.3048 }, { "yard", 0.9144 },
  { "mile", 1609.344 } };
constexpr Unit prefixes[] = { { "micro", 1e-6 }, { "milli", 1e-3 }, { "centi", 1e-2 }, { "deci", 1e-1 }, { "", 1 },
  { "kilo", 1e3 } };

/// "Meters" is "metre".
std::string wordOf(const std::string& name)
{
  std::string word = lower(name);
  if (word == "inches" || word == "feet")
  {
    return word == "feet" ? "foot" : "inch";
  }
  if (word.size() > 1 && word.back() == 's')
  {
    word.pop_back();
  }
  const std::string american = "meter";
  if (word.size() >= american.size() && word.compare(word.size() - american.size(), american.size(), american) == 0)
  {
    word.replace(word.size() - 2, 2, "re");
  }
  return word;
}
} // namespace

double metresOfUnit(const std::string& name)
{
  for (const Unit& unit : symbols)
  {
    if (name == unit.name)
    {
      return unit.metres;
    }
  }
  const std::string word = wordOf(name);
  for (const Unit& prefix : prefixes)
  {
    if (word == std::string(prefix.name) + "metre")
    {
      return prefix.metres;
    }
  }
  const auto* const found =
    std::find_if(std::begin(words), std::end(words), [&](const Unit& unit) { return word == unit.name; });
  return found == std::end(words) ? 0 : found->metres;
}

const std::vector<std::string>& datasetWords()
{
  static const std::vector<std::string> keys{ "name", "description", "version", "author", "license", "licenseUrl",
    "citation", "url" };
  return keys;
}

namespace scenefile
{

namespace
{
void readDataset(const JsonCursor& at, SceneDescription& scene)
{
  const std::vector<std::string>& known = datasetWords();
  for (std::size_t i = 0, n = at.memberCount(); i < n; ++i)
  {
    if (std::find(known.begin(), known.end(), at.key(i)) == known.end())
    {
      failKey(at, i, known);
    }
    scene.dataset[at.key(i)] = at.member(i).string(false);
  }
}

void writeDataset(const SceneDescription& scene, const char* key, JsonNode& node)
{
  JsonNode texts(JsonNode::Type::Object);
  std::map<std::string, std::string> others = scene.dataset;
  for (const std::string& word : datasetWords())
  {
    const auto found = others.find(word);
    if (found != others.end())
    {
      texts.add(word, JsonNode::of(found->second));
      others.erase(found);
    }
  }
  for (const auto& [word, text] : others) // unknown: refused where it is read
  {
    texts.add(word, JsonNode::of(text));
  }
  if (!texts.children.empty())
  {
    node.add(key, std::move(texts));
  }
}
} // namespace

JsonField<SceneDescription> datasetRow() { return { "dataset", readDataset, writeDataset }; }
JsonField<SceneDescription> metresRow()
{
  return row<&SceneDescription::metresPerUnit, rules::metres>("metresPerUnit");
}

} // namespace scenefile

} // namespace dgtk
