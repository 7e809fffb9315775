// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDrawingRate.h"

#include <algorithm>
#include <limits>

namespace dgtk
{

namespace
{
constexpr double mostSeconds = 0.15; // of a drawing: beyond, what is small has fewer triangles
constexpr std::size_t few = 5;       // drawings
constexpr double leastSeconds = 1e-6;
} // namespace

double DrawingRate::best() const
{
  return this->Rates.empty() ? 0 : *std::max_element(this->Rates.begin(), this->Rates.end());
}

void DrawingRate::add(std::size_t triangles, double seconds)
{
  // Of few triangles it is not they that take the time: such a drawing can only say that more are possible.
  const double rate = double(triangles) / std::max(seconds, leastSeconds);
  const bool many = triangles > usualTriangles / 2;
  if (many || (!this->Rates.empty() && rate > this->best()))
  {
    this->Rates.push_back(rate);
  }
  if (this->Rates.size() > few)
  {
    this->Rates.pop_front();
  }
}

std::size_t DrawingRate::mostTriangles() const
{
  return this->Rates.empty() ? std::numeric_limits<std::size_t>::max()
                             : std::max(usualTriangles, static_cast<std::size_t>(mostSeconds * this->best()));
}

} // namespace dgtk
