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

__m128i word(const std::uint8_t* rgba)
{
  std::int32_t bytes = 0;
  std::memcpy(&bytes, rgba, sizeof bytes);
  return _mm_cvtsi32_si128(bytes);
}

/// Two texels of a row, which mostly are beside one another.
struct Texels
{
  Float4 left;
  Float4 right;
  Texels(const std::uint8_t* row, int low, int high)
  {
    const __m128i both = high == low + 1 ? _mm_loadl_epi64(reinterpret_cast<const __m128i*>(row + 4 * low))
                                         : _mm_unpacklo_epi32(word(row + 4 * low), word(row + 4 * high));
    const __m128i zero = _mm_setzero_si128();
    const __m128i shorts = _mm_unpacklo_epi8(both, zero);
    this->left = _mm_cvtepi32_ps(_mm_unpacklo_epi16(shorts, zero));
    this->right = _mm_cvtepi32_ps(_mm_unpackhi_epi16(shorts, zero));
  }
  Float4 mixed(float part) const { return this->left + (this->right - this->left) * part; }
};

constexpr int mostProbes = 4;

/// Where probes are along the longer axis, in footprints from its middle, and what they are weighed with.
struct Probes
{
  std::array<std::array<double, mostProbes>, mostProbes + 1> places{};
  std::array<float, mostProbes + 1> weights{};
  constexpr Probes()
  {
    for (std::size_t many = 1; many <= mostProbes; ++many)
    {
      for (std::size_t i = 0; i < many; ++i)
      {
        this->places[many][i] = double((float(i) + 0.5F) / float(many) - 0.5F);
      }
      this->weights[many] = 1 / (255 * float(many));
    }
  }
};
constexpr Probes allProbes;

template <typename Level>
float lastOf(const std::vector<Level>& levels)
{
  return float(levels.size() - 1);
}
} // namespace

TexturePyramid::TexturePyramid(const Image& image, const PictureUse& use)
  : Use(use)
  , IsTiled(use.wrap == PictureUse().wrap)
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

/// `axis`: of the coordinate u of its level, before that of v.
inline Float4 TexturePyramid::bilinear(const Level& level, const Neighbours& at, int axis)
{
  const std::size_t row = std::size_t(level.width) * 4;
  const std::uint8_t* const texels = level.rgba.data();
  const Texels low(texels + std::size_t(at.low[axis + 1]) * row, at.low[axis], at.high[axis]);
  const Texels high(texels + std::size_t(at.high[axis + 1]) * row, at.low[axis], at.high[axis]);
  const Float4 below = low.mixed(at.part[axis]);
  return below + (high.mixed(at.part[axis]) - below) * at.part[axis + 1];
}

Float4 TexturePyramid::nearest(const Level& level, float u, float v)
{
  const int x = std::min(int(u * float(level.width)), level.width - 1);
  const int y = std::min(int(v * float(level.height)), level.height - 1);
  return Texels(level.rgba.data() + std::size_t(y) * std::size_t(level.width) * 4, x, x).left;
}

inline Float4 TexturePyramid::within(double u, double v, const Level& one, const Level& other) const
{
  const Float4 tiled = repeated(u, v);
  if (this->IsTiled)
  {
    return tiled;
  }
  const auto inside = [&](std::size_t axis, double coordinate, int size)
  {
    const TextureWrap wrap = this->Use.wrap[axis];
    if (wrap == TextureWrap::Repeat)
    {
      return tiled[axis];
    }
    const double half = 0.5 / size;
    const double folded =
      wrap == TextureWrap::Mirror ? std::abs(coordinate - 2 * std::floor(coordinate / 2 + 0.5)) : coordinate;
    return float(folded > half ? std::min(folded, 1 - half) : half);
  };
  return float4(
    inside(0, u, one.width), inside(1, v, one.height), inside(0, u, other.width), inside(1, v, other.height));
}

/// Between the picture's own texels.
Float4 TexturePyramid::enlarged(const Footprint& f) const
{
  const Level& own = this->Levels.front();
  const Float4 at = this->within(f.u, f.v, own, own);
  return bilinear(own, Neighbours(at, Int4{ own.width, own.height, own.width, own.height }), 0) * (1 / 255.0F);
}

