// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFrameSource.h"

#include "dgtkError.h"
#include "dgtkRayPictures.h"
#include "dgtkRaySource.h"
#include "dgtkRenderGLCalls.h"
#include "dgtkThreadPool.h"

#include <algorithm>
#include <deque>
#include <future>
#include <utility>

namespace dgtk
{

FrameSourceOptions sourceOptions(const WorkPlan& plan)
{
  FrameSourceOptions options;
  options.needs = plan.needs;
  options.raster = plan.raster;
  options.drawn = plan.drawn;
  options.samples = option::samples().of(plan.request.options);
  options.filter = pixelFilterFromName(option::filter().of(plan.request.options));
  options.gl = option::gl().of(plan.request.options);
  return options;
}

FrameSource::FrameSource(const FrameSourceOptions& options, ThreadPool& pool)
  : Options(options)
  , Pool(pool)
{
  if (options.needs.color && options.pov)
  {
    this->Pov = std::make_unique<PovColorSource>(*options.pov, pool);
  }
  const bool pictures = this->ownColor() || options.needs.peeled || !options.needs.mattes.empty();
  if ((pictures && options.drawn) || (options.needs.hits && options.raster))
  {
    this->Raster = renderGL().makeRasterSource(renderGL().glBackendFromName(options.gl));
    this->Description = this->Raster->choice().description;
    this->Raster->setHits(
      options.needs.peeled || !options.needs.mattes.empty() || (options.needs.hits && options.raster));
  }
  if (pictures)
  {
    this->Shaded = options.drawn ? nullptr : makeRayPictures(pool);
    this->Pictures = options.drawn ? this->Raster.get() : this->Shaded.get();
    this->Pictures->setFilter(options.filter);
    this->Exposed = std::make_unique<ExposedColor>(*this->Pictures, pool);
  }
  if (options.needs.hits && !options.raster && !this->Shaded)
  {
    this->Ray = makeRaySource(pool);
  }
  if (!options.needs.mattes.empty())
  {
    this->Matting = std::make_unique<MattingSource>(*this->Pictures, options.needs.mattes, options.samples);
  }
}

FrameSource::~FrameSource() = default;

void FrameSource::setScene(const std::shared_ptr<const SceneState>& state, const View& view)
{
  this->State = state;
  this->TheView = view;
  if (this->Ray)
  {
    this->Ray->setScene(state, view);
  }
  if (this->Raster)
  {
    this->Raster->setScene(state, view);
  }
  if (this->Shaded)
  {
    this->Shaded->setScene(state, view);
  }
  if (this->Exposed)
  {
    this->Exposed->set({}, {});
  }
  if (this->Matting)
  {
    this->Matting->setScene(state, view);
  }
  if (this->Pov)
  {
    this->Pov->setScene(state, view);
  }
  this->Grid = std::make_unique<TileGrid>(view.model->width(), view.model->height());
}

void FrameSource::expose(std::vector<Exposure> exposures, ExposedColor::StateAt stateAt)
{
  if (this->Exposed)
  {
    this->Exposed->set(std::move(exposures), std::move(stateAt));
  }
}

bool FrameSource::drawsAnything() const
{
  const LayerNeeds& needs = this->Options.needs;
  return needs.hits || needs.color || needs.peeled || !needs.mattes.empty();
}

int FrameSource::bands() const { return this->Grid->rows(); }

/// What is drawn of a canonical tile.
struct FrameSource::Tile
{
  VisibilityBuffer hits;
  ColorBuffer colors;
  ColorBuffer sharp;
  SurfaceLists surfaces;
  std::function<void()> peel = [] {}; ///< to be done until `surfaces` is whole
  std::vector<MattePixels> mattes;
  UnreadColor color; ///< to be read and finished before the buffers are whole
};

void FrameSource::drawColor(const PixelRect& rect, Tile& tile)
{
  const int samples = this->Options.samples;
  if (!this->Exposed->blurs() && this->Shaded)
  {
    tile.color.rest = this->Shaded->drawColor(rect, samples, tile.colors, this->shadesHits() ? &tile.hits : nullptr);
    return;
  }
  if (!this->Exposed->blurs())
  {
    tile.color = this->Raster->startColor(rect, samples, tile.colors);
    return;
  }
  if (this->Options.needs.sharp)
  {
    tile.color.rest = this->Pictures->drawColor(rect, samples, tile.sharp, nullptr);
  }
  this->Exposed->draw(rect, samples, tile.colors);
  this->Pictures->setScene(this->State, this->TheView);
}

/// Whether the hits are those of which the colours are made.
bool FrameSource::shadesHits() const
{
  return this->Options.needs.hits && !this->Options.raster && this->Shaded && this->ownColor() &&
         !this->Exposed->blurs();
}

std::shared_ptr<FrameSource::Tile> FrameSource::drawTile(const PixelRect& rect)
{
  auto tile = std::make_shared<Tile>();
  const std::size_t pixels = std::size_t(rect.width) * std::size_t(rect.height);
  if (this->Options.needs.hits)
  {
    tile->hits.hits = this->Buffers->hits.take(pixels);
  }
  if (this->ownColor())
  {
    tile->colors.rgb = this->Buffers->colors.take(3 * pixels);
  }
  // Software OpenGL leaves cores idle while it transforms vertices; rays are traced meanwhile.
  std::future<void> traced;
  if (this->Shaded && this->Options.needs.hits && !this->Options.raster && !this->shadesHits())
  {
    this->Shaded->render(rect, tile->hits);
  }
  if (this->Ray)
  {
    traced = this->Pool.submit([this, &rect, &tile] { this->Ray->render(rect, tile->hits); });
  }
  try
  {
    // What the ids are does not depend on whether colour is drawn, too.
    if (this->Options.needs.hits && this->Options.raster)
    {
      this->Raster->render(rect, tile->hits);
    }
    if (this->ownColor())
    {
      this->drawColor(rect, *tile);
    }
    this->finish(); // of the band before, while OpenGL works on this one
    if (this->Options.needs.peeled)
    {
      tile->peel = this->Pictures->peel(rect, tile->surfaces);
    }
    if (this->Matting)
    {
      tile->mattes = this->Matting->draw(rect);
    }
  }
  catch (...)
  {
    if (traced.valid())
    {
      traced.wait();
    }
    throw;
  }
  if (traced.valid())
  {
    this->Pool.wait(traced);
  }
  return tile;
}

namespace
{
template <typename T>
void place(const std::vector<T>& from, const PixelRect& tile, int channels, const PixelRect& band, std::vector<T>& to)
{
  const std::size_t row = std::size_t(tile.width) * channels;
  for (int y = 0; y < tile.height; ++y)
  {
    std::copy_n(from.data() + y * row, row, to.data() + (std::size_t(y) * band.width + tile.x) * channels);
  }
}
} // namespace

void FrameSource::finish()
{
  LateBand late = std::exchange(this->Late, {});
  if (late.read)
  {
    late.read();
    late.receiver(std::move(late.band));
  }
}

void FrameSource::draw(int row, const Receiver& receiver)
{
  const std::shared_ptr<DrawnBand> drawn(new DrawnBand,
    [spare = this->Buffers](DrawnBand* gone)
    {
      spare->hits.give(std::move(gone->band.hits));
      spare->colors.give(std::move(gone->band.rgb));
      delete gone;
    });
  std::function<void()> read = this->drawBand(row, *drawn);
  if (this->Pov)
  {
    drawn->fetchColor = [&band = drawn->band, draw = this->Pov->colorOf(drawn->band.rect)] { band.rgb = draw(); };
  }
  if (!read)
  {
    receiver(drawn);
    return;
  }
  this->Late = { drawn, std::move(read), receiver };
}

/// What is still to be called before the band's rest, in this thread; nothing where all is read.
std::function<void()> FrameSource::drawBand(int row, DrawnBand& drawn)
{
  Band& band = drawn.band;
  if (this->Grid->columns() > 1)
  {
    this->drawTiles(row, band);
    return nullptr;
  }
  band.rect = this->Grid->tile(0, row);
  const std::shared_ptr<Tile> tile = this->drawTile(band.rect);
  drawn.complete = [&band, tile]
  {
    tile->color.rest();
    tile->peel();
    band.rgb = std::move(tile->colors.rgb);
    band.sharp = std::move(tile->sharp.rgb);
    band.hits = std::move(tile->hits.hits);
    band.peeled.push_back(std::move(tile->surfaces));
    band.mattes = std::move(tile->mattes);
  };
  return std::exchange(tile->color.read, nullptr);
}

void FrameSource::drawTiles(int row, Band& band)
{
  const int columns = this->Grid->columns();
  const PixelRect last = this->Grid->tile(columns - 1, row);
  band.rect = { 0, last.y, last.x + last.width, last.height };
  const std::size_t pixels = std::size_t(band.rect.width) * band.rect.height;
  band.hits.resize(this->Options.needs.hits ? pixels : 0);
  band.rgb.resize(this->ownColor() ? pixels * 3 : 0);
  const bool sharp = this->Options.needs.sharp && this->ownColor() && this->Exposed->blurs();
  band.sharp.resize(sharp ? pixels * 3 : 0);
  band.peeled.resize(std::size_t(columns));
  band.mattes.resize(this->Options.needs.mattes.size());
  for (MattePixels& matte : band.mattes)
  {
    matte.count.resize(pixels);
    matte.foreground.resize(pixels * 3);
    matte.background.resize(pixels * 3);
  }
  std::deque<std::future<void>> placed;
  const auto waitFor = [&](std::size_t most)
  {
    for (; placed.size() > most; placed.pop_front())
    {
      this->Pool.wait(placed.front());
    }
  };
  try
  {
    for (int column = 0; column < columns; ++column)
    {
      const PixelRect rect = this->Grid->tile(column, row);
      std::shared_ptr<Tile> tile = this->drawTile(rect);
      if (const std::function<void()> read = std::exchange(tile->color.read, nullptr))
      {
        read();
      }
      placed.push_back(this->Pool.submit(
        [this, &band, rect, sharp, column, tile = std::move(tile)]
        {
          tile->color.rest();
          tile->peel();
          band.peeled[std::size_t(column)] = std::move(tile->surfaces);
          if (this->Options.needs.hits)
          {
            place(tile->hits.hits, rect, 1, band.rect, band.hits);
            this->Buffers->hits.give(std::move(tile->hits.hits));
          }
          if (this->ownColor())
          {
            place(tile->colors.rgb, rect, 3, band.rect, band.rgb);
            this->Buffers->colors.give(std::move(tile->colors.rgb));
          }
          if (sharp)
          {
            place(tile->sharp.rgb, rect, 3, band.rect, band.sharp);
          }
          for (std::size_t i = 0; i < tile->mattes.size(); ++i)
          {
            place(tile->mattes[i].count, rect, 1, band.rect, band.mattes[i].count);
            place(tile->mattes[i].foreground, rect, 3, band.rect, band.mattes[i].foreground);
            place(tile->mattes[i].background, rect, 3, band.rect, band.mattes[i].background);
          }
        }));
      waitFor(static_cast<std::size_t>(this->Pool.threads()));
    }
    waitFor(0);
  }
  catch (...)
  {
    for (const std::future<void>& rest : placed)
    {
      rest.valid() ? rest.wait() : void();
    }
    throw;
  }
}

} // namespace dgtk
