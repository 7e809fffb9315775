// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCanvas.h"
#include "dgtkDepthPicture.h"
#include "dgtkLayerPicture.h"
#include "dgtkLayerReader.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
/// Samples of a thumbnail: `channels` doubles a pixel.
struct Samples
{
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<double> values;
  const double* at(int x, int y) const
  {
    return &this->values[(std::size_t(y) * static_cast<std::size_t>(this->width) + std::size_t(x)) *
                         static_cast<std::size_t>(this->channels)];
  }
};

template <typename T>
void convertRow(const Rows& row, std::vector<double>& out)
{
  const T* from = row.row<T>(row.y());
  std::copy(from, from + out.size(), out.begin());
}

void toDoubles(const Rows& row, std::vector<double>& out)
{
  switch (row.type())
  {
    case PixelType::UInt8:
      return convertRow<std::uint8_t>(row, out);
    case PixelType::UInt16:
      return convertRow<std::uint16_t>(row, out);
    case PixelType::UInt32:
      return convertRow<std::uint32_t>(row, out);
    case PixelType::Float32:
      return convertRow<float>(row, out);
    case PixelType::Float64:
      return convertRow<double>(row, out);
  }
}

/// First source index of target index i.
int firstOf(int i, int target, int source) { return static_cast<int>(std::int64_t(i) * source / target); }
int endOf(int i, int target, int source)
{
  return std::max(firstOf(i, target, source) + 1, firstOf(i + 1, target, source));
}

Samples sample(RowReader& reader, int width, int height, bool average)
{
  const ImageInfo& info = reader.info();
  const std::size_t channels = std::size_t(info.channels);
  Samples out{ width, height, info.channels, std::vector<double>(std::size_t(width) * std::size_t(height) * channels) };
  std::vector<double> line(std::size_t(info.width) * channels);
  int ready = 0; // first target row that is not complete
  for (int y = 0; y < info.height && ready < height; ++y)
  {
    const Rows row = reader.read(1);
    for (int j = ready; j < height && firstOf(j, height, info.height) <= y; ++j)
    {
      const int first = firstOf(j, height, info.height);
      const int end = endOf(j, height, info.height);
      const int middle = (first + end - 1) / 2;
      if (average || y == middle)
      {
        toDoubles(row, line);
        for (int i = 0; i < width; ++i)
        {
          const int left = firstOf(i, width, info.width);
          const int right = endOf(i, width, info.width);
          const int from = average ? left : (left + right - 1) / 2;
          const int to = average ? right : from + 1;
          const double weight = average ? 1.0 / (double(to - from) * (end - first)) : 1.0;
          double* cell = &out.values[(std::size_t(j) * std::size_t(width) + std::size_t(i)) * channels];
          for (std::size_t k = std::size_t(from) * channels; k < std::size_t(to) * channels; ++k)
          {
            cell[k % channels] += weight * line[k];
          }
        }
      }
      ready += y + 1 >= end;
    }
  }
  return out;
}

std::uint8_t byteOf(double unit)
{
  return std::isnan(unit) ? 0 : static_cast<std::uint8_t>(std::min(std::max(unit, 0.0), 1.0) * 255 + 0.5);
}

