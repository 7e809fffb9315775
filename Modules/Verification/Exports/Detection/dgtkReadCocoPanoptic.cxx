// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportPixels.h"
#include "dgtkJsonFile.h"
#include "dgtkReadCoco.h"

#include <algorithm>

// COCO's data format, "Panoptic Segmentation": ids are R + 256 G + 65536 B, 0 is void.

namespace dgtk
{

namespace
{
using Json = nlohmann::json;

/// What a picture's objects say of a segment.
struct Shown
{
  std::set<std::uint32_t> objects;
  std::uint64_t area = 0;
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
};

/// The segments of a PNG, and the objects that the dataset has at their pixels.
std::map<std::uint32_t, Shown> shownIn(const ExportedFrom& source, const std::string& file, const ExportedName& picture)
{
  const DecodedPixels pixels = decodePng(source.path(file), {});
  const PicturePointer ids = source.picture(picture.camera, picture.frame, "objects");
  std::map<std::uint32_t, Shown> segments;
  for (int y = 0; y < pixels.height && pixels.channels == 3; ++y)
  {
    for (int x = 0; x < pixels.width; ++x)
    {
      const double id = pixels.at(x, y, 0) + 256 * pixels.at(x, y, 1) + 65536 * pixels.at(x, y, 2);
      Shown& one = segments[std::uint32_t(id)];
      const bool first = one.area++ == 0;
      one.objects.insert(ids->id(x, y));
      one.left = first ? x : std::min(one.left, x);
      one.top = first ? y : std::min(one.top, y);
      one.right = first ? x : std::max(one.right, x);
      one.bottom = first ? y : std::max(one.bottom, y);
    }
  }
  return segments;
}

void readSegments(ExportJudge& judge, const std::string& file, const std::string& camera, const Json& annotation,
  const std::map<std::uint32_t, bool>& things, std::map<std::uint32_t, Shown> shown)
{
  shown.erase(0);
  for (const Json& one : annotation.at("segments_info"))
  {
    const auto id = one.at("id").get<std::uint32_t>();
    const auto category = one.at("category_id").get<std::uint32_t>();
    const std::string where = annotation.at("file_name").get<std::string>() + ", segment " + std::to_string(id);
    const auto found = shown.find(id);
    judge.holds("segments", file, where, found != shown.end() && things.count(category) > 0, "a segment",
      "one of the picture, of a category");
    if (found == shown.end() || things.count(category) == 0)
    {
      continue;
    }
    const Shown& own = found->second;
    judge.exact("area", "px", file, where, one.at("area"), double(own.area));
    const std::vector<double> box{ double(own.left), double(own.top), double(own.right + 1 - own.left),
      double(own.bottom + 1 - own.top) };
    judge.holds("crowds", file, where, one.at("iscrowd") == 0, one.at("iscrowd").dump(), "0");
    judge.holds("box", file, where, one.at("bbox").get<std::vector<double>>() == box, one.at("bbox").dump(), "its box");
    const bool same = std::all_of(own.objects.begin(), own.objects.end(),
      [&](std::uint32_t object)
      {
        const ObjectRecord* record = judge.source().object(camera, object);
        return record && record->classId == category;
      });
    judge.holds("category", file, where, same, std::to_string(category), "that of its objects");
    judge.holds("things", file, where, !things.at(category) || own.objects.size() == 1, "several objects", "one");
    shown.erase(found);
  }
  judge.holds("segments", file, annotation.at("file_name"), shown.empty(), "a segment without a word", "none");
}

/// Whether a category is of things; what the dataset or the request calls stuff is not.
std::map<std::uint32_t, bool> judgeThings(ExportJudge& judge, const std::string& file, const Json& categories)
{
  const std::vector<ClassRecord> classes = readClasses(judge.source().document("objects.json"));
  judgeCocoCategories(judge, file, categories, classes);
  std::string stuff;
  for (const auto& [option, value] : judge.source().record().request)
  {
    stuff = option == "stuff" && !value.empty() ? ',' + value + ',' : stuff;
  }
  std::map<std::uint32_t, bool> things;
  std::set<std::vector<double>> colors;
  for (std::size_t i = 0; i < std::min(categories.size(), classes.size()); ++i)
  {
    const Json& one = categories[i];
    const bool isThing = classes[i].thing != false && stuff.find(',' + classes[i].name + ',') == std::string::npos;
    judge.holds("things", file, one.at("name"), one.at("isthing") == int(isThing), one.at("isthing").dump(),
      "as the dataset has it");
    const std::vector<double> color = numberList(one.at("color"), 3);
    const bool own = !classes[i].color || std::equal(color.begin(), color.end(), classes[i].color->begin());
    judge.holds("colors", file, one.at("name"), own && (classes[i].color || colors.insert(color).second),
      one.at("color").dump(), classes[i].color ? "that of the class" : "another than those before");
    things[classes[i].id] = isThing;
  }
  return things;
}

void readDocument(ExportJudge& judge, const std::string& file)
{
  const std::string path = judge.source().path(file);
  const Json document = readJsonFile(path);
  const std::string folder = file.substr(0, file.size() - 5) + '/';      // without .json
  const std::string split = folder.substr(folder.find("panoptic_") + 9); // SPLIT/
  std::map<std::int64_t, const ExportedName*> images;
  useJson(path,
    [&]
    {
      const std::map<std::uint32_t, bool> things = judgeThings(judge, file, document.at("categories"));
      for (const Json& one : document.at("images"))
      {
        const ExportedName* name = judgeCocoImage(judge, file, split, one);
        judge.holds("ids", file, "image", images.emplace(one.at("id"), name).second, "an id twice", "each once");
      }
      judge.exact("annotations", "", file, "", double(document.at("annotations").size()), double(images.size()));
      for (const Json& one : document.at("annotations"))
      {
        const auto image = images.find(one.at("image_id").get<std::int64_t>());
        judge.holds(
          "ids", file, one.at("file_name"), image != images.end(), "an image that is not there", "one of them");
        if (const ExportedName* picture = image == images.end() ? nullptr : image->second)
        {
          const std::string map = folder + one.at("file_name").get<std::string>();
          readSegments(judge, file, picture->camera, one, things, shownIn(judge.source(), map, *picture));
        }
      }
    });
}
} // namespace

void readCocoPanoptic(ExportJudge& judge)
{
  for (const ExportedFile& one : judge.source().record().files)
  {
    const std::string& path = one.file.path;
    if (path.rfind("annotations/panoptic_", 0) == 0 && path.size() > 5 && path.substr(path.size() - 5) == ".json")
    {
      readDocument(judge, path);
    }
  }
}

} // namespace dgtk
