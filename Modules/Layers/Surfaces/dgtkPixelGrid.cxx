// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPixelGrid.h"

#include "dgtkResampledCamera.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
int countOf(int size, int step)
{
  const int first = step / 2;
  return size > first ? (size - first + step - 1) / step : 0;
}
} // namespace

PixelGrid::PixelGrid(const CameraModel& model, int step)
  : Step(step)
  , First(step / 2 + 0.5)
  , Columns(countOf(model.width(), step))
  , RowCount(countOf(model.height(), step))
{
}

void PixelGrid::forNear(const Eigen::Vector2d& pixel, const std::function<void(int column, int row)>& body) const
{
  const Eigen::Vector2d at = (pixel - this->centre(0, 0)) / this->Step;
  const int column = static_cast<int>(std::floor(at.x()));
  const int row = static_cast<int>(std::floor(at.y()));
  for (int y = std::max(0, row); y < std::min(row + 2, this->RowCount); ++y)
  {
    for (int x = std::max(0, column); x < std::min(column + 2, this->Columns); ++x)
    {
      if ((this->centre(x, y) - pixel).norm() <= 0.5 * this->Step)
      {
        body(x, y);
      }
    }
  }
}

void PixelGrid::forSurfaces(const std::shared_ptr<const SceneState>& state, const View& view,
  const SceneQueries& queries, ThreadPool& pool,
  const std::function<void(int row, const SurfaceRows& surface)>& body) const
{
  if (this->Columns == 0 || this->RowCount == 0)
  {
    return;
  }
  View sparse = view;
  const double offset = this->First - 0.5 * this->Step;
  sparse.model = resampledCamera(view.model, this->Columns, this->RowCount, this->Step, { offset, offset });
  VisibilityBuffer buffer;
  const std::unique_ptr<VisibilitySource> source = queries.makeSource(pool);
  source->setScene(state, sparse);
  source->render({ 0, 0, this->Columns, this->RowCount }, buffer);
  pool.parallelFor(this->RowCount,
    [&](int y)
    {
      forSurfaceRows(*state, sparse, { 0, y, this->Columns, 1 }, buffer.hits.data() + std::size_t(y) * this->Columns,
        true, [&](const SurfaceRows& surface) { body(y, surface); });
    });
}

} // namespace dgtk
