// SPDX-License-Identifier: BSD-3-Clause
// What the tests of all readers share.
#ifndef dgtkModelChecks_h
#define dgtkModelChecks_h

#include "dgtkModelReader.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dgtk::test
{

/// Empty when the model keeps every promise of dgtkModel.h; otherwise the first that it breaks.
std::string brokenPromise(const Model& model);

/// Within 1e-12.
void expectNear(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Writes `bytes` to a file with that extension in a fresh folder and reads it without decoding textures.
std::shared_ptr<const Model> readBytes(const std::string& extension, const std::string& bytes);

/// The text of the InputError that reading throws, without the folder of the file; "" when it does not throw.
std::string refusal(const std::string& extension, const std::string& bytes);

/// Whether sweeps are as broad as they can be (DGTK_TEST_WHOLE); a thin one takes the first of what chance deals.
bool sweepsAreWhole();

/// Reads at least `variants` (a quarter in a thin sweep) truncated and mutated copies of the seeds (seeded, always the
/// same) and fails the running test for anything but a consistent model or an InputError of one line, for more than 2 s
/// of the processor, for a partial model of a truncated file without a warning where the format `knowsItsEnd`, and for
/// more memory than 10 times the file and 64 MiB.
void fuzzReader(
  const std::string& extension, const std::vector<std::string>& seeds, int variants = 2000, bool knowsItsEnd = true);

/// A truncated (each fourth) or mutated copy, the same for the same variant everywhere.
std::string damaged(const std::string& seed, std::uint64_t variant);

/// Reads a file of these bytes once, with the same limits of time and memory and the same checks; prints both. Returns
/// the model, or null when it is refused.
std::shared_ptr<const Model> readWithinLimits(const std::string& extension, const std::string& bytes);

/// Why a test of the further models is skipped.
extern const char* const withoutExtraModels;

/// Paths of the further models with exactly that extension and at least a byte, sorted.
std::vector<std::string> extraPaths(const std::string& extension);

/// Contents of those, of either case, that are at most `limit` bytes long.
std::vector<std::string> extraSeeds(const std::string& extension, std::size_t limit = 40000);

/// Bytes handed out by operator new and not yet given back: now, and the most since resetPeak().
std::size_t liveBytes();
std::size_t peakBytes();
void resetPeak();

} // namespace dgtk::test

#endif
