// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkImportBase64_h
#define dgtkImportBase64_h

#include <cstdint>
#include <string>
#include <string_view>

namespace dgtk::import
{

/// Adds the bytes of a text of base64 (RFC 4648), up to its padding; false when some character is none of its digits.
inline bool addBase64(std::string_view text, std::string& bytes)
{
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text.substr(0, text.find('=')))
  {
    const std::size_t digit = digits.find(c);
    if (digit == std::string_view::npos)
    {
      return false;
    }
    group = group << 6 | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits >= 8)
    {
      bits -= 8;
      bytes += static_cast<char>(group >> bits & 255);
    }
  }
  return true;
}

} // namespace dgtk::import

#endif
