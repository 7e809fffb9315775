// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayerColors.h"

#include "dgtkPixelValues.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace dgtk
{

namespace
{

std::uint8_t byteOf(double unit)
{
  return std::isnan(unit) ? 0 : static_cast<std::uint8_t>(std::min(std::max(unit, 0.0), 1.0) * 255 + 0.5);
}

/// Hues are turns, from -1/2 on.
Rgb hueColor(double hue, double saturation, double value)
{
  Rgb color{};
  constexpr double shift[] = { 5, 3, 1 };
  for (int c = 0; c < 3; ++c)
  {
    const double k = std::fmod(shift[c] + hue * 6, 6.0);
    const double level = value * (1 - saturation * std::max(0.0, std::min({ k, 4 - k, 1.0 })));
    color[std::size_t(c)] = static_cast<std::uint8_t>(level * 255 + 0.5);
  }
  return color;
}
} // namespace

Rgb rampColor(double value)
{
  // lightness rises evenly from 10 to 95 % along these
  constexpr double stops[][3] = { { 24, 15, 61 }, { 84, 31, 107 }, { 146, 47, 105 }, { 203, 75, 79 }, { 241, 122, 50 },
    { 250, 184, 62 }, { 250, 245, 170 } };
  constexpr int last = 6;
  const double at = std::min(std::max(value, 0.0), 1.0) * last;
  const int i = std::min(static_cast<int>(at), last - 1);
  Rgb color{};
  for (int c = 0; c < 3; ++c)
  {
    color[std::size_t(c)] = static_cast<std::uint8_t>(stops[i][c] + (at - i) * (stops[i + 1][c] - stops[i][c]) + 0.5);
  }
  return color;
}

Rgb idColor(std::uint32_t id)
{
  if (id == 0)
  {
    return { 40, 40, 44 };
  }
  // golden section: hues of neighbouring ids lie far apart; the rest comes from mixed bits
  std::uint32_t mixed = id * 2654435761u;
  mixed ^= mixed >> 15;
  const double hue = std::fmod(id * 0.61803398874989485, 1.0);
  return hueColor(hue, 0.45 + 0.5 * (mixed & 255) / 255.0, 0.65 + 0.35 * (mixed >> 8 & 255) / 255.0);
}

Rgb wheelColor(double dx, double dy)
{
  return hueColor(portable::atan2(dy, dx) / (2 * pi), std::min(std::hypot(dx, dy), 1.0), 1);
}

LayerLook lookOf(const LayerSpec& spec, const ImageInfo& info)
{
  const bool integers = info.type != PixelType::Float32 && info.type != PixelType::Float64;
  const bool depth = spec.meaning == Meaning::Depth || spec.meaning == Meaning::Distance;
  const bool shares = spec.meaning == Meaning::Coverage && integers;
  const bool unsaid = spec.meaning == Meaning::Unknown && integers && info.channels > 1;
  if (spec.meaning == Meaning::Picture || spec.meaning == Meaning::Mask || shares || unsaid ||
      (depth && info.format == "png"))
  {
    return LayerLook::Picture;
  }
  if (integers)
  {
    return LayerLook::Ids;
  }
  if (depth)
  {
    return LayerLook::Depth;
  }
  if (spec.meaning == Meaning::TextureCoordinates && info.channels == 2)
  {
    return LayerLook::Fractions;
  }
  return spec.meaning == Meaning::Direction && info.channels == 3 ? LayerLook::Normal : LayerLook::Ranges;
}

bool isFlow(const LayerSpec& spec, const ImageInfo& info)
{
  return spec.meaning == Meaning::Displacement && info.channels == 2;
}

LayerColors::LayerColors(LayerLook look, const LayerSpec& spec, const ImageInfo& info)
  : Look(look)
  , Channels(info.channels)
  , Scale(info.type == PixelType::UInt8    ? 1 / 255.0
          : info.type == PixelType::UInt16 ? 1 / 65535.0
                                           : 1)
  , Linear(Scale == 1)
  , Coverage(spec.meaning == Meaning::Id && info.channels == 4)
  , FromZero(!spec.invalid.empty() && spec.invalid != "0")
  , NoId(FromZero ? static_cast<std::uint32_t>(std::strtoul(spec.invalid.c_str(), nullptr, 10)) : 0)
{
  const bool one = look == LayerLook::Depth || look == LayerLook::Flow;
  this->Range.resize(one ? 1 : look == LayerLook::Ranges ? std::size_t(info.channels) : 0, { 0.0, 1.0 });
}

void LayerColors::setRange(int channel, double low, double high)
{
  this->Logarithmic = this->Look == LayerLook::Depth && low > 0;
  this->Range[std::size_t(channel)] =
    this->Logarithmic ? std::make_pair(portable::log(low), portable::log(high)) : std::make_pair(low, high);
}

double LayerColors::unit(double value, int channel) const
{
  const auto [low, high] = this->Range[std::size_t(channel)];
  return high > low ? (value - low) / (high - low) : 0.5;
}

std::uint32_t LayerColors::id(const double* v) const { return idOf(v, std::size_t(this->Channels)); }

Rgb LayerColors::picture(const double* v) const
{
  const auto channel = [&](int c)
  { return byteOf(this->Linear ? portable::srgbFromLinear(v[c] * this->Scale) : v[c] * this->Scale); };
  return this->Channels < 3 ? Rgb{ channel(0), channel(0), channel(0) } : Rgb{ channel(0), channel(1), channel(2) };
}

Rgb LayerColors::ids(const double* v) const
{
  const std::uint32_t id = this->id(v);
  if (!this->isId(id))
  {
    return nothingColor;
  }
  Rgb color = this->idColorOf(id);
  for (std::size_t c = 0; this->Coverage && c < 3; ++c)
  {
    color[c] = static_cast<std::uint8_t>(color[c] * v[3] / 255);
  }
  return color;
}

Rgb LayerColors::ranged(const double* v) const
{
  if (this->Channels == 1)
  {
    return rampColor(0.15 + 0.85 * this->unit(v[0], 0));
  }
  return { byteOf(this->unit(v[0], 0)), byteOf(this->unit(v[1], 1)),
    this->Channels > 2 ? byteOf(this->unit(v[2], 2)) : std::uint8_t(64) };
}

Rgb LayerColors::depth(double z) const
{
  // the farthest surface still differs from nothing
  const auto [low, high] = this->Range[0];
  const double at = this->Logarithmic ? (z > 0 ? portable::log(z) : low) : z;
  return rampColor(1 - 0.85 * (high > low ? std::min(std::max((at - low) / (high - low), 0.0), 1.0) : 0.0));
}

Rgb LayerColors::operator()(const double* v) const
{
  if (!std::isfinite(v[0]))
  {
    return nothingColor;
  }
  switch (this->Look)
  {
    case LayerLook::Picture:
      return this->picture(v);
    case LayerLook::Ids:
      return this->ids(v);
    case LayerLook::Depth:
      return this->depth(v[0]);
    case LayerLook::Normal:
      return { byteOf(0.5 + v[0] / 2), byteOf(0.5 - v[1] / 2), byteOf(0.5 - v[2] / 2) };
    case LayerLook::Fractions:
      return { byteOf(v[0] - std::floor(v[0])), byteOf(v[1] - std::floor(v[1])), 64 };
    case LayerLook::Ranges:
      return this->ranged(v);
    case LayerLook::Flow:
      break;
  }
  const double longest = this->Range[0].second;
  return longest > 0 ? wheelColor(v[0] / longest, v[1] / longest) : wheelColor(0, 0);
}

} // namespace dgtk
