// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMeter.h"

#include <charconv>

namespace dgtk
{

namespace
{
constexpr int meterChunk = 16;
}

std::string numberText(double value)
{
  if (!std::isfinite(value))
  {
    return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  }
  char text[32];
  return { text, std::to_chars(text, text + sizeof text, value).ptr };
}

std::string numbersText(const double* values, int count)
{
  if (count == 1)
  {
    return numberText(values[0]);
  }
  std::string text = "(";
  for (int i = 0; i < count; ++i)
  {
    text += (i > 0 ? ", " : "") + numberText(values[i]);
  }
  return text + ')';
}

void Meter::merge(const Meter& later)
{
  this->Count += later.Count;
  this->Skipped += later.Skipped;
  this->Bad += later.Bad;
  if (later.Largest > this->Largest)
  {
    this->Largest = later.Largest;
    this->Worst = later.Worst;
  }
}

void Results::startCheck(int index, const std::string& name)
{
  this->Index = index;
  this->Check = name;
}

void Results::add(const Row& row, const Meter& meter)
{
  this->Compared.insert(row.files.begin(), row.files.end());
  this->add({ this->Index, row.layer }, { this->Check, row.layer, row.unit, meter.Count, meter.Skipped, meter.Bad,
                                          meter.Largest, meter.Tolerance, row.mostOpen, meter.Worst });
}

void Results::add(const std::pair<int, std::string>& key, const Residual& found)
{
  const auto [at, isNew] = this->Residuals.try_emplace(key, found);
  if (isNew)
  {
    return;
  }
  Residual& residual = at->second;
  residual.count += found.count;
  residual.skipped += found.skipped;
  residual.bad += found.bad;
  residual.tolerance = std::max(residual.tolerance, found.tolerance);
  if (found.largest > residual.largest)
  {
    residual.largest = found.largest;
    residual.worst = found.worst;
  }
}

void Results::merge(const Results& other)
{
  this->Compared.insert(other.Compared.begin(), other.Compared.end());
  for (const auto& [key, residual] : other.Residuals)
  {
    this->add(key, residual);
  }
}

namespace
{
/// An error's text without the file that it begins with.
std::string textBehind(const std::string& file, const std::string& what)
{
  const std::size_t at = file.empty() ? std::string::npos : what.find(file + ':');
  if (at == std::string::npos || (at > 0 && what[at - 1] != '/'))
  {
    return what;
  }
  const std::string rest = what.substr(at + file.size() + 1);
  return rest.empty() ? what : rest.front() == ' ' ? rest.substr(1) : "line " + rest;
}
} // namespace

void Results::unusable(const std::string& layer, const std::string& file, const std::string& what)
{
  Meter meter(0);
  meter.equal(false, [&] { return Offender{ file, -1, -1, textBehind(file, what), "a file that can be used" }; });
  this->add({ layer, "", { file } }, meter);
}

VerificationReport Results::report() const
{
  VerificationReport report;
  for (const auto& [key, residual] : this->Residuals)
  {
    if (residual.count + residual.skipped > 0)
    {
      report.residuals.push_back(residual);
    }
  }
  return report;
}

Meter meterRows(ThreadPool& pool, int height, double tolerance, const std::function<void(int, Meter&)>& body)
{
  const int chunks = (height + meterChunk - 1) / meterChunk;
  std::vector<Meter> meters(static_cast<std::size_t>(chunks), Meter(tolerance));
  pool.parallelFor(chunks,
    [&](int chunk)
    {
      for (int y = chunk * meterChunk; y < std::min(height, (chunk + 1) * meterChunk); ++y)
      {
        body(y, meters[chunk]);
      }
    });
  Meter total(tolerance);
  for (const Meter& meter : meters)
  {
    total.merge(meter);
  }
  return total;
}

} // namespace dgtk
