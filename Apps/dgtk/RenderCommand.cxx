// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"
#include "Progress.h"

#include "dgtkError.h"
#include "dgtkGenerator.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <cstdio>

#include <signal.h>
#include <sys/resource.h>

namespace dgtk::app
{

namespace
{
constexpr int largestImage = 1 << 20;
std::atomic<bool> interrupted{ false };

void onInterrupt(int signal)
{
  interrupted = true;
  ::signal(signal, SIG_DFL); // a second one ends the program at once
}

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

FrameRange parseFrames(const std::string& text)
{
  constexpr int most = 1 << 30;
  std::vector<int> numbers;
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t colon = std::min(text.find(':', begin), text.size());
    numbers.push_back(parseInteger(text.substr(begin, colon - begin), "--frames", -most, most));
    begin = colon + 1;
  }
  if (numbers.size() > 3)
  {
    throw UsageError("--frames: expected A[:B[:STEP]], found " + quoted(text));
  }
  FrameRange range;
  range.first = numbers[0];
  range.last = numbers.size() > 1 ? numbers[1] : numbers[0];
  range.step = numbers.size() > 2 ? numbers[2] : 1;
  if (range.last < range.first || range.step < 1)
  {
    throw UsageError("--frames: expected A <= B and STEP >= 1, found " + quoted(text));
  }
  return range;
}

std::string oneOf(const Arguments& arguments, const std::string& option, const std::vector<std::string>& allowed)
{
  std::string value = arguments.text(option);
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end())
  {
    std::string names;
    for (const std::string& name : allowed)
    {
      names += (names.empty() ? "" : ", ") + name;
    }
    throw UsageError(option + ": expected one of " + names + ", found " + quoted(value));
  }
  return value;
}

constexpr double largestNumber = 1e30;

// As many numbers as `names` says, all above `least`.
std::vector<double> numbers(
  const Arguments& arguments, const std::string& option, std::size_t count, double least, const std::string& names)
{
  std::vector<double> values;
  for (const std::string& word : arguments.list(option))
  {
    double value = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = code == std::errc() && end == word.data() + word.size();
    values.push_back(whole && value > least && value < largestNumber ? value : NAN);
  }
  if (values.size() != count ||
      std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); }))
  {
    throw UsageError(option + ": expected " + names + ", found " + quoted(arguments.text(option)));
  }
  return values;
}

std::array<double, 6> parseBox(const Arguments& arguments, const std::string& option)
{
  const std::vector<double> values = numbers(arguments, option, 6, -largestNumber, "X0,Y0,Z0,X1,Y1,Z1");
  std::array<double, 6> box{};
  std::copy(values.begin(), values.end(), box.begin());
  if (!(box[0] < box[3] && box[1] < box[4] && box[2] < box[5]))
  {
    throw UsageError(option + ": the first corner of the box must be below the second");
  }
  return box;
}

// What POV-Ray shall show. The options mean nothing when it does not draw and no scene is written for it.
PovRenderOptions parsePov(const Arguments& arguments, const GeneratorRequest& request)
{
  PovRenderOptions pov;
  pov.shadows = arguments.has("--pov-shadows");
  pov.areaLights = arguments.has("--pov-area-lights") ? arguments.integer("--pov-area-lights", 2, 64) : 0;
  pov.reflections = arguments.has("--pov-reflections");
  pov.radiosity = arguments.has("--pov-radiosity");
  pov.antialias = arguments.has("--pov-antialias") ? arguments.integer("--pov-antialias", 1, 9) : 0;
  if (arguments.has("--pov-focal-blur"))
  {
    const std::vector<double> lens = numbers(arguments, "--pov-focal-blur", 2, 0, "APERTURE,DISTANCE, both above 0");
    pov.aperture = lens[0];
    pov.focus = lens[1];
  }
  pov.flatIds = arguments.has("--pov-flat-ids");
  if (arguments.has("--pov-position-colors"))
  {
    pov.positionColors = parseBox(arguments, "--pov-position-colors");
  }
  if (pov.flatIds && pov.positionColors)
  {
    throw UsageError("--pov-flat-ids and --pov-position-colors exclude one another");
  }
  const auto& layers = request.layers;
  const bool scenes = std::any_of(
    layers.begin(), layers.end(), [](const std::string& layer) { return layer == "pov" || layer == "all"; });
  if (request.renderer != "povray" && !scenes && !pov.describe().empty())
  {
    throw UsageError("--pov-... options are for --renderer povray or the layer pov");
  }
  return pov;
}

