// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCompare_h
#define dgtkCompare_h

#include "dgtkDatasetIOModule.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// How far two images may differ and still be equal.
struct CompareTolerance
{
  double value = 0;                    ///< a pixel counts when a channel differs by more; the file's own unit
  std::optional<std::uint64_t> pixels; ///< how many pixels may count; none may where `share` is not given either
  std::optional<double> share;         ///< which part of all pixels may count, 0 to 1; with `pixels`, both hold

  bool allows(std::uint64_t counted, std::uint64_t all) const;
};

/// Two files compared. NaN equals NaN, and infinities of one sign are equal; where only one side is NaN or infinite the
/// difference is +inf.
struct CompareResult
{
  std::string path;         ///< within the datasets; "" when two files were compared
  bool equal = false;       ///< no pixel differs, or as the tolerance allows; of what is not an image, the same bytes
  bool sameBytes = false;   ///< the files are identical
  std::string problem;      ///< why pixels were not compared: missing, another size or type; "" when they were
  std::uint64_t pixels = 0; ///< compared
  std::uint64_t differing = 0;
  double largest = 0; ///< largest absolute difference of a channel
  int firstX = -1;    ///< first differing pixel in reading order
  int firstY = -1;
  int worstX = -1; ///< pixel of the largest difference, the first of them in reading order
  int worstY = -1;
  std::string layer; ///< whose tolerance it was; "" without a tolerance, or of two files
  std::optional<CompareTolerance> tolerance;
  std::uint64_t beyond = 0; ///< pixels that differ by more than the tolerance's value
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
/// compared byte by byte, whatever the tolerance. Throws InputError for a file that cannot be read.
DGTKDATASETIO_EXPORT CompareResult compareFiles(
  const std::string& a, const std::string& b, const std::optional<CompareTolerance>& tolerance = {});

/// Two datasets, file by file: those of their manifests, or of the folders where one has none. What is on the disk is
/// compared, whatever a manifest says about it. `tolerances` by the names of layers in the manifest of `a`; a layer
/// that is not among them must be equal. Throws InputError for a folder that cannot be read, UsageError for a tolerance
/// of a layer that `a` does not have, and for one of values where the layer holds ids or classes.
DGTKDATASETIO_EXPORT DatasetComparison compareDatasets(
  const std::string& a, const std::string& b, const std::map<std::string, CompareTolerance>& tolerances = {});

/// One line for people, without a line break.
DGTKDATASETIO_EXPORT std::string describe(const CompareResult& result);
/// The members of the structure under the same names. An infinite difference is null.
DGTKDATASETIO_EXPORT std::string compareJson(const CompareResult& result);
DGTKDATASETIO_EXPORT std::string compareJson(const DatasetComparison& result);

} // namespace dgtk

#endif
