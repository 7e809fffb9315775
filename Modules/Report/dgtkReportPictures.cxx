// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReportPictures.h"

#include "dgtkError.h"
#include "dgtkFolder.h"
#include "dgtkLayerColors.h"
#include "dgtkPixelValues.h"
#include "dgtkReportPainting.h"

#include <algorithm>
#include <cmath>
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

/// Takes the rows of one picture.
class PictureReading
{
public:
  PictureReading(const LayerSpec& spec, Counted counted, const ImageInfo& info, int side)
    : What(counted)
    , Info(info)
    , Channels(std::size_t(info.channels))
    , Colors(lookOf(spec, info), spec, info)
    , Averages(lookOf(spec, info) == LayerLook::Picture)
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
    switch (this->What)
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

  Counted What;
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
  Counted counted = Counted::Nothing;
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
    const std::string& path = layer.files.find(picture)->second;
    const std::unique_ptr<RowReader> reader = openLayerFile(Folder(view.folder()).fileAt(path));
    out.counted = countedOf(layer.spec, path);
    PictureReading reading(layer.spec, out.counted, reader->info(), side);
    std::vector<double> line(std::size_t(reader->info().width) * std::size_t(reader->info().channels));
    for (Rows rows = reader->read(16); rows.height() > 0; rows = reader->read(16))
    {
      for (int y = rows.y(); y < rows.y() + rows.height(); ++y)
      {
        copyValues(rows, 0, y, line.size(), line.data());
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

void addCounts(LayerResult& result, Counted counted, std::size_t picture, PictureCounts counts)
{
  result.counted += counted != Counted::Nothing;
  std::uint64_t pixels = 0;
  switch (counted)
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

LayerResult readLayer(const ReportSource& source, const ReportLayer& layer, int side, ThreadPool& pool,
  const std::function<void(std::size_t shown, const std::string& text)>& write)
{
  LayerResult result;
  std::vector<std::size_t> wanted;
  for (const auto& [picture, path] : layer.files)
  {
    const bool isShown = std::binary_search(source.shown.begin(), source.shown.end(), picture);
    if (isShown || countedOf(layer.spec, path) != Counted::Nothing)
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
      addCounts(result, block[i].counted, picture, std::move(*block[i].counts));
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
      const ImageInfo& example = exampleOf(samples).info; // a file of another shape cannot be coloured with it
      const bool like = one.info.channels == example.channels && one.info.type == example.type;
      texts[std::size_t(i)] = blockOf(one, like ? painting.colors : paintingOf(layer, { one }).colors);
    });
  for (std::size_t i = 0; i < texts.size(); ++i)
  {
    write(places[i], texts[i]);
  }
  return result;
}

} // namespace dgtk
