// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFbxReaders.h"

#include <algorithm>
#include <cmath>

namespace dgtk::import
{

namespace
{
constexpr std::string_view magic("Kaydara FBX Binary  \0\x1a", 22);
const std::string noText;

bool isBinary(const std::string& bytes)
{
  return bytes.size() >= fbxHeaderBytes && std::string_view(bytes).substr(0, magic.size()) == magic;
}

template <class T>
std::vector<T> listOf(const FbxElement& element)
{
  std::vector<T> list;
  for (const FbxValue& value : element.values)
  {
    const auto add = [&list](const auto& kept)
    {
      using Kept = std::decay_t<decltype(kept)>;
      const auto one = [&list](auto number)
      {
        if constexpr (std::is_integral_v<T> && std::is_floating_point_v<decltype(number)>)
        {
          constexpr double most = 9e18;
          list.push_back(std::abs(number) < most ? static_cast<T>(number) : 0);
        }
        else
        {
          list.push_back(static_cast<T>(number));
        }
      };
      if constexpr (std::is_arithmetic_v<Kept>)
      {
        one(kept);
      }
      else if constexpr (!std::is_same_v<Kept, std::string>)
      {
        list.reserve(list.size() + kept.size());
        std::for_each(kept.begin(), kept.end(), one);
      }
    };
    std::visit(add, value);
  }
  return list;
}
} // namespace

const FbxElement* FbxElement::find(std::string_view child) const
{
  const auto found = std::find_if(
    this->children.begin(), this->children.end(), [child](const FbxElement& e) { return e.name == child; });
  return found == this->children.end() ? nullptr : &*found;
}

const std::string& FbxElement::text(std::size_t index) const
{
  const auto* text = index < this->values.size() ? std::get_if<std::string>(&this->values[index]) : nullptr;
  return text != nullptr ? *text : noText;
}

double FbxElement::number(std::size_t index, double otherwise) const
{
  if (index >= this->values.size())
  {
    return otherwise;
  }
  const auto* whole = std::get_if<std::int64_t>(&this->values[index]);
  const auto* real = std::get_if<double>(&this->values[index]);
  return whole != nullptr ? double(*whole) : real != nullptr ? *real : otherwise;
}

std::int64_t FbxElement::integer(std::size_t index, std::int64_t otherwise) const
{
  const auto* whole = index < this->values.size() ? std::get_if<std::int64_t>(&this->values[index]) : nullptr;
  return whole != nullptr ? *whole : otherwise;
}

std::vector<double> FbxElement::numbers(std::string_view child) const
{
  const FbxElement* list = this->find(child);
  return list != nullptr ? listOf<double>(*list) : std::vector<double>();
}

std::vector<std::int64_t> FbxElement::integers(std::string_view child) const
{
  const FbxElement* list = this->find(child);
  return list != nullptr ? listOf<std::int64_t>(*list) : std::vector<std::int64_t>();
}

FbxElement readFbxDocument(const std::string& bytes, std::uint64_t budget)
{
  if (isBinary(bytes))
  {
    return readFbxBinary(bytes, budget);
  }
  return readFbxText(bytes, budget);
}

std::int64_t fbxVersion(const std::string& bytes, const FbxElement& document)
{
  if (const FbxElement* header = document.find("FBXHeaderExtension"))
  {
    if (const FbxElement* version = header->find("FBXVersion"))
    {
      return version->integer(0, 0);
    }
  }
  if (!isBinary(bytes))
  {
    return 0;
  }
  const bool isBigEndian = bytes[22] != 0;
  const auto byte = [&bytes](std::size_t at) { return std::int64_t(static_cast<unsigned char>(bytes[at])); };
  return isBigEndian ? byte(26) + 256 * byte(25) : byte(23) + 256 * byte(24);
}

} // namespace dgtk::import
