// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJournal.h"

#include "dgtkError.h"
#include "dgtkFile.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

constexpr const char* firstLine = "DGTk journal 1 ";
constexpr const char* sheetName = "contact.png";

std::string escaped(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    out += c == '\t' ? "\\t" : c == '\n' ? "\\n" : c == '\\' ? "\\\\" : std::string(1, c);
  }
  return out;
}

std::string unescaped(const std::string& text)
{
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const bool code = text[i] == '\\' && i + 1 < text.size();
    const char c = code ? text[++i] : text[i];
    out += !code ? c : c == 't' ? '\t' : c == 'n' ? '\n' : c;
  }
  return out;
}

std::string lineOf(const DatasetFile& file)
{
  return file.sha256 + '\t' + std::to_string(file.bytes) + '\t' + std::to_string(file.frame) + '\t' +
         escaped(file.layer) + '\t' + escaped(file.camera) + '\t' + escaped(file.path) + '\n';
}

bool parseLine(const std::string& line, DatasetFile& file)
{
  std::vector<std::string> fields(1);
  for (const char c : line)
  {
    if (c == '\t')
    {
      fields.emplace_back();
    }
    else
    {
      fields.back() += c;
    }
  }
  if (fields.size() != 6 || fields[0].size() != 64)
  {
    return false;
  }
  const auto number = [](const std::string& text, auto& value)
  {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
  };
  file.sha256 = fields[0];
  file.layer = unescaped(fields[3]);
  file.camera = unescaped(fields[4]);
  file.path = unescaped(fields[5]);
  return number(fields[1], file.bytes) && number(fields[2], file.frame);
}

/// What a folder records about itself.
struct Recorded
{
  bool any = false;
  std::string requestHash;
  std::vector<DatasetFile> files;
  std::vector<DatasetFile> whole; ///< those of a manifest
};

Recorded readJournal(const std::string& path)
{
  const std::string text = readFile(path);
  Recorded recorded;
  recorded.any = true;
  std::size_t start = 0;
  for (std::size_t end; (end = text.find('\n', start)) != std::string::npos; start = end + 1)
  {
    const std::string line = text.substr(start, end - start);
    DatasetFile file;
    if (start == 0 && line.rfind(firstLine, 0) == 0)
    {
      recorded.requestHash = line.substr(std::strlen(firstLine));
    }
    else if (start == 0 || !parseLine(line, file))
    {
      break;
    }
    else
    {
      recorded.files.push_back(file);
    }
  }
  return recorded;
}

Recorded readRecords(const fs::path& folder)
{
  std::error_code code;
  Recorded recorded;
  if (fs::exists(folder / journalName, code))
  {
    recorded = readJournal(folder / journalName);
  }
  if (fs::exists(folder / manifestName, code))
  {
    Manifest manifest;
    try
    {
      manifest = readManifest(folder / manifestName);
    }
    catch (const InputError& error)
    {
      throw UsageError(
        folder.string() + ": holds a manifest that is not DGTk's; choose another folder (" + error.what() + ")");
    }
    recorded.whole = manifest.files;
    if (!recorded.any)
    {
      recorded = { true, manifest.requestHash, manifest.files, manifest.files };
    }
  }
  return recorded;
}

/// Below the folder, by name: a list of files is not trusted to stay inside.
bool staysInside(const std::string& path)
{
  const fs::path relative(path);
  if (path.empty() || relative.is_absolute())
  {
    return false;
  }
  for (const fs::path& part : relative)
  {
    if (part == ".." || part == "." || part.empty())
    {
      return false;
    }
  }
  return true;
}

/// Removes recorded files and the folders that they leave empty.
void removeFiles(const fs::path& folder, const std::vector<DatasetFile>& files)
{
  std::error_code ignored;
  for (const DatasetFile& file : files)
  {
    if (staysInside(file.path) && !fs::is_directory(folder / file.path, ignored))
    {
      fs::remove(folder / file.path, ignored);
      for (fs::path up = fs::path(file.path).parent_path(); !up.empty(); up = up.parent_path())
      {
        fs::remove(folder / up, ignored); // fails, as wanted, when it is not empty
      }
    }
  }
}