Extents::Extents(const std::array<const Footprint*, 4>& footprints, Float4 widths, Float4 heights)
{
  std::array<Float4, 4> rows; // of a footprint, then of its numbers
  for (std::size_t i = 0; i < 4; ++i)
  {
    rows[i] = loadFloat4(&footprints[i]->rightU);
  }
  _MM_TRANSPOSE4_PS(rows[0], rows[1], rows[2], rows[3]);
  const Float4 rightU = rows[0] * widths;
  const Float4 rightV = rows[1] * heights;
  const Float4 downU = rows[2] * widths;
  const Float4 downV = rows[3] * heights;
  const Float4 across = rightU * rightU + rightV * rightV;
  const Float4 along = downU * downU + downV * downV;
  const Float4 longest = across < along ? along : across;
  const Float4 ratio = longest / atLeast(along < across ? along : across, 1e-30F);
  const Int4 two = ratio >= 1.5F * 1.5F;
  const Int4 three = ratio >= 2.5F * 2.5F;
  const Int4 four = ratio >= 3.5F * 3.5F;
  const Float4 largest = float4(1e30F);
  const Float4 logOfProbes = four ? float4(2) : three ? float4(0x1.95c01ap+0F) : two ? float4(1) : float4(0);
  this->reduced = longest > 1; // not where there is no number
  this->wider = across > along;
  this->probes = 1 - two - three - four;
  this->details = 0.5F * portable::log2(longest > largest ? largest : longest) - logOfProbes;
}

Float4 TexturePyramid::at(const Footprint& f) const
{
  const Level& own = this->Levels.front();
  return this->at(f, Extents({ &f, &f, &f, &f }, float4(float(own.width)), float4(float(own.height))), 0);
}

Float4 TexturePyramid::at(const Footprint& f, const Extents& extents, std::size_t which) const
{
  const Level& own = this->Levels.front();
  if (this->Use.filter == TextureFilter::Nearest)
  {
    const Float4 at = this->within(f.u, f.v, own, own);
    return nearest(own, at[0], at[1]) * (1 / 255.0F);
  }
  if (this->Use.filter == TextureFilter::Linear || extents.reduced[which] == 0)
  {
    return this->enlarged(f);
  }
  const auto probes = std::size_t(extents.probes[which]);
  const std::array<double, mostProbes>& places = allProbes.places[probes];
  const float level = std::min(std::max(extents.details[which], 0.0F), lastOf(this->Levels));
  const auto low = std::size_t(level);
  const float part = level - float(low);
  const Level& fine = this->Levels[low];
  const Level& coarse = this->Levels[part > 0 ? low + 1 : low];
  const Int4 sizes = { fine.width, fine.height, coarse.width, coarse.height };
  const bool wider = extents.wider[which] != 0;
  const double axisU = double(wider ? f.rightU : f.downU);
  const double axisV = double(wider ? f.rightV : f.downV);
  Float4 sum = float4(0);
  for (std::size_t i = 0; i < probes; ++i)
  {
    const Neighbours at(this->within(f.u + axisU * places[i], f.v + axisV * places[i], fine, coarse), sizes);
    sum += bilinear(fine, at, 0) * (1 - part);
    if (part > 0)
    {
      sum += bilinear(coarse, at, 2) * part;
    }
  }
  return sum * allProbes.weights[probes];
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
  const Neighbours x(float4(u), Int4{ level.width, level.width, level.width, level.width });
  const float place = std::max(v * float(level.height) - 0.5F, 0.0F);
  const int low = std::min(int(place), level.height - 1);
  const int high = std::min(low + 1, level.height - 1);
  const float part = place - float(low);
  const auto mixed = [&](int row)
  {
    const std::size_t first = std::size_t(row) * std::size_t(level.width);
    const Float4 left = level.texel(first + std::size_t(x.low[0]));
    return left + (level.texel(first + std::size_t(x.high[0])) - left) * x.part[0];
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
