// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRaySource_h
#define dgtkRaySource_h

#include "dgtkRayTraceModule.h"

#include "dgtkVisibility.h"

#include <cstdint>
#include <memory>

namespace dgtk
{

/// The engine "ray": primary rays traced in packets of 16 by Embree, decided in double precision wherever single
/// precision cannot be sure: near an edge, at the near and far plane, and where surfaces coincide (nearest within a
/// relative 1e-9: the lowest object, then triangle). A ray exactly through an edge that triangles share meets one of
/// them. Views for which single precision is too coarse (telescopes), and lengths beyond it, are traced in double
/// precision alone. `pool` shares the work and must outlive the engine. Any rectangle inside the image may be rendered.
/// near and far bound the ray's parameter t, which is the depth for linear cameras. `coherent`: Embree bounds the rays
/// of a packet together, which takes half the time; a referee bounds each ray by itself. Throws MachineError when
/// Embree cannot work (no memory).
DGTKRAYTRACE_EXPORT std::unique_ptr<VisibilitySource> makeRaySource(ThreadPool& pool, bool coherent = true);

/// The yardstick of the engine above, for benchmarks: Embree's bare primary rays in packets of 16, nothing but ids
/// recorded, cut-out textures ignored, nothing settled.
DGTKRAYTRACE_EXPORT std::unique_ptr<VisibilitySource> makeBareRaySource(ThreadPool& pool);

/// Queries through Embree, each candidate decided in double precision. A ray through an edge or vertex of a closed
/// surface counts it once a pass. Surfaces nearer than the view's near hide nothing, as they are not drawn either. The
/// scene's acceleration structures are shared with every other engine that has the same state.
/// Throws MachineError when Embree cannot work (no memory).
DGTKRAYTRACE_EXPORT std::unique_ptr<OcclusionQuery> makeOcclusionQuery();

/// While the result lives, the trees that are built for the geometries of scenes stay for scenes that come later and
/// have the same models, as far as they are no larger than so many bytes, roughly; those that were not used for longest
/// go first.
/// Throws MachineError when Embree cannot work.
DGTKRAYTRACE_EXPORT std::shared_ptr<void> keepRayMeshes(std::uint64_t bytes);

} // namespace dgtk

#endif
