// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

#include <Eigen/Geometry>

#include <cmath>

namespace dgtk
{

namespace
{

/// Unit normals of triangles, of either side, camera frame. From differences of vertices: the place of the object does
/// not round them.
class UnitNormal
{
public:
  explicit UnitNormal(const SurfaceRows& in)
    : In(in)
  {
  }
  Eigen::Vector3d operator()(const Hit& hit)
  {
    const Instance& instance = this->In.state->instances[hit.object - 1];
    if (hit.object != this->Object)
    {
      this->Object = hit.object;
      this->CameraFromObject = this->In.view->camera_from_world.rotation * instance.world_from_object.linear;
    }
    const auto& corners = instance.model->triangles[hit.triangle];
    const std::vector<Eigen::Vector3d>& p = instance.geometry->positions;
    const Eigen::Vector3d e1 = this->CameraFromObject * (p[corners[1]] - p[corners[0]]);
    const Eigen::Vector3d e2 = this->CameraFromObject * (p[corners[2]] - p[corners[0]]);
    const Eigen::Vector3d normal = e1.cross(e2);
    const double square = normal.squaredNorm();
    constexpr double safe = 1e-280; // farther down squares lose their digits
    return square > safe && square < 1 / safe ? Eigen::Vector3d(normal / std::sqrt(square)) : normal.stableNormalized();
  }

private:
  const SurfaceRows& In;
  std::uint32_t Object = 0;
  Eigen::Matrix3d CameraFromObject = Eigen::Matrix3d::Identity();
};

class Normal final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "normal", PixelType::Float32, 3, "1", "camera", "nan",
      "unit normal of the triangle at the pixel's centre, on the side of the camera", Meaning::Direction };
  }
  std::vector<std::string> formats() const override { return { "npy", "exr" }; }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    const PixelRays rays(in);
    auto normalOf = cachePerTriangle<Eigen::Vector3d>(UnitNormal(in));
    forSurface<float, 3>(in, out, std::numeric_limits<float>::quiet_NaN(),
      [&](std::size_t i, int x, int y, float* value)
      {
        const Eigen::Vector3d& normal = normalOf(in.hits[i]);
        const double side = normal.dot(rays.direction(x, y)) > 0 ? -1 : 1;
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
