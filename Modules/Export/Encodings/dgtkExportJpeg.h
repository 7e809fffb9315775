// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExportJpeg_h
#define dgtkExportJpeg_h

#include "dgtkLayerReader.h"

#include <string>

namespace dgtk
{

struct JpegPicture
{
  std::string bytes;
  int largest = 0; ///< difference of a decoded value from the picture's, levels of 8 bits
};

/// RGB or gray of 8 or 16 bits as baseline JPEG, 4:4:4, with the accurate integer transform. No date, no comment.
/// Throws UsageError for more than 65,500 columns or rows, which JPEG cannot hold.
JpegPicture encodeJpeg(const ImageData& picture, int quality);

} // namespace dgtk

#endif
