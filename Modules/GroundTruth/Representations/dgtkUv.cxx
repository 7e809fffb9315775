// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

namespace dgtk
{

namespace
{
class Uv final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "uv", PixelType::Float64, 2, "1", "", "nan",
      "texture coordinates at the pixel's centre, (0, 0) the lower left corner of the picture; none for surfaces "
      "without",
      Meaning::TextureCoordinates };
  }
  std::vector<std::string> formats() const override { return { "npy", "exr" }; }
  bool needsBarycentrics() const override { return true; }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    forSurface<double, 2>(in, out, none,
      [&](std::size_t i, int, int, double* value)
      {
        const Model& model = *in.state->instances[in.hits[i].object - 1].model;
        if (!model.hasUvs(in.hits[i].triangle))
        {
          value[0] = value[1] = none;
          return;
        }
        const auto& corners = model.triangles[in.hits[i].triangle];
        const Eigen::Vector2d& first = model.uvs[corners[0]];
        Eigen::Map<Eigen::Vector2d> uv(value);
        uv = first + in.barycentrics[2 * i] * (model.uvs[corners[1]] - first) +
             in.barycentrics[2 * i + 1] * (model.uvs[corners[2]] - first);
      });
  }
};
} // namespace

std::unique_ptr<Representation> makeUv();
std::unique_ptr<Representation> makeUv() { return std::make_unique<Uv>(); }

} // namespace dgtk
