// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "dgtkError.h"
#include "dgtkExportVerification.h"
#include "dgtkFile.h"
#include "dgtkSampleVerification.h"
#include "dgtkSystem.h"
#include "dgtkUtf8.h"
#include "dgtkVerification.h"

#include <algorithm>
#include <cstdio>

namespace dgtk::app
{

namespace
{
constexpr int mostThreads = 1024;

int run(const Arguments& arguments)
{
  std::string folder = arguments.positional()[0];
  while (folder.size() > 1 && folder.back() == '/')
  {
    folder.pop_back();
  }
  const int threads = arguments.has("--threads") ? arguments.integer("--threads", 1, mostThreads) : machineThreads();
  const bool samples = isSampleFolder(folder);
  if (samples && (arguments.has("--check") || arguments.has("--export")))
  {
    throw UsageError(folder + " is a folder of samples, which have neither checks to choose nor exports");
  }
  if (!samples)
  {
    requireDataset(folder);
  }
  const std::vector<std::string> checks =
    arguments.has("--check") ? arguments.list("--check") : std::vector<std::string>{};
  const std::string exported = arguments.text("--export");
  const VerificationReport report = samples            ? verifySamples(folder)
                                    : exported.empty() ? verifyDataset(folder, threads, checks)
                                                       : verifyExport(folder, exported, threads);
  if (arguments.has("--write") && exported.empty())
  {
    writeFile(folder + "/verification.json", verificationText(report));
  }
  print(arguments.has("--json") ? verificationText(report) : verificationTable(report));
  if (const Residual* breach = report.firstBreach())
  {
    std::fprintf(
      stderr, "dgtk: %s\n", printable((exported.empty() ? folder : exported) + '/' + describe(*breach)).c_str());
  }
  return static_cast<int>(report.passed() ? ExitCode::Done : ExitCode::Difference);
}
} // namespace

Command verifyCommand()
{
  return { "verify", "DIR", 1, 1,
    "Derives anew what a dataset or a folder of samples claims, prints residuals; exits with 1 on a breach.",
    { { "--export", "DIR", "", "read an export of the dataset back and compare it, instead of the dataset itself" },
      { "--check", "NAME,...", "all", "only these checks, by the names of the table", verificationChecks(), true },
      { "--json", "", "", "print one JSON object" }, { "--write", "", "", "also write DIR/verification.json" },
      { "--threads", "N", "all processors", "threads to work with" } },
    &run };
}

} // namespace dgtk::app