void removeHalfWritten(const fs::path& folder)
{
  std::error_code code;
  std::vector<fs::path> found;
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
  {
    if (it->path().extension() == ".partial" && it->is_regular_file(code))
    {
      found.push_back(it->path());
    }
  }
  for (const fs::path& path : found)
  {
    fs::remove(path, code);
  }
}

bool isEmpty(const fs::path& folder)
{
  std::error_code code;
  const bool empty = fs::is_empty(folder, code);
  if (code)
  {
    throw MachineError(folder.string() + ": the folder cannot be read: " + code.message());
  }
  return empty;
}
} // namespace

struct Journal::Impl
{
  std::string folder;
  std::string path;
  int descriptor = -1;
  std::mutex mutex;
  std::vector<DatasetFile> finished;
  std::map<std::string, std::size_t> byPath;

  ~Impl()
  {
    if (this->descriptor >= 0)
    {
      ::close(this->descriptor);
    }
  }

  [[noreturn]] void fail() const { throw MachineError(this->path + ": cannot be written: " + std::strerror(errno)); }

  void append(const std::string& text)
  {
    // one write a line: a crash leaves whole lines and at most one torn one
    for (std::size_t done = 0; done < text.size();)
    {
      const ssize_t n = ::write(this->descriptor, text.data() + done, text.size() - done);
      if (n < 0 && errno != EINTR)
      {
        this->fail();
      }
      done += n > 0 ? static_cast<std::size_t>(n) : 0;
    }
  }

  /// One run at a time in a folder; the system lets go of the lock when the process ends, however it ends.
  void lock()
  {
    this->descriptor = ::open(this->path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (this->descriptor < 0)
    {
      this->fail();
    }
    if (::flock(this->descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    {
      throw UsageError(this->folder + ": another run is writing into this folder");
    }
  }

  void takeOver(const std::vector<DatasetFile>& files)
  {
    for (const DatasetFile& file : files)
    {
      std::error_code code;
      const fs::path whole = fs::path(this->folder) / file.path;
      const bool there =
        staysInside(file.path) && fs::is_regular_file(whole, code) && fs::file_size(whole, code) == file.bytes && !code;
      if (there && this->byPath.emplace(file.path, this->finished.size()).second)
      {
        this->finished.push_back(file);
      }
    }
  }
};

Journal::Journal(const std::string& folder, const std::string& requestHash, bool resume)
  : Self(new Impl)
{
  makeFolders(folder);
  this->Self->folder = folder;
  this->Self->path = (fs::path(folder) / journalName).string();
  const bool empty = isEmpty(folder);
  const Recorded before = empty ? Recorded{} : readRecords(folder);
  if (!empty && !before.any)
  {
    throw UsageError(folder + ": holds files that are not a DGTk dataset; name a new or an empty folder");
  }
  const bool same = before.any && before.requestHash == requestHash;
  if (resume && before.any && !same)
  {
    throw UsageError(folder + ": holds a run of another request, which cannot be resumed; "
                              "run without --resume to replace it, or name another folder");
  }
  this->Self->lock();
  removeHalfWritten(folder);
  std::error_code ignored;
  if (resume && same)
  {
    this->Self->takeOver(before.files);
  }
  else
  {
    removeFiles(folder, before.files);
    removeFiles(folder, before.whole);
    fs::remove(fs::path(folder) / sheetName, ignored);
  }
  std::string text = firstLine + requestHash + '\n';
  for (const DatasetFile& file : this->Self->finished)
  {
    text += lineOf(file);
  }
  if (::ftruncate(this->Self->descriptor, 0) != 0)
  {
    this->Self->fail();
  }
  this->Self->append(text);
  fs::remove(fs::path(folder) / manifestName, ignored);
}

Journal::~Journal() = default;

const std::vector<DatasetFile>& Journal::finished() const { return this->Self->finished; }

const DatasetFile* Journal::find(const std::string& path) const
{
  const auto found = this->Self->byPath.find(path);
  return found == this->Self->byPath.end() ? nullptr : &this->Self->finished[found->second];
}

void Journal::add(const DatasetFile& file)
{
  const std::lock_guard<std::mutex> guard(this->Self->mutex);
  this->Self->append(lineOf(file));
}

void Journal::close(const Manifest& manifest)
{
  writeFile((fs::path(this->Self->folder) / manifestName).string(), manifestText(manifest));
  std::error_code ignored;
  fs::remove(this->Self->path, ignored);
}

} // namespace dgtk
