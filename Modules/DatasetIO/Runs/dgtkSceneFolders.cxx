// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneFolders.h"

#include "dgtkFile.h"
#include "dgtkFolder.h"
#include "dgtkJournal.h"
#include "dgtkRunParts.h"

#include <filesystem>
#include <fstream>

namespace dgtk
{

namespace
{
/// Whether a manifest is of many scenes: its format stands at its beginning; a dataset's may be long.
bool speaksOfScenes(const std::string& path)
{
  constexpr std::size_t head = 4096;
  std::ifstream stream(path, std::ios::binary);
  std::string begin(head, '\0');
  stream.read(begin.data(), head);
  begin.resize(std::size_t(stream.gcount()));
  return begin.find("\"format\": \"DGTk datasets\"") != std::string::npos;
}
} // namespace

std::vector<std::string> sceneFoldersIn(const std::string& folder)
{
  const Folder place(folder);
  std::error_code code;
  if (!std::filesystem::is_regular_file(folder + '/' + manifestName, code) ||
      !speaksOfScenes(place.fileAt(manifestName)))
  {
    return {};
  }
  std::vector<std::string> names;
  for (const DatasetFile& file : readDatasets(folder).datasets)
  {
    names.push_back(file.path.substr(0, file.path.rfind('/')));
  }
  return names;
}

} // namespace dgtk
