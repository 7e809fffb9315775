// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPhongProperty_h
#define dgtkPhongProperty_h

#include "dgtkModel.h"
#include "dgtkRenderGLModule.h"

class vtkProperty;

namespace dgtk
{

/// VTK's property of Phong's colours, each with intensity 1. VTK has no emission beside them.
DGTKRENDERGL_EXPORT void setProperty(const Material& material, vtkProperty& property);

} // namespace dgtk

#endif
