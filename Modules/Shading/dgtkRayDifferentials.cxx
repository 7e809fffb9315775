// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRayDifferentials.h"

#include <algorithm>

namespace dgtk
{

namespace
{
CameraRay difference(const CameraRay& to, const CameraRay& from, double factor = 1)
{
  return { (to.origin - from.origin) * factor, (to.direction - from.direction) * factor };
}
} // namespace

RayDifferentials::RayDifferentials(const CameraModel& model)
  : Model(model)
  , Linear(model.linear().has_value())
{
  const CameraRay first = model.rayThrough({ 0.5, 0.5 });
  this->Right = difference(model.rayThrough({ 1.5, 0.5 }), first);
  this->Down = difference(model.rayThrough({ 0.5, 1.5 }), first);
}

const std::vector<PixelRay>& RayDifferentials::row(int y, int first, int count)
{
  this->Linear ? this->linearRow(y, first, std::size_t(count)) : this->generalRow(y, first, count);
  return this->Row;
}

void RayDifferentials::linearRow(int y, int first, std::size_t count)
{
  if (count != this->Row.size() || first != this->RowFirst)
  {
    this->Pixels.resize(count);
    this->Own.resize(count);
    this->Row.resize(count);
    this->RowFirst = first;
    for (std::size_t i = 0; i < count; ++i)
    {
      this->Pixels[i].x() = first + int(i) + 0.5;
      this->Row[i] = { &this->Own[i], &this->Right, &this->Down };
    }
  }
  for (Eigen::Vector2d& pixel : this->Pixels)
  {
    pixel.y() = y + 0.5;
  }
  this->Model.raysThrough(this->Pixels.data(), count, this->Own.data());
}

/// To the right and left along the row, at the border of what is seen to one side; down to the next row, on the last
/// one from that above.
void RayDifferentials::generalRow(int y, int first, int count)
{
  const int low = std::max(first - 1, std::min(first, 0));
  const int high = std::min(first + count, std::max(first + count, this->Model.width()) - 1); // included
  const auto wide = std::size_t(high - low + 1);
  const bool last = y + 1 >= this->Model.height() && y > 0;
  const auto trace = [&](int row, std::vector<CameraRay>& rays)
  {
    this->Pixels.resize(wide);
    rays.resize(wide);
    for (std::size_t i = 0; i < wide; ++i)
    {
      this->Pixels[i] = { low + int(i) + 0.5, row + 0.5 };
    }
    this->Model.raysThrough(this->Pixels.data(), wide, rays.data());
  };
  this->Row.resize(std::size_t(count));
  this->Differences.resize(2 * std::size_t(count));
  if (y == this->BelowRow && low == this->BelowLow && wide == this->BelowWide)
  {
    this->Own.swap(this->Below);
  }
  else
  {
    trace(y, this->Own);
  }
  trace(last ? y - 1 : y + 1, this->Below);
  this->BelowRow = last ? -1 : y + 1;
  this->BelowLow = low;
  this->BelowWide = wide;
  for (int i = 0; i < count; ++i)
  {
    const auto at = std::size_t(first + i - low);
    const auto isRay = [](const CameraRay& ray) { return ray.exists(); };
    const std::size_t before = at > 0 && isRay(this->Own[at - 1]) ? at - 1 : at;
    const std::size_t after = at + 1 < wide && isRay(this->Own[at + 1]) ? at + 1 : at;
    const double steps = double(std::max<std::size_t>(after - before, 1));
    CameraRay* const own = &this->Differences[2 * std::size_t(i)];
    own[0] = difference(this->Own[after], this->Own[before], 1 / steps);
    own[1] = difference(isRay(this->Below[at]) ? this->Below[at] : this->Own[at], this->Own[at], last ? -1 : 1);
    this->Row[std::size_t(i)] = { &this->Own[at], own, own + 1 };
  }
}

} // namespace dgtk
