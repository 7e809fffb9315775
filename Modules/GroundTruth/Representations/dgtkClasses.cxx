// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceLoop.h"

#include <map>

namespace dgtk
{

std::vector<std::uint32_t> classIds(const SceneState& state)
{
  std::map<std::string, std::uint32_t> known;
  std::vector<std::uint32_t> ids;
  for (std::size_t i = 0; i < state.objects(); ++i)
  {
    const Instance& instance = state.instances[i];
    const std::uint32_t next = instance.classId != 0 ? instance.classId : std::uint32_t(known.size() + 1);
    ids.push_back(known.emplace(instance.className, next).first->second);
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
      "class of the object, class_id of objects.json; 0 for the background", Meaning::Class };
  }
  std::vector<std::string> formats() const override { return { "png", "npy" }; }
  std::uint32_t largest(const SceneState& state) const override
  {
    const std::vector<std::uint32_t> ids = classIds(state);
    return ids.empty() ? 0 : *std::max_element(ids.begin(), ids.end());
  }

  void compute(const SurfaceRows& in, Rows& out) const override
  {
    const std::vector<std::uint32_t> ids = classIds(*in.state);
    forSurface<std::uint32_t, 1>(in, out, 0u,
      [&](std::size_t i, int, int, std::uint32_t* value) { *value = ids[in.state->objectOf(in.hits[i].object) - 1]; });
  }
};
} // namespace

std::unique_ptr<Representation> makeClasses();
std::unique_ptr<Representation> makeClasses() { return std::make_unique<Classes>(); }

} // namespace dgtk
