// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkClassedRows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

void addClasses(PixelEncoding& encoding, const std::string& layer, const WantedClasses& classes)
{
  for (const auto& [other, wanted] : classes)
  {
    encoding.numbers[other == layer ? "classes" : "classes_of_" + other] = wanted;
  }
}

ClassedRows::ClassedRows(
  const DatasetView& dataset, const DatasetShot& shot, const std::string& layer, const WantedClasses& classes)
  : Layer(layer)
  , Values(dataset.open(shot, layer))
{
  const bool usual = classes.empty() && !dataset.file(shot, layer + "_class", { "png" }).empty();
  for (const auto& [other, wanted] : usual ? WantedClasses{ { layer, placedClasses() } } : classes)
  {
    this->Filters.push_back({ dataset.open(shot, other + "_class", { "png" }), wanted, {} });
  }
}

void ClassedRows::next()
{
  constexpr int together = 16;
  ++this->Y;
  if (this->Y >= this->Block.y() + this->Block.height())
  {
    this->Block = this->Values->read(together);
    for (Filter& filter : this->Filters)
    {
      filter.rows = filter.reader->read(together);
    }
  }
  if (this->Filters.size() == 1 && this->Filters[0].wanted == placedClasses())
  {
    this->countGone();
  }
}

void ClassedRows::countGone()
{
  for (int x = 0; x < this->Block.width(); ++x)
  {
    const bool gone =
      valueAt(this->Filters[0].rows, x, this->Y) == 0 && std::isfinite(valueAt(this->Block, x, this->Y));
    this->Gone += gone ? 1 : 0;
  }
}

void ClassedRows::reportGone(ExportSink& sink, int channels) const
{
  if (this->Gone > 0)
  {
    const std::uint64_t values = this->Gone * static_cast<unsigned>(channels);
    sink.rounding({ this->Layer, "px", 0, values, values });
  }
}

double ClassedRows::at(int x, int channel) const
{
  const bool wanted = std::all_of(this->Filters.begin(), this->Filters.end(),
    [this, x](const Filter& filter)
    {
      const double found = valueAt(filter.rows, x, this->Y);
      return std::find(filter.wanted.begin(), filter.wanted.end(), found) != filter.wanted.end();
    });
  const double value = valueAt(this->Block, x, this->Y, channel);
  return wanted && std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
}

void ClassedRows::row(std::vector<double>& values) const
{
  if (this->Filters.empty() && this->Block.type() == PixelType::Float64 && this->Block.channels() == 1)
  {
    const double* const from = this->Block.row<double>(this->Y);
    std::transform(from, from + values.size(), values.begin(),
      [](double v) { return std::isfinite(v) ? v : std::numeric_limits<double>::quiet_NaN(); });
    return;
  }
  for (std::size_t x = 0; x < values.size(); ++x)
  {
    values[x] = this->at(static_cast<int>(x));
  }
}

} // namespace dgtk
