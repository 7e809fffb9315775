// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportPng.h"

#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportJpeg.h"
#include "dgtkLayerFile.h"

#include <cmath>
#include <memory>

namespace dgtk
{

void writePng(ExportSink& sink, const std::string& name, const ExportedPixels& pixels, const PngEncoder::Header& header,
  const std::function<void(int y, unsigned char* row)>& fill)
{
  const std::unique_ptr<ExportFile> file = sink.open(name, pixels);
  PngEncoder encoder(header, [&](const void* data, std::size_t bytes) { file->write(data, bytes); });
  std::vector<unsigned char> row(encoder.rowBytes());
  for (int y = 0; y < header.height; ++y)
  {
    fill(y, row.data());
    encoder.row(row.data());
  }
  encoder.finish();
  file->finish();
}

std::string pictureExtension(const OptionValues& options) { return exported::imageFormat().of(options); }

void writePicture(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& name, const OptionValues& options)
{
  const std::string source = dataset.file(shot, layer, { "png" });
  if (source.empty())
  {
    throw UsageError("the pictures of layer " + layer + " are no PNG, which the format needs (camera " +
                     quoted(shot.name()) + ", frame " + std::to_string(shot.frame()) + ')');
  }
  if (pictureExtension(options) == "png")
  {
    sink.copy(name, source, { layer, &shot, { "copy", {} } });
    sink.rounding({ layer, "levels", 0, std::uint64_t(shot.camera.width) * shot.camera.height, 0 });
    return;
  }
  const JpegPicture picture = encodeJpeg(readLayerFile(dataset.pathOf(source)), exported::quality().of(options));
  sink.write(name, picture.bytes, { layer, &shot, { "picture", { { "rounding", { double(picture.largest) } } } } });
  sink.rounding({ layer, "levels", double(picture.largest), std::uint64_t(shot.camera.width) * shot.camera.height, 0 });
}

std::uint32_t LinearCode::of(double value) const
{
  const double code = std::floor(value * this->factor / this->scale + this->offset + 0.5);
  return code >= this->least && code <= this->most ? static_cast<std::uint32_t>(code) : this->nothing;
}

PixelEncoding LinearCode::encoding(const std::string& kind) const
{
  return { kind, { { "factor", { this->factor } }, { "scale", { this->scale } }, { "offset", { this->offset } },
                   { "nothing", { double(this->nothing) } }, { "least", { double(this->least) } },
                   { "most", { double(this->most) } }, { "rounding", { this->scale / 2 } } } };
}

std::uint32_t CodeCounter::operator()(double value)
{
  if (!std::isfinite(value))
  {
    return this->Code.nothing;
  }
  const std::uint32_t code = this->Code.of(value);
  ++this->Values;
  this->Without += code == this->Code.nothing;
  return code;
}

void CodeCounter::report(ExportSink& sink, const DatasetShot& shot, const OptionValues& options) const
{
  if (this->Without > 0 && exported::outOfRange().of(options) == "refuse")
  {
    throw UsageError("out_of_range: " + std::to_string(this->Without) + " pixels of layer " + this->Layer +
                     " (camera " + quoted(shot.name()) + ", frame " + std::to_string(shot.frame()) +
                     ") have no code in the format");
  }
  sink.rounding({ this->Layer, this->Code.unit, this->Code.scale / 2, this->Values, this->Without });
}

void writeCodedPng(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& name, const LinearCode& code, const OptionValues& options)
{
  const std::unique_ptr<RowReader> reader = dataset.open(shot, layer);
  const ImageInfo& info = reader->info();
  CodeCounter counter(code, layer);
  PngEncoder::Header header;
  header.width = info.width;
  header.height = info.height;
  header.bitDepth = 16;
  header.channels = 1;
  writePng(sink, name, { layer, &shot, code.encoding() }, header,
    [&](int y, unsigned char* row)
    {
      const Rows rows = reader->read(1);
      for (int x = 0; x < info.width; ++x)
      {
        putBig16(row + 2 * std::size_t(x), counter(valueAt(rows, x, y)));
      }
    });
  counter.report(sink, shot, options);
}

} // namespace dgtk
