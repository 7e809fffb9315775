// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRaySource.h"

#include "dgtkRayPacket.h"
#include "dgtkRayScene.h"
#include "dgtkRaySettle.h"
#include "dgtkThreadPool.h"
#include "dgtkWorkTime.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr int bandRows = 8; ///< rows that are traced as one job
constexpr int side = PacketTracer::side;

/// Primary rays in packets; `Bare` is the yardstick.
template <bool Bare>
class RaySource final : public VisibilitySource
{
public:
  explicit RaySource(ThreadPool& pool)
    : Pool(pool)
    , Scene(RayDevice::shared(), Bare)
  {
  }
  std::string name() const override { return "ray"; }

  void setScene(std::shared_ptr<const SceneState> state, const View& view) override
  {
    this->Scene.place(std::move(state), view.camera_from_world);
    this->TheView = view;
  }

  void render(const PixelRect& rect, VisibilityBuffer& hits) override
  {
    hits.resize(rect);
    if (Bare)
    {
      this->trace<TraceMode::Bare>(hits);
      return;
    }
    this->Marks.resize(rect);
    this->trace<TraceMode::Exact>(hits);
    settleMarked(this->Scene, this->TheView, this->Marks, hits, this->Pool);
  }

private:
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
        PacketTracer tracer(this->Scene, this->TheView);
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
  RayScene Scene;
  View TheView;
  RayMarks Marks;
};

} // namespace

std::unique_ptr<VisibilitySource> makeRaySource(ThreadPool& pool) { return std::make_unique<RaySource<false>>(pool); }

std::unique_ptr<VisibilitySource> makeBareRaySource(ThreadPool& pool)
{
  return std::make_unique<RaySource<true>>(pool);
}

} // namespace dgtk
