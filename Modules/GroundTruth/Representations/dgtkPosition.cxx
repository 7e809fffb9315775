// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

namespace dgtk
{

namespace
{
class Position final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "position", PixelType::Float64, 3, "scene units", "world", "nan", "surface point at the pixel's centre",
      Meaning::Point };
  }
  std::vector<std::string> formats() const override { return { "npy", "exr" }; }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    const PixelRays rays(in);
    const Rigid3 world_from_camera = in.view->camera_from_world.inverse();
    forSurface<double, 3>(in, out, std::numeric_limits<double>::quiet_NaN(),
      [&](std::size_t i, int x, int y, double* value)
      {
        Eigen::Map<Eigen::Vector3d> point(value);
        point = world_from_camera * rays.point(x, y, in.t[i]);
      });
  }
};
} // namespace

std::unique_ptr<Representation> makePosition();
std::unique_ptr<Representation> makePosition() { return std::make_unique<Position>(); }

} // namespace dgtk
