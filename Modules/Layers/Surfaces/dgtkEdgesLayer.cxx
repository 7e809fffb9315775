// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEdges.h"
#include "dgtkLayers.h"

#include <algorithm>

namespace dgtk
{

namespace
{
LayerSpec edgesSpec()
{
  return { "edges", PixelType::UInt8, 1, "1", "image", "0",
    "255: a 4-neighbour has another object id; 128: one of the same object lies off this pixel's tangent plane, and "
    "this pixel off its, by more than 1 % of the smaller depth",
    Meaning::Mask };
}

class EdgesPass : public LayerPass
{
public:
  explicit EdgesPass(const JobContext& context)
    : State(context.state)
    , TheView(context.view)
  {
  }

  void band(const Band& band, LayerSink& sink) override
  {
    for (int y = 0; y < band.rect.height; ++y)
    {
      std::vector<PixelPlane> planes;
      forSurfaceRows(*this->State, this->TheView, { 0, band.rect.y + y, band.rect.width, 1 },
        band.hits.data() + std::size_t(y) * std::size_t(band.rect.width), false,
        [&planes](const SurfaceRows& row)
        {
          const std::vector<PixelPlane> part = pixelPlanes(row);
          planes.insert(planes.end(), part.begin(), part.end());
        });
      const std::vector<std::uint8_t> above = this->Edges.next(std::move(planes));
      this->Last = band.rect.y + y;
      if (!above.empty())
      {
        give(this->Last - 1, above, sink);
      }
    }
  }

  void finish(LayerSink& sink) override { give(this->Last, this->Edges.last(), sink); }

private:
  static void give(int y, const std::vector<std::uint8_t>& marks, LayerSink& sink)
  {
    Rows rows(PixelType::UInt8, 1, static_cast<int>(marks.size()), y, 1);
    std::copy(marks.begin(), marks.end(), rows.row<std::uint8_t>(y));
    sink.rows(0, rows);
  }

  std::shared_ptr<const SceneState> State;
  View TheView;
  EdgeRows Edges;
  int Last = 0; ///< row that came last
};

class EdgesLayer final : public Layer
{
public:
  LayerInfo info() const override
  {
    return { "edges", { "png", "npy" }, "discontinuities of object ids and of depth" };
  }
  LayerNeeds needs(const LayerRequest&, const Stage&) const override { return LayerNeeds::ofHits(); }
  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    return { { edgesSpec(), format } };
  }
  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    return { imageOutput(plan, stage, job, edgesSpec(), planned.formats) };
  }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>&) const override
  {
    return std::make_unique<EdgesPass>(context);
  }
};
} // namespace

LayerList edgesLayers() { return { std::make_shared<EdgesLayer>() }; }

} // namespace dgtk
