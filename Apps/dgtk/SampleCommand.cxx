// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"
#include "Interrupt.h"
#include "Progress.h"

#include "dgtkAgainError.h"
#include "dgtkError.h"
#include "dgtkFolderContents.h"
#include "dgtkSampleRun.h"
#include "dgtkSampler.h"

namespace dgtk::app
{

namespace
{
/// "A" or "A:B", both included.
void parseSamples(const std::string& text, int& first, int& last)
{
  const std::size_t colon = text.find(':');
  first = parseInteger(text.substr(0, colon), "--samples", 0, largestSample);
  last = colon == std::string::npos ? first : parseInteger(text.substr(colon + 1), "--samples", 0, largestSample);
  if (first > last)
  {
    throw UsageError("--samples: expected A:B with A at most B, found '" + text + "'");
  }
}

std::uint64_t parseSeed(const std::string& text)
{
  const bool digits = !text.empty() && text.size() < 17 && text.find_first_not_of("0123456789") == std::string::npos;
  const std::uint64_t seed = digits ? std::stoull(text) : 0;
  if (!digits || seed >= (std::uint64_t(1) << 53))
  {
    throw UsageError("--seed: expected a whole number from 0 to 2^53 - 1, found " + quoted(text));
  }
  return seed;
}

SampleRequest parseSampleRequest(const Arguments& arguments)
{
  SampleRequest request;
  request.scene = arguments.positional()[0];
  request.folder = arguments.text("--output");
  if (request.folder.empty() || !arguments.has("--samples"))
  {
    throw UsageError("sample needs numbers of samples and a folder for them: --samples A:B -o DIR");
  }
  requireOutsideDatasets(request.folder);
  parseSamples(arguments.text("--samples"), request.first, request.last);
  if (arguments.has("--seed"))
  {
    request.seed = parseSeed(arguments.text("--seed"));
  }
  request.replace = arguments.has("--replace");
  request.threads = arguments.threads();
  return request;
}

int runSample(const Arguments& arguments)
{
  const SampleRequest request = parseSampleRequest(arguments);
  Progress progress(arguments.has("--quiet"), "samples");
  SampleCallbacks callbacks;
  callbacks.cancel = &catchInterrupts();
  callbacks.progress = [&](std::size_t done, std::size_t total) { progress.update(done, total); };
  SampleResult result;
  try
  {
    result = writeSamples(request, callbacks);
  }
  catch (const SampleFolderError& error)
  {
    throw UsageError(error.what() + std::string(error.mayBeReplaced() ? " (--replace removes them)" : ""));
  }
  if (result.interrupted)
  {
    throw AgainError("interrupted; the same command begins anew");
  }
  if (result.refused > 0 || result.leftOut > 0)
  {
    progress.message("warning: " + std::to_string(result.refused) + " samples refused, " +
                     std::to_string(result.leftOut) + " objects and cameras left out; samples.json says why");
  }
  progress.message(std::to_string(result.written) + " scenes in " + request.folder);
  return 0;
}
} // namespace

Command sampleCommand()
{
  return { "SCENE", 1, 1,
    { { "--output", "DIR", "", "folder of the scenes" },
      { "--samples", "A:B", "", "numbers of the samples, both included" },
      { "--seed", "N", "", "instead of the scene's seed" },
      { "--threads", "N", "0", "threads to work with (0: all processors)" },
      { "--replace", "", "", "remove the samples of an earlier run that the folder holds" },
      { "--quiet", "", "", "no progress and no messages" }, noCacheOption },
    &runSample };
}

} // namespace dgtk::app
