// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDrawOrder.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace dgtk
{
namespace
{

bool meet(const ViewBox& a, const ViewBox& b)
{
  return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

/// For each box the later ones that meet it, and for each how many earlier ones do: a sweep along x.
struct Meetings
{
  explicit Meetings(const std::vector<ViewBox>& boxes)
    : later(boxes.size())
    , earlier(boxes.size(), 0)
  {
    std::vector<std::size_t> byStart(boxes.size());
    std::iota(byStart.begin(), byStart.end(), std::size_t(0));
    std::sort(byStart.begin(), byStart.end(),
      [&](std::size_t a, std::size_t b)
      { return boxes[a].min.x() != boxes[b].min.x() ? boxes[a].min.x() < boxes[b].min.x() : a < b; });
    std::vector<std::size_t> open;
    for (const std::size_t i : byStart)
    {
      open.erase(std::remove_if(
                   open.begin(), open.end(), [&](std::size_t j) { return !(boxes[j].max.x() >= boxes[i].min.x()); }),
        open.end());
      for (const std::size_t j : open)
      {
        if (meet(boxes[i], boxes[j]))
        {
          this->later[std::min(i, j)].push_back(std::max(i, j));
          ++this->earlier[std::max(i, j)];
        }
      }
      open.push_back(i);
    }
  }
  std::vector<std::vector<std::size_t>> later;
  std::vector<std::size_t> earlier;
};

} // namespace

std::vector<std::size_t> drawOrder(const std::vector<ViewBox>& boxes)
{
  Meetings meetings(boxes);
  using Ready = std::pair<double, std::size_t>; // distance along the view and index
  std::priority_queue<Ready, std::vector<Ready>, std::greater<>> ready;
  const auto add = [&](std::size_t i) { ready.emplace(-boxes[i].max.z(), i); };
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    if (meetings.earlier[i] == 0)
    {
      add(i);
    }
  }
  std::vector<std::size_t> order;
  order.reserve(boxes.size());
  while (!ready.empty())
  {
    const std::size_t i = ready.top().second;
    ready.pop();
    order.push_back(i);
    for (const std::size_t j : meetings.later[i])
    {
      if (--meetings.earlier[j] == 0)
      {
        add(j);
      }
    }
  }
  return order;
}

} // namespace dgtk
