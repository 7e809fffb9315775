// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJsonText.h"

#include <charconv>
#include <cmath>

namespace dgtk
{

std::string shortest(double value)
{
  if (std::isnan(value))
  {
    return "nan";
  }
  if (std::isinf(value))
  {
    return value > 0 ? "inf" : "-inf";
  }
  char text[32];
  return { text, std::to_chars(text, text + sizeof text, value).ptr };
}

std::string jsonNumber(double value)
{
  if (!std::isfinite(value))
  {
    return "null";
  }
  const std::string text = shortest(value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

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
} // namespace

std::string jsonString(const std::string& text)
{
  constexpr char digits[] = "0123456789abcdef";
  std::string out = "\"";
  for (std::size_t i = 0; i < text.size();)
  {
    const char c = text[i];
    const std::size_t length = sequenceAt(text, i);
    if (length == 0)
    {
      out += "\xef\xbf\xbd";
    }
    else if (c == '"' || c == '\\')
    {
      out += { '\\', c };
    }
    else if (static_cast<unsigned char>(c) < 0x20)
    {
      out += std::string("\\u00") + digits[c >> 4] + digits[c & 15];
    }
    else
    {
      out.append(text, i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return out + '"';
}

std::string jsonMatrix(const Eigen::Ref<const Eigen::MatrixXd>& matrix)
{
  std::string out = "[";
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
  {
    out += i > 0 ? ", " : "";
    std::string row;
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    {
      row += (j > 0 ? ", " : "") + jsonNumber(matrix(i, j));
    }
    out += matrix.cols() == 1 ? row : "[" + row + "]";
  }
  return out + "]";
}

JsonObject& JsonObject::raw(const std::string& key, const std::string& value)
{
  const std::string member = jsonString(key) + ": " + value;
  this->Block += (this->Block.empty() ? "\n" : ",\n") + std::string(this->Indent, ' ') + member;
  this->Line += (this->Line.empty() ? "" : ", ") + member;
  return *this;
}

std::string JsonObject::block() const
{
  return "{" + this->Block + "\n" + std::string(std::max(0, this->Indent - 2), ' ') + "}";
}

std::string JsonObject::line() const { return "{" + this->Line + "}"; }

void JsonArray::add(const std::string& item)
{
  this->Items += (this->Items.empty() ? "\n" : ",\n") + std::string(this->Indent, ' ') + item;
}

std::string JsonArray::block() const
{
  return this->Items.empty() ? "[]" : "[" + this->Items + "\n" + std::string(std::max(0, this->Indent - 2), ' ') + "]";
}

} // namespace dgtk
