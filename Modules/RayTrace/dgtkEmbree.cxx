// SPDX-License-Identifier: BSD-3-Clause
// The library dgtkEmbree: what is linked to Embree.
#include "dgtkEmbree.h"

namespace
{
#define DGTK_EMBREE_ADDRESS(name) &rtc##name,
dgtk::EmbreeCalls calls{ DGTK_EMBREE_FUNCTIONS(DGTK_EMBREE_ADDRESS) };
#undef DGTK_EMBREE_ADDRESS

/// Embree is loaded late, and so ends earlier than static objects of other libraries: what these release is gone then.
/// None may trace any more: a run must be over before main() returns.
struct AtExit
{
  ~AtExit()
  {
    calls.ReleaseDevice = [](RTCDevice) {};
    calls.ReleaseScene = [](RTCScene) {};
    calls.ReleaseGeometry = [](RTCGeometry) {};
    calls.DetachGeometry = [](RTCScene, unsigned int) {};
  }
};
const AtExit atExit;
} // namespace

const dgtk::EmbreeCalls* dgtkEmbreeCalls() { return &calls; }
