// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColorRows.h"
#include "dgtkNoisySensor.h"

#include "dgtkImageSensor.h"
#include "dgtkPortableMath.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr int sensorBlock = 1 << 18; // given to the sensor at once

LayerSpec noisySpec(const LayerRequest& request, const std::string& format)
{
  LayerSpec spec = colorSpec(request, format);
  spec.name = "color_noisy";
  spec.unit = format == "exr" ? "linear sRGB, or the camera's own response" : "camera response";
  spec.description =
    format == "exr"
      ? "What the camera's sensor makes of the picture; linear light for sensors that answer in sRGB, otherwise the "
        "sensor's own values; red, green, blue."
      : "What the camera's sensor makes of the picture, through its response curve; red, green, blue.";
  return spec;
}

class NoisyColorPass : public LayerPass
{
public:
  NoisyColorPass(const JobContext& context, const std::vector<LayerOutput>& outputs)
    : Width(context.view.model->width())
  {
    const Stage& stage = context.queries.stage();
    ImageSensorSetup setup;
    setup.parameters = colorSensorOf(stage, context.job.camera);
    setup.width = this->Width;
    setup.height = context.view.model->height();
    setup.key = noiseKey(context.plan.request, stage, context.job);
    setup.fieldCosine = [model = context.view.model](int x, int y)
    {
      const Eigen::Vector3d d = model->rayThrough({ x + 0.5, y + 0.5 }).direction;
      return d.z() > 0 ? d.z() / d.norm() : 0.0; // beyond 90 degrees it is dark, as where there is no ray
    };
    this->Decodes = setup.parameters.response == ResponseCurve::Srgb;
    for (const LayerOutput& output : outputs)
    {
      this->Specs.push_back(output.spec);
    }
    this->Sensor = std::make_unique<ImageSensor>(
      setup, [this](int y, int height, const float* rgb) { this->append(y, height, rgb); }, &context.pool);
  }

  void band(const Band& band, LayerSink& sink) override
  {
    this->Sink = &sink;
    const int rows = std::max(1, sensorBlock / this->Width);
    for (int y = 0; y < band.rect.height; y += rows)
    {
      this->Sensor->write(std::min(rows, band.rect.height - y), band.rgb.data() + std::size_t(y) * this->Width * 3);
    }
  }

private:
  void append(int y, int height, const float* rgb)
  {
    Band band;
    band.rect = { 0, y, this->Width, height };
    band.rgb.assign(rgb, rgb + std::size_t(this->Width) * height * 3);
    for (std::size_t i = 0; i < this->Specs.size(); ++i)
    {
      if (this->Specs[i].type != PixelType::Float32)
      {
        this->Sink->rows(i, quantise(band, this->Specs[i], y, height));
        continue;
      }
      Rows rows(PixelType::Float32, 3, this->Width, y, height);
      std::transform(band.rgb.begin(), band.rgb.end(), rows.row<float>(y),
        [this](float v) { return this->Decodes ? static_cast<float>(portable::linearFromSrgb(v)) : v; });
      this->Sink->rows(i, rows);
    }
  }

  int Width;
  bool Decodes = true;
  std::vector<LayerSpec> Specs; // one an output
  LayerSink* Sink = nullptr;    // of the band that the sensor has been given
  std::unique_ptr<ImageSensor> Sensor;
};

class NoisyColorLayer final : public Layer
{
public:
  LayerInfo info() const override
  {
    return { "color_noisy", { "png", "exr" }, "what the camera's sensor makes of the picture" };
  }
  LayerNeeds needs(const LayerRequest&, const Stage&) const override { return LayerNeeds::ofColor(); }
  std::vector<LayerRecord> records(const WorkPlan& plan, const std::string& format) const override
  {
    return { { noisySpec(plan.request, format), format } };
  }
  std::vector<std::pair<std::string, std::string>> noise(const WorkPlan& plan, const Stage& stage) const override
  {
    return describeNoise(
      plan, stage, this->info().layer, [](const SensorParameters& sensor) { return sensor.color.has_value(); });
  }
  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    return colorOutputs(plan, stage, job, planned, &noisySpec);
  }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>& layers) const override
  {
    return std::make_unique<NoisyColorPass>(context, layers.front().outputs);
  }
};
} // namespace

LayerList noisyColorLayers() { return { std::make_shared<NoisyColorLayer>() }; }

} // namespace dgtk
