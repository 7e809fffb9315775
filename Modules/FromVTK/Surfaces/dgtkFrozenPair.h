// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFrozenPair_h
#define dgtkFrozenPair_h

#include "dgtkFrozenView.h"

#include <cstdint>

namespace dgtk
{

/// Where the surface points that the pixels of `from` see are in `to`: two pixels a point, and its VisibilityClass.
/// Points keep their place in their triangle, as `from` cuts polygons. An actor that is not in `to`, or a point that is
/// cut away or culled there, is nowhere: class 0. Throws InputError for an actor whose cells are others.
void correspondViews(const FrozenView& from, const FrozenView& to, double* pixels, std::uint8_t* classes);

} // namespace dgtk

#endif
