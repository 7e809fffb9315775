// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadArchives.h"

#include "dgtkError.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <regex>

#include <zlib.h>

// POSIX.1-1988, the ustar interchange format; NumPy's format 1.0; the PNG specification, sections 5 and 9.

namespace dgtk
{

namespace
{
constexpr std::size_t block = 512;

struct Header
{
  char bytes[block];
  std::string text(std::size_t at, std::size_t size) const
  {
    return { this->bytes + at, ::strnlen(this->bytes + at, size) };
  }
  std::uint64_t number(std::size_t at, std::size_t size) const
  {
    return std::strtoull(this->text(at, size).c_str(), nullptr, 8);
  }
  /// Of all bytes, with spaces where the sum stands.
  std::uint64_t sum() const
  {
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < block; ++i)
    {
      total += i >= 148 && i < 156 ? ' ' : static_cast<unsigned char>(this->bytes[i]);
    }
    return total;
  }
  bool isEmpty() const
  {
    return std::all_of(std::begin(this->bytes), std::end(this->bytes), [](char c) { return c == 0; });
  }
};

void check(const Header& header, const std::string& path, std::uint64_t offset)
{
  const auto need = [&](bool right, const char* what)
  {
    if (!right)
    {
      throw InputError(path, "at byte " + std::to_string(offset) + ": " + what);
    }
  };
  need(header.text(257, 6) == "ustar" && std::memcmp(header.bytes + 263, "00", 2) == 0, "is no ustar header");
  need(header.number(148, 8) == header.sum(), "the header's sum is another");
  need(header.bytes[156] == '0', "is no plain file");
  need(header.number(136, 12) == 0, "has a time");
  need(header.number(108, 8) == 0 && header.number(116, 8) == 0, "has an owner");
}
} // namespace

void forTarMembers(
  const std::string& path, const std::function<void(const std::string& name, const std::string& bytes)>& visit)
{
  std::ifstream file(path, std::ios::binary);
  std::uint64_t offset = 0;
  for (Header header{}; file.read(header.bytes, block); offset += block)
  {
    if (header.isEmpty())
    {
      if (!file.read(header.bytes, block) || !header.isEmpty())
      {
        throw InputError(path, "does not end with two empty blocks");
      }
      return;
    }
    check(header, path, offset);
    const std::uint64_t size = header.number(124, 12);
    const std::uint64_t padded = (size + block - 1) / block * block;
    const auto here = file.tellg();
    file.seekg(0, std::ios::end);
    const bool fits = std::uint64_t(file.tellg() - here) >= padded;
    file.seekg(here);
    if (!fits)
    {
      throw InputError(path, "at byte " + std::to_string(offset) + ": the file ends before its contents");
    }
    std::string bytes(padded, '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(padded));
    bytes.resize(size);
    offset += padded;
    visit(header.text(0, 100), bytes);
  }
  throw InputError(path, "ends without an empty block");
}

namespace
{
template <typename T>
void append(std::vector<double>& values, const char* data, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    T value;
    std::memcpy(&value, data + i * sizeof(T), sizeof(T));
    values.push_back(double(value));
  }
}

struct NumpyType
{
  const char* name;
  std::size_t bytes;
  void (*append)(std::vector<double>&, const char*, std::size_t);
};
constexpr NumpyType numpyTypes[] = { { "|u1", 1, &append<std::uint8_t> }, { "<u2", 2, &append<std::uint16_t> },
  { "<u4", 4, &append<std::uint32_t> }, { "<f4", 4, &append<float> }, { "<f8", 8, &append<double> } };
} // namespace

DecodedPixels decodeNpyBytes(const std::string& path, const std::string& bytes)
{
  static const std::regex form(
    R"(\{'descr': '([^']+)', 'fortran_order': False, 'shape': \((\d+), (\d+)(?:, (\d+))?\), \} *\n)");
  const std::size_t length =
    bytes.size() < 10 ? 0 : static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  std::smatch match;
  const std::string text = bytes.size() < 10 + length ? "" : bytes.substr(10, length);
  if (bytes.compare(0, 8, std::string("\x93NUMPY\x01\x00", 8)) != 0 || !std::regex_match(text, match, form))
  {
    throw InputError(path, "is no NumPy array of format 1.0");
  }
  DecodedPixels pixels;
  pixels.height = std::stoi(match[2]);
  pixels.width = std::stoi(match[3]);
  pixels.channels = match[4].matched ? std::stoi(match[4]) : 1;
  const std::size_t count = std::size_t(pixels.width) * pixels.height * pixels.channels;
  for (const NumpyType& type : numpyTypes)
  {
    if (match[1] == type.name && bytes.size() == 10 + length + count * type.bytes)
    {
      type.append(pixels.values, bytes.data() + 10 + length, count);
      return pixels;
    }
  }
  throw InputError(path, "is no array of as many numbers as its shape says");
}

