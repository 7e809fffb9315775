// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkStream_h
#define dgtkStream_h

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

/// Values for another process of the same program: as they are in memory, in the byte order of the machine, every list
/// preceded by its count. One function `io(a, value)` for each structure both writes and reads it.
namespace dgtk
{

/// Types whose bytes are the stream's. A structure that can have unused bytes, or values that are not allowed, is none.
template <class T>
struct IsPlain
  : std::integral_constant<bool, (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) || std::is_enum_v<T>>
{
};
template <class T, std::size_t N>
struct IsPlain<std::array<T, N>> : IsPlain<T>
{
};

/// Writes to `put(const void*, size_t)`.
template <class Put>
class StreamWriter
{
public:
  static constexpr bool isReader = false;

  explicit StreamWriter(Put put)
    : Out(put)
  {
  }
  void mark(std::uint32_t value) { (*this)(value); }
  template <class T>
  void operator()(T& value)
  {
    if constexpr (IsPlain<T>::value)
    {
      this->Out(&value, sizeof value);
    }
    else
    {
      io(*this, value);
    }
  }
  void operator()(bool& value)
  {
    const std::uint8_t byte = value ? 1 : 0;
    this->Out(&byte, 1);
  }
  void operator()(std::string& text) { this->block(text); }
  template <class T>
  void operator()(std::vector<T>& list)
  {
    if constexpr (IsPlain<T>::value)
    {
      this->block(list);
    }
    else
    {
      std::uint64_t count = list.size();
      this->Out(&count, sizeof count);
      for (T& item : list)
      {
        (*this)(item);
      }
    }
  }

private:
  template <class L>
  void block(L& list)
  {
    std::uint64_t count = list.size();
    this->Out(&count, sizeof count);
    this->Out(list.data(), list.size() * sizeof(typename L::value_type));
  }
  Put Out;
};

/// Reads what StreamWriter wrote, `size` bytes, from `take(void*, size_t)`; a count is believed only when as many bytes
/// follow. Throws std::runtime_error.
template <class Take>
class StreamReader
{
public:
  static constexpr bool isReader = true;

  StreamReader(Take take, std::uint64_t size)
    : In(take)
    , Left(size)
  {
  }
  void mark(std::uint32_t expected)
  {
    std::uint32_t found = 0;
    (*this)(found);
    if (found != expected)
    {
      throw std::runtime_error("mark");
    }
  }
  template <class T>
  void operator()(T& value)
  {
    if constexpr (IsPlain<T>::value)
    {
      this->take(&value, sizeof value);
    }
    else
    {
      io(*this, value);
    }
  }
  void operator()(bool& value)
  {
    std::uint8_t byte = 0;
    this->take(&byte, 1);
    value = byte != 0;
  }
  void operator()(std::string& text)
  {
    text.resize(this->count(1));
    this->take(text.data(), text.size());
  }
  template <class T>
  void operator()(std::vector<T>& list)
  {
    if constexpr (IsPlain<T>::value)
    {
      list.resize(this->count(sizeof(T)));
      this->take(list.data(), list.size() * sizeof(T));
    }
    else
    {
      // every structure of the stream takes at least eight bytes
      const std::size_t items = this->count(8);
      for (std::size_t i = 0; i < items; ++i)
      {
        list.emplace_back();
        (*this)(list.back());
      }
    }
  }

private:
  std::size_t count(std::size_t itemBytes)
  {
    std::uint64_t value = 0;
    this->take(&value, sizeof value);
    if (value > this->Left / itemBytes)
    {
      throw std::runtime_error("count");
    }
    return static_cast<std::size_t>(value);
  }
  void take(void* to, std::size_t bytes)
  {
    if (bytes > this->Left)
    {
      throw std::runtime_error("end");
    }
    if (bytes > 0)
    {
      this->In(to, bytes);
    }
    this->Left -= bytes;
  }
  Take In;
  std::uint64_t Left;
};

/// Bytes in memory, one after the other.
struct TakeFromMemory
{
  const char* at;
  void operator()(void* to, std::size_t bytes)
  {
    std::memcpy(to, this->at, bytes);
    this->at += bytes;
  }
};
using MemoryReader = StreamReader<TakeFromMemory>;

} // namespace dgtk

#endif
