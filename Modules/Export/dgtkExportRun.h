// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExportRun_h
#define dgtkExportRun_h

#include "dgtkDatasetScenes.h"
#include "dgtkExport.h"
#include "dgtkExportNotes.h"
#include "dgtkExporterEntry.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace dgtk
{

/// Items of an export one behind the other.
struct ItemRange
{
  std::size_t first = 0;
  std::size_t end = 0;
};

/// One export of one format: its items in any order, then its documents, then export.json.
class ExportRun
{
public:
  ExportRun(const ExportRequest& request, const ExportCallbacks& callbacks);
  ExportResult execute();

  /// The items of a block alone, into a folder of their own, without documents; what is there of them is kept.
  ExportResult executeBlock(const std::string& folder, const ItemRange& block);
  /// Whether a block's folder holds all of its items, every file with its recorded size and SHA-256.
  bool holdsBlock(const std::string& folder, const ItemRange& block) const;
  /// The whole export from the folders of its blocks, which stay; into the request's folder.
  ExportResult executeFrom(const std::vector<std::pair<std::string, ItemRange>>& blocks);

  /// Throws UsageError where one file would be written over another; execute() asks, too.
  void requireOneEach() const;
  /// Of format, dataset and all that decides bytes.
  const std::string& hash() const { return this->Hash; }
  std::size_t items() const { return this->Items; } ///< without documents
  /// So many items that blocks have are what progress counts.
  void count(std::size_t items) { this->Total = items; }

private:
  TextPairs described() const;
  std::string identity() const;
  void forNames(const std::function<void(const std::string&)>& visit) const;
  ForNames announced() const;
  bool isKept(std::size_t item) const;
  void writeItems(const ItemRange& range);
  void write(std::size_t item);
  void adopt(std::size_t item, const std::string& folder, const ExportNotes& notes);
  ExportResult end();
  void writeDocuments();
  void close();
  void forRecords(const std::function<void(const ItemRecord&)>& visit) const;
  void forNotes(const std::string& list, const std::function<void(const std::string&)>& visit) const;
  ExportItem item(std::size_t index) const;
  std::size_t all() const { return this->Items + this->Plan.documents.size(); }
  bool cancelled() const { return this->Callbacks.cancel && *this->Callbacks.cancel; }
  void advance(bool kept = false);
  void discard(bool withFolder);

  ExportRequest Request;
  ExportCallbacks Callbacks;
  const ExporterRow& Row;
  std::unique_ptr<Exporter> Format;
  DatasetScenes Datasets;
  ExportPlan Plan;
  std::size_t Items = 0;
  std::size_t Total = 0; ///< that progress counts
  std::string Hash;
  std::unique_ptr<Journal> Log;
  std::unique_ptr<ExportNotes> Notes;
  std::mutex ProgressMutex;
  std::size_t Done = 0;
  std::size_t Kept = 0; ///< of those done
  ExportResult Result;
};

/// Each scene of a folder of datasets as a request of its own.
ExportRequest sceneExport(const ExportRequest& request, const std::string& scene);
/// Of a format whose exports of many scenes are one each: the scenes' names; else none.
std::vector<std::string> scenesApart(const ExportRequest& request);
/// Where one of several scenes stands among them.
struct ScenePlace
{
  std::size_t scene = 0;
  std::size_t scenes = 0;
  std::size_t keptScenes = 0; ///< of those before it, that were there as a whole
  std::size_t keptItems = 0;  ///< of the others before it
};

/// Of one of several scenes, whose progress is that of all.
ExportCallbacks sceneCallbacks(const ExportCallbacks& callbacks, const ScenePlace& place);
/// Adds what one export, or block, came to; `interrupted` is the last one's.
void addResult(const ExportResult& one, ExportResult& all);

} // namespace dgtk

#endif
