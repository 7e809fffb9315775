// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJournal.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkFolderRecords.h"
#include "dgtkHash.h"
#include "dgtkSystem.h"
#include "dgtkThreadPool.h"

#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

namespace dgtk
{

bool isWhole(const Folder& folder, const DatasetFile& file)
{
  if (folder.look(file.path) != EntryKind::File)
  {
    return false;
  }
  const std::string path = folder.pathOf(file.path);
  struct stat info = {};
  return ::stat(path.c_str(), &info) == 0 && std::uint64_t(info.st_size) == file.bytes &&
         Sha256::ofFile(path) == file.sha256;
}

namespace
{
void refuseIfNeeded(
  const std::string& folder, const FolderRecords& records, FolderContents contents, JournalStart start)
{
  switch (contents)
  {
    case FolderContents::Nothing:
    case FolderContents::Finished:
      return;
    case FolderContents::Unfinished:
      if (start == JournalStart::Fresh)
      {
        throw FolderError(folder, contents);
      }
      return;
    case FolderContents::FinishedOther:
    case FolderContents::UnfinishedOther:
      if (start != JournalStart::Replace)
      {
        throw FolderError(folder, contents, start == JournalStart::Resume ? ", which cannot be resumed" : "");
      }
      return;
    case FolderContents::Running:
      throw FolderError(folder, contents);
    case FolderContents::Foreign:
      throw FolderError(folder, contents,
        records.foreign.empty() ? "; name a new or an empty folder"
                                : "; name another folder (" + records.foreign + ")");
  }
}

[[noreturn]] void inTheWay(const Folder& folder, const std::string& name, const char* what)
{
  throw UsageError(folder.pathOf(name) + ": " + what + "; name another folder, or take it away");
}

/// A file of a run or of its predecessor is reached without links, and not a folder.
void checkFile(const Folder& folder, const std::string& name, EntryKind kind)
{
  if (kind == EntryKind::Blocked)
  {
    inTheWay(folder, name, "a link or a file stands where a folder of the dataset has to be");
  }
  if (kind == EntryKind::Folder)
  {
    inTheWay(folder, name, "a folder stands where a file of the dataset has to be");
  }
}

constexpr const char* nobodys = "is in the way, and no run has written it";

/// Before anything is changed.
void checkNames(const Folder& folder, const FolderRecords& before, const std::vector<std::string>& names)
{
  if (holdsNothing(folder.path()))
  {
    return;
  }
  std::set<std::string> all = before.names;
  all.insert(names.begin(), names.end());
  std::set<std::string> partial;
  for (const std::string& name : all)
  {
    partial.insert(partialName(name));
  }
  folder.look(all,
    [&](const std::string& name, EntryKind kind)
    {
      checkFile(folder, name, kind);
      if (kind != EntryKind::Nothing && before.names.count(name) == 0)
      {
        inTheWay(folder, name, nobodys);
      }
    });
  folder.look(partial, [&](const std::string& name, EntryKind kind) { checkFile(folder, name, kind); });
}

bool isSameFile(const FileDescriptor& a, const FileDescriptor& b)
{
  struct stat one = {};
  struct stat two = {};
  return ::fstat(a.number(), &one) == 0 && ::fstat(b.number(), &two) == 0 && one.st_dev == two.st_dev &&
         one.st_ino == two.st_ino;
}
} // namespace

struct Journal::Impl
{
  Folder folder;
  std::string document;
  FileDescriptor descriptor;
  std::mutex mutex;
  std::vector<DatasetFile> finished;
  std::map<std::string, std::size_t> byPath;
  std::set<std::string> before; ///< names that a run that is resumed has announced

  Impl(const std::string& path, const std::string& last)
    : folder(path)
    , document(last)
  {
  }

  [[noreturn]] void fail() const
  {
    throw MachineError(this->folder.pathOf(journalName) + ": cannot be written: " + std::strerror(errno));
  }

  void append(const std::string& text)
  {
    // one write a line: a crash leaves whole lines and at most one torn one
    if (!writeAll(this->descriptor.number(), text.data(), text.size()))
    {
      this->fail();
    }
  }

