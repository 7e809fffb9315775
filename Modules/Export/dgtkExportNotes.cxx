// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportNotes.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJournal.h"
#include "dgtkJson.h"

#include <nlohmann/json.hpp>

#include <cerrno>
#include <charconv>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dgtk
{

namespace
{
using Json = nlohmann::json;

/// Begins like the journal: a folder that holds nothing else holds nothing.
const std::string& notesName()
{
  static const std::string name = std::string(journalName) + "-notes";
  return name;
}

Json jsonOf(const ItemRecord& record)
{
  Json json{ { "files", Json::array() }, { "rounding", Json::array() }, { "notes", record.notes } };
  for (const ExportedFile& one : record.files)
  {
    const DatasetFile& file = one.file;
    json["files"].push_back({ file.path, file.bytes, file.sha256, file.layer, file.camera, file.frame,
      one.encoding.kind, one.encoding.numbers });
  }
  json["names"] = Json::array();
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

ItemRecord recordOf(const Json& json)
{
  ItemRecord record;
  for (const Json& one : json.at("files"))
  {
    record.files.push_back({ { one.at(0), one.at(1), one.at(2), one.at(3), one.at(4), one.at(5) },
      { one.at(6), one.at(7).get<std::map<std::string, std::vector<double>>>() } });
  }
  for (const Json& one : json.at("rounding"))
  {
    record.rounding.push_back({ one.at(0), one.at(1), one.at(2), one.at(3), one.at(4) });
  }
  for (const Json& one : json.at("names"))
  {
    record.names.push_back({ one.at(0), one.at(1), one.at(2) });
  }
  record.notes = json.at("notes").get<std::vector<std::pair<std::string, std::string>>>();
  return record;
}

// Texts may be any bytes, which CBOR keeps.
std::string packed(const ItemRecord& record)
{
  const std::vector<std::uint8_t> bytes = Json::to_cbor(jsonOf(record));
  return { bytes.begin(), bytes.end() };
}
} // namespace

ExportNotes::ExportNotes(const std::string& folder, const std::string& requestHash, std::size_t items, bool resume)
  : Holder(folder)
  , Places(items)
{
  if (!resume)
  {
    this->Holder.remove(notesName());
  }
  this->File = this->Holder.open(notesName(), O_RDWR | O_CREAT);
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
  throw MachineError(this->Holder.pathOf(notesName()) + ": cannot be written: " + std::strerror(errno));
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
    this->Places[head[0]] = place;
    this->End = place.offset + place.bytes;
  }
  if (::ftruncate(this->File.number(), static_cast<off_t>(this->End)) != 0 ||
      ::lseek(this->File.number(), static_cast<off_t>(this->End), SEEK_SET) < 0)
  {
    this->fail();
  }
}

void ExportNotes::add(std::size_t item, const ItemRecord& record)
{
  const std::string bytes = packed(record);
  const std::uint64_t head[2] = { item, bytes.size() };
  std::string text(reinterpret_cast<const char*>(head), sizeof head);
  text += bytes;
  const std::lock_guard<std::mutex> guard(this->Mutex);
  if (!writeAll(this->File.number(), text.data(), text.size()))
  {
    this->fail();
  }
  this->Places[item] = Place{ this->End + sizeof head, bytes.size() };
  this->End += text.size();
}

ItemRecord ExportNotes::read(std::size_t item) const
{
  const Place& place = *this->Places[item];
  std::vector<std::uint8_t> bytes(place.bytes);
  std::size_t done = 0;
  while (done < bytes.size())
  {
    const ssize_t got =
      ::pread(this->File.number(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(place.offset + done));
    if (got <= 0)
    {
      throw MachineError(this->Holder.pathOf(notesName()) + ": cannot be read back");
    }
    done += static_cast<std::size_t>(got);
  }
  try
  {
    return recordOf(Json::from_cbor(bytes));
  }
  catch (const Json::exception&)
  {
    throw MachineError(this->Holder.pathOf(notesName()) + ": is damaged; start over");
  }
}

void ExportNotes::remove() { this->Holder.remove(notesName()); }

} // namespace dgtk
