// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "dgtkError.h"
#include "dgtkModelCache.h"
#include "dgtkRenderGLCalls.h"
#include "dgtkSystem.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include <signal.h>

namespace
{
using namespace dgtk::app;

std::string overview()
{
  std::string text = "usage: dgtk COMMAND [arguments] [options]\n\n"
                     "Images and exact ground truth from described 3D scenes.\n\n";
  for (const CommandRow& row : commandRows())
  {
    const std::string name = row.name;
    text += "  " + name + std::string(12 - name.size(), ' ') + row.help + '\n';
  }
  return text + "\ndgtk COMMAND --help tells more; dgtk --version prints the version.\n";
}

int dispatch(const std::vector<std::string>& words)
{
  if (words.empty())
  {
    throw dgtk::UsageError("a command is missing (see dgtk --help)");
  }
  if (words[0] == "--help" || words[0] == "-h" || words[0] == "help")
  {
    print(overview());
    return 0;
  }
  if (words[0] == "--version")
  {
    print("dgtk " DGTK_VERSION "\n");
    return 0;
  }
  const std::vector<CommandRow>& all = commandRows();
  const auto row = std::find_if(all.begin(), all.end(), [&](const CommandRow& one) { return one.name == words[0]; });
  if (row == all.end())
  {
    std::vector<std::string> names;
    std::transform(all.begin(), all.end(), std::back_inserter(names), [](const CommandRow& one) { return one.name; });
    const std::string near = dgtk::nearest(words[0], names);
    throw dgtk::UsageError("unknown command " + dgtk::quoted(words[0]) +
                           (near.empty() ? "" : ", did you mean " + near + "?") + " (see dgtk --help)");
  }
  const Command command = commandOf(*row);
  const Arguments arguments(command, { words.begin() + 1, words.end() });
  if (arguments.has("--help"))
  {
    print(helpPage(command));
    return 0;
  }
  const auto isSwitch = [](const Option& option) { return option.name == noCacheOption.name; };
  if (std::any_of(command.options.begin(), command.options.end(), isSwitch) && !arguments.has(noCacheOption.name))
  {
    dgtk::ModelCache::use(dgtk::ModelCache::ofUser());
  }
  return command.run(arguments);
}
} // namespace

const std::vector<CommandRow>& dgtk::app::commandRows()
{
  static const std::vector<CommandRow> rows{
    { "render", &renderCommand,
      "Renders images and ground truth of a scene, or of all scenes of a folder, into a folder." },
    { "sample", &sampleCommand, "Draws plain scenes from one with random values." },
    { "merge", &mergeCommand,
      "Makes one dataset, or export, of a run in shards; names what is missing and exits with 1 then." },
    { "export", &exportCommand, "Writes a dataset in the format of other people's tools." },
    { "info", &infoCommand, "Tells what a scene, a model or a dataset holds." },
    { "convert", &convertCommand,
      "Converts a scene between .scene and .json, and a scene or model to a POV-Ray scene .pov." },
    { "verify", &verifyCommand,
      "Derives anew what a dataset or a folder of samples claims, prints residuals; exits with 1 on a breach." },
    { "correspond", &correspondCommand,
      "Finds where image points of one view are in another, and whether they are seen there." },
    { "compare", &compareCommand, "Compares two images or two datasets; exits with 1 if they differ." },
    { "warp", &warpCommand, "Renders a novel view from a layered depth image of a dataset." },
    { "report", &reportCommand,
      "One page, for any browser and without a network, that shows what is in a dataset or in a folder of datasets." },
    { "list", &listCommand, "Lists what this program can read, derive and write." }
  };
  return rows;
}

Command dgtk::app::commandOf(const CommandRow& row)
{
  Command command = row.make();
  command.name = row.name;
  command.help = row.help;
  return command;
}

void dgtk::app::print(const std::string& text)
{
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
  {
    throw MachineError(std::string("standard output cannot be written: ") + std::strerror(errno));
  }
}

namespace
{
char** processArguments = nullptr;
}

void dgtk::app::prepareGL(const std::string& backend, int threads)
{
  renderGL().prepareProcess(renderGL().glBackendFromName(backend), processArguments, threads);
}

int main(int argc, char** argv)
{
  processArguments = argv;
  dgtk::holdStandardStreams();
  dgtk::prepareHeap();
  ::signal(SIGXFSZ, SIG_IGN); // a file beyond the limit of `ulimit -f` is an error of writing, also in helpers
  try
  {
    return dispatch({ argv + 1, argv + argc });
  }
  catch (const dgtk::Error& error)
  {
    std::fprintf(stderr, "dgtk: %s\n", error.what());
    return static_cast<int>(error.code());
  }
  catch (const std::bad_alloc&)
  {
    std::fprintf(stderr, "dgtk: the memory of this machine is not enough\n");
  }
  catch (const std::filesystem::filesystem_error& error)
  {
    const std::string path = dgtk::printable(error.path1().string());
    std::fprintf(stderr, "dgtk: %s: %s\n", path.c_str(), error.code().message().c_str());
  }
  catch (const std::system_error& error)
  {
    std::fprintf(stderr, "dgtk: the system refuses: %s\n", error.code().message().c_str());
  }
  catch (const std::exception&)
  {
    std::fprintf(stderr, "dgtk: failed in a way that it does not know; please report the command\n");
  }
  return static_cast<int>(dgtk::ExitCode::Machine);
}
