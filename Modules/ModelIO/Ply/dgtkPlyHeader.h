// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPlyHeader_h
#define dgtkPlyHeader_h

#include "dgtkModel.h"

#include <array>
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
  /// Of a property in one of the rows; 0 for -1.
  static double valueAt(const std::vector<double>& row, int property)
  {
    return property < 0 ? 0.0 : row[static_cast<std::size_t>(property)];
  }
};

/// The colour of an element, from its rows.
class PlyColor
{
public:
  explicit PlyColor(const PlyElement& element);
  bool exists() const { return this->Red >= 0 && this->Green >= 0 && this->Blue >= 0; }
  Eigen::Vector3d in(const std::vector<double>& row); ///< white at 1
  std::array<std::uint8_t, 4> bytesIn(const std::vector<double>& row);
  /// A warning when what was read so far hardly has the range of its type; "" otherwise.
  std::string oddRange() const;

private:
  int Red;
  int Green;
  int Blue;
  int Alpha;
  double White = 1;
  double Most = 0; ///< component of the colours so far
};

/// A picture that the header names.
struct PlyPicture
{
  std::string name;    ///< of a line `comment TextureFile NAME`
  TextureWraps wrap{}; ///< of a line `comment TextureWrap clamp mirror` behind it
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
  std::vector<PlyPicture> pictures;
  std::size_t bodyAt = 0; ///< offset of the first byte after the header
};

/// Reads and checks the header: known types, no name twice, and counts that fit into the bytes that follow. Throws
/// InputError.
PlyHeader readPlyHeader(const std::string& path, const std::string& contents);

} // namespace dgtk

#endif
