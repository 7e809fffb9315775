// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPinholeTwins_h
#define dgtkPinholeTwins_h

#include "dgtkDatasetView.h"

#include <vector>

namespace dgtk
{

/// Shots of plain pinholes alone, each once: in place of a camera that is none stands its twin among all shots, a plain
/// pinhole with the same poses at the same frames; of several the one of the same size, then the first by name. Throws
/// a UsageError that says which twin a camera needs.
std::vector<DatasetShot> withTwins(const std::vector<DatasetShot>& wanted, const std::vector<DatasetShot>& all);

} // namespace dgtk

#endif
