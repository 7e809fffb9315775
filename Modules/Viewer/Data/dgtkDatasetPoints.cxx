// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetPoints.h"

#include "dgtkCameraEntry.h"
#include "dgtkError.h"
#include "dgtkPictureColors.h"
#include "dgtkStage.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr std::array<std::uint8_t, 3> uncolored = { 200, 200, 205 };
constexpr double samePlace = 1e-9;

std::shared_ptr<const CameraModel> modelOf(const CameraRecord& camera)
{
  const std::optional<Eigen::Matrix3d> K = camera.hasK ? std::optional(camera.K) : std::nullopt;
  return findCamera(camera.model) ? makeCamera(camera.model, { camera.width, camera.height, K, camera.numbers,
                                                               camera.files, camera.rollingShutter })
                                  : nullptr;
}

/// The parameter of the ray's point at a distance from the origin of its frame.
double parameterAt(const CameraRay& ray, double distance)
{
  const double square = ray.direction.squaredNorm();
  const double middle = ray.origin.dot(ray.direction) / square;
  return -middle + std::sqrt(middle * middle - (ray.origin.squaredNorm() - distance * distance) / square);
}

/// False for a model that is not known here, or places that are not. What is wrong with a known one is said where its
/// points are asked for.
bool knowsRays(const DatasetPictures& dataset, const CameraRecord& camera)
{
  try
  {
    return findCamera(camera.model) != nullptr && PixelCamera(dataset, camera).knowsPlace();
  }
  catch (const Error&)
  {
    return true;
  }
}

/// Whether the camera is in the same place at the frames before and after that the dataset has: at one of them at
/// least.
bool standsStill(const DatasetPictures& dataset, const CameraRecord& camera)
{
  const CameraRecord* before = nullptr;
  const CameraRecord* after = nullptr;
  for (const CameraRecord& other : dataset.records()) // by frame
  {
    if (other.name == camera.name && other.frame < camera.frame)
    {
      before = &other;
    }
    else if (other.name == camera.name && other.frame > camera.frame && after == nullptr)
    {
      after = &other;
    }
  }
  const auto agrees = [&](const CameraRecord* other)
  { return other == nullptr || (other->R == camera.R && other->t == camera.t); };
  return (before != nullptr || after != nullptr) && agrees(before) && agrees(after);
}

bool isPlace(const LayerSpec& spec) { return spec.meaning == Meaning::Point && spec.frame == "world"; }
} // namespace

View viewOf(const CameraRecord& record)
{
  View view;
  view.name = record.name;
  view.model = modelOf(record);
  if (!view.model)
  {
    throw InputError("cameras.json", "camera " + quoted(record.name) + " has a model that is not known here",
      "a camera model of this program", quoted(record.model));
  }
  view.camera_from_world = { record.R, record.t };
  view.near = record.near;
  view.far = record.far;
  return view;
}

PixelCamera::PixelCamera(const DatasetPictures& dataset, const CameraRecord& record)
  : Seen(viewOf(record))
  , Frame(record.frame)
  , OnePlace(!Seen.model->rolls() || standsStill(dataset, record))
{
  const CameraDescription* const camera = this->Seen.model->rolls() ? dataset.sceneCamera(record.name) : nullptr;
  if (camera == nullptr)
  {
    return;
  }
  CameraDescription motion;
  motion.posed = camera->posed;
  motion.eye = camera->eye;
  motion.lookAt = camera->lookAt;
  motion.up = camera->up;
  motion.position = camera->position;
  motion.orientation = camera->orientation;
  const Rigid3 own = cameraView(motion, record.frame).camera_from_world;
  if (own.rotation.isApprox(record.R, samePlace) &&
      (own.translation - record.t).norm() <= samePlace * std::max(1.0, record.t.norm()))
  {
    this->Motion = std::move(motion);
  }
}

const View* PixelCamera::at(int x, int y)
{
  if (this->Motion)
  {
    const double time = this->Frame + this->Seen.model->timeAt(Eigen::Vector2d(x + 0.5, y + 0.5));
    this->Seen.camera_from_world = cameraView(*this->Motion, time).camera_from_world;
  }
  return this->knowsPlace() ? &this->Seen : nullptr;
}

bool givesPoints(const LayerSpec& spec)
{
  return spec.meaning == Meaning::Depth || spec.meaning == Meaning::Distance || spec.meaning == Meaning::InverseDepth ||
         isPlace(spec);
}

