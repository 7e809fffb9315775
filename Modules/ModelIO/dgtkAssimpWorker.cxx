// SPDX-License-Identifier: BSD-3-Clause
// dgtk-import FILE FORMAT: reads a model with Assimp and writes it to standard output (dgtkAssimpStream.h). A program
// of its own, so that an assertion, an endless loop or a flood of memory in an importer ends here.
#include "dgtkAssimpConvert.h"
#include "dgtkAssimpGltf.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include <sys/resource.h>

namespace
{
namespace fs = std::filesystem;
using dgtk::import::Scene;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool limitMemory = false; // the sanitizers reserve terabytes of addresses
#else
constexpr bool limitMemory = true;
#endif
constexpr std::uint64_t memoryBase = std::uint64_t(512) << 20;
constexpr std::uint64_t memoryPerByte = 10;
constexpr rlim_t seconds = 60;
constexpr std::uint64_t largestFile = std::uint64_t(1) << 32;

void limit(int what, rlim_t value)
{
  rlimit now{};
  if (getrlimit(static_cast<__rlimit_resource>(what), &now) == 0)
  {
    now.rlim_cur = std::min(value, now.rlim_max);
    setrlimit(static_cast<__rlimit_resource>(what), &now);
  }
}

std::string lower(std::string text)
{
  std::transform(
    text.begin(), text.end(), text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return text;
}

/// Opens regular files only, finds names as textures are found (as written, beside the model, in any case), and lets
/// memory grow with what was read.
class Files : public Assimp::DefaultIOSystem
{
public:
  explicit Files(const std::string& model)
    : Folder(fs::path(model).parent_path())
  {
  }
  bool Exists(const char* name) const override { return !this->locate(name).empty(); }
  Assimp::IOStream* Open(const char* name, const char* mode) override
  {
    const std::string path = mode && mode[0] == 'r' ? this->locate(name) : std::string();
    if (path.empty())
    {
      this->Missing.insert(name);
      return nullptr;
    }
    std::error_code code;
    const std::uint64_t bytes = fs::file_size(path, code);
    if (code || bytes > largestFile)
    {
      return nullptr;
    }
    if (this->Seen.insert(path).second)
    {
      this->Bytes += bytes;
      if (limitMemory)
      {
        limit(RLIMIT_AS, memoryBase + memoryPerByte * this->Bytes);
      }
    }
    return Assimp::DefaultIOSystem::Open(path.c_str(), mode);
  }

  std::uint64_t Bytes = 0;
  std::set<std::string> Missing;

private:
  std::string locate(const std::string& written) const
  {
    std::string name = written;
    std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path path(name);
    std::error_code code;
    for (const fs::path& candidate : { path, this->Folder / path, this->Folder / path.filename() })
    {
      if (fs::is_regular_file(candidate, code))
      {
        return candidate.string();
      }
    }
    const std::string wanted = lower(path.filename().string());
    std::string found;
    const fs::path folder = this->Folder.empty() ? fs::path(".") : this->Folder;
    for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
    {
      const std::string other = it->path().filename().string();
      if (lower(other) == wanted && fs::is_regular_file(it->path(), code) && (found.empty() || other < found))
      {
        found = other;
      }
    }
    return found.empty() ? found : (folder / found).string();
  }

  fs::path Folder;
  std::set<std::string> Seen;
};

/// `<unit meter="..."/>` of a Collada file; the importer scales by it.
double colladaUnit(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::string text(65536, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  const std::size_t unit = text.find("<unit");
  const std::size_t end = unit == std::string::npos ? unit : text.find('>', unit);
  const std::size_t meter = end == std::string::npos ? end : text.find("meter=", unit);
  double value = 1;
  if (meter < end && meter + 7 < text.size())
  {
    std::from_chars(text.data() + meter + 7, text.data() + end, value);
  }
  return value > 0 && value < 1e30 ? value : 1;
}

void read(const std::string& path, const std::string& format, Scene& scene)
{
  Assimp::Importer importer;
  auto* files = new Files(path); // the importer owns it
  importer.SetIOHandler(files);
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, 1);
  const aiScene* found = importer.ReadFile(path, aiProcess_TransformUVCoords);
  scene.bytesRead = files->Bytes;
  if (!found)
  {
    scene.error = importer.GetErrorString();
    scene.error = scene.error.empty() ? "cannot be read" : scene.error;
    return;
  }
  for (const std::string& name : files->Missing)
  {
    scene.warnings.push_back("file " + name.substr(0, 200) + " not found");
  }
  dgtk::import::convert(*found, format == "gltf", format == "collada" ? colladaUnit(path) : 1, scene);
  if (format == "gltf")
  {
    dgtk::import::repairGltf(path, scene);
  }
}

bool send(Scene& scene)
{
  bool good = true;
  const auto put = [&good](const void* data, std::size_t bytes)
  { good = good && (bytes == 0 || std::fwrite(data, 1, bytes, stdout) == bytes); };
  dgtk::import::StreamWriter<decltype(put)> writer(put);
  io(writer, scene);
  return std::fflush(stdout) == 0 && good;
}
} // namespace

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::fputs("dgtk-import is a part of DGTk: it reads one model for the library\n", stderr);
    return 2;
  }
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, seconds);
  if (limitMemory)
  {
    limit(RLIMIT_AS, memoryBase);
  }
  Scene scene;
  try
  {
    read(argv[1], argv[2], scene);
  }
  catch (const std::bad_alloc&)
  {
    scene = {};
    scene.error = "needs more memory than a file of its size may";
  }
  catch (const std::exception& error)
  {
    scene = {};
    scene.error = error.what();
  }
  return send(scene) ? 0 : 1;
}
