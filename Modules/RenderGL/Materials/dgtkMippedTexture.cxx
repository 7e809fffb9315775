// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMippedTexture.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vtkImageData.h>
#include <vtkObjectFactory.h>
#include <vtkTextureObject.h>
#include <vtk_glew.h>

namespace dgtk
{

namespace
{
constexpr int one = 256; // of a texel's weight

/// The two texels of a row, or rows, that one of the half as many lies between.
struct Between
{
  int first;
  int second;
  int weight; ///< of the second
};

std::vector<Between> halved(int size)
{
  std::vector<Between> half(std::size_t(std::max(1, size / 2)));
  for (std::size_t i = 0; i < half.size(); ++i)
  {
    const double at = (double(i) + 0.5) * size / double(half.size()) - 0.5;
    const int first = int(std::floor(at));
    half[i] = { first, std::min(first + 1, size - 1), int(std::lround((at - first) * one)) };
  }
  return half;
}

std::vector<std::uint8_t> smaller(const std::uint8_t* from, const std::vector<Between>& columns,
  const std::vector<Between>& rows, int width, int channels)
{
  std::vector<std::uint8_t> to(columns.size() * rows.size() * std::size_t(channels));
  std::uint8_t* texel = to.data();
  for (const Between& row : rows)
  {
    const std::uint8_t* const below = from + std::size_t(row.first) * std::size_t(width * channels);
    const std::uint8_t* const above = from + std::size_t(row.second) * std::size_t(width * channels);
    for (const Between& column : columns)
    {
      for (int c = 0; c < channels; ++c)
      {
        const int a = column.first * channels + c;
        const int b = column.second * channels + c;
        const int low = below[a] * (one - column.weight) + below[b] * column.weight;
        const int high = above[a] * (one - column.weight) + above[b] * column.weight;
        *texel++ = std::uint8_t((low * (one - row.weight) + high * row.weight + one * one / 2) / (one * one));
      }
    }
  }
  return to;
}
} // namespace

SmallerPictures smallerPictures(vtkImageData& picture)
{
  int width = picture.GetDimensions()[0];
  int height = picture.GetDimensions()[1];
  const auto* from = static_cast<const std::uint8_t*>(picture.GetScalarPointer());
  SmallerPictures all;
  while (width > 1 || height > 1)
  {
    const std::vector<Between> columns = halved(width);
    const std::vector<Between> rows = halved(height);
    all.push_back(smaller(from, columns, rows, width, picture.GetNumberOfScalarComponents()));
    from = all.back().data();
    width = int(columns.size());
    height = int(rows.size());
  }
  return all;
}

vtkStandardNewMacro(MippedTexture);

void MippedTexture::setPicture(vtkImageData* picture, std::shared_ptr<const SmallerPictures> smaller)
{
  this->Smaller = std::move(smaller);
  this->SetInputData(picture);
  this->MipmapOn();
}

void MippedTexture::Load(vtkRenderer* renderer)
{
  const vtkMTimeType before = this->LoadTime;
  this->Mipmap = false; // it makes none
  this->vtkOpenGLTexture::Load(renderer);
  this->Mipmap = true;
  vtkTextureObject* const loaded = this->TextureObject;
  if (this->LoadTime == before || loaded == nullptr)
  {
    return;
  }
  int width = int(loaded->GetWidth());
  int height = int(loaded->GetHeight());
  const int* const size = this->GetInput()->GetDimensions();
  const bool isWhole = width == size[0] && height == size[1];
  const int channels = loaded->GetComponents();
  const auto internal = GLint(loaded->GetInternalFormat(VTK_UNSIGNED_CHAR, channels, false));
  loaded->Bind();
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (std::size_t i = 0; isWhole && i < this->Smaller->size(); ++i)
  {
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
    glTexImage2D(GL_TEXTURE_2D, GLint(i + 1), internal, width, height, 0,
      loaded->GetFormat(VTK_UNSIGNED_CHAR, channels, false), GL_UNSIGNED_BYTE, (*this->Smaller)[i].data());
  }
  if (!isWhole)
  {
    glGenerateMipmap(GL_TEXTURE_2D); // VTK has made it smaller, as OpenGL has none of that size
  }
  loaded->SetMaxLevel(int(this->Smaller->size()));
  loaded->SetMinificationFilter(vtkTextureObject::LinearMipmapLinear);
  loaded->SendParameters();
}

} // namespace dgtk
