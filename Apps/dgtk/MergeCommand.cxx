// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "dgtkError.h"
#include "dgtkExportShards.h"
#include "dgtkRunParts.h"
#include "dgtkSystem.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace dgtk::app
{

namespace
{
/// Tasks that make what is missing, as sbatch --array= takes them: all of an array's tasks share a run among them, so
/// that those of another one than the first cannot be named by their old numbers.
std::string arrayOf(const MergeReport& report)
{
  const std::size_t most = report.workers.empty() ? 1 : report.workers.back();
  const std::size_t tasks = std::min(report.missing.size(), most);
  return tasks > 1 ? "0-" + std::to_string(tasks - 1) : "0";
}

/// What has to be started again: shares of those that there were, or an array.
std::string again(const MergeReport& report)
{
  std::string text;
  for (const std::size_t count : report.workers)
  {
    text += "shares " + report.processes(count) + " of " + std::to_string(count) + "; ";
  }
  return text + "--array=" + arrayOf(report);
}

int runMerge(const Arguments& arguments)
{
  std::string folder = arguments.positional()[0];
  while (folder.size() > 1 && folder.back() == '/')
  {
    folder.pop_back();
  }
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(folder, code);
  if (std::filesystem::status_known(status) && !std::filesystem::is_directory(status))
  {
    throw InputError(folder, std::filesystem::exists(status) ? "is no folder" : "does not exist");
  }
  const bool exported = hasParts(folder) && !readParts(folder).exporter.empty();
  const MergeReport report = exported ? mergeExport(folder) : mergeParts(folder, machineThreads());
  if (arguments.has("--json"))
  {
    nlohmann::ordered_json json{ { "merged", report.merged }, { "blocks", report.blocks }, { "files", report.files },
      { "missing", report.missing }, { "problems", report.problems } };
    if (!report.missing.empty())
    {
      json["array"] = arrayOf(report);
    }
    for (const std::size_t count : report.workers)
    {
      json["shares"][std::to_string(count)] = report.processes(count);
    }
    print(json.dump(2) + '\n');
  }
  else if (report.merged)
  {
    print(folder + (report.blocks == 0 ? ": is whole already\n"
                                       : ": whole, " + std::to_string(report.files) + " files of " +
                                           std::to_string(report.blocks) + " blocks\n"));
  }
  for (const std::string& problem : report.problems)
  {
    std::fprintf(stderr, "dgtk: %s\n", problem.c_str());
  }
  if (!report.missing.empty())
  {
    std::fprintf(stderr, "dgtk: %s: %zu of %zu blocks are missing (%s)\n", folder.c_str(), report.missing.size(),
      report.blocks, again(report).c_str());
  }
  return static_cast<int>(report.merged ? ExitCode::Done : ExitCode::Difference);
}
} // namespace

Command mergeCommand() { return { "DIR", 1, 1, { { "--json", "", "", "print one JSON object" } }, &runMerge }; }

} // namespace dgtk::app
