// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFolderRecords.h"

#include "dgtkError.h"
#include "dgtkExportDocument.h"
#include "dgtkFile.h"
#include "dgtkRunParts.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <iterator>

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

/// One line but the first; false for a torn one.
bool readLine(const std::string& line, FolderRecords& records)
{
  const std::vector<std::string> fields = fieldsOf(line);
  DatasetFile file;
  if (fields.size() == 2 && fields[0] == planned)
  {
    file.path = unescaped(fields[1]);
  }
  else if (!parseFile(fields, file))
  {
    return false;
  }
  if (!Folder::isPlain(file.path))
  {
    records.foreign = std::string(journalName) + ": " + quoted(file.path) + " leads out of the dataset";
    return false;
  }
  records.names.insert(file.path);
  if (!file.sha256.empty())
  {
    records.finished.push_back(file);
  }
  return true;
}

void readJournal(const std::string& text, FolderRecords& records)
{
  if (text.empty())
  {
    return; // of a run that was killed at its very beginning
  }
  std::size_t start = text.find('\n');
  if (text.rfind(firstLine, 0) != 0 || start == std::string::npos)
  {
    records.foreign = std::string(journalName) + ": is not a journal of DGTk";
    return;
  }
  records.journal = true;
  records.requestHash = text.substr(std::strlen(firstLine), start - std::strlen(firstLine));
  for (std::size_t end; (end = text.find('\n', ++start)) != std::string::npos; start = end)
  {
    if (!readLine(text.substr(start, end - start), records))
    {
      break;
    }
  }
}

void addWhole(const std::vector<DatasetFile>& files, const std::string& requestHash, FolderRecords& records)
{
  for (const DatasetFile& file : files)
  {
    records.names.insert(file.path);
  }
  if (!records.journal || records.requestHash == requestHash)
  {
    records.whole = true;
    records.requestHash = requestHash;
    records.finished = files;
  }
}

void addDocument(const std::string& path, const std::string& document, FolderRecords& records)
{
  if (document == manifestName)
  {
    const Manifest manifest = readManifest(path);
    addWhole(manifest.files, manifest.requestHash, records);
    return;
  }
  const ExportRecord whole = readExport(path);
  std::vector<DatasetFile> files;
  std::transform(whole.files.begin(), whole.files.end(), std::back_inserter(files),
    [](const ExportedFile& exported) { return exported.file; });
  addWhole(files, whole.requestHash, records);
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

FolderRecords readFolderRecords(const Folder& folder, const std::string& document)
{
  FolderRecords records;
  try
  {
    if (holds(folder, journalName, records))
    {
      readJournal(readFile(folder.pathOf(journalName)), records);
    }
    if (holds(folder, document, records))
    {
      addDocument(folder.pathOf(document), document, records);
    }
    if (document == manifestName && holdsParts(folder.path()))
    {
      records.foreign = std::string(partsName) + ": parts of a run wait to be merged";
    }
  }
  catch (const InputError& error)
  {
    records.foreign = error.what();
  }
  return records;
}

std::string journalFirstLine(const std::string& requestHash) { return firstLine + requestHash + '\n'; }

std::string journalLine(const DatasetFile& file)
{
  return file.sha256 + '\t' + std::to_string(file.bytes) + '\t' + std::to_string(file.frame) + '\t' +
         escaped(file.layer) + '\t' + escaped(file.camera) + '\t' + escaped(file.path) + '\n';
}

std::string journalPlan(const std::string& name) { return std::string(planned) + '\t' + escaped(name) + '\n'; }

} // namespace dgtk
