// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtk3dsChunks_h
#define dgtk3dsChunks_h

#include <cstdint>

namespace dgtk
{

enum ChunkId3ds : std::uint16_t
{
  ColorFloat = 0x0010,
  ColorByte = 0x0011,
  ColorByteLinear = 0x0012,
  ColorFloatLinear = 0x0013,
  PercentInt = 0x0030,
  PercentFloat = 0x0031,
  Editor = 0x3d3d,
  NamedObject = 0x4000,
  Mesh = 0x4100,
  Vertices = 0x4110,
  Faces = 0x4120,
  FaceMaterial = 0x4130,
  TextureCoordinates = 0x4140,
  SmoothingGroups = 0x4150,
  Main = 0x4d4d,
  MaterialName = 0xa000,
  Ambient = 0xa010,
  Diffuse = 0xa020,
  Specular = 0xa030,
  Shininess = 0xa040,
  ShininessStrength = 0xa041,
  Transparency = 0xa050,
  TwoSided = 0xa081,
  SelfIllumination = 0xa084,
  TextureMap = 0xa200,
  SpecularMap = 0xa204,
  OpacityMap = 0xa210,
  ReflectionMap = 0xa220,
  BumpMap = 0xa230,
  TextureName = 0xa300,
  SecondTextureMap = 0xa33a,
  ShininessMap = 0xa33c,
  SelfIlluminationMap = 0xa33d,
  TextureTiling = 0xa351,
  TextureScaleV = 0xa354,
  TextureScaleU = 0xa356,
  TextureOffsetU = 0xa358,
  TextureOffsetV = 0xa35a,
  TextureAngle = 0xa35c,
  MaterialBlock = 0xafff,
  KeyFramer = 0xb000,
  ObjectNode = 0xb002,
  PositionTrack = 0xb020,
  RotationTrack = 0xb021,
  ScaleTrack = 0xb022,
  MorphTrack = 0xb026
};

/// What the picture of a map that is not drawn is for; null for other chunks.
constexpr const char* unreadMap3ds(std::uint16_t id)
{
  return id == SpecularMap           ? "specular"
         : id == ReflectionMap       ? "reflection"
         : id == BumpMap             ? "bump"
         : id == SecondTextureMap    ? "second texture"
         : id == ShininessMap        ? "shininess"
         : id == SelfIlluminationMap ? "self-illumination"
                                     : nullptr;
}

} // namespace dgtk

#endif
