// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExactSide_h
#define dgtkExactSide_h

#include "dgtkRayTraceModule.h"

#include <Eigen/Core>

namespace dgtk
{

/// The side of the plane through the origin, `a` and `b` on which a direction passes, without any rounding: the sign of
/// direction * (a x b). Of a direction in the plane, the side to which an infinitely small turn towards x, else y, else
/// z moves it: of the triangles around an edge or a corner that a ray meets, exactly as many as of those beside it.
DGTKRAYTRACE_EXPORT int exactSide(const Eigen::Vector3d& direction, const Eigen::Vector3d& a, const Eigen::Vector3d& b);

} // namespace dgtk

#endif
