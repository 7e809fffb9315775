// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMaskPng_h
#define dgtkMaskPng_h

#include "dgtkExporter.h"
#include "dgtkRunLengths.h"

#include <string>

namespace dgtk
{

/// A mask as an 8-bit gray PNG, 255 inside and 0 outside. The picture is made of the runs: what it takes grows with the
/// mask's box, not with the image, most of which is empty (22 masks a picture are usual).
std::string maskPng(const RunLengths& mask);

} // namespace dgtk

#endif
