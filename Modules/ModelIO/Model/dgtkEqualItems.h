// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEqualItems_h
#define dgtkEqualItems_h

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace dgtk
{

/// Finds which of the items 0, 1, 2, ... are equal: open addressing with linear probing.
class EqualItems
{
public:
  /// For at most `items` items.
  explicit EqualItems(std::size_t items)
  {
    std::size_t size = 16;
    while (size < items + items / 4)
    {
      size *= 2;
    }
    this->Slots.assign(size, none);
  }

  /// The first of the items given so far that is equal to this one, or itself. Where too many others are in the way,
  /// which files made for that purpose achieve, it is itself.
  template <class Equal>
  std::uint32_t find(std::uint32_t item, std::uint64_t hash, const Equal& equal)
  {
    const std::size_t mask = this->Slots.size() - 1;
    std::size_t at = static_cast<std::size_t>(hash) & mask;
    for (int steps = 0; steps < mostSteps && this->Slots[at] != none; ++steps, at = (at + 1) & mask)
    {
      if (equal(this->Slots[at], item))
      {
        return this->Slots[at];
      }
    }
    if (this->Slots[at] == none)
    {
      this->Slots[at] = item;
    }
    return item;
  }

private:
  static constexpr std::uint32_t none = 0xffffffffu;
  static constexpr int mostSteps = 256;
  std::vector<std::uint32_t> Slots;
};

/// Mixes a number into a hash. Equal floating-point numbers, 0 and -0 too, have equal hashes.
template <class Number>
std::uint64_t mixed(std::uint64_t hash, Number value)
{
  static_assert(sizeof value == 4 || sizeof value == 8);
  const Number positive = value + Number(0);
  std::conditional_t<sizeof value == 4, std::uint32_t, std::uint64_t> bits = 0;
  std::memcpy(&bits, &positive, sizeof bits);
  hash = (hash ^ bits) * 0x9e3779b97f4a7c15ull;
  return hash ^ hash >> 29;
}

/// Of each of `count` points, given by `at(i)` with three coordinates, the first that is equal to it. Not-a-number is
/// equal to nothing.
template <class Points>
std::vector<std::uint32_t> firstOfEqualPoints(std::size_t count, const Points& at)
{
  EqualItems known(count);
  std::vector<std::uint32_t> first(count);
  const auto equal = [&at](std::uint32_t a, std::uint32_t b)
  { return at(a)[0] == at(b)[0] && at(a)[1] == at(b)[1] && at(a)[2] == at(b)[2]; };
  for (std::uint32_t i = 0; i < count; ++i)
  {
    first[i] = known.find(i, mixed(mixed(mixed(0, at(i)[0]), at(i)[1]), at(i)[2]), equal);
  }
  return first;
}

} // namespace dgtk

#endif
