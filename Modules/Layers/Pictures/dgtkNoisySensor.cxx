// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkNoisySensor.h"

#include "dgtkImageSensor.h"

#include <set>

namespace dgtk
{

namespace
{
const std::optional<SensorParameters>& sensorOf(const Stage& stage, std::size_t camera)
{
  return stage.description().cameras[camera].sensor;
}
} // namespace

ColorSensorParameters colorSensorOf(const Stage& stage, std::size_t camera)
{
  const std::optional<SensorParameters>& sensor = sensorOf(stage, camera);
  return sensor && sensor->color ? *sensor->color : defaultColorSensor();
}

DepthSensorParameters depthSensorOf(const Stage& stage, std::size_t camera)
{
  const std::optional<SensorParameters>& sensor = sensorOf(stage, camera);
  return sensor && sensor->depth ? *sensor->depth : defaultDepthSensor();
}

std::uint64_t noiseSeed(const LayerRequest& request, const Stage& stage)
{
  return stage.description().seed + static_cast<std::uint64_t>(option::seed().of(request.options));
}

NoiseKey noiseKey(const LayerRequest& request, const Stage& stage, const Job& job)
{
  return { noiseSeed(request, stage), static_cast<std::uint32_t>(job.camera), job.frame };
}

std::vector<std::pair<std::string, std::string>> describeNoise(const WorkPlan& plan, const Stage& stage,
  const std::string& layer, const std::function<bool(const SensorParameters&)>& isOwn)
{
  std::set<std::size_t> cameras;
  for (const Job& job : plan.jobs)
  {
    const std::optional<SensorParameters>& sensor = sensorOf(stage, job.camera);
    if (!sensor || !isOwn(*sensor))
    {
      cameras.insert(job.camera);
    }
  }
  std::string names;
  for (const std::size_t camera : cameras)
  {
    names += (names.empty() ? "" : ",") + stage.description().cameras[camera].name;
  }
  return { { "noise_seed", std::to_string(noiseSeed(plan.request, stage)) },
    { layer + "_default_sensor", names.empty() ? "none" : names } };
}

} // namespace dgtk
