// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkByteReader_h
#define dgtkByteReader_h

#include "dgtkError.h"

#include <cstdint>
#include <cstring>
#include <string>

namespace dgtk
{

/// Little-endian values of a binary file. Reading beyond its end throws an InputError that names the offset.
class ByteReader
{
public:
  /// `bytes` must outlive the reader.
  ByteReader(const std::string& path, const std::string& bytes)
    : Path(path)
    , Bytes(bytes)
  {
  }
  std::size_t size() const { return this->Bytes.size(); }

  /// Throws unless `count` bytes of `what` lie at `offset`.
  void need(std::uint64_t offset, std::uint64_t count, const char* what) const
  {
    if (offset > this->Bytes.size() || count > this->Bytes.size() - offset)
    {
      throw InputError(this->Path,
        std::string(what) + " at byte " + std::to_string(offset) + " run past the end of the file",
        std::to_string(count) + " bytes",
        std::to_string(offset > this->Bytes.size() ? 0 : this->Bytes.size() - offset));
    }
  }
  [[noreturn]] void fail(std::uint64_t offset, const std::string& what, const std::string& expected = {},
    const std::string& found = {}) const
  {
    throw InputError(this->Path, what + " at byte " + std::to_string(offset), expected, found);
  }

  std::uint8_t u8(std::size_t offset) const
  {
    this->need(offset, 1, "values");
    return static_cast<std::uint8_t>(this->Bytes[offset]);
  }
  std::uint16_t u16(std::size_t offset) const { return static_cast<std::uint16_t>(this->little(offset, 2)); }
  std::int16_t i16(std::size_t offset) const { return static_cast<std::int16_t>(this->u16(offset)); }
  std::uint32_t u32(std::size_t offset) const { return this->little(offset, 4); }
  std::int32_t i32(std::size_t offset) const { return static_cast<std::int32_t>(this->u32(offset)); }
  float f32(std::size_t offset) const
  {
    const std::uint32_t bits = this->u32(offset);
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  /// Text of at most `length` bytes that ends at the first zero byte; control characters are left out.
  std::string text(std::size_t offset, std::size_t length) const
  {
    this->need(offset, length, "texts");
    std::string out;
    for (std::size_t i = offset; i < offset + length && this->Bytes[i] != '\0'; ++i)
    {
      const auto c = static_cast<unsigned char>(this->Bytes[i]);
      if (c >= 0x20 && c != 0x7f)
      {
        out += this->Bytes[i];
      }
    }
    return out;
  }

private:
  std::uint32_t little(std::size_t offset, std::size_t count) const
  {
    this->need(offset, count, "values");
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      value |= std::uint32_t(static_cast<std::uint8_t>(this->Bytes[offset + i])) << (8 * i);
    }
    return value;
  }

  const std::string& Path;
  const std::string& Bytes;
};

} // namespace dgtk

#endif
