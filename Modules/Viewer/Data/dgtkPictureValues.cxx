// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPictureValues.h"

#include "dgtkObjectDocuments.h"
#include "dgtkPixelValues.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace dgtk
{

namespace
{
constexpr std::uint64_t blockBytes = 1 << 20; // read between two questions whether to go on

constexpr int largestSide = 16384; // of what is kept; painting has 16 bits for a coordinate

int kept(int length, int step) { return (length + step - 1) / step; }

/// The smallest step that keeps at most `budget` bytes and sides that can be painted.
int stepFor(const PixelRect& window, double pixelBytes, std::uint64_t budget)
{
  int step = 1;
  while (double(kept(window.width, step)) * kept(window.height, step) * pixelBytes > double(budget) ||
         std::max(kept(window.width, step), kept(window.height, step)) > largestSide)
  {
    ++step;
  }
  return step;
}

PixelRect partOf(const PixelRect& wanted, int width, int height)
{
  if (wanted.width < 1 || wanted.height < 1)
  {
    return { 0, 0, width, height };
  }
  PixelRect part = wanted;
  part.x = std::clamp(wanted.x, 0, width - 1);
  part.y = std::clamp(wanted.y, 0, height - 1);
  part.width = std::clamp(wanted.x + wanted.width - part.x, 1, width - part.x);
  part.height = std::clamp(wanted.y + wanted.height - part.y, 1, height - part.y);
  return part;
}

/// Copies the kept pixels of a row.
void keep(PictureValues& picture, const Rows& rows, int y)
{
  const std::size_t pixel = bytesOf(rows.type()) * static_cast<std::size_t>(rows.channels());
  const std::byte* const from = rows.data() + std::size_t(y - rows.y()) * rows.rowBytes();
  std::byte* const to = picture.values.data() + std::size_t(picture.row(y)) * picture.values.rowBytes();
  if (picture.step == 1)
  {
    std::memcpy(to, from + std::size_t(picture.window.x) * pixel, picture.values.rowBytes());
    return;
  }
  for (int column = 0; column < picture.columns(); ++column)
  {
    std::memcpy(to + std::size_t(column) * pixel, from + std::size_t(picture.x(column)) * pixel, pixel);
  }
}

void readRows(PictureValues& picture, RowReader& reader, const PictureRead& read)
{
  const std::uint64_t rowBytes = picture.info.pixelBytes() / std::uint64_t(picture.info.height);
  const int block =
    picture.step > 1 ? 1 : int(std::max<std::uint64_t>(1, blockBytes / std::max<std::uint64_t>(rowBytes, 1)));
  int next = 0;
  for (int row = 0; row < picture.rows();)
  {
    if (read.goOn && !read.goOn())
    {
      picture = {};
      return;
    }
    reader.skip(picture.y(row) - next);
    const Rows rows = reader.read(std::min(block, picture.rows() - row));
    for (int y = rows.y(); y < rows.y() + rows.height(); ++y)
    {
      keep(picture, rows, y);
    }
    next = rows.y() + rows.height();
    row += rows.height();
  }
}

/// What is shown of a layered depth image.
enum class LdiShow
{
  Color,
  Depth,
  Count
};

LdiShow showOf(const PictureLayer& layer)
{
  return layer.part == "depth" ? LdiShow::Depth : layer.part == "count" ? LdiShow::Count : LdiShow::Color;
}

void fillLdi(PictureValues& picture, LdiShow show, int surface)
{
  const LdiPixels& ldi = *picture.ldi;
  const std::size_t pixels = ldi.first.size() - 1;
  float* const colors = picture.values.row<float>(0);
  double* const depths = picture.values.row<double>(0);
  std::uint32_t* const counts = picture.values.row<std::uint32_t>(0);
  for (std::size_t i = 0; i < pixels; ++i)
  {
    const std::uint64_t count = ldi.first[i + 1] - ldi.first[i];
    const LdiRecord* const record =
      count > std::uint64_t(surface) ? &ldi.records[ldi.first[i] + std::uint64_t(surface)] : nullptr;
    if (show == LdiShow::Count)
    {
      counts[i] = static_cast<std::uint32_t>(count);
    }
    else if (show == LdiShow::Depth)
    {
      depths[i] = record ? record->depth : std::numeric_limits<double>::infinity();
    }
    for (std::size_t c = 0; show == LdiShow::Color && c < 3; ++c)
    {
      colors[3 * i + c] = record ? float(record->rgba[c]) : std::numeric_limits<float>::quiet_NaN();
    }
  }
}

/// The records of the kept pixels. False when it was told to stop.
bool readRecords(PictureValues& picture, LdiReader& reader, const PictureRead& read)
{
  auto ldi = std::make_shared<LdiPixels>();
  LdiRow row;
  for (int y = 0; y < picture.window.y + picture.window.height && reader.read(row); ++y)
  {
    if (read.goOn && !read.goOn())
    {
      return false;
    }
    if (y < picture.window.y || picture.y(picture.row(y)) != y)
    {
      continue;
    }
    std::size_t at = 0;
    int column = 0;
    for (int x = 0; x < reader.width() && column < picture.columns(); ++x)
    {
      const std::uint32_t count = row.counts[std::size_t(x)];
      if (x == picture.x(column))
      {
        ldi->first.push_back(ldi->records.size());
        const auto from = row.records.begin() + std::ptrdiff_t(at);
        ldi->records.insert(ldi->records.end(), from, from + count);
        picture.surfaces = std::max(picture.surfaces, static_cast<int>(count));
        ++column;
      }
      at += count;
    }
  }
  ldi->first.push_back(ldi->records.size());
  picture.ldi = ldi;
  return true;
}

PictureValues readLdi(const std::string& path, const PictureLayer& layer, const PictureRead& read)
{
  LdiReader reader(path);
  PictureValues picture;
  picture.layer = layer;
  const LdiShow show = showOf(layer);
  picture.info = { "ldi", show == LdiShow::Color ? PixelType::UInt8 : PixelType::Float64,
    show == LdiShow::Color ? 3 : 1, reader.width(), reader.height() };
  picture.window = partOf(read.window, reader.width(), reader.height());
  constexpr double likelyBytes = 4 * sizeof(LdiRecord);
  picture.step = read.step > 0 ? read.step : stepFor(picture.window, likelyBytes, read.budget);
  const PixelType type = show == LdiShow::Color   ? PixelType::Float32
                         : show == LdiShow::Depth ? PixelType::Float64
                                                  : PixelType::UInt32;
  picture.values = Rows(type, picture.info.channels, kept(picture.window.width, picture.step), 0,
    kept(picture.window.height, picture.step));
  if (!readRecords(picture, reader, read))
  {
    return {};
  }
  fillLdi(picture, show, read.surface);
  return picture;
}

void fillMask(PictureValues& picture, const MaskRecord& mask, int height)
{
  std::size_t run = 0; // of columns from left to right, each from top to bottom; odd ones are inside
  std::uint64_t end = mask.counts.front();
  for (int column = 0; column < picture.columns(); ++column)
  {
    for (int row = 0; row < picture.rows(); ++row)
    {
      const std::uint64_t at = std::uint64_t(picture.x(column)) * std::uint64_t(height) + std::uint64_t(picture.y(row));
      while (at >= end)
      {
        end += mask.counts[++run];
      }
      picture.values.row<std::uint32_t>(row)[column] = run % 2 == 1 ? mask.id : 0;
    }
  }
}

/// The object's id in its mask, 0 outside.
PictureValues readMask(const std::string& path, const PictureLayer& layer, const PictureRead& read)
{
  const AmodalMasks file = readAmodal(path);
  PictureValues picture;
  picture.layer = layer;
  picture.info = { "json", PixelType::UInt32, 1, file.width, file.height };
  picture.window = partOf(read.window, file.width, file.height);
  picture.step = read.step > 0 ? read.step : stepFor(picture.window, sizeof(std::uint32_t), read.budget);
  picture.values =
    Rows(PixelType::UInt32, 1, kept(picture.window.width, picture.step), 0, kept(picture.window.height, picture.step));
  std::fill_n(picture.values.data(), picture.values.bytes(), std::byte{ 0 });
  for (const MaskRecord& mask : file.masks)
  {
    if (mask.id == std::uint32_t(read.surface) + 1)
    {
      fillMask(picture, mask, file.height);
    }
  }
  return picture;
}
} // namespace

std::uint64_t PictureValues::bytes() const
{
  return this->values.bytes() +
         (this->ldi ? this->ldi->records.size() * sizeof(LdiRecord) + this->ldi->first.size() * 8 : 0);
}

int PictureValues::place(int kept, int start, int length) const
{
  return start + std::min(kept * this->step + this->step / 2, length - 1);
}

bool PictureValues::inside(int x, int y) const
{
  return x >= this->window.x && y >= this->window.y && x < this->window.x + this->window.width &&
         y < this->window.y + this->window.height;
}

bool PictureValues::exact(int x, int y) const
{
  return this->inside(x, y) && this->x(this->column(x)) == x && this->y(this->row(y)) == y;
}

void PictureValues::get(int column, int row, double* channels) const
{
  copyValues(this->values, column, row, std::size_t(this->values.channels()), channels);
}

bool isObjectMask(const PictureLayer& layer) { return layer.format == "json"; }

PictureValues readPicture(const std::string& path, const PictureLayer& layer, const PictureRead& read)
{
  if (layer.format == "ldi")
  {
    return readLdi(path, layer, read);
  }
  if (isObjectMask(layer))
  {
    return readMask(path, layer, read);
  }
  const std::unique_ptr<RowReader> reader = openLayerFile(path);
  PictureValues picture;
  picture.layer = layer;
  picture.info = reader->info();
  picture.window = partOf(read.window, picture.info.width, picture.info.height);
  const double pixelBytes = double(bytesOf(picture.info.type)) * picture.info.channels;
  picture.step = read.step > 0 ? read.step : stepFor(picture.window, pixelBytes, read.budget);
  picture.values = Rows(picture.info.type, picture.info.channels, kept(picture.window.width, picture.step), 0,
    kept(picture.window.height, picture.step));
  readRows(picture, *reader, read);
  return picture;
}

std::pair<int, int> pictureSize(const std::string& path, const PictureLayer& layer)
{
  if (layer.format == "ldi")
  {
    const LdiReader reader(path);
    return { reader.width(), reader.height() };
  }
  if (isObjectMask(layer))
  {
    const AmodalMasks masks = readAmodal(path);
    return { masks.width, masks.height };
  }
  const ImageInfo info = openLayerFile(path)->info();
  return { info.width, info.height };
}

} // namespace dgtk
