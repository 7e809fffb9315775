// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFbxCurve_h
#define dgtkFbxCurve_h

#include "dgtkFbxDocument.h"
#include "dgtkImportMotion.h"

namespace dgtk::import
{

/// An AnimationCurve, whose times are `ticks` a second: its keys at seconds after the time `begin`, as many as have
/// both a time and a value.
Curve readFbxCurve(const FbxElement& element, double begin, double ticks);

} // namespace dgtk::import

#endif
