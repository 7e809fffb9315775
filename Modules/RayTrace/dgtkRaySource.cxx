// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRaySource.h"

#include "dgtkRayPacket.h"
#include "dgtkRayScene.h"
#include "dgtkRaySettle.h"
#include "dgtkThreadPool.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr int BandRows = 8; ///< rows that are traced as one job
constexpr int BlockSide = PacketTracer::Side;

/// Primary rays in packets; `Exact` chooses between the engine and its yardstick.
template <bool Exact>
class RaySource final : public VisibilitySource
{
public:
  explicit RaySource(ThreadPool& pool)
    : Pool(pool)
    , Scene(RayDevice::shared(), !Exact)
  {
  }
  std::string name() const override { return "ray"; }

  void setScene(std::shared_ptr<const SceneState> state, const View& view) override
  {
    this->Scene.place(std::move(state), view.camera_from_world);
    this->CurrentView = view;
  }

  void render(const PixelRect& rect, VisibilityBuffer& hits) override
  {
    hits.resize(rect);
    if (Exact)
    {
      this->Marks.resize(rect);
    }
    const int bands = (rect.height + BandRows - 1) / BandRows;
    this->Pool.parallelFor(bands,
      [&](int band)
      {
        const int first = band * BandRows;
        const int last = std::min(rect.height, first + BandRows);
        PacketTracer tracer(this->Scene, this->CurrentView);
        for (int x = 0; x < rect.width; x += BlockSide)
        {
          for (int y = first; y < last; y += BlockSide)
          {
            const PixelRect block{ rect.x + x, rect.y + y, std::min(BlockSide, rect.width - x),
              std::min(BlockSide, last - y) };
            tracer.template trace<Exact>(block, hits, this->Marks);
          }
        }
      });
    if (Exact)
    {
      settleMarked(this->Scene, this->CurrentView, this->Marks, hits, this->Pool);
    }
  }

private:
  ThreadPool& Pool;
  RayScene Scene;
  View CurrentView;
  RayMarks Marks;
};

} // namespace

std::unique_ptr<VisibilitySource> makeRaySource(ThreadPool& pool) { return std::make_unique<RaySource<true>>(pool); }

std::unique_ptr<VisibilitySource> makeBareRaySource(ThreadPool& pool)
{
  return std::make_unique<RaySource<false>>(pool);
}

} // namespace dgtk
