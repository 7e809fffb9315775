// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadArchives.h"
#include "dgtkReadTexts.h"

#include "dgtkFile.h"

#include <algorithm>

// Pascal VOC 2012, "Annotation": pixels from 1, both ends included.

namespace dgtk
{

namespace
{
/// What stands between the tags of a name, one after another.
std::vector<std::string> between(const std::string& text, const std::string& tag)
{
  std::vector<std::string> found;
  const std::string open = '<' + tag + '>';
  const std::string close = "</" + tag + '>';
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at + 1))
  {
    const std::size_t begin = at + open.size();
    found.push_back(text.substr(begin, text.find(close, begin) - begin));
  }
  return found;
}

void judgePicture(ExportJudge& judge, const std::string& stem, const ExportedName& picture)
{
  const std::string file = "Annotations/" + stem + ".xml";
  const std::string path = judge.source().path(file);
  const std::string text = readFile(path);
  const auto number = [&](const std::string& in, const char* tag)
  {
    const std::vector<std::string> found = between(in, tag);
    return numberIn(path, 1, found.empty() ? "" : found[0]);
  };
  judge.size(file, picture.camera, picture.frame, int(number(text, "width")), int(number(text, "height")));
  std::vector<BoxRecord> boxes = judge.source().boxes(picture.camera, picture.frame);
  boxes.erase(
    std::remove_if(boxes.begin(), boxes.end(), [](const BoxRecord& box) { return !box.visible; }), boxes.end());
  const std::vector<std::string> objects = between(text, "object");
  judge.number("annotations", "objects", file, picture.name, double(objects.size()), double(boxes.size()), 0);
  const std::vector<ClassRecord> classes = readClasses(judge.source().document("objects.json"));
  std::map<std::uint32_t, std::pair<double, double>> codes; // class, object
  for (std::size_t i = 0; i < std::min(objects.size(), boxes.size()); ++i)
  {
    const BoxRecord& box = boxes[i];
    const Eigen::Vector4d corners(number(objects[i], "xmin") - 1, number(objects[i], "ymin") - 1,
      number(objects[i], "xmax"), number(objects[i], "ymax"));
    judge.box(file, picture.camera, picture.frame, box.id, corners, 0);
    judge.number(
      "truncated", "", file, box.name, number(objects[i], "truncated"), box.pixelsWhole > box.pixelsAmodal, 0);
    judge.number(
      "occluded", "", file, box.name, number(objects[i], "occluded"), box.pixelsVisible < box.pixelsAmodal, 0);
    const ObjectRecord* object = judge.source().object(picture.camera, box.id);
    for (std::size_t k = 0; object && k < classes.size(); ++k)
    {
      if (classes[k].id == object->classId)
      {
        codes[box.id] = { double(k + 1), double(i + 1) };
        std::string name = between(objects[i], "name").at(0);
        for (const auto& [code, sign] :
          { std::pair{ "&lt;", "<" }, std::pair{ "&gt;", ">" }, std::pair{ "&amp;", "&" } })
        {
          for (std::size_t at = name.find(code); at != std::string::npos; at = name.find(code, at + 1))
          {
            name.replace(at, std::string(code).size(), sign);
          }
        }
        const std::string expected = classes[k].name.empty() ? "object" : classes[k].name;
        judge.holds("category", file, box.name, name == expected, name, expected);
      }
    }
  }
  const PicturePointer ids = judge.source().picture(picture.camera, picture.frame, "objects");
  for (const bool kind : { true, false })
  {
    const std::string map = (kind ? "SegmentationClass/" : "SegmentationObject/") + stem + ".png";
    const DecodedPixels found = decodeGrayPngBytes(judge.source().path(map), readFile(judge.source().path(map)));
    judge.size(map, picture.camera, picture.frame, found.width, found.height);
    for (int y = 0; y < std::min(found.height, ids->height()); ++y)
    {
      for (int x = 0; x < std::min(found.width, ids->width()); ++x)
      {
        const auto code = codes.find(ids->id(x, y));
        const double expected = code == codes.end() ? 0 : kind ? code->second.first : code->second.second;
        judge.number("codes", "", map, picture.name, found.at(x, y), expected, 0);
      }
    }
  }
}
} // namespace

void readVoc(ExportJudge& judge)
{
  std::size_t listed = 0;
  for (const ExportedFile* one : filesIn(judge.source(), "ImageSets/", "txt"))
  {
    for (const std::vector<std::string>& line : linesOf(judge.source().path(one->file.path)))
    {
      const ExportedName* picture = pictureOf(judge, one->file.path, "JPEGImages/" + line.at(0) + ".jpg");
      const bool main = one->file.path.find("/Main/") != std::string::npos;
      listed += main;
      if (main && picture)
      {
        judgePicture(judge, line.at(0), *picture);
      }
    }
  }
  judge.number(
    "pictures", "", "ImageSets", "all parts", double(listed), double(judge.source().record().names.size()), 0);
}

} // namespace dgtk
