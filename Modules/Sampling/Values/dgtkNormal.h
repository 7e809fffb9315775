// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkNormal_h
#define dgtkNormal_h

#include "dgtkSamplingModule.h"

namespace dgtk
{

/// The probability that a standard normal number is above x; relative error below 1e-12 from -38 to 37. The same bits
/// on every machine.
DGTKSAMPLING_EXPORT double normalTail(double x);

/// The standard normal number between least < most that a uniform in [0, 1) stands for, by the inverse of the
/// distribution. One of them may be infinite; least < 37 and most > -37.
DGTKSAMPLING_EXPORT double truncatedNormal(double uniform, double least, double most);

} // namespace dgtk

#endif
