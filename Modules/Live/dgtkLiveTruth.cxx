// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLiveTruth.h"

#include "dgtkAlbedo.h"
#include "dgtkError.h"
#include "dgtkPixelValues.h"
#include "dgtkSurfaceRows.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <thread>
#include <utility>

namespace dgtk
{

namespace
{
constexpr int steps[] = { 6, 2, 1 };
constexpr int leastFine = 1 << 14; ///< pixels of a picture that is not worth a coarse one

/// One thread is left to the window.
int pictureThreads() { return std::clamp(static_cast<int>(std::thread::hardware_concurrency()) - 1, 1, 8); }

std::vector<double> numbers(const Rows& rows, int column, int row)
{
  std::vector<double> values(std::size_t(rows.channels()));
  copyValues(rows, column, row, values.size(), values.data());
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
  LiveEye eye(question, step, pool);
  const int width = eye.view().model->width();
  const int height = eye.view().model->height();
  const LayerSpec spec = eye.spec(layer);
  LivePicture result;
  result.meaning = spec.meaning;
  result.step = step;
  if (const std::string missing = eye.missing(layer); !missing.empty())
  {
    result.message = "it needs " + missing;
    return result;
  }
  VisibilityBuffer hits;
  if (!eye.trace(0, height, hits, stop))
  {
    return result;
  }
  const Rows whole = eye.values(layer, hits, stop);
  if (whole.width() == width)
  {
    result.picture = paintLayer(whole, spec);
    findRange(whole, result);
  }
  return result;
}

namespace
{
/// The values of all layers at a pixel; those that the view does not have are NaN, or 0.
std::vector<PixelValue> valuesAt(LiveEye& eye, const VisibilityBuffer& rows, int column, int row)
{
  std::vector<PixelValue> all;
  for (const LiveLayer& layer : liveLayers())
  {
    if (layer.name == draftLayer)
    {
      continue;
    }
    const LayerSpec spec = eye.spec(layer.name);
    const bool real = spec.type == PixelType::Float32 || spec.type == PixelType::Float64;
    const double nothing = real ? std::numeric_limits<double>::quiet_NaN() : 0;
    const std::vector<LiveImageRows> images = eye.allValues(layer.name, rows);
    for (const LiveImageRows& image : images)
    {
      all.push_back({ image.name, spec, numbers(image.rows, column, row) });
    }
    if (images.empty())
    {
      all.push_back({ layer.name, spec, std::vector<double>(std::size_t(spec.channels), nothing) });
    }
  }
  return all;
}
} // namespace

PixelTruth pixelTruth(const LiveQuestion& question, int column, int row, ThreadPool& pool)
{
  LiveEye eye(question, 1, pool);
  const View& view = eye.view();
  if (column < 0 || row < 0 || column >= view.model->width() || row >= view.model->height())
  {
    throw UsageError("the pixel is outside the image");
  }
  const SceneState& state = *eye.moment().state;
  VisibilityBuffer rows; // some layers look at the pixels around
  const int first = std::max(0, row - 1);
  eye.trace(first, std::min(row + 2, view.model->height()) - first, rows);
  PixelTruth truth;
  truth.column = column;
  truth.row = row;
  truth.frame = question.frame;
  truth.isLinear = view.model->linear().has_value();
  truth.values = valuesAt(eye, rows, column, row);
  if (const Hit& hit = rows.at(column, row); hit.object != 0)
  {
    const Instance& instance = state.instances[hit.object - 1];
    truth.object = instance.name;
    truth.id = hit.object;
    truth.className = instance.className;
    truth.partId = instance.model->partOf(hit.triangle);
    truth.part = instance.model->parts[truth.partId].name;
    truth.triangle = hit.triangle - instance.model->parts[truth.partId].firstTriangle;
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
      std::int64_t pixels = 0;
      const LivePicture refused = attempted<LivePicture>(
        [&]
        {
          const View view = viewOf(question);
          pixels = std::int64_t(view.model->width()) * view.model->height();
          return LivePicture();
        });
      if (!refused.message.empty())
      {
        receive(refused);
        return;
      }
      const bool small = pixels < leastFine;
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
