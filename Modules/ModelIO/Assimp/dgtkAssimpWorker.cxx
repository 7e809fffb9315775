// SPDX-License-Identifier: BSD-3-Clause
// dgtk-import: reads models with Assimp, each in a copy of the process that the library has started, and writes it
// through a pipe (dgtkAssimpStream.h). A program of its own, so that an assertion, an endless loop or a flood of memory
// in an importer ends here, with that one model. It opens no file: it asks the library for each (dgtkImportProtocol.h).
#include "dgtkAssimpConvert.h"
#include "dgtkAssimpGltf.h"
#include "dgtkColladaText.h"
#include "dgtkFbxImport.h"
#include "dgtkHelperChannel.h"
#include "dgtkHelperWall.h"
#include "dgtkImportProtocol.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/IOStream.hpp>
#include <assimp/Importer.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/stat.h>
#include <sys/wait.h>

namespace
{
using dgtk::helper::Descriptor;
using dgtk::helper::Descriptors;
using dgtk::helper::limitTo;
using dgtk::import::ModelRequest;
using dgtk::import::Question;
using dgtk::import::Scene;

constexpr int channel = 0;
constexpr std::uint64_t workerBase = std::uint64_t(512) << 20;
constexpr std::uint64_t workerPerByte = 10;
constexpr std::uint64_t seconds = 60;
/// Digits of the longest number: an importer's time grows with their square.
constexpr std::uint64_t mostDigits = 1000;
const char* const memoryError = "needs more memory than a file of its size may";

/// An open file that the library has handed over.
class File : public Assimp::IOStream
{
public:
  explicit File(Descriptor&& descriptor)
    : Stream(::fdopen(descriptor.release(), "rb"))
  {
  }
  ~File() override { std::fclose(this->Stream); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  std::size_t Read(void* to, std::size_t size, std::size_t count) override
  {
    return std::fread(to, size, count, this->Stream);
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override
  {
    const int whence = origin == aiOrigin_CUR ? SEEK_CUR : origin == aiOrigin_END ? SEEK_END : SEEK_SET;
    return std::fseek(this->Stream, static_cast<long>(offset), whence) == 0 ? aiReturn_SUCCESS : aiReturn_FAILURE;
  }
  std::size_t Tell() const override { return static_cast<std::size_t>(std::ftell(this->Stream)); }
  std::size_t FileSize() const override
  {
    struct stat status = {};
    return ::fstat(::fileno(this->Stream), &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
  }
  void Flush() override {}

private:
  std::FILE* Stream;
};

/// Line of the first number that is too long, in a text; 0 when there is none, or the file is no text.
std::uint64_t lineOfLongNumber(int file)
{
  std::vector<char> buffer(65536);
  std::uint64_t line = 1;
  std::uint64_t digits = 0;
  ssize_t got = 0;
  for (off_t at = 0; (got = ::pread(file, buffer.data(), buffer.size(), at)) > 0; at += got)
  {
    const char* const begin = buffer.data();
    const char* const end = begin + got;
    if (at == 0 && std::find(begin, end, '\0') != end)
    {
      return 0;
    }
    for (const char* c = begin; c != end; ++c)
    {
      digits = *c >= '0' && *c <= '9' ? digits + 1 : 0;
      if (digits > mostDigits)
      {
        return line;
      }
      line += *c == '\n' ? 1 : 0;
    }
  }
  return 0;
}

std::string bytesOf(Assimp::IOStream& file)
{
  std::string bytes(file.FileSize(), '\0');
  bytes.resize(file.Read(bytes.data(), 1, bytes.size()));
  return bytes;
}

/// The model's files, through the library; lets memory grow with what was read.
class Files : public Assimp::DefaultIOSystem
{
public:
  explicit Files(bool isCollada)
    : IsCollada(isCollada)
  {
  }

  bool Exists(const char* name) const override { return static_cast<bool>(ask(name).file); }
  Assimp::IOStream* Open(const char* name, const char* mode) override
  {
    Found found = mode && mode[0] == 'r' ? ask(name) : Found();
    if (!found.file)
    {
      this->Missing.insert(name);
      return nullptr;
    }
    const bool isNew = this->Seen.insert(found.path).second;
    const std::uint64_t line = isNew ? lineOfLongNumber(found.file.get()) : 0;
    if (line > 0 || !this->LongNumber.empty())
    {
      this->LongNumber = this->LongNumber.empty() ? found.path : this->LongNumber;
      this->Line = std::max(line, this->Line);
      return nullptr;
    }
    auto file = std::make_unique<File>(std::move(found.file));
    if (isNew)
    {
      this->Bytes += file->FileSize();
      if (!dgtk::helper::isSanitized)
      {
        limitTo(RLIMIT_AS, workerBase + workerPerByte * this->Bytes);
      }
    }
    if (this->IsCollada)
    {
      this->Collada = dgtk::import::colladaText(bytesOf(*file));
      return this->Collada.problem.empty() ? streamOf(std::exchange(this->Collada.text, {})) : nullptr;
    }
    return !this->Text.empty() && name == this->Replaced ? streamOf(this->Text) : file.release();
  }

  /// All of a file. Throws std::runtime_error.
  std::string contentsOf(const std::string& name)
  {
    const std::unique_ptr<Assimp::IOStream> file(this->Open(name.c_str(), "rb"));
    if (!file)
    {
      throw std::runtime_error("a buffer cannot be opened");
    }
    return bytesOf(*file);
  }

  std::uint64_t Bytes = 0;
  std::set<std::string> Missing;
  std::string Replaced;              ///< path of the file instead of which Text is handed out, unless that is ""
  std::string Text;                  ///< of Replaced
  std::string LongNumber;            ///< path of the file that has one, or ""
  std::uint64_t Line = 0;            ///< where it is
  dgtk::import::ColladaText Collada; ///< what was opened last, without the text

private:
  struct Found
  {
    Descriptor file = Descriptor();
    std::string path;
  };

  static Assimp::IOStream* streamOf(const std::string& text)
  {
    auto bytes = std::make_unique<std::uint8_t[]>(text.size());
    std::copy(text.begin(), text.end(), bytes.get());
    auto stream = std::make_unique<Assimp::MemoryIOStream>(bytes.get(), text.size(), true);
    bytes.release(); // the stream's own
    return stream.release();
  }

  static Found ask(const std::string& name)
  {
    Question request;
    dgtk::import::FileAnswer answer;
    Descriptors files;
    if (name.size() >= sizeof request.name)
    {
      return Found();
    }
    dgtk::helper::put(request.name, name.c_str());
    if (!dgtk::helper::send(channel, request) || !dgtk::helper::receive(channel, answer, files) || answer.found == 0)
    {
      return Found();
    }
    answer.path[sizeof answer.path - 1] = '\0';
    return { std::move(files[0]), answer.path };
  }

  bool IsCollada;
  std::set<std::string> Seen;
};

/// What the standard library says of memory and sizes, in words.
std::string inWords(const std::string& error)
{
  for (const char* text : { "std::bad_alloc", "bad allocation", "std::bad_array_new_length", "std::length_error",
         "vector::_M", "vector::reserve", "basic_string::_M", "basic_string::reserve" })
  {
    if (error.find(text) != std::string::npos)
    {
      return memoryError;
    }
  }
  if (error.find("No suitable reader found") != std::string::npos)
  {
    return "its importer finds nothing of that format in it";
  }
  return error.empty() ? "its importer says no more" : error;
}

/// Leaves no importer but those of an extension: Assimp tries all of them on a file that its own one does not take.
void keepImportersOf(const std::string& extension, Assimp::Importer& importer)
{
  std::string word = extension.substr(extension.empty() ? 0 : 1);
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;)
  {
    const std::string words = std::string(" ") + importer.GetImporterInfo(i)->mFileExtensions + ' ';
    if (words.find(' ' + word + ' ') == std::string::npos)
    {
      importer.UnregisterLoader(importer.GetImporter(i));
    }
  }
}

bool refuseLongNumber(const Files& files, Scene& scene)
{
  if (files.LongNumber.empty())
  {
    return false;
  }
  scene.error = "a number has more than " + std::to_string(mostDigits) + " digits";
  scene.errorFile = files.LongNumber;
  scene.errorLine = files.Line;
  return true;
}

void read(const std::string& path, const std::string& format, Scene& scene)
{
  if (format == "fbx")
  {
    Files own(false);
    const std::unique_ptr<Assimp::IOStream> file(own.Open(path.c_str(), "rb"));
    scene.bytesRead = own.Bytes;
    if (!refuseLongNumber(own, scene))
    {
      dgtk::import::readFbx(file ? bytesOf(*file) : throw std::runtime_error("cannot be opened"), scene);
    }
    return;
  }
  Assimp::Importer importer;
  keepImportersOf(std::filesystem::path(path).extension().string(), importer);
  auto* files = new Files(format == "collada"); // the importer owns it
  importer.SetIOHandler(files);
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, 1);
  const auto contents = [files](const std::string& name) { return files->contentsOf(name); };
  files->Replaced = path;
  files->Text = format == "gltf" ? dgtk::import::withoutHarm(path, contents) : std::string();
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const aiScene* found = importer.ReadFile(path, 0u);
  if (!found && format == "gltf" && files->LongNumber.empty())
  {
    files->Text = dgtk::import::inOrder(path, contents);
    found = files->Text.empty() ? found : importer.ReadFile(path, 0u);
  }
  std::string().swap(files->Text); // and its memory
  scene.bytesRead = files->Bytes;
  if (refuseLongNumber(*files, scene))
  {
    return;
  }
  if (!found)
  {
    const std::string problem = format == "gltf" ? dgtk::import::gltfProblem(path, contents) : files->Collada.problem;
    scene.error = problem.empty() ? inWords(importer.GetErrorString()) : problem;
    return;
  }
  for (const std::string& name : files->Missing)
  {
    scene.warnings.push_back("file " + name.substr(0, 200) + " not found");
  }
  scene.warnings.insert(scene.warnings.end(), files->Collada.warnings.begin(), files->Collada.warnings.end());
  dgtk::import::convert(*found, format == "gltf", scene);
  if (format == "collada")
  {
    dgtk::import::restoreNames(scene);
  }
  if (format == "gltf")
  {
    dgtk::import::repairGltf(path, contents, scene);
  }
}

bool send(Scene& scene)
{
  bool good = true;
  const auto put = [&good](const void* data, std::size_t bytes)
  { good = good && (bytes == 0 || std::fwrite(data, 1, bytes, stdout) == bytes); };
  dgtk::StreamWriter<decltype(put)> writer(put);
  io(writer, scene);
  return std::fflush(stdout) == 0 && good;
}

/// One model, behind the wall; its status.
int importOne(const ModelRequest& request)
{
  limitTo(RLIMIT_CPU, seconds);
  if (!dgtk::helper::isSanitized)
  {
    limitTo(RLIMIT_AS, workerBase);
  }
  dgtk::helper::lockDown(dgtk::helper::Opening::Nothing);
  Scene scene;
  try
  {
    read(request.path, request.format, scene);
  }
  catch (const std::bad_alloc&)
  {
    scene = {};
    scene.error = memoryError;
  }
  catch (const std::exception& error)
  {
    scene = {};
    scene.error = inWords(error.what());
  }
  return send(scene) ? 0 : 1;
}

/// Starts copies, and says how they ended.
class Server
{
public:
  Server()
  {
    sigset_t child;
    sigemptyset(&child);
    sigaddset(&child, SIGCHLD);
    ::sigprocmask(SIG_BLOCK, &child, &this->Before);
    this->Ends = Descriptor(::signalfd(-1, &child, SFD_CLOEXEC));
  }

