// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"
#include "Progress.h"

#include "dgtkError.h"
#include "dgtkReport.h"

#include <algorithm>
#include <cstdio>

namespace dgtk::app
{

namespace
{
constexpr int mostPictures = 1 << 30;

std::size_t countOf(const Arguments& arguments, const std::string& name)
{
  return arguments.text(name) == "all" ? 0 : std::size_t(arguments.integer(name, 1, mostPictures));
}

int runReport(const Arguments& arguments)
{
  ReportRequest request;
  request.dataset = arguments.positional()[0];
  request.file = arguments.text("--output");
  if (request.file.empty())
  {
    throw UsageError("report needs a file for the page: -o FILE.html");
  }
  request.shown = countOf(arguments, "--pictures");
  request.read = countOf(arguments, "--read");
  request.read = request.read == 0 || request.shown == 0 ? 0 : std::max(request.read, request.shown); // 0: all
  request.seed = std::uint64_t(arguments.integer("--seed", 0, mostPictures));
  request.threads = arguments.threads();
  request.verification = arguments.text("--verification");
  request.exports = arguments.all("--export");
  request.samples = arguments.text("--samples");
  Progress progress(arguments.has("--quiet"));
  const ReportResult result =
    writeReport(request, [&](std::size_t done, std::size_t total) { progress.update(done, total); });
  for (const std::string& note : result.notes)
  {
    progress.message("note: " + note);
  }
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.3g", progress.seconds());
  progress.message(request.file + ": " + std::to_string(result.shown) + " of " + std::to_string(result.pictures) +
                   " pictures, distributions of " + std::to_string(result.read) + ", " + std::to_string(result.layers) +
                   " layers, " + std::to_string(result.bytes / 1000) + " kB, " + seconds + " s");
  return 0;
}
} // namespace

Command reportCommand()
{
  return { "DATASET", 1, 1,
    { { "--output", "FILE.html", "", "the page" },
      { "--pictures", "N|all", "48", "pictures that are shown, with all of their layers" },
      { "--read", "N|all", "240", "pictures that distributions are made from; those that are shown are among them" },
      { "--seed", "N", "0", "of which pictures these are" },
      { "--verification", "FILE", "", "what dgtk verify DATASET --json printed (default: DATASET/verification.json)" },
      { "--export", "DIR", "", "an export of the dataset, whose rounding is shown; may be repeated" },
      { "--samples", "FILE", "", "samples.json of the scenes: what was refused (default: DATASET/samples.json)" },
      { "--threads", "N", "0", "threads to work with (0: all processors)" },
      { "--quiet", "", "", "no progress and no messages" } },
    &runReport };
}

} // namespace dgtk::app
