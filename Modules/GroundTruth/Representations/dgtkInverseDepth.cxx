// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

namespace dgtk
{

namespace
{
class InverseDepth final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "inversedepth", PixelType::Float64, 1, "1 / scene units", "camera", "0",
      "1 / z in the camera frame of the surface at the pixel's centre", Meaning::InverseDepth };
  }
  std::vector<std::string> formats() const override { return { "npy", "exr", "pfm" }; }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    const PixelRays rays(in);
    forSurface<double, 1>(
      in, out, 0.0, [&](std::size_t i, int x, int y, double* value) { *value = 1 / rays.point(x, y, in.t[i]).z(); });
  }
};
} // namespace

std::unique_ptr<Representation> makeInverseDepth();
std::unique_ptr<Representation> makeInverseDepth() { return std::make_unique<InverseDepth>(); }

} // namespace dgtk
