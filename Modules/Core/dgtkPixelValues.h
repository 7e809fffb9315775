// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPixelValues_h
#define dgtkPixelValues_h

#include "dgtkLayer.h"

namespace dgtk
{

/// Calls `act` with a number of the C++ type that `type` names, for code that is the same for all of them.
template <typename Act>
auto withPixelType(PixelType type, const Act& act)
{
  switch (type)
  {
    case PixelType::UInt8: // NOLINT(bugprone-branch-clone): the branches differ in what they call
      return act(std::uint8_t());
    case PixelType::UInt16:
      return act(std::uint16_t());
    case PixelType::UInt32:
      return act(std::uint32_t());
    case PixelType::Float32:
      return act(float());
    case PixelType::Float64:
      break;
  }
  return act(double());
}

/// One channel of a pixel as a number.
inline double valueAt(const Rows& rows, int x, int y, int channel = 0)
{
  const std::size_t i = std::size_t(x) * rows.channels() + channel;
  return withPixelType(rows.type(), [&](auto type) { return double(rows.row<decltype(type)>(y)[i]); });
}

/// An id per pixel of a layer of ids, whatever its file; 24 bits of R, G, B where it has three channels.
inline std::uint32_t idAt(const Rows& rows, int x, int y)
{
  if (rows.type() == PixelType::UInt8 && rows.channels() == 3) // what they usually are
  {
    const std::uint8_t* const pixel = rows.row<std::uint8_t>(y) + 3 * std::size_t(x);
    return std::uint32_t(pixel[0]) << 16 | std::uint32_t(pixel[1]) << 8 | pixel[2];
  }
  const auto channel = [&](int c) { return static_cast<std::uint32_t>(valueAt(rows, x, y, c)); };
  return rows.channels() >= 3 ? channel(0) << 16 | channel(1) << 8 | channel(2) : channel(0);
}

/// `count` channels from the first of pixel (x, y) on as numbers.
inline void copyValues(const Rows& rows, int x, int y, std::size_t count, double* to)
{
  withPixelType(rows.type(),
    [&](auto type)
    {
      const auto* const from = rows.row<decltype(type)>(y) + std::size_t(x) * rows.channels();
      for (std::size_t i = 0; i < count; ++i)
      {
        to[i] = double(from[i]);
      }
    });
}

} // namespace dgtk

#endif
