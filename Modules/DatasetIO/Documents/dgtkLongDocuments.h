// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLongDocuments_h
#define dgtkLongDocuments_h

#include "dgtkDatasetIOModule.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkExportDocument.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// Documents that grow with the number of pictures, read entry by entry: memory does not grow with them. As the readers
// of whole documents these throw InputErrors that name the file and the place.

namespace dgtk
{

/// The manifest of the dataset in a folder, as readManifestIn() reads it; its files are handed on in their order, and
/// none are in what is returned.
DGTKDATASETIO_EXPORT Manifest readManifestIn(
  const std::string& folder, const std::function<void(DatasetFile&&)>& visit);
/// A manifest wherever it stands.
DGTKDATASETIO_EXPORT Manifest readManifest(const std::string& path, const std::function<void(DatasetFile&&)>& visit);
DGTKDATASETIO_EXPORT void readCameras(const std::string& path, const std::function<void(CameraRecord&&)>& visit);
DGTKDATASETIO_EXPORT void readPoses(const std::string& path, const std::function<void(PoseRecord&&)>& visit);

/// export.json; what is returned has neither names nor files. An error may come behind files that were handed on.
DGTKDATASETIO_EXPORT ExportRecord readExport(const std::string& path,
  const std::function<void(ExportedName&&)>& visitName, const std::function<void(ExportedFile&&)>& visitFile);
/// The record in a folder, as readExportIn() reads it.
DGTKDATASETIO_EXPORT ExportRecord readExportIn(const std::string& folder,
  const std::function<void(ExportedName&&)>& visitName, const std::function<void(ExportedFile&&)>& visitFile);

/// Finds the poses of a frame in poses.json, which stays on the disk. Every function may be called from any thread.
class DGTKDATASETIO_EXPORT PoseIndex
{
public:
  /// Reads, and so judges, the whole document.
  explicit PoseIndex(const std::string& path);
  /// By id.
  std::vector<PoseRecord> at(int frame) const;

private:
  /// Bytes of poses of one frame that follow each other.
  struct Range
  {
    int frame = 0;
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
  };
  std::string Path;
  std::vector<Range> Ranges; ///< by frame
};

} // namespace dgtk

#endif
