// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadCoco.h"

#include "dgtkExportPixels.h"
#include "dgtkJsonFile.h"
#include "dgtkUtf8.h"

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
    std::uint64_t value = 0;
    int shift = 0; // of more bits than there are, the first ones count
    int code = 0;
    do
    {
      code = text[at++] - 48;
      value |= shift < 64 ? std::uint64_t(code & 0x1f) << shift : 0;
      shift = std::min(shift + 5, 64);
    } while ((code & 0x20) != 0 && at < text.size());
    if ((code & 0x10) != 0 && shift < 64)
    {
      value |= ~std::uint64_t(0) << shift;
    }
    const std::size_t n = counts.size();
    counts.push_back(n > 2 ? value + counts[n - 2] : value);
  }
  return counts;
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
  const bool sized = segmentation.at("size") == Json{ height, width };
  return sized ? maskOfCounts(countsOf(segmentation.at("counts")), width, height) : std::vector<char>();
}

Eigen::Vector4d cornersOf(const Json& box)
{
  const std::vector<double> numbers = numberList(box, 4);
  return { numbers[0], numbers[1], numbers[0] + numbers[2], numbers[1] + numbers[3] };
}

struct CocoImage
{
  const ExportedName* picture = nullptr;
  int width = 0;
  int height = 0;
  std::uint64_t annotations = 0;
};

std::uint64_t visibleObjects(const ExportedFrom& source, const CocoImage& image)
{
  const std::vector<BoxRecord>& boxes = source.boxes(image.picture->camera, image.picture->frame);
  return static_cast<std::uint64_t>(
    std::count_if(boxes.begin(), boxes.end(), [](const BoxRecord& box) { return box.visible.has_value(); }));
}

void readAnnotation(ExportJudge& judge, const std::string& file, const Json& one, CocoImage& image)
{
  const auto object = one.at("object_id").get<std::uint32_t>();
  const std::string& camera = image.picture->camera;
  const int frame = image.picture->frame;
  const std::string where = "annotation " + one.at("id").dump();
  const std::vector<char> mask = maskOf(one.at("segmentation"), image.width, image.height);
  const std::vector<char> whole = maskOf(one.at("amodal_segmentation"), image.width, image.height);
  judge.box(file, camera, frame, object, cornersOf(one.at("bbox")), 0);
  judge.mask(file, camera, frame, object, mask);
  judge.exact("area", "px", file, where, one.at("area"), double(std::count(mask.begin(), mask.end(), char(1))));
  judge.amodalMask(file, camera, frame, object, whole);
  judge.holds("amodal box", file, where, cornersOf(one.at("amodal_bbox")) == cornersOfMask(whole, image.width),
    one.at("amodal_bbox").dump(), "that of the mask");
  judge.holds("crowds", file, where, one.at("iscrowd") == 0, one.at("iscrowd").dump(), "0");
  const ObjectRecord* record = judge.source().object(camera, object);
  judge.exact("category", "id", file, where, one.at("category_id"), record ? record->classId : 0);
  judge.holds("object", file, where, record && one.at("object") == utf8FromBytes(record->name), one.at("object").dump(),
    "the name of the object");
  for (const BoxRecord& box : judge.source().boxes(camera, frame))
  {
    if (box.id == object)
    {
      judge.exact("visible fraction", "1", file, where, one.at("visible_fraction"),
        double(box.pixelsVisible) / double(box.pixelsAmodal));
    }
  }
  ++image.annotations;
}

/// x, y, v of the keypoints that a category names; pixels' centres are whole numbers.
void readKeypoints(
  ExportJudge& judge, const std::string& file, const Json& categories, const Json& one, const CocoImage& image)
{
  const auto object = one.at("object_id").get<std::uint32_t>();
  const std::vector<BoxRecord>& boxes = judge.source().boxes(image.picture->camera, image.picture->frame);
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
  judge.exact("keypoints", "px", file, where, double(numbers.size()), double(3 * names.size()));
  for (std::size_t i = 0; i < names.size() && numbers.size() == 3 * names.size(); ++i)
  {
    const double v = numbers[3 * i + 2];
    labelled += v > 0;
    const auto own = std::find_if(box->keypoints.begin(), box->keypoints.end(),
      [&](const KeypointRecord& point) { return point.name == names[i]; });
    const int seen = own == box->keypoints.end() ? 0 : own->visibility;
    const std::string what = where + ", " + names[i];
    judge.exact("keypoints", "px", file, what, v, seen == 1 ? 2 : seen == 2 || seen == 3 ? 1 : 0);
    const bool there = v > 0 && own != box->keypoints.end() && own->pixel;
    judge.exact("keypoints", "px", file, what, numbers[3 * i], there ? own->pixel->x() - 0.5 : 0);
    judge.exact("keypoints", "px", file, what, numbers[3 * i + 1], there ? own->pixel->y() - 0.5 : 0);
  }
  judge.exact("keypoints", "px", file, where, one.at("num_keypoints"), labelled);
}

