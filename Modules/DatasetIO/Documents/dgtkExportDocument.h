// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExportDocument_h
#define dgtkExportDocument_h

#include "dgtkDatasetIOModule.h"

#include "dgtkDatasetDocuments.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

// export.json, which stands beside a dataset in another program's format; see Documentation/Formats/exports/index.md.

namespace dgtk
{

/// Name of the document in the folder of an export.
constexpr const char* exportName = "export.json";

/// How a file of an export says the pixels of a layer: the name of a decoder and its numbers. `factor` (default 1)
/// times the layer's value is the exported one; decoded values are at most `rounding` from it.
struct PixelEncoding
{
  std::string kind; ///< "png", "kitti-flow", ...: see dgtkExportPixels.h of Verification; "" for a file of no pixels
  std::map<std::string, std::vector<double>> numbers;
};

/// A file of an export; layer, camera and frame are those whose pixels it has.
struct ExportedFile
{
  DatasetFile file;
  PixelEncoding encoding;
};

/// What a format did to a layer's values.
struct LayerRounding
{
  std::string layer;
  std::string unit;
  double largest = 0;            ///< rounding error, in `unit`
  std::uint64_t values = 0;      ///< pixels that have one
  std::uint64_t withoutCode = 0; ///< of these, such as the format cannot say: they are marked as nothing
};

/// The name of a picture in the export.
struct ExportedName
{
  std::string camera;
  int frame = 0;
  std::string name;
};

/// A list of texts and of number-like texts, in this order.
using TextPairs = std::vector<std::pair<std::string, std::string>>;

struct ExportRecord
{
  std::string version;     ///< of DGTk
  std::string exporter;    ///< "coco"
  std::string requestHash; ///< of dataset and request
  std::string manifestHash;
  TextPairs request;     ///< option and value
  TextPairs conventions; ///< what is the format's and not the dataset's: "pixel_centre", "axes", "unit", ...
  std::vector<LayerRounding> layers;
  std::vector<ExportedName> names;
  std::vector<ExportedFile> files;
};

// The document in the order of its parts: exportHead(), further names, exportMiddle(), files, exportTail() of the hash
// of all these.

/// Everything before the files, and the record's names.
DGTKDATASETIO_EXPORT std::string exportHead(const ExportRecord& record);
DGTKDATASETIO_EXPORT std::string exportNameLine(const ExportedName& name, bool isFirst);
DGTKDATASETIO_EXPORT std::string exportMiddle(bool noNames);
DGTKDATASETIO_EXPORT std::string exportFileLine(const ExportedFile& file, bool isFirst);
DGTKDATASETIO_EXPORT std::string exportTail(const std::string& sha256);
/// What exportTail() was made of and what it should have been: the hash that the document of a folder says of itself,
/// and that of its text. Throws InputError when it cannot be read.
DGTKDATASETIO_EXPORT std::pair<std::string, std::string> exportOwnHashes(const std::string& path);

/// Throws InputError that names the file and the place.
DGTKDATASETIO_EXPORT ExportRecord readExport(const std::string& path);
/// The record in a folder; as readManifestIn(), no link is followed to what it lists.
DGTKDATASETIO_EXPORT ExportRecord readExportIn(const std::string& folder);

/// `{"kind": "png", "scale": 0.1}`, and back.
DGTKDATASETIO_EXPORT std::string encodingText(const PixelEncoding& encoding);

} // namespace dgtk

#endif
