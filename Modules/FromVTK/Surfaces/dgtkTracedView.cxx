// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTracedView.h"

#include "dgtkRaySource.h"
#include "dgtkSpareVectors.h"
#include "dgtkSystem.h"
#include "dgtkThreadPool.h"

#include <algorithm>

namespace dgtk
{

void traceTiles(const Stage& stage, const View& view, const std::function<void(const VisibilityBuffer&)>& look)
{
  ThreadPool pool(machineThreads());
  const std::unique_ptr<VisibilitySource> source = makeRaySource(pool);
  source->setScene(stage.at(0), view);
  const TileGrid grid(view.model->width(), view.model->height());
  static SpareVectors<Hit> spare; // one view is often traced after another of its size
  const PixelRect first = grid.tile(0, 0);
  VisibilityBuffer tile;
  tile.hits = spare.take(std::size_t(first.width) * std::size_t(first.height));
  for (int row = 0; row < grid.rows(); ++row)
  {
    for (int column = 0; column < grid.columns(); ++column)
    {
      source->render(grid.tile(column, row), tile);
      look(tile);
    }
  }
  spare.give(std::move(tile.hits));
}

std::vector<Hit> traceView(const Stage& stage, const View& view)
{
  const auto width = std::size_t(view.model->width());
  std::vector<Hit> all(width * std::size_t(view.model->height()));
  traceTiles(stage, view,
    [&](const VisibilityBuffer& tile)
    {
      for (int y = 0; y < tile.rect.height; ++y)
      {
        std::copy_n(&tile.hits[std::size_t(y) * std::size_t(tile.rect.width)], tile.rect.width,
          &all[std::size_t(tile.rect.y + y) * width + std::size_t(tile.rect.x)]);
      }
    });
  return all;
}

} // namespace dgtk
