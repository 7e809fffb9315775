// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceResolution.h"

#include "dgtkError.h"
#include "dgtkRaySource.h"
#include "dgtkStage.h"
#include "dgtkSurfaceRows.h"
#include "dgtkSystem.h"
#include "dgtkThreadPool.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dgtk
{

SurfaceResolution surfaceResolution(const Stage& stage, std::size_t camera, double frame, int width, int height)
{
  const View view = stage.view(camera, frame, width, height);
  const std::optional<LinearProjection> linear = view.model->linear();
  if (!linear)
  {
    throw UsageError("the resolution of camera " + view.name + " has no closed form");
  }
  const double focal = std::sqrt(linear->K(0, 0) * linear->K(1, 1));
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
      SurfaceRows surface;
      computeSurfaceRows(*state, view, hits.rect, hits.hits.data(), false, surface);
      for (const double depth : surface.t)
      {
        if (std::isfinite(depth))
        {
          sides.push_back((linear->perspective ? depth : 1.0) / focal);
        }
      }
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
