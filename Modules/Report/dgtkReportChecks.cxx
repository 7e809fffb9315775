// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReportChecks.h"

#include "dgtkError.h"
#include "dgtkExportDocument.h"
#include "dgtkFile.h"
#include "dgtkFolder.h"
#include "dgtkHash.h"
#include "dgtkJournal.h"
#include "dgtkJson.h"
#include "dgtkSceneFolders.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace dgtk
{

namespace
{
constexpr const char* verificationName = "verification.json";
constexpr const char* samplesName = "samples.json";
constexpr std::uint64_t largestDocument = std::uint64_t(1) << 28;
constexpr std::size_t mostReasons = 100;

/// `given`, or the dataset's document of that name; "" where neither is.
std::string documentAt(const std::string& given, const std::string& dataset, const char* name)
{
  if (!given.empty())
  {
    return given;
  }
  const Folder folder(dataset);
  return folder.look(name) == EntryKind::File ? folder.fileAt(name) : "";
}

/// Whether a document is of the dataset as it is, by the hash of the manifest that it says; null where it says none.
ReportJson isOf(const std::string& dataset, const std::string& hash)
{
  const Folder folder(dataset);
  return hash.empty() ? ReportJson(nullptr)
                      : ReportJson(folder.look(manifestName) == EntryKind::File &&
                                   Sha256::ofFile(folder.fileAt(manifestName)) == hash);
}

ReportJson valueOf(const JsonNode& node)
{
  switch (node.type)
  {
    case JsonNode::Type::Boolean:
      return node.boolean;
    case JsonNode::Type::Number:
      return node.number;
    case JsonNode::Type::String:
      return utf8FromBytes(node.text);
    default:
      return nullptr;
  }
}

/// The members of a row that are no lists and no objects.
ReportJson rowOf(const JsonNode& node)
{
  ReportJson row = ReportJson::object();
  for (std::size_t i = 0; i + 1 < node.children.size() && node.type == JsonNode::Type::Object; i += 2)
  {
    row[utf8FromBytes(node.children[i].text)] = valueOf(node.children[i + 1]);
  }
  return row;
}

ReportJson rowsOf(const JsonCursor& list)
{
  ReportJson rows = ReportJson::array();
  for (const JsonCursor& item : list.items())
  {
    rows.push_back(rowOf(item.node()));
  }
  return rows;
}

/// Why something was left out, and in which samples.
struct Reason
{
  std::uint64_t times = 0;
  std::string example; ///< of a sample
};
using Reasons = std::map<std::pair<std::string, std::string>, Reason>; ///< by path and reason

/// Everything that says a reason, wherever it stands in a sample's record; how many there are.
std::uint64_t addReasons(const JsonNode& node, const std::string& sample, Reasons& reasons)
{
  std::uint64_t found = 0;
  const bool object = node.type == JsonNode::Type::Object;
  const JsonNode* const why = object ? node.find("why") : nullptr;
  if (why != nullptr && !why->text.empty())
  {
    const JsonNode* const path = node.find("path");
    Reason& reason = reasons[{ path != nullptr ? path->text : "", why->text }];
    ++reason.times;
    ++found;
    reason.example = reason.example.empty() ? sample : reason.example;
  }
  for (std::size_t i = object ? 1 : 0; i < node.children.size(); i += object ? 2 : 1)
  {
    found += addReasons(node.children[i], sample, reasons);
  }
  return found;
}

std::string sampleName(const JsonNode& sample, std::size_t index)
{
  for (const char* key : { "sample", "number", "scene", "file" })
  {
    const JsonNode* const found = sample.type == JsonNode::Type::Object ? sample.find(key) : nullptr;
    if (found != nullptr && (found->type == JsonNode::Type::Number || found->type == JsonNode::Type::String))
    {
      return found->type == JsonNode::Type::String ? found->text : std::to_string(static_cast<long>(found->number));
    }
  }
  return std::to_string(index);
}

ReportJson verificationIn(const JsonCursor& root, const std::string& dataset)
{
  if (!root.has("format") || root["format"].node().text != "DGTk verification")
  {
    root.fail("is not what a verification of a dataset says");
  }
  const std::string hash = root.has("dataset_manifest") ? root["dataset_manifest"].text() : "";
  return { { "passed", root["passed"].boolean() }, { "same", isOf(dataset, hash) },
    { "residuals", rowsOf(root["residuals"]) },
    { "unchecked", root.has("not_checked") ? rowsOf(root["not_checked"]) : ReportJson::array() } };
}

/// Adds a row of a dataset to the row of the same check, or files, of those before: numbers are added, of residuals the
/// largest is kept, and the dataset that breaks it first.
void addRow(ReportJson& rows, const ReportJson& row, const char* key, const char* second, const std::string& name)
{
  const auto is = [&](const ReportJson& other)
  { return other.value(key, "") == row.value(key, "") && other.value(second, "") == row.value(second, ""); };
  auto known = std::find_if(rows.begin(), rows.end(), is);
  const bool isNew = known == rows.end();
  if (isNew)
  {
    rows.push_back(row);
    known = std::prev(rows.end());
  }
  for (const char* sum : { "count", "skipped", "bad", "files" })
  {
    if (!isNew && row.contains(sum))
    {
      (*known)[sum] = known->value(sum, 0.0) + row.value(sum, 0.0);
    }
  }
  if (row.value("breach", false) && !known->contains("dataset"))
  {
    known->update({ { "breach", true }, { "dataset", utf8FromBytes(name) }, { "tolerance", row["tolerance"] } });
  }
  if (row.contains("largest") && !(*known)["largest"].is_null()) // null: a residual that is no number
  {
    const bool larger = row["largest"].is_null() || row["largest"] > (*known)["largest"];
    (*known)["largest"] = larger ? row["largest"] : (*known)["largest"];
  }
}

/// What verifications of all datasets of a folder say together.
ReportJson verificationsIn(const JsonCursor& root, const std::string& folder)
{
  ReportJson all{ { "passed", true }, { "same", true }, { "residuals", ReportJson::array() },
    { "unchecked", ReportJson::array() } };
  std::vector<std::string> names = sceneFoldersIn(folder);
  for (std::size_t i = 0; i < root.memberCount(); ++i)
  {
    const auto known = std::find(names.begin(), names.end(), root.key(i));
    const bool here = known != names.end();
    const ReportJson one = verificationIn(root.member(i), here ? folder + '/' + root.key(i) : folder);
    all["passed"] = all["passed"] && one["passed"];
    all["same"] = !here ? ReportJson(false) : one["same"] == true ? all["same"] : one["same"];
    for (const ReportJson& row : one["residuals"])
    {
      addRow(all["residuals"], row, "check", "layer", root.key(i));
    }
    for (const ReportJson& row : one["unchecked"])
    {
      addRow(all["unchecked"], row, "layer", "format", root.key(i));
    }
    names.erase(here ? known : names.end(), here ? known + 1 : names.end());
  }
  all["same"] = names.empty() ? all["same"] : ReportJson(false); // a dataset of which nothing is said
  return all;
}
} // namespace

ReportJson verificationOf(const ReportRequest& request)
{
  const std::string path = documentAt(request.verification, request.dataset, verificationName);
  if (path.empty())
  {
    return nullptr;
  }
  const JsonDocument document = parseJson(path, readFile(path, largestDocument));
  const JsonCursor root(document);
  const bool many = !root.has("format") && !sceneFoldersIn(request.dataset).empty();
  return many ? verificationsIn(root, request.dataset) : verificationIn(root, request.dataset);
}

ReportJson exportsOf(const ReportRequest& request)
{
  ReportJson exports = ReportJson::array();
  for (const std::string& folder : request.exports)
  {
    const ExportRecord record = readExport(Folder(folder).fileAt(exportName));
    ReportJson layers = ReportJson::array();
    for (const LayerRounding& layer : record.layers)
    {
      layers.push_back({ { "layer", utf8FromBytes(layer.layer) }, { "unit", utf8FromBytes(layer.unit) },
        { "largest", layer.largest }, { "values", layer.values }, { "withoutCode", layer.withoutCode } });
    }
    exports.push_back({ { "format", utf8FromBytes(record.exporter) },
      { "same", isOf(request.dataset, record.manifestHash) }, { "files", record.files.size() }, { "layers", layers } });
  }
  return exports;
}

ReportJson samplesOf(const ReportRequest& request)
{
  const std::string path = documentAt(request.samples, request.dataset, samplesName);
  if (path.empty())
  {
    return nullptr;
  }
  const JsonDocument document = parseJson(path, readFile(path, largestDocument));
  const JsonNode* const listed = document.root.find("samples");
  const JsonNode& list = listed != nullptr ? *listed : document.root;
  if (list.type != JsonNode::Type::Array)
  {
    JsonCursor(document).fail("has no list of samples");
  }
  Reasons reasons;
  std::uint64_t touched = 0;
  for (std::size_t i = 0; i < list.children.size(); ++i)
  {
    touched += addReasons(list.children[i], sampleName(list.children[i], i), reasons) > 0;
  }
  std::vector<std::pair<std::pair<std::string, std::string>, Reason>> sorted(reasons.begin(), reasons.end());
  std::stable_sort(
    sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second.times > b.second.times; });
  ReportJson rows = ReportJson::array();
  for (std::size_t i = 0; i < std::min(sorted.size(), mostReasons); ++i)
  {
    rows.push_back({ { "path", utf8FromBytes(sorted[i].first.first) }, { "why", utf8FromBytes(sorted[i].first.second) },
      { "times", sorted[i].second.times }, { "example", utf8FromBytes(sorted[i].second.example) } });
  }
  return { { "samples", list.children.size() }, { "touched", touched }, { "reasonCount", sorted.size() },
    { "reasons", rows } };
}

} // namespace dgtk
