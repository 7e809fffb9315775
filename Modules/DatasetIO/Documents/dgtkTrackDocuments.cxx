// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTrackDocuments.h"

#include "dgtkDocumentValues.h"
#include "dgtkError.h"
#include "dgtkJsonPieces.h"
#include "dgtkJsonText.h"
#include "dgtkLayerFile.h"
#include "dgtkLayerReader.h"

namespace dgtk
{

namespace
{
constexpr Range aByte{ 0, 255, false, false, "a whole number from 0 to 255" };
constexpr int numbersOfPlace = 3;

TrackPoint trackPointOf(const JsonCursor& value)
{
  TrackPoint point;
  point.object = idOf(value["object"]);
  point.triangle = idOf(value["triangle"], anIndex);
  point.barycentric = value["barycentric"].matrix<Eigen::Vector3d>();
  point.x = value["x"].matrix<Eigen::Vector3d>();
  const JsonCursor color = value["color"];
  color.listSize(3);
  for (std::size_t i = 0; i < 3; ++i)
  {
    point.color[i] = static_cast<std::uint8_t>(integerOf(color.element(i), aByte));
  }
  point.isStatic = value["static"].boolean();
  point.camera = value["camera"].text();
  point.frame = integerOf(value["frame"], anyFrame);
  return point;
}

std::string numbers(const Eigen::Vector3d& values)
{
  return jsonNumber(values[0]) + ", " + jsonNumber(values[1]) + ", " + jsonNumber(values[2]);
}
} // namespace

std::string tracksText(const std::vector<TrackPoint>& points)
{
  std::string text = "{\n  \"points\": [";
  for (const TrackPoint& point : points)
  {
    text += &point == points.data() ? "\n    {\"object\": " : ",\n    {\"object\": ";
    text += std::to_string(point.object) + ", \"triangle\": " + std::to_string(point.triangle);
    text += ", \"barycentric\": [" + numbers(point.barycentric) + "], \"x\": [" + numbers(point.x);
    text += "], \"color\": [" + std::to_string(point.color[0]) + ", " + std::to_string(point.color[1]) + ", " +
            std::to_string(point.color[2]);
    text += std::string("], \"static\": ") + (point.isStatic ? "true" : "false");
    text += ", \"camera\": " + jsonString(point.camera) + ", \"frame\": " + std::to_string(point.frame) + '}';
  }
  return text + (points.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

std::vector<TrackPoint> readTrackPoints(const std::string& path)
{
  std::vector<TrackPoint> points;
  const JsonDocument document = readJsonPieces(
    path, { { "points", [&](const JsonPiece& piece) { points.push_back(trackPointOf(piece.value)); } } });
  JsonCursor(document)["points"].listSize();
  return points;
}

std::string trackPlacesNpy(const std::vector<TrackPlace>& places)
{
  std::string bytes = npyHeader(PixelType::Float64, std::to_string(places.size()) + ", 3");
  bytes.reserve(bytes.size() + places.size() * numbersOfPlace * sizeof(double));
  for (const TrackPlace& place : places)
  {
    putLittle(bytes, place.u);
    putLittle(bytes, place.v);
    putLittle(bytes, place.visibility);
  }
  return bytes;
}

std::vector<TrackPlace> readTrackPlaces(const std::string& path, std::size_t points)
{
  if (points == 0)
  {
    return {}; // no image has no row
  }
  const ImageData data = readLayerFile(path);
  const ImageInfo& info = data.info;
  const bool shaped = info.type == PixelType::Float64 && info.channels == 1 && info.width == numbersOfPlace;
  if (!shaped || std::size_t(info.height) != points)
  {
    throw InputError(path, "is not what it should be", std::to_string(points) + " x 3 float64",
      std::to_string(info.height) + " x " + std::to_string(info.width * info.channels) + ' ' + nameOf(info.type));
  }
  std::vector<TrackPlace> places;
  places.reserve(points);
  for (int i = 0; i < info.height; ++i)
  {
    const double* const row = data.pixels.row<double>(i);
    places.push_back({ row[0], row[1], row[2] });
  }
  return places;
}

} // namespace dgtk