// --depth-format npy,dgd and the like: one option a layer that can be written in more than one way.
std::string formatOption(const LayerInfo& layer) { return "--" + layer.layer + "-format"; }

GeneratorRequest parseRequest(const Arguments& arguments)
{
  GeneratorRequest request;
  request.scene = arguments.positional()[0];
  request.folder = arguments.text("--output");
  if (request.folder.empty())
  {
    throw UsageError("render needs a folder for the dataset: -o DIR");
  }
  request.layers = arguments.list("--layers");
  request.cameras = arguments.list("--cameras");
  if (arguments.has("--frames"))
  {
    request.frames = parseFrames(arguments.text("--frames"));
  }
  if (arguments.has("--size"))
  {
    arguments.size("--size", largestImage, request.width, request.height);
  }
  arguments.size("--tile", largestImage, request.tileWidth, request.tileHeight);
  request.samples = arguments.integer("--samples", 1, 16);
  request.filter = oneOf(arguments, "--filter", { "box", "triangle", "gaussian", "mitchell", "lanczos" });
  oneOf(arguments, "--color-bits", { "8", "16" });
  request.colorBits = arguments.integer("--color-bits", 8, 16);
  request.renderer = oneOf(arguments, "--renderer", { "vtk", "povray" });
  request.pov = parsePov(arguments, request);
  request.visibility = oneOf(arguments, "--visibility", { "auto", "raster", "ray" });
  request.gl = oneOf(arguments, "--gl", { "auto", "egl", "osmesa", "glx" });
  request.threads = arguments.integer("--threads", 0, 256);
  if (arguments.has("--pairs"))
  {
    request.pairs = arguments.list("--pairs");
  }
  if (arguments.has("--matte"))
  {
    request.matte = arguments.list("--matte");
  }
  request.pointsStep = arguments.integer("--points-step", 1, largestImage);
  request.seed = arguments.integer("--seed", 0, 2147483647);
  request.resume = arguments.has("--resume");
  request.replace = arguments.has("--replace");
  if (request.resume && request.replace)
  {
    throw UsageError("--resume and --replace exclude one another");
  }
  request.pack = arguments.has("--pack");
  request.contactSheet = arguments.has("--contact-sheet");
  for (const LayerInfo& layer : generatorLayers())
  {
    if (layer.formats.size() > 1 && arguments.has(formatOption(layer)))
    {
      request.formats[layer.layer] = arguments.list(formatOption(layer));
    }
  }
  return request;
}

// What may be done about a folder that is refused.
std::string wayOut(FolderContents contents)
{
  switch (contents)
  {
    case FolderContents::Unfinished:
      return "; --resume completes it, --replace starts over";
    case FolderContents::FinishedOther:
    case FolderContents::UnfinishedOther:
      return "; --replace removes it, or name another folder";
    default:
      return "";
  }
}

/// A refusal that begins with the name of what was asked for ("points_step: ..."), with that of its option.
std::string withOption(const std::string& line)
{
  std::string option = "--" + line.substr(0, line.find(": "));
  std::replace(option.begin(), option.end(), '_', '-');
  const std::vector<Option> options = renderCommand().options;
  const bool known =
    std::any_of(options.begin(), options.end(), [&](const Option& other) { return other.name == option; });
  return known ? option + line.substr(option.size() - 2) : line;
}

GeneratorResult generated(const GeneratorRequest& request, const GeneratorCallbacks& callbacks)
{
  try
  {
    return generate(request, callbacks);
  }
  catch (const FolderError& error)
  {
    throw UsageError(error.what() + wayOut(error.contents()));
  }
  catch (const UsageError& error)
  {
    throw UsageError(withOption(error.what()));
  }
}

