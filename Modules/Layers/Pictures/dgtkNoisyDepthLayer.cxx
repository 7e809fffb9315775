// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkLayers.h"
#include "dgtkNoisySensor.h"
#include "dgtkStrips.h"

#include "dgtkDepthSensor.h"
#include "dgtkRepresentation.h"
#include "dgtkSurfaceRows.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int noisyStrip = 1 << 16; // whose surfaces are computed at once

LayerSpec noisyDepthSpec()
{
  return { "depth_noisy", PixelType::Float64, 1, "scene units", "camera", "+inf",
    "z in the camera frame as the camera's depth sensor measures it, positive forward", Meaning::Depth };
}

/// fx in pixels; 0 for a camera that has none.
double focalLengthOf(const CameraModel& model)
{
  const std::optional<LinearProjection> linear = model.linear();
  return linear && linear->perspective ? linear->K(0, 0) : 0;
}

class NoisyDepthPass : public LayerPass
{
public:
  explicit NoisyDepthPass(const JobContext& context)
    : Context(context)
    , Depth(makeRepresentation("depth"))
    , Normal(makeRepresentation("normal"))
  {
    const View& view = context.view;
    const Stage& stage = context.queries.stage();
    DepthSensorSetup setup;
    setup.parameters = depthSensorOf(stage, context.job.camera);
    setup.width = view.model->width();
    setup.height = view.model->height();
    setup.key = noiseKey(context.plan.request, stage, context.job);
    setup.focalLength = focalLengthOf(*view.model);
    this->Sensor = std::make_unique<DepthSensor>(
      setup, [this](int y, const double* depth) { this->append(y, depth); }, &context.pool);
  }

  void band(const Band& band, LayerSink& sink) override
  {
    this->Sink = &sink;
    forStrips(
      band, noisyStrip, this->Context.pool.threads(), this->Context.pool,
      [this](const PixelRect& rect, const Hit* hits) { return this->derive(rect, hits); },
      [this](const Strip& strip)
      { this->Sensor->write(strip.depth.height(), strip.depth.row<double>(strip.depth.y()), strip.cosines.data()); });
  }

private:
  struct Strip
  {
    Rows depth;
    std::vector<float> cosines; // between normal and ray
  };

  Strip derive(const PixelRect& rect, const Hit* hits) const
  {
    const View& view = this->Context.view;
    Strip strip;
    strip.depth = Rows(PixelType::Float64, 1, rect.width, rect.y, rect.height);
    Rows normals(PixelType::Float32, 3, rect.width, rect.y, rect.height);
    forSurfaceRows(*this->Context.state, view, rect, hits, false,
      [&](const SurfaceRows& surface)
      {
        this->Depth->compute(surface, strip.depth);
        this->Normal->compute(surface, normals);
      });
    const float* n = normals.row<float>(rect.y);
    strip.cosines.resize(std::size_t(rect.width) * rect.height);
    for (std::size_t i = 0; i < strip.cosines.size(); ++i, n += 3)
    {
      if (std::isfinite(n[0]))
      {
        const double x = rect.x + double(i % rect.width) + 0.5;
        const double y = rect.y + double(i / rect.width) + 0.5;
        const Eigen::Vector3d ray = view.model->rayThrough({ x, y }).direction;
        strip.cosines[i] = static_cast<float>(std::abs(ray.dot(Eigen::Vector3d(n[0], n[1], n[2]))) / ray.norm());
      }
    }
    return strip;
  }

  void append(int y, const double* depth)
  {
    const int width = this->Context.view.model->width();
    Rows rows(PixelType::Float64, 1, width, y, 1);
    std::copy_n(depth, width, rows.row<double>(y));
    this->Sink->rows(0, rows);
  }

  JobContext Context;
  std::unique_ptr<Representation> Depth;
  std::unique_ptr<Representation> Normal;
  LayerSink* Sink = nullptr; // of the band that the sensor has been given
  std::unique_ptr<DepthSensor> Sensor;
};

class NoisyDepthLayer final : public Layer
{
public:
  LayerInfo info() const override
  {
    return { "depth_noisy", { "npy", "dgd", "exr", "pfm", "png" }, "depth as the camera's depth sensor measures it" };
  }
  LayerNeeds needs(const LayerRequest&, const Stage&) const override
  {
    LayerNeeds needs = LayerNeeds::ofHits();
    needs.whole = true;
    return needs;
  }
  void check(const WorkPlan& plan, const Stage& stage, const PlannedLayer&) const override
  {
    for (const Job& job : plan.jobs)
    {
      if (depthSensorOf(stage, job.camera).stereo.baseline > 0 &&
          !(focalLengthOf(*stage.view(job.camera, job.frame, plan.request.width, plan.request.height).model) > 0))
      {
        throw UsageError("depth_noisy: the stereo sensor of camera " + quoted(stage.cameraNames()[job.camera]) +
                         " needs a camera with a focal length (expected a pinhole)");
      }
    }
  }
  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    return { { noisyDepthSpec(), format } };
  }
  std::vector<std::pair<std::string, std::string>> noise(const WorkPlan& plan, const Stage& stage) const override
  {
    return describeNoise(
      plan, stage, this->info().layer, [](const SensorParameters& sensor) { return sensor.depth.has_value(); });
  }
  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    return { imageOutput(plan, stage, job, noisyDepthSpec(), planned.formats) };
  }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>&) const override
  {
    return std::make_unique<NoisyDepthPass>(context);
  }
};
} // namespace

LayerList noisyDepthLayers() { return { std::make_shared<NoisyDepthLayer>() }; }

} // namespace dgtk
