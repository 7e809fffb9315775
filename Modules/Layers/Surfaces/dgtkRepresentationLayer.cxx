// SPDX-License-Identifier: BSD-3-Clause
// Every representation as a layer: one pass computes the surface of each pixel for all of them.
#include "dgtkLayers.h"
#include "dgtkStrips.h"

#include "dgtkError.h"
#include "dgtkRepresentation.h"
#include "dgtkSurfaceRows.h"

namespace dgtk
{

namespace
{
// Pixels whose surfaces are computed at once: fits a core's cache, large enough to be worth a job.
constexpr int stripPixels = 1 << 16;

class RepresentationLayer final : public Layer
{
public:
  explicit RepresentationLayer(const RepresentationInfo& info)
    : Values(makeRepresentation(info.layer))
    , Info{ info.layer, Values->formats(), info.description, info.usual }
  {
  }
  const Representation& representation() const { return *this->Values; }

  LayerInfo info() const override { return this->Info; }
  LayerNeeds needs(const LayerRequest&, const Stage&) const override { return LayerNeeds::ofHits(); }
  /// Ids that do not fit a format are refused before anything is written.
  void check(const WorkPlan& plan, const Stage& stage, const PlannedLayer& planned) const override
  {
    const LayerSpec spec = this->Values->spec();
    const std::uint32_t largest = this->Values->largest(*stage.at(plan.jobs.front().frame));
    for (const std::string& format : planned.formats)
    {
      const std::uint32_t fits = largestStored(format, spec);
      if (largest > fits)
      {
        throw UsageError("layer " + spec.name + ": ids up to " + std::to_string(largest) + " do not fit ." +
                         formatExtension(format) + " (largest " + std::to_string(fits) + "); .npy holds them");
      }
    }
  }
  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    return { { storedSpec(format, this->Values->spec()), format } };
  }
  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    return { imageOutput(plan, stage, job, this->Values->spec(), planned.formats) };
  }
  std::string passKey() const override { return "surface"; }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>& layers) const override;

private:
  std::shared_ptr<const Representation> Values;
  LayerInfo Info;
};

class SurfacePass : public LayerPass
{
public:
  SurfacePass(const JobContext& context, const std::vector<PassLayer>& layers)
    : State(context.state)
    , TheView(context.view)
    , Pool(context.pool)
  {
    for (const PassLayer& layer : layers)
    {
      const Representation& values = static_cast<const RepresentationLayer&>(layer.layer).representation();
      this->Barycentrics = this->Barycentrics || values.needsBarycentrics();
      this->Layers.push_back({ &values, values.spec() });
    }
  }

  void band(const Band& band, LayerSink& sink) override
  {
    forStrips(
      band, stripPixels, this->Pool.threads(), this->Pool,
      [this](const PixelRect& rect, const Hit* hits) { return this->derive(rect, hits); },
      [&sink](const std::vector<Rows>& strip)
      {
        for (std::size_t i = 0; i < strip.size(); ++i)
        {
          sink.rows(i, strip[i]);
        }
      });
  }

private:
  struct Values
  {
    const Representation* representation;
    LayerSpec spec;
  };

  std::vector<Rows> derive(const PixelRect& rect, const Hit* hits) const
  {
    std::vector<Rows> out;
    for (const Values& layer : this->Layers)
    {
      out.emplace_back(layer.spec.type, layer.spec.channels, rect.width, rect.y, rect.height);
    }
    forSurfaceRows(*this->State, this->TheView, rect, hits, this->Barycentrics,
      [&](const SurfaceRows& surface)
      {
        for (std::size_t i = 0; i < out.size(); ++i)
        {
          this->Layers[i].representation->compute(surface, out[i]);
        }
      });
    return out;
  }

  std::shared_ptr<const SceneState> State;
  View TheView;
  ThreadPool& Pool;
  bool Barycentrics = false;
  std::vector<Values> Layers; // one an output
};

std::unique_ptr<LayerPass> RepresentationLayer::makePass(
  const JobContext& context, const std::vector<PassLayer>& layers) const
{
  return std::make_unique<SurfacePass>(context, layers);
}
} // namespace

LayerList representationLayers()
{
  LayerList all;
  for (const RepresentationInfo& info : representations())
  {
    all.push_back(std::make_shared<RepresentationLayer>(info));
  }
  return all;
}

} // namespace dgtk