double encoded(double linear) // IEC 61966-2-1
{
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// Range of the finite values of one channel, without the outermost hundredth on either side when there are many;
/// 0 to 1 when there is none.
std::pair<double, double> rangeOf(const Samples& samples, int channel, bool robust)
{
  std::vector<double> values;
  for (std::size_t i = std::size_t(channel); i < samples.values.size(); i += std::size_t(samples.channels))
  {
    if (std::isfinite(samples.values[i]))
    {
      values.push_back(samples.values[i]);
    }
  }
  if (values.empty())
  {
    return { 0.0, 1.0 };
  }
  std::sort(values.begin(), values.end());
  const std::size_t cut = robust ? values.size() / 100 : 0;
  return { values[cut], values[values.size() - 1 - cut] };
}

constexpr Rgb nothing = { 40, 40, 44 };

template <typename F>
Canvas paint(const Samples& samples, F colorOf)
{
  Canvas canvas(samples.width, samples.height, nothing);
  for (int y = 0; y < samples.height; ++y)
  {
    for (int x = 0; x < samples.width; ++x)
    {
      const double* value = samples.at(x, y);
      canvas.at(x, y) = std::isfinite(value[0]) ? colorOf(value) : nothing;
    }
  }
  return canvas;
}

Canvas paintDepth(const Samples& samples)
{
  const auto [near, far] = rangeOf(samples, 0, false);
  const bool logarithmic = near > 0;
  const double low = logarithmic ? portableLog(near) : near;
  const double high = logarithmic ? portableLog(far) : far;
  const double scale = high > low ? 1 / (high - low) : 0;
  return paint(samples,
    [=](const double* v)
    {
      const double at = ((logarithmic ? portableLog(*v) : *v) - low) * scale;
      return rampColor(1 - 0.85 * at); // the farthest surface still differs from nothing
    });
}

Canvas paintRanges(const Samples& samples)
{
  std::vector<std::pair<double, double>> ranges;
  for (int c = 0; c < samples.channels; ++c)
  {
    ranges.push_back(rangeOf(samples, c, true));
  }
  const auto unit = [ranges](const double* v, std::size_t c)
  {
    const auto [low, high] = ranges[c];
    return high > low ? (v[c] - low) / (high - low) : 0.5;
  };
  if (samples.channels == 1)
  {
    return paint(samples, [&](const double* v) { return rampColor(0.15 + 0.85 * unit(v, 0)); });
  }
  const bool blue = samples.channels > 2;
  return paint(samples,
    [&](const double* v) {
      return Rgb{ byteOf(unit(v, 0)), byteOf(unit(v, 1)), blue ? byteOf(unit(v, 2)) : std::uint8_t(64) };
    });
}

Canvas paintColor(const Samples& samples, PixelType type)
{
  const double scale = type == PixelType::UInt8 ? 1 / 255.0 : type == PixelType::UInt16 ? 1 / 65535.0 : 1;
  const bool linear = scale == 1;
  const bool gray = samples.channels < 3;
  return paint(samples,
    [=](const double* v)
    {
      const auto channel = [&](int c) { return byteOf(linear ? encoded(v[c] * scale) : v[c] * scale); };
      return gray ? Rgb{ channel(0), channel(0), channel(0) } : Rgb{ channel(0), channel(1), channel(2) };
    });
}

/// Ids start at 0 where another value stands for nothing.
Canvas paintIds(const Samples& samples, const LayerSpec& spec)
{
  const int channels = samples.channels;
  const bool coverage = spec.name == "alpha" && channels == 4;
  const bool fromZero = !spec.invalid.empty() && spec.invalid != "0";
  return paint(samples,
    [&](const double* v)
    {
      const auto id = static_cast<std::uint32_t>(channels >= 3 ? v[0] * 65536 + v[1] * 256 + v[2] : v[0]);
      if (fromZero && std::to_string(id) == spec.invalid)
      {
        return nothing;
      }
      Rgb color = idColor(fromZero ? id + 1 : id);
      for (std::size_t c = 0; coverage && c < 3; ++c)
      {
        color[c] = static_cast<std::uint8_t>(color[c] * v[3] / 255);
      }
      return color;
    });
}

/// Texture coordinates repeat: their fractions.
Canvas paintFractions(const Samples& samples)
{
  return paint(samples,
    [](const double* v) {
      return Rgb{ byteOf(v[0] - std::floor(v[0])), byteOf(v[1] - std::floor(v[1])), std::uint8_t(64) };
    });
}

Canvas paintNormals(const Samples& samples)
{
  return paint(samples,
    [](const double* v) {
      return Rgb{ byteOf(0.5 + v[0] / 2), byteOf(0.5 - v[1] / 2), byteOf(0.5 - v[2] / 2) };
    });
}
/// Whole pictures, without a change of size.
Samples samplesOf(const Rows& rows)
{
  Samples out{ rows.width(), rows.height(), rows.channels(), {} };
  out.values.resize(std::size_t(rows.width()) * std::size_t(rows.height()) * std::size_t(rows.channels()));
  toDoubles(rows, out.values);
  return out;
}

bool isColor(const LayerSpec& spec) { return spec.name.rfind("color", 0) == 0 || spec.name == "tiles"; }
bool isDepth(const LayerSpec& spec)
{
  return spec.name == "depth" || spec.name == "depth_noisy" || spec.name == "distance";
}

/// In the colours of its meaning; `color`: the values are a picture's.
Canvas paintSamples(const Samples& samples, const LayerSpec& spec, PixelType type, bool color)
{
  if (color)
  {
    return paintColor(samples, type);
  }
  if (type != PixelType::Float32 && type != PixelType::Float64)
  {
    return paintIds(samples, spec);
  }
  if (isDepth(spec))
  {
    return paintDepth(samples);
  }
  if (spec.name == "uv" && samples.channels == 2)
  {
    return paintFractions(samples);
  }
  const bool normals = spec.name == "normal" || spec.name == "shadingnormal";
  return normals && samples.channels == 3 ? paintNormals(samples) : paintRanges(samples);
}
} // namespace

Canvas makeThumbnail(const std::string& path, const LayerSpec& spec, int width, int height)
{
  const std::unique_ptr<RowReader> reader = openLayerFile(path);
  const ImageInfo info = reader->info();
  const bool color = isColor(spec) || (info.format == "png" && isDepth(spec));
  return paintSamples(sample(*reader, width, height, color), spec, info.type, color);
}

LayerPicture paintLayer(const Rows& rows, const LayerSpec& spec)
{
  const Canvas canvas = paintSamples(samplesOf(rows), spec, rows.type(), isColor(spec));
  return { canvas.width(), canvas.height(), canvas.pixels() };
}

} // namespace dgtk
