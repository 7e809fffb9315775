// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPictureSamples.h"

#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportJpeg.h"
#include "dgtkFile.h"
#include "dgtkLayerFile.h"
#include "dgtkPngEncoder.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <map>

namespace dgtk::samples
{

namespace
{
bool isPreview(const DatasetView& dataset, const DatasetFile& file)
{
  const Meaning meaning = dataset.meaningOf(file.layer);
  return extensionOf(file.path) == "png" && (meaning == Meaning::Depth || meaning == Meaning::Distance);
}

/// The smaller, the sooner a file stands for its layer: what decoders know and holds the values comes first; pictures
/// of depth for people come last.
std::size_t rankOf(const DatasetView& dataset, const DatasetFile& file)
{
  static const std::vector<std::string> order{ "npy", "png", "dgd", "pfm", "flo", "ppm", "exr", "json", "txt", "ldi" };
  const auto found = std::find(order.begin(), order.end(), extensionOf(file.path));
  const bool last = found == order.end() || isPreview(dataset, file);
  return last ? order.size() : std::size_t(found - order.begin());
}

/// "depth", "correspondence_right", "disparity_class": the file's folder, what follows the frame in its name, and
/// whether it is a class image.
std::string stemOf(const DatasetFile& file)
{
  const std::size_t slash = file.path.rfind('/');
  const std::size_t before = slash == std::string::npos || slash == 0 ? slash : file.path.rfind('/', slash - 1);
  const std::string folder = slash == std::string::npos ? "" : file.path.substr(before + 1, slash - before - 1);
  const std::string name = file.path.substr(slash + 1, file.path.rfind('.') - slash - 1);
  const std::string frame = padded(file.frame, 6);
  const std::string suffix = name.rfind(frame, 0) == 0 ? name.substr(frame.size()) : '_' + name;
  static const std::string classes = "_class";
  const auto endsSo = [](const std::string& text)
  { return text.size() > classes.size() && text.compare(text.size() - classes.size(), classes.size(), classes) == 0; };
  return folder + suffix + (endsSo(file.layer) && !endsSo(folder) ? classes : "");
}

bool hasShortIds(const DatasetView& dataset)
{
  const std::vector<ObjectRecord>& all = dataset.objects();
  return std::all_of(all.begin(), all.end(), [](const ObjectRecord& object) { return object.id <= 65535; });
}

Member memberOf(
  const DatasetView& dataset, const DatasetFile& file, const std::string& stem, const OptionValues& options)
{
  const std::string extension = extensionOf(file.path);
  if (extension == "ppm" && dataset.meaningOf(file.layer) == Meaning::Id && hasShortIds(dataset))
  {
    return { stem + ".png", file, Member::Form::Ids };
  }
  if (extension == "ppm" || extension == "dgd" || extension == "pfm" || extension == "flo")
  {
    return { stem + ".npy", file, Member::Form::Array };
  }
  const bool lossy =
    extension == "png" && file.layer == exported::color().of(options) && exported::imageFormat().of(options) == "jpg";
  return lossy ? Member{ stem + ".jpg", file, Member::Form::Jpeg }
               : Member{ stem + '.' + extension, file, Member::Form::Copy };
}

std::string shapeOf(const ImageInfo& info, int channels)
{
  return std::to_string(info.height) + ", " + std::to_string(info.width) +
         (channels > 1 ? ", " + std::to_string(channels) : "");
}

/// Ids of three bytes are one number.
std::string npyOf(const ImageData& image, bool ids)
{
  const ImageInfo& info = image.info;
  if (!ids || info.channels != 3)
  {
    return npyHeader(info.type, shapeOf(info, info.channels)) +
           std::string(reinterpret_cast<const char*>(image.pixels.data()), image.pixels.bytes());
  }
  std::string bytes = npyHeader(PixelType::UInt32, shapeOf(info, 1));
  for (int y = 0; y < info.height; ++y)
  {
    for (int x = 0; x < info.width; ++x)
    {
      putLittle(bytes, idAt(image.pixels, x, y));
    }
  }
  return bytes;
}

std::string idPngOf(const ImageData& image)
{
  PngEncoder::Header header;
  header.width = image.info.width;
  header.height = image.info.height;
  header.bitDepth = 16;
  header.channels = 1;
  header.prediction = PngPrediction::Labels;
  std::string bytes;
  PngEncoder encoder(
    header, [&](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); });
  std::vector<unsigned char> row(encoder.rowBytes());
  for (int y = 0; y < header.height; ++y)
  {
    for (int x = 0; x < header.width; ++x)
    {
      putBig16(row.data() + 2 * std::size_t(x), idAt(image.pixels, x, y));
    }
    encoder.row(row.data());
  }
  encoder.finish();
  return bytes;
}
} // namespace

