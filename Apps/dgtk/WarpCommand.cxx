// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "dgtkCameraEntry.h"
#include "dgtkDatasetDocuments.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkFolderContents.h"
#include "dgtkJson.h"
#include "dgtkLdi.h"
#include "dgtkText.h"
#include "dgtkWarp.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <filesystem>
#include <limits>

namespace dgtk::app
{

namespace
{
constexpr std::uint64_t largestDocument = 1 << 20;
constexpr int farthestFrame = 1 << 30;

bool isFile(const std::string& name) { return name.size() > 5 && name.compare(name.size() - 5, 5, ".json") == 0; }

/// What the model of a camera has, as it has it in cameras.json.
void readLens(const JsonCursor& at, const std::string& path, CameraRecord& camera)
{
  const CameraEntry* const entry = findCamera(camera.model);
  const std::vector<CameraParameter> parameters = entry ? entry->parameters : std::vector<CameraParameter>();
  camera.hasK = entry == nullptr || std::any_of(parameters.begin(), parameters.end(),
                                      [](const CameraParameter& parameter) { return parameter.saidByK; });
  if (camera.hasK)
  {
    camera.K = at["K"].matrix<Eigen::Matrix3d>();
  }
  for (const CameraParameter& parameter : parameters)
  {
    if (parameter.kind == CameraParameter::Kind::Matrix || parameter.saidByK || !at.has(parameter.name))
    {
      continue;
    }
    const JsonCursor value = at[parameter.name];
    if (parameter.kind == CameraParameter::Kind::File)
    {
      camera.files[parameter.name] = (std::filesystem::path(path).parent_path() / value.text()).string();
    }
    else if (parameter.counts == std::vector<std::size_t>{ 1 })
    {
      camera.numbers[parameter.name] = { value.number() };
    }
    else
    {
      for (const JsonCursor& number : value.items())
      {
        camera.numbers[parameter.name].push_back(number.number());
      }
    }
  }
}

/// Of a camera file, and of an entry of cameras.json, which has a distortion whatever its model.
void checkKeys(const JsonCursor& at, const CameraRecord& camera)
{
  std::vector<std::string> known{ "name", "frame", "width", "height", "R", "t", "model", "near", "far",
    "rollingShutter" };
  if (camera.hasK)
  {
    known.emplace_back("K");
  }
  for (const CameraParameter& parameter : findCamera(camera.model)->parameters)
  {
    if (parameter.kind != CameraParameter::Kind::Matrix && !parameter.saidByK)
    {
      known.push_back(parameter.name);
    }
  }
  for (std::size_t i = 0; i < at.memberCount(); ++i)
  {
    const bool none = at.key(i) == "distortion" && at.member(i).node().type == JsonNode::Type::Array &&
                      at.member(i).node().children.empty();
    if (!none && std::find(known.begin(), known.end(), at.key(i)) == known.end())
    {
      at.member(i).fail("is an unknown key", "one of " + joined(known));
    }
  }
}

/// A camera file: R, t, width, height and, where given, model, near and far; K and what else the model has.
CameraRecord readCameraFile(const std::string& path)
{
  static constexpr Range side{ 1, 65536, false, false, "a whole number from 1 to 65536" };
  static constexpr Range distance{ 0, anyNumber.most, true, false, "a number above 0" };
  static constexpr Range frames{ 0, 1000, false, false, "frames from 0 to 1000" };
  const JsonDocument document = parseJson(path, readFile(path, largestDocument));
  const JsonCursor at(document);
  CameraRecord camera;
  camera.name = path;
  camera.model = at.has("model") ? at["model"].text() : camera.model;
  readLens(at, path, camera);
  if (findCamera(camera.model))
  {
    checkKeys(at, camera);
  }
  camera.R = at["R"].matrix<Eigen::Matrix3d>();
  camera.t = at["t"].matrix<Eigen::Vector3d>();
  camera.width = static_cast<int>(at["width"].wholeNumber(side));
  camera.height = static_cast<int>(at["height"].wholeNumber(side));
  camera.near = at.has("near") ? at["near"].number(distance) : 1e-6;
  // null: infinity, which JSON has not
  camera.far = at.has("far") && !at["far"].isNull() ? at["far"].number() : std::numeric_limits<double>::max();
  if (camera.far <= camera.near)
  {
    at["far"].fail("is not beyond near", "more than " + plainNumber(camera.near), plainNumber(camera.far));
  }
  if (at.has("rollingShutter"))
  {
    camera.rollingShutter.duration = at["rollingShutter"]["duration"].number(frames);
  }
  const Eigen::Matrix3d error = camera.R * camera.R.transpose() - Eigen::Matrix3d::Identity();
  if (error.cwiseAbs().maxCoeff() > 1e-6 || camera.R.row(0).cross(camera.R.row(1)).dot(camera.R.row(2)) < 0)
  {
    throw InputError(path, "R is not a rotation");
  }
  return camera;
}

View viewOf(const CameraRecord& camera, const std::string& file)
{
  View view;
  view.name = camera.name;
  view.camera_from_world = { camera.R, camera.t };
  view.near = camera.near;
  view.far = camera.far;
  try
  {
    const std::optional<Eigen::Matrix3d> K = camera.hasK ? std::optional(camera.K) : std::nullopt;
    const CameraParameters of{ camera.width, camera.height, K, camera.numbers, camera.files };
    view.model = findCamera(camera.model) ? makeCamera(camera.model, of) : nullptr;
  }
  catch (const UsageError& error)
  {
    throw InputError(file, "camera " + quoted(camera.name) + ": " + error.what());
  }
  if (!view.model)
  {
    throw UsageError("camera " + quoted(camera.name) + " of " + file + " has a model that is not known here (" +
                     quoted(camera.model) + "): it cannot be warped from and to");
  }
  if (camera.rollingShutter.duration > 0 || view.model->rolls())
  {
    throw UsageError("camera " + quoted(camera.name) + " of " + file +
                     " has a rolling shutter: its picture is of many instants and cannot be warped from or to");
  }
  return view;
}

/// A layered depth image and the dataset that it belongs to.
struct Source
{
  std::string path;
  std::string cameras; ///< cameras.json
  std::string camera;  ///< name
  int frame = 0;
};

/// DIR/<camera>/ldi/<frame>.ldi
Source locate(const std::string& path)
{
  namespace fs = std::filesystem;
  const fs::path layer = fs::absolute(path).lexically_normal().parent_path();
  const std::string stem = fs::path(path).stem().string();
  const bool digits = !stem.empty() && stem.size() < 10 &&
                      stem.find_first_not_of("0123456789", stem[0] == '-' ? 1 : 0) == std::string::npos && stem != "-";
  if (fs::path(path).extension() != ".ldi" || layer.filename() != "ldi" || !digits)
  {
    throw UsageError(path + " is not in a dataset (expected DIR/CAMERA/ldi/FRAME.ldi)");
  }
  const fs::path camera = layer.parent_path();
  return { path, (camera.parent_path() / "cameras.json").string(), camera.filename().string(), std::stoi(stem) };
}

const CameraRecord& find(
  const std::vector<CameraRecord>& cameras, const std::string& name, int frame, const std::string& file)
{
  const auto found = std::find_if(cameras.begin(), cameras.end(),
    [&](const CameraRecord& camera) { return camera.name == name && camera.frame == frame; });
  if (found == cameras.end())
  {
    throw UsageError(file + " has no camera " + quoted(name) + " at frame " + std::to_string(frame));
  }
  return *found;
}

/// NAME, NAME@FRAME or a camera file.
View target(const std::string& text, const Source& source, const std::vector<CameraRecord>& cameras)
{
  const auto named = [&](const std::string& name)
  {
    return std::any_of(cameras.begin(), cameras.end(), [&](const CameraRecord& camera) { return camera.name == name; });
  };
  if (!named(text) && isFile(text))
  {
    return viewOf(readCameraFile(text), text);
  }
  const std::size_t at = text.rfind('@');
  if (named(text) || at == std::string::npos)
  {
    return viewOf(find(cameras, text, source.frame, source.cameras), source.cameras);
  }
  const int frame = parseInteger(text.substr(at + 1), "--to: frame", -farthestFrame, farthestFrame);
  return viewOf(find(cameras, text.substr(0, at), frame, source.cameras), source.cameras);
}

WarpedImage warp(LdiReader& file, std::uint32_t layers, const View& from, const View& to)
{
  const WarpSource source = [&](const std::function<void(int, int, const WarpSample&)>& visit)
  {
    file.rewind();
    LdiRow row;
    for (int y = 0; file.read(row); ++y)
    {
      const LdiRecord* record = row.records.data();
      for (int x = 0; x < file.width(); ++x)
      {
        const std::uint32_t count = row.counts[static_cast<std::size_t>(x)];
        for (std::uint32_t i = 0; i < std::min(count, layers); ++i)
        {
          visit(x, y, { record[i].rgba, record[i].depth, record[i].splatIndex });
        }
        record += count;
      }
    }
  };
  return warpLayeredDepth(source, from, to);
}

void save(const std::string& path, const WarpedImage& image, const std::vector<std::uint8_t>& pixels, int channels)
{
  LayerSpec spec;
  spec.name = "picture";
  spec.meaning = Meaning::Picture;
  spec.channels = channels;
  const auto writer = makeLayerWriter("png", path, spec, image.width, image.height);
  Rows rows(PixelType::UInt8, channels, image.width, 0, image.height);
  std::copy(pixels.begin(), pixels.end(), rows.row<std::uint8_t>(0));
  writer->write(rows);
  writer->finish();
}

/// Both pictures are PNG, and neither is the other one, the image that is read, or another file of a dataset.
void checkNames(const std::string& ldi, const std::string& picture, const std::string& mask)
{
  namespace fs = std::filesystem;
  const auto same = [](const std::string& a, const std::string& b)
  {
    std::error_code code; // where one is not there
    return fs::equivalent(a, b, code) || fs::absolute(a).lexically_normal() == fs::absolute(b).lexically_normal();
  };
  if (same(picture, ldi) || (!mask.empty() && (same(mask, ldi) || same(mask, picture))))
  {
    throw UsageError("the picture, its mask and the layered depth image need names of their own");
  }
  for (const std::string& name : { picture, mask })
  {
    if (!name.empty() && extensionOf(name) != "png")
    {
      throw UsageError(name + ": a picture is written as .png");
    }
    requireOutsideDatasets(name);
  }
}

int runWarp(const Arguments& arguments)
{
  const std::string output = arguments.text("--output");
  if (output.empty() || !arguments.has("--to"))
  {
    throw UsageError("warp needs a camera and a file for the picture: --to CAMERA -o FILE.png");
  }
  const int layers = arguments.integer("--layers", 0, 1 << 30);
  const Source source = locate(arguments.positional()[0]);
  checkNames(source.path, output, arguments.text("--mask"));
  LdiReader file(source.path);
  const std::vector<CameraRecord> cameras = readCameras(source.cameras);
  const View from = viewOf(find(cameras, source.camera, source.frame, source.cameras), source.cameras);
  if (from.model->width() != file.width() || from.model->height() != file.height())
  {
    throw InputError(source.path, "has another size than its camera",
      std::to_string(from.model->width()) + " x " + std::to_string(from.model->height()),
      std::to_string(file.width()) + " x " + std::to_string(file.height()));
  }
  const View to = target(arguments.text("--to"), source, cameras);
  const std::uint32_t most =
    layers == 0 ? std::numeric_limits<std::uint32_t>::max() : static_cast<std::uint32_t>(layers);
  const WarpedImage image = warp(file, most, from, to);
  save(output, image, image.rgb, 3);
  if (arguments.has("--mask"))
  {
    save(arguments.text("--mask"), image, image.holes, 1);
  }
  print(std::to_string(image.holeCount) + " of " + std::to_string(image.holes.size()) +
        " pixels without a sample (holes)\n");
  return 0;
}
} // namespace

Command warpCommand()
{
  return { "LDI", 1, 1,
    { { "--output", "FILE.png", "", "the picture" },
      { "--to", "CAMERA", "", "a camera of the dataset, NAME[@FRAME], or a .json file with K, R, t, width, height" },
      { "--layers", "N", "0", "use the first N surfaces of each pixel (1: a depth map); 0: all" },
      { "--mask", "FILE.png", "", "also write where no sample fell (255)" } },
    &runWarp };
}

} // namespace dgtk::app
