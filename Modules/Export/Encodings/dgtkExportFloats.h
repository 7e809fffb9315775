// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExportFloats_h
#define dgtkExportFloats_h

// Private to Export: float32 values as other formats have them.

#include "dgtkExporter.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace dgtk
{

/// Rounds values to float32 and keeps account of it.
class FloatRounder
{
public:
  FloatRounder(float nothing, const std::string& layer, const std::string& unit)
    : Nothing(nothing)
    , Account{ layer, unit, 0, 0, 0 }
  {
  }
  /// `nothing` for NaN, and for what is too large, which is counted.
  float operator()(double value);
  /// The same of a length, which is not 0: what is too small is `nothing`, too.
  float length(double value);
  const LayerRounding& account() const { return this->Account; }

private:
  float Nothing;
  LayerRounding Account;
};

/// A file of float32 values, little-endian.
struct FloatFile
{
  enum class Kind
  {
    Pfm,   ///< one channel, or three; bottom row first
    Dpt,   ///< Sintel's depth, one channel
    Flo,   ///< Middlebury's flow, two channels
    Colmap ///< COLMAP's depth and normal maps, channel after channel
  };
  Kind kind = Kind::Pfm;
  int channels = 1;
  float nothing = 0; ///< stands where there is no value
  std::string unit;
};

/// `fill` makes the rows from top to bottom, channels interleaved, NaN for no value; channels of the file beyond
/// `filled` are 0. Reports the largest rounding to float32; a value too large for it is none, and counted.
void writeFloats(ExportSink& sink, const std::string& name, const ExportedPixels& pixels, const FloatFile& form,
  int width, int height, int filled, const std::function<void(int y, double* row)>& fill);

/// The layer of a shot, all values that are finite, but for pixels of the objects that are left out.
void writeFloatLayer(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& name, const FloatFile& form, const std::vector<std::uint32_t>& leftOut = {});

} // namespace dgtk

#endif
