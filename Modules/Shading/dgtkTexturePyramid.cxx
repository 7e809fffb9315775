// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTexturePyramid.h"

#include "dgtkCutOutColors.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <emmintrin.h>

namespace dgtk
{

namespace
{
constexpr float mostProbes = 4;

/// What of a row of `from` texels each of `to` is made of: the first one, and the parts of it and of up to two more.
struct Halving
{
  std::vector<int> first;
  std::vector<std::array<float, 3>> parts;

  Halving(int from, int to)
  {
    const double step = double(from) / to; // 1, 2, or between 2 and 3
    for (int i = 0; i < to; ++i)
    {
      const double begin = i * step;
      const double end = begin + step;
      const int texel = int(begin + 1e-9);
      std::array<float, 3> part{};
      for (int k = 0; k < 3; ++k)
      {
        part[std::size_t(k)] =
          float(std::max(0.0, std::min(end, double(texel + k + 1)) - std::max(begin, double(texel + k))) / step);
      }
      this->first.push_back(texel);
      this->parts.push_back(part);
    }
  }
};

/// Between neighbours, of which the one on the far side of the end is the first.
struct Neighbours
{
  int low;
  int high;
  float part;
  Neighbours(float at, int size)
  {
    const float place = at * float(size) - 0.5F;
    const int whole = place < 0 ? -1 : int(place);
    this->part = place - float(whole);
    this->low = whole < 0 ? size - 1 : whole;
    this->high = whole + 1 < size ? whole + 1 : 0;
  }
};

Float4 texel(const std::uint8_t* rgba)
{
  std::int32_t bytes = 0;
  std::memcpy(&bytes, rgba, sizeof bytes);
  const __m128i zero = _mm_setzero_si128();
  const __m128i shorts = _mm_unpacklo_epi8(_mm_cvtsi32_si128(bytes), zero);
  return _mm_cvtepi32_ps(_mm_unpacklo_epi16(shorts, zero));
}

template <typename Level>
float lastOf(const std::vector<Level>& levels)
{
  return float(levels.size() - 1);
}
} // namespace

TexturePyramid::TexturePyramid(const Image& image, const PictureUse& use)
  : Use(use)
{
  Level finest;
  finest.width = image.width;
  finest.height = image.height;
  const std::vector<std::uint8_t> filled = use.cutOut ? withoutHoles(image) : std::vector<std::uint8_t>();
  const std::uint8_t* source = use.cutOut ? filled.data() : image.rgba.data();
  const std::size_t row = std::size_t(image.width) * 4;
  finest.rgba.resize(row * std::size_t(image.height));
  for (int y = 0; y < image.height; ++y)
  {
    std::memcpy(&finest.rgba[std::size_t(image.height - 1 - y) * row], source + std::size_t(y) * row, row);
  }
  this->Levels.push_back(std::move(finest));
  while (use.filter == TextureFilter::Smooth && (this->Levels.back().width > 1 || this->Levels.back().height > 1))
  {
    this->Levels.push_back(half(this->Levels.back()));
  }
}

/// The mean by area.
TexturePyramid::Level TexturePyramid::half(const Level& from)
{
  Level to;
  to.width = std::max(1, from.width / 2);
  to.height = std::max(1, from.height / 2);
  to.rgba.resize(std::size_t(to.width) * std::size_t(to.height) * 4);
  if (from.width == 2 * to.width && from.height == 2 * to.height)
  {
    const std::size_t row = std::size_t(from.width) * 4;
    std::uint8_t* target = to.rgba.data();
    for (int y = 0; y < to.height; ++y)
    {
      const std::uint8_t* source = &from.rgba[2 * std::size_t(y) * row];
      for (int x = 0; x < to.width; ++x, source += 8, target += 4)
      {
        for (int c = 0; c < 4; ++c)
        {
          target[c] = std::uint8_t((source[c] + source[c + 4] + source[row + c] + source[row + c + 4] + 2) / 4);
        }
      }
    }
    return to;
  }
  const Halving across(from.width, to.width);
  const Halving along(from.height, to.height);
  for (int y = 0; y < to.height; ++y)
  {
    for (int x = 0; x < to.width; ++x)
    {
      float sum[4] = { 0.5F, 0.5F, 0.5F, 0.5F };
      for (int j = 0; j < 3; ++j)
      {
        for (int i = 0; i < 3; ++i)
        {
          const float weight =
            across.parts[std::size_t(x)][std::size_t(i)] * along.parts[std::size_t(y)][std::size_t(j)];
          if (weight > 0)
          {
            const int column = across.first[std::size_t(x)] + i;
            const int row = along.first[std::size_t(y)] + j;
            const std::uint8_t* source =
              &from.rgba[(std::size_t(row) * std::size_t(from.width) + std::size_t(column)) * 4];
            for (int c = 0; c < 4; ++c)
            {
              sum[c] += weight * float(source[c]);
            }
          }
        }
      }
      std::uint8_t* target = &to.rgba[(std::size_t(y) * std::size_t(to.width) + std::size_t(x)) * 4];
      std::transform(sum, sum + 4, target, [](float v) { return std::uint8_t(v); });
    }
  }
  return to;
}

Float4 TexturePyramid::bilinear(const Level& level, float u, float v)
{
  const Neighbours x(u, level.width);
  const Neighbours y(v, level.height);
  const std::uint8_t* low = level.rgba.data() + std::size_t(y.low) * std::size_t(level.width) * 4;
  const std::uint8_t* high = level.rgba.data() + std::size_t(y.high) * std::size_t(level.width) * 4;
  const Float4 a = texel(low + 4 * x.low);
  const Float4 b = texel(low + 4 * x.high);
  const Float4 c = texel(high + 4 * x.low);
  const Float4 d = texel(high + 4 * x.high);
  const Float4 below = a + (b - a) * x.part;
  const Float4 above = c + (d - c) * x.part;
  return below + (above - below) * y.part;
}

Float4 TexturePyramid::nearest(const Level& level, float u, float v)
{
  const int x = std::min(int(u * float(level.width)), level.width - 1);
  const int y = std::min(int(v * float(level.height)), level.height - 1);
  return texel(&level.rgba[(std::size_t(y) * std::size_t(level.width) + std::size_t(x)) * 4]);
}

float TexturePyramid::within(double coordinate, int size) const
{
  if (this->Use.repeats)
  {
    return repeated(coordinate);
  }
  const double half = 0.5 / size;
  return float(coordinate > half ? std::min(coordinate, 1 - half) : half);
}

Float4 TexturePyramid::at(const Footprint& f) const
{
  const auto w = float(this->width());
  const auto h = float(this->height());
  if (this->Use.filter != TextureFilter::Smooth)
  {
    const float u = this->within(f.u, this->width());
    const float v = this->within(f.v, this->height());
    const bool linear = this->Use.filter == TextureFilter::Linear;
    return (linear ? bilinear(this->Levels.front(), u, v) : nearest(this->Levels.front(), u, v)) * (1 / 255.0F);
  }
  const float across = f.rightU * w * (f.rightU * w) + f.rightV * h * (f.rightV * h);
  const float along = f.downU * w * (f.downU * w) + f.downV * h * (f.downV * h);
  const float longest = std::max(across, along);
  if (!(longest > 1)) // enlarged, or not a number
  {
    return bilinear(this->Levels.front(), this->within(f.u, this->width()), this->within(f.v, this->height())) *
           (1 / 255.0F);
  }
  const float ratio = longest / std::max(std::min(across, along), 1e-30F);
  float probes = 1;
  for (; probes < mostProbes && (probes + 0.5F) * (probes + 0.5F) <= ratio; probes += 1)
  {
  }
  const float detail = 0.5F * portable::log2(std::min(longest, 1e30F)) - (probes > 1 ? portable::log2(probes) : 0.0F);
  const float level = std::min(std::max(detail, 0.0F), lastOf(this->Levels));
  const auto low = std::size_t(level);
  const float part = level - float(low);
  const double axisU = double(across > along ? f.rightU : f.downU);
  const double axisV = double(across > along ? f.rightV : f.downV);
  Float4 sum = float4(0);
  for (int i = 0; i < int(probes); ++i)
  {
    const double place = double((float(i) + 0.5F) / probes - 0.5F);
    const float u = this->within(f.u + axisU * place, this->Levels[low].width);
    const float v = this->within(f.v + axisV * place, this->Levels[low].height);
    sum += bilinear(this->Levels[low], u, v) * (1 - part);
    if (part > 0)
    {
      sum += bilinear(this->Levels[low + 1], u, v) * part;
    }
  }
  return sum * (1 / (255 * probes));
}

RadiancePyramid::RadiancePyramid(const RadianceImage& image)
{
  Level finest;
  finest.width = image.width;
  finest.height = image.height;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
  {
    finest.add(toFloat4(&image.rgb[i]));
  }
  this->Levels.push_back(std::move(finest));
  while (this->Levels.back().width > 1 || this->Levels.back().height > 1)
  {
    const Level& from = this->Levels.back();
    Level to;
    to.width = std::max(1, from.width / 2);
    to.height = std::max(1, from.height / 2);
    const Halving across(from.width, to.width);
    const Halving along(from.height, to.height);
    for (std::size_t y = 0; y < std::size_t(to.height); ++y)
    {
      for (std::size_t x = 0; x < std::size_t(to.width); ++x)
      {
        Float4 sum = float4(0);
        for (std::size_t k = 0; k < 9; ++k)
        {
          const float weight = across.parts[x][k % 3] * along.parts[y][k / 3];
          const std::size_t row = std::size_t(along.first[y]) + k / 3;
          sum += weight > 0 ? from.texel(row * std::size_t(from.width) + std::size_t(across.first[x]) + k % 3) * weight
                            : float4(0);
        }
        to.add(sum);
      }
    }
    this->Levels.push_back(std::move(to));
  }
}

RadiancePyramid::RadiancePyramid(const std::vector<float>* levels, int count, int width)
{
  for (int i = 0; i < count; ++i)
  {
    Level level;
    level.width = width >> i;
    level.height = level.width / 2;
    for (std::size_t k = 0; k < levels[i].size(); k += 3)
    {
      level.add(toFloat4(&levels[i][k]));
    }
    this->Levels.push_back(std::move(level));
  }
}

Float4 RadiancePyramid::bilinear(const Level& level, float u, float v)
{
  const Neighbours x(u, level.width);
  const float place = std::max(v * float(level.height) - 0.5F, 0.0F);
  const int low = std::min(int(place), level.height - 1);
  const int high = std::min(low + 1, level.height - 1);
  const float part = place - float(low);
  const auto mixed = [&](int row)
  {
    const std::size_t first = std::size_t(row) * std::size_t(level.width);
    const Float4 left = level.texel(first + std::size_t(x.low));
    return left + (level.texel(first + std::size_t(x.high)) - left) * x.part;
  };
  const Float4 above = mixed(low);
  const Float4 below = mixed(high);
  return above + (below - above) * part;
}

Float4 RadiancePyramid::at(Float4 d, float level) const
{
  const float turn = 0.5F + portable::atan2(d[0], -d[2]) * 0.159154943F;
  const float u = turn < 1 ? turn : 0.0F;
  const float v = portable::atan2(std::sqrt(d[0] * d[0] + d[2] * d[2]), d[1]) * 0.318309886F;
  level = std::min(std::max(level, 0.0F), lastOf(this->Levels));
  const auto low = std::size_t(level);
  const float part = level - float(low);
  const Float4 color = bilinear(this->Levels[low], u, v);
  return part > 0 ? color + (bilinear(this->Levels[low + 1], u, v) - color) * part : color;
}

} // namespace dgtk
