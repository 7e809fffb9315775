// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCocoAnnotations.h"

#include "dgtkUtf8.h"

#include <algorithm>
#include <cstdio>

namespace dgtk::coco
{

std::string textOf(const Json& value) { return value.dump(); }

std::string pictureName(const DatasetShot& shot, SafeNames& names, const std::string& extension)
{
  char frame[16];
  std::snprintf(frame, sizeof frame, "_%06d.", shot.frame());
  return names.of(shot.name()) + frame + extension;
}

std::int64_t imageIdOf(const DatasetShot& shot) { return static_cast<std::int64_t>(shot.index) + 1; }

std::int64_t annotationIdOf(const DatasetView& dataset, const DatasetShot& shot, std::uint32_t object)
{
  std::uint32_t largest = 0;
  for (const ObjectRecord& one : dataset.objects())
  {
    largest = std::max(largest, one.id);
  }
  return static_cast<std::int64_t>(shot.index) * largest + object;
}

std::string imageText(const DatasetShot& shot, const std::string& file)
{
  return textOf({ { "id", imageIdOf(shot) }, { "file_name", file }, { "width", shot.camera.width },
    { "height", shot.camera.height }, { "camera", utf8FromBytes(shot.name()) }, { "frame", shot.frame() } });
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
    categories.push_back({ { "id", one.id }, { "name", utf8FromBytes(one.name) }, { "supercategory", "" } });
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

ExportItem document(const DatasetView& dataset, const std::string& name, const std::string& split,
  const std::map<std::uint32_t, Json>& more)
{
  return { { name }, [&dataset, name, split, more](ExportSink& sink)
    {
      Json categories = categoriesOf(dataset);
      for (Json& category : categories)
      {
        const auto found = more.find(category["id"].get<std::uint32_t>());
        if (found != more.end())
        {
          category.update(found->second);
        }
      }
      const std::unique_ptr<ExportFile> file = sink.open(name);
      file->write("{\n  \"info\": " + textOf({ { "description", "made by DGTk" } }) + ",\n  \"licenses\": [],\n");
      writeList(*file, sink, "images", "images:" + split);
      writeList(*file, sink, "annotations", "annotations:" + split);
      file->write("  \"categories\": " + textOf(categories) + "\n}\n");
      file->finish();
    } };
}

} // namespace dgtk::coco