  void run()
  {
    pollfd waits[2] = { { channel, POLLIN, 0 }, { this->Ends.get(), POLLIN, 0 } };
    bool wanted = true;
    while (wanted)
    {
      const int ready = ::poll(waits, 2, this->Channels.empty() ? idleMilliseconds : -1);
      if (ready > 0 && waits[1].revents != 0)
      {
        this->collect();
      }
      wanted = ready < 0 || (ready > 0 && (waits[0].revents == 0 || this->start()));
    }
  }

private:
  static constexpr int idleMilliseconds = 10000;

  /// False when nobody asks any more. The copies end with this process.
  bool start()
  {
    ModelRequest request;
    Descriptors files;
    if (!dgtk::helper::receive(channel, request, files))
    {
      return false;
    }
    request.path[sizeof request.path - 1] = '\0';
    request.format[sizeof request.format - 1] = '\0';
    const pid_t copy = ::fork();
    if (copy == 0)
    {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      ::sigprocmask(SIG_SETMASK, &this->Before, nullptr);
      ::dup2(files[0].get(), channel);
      ::dup2(files[1].get(), STDOUT_FILENO);
      files[0].reset();
      files[1].reset();
      this->Channels.clear();
      this->Ends.reset();
      ::_exit(importOne(request));
    }
    if (copy > 0)
    {
      this->Channels[copy] = std::move(files[0]);
    }
    else
    {
      sayEnd(files[0].get(), SIGKILL); // no memory for it
    }
    return true;
  }

  static void sayEnd(int to, int status)
  {
    Question last;
    last.hasEnded = 1;
    last.status = status;
    dgtk::helper::send(to, last);
  }

  void collect()
  {
    signalfd_siginfo ignored;
    int status = 0;
    if (::read(this->Ends.get(), &ignored, sizeof ignored) > 0)
    {
      for (pid_t copy = 0; (copy = ::waitpid(-1, &status, WNOHANG)) > 0;)
      {
        sayEnd(this->Channels[copy].get(), status);
        this->Channels.erase(copy);
      }
    }
  }

  sigset_t Before{};
  Descriptor Ends;
  std::map<pid_t, Descriptor> Channels;
};
} // namespace

int main()
{
  struct stat status = {};
  if (::fstat(channel, &status) != 0 || !S_ISSOCK(status.st_mode))
  {
    std::fputs("dgtk-import is a part of DGTk: it reads models for the library\n", stderr);
    return 2;
  }
  limitTo(RLIMIT_CORE, 0);
  Server().run();
}
