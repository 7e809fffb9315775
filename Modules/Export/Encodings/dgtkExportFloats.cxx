// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportFloats.h"

#include "dgtkClassedRows.h"
#include "dgtkLayerFile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace dgtk
{

namespace
{
constexpr float magic = 202021.25F; ///< of .flo and .dpt

std::string headOf(const FloatFile& form, int width, int height)
{
  std::string head;
  if (form.kind == FloatFile::Kind::Pfm)
  {
    return (form.channels == 1 ? "Pf\n" : "PF\n") + std::to_string(width) + ' ' + std::to_string(height) + "\n-1\n";
  }
  if (form.kind == FloatFile::Kind::Colmap)
  {
    return std::to_string(width) + '&' + std::to_string(height) + '&' + std::to_string(form.channels) + '&';
  }
  putLittle(head, magic);
  putLittle(head, width);
  putLittle(head, height);
  return head;
}

PixelEncoding encodingOf(const FloatFile& form)
{
  const char* kind = form.kind == FloatFile::Kind::Dpt      ? "dpt"
                     : form.kind == FloatFile::Kind::Colmap ? "colmap"
                                                            : "float";
  PixelEncoding encoding{ kind, {} };
  if (std::isfinite(form.nothing))
  {
    encoding.numbers["nothing"] = { double(form.nothing) };
  }
  return encoding;
}
} // namespace

float FloatRounder::operator()(double value)
{
  if (std::isnan(value))
  {
    return this->Nothing;
  }
  ++this->Account.values;
  const auto rounded = static_cast<float>(value);
  if (!std::isfinite(rounded))
  {
    ++this->Account.withoutCode;
    return this->Nothing;
  }
  this->Account.largest = std::max(this->Account.largest, std::abs(double(rounded) - value));
  return rounded;
}

float FloatRounder::length(double value)
{
  return (*this)(value > 0 && static_cast<float>(value) == 0 ? std::numeric_limits<double>::infinity() : value);
}

void writeFloats(ExportSink& sink, const std::string& name, const ExportedPixels& pixels, const FloatFile& form,
  int width, int height, int filled, const std::function<void(int y, double* row)>& fill)
{
  FloatRounder rounder(form.nothing, pixels.layer, form.unit);
  const bool planes = form.kind == FloatFile::Kind::Colmap;
  const std::size_t rowValues = std::size_t(width) * static_cast<unsigned>(planes ? 1 : form.channels);
  const std::size_t nextValue = planes ? 1 : static_cast<unsigned>(form.channels);
  const std::size_t nextChannel = planes ? rowValues * static_cast<unsigned>(height) : 1;
  std::vector<double> row(std::size_t(width) * static_cast<unsigned>(filled));
  std::vector<float> all(std::size_t(width) * static_cast<unsigned>(height) * static_cast<unsigned>(form.channels));
  for (int y = 0; y < height; ++y)
  {
    fill(y, row.data());
    const int line = form.kind == FloatFile::Kind::Pfm ? height - 1 - y : y;
    for (int x = 0; x < width; ++x)
    {
      for (int c = 0; c < filled; ++c)
      {
        all[line * rowValues + x * nextValue + c * nextChannel] = rounder(row[std::size_t(x) * filled + c]);
      }
    }
  }
  ExportedPixels described = pixels;
  if (described.encoding.kind.empty())
  {
    described.encoding = encodingOf(form);
  }
  const std::unique_ptr<ExportFile> file = sink.open(name, described);
  file->write(headOf(form, width, height));
  file->write(all.data(), all.size() * sizeof(float));
  file->finish();
  sink.rounding(rounder.account());
}

void writeFloatLayer(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& name, const FloatFile& form, const std::vector<std::uint32_t>& leftOut)
{
  ClassedRows rows(dataset, shot, layer);
  const int filled = rows.info().channels;
  ExportedPixels pixels{ layer, &shot, {} };
  std::unique_ptr<RowReader> objects;
  if (!leftOut.empty())
  {
    objects = dataset.open(shot, "objects");
    pixels.encoding = encodingOf(form);
    pixels.encoding.numbers["left_out"] = { leftOut.begin(), leftOut.end() };
  }
  writeFloats(sink, name, pixels, form, rows.info().width, rows.info().height, filled,
    [&](int y, double* row)
    {
      rows.next();
      const Rows ids = objects ? objects->read(1) : Rows();
      for (int i = 0; i < rows.info().width * filled; ++i)
      {
        const bool out =
          objects && std::find(leftOut.begin(), leftOut.end(), idAt(ids, i / filled, y)) != leftOut.end();
        row[i] = out ? std::numeric_limits<double>::quiet_NaN() : rows.at(i / filled, i % filled);
      }
    });
  rows.reportGone(sink, filled);
}

} // namespace dgtk
