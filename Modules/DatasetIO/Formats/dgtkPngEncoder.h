// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPngEncoder_h
#define dgtkPngEncoder_h

#include "dgtkDatasetIOModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// How the bytes of a row are predicted (PNG specification, section 9).
enum class PngPrediction
{
  Smooth, ///< per row the one of Sub, Up and Paeth with the smallest sum of residuals
  Labels  ///< always Up: areas of one value become zeros
};

/// Makes a PNG file row by row. Images of at most wholeImageBytes are compressed in one piece at the end (fast, by
/// libdeflate), larger ones while they arrive (by zlib); which of the two depends on the image's size alone.
/// Not libpng's: of 320 x 240 pixels it takes 3.9 ms at its fastest level and 19 by default, this 1.9; and its filters
/// may choose otherwise in its next version, while a dataset's bytes stay.
class DGTKDATASETIO_EXPORT PngEncoder
{
public:
  using Sink = std::function<void(const void* data, std::size_t bytes)>;
  static constexpr std::uint64_t wholeImageBytes = std::uint64_t(64) << 20;

  struct Header
  {
    int width = 0;
    int height = 0;
    int bitDepth = 8;     ///< 8 or 16
    int channels = 3;     ///< 1 gray, 2 gray and alpha, 3 RGB, 4 RGBA
    bool srgb = false;    ///< adds an sRGB chunk, perceptual intent
    bool nothing = false; ///< adds a tRNS chunk: of 16-bit gray, 65535 is no value
    PngPrediction prediction = PngPrediction::Smooth;
    std::string palette = {}; ///< of one channel of 8 bits: R, G, B of the codes from 0; adds a PLTE chunk
  };

  /// Writes the signature and the header to the sink.
  PngEncoder(const Header& header, Sink sink);
  ~PngEncoder();
  /// Bytes of one row, 16-bit values high byte first.
  std::size_t rowBytes() const { return this->RowBytes; }
  /// The next row, rowBytes() bytes.
  void row(const unsigned char* bytes);
  /// Behind the last row.
  void finish();

private:
  class Compressor;
  class WholeCompressor;
  class StreamCompressor;
  void chunk(const char* type, const void* data, std::size_t bytes);
  void filterSmooth(const unsigned char* bytes, unsigned char* out);

  Sink Out;
  Header Head;
  std::size_t RowBytes;
  std::vector<unsigned char> Previous; ///< with a pixel of zeros before it
  std::vector<unsigned char> Current;  ///< likewise
  std::vector<unsigned char> Filtered; ///< candidates
  std::unique_ptr<Compressor> Deflate;
};

} // namespace dgtk

#endif
