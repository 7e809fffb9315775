// SPDX-License-Identifier: BSD-3-Clause
#include "Info.h"

#include "dgtkRandomScene.h"
#include "dgtkSceneRandom.h"
#include "dgtkText.h"

#include <nlohmann/json.hpp>

namespace dgtk::app
{

bool isRandomScene(const std::string& path)
{
  return extensionOf(path) == "json" && firstRandom(RandomScene::read(path)->document()).has_value();
}

Json infoOfRandomScene(const std::string& path)
{
  const std::shared_ptr<const RandomScene> scene = RandomScene::read(path);
  Json info;
  info["file"] = path;
  info["random"] = true;
  info["seed"] = scene->seed();
  info["stratify"] = scene->stratify();
  for (const char* list : { "objects", "lights", "cameras" })
  {
    info[list] = Json::array();
    const JsonNode* const items = scene->document().root.find(list);
    for (std::size_t i = 0; items != nullptr && i < items->children.size(); ++i)
    {
      const JsonNode* const name = items->children[i].find("name");
      info[list].push_back(name != nullptr ? name->text : std::string());
    }
  }
  info["parameters"] = Json::array();
  const JsonNode* const parameters = scene->document().root.find("parameters");
  for (std::size_t i = 0; parameters != nullptr && i + 1 < parameters->children.size(); i += 2)
  {
    info["parameters"].push_back(parameters->children[i].text);
  }
  info["values"] = Json::array();
  for (const RandomScene::Place& place : scene->places())
  {
    info["values"].push_back({ { "path", place.path }, { "kind", place.word }, { "line", place.line } });
  }
  return info;
}

} // namespace dgtk::app
