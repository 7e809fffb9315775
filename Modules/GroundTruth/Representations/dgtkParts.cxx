// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

namespace dgtk
{

namespace
{
class Parts final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "parts", PixelType::UInt32, 1, "id", "", "4294967295",
      "part within the object at the pixel's centre, from 0 in file order", Meaning::Index };
  }
  std::vector<std::string> formats() const override { return { "npy", "png" }; }
  std::uint32_t largest(const SceneState& state) const override
  {
    std::size_t most = 1;
    for (const Instance& instance : state.instances)
    {
      most = std::max(most, instance.firstPart + instance.model->parts.size());
    }
    return std::uint32_t(most - 1);
  }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    PartLookup parts(*in.state);
    forSurface<std::uint32_t, 1>(
      in, out, noId, [&](std::size_t i, int, int, std::uint32_t* value) { *value = parts.part(in.hits[i]); });
  }
};
} // namespace

std::unique_ptr<Representation> makeParts();
std::unique_ptr<Representation> makeParts() { return std::make_unique<Parts>(); }

} // namespace dgtk
