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
