// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDisjointSets_h
#define dgtkDisjointSets_h

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace dgtk
{

/// Sets of 0 to n - 1, at first each of one number, that are joined two by two.
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t n)
    : Parent(n)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), 0u);
  }
  /// The number that stands for the set of i.
  std::uint32_t find(std::uint32_t i)
  {
    while (this->Parent[i] != i)
    {
      i = this->Parent[i] = this->Parent[this->Parent[i]];
    }
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { this->Parent[this->find(a)] = this->find(b); }

private:
  std::vector<std::uint32_t> Parent;
};

} // namespace dgtk

#endif
