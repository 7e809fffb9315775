// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportPixels.h"
#include "dgtkJsonFile.h"

#include <algorithm>

// COCO's data format (cocodataset.org/#format-data) and cocoapi's maskApi.c.

namespace dgtk
{

namespace
{
using Json = nlohmann::json;

std::vector<std::uint64_t> countsOf(const std::string& text)
{
  std::vector<std::uint64_t> counts;
  for (std::size_t at = 0; at < text.size();)
  {
    std::int64_t value = 0;
    int shift = 0;
    int code = 0;
    do
    {
      code = text[at++] - 48;
      value |= std::int64_t(code & 0x1f) << shift;
      shift += 5;
    } while ((code & 0x20) != 0 && at < text.size());
    if ((code & 0x10) != 0)
    {
      value |= -1 * (std::int64_t(1) << shift);
    }
    const std::size_t n = counts.size();
    counts.push_back(static_cast<std::uint64_t>(n > 2 ? value + std::int64_t(counts[n - 2]) : value));
  }
  return counts;
}

/// Rows top to bottom of a mask given column by column.
std::vector<char> filled(const std::vector<std::uint64_t>& counts, int width, int height)
{
  std::vector<char> mask(std::size_t(width) * height);
  std::size_t at = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    for (std::uint64_t k = 0; k < counts[i] && at < mask.size(); ++k, ++at)
    {
      mask[at % std::size_t(height) * std::size_t(width) + at / std::size_t(height)] = char(i % 2);
    }
  }
  return mask;
}

std::vector<char> maskOf(const Json& segmentation, int width, int height)
{
  if (segmentation.is_array())
  {
    std::vector<char> mask(std::size_t(width) * height);
    for (const Json& polygon : segmentation)
    {
      fillPolygon(polygon.get<std::vector<double>>(), width, height, mask);
    }
    return mask;
  }
  const Json& counts = segmentation.at("counts");
  return filled(counts.is_string() ? countsOf(counts.get<std::string>()) : counts.get<std::vector<std::uint64_t>>(),
    segmentation.at("size").at(1), segmentation.at("size").at(0));
}

Eigen::Vector4d cornersOf(const Json& box)
{
  const double x = box.at(0);
  const double y = box.at(1);
  return { x, y, x + box.at(2).get<double>(), y + box.at(3).get<double>() };
}

struct CocoImage
{
  std::string camera;
  int frame = 0;
  int width = 0;
  int height = 0;
  std::uint64_t annotations = 0;
};

std::uint64_t visibleObjects(const ExportedFrom& source, const CocoImage& image)
{
  const std::vector<BoxRecord>& boxes = source.boxes(image.camera, image.frame);
  return static_cast<std::uint64_t>(
    std::count_if(boxes.begin(), boxes.end(), [](const BoxRecord& box) { return box.visible.has_value(); }));
}

void readAnnotation(ExportJudge& judge, const std::string& file, const Json& one, CocoImage& image)
{
  const auto object = one.at("object_id").get<std::uint32_t>();
  const std::string where = "annotation " + one.at("id").dump();
  const std::vector<char> mask = maskOf(one.at("segmentation"), image.width, image.height);
  judge.box(file, image.camera, image.frame, object, cornersOf(one.at("bbox")), 0);
  judge.mask(file, image.camera, image.frame, object, mask);
  judge.number("area", "px", file, where, one.at("area"), double(std::count(mask.begin(), mask.end(), char(1))), 0);
  judge.amodalMask(
    file, image.camera, image.frame, object, maskOf(one.at("amodal_segmentation"), image.width, image.height));
  const ObjectRecord* record = judge.source().object(image.camera, object);
  judge.number("category", "id", file, where, one.at("category_id"), record ? record->classId : 0, 0);
  ++image.annotations;
}

/// x, y, v of the keypoints that a category names; pixels' centres are whole numbers.
void readKeypoints(
  ExportJudge& judge, const std::string& file, const Json& categories, const Json& one, const CocoImage& image)
{
  const auto object = one.at("object_id").get<std::uint32_t>();
  const std::vector<BoxRecord>& boxes = judge.source().boxes(image.camera, image.frame);
  const auto box = std::find_if(boxes.begin(), boxes.end(), [&](const BoxRecord& each) { return each.id == object; });
  const auto category = std::find_if(
    categories.begin(), categories.end(), [&](const Json& each) { return each.at("id") == one.at("category_id"); });
  const std::string where = "annotation " + one.at("id").dump();
  judge.holds("keypoints", file, where, category != categories.end() && box != boxes.end(), "no category", "one");
  if (category == categories.end() || box == boxes.end())
  {
    return;
  }
  int labelled = 0;
  const std::vector<std::string> names = category->at("keypoints");
  const std::vector<double> numbers = one.at("keypoints");
  judge.number("keypoints", "px", file, where, double(numbers.size()), double(3 * names.size()), 0);
  for (std::size_t i = 0; i < names.size() && numbers.size() == 3 * names.size(); ++i)
  {
    const double v = numbers[3 * i + 2];
    labelled += v > 0;
    const auto own = std::find_if(box->keypoints.begin(), box->keypoints.end(),
      [&](const KeypointRecord& point) { return point.name == names[i]; });
    const int seen = own == box->keypoints.end() ? 0 : own->visibility;
    const std::string what = where + ", " + names[i];
    judge.number("keypoints", "px", file, what, v, seen == 1 ? 2 : seen == 2 || seen == 3 ? 1 : 0, 0);
    const bool there = v > 0 && own != box->keypoints.end() && own->pixel;
    judge.number("keypoints", "px", file, what, numbers[3 * i], there ? own->pixel->x() - 0.5 : 0, 0);
    judge.number("keypoints", "px", file, what, numbers[3 * i + 1], there ? own->pixel->y() - 0.5 : 0, 0);
  }
  judge.number("keypoints", "px", file, where, one.at("num_keypoints"), labelled, 0);
}

std::uint64_t pointedObjects(const ExportedFrom& source, const CocoImage& image, const Json& categories)
{
  const std::vector<BoxRecord>& boxes = source.boxes(image.camera, image.frame);
  return static_cast<std::uint64_t>(std::count_if(boxes.begin(), boxes.end(),
    [&](const BoxRecord& box)
    {
      const ObjectRecord* object = source.object(image.camera, box.id);
      return box.visible && object &&
             std::any_of(
               categories.begin(), categories.end(), [&](const Json& one) { return one.at("id") == object->classId; });
    }));
}

void readInstances(ExportJudge& judge, const std::string& file, const std::string& kind)
{
  const std::string path = judge.source().path(file);
  const Json document = readJsonFile(path);
  const std::size_t slash = file.rfind('/') + 1;
  const std::string split = file.substr(slash + kind.size(), file.size() - slash - kind.size() - 5); // KINDSPLIT.json
  const bool pointed = kind == "person_keypoints_";
  useJson(path,
    [&]
    {
      std::map<std::int64_t, CocoImage> images;
      for (const Json& one : document.at("images"))
      {
        const ExportedName* name = judge.source().named(split + "/" + one.at("file_name").get<std::string>());
        const bool same =
          name && one.value("camera", name->camera) == name->camera && one.value("frame", name->frame) == name->frame;
        judge.holds("names", file, one.at("file_name"), same, "a picture", "one of export.json");
        const CocoImage image{ name ? name->camera : "", name ? name->frame : 0, one.at("width"), one.at("height") };
        judge.size(file, image.camera, image.frame, image.width, image.height);
        judge.holds("ids", file, "image", images.emplace(one.at("id"), image).second, "an id twice", "each once");
      }
      std::set<std::int64_t> ids;
      for (const Json& one : document.at("annotations"))
      {
        const auto id = one.at("id").get<std::int64_t>();
        judge.holds(
          "ids", file, "annotation", id > 0 && ids.insert(id).second, one.at("id").dump(), "each once, from 1");
        CocoImage& image = images.at(one.at("image_id"));
        readAnnotation(judge, file, one, image);
        if (pointed)
        {
          readKeypoints(judge, file, document.at("categories"), one, image);
        }
      }
      for (const auto& [id, image] : images)
      {
        judge.number("annotations", "objects", file, image.camera + " at frame " + std::to_string(image.frame),
          double(image.annotations),
          double(pointed ? pointedObjects(judge.source(), image, document.at("categories"))
                         : visibleObjects(judge.source(), image)),
          0);
      }
    });
}
} // namespace

void readCoco(ExportJudge& judge)
{
  for (const ExportedFile& one : judge.source().record().files)
  {
    for (const char* kind : { "instances_", "person_keypoints_" })
    {
      if (one.file.path.rfind(std::string("annotations/") + kind, 0) == 0)
      {
        readInstances(judge, one.file.path, kind);
      }
    }
  }
}

} // namespace dgtk
