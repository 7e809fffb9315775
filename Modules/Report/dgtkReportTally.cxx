// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReportTally.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int octaves = 64; ///< below and above 1
constexpr int steps = 8;    ///< of an octave
} // namespace

void NumberTally::add(double value)
{
  if (!std::isfinite(value))
  {
    ++this->nothing;
    return;
  }
  this->least = this->values == 0 ? value : std::min(this->least, value);
  this->most = this->values == 0 ? value : std::max(this->most, value);
  ++this->values;
  this->sum += value;
  if (value <= 0)
  {
    ++(value < 0 ? this->negative : this->zero);
    return;
  }
  if (this->bins.empty())
  {
    this->bins.resize(2 * octaves * steps, 0);
  }
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent); // in [0.5, 1)
  const int bin = (exponent - 1 + octaves) * steps + static_cast<int>((2 * fraction - 1) * steps);
  ++this->bins[std::size_t(std::min(std::max(bin, 0), 2 * octaves * steps - 1))];
}

void NumberTally::merge(const NumberTally& other)
{
  if (other.values > 0)
  {
    this->least = this->values == 0 ? other.least : std::min(this->least, other.least);
    this->most = this->values == 0 ? other.most : std::max(this->most, other.most);
  }
  this->values += other.values;
  this->nothing += other.nothing;
  this->zero += other.zero;
  this->negative += other.negative;
  this->sum += other.sum;
  this->bins.resize(std::max(this->bins.size(), other.bins.size()), 0);
  for (std::size_t i = 0; i < other.bins.size(); ++i)
  {
    this->bins[i] += other.bins[i];
  }
}

ReportJson NumberTally::json() const
{
  ReportJson json{ { "values", this->values }, { "nothing", this->nothing }, { "zero", this->zero },
    { "negative", this->negative } };
  if (this->values > 0)
  {
    json["least"] = this->least;
    json["most"] = this->most;
    json["mean"] = this->sum / double(this->values);
  }
  json["bins"] = ReportJson::array();
  for (std::size_t i = 0; i < this->bins.size(); ++i)
  {
    if (this->bins[i] > 0)
    {
      json["bins"].push_back({ int(i) - octaves * steps, this->bins[i] });
    }
  }
  return json;
}

void ShareTally::add(double value)
{
  const double share = std::min(std::max(value, 0.0), 1.0);
  ++this->values;
  this->sum += share;
  this->least = std::min(this->least, share);
  this->most = std::max(this->most, share);
  this->zero += share <= 0;
  this->one += share >= 1;
  const auto last = this->bins.size() - 1;
  ++this->bins[std::min(static_cast<std::size_t>(share * double(this->bins.size())), last)];
}

void ShareTally::merge(const ShareTally& other)
{
  this->values += other.values;
  this->sum += other.sum;
  this->zero += other.zero;
  this->one += other.one;
  this->least = std::min(this->least, other.least);
  this->most = std::max(this->most, other.most);
  for (std::size_t i = 0; i < this->bins.size(); ++i)
  {
    this->bins[i] += other.bins[i];
  }
}

ReportJson ShareTally::json() const
{
  ReportJson json{ { "values", this->values }, { "zero", this->zero }, { "one", this->one } };
  if (this->values > 0)
  {
    json["least"] = this->least;
    json["most"] = this->most;
    json["mean"] = this->sum / double(this->values);
  }
  json["bins"] = this->bins;
  return json;
}

} // namespace dgtk
