// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneFragment.h"

#include "dgtkError.h"
#include "dgtkSceneFromText.h"

#include <set>

namespace dgtk
{

namespace
{
constexpr char afterFolder = '\0';
} // namespace

std::string fragmentText(const SceneDescription& part, const std::string& folder)
{
  SceneDescription alone = part;
  std::set<std::string> names;
  for (const ObjectDescription& object : alone.objects)
  {
    names.insert(object.name);
  }
  for (ObjectDescription& object : alone.objects)
  {
    object.parent = names.count(object.parent) != 0 ? object.parent : std::string();
  }
  return toJson(alone, folder);
}

std::optional<SceneDescription> readFragment(const std::string& text, const std::string& folder)
{
  try
  {
    SceneDescription part = readSceneText(text, folder);
    return part.items().empty() ? std::nullopt : std::make_optional(std::move(part));
  }
  catch (const Error&)
  {
    return std::nullopt;
  }
}

std::string packFragment(const SceneDescription& part)
{
  return part.folder + afterFolder + fragmentText(part, part.folder);
}

std::optional<SceneDescription> unpackFragment(const std::string& bytes)
{
  const std::size_t end = bytes.find(afterFolder);
  return end == std::string::npos ? std::nullopt : readFragment(bytes.substr(end + 1), bytes.substr(0, end));
}

} // namespace dgtk
