// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLdi_h
#define dgtkLdi_h

#include "dgtkDatasetIOModule.h"

#include "dgtkLayerWriter.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// One surface along the ray through a pixel's centre, to be written.
struct LdiSurface
{
  std::array<float, 4> rgba{}; ///< display-referred (sRGB-encoded) colour and opacity in [0, 1], not premultiplied
  double depth = 0;            ///< z in the camera frame, scene units
  std::uint32_t splatIndex = 0;
  std::uint32_t object = 0;   ///< id, 1..N
  std::uint32_t part = 0;     ///< within the object
  std::uint32_t triangle = 0; ///< within the part
};

/// Names of what a .ldi file has of a pixel and of a surface: count, and colour, depth and splat index.
constexpr const char* ldiParts[] = { "count", "rgba", "depth", "splat" };
/// A surface's colour as .ldi files hold it: rounded as the layer color is.
DGTKDATASETIO_EXPORT std::array<std::uint8_t, 4> ldiColor(const std::array<float, 4>& rgba);

/// Full-width rows of a layered depth image, top to bottom.
struct LdiRows
{
  int y = 0;
  int height = 0;
  std::vector<std::uint32_t> counts; ///< surfaces of each pixel, width * height
  std::vector<LdiSurface> surfaces;  ///< of all pixels in turn, near to far within a pixel
};

/// Writes a layered depth image while it is produced; as LayerWriter, memory stays bounded by a block of rows and the
/// file appears on finish() only. Failures are MachineErrors naming the file.
class DGTKDATASETIO_EXPORT LdiWriter
{
public:
  virtual ~LdiWriter() = default;
  /// The next rows. Throws UsageError for rows out of order or counts that do not add up.
  virtual void write(const LdiRows& rows) = 0;
  virtual FileRecord finish() = 0;
};

/// `format`: "ldi", the thesis's file (Documentation/Formats/ldi.md), or "exr", deep scan lines with the channels R G B
/// A (float32, linear light, premultiplied), Z (float32 depth), id, part, triangle (uint32). Throws UsageError for
/// another format.
DGTKDATASETIO_EXPORT std::unique_ptr<LdiWriter> makeLdiWriter(
  const std::string& format, const FilePlace& path, int width, int height);

/// One record of a .ldi file.
struct LdiRecord
{
  std::array<std::uint8_t, 4> rgba{};
  double depth = 0;
  std::uint32_t splatIndex = 0;
};

/// One row of a .ldi file.
struct LdiRow
{
  std::vector<std::uint32_t> counts; ///< records of each pixel
  std::vector<LdiRecord> records;    ///< of all pixels in turn
};

/// Reads a .ldi file row by row from the top. A damaged file is an InputError that names the file and the offset;
/// memory is bounded by the size of a row in the file.
class DGTKDATASETIO_EXPORT LdiReader
{
public:
  /// Throws InputError for a file that is missing or whose header cannot be true.
  explicit LdiReader(const std::string& path);
  ~LdiReader();
  LdiReader(const LdiReader&) = delete;
  LdiReader& operator=(const LdiReader&) = delete;

  int width() const;
  int height() const;
  /// The next row; false behind the last. Refuses counts that reach beyond the end of the file, depths that are not
  /// finite or not in order, and bytes behind the last row.
  bool read(LdiRow& row);
  /// Back to the first row.
  void rewind();

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

/// Whether a file is deep OpenEXR, which openLayerFile() does not read. False when it cannot be read.
DGTKDATASETIO_EXPORT bool isDeepExr(const std::string& path);

} // namespace dgtk

#endif
