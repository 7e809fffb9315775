// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

#include <map>

namespace dgtk
{

std::vector<std::uint32_t> classIds(const SceneState& state)
{
  std::map<std::string, std::uint32_t> known;
  std::vector<std::uint32_t> ids;
  for (const Instance& instance : state.instances)
  {
    ids.push_back(known.emplace(instance.className, std::uint32_t(known.size() + 1)).first->second);
  }
  return ids;
}

namespace
{
class Classes final : public Representation
{
public:
  LayerSpec spec() const override
  {
    return { "classes", PixelType::UInt32, 1, "id", "", "0",
      "class of the object, class_id of objects.json; 0 for the background" };
  }
  std::vector<std::string> formats() const override { return { "png", "npy" }; }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    const std::vector<std::uint32_t> ids = classIds(*in.state);
    forSurface<std::uint32_t, 1>(
      in, out, 0u, [&](std::size_t i, int, int, std::uint32_t* value) { *value = ids[in.hits[i].object - 1]; });
  }
};
} // namespace

std::unique_ptr<Representation> makeClasses();
std::unique_ptr<Representation> makeClasses() { return std::make_unique<Classes>(); }

} // namespace dgtk
