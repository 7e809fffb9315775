// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExportNotes_h
#define dgtkExportNotes_h

#include "dgtkExporter.h"
#include "dgtkFolder.h"

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// What a finished item leaves: its files, and what it says for the documents of the whole.
struct ItemRecord
{
  std::vector<ExportedFile> files;
  std::vector<LayerRounding> rounding;
  std::vector<std::pair<std::string, std::string>> notes; ///< list and text
  std::vector<ExportedName> names;
};

/// The records of the items of an export, in a file beside the journal: an export that is resumed finds them, and
/// memory does not hold them. A record that a crash tore is not there.
class ExportNotes
{
public:
  /// Begins anew, or takes over the whole records of the same request (64 hexadecimal digits) that are there. Throws
  /// MachineError.
  ExportNotes(const std::string& folder, const std::string& requestHash, std::size_t items, bool resume);

  bool has(std::size_t item) const { return this->Places[item] != 0; }
  /// Throws MachineError.
  void add(std::size_t item, const ItemRecord& record);
  /// The record of a finished item of another run's part. Throws MachineError.
  void add(std::size_t item, const ExportNotes& part);
  /// The record of a finished item, without its notes.
  ItemRecord read(std::size_t item) const;
  /// Calls visit(text) for the notes of a finished item in a list.
  void forNotes(std::size_t item, const std::string& list, const std::function<void(const std::string&)>& visit) const;
  /// Removes the file.
  void remove();

private:
  /// Bytes of a record.
  struct Place
  {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
  };
  [[noreturn]] void fail() const;
  [[noreturn]] void failDamaged() const;
  std::string bytesAt(std::uint64_t offset, std::uint64_t bytes) const;
  Place placeOf(std::size_t item) const;
  void begin(const std::string& requestHash);
  void addBytes(std::size_t item, const std::string& bytes);
  void takeOver();
  Folder Holder;
  FileDescriptor File;
  std::uint64_t End = 0;
  std::vector<std::uint64_t> Places; ///< of an item's record, its head first; 0 for none, where the request's hash is
  std::mutex Mutex;
};

} // namespace dgtk

#endif
