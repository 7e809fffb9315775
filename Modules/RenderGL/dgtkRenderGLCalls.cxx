// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderGLCalls.h"

const dgtk::RenderGLCalls* dgtkRenderGLCalls()
{
  static const dgtk::RenderGLCalls calls{ &dgtk::makeRasterSource, &dgtk::glBackendFromName, &dgtk::nameOf,
    &dgtk::prepareProcess, &dgtk::glBackends, [] { return std::make_shared<dgtk::GLTurn>(); }, &dgtk::coarseShadows };
  return &calls;
}
