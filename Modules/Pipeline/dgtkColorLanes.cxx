// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkOutputLanes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
template <typename T>
void round(const float* from, T* to, std::size_t count)
{
  constexpr float top = std::numeric_limits<T>::max();
  for (std::size_t i = 0; i < count; ++i)
  {
    to[i] = static_cast<T>(std::min(std::max(from[i], 0.0f), 1.0f) * top + 0.5f);
  }
}

// Rows that are encoded at once.
constexpr int blockPixels = 1 << 18;

class ColorLane : public OutputLane
{
public:
  ColorLane(const WorkPlan& plan, const LayerSpec& spec, const std::string& name, const View& view,
    const std::string& format, std::vector<float> Band::*rgb)
    : Spec(spec)
    , Name(name)
    , Rgb(rgb)
    , Writer(makeLayerWriter(
        format, FilePlace(plan.request.folder, this->Name), this->Spec, view.model->width(), view.model->height()))
  {
  }

  void write(const Band& band) override
  {
    const int rows = std::max(1, blockPixels / band.rect.width);
    for (int y = 0; y < band.rect.height; y += rows)
    {
      this->Writer->write(quantise(band, this->Spec, band.rect.y + y, std::min(rows, band.rect.height - y), this->Rgb));
    }
  }

  std::vector<FinishedFile> finish() override
  {
    FileRecord record = this->Writer->finish();
    record.path = this->Name;
    return { { record, this->Spec.name } };
  }

private:
  LayerSpec Spec;
  std::string Name;
  std::vector<float> Band::*Rgb;
  std::unique_ptr<LayerWriter> Writer;
};

// Tile rows are gathered from bands; the tiles of one row are open together.
class TilesLane : public OutputLane
{
public:
  TilesLane(const WorkPlan& plan, const Job& job, const std::string& camera, const View& view)
    : Spec(plan.colorSpec("png"))
    , Folder(plan.request.folder)
    , Names(plan.tileNames(camera, job.frame, *view.model))
    , Width(view.model->width())
    , Height(view.model->height())
    , TileWidth(std::min(plan.request.tileWidth, this->Width))
    , TileHeight(std::min(plan.request.tileHeight, this->Height))
  {
  }

  void write(const Band& band) override
  {
    const int end = band.rect.y + band.rect.height;
    for (int y = band.rect.y; y < end;)
    {
      const int row = y / this->TileHeight;
      const int stop = std::min({ end, (row + 1) * this->TileHeight, y + std::max(1, blockPixels / this->Width) });
      if (y == row * this->TileHeight)
      {
        this->open(row);
      }
      this->writeRows(quantise(band, this->Spec, y, stop - y), row);
      y = stop;
      if (y == this->Height || y == (row + 1) * this->TileHeight)
      {
        this->close();
      }
    }
  }

  std::vector<FinishedFile> finish() override { return std::move(this->Files); }

private:
  void open(int row)
  {
    const int height = std::min(this->TileHeight, this->Height - row * this->TileHeight);
    for (int x = 0; x < this->Width; x += this->TileWidth)
    {
      const std::string& name = this->Names[this->Files.size() + this->Writers.size()];
      this->Writers.push_back(makeLayerWriter(
        "png", FilePlace(this->Folder, name), this->Spec, std::min(this->TileWidth, this->Width - x), height));
    }
  }

  void writeRows(const Rows& rows, int tileRow)
  {
    const std::size_t pixelBytes = rows.rowBytes() / rows.width();
    for (std::size_t i = 0; i < this->Writers.size(); ++i)
    {
      const int x = static_cast<int>(i) * this->TileWidth;
      const int width = std::min(this->TileWidth, this->Width - x);
      Rows part(rows.type(), rows.channels(), width, rows.y() - tileRow * this->TileHeight, rows.height());
      for (int r = 0; r < rows.height(); ++r)
      {
        std::copy_n(
          rows.data() + r * rows.rowBytes() + x * pixelBytes, part.rowBytes(), part.data() + r * part.rowBytes());
      }
      this->Writers[i]->write(part);
    }
  }

  void close()
  {
    for (const std::unique_ptr<LayerWriter>& writer : this->Writers)
    {
      FileRecord record = writer->finish();
      record.path = this->Names[this->Files.size()];
      this->Files.push_back({ record, "tiles" });
    }
    this->Writers.clear();
  }

  LayerSpec Spec;
  std::string Folder;
  std::vector<std::string> Names; // of all tiles, in the order in which they are opened
  int Width;
  int Height;
  int TileWidth;
  int TileHeight;
  std::vector<std::unique_ptr<LayerWriter>> Writers;
  std::vector<FinishedFile> Files;
};
} // namespace

float linearFromEncoded(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

float encodedFromLinear(float v) { return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f; }

Rows quantise(const Band& band, const LayerSpec& spec, int y, int height, std::vector<float> Band::*rgb)
{
  const std::size_t rowValues = std::size_t(band.rect.width) * 3;
  const std::size_t count = rowValues * height;
  const float* from = (band.*rgb).data() + std::size_t(y - band.rect.y) * rowValues;
  Rows rows(spec.type, 3, band.rect.width, y, height);
  switch (spec.type)
  {
    case PixelType::UInt8:
      round(from, rows.row<std::uint8_t>(y), count);
      break;
    case PixelType::UInt16:
      round(from, rows.row<std::uint16_t>(y), count);
      break;
    default:
      std::transform(from, from + count, rows.row<float>(y), linearFromEncoded);
  }
  return rows;
}

std::unique_ptr<OutputLane> makeColorLane(
  const WorkPlan& plan, const Job& job, const std::string& camera, const View& view, const std::string& format)
{
  return makePictureLane(plan, plan.colorSpec(format),
    WorkPlan::fileName(camera, "color", job.frame, formatExtension(format)), view, format, &Band::rgb);
}

std::unique_ptr<OutputLane> makePictureLane(const WorkPlan& plan, const LayerSpec& spec, const std::string& name,
  const View& view, const std::string& format, std::vector<float> Band::*rgb)
{
  return std::make_unique<ColorLane>(plan, spec, name, view, format, rgb);
}

std::unique_ptr<OutputLane> makeTilesLane(
  const WorkPlan& plan, const Job& job, const std::string& camera, const View& view)
{
  return std::make_unique<TilesLane>(plan, job, camera, view);
}

} // namespace dgtk
