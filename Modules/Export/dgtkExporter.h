// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExporter_h
#define dgtkExporter_h

#include "dgtkExportModule.h"

#include "dgtkDatasetView.h"

#include "dgtkExportDocument.h"
#include "dgtkOption.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// What a dataset has to hold for a format: what `render` adds when it is asked for a dataset for the format.
struct ExportNeeds
{
  std::vector<std::string> layers;
  OptionValues options = {}; ///< of a run: "tracks_step"; those that the user gives win
};

/// What a file of an export shows: the layer whose pixels it has, of which picture, and how they are coded.
struct ExportedPixels
{
  std::string layer = {};
  const DatasetShot* shot = nullptr;
  PixelEncoding encoding = {};
};

/// A file of an export while it is written; see ExportSink::open().
class DGTKEXPORT_EXPORT ExportFile
{
public:
  virtual ~ExportFile() = default;
  virtual void write(const void* data, std::size_t bytes) = 0;
  void write(const std::string& text) { this->write(text.data(), text.size()); }
  /// Writes over bytes that were written: of a head that says what only the end knows. The file is then read once more
  /// for its hash.
  virtual void rewrite(std::uint64_t position, const std::string& text) = 0;
  /// The file gets its name. Without it nothing is left behind. What it turned out to be: path, bytes, hash.
  virtual DatasetFile finish() = 0;
};

/// Takes what an item writes. Names are relative to the export's folder, with '/'. Failures are MachineErrors.
class DGTKEXPORT_EXPORT ExportSink
{
public:
  virtual ~ExportSink() = default;

  /// A file that is written piece by piece.
  virtual std::unique_ptr<ExportFile> open(const std::string& name, const ExportedPixels& pixels = {}) = 0;
  /// A whole file.
  void write(const std::string& name, const std::string& bytes, const ExportedPixels& pixels = {});
  /// A file of the dataset as it is; a hard link where that was asked for.
  virtual void copy(const std::string& name, const std::string& datasetFile, const ExportedPixels& pixels = {}) = 0;

  /// A text for a document of the whole export, which is made when all items are done. Texts of a list are read in the
  /// order of the items. They wait on the disk, so that memory does not grow with the number of pictures.
  virtual void note(const std::string& list, const std::string& text) = 0;
  /// Of a document's item: calls visit(text) for all texts of a list.
  virtual void notes(const std::string& list, const std::function<void(const std::string&)>& visit) = 0;

  /// What the format did to values of a layer; counts are added up, of the largest error the largest stays.
  virtual void rounding(const LayerRounding& rounding) = 0;
};

/// Something to write: a pure function of the dataset, in any order, on any thread.
struct ExportItem
{
  std::vector<std::string> files; ///< all that it writes; an item without files leaves notes only
  std::function<void(ExportSink&)> write;
  std::vector<ExportedName> names = {}; ///< of pictures, as the format calls them; beside those of the plan
  const DatasetView* dataset = nullptr; ///< whose files it copies, where there are several
};

/// Items that are made when it is their turn, so that a plan of many pictures is small: item(i) is a pure function, and
/// may be called from any thread, several times.
struct ExportSeries
{
  std::size_t count = 0;
  std::function<ExportItem(std::size_t)> item;
};

struct ExportPlan
{
  std::vector<ExportItem> items;
  std::vector<ExportSeries> series;  ///< behind the items, in this order
  std::vector<ExportItem> documents; ///< written one by one after all items; they may read their notes
  TextPairs conventions;             ///< { "pixel_centre", "integer: cx and cy are 0.5 less" }, ...
  std::vector<ExportedName> names;   ///< of the pictures, as the format calls them; those of items follow
  std::vector<std::string> warnings; ///< lines for the user: what becomes of the dataset in the format
};

/// A format of other people's datasets. Stateless; sees a dataset, and nothing of how it was made.
class DGTKEXPORT_EXPORT Exporter
{
public:
  virtual ~Exporter() = default;
  /// Beside the options that all formats have (exportOptions()).
  virtual std::vector<const OptionRow*> options() const { return {}; }
  virtual ExportNeeds needs(const OptionValues& options) const = 0;
  /// What the format cannot say is a UsageError that names it, before anything is written. Layers that needs() lists
  /// have been looked for in every picture.
  virtual void check(const DatasetView& dataset, const OptionValues& options) const;
  virtual ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const = 0;

  /// Whether the datasets of many scenes become one of the format, with pictures side by side. Otherwise each is an
  /// export of its own.
  virtual bool joinsScenes() const { return false; }
  /// Of such datasets, which have the same classes and the same length of a unit: what plan() says of each, one behind
  /// the other, and documents of one name once. So documents are made of notes, and of what all scenes share.
  virtual ExportPlan planScenes(const std::vector<const DatasetView*>& scenes, const OptionValues& options) const;
};

} // namespace dgtk

#endif
