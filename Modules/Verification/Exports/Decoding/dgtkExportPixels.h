// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExportPixels_h
#define dgtkExportPixels_h

#include "dgtkExportJudge.h"

namespace dgtk
{

/// Pixels of a file of an export, in the format's unit; NaN where the file says that there is nothing.
struct DecodedPixels
{
  int width = 0;
  int height = 0;
  int channels = 1;
  std::vector<double> values; ///< rows top to bottom, channels interleaved
  double at(int x, int y, int c = 0) const
  {
    return this->values[(std::size_t(y) * this->width + x) * this->channels + c];
  }
};

/// Reads a file as its encoding says; see the table in dgtkExportPixels.cxx. Damaged files are InputErrors.
using DecodePixels = DecodedPixels (*)(const std::string& path, const PixelEncoding& encoding);

/// The number of an encoding, or the one given for none.
double numberOf(const PixelEncoding& encoding, const std::string& key, double usual);

/// Compares the pixels of a file with the dataset's, as its encoding says.
void judgePixels(const ExportedFrom& source, const ExportedFile& file, Results& results);

/// Decoders of single formats; others stand in the file of the format's reader.
DecodedPixels decodePng(const std::string& path, const PixelEncoding& encoding);
DecodedPixels decodeKittiFlow(const std::string& path, const PixelEncoding& encoding);
DecodedPixels decodeSintelDisparity(const std::string& path, const PixelEncoding& encoding);
DecodedPixels decodeDpt(const std::string& path, const PixelEncoding& encoding);
DecodedPixels decodeHdf5(const std::string& path, const PixelEncoding& encoding);
DecodedPixels decodeColmap(const std::string& path, const PixelEncoding& encoding);
DecodedPixels decodeFlowPfm(const std::string& path, const PixelEncoding& encoding);
/// A JPEG or PNG picture as levels of 8 bits.
DecodedPixels decodePicture(const std::string& path);
/// The bytes of a JPEG picture; `path` stands in errors.
DecodedPixels decodeJpeg(const std::string& path, const std::string& bytes);

/// Marks the pixels whose centres lie in a polygon, by the even-odd rule along rows: x, y in turn, pixels from the
/// image's corner.
void fillPolygon(const std::vector<double>& polygon, int width, int height, std::vector<char>& mask);

} // namespace dgtk

#endif
