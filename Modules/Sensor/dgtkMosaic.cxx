// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMosaic.h"

namespace dgtk::sensor
{

namespace
{
// Mirroring keeps the colours of the pattern where they belong.
int mirrored(int i, int size)
{
  if (size == 1)
  {
    return 0;
  }
  return i < 0 ? -i : i >= size ? 2 * size - 2 - i : i;
}
} // namespace

int bayerChannel(BayerPattern pattern, int x, int y)
{
  // Red lies at (redX, redY) of the cell, blue across.
  const int redX = pattern == BayerPattern::RGGB || pattern == BayerPattern::GBRG ? 0 : 1;
  const int redY = pattern == BayerPattern::RGGB || pattern == BayerPattern::GRBG ? 0 : 1;
  const bool ofRedColumn = (x & 1) == redX;
  const bool ofRedRow = (y & 1) == redY;
  return ofRedColumn == ofRedRow ? (ofRedRow ? 0 : 2) : 1;
}

std::vector<float> demosaicRow(const RowWindow<float>& rows, int height, BayerPattern pattern, int y)
{
  const std::vector<float>* near[3] = { &rows.at(mirrored(y - 1, height)), &rows.at(y),
    &rows.at(mirrored(y + 1, height)) };
  const int width = static_cast<int>(near[1]->size());
  std::vector<float> out(std::size_t(width) * 3);
  for (int x = 0; x < width; ++x)
  {
    double sum[3] = { 0, 0, 0 };
    int count[3] = { 0, 0, 0 };
    const int own = bayerChannel(pattern, x, y);
    for (int j = -1; j <= 1; ++j)
    {
      for (int i = -1; i <= 1; ++i)
      {
        const int channel = bayerChannel(pattern, x + i, y + j);
        const bool counts = channel == own ? i == 0 && j == 0 : true;
        if (counts)
        {
          sum[channel] += (*near[j + 1])[static_cast<std::size_t>(mirrored(x + i, width))];
          ++count[channel];
        }
      }
    }
    for (int c = 0; c < 3; ++c)
    {
      out[std::size_t(x) * 3 + c] = static_cast<float>(sum[c] / count[c]);
    }
  }
  return out;
}

} // namespace dgtk::sensor
