// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkNoisySensor_h
#define dgtkNoisySensor_h

#include "dgtkNoiseKey.h"
#include "dgtkSensorParameters.h"
#include "dgtkWorkPlan.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// The sensor of a camera of the scene, or the default one.
ColorSensorParameters colorSensorOf(const Stage& stage, std::size_t camera);
DepthSensorParameters depthSensorOf(const Stage& stage, std::size_t camera);

/// Seed of the noise: the scene's plus the request's, modulo 2^64.
std::uint64_t noiseSeed(const LayerRequest& request, const Stage& stage);
NoiseKey noiseKey(const LayerRequest& request, const Stage& stage, const Job& job);

/// What Layer::noise() is of a noisy layer: the seed, and the cameras of the plan without a sensor of their own.
std::vector<std::pair<std::string, std::string>> describeNoise(const WorkPlan& plan, const Stage& stage,
  const std::string& layer, const std::function<bool(const SensorParameters&)>& isOwn);

} // namespace dgtk

#endif
