// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRaySource.h"

#include "dgtkInstantSource.h"
#include "dgtkRayPacket.h"
#include "dgtkRayScene.h"
#include "dgtkRaySettle.h"
#include "dgtkSpareVectors.h"
#include "dgtkThreadPool.h"
#include "dgtkWorkTime.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

namespace dgtk
{

namespace
{
constexpr int bandRows = 8; ///< rows that are traced as one job
constexpr int side = PacketTracer::side;
/// Pixels: above this error of single precision, as that of a telescope, neighbours do not tell what a ray misses.
constexpr double coarsestTraced = 1.0 / 4;
constexpr std::size_t partsOfJob = 16; ///< parts of a picture of many instants

/// What is left of sources that are gone: one is often made for a single picture after another of its size.
struct SpareMarks
{
  SpareVectors<float> nearness;
  SpareVectors<std::uint8_t> doubtful;

  static std::shared_ptr<SpareMarks> shared()
  {
    static const auto all = std::make_shared<SpareMarks>();
    return all;
  }
};

/// Primary rays in packets; `Bare` is the yardstick.
template <bool Bare>
class RaySource final : public VisibilitySource
{
public:
  explicit RaySource(ThreadPool& pool, bool coherent = true)
    : Pool(pool)
    , Coherent(coherent)
    , Scene(RayDevice::shared(), Bare)
  {
  }
  ~RaySource() override
  {
    this->Spare->nearness.give(std::move(this->Marks.nearness));
    this->Spare->doubtful.give(std::move(this->Marks.doubtful));
  }
  std::string name() const override { return "ray"; }

  void setScene(std::shared_ptr<const SceneState> state, const View& view) override
  {
    if (!view.instants)
    {
      this->Scene.place(std::move(state), view.camera_from_world);
    }
    this->TheView = view;
  }

  void render(const PixelRect& rect, VisibilityBuffer& hits) override
  {
    hits.resize(rect);
    if (this->TheView.instants)
    {
      this->renderInstants(hits);
      return;
    }
    if (Bare)
    {
      this->trace<TraceMode::Bare>(hits);
      return;
    }
    if (this->Scene.errorInPixels(this->TheView) > coarsestTraced)
    {
      this->traceExactly(hits);
      return;
    }
    if (this->Marks.nearness.empty())
    {
      this->Marks.nearness = this->Spare->nearness.take(hits.hits.size());
      this->Marks.doubtful = this->Spare->doubtful.take(hits.hits.size());
    }
    this->Marks.resize(rect);
    this->trace<TraceMode::Exact>(hits);
    settleMarked(this->Scene, this->TheView, this->Marks, hits, this->Pool);
  }

private:
  /// A pixel more on each side, where the image has one: `rect` itself may lie outside, in the margin of a filter.
  static PixelRect withNeighbours(const PixelRect& rect, const CameraModel& model)
  {
    const int left = std::min(rect.x, std::max(0, rect.x - 1));
    const int top = std::min(rect.y, std::max(0, rect.y - 1));
    const int right = rect.x + rect.width;
    const int bottom = rect.y + rect.height;
    return { left, top, std::max(right, std::min(model.width(), right + 1)) - left,
      std::max(bottom, std::min(model.height(), bottom + 1)) - top };
  }

  /// Each part as the camera of its instant sees it, with the neighbours that settling looks at.
  void renderInstants(VisibilityBuffer& hits)
  {
    const CameraModel& model = *this->TheView.model;
    const std::vector<TimedRect> parts = timedRects(model, hits.rect);
    const auto jobs = static_cast<int>((parts.size() + partsOfJob - 1) / partsOfJob);
    this->Pool.parallelFor(jobs,
      [&](int job)
      {
        ThreadPool alone(1);
        RaySource source(alone, this->Coherent);
        VisibilityBuffer around;
        for (std::size_t i = job * partsOfJob; i < std::min(parts.size(), (job + 1) * partsOfJob); ++i)
        {
          const PixelRect& rect = parts[i].rect;
          const SeenInstant now = instantOf(this->TheView, parts[i].time);
          source.setScene(now.state, now.view);
          source.render(withNeighbours(rect, model), around);
          for (int y = rect.y; y < rect.y + rect.height; ++y)
          {
            std::copy_n(&around.at(rect.x, y), rect.width, &hits.at(rect.x, y));
          }
        }
      });
  }

  void traceExactly(VisibilityBuffer& hits)
  {
    this->Pool.parallelFor(hits.rect.height,
      [&](int row)
      {
        const WorkTime time(WorkStage::Trace);
        const int y = hits.rect.y + row;
        std::vector<RayHit> found;
        for (int x = hits.rect.x; x < hits.rect.x + hits.rect.width; ++x)
        {
          this->Scene.collectExactly(rayOf(this->TheView, { x + 0.5, y + 0.5 }), true, found);
          hits.at(x, y) = found.empty() ? Hit{} : found.front().hit;
        }
      });
  }

  template <TraceMode Mode>
  void trace(VisibilityBuffer& hits)
  {
    const PixelRect& rect = hits.rect;
    this->Pool.parallelFor((rect.height + bandRows - 1) / bandRows,
      [&](int band)
      {
        const WorkTime time(WorkStage::Trace);
        const int first = band * bandRows;
        const int last = std::min(rect.height, first + bandRows);
        PacketTracer tracer(this->Scene, this->TheView, this->Coherent);
        for (int x = 0; x < rect.width; x += side)
        {
          for (int y = first; y < last; y += side)
          {
            tracer.template trace<Mode>(
              { rect.x + x, rect.y + y, std::min(side, rect.width - x), std::min(side, last - y) }, hits, this->Marks);
          }
        }
      });
  }

  ThreadPool& Pool;
  bool Coherent;
  RayScene Scene;
  View TheView;
  RayMarks Marks;
  std::shared_ptr<SpareMarks> Spare = SpareMarks::shared();
};

} // namespace

std::unique_ptr<VisibilitySource> makeRaySource(ThreadPool& pool, bool coherent)
{
  return std::make_unique<RaySource<false>>(pool, coherent);
}

std::unique_ptr<VisibilitySource> makeBareRaySource(ThreadPool& pool)
{
  return std::make_unique<RaySource<true>>(pool);
}

} // namespace dgtk