int run(const Arguments& arguments)
{
  const GeneratorRequest request = parseRequest(arguments);
  prepareGL(request.gl, request.threads);
  allowManyFiles();
  struct sigaction action = {};
  action.sa_handler = &onInterrupt;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);

  Progress progress(arguments.has("--quiet"));
  GeneratorCallbacks callbacks;
  callbacks.cancel = &interrupted;
  callbacks.progress = [&](const GeneratorProgress& state) { progress.update(state.done, state.total); };
  callbacks.message = [&](const std::string& line) { progress.message(line); };
  const GeneratorResult result = generated(request, callbacks);
  if (result.interrupted)
  {
    throw MachineError("interrupted; the same command with --resume completes " + request.folder);
  }
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.1f s", progress.seconds());
  progress.message(std::to_string(result.pictures) + " pictures, " + std::to_string(result.files) + " files in " +
                   request.folder + ", " + seconds);
  return 0;
}
} // namespace

Command renderCommand()
{
  Command command{ "render", "SCENE", 1, 1, "Renders images and ground truth of a scene into a folder.", {}, &run };
  command.options = { { "--output", "DIR", "", "folder of the dataset" },
    { "--layers", "NAMES|all", "color,depth,objects,calibration", "what to write; see dgtk list layers" },
    { "--cameras", "NAMES", "", "some of the cameras (default: all)" },
    { "--frames", "A[:B[:STEP]]", "", "some of the frames (default: all)" },
    { "--size", "WxH", "", "size of the images in pixels (default: the camera's own, else 640x480)" },
    { "--tile", "WxH", "640x480", "size of the images of the tiles layer" },
    { "--pairs", "A:B,...", "",
      "camera pairs of the correspondence layer; A:B+1 one frame later (default: all pairs)" },
    { "--matte", "NAMES", "", "objects of the matting layer" },
    { "--points-step", "N", "4", "pixels between the samples of the points layer" },
    { "--samples", "N", "1", "N x N points a pixel: colour is their mean; alpha, coverage and matting count them" },
    { "--filter", "NAME", "box", "how samples become a pixel's colour: box, triangle, gaussian, mitchell, lanczos" },
    { "--color-bits", "8|16", "8", "bits a channel of colour PNG files" },
    { "--renderer", "vtk|povray", "vtk", "what draws colour; POV-Ray 3.7 must be installed" },
    { "--pov-shadows", "", "", "POV-Ray: objects cast shadows" },
    { "--pov-area-lights", "N", "", "POV-Ray: soft shadows, lights of N x N points" },
    { "--pov-reflections", "", "", "POV-Ray: shiny materials reflect" },
    { "--pov-radiosity", "", "", "POV-Ray: light between surfaces in place of ambient light" },
    { "--pov-focal-blur", "APERTURE,DISTANCE", "", "POV-Ray: diameter of the lens, distance in focus, scene units" },
    { "--pov-flat-ids", "", "", "POV-Ray: every object in the colour of its id, without light" },
    { "--pov-position-colors", "X0,Y0,Z0,X1,Y1,Z1", "", "POV-Ray: surfaces in the colour of their place in that box" },
    { "--pov-antialias", "N", "", "POV-Ray: N x N points a pixel (default: that of --samples)" } };
  for (const LayerInfo& layer : generatorLayers())
  {
    if (layer.formats.size() > 1)
    {
      std::string formats;
      for (const std::string& format : layer.formats)
      {
        formats += (formats.empty() ? "" : ",") + format;
      }
      command.options.push_back(
        { formatOption(layer), "NAMES", layer.formats.front(), "files of the layer, of " + formats });
    }
  }
  const std::vector<Option> last = {
    { "--visibility", "auto|raster|ray", "auto", "engine of the ids: OpenGL or Embree; auto is Embree" },
    { "--gl", "auto|egl|osmesa|glx", "auto", "way to OpenGL" },
    { "--threads", "N", "0", "threads; 0: as many as the machine has cores" },
    { "--resume", "", "", "continue an interrupted run of the same request" },
    { "--replace", "", "", "remove the dataset of another request, or an interrupted run, that the folder holds" },
    { "--seed", "N", "0", "seed of random numbers" },
    { "--pack", "", "", "copy scene, models and textures into DIR/inputs, so that DIR can be moved" },
    { "--contact-sheet", "", "", "also write DIR/contact.png: cameras and frames by layer" },
    { "--quiet", "", "", "no progress and no messages (environment DGTK_PROGRESS: seconds between its lines, else 5)" }
  };
  command.options.insert(command.options.end(), last.begin(), last.end());
  return command;
}

} // namespace dgtk::app
