// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"
#include "Interrupt.h"
#include "Progress.h"
#include "Shard.h"

#include "dgtkAgainError.h"
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkGenerator.h"
#include "dgtkSceneFile.h"
#include "dgtkWorkPlan.h"
#include "dgtkWorkTime.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <optional>

#include <sys/resource.h>

namespace dgtk::app
{

namespace
{
constexpr int largestImage = 1 << 20;
// Tiles of one row are open together.
void allowManyFiles()
{
  struct rlimit limit = {};
  if (::getrlimit(RLIMIT_NOFILE, &limit) == 0)
  {
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &limit);
  }
}

std::string usualLayers()
{
  std::vector<std::string> usual;
  for (const LayerInfo& info : generatorLayers())
  {
    if (info.usual)
    {
      usual.push_back(info.layer);
    }
  }
  return joinedNames(usual);
}

std::vector<std::string> layerWords()
{
  std::vector<std::string> words{ "all" };
  for (const LayerInfo& info : generatorLayers())
  {
    words.push_back(info.layer);
  }
  return words;
}

GeneratorRequest parseRenderRequest(const Arguments& arguments)
{
  GeneratorRequest request;
  request.scene = arguments.positional()[0];
  request.folder = arguments.text("--output");
  if (request.folder.empty())
  {
    throw UsageError("render needs a folder for the dataset: -o DIR");
  }
  if (arguments.has("--layers")) // otherwise the usual ones, as far as the scene's cameras can have them
  {
    request.layers = arguments.list("--layers");
  }
  request.cameras = arguments.list("--cameras");
  if (arguments.has("--frames"))
  {
    const FrameSteps frames = parseFrames(arguments.text("--frames"));
    request.frames = { frames.first, frames.last, frames.step };
  }
  if (arguments.has("--size"))
  {
    arguments.size("--size", largestImage, request.width, request.height);
  }
  for (const OptionRow* row : allOptions())
  {
    if (arguments.has(optionWord(*row)))
    {
      request.options[row->name] = row->normal(arguments.text(optionWord(*row)));
    }
  }
  if (arguments.has("--classes"))
  {
    request.classes = readClassFile(arguments.text("--classes"));
  }
  if (arguments.has("--for"))
  {
    addNeeds(arguments.list("--for"), request.layers, request.options);
  }
  request.resume = arguments.has("--resume");
  request.replace = arguments.has("--replace");
  if (request.resume && request.replace)
  {
    throw UsageError("--resume and --replace exclude one another");
  }
  return request;
}

/// A line a stage: processor time of all threads, its share, and the peak of memory until its end.
void printTimings(double seconds)
{
  constexpr double mebibyte = 1 << 20;
  const std::vector<StageTime> all = workTimes();
  char line[128];
  double sum = 0;
  std::snprintf(line, sizeof line, "%-8s %12s %7s %12s\n", "stage", "processors s", "share", "memory MiB");
  std::string text = line;
  for (const StageTime& stage : all)
  {
    sum += stage.seconds;
  }
  for (const StageTime& stage : all)
  {
    std::snprintf(line, sizeof line, "%-8s %12.3f %5.1f %% %12.0f\n", stage.name.c_str(), stage.seconds,
      100 * stage.seconds / std::max(sum, 1e-9), double(stage.peakBytes) / mebibyte);
    text += line;
  }
  std::snprintf(line, sizeof line, "%-8s %12.3f %7s %12.0f (%.3f s by the clock)\n", "all", sum, "",
    double(all.back().peakBytes) / mebibyte, seconds);
  print(text + line);
}

GeneratorResult generated(
  const GeneratorRequest& request, const std::optional<RunShard>& shard, const GeneratorCallbacks& callbacks)
{
  try
  {
    if (shard)
    {
      return generateShard(request, *shard, callbacks);
    }
    return namesScenes(request) ? generateScenes(request, callbacks) : generate(request, callbacks);
  }
  catch (const FolderError& error)
  {
    refuse(error, shard.has_value());
  }
}

int render(const Arguments& arguments)
{
  const std::atomic<bool>& interrupted = catchInterrupts();
  const GeneratorRequest request = parseRenderRequest(arguments);
  if (mayUseOpenGL(request))
  {
    prepareGL(option::gl().of(request.options), option::threads().of(request.options));
  }
  allowManyFiles();
  if (arguments.has("--timings"))
  {
    keepWorkTimes();
  }
  Progress progress(arguments.has("--quiet"), namesScenes(request) ? "scenes" : "pictures");
  GeneratorCallbacks callbacks;
  callbacks.cancel = &interrupted;
  callbacks.progress = [&](const GeneratorProgress& state) { progress.update(state.done, state.total, state.kept); };
  callbacks.message = [&](const std::string& line) { progress.message(line); };
  std::optional<RunShard> shard;
  if (arguments.has("--shard"))
  {
    shard = parseShard(arguments.text("--shard"));
  }
  const GeneratorResult result = generated(request, shard, callbacks);
  if (result.interrupted)
  {
    throw AgainError(shard ? "interrupted; the same command completes its share of " + request.folder
                           : "interrupted; the same command with --resume completes " + request.folder);
  }
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.1f s", progress.seconds());
  progress.message(std::to_string(result.pictures) + " pictures, " + std::to_string(result.files) + " files in " +
                   request.folder + ", " + seconds);
  if (arguments.has("--timings"))
  {
    printTimings(progress.seconds());
  }
  return 0;
}

int runRender(const Arguments& arguments)
{
  try
  {
    return render(arguments);
  }
  catch (const UsageError& error)
  {
    throw UsageError(withOption(error.what(), allOptions()));
  }
}
} // namespace

Command renderCommand()
{
  Command command{ "SCENE|FOLDER", 1, 1, {}, &runRender };
  command.options = { { "--output", "DIR", "", "folder of the dataset" },
    { "--layers", "NAMES|all", usualLayers(), "what to write; see dgtk list layers", layerWords(), true },
    { "--for", "EXPORTER,...", "", "what these exports need, beside the layers that are given", exporterNames(), true },
    { "--cameras", "NAMES", "", "some of the cameras (default: all)" },
    { "--frames", "A[:B[:STEP]]", "", "some of the frames (default: all)" },
    { "--classes", "FILE", "",
      "numbers of the classes of scenes that fix none (default: of all scenes of a folder together)" },
    { "--size", "WxH", "", "size of the images in pixels (default: the camera's own, else 640x480)" } };
  for (const OptionRow* row : allOptions())
  {
    command.options.push_back({ optionWord(*row), row->value, row->value.empty() ? "" : row->fallback, row->help,
      row->choices, row->kind == OptionRow::Kind::Names });
  }
  const std::vector<Option> last = {
    { "--shard", "I/N|auto", "", "a share of the run, from 0; dgtk merge ends it when all are there" },
    { "--resume", "", "", "continue an interrupted run of the same request" },
    { "--replace", "", "", "remove the dataset of another request, or an interrupted run, that the folder holds" },
    noCacheOption, { "--timings", "", "", "print where processor time and memory went, at the end" },
    { "--quiet", "", "", "no progress and no messages (environment DGTK_PROGRESS: seconds between its lines, else 5)" }
  };
  command.options.insert(command.options.end(), last.begin(), last.end());
  return command;
}

} // namespace dgtk::app
