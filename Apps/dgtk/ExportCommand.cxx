// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"
#include "Interrupt.h"
#include "Progress.h"
#include "Shard.h"

#include "dgtkAgainError.h"
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportShards.h"
#include "dgtkExporterEntry.h"
#include "dgtkFolderContents.h"

#include <algorithm>
#include <optional>

namespace dgtk::app
{

std::vector<std::string> exporterNames()
{
  std::vector<std::string> names;
  for (const ExporterRow& row : exporterRows())
  {
    names.push_back(row.info.name);
  }
  return names;
}

namespace
{
ExportRequest parseExportRequest(const Arguments& arguments)
{
  ExportRequest request;
  request.dataset = arguments.positional()[0];
  request.folder = arguments.text("--output");
  request.format = arguments.text("--format");
  if (request.folder.empty() || request.format.empty())
  {
    throw UsageError("export needs a format and a folder for it: --format EXPORTER -o DIR");
  }
  requireDataset(request.dataset);
  if (arguments.has("--frames"))
  {
    const FrameSteps frames = parseFrames(arguments.text("--frames"));
    request.selection.someFrames = true;
    request.selection.first = frames.first;
    request.selection.last = frames.last;
    request.selection.step = frames.step;
  }
  for (const OptionRow* row : allExportOptions())
  {
    if (arguments.has(optionWord(*row)))
    {
      const std::string given = arguments.text(optionWord(*row));
      request.options[row->name] = row->value.empty() ? row->normal(given) : given;
    }
  }
  request.resume = arguments.has("--resume");
  request.replace = arguments.has("--replace");
  return request;
}

ExportResult exported(
  const ExportRequest& request, const std::optional<RunShard>& shard, const ExportCallbacks& callbacks)
{
  try
  {
    return shard ? exportShard(request, *shard, callbacks) : exportDataset(request, callbacks);
  }
  catch (const FolderError& error)
  {
    refuse(error, shard.has_value());
  }
}

std::string numberText(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

int exportRun(const Arguments& arguments)
{
  const ExportRequest request = parseExportRequest(arguments);
  Progress progress(arguments.has("--quiet"));
  ExportCallbacks callbacks;
  callbacks.cancel = &catchInterrupts();
  callbacks.progress = [&](const ExportProgress& state) { progress.update(state.done, state.total, state.kept); };
  callbacks.message = [&](const std::string& line) { progress.message(line); };
  std::optional<RunShard> shard;
  if (arguments.has("--shard"))
  {
    shard = parseShard(arguments.text("--shard"));
  }
  const ExportResult result = exported(request, shard, callbacks);
  if (result.interrupted)
  {
    throw AgainError(shard ? "interrupted; the same command completes its share of " + request.folder
                           : "interrupted; the same command with --resume completes " + request.folder);
  }
  if (shard)
  {
    progress.message("share " + std::to_string(shard->index) + " of " + std::to_string(shard->count) + " of " +
                     request.folder + ", " + numberText(progress.seconds()) + " s");
    return 0;
  }
  for (const LayerRounding& layer : result.layers)
  {
    if (layer.withoutCode > 0)
    {
      progress.message("warning: " + std::to_string(layer.withoutCode) + " of " + std::to_string(layer.values) +
                       " values of " + layer.layer + " have no code in the format and are marked as nothing");
    }
    if (layer.largest > 0)
    {
      progress.message(layer.layer + ": rounded by at most " + numberText(layer.largest) + ' ' + layer.unit);
    }
  }
  progress.message(
    std::to_string(result.files) + " files in " + request.folder + ", " + numberText(progress.seconds()) + " s");
  return 0;
}

int runExport(const Arguments& arguments)
{
  try
  {
    return exportRun(arguments);
  }
  catch (const UsageError& error)
  {
    const std::string line = error.what();
    throw UsageError(line.rfind("format: ", 0) == 0 ? "--" + line : withOption(line, allExportOptions()));
  }
}
} // namespace

Command exportCommand()
{
  Command command{ "DATASET", 1, 1, {}, &runExport };
  command.options = { { "--format", "EXPORTER", "", "the format; see dgtk list exporters", exporterNames() },
    { "--output", "DIR", "", "folder of the export" },
    { "--frames", "A[:B[:STEP]]", "", "some of the frames (default: all)" } };
  for (const OptionRow* row : allExportOptions())
  {
    command.options.push_back({ optionWord(*row), row->value, row->value.empty() ? "" : row->fallback, row->help,
      row->choices, row->kind == OptionRow::Kind::Names });
  }
  const std::vector<Option> last = { { "--resume", "", "", "continue an interrupted export of the same request" },
    { "--replace", "", "", "remove the export of another request, or an interrupted one, that the folder holds" },
    { "--shard", "I/N|auto", "", "a share of the export, from 0; dgtk merge ends it when all are there" },
    { "--quiet", "", "", "no progress and no messages" } };
  command.options.insert(command.options.end(), last.begin(), last.end());
  return command;
}

} // namespace dgtk::app
