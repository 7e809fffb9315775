// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFrameLayers.h"
#include "dgtkNoisySensor.h"
#include "dgtkOutputLanes.h"

#include "dgtkImageSensor.h"
#include "dgtkPortableMath.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr int blockPixels = 1 << 18; // given to the sensor at once

LayerSpec noisySpec(const WorkPlan& plan, const std::string& format)
{
  LayerSpec spec = plan.colorSpec(format);
  spec.name = "color_noisy";
  spec.unit = format == "exr" ? "linear sRGB, or the camera's own response" : "camera response";
  spec.description =
    format == "exr"
      ? "What the camera's sensor makes of the picture; linear light for sensors that answer in sRGB, otherwise the "
        "sensor's own values; red, green, blue."
      : "What the camera's sensor makes of the picture, through its response curve; red, green, blue.";
  return spec;
}

class NoisyColorLane : public OutputLane
{
public:
  explicit NoisyColorLane(const JobContext& context)
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
      return d.z() / d.norm();
    };
    this->Decodes = setup.parameters.response == ResponseCurve::Srgb;
    for (const std::string& format : context.plan.formatsOf("color_noisy"))
    {
      const LayerSpec spec = noisySpec(context.plan, format);
      const std::string name =
        WorkPlan::fileName(context.camera, "color_noisy", context.job.frame, formatExtension(format));
      this->Files.push_back(
        { spec, name, makeLayerWriter(format, context.path(name), spec, setup.width, setup.height) });
    }
    this->Sensor = std::make_unique<ImageSensor>(
      setup, [this](int y, int height, const float* rgb) { this->append(y, height, rgb); }, &context.pool);
  }

  void write(const Band& band) override
  {
    const int rows = std::max(1, blockPixels / this->Width);
    for (int y = 0; y < band.rect.height; y += rows)
    {
      this->Sensor->write(std::min(rows, band.rect.height - y), band.rgb.data() + std::size_t(y) * this->Width * 3);
    }
  }

  std::vector<FinishedFile> finish() override
  {
    std::vector<FinishedFile> finished;
    for (File& file : this->Files)
    {
      FileRecord record = file.writer->finish();
      record.path = file.name;
      finished.push_back({ record, "color_noisy" });
    }
    return finished;
  }

private:
  struct File
  {
    LayerSpec spec;
    std::string name;
    std::unique_ptr<LayerWriter> writer;
  };

  void append(int y, int height, const float* rgb)
  {
    Band band;
    band.rect = { 0, y, this->Width, height };
    band.rgb.assign(rgb, rgb + std::size_t(this->Width) * height * 3);
    for (const File& file : this->Files)
    {
      if (file.spec.type != PixelType::Float32)
      {
        file.writer->write(quantise(band, file.spec, y, height));
        continue;
      }
      Rows rows(PixelType::Float32, 3, this->Width, y, height);
      std::transform(band.rgb.begin(), band.rgb.end(), rows.row<float>(y),
        [this](float v) { return this->Decodes ? static_cast<float>(portable::linearFromSrgb(v)) : v; });
      file.writer->write(rows);
    }
  }

  int Width;
  bool Decodes = true;
  std::vector<File> Files;
  std::unique_ptr<ImageSensor> Sensor;
};

class NoisyColorLayer final : public FrameLayer
{
public:
  LayerInfo info() const override
  {
    return { "color_noisy", { "png", "exr" }, "what the camera's sensor makes of the picture" };
  }
  bool needsColor() const override { return true; }
  std::vector<LayerRecord> specs(const std::string& format) const override { return this->records({}, format); }
  std::vector<LayerRecord> records(const WorkPlan& plan, const std::string& format) const override
  {
    return { { noisySpec(plan, format), format } };
  }
  std::vector<std::string> files(const WorkPlan& plan, const Stage& stage, const Job& job) const override
  {
    std::vector<std::string> names;
    for (const std::string& format : plan.formatsOf("color_noisy"))
    {
      names.push_back(
        WorkPlan::fileName(stage.cameraNames()[job.camera], "color_noisy", job.frame, formatExtension(format)));
    }
    return names;
  }
  std::unique_ptr<OutputLane> makeLane(const JobContext& context) const override
  {
    return std::make_unique<NoisyColorLane>(context);
  }
};
} // namespace

std::shared_ptr<const FrameLayer> makeNoisyColorLayer();
std::shared_ptr<const FrameLayer> makeNoisyColorLayer() { return std::make_shared<NoisyColorLayer>(); }

} // namespace dgtk
