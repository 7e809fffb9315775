// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJsonValue.h"
#include "dgtkObjectDocuments.h"

namespace dgtk
{

namespace
{
constexpr std::int64_t mostIds = std::numeric_limits<std::uint32_t>::max();

std::optional<Eigen::Vector4d> boxOf(const JsonValue& value)
{
  return value.isNull() ? std::nullopt : std::optional<Eigen::Vector4d>(value.matrix<Eigen::Vector4d>());
}

BoxRecord recordOf(const JsonValue& value)
{
  BoxRecord record;
  record.id = std::uint32_t(value["id"].integer(1, mostIds));
  record.name = value["name"].text();
  record.objectClass = value["class"].text();
  record.pixelsVisible = value["pixels_visible"].count();
  record.pixelsAmodal = value["pixels_amodal"].count();
  record.visible = boxOf(value["box_visible"]);
  record.amodal = boxOf(value["box_amodal"]);
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
  return record;
}

MaskRecord maskOf(const JsonValue& value, std::uint64_t pixels)
{
  MaskRecord mask;
  mask.id = std::uint32_t(value["id"].integer(1, mostIds));
  std::uint64_t at = 0;
  for (const JsonValue& count : value["counts"].items())
  {
    mask.counts.push_back(count.count());
    if (mask.counts.back() > pixels - at)
    {
      value.fail("a mask is longer than the image");
    }
    at += mask.counts.back();
  }
  if (at != pixels)
  {
    value.fail("a mask ends before the image");
  }
  return mask;
}

PointRecord pointOf(const JsonValue& value)
{
  PointRecord point;
  point.x = value["x"].matrix<Eigen::Vector3d>();
  point.object = std::uint32_t(value["object"].integer(0, mostIds));
  point.triangle = std::uint32_t(value["triangle"].integer(0, mostIds));
  for (const JsonValue& sight : value["track"].items())
  {
    const std::vector<JsonValue> numbers = sight.items();
    sight.require(numbers.size() == 3, "a camera's index and two numbers");
    point.track.push_back({ std::uint32_t(numbers[0].integer(0, mostIds)), numbers[1].number(), numbers[2].number() });
  }
  return point;
}
} // namespace

std::vector<BoxRecord> readBoxes(const std::string& path)
{
  const nlohmann::ordered_json json = readJson(path);
  std::vector<BoxRecord> records;
  for (const JsonValue& item : JsonValue(path, "", json)["objects"].items())
  {
    records.push_back(recordOf(item));
  }
  return records;
}

AmodalMasks readAmodal(const std::string& path)
{
  const nlohmann::ordered_json json = readJson(path);
  const JsonValue root(path, "", json);
  AmodalMasks masks;
  masks.width = root["width"].smallInteger(1);
  masks.height = root["height"].smallInteger(1);
  for (const JsonValue& item : root["masks"].items())
  {
    masks.masks.push_back(maskOf(item, std::uint64_t(masks.width) * std::uint64_t(masks.height)));
  }
  return masks;
}

TrackedPoints readPoints(const std::string& path)
{
  const nlohmann::ordered_json json = readJson(path);
  const JsonValue root(path, "", json);
  TrackedPoints points;
  points.frame = root["frame"].smallInteger(std::numeric_limits<int>::min());
  for (const JsonValue& item : root["cameras"].items())
  {
    points.cameras.push_back(item.text());
  }
  for (const JsonValue& item : root["points"].items())
  {
    points.points.push_back(pointOf(item));
  }
  return points;
}

} // namespace dgtk