std::optional<Eigen::Vector3d> pointOf(const LayerSpec& spec, const View& view, int x, int y, const double* values)
{
  if (isPlace(spec))
  {
    const Eigen::Vector3d point(values[0], values[1], values[2]);
    return point.allFinite() ? std::optional<Eigen::Vector3d>(point) : std::nullopt;
  }
  const double value = spec.meaning == Meaning::InverseDepth ? 1 / values[0] : values[0];
  if (!givesPoints(spec) || !std::isfinite(value))
  {
    return std::nullopt;
  }
  const CameraRay ray = view.model->rayThrough(Eigen::Vector2d(x + 0.5, y + 0.5));
  const double along =
    spec.meaning == Meaning::Distance ? parameterAt(ray, value) : (value - ray.origin.z()) / ray.direction.z();
  if (!ray.exists() || !std::isfinite(along))
  {
    return std::nullopt; // depth says no place on a ray along the image plane
  }
  return view.camera_from_world.inverse() * (ray.origin + along * ray.direction);
}

std::string pointLayer(const DatasetPictures& dataset, const std::string& camera, int frame)
{
  const CameraRecord* const record = dataset.camera(camera, frame);
  const bool positionOnly = record != nullptr && !knowsRays(dataset, *record);
  for (const Meaning meaning : { Meaning::Point, Meaning::Depth, Meaning::Distance, Meaning::InverseDepth })
  {
    for (const PictureLayer& layer : dataset.layers())
    {
      // a .png of depth is a picture for people
      const bool usable = layer.spec.meaning == meaning && givesPoints(layer.spec) && layer.format != "png" &&
                          (isPlace(layer.spec) || !positionOnly);
      if (usable && !dataset.file({ camera, frame, layer.label }).empty())
      {
        return layer.label;
      }
    }
  }
  return {};
}

void addPoints(PointCloud& cloud, const DatasetPictures& dataset, const std::string& camera, int frame,
  const std::string& colorLayer, std::size_t most, const std::function<bool()>& goOn)
{
  const std::string label = pointLayer(dataset, camera, frame);
  const CameraRecord* const record = dataset.camera(camera, frame);
  if (label.empty())
  {
    return;
  }
  if (record == nullptr)
  {
    throw InputError(
      dataset.folder() + "/cameras.json", "has no camera " + quoted(camera) + " at frame " + std::to_string(frame));
  }
  const std::string path = dataset.file({ camera, frame, label });
  const PictureLayer& layer = *dataset.layer(label);
  std::optional<PixelCamera> eye;
  if (!isPlace(layer.spec))
  {
    eye.emplace(dataset, *record);
  }
  const View none;
  const auto [width, height] = pictureSize(path, layer);
  PictureRead read;
  read.goOn = goOn;
  read.step = std::max(1, static_cast<int>(std::ceil(std::sqrt(double(width) * height / double(most)))));
  const PictureValues values = readPicture(path, layer, read);
  const std::string colors = colorLayer.empty() ? dataset.firstLayer(Meaning::Picture, camera, frame) : colorLayer;
  const std::string colorPath = dataset.file({ camera, frame, colors });
  PictureColors painted;
  if (!colorPath.empty())
  {
    const PictureValues picture = readPicture(colorPath, *dataset.layer(colors), read);
    const bool same = picture.columns() == values.columns() && picture.rows() == values.rows();
    painted = same ? colorPicture(dataset, picture) : PictureColors();
  }
  std::vector<double> channels(std::size_t(std::max(1, values.values.channels())));
  for (int row = 0; row < values.rows(); ++row)
  {
    for (int column = 0; column < values.columns(); ++column)
    {
      values.get(column, row, channels.data());
      const int x = values.x(column);
      const int y = values.y(row);
      const View* const view = eye ? eye->at(x, y) : &none;
      const auto point = view ? pointOf(layer.spec, *view, x, y, channels.data()) : std::nullopt;
      if (point)
      {
        cloud.points.push_back(*point);
        const std::size_t i = std::size_t(row) * std::size_t(values.columns()) + std::size_t(column);
        const std::uint32_t color = painted.pixels.empty() ? 0 : painted.pixels[i];
        cloud.colors.push_back(painted.pixels.empty() ? uncolored
                                                      : std::array<std::uint8_t, 3>{ std::uint8_t(color >> 16),
                                                          std::uint8_t(color >> 8), std::uint8_t(color) });
      }
    }
  }
}

} // namespace dgtk
