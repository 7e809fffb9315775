// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPixelFilter_h
#define dgtkPixelFilter_h

#include "dgtkVisibility.h"

#include <cstddef>
#include <string>
#include <vector>

namespace dgtk
{

/// How the samples of a neighbourhood become the colour of a pixel. Separable; the weights of the samples at hand sum
/// to 1.
enum class PixelFilter
{
  Box,      ///< the pixel itself, radius 0.5 pixel
  Triangle, ///< radius 1
  Gaussian, ///< of standard deviation 0.5, cut off at radius 1.5
  Mitchell, ///< radius 2, B = C = 1/3 (Mitchell and Netravali 1988)
  Lanczos   ///< radius 3 (Duchon 1979)
};
/// Throws UsageError for an unknown name: box, triangle, gaussian, mitchell, lanczos.
DGTKVISIBILITY_EXPORT PixelFilter pixelFilterFromName(const std::string& name);
/// Weights of `samples` samples a pixel along one axis, from `margin` pixels before the pixel to `margin` after it.
DGTKVISIBILITY_EXPORT std::vector<double> pixelFilterWeights(PixelFilter filter, int samples, int& margin);

/// Samples of a picture, red, green and blue first.
struct SampleImage
{
  const float* top = nullptr;   ///< the uppermost row
  std::ptrdiff_t toNextRow = 0; ///< values from a row to the one below
  int channels = 3;

  /// RGBA, rows bottom to top, as OpenGL gives them.
  static SampleImage upwards(const std::vector<float>& rgba, int width)
  {
    const std::ptrdiff_t row = 4 * std::ptrdiff_t(width);
    return { rgba.data() + rgba.size() - row, -row, 4 };
  }
};

/// Makes pixels of samples x samples points each.
class DGTKVISIBILITY_EXPORT SampleFilter
{
public:
  /// Each sample is taken as within [0, `most`].
  SampleFilter(PixelFilter filter, int samples, float most = 1);
  /// Pixels around a piece whose samples count.
  int margin() const { return this->Margin; }
  /// What must be drawn for a piece.
  PixelRect drawn(const PixelRect& piece) const
  {
    return { piece.x - this->Margin, piece.y - this->Margin, piece.width + 2 * this->Margin,
      piece.height + 2 * this->Margin };
  }
  /// Fills a piece of `colors` from the samples of drawn(piece).
  void apply(const SampleImage& samples, const PixelRect& piece, ColorBuffer& colors) const;

private:
  template <typename T>
  float clamped(T value) const
  {
    return value > 0 ? (value < this->Most ? float(value) : this->Most) : 0.0f;
  }
  void applyBox(const SampleImage& samples, const PixelRect& piece, ColorBuffer& colors) const;
  PixelFilter Filter;
  int Samples;
  float Most;
  int Margin = 0;
  std::vector<double> Weights;
};

} // namespace dgtk

#endif
