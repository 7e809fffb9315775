// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"
#include "Info.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkError.h"
#include "dgtkFolder.h"
#include "dgtkFolderContents.h"
#include "dgtkLayerWriter.h"
#include "dgtkRunParts.h"
#include "dgtkSceneFolders.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <map>
#include <set>

namespace dgtk::app
{

namespace
{
/// Of a folder of datasets.
Json infoOfScenes(const std::string& folder)
{
  const DatasetsManifest manifest = readDatasets(folder);
  Json info;
  info["datasets"] = folder;
  info["version"] = manifest.version;
  info["request"] = Json::object();
  for (const auto& [key, value] : manifest.request)
  {
    info["request"][key] = utf8FromBytes(value);
  }
  info["left_out"] = Json::array();
  for (const std::string& name : manifest.leftOut)
  {
    info["left_out"].push_back(utf8FromBytes(name));
  }
  info["scenes"] = Json::array();
  for (const std::string& scene : sceneFoldersIn(folder))
  {
    info["scenes"].push_back(utf8FromBytes(scene));
  }
  return info;
}
} // namespace

Json infoOfDataset(const std::string& folder)
{
  if (!sceneFoldersIn(folder).empty())
  {
    return infoOfScenes(folder);
  }
  const Manifest manifest = readManifest(folder + "/manifest.json");
  std::set<std::string> cameras;
  std::set<int> frames;
  std::map<std::string, std::size_t> files;
  std::uint64_t bytes = 0;
  for (const DatasetFile& file : manifest.files)
  {
    bytes += file.bytes;
    if (!file.camera.empty())
    {
      cameras.insert(file.camera);
      frames.insert(file.frame);
      ++files[file.layer];
    }
  }
  Json info;
  info["dataset"] = folder;
  info["version"] = manifest.version;
  info["cameras"] = cameras;
  info["first_frame"] = frames.empty() ? Json(nullptr) : Json(*frames.begin());
  info["last_frame"] = frames.empty() ? Json(nullptr) : Json(*frames.rbegin());
  info["frames"] = frames.size();
  info["files"] = manifest.files.size();
  info["bytes"] = bytes;
  info["units"] = manifest.units;
  info["layers"] = Json::array();
  for (const LayerRecord& layer : manifest.layers)
  {
    info["layers"].push_back({ { "name", layer.spec.name }, { "format", layer.format },
      { "type", nameOf(storedType(layer.format, layer.spec.type)) }, { "channels", layer.spec.channels },
      { "unit", layer.spec.unit }, { "files", files[layer.spec.name] } });
  }
  info["classes"] = Json::array();
  const char* const objects = "objects.json";
  const Folder root(folder);
  for (const ClassRecord& one :
    root.look(objects) == EntryKind::Nothing ? std::vector<ClassRecord>() : readClasses(root.fileAt(objects)))
  {
    info["classes"].push_back({ { "id", one.id }, { "name", one.name } });
  }
  Json request = Json::object();
  for (const auto& [key, value] : manifest.request)
  {
    request[utf8FromBytes(key)] = value;
  }
  info["request"] = request;
  return info;
}

} // namespace dgtk::app
