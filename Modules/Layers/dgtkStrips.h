// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkStrips_h
#define dgtkStrips_h

// Private to Layers.

#include "dgtkBand.h"
#include "dgtkPixelBlocks.h"
#include "dgtkThreadPool.h"
#include "dgtkWorkTime.h"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace dgtk
{

/// Cuts the rows of a band into strips of some `pixels`, which end where blocks of pixels do. `derive(rect, hits)` is
/// called for `batch` of them side by side, with the strip's rectangle and the hits of its pixels; `give` gets what it
/// returns, strip by strip from the top.
template <typename Derive, typename Give>
void forStrips(const Band& band, int pixels, int batch, ThreadPool& pool, const Derive& derive, const Give& give)
{
  const PixelRect& whole = band.rect;
  const int most = std::max(1, pixels / whole.width);
  const int rows = most < pixelBlock ? most : most / pixelBlock * pixelBlock;
  const int strips = (whole.height + rows - 1) / rows;
  batch = std::max(1, batch);
  for (int first = 0; first < strips; first += batch)
  {
    std::vector<std::invoke_result_t<Derive, const PixelRect&, const Hit*>> done(
      static_cast<std::size_t>(std::min(batch, strips - first)));
    pool.parallelFor(static_cast<int>(done.size()),
      [&](int i)
      {
        const WorkTime time(WorkStage::Derive);
        const int offset = (first + i) * rows;
        const PixelRect rect{ whole.x, whole.y + offset, whole.width, std::min(rows, whole.height - offset) };
        done[static_cast<std::size_t>(i)] =
          derive(rect, band.hits.data() + static_cast<std::size_t>(offset) * static_cast<std::size_t>(whole.width));
      });
    for (const auto& strip : done)
    {
      give(strip);
    }
  }
}

} // namespace dgtk

#endif
