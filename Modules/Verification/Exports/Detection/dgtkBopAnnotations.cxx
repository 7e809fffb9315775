// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkBopAnnotations.h"

#include "dgtkJsonFile.h"
#include "dgtkReadTexts.h"

#include <algorithm>
#include <array>

namespace dgtk
{

namespace
{
using Json = nlohmann::json;

/// The pixels of counts of outside and inside in turns, column by column; rows top to bottom. Empty unless there are
/// as many as asked for.
std::vector<char> columnsOf(const std::vector<std::uint64_t>& counts, std::size_t height, std::size_t pixels)
{
  std::vector<char> columns;
  std::size_t next = 0;
  for (; next < counts.size() && counts[next] <= pixels - columns.size(); ++next)
  {
    columns.insert(columns.end(), counts[next], char(next % 2));
  }
  const bool whole = next == counts.size() && columns.size() == pixels && height > 0 && pixels % height == 0;
  std::vector<char> mask(whole ? pixels : 0);
  for (std::size_t i = 0; i < mask.size(); ++i)
  {
    mask[i % height * (pixels / height) + i / height] = columns[i];
  }
  return mask;
}

/// [x, y, width, height] of pixels that are not 0.
std::vector<double> boxOf(const std::vector<char>& mask, std::size_t width)
{
  std::array<double, 4> box{ infinite, infinite, -infinite, -infinite };
  for (std::size_t i = 0; i < mask.size(); ++i)
  {
    if (mask[i] != 0)
    {
      const auto x = double(i % std::max<std::size_t>(1, width));
      const auto y = double(i / std::max<std::size_t>(1, width));
      box = { std::min(box[0], x), std::min(box[1], y), std::max(box[2], x + 1), std::max(box[3], y + 1) };
    }
  }
  return { box[0], box[1], box[2] - box[0], box[3] - box[1] };
}
} // namespace

BopAnnotations::BopAnnotations(ExportJudge& judge, const std::string& file)
  : Judge(judge)
  , File(file)
  , Document(readJsonFile(judge.source().path(file)))
{
  constexpr std::int64_t most = 100000; // instances of a picture
  useJson(judge.source().path(file),
    [&]
    {
      for (const Json& one : this->Document.at("annotations"))
      {
        const std::int64_t image = one.at("image_id");
        const std::int64_t id = one.at("id");
        this->Annotations.emplace(std::make_pair(image, id - image * most), &one);
      }
    });
}

void BopAnnotations::judge(const Instance& instance, const std::vector<char>& visible, const std::vector<char>& whole)
{
  const auto found = this->Annotations.find({ instance.image, std::int64_t(instance.number) + 1 });
  const std::string where = instance.picture + ", instance " + std::to_string(instance.number);
  this->Judge.holds("coco", this->File, where, found != this->Annotations.end(), "no annotation", "one");
  if (found != this->Annotations.end())
  {
    useJson(
      this->Judge.source().path(this->File), [&] { this->judgeOne(where, *found->second, instance, visible, whole); });
  }
}

void BopAnnotations::judgeOne(const std::string& where, const Json& one, const Instance& instance,
  const std::vector<char>& visible, const std::vector<char>& whole)
{
  const auto holds = [&](const char* key, const Json& expected)
  {
    this->Judge.holds(
      "coco", this->File, where + ' ' + key, one.at(key) == expected, one.at(key).dump(), expected.dump());
  };
  const std::size_t width = one.at("width");
  const std::size_t height = one.at("height");
  holds("category_id", instance.model);
  holds("area", std::count(visible.begin(), visible.end(), char(1)));
  holds("bbox", boxOf(whole, width));
  holds("iscrowd", 0);
  holds("ignore", !instance.wanted);
  const Json& mask = one.at("segmentation");
  const bool same =
    mask.at("size") == Json{ height, width } && columnsOf(mask.at("counts"), height, visible.size()) == visible;
  this->Judge.holds("coco", this->File, where, same, "another mask", "mask_visib");
}

void BopAnnotations::judgeRest(const std::string& folder, std::set<int> models, std::size_t instances)
{
  const ExportedFrom& source = this->Judge.source();
  const auto holds = [&](const Json& one, bool right, const char* expected)
  { this->Judge.holds("coco", this->File, one.dump(), right, "another", expected); };
  useJson(source.path(this->File),
    [&]
    {
      for (const Json& one : this->Document.at("categories"))
      {
        const int id = one.at("id");
        holds(one, models.erase(id) > 0 && one.at("name") == std::to_string(id), "a model, once");
      }
      for (const Json& one : this->Document.at("images"))
      {
        const ExportedName* picture = source.named(folder + one.at("file_name").get<std::string>());
        holds(one, picture && stemOf(picture->name) == digitsOf(one.at("id").dump(), 6), "a picture");
        this->Judge.size(
          this->File, picture ? picture->camera : "", picture ? picture->frame : 0, one.at("width"), one.at("height"));
      }
      this->Judge.exact("coco", "categories", this->File, "left out", double(models.size()), 0);
      this->Judge.exact(
        "coco", "annotations", this->File, "", double(this->Document.at("annotations").size()), double(instances));
      const auto& names = source.record().names;
      const auto pictures = std::count_if(
        names.begin(), names.end(), [&](const ExportedName& one) { return one.name.rfind(folder, 0) == 0; });
      this->Judge.exact("coco", "images", this->File, "", double(this->Document.at("images").size()), double(pictures));
    });
}

} // namespace dgtk
