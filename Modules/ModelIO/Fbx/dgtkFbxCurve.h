// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFbxCurve_h
#define dgtkFbxCurve_h

#include "dgtkFbxDocument.h"
#include "dgtkImportMotion.h"

namespace dgtk::import
{

/// An AnimationCurve, its times in seconds after `begin`, both of `ticks` a second. No keys where its lists do not
/// match.
Curve readFbxCurve(const FbxElement& element, double begin, double ticks);

} // namespace dgtk::import

#endif
