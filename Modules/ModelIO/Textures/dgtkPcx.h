// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPcx_h
#define dgtkPcx_h

#include <cstddef>
#include <cstdint>
#include <string>

namespace dgtk
{

extern const char* const pcxCutShort;

/// A PCX picture in memory: run-length coded, 8 bits with a palette of 256 colours, or 24 bits in three planes.
class PcxPicture
{
public:
  /// `data` has to outlive the object.
  PcxPicture(const std::uint8_t* data, std::size_t bytes, int largestSide);
  /// Why it cannot be decoded: it is something else, or has more than `largestSide` pixels a side. Empty when it can.
  const std::string& problem() const { return this->Problem; }
  std::size_t width() const { return this->Width; }
  std::size_t height() const { return this->Height; }
  /// Writes width() * height() pixels, R, G, B, rows top to bottom. False where the file lacks some (pcxCutShort).
  bool decode(std::uint8_t* rgb) const;

private:
  const std::uint8_t* Data;
  std::size_t Bytes;
  std::size_t Planes = 0;
  std::size_t LineBytes = 0;
  std::size_t Width = 0;
  std::size_t Height = 0;
  std::string Problem;
};

} // namespace dgtk

#endif
