// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExport_h
#define dgtkExport_h

#include "dgtkExportModule.h"

#include "dgtkExporter.h"
#include "dgtkJournal.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace dgtk
{

/// A dataset, and what is to become of it.
struct ExportRequest
{
  std::string dataset;        ///< its folder
  std::string folder;         ///< of the export
  std::string format;         ///< name of an exporter
  DatasetSelection selection; ///< its frames; cameras and unit are options
  OptionValues options;
  bool resume = false;
  bool replace = false;
};

struct ExportProgress
{
  std::size_t done = 0;
  std::size_t total = 0;
  std::size_t kept = 0; ///< of those done, the items taken over from an interrupted run
};

/// May be called from any thread, one at a time.
struct ExportCallbacks
{
  std::function<void(const ExportProgress&)> progress;
  std::function<void(const std::string&)> message; ///< a line
  const std::atomic<bool>* cancel = nullptr;
};

struct ExportResult
{
  std::size_t files = 0;
  std::size_t kept = 0; ///< items taken over from an interrupted run
  bool interrupted = false;
  std::vector<LayerRounding> layers;
};

/// Writes a dataset in another format; export.json last. The same bytes whatever the threads, resumed or not. Throws
/// UsageError for what the format cannot say and for a folder that is in the way, InputError for a dataset that cannot
/// be read, MachineError for a folder that cannot be written.
DGTKEXPORT_EXPORT ExportResult exportDataset(const ExportRequest& request, const ExportCallbacks& callbacks = {});

/// What a dataset has to hold for formats; UsageError for an unknown one. Layers sorted, each once.
DGTKEXPORT_EXPORT ExportNeeds needsOf(const std::vector<std::string>& formats);

/// Adds these to a request: to its layers, and to its options where they are not given.
DGTKEXPORT_EXPORT void addNeeds(
  const std::vector<std::string>& formats, std::vector<std::string>& layers, OptionValues& options);

/// Options that all formats have.
DGTKEXPORT_EXPORT const std::vector<const OptionRow*>& exportOptions();
/// These and those of every exporter, each once.
DGTKEXPORT_EXPORT std::vector<const OptionRow*> allExportOptions();
/// Throws UsageError with the nearest name for one that there is not.
DGTKEXPORT_EXPORT const struct ExporterRow& findExporter(const std::string& name);

// Typed rows of the options that all formats have.
namespace exported
{
DGTKEXPORT_EXPORT const NamesOption& cameras();
DGTKEXPORT_EXPORT const NamesOption& split();        ///< "train=0:79,val=80:99"
DGTKEXPORT_EXPORT const NumbersOption& unitMetres(); ///< metres of a scene unit
DGTKEXPORT_EXPORT const ChoiceOption& color();       ///< layer of the pictures
DGTKEXPORT_EXPORT const ChoiceOption& depth();       ///< layer of the depth maps
DGTKEXPORT_EXPORT const ChoiceOption& imageFormat(); ///< "png" or "jpg"
DGTKEXPORT_EXPORT const IntegerOption& quality();    ///< of JPEG
DGTKEXPORT_EXPORT const ChoiceOption& outOfRange();  ///< "void" or "refuse"
DGTKEXPORT_EXPORT const SwitchOption& undistort();   ///< pinhole twins in place of lenses
DGTKEXPORT_EXPORT const SwitchOption& link();        ///< hard links for equal bytes
DGTKEXPORT_EXPORT const IntegerOption& threads();
} // namespace exported

/// A part of a dataset by frames, or of many scenes by their places, as the option `split` names it.
struct DatasetSplit
{
  std::string name;
  int first = 0;
  int last = 0;
  bool holds(const DatasetShot& shot) const { return shot.part >= this->first && shot.part <= this->last; }
};
/// Without the option: one split of all frames, of this name. Throws UsageError for what is not NAME=A:B, for parts
/// that overlap and for one without a picture.
DGTKEXPORT_EXPORT std::vector<DatasetSplit> splitsOf(
  const DatasetView& dataset, const OptionValues& options, const std::string& usual);

/// Numbers of a split's shots, in their order.
DGTKEXPORT_EXPORT std::vector<std::uint32_t> shotsIn(const DatasetView& dataset, const DatasetSplit& split);

} // namespace dgtk

#endif
