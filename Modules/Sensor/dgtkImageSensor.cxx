// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkImageSensor.h"

#include "dgtkJpegArtefacts.h"
#include "dgtkMosaic.h"
#include "dgtkPhotosites.h"
#include "dgtkPointSpread.h"
#include "dgtkPortableMath.h"
#include "dgtkResponse.h"
#include "dgtkRowWindow.h"

#include <optional>

namespace dgtk
{

using namespace sensor;

struct ImageSensor::Impl
{
  Impl(const ImageSensorSetup& setup, Sink sink, ThreadPool* pool)
    : Width(setup.width)
    , Height(setup.height)
    , Bayer(setup.parameters.bayer)
    , Out(std::move(sink))
    , Pool(pool)
    , Spread(setup.parameters.psf)
    , Sites(setup)
    , Curve(setup.parameters, setup.key)
    , Light(setup.height, this->Spread.radius())
    , Raw(setup.height, this->Bayer == BayerPattern::None ? 0 : 1)
  {
    if (setup.parameters.jpegQuality > 0)
    {
      this->Jpeg.emplace(setup.parameters.jpegQuality, !setup.parameters.jpegFullChroma);
    }
  }

  void write(int rows, const float* rgb);
  void emit(std::vector<std::vector<float>>& rows);
  void emitCoded(std::vector<std::vector<float>>& rows);

  int Width;
  int Height;
  BayerPattern Bayer;
  Sink Out;
  ThreadPool* Pool;
  PointSpread Spread;
  Photosites Sites;
  Response Curve;
  std::optional<JpegArtefacts> Jpeg;
  RowWindow<float> Light;                 // linear, 3 values a pixel
  RowWindow<float> Raw;                   // digital values, 3 a pixel or 1 of a mosaic
  std::vector<std::vector<float>> Blocks; // rows that wait for the rest of their blocks
  int Written = 0;
};

void ImageSensor::Impl::write(int count, const float* rgb)
{
  const std::size_t values = std::size_t(this->Width) * 3;
  std::vector<std::vector<float>> rows(static_cast<std::size_t>(count));
  forEach(this->Pool, count,
    [&](int i)
    {
      std::vector<float> row(rgb + i * values, rgb + (i + 1) * values);
      for (float& v : row)
      {
        v = static_cast<float>(portable::linearFromSrgb(v));
      }
      rows[static_cast<std::size_t>(i)] = this->Spread.prepare(std::move(row));
    });
  for (std::vector<float>& row : rows)
  {
    this->Light.push(std::move(row));
  }
  rows = computeReady(
    this->Light, this->Pool, [&](int y) { return this->Sites.expose(y, this->Spread.blur(this->Light, y)); });
  for (std::vector<float>& row : rows)
  {
    this->Raw.push(std::move(row));
  }
  rows = computeReady(this->Raw, this->Pool,
    [&](int y)
    {
      std::vector<float> row =
        this->Bayer == BayerPattern::None ? this->Raw.at(y) : demosaicRow(this->Raw, this->Height, this->Bayer, y);
      this->Curve.apply(y, row);
      return row;
    });
  this->Jpeg ? this->emitCoded(rows) : this->emit(rows);
}

void ImageSensor::Impl::emitCoded(std::vector<std::vector<float>>& rows)
{
  std::move(rows.begin(), rows.end(), std::back_inserter(this->Blocks));
  const auto block = static_cast<std::size_t>(this->Jpeg->blockRows());
  const bool last = this->Written + static_cast<int>(this->Blocks.size()) == this->Height;
  const std::size_t whole = last ? this->Blocks.size() : this->Blocks.size() / block * block;
  std::vector<std::vector<std::vector<float>>> strips;
  for (std::size_t y = 0; y < whole; ++y)
  {
    if (y % block == 0)
    {
      strips.emplace_back();
    }
    strips.back().push_back(std::move(this->Blocks[y]));
  }
  this->Blocks.erase(this->Blocks.begin(), this->Blocks.begin() + static_cast<std::ptrdiff_t>(whole));
  forEach(this->Pool, static_cast<int>(strips.size()),
    [&](int i) { this->Jpeg->apply(strips[static_cast<std::size_t>(i)]); });
  for (std::vector<std::vector<float>>& strip : strips)
  {
    this->emit(strip);
  }
}

void ImageSensor::Impl::emit(std::vector<std::vector<float>>& rows)
{
  if (rows.empty())
  {
    return;
  }
  std::vector<float> joined;
  joined.reserve(rows.size() * this->Width * 3);
  for (const std::vector<float>& row : rows)
  {
    joined.insert(joined.end(), row.begin(), row.end());
  }
  this->Out(this->Written, static_cast<int>(rows.size()), joined.data());
  this->Written += static_cast<int>(rows.size());
}

ImageSensor::ImageSensor(const ImageSensorSetup& setup, Sink sink, ThreadPool* pool)
  : Self(std::make_unique<Impl>(setup, std::move(sink), pool))
{
}

ImageSensor::~ImageSensor() = default;

void ImageSensor::write(int rows, const float* rgb) { this->Self->write(rows, rgb); }

} // namespace dgtk
