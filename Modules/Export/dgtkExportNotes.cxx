// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportNotes.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJournal.h"
#include "dgtkJson.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dgtk
{

namespace
{
using NoteJson = nlohmann::json;

NoteJson jsonOf(const ItemRecord& record)
{
  NoteJson json{ { "files", NoteJson::array() }, { "rounding", NoteJson::array() } };
  for (const ExportedFile& one : record.files)
  {
    const DatasetFile& file = one.file;
    json["files"].push_back({ file.path, file.bytes, file.sha256, file.layer, file.camera, file.frame,
      one.encoding.kind, one.encoding.numbers });
  }
  json["names"] = NoteJson::array();
  for (const ExportedName& one : record.names)
  {
    json["names"].push_back({ one.camera, one.frame, one.name });
  }
  for (const LayerRounding& one : record.rounding)
  {
    json["rounding"].push_back({ one.layer, one.unit, one.largest, one.values, one.withoutCode });
  }
  return json;
}

ItemRecord recordOf(const NoteJson& json)
{
  ItemRecord record;
  for (const NoteJson& one : json.at("files"))
  {
    record.files.push_back({ { one.at(0), one.at(1), one.at(2), one.at(3), one.at(4), one.at(5) },
      { one.at(6), one.at(7).get<std::map<std::string, std::vector<double>>>() } });
  }
  for (const NoteJson& one : json.at("rounding"))
  {
    record.rounding.push_back({ one.at(0), one.at(1), one.at(2), one.at(3), one.at(4) });
  }
  for (const NoteJson& one : json.at("names"))
  {
    record.names.push_back({ one.at(0), one.at(1), one.at(2) });
  }
  return record;
}

void putSize(std::string& to, std::uint64_t size) { to.append(reinterpret_cast<const char*>(&size), sizeof size); }

/// Takes what putSize() put, and what follows it.
std::uint64_t takeSize(const std::string& from, std::size_t& at)
{
  std::uint64_t size = from.size();
  if (from.size() - at >= sizeof size)
  {
    std::memcpy(&size, from.data() + at, sizeof size);
  }
  at += sizeof size;
  return size;
}

/// The size of all but the notes, these as CBOR (texts may be any bytes), then the notes: sizes of list and text, list,
/// text.
std::string packed(const ItemRecord& record)
{
  const std::vector<std::uint8_t> bytes = NoteJson::to_cbor(jsonOf(record));
  std::string text;
  putSize(text, bytes.size());
  text.append(bytes.begin(), bytes.end());
  for (const auto& [list, note] : record.notes)
  {
    putSize(text, list.size());
    putSize(text, note.size());
    text += list + note;
  }
  return text;
}
} // namespace

ExportNotes::ExportNotes(const std::string& folder, const std::string& requestHash, std::size_t items, bool resume)
  : Holder(folder)
  , Places(items)
{
  if (!resume)
  {
    this->Holder.remove(notesName);
  }
  this->File = this->Holder.open(notesName, O_RDWR | O_CREAT);
  if (!this->File)
  {
    this->fail();
  }
  this->begin(requestHash);
  this->takeOver();
}

/// The request's hash stands first.
void ExportNotes::begin(const std::string& requestHash)
{
  std::string there(requestHash.size(), '\0');
  const bool same =
    ::pread(this->File.number(), there.data(), there.size(), 0) == ssize_t(there.size()) && there == requestHash;
  if (!same && (::ftruncate(this->File.number(), 0) != 0 ||
                 !writeAll(this->File.number(), requestHash.data(), requestHash.size())))
  {
    this->fail();
  }
  this->End = requestHash.size();
}

void ExportNotes::fail() const
{
  throw MachineError(this->Holder.pathOf(notesName) + ": cannot be written: " + std::strerror(errno));
}

/// A record is the item's number, its size and that of its bytes, little-endian, then the bytes.
void ExportNotes::takeOver()
{
  struct stat info = {};
  if (::fstat(this->File.number(), &info) != 0)
  {
    this->fail();
  }
  const auto size = static_cast<std::uint64_t>(info.st_size);
  std::uint64_t head[2];
  while (this->End + sizeof head <= size &&
         ::pread(this->File.number(), head, sizeof head, static_cast<off_t>(this->End)) == ssize_t(sizeof head))
  {
    const Place place{ this->End + sizeof head, head[1] };
    if (head[0] >= this->Places.size() || place.bytes > size - place.offset)
    {
      break;
    }
    this->Places[head[0]] = this->End;
    this->End = place.offset + place.bytes;
  }
  if (::ftruncate(this->File.number(), static_cast<off_t>(this->End)) != 0 ||
      ::lseek(this->File.number(), static_cast<off_t>(this->End), SEEK_SET) < 0)
  {
    this->fail();
  }
}

void ExportNotes::add(std::size_t item, const ItemRecord& record) { this->addBytes(item, packed(record)); }

void ExportNotes::add(std::size_t item, const ExportNotes& part)
{
  const Place place = part.placeOf(item);
  this->addBytes(item, part.bytesAt(place.offset, place.bytes));
}

void ExportNotes::addBytes(std::size_t item, const std::string& bytes)
{
  const std::uint64_t head[2] = { item, bytes.size() };
  std::string text(reinterpret_cast<const char*>(head), sizeof head);
  text += bytes;
  const std::lock_guard<std::mutex> guard(this->Mutex);
  if (!writeAll(this->File.number(), text.data(), text.size()))
  {
    this->fail();
  }
  this->Places[item] = this->End;
  this->End += text.size();
}

std::string ExportNotes::bytesAt(std::uint64_t offset, std::uint64_t bytes) const
{
  std::string text(bytes, '\0');
  std::size_t done = 0;
  while (done < text.size())
  {
    const ssize_t got =
      ::pread(this->File.number(), text.data() + done, text.size() - done, static_cast<off_t>(offset + done));
    if (got <= 0)
    {
      throw MachineError(this->Holder.pathOf(notesName) + ": cannot be read back");
    }
    done += static_cast<std::size_t>(got);
  }
  return text;
}

ExportNotes::Place ExportNotes::placeOf(std::size_t item) const
{
  std::uint64_t head[2];
  const std::string bytes = this->bytesAt(this->Places[item], sizeof head);
  std::memcpy(head, bytes.data(), sizeof head);
  return { this->Places[item] + sizeof head, head[1] };
}

void ExportNotes::failDamaged() const { throw InputError(this->Holder.pathOf(notesName), "is damaged; start over"); }

ItemRecord ExportNotes::read(std::size_t item) const
{
  const Place place = this->placeOf(item);
  std::size_t at = 0;
  const std::uint64_t size = takeSize(this->bytesAt(place.offset, std::min<std::uint64_t>(8, place.bytes)), at);
  if (size > place.bytes - std::min<std::uint64_t>(at, place.bytes))
  {
    this->failDamaged();
  }
  const std::string bytes = this->bytesAt(place.offset + at, size);
  try
  {
    return recordOf(NoteJson::from_cbor(bytes.begin(), bytes.end()));
  }
  catch (const NoteJson::exception&)
  {
    this->failDamaged();
  }
}

void ExportNotes::forNotes(
  std::size_t item, const std::string& list, const std::function<void(const std::string&)>& visit) const
{
  const Place place = this->placeOf(item);
  const std::string bytes = this->bytesAt(place.offset, place.bytes);
  std::size_t at = 0;
  const std::uint64_t rest = takeSize(bytes, at);
  at += rest;
  while (at < bytes.size())
  {
    const std::uint64_t name = takeSize(bytes, at);
    const std::uint64_t text = takeSize(bytes, at);
    if (at > bytes.size() || name > bytes.size() - at || text > bytes.size() - at - name)
    {
      this->failDamaged();
    }
    if (bytes.compare(at, name, list) == 0)
    {
      visit(bytes.substr(at + name, text));
    }
    at += name + text;
  }
}

void ExportNotes::remove() { this->Holder.remove(notesName); }

} // namespace dgtk
