// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRunParts_h
#define dgtkRunParts_h

#include "dgtkDatasetIOModule.h"

#include "dgtkDatasetDocuments.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// Where the parts of a run wait in its folder until they are merged.
constexpr const char* partsName = ".dgtk-parts";
/// Where they are once they are merged, until they are removed.
constexpr const char* mergedName = ".dgtk-parts-merged";

/// Which share of a run a process makes: of the run's blocks those with the numbers index, index + count, ...
struct RunShard
{
  std::size_t index = 0;
  std::size_t count = 1;
};

/// A run that several processes make together: pictures of a dataset, datasets of several scenes, or an export of one
/// of these. It falls into blocks of consecutive items, which depend on their number alone. Kept in
/// DIR/.dgtk-parts/run.json.
struct DGTKDATASETIO_EXPORT RunParts
{
  std::string version;     ///< of DGTk
  std::string requestHash; ///< of the whole run
  std::size_t items = 0;   ///< pictures, scenes, or pieces of an export
  bool contactSheet = false;
  std::vector<std::string> scenes;                          ///< names of their folders; none: pictures of one dataset
  std::vector<std::pair<std::string, std::string>> request; ///< of scenes, or of an export
  std::vector<std::string> leftOut;                         ///< files of the scenes' folder that are no scenes
  std::string exporter;                                     ///< of an export: its format
  std::string dataset; ///< of an export: the whole path of the folder that it is made from
  /// Items of a block.
  std::size_t blockSize() const;
  std::size_t blocks() const;
};

/// ".dgtk-parts/000012": the folder of a block of pictures, itself like a dataset; documents, copies of inputs and
/// models are in the first block alone.
DGTKDATASETIO_EXPORT std::string partName(std::size_t block);

/// Whether parts wait in a folder.
DGTKDATASETIO_EXPORT bool hasParts(const std::string& folder);
/// Whether anything stands in the place of parts, but for what a process leaves that was ended while it began them.
DGTKDATASETIO_EXPORT bool holdsParts(const std::string& folder);
/// Throws InputError for what is not written by beginParts().
DGTKDATASETIO_EXPORT RunParts readParts(const std::string& folder);
/// Throws FolderError where something stands in a folder that has no parts; `requestHash` as for folderContents().
DGTKDATASETIO_EXPORT void requireRoomForParts(const std::string& folder, const std::string& requestHash = {});
/// Prepares a folder for the parts of a run, of which this is one process of `workers`; any number may do so at the
/// same time; `replace`: it is alone, and the record of another run goes. Throws UsageError when parts of another
/// request are there, MachineError when it cannot be written.
DGTKDATASETIO_EXPORT void beginParts(
  const std::string& folder, const RunParts& run, std::size_t workers, bool replace = false);
/// Removes the parts of a whole run; killed meanwhile, it leaves a folder that mergeParts() knows to be whole;
/// a later run of the same folder removes the rest.
DGTKDATASETIO_EXPORT void removeParts(const std::string& folder);

/// Counts of processes that the parts in a folder were begun with, ascending.
DGTKDATASETIO_EXPORT std::vector<std::size_t> workersOf(const std::string& folder);

/// Writes the manifest of a folder whose scenes' datasets have just been finished by this process; their files are not
/// looked at. Its parts' record goes.
DGTKDATASETIO_EXPORT void endScenes(const std::string& folder, const RunParts& run);

/// What mergeParts() found.
struct MergeReport
{
  std::size_t blocks = 0;
  std::size_t files = 0;             ///< of the dataset, or datasets
  std::vector<std::size_t> missing;  ///< blocks that are not finished
  std::vector<std::string> problems; ///< lines: parts that do not fit
  std::vector<std::size_t> workers;  ///< counts of processes that the run was begun with, ascending
  bool merged = false;               ///< the folder is whole
  /// The numbers of the processes of so many that have to run again: "3,17,40-42".
  DGTKDATASETIO_EXPORT std::string processes(std::size_t of) const;
};

/// Makes of the parts in a folder what one process would have left, when all are there: every file is compared with its
/// SHA-256 first, and nothing is changed unless all fit. May be called again after it was interrupted, and where all
/// is whole: no blocks then. Throws UsageError where neither parts nor a whole run are, and what reading and writing
/// throw.
DGTKDATASETIO_EXPORT MergeReport mergeParts(const std::string& folder, int threads);

/// The manifest of a folder of datasets.
struct DatasetsManifest
{
  std::string version;
  std::string requestHash;
  std::vector<std::pair<std::string, std::string>> request;
  std::vector<std::string> leftOut;
  std::vector<DatasetFile> datasets; ///< their manifests, in the order of their names
};
/// Throws InputError.
DGTKDATASETIO_EXPORT DatasetsManifest readDatasets(const std::string& folder);

} // namespace dgtk

#endif
