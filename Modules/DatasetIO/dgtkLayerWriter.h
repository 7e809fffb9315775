// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLayerWriter_h
#define dgtkLayerWriter_h

#include "dgtkDatasetIOModule.h"

#include "dgtkFile.h"
#include "dgtkLayer.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// What a file turned out to be, for the manifest.
struct FileRecord
{
  std::string path; ///< as given to makeLayerWriter
  std::uint64_t bytes = 0;
  std::string sha256;
};

/// What some formats store beside the pixels.
struct LayerWriterContext
{
  Eigen::Matrix4d projection = Eigen::Matrix4d::Identity(); ///< OpenGL, for .dgd
  Eigen::Matrix4d modelView = Eigen::Matrix4d::Identity();  ///< OpenGL, for .dgd
  double near = 0;                                          ///< range of the 8-bit depth picture
  double far = 0;
  std::vector<std::string> channels; ///< names of the channels in .exr, one a channel; empty: those of the layer
  std::vector<std::pair<std::string, std::string>> attributes; ///< further text in the header of .exr
};

/// Writes one image file while it is produced. Rows come strictly top to bottom, in blocks of any height; memory stays
/// bounded by a block (and, for PNG and EXR, by the encoder's state). The file appears under its name on finish() only;
/// without finish() nothing is left behind. Failures are MachineErrors naming the file.
class DGTKDATASETIO_EXPORT LayerWriter
{
public:
  virtual ~LayerWriter() = default;
  virtual void write(const Rows& rows) = 0;
  virtual FileRecord finish() = 0;
};

/// One row of the registry of writers.
struct WriterInfo
{
  std::string name;      ///< "Npy"
  std::string format;    ///< "npy": as the formats of a layer are chosen
  std::string extension; ///< "npy"
  std::string description;
};
DGTKDATASETIO_EXPORT const std::vector<WriterInfo>& layerWriters();

/// Whether `format` can hold a layer of this specification.
DGTKDATASETIO_EXPORT bool canWrite(const std::string& format, const LayerSpec& spec);

/// Whether a file of `format` holds OpenGL's matrices, which a camera without a linear projection does not have.
DGTKDATASETIO_EXPORT bool holdsMatrices(const std::string& format);

/// The type of the real numbers that a file of `format` holds of a layer of `type`: float32 where float64 is rounded to
/// it. Other types, and formats that are no images, are returned as they are.
DGTKDATASETIO_EXPORT PixelType storedType(const std::string& format, PixelType type);
/// The layer as the files of a format hold it: `invalid` is another one where the layer's does not fit.
DGTKDATASETIO_EXPORT LayerSpec storedSpec(const std::string& format, const LayerSpec& spec);
/// The largest value of a uint32 layer, apart from its code for nothing, that fits a format.
DGTKDATASETIO_EXPORT std::uint32_t largestStored(const std::string& format, const LayerSpec& spec);

/// Opens a writer. Throws UsageError for an unknown format or one that cannot hold the layer, MachineError when the
/// file cannot be made.
DGTKDATASETIO_EXPORT std::unique_ptr<LayerWriter> makeLayerWriter(const std::string& format, const FilePlace& path,
  const LayerSpec& spec, int width, int height, const LayerWriterContext& context = {});

} // namespace dgtk

#endif
