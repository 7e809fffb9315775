// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkFolderContents.h"
#include "dgtkModelReader.h"
#include "dgtkNamedFile.h"
#include "dgtkPovExport.h"
#include "dgtkStage.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace dgtk::app
{

namespace
{
bool isScene(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == "scene" || extension == "json";
}

void warn(const std::string& line) { std::cerr << "dgtk: warning: " << printable(line) << '\n'; }

std::size_t cameraOf(const Stage& stage, const Arguments& arguments)
{
  const std::vector<std::string> names = stage.cameraNames();
  if (names.empty())
  {
    throw InputError(stage.description().title(), "has no camera", "one for the POV-Ray scene");
  }
  if (!arguments.has("--camera"))
  {
    return 0;
  }
  const std::string name = arguments.text("--camera");
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
  {
    const std::string near = nearest(name, names);
    throw UsageError("--camera: the scene has no camera " + quoted(name) +
                     (near.empty() ? "" : ", did you mean " + quoted(near) + '?'));
  }
  return static_cast<std::size_t>(found - names.begin());
}

PovResult sceneToPov(const std::string& from, const std::string& to, const Arguments& arguments)
{
  const auto stage = Stage::load(readScene(from), warn);
  const std::size_t camera = cameraOf(*stage, arguments);
  const SceneDescription& scene = stage->description();
  const int frame =
    arguments.has("--frame") ? arguments.integer("--frame", scene.firstFrame(), scene.lastFrame()) : scene.firstFrame();
  PovOptions options;
  options.flatIds = arguments.has("--flat-ids");
  options.shadows = arguments.has("--shadows");
  options.inputs = stage->inputFiles();
  return exportPov(*stage->at(frame), stage->view(camera, frame), to, options);
}

PovResult modelToPov(const std::string& from, const std::string& to)
{
  const std::shared_ptr<const Model> model = readModel(from);
  for (const std::string& warning : model->warnings)
  {
    warn(warning);
  }
  return exportPov(model, to);
}

int runConvert(const Arguments& arguments)
{
  const std::string& from = arguments.positional()[0];
  const std::string& to = arguments.positional()[1];
  const bool pov = lower(std::filesystem::path(to).extension().string()) == ".pov";
  for (const char* const option : { "--camera", "--frame", "--flat-ids", "--shadows" })
  {
    if (arguments.has(option) && !(pov && isScene(from)))
    {
      throw UsageError(std::string(option) + " is for a scene that becomes .pov");
    }
  }
  if (!pov && !isScene(to))
  {
    throw UsageError("nothing can be converted to " + quoted(to) + " (expected a name in .scene, .json or .pov)");
  }
  requireOutsideDatasets(pov ? to : linkedPath(to));
  if (!pov)
  {
    const SceneDescription scene = readScene(from);
    refuseInPlaceOf({ from, scene.resolve(scene.classFile) }, to);
    writeScene(scene, to);
    return 0;
  }
  const PovResult result = isScene(from) ? sceneToPov(from, to, arguments) : modelToPov(from, to);
  for (const std::string& warning : result.warnings)
  {
    warn(warning);
  }
  return 0;
}
} // namespace

Command convertCommand()
{
  Command command{ "IN OUT", 2, 2, {}, &runConvert };
  command.options = { { "--camera", "NAME", "", "for .pov: the camera (default: the scene's first)" },
    { "--frame", "N", "", "for .pov: the frame (default: the scene's first)" },
    { "--flat-ids", "", "", "for .pov: every object in the colour of its id, without light" },
    { "--shadows", "", "", "for .pov: objects cast shadows" }, noCacheOption };
  return command;
}

} // namespace dgtk::app
