// SPDX-License-Identifier: BSD-3-Clause
// The layers of several samples a pixel: alpha and coverage. One lane traces the samples for both.
#include "dgtkCryptomatte.h"
#include "dgtkEmptyLane.h"
#include "dgtkError.h"
#include "dgtkFrameLayers.h"
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
    "share of the samples that show it, rounded" };
}

LayerSpec coverageSpec()
{
  return { "coverage", PixelType::Float32, 2 * leastRanks, "1", "image", "0",
    "Cryptomatte: ranks of (id, coverage), the largest coverage first, id 0 is the background; six ranks, more where a "
    "pixel needs them" };
}

std::string fileOf(const JobContext& context, const LayerSpec& spec, const std::string& extension)
{
  return WorkPlan::fileName(context.camera, spec.name, context.job.frame, extension);
}

class SampledLane : public OutputLane
{
public:
  explicit SampledLane(const JobContext& context)
    : Context(context)
    , Sampler(context.state, context.view, context.plan.request.samples, context.pool)
  {
    const CameraModel& model = *context.view.model;
    if (context.plan.has("alpha"))
    {
      this->Alpha = makeLayerWriter(
        "png", context.path(fileOf(context, alphaSpec(), "png")), alphaSpec(), model.width(), model.height());
    }
    if (context.plan.has("coverage"))
    {
      this->Coverage = std::make_unique<CryptomatteWriter>(context.path(fileOf(context, coverageSpec(), "exr")),
        coverageSpec(), model.width(), model.height(), context.queries.stage().objectNames(), leastRanks);
    }
  }

  void write(const Band& band) override
  {
    const int step = this->Sampler.stripRows();
    for (int y = 0; y < band.rect.height; y += step)
    {
      PixelRect rect = band.rect;
      rect.y += y;
      rect.height = std::min(step, band.rect.height - y);
      this->Sampler.sample(rect, band.hits.data() + std::size_t(y) * rect.width, this->Samples);
      if (this->Alpha)
      {
        this->Alpha->write(alphaRows(this->Samples, this->Context.pool));
      }
      if (this->Coverage)
      {
        this->writeCoverage();
      }
    }
  }

  std::vector<FinishedFile> finish() override
  {
    std::vector<FinishedFile> files;
    const auto add = [&](FileRecord record, const LayerSpec& spec, const char* extension)
    {
      record.path = fileOf(this->Context, spec, extension);
      files.push_back({ record, spec.name });
    };
    if (this->Alpha)
    {
      add(this->Alpha->finish(), alphaSpec(), "png");
    }
    if (this->Coverage)
    {
      add(this->Coverage->finish(), coverageSpec(), "exr");
    }
    return files;
  }

private:
  void writeCoverage()
  {
    const PixelRect& rect = this->Samples.rect;
    std::vector<std::uint32_t> ids(this->Samples.samples);
    std::vector<SampleCount> ranks;
    const std::size_t pixels = this->Samples.mixed.size();
    for (std::size_t i = 0; i < pixels;)
    {
      const std::size_t rowEnd = i - i % rect.width + rect.width;
      const std::uint32_t id = this->Samples.hits[0].hits[i].object;
      std::size_t end = i + 1;
      if (this->Samples.mixed[i])
      {
        for (int k = 0; k < this->Samples.samples; ++k)
        {
          ids[k] = this->Samples.hits[k].hits[i].object;
        }
        rankCoverages(ids.data(), this->Samples.samples, ranks);
      }
      else
      {
        while (end < rowEnd && !this->Samples.mixed[end] && this->Samples.hits[0].hits[end].object == id)
        {
          ++end;
        }
        ranks.assign(1, { id, std::uint32_t(this->Samples.samples) });
      }
      this->Ranks.clear();
      for (const SampleCount& rank : ranks)
      {
        this->Ranks.push_back({ rank.id, static_cast<float>(double(rank.count) / this->Samples.samples) });
      }
      this->Coverage->add(this->Ranks, static_cast<std::uint32_t>(end - i));
      i = end;
    }
  }

  JobContext Context;
  PixelSampler Sampler;
  SampledRows Samples;
  std::vector<CoveredId> Ranks;
  std::unique_ptr<LayerWriter> Alpha;
  std::unique_ptr<CryptomatteWriter> Coverage;
};

class SampledLayer : public FrameLayer
{
public:
  std::vector<std::pair<std::string, std::string>> options(const GeneratorRequest& request) const override
  {
    return { { this->info().layer + "_samples", std::to_string(request.samples) } };
  }
  std::vector<std::string> files(const WorkPlan&, const Stage& stage, const Job& job) const override
  {
    const LayerInfo info = this->info();
    return { WorkPlan::fileName(stage.cameraNames()[job.camera], info.layer, job.frame, info.formats.front()) };
  }
};

class AlphaLayer final : public SampledLayer
{
public:
  LayerInfo info() const override
  {
    return { "alpha", { "png" }, "id of the nearest object in each pixel and its coverage by N x N samples" };
  }
  void check(const WorkPlan&, const Stage& stage) const override
  {
    if (stage.objectNames().size() > largestId)
    {
      throw UsageError("layer alpha: more objects than 24 bits can number");
    }
  }
  std::vector<LayerRecord> specs(const std::string& format) const override { return { { alphaSpec(), format } }; }
  std::unique_ptr<OutputLane> makeLane(const JobContext& context) const override
  {
    return std::make_unique<SampledLane>(context);
  }
};

class CoverageLayer final : public SampledLayer
{
public:
  LayerInfo info() const override
  {
    return { "coverage", { "exr" }, "coverage of every object in each pixel by N x N samples, as Cryptomatte" };
  }
  std::vector<LayerRecord> specs(const std::string& format) const override { return { { coverageSpec(), format } }; }
  std::unique_ptr<OutputLane> makeLane(const JobContext& context) const override
  {
    if (context.plan.has("alpha"))
    {
      return std::make_unique<EmptyLane>();
    }
    return std::make_unique<SampledLane>(context);
  }
};
} // namespace

std::shared_ptr<const FrameLayer> makeAlphaLayer();
std::shared_ptr<const FrameLayer> makeAlphaLayer() { return std::make_shared<AlphaLayer>(); }

std::shared_ptr<const FrameLayer> makeCoverageLayer();
std::shared_ptr<const FrameLayer> makeCoverageLayer() { return std::make_shared<CoverageLayer>(); }

} // namespace dgtk
