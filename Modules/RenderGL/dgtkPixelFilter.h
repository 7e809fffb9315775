// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPixelFilter_h
#define dgtkPixelFilter_h

// Private to RenderGL.

#include "dgtkRasterSource.h"

#include <vector>

namespace dgtk
{

/// Makes pixels of samples x samples points each.
class SampleFilter
{
public:
  SampleFilter(PixelFilter filter, int samples);
  /// Pixels around a piece whose samples count.
  int margin() const { return this->Margin; }
  /// What must be drawn for a piece.
  PixelRect drawn(const PixelRect& piece) const
  {
    return { piece.x - this->Margin, piece.y - this->Margin, piece.width + 2 * this->Margin,
      piece.height + 2 * this->Margin };
  }
  /// Fills a piece of `colors` from the samples of drawn(piece): RGBA, rows bottom to top, each taken as within [0, 1].
  void apply(const std::vector<float>& samples, const PixelRect& piece, ColorBuffer& colors) const;

private:
  void applyBox(const std::vector<float>& samples, const PixelRect& piece, ColorBuffer& colors) const;
  PixelFilter Filter;
  int Samples;
  int Margin = 0;
  std::vector<double> Weights;
};

} // namespace dgtk

#endif
