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
  : Values(dataset.open(shot, layer))
{
  for (const auto& [other, wanted] : classes)
  {
    this->Filters.push_back({ dataset.open(shot, other + "_class", { "png" }), wanted, {} });
  }
}

void ClassedRows::next()
{
  this->Row = this->Values->read(1);
  for (Filter& filter : this->Filters)
  {
    filter.row = filter.reader->read(1);
  }
}

double ClassedRows::at(int x, int channel) const
{
  const bool wanted = std::all_of(this->Filters.begin(), this->Filters.end(),
    [x](const Filter& filter)
    {
      const double found = valueAt(filter.row, x, filter.row.y());
      return std::find(filter.wanted.begin(), filter.wanted.end(), found) != filter.wanted.end();
    });
  const double value = valueAt(this->Row, x, this->Row.y(), channel);
  return wanted && std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
}

} // namespace dgtk
