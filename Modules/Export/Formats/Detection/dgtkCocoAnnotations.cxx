// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCocoAnnotations.h"

#include "dgtkUtf8.h"

#include <algorithm>
#include <cstdio>

namespace dgtk::coco
{

std::string textOf(const Json& value) { return value.dump(); }

std::string pictureName(const DatasetShot& shot, const SafeNames& names, const std::string& extension)
{
  char frame[16];
  std::snprintf(frame, sizeof frame, "_%06d.", shot.frame());
  return names.known(shot.name()) + frame + extension;
}

std::int64_t imageIdOf(const DatasetShot& shot) { return static_cast<std::int64_t>(shot.number) + 1; }

std::int64_t annotationIdOf(const DatasetView& dataset, const DatasetShot& shot, std::uint32_t object)
{
  return static_cast<std::int64_t>(shot.number) * dataset.largestObject() + object;
}

std::string imageText(const DatasetView& dataset, const DatasetShot& shot, const std::string& file)
{
  Json image{ { "id", imageIdOf(shot) }, { "file_name", file }, { "width", shot.camera.width },
    { "height", shot.camera.height }, { "camera", utf8FromBytes(shot.name()) }, { "frame", shot.frame() } };
  if (dataset.manifest().info.count("license") > 0)
  {
    image["license"] = 1;
  }
  return textOf(image);
}

Json boxOf(const RunLengths& mask)
{
  const Eigen::Vector4d box = mask.box();
  return { box[0], box[1], box[2], box[3] };
}

Json annotationOf(const DatasetView& dataset, const DatasetShot& shot, std::uint32_t object, const RunLengths& visible)
{
  const ObjectRecord* record = dataset.object(object);
  return { { "id", annotationIdOf(dataset, shot, object) }, { "image_id", imageIdOf(shot) },
    { "category_id", record ? record->classId : 0 }, { "iscrowd", 0 }, { "area", visible.area() },
    { "bbox", boxOf(visible) }, { "object_id", object },
    { "object", record ? utf8FromBytes(record->name) : std::string() } };
}

Json categoriesOf(const DatasetView& dataset)
{
  Json categories = Json::array();
  for (const ClassRecord& one : dataset.classes())
  {
    categories.push_back({ { "id", one.id }, { "name", utf8FromBytes(namedClass(one.name)) },
      { "supercategory", utf8FromBytes(one.supercategory) } });
  }
  return categories;
}

namespace
{
void writeList(ExportFile& file, ExportSink& sink, const char* key, const std::string& list)
{
  file.write(std::string("  \"") + key + "\": [");
  const char* between = "\n    ";
  sink.notes(list,
    [&](const std::string& text)
    {
      file.write(between + text);
      between = ",\n    ";
    });
  file.write(std::string("\n  ],\n"));
}
} // namespace

namespace
{
/// What the dataset says of itself, in COCO's words.
Json cocoInfo(const DatasetView& dataset)
{
  Json info = Json::object();
  const std::map<std::string, std::string>& known = dataset.manifest().info;
  for (const auto& [key, name] : std::initializer_list<std::pair<const char*, const char*>>{
         { "description", "description" }, { "version", "version" }, { "author", "contributor" }, { "url", "url" },
         { "name", "name" }, { "citation", "citation" } })
  {
    const auto found = known.find(key);
    if (found != known.end())
    {
      info[name] = utf8FromBytes(found->second);
    }
  }
  info["made_by"] = "DGTk";
  return info;
}

Json licensesOf(const DatasetView& dataset)
{
  const std::map<std::string, std::string>& known = dataset.manifest().info;
  const auto name = known.find("license");
  const auto url = known.find("licenseUrl");
  Json licenses = Json::array();
  if (name != known.end())
  {
    licenses.push_back({ { "id", 1 }, { "name", utf8FromBytes(name->second) },
      { "url", url == known.end() ? std::string() : utf8FromBytes(url->second) } });
  }
  return licenses;
}
} // namespace

ExportItem document(const DatasetView& dataset, const std::string& name, const std::string& split,
  const std::string& annotations, const Json& categories)
{
  return { { name }, [&dataset, name, split, annotations, categories](ExportSink& sink)
    {
      const std::unique_ptr<ExportFile> file = sink.open(name);
      file->write(
        "{\n  \"info\": " + textOf(cocoInfo(dataset)) + ",\n  \"licenses\": " + textOf(licensesOf(dataset)) + ",\n");
      writeList(*file, sink, "images", "images:" + split);
      writeList(*file, sink, "annotations", annotations + ':' + split);
      file->write("  \"categories\": " + textOf(categories) + "\n}\n");
      file->finish();
    } };
}

} // namespace dgtk::coco
