// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkItemSink_h
#define dgtkItemSink_h

#include "dgtkExportNotes.h"
#include "dgtkExporter.h"
#include "dgtkJournal.h"

#include <string>

namespace dgtk
{

/// Adds what one item did to a layer's values to what others did.
void addRounding(std::vector<LayerRounding>& all, const LayerRounding& one);
void addRounding(std::vector<LayerRounding>& all, const std::vector<LayerRounding>& some);

/// Writes the files of one item into the folder of an export and collects what it leaves.
class ItemSink : public ExportSink
{
public:
  /// Reads notes of finished items; where there are none, null.
  using Notes = std::function<void(const std::string& list, const std::function<void(const std::string&)>& visit)>;

  ItemSink(const DatasetView& dataset, const std::string& folder, const ExportItem& item, Journal& journal, bool links);
  void readsNotes(Notes notes) { this->Others = std::move(notes); }

  using ExportSink::write;
  std::unique_ptr<ExportFile> open(const std::string& name, const ExportedPixels& pixels) override;
  void copy(const std::string& name, const std::string& datasetFile, const ExportedPixels& pixels) override;
  void note(const std::string& list, const std::string& text) override { this->Record.notes.emplace_back(list, text); }
  void notes(const std::string& list, const std::function<void(const std::string&)>& visit) override;
  void rounding(const LayerRounding& rounding) override { addRounding(this->Record.rounding, rounding); }

  const ItemRecord& record() const { return this->Record; }

private:
  class Piecewise;
  void expect(const std::string& name) const;
  void finished(const DatasetFile& file, const PixelEncoding& encoding);
  const DatasetView& Dataset;
  Folder Holder;
  const ExportItem& Item;
  Journal& Log;
  bool Links;
  Notes Others;
  ItemRecord Record;
};

/// Gives a file a second name in a folder, under which it takes the place of what is there. False where that cannot be:
/// on another disk, or one without links.
bool linkFile(const std::string& path, const Folder& folder, const std::string& name);

} // namespace dgtk

#endif
