// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFbxReaders.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>

namespace dgtk::import
{

namespace
{
[[noreturn]] void failFbxBinary(const std::string& what) { throw std::runtime_error(what); }

class BinaryReader
{
public:
  BinaryReader(const std::string& bytes, std::uint64_t budget)
    : Bytes(bytes)
    , Memory(budget)
  {
    this->BigEndian = bytes[22] != 0; // 1 where numbers are written from the other end, which no exporter does any more
    this->At = 23;
    this->Wide = this->take<std::uint32_t>() >= 7500;
  }

  FbxElement run()
  {
    FbxElement all;
    for (;;)
    {
      if (this->At + (this->Wide ? 25 : 13) > this->Bytes.size())
      {
        failFbxBinary("ends before its last element");
      }
      FbxElement element;
      if (!this->element(element, 0, this->Bytes.size()))
      {
        return all;
      }
      all.children.push_back(std::move(element));
    }
  }

private:
  template <class T>
  T take()
  {
    if (this->Bytes.size() - this->At < sizeof(T))
    {
      failFbxBinary("ends inside of an element, at byte " + std::to_string(this->At));
    }
    char raw[sizeof(T)];
    std::memcpy(raw, this->Bytes.data() + this->At, sizeof raw);
    this->At += sizeof raw;
    if (this->BigEndian)
    {
      std::reverse(raw, raw + sizeof raw);
    }
    T value;
    std::memcpy(&value, raw, sizeof value);
    return value;
  }
  std::uint64_t word() { return this->Wide ? this->take<std::uint64_t>() : this->take<std::uint32_t>(); }
  std::string_view block(std::uint64_t size)
  {
    if (this->Bytes.size() - this->At < size)
    {
      failFbxBinary("ends inside of an element, at byte " + std::to_string(this->At));
    }
    const std::string_view block(this->Bytes.data() + this->At, size);
    this->At += size;
    return block;
  }

  /// False for the empty one that ends a list.
  bool element(FbxElement& to, int depth, std::uint64_t limit)
  {
    const std::size_t begin = this->At;
    const std::uint64_t end = this->word();
    const std::uint64_t values = this->word();
    const std::uint64_t valueBytes = this->word();
    const auto name = this->block(this->take<std::uint8_t>());
    if (end == 0)
    {
      return false;
    }
    if (end < this->At || end > limit || valueBytes > end - this->At || depth > deepestFbxElement)
    {
      failFbxBinary("has an element that does not fit its place, at byte " + std::to_string(begin));
    }
    this->Memory.take(sizeof(FbxElement) + name.size());
    to.name = name;
    const std::size_t children = this->At + valueBytes;
    for (std::uint64_t i = 0; i < values && this->At < children; ++i)
    {
      this->Memory.take(sizeof(FbxValue));
      to.values.push_back(this->value());
    }
    this->At = children;
    while (this->At < end)
    {
      FbxElement child;
      if (!this->element(child, depth + 1, end))
      {
        break;
      }
      to.children.push_back(std::move(child));
    }
    this->At = end;
    return true;
  }

  FbxValue value()
  {
    const char type = this->take<char>();
    switch (type)
    {
      case 'C':
      case 'B':
        return std::int64_t(this->take<std::uint8_t>());
      case 'Y':
        return std::int64_t(this->take<std::int16_t>());
      case 'Z':
        return std::int64_t(this->take<std::int8_t>());
      case 'I':
        return std::int64_t(this->take<std::int32_t>());
      case 'L':
        return this->take<std::int64_t>();
      case 'F':
        return double(this->take<float>());
      case 'D':
        return this->take<double>();
      case 'S':
      case 'R':
      {
        const std::string_view text = this->block(this->take<std::uint32_t>());
        this->Memory.take(text.size());
        return std::string(text);
      }
      case 'f':
        return this->list<float, double>();
      case 'd':
        return this->list<double, double>();
      case 'i':
        return this->list<std::int32_t, std::int64_t>();
      case 'l':
        return this->list<std::int64_t, std::int64_t>();
      case 'b':
      case 'c':
        return this->list<std::uint8_t, std::int64_t>();
      default:
        failFbxBinary("has a value of a type that is not known, at byte " + std::to_string(this->At - 1));
    }
  }

  template <class Stored, class Kept>
  std::vector<Kept> list()
  {
    const std::uint32_t count = this->take<std::uint32_t>();
    const std::uint32_t encoding = this->take<std::uint32_t>();
    const std::string_view packed = this->block(this->take<std::uint32_t>());
    const std::uint64_t bytes = std::uint64_t(count) * sizeof(Stored);
    this->Memory.take(std::uint64_t(count) * sizeof(Kept));
    std::string unpacked;
    if (encoding == 1)
    {
      unpacked.resize(bytes);
      const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> zlib(
        libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
      if (!zlib || libdeflate_zlib_decompress(
                     zlib.get(), packed.data(), packed.size(), unpacked.data(), bytes, nullptr) != LIBDEFLATE_SUCCESS)
      {
        failFbxBinary("has a list that cannot be decompressed, before byte " + std::to_string(this->At));
      }
    }
    else if (encoding != 0 || packed.size() != bytes)
    {
      failFbxBinary("has a list of another length than it says, before byte " + std::to_string(this->At));
    }
    const char* from = encoding == 1 ? unpacked.data() : packed.data();
    std::vector<Kept> list(count);
    for (Kept& kept : list)
    {
      char raw[sizeof(Stored)];
      std::memcpy(raw, from, sizeof raw);
      from += sizeof raw;
      if (this->BigEndian)
      {
        std::reverse(raw, raw + sizeof raw);
      }
      Stored stored;
      std::memcpy(&stored, raw, sizeof stored);
      kept = static_cast<Kept>(stored);
    }
    return list;
  }

  const std::string& Bytes;
  FbxBudget Memory;
  std::size_t At = 0;
  bool Wide = false;
  bool BigEndian = false;
};
} // namespace

FbxElement readFbxBinary(const std::string& bytes, std::uint64_t budget) { return BinaryReader(bytes, budget).run(); }

} // namespace dgtk::import
