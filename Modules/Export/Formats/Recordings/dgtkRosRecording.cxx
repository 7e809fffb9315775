// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRosRecording.h"

#include "dgtkError.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkExportSeries.h"
#include "dgtkLayerFile.h"
#include "dgtkText.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

namespace dgtk::ros
{

namespace
{
constexpr double second = 1e9; // nanoseconds

std::uint64_t timeOf(const DatasetView& dataset, int frame)
{
  return static_cast<std::uint64_t>(std::llround((dataset.seconds(frame) + 1) * second));
}

/// Topics of a camera, in this order behind /tf.
enum CameraTopic : std::size_t
{
  Picture,
  Info,
  Depth,
  DepthInfo,
  CameraTopics
};

/// Coefficients without the zeros at their end.
std::vector<double> coefficientsOf(const CameraRecord& camera)
{
  std::vector<double> numbers = distortionOf(camera);
  while (!numbers.empty() && numbers.back() == 0)
  {
    numbers.pop_back();
  }
  return numbers;
}

struct Lens
{
  std::string name; ///< "" for one that ROS does not know
  std::size_t coefficients = 0;
};

Lens rosLensOf(const CameraRecord& camera)
{
  const std::size_t count = coefficientsOf(camera).size();
  if (camera.rollingShutter.duration != 0 || !camera.hasK || camera.K(0, 1) != 0)
  {
    return {};
  }
  if (camera.model == "fisheye")
  {
    return { "equidistant", 4 };
  }
  if (camera.model != "pinhole" || count > 8)
  {
    return {};
  }
  return count > 5 ? Lens{ "rational_polynomial", 8 } : Lens{ "plumb_bob", 5 };
}

void requireLens(const CameraRecord& camera, const std::string& format)
{
  if (rosLensOf(camera).name.empty())
  {
    const char* what = camera.rollingShutter.duration != 0        ? " with a rolling shutter"
                       : camera.hasK && camera.K(0, 1) != 0       ? " with skew"
                       : camera.model == "pinhole" && camera.hasK ? " with more than 8 coefficients"
                                                                  : "";
    throw UsageError(format + ": camera " + quoted(camera.name) + " (" + camera.model + what +
                     ") is none that sensor_msgs/CameraInfo knows: plumb_bob, rational_polynomial, equidistant");
  }
}

/// Positions in a recording's part have 32 bits.
void requireSmall(const CameraRecord& camera, const std::string& format)
{
  constexpr std::uint64_t most = (std::uint64_t(1) << 32) / 13; // bytes a pixel: 4 of depth, at most 8 of colour
  if (std::uint64_t(camera.width) * camera.height > most)
  {
    throw UsageError(format + ": the pictures of camera " + quoted(camera.name) + " have more than " +
                     std::to_string(most) + " pixels, which the format cannot hold");
  }
}

/// Letters, digits and '_' alone.
std::string safeName(const std::string& name)
{
  std::string safe = SafeNames().of(name);
  std::replace(safe.begin(), safe.end(), '-', '_');
  return safe;
}

/// REP 118: a depth is positive.
bool isSayable(double depth)
{
  return depth <= double(std::numeric_limits<float>::max()) && static_cast<float>(depth) > 0;
}

std::string pictureName(const std::string& file, const std::string& camera, std::uint64_t time)
{
  constexpr std::uint64_t whole = 1000000000;
  return file + ':' + camera + '@' + std::to_string(time / whole) + '.' + padded(static_cast<int>(time % whole), 9);
}
} // namespace

std::map<std::string, std::string> namesOfCameras(const DatasetView& dataset)
{
  std::map<std::string, std::string> names;
  std::set<std::string> taken{ "tf" };
  for (const std::string& camera : dataset.cameras())
  {
    const std::string safe = safeName(camera);
    std::string name = safe;
    for (int i = 2; !taken.insert(name).second; ++i)
    {
      name = safe + '_' + std::to_string(i);
    }
    names[camera] = name;
  }
  return names;
}

void requireRecordable(const DatasetView& dataset, const OptionValues& options, const std::string& format)
{
  dataset.metres();
  for (const DatasetShot& shot : dataset.shots())
  {
    requireLens(shot.camera, format);
    requireSmall(shot.camera, format);
    const double seconds = dataset.seconds(shot.frame()) + 1;
    if (seconds <= 0 || seconds >= double(std::numeric_limits<std::uint32_t>::max()))
    {
      throw UsageError(format + ": frame " + std::to_string(shot.frame()) + " has no time: seconds have 32 bits");
    }
  }
  requireEverywhere(dataset, exported::color().of(options), format, { "png" });
  requireEverywhere(dataset, exported::depth().of(options), format);
}

ExportNeeds recordingNeeds(const OptionValues& options)
{
  return { { exported::color().of(options), exported::depth().of(options) } };
}

ExportPlan planRecordings(const DatasetView& dataset, const OptionValues& options, const std::string& extension,
  void (*write)(ExportSink& sink, const Recording& recording, const std::string& file))
{
  ExportPlan plan;
  plan.conventions = { { "pixel_centre", "integer: cx and cy are 0.5 less" },
    { "axes", "of cameras x right, y down, z forward; world and objects have the dataset's" },
    { "times", "frame / frames per second + 1 s" }, { "depth", "z, float32 metres, NaN for none and for z <= 0" },
    { "metres_per_unit", shortest(dataset.metres()) } };
  std::set<std::string> sheared;
  for (const int frame : dataset.frames())
  {
    for (const PoseRecord& pose : dataset.poses(frame))
    {
      const ObjectRecord* object = dataset.object(pose.id);
      if (object && !pose.rigid)
      {
        sheared.insert(object->name);
      }
    }
  }
  if (!sheared.empty())
  {
    plan.conventions.emplace_back("sheared_objects_without_axes", joined({ sheared.begin(), sheared.end() }));
  }
  const std::map<std::string, std::string> names = namesOfCameras(dataset);
  for (const DatasetSplit& split : splitsOf(dataset, options, "dataset"))
  {
    const std::string file = split.name + '.' + extension;
    plan.series.push_back(dgtk::namesOf(dataset, shotsIn(dataset, split),
      [&dataset, names, file](const DatasetShot& shot)
      { return pictureName(file, names.at(shot.name()), timeOf(dataset, shot.frame())); }));
    plan.items.push_back({ { file }, [&dataset, options, split, file, write](ExportSink& sink)
      { write(sink, Recording(dataset, options, split), file); } });
  }
  return plan;
}

Recording::Recording(const DatasetView& dataset, const OptionValues& options, const DatasetSplit& split)
  : Dataset(dataset)
  , Options(options)
  , Names(namesOfCameras(dataset))
{
  for (const CameraEyes& eyes : eyesOf(dataset))
  {
    if (!eyes.right.empty())
    {
      this->LeftOf[eyes.right] = eyes.left;
    }
  }
  for (const DatasetShot& shot : dataset.shots())
  {
    if (split.holds(shot))
    {
      this->Shots.push_back(&shot);
    }
  }
  std::stable_sort(this->Shots.begin(), this->Shots.end(),
    [](const DatasetShot* a, const DatasetShot* b)
    { return std::make_tuple(a->frame(), a->index) < std::make_tuple(b->frame(), b->index); });
  this->Topics.push_back({ "/tf", &transformsType() });
  std::set<std::string> cameras;
  for (const DatasetShot* shot : this->Shots)
  {
    cameras.insert(shot->name());
  }
  for (const std::string& camera : cameras)
  {
    this->FirstTopic[camera] = this->Topics.size();
    const std::string base = '/' + this->Names.at(camera);
    this->Topics.push_back({ base + "/image_raw/compressed", &compressedImageType() });
    this->Topics.push_back({ base + "/camera_info", &cameraInfoType() });
    this->Topics.push_back({ base + "/depth/image_raw", &imageType() });
    this->Topics.push_back({ base + "/depth/camera_info", &cameraInfoType() });
  }
}

std::uint64_t Recording::nanoseconds(const DatasetShot& shot) const { return timeOf(this->Dataset, shot.frame()); }

CameraInfo Recording::infoOf(const DatasetShot& shot) const
{
  const Lens lens = rosLensOf(shot.camera);
  CameraInfo info;
  info.width = shot.camera.width;
  info.height = shot.camera.height;
  info.model = lens.name;
  info.D = coefficientsOf(shot.camera);
  info.D.resize(lens.coefficients);
  info.K = intrinsicsOf(shot.camera, PixelCentre::Integer);
  const auto left = this->LeftOf.find(shot.name());
  if (left != this->LeftOf.end())
  {
    info.baseline = baselineMetres(this->Dataset, *this->Dataset.shot(left->second, shot.frame()), shot);
  }
  return info;
}

Message Recording::picture(
  const DatasetShot& shot, const Stamp& stamp, const std::string& frame, ExportSink& sink) const
{
  const bool png = pictureExtension(this->Options) == "png";
  EncodedPicture encoded = encodePicture(this->Dataset, shot, exported::color().of(this->Options), this->Options);
  Message message;
  message.topic = this->FirstTopic.at(shot.name()) + Picture;
  message.body = std::move(encoded.bytes);
  message.head =
    compressedImageHead(stamp, frame, png ? "png" : "jpeg", static_cast<std::uint32_t>(message.body.size()));
  sink.rounding(encoded.rounding);
  return message;
}

Message Recording::depth(const DatasetShot& shot, const Stamp& stamp, const std::string& frame, ExportSink& sink) const
{
  Message message;
  message.topic = this->FirstTopic.at(shot.name()) + Depth;
  message.head = floatImageHead(stamp, frame, shot.camera.width, shot.camera.height);
  message.body.reserve(std::size_t(shot.camera.width) * std::size_t(shot.camera.height) * sizeof(float));
  ClassedRows rows(this->Dataset, shot, exported::depth().of(this->Options));
  LayerRounding rounding{ exported::depth().of(this->Options), "m", 0, 0, 0 };
  for (int y = 0; y < rows.info().height; ++y)
  {
    rows.next();
    for (int x = 0; x < rows.info().width; ++x)
    {
      const double value = rows.at(x) * this->Dataset.metres();
      const bool there = std::isfinite(value);
      const bool fits = isSayable(value);
      const float code = fits ? static_cast<float>(value) : std::numeric_limits<float>::quiet_NaN();
      rounding.values += there ? 1 : 0;
      rounding.withoutCode += there && !fits ? 1 : 0;
      rounding.largest = fits ? std::max(rounding.largest, std::abs(double(code) - value)) : rounding.largest;
      putLittle(message.body, code);
    }
  }
  sink.rounding(rounding);
  return message;
}

std::vector<Transform> Recording::placesOf(std::size_t shot, const std::string& frame) const
{
  const DatasetShot& one = *this->Shots[shot];
  const double metres = this->Dataset.metres();
  const Rigid3 camera = cameraFromWorld(one.camera).inverse();
  std::vector<Transform> all{ { frame, { camera.rotation, camera.translation * metres } } };
  if (shot > 0 && this->Shots[shot - 1]->frame() == one.frame())
  {
    return all;
  }
  for (const PoseRecord& pose : this->Dataset.poses(one.frame()))
  {
    const ObjectRecord* object = this->Dataset.object(pose.id);
    if (object && pose.rigid && pose.visible)
    {
      all.push_back({ safeName(object->name) + '_' + std::to_string(pose.id), { pose.R, pose.t * metres } });
    }
  }
  return all;
}

std::vector<Message> Recording::messages(std::size_t shot, ExportSink& sink) const
{
  const DatasetShot& one = *this->Shots[shot];
  const Stamp stamp{ static_cast<std::uint32_t>(one.frame()), this->nanoseconds(one) };
  const std::string frame = this->Names.at(one.name()) + "_optical_frame";
  const std::size_t first = this->FirstTopic.at(one.name());
  const std::string info = cameraInfo(stamp, frame, this->infoOf(one));
  std::vector<Message> all;
  all.push_back({ 0, transforms(stamp, "world", this->placesOf(shot, frame)) });
  all.push_back({ first + Info, info });
  all.push_back(this->picture(one, stamp, frame, sink));
  all.push_back({ first + DepthInfo, info });
  all.push_back(this->depth(one, stamp, frame, sink));
  return all;
}

} // namespace dgtk::ros
