// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMattingSource.h"

#include "dgtkError.h"
#include "dgtkSamples.h"
#include "dgtkWorkPlan.h"

#include <algorithm>

namespace dgtk
{

std::vector<std::uint32_t> matteObjects(const WorkPlan& plan, const Stage& stage)
{
  std::vector<std::uint32_t> objects;
  if (!plan.has("matting"))
  {
    return objects;
  }
  const std::vector<std::string> names = stage.objectNames();
  for (const std::string& name : plan.request.matte)
  {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
    {
      throw UsageError("--matte: the scene has no object " + quoted(name));
    }
    const auto id = static_cast<std::uint32_t>(found - names.begin() + 1);
    if (std::find(objects.begin(), objects.end(), id) == objects.end())
    {
      objects.push_back(id);
    }
  }
  return objects;
}

MattingSource::MattingSource(RasterSource& raster, std::vector<std::uint32_t> objects, int samples)
  : Raster(raster)
  , Objects(std::move(objects))
  , Samples(samples)
{
}

void MattingSource::setScene(const std::shared_ptr<const SceneState>& state, const View& view)
{
  this->State = state;
  this->Camera = view;
}

std::vector<MattePixels> MattingSource::draw(const PixelRect& rect)
{
  const std::size_t pixels = std::size_t(rect.width) * rect.height;
  std::vector<MattePixels> mattes(this->Objects.size());
  for (MattePixels& matte : mattes)
  {
    matte.count.assign(pixels, 0);
    matte.foreground.assign(pixels * 3, 0.0f);
  }
  this->drawForegrounds(rect, mattes);
  for (std::size_t i = 0; i < mattes.size(); ++i)
  {
    ColorBuffer colors;
    this->Raster.setScene(this->without(this->Objects[i]), this->Camera);
    this->Raster.renderColor(rect, this->Samples, colors, nullptr);
    mattes[i].background = std::move(colors.rgb);
  }
  this->Raster.setScene(this->State, this->Camera);
  return mattes;
}

void MattingSource::drawForegrounds(const PixelRect& rect, std::vector<MattePixels>& mattes)
{
  std::vector<std::vector<double>> sums(mattes.size(), std::vector<double>(std::size_t(rect.width) * rect.height * 3));
  for (int k = 0; k < this->Samples * this->Samples; ++k)
  {
    ColorBuffer colors;
    VisibilityBuffer hits;
    this->Raster.setScene(this->State, sampleView(this->Camera, k % this->Samples, k / this->Samples, this->Samples));
    this->Raster.renderColor(rect, 1, colors, &hits);
    for (std::size_t m = 0; m < mattes.size(); ++m)
    {
      for (std::size_t i = 0; i < hits.hits.size(); ++i)
      {
        if (hits.hits[i].object == this->Objects[m])
        {
          ++mattes[m].count[i];
          for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
          {
            sums[m][c] += colors.rgb[c];
          }
        }
      }
    }
  }
  for (std::size_t m = 0; m < mattes.size(); ++m)
  {
    for (std::size_t c = 0; c < sums[m].size(); ++c)
    {
      const int count = mattes[m].count[c / 3];
      mattes[m].foreground[c] = count > 0 ? static_cast<float>(sums[m][c] / count) : 0.0f;
    }
  }
}

/// The scene with an object put out of sight, behind the camera; ids and what the engine has loaded stay as they are.
std::shared_ptr<const SceneState> MattingSource::without(std::uint32_t object) const
{
  auto state = std::make_shared<SceneState>(*this->State);
  Instance& instance = state->instances[object - 1];
  const Affine3 camera_from_object = this->Camera.camera_from_world * instance.world_from_object;
  double farthest = this->Camera.far;
  for (const Eigen::Vector3d& position : instance.geometry->positions)
  {
    farthest = std::max(farthest, (camera_from_object * position).norm());
  }
  const Eigen::Vector3d forward = this->Camera.camera_from_world.rotation.row(2).transpose();
  instance.world_from_object.translation -= 4 * farthest * forward;
  return state;
}

} // namespace dgtk
