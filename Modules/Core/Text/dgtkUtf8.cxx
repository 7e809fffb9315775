// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkUtf8.h"

#include <cstdio>

namespace dgtk
{

namespace
{
// Length of the UTF-8 sequence at text[i]; 0 when there is none (Unicode 15, table 3-7).
std::size_t sequenceAt(const std::string& text, std::size_t i)
{
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
  const auto tail = [&](std::size_t k) { return (byte(k) & 0xc0) == 0x80; };
  const unsigned int a = byte(i);
  const unsigned int b = byte(i + 1);
  if (a < 0x80)
  {
    return 1;
  }
  if (a >= 0xc2 && a <= 0xdf && tail(i + 1))
  {
    return 2;
  }
  if (a >= 0xe0 && a <= 0xef && tail(i + 1) && tail(i + 2) && !(a == 0xe0 && b < 0xa0) && !(a == 0xed && b > 0x9f))
  {
    return 3;
  }
  if (a >= 0xf0 && a <= 0xf4 && tail(i + 1) && tail(i + 2) && tail(i + 3) && !(a == 0xf0 && b < 0x90) &&
      !(a == 0xf4 && b > 0x8f))
  {
    return 4;
  }
  return 0;
}

// U+EF80 to U+EFFF: ee be 80 to ee bf bf.
bool standsForByte(const std::string& text, std::size_t i)
{
  return i + 2 < text.size() && text[i] == '\xee' && (text[i + 1] == '\xbe' || text[i + 1] == '\xbf') &&
         sequenceAt(text, i) == 3;
}

std::string standIn(char byte)
{
  const auto value = static_cast<unsigned char>(byte); // 0x80 or more
  return { '\xee', value < 0xc0 ? '\xbe' : '\xbf', static_cast<char>(0x80 | (value & 0x3f)) };
}
} // namespace

bool isUtf8(const std::string& text)
{
  std::size_t i = 0;
  for (std::size_t length = 1; i < text.size() && length > 0; i += length)
  {
    length = sequenceAt(text, i);
  }
  return i >= text.size();
}

std::string utf8FromBytes(const std::string& bytes)
{
  std::string text;
  for (std::size_t i = 0; i < bytes.size();)
  {
    const std::size_t length = sequenceAt(bytes, i);
    if (length > 0 && !standsForByte(bytes, i))
    {
      text.append(bytes, i, length);
      i += length;
      continue;
    }
    text += standIn(bytes[i]);
    const std::size_t end = i + (length > 0 ? length : 1);
    while (++i < end)
    {
      text += standIn(bytes[i]);
    }
  }
  return text;
}

std::string bytesFromUtf8(const std::string& text)
{
  std::string bytes;
  for (std::size_t i = 0; i < text.size();)
  {
    if (standsForByte(text, i))
    {
      bytes += static_cast<char>((text[i + 1] == '\xbe' ? 0x80 : 0xc0) | (text[i + 2] & 0x3f));
      i += 3;
    }
    else
    {
      bytes += text[i++];
    }
  }
  return bytes;
}

namespace
{
/// A control character of one or two bytes, or a line or paragraph separator (U+2028, U+2029), begins here.
bool endsLine(const std::string& text, std::size_t at)
{
  const auto c = static_cast<unsigned char>(text[at]);
  return c < 0x20 || c == 0x7f || (c == 0xc2 && static_cast<unsigned char>(text[at + 1]) < 0xa0) ||
         text.compare(at, 3, "\xe2\x80\xa8") == 0 || text.compare(at, 3, "\xe2\x80\xa9") == 0;
}
} // namespace

std::string printable(const std::string& text)
{
  std::string out;
  for (std::size_t i = 0; i < text.size();)
  {
    const std::size_t length = sequenceAt(text, i);
    if (length == 0 || endsLine(text, i)) // what follows of a character is none by itself
    {
      char code[8];
      std::snprintf(code, sizeof code, "\\x%02X", static_cast<unsigned char>(text[i]));
      out += code;
      ++i;
    }
    else
    {
      out.append(text, i, length);
      i += length;
    }
  }
  return out;
}

} // namespace dgtk
