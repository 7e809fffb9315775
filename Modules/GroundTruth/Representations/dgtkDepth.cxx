// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

#include <cstring>

namespace dgtk
{

namespace
{
class Depth final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "depth", PixelType::Float64, 1, "scene units", "camera", "+inf",
      "z in the camera frame, positive forward, of the surface at the pixel's centre", Meaning::Depth };
  }
  std::vector<std::string> formats() const override { return { "npy", "dgd", "exr", "pfm", "png" }; }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    if (in.view->model->linear())
    {
      const std::size_t bytes = std::size_t(in.rect.width) * sizeof(double);
      for (int y = 0; y < in.rect.height; ++y)
      {
        std::memcpy(out.row<double>(in.rect.y + y) + in.rect.x, in.t.data() + std::size_t(y) * in.rect.width, bytes);
      }
      return;
    }
    const PixelRays rays(in);
    forSurface<double, 1>(in, out, std::numeric_limits<double>::infinity(),
      [&](std::size_t i, int x, int y, double* value) { *value = rays.point(x, y, in.t[i]).z(); });
  }
};
} // namespace

std::unique_ptr<Representation> makeDepth();
std::unique_ptr<Representation> makeDepth() { return std::make_unique<Depth>(); }

} // namespace dgtk
