// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCanvas.h"
#include "dgtkLayerPicture.h"
#include "dgtkLayerReader.h"
#include "dgtkPixelValues.h"

#include <algorithm>
#include <cmath>

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
        copyValues(row, 0, row.y(), line.size(), line.data());
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

/// Of the finite displacements, without the outermost hundredth.
double longestOf(const Samples& samples)
{
  std::vector<double> lengths;
  for (std::size_t i = 0; i + 1 < samples.values.size(); i += 2)
  {
    const double length = std::hypot(samples.values[i], samples.values[i + 1]);
    if (std::isfinite(length))
    {
      lengths.push_back(length);
    }
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths.empty() ? 0 : lengths[lengths.size() - 1 - lengths.size() / 100];
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

Canvas paint(const Samples& samples, const LayerColors& colorOf)
{
  Canvas canvas(samples.width, samples.height, nothingColor);
  for (int y = 0; y < samples.height; ++y)
  {
    for (int x = 0; x < samples.width; ++x)
    {
      canvas.at(x, y) = colorOf(samples.at(x, y));
    }
  }
  return canvas;
}

Canvas paintSamples(const Samples& samples, LayerColors colors)
{
  for (int c = 0; c < colors.ranges(); ++c)
  {
    const auto [low, high] = rangeOf(samples, c, colors.look() != LayerLook::Depth);
    colors.setRange(c, low, high);
  }
  return paint(samples, colors);
}

/// Whole pictures, without a change of size.
Samples samplesOf(const Rows& rows)
{
  Samples out{ rows.width(), rows.height(), rows.channels(), {} };
  out.values.resize(std::size_t(rows.width()) * std::size_t(rows.height()) * std::size_t(rows.channels()));
  copyValues(rows, 0, rows.y(), out.values.size(), out.values.data());
  return out;
}
} // namespace

Canvas makeThumbnail(const std::string& path, const LayerSpec& spec, int width, int height)
{
  const std::unique_ptr<RowReader> reader = openLayerFile(path);
  const LayerColors colors(lookOf(spec, reader->info()), spec, reader->info());
  return paintSamples(sample(*reader, width, height, colors.look() == LayerLook::Picture), colors);
}

LayerPicture paintLayer(const Rows& rows, const LayerSpec& spec)
{
  ImageInfo info;
  info.type = rows.type();
  info.channels = rows.channels();
  info.width = rows.width();
  info.height = rows.height();
  const Samples samples = samplesOf(rows);
  if (isFlow(spec, info))
  {
    LayerColors wheel(LayerLook::Flow, spec, info);
    const double longest = longestOf(samples);
    wheel.setRange(0, 0, longest);
    const Canvas canvas = paint(samples, wheel);
    return { canvas.width(), canvas.height(), canvas.pixels(), longest };
  }
  const Canvas canvas = paintSamples(samples, { lookOf(spec, info), spec, info });
  return { canvas.width(), canvas.height(), canvas.pixels() };
}

} // namespace dgtk
