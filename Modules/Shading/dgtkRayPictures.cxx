// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRayPictures.h"

#include "dgtkShadedView.h"

#include "dgtkError.h"
#include "dgtkInstantSource.h"
#include "dgtkPixelBlocks.h"
#include "dgtkRaySource.h"
#include "dgtkResampledCamera.h"
#include "dgtkSpareVectors.h"
#include "dgtkThreadPool.h"
#include "dgtkWorkTime.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace dgtk
{

namespace
{
constexpr int maxSamples = 64;
constexpr int maxPiece = 2048; ///< side of what is drawn at once with several samples a pixel
constexpr int jobRows = 8;     ///< rows that are shaded as one job

/// A scene shaded as a view sees it: at one instant, or at those of the parts of the picture.
class ShadedScene
{
public:
  ShadedScene(std::shared_ptr<const SceneState> state, const View& view)
    : TheView(view)
    , Middle(std::make_shared<const ShadedView>(std::move(state), view))
  {
  }
  const View& view() const { return this->TheView; }
  bool isWhole() const { return !this->TheView.instants; }
  /// `time`: of the part, frames after the picture's own.
  std::shared_ptr<const ShadedView> at(double time) const
  {
    if (this->isWhole())
    {
      return this->Middle;
    }
    const SeenInstant now = instantOf(this->TheView, time);
    return std::make_shared<const ShadedView>(now.state, now.view);
  }

private:
  View TheView;
  std::shared_ptr<const ShadedView> Middle; ///< of the picture's own time; holds the textures of the others
};

void shadePart(const ShadedView& view, const VisibilityBuffer& hits, const PixelRect& part, float* rgb)
{
  const WorkTime time(WorkStage::Draw);
  const PixelRect& all = hits.rect;
  ShadedView::Worker worker(view);
  for (int y = part.y; y < part.y + part.height; ++y)
  {
    const std::size_t first = std::size_t(y - all.y) * std::size_t(all.width) + std::size_t(part.x - all.x);
    view.row(worker, part.x, y, part.width, &hits.hits[first], rgb + 3 * first);
  }
}

void shadeHits(const ShadedScene& scene, const VisibilityBuffer& hits, ThreadPool& pool, float* rgb)
{
  const PixelRect& all = hits.rect;
  std::vector<TimedRect> parts;
  for (int y = 0; scene.isWhole() && y < all.height; y += jobRows)
  {
    parts.push_back({ { all.x, all.y + y, all.width, std::min(jobRows, all.height - y) }, 0 });
  }
  parts = scene.isWhole() ? std::move(parts) : timedRects(*scene.view().model, all);
  pool.parallelFor(static_cast<int>(parts.size()),
    [&](int i)
    {
      const TimedRect& part = parts[std::size_t(i)];
      shadePart(*scene.at(part.time), hits, part.rect, rgb);
    });
}

class KnownHits final : public HitShader
{
public:
  KnownHits(const std::shared_ptr<const SceneState>& state, const View& view)
    : Seen(state, view)
  {
  }
  void shade(const VisibilityBuffer& hits, ThreadPool& pool, float* rgb) const override
  {
    shadeHits(this->Seen, hits, pool, rgb);
  }

private:
  ShadedScene Seen;
};

class RayPictures final : public PictureSource
{
public:
  explicit RayPictures(ThreadPool& pool)
    : Pool(pool)
    , Rays(makeRaySource(pool))
  {
  }
  std::string name() const override { return this->Rays->name(); }
  void setFilter(PixelFilter filter) override { this->Filter = filter; }
  void setScene(std::shared_ptr<const SceneState> state, const View& view) override;
  void render(const PixelRect& rect, VisibilityBuffer& hits) override
  {
    this->placeRays(this->TheView);
    this->Rays->render(rect, hits);
  }
  std::function<void()> drawColor(
    const PixelRect& rect, int samples, ColorBuffer& colors, VisibilityBuffer* hits) override;
  void renderWanted(const PixelRect& rect, ColorBuffer& colors, VisibilityBuffer& hits,
    const std::function<bool(const Hit&)>& wanted) override;
  std::function<void()> peel(const PixelRect& rect, SurfaceLists& lists) override;

private:
  void placeRays(const View& view);
  std::shared_ptr<const ShadedScene> shaded();
  void drawSamples(const PixelRect& rect, int samples, ColorBuffer& colors);
  void fillBorder(const PixelRect& all, float* rgb);
  void wrapAround(const PixelRect& all, float* rgb);
  std::shared_ptr<VisibilityBuffer> spareHits(const PixelRect& rect);

  ThreadPool& Pool;
  std::unique_ptr<VisibilitySource> Rays;
  std::shared_ptr<SpareVectors<Hit>> Spare = std::make_shared<SpareVectors<Hit>>(); ///< of pictures without ids
  PixelFilter Filter = PixelFilter::Box;
  std::shared_ptr<const SceneState> State;
  View TheView;
  std::shared_ptr<const CameraModel> RaysModel; ///< of the view that Rays has; null: none of this scene
  std::shared_ptr<const ShadedScene> Shaded;    ///< of State and TheView; null until it is needed
  std::shared_ptr<const ShadedScene> ShadedSamples;
  std::shared_ptr<const ShadedScene> Before; ///< of the scene before, until there is a new one: it holds the textures
  int SamplesOfIt = 0;
};

void RayPictures::setScene(std::shared_ptr<const SceneState> state, const View& view)
{
  this->State = std::move(state);
  this->TheView = view;
  this->RaysModel.reset();
  for (std::shared_ptr<const ShadedScene>* made : { &this->Shaded, &this->ShadedSamples })
  {
    if (*made)
    {
      this->Before = std::move(*made);
    }
  }
}

/// The scene of the rays, with the view or one of its samples.
void RayPictures::placeRays(const View& view)
{
  if (!this->State)
  {
    throw UsageError("no scene was set");
  }
  if (this->RaysModel != view.model)
  {
    this->Rays->setScene(this->State, view);
    this->RaysModel = view.model;
  }
}

std::shared_ptr<const ShadedScene> RayPictures::shaded()
{
  if (!this->Shaded)
  {
    const WorkTime build(WorkStage::Build);
    this->Shaded = std::make_shared<const ShadedScene>(this->State, this->TheView);
    this->Before.reset();
  }
  return this->Shaded;
}

std::shared_ptr<VisibilityBuffer> RayPictures::spareHits(const PixelRect& rect)
{
  std::shared_ptr<VisibilityBuffer> taken(new VisibilityBuffer,
    [spare = this->Spare](VisibilityBuffer* gone)
    {
      spare->give(std::move(gone->hits));
      delete gone;
    });
  taken->hits = this->Spare->take(std::size_t(rect.width) * std::size_t(rect.height));
  return taken;
}

std::function<void()> RayPictures::drawColor(
  const PixelRect& rect, int samples, ColorBuffer& colors, VisibilityBuffer* hits)
{
  if (samples < 1 || samples > maxSamples)
  {
    throw UsageError(
      "samples must be between 1 and " + std::to_string(maxSamples) + " (found " + std::to_string(samples) + ")");
  }
  colors.resize(rect);
  if (samples > 1)
  {
    this->drawSamples(rect, samples, colors);
    if (hits)
    {
      this->render(rect, *hits);
    }
    return [] {};
  }
  const auto own = hits ? nullptr : this->spareHits(rect);
  VisibilityBuffer& seen = hits ? *hits : *own;
  this->render(rect, seen);
  return [scene = this->shaded(), own, &seen, &colors, &pool = this->Pool]
  { shadeHits(*scene, seen, pool, colors.rgb.data()); };
}

void RayPictures::renderWanted(
  const PixelRect& rect, ColorBuffer& colors, VisibilityBuffer& hits, const std::function<bool(const Hit&)>& wanted)
{
  this->render(rect, hits);
  VisibilityBuffer shown = hits;
  std::replace_if(
    shown.hits.begin(), shown.hits.end(), [&wanted](const Hit& hit) { return !wanted(hit); }, Hit());
  colors.resize(rect);
  shadeHits(*this->shaded(), shown, this->Pool, colors.rgb.data());
}

/// Whether there are rays beyond the border.
bool seesBeyond(const CameraModel& model)
{
  const auto sees = [&model](double x, double y) { return model.rayThrough({ x, y }).exists(); };
  bool any = false;
  for (int x = 0; x < model.width() && !any; ++x)
  {
    any = sees(x + 0.5, -0.5) || sees(x + 0.5, model.height() + 0.5);
  }
  for (int y = 0; y < model.height() && !any; ++y)
  {
    any = sees(-0.5, y + 0.5) || sees(model.width() + 0.5, y + 0.5);
  }
  return any;
}

/// The samples around the image of a camera that has no rays there: of a panorama those beyond its seam and its poles,
/// of others the nearest.
void RayPictures::fillBorder(const PixelRect& all, float* rgb)
{
  const CameraModel& model = *this->ShadedSamples->view().model;
  const int left = std::max(all.x, 0);
  const int top = std::max(all.y, 0);
  const PixelRect in{ left, top, std::min(all.x + all.width, model.width()) - left,
    std::min(all.y + all.height, model.height()) - top };
  if (in == all || in.width <= 0 || in.height <= 0 || seesBeyond(model))
  {
    return;
  }
  const auto at = [&](int x, int y) { return rgb + 3 * (std::ptrdiff_t(y - all.y) * all.width + x - all.x); };
  for (int y = all.y; y < all.y + all.height; ++y)
  {
    for (int x = all.x; x < all.x + all.width; ++x)
    {
      const int fromX = std::min(std::max(x, in.x), in.x + in.width - 1);
      const int fromY = std::min(std::max(y, in.y), in.y + in.height - 1);
      if (fromX != x || fromY != y)
      {
        std::copy_n(at(fromX, fromY), 3, at(x, y));
      }
    }
  }
  if (model.name() == "equirectangular")
  {
    this->wrapAround(all, rgb);
  }
}

void RayPictures::wrapAround(const PixelRect& all, float* rgb)
{
  const int width = this->ShadedSamples->view().model->width();
  const int height = this->ShadedSamples->view().model->height();
  const int rows[4] = { all.y, std::max(all.y, 0), std::min(all.y + all.height, height), all.y + all.height };
  VisibilityBuffer hits;
  std::vector<float> part;
  for (int k = 0; k < 3; ++k)
  {
    const bool over = k != 1; // the pole: rows go back on the other side
    const int top = k == 0 ? 0 : k == 1 ? rows[1] : 2 * height - rows[3];
    const int count = rows[k + 1] - rows[k];
    for (int x = all.x, wide = 0; count > 0 && count <= height && x < all.x + all.width; x += wide)
    {
      const int from = ((x + (over ? width / 2 : 0)) % width + width) % width;
      wide = std::min(all.x + all.width - x, width - from);
      if (!over && from == x)
      {
        continue;
      }
      this->Rays->render({ from, top, wide, count }, hits);
      part.resize(hits.hits.size() * 3);
      shadeHits(*this->ShadedSamples, hits, this->Pool, part.data());
      for (int y = 0; y < count; ++y)
      {
        const int row = rows[k] - all.y + (over ? count - 1 - y : y);
        std::copy_n(
          &part[std::size_t(3) * y * wide], 3 * wide, rgb + 3 * (std::ptrdiff_t(row) * all.width + x - all.x));
      }
    }
  }
}

/// The samples are the pixels of a picture `samples` times as large.
void RayPictures::drawSamples(const PixelRect& rect, int samples, ColorBuffer& colors)
{
  if (!this->ShadedSamples || this->SamplesOfIt != samples)
  {
    const WorkTime build(WorkStage::Build);
    View large = this->TheView;
    large.model = resampledCamera(this->TheView.model, this->TheView.model->width() * samples,
      this->TheView.model->height() * samples, 1.0 / samples, { 0, 0 });
    this->ShadedSamples = std::make_shared<const ShadedScene>(this->State, large);
    this->Before.reset();
    this->SamplesOfIt = samples;
  }
  const SampleFilter filter(this->Filter, samples, std::numeric_limits<float>::max());
  const int side = std::max(1, maxPiece / samples - 2 * filter.margin());
  const ShadedScene& scene = *this->ShadedSamples;
  this->placeRays(scene.view());
  VisibilityBuffer hits;
  std::vector<float> rgb;
  for (int y = 0; y < rect.height; y += side)
  {
    for (int x = 0; x < rect.width; x += side)
    {
      const PixelRect piece{ rect.x + x, rect.y + y, std::min(side, rect.width - x), std::min(side, rect.height - y) };
      const PixelRect drawn = filter.drawn(piece);
      const PixelRect all{ drawn.x * samples, drawn.y * samples, drawn.width * samples, drawn.height * samples };
      this->Rays->render(all, hits);
      rgb.resize(hits.hits.size() * 3);
      shadeHits(scene, hits, this->Pool, rgb.data());
      this->fillBorder(all, rgb.data());
      filter.apply({ rgb.data(), 3 * std::ptrdiff_t(all.width), 3 }, piece, colors);
    }
  }
}

/// What peelRows() needs, kept from one call to the next.
struct PeelSpace
{
  std::vector<Eigen::Vector2d> pixels;
  std::vector<std::uint32_t> places; ///< in `pixels` and `hits`, of the pixels row by row
  std::vector<std::vector<Hit>> hits;
  std::vector<ShadedView::Surface> surfaces;
};

/// All surfaces along the rays of some rows of pixels.
void peelRows(const ShadedView& view, ShadedView::Worker& worker, PeelSpace& space, SurfaceLists& rows)
{
  const PixelRect& rect = rows.rect;
  space.pixels.clear();
  space.places.resize(std::size_t(rect.width) * std::size_t(rect.height));
  forPixelBlocks(rect,
    [&](int x, int y)
    {
      space.places[std::size_t(y - rect.y) * std::size_t(rect.width) + std::size_t(x - rect.x)] =
        std::uint32_t(space.pixels.size());
      space.pixels.emplace_back(x + 0.5, y + 0.5);
    });
  space.hits.resize(std::max(space.hits.size(), space.pixels.size()));
  view.allHits(space.pixels, space.hits.data());
  const std::uint32_t* place = space.places.data();
  for (int y = 0; y < rect.height; ++y)
  {
    space.surfaces.clear();
    for (int x = 0; x < rect.width; ++x)
    {
      rows.first.push_back(std::uint32_t(rows.hits.size()));
      for (const Hit& hit : space.hits[*place++])
      {
        space.surfaces.push_back({ x, hit });
        rows.hits.push_back(hit);
      }
    }
    const std::size_t before = rows.rgba.size();
    rows.rgba.resize(4 * rows.hits.size());
    view.shadeRow(worker, rect.x, rect.y + y, rect.width, space.surfaces, rows.rgba.data() + before);
  }
  std::transform(
    rows.rgba.begin(), rows.rgba.end(), rows.rgba.begin(), [](float v) { return std::min(std::max(v, 0.0F), 1.0F); });
}

std::function<void()> RayPictures::peel(const PixelRect& rect, SurfaceLists& lists)
{
  return [scene = this->shaded(), rect, &lists, &pool = this->Pool]
  {
    std::vector<TimedRect> runs;
    for (int y = 0; scene->isWhole() && y < rect.height; y += rowsOfBlocks(rect.y + y, rect.height - y))
    {
      runs.push_back({ { rect.x, rect.y + y, rect.width, rowsOfBlocks(rect.y + y, rect.height - y) }, 0 });
    }
    runs = scene->isWhole() ? std::move(runs) : timedRuns(*scene->view().model, rect);
    std::vector<SurfaceLists> rows(runs.size());
    pool.parallelFor(static_cast<int>(runs.size()),
      [&](int i)
      {
        const WorkTime time(WorkStage::Draw);
        thread_local PeelSpace space;
        const TimedRect& run = runs[std::size_t(i)];
        const std::shared_ptr<const ShadedView> view = scene->at(run.time);
        ShadedView::Worker worker(*view);
        rows[std::size_t(i)].rect = run.rect;
        peelRows(*view, worker, space, rows[std::size_t(i)]);
      });
    lists = { rect, {}, {}, {} };
    for (const SurfaceLists& row : rows)
    {
      const auto before = std::uint32_t(lists.hits.size());
      std::transform(row.first.begin(), row.first.end(), std::back_inserter(lists.first),
        [before](std::uint32_t first) { return before + first; });
      lists.hits.insert(lists.hits.end(), row.hits.begin(), row.hits.end());
      lists.rgba.insert(lists.rgba.end(), row.rgba.begin(), row.rgba.end());
    }
    lists.first.push_back(std::uint32_t(lists.hits.size()));
  };
}

} // namespace

std::shared_ptr<const HitShader> makeHitShader(const std::shared_ptr<const SceneState>& state, const View& view)
{
  return std::make_shared<const KnownHits>(state, view);
}

std::unique_ptr<PictureSource> makeRayPictures(ThreadPool& pool) { return std::make_unique<RayPictures>(pool); }

} // namespace dgtk
