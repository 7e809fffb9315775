// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTextLines.h"

#include "dgtkUtf8.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace dgtk
{

namespace
{
constexpr std::string_view blanks = " \t\f\v";

void appendUtf8(std::string& out, std::uint32_t code)
{
  if (code < 0x80)
  {
    out += static_cast<char>(code);
  }
  else if (code < 0x800)
  {
    out += static_cast<char>(0xc0 | (code >> 6));
    out += static_cast<char>(0x80 | (code & 0x3f));
  }
  else if (code < 0x10000)
  {
    out += static_cast<char>(0xe0 | (code >> 12));
    out += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
    out += static_cast<char>(0x80 | (code & 0x3f));
  }
  else
  {
    out += static_cast<char>(0xf0 | (code >> 18));
    out += static_cast<char>(0x80 | ((code >> 12) & 0x3f));
    out += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
    out += static_cast<char>(0x80 | (code & 0x3f));
  }
}

std::string fromUtf16(const std::string& bytes, std::size_t start, bool bigEndian)
{
  std::string out;
  out.reserve(bytes.size() / 2 + 16);
  const auto unit = [&](std::size_t i)
  {
    const auto a = static_cast<std::uint8_t>(bytes[i]);
    const auto b = static_cast<std::uint8_t>(bytes[i + 1]);
    return bigEndian ? std::uint32_t(a) * 256u + b : std::uint32_t(b) * 256u + a;
  };
  for (std::size_t i = start; i + 1 < bytes.size(); i += 2)
  {
    std::uint32_t code = unit(i);
    if (code >= 0xd800 && code < 0xdc00 && i + 3 < bytes.size() && (unit(i + 2) & 0xfc00u) == 0xdc00u)
    {
      code = 0x10000 + ((code & 0x3ffu) << 10) + (unit(i + 2) & 0x3ffu);
      i += 2;
    }
    appendUtf8(out, code);
  }
  return out;
}
} // namespace

std::string toUtf8(std::string bytes)
{
  const std::string_view head(bytes.data(), bytes.size() < 3 ? bytes.size() : 3);
  if (head.substr(0, 2) == "\xff\xfe" || (head.size() >= 2 && head[0] != '\0' && head[1] == '\0'))
  {
    return fromUtf16(bytes, head[0] == '\xff' ? 2 : 0, false);
  }
  if (head.substr(0, 2) == "\xfe\xff" || (head.size() >= 2 && head[0] == '\0' && head[1] != '\0'))
  {
    return fromUtf16(bytes, head[0] == '\xfe' ? 2 : 0, true);
  }
  if (head == "\xef\xbb\xbf")
  {
    bytes.erase(0, 3);
  }
  return bytes;
}

std::string validUtf8(const std::string& text)
{
  std::string out;
  for (const char c : isUtf8(text) ? std::string() : text)
  {
    appendUtf8(out, static_cast<std::uint8_t>(c));
  }
  return out.empty() ? text : out;
}

std::optional<double> parseNumber(std::string_view token)
{
  if (!token.empty() && token[0] == '+')
  {
    token.remove_prefix(1);
  }
  double value = 0;
  const char* end = token.data() + token.size();
  const std::from_chars_result result = std::from_chars(token.data(), end, value);
  const std::string_view rest(result.ptr, static_cast<std::size_t>(end - result.ptr));
  if (result.ec == std::errc::result_out_of_range && rest.empty())
  {
    // from_chars leaves the value alone: tell too large from too small by the sign of the exponent
    const std::size_t e = token.find_first_of("eE");
    const bool small = e != std::string_view::npos && token.substr(e + 1, 1) == "-";
    return small             ? 0.0
           : token[0] == '-' ? -std::numeric_limits<double>::infinity()
                             : std::numeric_limits<double>::infinity();
  }
  if (result.ec != std::errc())
  {
    return std::nullopt;
  }
  if (!rest.empty())
  {
    const bool printed = rest[0] == '#' || (std::isnan(value) && rest[0] == '(');
    return printed ? std::optional<double>(std::numeric_limits<double>::quiet_NaN()) : std::nullopt;
  }
  return value;
}

std::optional<long long> parseInteger(std::string_view token)
{
  int base = 10;
  if (token.size() > 2 && token[0] == '0' && (token[1] == 'x' || token[1] == 'X'))
  {
    base = 16;
    token.remove_prefix(2);
  }
  long long value = 0;
  const char* end = token.data() + token.size();
  const std::from_chars_result result = std::from_chars(token.data(), end, value, base);
  return result.ec == std::errc() && result.ptr == end ? std::optional<long long>(value) : std::nullopt;
}

bool TextLines::next()
{
  if (this->Again)
  {
    this->Again = false;
    return true;
  }
  if (this->At >= this->Text.size())
  {
    return false;
  }
  const std::size_t end = this->Text.find_first_of("\r\n", this->At);
  const std::size_t stop = end == std::string_view::npos ? this->Text.size() : end;
  this->Line = this->Text.substr(this->At, stop - this->At);
  this->At = stop + (stop < this->Text.size() ? 1 : 0);
  if (stop + 1 < this->Text.size() && this->Text[stop] == '\r' && this->Text[stop + 1] == '\n')
  {
    ++this->At;
  }
  ++this->Number;
  return true;
}

const std::vector<std::string_view>& TextLines::words()
{
  this->Found.clear();
  const std::string_view line = this->Line;
  std::size_t at = line.find_first_not_of(blanks);
  while (at != std::string_view::npos && this->Found.size() < 64)
  {
    const bool inQuotes = line[at] == '"';
    const std::size_t begin = at + (inQuotes ? 1 : 0);
    std::size_t end = inQuotes ? line.find('"', begin) : line.find_first_of(blanks, begin);
    end = end == std::string_view::npos ? line.size() : end;
    this->Found.push_back(line.substr(begin, end - begin));
    at = end + (inQuotes ? 1 : 0);
    at = at < line.size() ? line.find_first_not_of(blanks, at) : std::string_view::npos;
  }
  return this->Found;
}

} // namespace dgtk
