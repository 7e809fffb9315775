// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportPng.h"

#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportJpeg.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkLayerFile.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

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

namespace
{
std::string pngOf(const DatasetView& dataset, const DatasetShot& shot, const std::string& layer)
{
  std::string source = dataset.file(shot, layer, { "png" });
  if (source.empty())
  {
    throw UsageError("the pictures of layer " + layer + " are no PNG, which the format needs (camera " +
                     quoted(shot.name()) + ", frame " + std::to_string(shot.frame()) + ')');
  }
  dataset.open(shot, layer, { "png" }); // which compares its size
  return source;
}

LayerRounding roundingOf(const DatasetShot& shot, const std::string& layer, int largest)
{
  return { layer, "levels", double(largest), std::uint64_t(shot.camera.width) * shot.camera.height, 0 };
}
} // namespace

EncodedPicture encodePicture(
  const DatasetView& dataset, const DatasetShot& shot, const std::string& layer, const OptionValues& options)
{
  const std::string source = pngOf(dataset, shot, layer);
  if (pictureExtension(options) != "png")
  {
    JpegPicture picture = encodeJpeg(readLayerFile(dataset.pathOf(source)), exported::quality().of(options));
    return { std::move(picture.bytes), roundingOf(shot, layer, picture.largest) };
  }
  return { dataset.bytesOf(source), roundingOf(shot, layer, 0) };
}

void writePicture(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& name, const OptionValues& options)
{
  if (pictureExtension(options) == "png")
  {
    sink.copy(name, pngOf(dataset, shot, layer), { layer, &shot, { "copy", {} } });
    sink.rounding(roundingOf(shot, layer, 0));
    return;
  }
  const EncodedPicture picture = encodePicture(dataset, shot, layer, options);
  sink.write(name, picture.bytes, { layer, &shot, { "picture", { { "rounding", { picture.rounding.largest } } } } });
  sink.rounding(picture.rounding);
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
  const LayerRounding rounding{ this->Layer, this->Code.unit, this->Code.scale / 2, this->Values, this->Without };
  requireCodes(rounding, options, "camera " + quoted(shot.name()) + ", frame " + std::to_string(shot.frame()));
  sink.rounding(rounding);
}

void writeCodedPng(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& name, const LinearCode& code, const OptionValues& options, const WantedClasses& classes,
  const std::function<void(int y, const std::vector<std::uint32_t>& codes)>& row)
{
  ClassedRows rows(dataset, shot, layer, classes);
  CodeCounter counter(code, layer);
  PngEncoder::Header header;
  header.width = rows.info().width;
  header.height = rows.info().height;
  header.bitDepth = 16;
  header.channels = 1;
  ExportedPixels pixels{ layer, &shot, code.encoding() };
  addClasses(pixels.encoding, layer, classes);
  std::vector<double> values(std::size_t(header.width));
  std::vector<std::uint32_t> codes(values.size());
  writePng(sink, name, pixels, header,
    [&](int y, unsigned char* bytes)
    {
      rows.next();
      rows.row(values);
      for (std::size_t x = 0; x < values.size(); ++x)
      {
        codes[x] = counter(values[x]);
        putBig16(bytes + 2 * x, codes[x]);
      }
      if (row)
      {
        row(y, codes);
      }
    });
  counter.report(sink, shot, options);
  rows.reportGone(sink, 1);
}

namespace
{
PixelEncoding encodingOfIds(const std::map<std::uint32_t, std::uint32_t>& codes, IdBytes bytes)
{
  PixelEncoding encoding{ "ids", { { "nothing", { 0 } } } };
  std::vector<double>& pairs = encoding.numbers["codes"];
  for (const auto& [id, code] : codes)
  {
    pairs.insert(pairs.end(), { double(id), double(code) });
  }
  if (bytes == IdBytes::RedHigh)
  {
    encoding.numbers["high_first"] = { 1 };
  }
  return encoding;
}
} // namespace

void writeIdPng(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& name, const std::map<std::uint32_t, std::uint32_t>& codes, IdBytes bytes)
{
  const std::unique_ptr<RowReader> reader = dataset.open(shot, layer);
  PngEncoder::Header header;
  header.width = reader->info().width;
  header.height = reader->info().height;
  header.channels = bytes == IdBytes::Gray ? 1 : 3;
  header.prediction = PngPrediction::Labels;
  writePng(sink, name, { layer, &shot, encodingOfIds(codes, bytes) }, header,
    [&](int y, unsigned char* row)
    {
      const Rows rows = reader->read(1);
      std::optional<std::uint32_t> last; // neighbours are mostly of one object
      std::uint32_t code = 0;
      for (int x = 0; x < header.width; ++x)
      {
        const std::uint32_t id = idAt(rows, x, y);
        if (id != last)
        {
          const auto found = codes.find(id);
          code = found == codes.end() ? 0 : found->second;
          last = id;
        }
        for (int c = 0; c < header.channels; ++c)
        {
          const int place = bytes == IdBytes::RedLow ? c : header.channels - 1 - c;
          *row++ = static_cast<unsigned char>(code >> (8 * place));
        }
      }
    });
  sink.rounding({ layer, "id", 0, std::uint64_t(header.width) * header.height, 0 });
}

} // namespace dgtk
