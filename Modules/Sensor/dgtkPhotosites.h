// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPhotosites_h
#define dgtkPhotosites_h

#include "dgtkGradientNoise.h"
#include "dgtkImageSensor.h"

#include <vector>

namespace dgtk::sensor
{

/// From light to numbers: vignetting, texture, exposure, shot noise, fixed pattern, read noise, converter (terms of
/// EMVA 1288).
class Photosites
{
public:
  explicit Photosites(const ImageSensorSetup& setup);
  /// Row y of linear light, 3 values a pixel, becomes digital values in [0, 1]: 3 a pixel, or with a Bayer pattern the
  /// one of its photosite.
  std::vector<float> expose(int y, const std::vector<float>& light) const;

private:
  double vignetting(int x, int y) const;
  double reading(double light, int x, int y, int channel, double offset) const;
  ImageSensorSetup Setup;
  GradientNoise Texture;
  CounterRandom Shot;
  CounterRandom Fixed;
  CounterRandom RowPattern;
  CounterRandom Read;
  std::vector<double> Columns; ///< electrons
};

} // namespace dgtk::sensor

#endif