  bool isLocked(const FileDescriptor& file) const
  {
    return ::flock(file.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  }

  /// One run at a time in a folder; the system lets go of the lock when the process ends, however it ends.
  void lock()
  {
    FileDescriptor same;
    do
    {
      this->descriptor = this->folder.open(journalName, O_RDWR | O_CREAT | O_APPEND);
      if (!this->descriptor)
      {
        this->fail();
      }
      if (this->isLocked(this->descriptor))
      {
        throw FolderError(this->folder.path(), FolderContents::Running);
      }
      // not one that another run has just replaced or removed
      same = this->folder.open(journalName, O_RDONLY);
    } while (!same || !isSameFile(this->descriptor, same));
  }

  /// A new journal in place of the old one, at once and under the lock.
  void rewrite(const std::string& text)
  {
    const std::string partial = partialName(journalName);
    this->folder.remove(partial);
    FileDescriptor next = this->folder.open(partial, O_RDWR | O_CREAT | O_EXCL | O_APPEND);
    if (!next || this->isLocked(next) || !writeAll(next.number(), text.data(), text.size()))
    {
      this->fail();
    }
    this->folder.rename(partial, journalName);
    this->descriptor = std::move(next);
  }

  void takeOver(const FolderRecords& records)
  {
    // A crash of the machine may leave a file with its name and size, and without its contents.
    std::vector<char> whole(records.finished.size(), 0);
    ThreadPool pool(machineThreads());
    pool.parallelFor(static_cast<int>(whole.size()),
      [&](int i) { whole[std::size_t(i)] = isWhole(this->folder, records.finished[std::size_t(i)]) ? 1 : 0; });
    for (std::size_t i = 0; i < whole.size(); ++i)
    {
      const DatasetFile& file = records.finished[i];
      if (whole[i] && this->byPath.emplace(file.path, this->finished.size()).second)
      {
        this->finished.push_back(file);
      }
    }
    for (const std::string& name : records.names)
    {
      this->folder.remove(partialName(name));
    }
    this->before = records.names;
  }

  void removeFiles(const std::set<std::string>& names)
  {
    for (const std::string& name : names)
    {
      this->folder.remove(name);
      this->folder.remove(partialName(name));
      this->folder.removeEmptyParents(name);
    }
  }
};

namespace
{
std::string planOf(const std::set<std::string>& names)
{
  std::string text;
  for (const std::string& name : names)
  {
    text += journalPlan(name);
  }
  return text;
}
} // namespace

Journal::Journal(const std::string& path, const std::string& requestHash, JournalStart start,
  const std::vector<std::string>& names, const std::string& document)
  : Self(new Impl(path, document))
{
  makeFolders(path);
  const Folder& folder = this->Self->folder;
  if (isRunning(folder))
  {
    throw FolderError(path, FolderContents::Running);
  }
  // once without the lock, so that a refusal leaves no trace, and once with it
  FolderRecords before = readFolderRecords(folder, document);
  refuseIfNeeded(path, before, contentsOf(folder, before, requestHash), start);
  checkNames(folder, before, names);
  this->Self->lock();
  before = readFolderRecords(folder, document);
  const FolderContents contents = contentsOf(folder, before, requestHash);
  refuseIfNeeded(path, before, contents, start);
  const bool resumes = start == JournalStart::Resume && contents != FolderContents::Nothing;
  if (resumes)
  {
    this->Self->takeOver(before);
  }
  std::string text = journalFirstLine(requestHash) + planOf(before.names);
  for (const DatasetFile& file : this->Self->finished)
  {
    text += journalLine(file);
  }
  this->Self->rewrite(text);
  folder.remove(document);
  if (!resumes && !before.names.empty())
  {
    // killed in between, everything is in the journal still
    this->Self->removeFiles(before.names);
    this->Self->rewrite(journalFirstLine(requestHash));
  }
}

Journal::~Journal() = default;

const std::vector<DatasetFile>& Journal::finished() const { return this->Self->finished; }

const DatasetFile* Journal::find(const std::string& path) const
{
  const auto found = this->Self->byPath.find(path);
  return found == this->Self->byPath.end() ? nullptr : &this->Self->finished[found->second];
}

void Journal::plan(const std::vector<std::string>& names)
{
  std::string text;
  for (const std::string& name : names)
  {
    text += journalPlan(name);
  }
  const std::lock_guard<std::mutex> guard(this->Self->mutex);
  this->Self->append(text);
}

void Journal::planLate(const std::string& name)
{
  const EntryKind kind = this->Self->folder.look(name);
  checkFile(this->Self->folder, name, kind);
  if (kind != EntryKind::Nothing && this->Self->before.count(name) == 0)
  {
    inTheWay(this->Self->folder, name, nobodys);
  }
  this->plan({ name });
}

void Journal::add(const DatasetFile& file)
{
  const std::lock_guard<std::mutex> guard(this->Self->mutex);
  this->Self->append(journalLine(file));
}

void Journal::close(const Manifest& manifest)
{
  this->close([&](AtomicFile& document) { document.write(manifestText(manifest)); });
}

void Journal::close(const std::function<void(AtomicFile& document)>& write)
{
  // whoever finds a manifest finds whole files, also when the power fails
  this->Self->folder.syncAll();
  AtomicFile document(FilePlace(this->Self->folder.path(), this->Self->document));
  write(document);
  document.commitDurably();
  this->Self->folder.remove(journalName);
}

} // namespace dgtk
