// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMeter.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace dgtk
{

namespace
{
using OrderedJson = nlohmann::ordered_json;

OrderedJson numberJson(double value)
{
  return std::isfinite(value) ? OrderedJson(value) : OrderedJson(numberText(value));
}

/// Three digits, for people.
std::string brief(double value)
{
  if (!std::isfinite(value) || value == 0)
  {
    return numberText(value);
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.2e", value);
  return text;
}

OrderedJson residualJson(const Residual& residual)
{
  OrderedJson json;
  json["check"] = residual.check;
  json["layer"] = utf8FromBytes(residual.layer);
  json["count"] = residual.count;
  json["skipped"] = residual.skipped;
  json["most_open"] = residual.mostOpen;
  json["bad"] = residual.bad;
  json["largest"] = numberJson(residual.largest);
  json["tolerance"] = residual.tolerance;
  json["unit"] = residual.unit;
  json["breach"] = residual.breach();
  if (!residual.worst.file.empty())
  {
    OrderedJson& worst = json["worst"];
    worst["file"] = utf8FromBytes(residual.worst.file);
    worst["pixel"] =
      residual.worst.x < 0 ? OrderedJson(nullptr) : OrderedJson::array({ residual.worst.x, residual.worst.y });
    worst["value"] = utf8FromBytes(residual.worst.value);
    worst["expected"] = utf8FromBytes(residual.worst.expected);
  }
  return json;
}

std::vector<std::string> cellsOf(const Residual& residual)
{
  return { residual.check, printable(residual.layer), std::to_string(residual.count), std::to_string(residual.skipped),
    brief(residual.largest), brief(residual.tolerance), residual.unit,
    residual.bad > 0         ? "BREACH (" + std::to_string(residual.bad) + ")"
    : residual.tooMuchOpen() ? "BREACH (open)"
                             : "ok" };
}

/// "color .png (4 files)"
std::string kindText(const Unchecked& kind)
{
  const std::string format = kind.layer.find('.') == std::string::npos ? " ." + kind.format : "";
  return printable(kind.layer + format) + " (" + std::to_string(kind.files) + (kind.files == 1 ? " file)" : " files)");
}

std::string openText(const Residual& residual)
{
  return std::to_string(residual.skipped) + " of " + std::to_string(residual.count + residual.skipped) +
         " values left open, expected at most " + brief(100 * residual.mostOpen) + " %";
}
} // namespace

std::string verificationTable(const VerificationReport& report)
{
  std::vector<std::vector<std::string>> rows{ { "check", "layer", "values", "open", "largest", "tolerance", "unit",
    "" } };
  for (const Residual& residual : report.residuals)
  {
    rows.push_back(cellsOf(residual));
  }
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows)
  {
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  std::string text;
  for (const auto& row : rows)
  {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      const std::string pad(widths[i] - row[i].size(), ' ');
      const bool number = i >= 2 && i <= 5;
      line += (i > 0 ? "  " : "") + (number ? pad + row[i] : row[i] + pad);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  std::string kinds;
  for (const Unchecked& kind : report.unchecked)
  {
    kinds += (kinds.empty() ? "" : ", ") + kindText(kind);
  }
  return kinds.empty() ? text : text + "not checked beyond their hashes: " + kinds + '\n';
}

std::string verificationText(const VerificationReport& report)
{
  OrderedJson json;
  json["format"] = "DGTk verification";
  json["format_version"] = 1;
  if (!report.manifestHash.empty())
  {
    json["dataset_manifest"] = report.manifestHash;
  }
  json["passed"] = report.passed();
  json["residuals"] = OrderedJson::array();
  for (const Residual& residual : report.residuals)
  {
    json["residuals"].push_back(residualJson(residual));
  }
  json["not_checked"] = OrderedJson::array();
  for (const Unchecked& kind : report.unchecked)
  {
    json["not_checked"].push_back(
      { { "layer", utf8FromBytes(kind.layer) }, { "format", utf8FromBytes(kind.format) }, { "files", kind.files } });
  }
  return json.dump(2) + '\n';
}

std::string describe(const Residual& residual)
{
  if (residual.bad == 0 && residual.tooMuchOpen())
  {
    return "dataset: " + openText(residual) + " (check " + residual.check + ", layer " + residual.layer + ')';
  }
  const Offender& worst = residual.worst;
  std::string text = worst.file.empty() ? "dataset" : worst.file;
  if (worst.x >= 0)
  {
    text += ": pixel (" + std::to_string(worst.x) + ", " + std::to_string(worst.y) + ")";
  }
  text += ": found " + worst.value + ", expected " + worst.expected + " (check " + residual.check;
  text += residual.layer.empty() ? "" : ", layer " + residual.layer;
  if (std::isfinite(residual.largest) && residual.largest > 0)
  {
    text += ", residual " + brief(residual.largest) + ' ' + residual.unit + " against " + brief(residual.tolerance);
  }
  return text + ')';
}

} // namespace dgtk
