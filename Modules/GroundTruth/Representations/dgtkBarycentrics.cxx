// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

namespace dgtk
{

namespace
{
class Barycentrics final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "barycentrics", PixelType::Float64, 3, "1", "", "nan",
      "weights of the three corners of the triangle at the pixel's centre, in the order of the model, sum 1",
      Meaning::Weights };
  }
  std::vector<std::string> formats() const override { return { "npy", "exr" }; }
  bool needsBarycentrics() const override { return true; }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    forSurface<double, 3>(in, out, std::numeric_limits<double>::quiet_NaN(),
      [&](std::size_t i, int, int, double* value)
      {
        value[1] = in.barycentrics[2 * i];
        value[2] = in.barycentrics[2 * i + 1];
        value[0] = 1 - value[1] - value[2];
      });
  }
};
} // namespace

std::unique_ptr<Representation> makeBarycentrics();
std::unique_ptr<Representation> makeBarycentrics() { return std::make_unique<Barycentrics>(); }

} // namespace dgtk
