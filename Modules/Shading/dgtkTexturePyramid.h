// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTexturePyramid_h
#define dgtkTexturePyramid_h

// Private to Shading.

#include "dgtkFloat4.h"

#include "dgtkModel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace dgtk
{

/// Texture coordinates at a pixel and how they change to its neighbours.
struct Footprint
{
  double u = 0;
  double v = 0;
  float rightU = 0; ///< towards the pixel on the right
  float rightV = 0;
  float downU = 0; ///< towards the pixel below
  float downV = 0;
};

/// How four footprints lie in pictures of some widths and heights.
struct Extents
{
  Extents(const std::array<const Footprint*, 4>& footprints, Float4 widths, Float4 heights);
  Int4 reduced;   ///< texels are smaller than pixels
  Int4 wider;     ///< the axis to the right is the longer one
  Int4 probes;    ///< along the longer axis
  Float4 details; ///< level of a probe, before it is cut off
};

/// How a picture is looked at.
struct PictureUse
{
  bool cutOut = false; ///< the colours of what is cut out are those beside it
  TextureFilter filter = TextureFilter::Smooth;
  TextureWraps wrap{};

  bool operator<(const PictureUse& o) const
  {
    return std::tie(this->cutOut, this->filter, this->wrap) < std::tie(o.cutOut, o.filter, o.wrap);
  }
};

/// Of four coordinates: the texels between which they are, of which the one on the far side of the end is the first,
/// and how far towards the second.
struct Neighbours
{
  Int4 low;
  Int4 high;
  Float4 part;
  Neighbours(Float4 at, Int4 sizes)
  {
    const Float4 place = at * __builtin_convertvector(sizes, Float4) - 0.5F;
    const Int4 before = place < 0;
    const Int4 whole = __builtin_convertvector(place, Int4) | before;
    const Int4 next = whole + 1;
    this->part = place - __builtin_convertvector(whole, Float4);
    this->low = whole + (before & sizes);
    this->high = next & (next < sizes);
  }
};

/// A picture at all resolutions, each half as wide and high as the one before; at its own only where it is not smooth.
class TexturePyramid
{
public:
  TexturePyramid(const Image& image, const PictureUse& use);

  int width() const { return this->Levels.front().width; }
  int height() const { return this->Levels.front().height; }

  /// What a pixel sees of the picture, RGB in [0, 1]: one to four trilinear probes along the longer axis of its
  /// footprint, as EXT_texture_filter_anisotropic defines it. Of a picture that is not smooth what is at its middle.
  Float4 at(const Footprint& f) const;
  /// The same where it is known how the footprint lies in a picture of this size.
  Float4 at(const Footprint& f, const Extents& extents, std::size_t which) const;

private:
  struct Level
  {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba; ///< rows from bottom to top
  };
  static Level half(const Level& from);
  static Float4 bilinear(const Level& level, const Neighbours& at, int axis);
  static Float4 nearest(const Level& level, float u, float v);
  Float4 enlarged(const Footprint& f) const;
  /// Coordinates u, v, u, v in [0, 1) of two levels.
  Float4 within(double u, double v, const Level& one, const Level& other) const;

  PictureUse Use;
  bool IsTiled; ///< it repeats along both axes
  std::vector<Level> Levels;
};

/// An equirectangular picture of light at all resolutions.
class RadiancePyramid
{
public:
  explicit RadiancePyramid(const RadianceImage& image);
  /// Levels that are given, each half as wide as the one before: RGB, width x width / 2.
  RadiancePyramid(const std::vector<float>* levels, int count, int width);

  int height() const { return this->Levels.front().height; }
  /// Along a unit vector in the axes of the picture, between levels.
  Float4 at(Float4 direction, float level) const;

private:
  struct Level
  {
    int width = 0;
    int height = 0;
    std::vector<float> rgbx; ///< rows from top to bottom, four a texel
    void add(Float4 rgb) { this->rgbx.insert(this->rgbx.end(), { rgb[0], rgb[1], rgb[2], 0.0F }); }
    Float4 texel(std::size_t i) const { return loadFloat4(&this->rgbx[4 * i]); }
  };
  static Float4 bilinear(const Level& level, float u, float v);

  std::vector<Level> Levels;
};

} // namespace dgtk

#endif
