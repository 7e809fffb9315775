// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReportPictures.h"

#include "dgtkError.h"
#include "dgtkFolder.h"
#include "dgtkLayerColors.h"
#include "dgtkPngEncoder.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace dgtk
{

namespace
{
constexpr std::size_t pictureBlock = 64; ///< counted together before they are added up

int firstOf(int i, int samples, int pixels) { return static_cast<int>(std::int64_t(i) * pixels / samples); }
int endOf(int i, int samples, int pixels)
{
  return std::max(firstOf(i, samples, pixels) + 1, firstOf(i + 1, samples, pixels));
}

template <typename T>
void convertRow(const Rows& rows, int y, std::vector<double>& line)
{
  const T* const from = rows.row<T>(y);
  std::copy(from, from + line.size(), line.begin());
}

void toDoubles(const Rows& rows, int y, std::vector<double>& line)
{
  switch (rows.type())
  {
    case PixelType::UInt8:
      return convertRow<std::uint8_t>(rows, y, line);
    case PixelType::UInt16:
      return convertRow<std::uint16_t>(rows, y, line);
    case PixelType::UInt32:
      return convertRow<std::uint32_t>(rows, y, line);
    case PixelType::Float32:
      return convertRow<float>(rows, y, line);
    case PixelType::Float64:
      return convertRow<double>(rows, y, line);
  }
}

/// Takes the rows of one picture.
class PictureReading
{
public:
  PictureReading(const ReportLayer& layer, const ImageInfo& info, int side)
    : Layer(layer)
    , Info(info)
    , Channels(std::size_t(info.channels))
    , Colors(lookOf(layer.spec, info), layer.spec, info)
    , Averages(lookOf(layer.spec, info) == LayerLook::Picture)
  {
    if (side <= 0)
    {
      return;
    }
    const double scale = std::min(1.0, double(side) / std::max(info.width, info.height));
    this->Samples.info = info;
    this->Samples.width = std::max(1, static_cast<int>(std::lround(info.width * scale)));
    this->Samples.height = std::max(1, static_cast<int>(std::lround(info.height * scale)));
    const std::size_t size = std::size_t(this->Samples.width) * std::size_t(this->Samples.height) * this->Channels;
    this->Samples.exact.resize(size);
    this->Samples.drawn.resize(this->Averages ? size : 0);
  }

  void row(int y, const std::vector<double>& line)
  {
    this->count(line);
    const int height = this->Samples.height;
    for (int j = this->Ready; j < height && firstOf(j, height, this->Info.height) <= y; ++j)
    {
      const int end = endOf(j, height, this->Info.height);
      if (y == middleOf(j, height, this->Info.height))
      {
        this->take(j, line);
      }
      if (this->Averages)
      {
        this->average(j, line, end - firstOf(j, height, this->Info.height));
      }
      this->Ready += y + 1 >= end;
    }
  }

  PictureCounts Counts;
  ReportSamples Samples;

private:
  void count(const std::vector<double>& line)
  {
    switch (this->Layer.counted)
    {
      case Counted::Nothing:
        return;
      case Counted::Numbers:
        return this->countNumbers(line);
      case Counted::Brightness:
        return this->countBrightness(line);
      case Counted::Objects:
      case Counted::Classes:
        break;
    }
    for (std::size_t x = 0; x < line.size(); x += this->Channels)
    {
      const std::uint32_t id = this->Colors.id(&line[x]);
      if (this->LastCount == nullptr || id != this->Last)
      {
        this->Last = id;
        this->LastCount = &this->Counts.ids[id];
      }
      ++*this->LastCount;
    }
  }

  void countNumbers(const std::vector<double>& line)
  {
    for (std::size_t x = 0; x < line.size(); x += this->Channels)
    {
      double value = line[x];
      if (this->Channels > 1)
      {
        double squares = 0;
        for (std::size_t c = 0; c < this->Channels; ++c)
        {
          squares += line[x + c] * line[x + c];
        }
        value = std::sqrt(squares);
      }
      this->Counts.numbers.add(value);
    }
  }

  void countBrightness(const std::vector<double>& line)
  {
    const double most = this->Info.type == PixelType::UInt8 ? 255 : 65535;
    for (std::size_t x = 0; x < line.size(); x += this->Channels)
    {
      const bool gray = this->Channels < 3;
      const double luma = gray ? line[x] : 0.2126 * line[x] + 0.7152 * line[x + 1] + 0.0722 * line[x + 2];
      this->Counts.brightness.add(luma / most);
    }
  }

  double* cell(std::vector<double>& values, int i, int j)
  {
    return &values[(std::size_t(j) * std::size_t(this->Samples.width) + std::size_t(i)) * this->Channels];
  }

  void take(int j, const std::vector<double>& line)
  {
    for (int i = 0; i < this->Samples.width; ++i)
    {
      const double* const from =
        &line[std::size_t(middleOf(i, this->Samples.width, this->Info.width)) * this->Channels];
      std::copy(from, from + this->Channels, this->cell(this->Samples.exact, i, j));
    }
  }

  void average(int j, const std::vector<double>& line, int rows)
  {
    for (int i = 0; i < this->Samples.width; ++i)
    {
      const int left = firstOf(i, this->Samples.width, this->Info.width);
      const int right = endOf(i, this->Samples.width, this->Info.width);
      double* const to = this->cell(this->Samples.drawn, i, j);
      for (std::size_t k = std::size_t(left) * this->Channels; k < std::size_t(right) * this->Channels; ++k)
      {
        to[k % this->Channels] += line[k] / (double(right - left) * rows);
      }
    }
  }

  const ReportLayer& Layer;
  ImageInfo Info;
  std::size_t Channels;
  LayerColors Colors;
  bool Averages;
  int Ready = 0;
  std::uint32_t Last = 0;
  std::uint64_t* LastCount = nullptr; ///< of Last
};

/// One file: its counts and samples, or why it could not be read.
struct ReadPicture
{
  std::optional<PictureCounts> counts;
  ReportSamples samples;
  std::string note;
};

ReadPicture readPicture(const ReportSource& source, const ReportLayer& layer, std::size_t picture, int side)
{
  ReadPicture out;
  try
  {
    const DatasetView& view = source.viewOf(source.pictures[picture]);
    const std::unique_ptr<RowReader> reader =
      openLayerFile(Folder(view.folder()).fileAt(layer.files.find(picture)->second));
    PictureReading reading(layer, reader->info(), side);
    std::vector<double> line(std::size_t(reader->info().width) * std::size_t(reader->info().channels));
    for (Rows rows = reader->read(16); rows.height() > 0; rows = reader->read(16))
    {
      for (int y = rows.y(); y < rows.y() + rows.height(); ++y)
      {
        toDoubles(rows, y, line);
        reading.row(y, line);
      }
    }
    out.counts = std::move(reading.Counts);
    out.samples = std::move(reading.Samples);
  }
  catch (const Error& error)
  {
    out.note = error.what();
  }
  return out;
}

/// Of the finite values of a channel in all pictures, without the outermost hundredth on either side.
std::pair<double, double> rangeOf(const std::vector<ReportSamples>& all, std::size_t channel)
{
  std::vector<double> values;
  for (const ReportSamples& samples : all)
  {
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

/// Colours of a layer, with one range for all pictures, and what the page says of them.
struct Painting
{
  LayerColors colors;
  ReportJson legend;
};

Painting paintingOf(const ReportLayer& layer, const std::vector<ReportSamples>& all)
{
  const ImageInfo info = all.empty() ? ImageInfo() : all.front().info;
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

/// "width height pixel-width pixel-height channels type|png|values".
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

void addCounts(LayerResult& result, const ReportLayer& layer, std::size_t picture, PictureCounts counts)
{
  ++result.counted;
  std::uint64_t pixels = 0;
  switch (layer.counted)
  {
    case Counted::Nothing:
      return;
    case Counted::Numbers:
      pixels = counts.numbers.values + counts.numbers.nothing;
      result.covered[picture] = pixels > 0 ? double(counts.numbers.values) / double(pixels) : 0;
      return result.numbers.merge(counts.numbers);
    case Counted::Brightness:
      result.means[picture] =
        counts.brightness.values > 0 ? counts.brightness.sum / double(counts.brightness.values) : 0;
      return result.brightness.merge(counts.brightness);
    case Counted::Objects:
    case Counted::Classes:
      break;
  }
  for (const auto& [id, count] : counts.ids)
  {
    pixels += count;
  }
  result.covered[picture] = pixels > 0 ? double(pixels - counts.ids[0]) / double(pixels) : 0;
  result.ids[picture] = std::move(counts.ids);
}
} // namespace

int middleOf(int i, int samples, int pixels)
{
  return (firstOf(i, samples, pixels) + endOf(i, samples, pixels) - 1) / 2;
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

LayerResult readLayer(const ReportSource& source, const ReportLayer& layer, int side, ThreadPool& pool,
  const std::function<void(std::size_t shown, const std::string& text)>& write)
{
  LayerResult result;
  std::vector<std::size_t> wanted;
  for (const auto& [picture, path] : layer.files)
  {
    const bool isShown = std::binary_search(source.shown.begin(), source.shown.end(), picture);
    if (isShown || layer.counted != Counted::Nothing)
    {
      wanted.push_back(picture);
    }
  }
  std::vector<std::size_t> places; // of samples, among the shown
  std::vector<ReportSamples> samples;
  for (std::size_t first = 0; first < wanted.size(); first += pictureBlock)
  {
    std::vector<ReadPicture> block(std::min(pictureBlock, wanted.size() - first));
    const auto sideOf = [&](std::size_t picture)
    { return std::binary_search(source.shown.begin(), source.shown.end(), picture) ? side : 0; };
    pool.parallelFor(static_cast<int>(block.size()),
      [&](int i)
      {
        const std::size_t picture = wanted[first + std::size_t(i)];
        block[std::size_t(i)] = readPicture(source, layer, picture, sideOf(picture));
      });
    for (std::size_t i = 0; i < block.size(); ++i)
    {
      const std::size_t picture = wanted[first + i];
      if (!block[i].counts)
      {
        result.notes.push_back(block[i].note);
        continue;
      }
      addCounts(result, layer, picture, std::move(*block[i].counts));
      if (block[i].samples.width > 0)
      {
        const auto place = std::lower_bound(source.shown.begin(), source.shown.end(), picture);
        places.push_back(std::size_t(place - source.shown.begin()));
        samples.push_back(std::move(block[i].samples));
      }
    }
  }
  const Painting painting = paintingOf(layer, samples);
  result.legend = painting.legend;
  std::vector<std::string> texts(samples.size());
  pool.parallelFor(static_cast<int>(samples.size()),
    [&](int i)
    {
      const ReportSamples& one = samples[std::size_t(i)];
      // a file of another shape than the first cannot be coloured with it
      const bool like =
        one.info.channels == samples.front().info.channels && one.info.type == samples.front().info.type;
      texts[std::size_t(i)] = blockOf(one, like ? painting.colors : paintingOf(layer, { one }).colors);
    });
  for (std::size_t i = 0; i < texts.size(); ++i)
  {
    write(places[i], texts[i]);
  }
  return result;
}

} // namespace dgtk
