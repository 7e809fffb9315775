// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportDocument.h"

#include "dgtkDocumentValues.h"
#include "dgtkHash.h"
#include "dgtkJsonText.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr const char* formatWord = "DGTk export";

std::string pairsText(const TextPairs& pairs)
{
  JsonObject object(4);
  for (const auto& [key, value] : pairs)
  {
    object.text(key, value);
  }
  return pairs.empty() ? "{}" : object.block();
}

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

std::string listText(const std::vector<double>& numbers)
{
  std::string text;
  for (const double number : numbers)
  {
    text += (text.empty() ? "" : ", ") + jsonNumber(number);
  }
  return numbers.size() == 1 ? text : "[" + text + "]";
}

TextPairs pairsOf(const JsonCursor& object)
{
  TextPairs pairs;
  for (std::size_t i = 0, n = object.memberCount(); i < n; ++i)
  {
    pairs.emplace_back(object.key(i), object.member(i).text());
  }
  return pairs;
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
    object.raw(key, listText(numbers));
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
  const std::string text = readFile(path);
  const std::size_t end = std::min(text.rfind(tail), text.size());
  const std::string hash = Sha256::of(text.substr(0, end));
  return { text.substr(end) == exportTail(hash) ? hash : end < text.size() ? "another one" : "none", hash };
}

ExportRecord readExport(const std::string& path)
{
  const JsonDocument document = readJson(path);
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
  record.request = pairsOf(root["request"]);
  record.conventions = pairsOf(root["conventions"]);
  for (const JsonCursor& item : root["layers"].items())
  {
    record.layers.push_back(roundingOf(item));
  }
  for (const JsonCursor& item : root["names"].items())
  {
    record.names.push_back({ item["camera"].text(), integerOf(item["frame"], anyFrame), item["name"].text() });
  }
  for (const JsonCursor& item : root["files"].items())
  {
    record.files.push_back({ fileOf(item), item.has("encoding") ? encodingOf(item["encoding"]) : PixelEncoding() });
  }
  return record;
}

ExportRecord readExportIn(const std::string& path)
{
  const Folder folder(path);
  ExportRecord record = readExport(folder.fileAt(exportName));
  std::set<std::string> names;
  for (const ExportedFile& file : record.files)
  {
    names.insert(file.file.path);
  }
  refuseLinks(folder, names);
  return record;
}

} // namespace dgtk
