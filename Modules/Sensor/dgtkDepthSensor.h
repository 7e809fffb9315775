// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDepthSensor_h
#define dgtkDepthSensor_h

#include "dgtkSensorModule.h"

#include "dgtkNoiseKey.h"
#include "dgtkSensorParameters.h"

#include <functional>
#include <memory>

namespace dgtk
{

class ThreadPool;

/// One depth picture and the sensor that sees it.
struct DepthSensorSetup
{
  DepthSensorParameters parameters;
  int width = 0;
  int height = 0;
  NoiseKey key;
  double focalLength = 0; ///< fx, pixels; needed with a stereo baseline only
};

/// Standard deviation of the depth of a structured-light camera, metres, at z metres and `angle` radians between normal
/// and ray: 0.0012 + 0.0019 (z - 0.4)^2, from 60 degrees on + 0.0001 / sqrt(z) angle^2 / (pi/2 - angle)^2, the angle
/// held at 85 degrees (Nguyen, Izadi and Lovell, "Modeling Kinect sensor noise for improved 3D reconstruction and
/// tracking", 3DIMPVT 2012).
DGTKSENSOR_EXPORT double kinectAxialSigma(double z, double angle);
/// Standard deviation across the image, pixels: 0.8 + 0.035 angle / (pi/2 - angle), of the same paper and held
/// likewise.
DGTKSENSOR_EXPORT double kinectLateralSigma(double angle);

/// Turns a stream of exact depth rows into what a depth camera measures. Memory and independence as ImageSensor.
class DGTKSENSOR_EXPORT DepthSensor
{
public:
  /// Receives row y, top to bottom: depth, +inf where there is none.
  using Sink = std::function<void(int y, const double* depth)>;

  /// Throws UsageError for a stereo baseline without a focal length.
  DepthSensor(const DepthSensorSetup& setup, Sink sink, ThreadPool* pool = nullptr);
  ~DepthSensor();
  DepthSensor(const DepthSensor&) = delete;
  DepthSensor& operator=(const DepthSensor&) = delete;

  /// The next `rows` rows, top to bottom: depth (scene units, +inf for none) and the cosine, in [0, 1], of the angle
  /// between surface normal and ray.
  void write(int rows, const double* depth, const float* cosine);

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
