// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCutOutColors.h"

namespace dgtk
{
namespace
{

/// Fills the colours of texels with alpha below 0.5 from their neighbours, ring by ring (the picture repeats).
void dilate(std::vector<std::uint8_t>& rgba, int width, int height)
{
  std::vector<std::uint8_t> known(std::size_t(width) * height);
  std::vector<int> border;
  for (std::size_t i = 0; i < known.size(); ++i)
  {
    known[i] = rgba[i * 4 + 3] >= 128;
  }
  const auto neighbours = [width, height](int texel, int(&around)[4])
  {
    const int x = texel % width;
    const int y = texel / width;
    around[0] = y * width + (x + 1) % width;
    around[1] = y * width + (x + width - 1) % width;
    around[2] = (y + 1) % height * width + x;
    around[3] = (y + height - 1) % height * width + x;
  };
  int around[4];
  for (int i = 0; i < int(known.size()); ++i)
  {
    neighbours(i, around);
    if (!known[i] && (known[around[0]] || known[around[1]] || known[around[2]] || known[around[3]]))
    {
      border.push_back(i);
    }
  }
  while (!border.empty())
  {
    for (const int texel : border)
    {
      neighbours(texel, around);
      int sum[3] = {};
      int count = 0;
      for (const int other : around)
      {
        if (known[other] == 1)
        {
          ++count;
          for (int c = 0; c < 3; ++c)
          {
            sum[c] += rgba[std::size_t(other) * 4 + c];
          }
        }
      }
      for (int c = 0; c < 3; ++c)
      {
        rgba[std::size_t(texel) * 4 + c] = std::uint8_t((sum[c] + count / 2) / count);
      }
      known[texel] = 2; // of this ring: not yet a source
    }
    std::vector<int> next;
    for (const int texel : border)
    {
      known[texel] = 1;
    }
    for (const int texel : border)
    {
      neighbours(texel, around);
      for (const int other : around)
      {
        if (!known[other])
        {
          known[other] = 3; // in the next ring
          next.push_back(other);
        }
      }
    }
    for (const int texel : next)
    {
      known[texel] = 0;
    }
    border.swap(next);
  }
}

} // namespace

std::vector<std::uint8_t> withoutHoles(const Image& image)
{
  std::vector<std::uint8_t> filled = image.rgba;
  dilate(filled, image.width, image.height);
  return filled;
}

} // namespace dgtk
