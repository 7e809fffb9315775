// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterModels.h"

#include <limits>
#include <numeric>

namespace dgtk
{

RasterTopology rasterTopology(const Model& model, bool numbered)
{
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  const std::size_t count = model.triangles.size();
  RasterTopology result;
  result.numbered = numbered;
  result.source.resize(count);
  result.triangles.resize(count);
  std::vector<std::uint32_t> renumbered(model.rest->positions.size(), none); // vertex of the model -> vertex

  // Each triangle claims a corner that no other has claimed, or a copy of its last one.
  std::vector<std::uint8_t> claimed(count);
  for (std::size_t t = 0; t < count; ++t)
  {
    for (std::uint8_t k = 0; k < 3; ++k)
    {
      const std::uint8_t corner = std::uint8_t((k + 2) % 3);
      std::uint32_t& vertex = renumbered[model.triangles[t][corner]];
      if (vertex == none || k == 2)
      {
        claimed[t] = vertex == none ? corner : 2;
        result.source[t] = model.triangles[t][claimed[t]];
        if (vertex == none)
        {
          vertex = std::uint32_t(t);
        }
        break;
      }
    }
  }
  if (!numbered)
  {
    result.source.resize(model.rest->positions.size());
    std::iota(result.source.begin(), result.source.end(), 0u);
    for (std::size_t t = 0; t < count; ++t)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        result.triangles[t][k] = model.triangles[t][(claimed[t] + 1 + k) % 3];
      }
    }
    return result;
  }
  for (std::size_t t = 0; t < count; ++t)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::uint32_t original = model.triangles[t][(claimed[t] + 1 + k) % 3];
      if (renumbered[original] == none)
      {
        renumbered[original] = std::uint32_t(result.source.size());
        result.source.push_back(original);
      }
      result.triangles[t][k] = k == 2 ? std::uint32_t(t) : renumbered[original];
    }
  }
  return result;
}

} // namespace dgtk