namespace
{
std::uint32_t big32(const std::string& bytes, std::size_t at)
{
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i)
  {
    value = value << 8 | static_cast<unsigned char>(bytes.at(i));
  }
  return value;
}

int paeth(int a, int b, int c)
{
  const int toA = std::abs(b - c);
  const int toB = std::abs(a - c);
  const int toC = std::abs(a + b - 2 * c);
  return toA <= toB && toA <= toC ? a : toB <= toC ? b : c;
}

/// Takes the prediction off the rows, in place; each begins with a byte that says which.
void unfilter(std::vector<unsigned char>& data, std::size_t rowBytes, std::size_t pixelBytes)
{
  const auto at = [&](std::size_t row, std::size_t i) { return int(data[row * (rowBytes + 1) + 1 + i]); };
  for (std::size_t y = 0; y < data.size() / (rowBytes + 1); ++y)
  {
    const unsigned char kind = data[y * (rowBytes + 1)];
    for (std::size_t i = 0; i < rowBytes; ++i)
    {
      const int left = i >= pixelBytes ? at(y, i - pixelBytes) : 0;
      const int up = y > 0 ? at(y - 1, i) : 0;
      const int corner = y > 0 && i >= pixelBytes ? at(y - 1, i - pixelBytes) : 0;
      const int guesses[] = { 0, left, up, (left + up) / 2, paeth(left, up, corner) };
      data[y * (rowBytes + 1) + 1 + i] = static_cast<unsigned char>(at(y, i) + guesses[kind % 5]);
    }
  }
}
} // namespace

DecodedPixels decodeGrayPngBytes(const std::string& path, const std::string& bytes)
{
  try
  {
    DecodedPixels pixels;
    std::string packed;
    std::size_t depth = 0;
    for (std::size_t at = 8; at < bytes.size(); at += 12 + std::size_t(big32(bytes, at)))
    {
      const std::string type = bytes.substr(at + 4, 4);
      if (type == "IHDR")
      {
        pixels.width = static_cast<int>(big32(bytes, at + 8));
        pixels.height = static_cast<int>(big32(bytes, at + 12));
        depth = static_cast<unsigned char>(bytes.at(at + 16)) / 8U;
        const bool codes = bytes.at(at + 17) == 0 || bytes.at(at + 17) == 3; // gray, or a palette's
        depth = codes && bytes.at(at + 20) == 0 ? depth : 0;                 // not interlaced
      }
      packed += type == "IDAT" ? bytes.substr(at + 8, big32(bytes, at)) : "";
    }
    const std::size_t rowBytes = std::size_t(pixels.width) * depth;
    const std::size_t most = 1032 * packed.size(); // deflate packs no tighter
    const bool fits = pixels.width > 0 && pixels.height > 0 && rowBytes < most / std::size_t(pixels.height);
    std::vector<unsigned char> data(fits ? (rowBytes + 1) * std::size_t(pixels.height) : 0);
    uLongf size = data.size();
    if (depth == 0 || size == 0 ||
        uncompress(data.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()) != Z_OK ||
        size != data.size())
    {
      throw InputError(path, "is no gray PNG, or damaged");
    }
    unfilter(data, rowBytes, depth);
    for (std::size_t y = 0; y < std::size_t(pixels.height); ++y)
    {
      for (std::size_t x = 0; x < std::size_t(pixels.width); ++x)
      {
        const unsigned char* code = &data[y * (rowBytes + 1) + 1 + x * depth];
        pixels.values.push_back(depth == 1 ? code[0] : code[0] * 256 + code[1]);
      }
    }
    return pixels;
  }
  catch (const std::out_of_range&)
  {
    throw InputError(path, "is no PNG, or damaged");
  }
}

} // namespace dgtk
