// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

namespace dgtk
{

namespace
{
class Triangles final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "triangles", PixelType::UInt32, 1, "id", "", "4294967295",
      "triangle within the part at the pixel's centre, from 0 in file order", Meaning::Index };
  }
  std::vector<std::string> formats() const override { return { "npy", "png" }; }
  std::uint32_t largest(const SceneState& state) const override
  {
    std::uint32_t most = 1;
    for (const Instance& instance : state.instances)
    {
      for (const Part& part : instance.model->parts)
      {
        most = std::max(most, instance.firstInPart + part.triangles);
      }
    }
    return most - 1;
  }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    PartLookup parts(*in.state);
    forSurface<std::uint32_t, 1>(
      in, out, noId, [&](std::size_t i, int, int, std::uint32_t* value) { *value = parts.triangle(in.hits[i]); });
  }
};
} // namespace

std::unique_ptr<Representation> makeTriangles();
std::unique_ptr<Representation> makeTriangles() { return std::make_unique<Triangles>(); }

} // namespace dgtk
