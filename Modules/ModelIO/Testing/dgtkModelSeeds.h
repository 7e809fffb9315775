// SPDX-License-Identifier: BSD-3-Clause
// Small valid files of the formats that have an own reader, made by the tests.
#ifndef dgtkModelSeeds_h
#define dgtkModelSeeds_h

#include <cstdint>
#include <string>
#include <vector>

namespace dgtk::test
{

/// AC3D with most statements of the format: two materials, nested objects, all kinds of surfaces.
std::string ac3dSeed();

/// An MD2 file from parts.
struct Md2File
{
  struct Frame
  {
    std::string name;
    float scale[3] = { 1, 1, 1 };
    float translate[3] = { 0, 0, 0 };
    std::vector<std::uint8_t> coordinates; ///< three a vertex
  };
  std::int32_t skinWidth = 64;
  std::int32_t skinHeight = 32;
  std::vector<std::string> skins;
  std::vector<std::int16_t> sts;        ///< two a texture coordinate
  std::vector<std::uint16_t> triangles; ///< six a triangle: vertices, then texture coordinates
  std::vector<Frame> frames;

  std::string bytes() const;
};
/// A tetrahedron of four frames in two sequences.
Md2File md2Seed();

/// A 3DS chunk with its contents.
std::string chunk3ds(std::uint16_t id, const std::string& contents);
std::string u16(unsigned value);
std::string u32(unsigned long value);
std::string f32(float value);
/// Two triangles of a textured, two-sided material and a smoothed tetrahedron.
std::string seed3ds();

} // namespace dgtk::test

#endif
