// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPcx_h
#define dgtkPcx_h

#include "dgtkModel.h"

#include <memory>
#include <string>

namespace dgtk
{

/// Decodes a PCX picture (run-length coded, 8 bits with a palette of 256 colours, or 24 bits in three planes) to RGBA.
/// Null, and `problem` set, for anything else and for more than `largestSide` pixels a side. Throws InputError when
/// the file cannot be read.
std::shared_ptr<Image> decodePcx(const std::string& path, int largestSide, std::string& problem);

} // namespace dgtk

#endif
