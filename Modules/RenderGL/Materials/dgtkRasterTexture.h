// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRasterTexture_h
#define dgtkRasterTexture_h

#include "dgtkModel.h"
#include "dgtkRenderGLModule.h"

#include <vtkSmartPointer.h>

class vtkImageData;
class vtkOpenGLTexture;

namespace dgtk
{

/// The picture as VTK's, RGB. With `cutOut` it keeps its alpha, and the colour of what is cut out is that of the
/// nearest texels that are there, so that no fringe appears where texels are averaged.
DGTKRENDERGL_EXPORT vtkSmartPointer<vtkImageData> makePicture(const Image& image, bool cutOut);

/// That picture for OpenGL: repeated, mip-mapped, anisotropic.
vtkSmartPointer<vtkOpenGLTexture> makeTexture(const Image& image, bool cutOut);

} // namespace dgtk

#endif