std::string keyOf(const DatasetShot& shot, const SafeNames& names)
{
  return names.known(shot.name()) + '_' + padded(shot.frame(), 6);
}

namespace
{
/// By stem the file that stands for what it shows.
std::map<std::string, DatasetFile> filesByStem(const DatasetView& dataset, const DatasetShot& shot)
{
  std::map<std::string, DatasetFile> best;
  for (const DatasetFile& file : dataset.filesOf(shot))
  {
    const std::string extension = extensionOf(file.path);
    if (file.layer == "boxes" || extension == "pov" || file.layer == "pov")
    {
      continue;
    }
    const auto [at, isNew] = best.emplace(stemOf(file), file);
    if (!isNew && rankOf(dataset, file) < rankOf(dataset, at->second))
    {
      at->second = file;
    }
  }
  return best;
}
} // namespace

void addStems(const DatasetView& dataset, const DatasetShot& shot, SafeNames& names)
{
  for (const auto& [stem, file] : filesByStem(dataset, shot))
  {
    names.of(stem);
  }
}

std::vector<Member> membersOf(
  const DatasetView& dataset, const DatasetShot& shot, const SafeNames& names, const OptionValues& options)
{
  std::vector<Member> members;
  for (const auto& [stem, file] : filesByStem(dataset, shot))
  {
    members.push_back(memberOf(dataset, file, names.known(stem), options));
  }
  std::sort(members.begin(), members.end(), [](const Member& a, const Member& b) { return a.name < b.name; });
  return members;
}

std::string bytesOf(ExportSink& sink, const DatasetView& dataset, const Member& member, const OptionValues& options)
{
  if (member.form == Member::Form::Copy)
  {
    return dataset.bytesOf(member.file.path);
  }
  const ImageData image = readLayerFile(dataset.pathOf(member.file.path));
  if (member.form == Member::Form::Jpeg)
  {
    const JpegPicture picture = encodeJpeg(image, exported::quality().of(options));
    const std::uint64_t pixels = std::uint64_t(image.info.width) * static_cast<unsigned>(image.info.height);
    sink.rounding({ member.file.layer, "levels", double(picture.largest), pixels, 0 });
    return picture.bytes;
  }
  return member.form == Member::Form::Ids ? idPngOf(image)
                                          : npyOf(image, dataset.meaningOf(member.file.layer) == Meaning::Id);
}

Json sourcesOf(const std::vector<Member>& members)
{
  Json sources = Json::object();
  for (const Member& member : members)
  {
    sources[member.name] = utf8FromBytes(member.file.path);
  }
  return sources;
}

Json documentOf(const DatasetView& dataset, const DatasetShot& shot)
{
  CameraRecord camera = shot.camera;
  camera.files.clear(); // of lenses: they are not in the export
  Json document;
  document["camera"] = Json::parse(camerasText({ camera })).at("cameras").at(0);
  if (dataset.manifest().fps > 0)
  {
    document["seconds"] = dataset.seconds(shot.frame());
  }
  if (dataset.knowsMetres())
  {
    document["metres_per_unit"] = dataset.metres();
  }
  document["poses"] = Json::parse(posesText(dataset.poses(shot.frame()))).at("poses");
  const std::string boxes = dataset.file(shot, "boxes", { "json" });
  if (!boxes.empty())
  {
    document["boxes"] = Json::parse(dataset.bytesOf(boxes)).at("objects");
  }
  return document;
}

} // namespace dgtk::samples
