// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSensorDescription.h"

#include <cmath>
#include <numeric>

namespace dgtk::scenefile
{

namespace
{
constexpr std::size_t largestKernel = 65; // pixels a side

bool isKernel(const std::vector<double>& kernel)
{
  const auto side = static_cast<std::size_t>(std::sqrt(double(kernel.size())) + 0.5);
  return side * side == kernel.size() && side % 2 == 1 && side <= largestKernel &&
         std::accumulate(kernel.begin(), kernel.end(), 0.0) > 0;
}
} // namespace

std::string faultOf(const ColorSensorParameters& sensor)
{
  const PointSpreadParameters& psf = sensor.psf;
  if ((psf.gaussian > 0 ? 1 : 0) + (psf.disc > 0 ? 1 : 0) + (psf.kernel.empty() ? 0 : 1) > 1)
  {
    return "psf: one of gaussian, disc and kernel";
  }
  if (!psf.kernel.empty() && !isKernel(psf.kernel))
  {
    return "psf.kernel: n * n numbers, n odd and at most 65, not all 0";
  }
  if (sensor.response == ResponseCurve::Table && sensor.table.size() < 2)
  {
    return "table: at least two numbers beside the response table";
  }
  if (sensor.salt + sensor.pepper > 1)
  {
    return "salt and pepper: together at most 1";
  }
  return {};
}

std::string faultOf(const DepthSensorParameters& sensor)
{
  if (sensor.most != 0 && !(sensor.most > sensor.least))
  {
    return "most: 0, or more than least";
  }
  if (sensor.stereo.baseline == 0 &&
      (sensor.stereo.subpixel > 0 || sensor.stereo.sigma > 0 || sensor.dropout.occluded > 0))
  {
    return "stereo.baseline: above 0 beside subpixel, sigma and dropout.occluded";
  }
  return {};
}

} // namespace dgtk::scenefile
