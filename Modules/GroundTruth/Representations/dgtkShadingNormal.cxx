// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCofactors.h"
#include "dgtkSurfaceLoop.h"

#include <Eigen/Geometry>

namespace dgtk
{

namespace
{
/// What the corners of a triangle have, camera frame.
struct CornerNormals
{
  Eigen::Vector3d outward; ///< normal of the triangle, of its front where nothing mirrors
  Eigen::Vector3d corner[3];
};

class CornersOf
{
public:
  explicit CornersOf(const SurfaceRows& in)
    : In(in)
  {
  }
  CornerNormals operator()(const Hit& hit) const
  {
    const Instance& instance = this->In.state->instances[hit.object - 1];
    const Eigen::Matrix3d normals =
      cofactorsOf(this->In.view->camera_from_world.rotation * instance.world_from_object.linear);
    const auto& corners = instance.model->triangles[hit.triangle];
    const std::vector<Eigen::Vector3d>& p = instance.geometry->positions;
    CornerNormals result;
    result.outward =
      (normals * (p[corners[1]] - p[corners[0]]).cross(p[corners[2]] - p[corners[0]])).stableNormalized();
    for (int k = 0; k < 3; ++k)
    {
      // a corner's normal has unit length in the model, where shading interpolates
      result.corner[k] = normals * instance.geometry->normals[corners[k]].cast<double>();
    }
    return result;
  }

private:
  const SurfaceRows& In;
};

class ShadingNormal final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "shadingnormal", PixelType::Float64, 3, "1", "camera", "nan",
      "unit normal that the vertices' normals interpolate to, turned around where the triangle is seen from behind",
      Meaning::Direction };
  }
  std::vector<std::string> formats() const override { return { "npy", "exr" }; }
  bool needsBarycentrics() const override { return true; }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    const PixelRays rays(in);
    auto cornersOf = cachePerTriangle<CornerNormals>(CornersOf(in));
    forSurface<double, 3>(in, out, std::numeric_limits<double>::quiet_NaN(),
      [&](std::size_t i, int x, int y, double* value)
      {
        const CornerNormals& normals = cornersOf(in.hits[i]);
        const double second = in.barycentrics[2 * i];
        const double third = in.barycentrics[2 * i + 1];
        Eigen::Vector3d normal =
          (1 - second - third) * normals.corner[0] + second * normals.corner[1] + third * normals.corner[2];
        normal = normal.squaredNorm() > 0 ? normal.stableNormalized() : normals.outward;
        const double side = normals.outward.dot(rays.direction(x, y)) > 0 ? -1 : 1;
        Eigen::Map<Eigen::Vector3d> target(value);
        target = side * normal;
      });
  }
};
} // namespace

std::unique_ptr<Representation> makeShadingNormal();
std::unique_ptr<Representation> makeShadingNormal() { return std::make_unique<ShadingNormal>(); }

} // namespace dgtk
