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

/// An id from the channels of its pixel as numbers: 24 bits of R, G, B where there are three or more.
inline std::uint32_t idOf(const double* values, std::size_t channels)
{
  return static_cast<std::uint32_t>(channels >= 3 ? values[0] * 65536 + values[1] * 256 + values[2] : values[0]);
}

/// The id of a pixel of a layer of ids, whatever its file.
inline std::uint32_t idAt(const Rows& rows, int x, int y)
{
  if (rows.type() == PixelType::UInt8 && rows.channels() == 3) // what they usually are
  {
    const std::uint8_t* const pixel = rows.row<std::uint8_t>(y) + 3 * std::size_t(x);
    return std::uint32_t(pixel[0]) << 16 | std::uint32_t(pixel[1]) << 8 | pixel[2];
  }
  double values[3] = { 0, 0, 0 };
  const auto channels = std::size_t(rows.channels());
  copyValues(rows, x, y, channels < 3 ? channels : 3, values);
  return idOf(values, channels);
}

} // namespace dgtk

#endif
