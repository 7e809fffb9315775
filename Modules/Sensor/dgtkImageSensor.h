// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkImageSensor_h
#define dgtkImageSensor_h

#include "dgtkSensorModule.h"

#include "dgtkNoiseKey.h"
#include "dgtkSensorParameters.h"

#include <functional>
#include <memory>

namespace dgtk
{

class ThreadPool;

/// The colour sensor of a camera that does not say one: a small industrial camera in good light.
DGTKSENSOR_EXPORT ColorSensorParameters defaultColorSensor();
/// The depth sensor of a camera that does not say one: a structured-light camera in a scene in metres.
DGTKSENSOR_EXPORT DepthSensorParameters defaultDepthSensor();

/// One picture and the sensor that sees it.
struct ImageSensorSetup
{
  ColorSensorParameters parameters;
  int width = 0;
  int height = 0;
  NoiseKey key;
  /// Cosine of the angle between the optical axis and the ray through the centre of pixel (x, y); empty: 1.
  /// Thread-safe.
  std::function<double(int x, int y)> fieldCosine;
};

/// Turns a stream of rows into what the sensor makes of them, in the order of Documentation/Formats/sensor.md. Memory
/// is bounded by the rows given at once and the halo of the effects; the result does not depend on how rows are grouped
/// nor on the pool.
class DGTKSENSOR_EXPORT ImageSensor
{
public:
  /// Receives rows [y, y + height) top to bottom, 3 values a pixel in [0, 1] as the camera gives them out.
  using Sink = std::function<void(int y, int height, const float* rgb)>;

  /// `pool`, which may be null, shares the work; it must outlive this.
  ImageSensor(const ImageSensorSetup& setup, Sink sink, ThreadPool* pool = nullptr);
  ~ImageSensor();
  ImageSensor(const ImageSensor&) = delete;
  ImageSensor& operator=(const ImageSensor&) = delete;

  /// The next `rows` rows, top to bottom, 3 values a pixel: sRGB-encoded, [0, 1]. With the last row of the image the
  /// sink has everything.
  void write(int rows, const float* rgb);

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
