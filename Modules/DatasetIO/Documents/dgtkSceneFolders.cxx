// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneFolders.h"

#include "dgtkFile.h"
#include "dgtkFolder.h"
#include "dgtkJournal.h"
#include "dgtkJson.h"

#include <fstream>

namespace dgtk
{

namespace
{
/// Whether a manifest is of many scenes: their list stands at its beginning, a dataset's may be long.
bool speaksOfScenes(const std::string& path)
{
  constexpr std::size_t head = 4096;
  std::ifstream stream(path, std::ios::binary);
  std::string begin(head, '\0');
  stream.read(begin.data(), head);
  begin.resize(std::size_t(stream.gcount()));
  return begin.find("\"scenes\"") != std::string::npos;
}
} // namespace

std::vector<std::string> sceneFoldersIn(const std::string& folder)
{
  const Folder place(folder);
  if (place.look(manifestName) != EntryKind::File || !speaksOfScenes(place.fileAt(manifestName)))
  {
    return {};
  }
  const std::string path = place.fileAt(manifestName);
  const JsonDocument document = parseJson(path, readFile(path));
  std::vector<std::string> names;
  const JsonNode* scenes = document.root.find("scenes");
  if (scenes && scenes->type == JsonNode::Type::Array)
  {
    for (const JsonCursor& scene : JsonCursor(document)["scenes"].items())
    {
      names.push_back(scene["name"].string(false));
    }
  }
  return names;
}

} // namespace dgtk
