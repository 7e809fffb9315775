// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEmbree_h
#define dgtkEmbree_h

#include "dgtkOnDemand.h"

#include <embree3/rtcore.h>

namespace dgtk
{

/// Embree's functions, by their names without `rtc`. The library dgtkEmbree gives them, which the first
/// device loads (see dgtkOnDemand.h): Embree is a seventh of a start's page faults.
#define DGTK_EMBREE_FUNCTIONS(row)                                                                                    \
  row(NewDevice) row(ReleaseDevice) row(GetDeviceError) row(NewScene) row(ReleaseScene) row(SetSceneFlags)            \
    row(SetSceneBuildQuality) row(CommitScene) row(NewBuffer) row(GetBufferData) row(ReleaseBuffer) row(NewGeometry)  \
      row(SetGeometryBuffer) row(SetNewGeometryBuffer) row(SetGeometryUserData) row(SetGeometryInstancedScene)        \
        row(SetGeometryTransform) row(CommitGeometry) row(AttachGeometry) row(AttachGeometryByID) row(DetachGeometry) \
          row(EnableGeometry) row(DisableGeometry) row(ReleaseGeometry) row(Intersect1) row(Intersect16)              \
            row(Occluded16) row(PointQuery)

struct EmbreeCalls
{
#define DGTK_EMBREE_POINTER(name) decltype(&rtc##name) name; // NOLINT(bugprone-macro-parentheses): a member
  DGTK_EMBREE_FUNCTIONS(DGTK_EMBREE_POINTER)
#undef DGTK_EMBREE_POINTER
};

/// Throws MachineError when the library cannot be loaded.
inline const EmbreeCalls& embree() { return onDemand<EmbreeCalls>("dgtkEmbree"); }

} // namespace dgtk

extern "C" const dgtk::EmbreeCalls* dgtkEmbreeCalls();

#endif
