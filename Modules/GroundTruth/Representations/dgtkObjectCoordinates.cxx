// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

namespace dgtk
{

namespace
{
class ObjectCoordinates final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "objectcoords", PixelType::Float64, 3, "object units", "object", "nan",
      "surface point at the pixel's centre in the frame of its object, before placement and scale", Meaning::Point };
  }
  std::vector<std::string> formats() const override { return { "npy", "exr" }; }
  bool needsBarycentrics() const override { return true; }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    forSurface<double, 3>(in, out, std::numeric_limits<double>::quiet_NaN(),
      [&](std::size_t i, int, int, double* value)
      {
        const Instance& instance = in.state->instances[in.hits[i].object - 1];
        const auto& corners = instance.model->triangles[in.hits[i].triangle];
        const std::vector<Eigen::Vector3d>& p = instance.geometry->positions;
        const Eigen::Vector3d& first = p[corners[0]];
        Eigen::Map<Eigen::Vector3d> point(value);
        point = first + in.barycentrics[2 * i] * (p[corners[1]] - first) +
                in.barycentrics[2 * i + 1] * (p[corners[2]] - first);
        if (instance.copyOf != 0)
        {
          point = (instance.object_from_model * Eigen::Vector3d(point)).eval();
        }
      });
  }
};
} // namespace

std::unique_ptr<Representation> makeObjectCoordinates();
std::unique_ptr<Representation> makeObjectCoordinates() { return std::make_unique<ObjectCoordinates>(); }

} // namespace dgtk
