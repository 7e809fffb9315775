// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkVerification.h"

#include "dgtkCheck.h"
#include "dgtkError.h"
#include "dgtkHash.h"
#include "dgtkJournal.h"
#include "dgtkText.h"

#include <algorithm>
#include <filesystem>
#include <map>

namespace dgtk
{

namespace
{
/// In this order a fault is named where it is, and not where it shows: later checks build upon earlier ones.
constexpr Check allChecks[] = {
  { "hashes", checkHashes, nullptr },
  { "cameras", checkCameras, nullptr },
  { "metadata", checkMetadata, nullptr },
  { "poses", checkPoses, nullptr },
  { "models", checkModels, nullptr },
  { "depth", nullptr, checkDepth },
  { "objects", nullptr, checkObjects },
  { "calibration", nullptr, checkCalibration },
  { "geometry", nullptr, checkGeometry },
  { "edges", nullptr, checkEdges },
  { "motion", nullptr, checkMotion },
  { "class", nullptr, checkClass },
  { "epipolar", nullptr, checkEpipolar },
  { "triangulation", nullptr, checkTriangulation },
  { "forward-backward", nullptr, checkForwardBackward },
  { "partition", nullptr, checkPartition },
  { "ldi", nullptr, checkLdi },
  { "alpha", nullptr, checkAlpha },
  { "matting", nullptr, checkMatting },
  { "rgba", nullptr, checkRgba },
  { "boxes", nullptr, checkBoxes },
  { "keypoints", nullptr, checkKeypoints },
  { "points", checkPoints, nullptr },
  { "tracks", checkTracks, nullptr },
};

/// Runs one function of a check; a file that cannot be used becomes a residual.
template <typename Subject>
void run(
  const Check& check, void (*body)(Subject&, Results&), Subject& subject, const Dataset& dataset, Results& results)
{
  results.startCheck(static_cast<int>(&check - allChecks), check.name);
  if (!body)
  {
    return;
  }
  try
  {
    body(subject, results);
  }
  catch (const InputError& error)
  {
    results.unusable("", dataset.relative(error.file()), error.what());
  }
  catch (const UsageError& error)
  {
    results.unusable("", "", error.what());
  }
}

bool isAsked(const std::vector<std::string>& names, const Check& check)
{
  return names.empty() || std::find(names.begin(), names.end(), check.name) != names.end();
}

/// The checks of these names, in the order of the table; all for none.
std::vector<const Check*> checksOf(const std::vector<std::string>& names)
{
  const std::vector<std::string> known = verificationChecks();
  for (const std::string& name : names)
  {
    if (std::find(known.begin(), known.end(), name) == known.end())
    {
      throw UsageError("there is no check " + quoted(name) + " (expected one of " + joined(known) + ")");
    }
  }
  std::vector<const Check*> asked;
  for (const Check& check : allChecks)
  {
    if (isAsked(names, check))
    {
      asked.push_back(&check);
    }
  }
  return asked;
}

/// What no row compares. The scene is what all else is derived from.
std::vector<Unchecked> uncheckedOf(const Dataset& dataset, const Results& results)
{
  std::map<std::pair<std::string, std::string>, std::uint64_t> kinds;
  for (const DatasetFile& file : dataset.manifest().files)
  {
    if (file.path != "scene.json" && !results.compares(file.path))
    {
      const std::string extension = std::filesystem::path(file.path).extension().string();
      ++kinds[{ file.layer.empty() ? file.path : file.layer, extension.empty() ? extension : extension.substr(1) }];
    }
  }
  std::vector<Unchecked> unchecked;
  unchecked.reserve(kinds.size());
  for (const auto& [kind, files] : kinds)
  {
    unchecked.push_back({ kind.first, kind.second, files });
  }
  return unchecked;
}

void verifyPictures(Dataset& dataset, const std::vector<const Check*>& checks, Results& results)
{
  std::vector<CameraRecord> records = dataset.cameras();
  std::stable_sort(
    records.begin(), records.end(), [](const CameraRecord& a, const CameraRecord& b) { return a.frame < b.frame; });
  for (const CameraRecord& record : records)
  {
    try
    {
      Picture picture(dataset, record);
      for (const Check* check : checks)
      {
        run(*check, check->ofPicture, picture, dataset, results);
      }
    }
    catch (const UsageError& error)
    {
      results.unusable("cameras", "cameras.json", error.what());
    }
  }
}
} // namespace

std::vector<std::string> verificationChecks()
{
  std::vector<std::string> names;
  for (const Check& check : allChecks)
  {
    names.emplace_back(check.name);
  }
  return names;
}

VerificationReport verifyDataset(const std::string& folder, int threads, const std::vector<std::string>& checks)
{
  const std::vector<const Check*> asked = checksOf(checks);
  Dataset dataset(folder, threads);
  const std::string manifestHash = Sha256::ofFile(dataset.absolute(manifestName)); // not of one that comes meanwhile
  Results results;
  results.startCheck(0, allChecks[0].name);
  for (const Dataset::Problem& problem : dataset.problems())
  {
    results.unusable("documents", problem.file, problem.what);
  }
  const bool usable = dataset.problems().empty();
  for (const Check* check : asked)
  {
    if (usable || check == allChecks)
    {
      run(*check, check->ofDataset, dataset, dataset, results);
    }
  }
  if (usable)
  {
    verifyPictures(dataset, asked, results);
  }
  VerificationReport report = results.report();
  report.manifestHash = manifestHash;
  report.unchecked = checks.empty() ? uncheckedOf(dataset, results) : std::vector<Unchecked>{};
  return report;
}

} // namespace dgtk
