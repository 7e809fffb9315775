// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceResolution.h"

#include "dgtkRaySource.h"
#include "dgtkStage.h"
#include "dgtkSurfaceRows.h"
#include "dgtkSystem.h"
#include "dgtkThreadPool.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace dgtk
{

namespace
{
/// Side of the square that a pixel of a lens covers across its ray, by the rays through the middles of its sides;
/// nothing where one of them is not there.
std::optional<double> lensSide(const CameraModel& model, double x, double y, double t)
{
  const Eigen::Vector2d sides[4] = { { x + 1, y + 0.5 }, { x, y + 0.5 }, { x + 0.5, y + 1 }, { x + 0.5, y } };
  CameraRay rays[4];
  model.raysThrough(sides, 4, rays);
  if (!std::all_of(std::begin(rays), std::end(rays), [](const CameraRay& ray) { return ray.exists(); }))
  {
    return std::nullopt;
  }
  const auto at = [&](int i) { return Eigen::Vector3d(rays[i].origin + t * rays[i].direction); };
  return std::sqrt((at(0) - at(1)).cross(at(2) - at(3)).norm());
}
} // namespace

SurfaceResolution surfaceResolution(const Stage& stage, std::size_t camera, double frame, int width, int height)
{
  const View view = stage.view(camera, frame, width, height);
  const std::optional<LinearProjection> linear = view.model->linear();
  const auto sideOf = [&, focal = linear ? std::sqrt(linear->K(0, 0) * linear->K(1, 1)) : 0](
                        int x, int y, double t) -> std::optional<double>
  { return linear ? (linear->perspective ? t : 1.0) / focal : lensSide(*view.model, x, y, t); };
  ThreadPool pool(machineThreads());
  const std::unique_ptr<VisibilitySource> source = makeRaySource(pool);
  const std::shared_ptr<const SceneState> state = stage.at(frame);
  source->setScene(state, view);
  const TileGrid grid(view.model->width(), view.model->height());
  std::vector<double> sides;
  for (int row = 0; row < grid.rows(); ++row)
  {
    for (int column = 0; column < grid.columns(); ++column)
    {
      VisibilityBuffer hits;
      source->render(grid.tile(column, row), hits);
      forSurfaceRows(*state, view, hits.rect, hits.hits.data(), false,
        [&](const SurfaceRows& surface)
        {
          for (std::size_t i = 0; i < surface.t.size(); ++i)
          {
            const int x = surface.rect.x + int(i % std::size_t(surface.rect.width));
            const int y = surface.rect.y + int(i / std::size_t(surface.rect.width));
            if (const auto side = std::isfinite(surface.t[i]) ? sideOf(x, y, surface.t[i]) : std::nullopt)
            {
              sides.push_back(*side);
            }
          }
        });
    }
  }
  SurfaceResolution result;
  result.pixels = sides.size();
  if (!sides.empty())
  {
    const auto middle = sides.begin() + static_cast<std::ptrdiff_t>((sides.size() - 1) / 2);
    std::nth_element(sides.begin(), middle, sides.end());
    result.median = *middle;
    const auto [low, high] = std::minmax_element(sides.begin(), sides.end());
    result.smallest = *low;
    result.largest = *high;
  }
  return result;
}

} // namespace dgtk
