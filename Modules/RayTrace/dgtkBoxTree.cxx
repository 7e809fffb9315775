// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkBoxTree.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr std::uint32_t mostInLeaf = 4;
}

BoxTree::BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes)
{
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
  {
    if (!boxes[i].isEmpty() && boxes[i].min().allFinite() && boxes[i].max().allFinite())
    {
      this->Items.push_back(i);
    }
  }
  if (!this->Items.empty())
  {
    this->build(boxes, 0, std::uint32_t(this->Items.size()));
  }
}

std::uint32_t BoxTree::build(const std::vector<Eigen::AlignedBox3d>& boxes, std::uint32_t first, std::uint32_t last)
{
  const auto index = std::uint32_t(this->Nodes.size());
  this->Nodes.emplace_back();
  Node node{ {}, first, last, 0 };
  Eigen::AlignedBox3d centres;
  for (std::uint32_t i = first; i < last; ++i)
  {
    const Eigen::AlignedBox3d& box = boxes[this->Items[i]];
    node.box.extend(box);
    centres.extend(box.center());
  }
  if (last - first > mostInLeaf)
  {
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const std::uint32_t middle = first + (last - first) / 2;
    const auto items = this->Items.begin();
    std::nth_element(items + first, items + middle, items + last,
      [&](std::uint32_t a, std::uint32_t b) { return boxes[a].center()[axis] < boxes[b].center()[axis]; });
    node.first = node.last = 0;
    this->build(boxes, first, middle);
    node.second = this->build(boxes, middle, last);
  }
  this->Nodes[index] = node;
  return index;
}

} // namespace dgtk
