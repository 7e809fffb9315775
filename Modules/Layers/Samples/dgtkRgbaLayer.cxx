// SPDX-License-Identifier: BSD-3-Clause
// The layer color_rgba: the picture without its background.
#include "dgtkLayers.h"
#include "dgtkPictureCurve.h"
#include "dgtkSamples.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace dgtk
{

namespace
{
constexpr const char* rgbaName = "color_rgba";

LayerSpec rgbaSpec()
{
  return { rgbaName, PixelType::UInt8, 4, "sRGB", "image", "none",
    "R, G, B: the picture's colour without the background's share, not multiplied by A; A: 255 times the share of the "
    "pixel's N x N samples that meet an object, rounded; R, G, B of A = 0 are 0",
    Meaning::Picture };
}

/// How many samples of each pixel of the rows meet an object.
std::vector<int> covered(const SampledRows& samples)
{
  std::vector<int> counts(samples.mixed.size(), 0);
  for (const VisibilityBuffer& hits : samples.hits)
  {
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
      counts[i] += hits.hits[i].object != 0 ? 1 : 0;
    }
  }
  return counts;
}

/// In display values, which are what the picture's samples are averaged in. `behind`: what the samples show of the
/// background; those without a ray are black.
void writePixel(const Eigen::Vector3d& rgb, const Eigen::Vector3d& behind, double share, std::uint8_t* out)
{
  constexpr double top = 255;
  for (int c = 0; c < 3; ++c)
  {
    const double color = share > 0 ? (rgb[c] - behind[c]) / share : 0;
    out[c] = static_cast<std::uint8_t>(std::lround(top * std::min(std::max(color, 0.0), 1.0)));
  }
  out[3] = static_cast<std::uint8_t>(std::lround(top * share));
}

class RgbaPass : public LayerPass
{
public:
  explicit RgbaPass(const JobContext& context)
    : Curve(context.plan.request)
    , Background(this->curved(context.state->background).cwiseMin(1))
    , Sampler(context.state, context.view, option::samples().of(context.plan.request.options),
        context.queries.makeSource(context.pool), context.pool)
  {
  }

  void band(const Band& band, LayerSink& sink) override
  {
    const int step = this->Sampler.stripRows();
    for (int y = 0; y < band.rect.height; y += step)
    {
      PixelRect rect = band.rect;
      rect.y += y;
      rect.height = std::min(step, band.rect.height - y);
      const std::size_t first = std::size_t(y) * std::size_t(rect.width);
      this->Sampler.sample(rect, band.hits.data() + first, this->Samples);
      const std::vector<int> counts = covered(this->Samples);
      Rows rows(PixelType::UInt8, 4, rect.width, rect.y, rect.height);
      std::uint8_t* out = rows.row<std::uint8_t>(rect.y);
      for (std::size_t i = 0; i < counts.size(); ++i)
      {
        const double all = this->Samples.samples;
        const double share = counts[i] / all;
        const bool mixed = counts[i] > 0 && counts[i] < this->Samples.samples;
        const int dark =
          mixed ? this->Sampler.withoutRay(rect.x + int(i) % rect.width, rect.y + int(i) / rect.width) : 0;
        const Eigen::Vector3d color = Eigen::Map<const Eigen::Vector3f>(&band.rgb[3 * (first + i)]).cast<double>();
        writePixel(this->curved(color), (1 - share - dark / all) * this->Background, share, out + 4 * i);
      }
      sink.rows(0, rows);
    }
  }

private:
  Eigen::Vector3d curved(const Eigen::Vector3d& color) const
  {
    return this->Curve.changes()
             ? Eigen::Vector3d(color.unaryExpr([this](double v) { return double(this->Curve(float(v))); }))
             : color;
  }

  PictureCurve Curve;
  Eigen::Vector3d Background; ///< sRGB, as the picture shows it
  PixelSampler Sampler;
  SampledRows Samples;
};

/// The background is one colour, and mixes with the rest by samples.
bool hasPlainBackground(const SceneDescription& scene)
{
  const bool seen = !scene.environment.image.empty() && scene.environment.background;
  return !seen && !std::all_of(scene.cameras.begin(), scene.cameras.end(), std::mem_fn(&CameraDescription::blurs));
}

class RgbaLayer final : public Layer
{
public:
  LayerInfo info() const override
  {
    return { rgbaName, { "png" }, "the picture with a transparent background, by N x N samples", false, {},
      &hasPlainBackground };
  }
  std::string requirement() const override
  {
    return "a camera without shutter and lens, drawn by the built-in renderer, a background of one colour, and pixels "
           "that are the mean of their own samples (filter box)";
  }
  LayerNeeds needs(const LayerRequest&, const Stage&) const override
  {
    LayerNeeds needs = LayerNeeds::ofColor();
    needs.hits = true;
    needs.samples = true;
    return needs;
  }
  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    return { { rgbaSpec(), format } };
  }
  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    const SceneDescription& scene = stage.description();
    if (!drawsItself(plan.request) || !option::filter().isDefault(plan.request.options) ||
        scene.cameras[job.camera].blurs() || !hasPlainBackground(scene))
    {
      return {};
    }
    return { imageOutput(plan, stage, job, rgbaSpec(), planned.formats) };
  }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>&) const override
  {
    return std::make_unique<RgbaPass>(context);
  }
};
} // namespace

LayerList rgbaLayers() { return { std::make_shared<RgbaLayer>() }; }

} // namespace dgtk
