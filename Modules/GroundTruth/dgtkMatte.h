// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMatte_h
#define dgtkMatte_h

#include "dgtkGroundTruthModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dgtk
{

/// Values of a trimap.
constexpr std::uint8_t trimapBackground = 0;
constexpr std::uint8_t trimapUnknown = 128;
constexpr std::uint8_t trimapForeground = 255;

/// 16-bit pictures of a matte from `pixels` pixels: foreground (3 a pixel, mean colour of the `count` samples that show
/// the object), background (3 a pixel) and alpha = count / samples^2 are rounded first; composite = alpha foreground +
/// (1 - alpha) background is computed from the rounded values, and rounded. Colours are clamped to [0, 1].
DGTKGROUNDTRUTH_EXPORT void composeMatte(const std::uint16_t* count, const float* foreground, const float* background,
  int samples, std::size_t pixels, std::uint16_t* foreground16, std::uint16_t* background16, std::uint16_t* alpha16,
  std::uint16_t* composite16);

/// The trimap of an object: foreground and background where all pixels within `Band` columns and rows are wholly so
/// (eroded by squares), unknown between.
class DGTKGROUNDTRUTH_EXPORT Matte
{
public:
  static constexpr int band = 2; ///< pixels

  Matte(int width, int samples)
    : Width(width)
    , Full(static_cast<std::uint16_t>(samples * samples))
  {
  }
  /// The next rows from the top; `count` as in composeMatte().
  void addRows(const std::uint16_t* count, int rows);
  int width() const { return this->Width; }
  int height() const { return static_cast<int>(this->Values.size() / static_cast<std::size_t>(this->Width)); }
  /// A row of the trimap of all rows added.
  void trimapRow(int y, std::uint8_t* row) const;

private:
  int Width;
  std::uint16_t Full;
  std::vector<std::uint8_t> Values; ///< of the pixel alone
};

} // namespace dgtk

#endif
