// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkVerification_h
#define dgtkVerification_h

#include "dgtkVerificationModule.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace dgtk
{

/// A value of a file that is farthest from what it should be.
struct Offender
{
  std::string file; ///< relative to the dataset; "" for none
  int x = -1;       ///< pixel, from the top-left corner; -1 where the value belongs to no pixel
  int y = -1;
  std::string value;    ///< as in the file
  std::string expected; ///< as derived anew
};

/// What one check found in one layer, over all cameras and frames.
struct Residual
{
  std::string check;         ///< name of the check, as in the table of verification.md
  std::string layer;         ///< "" for the dataset as a whole
  std::string unit;          ///< of largest and tolerance
  std::uint64_t count = 0;   ///< values compared
  std::uint64_t skipped = 0; ///< values that the check leaves open: near an edge, at coincident surfaces, ...
  std::uint64_t bad = 0;     ///< values beyond the tolerance
  double largest = 0;        ///< largest residual; +inf for a value of the wrong kind
  double tolerance = 0;
  double mostOpen = 0; ///< share of the values that may be left open
  Offender worst;      ///< where `largest` is
  /// More values were left open than sound datasets need; a few always may.
  bool tooMuchOpen() const
  {
    constexpr double few = 16; // of a small picture
    return double(this->skipped) > few + this->mostOpen * double(this->count + this->skipped);
  }
  bool breach() const { return this->bad > 0 || this->tooMuchOpen(); }
};

/// Files of one kind of which no check compares the contents: only their hashes are known to be right.
struct Unchecked
{
  std::string layer;  ///< as in the manifest; the path of a file that belongs to no layer
  std::string format; ///< extension without the dot
  std::uint64_t files = 0;
};

struct VerificationReport
{
  std::string manifestHash;         ///< SHA-256 of the dataset's manifest; "" where the report is not of a dataset
  std::vector<Residual> residuals;  ///< in the order of the checks; only of layers that the dataset has
  std::vector<Unchecked> unchecked; ///< sorted; empty where only some checks were asked for
  /// No breach, and something was checked.
  bool passed() const { return !this->firstBreach() && !this->residuals.empty(); }
  /// The residual to name first: the first breach, as later checks build upon earlier ones. Null when there is none.
  const Residual* firstBreach() const
  {
    const auto found = std::find_if(
      this->residuals.begin(), this->residuals.end(), [](const Residual& residual) { return residual.breach(); });
    return found == this->residuals.end() ? nullptr : &*found;
  }
};

/// Derives everything a dataset claims anew from its files, its scene and models, with Embree, OpenCV and own
/// arithmetic; none of the code that wrote it takes part. A damaged or missing file is a breach. `threads` >= 1; the
/// report does not depend on it. `checks`: names of the checks to run, all when empty; documents that cannot be read
/// are always reported. Throws InputError when `folder` is not a dataset: no readable manifest.json; UsageError for a
/// check that there is not.
DGTKVERIFICATION_EXPORT VerificationReport verifyDataset(
  const std::string& folder, int threads, const std::vector<std::string>& checks = {});

/// The names of all checks, in their order.
DGTKVERIFICATION_EXPORT std::vector<std::string> verificationChecks();

/// One line a residual and one for what is not checked, for people; ends with a newline.
DGTKVERIFICATION_EXPORT std::string verificationTable(const VerificationReport& report);
/// The contents of verification.json; ends with a newline. Numbers that are not finite are texts.
DGTKVERIFICATION_EXPORT std::string verificationText(const VerificationReport& report);
/// "FILE: pixel (x, y): found V, expected E (check depth, layer depth: residual R unit, tolerance T)".
DGTKVERIFICATION_EXPORT std::string describe(const Residual& residual);

} // namespace dgtk

#endif
