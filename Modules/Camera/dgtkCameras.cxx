// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFinerCamera.h"
#include "dgtkLensCamera.h"
#include "dgtkLinearCamera.h"
#include "dgtkRollingCamera.h"
#include "dgtkText.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>

namespace dgtk
{

void CameraModel::raysThrough(const Eigen::Vector2d* pixels, std::size_t count, CameraRay* rays) const
{
  std::transform(
    pixels, pixels + count, rays, [this](const Eigen::Vector2d& pixel) { return this->rayThrough(pixel); });
}

void CameraModel::projectAll(
  const Eigen::Vector3d* x_in_camera, std::size_t count, Eigen::Vector2d* pixels, std::uint8_t* seen) const
{
  for (std::size_t i = 0; i < count; ++i)
  {
    seen[i] = this->project(x_in_camera[i], pixels[i]) ? 1 : 0;
  }
}

namespace
{
constexpr int largestSide = 1 << 20;

void checkNumbers(const CameraParameter& parameter, const std::vector<double>& numbers)
{
  if (std::find(parameter.counts.begin(), parameter.counts.end(), numbers.size()) == parameter.counts.end())
  {
    throw UsageError(
      parameter.name + " has " + std::to_string(numbers.size()) + " numbers (expected " + countsText(parameter) + ")");
  }
  for (const double number : numbers)
  {
    if (!std::isfinite(number) || !parameter.range.holds(number))
    {
      throw UsageError(
        parameter.name + " out of range (expected " + parameter.range.text + ", found " + shortest(number) + ")");
    }
  }
}

/// Fails for a name that is no parameter of this kind.
template <typename Values>
void checkNames(const std::string& model, const CameraEntry& entry, const Values& values, CameraParameter::Kind kind)
{
  for (const auto& [name, value] : values)
  {
    const CameraParameter* const parameter = entry.find(name);
    if (parameter == nullptr || parameter->kind != kind)
    {
      throw UsageError("a camera of the model " + quoted(model) + " has no " + quoted(name));
    }
  }
}

/// Cameras that were made last: one is asked for at each frame, and its tables take as long as thousands of rays.
class MadeCameras
{
public:
  std::shared_ptr<const CameraModel> make(const CameraEntry& entry, const CameraParameters& of)
  {
    if (!of.files.empty()) // what they hold may change
    {
      return withRollingShutter(entry.make(of), of.rollingShutter);
    }
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (const Made& made : this->Last)
    {
      if (made.entry == &entry && made.of.width == of.width && made.of.height == of.height && made.of.K == of.K &&
          made.of.numbers == of.numbers && made.of.rollingShutter == of.rollingShutter)
      {
        return made.camera;
      }
    }
    this->Last.push_back({ &entry, of, withRollingShutter(entry.make(of), of.rollingShutter) });
    if (this->Last.size() > most)
    {
      this->Last.pop_front();
    }
    return this->Last.back().camera;
  }

private:
  static constexpr std::size_t most = 16;
  struct Made
  {
    const CameraEntry* entry;
    CameraParameters of;
    std::shared_ptr<const CameraModel> camera;
  };
  std::mutex Mutex;
  std::deque<Made> Last;
};
} // namespace

std::string countsText(const CameraParameter& parameter)
{
  std::string text;
  for (std::size_t i = 0; i < parameter.counts.size(); ++i)
  {
    text += (i == 0 ? "" : i + 1 < parameter.counts.size() ? ", " : " or ") + std::to_string(parameter.counts[i]);
  }
  return text;
}

void checkCameraSize(int width, int height)
{
  if (width < 1 || height < 1 || width > largestSide || height > largestSide)
  {
    throw UsageError("image size out of range (expected 1 to " + std::to_string(largestSide) +
                     " pixels a side, found " + std::to_string(width) + " x " + std::to_string(height) + ")");
  }
}

CameraParameter fieldOfViewParameter()
{
  return { "fovY", "degrees", "vertical field of view", { 0, 180, true, true, "degrees above 0 and below 180" }, { 60 },
    { 1 }, true, CameraParameter::Kind::Numbers, true };
}

CameraParameter aspectParameter()
{
  return { "aspect", "", "width / height of the view; 0: square pixels",
    { 0, 1e6, false, false, "a number from 0 to 1e6" }, { 0 }, { 1 }, false, CameraParameter::Kind::Numbers, true };
}

CameraParameter viewHeightParameter()
{
  return { "viewHeight", "scene units", "height of the image", { 0, 1e15, true, false, "a number above 0, up to 1e15" },
    { 2 }, { 1 }, true, CameraParameter::Kind::Numbers, true };
}

CameraParameter matrixParameter()
{
  CameraParameter parameter{ "K", "pixels", "[fx s cx; 0 fy cy; 0 0 1] of the camera's own image size" };
  parameter.kind = CameraParameter::Kind::Matrix;
  return parameter;
}

const CameraParameter* CameraEntry::find(const std::string& name) const
{
  const auto found = std::find_if(this->parameters.begin(), this->parameters.end(),
    [&](const CameraParameter& parameter) { return parameter.name == name; });
  return found == this->parameters.end() ? nullptr : &*found;
}

const CameraEntry* findCamera(const std::string& model)
{
  const auto& rows = cameraRows();
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const CameraRow& row) { return row.model == model; });
  return found == rows.end() ? nullptr : found->entry;
}

std::shared_ptr<const CameraModel> makeCamera(const std::string& model, const CameraParameters& parameters)
{
  const CameraEntry* const entry = findCamera(model);
  if (entry == nullptr)
  {
    std::vector<std::string> models;
    for (const CameraRow& row : cameraRows())
    {
      models.push_back(row.model);
    }
    throw UsageError("no such camera model: " + quoted(model) + " (there are " + joined(models) + ")");
  }
  checkCameraSize(parameters.width, parameters.height);
  checkNames(model, *entry, parameters.numbers, CameraParameter::Kind::Numbers);
  checkNames(model, *entry, parameters.files, CameraParameter::Kind::File);
  CameraParameters whole = parameters;
  for (const CameraParameter& parameter : entry->parameters)
  {
    if (parameter.kind == CameraParameter::Kind::File && whole.files.count(parameter.name) == 0)
    {
      throw UsageError("a camera of the model " + quoted(model) + " needs " + quoted(parameter.name));
    }
    if (parameter.kind == CameraParameter::Kind::Numbers && !(whole.K && parameter.saidByK))
    {
      checkNumbers(parameter, whole.numbers.try_emplace(parameter.name, parameter.usual).first->second);
    }
  }
  static MadeCameras made;
  return made.make(*entry, whole);
}

/// Multiplied by a power of 2, all numbers are rounded as they were.
std::shared_ptr<const CameraModel> finerCamera(const CameraModel& model, int times)
{
  const bool isLens = dynamic_cast<const LensCamera*>(&model) != nullptr;
  if (!isLens || times < 1 || (times & (times - 1)) != 0 ||
      std::max(model.width(), model.height()) > largestSide / times)
  {
    return nullptr;
  }
  CameraParameters finer = model.parameters();
  finer.width *= times;
  finer.height *= times;
  finer.K->topRows<2>() *= times;
  return makeCamera(model.name(), finer);
}

} // namespace dgtk
