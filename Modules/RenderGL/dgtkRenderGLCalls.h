// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRenderGLCalls_h
#define dgtkRenderGLCalls_h

#include "dgtkGLContext.h"
#include "dgtkOnDemand.h"
#include "dgtkRasterSource.h"
#include "dgtkShadowNotes.h"

namespace dgtk
{

/// The functions of this module, for programs that load it when they draw: see dgtkOnDemand.h.
struct RenderGLCalls
{
  decltype(&dgtk::makeRasterSource) makeRasterSource;
  decltype(&dgtk::glBackendFromName) glBackendFromName;
  const char* (*nameOf)(GLBackend backend);
  decltype(&dgtk::prepareProcess) prepareProcess;
  decltype(&dgtk::glBackends) glBackends;
  /// A GLTurn that lasts as long as what is returned.
  std::shared_ptr<GLTurn> (*takeTurn)();
  decltype(&dgtk::coarseShadows) coarseShadows;
};

inline const RenderGLCalls& renderGL() { return onDemand<RenderGLCalls>("dgtkRenderGL"); }

} // namespace dgtk

extern "C" DGTKRENDERGL_EXPORT const dgtk::RenderGLCalls* dgtkRenderGLCalls();

#endif
