// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPairPass.h"

#include "dgtkStrips.h"

namespace dgtk
{

namespace
{
// Pixels that are one job of the pool.
constexpr int stripPixels = 1 << 14;

class PairPass : public LayerPass
{
public:
  PairPass(const JobContext& context, const std::vector<PairTarget>& targets)
    : Context(context)
  {
    for (const PairTarget& target : targets)
    {
      Output output;
      output.target = target;
      output.moment = context.queries.at(target.frame);
      output.other = { output.moment.state.get(),
        context.queries.stage().view(
          target.camera, target.frame, context.plan.request.width, context.plan.request.height),
        output.moment.occlusion.get() };
      this->Outputs.push_back(std::move(output));
    }
  }

  void band(const Band& band, LayerSink& sink) override
  {
    forStrips(
      band, stripPixels, 4 * this->Context.pool.threads(), this->Context.pool,
      [this](const PixelRect& rect, const Hit* hits) { return this->derive(rect, hits); },
      [this, &sink](const std::vector<Values>& strip) { this->append(strip, sink); });
  }

private:
  struct Output
  {
    PairTarget target;
    SceneQueries::Moment moment;
    OtherView other;
  };
  // Of a strip and an output.
  struct Values
  {
    Rows values;
    Rows classes;
  };

  std::vector<Values> derive(const PixelRect& rect, const Hit* hits) const
  {
    SurfaceRows surface;
    computeSurfaceRows(*this->Context.state, this->Context.view, rect, hits, true, surface);
    std::vector<Values> strip;
    for (const Output& output : this->Outputs)
    {
      strip.push_back(deriveOne(surface, output));
    }
    return strip;
  }

  static Values deriveOne(const SurfaceRows& surface, const Output& output)
  {
    const PixelRect& rect = surface.rect;
    const PairValue value = output.target.value;
    Values result;
    result.values = Rows(PixelType::Float64, channelsOf(value), rect.width, rect.y, rect.height);
    std::uint8_t* classes = nullptr;
    if (value != PairValue::Motion)
    {
      result.classes = Rows(PixelType::UInt8, 1, rect.width, rect.y, rect.height);
      classes = result.classes.row<std::uint8_t>(rect.y);
    }
    pairRows(surface, output.other, value, result.values.row<double>(rect.y), classes);
    return result;
  }

  void append(const std::vector<Values>& strip, LayerSink& sink) const
  {
    std::size_t output = 0;
    for (std::size_t i = 0; i < strip.size(); ++i)
    {
      sink.rows(output++, strip[i].values);
      if (this->Outputs[i].target.value != PairValue::Motion)
      {
        sink.rows(output++, strip[i].classes);
      }
    }
  }

  JobContext Context;
  std::vector<Output> Outputs;
};
} // namespace

std::unique_ptr<LayerPass> makePairPass(const JobContext& context, const std::vector<PairTarget>& targets)
{
  return std::make_unique<PairPass>(context, targets);
}

} // namespace dgtk
