// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

#include <Eigen/Geometry>

namespace dgtk
{

namespace
{

/// Of either side, camera frame. From differences of vertices: the place of the object does not round it.
Eigen::Vector3d unitNormal(const SurfaceRows& in, const Hit& hit)
{
  const Instance& instance = in.state->instances[hit.object - 1];
  const auto& corners = instance.model->triangles[hit.triangle];
  const std::vector<Eigen::Vector3d>& p = instance.geometry->positions;
  const Eigen::Matrix3d camera_from_object = in.view->camera_from_world.rotation * instance.world_from_object.linear;
  const Eigen::Vector3d e1 = camera_from_object * (p[corners[1]] - p[corners[0]]);
  const Eigen::Vector3d e2 = camera_from_object * (p[corners[2]] - p[corners[0]]);
  return e1.cross(e2).stableNormalized();
}

class Normal final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "normal", PixelType::Float32, 3, "1", "camera", "nan",
      "unit normal of the triangle at the pixel's centre, on the side of the camera" };
  }
  std::vector<std::string> formats() const override { return { "npy", "exr" }; }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    const PixelRays rays(*in.view->model);
    auto normalOf = cachePerTriangle<Eigen::Vector3d>([&](const Hit& hit) { return unitNormal(in, hit); });
    forSurface<float, 3>(in, out, std::numeric_limits<float>::quiet_NaN(),
      [&](std::size_t i, int x, int y, float* value)
      {
        const Eigen::Vector3d& normal = normalOf(in.hits[i]);
        const double side = normal.dot(rays.point(x, y, in.t[i]) - rays.point(x, y, 0)) > 0 ? -1 : 1;
        for (int k = 0; k < 3; ++k)
        {
          value[k] = static_cast<float>(side * normal[k]);
        }
      });
  }
};
} // namespace

std::unique_ptr<Representation> makeNormal();
std::unique_ptr<Representation> makeNormal() { return std::make_unique<Normal>(); }

} // namespace dgtk
