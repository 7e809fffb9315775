// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJournal.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkFolderRecords.h"
#include "dgtkHash.h"
#include "dgtkRunParts.h"
#include "dgtkSyncAhead.h"
#include "dgtkSystem.h"
#include "dgtkThreadPool.h"
#include "dgtkWayCheck.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <mutex>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

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
constexpr std::uint64_t syncedTogether = std::uint64_t(16) << 20; ///< bytes

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
      if (records.damage && start == JournalStart::Resume)
      {
        throw *records.damage;
      }
      throw FolderError(folder, contents,
        records.foreign.empty() ? "; name a new or an empty folder"
                                : "; name another folder (" + records.foreign + ")");
  }
}

/// Before anything is changed.
void checkNames(const Folder& folder, const std::string& document, const NameTable& listed, const ForNames& names)
{
  if (holdsNothing(folder.path()))
  {
    return;
  }
  WayCheck check(folder, listed);
  readFolderRecords(folder, document, [&](DatasetFile&& file, ListedIn) { check.add(file.path); });
  names([&](const std::string& name) { check.add(name); });
  check.finish();
}

/// What only an unfinished run has; the journal goes last, as it is locked.
void removeRecords(const Folder& folder)
{
  for (const std::string& name : { std::string(notesName), partialName(journalName), std::string(journalName) })
  {
    folder.remove(name);
  }
}

/// Of a merge that was killed at its very end.
void removeMerged(const Folder& folder)
{
  std::error_code code;
  std::filesystem::remove_all(folder.pathOf(mergedName), code);
}

bool isSameFile(const FileDescriptor& a, const FileDescriptor& b)
{
  struct stat one = {};
  struct stat two = {};
  return ::fstat(a.number(), &one) == 0 && ::fstat(b.number(), &two) == 0 && one.st_dev == two.st_dev &&
         one.st_ino == two.st_ino;
}

/// A journal while it is written anew.
class JournalText
{
public:
  explicit JournalText(const FileDescriptor& file)
    : File(file)
  {
  }
  std::uint64_t size() const { return this->Size; }
  void add(const std::string& line)
  {
    this->Waiting += line;
    this->Size += line.size();
    if (this->Waiting.size() > blockBytes)
    {
      this->flush();
    }
  }
  /// False, with errno, when the system refused any of it.
  bool flush()
  {
    if (this->Reason == 0 && !writeAll(this->File.number(), this->Waiting.data(), this->Waiting.size()))
    {
      this->Reason = errno;
    }
    this->Waiting.clear();
    errno = this->Reason;
    return this->Reason == 0;
  }

private:
  static constexpr std::size_t blockBytes = std::size_t(1) << 16;
  const FileDescriptor& File;
  std::string Waiting;
  std::uint64_t Size = 0;
  int Reason = 0; ///< errno of the first refusal
};

/// What the numbers of a table of names say: where the file's line is in the journal, and whether it is finished.
struct LinePlace
{
  std::uint64_t offset = 0; ///< never 0: the first line is the request's
  bool finished = false;
  static LinePlace of(std::uint64_t number) { return { number >> 1, (number & 1) != 0 }; }
  std::uint64_t number() const { return this->offset << 1 | (this->finished ? 1 : 0); }
};
} // namespace

struct Journal::Impl
{
  Folder folder;
  std::string document;
  FileDescriptor descriptor;
  std::mutex mutex;
  NameTable listed; ///< files of a run that is resumed, finished ones and such as it has announced; LinePlaces
  std::size_t finished = 0;
  SyncAhead ahead;

  Impl(const std::string& path, const std::string& last)
    : folder(path)
    , document(last)
    , ahead([this] { this->folder.syncAll(); }, syncedTogether)
  {
  }

  [[noreturn]] void fail() const
  {
    throw MachineError(this->folder.pathOf(journalName) + ": cannot be written: " + std::strerror(errno));
  }

