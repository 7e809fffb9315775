// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReportPainting.h"

#include "dgtkError.h"
#include "dgtkPngEncoder.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace dgtk
{

namespace
{
/// Of the finite values of a channel in all pictures, without the outermost hundredth on either side.
std::pair<double, double> rangeOf(const std::vector<ReportSamples>& all, std::size_t channel)
{
  std::vector<double> values;
  for (const ReportSamples& samples : all)
  {
    if (samples.info.format == "png")
    {
      continue; // levels of a picture of values
    }
    const auto step = std::size_t(std::max(1, samples.info.channels));
    for (std::size_t i = channel; i < samples.exact.size(); i += step)
    {
      if (std::isfinite(samples.exact[i]))
      {
        values.push_back(samples.exact[i]);
      }
    }
  }
  if (values.empty())
  {
    return { 0.0, 1.0 };
  }
  const auto at = [&](std::size_t place)
  {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(place), values.end());
    return values[place];
  };
  const std::size_t cut = values.size() / 100;
  const double low = at(cut);
  return { low, at(values.size() - 1 - cut) };
}

double longestOf(const std::vector<ReportSamples>& all)
{
  std::vector<double> lengths;
  for (const ReportSamples& samples : all)
  {
    for (std::size_t i = 0; i + 1 < samples.exact.size(); i += 2)
    {
      const double length = std::hypot(samples.exact[i], samples.exact[i + 1]);
      if (std::isfinite(length))
      {
        lengths.push_back(length);
      }
    }
  }
  if (lengths.empty())
  {
    return 0;
  }
  const std::size_t place = lengths.size() - 1 - lengths.size() / 100;
  std::nth_element(lengths.begin(), lengths.begin() + std::ptrdiff_t(place), lengths.end());
  return lengths[place];
}

std::string hexOf(const Rgb& color)
{
  constexpr const char* digits = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t c : color)
  {
    text += { digits[c >> 4], digits[c & 15] };
  }
  return text;
}

} // namespace

const ReportSamples& exampleOf(const std::vector<ReportSamples>& all)
{
  const auto values =
    std::find_if(all.begin(), all.end(), [](const ReportSamples& one) { return one.info.format != "png"; });
  return values == all.end() ? all.front() : *values;
}

Painting paintingOf(const ReportLayer& layer, const std::vector<ReportSamples>& all)
{
  const ImageInfo info = all.empty() ? ImageInfo() : exampleOf(all).info;
  if (isFlow(layer.spec, info))
  {
    Painting wheel{ { LayerLook::Flow, layer.spec, info }, {} };
    const double longest = longestOf(all);
    wheel.colors.setRange(0, 0, longest);
    wheel.legend = { { "kind", "wheel" }, { "high", longest } };
    return wheel;
  }
  Painting painting{ { lookOf(layer.spec, info), layer.spec, info }, {} };
  std::pair<double, double> range;
  for (int c = 0; c < painting.colors.ranges(); ++c)
  {
    range = rangeOf(all, std::size_t(c));
    painting.colors.setRange(c, range.first, range.second);
  }
  const LayerLook look = painting.colors.look();
  if (look == LayerLook::Depth || (look == LayerLook::Ranges && info.channels == 1))
  {
    const bool logarithmic = look == LayerLook::Depth && range.first > 0;
    painting.legend = { { "kind", "ramp" }, { "low", range.first }, { "high", range.second }, { "log", logarithmic } };
    constexpr int stops = 24;
    for (int i = 0; i <= stops; ++i)
    {
      const double at = double(i) / stops;
      const double value = logarithmic ? range.first * std::pow(range.second / range.first, at)
                                       : range.first + at * (range.second - range.first);
      painting.legend["colors"].push_back(hexOf(painting.colors(&value)));
    }
    return painting;
  }
  painting.legend = { { "kind", look == LayerLook::Picture ? "picture" : look == LayerLook::Ids ? "ids" : "axes" } };
  return painting;
}

namespace
{
std::string pngOf(const ReportSamples& samples, const LayerColors& colors)
{
  std::string bytes;
  PngEncoder::Header header;
  header.width = samples.width;
  header.height = samples.height;
  header.prediction = colors.look() == LayerLook::Ids ? PngPrediction::Labels : PngPrediction::Smooth;
  PngEncoder encoder(
    header, [&](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); });
  const std::vector<double>& values = samples.drawn.empty() ? samples.exact : samples.drawn;
  std::vector<unsigned char> line(encoder.rowBytes());
  std::size_t at = 0;
  for (int y = 0; y < samples.height; ++y)
  {
    for (std::size_t x = 0; x < std::size_t(samples.width); ++x, at += std::size_t(samples.info.channels))
    {
      const Rgb color = colors(&values[at]);
      std::copy(color.begin(), color.end(), &line[3 * x]);
    }
    encoder.row(line.data());
  }
  encoder.finish();
  return bytes;
}

/// The first bytes of all values, then the second ones ..., little-endian: areas of like values become like bytes.
template <typename T>
std::string planesOf(const std::vector<double>& values)
{
  std::string planes(values.size() * sizeof(T), '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const T value = static_cast<T>(values[i]);
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (std::size_t b = 0; b < sizeof(T); ++b)
    {
      planes[b * values.size() + i] = static_cast<char>(bytes[b]);
    }
  }
  return planes;
}

std::string planesOf(const ReportSamples& samples)
{
  switch (samples.info.type)
  {
    case PixelType::UInt8:
      return planesOf<std::uint8_t>(samples.exact);
    case PixelType::UInt16:
      return planesOf<std::uint16_t>(samples.exact);
    case PixelType::UInt32:
      return planesOf<std::uint32_t>(samples.exact);
    case PixelType::Float32:
    case PixelType::Float64:
      break;
  }
  return planesOf<float>(samples.exact);
}

std::string deflated(const std::string& bytes)
{
  uLongf size = compressBound(uLong(bytes.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
        uLong(bytes.size()), 6) != Z_OK)
  {
    throw MachineError("the values of a picture cannot be packed");
  }
  packed.resize(size);
  return packed;
}

std::string base64Of(const std::string& bytes)
{
  constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3)
  {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      bits = bits << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k)
    {
      text += k <= left ? letters[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

} // namespace

std::string blockOf(const ReportSamples& samples, const LayerColors& colors)
{
  const bool isFloat = samples.info.type == PixelType::Float32 || samples.info.type == PixelType::Float64;
  std::string head;
  for (const int number :
    { samples.width, samples.height, samples.info.width, samples.info.height, samples.info.channels })
  {
    head += std::to_string(number) + ' ';
  }
  head += isFloat ? "float32" : nameOf(samples.info.type);
  return head + '|' + base64Of(pngOf(samples, colors)) + '|' + base64Of(deflated(planesOf(samples)));
}

} // namespace dgtk
