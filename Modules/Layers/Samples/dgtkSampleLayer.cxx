// SPDX-License-Identifier: BSD-3-Clause
// The layers of several samples a pixel: alpha and coverage. One pass traces the samples for both.
#include "dgtkError.h"
#include "dgtkLayers.h"
#include "dgtkSamples.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr std::uint32_t largestId = 0xffffff;
constexpr int leastRanks = 6;

LayerSpec alphaSpec()
{
  return { "alpha", PixelType::UInt8, 4, "id", "image", "0",
    "R, G, B: id of the nearest object among the pixel's N x N samples as a 24-bit number, R high; A: 255 times the "
    "share of the samples that show it, rounded",
    Meaning::Id };
}

LayerSpec coverageSpec()
{
  return { "coverage", PixelType::Float32, 2 * leastRanks, "1", "image", "0",
    "Cryptomatte: ranks of (id, coverage), the largest coverage first, id 0 is the background; six ranks, more where a "
    "pixel needs them",
    Meaning::Coverage };
}

class SampledLayer : public Layer
{
public:
  LayerNeeds needs(const LayerRequest&, const Stage&) const override
  {
    LayerNeeds needs = LayerNeeds::ofHits();
    needs.samples = true;
    return needs;
  }
  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    return { { this->spec(), format } };
  }
  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    return { imageOutput(plan, stage, job, this->spec(), planned.formats) };
  }
  std::string passKey() const override { return "samples"; }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>& layers) const override;

  virtual LayerSpec spec() const = 0;
  /// Gives the next rows.
  virtual void write(const SampledRows& samples, ThreadPool& pool, std::size_t output, LayerSink& sink) const = 0;
};

class SampledPass : public LayerPass
{
public:
  SampledPass(const JobContext& context, const std::vector<PassLayer>& layers)
    : Pool(context.pool)
    , Sampler(context.state, context.view, option::samples().of(context.plan.request.options),
        context.queries.makeSource(context.pool), context.pool)
  {
    for (const PassLayer& layer : layers)
    {
      this->Layers.push_back(static_cast<const SampledLayer*>(&layer.layer));
    }
  }

  void band(const Band& band, LayerSink& sink) override
  {
    const int step = this->Sampler.stripRows();
    for (int y = 0; y < band.rect.height; y += step)
    {
      PixelRect rect = band.rect;
      rect.y += y;
      rect.height = std::min(step, band.rect.height - y);
      this->Sampler.sample(rect, band.hits.data() + std::size_t(y) * rect.width, this->Samples);
      for (std::size_t i = 0; i < this->Layers.size(); ++i)
      {
        this->Layers[i]->write(this->Samples, this->Pool, i, sink);
      }
    }
  }

private:
  ThreadPool& Pool;
  PixelSampler Sampler;
  SampledRows Samples;
  std::vector<const SampledLayer*> Layers; // one an output
};

std::unique_ptr<LayerPass> SampledLayer::makePass(const JobContext& context, const std::vector<PassLayer>& layers) const
{
  return std::make_unique<SampledPass>(context, layers);
}

void writeCoverage(const SampledRows& samples, std::size_t output, LayerSink& sink)
{
  const PixelRect& rect = samples.rect;
  std::vector<std::uint32_t> ids(samples.samples);
  std::vector<SampleCount> ranks;
  std::vector<CoveredId> covered;
  const std::size_t pixels = samples.mixed.size();
  for (std::size_t i = 0; i < pixels;)
  {
    const std::size_t rowEnd = i - i % rect.width + rect.width;
    const std::uint32_t id = samples.idOf(0, i);
    std::size_t end = i + 1;
    if (samples.mixed[i])
    {
      for (int k = 0; k < samples.samples; ++k)
      {
        ids[k] = samples.idOf(k, i);
      }
      rankCoverages(ids.data(), samples.samples, ranks);
    }
    else
    {
      while (end < rowEnd && !samples.mixed[end] && samples.idOf(0, end) == id)
      {
        ++end;
      }
      ranks.assign(1, { id, std::uint32_t(samples.samples) });
    }
    covered.clear();
    for (const SampleCount& rank : ranks)
    {
      covered.push_back({ rank.id, static_cast<float>(double(rank.count) / samples.samples) });
    }
    sink.ranks(output, covered, static_cast<std::uint32_t>(end - i));
    i = end;
  }
}

class AlphaLayer final : public SampledLayer
{
public:
  LayerInfo info() const override
  {
    return { "alpha", { "png" }, "id of the nearest object in each pixel and its coverage by N x N samples" };
  }
  void check(const WorkPlan&, const Stage& stage, const PlannedLayer&) const override
  {
    if (stage.objectNames().size() > largestId)
    {
      throw UsageError("layer alpha: more objects than 24 bits can number");
    }
  }
  LayerSpec spec() const override { return alphaSpec(); }
  void write(const SampledRows& samples, ThreadPool& pool, std::size_t output, LayerSink& sink) const override
  {
    sink.rows(output, alphaRows(samples, pool));
  }
};

class CoverageLayer final : public SampledLayer
{
public:
  LayerInfo info() const override
  {
    return { "coverage", { "exr" }, "coverage of every object in each pixel by N x N samples, as Cryptomatte" };
  }
  LayerSpec spec() const override { return coverageSpec(); }
  void write(const SampledRows& samples, ThreadPool&, std::size_t output, LayerSink& sink) const override
  {
    writeCoverage(samples, output, sink);
  }
};
} // namespace

LayerList sampleLayers() { return { std::make_shared<AlphaLayer>(), std::make_shared<CoverageLayer>() }; }

} // namespace dgtk
