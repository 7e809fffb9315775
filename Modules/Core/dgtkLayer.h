// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLayer_h
#define dgtkLayer_h

#include "dgtkCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace dgtk
{

/// Type of one channel of a pixel.
enum class PixelType
{
  UInt8,
  UInt16,
  UInt32,
  Float32,
  Float64
};

/// Bytes of one channel.
DGTKCORE_EXPORT std::size_t bytesOf(PixelType type);
/// "uint8", "uint16", "uint32", "float32", "float64": the names that the manifest and NumPy use.
DGTKCORE_EXPORT const char* nameOf(PixelType type);

/// What the values of a layer are. Decides their channels' names, colours and texts: nobody asks for a layer's name.
enum class Meaning
{
  Unknown,
  Picture,            ///< colours, or gray
  Id,                 ///< of objects; with four channels 24 bits, high first, and the object's coverage
  Class,              ///< of objects
  Index,              ///< within an object
  Visibility,         ///< visibility class of a surface point in another image
  Depth,              ///< z in the camera frame
  Distance,           ///< from the camera centre
  InverseDepth,       ///< 1 / z
  Point,              ///< coordinates in the layer's frame, which may be another image
  Direction,          ///< unit vector
  Displacement,       ///< difference of two points
  TextureCoordinates, ///< (u, v)
  Weights,            ///< barycentric coordinates
  Coverage,           ///< share of the pixel, or ranks of (id, share)
  Mask,               ///< which pixels are meant
  Surfaces,           ///< all along each ray
  Record              ///< no image
};
/// "picture", "texture coordinates": the words of the manifest.
DGTKCORE_EXPORT const char* nameOf(Meaning meaning);
/// Unknown for a word that is none.
DGTKCORE_EXPORT Meaning meaningFromName(const std::string& name);

/// What the values of a layer mean. Plain text, written to the manifest as it stands.
struct LayerSpec
{
  std::string name; ///< as on the command line: "depth"
  PixelType type = PixelType::UInt8;
  int channels = 1;
  std::string unit;        ///< "scene units", "pixels", "1", "id"
  std::string frame;       ///< coordinate frame of the values: "camera", "world", "object", "image" or ""
  std::string invalid;     ///< value where there is nothing: "+inf", "nan", "0"
  std::string description; ///< one sentence
  Meaning meaning = Meaning::Unknown;
};

/// A rectangle of pixels; x to the right, y down from the top-left corner of the image.
struct PixelRect
{
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  bool operator==(const PixelRect& o) const
  {
    return this->x == o.x && this->y == o.y && this->width == o.width && this->height == o.height;
  }
};

/// Full-width rows [y, y + height) of a layer, top to bottom, channels interleaved, without padding.
class DGTKCORE_EXPORT Rows
{
public:
  Rows() = default;
  Rows(PixelType type, int channels, int width, int y, int height);

  PixelType type() const { return this->Type; }
  int channels() const { return this->Channels; }
  int width() const { return this->Width; }
  int y() const { return this->Y; }
  int height() const { return this->Height; }
  std::size_t rowBytes() const { return bytesOf(this->Type) * this->Channels * this->Width; }
  std::size_t bytes() const { return this->rowBytes() * this->Height; }

  std::byte* data() { return this->Data.get(); }
  const std::byte* data() const { return this->Data.get(); }

  /// First channel of the first pixel of image row `row` (y() <= row < y() + height()). T must match type().
  template <typename T>
  T* row(int row)
  {
    return reinterpret_cast<T*>(this->Data.get()) + std::size_t(row - this->Y) * this->Width * this->Channels;
  }
  template <typename T>
  const T* row(int row) const
  {
    return reinterpret_cast<const T*>(this->Data.get()) + std::size_t(row - this->Y) * this->Width * this->Channels;
  }

private:
  PixelType Type = PixelType::UInt8;
  int Channels = 0;
  int Width = 0;
  int Y = 0;
  int Height = 0;
  std::unique_ptr<std::byte[]> Data; // left uninitialised: every producer writes every pixel
};

} // namespace dgtk

#endif
