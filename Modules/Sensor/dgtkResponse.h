// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkResponse_h
#define dgtkResponse_h

#include "dgtkNoiseKey.h"
#include "dgtkSensorParameters.h"

#include <vector>

namespace dgtk::sensor
{

/// Response curve, then salt and pepper.
class Response
{
public:
  Response(const ColorSensorParameters& parameters, const NoiseKey& key)
    : Parameters(parameters)
    , Random(key.random(NoiseKey::SaltAndPepper))
  {
  }
  /// Row y, 3 values a pixel in [0, 1], in place.
  void apply(int y, std::vector<float>& rgb) const;

private:
  double curve(double v) const;
  ColorSensorParameters Parameters;
  CounterRandom Random;
};

} // namespace dgtk::sensor

#endif
