// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkVerification.h"

#include "dgtkCheck.h"
#include "dgtkError.h"

#include <algorithm>

namespace dgtk
{

namespace
{
/// In this order a fault is named where it is, and not where it shows: later checks build upon earlier ones.
constexpr Check Checks[] = {
  { "hashes", checkHashes, nullptr },
  { "cameras", checkCameras, nullptr },
  { "depth", nullptr, checkDepth },
  { "objects", nullptr, checkObjects },
  { "calibration", nullptr, checkCalibration },
  { "geometry", nullptr, checkGeometry },
  { "motion", nullptr, checkMotion },
  { "class", nullptr, checkClass },
  { "epipolar", nullptr, checkEpipolar },
  { "triangulation", nullptr, checkTriangulation },
  { "forward-backward", nullptr, checkForwardBackward },
  { "partition", nullptr, checkPartition },
  { "ldi", nullptr, checkLdi },
  { "alpha", nullptr, checkAlpha },
  { "matting", nullptr, checkMatting },
  { "boxes", nullptr, checkBoxes },
  { "points", checkPoints, nullptr },
};

/// Runs one function of a check; a file that cannot be used becomes a residual.
template <typename Subject>
void run(
  const Check& check, void (*body)(Subject&, Results&), Subject& subject, const Dataset& dataset, Results& results)
{
  results.startCheck(static_cast<int>(&check - Checks), check.name);
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

} // namespace

VerificationReport verifyDataset(const std::string& folder, int threads)
{
  Dataset dataset(folder, threads);
  Results results;
  run(Checks[0], Checks[0].ofDataset, dataset, dataset, results);
  for (const Dataset::Problem& problem : dataset.problems())
  {
    results.unusable("documents", problem.file, problem.what);
  }
  if (!dataset.problems().empty())
  {
    return results.report();
  }
  for (const Check& check : Checks)
  {
    if (&check != Checks)
    {
      run(check, check.ofDataset, dataset, dataset, results);
    }
  }
  std::vector<CameraRecord> records = dataset.cameras();
  std::stable_sort(
    records.begin(), records.end(), [](const CameraRecord& a, const CameraRecord& b) { return a.frame < b.frame; });
  for (const CameraRecord& record : records)
  {
    try
    {
      Picture picture(dataset, record);
      for (const Check& check : Checks)
      {
        run(check, check.ofPicture, picture, dataset, results);
      }
    }
    catch (const UsageError& error)
    {
      results.unusable("cameras", "cameras.json", error.what());
    }
  }
  return results.report();
}

} // namespace dgtk
