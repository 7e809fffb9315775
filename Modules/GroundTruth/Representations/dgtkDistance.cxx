// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

namespace dgtk
{

namespace
{
class Distance final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "distance", PixelType::Float64, 1, "scene units", "", "+inf",
      "Euclidean distance of the surface at the pixel's centre from the camera centre", Meaning::Distance };
  }
  std::vector<std::string> formats() const override { return { "npy", "exr", "pfm" }; }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    const PixelRays rays(in);
    forSurface<double, 1>(in, out, std::numeric_limits<double>::infinity(),
      [&](std::size_t i, int x, int y, double* value) { *value = rays.point(x, y, in.t[i]).norm(); });
  }
};
} // namespace

std::unique_ptr<Representation> makeDistance();
std::unique_ptr<Representation> makeDistance() { return std::make_unique<Distance>(); }

} // namespace dgtk
