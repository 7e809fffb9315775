// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkBoxTree_h
#define dgtkBoxTree_h

#include <Eigen/Geometry>

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace dgtk
{

/// Boxes in double precision, for rays that single precision cannot follow.
class BoxTree
{
public:
  BoxTree() = default;
  /// Those that are empty or not finite are never met.
  explicit BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes);

  /// Around all boxes; empty when there are none.
  Eigen::AlignedBox3d box() const { return this->Nodes.empty() ? Eigen::AlignedBox3d() : this->Nodes[0].box; }

  /// Calls `visit` with the number of every box that a ray may meet, about near to far. `enter`: where it enters a box,
  /// infinity when it does not. What it enters beyond `most`, which may shrink on the way, is left out.
  template <typename Enter, typename Visit>
  void walk(const double& most, const Enter& enter, const Visit& visit) const
  {
    std::pair<double, std::uint32_t> open[mostOpen];
    int count = 0;
    const auto push = [&](double entry, std::uint32_t node)
    {
      if (entry <= most && entry < std::numeric_limits<double>::infinity())
      {
        open[count++] = { entry, node };
      }
    };
    if (!this->Nodes.empty())
    {
      push(enter(this->Nodes[0].box), 0);
    }
    while (count > 0)
    {
      const auto [entry, index] = open[--count];
      const Node& node = this->Nodes[index];
      if (entry > most)
      {
        continue;
      }
      for (std::uint32_t i = node.first; i < node.last; ++i)
      {
        visit(this->Items[i]);
      }
      if (node.second != 0)
      {
        const double first = enter(this->Nodes[index + 1].box);
        const double second = enter(this->Nodes[node.second].box);
        push(first < second ? second : first, first < second ? node.second : index + 1);
        push(first < second ? first : second, first < second ? index + 1 : node.second);
      }
    }
  }

private:
  struct Node
  {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0; ///< of Items, of a leaf
    std::uint32_t last = 0;
    std::uint32_t second = 0; ///< node; the other child is the next one; 0 for a leaf
  };
  static constexpr int mostOpen = 64; ///< halves of halves
  std::uint32_t build(const std::vector<Eigen::AlignedBox3d>& boxes, std::uint32_t first, std::uint32_t last);

  std::vector<Node> Nodes;
  std::vector<std::uint32_t> Items;
};

} // namespace dgtk

#endif
