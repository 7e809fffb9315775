// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPairPass.h"

#include "dgtkStrips.h"

#include <algorithm>

namespace dgtk
{

namespace
{
// Pixels that are one job of the pool.
constexpr int pairStrip = 1 << 14;

class PairPass : public LayerPass
{
public:
  PairPass(const JobContext& context, const std::vector<PairTarget>& targets)
    : Context(context)
  {
    for (const PairTarget& target : targets)
    {
      Output output;
      const auto same = [&target](const Output& other)
      {
        return other.target.camera == target.camera && other.target.frame == target.frame &&
               other.target.value != PairValue::Motion;
      };
      output.places = static_cast<std::size_t>(
        std::find_if(this->Outputs.begin(), this->Outputs.end(), same) - this->Outputs.begin());
      output.target = target;
      output.moment = context.queries.at(target.frame);
      const auto view = [&](std::size_t camera) {
        return context.queries.stage().view(
          camera, target.frame, context.plan.request.width, context.plan.request.height);
      };
      output.other = { output.moment.state.get(), view(target.camera), output.moment.occlusion.get() };
      if (target.isMoved)
      {
        output.own = { output.moment.state.get(), view(context.job.camera), nullptr };
      }
      this->Outputs.push_back(std::move(output));
    }
  }

  void band(const Band& band, LayerSink& sink) override
  {
    forStrips(
      band, pairStrip, 4 * this->Context.pool.threads(), this->Context.pool,
      [this](const PixelRect& rect, const Hit* hits) { return this->derive(rect, hits); },
      [this, &sink](const std::vector<Values>& strip) { this->append(strip, sink); });
  }

private:
  struct Output
  {
    PairTarget target;
    SceneQueries::Moment moment;
    OtherView other;
    OtherView own;          ///< of a moved target: the picture's camera at that moment
    std::size_t places = 0; ///< the first output whose places are the same
  };
  // Where the surface points of a part of a strip are in another view.
  struct Places
  {
    std::vector<double> pixels;
    std::vector<std::uint8_t> classes;
  };
  // Of a strip and an output.
  struct Values
  {
    Rows values;
    Rows classes;
  };

  std::vector<Values> derive(const PixelRect& rect, const Hit* hits) const
  {
    std::vector<Values> strip(this->Outputs.size());
    for (std::size_t i = 0; i < strip.size(); ++i)
    {
      const PairValue value = this->Outputs[i].target.value;
      strip[i].values = Rows(PixelType::Float64, channelsOf(value), rect.width, rect.y, rect.height);
      strip[i].classes = Rows(PixelType::UInt8, value == PairValue::Motion ? 0 : 1, rect.width, rect.y, rect.height);
    }
    forSurfaceRows(*this->Context.state, this->Context.view, rect, hits, true,
      [&](const SurfaceRows& surface)
      {
        std::vector<Places> places(this->Outputs.size());
        for (std::size_t i = 0; i < this->Outputs.size(); ++i)
        {
          const Output& output = this->Outputs[i];
          if (output.places == i && output.target.value != PairValue::Motion)
          {
            places[i] = placesIn(surface, output.other);
          }
          deriveOne(surface, output, places[output.places], strip[i]);
        }
      });
    return strip;
  }

  static Places placesIn(const SurfaceRows& surface, const OtherView& other)
  {
    Places places;
    places.pixels.resize(2 * surface.t.size());
    places.classes.resize(surface.t.size());
    correspondRows(surface, other, places.pixels.data(), places.classes.data());
    return places;
  }

  static void deriveOne(const SurfaceRows& surface, const Output& output, const Places& places, Values& strip)
  {
    const PairValue value = output.target.value;
    std::vector<double> values(static_cast<std::size_t>(channelsOf(value)) * surface.t.size());
    if (value == PairValue::Motion)
    {
      sceneFlowRows(surface, output.other, values.data());
    }
    else
    {
      const Places own = output.target.isMoved ? placesIn(surface, output.own) : Places();
      pairRows(
        surface.rect, places.pixels.data(), value, values.data(), output.target.isMoved ? own.pixels.data() : nullptr);
      place(places.classes, surface.rect, strip.classes);
    }
    place(values, surface.rect, strip.values);
  }

  /// Copies the values of a part into rows.
  template <typename T>
  static void place(const std::vector<T>& values, const PixelRect& part, Rows& rows)
  {
    const auto width = static_cast<std::size_t>(part.width) * static_cast<std::size_t>(rows.channels());
    for (int y = 0; y < part.height; ++y)
    {
      std::copy_n(values.data() + static_cast<std::size_t>(y) * width, width,
        rows.row<T>(part.y + y) + static_cast<std::ptrdiff_t>(part.x) * rows.channels());
    }
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
