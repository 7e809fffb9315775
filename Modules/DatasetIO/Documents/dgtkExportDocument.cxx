// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportDocument.h"

#include "dgtkDocumentValues.h"
#include "dgtkError.h"
#include "dgtkHash.h"
#include "dgtkJsonPieces.h"
#include "dgtkJsonText.h"
#include "dgtkLongDocuments.h"

#include <algorithm>
#include <fstream>

namespace dgtk
{

namespace
{
constexpr const char* formatWord = "DGTk export";

std::string layersText(const std::vector<LayerRounding>& layers)
{
  JsonArray array(4);
  for (const LayerRounding& one : layers)
  {
    array.add(JsonObject(6)
                .text("layer", one.layer)
                .text("unit", one.unit)
                .number("largest_rounding", one.largest)
                .integer("values", static_cast<std::int64_t>(one.values))
                .integer("without_code", static_cast<std::int64_t>(one.withoutCode))
                .line());
  }
  return array.block();
}

PixelEncoding encodingOf(const JsonCursor& object)
{
  PixelEncoding encoding;
  for (std::size_t i = 0, n = object.memberCount(); i < n; ++i)
  {
    const JsonCursor value = object.member(i);
    if (object.key(i) == "kind")
    {
      encoding.kind = value.text();
      continue;
    }
    std::vector<double>& numbers = encoding.numbers[object.key(i)];
    if (value.node().type != JsonNode::Type::Array)
    {
      numbers.push_back(value.number());
      continue;
    }
    for (const JsonCursor& item : value.items())
    {
      numbers.push_back(item.number());
    }
  }
  return encoding;
}

LayerRounding roundingOf(const JsonCursor& item)
{
  return { item["layer"].text(), item["unit"].text(), item["largest_rounding"].number(), countOf(item["values"]),
    countOf(item["without_code"]) };
}
} // namespace

std::string encodingText(const PixelEncoding& encoding)
{
  JsonObject object(6);
  object.text("kind", encoding.kind);
  for (const auto& [key, numbers] : encoding.numbers)
  {
    object.raw(key, numbersText(numbers));
  }
  return object.line();
}

std::string exportHead(const ExportRecord& record)
{
  JsonObject object(2);
  object.text("format", formatWord)
    .integer("format_version", 1)
    .text("version", record.version)
    .text("exporter", record.exporter)
    .text("request_hash", record.requestHash)
    .text("dataset_manifest", record.manifestHash)
    .raw("request", pairsText(record.request))
    .raw("conventions", pairsText(record.conventions))
    .raw("layers", layersText(record.layers));
  std::string text = object.block();
  text.resize(text.size() - 2); // the brace
  text += ",\n  \"names\": [";
  for (const ExportedName& one : record.names)
  {
    text += exportNameLine(one, &one == record.names.data());
  }
  return text;
}

std::string exportNameLine(const ExportedName& name, bool isFirst)
{
  JsonObject object(6);
  object.text("camera", name.camera).integer("frame", name.frame).text("name", name.name);
  return (isFirst ? "\n    " : ",\n    ") + object.line();
}

std::string exportMiddle(bool noNames) { return noNames ? "],\n  \"files\": [" : "\n  ],\n  \"files\": ["; }

std::string exportFileLine(const ExportedFile& file, bool isFirst)
{
  JsonObject object = fileObject(file.file);
  if (!file.encoding.kind.empty())
  {
    object.raw("encoding", encodingText(file.encoding));
  }
  return (isFirst ? "\n    " : ",\n    ") + object.line();
}

namespace
{
constexpr const char* tail = "\n  ],\n  \"sha256\": ";
}

std::string exportTail(const std::string& sha256) { return tail + ('"' + sha256) + "\"\n}\n"; }

std::pair<std::string, std::string> exportOwnHashes(const std::string& path)
{
  const std::uint64_t tailBytes = exportTail(std::string(64, '0')).size();
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(file.tellg(), 0));
  std::uint64_t left = size - std::min(size, tailBytes);
  file.seekg(0);
  Sha256 hash;
  std::string block(std::size_t(1) << 16, '\0');
  while (left > 0 && file.read(block.data(), std::streamsize(std::min<std::uint64_t>(left, block.size()))))
  {
    hash.update(block.data(), std::size_t(file.gcount()));
    left -= std::uint64_t(file.gcount());
  }
  std::string end(std::min(size, tailBytes), '\0');
  if (!file.read(end.data(), std::streamsize(end.size())))
  {
    throw InputError(path, "cannot be read");
  }
  const std::string right = hash.hex();
  return { end == exportTail(right) ? right : end.rfind(tail, 0) == 0 ? "another one" : "none", right };
}

ExportRecord readExport(const std::string& path, const std::function<void(ExportedName&&)>& visitName,
  const std::function<void(ExportedFile&&)>& visitFile)
{
  const auto readName = [&](const JsonPiece& piece)
  {
    const JsonCursor& item = piece.value;
    visitName({ item["camera"].text(), integerOf(item["frame"], anyFrame), item["name"].text() });
  };
  const auto readFile = [&](const JsonPiece& piece)
  {
    const JsonCursor& item = piece.value;
    visitFile({ fileOf(item), item.has("encoding") ? encodingOf(item["encoding"]) : PixelEncoding() });
  };
  const JsonDocument document = readJsonPieces(path, { { "names", readName }, { "files", readFile } });
  const JsonCursor root(document);
  if (!root.has("format") || root["format"].node().text != formatWord)
  {
    root.fail("is not the document of a DGTk export");
  }
  root["format_version"].number({ 1, 1, false, false, "1" });
  ExportRecord record;
  record.version = root["version"].text();
  record.exporter = root["exporter"].text();
  record.requestHash = root["request_hash"].text();
  record.manifestHash = hashOf(root["dataset_manifest"]);
  record.request = pairsIn(root["request"]);
  record.conventions = pairsIn(root["conventions"]);
  for (const JsonCursor& item : root["layers"].items())
  {
    record.layers.push_back(roundingOf(item));
  }
  root["names"].listSize();
  root["files"].listSize();
  return record;
}

namespace
{
/// By one of the readers that hand on names and files.
template <typename Read>
ExportRecord wholeBy(const Read& read, const std::string& path)
{
  std::vector<ExportedName> names;
  std::vector<ExportedFile> files;
  ExportRecord record = read(
    path, [&](ExportedName&& name) { names.push_back(std::move(name)); },
    [&](ExportedFile&& file) { files.push_back(std::move(file)); });
  record.names = std::move(names);
  record.files = std::move(files);
  return record;
}
} // namespace

ExportRecord readExport(const std::string& path)
{
  return wholeBy([](const std::string& file, const auto&... visits) { return readExport(file, visits...); }, path);
}

ExportRecord readExportIn(const std::string& path, const std::function<void(ExportedName&&)>& visitName,
  const std::function<void(ExportedFile&&)>& visitFile)
{
  const Folder folder(path);
  LinkCheck links(folder);
  ExportRecord record = readExport(folder.fileAt(exportName), visitName,
    [&](ExportedFile&& file)
    {
      links.add(file.file.path);
      visitFile(std::move(file));
    });
  links.finish();
  return record;
}

ExportRecord readExportIn(const std::string& path)
{
  return wholeBy(
    [](const std::string& folder, const auto&... visits) { return readExportIn(folder, visits...); }, path);
}

} // namespace dgtk
