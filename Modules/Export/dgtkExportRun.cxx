// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportRun.h"

#include "dgtkError.h"
#include "dgtkExportChecks.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkItemSink.h"
#include "dgtkSystem.h"
#include "dgtkText.h"
#include "dgtkThreadPool.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <tuple>

namespace dgtk
{

namespace
{
/// The options as they stand in export.json.
ExportRequest checked(ExportRequest request)
{
  const ExporterRow& row = findExporter(request.format);
  std::vector<const OptionRow*> known = exportOptions();
  const std::vector<const OptionRow*> own = row.make()->options();
  known.insert(known.end(), own.begin(), own.end());
  for (auto& [name, value] : request.options)
  {
    const auto option =
      std::find_if(known.begin(), known.end(), [&key = name](const OptionRow* one) { return one->name == key; });
    if (option == known.end())
    {
      throw UsageError(name + ": format " + row.info.name + " has no such option");
    }
    value = (*option)->normal(value);
  }
  return request;
}

DatasetSelection selectionOf(const ExportRequest& request)
{
  DatasetSelection selection = request.selection;
  selection.cameras = exported::cameras().of(request.options);
  const std::vector<double> metres = exported::unitMetres().of(request.options);
  selection.metresPerUnit = metres.empty() ? 0 : metres[0];
  selection.pinholeTwins = exported::undistort().of(request.options);
  return selection;
}

void noNames(const std::function<void(const std::string&)>&) {}

/// The export is a folder of its own.
void requireOther(const ExportRequest& request)
{
  std::error_code code;
  if (std::filesystem::equivalent(request.dataset, request.folder, code))
  {
    throw UsageError(request.folder + ": is the dataset's own folder; name another one for the export");
  }
  requireOutsideDatasets(request.folder);
}

} // namespace

ExportRun::ExportRun(const ExportRequest& request, const ExportCallbacks& callbacks)
  : Request(checked(request))
  , Callbacks(callbacks)
  , Row(findExporter(request.format))
  , Format(this->Row.make())
  , Datasets(request.dataset, selectionOf(this->Request))
{
  const OptionValues& options = this->Request.options;
  requireOther(request);
  for (const DatasetView* dataset : this->Datasets.views())
  {
    requireLayers(*dataset, this->Format->needs(options), this->Row.info.name);
    this->Format->check(*dataset, options);
  }
  this->Plan = this->Datasets.many() ? this->Format->planScenes(this->Datasets.views(), options)
                                     : this->Format->plan(this->Datasets.first(), options);
  this->Items = this->Plan.items.size();
  for (const ExportSeries& series : this->Plan.series)
  {
    this->Items += series.count;
  }
  this->Total = this->all();
  this->Hash = this->identity();
}

ExportItem ExportRun::item(std::size_t index) const
{
  if (index < this->Plan.items.size())
  {
    return this->Plan.items[index];
  }
  index -= this->Plan.items.size();
  for (const ExportSeries& series : this->Plan.series)
  {
    if (index < series.count)
    {
      return series.item(index);
    }
    index -= series.count;
  }
  return this->Plan.documents.at(index);
}

/// What decides bytes: neither threads nor links.
TextPairs ExportRun::described() const
{
  TextPairs pairs;
  const DatasetSelection& frames = this->Request.selection;
  pairs.emplace_back("frames", frames.someFrames ? std::to_string(frames.first) + ':' + std::to_string(frames.last) +
                                                     ':' + std::to_string(frames.step)
                                                 : "all");
  const auto add = [&](const OptionRow* row) { pairs.emplace_back(row->name, row->text(this->Request.options)); };
  for (const OptionRow* row : exportOptions())
  {
    if (row->name != exported::threads().name && row->name != exported::link().name)
    {
      add(row);
    }
  }
  for (const OptionRow* row : this->Format->options())
  {
    add(row);
  }
  return pairs;
}

std::string ExportRun::identity() const
{
  std::string text = std::string(DGTK_VERSION) + '\n' + this->Row.info.name + '\n' + this->Datasets.manifestHash();
  for (const auto& [name, value] : this->described())
  {
    text += '\n' + name + '=' + value;
  }
  return Sha256::of(text);
}

void ExportRun::forNames(const std::function<void(const std::string&)>& visit) const
{
  for (std::size_t i = 0; i < this->all(); ++i)
  {
    for (const std::string& name : this->item(i).files)
    {
      visit(name);
    }
  }
}

/// No file is written over another one.
void ExportRun::requireOneEach() const
{
  NameTable names;
  std::size_t count = 0;
  this->forNames(
    [&](const std::string& name)
    {
      names.add(name);
      ++count;
    });
  names.finish();
  if (names.size() == count)
  {
    return;
  }
  this->forNames(
    [&](const std::string& name)
    {
      if (++*names.numberOf(name) > 1)
      {
        throw UsageError(this->Row.info.name + ": two files would be " + quoted(name) +
                         " (expected names of cameras and parts that differ in the format, too)");
      }
    });
}

/// What may be in the way of files; nothing is in an empty folder, however many they are.
ForNames ExportRun::announced() const
{
  std::error_code code;
  if (!std::filesystem::exists(this->Request.folder, code) || std::filesystem::is_empty(this->Request.folder, code))
  {
    return noNames;
  }
  return [this](const auto& visit) { this->forNames(visit); };
}

ExportResult ExportRun::execute()
{
  this->requireOneEach();
  if (this->Request.resume && this->Request.replace)
  {
    throw UsageError("a run is either resumed or replaced");
  }
  const JournalStart start = this->Request.resume    ? JournalStart::Resume
                             : this->Request.replace ? JournalStart::Replace
                                                     : JournalStart::Fresh;
  std::error_code code;
  const bool anew = !std::filesystem::exists(this->Request.folder, code);
  this->Log = std::make_unique<Journal>(this->Request.folder, this->Hash, start, this->announced(), exportName);
  this->Notes = std::make_unique<ExportNotes>(this->Request.folder, this->Hash, this->all(), this->Request.resume);
  try
  {
    this->writeItems({ 0, this->items() });
    return this->end();
  }
  catch (const UsageError&) // values without a code, which are found when they are written
  {
    this->discard(anew);
    throw;
  }
}

/// Nothing stays of a run that is refused while it writes.
void ExportRun::discard(bool withFolder)
{
  this->Notes->remove();
  this->Notes.reset();
  this->Log.reset();
  static_cast<void>(Journal(this->Request.folder, this->Hash, JournalStart::Replace, noNames, exportName));
  Folder(this->Request.folder).remove(journalName);
  if (withFolder)
  {
    std::error_code code;
    std::filesystem::remove(this->Request.folder, code);
  }
}

ExportResult ExportRun::end()
{
  if (!this->cancelled())
  {
    this->writeDocuments();
  }
  this->Result.interrupted = this->cancelled();
  if (!this->Result.interrupted)
  {
    this->close();
  }
  return this->Result;
}

namespace
{
bool holds(const Journal& journal, const ExportNotes& notes, std::size_t item)
{
  if (!notes.has(item))
  {
    return false;
  }
  const ItemRecord record = notes.read(item);
  return std::all_of(record.files.begin(), record.files.end(),
    [&](const ExportedFile& one)
    {
      const std::optional<DatasetFile> file = journal.find(one.file.path);
      return file && file->sha256 == one.file.sha256;
    });
}
} // namespace

bool ExportRun::isKept(std::size_t item) const { return holds(*this->Log, *this->Notes, item); }

void ExportRun::advance(bool kept)
{
  const std::lock_guard<std::mutex> guard(this->ProgressMutex);
  ++this->Done;
  this->Kept += std::size_t(kept);
  if (this->Callbacks.progress)
  {
    this->Callbacks.progress({ this->Done, this->Total, this->Kept });
  }
}

void ExportRun::writeItems(const ItemRange& range)
{
  const int threads = exported::threads().of(this->Request.options);
  ThreadPool pool(threads > 0 ? threads : machineThreads());
  const std::size_t before = this->Kept;
  std::atomic<bool> failed{ false };
  pool.parallelFor(static_cast<int>(range.end - range.first),
    [&](int i)
    {
      const std::size_t item = range.first + std::size_t(i);
      if (failed || this->cancelled())
      {
        return;
      }
      try
      {
        const bool kept = this->isKept(item);
        if (!kept)
        {
          this->write(item);
        }
        this->advance(kept);
      }
      catch (...)
      {
        failed = true;
        throw;
      }
    });
  this->Result.kept = this->Kept - before;
}

void ExportRun::write(std::size_t index)
{
  const ExportItem item = this->item(index);
  const DatasetView& dataset = item.dataset ? *item.dataset : this->Datasets.first();
  ItemSink sink(dataset, this->Request.folder, item, *this->Log, exported::link().of(this->Request.options));
  if (index >= this->items())
  {
    sink.readsNotes([this](const std::string& list, const auto& visit) { this->forNotes(list, visit); });
  }
  item.write(sink);
  for (const LayerRounding& layer : sink.record().rounding)
  {
    requireCodes(layer, this->Request.options, item.files.empty() ? "" : item.files.front());
  }
  this->Notes->add(index, sink.record());
}

ExportResult ExportRun::executeBlock(const std::string& folder, const ItemRange& block)
{
  this->Request.folder = folder;
  this->Result = {};
  this->Log = std::make_unique<Journal>(folder, this->Hash, JournalStart::Resume, noNames, exportName);
  this->Notes = std::make_unique<ExportNotes>(folder, this->Hash, this->all(), true);
  this->writeItems(block);
  this->Result.interrupted = this->cancelled();
  this->Notes.reset();
  this->Log.reset();
  return this->Result;
}

bool ExportRun::holdsBlock(const std::string& folder, const ItemRange& block) const
{
  std::error_code code;
  if (!std::filesystem::exists(folder, code))
  {
    return false;
  }
  try
  {
    const Journal journal(folder, this->Hash, JournalStart::Resume, noNames, exportName);
    const ExportNotes notes(folder, this->Hash, this->all(), true);
    for (std::size_t i = block.first; i < block.end; ++i)
    {
      if (!holds(journal, notes, i))
      {
        return false;
      }
    }
    return true;
  }
  catch (const FolderError&) // another process is writing it, or it is of another request
  {
    return false;
  }
}

ExportResult ExportRun::executeFrom(const std::vector<std::pair<std::string, ItemRange>>& blocks)
{
  this->Log =
    std::make_unique<Journal>(this->Request.folder, this->Hash, JournalStart::Resume, this->announced(), exportName);
  this->Notes = std::make_unique<ExportNotes>(this->Request.folder, this->Hash, this->all(), true);
  for (const auto& [folder, block] : blocks)
  {
    const ExportNotes part(folder, this->Hash, this->all(), true);
    for (std::size_t i = block.first; i < block.end && !this->cancelled(); ++i)
    {
      if (!this->isKept(i))
      {
        this->adopt(i, folder, part);
      }
      this->advance();
    }
  }
  return this->end();
}

/// A finished item of a part: its files under a second name or, where a disk has none, copied.
void ExportRun::adopt(std::size_t item, const std::string& folder, const ExportNotes& notes)
{
  const Folder from(folder);
  const Folder to(this->Request.folder);
  const ItemRecord record = notes.read(item);
  std::vector<std::string> names;
  for (const ExportedFile& one : record.files)
  {
    names.push_back(one.file.path);
  }
  this->Log->plan(names);
  for (const ExportedFile& one : record.files)
  {
    to.makeParents(one.file.path);
    if (!linkFile(from.pathOf(one.file.path), to, one.file.path))
    {
      AtomicFile target(FilePlace(to.path(), one.file.path));
      target.write(readFile(from.pathOf(one.file.path)));
      target.commit();
    }
    this->Log->add(one.file);
  }
  this->Notes->add(item, notes);
}

void ExportRun::writeDocuments()
{
  for (std::size_t i = 0; i < this->Plan.documents.size() && !this->cancelled(); ++i)
  {
    this->write(this->items() + i);
    this->advance();
  }
}

void ExportRun::forRecords(const std::function<void(const ItemRecord&)>& visit) const
{
  for (std::size_t i = 0; i < this->all(); ++i)
  {
    if (this->Notes->has(i)) // documents are written one after another
    {
      visit(this->Notes->read(i));
    }
  }
}

void ExportRun::forNotes(const std::string& list, const std::function<void(const std::string&)>& visit) const
{
  for (std::size_t i = 0; i < this->all(); ++i)
  {
    if (this->Notes->has(i))
    {
      this->Notes->forNotes(i, list, visit);
    }
  }
}

void ExportRun::close()
{
  ExportRecord record;
  record.version = DGTK_VERSION;
  record.exporter = this->Row.info.name;
  record.requestHash = this->Hash;
  record.manifestHash = this->Datasets.manifestHash();
  record.request = this->described();
  record.conventions = this->Plan.conventions;
  record.names = this->Plan.names;
  this->forRecords([&](const ItemRecord& item) { addRounding(record.layers, item.rounding); });
  requireSomeCodes(record.layers, this->Row.info.name);
  std::sort(record.layers.begin(), record.layers.end(),
    [](const LayerRounding& a, const LayerRounding& b)
    { return std::tie(a.layer, a.unit) < std::tie(b.layer, b.unit); });
  this->Log->close(
    [&](AtomicFile& document)
    {
      Sha256 hash;
      const auto write = [&](const std::string& text)
      {
        hash.update(text.data(), text.size());
        document.write(text);
      };
      write(exportHead(record));
      bool first = record.names.empty();
      this->forRecords(
        [&](const ItemRecord& item)
        {
          for (const ExportedName& name : item.names)
          {
            write(exportNameLine(name, first));
            first = false;
          }
        });
      write(exportMiddle(first));
      this->forRecords(
        [&](const ItemRecord& item)
        {
          for (const ExportedFile& file : item.files)
          {
            write(exportFileLine(file, this->Result.files++ == 0));
          }
        });
      document.write(exportTail(hash.hex()));
    });
  this->Result.layers = record.layers;
  for (const std::string& warning : this->Callbacks.message ? this->Plan.warnings : std::vector<std::string>())
  {
    this->Callbacks.message("warning: " + warning);
  }
}

} // namespace dgtk
