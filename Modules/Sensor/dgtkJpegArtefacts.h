// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJpegArtefacts_h
#define dgtkJpegArtefacts_h

#include "dgtkSensorModule.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dgtk::sensor
{

/// What baseline JPEG (ITU-T T.81) keeps of a picture: JFIF colours, chroma halved when `subsampled`, 8 x 8 cosine
/// transform, the tables of T.81's annex K scaled by quality 1 to 100 as the Independent JPEG Group does, and all the
/// way back with chroma repeated. Blocks are independent, so a strip of whole blocks gives what the whole picture
/// gives; the entropy code, which loses nothing, is left out.
class DGTKSENSOR_EXPORT JpegArtefacts
{
public:
  JpegArtefacts(int quality, bool subsampled);
  int blockRows() const { return this->Subsampled ? 16 : 8; }
  /// Rows of a strip (blockRows(), fewer at the image's bottom) of 3 values a pixel in [0, 1], in place; afterwards
  /// they are multiples of 1/255.
  void apply(std::vector<std::vector<float>>& rows) const;

private:
  struct Plane
  {
    int width = 0;
    int height = 0;
    std::vector<std::int16_t> samples;
    std::int16_t& at(int x, int y) { return this->samples[std::size_t(y) * width + x]; }
    std::int16_t at(int x, int y) const { return this->samples[std::size_t(y) * width + x]; }
  };
  static Plane halved(const Plane& plane);
  void codePlane(Plane& plane, const std::array<int, 64>& table) const;
  bool Subsampled;
  std::array<int, 64> Luminance;
  std::array<int, 64> Chrominance;
};

} // namespace dgtk::sensor

#endif
