// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPairLane.h"

#include "dgtkCorrespondence.h"

#include <algorithm>

namespace dgtk
{

namespace
{
// Pixels that are one job of the pool.
constexpr int stripPixels = 1 << 14;

class PairLane : public OutputLane
{
public:
  PairLane(const JobContext& context, const std::vector<PairTarget>& targets)
    : Context(context)
  {
    const CameraModel& model = *context.view.model;
    for (const PairTarget& target : targets)
    {
      Output output;
      output.target = target;
      output.moment = context.queries.at(target.frame);
      output.other = { output.moment.state.get(),
        context.queries.stage().view(
          target.camera, target.frame, context.plan.request.width, context.plan.request.height),
        output.moment.occlusion.get() };
      output.names = pairFiles(target, context.camera, context.job.frame);
      for (std::size_t i = 0; i < output.names.size(); ++i)
      {
        const bool isClass = i == target.formats.size();
        output.writers.push_back(makeLayerWriter(isClass ? "png" : target.formats[i], context.path(output.names[i]),
          isClass ? classSpec(target.spec.name) : target.spec, model.width(), model.height()));
      }
      this->Outputs.push_back(std::move(output));
    }
  }

  void write(const Band& band) override
  {
    const int stripRows = std::max(1, stripPixels / band.rect.width);
    const int strips = (band.rect.height + stripRows - 1) / stripRows;
    const int batch = std::max(1, 4 * this->Context.pool.threads());
    for (int first = 0; first < strips; first += batch)
    {
      const int count = std::min(batch, strips - first);
      std::vector<std::vector<Values>> done(count);
      this->Context.pool.parallelFor(
        count, [&](int i) { done[i] = this->derive(band, (first + i) * stripRows, stripRows); });
      for (const std::vector<Values>& strip : done)
      {
        this->append(strip);
      }
    }
  }

  std::vector<FinishedFile> finish() override
  {
    std::vector<FinishedFile> files;
    for (Output& output : this->Outputs)
    {
      for (std::size_t i = 0; i < output.writers.size(); ++i)
      {
        FileRecord record = output.writers[i]->finish();
        record.path = output.names[i];
        const std::string& layer = output.target.spec.name;
        files.push_back({ record, i == output.target.formats.size() ? classSpec(layer).name : layer });
      }
    }
    return files;
  }

private:
  struct Output
  {
    PairTarget target;
    SceneQueries::Moment moment;
    OtherView other;
    std::vector<std::string> names;
    std::vector<std::unique_ptr<LayerWriter>> writers; // one a name
  };
  // Of a strip and an output.
  struct Values
  {
    Rows values;
    Rows classes;
  };

  std::vector<Values> derive(const Band& band, int offset, int stripRows) const
  {
    PixelRect rect = band.rect;
    rect.y += offset;
    rect.height = std::min(stripRows, band.rect.height - offset);
    SurfaceRows surface;
    computeSurfaceRows(*this->Context.state, this->Context.view, rect,
      band.hits.data() + std::size_t(offset) * rect.width, true, surface);
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
    const LayerSpec& spec = output.target.spec;
    Values result;
    result.values = Rows(PixelType::Float64, spec.channels, rect.width, rect.y, rect.height);
    if (output.target.value == PairValue::Motion)
    {
      sceneFlowRows(surface, *output.other.state, result.values.row<double>(rect.y));
      return result;
    }
    result.classes = Rows(PixelType::UInt8, 1, rect.width, rect.y, rect.height);
    std::vector<double> found(surface.t.size() * 2);
    correspondRows(surface, output.other, found.data(), result.classes.row<std::uint8_t>(rect.y));
    double* value = result.values.row<double>(rect.y);
    std::size_t i = 0;
    for (int y = rect.y; y < rect.y + rect.height; ++y)
    {
      for (int x = 0; x < rect.width; ++x, i += 2)
      {
        const double own[2] = { x + 0.5, y + 0.5 };
        switch (output.target.value)
        {
          case PairValue::Position:
            *value++ = found[i];
            *value++ = found[i + 1];
            break;
          case PairValue::Displacement:
            *value++ = found[i] - own[0];
            *value++ = found[i + 1] - own[1];
            break;
          case PairValue::FromLeft:
            *value++ = own[0] - found[i];
            break;
          default:
            *value++ = found[i] - own[0];
        }
      }
    }
    return result;
  }

  void append(const std::vector<Values>& strip)
  {
    for (std::size_t o = 0; o < strip.size(); ++o)
    {
      Output& output = this->Outputs[o];
      for (std::size_t i = 0; i < output.writers.size(); ++i)
      {
        output.writers[i]->write(i == output.target.formats.size() ? strip[o].classes : strip[o].values);
      }
    }
  }

  JobContext Context;
  std::vector<Output> Outputs;
};
} // namespace

LayerSpec classSpec(const std::string& layer)
{
  return { layer + "_class", PixelType::UInt8, 1, "class", "image", "0",
    "0 no surface, 1 visible, 2 occluded by another object, 3 occluded by its own object, 4 outside the image, "
    "5 behind the camera" };
}

std::vector<std::string> pairFiles(const PairTarget& target, const std::string& camera, int frame)
{
  std::vector<std::string> names;
  for (const std::string& format : target.formats)
  {
    names.push_back(WorkPlan::fileName(camera, target.folder, frame, formatExtension(format)));
  }
  if (target.value != PairValue::Motion)
  {
    names.push_back(WorkPlan::fileName(camera, target.folder, frame, "png"));
  }
  return names;
}

std::unique_ptr<OutputLane> makePairLane(const JobContext& context, const std::vector<PairTarget>& targets)
{
  return std::make_unique<PairLane>(context, targets);
}

} // namespace dgtk
