// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFrameSource.h"

#include "dgtkError.h"
#include "dgtkRasterSource.h"
#include "dgtkRaySource.h"

#include <algorithm>

namespace dgtk
{

FrameSource::FrameSource(const FrameSourceOptions& options, ThreadPool& pool)
  : Options(options)
{
  if (options.hits && !options.raster)
  {
    this->Ray = makeRaySource(pool);
  }
  if (options.color || (options.hits && options.raster))
  {
    std::unique_ptr<RasterSource> raster = makeRasterSource(glBackendFromName(options.gl));
    this->Description = raster->choice().description;
    this->Raster = std::move(raster);
  }
}

FrameSource::~FrameSource() = default;

void FrameSource::setScene(const std::shared_ptr<const SceneState>& state, const View& view)
{
  if (this->Ray)
  {
    this->Ray->setScene(state, view);
  }
  if (this->Raster)
  {
    this->Raster->setScene(state, view);
  }
  this->Grid = std::make_unique<TileGrid>(view.model->width(), view.model->height());
}

int FrameSource::bands() const { return this->Grid->rows(); }

void FrameSource::drawTile(const PixelRect& rect, Band& tile)
{
  tile.rect = rect;
  VisibilityBuffer hits;
  ColorBuffer colors;
  const bool rasterHits = this->Options.hits && this->Options.raster;
  if (this->Options.color)
  {
    this->Raster->renderColor(rect, this->Options.samples, colors, rasterHits ? &hits : nullptr);
    tile.rgb = std::move(colors.rgb);
  }
  else if (rasterHits)
  {
    this->Raster->render(rect, hits);
  }
  if (this->Ray)
  {
    this->Ray->render(rect, hits);
  }
  tile.hits = std::move(hits.hits);
}

namespace
{
template <typename T>
void place(const std::vector<T>& from, const PixelRect& tile, int channels, const PixelRect& band, std::vector<T>& to)
{
  to.resize(std::size_t(band.width) * band.height * channels);
  const std::size_t row = std::size_t(tile.width) * channels;
  for (int y = 0; y < tile.height; ++y)
  {
    std::copy_n(from.data() + y * row, row, to.data() + (std::size_t(y) * band.width + tile.x) * channels);
  }
}
} // namespace

void FrameSource::draw(int row, Band& band)
{
  const int columns = this->Grid->columns();
  if (columns == 1)
  {
    this->drawTile(this->Grid->tile(0, row), band);
    return;
  }
  const PixelRect last = this->Grid->tile(columns - 1, row);
  band.rect = { 0, last.y, last.x + last.width, last.height };
  for (int column = 0; column < columns; ++column)
  {
    Band tile;
    this->drawTile(this->Grid->tile(column, row), tile);
    if (this->Options.hits)
    {
      place(tile.hits, tile.rect, 1, band.rect, band.hits);
    }
    if (this->Options.color)
    {
      place(tile.rgb, tile.rect, 3, band.rect, band.rgb);
    }
  }
}

} // namespace dgtk
