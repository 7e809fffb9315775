// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkClassedRows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

ClassedRows::ClassedRows(
  const DatasetView& dataset, const DatasetShot& shot, const std::string& layer, const std::vector<double>& classes)
  : Values(dataset.open(shot, layer))
  , Wanted(classes)
{
  if (!classes.empty())
  {
    this->Classes = dataset.open(shot, layer + "_class", { "png" });
  }
}

void ClassedRows::next()
{
  this->Row = this->Values->read(1);
  if (this->Classes)
  {
    this->ClassRow = this->Classes->read(1);
  }
}

double ClassedRows::at(int x, int channel) const
{
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  if (this->Classes && std::find(this->Wanted.begin(), this->Wanted.end(),
                         valueAt(this->ClassRow, x, this->ClassRow.y())) == this->Wanted.end())
  {
    return nothing;
  }
  const double value = valueAt(this->Row, x, this->Row.y(), channel);
  return std::isfinite(value) ? value : nothing;
}

} // namespace dgtk
