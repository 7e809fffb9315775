// SPDX-License-Identifier: BSD-3-Clause
// objects.json and poses.json.
#include "dgtkDatasetDocuments.h"
#include "dgtkDocumentValues.h"
#include "dgtkJsonPieces.h"
#include "dgtkJsonText.h"
#include "dgtkLongDocuments.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace dgtk
{

namespace
{
std::string wholeNumbers(const int* numbers, std::size_t count)
{
  return listText(std::vector<int>(numbers, numbers + count), [](int number) { return std::to_string(number); });
}

std::string objectText(const ObjectRecord& record)
{
  JsonObject object(6);
  object.integer("id", record.id)
    .text("name", record.name)
    .text("class", record.objectClass)
    .integer("class_id", record.classId)
    .text("model", record.model)
    .integer("triangles", static_cast<std::int64_t>(record.triangles))
    .boolean("static", record.isStatic)
    .boolean("deforming", record.deforming);
  if (!record.geometry.empty())
  {
    object.text("geometry", record.geometry);
  }
  if (!record.geometryFile.empty())
  {
    object.text("geometry_file", record.geometryFile);
  }
  return object.line();
}

std::string classText(const ClassRecord& one)
{
  JsonObject object(6);
  object.integer("id", one.id).text("name", one.name);
  if (!one.supercategory.empty())
  {
    object.text("supercategory", one.supercategory);
  }
  if (one.thing)
  {
    object.boolean("thing", *one.thing);
  }
  if (one.color)
  {
    object.raw("color", wholeNumbers(one.color->data(), one.color->size()));
  }
  if (!one.keypoints.empty())
  {
    object.raw("keypoints", listText(one.keypoints, jsonString));
  }
  if (!one.skeleton.empty())
  {
    object.raw("skeleton",
      listText(one.skeleton, [](const std::array<int, 2>& pair) { return wholeNumbers(pair.data(), pair.size()); }));
  }
  return object.line();
}

std::string poseText(const PoseRecord& pose)
{
  return JsonObject(6)
    .integer("frame", pose.frame)
    .integer("id", pose.id)
    .boolean("visible", pose.visible)
    .raw("matrix", jsonMatrix(pose.matrix))
    .raw("R", pose.rigid ? jsonMatrix(pose.R) : "null")
    .raw("t", jsonMatrix(pose.t))
    .raw("scale", pose.rigid ? jsonMatrix(pose.scale) : "null")
    .line();
}

ObjectRecord objectOf(const JsonCursor& item)
{
  ObjectRecord object;
  object.id = idOf(item["id"]);
  object.name = item["name"].text();
  object.objectClass = item["class"].text();
  object.classId = idOf(item["class_id"]);
  object.model = item["model"].text();
  object.triangles = countOf(item["triangles"]);
  // not in the first datasets
  object.isStatic = item.has("static") && item["static"].boolean();
  object.deforming = item.has("deforming") && item["deforming"].boolean();
  object.geometry = item.has("geometry") ? hashOf(item["geometry"]) : "";
  object.geometryFile = item.has("geometry_file") ? item["geometry_file"].text() : "";
  return object;
}

constexpr Range colorByte{ 0, 255, false, false, "a whole number from 0 to 255" };

std::vector<std::array<int, 2>> skeletonOf(const JsonCursor& at, std::size_t keypoints)
{
  const std::string text = "a whole number from 1 to " + std::to_string(keypoints);
  const Range range{ 1, double(keypoints), false, false, text.c_str() };
  std::vector<std::array<int, 2>> skeleton;
  for (const JsonCursor& pair : at.items())
  {
    pair.listSize(2);
    skeleton.push_back({ integerOf(pair.element(0), range), integerOf(pair.element(1), range) });
  }
  return skeleton;
}

ClassRecord classOf(const JsonCursor& item)
{
  ClassRecord one;
  one.id = idOf(item["id"]);
  one.name = item["name"].text();
  one.supercategory = item.has("supercategory") ? item["supercategory"].text() : "";
  if (item.has("thing"))
  {
    one.thing = item["thing"].boolean();
  }
  if (item.has("color"))
  {
    const JsonCursor color = item["color"];
    color.listSize(3);
    one.color = { integerOf(color.element(0), colorByte), integerOf(color.element(1), colorByte),
      integerOf(color.element(2), colorByte) };
  }
  if (item.has("keypoints"))
  {
    one.keypoints = textsIn(item["keypoints"]);
  }
  if (item.has("skeleton"))
  {
    one.skeleton = skeletonOf(item["skeleton"], one.keypoints.size());
  }
  return one;
}

PoseRecord poseOf(const JsonCursor& item)
{
  PoseRecord pose;
  pose.frame = integerOf(item["frame"], anyFrame);
  pose.id = idOf(item["id"]);
  pose.visible = item["visible"].boolean();
  pose.matrix = item["matrix"].matrix<Eigen::Matrix<double, 3, 4>>();
  pose.t = item["t"].matrix<Eigen::Vector3d>();
  pose.rigid = !item["R"].isNull();
  if (pose.rigid)
  {
    pose.R = item["R"].matrix<Eigen::Matrix3d>();
    pose.scale = item["scale"].matrix<Eigen::Vector3d>();
  }
  return pose;
}
} // namespace

std::string objectsText(std::vector<ObjectRecord> objects, const std::vector<ClassRecord>& classes)
{
  std::map<std::uint32_t, ClassRecord> table;
  for (const ClassRecord& one : classes)
  {
    table.emplace(one.id, one);
  }
  for (const ObjectRecord& object : objects)
  {
    ClassRecord one;
    one.id = object.classId;
    one.name = object.objectClass;
    table.emplace(one.id, one);
  }
  std::stable_sort(
    objects.begin(), objects.end(), [](const ObjectRecord& a, const ObjectRecord& b) { return a.id < b.id; });
  JsonArray lines(4);
  for (const auto& [id, one] : table)
  {
    lines.add(classText(one));
  }
  return JsonObject(2).raw(objectsKey, arrayText(objects, objectText)).raw(classesKey, lines.block()).block() + "\n";
}

std::string posesText(std::vector<PoseRecord> poses)
{
  std::stable_sort(poses.begin(), poses.end(),
    [](const PoseRecord& a, const PoseRecord& b) { return std::tie(a.frame, a.id) < std::tie(b.frame, b.id); });
  return JsonObject(2).raw("poses", arrayText(poses, poseText)).block() + "\n";
}

std::vector<ObjectRecord> readObjects(const std::string& path)
{
  const JsonDocument document = readJson(path);
  std::vector<ObjectRecord> objects;
  for (const JsonCursor& item : JsonCursor(document)[objectsKey].items())
  {
    objects.push_back(objectOf(item));
  }
  return objects;
}

std::vector<ClassRecord> readClasses(const std::string& path)
{
  const JsonDocument document = readJson(path);
  const JsonCursor root(document);
  const bool hasTable = root.has(classesKey); // not in the first datasets
  std::map<std::uint32_t, ClassRecord> table;
  for (const JsonCursor& item : root[hasTable ? classesKey : objectsKey].items())
  {
    ClassRecord one;
    if (hasTable)
    {
      one = classOf(item);
    }
    else
    {
      one.id = idOf(item["class_id"]);
      one.name = item["class"].text();
    }
    if (!table.emplace(one.id, one).second && hasTable)
    {
      item.fail("has the number of another class");
    }
  }
  std::vector<ClassRecord> classes;
  classes.reserve(table.size());
  for (const auto& [id, one] : table)
  {
    classes.push_back(one);
  }
  return classes;
}

std::vector<PoseRecord> readPoses(const std::string& path)
{
  std::vector<PoseRecord> poses;
  readPoses(path, [&](PoseRecord&& pose) { poses.push_back(std::move(pose)); });
  return poses;
}

void readPoses(const std::string& path, const std::function<void(PoseRecord&&)>& visit)
{
  const JsonDocument document =
    readJsonPieces(path, { { "poses", [&](const JsonPiece& piece) { visit(poseOf(piece.value)); } } });
  JsonCursor(document)["poses"].listSize();
}

PoseIndex::PoseIndex(const std::string& path)
  : Path(path)
{
  const JsonDocument document =
    readJsonPieces(path, { { "poses", [this](const JsonPiece& piece)
                           {
                             const int frame = poseOf(piece.value).frame;
                             if (!this->Ranges.empty() && this->Ranges.back().frame == frame)
                             {
                               this->Ranges.back().end = piece.end;
                               return;
                             }
                             this->Ranges.push_back({ frame, piece.begin, piece.end });
                           } } });
  JsonCursor(document)["poses"].listSize();
  std::stable_sort(
    this->Ranges.begin(), this->Ranges.end(), [](const Range& a, const Range& b) { return a.frame < b.frame; });
}

std::vector<PoseRecord> PoseIndex::at(int frame) const
{
  const auto before = [](const Range& range, int wanted) { return range.frame < wanted; };
  std::vector<PoseRecord> poses;
  for (auto range = std::lower_bound(this->Ranges.begin(), this->Ranges.end(), frame, before);
       range != this->Ranges.end() && range->frame == frame; ++range)
  {
    const JsonDocument document = readJsonPieces(this->Path, range->begin, range->end, "poses");
    for (const JsonCursor& item : JsonCursor(document).items())
    {
      poses.push_back(poseOf(item));
    }
  }
  std::stable_sort(poses.begin(), poses.end(), [](const PoseRecord& a, const PoseRecord& b) { return a.id < b.id; });
  return poses;
}

} // namespace dgtk
