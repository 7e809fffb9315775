// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPlyHeader_h
#define dgtkPlyHeader_h

#include "dgtkModel.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dgtk
{

enum class PlyType : std::uint8_t
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Float32,
  Float64
};

std::size_t bytesOf(PlyType type);

struct PlyProperty
{
  std::string name;
  PlyType type = PlyType::Float32;
  bool isList = false;
  PlyType countType = PlyType::UInt8;
};

struct PlyElement
{
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Index of the first property with one of the names, or -1.
  int find(std::initializer_list<const char*> names) const;
};

struct PlyHeader
{
  enum class Encoding : std::uint8_t
  {
    Ascii,
    Little,
    Big
  };
  Encoding encoding = Encoding::Ascii;
  std::vector<PlyElement> elements;
  std::string texture;    ///< of a line `comment TextureFile NAME`
  TextureWraps wrap{};    ///< of a line `comment TextureWrap clamp mirror` behind it
  std::size_t bodyAt = 0; ///< offset of the first byte after the header
};

/// Reads and checks the header: known types, no name twice, and counts that fit into the bytes that follow. Throws
/// InputError.
PlyHeader readPlyHeader(const std::string& path, const std::string& contents);

} // namespace dgtk

#endif