  [[noreturn]] void failChanged() const
  {
    throw MachineError(this->folder.path() + ": somebody has changed what it lists while it was read");
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

  /// What manifest and journal say, and the table of the files that they list.
  FolderRecords read()
  {
    this->listed = NameTable();
    FolderRecords records = readFolderRecords(
      this->folder, this->document, [&](DatasetFile&& file, ListedIn) { this->listed.add(file.path); });
    this->listed.finish();
    return records;
  }

  /// A new journal in place of the old one, at once and under the lock.
  void rewrite(const std::function<void(JournalText& text)>& write)
  {
    const std::string partial = partialName(journalName);
    this->folder.remove(partial);
    FileDescriptor next = this->folder.open(partial, O_RDWR | O_CREAT | O_EXCL | O_APPEND);
    if (!next || this->isLocked(next))
    {
      this->fail();
    }
    JournalText text(next);
    write(text);
    if (!text.flush())
    {
      this->fail();
    }
    this->folder.rename(partial, journalName);
    this->descriptor = std::move(next);
  }

  void record(const DatasetFile& file, bool whole, JournalText& text)
  {
    std::uint64_t* number = this->listed.numberOf(file.path);
    if (!number)
    {
      this->failChanged();
    }
    if (*number == 0 || (whole && !LinePlace::of(*number).finished))
    {
      *number = LinePlace{ text.size(), whole }.number();
      this->finished += whole ? 1 : 0;
      text.add(whole ? journalLine(file) : journalPlan(file.path));
    }
  }

  /// A crash of the machine may leave a file with its name and size, and without its contents.
  void recordWhole(std::vector<DatasetFile>& files, JournalText& text)
  {
    std::vector<char> whole(files.size(), 0);
    ThreadPool pool(machineThreads());
    pool.parallelFor(static_cast<int>(files.size()),
      [&](int i) { whole[std::size_t(i)] = isWhole(this->folder, files[std::size_t(i)]) ? 1 : 0; });
    for (std::size_t i = 0; i < files.size(); ++i)
    {
      this->record(files[i], whole[i] != 0, text);
    }
    files.clear();
  }

  /// The journal of this request with all files that are listed; finished ones stay so if they are `kept`.
  void begin(const std::string& requestHash, const FolderRecords& records, bool kept)
  {
    constexpr std::size_t together = 4096;
    this->rewrite(
      [&](JournalText& text)
      {
        text.add(journalFirstLine(requestHash));
        std::vector<DatasetFile> waiting;
        const FolderRecords again = readFolderRecords(this->folder, this->document,
          [&](DatasetFile&& file, ListedIn where)
          {
            if (kept)
            {
              this->folder.remove(partialName(file.path));
            }
            if (!kept || file.sha256.empty() || (where == ListedIn::Document && !records.whole))
            {
              this->record(file, false, text);
              return;
            }
            waiting.push_back(std::move(file));
            if (waiting.size() == together)
            {
              this->recordWhole(waiting, text);
            }
          });
        this->recordWhole(waiting, text);
        if (!again.foreign.empty() || again.requestHash != records.requestHash)
        {
          this->failChanged();
        }
      });
  }

  /// What the journal lists.
  void removeFiles()
  {
    readFolderRecords(this->folder, this->document,
      [this](DatasetFile&& file, ListedIn)
      {
        this->folder.remove(file.path);
        this->folder.remove(partialName(file.path));
        this->folder.removeEmptyParents(file.path);
      });
  }

  /// The line that begins there.
  std::string lineAt(std::uint64_t offset) const
  {
    std::string line;
    char block[512];
    for (ssize_t got;
         (got = ::pread(this->descriptor.number(), block, sizeof block, static_cast<off_t>(offset + line.size()))) > 0;)
    {
      const char* end = std::find(block, block + got, '\n');
      line.append(block, std::size_t(end - block));
      if (end != block + got)
      {
        return line;
      }
    }
    throw MachineError(this->folder.pathOf(journalName) + ": cannot be read back");
  }
};

Journal::Journal(const std::string& path, const std::string& requestHash, JournalStart start, const ForNames& names,
  const std::string& document, const JudgeOfFiles& judge)
  : Self(new Impl(path, document))
{
  makeFolders(path);
  const Folder& folder = this->Self->folder;
  if (isRunning(folder))
  {
    throw FolderError(path, FolderContents::Running);
  }
  // once without the lock, so that a refusal leaves no trace, and once with it
  const auto look = [&]
  {
    const FolderRecords records = this->Self->read();
    refuseIfNeeded(path, records, contentsOf(folder, records, requestHash), start);
    judgeFiles(folder, document, start == JournalStart::Resume ? judge : nullptr);
    checkNames(folder, document, this->Self->listed, names);
  };
  try
  {
    look();
  }
  catch (const Error&)
  {
    if (isRunning(folder))
    {
      throw FolderError(path, FolderContents::Running);
    }
    look(); // another process may have come and gone meanwhile
  }
  this->Self->lock();
  const FolderRecords before = this->Self->read();
  const FolderContents contents = contentsOf(folder, before, requestHash);
  refuseIfNeeded(path, before, contents, start);
  removeMerged(folder);
  const bool resumes = start == JournalStart::Resume && contents != FolderContents::Nothing;
  this->Self->begin(requestHash, before, resumes);
  folder.remove(document);
  if (!resumes && before.names)
  {
    // killed in between, everything is in the journal still
    this->Self->removeFiles();
    this->Self->listed = NameTable();
    this->Self->rewrite([&](JournalText& text) { text.add(journalFirstLine(requestHash)); });
  }
}

Journal::Journal(const std::string& path, const std::string& requestHash, JournalStart start,
  const std::vector<std::string>& names, const JudgeOfFiles& judge)
  : Journal(
      path, requestHash, start,
      [&](const std::function<void(const std::string&)>& visit) { std::for_each(names.begin(), names.end(), visit); },
      manifestName, judge)
{
}

Journal::~Journal() = default;

std::size_t Journal::finished() const { return this->Self->finished; }

std::optional<DatasetFile> Journal::find(const std::string& path) const
{
  const NameTable& listed = this->Self->listed;
  const std::uint64_t* number = listed.numberOf(path);
  if (!number || !LinePlace::of(*number).finished)
  {
    return std::nullopt;
  }
  std::optional<DatasetFile> file = readJournalLine(this->Self->lineAt(LinePlace::of(*number).offset));
  return file && file->path == path ? file : std::nullopt;
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
  WayCheck check(this->Self->folder, this->Self->listed);
  check.add(name);
  check.finish();
  this->plan({ name });
}

void Journal::add(const DatasetFile& file)
{
  {
    const std::lock_guard<std::mutex> guard(this->Self->mutex);
    this->Self->append(journalLine(file));
  }
  this->Self->ahead.wrote(file.bytes);
}

bool isFinished(const std::string& path, const std::string& requestHash)
{
  if (folderContents(path, requestHash) != FolderContents::Finished)
  {
    return false;
  }
  removeLeftJournal(path);
  return true;
}

void removeLeftJournal(const std::string& path, const std::string& document)
{
  const Folder folder(path);
  if (folder.look(document) == EntryKind::File)
  {
    removeMerged(folder);
  }
  const FileDescriptor left = folder.open(journalName, O_RDWR | O_NONBLOCK);
  if (left && ::flock(left.number(), LOCK_EX | LOCK_NB) == 0 && folder.look(document) == EntryKind::File)
  {
    removeRecords(folder);
  }
}

void Journal::close(const Manifest& manifest)
{
  this->close([&](AtomicFile& document) { document.write(manifestText(manifest)); });
}

void Journal::close(const std::function<void(AtomicFile& document)>& write)
{
  // whoever finds a manifest finds whole files, also when the power fails
  this->Self->ahead.finish();
  this->Self->folder.syncAll();
  AtomicFile document(FilePlace(this->Self->folder.path(), this->Self->document));
  write(document);
  document.commitDurably();
  removeRecords(this->Self->folder);
}

} // namespace dgtk
