// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRasterTexture_h
#define dgtkRasterTexture_h

// Private to RenderGL.

#include "dgtkModel.h"

#include <vtkSmartPointer.h>

class vtkOpenGLTexture;

namespace dgtk
{

/// The picture for OpenGL: repeated, mip-mapped, anisotropic. With `cutOut` it keeps its alpha, and the colour of what
/// is cut out is that of the nearest texels that are there, so that no fringe appears where texels are averaged.
vtkSmartPointer<vtkOpenGLTexture> makeTexture(const Image& image, bool cutOut);

} // namespace dgtk

#endif
