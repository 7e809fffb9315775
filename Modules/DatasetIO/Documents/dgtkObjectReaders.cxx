// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDocumentValues.h"
#include "dgtkObjectDocuments.h"

namespace dgtk
{

namespace
{
std::optional<Eigen::Vector4d> boxOf(const JsonCursor& value)
{
  return value.isNull() ? std::nullopt : std::optional<Eigen::Vector4d>(value.matrix<Eigen::Vector4d>());
}

constexpr Range aVisibilityClass{ 0, 5, false, false, "a whole number from 0 to 5" };

KeypointRecord keypointOf(const JsonCursor& value)
{
  KeypointRecord point;
  point.name = value["name"].text();
  point.x = value["x"].matrix<Eigen::Vector3d>();
  if (!value["u"].isNull())
  {
    point.pixel = Eigen::Vector2d(value["u"].number(), value["v"].number());
  }
  point.visibility = integerOf(value["visibility"], aVisibilityClass);
  return point;
}

BoxRecord recordOf(const JsonCursor& value)
{
  BoxRecord record;
  record.id = idOf(value["id"]);
  record.name = value["name"].text();
  record.objectClass = value["class"].text();
  record.pixelsVisible = countOf(value["pixels_visible"]);
  record.pixelsAmodal = countOf(value["pixels_amodal"]);
  record.visible = boxOf(value["box_visible"]);
  record.amodal = boxOf(value["box_amodal"]);
  if (value.has("box_whole")) // of newer versions
  {
    record.pixelsWhole = countOf(value["pixels_whole"]);
    record.whole = boxOf(value["box_whole"]);
  }
  record.projected = boxOf(value["box_projected"]);
  record.rigid = !value["R"].isNull();
  if (record.rigid)
  {
    record.R = value["R"].matrix<Eigen::Matrix3d>();
    record.t = value["t"].matrix<Eigen::Vector3d>();
    record.scale = value["scale"].matrix<Eigen::Vector3d>();
  }
  record.matrix = value["matrix"].matrix<Eigen::Matrix<double, 3, 4>>();
  record.corners = value["box3d"].matrix<Eigen::Matrix<double, 8, 3>>();
  for (const JsonCursor& point : value.has("keypoints") ? value["keypoints"].items() : std::vector<JsonCursor>())
  {
    record.keypoints.push_back(keypointOf(point));
  }
  return record;
}

MaskRecord maskOf(const JsonCursor& value, std::uint64_t pixels)
{
  MaskRecord mask;
  mask.id = idOf(value["id"]);
  std::uint64_t at = 0;
  for (const JsonCursor& count : value["counts"].items())
  {
    mask.counts.push_back(countOf(count));
    if (mask.counts.back() > pixels - at)
    {
      value.fail("is longer than the image");
    }
    at += mask.counts.back();
  }
  if (at != pixels)
  {
    value.fail("ends before the image");
  }
  return mask;
}

PointRecord pointOf(const JsonCursor& value)
{
  PointRecord point;
  point.x = value["x"].matrix<Eigen::Vector3d>();
  point.object = idOf(value["object"], anIndex);
  point.triangle = idOf(value["triangle"], anIndex);
  for (const JsonCursor& sight : value["track"].items())
  {
    sight.listSize(3);
    point.track.push_back({ idOf(sight.element(0), anIndex), sight.element(1).number(), sight.element(2).number() });
  }
  return point;
}
} // namespace

std::vector<BoxRecord> readBoxes(const std::string& path)
{
  const JsonDocument document = readJson(path);
  std::vector<BoxRecord> records;
  for (const JsonCursor& item : JsonCursor(document)["objects"].items())
  {
    records.push_back(recordOf(item));
  }
  return records;
}

AmodalMasks readAmodal(const std::string& path)
{
  const JsonDocument document = readJson(path);
  const JsonCursor root(document);
  AmodalMasks masks;
  masks.width = integerOf(root["width"], aSize);
  masks.height = integerOf(root["height"], aSize);
  for (const JsonCursor& item : root["masks"].items())
  {
    masks.masks.push_back(maskOf(item, std::uint64_t(masks.width) * std::uint64_t(masks.height)));
  }
  return masks;
}

TrackedPoints readPoints(const std::string& path)
{
  const JsonDocument document = readJson(path);
  const JsonCursor root(document);
  TrackedPoints points;
  points.frame = integerOf(root["frame"], anyFrame);
  points.cameras = textsIn(root["cameras"]);
  for (const JsonCursor& item : root["points"].items())
  {
    points.points.push_back(pointOf(item));
  }
  return points;
}

} // namespace dgtk
