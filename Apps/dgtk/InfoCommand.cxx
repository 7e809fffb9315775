// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"
#include "Info.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkFolderContents.h"
#include "dgtkModelReader.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace dgtk::app
{

namespace
{
Json infoOfModel(const std::string& path)
{
  ReadOptions options;
  options.decodeTextures = false;
  const std::shared_ptr<const Model> model = readModel(path, options);
  Json info;
  info["file"] = path;
  info["format"] = model->format;
  info["triangles"] = model->declaredTriangles > 0 ? model->declaredTriangles : model->triangles.size();
  info["drawn_triangles"] = model->triangles.size();
  info["vertices"] = model->fileVertices();
  info["parts"] = model->parts.size();
  info["materials"] = model->declaredMaterials;
  info["textures"] = Json::array();
  for (const Texture& texture : model->textures)
  {
    info["textures"].push_back({ { "name", texture.name }, { "found", !texture.path.empty() } });
  }
  const bool empty = (model->boundsMin.array() > model->boundsMax.array()).any();
  info["bounds"] = empty ? Json(nullptr) : Json::array({ vector(model->boundsMin), vector(model->boundsMax) });
  info["two_sided_triangles"] = model->twoSidedTriangles;
  info["two_sided_surfaces"] = model->twoSidedSurfaces;
  info["lines"] = model->lines;
  info["frames"] = model->frames;
  info["animations"] = Json::array();
  info["animations_beside"] = Json::array(); // of files that accompany the model
  for (const Animation& animation : model->animations)
  {
    info[animation.beside ? "animations_beside" : "animations"].push_back(
      { { "name", animation.name }, { "first", animation.first }, { "last", animation.last },
        { "end", animation.first + animation.span() }, { "fps", animation.fps } });
  }
  info["warnings"] = model->warnings;
  return info;
}

/// Names of files may be any bytes; JSON holds UTF-8. No zero has a sign.
void toPrint(Json& value)
{
  if (value.is_string())
  {
    value = utf8FromBytes(value.get<std::string>());
  }
  else if (value.is_number_float())
  {
    value = value.get<double>() + 0.0;
  }
  else if (value.is_structured())
  {
    std::for_each(value.begin(), value.end(), toPrint);
  }
}

std::string shown(Json value)
{
  if (value.is_string())
  {
    return printable(value.get<std::string>());
  }
  toPrint(value);
  return value.dump();
}

// "key: value" lines; lists of objects become indented blocks.
void appendLines(const Json& value, const std::string& indent, std::string& text)
{
  for (const auto& [key, item] : value.items())
  {
    const bool blocks = item.is_object() || (item.is_array() && !item.empty() && item[0].is_object());
    if (!blocks)
    {
      text += indent + key + ": " + shown(item) + '\n';
      continue;
    }
    text += indent + key + ":\n";
    if (item.is_object())
    {
      appendLines(item, indent + "  ", text);
      continue;
    }
    for (const Json& entry : item)
    {
      std::string block;
      appendLines(entry, indent + "    ", block);
      block.replace(indent.size() + 2, 1, "-");
      text += block;
    }
  }
}

Json infoOf(const Arguments& arguments)
{
  const std::string& path = arguments.positional()[0];
  std::error_code code; // what cannot be asked is told when it is read
  if (!std::filesystem::exists(path, code) && !code)
  {
    throw InputError(path, std::string("cannot be read: ") + std::strerror(ENOENT));
  }
  const bool folder = std::filesystem::is_directory(path, code);
  const bool manifest = !folder && std::filesystem::path(path).filename() == "manifest.json";
  const bool scene = !folder && !manifest && (extensionOf(path) == "scene" || extensionOf(path) == "json");
  const bool random = scene && isRandomScene(path);
  if (scene && !random)
  {
    return infoOfScene(path, arguments);
  }
  for (const char* const option : { "--size", "--surfaces" })
  {
    if (arguments.has(option))
    {
      throw UsageError(std::string(option) + (random ? " is for a scene without random values" : " is for a scene"));
    }
  }
  if (folder)
  {
    requireDataset(path);
    return infoOfDataset(path);
  }
  if (manifest)
  {
    const std::string parent = std::filesystem::path(path).parent_path().string();
    return infoOfDataset(parent.empty() ? "." : parent);
  }
  return random ? infoOfRandomScene(path) : infoOfModel(path);
}

int runInfo(const Arguments& arguments)
{
  Json info = infoOf(arguments);
  std::string text;
  if (arguments.has("--json"))
  {
    toPrint(info);
    text = info.dump(2) + '\n';
  }
  else
  {
    appendLines(info, "", text);
  }
  print(text);
  return 0;
}
} // namespace

Command infoCommand()
{
  return { "FILE", 1, 1,
    { { "--json", "", "", "print one JSON object" },
      { "--size", "WxH", "", "of a scene: size of the images (default: the camera's own, else 640x480)" },
      { "--surfaces", "", "", "of a scene: world units per pixel over what each camera sees at its first frame" },
      noCacheOption },
    &runInfo };
}

} // namespace dgtk::app
