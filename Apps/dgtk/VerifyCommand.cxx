// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkFolder.h"
#include "dgtkFolderContents.h"
#include "dgtkHash.h"
#include "dgtkJournal.h"
#include "dgtkJson.h"
#include "dgtkRunParts.h"
#include "dgtkSceneFolders.h"
#include "dgtkUtf8.h"
#include "dgtkVerificationCalls.h"

#include <cstdio>
#include <filesystem>
#include <set>

namespace dgtk::app
{

namespace
{
/// Whether the manifests of a folder's datasets are those that its own one has.
bool areListed(const std::string& folder)
{
  std::set<std::string> known;
  bool same = true;
  const auto wrong = [&](const std::string& file, const std::string& why)
  {
    std::fprintf(stderr, "dgtk: %s\n", printable(folder + '/' + file + ": " + why).c_str());
    same = false;
  };
  for (const DatasetFile& file : readDatasets(folder).datasets)
  {
    known.insert(file.path);
    const std::string path = Folder(folder).fileAt(file.path);
    if (Sha256::ofFile(path) != file.sha256 || std::filesystem::file_size(path) != file.bytes)
    {
      wrong(file.path, "found other bytes, expected those that " + std::string(manifestName) + " has");
    }
  }
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(folder, code))
  {
    const std::string file = entry.path().filename().string() + '/' + manifestName;
    if (known.count(file) == 0 && std::filesystem::is_regular_file(folder + '/' + file, code))
    {
      wrong(file, "found a dataset that " + std::string(manifestName) + " does not list, expected none");
    }
  }
  return same;
}

/// Every dataset of a folder of datasets: a line each, and the table of those with a breach.
int verifyScenes(const std::string& folder, const std::vector<std::string>& scenes, int threads,
  const std::vector<std::string>& checks, bool json)
{
  const bool listed = areListed(folder);
  std::size_t bad = 0;
  std::string all;
  for (const std::string& scene : scenes)
  {
    const std::string path = folder + '/' + scene;
    requireDataset(path);
    const VerificationReport report = verification().verifyDataset(path, threads, checks);
    if (json)
    {
      all += (all.empty() ? "" : ",\n") + jsonString(scene) + ": " + verification().text(report);
    }
    else if (!report.passed())
    {
      print(path + ":\n" + verification().table(report));
    }
    if (const Residual* breach = report.firstBreach())
    {
      std::fprintf(stderr, "dgtk: %s\n", printable(path + '/' + verification().describe(*breach)).c_str());
    }
    bad += report.passed() ? 0 : 1;
  }
  print(json
          ? "{\n" + all + "}\n"
          : folder + ": " + std::to_string(scenes.size()) + " datasets, " + std::to_string(bad) + " with a breach\n");
  return static_cast<int>(bad == 0 && listed ? ExitCode::Done : ExitCode::Difference);
}

int runVerify(const Arguments& arguments)
{
  std::string folder = arguments.positional()[0];
  while (folder.size() > 1 && folder.back() == '/')
  {
    folder.pop_back();
  }
  const int threads = arguments.threads();
  const std::string exported = arguments.text("--export");
  if (!exported.empty() && (arguments.has("--check") || arguments.has("--write")))
  {
    throw UsageError("--export: an export has neither checks to choose nor a file for what was found");
  }
  const bool samples = verification().isSampleFolder(folder);
  if (samples && (arguments.has("--check") || arguments.has("--export")))
  {
    throw UsageError(folder + " is a folder of samples, which have neither checks to choose nor exports");
  }
  const std::vector<std::string> scenes = samples ? std::vector<std::string>() : sceneFoldersIn(folder);
  if (!samples && scenes.empty())
  {
    requireDataset(folder);
  }
  const std::vector<std::string> checks =
    arguments.has("--check") ? arguments.list("--check") : std::vector<std::string>{};
  if (!scenes.empty() && exported.empty())
  {
    if (arguments.has("--write"))
    {
      throw UsageError(folder + ": holds many datasets; --write is for one of them");
    }
    return verifyScenes(folder, scenes, threads, checks, arguments.has("--json"));
  }
  const VerificationReport report = samples            ? verification().verifySamples(folder)
                                    : exported.empty() ? verification().verifyDataset(folder, threads, checks)
                                                       : verification().verifyExport(folder, exported, threads);
  if (arguments.has("--write"))
  {
    writeFile(folder + "/verification.json", verification().text(report));
  }
  print(arguments.has("--json") ? verification().text(report) : verification().table(report));
  if (const Residual* breach = report.firstBreach())
  {
    std::fprintf(stderr, "dgtk: %s\n",
      printable((exported.empty() ? folder : exported) + '/' + verification().describe(*breach)).c_str());
  }
  return static_cast<int>(report.passed() ? ExitCode::Done : ExitCode::Difference);
}
} // namespace

Command verifyCommand()
{
  return { "DIR", 1, 1,
    { { "--export", "DIR", "", "read an export of the dataset back and compare it, instead of the dataset itself" },
      { "--check", "NAME,...", "all", "only these checks, by the names of the table", verification().checks(), true },
      { "--json", "", "", "print one JSON object" }, { "--write", "", "", "also write DIR/verification.json" },
      { "--threads", "N", "0", "threads to work with (0: all processors)" } },
    &runVerify };
}

} // namespace dgtk::app
