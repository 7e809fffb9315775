// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLiveTruth.h"

#include "dgtkAlbedo.h"
#include "dgtkError.h"
#include "dgtkSamples.h"
#include "dgtkSurfaceRows.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <thread>
#include <utility>

namespace dgtk
{

namespace
{
constexpr int stripPixels = 1 << 14;
constexpr int steps[] = { 6, 2, 1 };
constexpr int leastFine = 1 << 14; ///< pixels of a picture that is not worth a coarse one

View coarser(const View& view, int step)
{
  View coarse = view;
  coarse.model = resampledCamera(
    view.model, (view.model->width() + step - 1) / step, (view.model->height() + step - 1) / step, step, { 0, 0 });
  return coarse;
}

/// One thread is left to the window.
int pictureThreads() { return std::clamp(static_cast<int>(std::thread::hardware_concurrency()) - 1, 1, 8); }

template <typename T>
void append(const Rows& rows, std::vector<double>& values)
{
  const T* const value = rows.row<T>(rows.y());
  values.insert(values.end(), value, value + rows.channels());
}

std::vector<double> numbers(const Rows& rows)
{
  std::vector<double> values;
  switch (rows.type())
  {
    case PixelType::UInt8:
      append<std::uint8_t>(rows, values);
      break;
    case PixelType::UInt16:
      append<std::uint16_t>(rows, values);
      break;
    case PixelType::UInt32:
      append<std::uint32_t>(rows, values);
      break;
    case PixelType::Float32:
      append<float>(rows, values);
      break;
    case PixelType::Float64:
      append<double>(rows, values);
      break;
  }
  return values;
}

PixelLayer layerOf(const SceneState& state, const Hit& hit, const SurfacePoint& point)
{
  const Instance& instance = state.instances[hit.object - 1];
  const Model& model = *instance.model;
  PixelLayer layer;
  layer.object = instance.name;
  layer.id = hit.object;
  layer.part = model.partOf(hit.triangle);
  layer.triangle = hit.triangle - model.parts[layer.part].firstTriangle;
  layer.depth = point.t;
  layer.color = albedoAt(instance, hit.triangle, point.barycentrics);
  const std::vector<Material>& materials = instance.materials ? *instance.materials : model.materials;
  layer.opacity = materials.empty() ? 1 : materials[model.parts[layer.part].material].opacity;
  return layer;
}

void findRange(const Rows& rows, LivePicture& picture)
{
  if (rows.type() != PixelType::Float64 || rows.channels() != 1)
  {
    return;
  }
  const double* const first = rows.row<double>(0);
  for (const double* value = first; value != first + std::size_t(rows.width()) * rows.height(); ++value)
  {
    if (std::isfinite(*value))
    {
      const bool none = picture.least > picture.most;
      picture.least = none ? *value : std::min(picture.least, *value);
      picture.most = none ? *value : std::max(picture.most, *value);
    }
  }
}

template <typename Answer, typename Make>
Answer attempted(const Make& make)
{
  Answer answer;
  try
  {
    answer = make();
  }
  catch (const std::exception& error)
  {
    answer.message = error.what();
  }
  return answer;
}
} // namespace

LivePicture livePicture(
  const LiveQuestion& question, const std::string& layer, int step, ThreadPool& pool, const std::function<bool()>& stop)
{
  LiveView view = question.view;
  for (View* one : { &view.now, &view.before, &view.after })
  {
    *one = step > 1 ? coarser(*one, step) : *one;
  }
  LiveEye eye(question.scene, question.frame, view, pool);
  const int width = view.now.model->width();
  const int height = view.now.model->height();
  const LayerSpec spec = eye.spec(layer);
  LivePicture result;
  result.meaning = spec.meaning;
  result.step = step;
  Rows whole(spec.type, spec.channels, width, 0, height);
  VisibilityBuffer hits;
  const int strip = std::max(8, stripPixels / width / 8 * 8);
  for (int y = 0; y < height; y += strip)
  {
    if (stop && stop())
    {
      return result;
    }
    eye.trace({ 0, y, width, std::min(strip, height - y) }, hits);
    const Rows rows = eye.values(layer, hits);
    std::memcpy(whole.data() + whole.rowBytes() * std::size_t(y), rows.data(), rows.bytes());
  }
  result.picture = paintLayer(whole, spec);
  findRange(whole, result);
  if (eye.isBeyond(layer))
  {
    result.message =
      layer.rfind("flow_backward", 0) == 0 ? "the first frame has none before it" : "the last frame has none after it";
  }
  return result;
}

PixelTruth pixelTruth(const LiveQuestion& question, int column, int row, ThreadPool& pool)
{
  const View& view = question.view.now;
  if (column < 0 || row < 0 || column >= view.model->width() || row >= view.model->height())
  {
    throw UsageError("the pixel is outside the image");
  }
  LiveEye eye(question.scene, question.frame, question.view, pool);
  const SceneState& state = *eye.moment().state;
  VisibilityBuffer hits;
  eye.trace({ column, row, 1, 1 }, hits);
  PixelTruth truth;
  truth.column = column;
  truth.row = row;
  truth.frame = question.frame;
  for (const LiveLayer& layer : liveLayers())
  {
    if (layer.name != "surface")
    {
      truth.values.push_back({ eye.spec(layer.name), numbers(eye.values(layer.name, hits)) });
    }
  }
  if (const Hit& hit = hits.hits.front(); hit.object != 0)
  {
    const Instance& instance = state.instances[hit.object - 1];
    truth.object = instance.name;
    truth.className = instance.className;
    truth.part = instance.model->parts[instance.model->partOf(hit.triangle)].name;
  }
  std::vector<Hit> surfaces;
  const Eigen::Vector2d center(column + 0.5, row + 0.5);
  eye.moment().occlusion->allHits(view, center, surfaces);
  for (const Hit& hit : surfaces)
  {
    truth.layers.push_back(layerOf(state, hit, surfacePointAt(state, view, center, hit)));
  }
  return truth;
}

LiveTruth::LiveTruth()
  : Pool(pictureThreads())
  , Alone(1)
{
}

LiveTruth::~LiveTruth() = default;

void LiveTruth::askPicture(LiveQuestion question, std::string layer, std::function<void(const LivePicture&)> receive)
{
  this->Pictures.start(
    [this, question = std::move(question), layer = std::move(layer), receive = std::move(receive)](
      const NewestTask::Outdated& outdated)
    {
      const CameraModel& model = *question.view.now.model;
      const bool small = std::int64_t(model.width()) * model.height() < leastFine;
      for (const int factor : steps)
      {
        const int step = factor * question.finest;
        if (factor > 1 && small)
        {
          continue;
        }
        // The coarse picture is shown even when it is late, so that a view that is being turned is not empty.
        LivePicture picture = attempted<LivePicture>(
          [&]
          {
            return livePicture(
              question, layer, step, this->Pool, factor == steps[0] || small ? std::function<bool()>() : outdated);
          });
        picture.coarseness = factor;
        if (!picture.picture.pixels.empty() || !picture.message.empty())
        {
          receive(picture);
        }
        if (outdated())
        {
          return;
        }
      }
    });
}

void LiveTruth::askPixel(LiveQuestion question, int column, int row, std::function<void(const PixelTruth&)> receive)
{
  this->Pixels.start(
    [this, question = std::move(question), column, row, receive = std::move(receive)](const NewestTask::Outdated&)
    { receive(attempted<PixelTruth>([&] { return pixelTruth(question, column, row, this->Alone); })); });
}

void LiveTruth::wait()
{
  this->Pictures.wait();
  this->Pixels.wait();
}

} // namespace dgtk
