// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMatte.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr std::uint32_t full = 65535;

std::uint16_t rounded(float value)
{
  return static_cast<std::uint16_t>(std::lround(double(full) * std::clamp(double(value), 0.0, 1.0)));
}
} // namespace

void composeMatte(const std::uint16_t* count, const float* foreground, const float* background, int samples,
  std::size_t pixels, std::uint16_t* foreground16, std::uint16_t* background16, std::uint16_t* alpha16,
  std::uint16_t* composite16)
{
  const double all = double(samples) * samples;
  for (std::size_t i = 0; i < pixels; ++i)
  {
    alpha16[i] = rounded(static_cast<float>(count[i] / all));
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
    {
      foreground16[c] = rounded(foreground[c]);
      background16[c] = rounded(background[c]);
      const std::uint64_t sum =
        std::uint64_t(alpha16[i]) * foreground16[c] + std::uint64_t(full - alpha16[i]) * background16[c];
      composite16[c] = static_cast<std::uint16_t>((sum + full / 2) / full);
    }
  }
}

void Matte::addRows(const std::uint16_t* count, int rows)
{
  const std::size_t pixels = std::size_t(this->Width) * static_cast<std::size_t>(rows);
  for (std::size_t i = 0; i < pixels; ++i)
  {
    this->Values.push_back(count[i] == 0            ? trimapBackground
                           : count[i] == this->Full ? trimapForeground
                                                    : trimapUnknown);
  }
}

void Matte::trimapRow(int y, std::uint8_t* row) const
{
  const int top = std::max(0, y - band);
  const int bottom = std::min(this->height() - 1, y + band);
  // the same value in the whole column, or unknown
  std::vector<std::uint8_t> column(this->Values.begin() + std::ptrdiff_t(top) * this->Width,
    this->Values.begin() + std::ptrdiff_t(top + 1) * this->Width);
  for (int other = top + 1; other <= bottom; ++other)
  {
    const std::uint8_t* values = this->Values.data() + std::size_t(other) * static_cast<std::size_t>(this->Width);
    for (int x = 0; x < this->Width; ++x)
    {
      column[x] = column[x] == values[x] ? column[x] : trimapUnknown;
    }
  }
  for (int x = 0; x < this->Width; ++x)
  {
    const auto first = column.begin() + std::max(0, x - band);
    const auto last = column.begin() + std::min(this->Width, x + band + 1);
    row[x] =
      std::all_of(first, last, [&](std::uint8_t value) { return value == column[x]; }) ? column[x] : trimapUnknown;
  }
}

} // namespace dgtk
