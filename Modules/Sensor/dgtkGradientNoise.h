// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGradientNoise_h
#define dgtkGradientNoise_h

#include "dgtkRandom.h"
#include "dgtkSensorModule.h"
#include "dgtkSensorParameters.h"

namespace dgtk::sensor
{

/// Sum of octaves of gradient noise (Perlin, "An image synthesizer", SIGGRAPH 1985; fade and fixed gradients as in
/// "Improving noise", SIGGRAPH 2002); the gradients, 8 directions of length sqrt(2), are drawn by the counter. An
/// octave of amplitude 1 lies in [-1, 1] and has mean 0.
class DGTKSENSOR_EXPORT GradientNoise
{
public:
  GradientNoise(const TextureParameters& parameters, const CounterRandom& random)
    : Parameters(parameters)
    , Random(random)
  {
  }
  bool none() const { return this->Parameters.amplitude == 0; }
  double at(int x, int y) const; ///< at the centre of a pixel

private:
  double octave(double u, double v, std::uint32_t draw) const;
  TextureParameters Parameters;
  CounterRandom Random;
};

} // namespace dgtk::sensor

#endif
