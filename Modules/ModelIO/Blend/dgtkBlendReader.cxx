// SPDX-License-Identifier: BSD-3-Clause
// Blender's own files are read by Blender, which says what it finds as glTF.
#include "dgtkAssimpModel.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHelperProcess.h"
#include "dgtkModelFolder.h"
#include "dgtkSystem.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include <sys/wait.h>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;
constexpr std::uint64_t memoryBase = std::uint64_t(8) << 30;
constexpr std::uint64_t memoryPerByte = 20;
constexpr std::uint64_t seconds = 600;

/// What Blender does with the file that it was started with: words behind "--" are the file, the model and a list of
/// the files that are named in it. In the file's own axes, with all modifiers, of what a render shows.
const char* const script = R"(
import bpy, os, sys
blend, model, files = sys.argv[sys.argv.index("--") + 1:]
assert bpy.data.filepath and os.path.samefile(bpy.data.filepath, blend)
bpy.ops.export_scene.gltf(filepath=model, export_format="GLB", export_yup=False, export_apply=True, use_renderable=True)
with open(files, "wb") as file:
    file.write(b"\n".join(os.fsencode(path) for path in bpy.utils.blend_paths(absolute=True)))
)";

/// Files of the model's folder, and of the one above it, that the file names and Blender could read if they are there;
/// relative to the model's folder.
std::vector<std::string> namedFiles(const std::string& path, const std::string& list)
{
  const fs::path folder = fs::absolute(path).lexically_normal().parent_path();
  std::set<std::string> names;
  std::istringstream lines(readFile(list));
  for (std::string line; std::getline(lines, line);)
  {
    if (isNamedBeneath(line, folder.parent_path().string()))
    {
      names.insert(fs::path(line).lexically_normal().lexically_relative(folder).generic_string());
    }
  }
  return { names.begin(), names.end() };
}

/// Says which files were read, and what the model depends on.
void nameFiles(const std::string& path, const std::string& list, ModelContents& contents)
{
  const std::string above = fs::absolute(path).parent_path().parent_path().string();
  contents.model->companions.clear();
  contents.dependencies.push_back({ ModelDependency::Kind::Program, "blender", "DGTK_BLENDER" });
  for (const std::string& name : namedFiles(path, list))
  {
    contents.dependencies.push_back({ ModelDependency::Kind::Beside, name, {} });
    const std::string file = (fs::path(path).parent_path() / name).lexically_normal().string();
    std::error_code code;
    if (fs::is_regular_file(file, code) && liesBeneath(file, above))
    {
      contents.model->companions.push_back(file);
    }
  }
  std::sort(contents.model->companions.begin(), contents.model->companions.end());
}

void runBlender(const std::string& path, const std::string& blender, ScratchFolder& own)
{
  const std::string file = fs::absolute(path).lexically_normal().string();
  const fs::path folder = fs::path(file).parent_path();
  std::error_code code;
  const fs::path program = fs::canonical(blender, code).parent_path();
  const std::uint64_t bytes = memoryBase + memoryPerByte * fs::file_size(file);
  helper::Process process(
    { helper::findProgram("dgtk-fence", "DGTK_FENCE"), std::to_string(bytes), std::to_string(seconds), own.path(),
      "/usr", "/lib", "/lib64", "/etc", "/proc", "/sys", program.string(), folder.parent_path().string(),
      folder.string(), "--", blender, "--background", "--factory-startup", "--disable-autoexec", "-noaudio", file,
      "--python-exit-code", "9", "--python-expr", script, "--", file, own.path("model.glb"), own.path("files") },
    -1);
  const int status = process.wait();
  const int signal = helper::signalOf(status, path);
  if (signal != 0 || WEXITSTATUS(status) != 0 || !fs::is_regular_file(own.path("model.glb"), code) ||
      !fs::is_regular_file(own.path("files"), code))
  {
    throw InputError(
      path, "cannot be read by Blender (" + blender + "), which ended with " +
              (signal != 0 ? helper::signalText(signal) : "code " + std::to_string(WEXITSTATUS(status))));
  }
}
} // namespace

ModelContents readBlend(const std::string& path, const ReadOptions& options);
ModelContents readBlend(const std::string& path, const ReadOptions& options)
{
  std::error_code code;
  if (!fs::is_regular_file(path, code))
  {
    throw InputError(path, fs::exists(path, code) ? "is not a regular file" : "no such file");
  }
  const std::string blender = helper::installedProgram("blender", "DGTK_BLENDER");
  if (blender.empty())
  {
    throw InputError(path,
      "Blender's own files are read by Blender, which is not installed: install it (DGTK_BLENDER can name it), or "
      "choose "
      "File > Export > glTF 2.0 in it and use the .glb file");
  }
  ScratchFolder own;
  runBlender(path, blender, own);
  ModelContents contents;
  try
  {
    contents = readThroughAssimp(own.path("model.glb"), "gltf", options);
  }
  catch (const InputError& error)
  {
    const std::string text = error.what();
    const std::size_t colon = text.find(": ");
    throw InputError(path, "what Blender makes of it " + text.substr(colon == std::string::npos ? 0 : colon + 2));
  }
  // Blender exports colours of vertices whether its materials use them or not
  std::vector<std::array<std::uint8_t, 4>>& colors = contents.model->colors;
  if (std::any_of(colors.begin(), colors.end(),
        [](const auto& c) { return c[0] < 255 || c[1] < 255 || c[2] < 255 || c[3] < 255; }))
  {
    contents.notes.push_back({ "colours of vertices are not drawn" });
  }
  colors.clear();
  contents.model->format = "blend";
  contents.model->isNumbered = false; // the numbers are those of what Blender exports
  contents.model->path = path;
  nameFiles(path, own.path("files"), contents);
  return contents;
}

} // namespace dgtk