std::uint64_t pointedObjects(const ExportedFrom& source, const CocoImage& image, const Json& categories)
{
  const std::vector<BoxRecord>& boxes = source.boxes(image.picture->camera, image.picture->frame);
  return static_cast<std::uint64_t>(std::count_if(boxes.begin(), boxes.end(),
    [&](const BoxRecord& box)
    {
      const ObjectRecord* object = source.object(image.picture->camera, box.id);
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
      std::vector<ClassRecord> classes = readClasses(judge.source().document("objects.json"));
      classes.erase(std::remove_if(classes.begin(), classes.end(),
                      [&](const ClassRecord& one) { return pointed && one.keypoints.empty(); }),
        classes.end());
      const Json& categories = document.at("categories");
      judgeCocoCategories(judge, file, categories, classes);
      std::map<std::int64_t, CocoImage> images;
      for (const Json& one : document.at("images"))
      {
        CocoImage image{ judgeCocoImage(judge, file, split + '/', one) };
        const CameraRecord* camera =
          image.picture ? judge.source().camera(image.picture->camera, image.picture->frame) : nullptr;
        image.width = camera ? camera->width : 0;
        image.height = camera ? camera->height : 0;
        const bool first = !image.picture || images.emplace(one.at("id"), image).second;
        judge.holds("ids", file, "image", first, "an id twice", "each once");
      }
      std::set<std::int64_t> ids;
      for (const Json& one : document.at("annotations"))
      {
        const auto id = one.at("id").get<std::int64_t>();
        judge.holds(
          "ids", file, "annotation", id > 0 && ids.insert(id).second, one.at("id").dump(), "each once, from 1");
        const auto image = images.find(one.at("image_id"));
        judge.holds("ids", file, "annotation", image != images.end(), one.at("image_id").dump(), "one of the images");
        if (image != images.end())
        {
          readAnnotation(judge, file, one, image->second);
          if (pointed)
          {
            readKeypoints(judge, file, categories, one, image->second);
          }
        }
      }
      for (const auto& [id, image] : images)
      {
        judge.exact("annotations", "objects", file, image.picture->name, double(image.annotations),
          double(pointed ? pointedObjects(judge.source(), image, categories) : visibleObjects(judge.source(), image)));
      }
      judge.exact("images", "", file, split, double(images.size()), double(judge.source().picturesBelow(split + '/')));
    });
}
} // namespace

std::vector<char> maskOfCounts(const std::vector<std::uint64_t>& counts, int width, int height)
{
  std::vector<char> mask(std::size_t(width) * height);
  std::size_t at = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    if (counts[i] > mask.size() - at)
    {
      return {};
    }
    for (const std::size_t end = at + counts[i]; at < end; ++at)
    {
      mask[at % std::size_t(height) * std::size_t(width) + at / std::size_t(height)] = char(i % 2);
    }
  }
  return at == mask.size() ? mask : std::vector<char>();
}

Eigen::Vector4d cornersOfMask(const std::vector<char>& mask, int width)
{
  Eigen::Vector4d corners(infinite, infinite, -infinite, -infinite);
  for (std::size_t i = 0; i < mask.size(); ++i)
  {
    if (mask[i] != 0)
    {
      const Eigen::Vector2d pixel(double(i % std::size_t(width)), double(i / std::size_t(width)));
      corners << corners.head<2>().cwiseMin(pixel), corners.tail<2>().cwiseMax(pixel + Eigen::Vector2d(1, 1));
    }
  }
  return corners;
}

void judgeCocoCategories(
  ExportJudge& judge, const std::string& file, const Json& categories, const std::vector<ClassRecord>& classes)
{
  judge.exact("categories", "", file, "all", double(categories.size()), double(classes.size()));
  for (std::size_t i = 0; i < std::min(categories.size(), classes.size()); ++i)
  {
    const Json& one = categories[i];
    const std::string name = classes[i].name.empty() ? "object" : utf8FromBytes(classes[i].name);
    const bool same = one.at("id") == classes[i].id && one.at("name") == name &&
                      one.at("supercategory") == utf8FromBytes(classes[i].supercategory);
    judge.holds("categories", file, std::to_string(i + 1), same, one.dump(), "a class of the dataset");
  }
}

const ExportedName* judgeCocoImage(
  ExportJudge& judge, const std::string& file, const std::string& folder, const Json& image)
{
  const ExportedName* name = judge.source().named(folder + image.at("file_name").get<std::string>());
  const bool same = name && image.at("camera") == utf8FromBytes(name->camera) && image.at("frame") == name->frame;
  judge.holds("names", file, image.at("file_name"), same, "a picture", "one of export.json");
  if (name)
  {
    judge.size(file, name->camera, name->frame, image.at("width"), image.at("height"));
  }
  return name;
}

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
