// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPixelGrid_h
#define dgtkPixelGrid_h

// Private to Layers.

#include "dgtkSceneQueries.h"
#include "dgtkSurfaceRows.h"
#include "dgtkThreadPool.h"

#include <functional>
#include <memory>

namespace dgtk
{

/// The pixels of a picture in columns and rows step / 2, step / 2 + step, ... (rounded down); none where there is none.
class PixelGrid
{
public:
  PixelGrid(const CameraModel& model, int step);
  int columns() const { return this->Columns; }
  int rows() const { return this->RowCount; }
  /// Centre of a pixel of the grid, pixels of the picture.
  Eigen::Vector2d centre(int column, int row) const
  {
    return { this->First + double(column) * this->Step, this->First + double(row) * this->Step };
  }

  /// Calls body(column, row) for the pixels of the grid whose centres are within half a step of a point of the picture.
  void forNear(const Eigen::Vector2d& pixel, const std::function<void(int column, int row)>& body) const;

  /// Gives the surfaces at the grid's pixels, with barycentrics, to body(row, surface): rows by several threads, the
  /// parts of a row from left to right. Columns of `surface` are those of the grid.
  void forSurfaces(const std::shared_ptr<const SceneState>& state, const View& view, const SceneQueries& queries,
    ThreadPool& pool, const std::function<void(int row, const SurfaceRows& surface)>& body) const;

private:
  int Step;
  double First;
  int Columns;
  int RowCount;
};

} // namespace dgtk

#endif
