// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFolderRecords.h"

#include "dgtkDocumentValues.h"
#include "dgtkError.h"
#include "dgtkExportDocument.h"
#include "dgtkLongDocuments.h"
#include "dgtkRunParts.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <vector>

namespace dgtk
{

namespace
{
constexpr const char* firstLine = "DGTk journal 1 ";
constexpr const char* planned = "planned";

std::string escaped(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    out += c == '\t' ? "\\t" : c == '\n' ? "\\n" : c == '\\' ? "\\\\" : std::string(1, c);
  }
  return out;
}

std::string unescaped(const std::string& text)
{
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const bool code = text[i] == '\\' && i + 1 < text.size();
    const char c = code ? text[++i] : text[i];
    out += !code ? c : c == 't' ? '\t' : c == 'n' ? '\n' : c;
  }
  return out;
}

std::vector<std::string> fieldsOf(const std::string& line)
{
  std::vector<std::string> fields(1);
  for (const char c : line)
  {
    if (c == '\t')
    {
      fields.emplace_back();
    }
    else
    {
      fields.back() += c;
    }
  }
  return fields;
}

bool parseFile(const std::vector<std::string>& fields, DatasetFile& file)
{
  if (fields.size() != 6 || fields[0].size() != 64)
  {
    return false;
  }
  const auto number = [](const std::string& text, auto& value)
  {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
  };
  file.sha256 = fields[0];
  file.layer = unescaped(fields[3]);
  file.camera = unescaped(fields[4]);
  file.path = unescaped(fields[5]);
  return number(fields[1], file.bytes) && number(fields[2], file.frame);
}

/// The text up to the next line feed; false where there is none.
bool nextLine(std::istream& text, std::string& line) { return bool(std::getline(text, line)) && !text.eof(); }

void list(DatasetFile&& file, ListedIn where, FolderRecords& records, const ForListed& visit)
{
  records.names = true;
  if (visit)
  {
    visit(std::move(file), where);
  }
}

void readJournal(const std::string& path, FolderRecords& records, const ForListed& visit)
{
  std::ifstream text(path, std::ios::binary);
  if (!text)
  {
    throw InputError(path, std::string("cannot be read: ") + std::strerror(errno));
  }
  if (text.peek() == std::ifstream::traits_type::eof())
  {
    return; // of a run that was killed at its very beginning
  }
  std::string line;
  if (!nextLine(text, line) || line.rfind(firstLine, 0) != 0)
  {
    records.foreign = std::string(journalName) + ": is not a journal of DGTk";
    return;
  }
  records.journal = true;
  records.requestHash = line.substr(std::strlen(firstLine));
  while (nextLine(text, line))
  {
    std::optional<DatasetFile> file = readJournalLine(line);
    if (!file)
    {
      break;
    }
    const std::string fault = faultOfName(file->path);
    if (!fault.empty())
    {
      throw InputError(path, quoted(file->path) + ' ' + fault);
    }
    list(std::move(*file), ListedIn::Journal, records, visit);
  }
}

void readDocument(const std::string& path, const std::string& document, FolderRecords& records, const ForListed& visit)
{
  const auto visitFile = [&](DatasetFile&& file) { list(std::move(file), ListedIn::Document, records, visit); };
  const std::string requestHash =
    document == manifestName
      ? readManifest(path, visitFile).requestHash
      : readExport(
          path, [](ExportedName&&) {}, [&](ExportedFile&& file) { visitFile(std::move(file.file)); })
          .requestHash;
  if (!records.journal || records.requestHash == requestHash)
  {
    records.whole = true;
    records.requestHash = requestHash;
  }
}

/// Whether a document is there; what is no file cannot be ours.
bool holds(const Folder& folder, const std::string& name, FolderRecords& records)
{
  const EntryKind kind = folder.look(name);
  if (kind != EntryKind::File && kind != EntryKind::Nothing)
  {
    records.foreign = name + ": is not a file";
  }
  return kind == EntryKind::File;
}
} // namespace

std::optional<DatasetFile> readJournalLine(const std::string& line)
{
  const std::vector<std::string> fields = fieldsOf(line);
  DatasetFile file;
  if (fields.size() == 2 && fields[0] == planned)
  {
    file.path = unescaped(fields[1]);
    return file;
  }
  return parseFile(fields, file) ? std::optional<DatasetFile>(std::move(file)) : std::nullopt;
}

FolderRecords readFolderRecords(const Folder& folder, const std::string& document, const ForListed& visit)
{
  FolderRecords records;
  try
  {
    if (holds(folder, journalName, records))
    {
      readJournal(folder.pathOf(journalName), records, visit);
    }
    if (holds(folder, document, records))
    {
      readDocument(folder.pathOf(document), document, records, visit);
    }
    if (holdsParts(folder.path()))
    {
      records.foreign = std::string(partsName) + ": parts of a run wait to be merged";
    }
  }
  catch (const InputError& error)
  {
    records.foreign = error.what();
    records.damage = error;
  }
  return records;
}

void judgeFiles(const Folder& folder, const std::string& document, const JudgeOfFiles& judge)
{
  if (!judge)
  {
    return;
  }
  std::optional<InputError> first; // what is thrown in between counts as damage of the document
  readFolderRecords(folder, document,
    [&](DatasetFile&& file, ListedIn where)
    {
      const std::string fault = first || file.sha256.empty() ? "" : judge(file);
      if (!fault.empty())
      {
        first.emplace(folder.pathOf(where == ListedIn::Journal ? journalName : document), fault);
      }
    });
  if (first)
  {
    throw *first;
  }
}

std::string journalFirstLine(const std::string& requestHash) { return firstLine + requestHash + '\n'; }

std::string journalLine(const DatasetFile& file)
{
  return file.sha256 + '\t' + std::to_string(file.bytes) + '\t' + std::to_string(file.frame) + '\t' +
         escaped(file.layer) + '\t' + escaped(file.camera) + '\t' + escaped(file.path) + '\n';
}

std::string journalPlan(const std::string& name) { return std::string(planned) + '\t' + escaped(name) + '\n'; }

} // namespace dgtk
