// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMippedTexture_h
#define dgtkMippedTexture_h

#include "dgtkRenderGLModule.h"

#include <cstdint>
#include <memory>
#include <vector>
#include <vtkOpenGLTexture.h>

class vtkImageData;

namespace dgtk
{

/// Pictures of bytes, each of half the width and height of the one before, down to one texel, without the first.
using SmallerPictures = std::vector<std::vector<std::uint8_t>>;

/// What OpenGL's linear filter makes of them.
DGTKRENDERGL_EXPORT SmallerPictures smallerPictures(vtkImageData& picture);

/// A texture with mip-maps that come with its picture. Software OpenGL compiles programs for making them, in each
/// context anew, which took half of the time from a scene's file to its picture.
class DGTKRENDERGL_EXPORT MippedTexture : public vtkOpenGLTexture
{
public:
  static MippedTexture* New();
  vtkTypeMacro(MippedTexture, vtkOpenGLTexture);

  void setPicture(vtkImageData* picture, std::shared_ptr<const SmallerPictures> smaller);
  void Load(vtkRenderer* renderer) override;

private:
  std::shared_ptr<const SmallerPictures> Smaller;
};

} // namespace dgtk

#endif
