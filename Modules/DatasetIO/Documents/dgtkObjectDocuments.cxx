// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkObjectDocuments.h"

#include "dgtkJsonText.h"
#include "dgtkLayerFile.h"

#include <cmath>

namespace dgtk
{

namespace
{
/// Borders between pixels are counted.
std::string bordersOrNull(const std::optional<Eigen::Vector4d>& box)
{
  if (!box)
  {
    return "null";
  }
  std::string text;
  for (const double border : *box)
  {
    text += (text.empty() ? "[" : ", ") + std::to_string(std::llround(border));
  }
  return text + ']';
}

std::string keypointText(const KeypointRecord& point)
{
  return JsonObject(10)
    .text("name", point.name)
    .raw("x", jsonMatrix(point.x))
    .raw("u", point.pixel ? jsonNumber(point.pixel->x()) : "null")
    .raw("v", point.pixel ? jsonNumber(point.pixel->y()) : "null")
    .integer("visibility", point.visibility)
    .line();
}

std::string keypointsText(const std::vector<KeypointRecord>& points)
{
  JsonArray list(8);
  for (const KeypointRecord& point : points)
  {
    list.add(keypointText(point));
  }
  return list.block();
}

std::string boxText(const BoxRecord& record)
{
  JsonObject object(6);
  object.integer("id", record.id);
  object.text("name", record.name);
  object.text("class", record.objectClass);
  object.integer("pixels_visible", static_cast<std::int64_t>(record.pixelsVisible));
  object.integer("pixels_amodal", static_cast<std::int64_t>(record.pixelsAmodal));
  object.integer("pixels_whole", static_cast<std::int64_t>(record.pixelsWhole));
  object.number(
    "visible_fraction", record.pixelsAmodal > 0 ? double(record.pixelsVisible) / double(record.pixelsAmodal) : 0.0);
  object.raw("box_visible", bordersOrNull(record.visible));
  object.raw("box_amodal", bordersOrNull(record.amodal));
  object.raw("box_whole", bordersOrNull(record.whole));
  object.raw("box_projected", record.projected ? jsonMatrix(*record.projected) : "null");
  object.raw("R", record.rigid ? jsonMatrix(record.R) : "null");
  object.raw("t", record.rigid ? jsonMatrix(record.t) : "null");
  object.raw("scale", record.rigid ? jsonMatrix(record.scale) : "null");
  object.raw("matrix", jsonMatrix(record.matrix));
  object.raw("box3d", jsonMatrix(record.corners));
  if (!record.keypoints.empty())
  {
    object.raw("keypoints", keypointsText(record.keypoints));
  }
  return object.block();
}

std::string documentText(const JsonObject& document) { return document.block() + '\n'; }
} // namespace

std::string boxesText(const std::string& camera, int frame, const std::vector<BoxRecord>& objects)
{
  JsonArray list(4);
  for (const BoxRecord& record : objects)
  {
    list.add(boxText(record));
  }
  JsonObject document(2);
  document.text("camera", camera).integer("frame", frame).raw("objects", list.block());
  return documentText(document);
}

std::string amodalText(int width, int height, const std::vector<MaskRecord>& masks)
{
  JsonArray list(4);
  for (const MaskRecord& mask : masks)
  {
    std::string counts = "[";
    for (const std::uint64_t count : mask.counts)
    {
      counts += (counts.size() > 1 ? ", " : "") + std::to_string(count);
    }
    list.add(JsonObject(6).integer("id", mask.id).raw("counts", counts + ']').line());
  }
  JsonObject document(2);
  document.integer("width", width).integer("height", height).raw("masks", list.block());
  return documentText(document);
}

std::string pointsText(int frame, const std::vector<std::string>& cameras, const std::vector<PointRecord>& points)
{
  std::string names = "[";
  for (const std::string& camera : cameras)
  {
    names += (names.size() > 1 ? ", " : "") + jsonString(camera);
  }
  std::string text = "{\n  \"frame\": " + std::to_string(frame) + ",\n  \"cameras\": " + names + "],\n  \"points\": [";
  for (const PointRecord& point : points)
  {
    text += &point == points.data() ? "\n    {\"x\": [" : ",\n    {\"x\": [";
    text += jsonNumber(point.x.x()) + ", " + jsonNumber(point.x.y()) + ", " + jsonNumber(point.x.z());
    text += "], \"object\": " + std::to_string(point.object) + ", \"triangle\": " + std::to_string(point.triangle);
    text += ", \"track\": [";
    for (const PointRecord::Sight& sight : point.track)
    {
      text += &sight == point.track.data() ? "[" : ", [";
      text += std::to_string(sight.camera) + ", " + jsonNumber(sight.u) + ", " + jsonNumber(sight.v) + ']';
    }
    text += "]}";
  }
  return text + (points.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

std::string pointsPly(const std::vector<PointRecord>& points)
{
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points.size()) + '\n';
  for (const char* property : { "double x", "double y", "double z", "float nx", "float ny", "float nz", "uchar red",
         "uchar green", "uchar blue", "uint object", "uint triangle" })
  {
    text += std::string("property ") + property + '\n';
  }
  text += "end_header\n";
  text.reserve(text.size() + points.size() * 47);
  for (const PointRecord& point : points)
  {
    for (int i = 0; i < 3; ++i)
    {
      putLittle(text, point.x[i]);
    }
    for (int i = 0; i < 3; ++i)
    {
      putLittle(text, point.normal[i]);
    }
    for (const std::uint8_t value : point.color)
    {
      text += static_cast<char>(value);
    }
    putLittle(text, point.object);
    putLittle(text, point.triangle);
  }
  return text;
}

} // namespace dgtk
