// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkBopAnnotations.h"

#include "dgtkJsonFile.h"
#include "dgtkReadCoco.h"
#include "dgtkReadTexts.h"

#include <algorithm>

namespace dgtk
{

namespace
{
using Json = nlohmann::json;
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
  const std::string where = instance.picture.name + ", instance " + std::to_string(instance.number);
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
  const CameraRecord* camera = this->Judge.source().camera(instance.picture.camera, instance.picture.frame);
  this->Judge.holds("coco", this->File, where, camera != nullptr, "a picture of no camera", "one of the dataset");
  if (camera == nullptr)
  {
    return;
  }
  const int width = camera->width;
  const int height = camera->height;
  const Eigen::Vector4d box = cornersOfMask(whole, width);
  holds("category_id", instance.model);
  holds("area", std::count(visible.begin(), visible.end(), char(1)));
  holds("width", width);
  holds("height", height);
  holds("bbox", Json{ box[0], box[1], box[2] - box[0], box[3] - box[1] });
  holds("iscrowd", 0);
  holds("ignore", !instance.wanted);
  const Json& mask = one.at("segmentation");
  const bool same =
    mask.at("size") == Json{ height, width } && maskOfCounts(mask.at("counts"), width, height) == visible;
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
      this->Judge.exact("coco", "images", this->File, "", double(this->Document.at("images").size()),
        double(source.picturesBelow(folder)));
    });
}

} // namespace dgtk
