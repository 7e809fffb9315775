// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLayerColors_h
#define dgtkLayerColors_h

#include "dgtkDatasetIOModule.h"

#include "dgtkLayerReader.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace dgtk
{

using Rgb = std::array<std::uint8_t, 3>;

/// 0 to 1 from dark to bright, in steps of even lightness.
DGTKDATASETIO_EXPORT Rgb rampColor(double value);
/// A colour of its own for every id; 0 is dark gray.
DGTKDATASETIO_EXPORT Rgb idColor(std::uint32_t id);
/// The colour wheel of a flow: the direction is the hue (right red, down yellow-green, left cyan), the length, in
/// [0, 1], the saturation.
DGTKDATASETIO_EXPORT Rgb wheelColor(double dx, double dy);
/// What stands where there is nothing.
constexpr Rgb nothingColor = { 40, 40, 44 };

/// How the values of a layer become colours.
enum class LayerLook
{
  Picture,   ///< they are colours, or gray
  Ids,       ///< a colour for each
  Depth,     ///< logarithmic ramp, near bright
  Normal,    ///< x, y, z as red, green, blue, the camera's axes turned so that surfaces facing it are blue
  Fractions, ///< of texture coordinates
  Ranges,    ///< a ramp of one channel; several as red, green, blue
  Flow       ///< the colour wheel
};

/// The look that the contact sheet gives a layer of a file. Flow is not among them: a sheet shows its components.
DGTKDATASETIO_EXPORT LayerLook lookOf(const LayerSpec& spec, const ImageInfo& info);

/// Displacements in the image, which a single picture shows best by the colour wheel.
DGTKDATASETIO_EXPORT bool isFlow(const LayerSpec& spec, const ImageInfo& info);

/// Colours of the values of one image.
class DGTKDATASETIO_EXPORT LayerColors
{
public:
  LayerColors(LayerLook look, const LayerSpec& spec, const ImageInfo& info);

  LayerLook look() const { return this->Look; }
  /// Channels whose range has to be set: all of Ranges, one of Depth, and one of Flow, where the upper end is the
  /// length shown in full colour.
  int ranges() const { return static_cast<int>(this->Range.size()); }
  void setRange(int channel, double low, double high);
  /// The id that Ids shows: 24 bits of red, green and blue where there are three channels.
  std::uint32_t id(const double* values) const;
  /// False for an id that the layer's spec declares to be none.
  bool isId(std::uint32_t id) const { return !this->FromZero || id != this->NoId; }
  Rgb idColorOf(std::uint32_t id) const { return idColor(this->FromZero ? id + 1 : id); }
  /// `values`: one of each channel. nothingColor where the first is not finite.
  Rgb operator()(const double* values) const;

private:
  Rgb picture(const double* values) const;
  Rgb ids(const double* values) const;
  Rgb ranged(const double* values) const;
  Rgb depth(double z) const;
  double unit(double value, int channel) const;

  LayerLook Look;
  int Channels;
  double Scale = 1; ///< of Picture, to [0, 1]
  bool Linear = false;
  bool Coverage = false; ///< the fourth channel dims
  bool FromZero = false; ///< ids start at 0; NoId stands for nothing
  std::uint32_t NoId = 0;
  bool Logarithmic = false;
  std::vector<std::pair<double, double>> Range;
};

} // namespace dgtk

#endif
