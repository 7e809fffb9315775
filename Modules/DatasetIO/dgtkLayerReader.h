// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLayerReader_h
#define dgtkLayerReader_h

#include "dgtkDatasetIOModule.h"

#include "dgtkLayer.h"

#include <Eigen/Core>

#include <memory>
#include <string>

namespace dgtk
{

/// What the header of an image file says.
struct ImageInfo
{
  std::string format; ///< "npy", "png", "ppm", "pfm", "exr", "flo", "dgd"
  PixelType type = PixelType::UInt8;
  int channels = 0;
  int width = 0;
  int height = 0;
  std::uint64_t pixelBytes() const
  {
    return bytesOf(this->type) * std::uint64_t(this->channels) * this->width * this->height;
  }
};

/// The matrices of a .dgd file, OpenGL.
struct DepthMatrices
{
  Eigen::Matrix4d projection = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d modelView = Eigen::Matrix4d::Identity();
};

/// Reads the rows of an image file from top to bottom in blocks; memory stays bounded by a block (and for PNG and EXR
/// by the decoder's state). Damaged files are InputErrors naming the file and, where there is one, the byte offset;
/// nothing is allocated on the word of a header that the file's size does not bear out.
class DGTKDATASETIO_EXPORT RowReader
{
public:
  virtual ~RowReader() = default;
  const ImageInfo& info() const { return this->Info; }
  /// The next rows, at most `rows` (>= 1) and fewer at the end; of height 0 behind the last.
  Rows read(int rows);
  /// Passes over rows, at most to the end; formats whose rows are found at once do not read them.
  void skip(int rows);

protected:
  virtual void readRows(Rows& rows) = 0;
  /// Whether readRows() finds any row without those before it.
  virtual bool anyRow() const { return false; }
  ImageInfo Info;

private:
  int Next = 0;
};

/// Opens a file by its extension. Throws InputError for one that cannot be read, UsageError for an unknown extension.
/// `matrices`, when given, receives those of a .dgd file.
DGTKDATASETIO_EXPORT std::unique_ptr<RowReader> openLayerFile(
  const std::string& path, DepthMatrices* matrices = nullptr);

/// The same of what may be a table: a .npy file may have no rows, as that of tracks where none begins.
DGTKDATASETIO_EXPORT std::unique_ptr<RowReader> openLayerTable(
  const std::string& path, DepthMatrices* matrices = nullptr);

/// Whether openLayerFile() knows the extension of `path`.
DGTKDATASETIO_EXPORT bool isLayerFile(const std::string& path);

/// A whole image.
struct ImageData
{
  ImageInfo info;
  Rows pixels;            ///< all rows
  DepthMatrices matrices; ///< of a .dgd file
};

/// Reads a whole file. Values are those of the file: nothing is scaled; .ppm files keep three channels; the unknown
/// flow of .flo is NaN. Throws as openLayerFile(), and InputError for more than `limit` bytes of pixels.
DGTKDATASETIO_EXPORT ImageData readLayerFile(const std::string& path, std::uint64_t limit = std::uint64_t(1) << 33);

} // namespace dgtk

#endif
