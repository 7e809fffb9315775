// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSamples_h
#define dgtkSamples_h

#include "dgtkLayersModule.h"

#include "dgtkCoverage.h"
#include "dgtkResampledCamera.h"
#include "dgtkSurfaceRows.h"
#include "dgtkThreadPool.h"
#include "dgtkVisibility.h"

#include <memory>
#include <vector>

namespace dgtk
{

/// The view whose pixel centres are sample (i, j) of the count x count samples of the pixels of `view`.
DGTKLAYERS_EXPORT View sampleView(const View& view, int i, int j, int count);

/// The samples of a strip of full-width rows.
struct DGTKLAYERS_EXPORT SampledRows
{
  PixelRect rect;
  int samples = 1; ///< of a pixel: the square of those of a side
  std::shared_ptr<const SceneState> state;
  std::vector<VisibilityBuffer> hits;     ///< one a sample, row by row of the pixel's grid
  std::vector<std::vector<double>> depth; ///< one a sample; computed where `mixed`; +inf for background
  std::vector<std::uint8_t> mixed; ///< whether the pixel's samples meet several objects, or several copies, one a pixel
  bool anyMixed = false;

  /// Id of the object that a sample of a pixel (index into `mixed`) meets; 0 for none.
  std::uint32_t idOf(int sample, std::size_t pixel) const
  {
    return this->state->objectOf(this->hits[std::size_t(sample)].hits[pixel].object);
  }
  /// The samples' objects of a pixel, and their depths.
  void gather(std::size_t pixel, std::uint32_t* ids, double* depths) const;
};

/// Traces N x N samples a pixel. The middle sample of an odd N is the pixel's own hit.
class DGTKLAYERS_EXPORT PixelSampler
{
public:
  /// `source` traces the samples.
  PixelSampler(std::shared_ptr<const SceneState> state, const View& view, int side,
    std::unique_ptr<VisibilitySource> source, ThreadPool& pool);
  ~PixelSampler();

  /// How many rows are best sampled at once.
  int stripRows() const;
  /// `own`: hits of the pixels of `rect`.
  void sample(const PixelRect& rect, const Hit* own, SampledRows& rows);
  /// How many samples of a pixel have no ray, beyond what a lens sees.
  int withoutRay(int x, int y) const;

private:
  void trace(SampledRows& rows, const Hit* own);
  void findMixed(SampledRows& rows) const;
  void findDepths(SampledRows& rows) const;
  std::shared_ptr<const SceneState> State;
  int Side;
  int Width;
  ThreadPool& Pool;
  std::vector<View> Views; ///< one a sample
  std::unique_ptr<VisibilitySource> Source;
};

/// The rows of the layer alpha: R, G, B the id of the object at the smallest depth, A 255 times its coverage, rounded.
DGTKLAYERS_EXPORT Rows alphaRows(const SampledRows& samples, ThreadPool& pool);

} // namespace dgtk

#endif
