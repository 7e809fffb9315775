// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWholeObjects.h"

#include "dgtkPixelBlocks.h"
#include "dgtkResampledCamera.h"
#include "dgtkThreadPool.h"

namespace dgtk
{

namespace
{
constexpr int stripPixels = 1 << 18; // traced at once
constexpr int jobPixels = 1 << 12;   // of a job of the pool
constexpr int blockRows = 8;

class Around
{
public:
  Around(const std::shared_ptr<const SceneState>& state, const View& view, const OcclusionQuery& occlusion,
    VisibilitySource& source, ThreadPool& pool)
    : State(*state)
    , Width(view.model->width())
    , Height(view.model->height())
    , Canvas(canvasOf(view))
    , Occlusion(occlusion)
    , Blocks(*state, this->Canvas)
    , Source(source)
    , Pool(pool)
    , All(state->objects())
  {
    source.setScene(state, this->Canvas);
  }

  std::vector<ObjectPixels> all()
  {
    this->add({ 0, 0, 3 * this->Width, this->Height });
    this->add({ 0, this->Height, this->Width, this->Height });
    this->add({ 2 * this->Width, this->Height, this->Width, this->Height });
    this->add({ 0, 2 * this->Height, 3 * this->Width, this->Height });
    for (ObjectPixels& pixels : this->All)
    {
      pixels.x0 -= this->Width;
      pixels.x1 -= this->Width;
      pixels.y0 -= this->Height;
      pixels.y1 -= this->Height;
    }
    return std::move(this->All);
  }

private:
  static View canvasOf(const View& view)
  {
    const int width = view.model->width();
    const int height = view.model->height();
    View canvas = view;
    canvas.model = resampledCamera(view.model, 3 * width, 3 * height, 1, Eigen::Vector2d(-width, -height));
    return canvas;
  }

  /// Of a part of the canvas.
  void add(const PixelRect& rect)
  {
    const int rows = std::max(blockRows, stripPixels / rect.width / blockRows * blockRows);
    for (int y = 0; y < rect.height; y += rows)
    {
      const PixelRect strip =
        this->Blocks.occupied({ rect.x, rect.y + y, rect.width, std::min(rows, rect.height - y) });
      if (strip.height > 0)
      {
        this->trace(strip);
      }
    }
  }

  void trace(const PixelRect& strip)
  {
    this->Source.render(strip, this->Hits);
    const int rows = std::max(pixelBlock, jobPixels / strip.width / pixelBlock * pixelBlock);
    std::vector<ObjectRows> parts(static_cast<std::size_t>((strip.height + rows - 1) / rows));
    this->Pool.parallelFor(static_cast<int>(parts.size()),
      [&](int i)
      {
        const PixelRect part{ strip.x, strip.y + i * rows, strip.width, std::min(rows, strip.height - i * rows) };
        collectObjects(this->State, this->Canvas, this->Occlusion, this->Blocks, part, &this->Hits.at(part.x, part.y),
          false, parts[static_cast<std::size_t>(i)]);
      });
    for (const ObjectRows& part : parts)
    {
      for (std::size_t i = 0; i < this->All.size(); ++i)
      {
        this->All[i].unite(part.amodal[i]);
      }
    }
  }

  const SceneState& State;
  int Width;
  int Height;
  View Canvas;
  const OcclusionQuery& Occlusion;
  BlockObjects Blocks;
  VisibilitySource& Source;
  ThreadPool& Pool;
  VisibilityBuffer Hits;
  std::vector<ObjectPixels> All;
};
} // namespace

std::vector<ObjectPixels> objectsAround(const std::shared_ptr<const SceneState>& state, const View& view,
  const OcclusionQuery& occlusion, VisibilitySource& source, ThreadPool& pool)
{
  return Around(state, view, occlusion, source, pool).all();
}

} // namespace dgtk
