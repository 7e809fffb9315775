// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadArchives.h"
#include "dgtkReadTexts.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <algorithm>

// Pascal VOC 2012, "Annotation": pixels from 1, both ends included.

namespace dgtk
{

namespace
{
/// Elements of XML without attributes, in their order: "annotation/size/width" and the text.
std::vector<std::pair<std::string, std::string>> leavesOf(const std::string& path)
{
  const std::string text = readFile(path);
  std::vector<std::pair<std::string, std::string>> leaves;
  std::vector<std::string> open;
  bool isLeaf = false;
  for (std::size_t at = 0; (at = text.find_first_not_of(" \n", at)) < text.size();)
  {
    const std::size_t end = text.find('>', at);
    const bool closes = text.compare(at, 2, "</") == 0;
    const std::string tag = text.substr(at + (closes ? 2 : 1), end - at - (closes ? 2 : 1));
    if (text[at] != '<' || end == std::string::npos || (closes && (open.empty() || open.back() != tag)))
    {
      throw InputError(path, "is no XML of elements that end as they begin");
    }
    at = end + 1;
    if (!closes)
    {
      open.push_back(tag);
      isLeaf = text.compare(at, 1, "\n") != 0 && text.compare(at, 1, "<") != 0;
      if (isLeaf)
      {
        const std::size_t next = std::min(text.find('<', at), text.size());
        leaves.emplace_back(joined(open, "/"), text.substr(at, next - at));
        at = next;
      }
      continue;
    }
    open.pop_back();
  }
  if (!open.empty())
  {
    throw InputError(path, "ends too early");
  }
  return leaves;
}

/// Takes leaves in the order that the format has them.
class Leaves
{
public:
  explicit Leaves(const std::string& path)
    : Path(path)
    , All(leavesOf(path))
  {
  }
  std::string text(const std::string& element)
  {
    if (this->At == this->All.size() || this->All[this->At].first != "annotation/" + element)
    {
      throw InputError(
        this->Path, "expected " + element + (this->isAtEnd() ? "" : ", found " + this->All[this->At].first));
    }
    return this->All[this->At++].second;
  }
  double number(const std::string& element) { return numberIn(this->Path, 0, this->text(element)); }
  bool isAtEnd() const { return this->At == this->All.size(); }

private:
  std::string Path;
  std::vector<std::pair<std::string, std::string>> All;
  std::size_t At = 0;
};

std::string unescaped(std::string text)
{
  for (const auto& [code, sign] : { std::pair{ "&lt;", "<" }, std::pair{ "&gt;", ">" }, std::pair{ "&amp;", "&" } })
  {
    for (std::size_t at = text.find(code); at != std::string::npos; at = text.find(code, at + 1))
    {
      text.replace(at, std::string(code).size(), sign);
    }
  }
  return text;
}

void judgePicture(ExportJudge& judge, const std::string& stem, const ExportedName& picture)
{
  const std::string file = "Annotations/" + stem + ".xml";
  Leaves leaves(judge.source().path(file));
  const auto equals = [&](const std::string& row, const std::string& element, const std::string& expected)
  {
    const std::string found = unescaped(leaves.text(element));
    judge.holds(row, file, element, found == expected, found, expected);
  };
  equals("names", "folder", "JPEGImages");
  equals("names", "filename", picture.name.substr(picture.name.find('/') + 1));
  leaves.text("source/database");
  const double width = leaves.number("size/width");
  judge.size(file, picture.camera, picture.frame, std::int64_t(width), std::int64_t(leaves.number("size/height")));
  equals("size", "size/depth", "3");
  equals("codes", "segmented", "1");
  const std::vector<ClassRecord> classes = readClasses(judge.source().document("objects.json"));
  std::map<std::uint32_t, std::pair<double, double>> codes; // class, object
  for (const BoxRecord& box : judge.source().boxes(picture.camera, picture.frame))
  {
    if (!box.visible)
    {
      continue;
    }
    const ObjectRecord* object = judge.source().object(picture.camera, box.id);
    const auto kind = std::find_if(
      classes.begin(), classes.end(), [&](const ClassRecord& one) { return object && one.id == object->classId; });
    const bool named = kind != classes.end() && !kind->name.empty();
    equals("category", "object/name", named ? utf8FromBytes(kind->name) : "object");
    codes[box.id] = { double(kind - classes.begin() + 1), double(codes.size() + 1) };
    equals("pose", "object/pose", "Unspecified");
    equals("truncated", "object/truncated", box.pixelsWhole > box.pixelsAmodal ? "1" : "0");
    equals("occluded", "object/occluded", box.pixelsVisible < box.pixelsAmodal ? "1" : "0");
    equals("difficult", "object/difficult", "0");
    Eigen::Vector4d corners;
    corners[0] = leaves.number("object/bndbox/xmin") - 1;
    corners[1] = leaves.number("object/bndbox/ymin") - 1;
    corners[2] = leaves.number("object/bndbox/xmax");
    corners[3] = leaves.number("object/bndbox/ymax");
    judge.box(file, picture.camera, picture.frame, box.id, corners, 0);
  }
  judge.holds("annotations", file, picture.name, leaves.isAtEnd(), "more", "objects of which something is visible");
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
        judge.exact("codes", "", map, picture.name, found.at(x, y), expected);
      }
    }
  }
}
} // namespace

void readVoc(ExportJudge& judge)
{
  std::set<std::string> listed;
  for (const ExportedFile* one : filesIn(judge.source(), "ImageSets/Main/", "txt"))
  {
    const std::string& file = one->file.path;
    const auto lines = linesOf(judge.source().path(file));
    for (const std::vector<std::string>& line : lines)
    {
      judge.holds("pictures", file, line[0], listed.insert(line[0]).second, "a picture twice", "each once");
      if (const ExportedName* picture = pictureOf(judge, file, "JPEGImages/" + line[0] + ".jpg"))
      {
        judgePicture(judge, line[0], *picture);
      }
    }
    const std::string masks = "ImageSets/Segmentation/" + stemOf(file) + ".txt";
    judge.holds("pictures", masks, "", linesOf(judge.source().path(masks)) == lines, "others", "those of " + file);
  }
  judge.exact(
    "pictures", "", "ImageSets", "all parts", double(listed.size()), double(judge.source().record().names.size()));
}

} // namespace dgtk
