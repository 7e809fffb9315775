// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetDocuments.h"

#include "dgtkDocumentValues.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkJsonText.h"

#include <algorithm>
#include <tuple>

namespace dgtk
{

namespace
{
std::string cameraText(const CameraRecord& camera)
{
  JsonObject object(6);
  object.text("name", camera.name)
    .integer("frame", camera.frame)
    .integer("width", camera.width)
    .integer("height", camera.height);
  if (camera.hasK)
  {
    object.raw("K", jsonMatrix(camera.K));
  }
  object.raw("R", jsonMatrix(camera.R)).raw("t", jsonMatrix(camera.t)).text("model", camera.model);
  if (camera.numbers.count("distortion") == 0)
  {
    object.raw("distortion", "[]");
  }
  for (const auto& [name, numbers] : camera.numbers)
  {
    object.raw(name, numbersText(numbers));
  }
  for (const auto& [name, file] : camera.files)
  {
    object.text(name, file);
  }
  if (camera.rollingShutter.duration > 0)
  {
    object.raw("rollingShutter", JsonObject(8)
                                   .number("duration", camera.rollingShutter.duration)
                                   .text("direction", rollingDirections()[std::size_t(camera.rollingShutter.direction)])
                                   .line());
  }
  return object.number("near", camera.near).number("far", camera.far).block();
}

std::string layerText(const LayerRecord& layer)
{
  const LayerSpec& spec = layer.spec;
  JsonObject object(6);
  object.text("name", spec.name)
    .text("format", layer.format)
    .text("type", nameOf(spec.type))
    .integer("channels", spec.channels)
    .text("unit", spec.unit)
    .text("frame", spec.frame)
    .text("invalid", spec.invalid)
    .text("description", spec.description);
  if (spec.meaning != Meaning::Unknown && spec.meaning != impliedMeaning(spec))
  {
    object.text("meaning", nameOf(spec.meaning));
  }
  return object.line();
}

std::string fileText(const DatasetFile& file) { return fileObject(file).line(); }
} // namespace

JsonObject fileObject(const DatasetFile& file)
{
  JsonObject object(6);
  object.text("path", file.path).integer("bytes", static_cast<std::int64_t>(file.bytes)).text("sha256", file.sha256);
  if (!file.layer.empty())
  {
    object.text("layer", file.layer);
  }
  if (!file.camera.empty())
  {
    object.text("camera", file.camera);
  }
  if (file.frame >= 0 || !file.camera.empty())
  {
    object.integer("frame", file.frame);
  }
  return object;
}

std::string camerasText(std::vector<CameraRecord> cameras)
{
  std::stable_sort(cameras.begin(), cameras.end(),
    [](const CameraRecord& a, const CameraRecord& b) { return std::tie(a.name, a.frame) < std::tie(b.name, b.frame); });
  return JsonObject(2).raw("cameras", arrayText(cameras, cameraText)).block() + "\n";
}

std::string manifestText(Manifest manifest)
{
  std::sort(manifest.files.begin(), manifest.files.end(),
    [](const DatasetFile& a, const DatasetFile& b) { return a.path < b.path; });
  std::sort(manifest.inputs.begin(), manifest.inputs.end(),
    [](const InputRecord& a, const InputRecord& b) { return a.path < b.path; });
  const auto input = [](const InputRecord& file)
  {
    return JsonObject(6)
      .text("path", file.path)
      .integer("bytes", static_cast<std::int64_t>(file.bytes))
      .text("sha256", file.sha256)
      .line();
  };
  const auto empty = [](const EmptyRecord& one)
  {
    return JsonObject(6)
      .text("layer", one.layer)
      .integer("pictures", static_cast<std::int64_t>(one.pictures))
      .integer("of", static_cast<std::int64_t>(one.of))
      .text("needs", one.needs)
      .line();
  };
  return JsonObject(2)
           .text("format", "DGTk dataset")
           .integer("format_version", 1)
           .text("version", manifest.version)
           .text("request_hash", manifest.requestHash)
           .raw("request", pairsText(manifest.request))
           .text("units", manifest.units)
           .raw("metres_per_unit", manifest.metresPerUnit > 0 ? jsonNumber(manifest.metresPerUnit) : "null")
           .raw("fps", manifest.fps > 0 ? jsonNumber(manifest.fps) : "null")
           .raw("info", pairsText(manifest.info))
           .raw("inputs", arrayText(manifest.inputs, input))
           .raw("layers", arrayText(manifest.layers, layerText))
           .raw("empty", arrayText(manifest.empty, empty))
           .raw("warnings", arrayText(manifest.warnings, jsonString))
           .raw("files", arrayText(manifest.files, fileText))
           .block() +
         "\n";
}

DatasetFile writeDocument(const std::string& folder, const std::string& name, const std::string& text,
  const std::string& layer, const std::string& camera, int frame)
{
  writeFile(FilePlace(folder, name), text);
  return { name, text.size(), Sha256::of(text), layer, camera, frame };
}

} // namespace dgtk
