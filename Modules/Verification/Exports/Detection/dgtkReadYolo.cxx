// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportPixels.h"
#include "dgtkReadTexts.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJsonFile.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <sstream>

// Ultralytics' dataset formats (detect, segment, pose, obb): places are shares of the image, classes from 0.

namespace dgtk
{

namespace
{
constexpr double tolerance = 1e-6; ///< pixels

struct Label
{
  int kind = 0;
  std::vector<double> places; ///< pixels, but for v of keypoints
};

std::vector<Label> labelsIn(const std::string& path, const CameraRecord& camera, bool poses)
{
  std::vector<Label> labels;
  for (const std::vector<std::string>& words : linesOf(path))
  {
    Label label;
    for (std::size_t i = 0; i < words.size(); ++i)
    {
      const double value = numberIn(path, labels.size() + 1, words[i]);
      if (i == 0)
      {
        label.kind = int(value);
        continue;
      }
      const std::size_t place = poses && i > 4 ? (i - 5) % 3 : (i - 1) % 2;
      label.places.push_back(place == 0 ? value * camera.width : place == 1 ? value * camera.height : value);
    }
    if (label.places.size() < 4)
    {
      throw InputError(path, labels.size() + 1, "expected a class and four numbers or more");
    }
    labels.push_back(label);
  }
  return labels;
}

/// The names of the classes and of all keypoints, in their order.
struct Names
{
  std::vector<ClassRecord> classes;
  std::vector<std::string> keypoints;
};

Names namesOf(const ExportedFrom& source)
{
  Names names;
  names.classes = readClasses(source.document("objects.json"));
  for (const ClassRecord& one : names.classes)
  {
    for (const std::string& name : one.keypoints)
    {
      if (std::find(names.keypoints.begin(), names.keypoints.end(), name) == names.keypoints.end())
      {
        names.keypoints.push_back(name);
      }
    }
  }
  return names;
}

bool hasKeypoints(const Names& names, std::uint32_t kind)
{
  return std::any_of(names.classes.begin(), names.classes.end(),
    [kind](const ClassRecord& one) { return one.id == kind && !one.keypoints.empty(); });
}

void judgeBox(ExportJudge& judge, const std::string& file, const ExportedName& picture, const BoxRecord& box,
  const std::vector<double>& p)
{
  const Eigen::Vector4d corners(p[0] - p[2] / 2, p[1] - p[3] / 2, p[0] + p[2] / 2, p[1] + p[3] / 2);
  judge.box(file, picture.camera, picture.frame, box.id, corners, tolerance);
}

/// A rectangle that holds all pixels of an object, touches them with every side, and is no larger than their box.
void judgeRectangle(ExportJudge& judge, const std::string& file, const ExportedName& picture, const BoxRecord& box,
  const std::vector<double>& p)
{
  const std::string where = picture.name + ", object " + std::to_string(box.id);
  judge.exact("rectangle", "px", file, where, double(p.size()), 8);
  if (p.size() != 8 || !box.visible)
  {
    return;
  }
  const Eigen::Map<const Eigen::Matrix<double, 2, 4>> corners(p.data());
  const Eigen::Vector2d along = corners.col(1) - corners.col(0);
  const Eigen::Vector2d aside = corners.col(3) - corners.col(0);
  judge.number("rectangle", "px", file, where, (corners.col(0) + along + aside - corners.col(2)).norm(), 0, tolerance);
  judge.number("rectangle", "px", file, where, along.dot(aside) / std::max(1.0, along.norm()), 0, tolerance);
  const PicturePointer ids = judge.source().picture(picture.camera, picture.frame, "objects");
  double area = 1;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Eigen::Vector2d from(p[2 * i], p[2 * i + 1]);
    const Eigen::Vector2d side = Eigen::Vector2d(p[2 * ((i + 1) % 4)], p[2 * ((i + 1) % 4) + 1]) - from;
    area *= i < 2 ? side.norm() : 1;
    const Eigen::Vector2d across = Eigen::Vector2d(-side.y(), side.x()).normalized();
    double nearest = infinite;
    for (int y = int((*box.visible)[1]); y < int((*box.visible)[3]); ++y)
    {
      for (int x = int((*box.visible)[0]); x < int((*box.visible)[2]); ++x)
      {
        for (int corner = 0; corner < 4 && ids->id(x, y) == box.id; ++corner)
        {
          nearest = std::min(nearest, across.dot(Eigen::Vector2d(x + corner % 2, y + corner / 2) - from));
        }
      }
    }
    judge.number("rectangle", "px", file, where, nearest, 0, tolerance);
  }
  const Eigen::Vector4d& b = *box.visible;
  judge.holds("rectangle area", file, where, area <= (b[2] - b[0]) * (b[3] - b[1]) * (1 + 1e-9), std::to_string(area),
    "at most that of the box");
}

void judgeKeypoints(ExportJudge& judge, const std::string& file, const ExportedName& picture, const BoxRecord& box,
  const std::vector<double>& p, const std::vector<std::string>& names)
{
  const std::string where = picture.name + ", object " + std::to_string(box.id);
  judge.exact("keypoints", "px", file, where, double(p.size()), double(4 + 3 * names.size()));
  for (std::size_t i = 0; i < names.size() && p.size() == 4 + 3 * names.size(); ++i)
  {
    const auto own = std::find_if(
      box.keypoints.begin(), box.keypoints.end(), [&](const KeypointRecord& point) { return point.name == names[i]; });
    const int seen = own == box.keypoints.end() ? 0 : own->visibility;
    const int code = seen == 1 ? 2 : seen == 2 || seen == 3 ? 1 : 0;
    const Eigen::Vector2d pixel = code > 0 && own->pixel ? *own->pixel : Eigen::Vector2d(0, 0);
    judge.number("keypoints", "px", file, where, p[4 + 3 * i], pixel.x(), tolerance);
    judge.number("keypoints", "px", file, where, p[5 + 3 * i], pixel.y(), tolerance);
    judge.number("keypoints", "px", file, where, p[6 + 3 * i], code, tolerance);
  }
}

void judgePicture(ExportJudge& judge, const std::string& file, const ExportedName& picture, const Names& names)
{
  const std::string kind = judge.source().convention("labels");
  const CameraRecord* camera = judge.source().camera(picture.camera, picture.frame);
  if (!camera)
  {
    return;
  }
  std::vector<BoxRecord> boxes = judge.source().boxes(picture.camera, picture.frame);
  boxes.erase(std::remove_if(boxes.begin(), boxes.end(),
                [&](const BoxRecord& box)
                {
                  const ObjectRecord* object = judge.source().object(picture.camera, box.id);
                  return !box.visible || !object || (kind == "poses" && !hasKeypoints(names, object->classId));
                }),
    boxes.end());
  const std::vector<Label> labels = labelsIn(judge.source().path(file), *camera, kind == "poses");
  judge.exact("labels", "objects", file, picture.name, double(labels.size()), double(boxes.size()));
  for (std::size_t i = 0; i < std::min(labels.size(), boxes.size()); ++i)
  {
    const ObjectRecord* object = judge.source().object(picture.camera, boxes[i].id);
    const bool same = labels[i].kind >= 0 && std::size_t(labels[i].kind) < names.classes.size() &&
                      names.classes[std::size_t(labels[i].kind)].id == object->classId;
    judge.holds("category", file, picture.name, same, std::to_string(labels[i].kind), "the class of " + object->name);
    if (kind == "segments")
    {
      std::vector<char> mask(std::size_t(camera->width) * std::size_t(camera->height));
      fillPolygon(labels[i].places, camera->width, camera->height, mask);
      judge.mask(file, picture.camera, picture.frame, boxes[i].id, mask);
    }
    else if (kind == "oriented")
    {
      judgeRectangle(judge, file, picture, boxes[i], labels[i].places);
    }
    else
    {
      judgeBox(judge, file, picture, boxes[i], labels[i].places);
      if (kind == "poses")
      {
        judgeKeypoints(judge, file, picture, boxes[i], labels[i].places, names.keypoints);
      }
    }
  }
}
/// data.yaml: the parts' folders, and the names of the classes in their order.
void judgeYaml(ExportJudge& judge, const Names& names)
{
  const std::string file = "data.yaml";
  const std::string path = judge.source().path(file);
  std::set<std::string> parts;
  for (const ExportedName& picture : judge.source().record().names)
  {
    parts.insert(picture.name.substr(0, picture.name.rfind('/')));
  }
  std::map<std::string, std::string> said;
  std::vector<std::string> classes;
  int lists = 0;
  std::istringstream text(readFile(path));
  useJson(path,
    [&]
    {
      for (std::string line; std::getline(text, line);)
      {
        const std::string key = line.substr(0, line.find(": "));
        const std::string value = line.substr(std::min(line.size(), key.size() + 2));
        if (key == "  " + std::to_string(classes.size()))
        {
          classes.push_back(nlohmann::json::parse(value));
        }
        else if (key == "kpt_shape")
        {
          const std::string expected = '[' + std::to_string(names.keypoints.size()) + ", 3]";
          judge.holds("keypoints", file, key, value == expected, value, expected);
        }
        else if (key == "names:" || line == "names: {}")
        {
          judge.holds("names", file, key, classes.empty() && ++lists == 1, "names twice", "once");
        }
        else
        {
          const std::string part = key[0] == '"' ? nlohmann::json::parse(key).get<std::string>() : key;
          const bool own = value == "images/" + part || parts.count("images/" + part) == 0; // of train and val both are
          judge.holds("parts", file, key, own && parts.count(value) > 0 && said.emplace(part, value).second, value,
            "a folder of pictures, once");
        }
      }
    });
  parts.insert({ "images/train", "images/val" });
  for (const std::string& part : parts)
  {
    judge.holds("parts", file, part, said.count(part.substr(7)) > 0, "none", "a line");
  }
  judge.exact("names", "", file, "lists", lists, 1);
  judge.exact("names", "", file, "classes", double(classes.size()), double(names.classes.size()));
  for (std::size_t i = 0; i < std::min(classes.size(), names.classes.size()); ++i)
  {
    const std::string expected = names.classes[i].name.empty() ? "object" : utf8FromBytes(names.classes[i].name);
    judge.holds("names", file, "class " + std::to_string(i), classes[i] == expected, classes[i], expected);
  }
}
} // namespace

void readYolo(ExportJudge& judge)
{
  const Names names = namesOf(judge.source());
  for (const ExportedName& picture : judge.source().record().names)
  {
    const std::string stem = picture.name.substr(0, picture.name.rfind('.'));
    judgePicture(judge, "labels/" + stem.substr(stem.find('/') + 1) + ".txt", picture, names);
  }
  judgeYaml(judge, names);
}

} // namespace dgtk
