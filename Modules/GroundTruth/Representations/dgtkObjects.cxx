// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

namespace dgtk
{

namespace
{
class Objects final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "objects", PixelType::UInt32, 1, "id", "", "0",
      "object at the pixel's centre, 1 to N in the order of the scene", Meaning::Id };
  }
  std::vector<std::string> formats() const override { return { "ppm", "png", "npy" }; }
  std::uint32_t largest(const SceneState& state) const override { return std::uint32_t(state.objects()); }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    forSurface<std::uint32_t, 1>(in, out, 0u,
      [&](std::size_t i, int, int, std::uint32_t* value) { *value = in.state->objectOf(in.hits[i].object); });
  }
};
} // namespace

std::unique_ptr<Representation> makeObjects();
std::unique_ptr<Representation> makeObjects() { return std::make_unique<Objects>(); }

} // namespace dgtk
