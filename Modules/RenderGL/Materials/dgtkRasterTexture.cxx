// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterTexture.h"

#include "dgtkCutOutColors.h"

#include <cstring>
#include <vtkImageData.h>
#include <vtkOpenGLTexture.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

namespace dgtk
{
vtkSmartPointer<vtkImageData> makePicture(const Image& image, bool cutOut)
{
  // VTK takes a picture of width 1 for one lying on its side.
  const int repeat = image.width == 1 ? 2 : 1;
  const int width = image.width * repeat;
  const int channels = cutOut ? 4 : 3;
  std::vector<std::uint8_t> filled;
  const std::uint8_t* source = image.rgba.data();
  if (cutOut)
  {
    filled = withoutHoles(image);
    source = filled.data();
  }
  auto data = vtkSmartPointer<vtkImageData>::New();
  data->SetDimensions(width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
  auto* target = static_cast<std::uint8_t*>(data->GetScalarPointer());
  for (int row = image.height - 1; row >= 0; --row)
  {
    for (int column = 0; column < width; ++column, target += channels)
    {
      std::memcpy(target, source + (std::size_t(row) * image.width + column / repeat) * 4, std::size_t(channels));
    }
  }
  return data;
}

vtkSmartPointer<vtkOpenGLTexture> makeTexture(const Image& image, bool cutOut)
{
  auto texture = vtkSmartPointer<vtkOpenGLTexture>::New();
  texture->SetInputData(makePicture(image, cutOut));
  texture->SetColorModeToDirectScalars();
  texture->SetInterpolate(1);
  texture->SetMipmap(true);
  texture->SetMaximumAnisotropicFiltering(1); // the shaders' own, see dgtkTexel
  texture->SetWrap(vtkTexture::Repeat);
  return texture;
}

} // namespace dgtk
