// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCompare_h
#define dgtkCompare_h

#include "dgtkDatasetIOModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dgtk
{

/// Two files compared. NaN equals NaN, and infinities of one sign are equal; where only one side is NaN or infinite the
/// difference is +inf.
struct CompareResult
{
  std::string path;         ///< within the datasets; "" when two files were compared
  bool equal = false;       ///< no pixel differs (files), or the same bytes (what is not an image)
  bool sameBytes = false;   ///< the files are identical
  std::string problem;      ///< why pixels were not compared: missing, another size or type; "" when they were
  std::uint64_t pixels = 0; ///< compared
  std::uint64_t differing = 0;
  double largest = 0; ///< largest absolute difference of a channel
  int firstX = -1;    ///< first differing pixel in reading order
  int firstY = -1;
  int worstX = -1; ///< pixel of the largest difference, the first of them in reading order
  int worstY = -1;
};

struct DatasetComparison
{
  bool equal = false;      ///< every file is equal
  std::uint64_t files = 0; ///< in either dataset, without the manifests
  /// The files that are not equal, or not identical, by path.
  std::vector<CompareResult> differing;
  /// Parts of the manifests that differ ("version", "request: tile"); they alone make no dataset differ.
  std::vector<std::string> manifest;
};

/// Two image files of any readable formats; their types may differ as long as the channels agree. Other files are
/// compared byte by byte. Throws InputError for a file that cannot be read.
DGTKDATASETIO_EXPORT CompareResult compareFiles(const std::string& a, const std::string& b);

/// Two datasets, file by file: those of their manifests, or of the folders where one has none. What is on the disk is
/// compared, whatever a manifest says about it. Throws InputError for a folder that cannot be read.
DGTKDATASETIO_EXPORT DatasetComparison compareDatasets(const std::string& a, const std::string& b);

/// One line for people, without a line break.
DGTKDATASETIO_EXPORT std::string describe(const CompareResult& result);
/// The members of the structure under the same names. An infinite difference is null.
DGTKDATASETIO_EXPORT std::string compareJson(const CompareResult& result);
DGTKDATASETIO_EXPORT std::string compareJson(const DatasetComparison& result);

} // namespace dgtk

#endif
