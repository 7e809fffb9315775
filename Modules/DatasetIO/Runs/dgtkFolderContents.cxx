// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFolderContents.h"

#include "dgtkFolderRecords.h"
#include "dgtkJournal.h"
#include "dgtkLongDocuments.h"
#include "dgtkRunParts.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>

namespace dgtk
{

namespace fs = std::filesystem;

/// A journal without a record counts as nothing, and so do parts that a process is just about to begin, or was when it
/// was killed.
bool holdsNothing(const std::string& folder)
{
  std::error_code code;
  const fs::directory_iterator entries(folder, code);
  if (code == std::errc::no_such_file_or_directory)
  {
    return true;
  }
  if (code)
  {
    throw MachineError(folder + ": the folder cannot be read: " + code.message());
  }
  return std::all_of(begin(entries), end(entries),
    [&](const fs::directory_entry& entry)
    {
      const std::string name = entry.path().filename().string();
      return name.rfind(journalName, 0) == 0 || name == mergedName || (name == partsName && !holdsParts(folder));
    });
}

bool isRunning(const Folder& folder)
{
  const FileDescriptor journal = folder.open(journalName, O_RDONLY | O_NONBLOCK);
  return journal && ::flock(journal.number(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

FolderContents contentsOf(const Folder& folder, const FolderRecords& records, const std::string& requestHash)
{
  const bool same = records.requestHash == requestHash;
  if (!records.foreign.empty())
  {
    return FolderContents::Foreign;
  }
  if (records.whole)
  {
    return same ? FolderContents::Finished : FolderContents::FinishedOther;
  }
  if (!records.journal)
  {
    return holdsNothing(folder.path()) ? FolderContents::Nothing : FolderContents::Foreign;
  }
  if (!records.names)
  {
    return FolderContents::Nothing; // it ended before its first picture
  }
  return same ? FolderContents::Unfinished : FolderContents::UnfinishedOther;
}

FolderContents folderContents(const std::string& path, const std::string& requestHash)
{
  const Folder folder(path);
  std::error_code code;
  if (!fs::exists(path, code) && !code)
  {
    return FolderContents::Nothing;
  }
  if (!fs::is_directory(path, code) && !code)
  {
    throw MachineError(path + ": a file stands where the folder has to be");
  }
  return isRunning(folder) ? FolderContents::Running : contentsOf(folder, readFolderRecords(folder), requestHash);
}

namespace
{
/// Whether a document is what it is read as: it may be another program's.
template <typename Read>
bool canBeRead(const Read& read)
{
  try
  {
    read();
    return true;
  }
  catch (const InputError&)
  {
    return false;
  }
}
} // namespace

void requireFinished(const std::string& folder)
{
  std::error_code code;
  if (!fs::is_directory(folder, code) || fs::exists(fs::path(folder) / manifestName, code))
  {
    return;
  }
  if (holdsParts(folder))
  {
    throw InputError(folder, "holds a run in parts: dgtk merge makes the dataset of them when they are all there");
  }
  if (folderContents(folder, "") == FolderContents::UnfinishedOther)
  {
    throw InputError(folder, "holds an unfinished run: the same run with resume completes it");
  }
}

void requireDataset(const std::string& folder)
{
  std::error_code code;
  if (!fs::exists(fs::path(folder) / manifestName, code))
  {
    requireFinished(folder);
    throw InputError(folder, "is not a dataset", "a folder with manifest.json");
  }
}

void requireOutsideDatasets(const std::string& path)
{
  std::error_code code;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path, code), code);
  for (fs::path folder = whole.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
  {
    if (!fs::exists(folder / manifestName, code))
    {
      continue;
    }
    const bool isManifest = whole == folder / manifestName; // also that of a folder of datasets
    if (canBeRead([&] { readManifestIn(folder.string(), [](DatasetFile&&) {}); }) ||
        (isManifest && canBeRead([&] { readDatasets(folder.string()); })))
    {
      throw UsageError(path + ": lies in the dataset in " + folder.string() + "; name a place outside");
    }
  }
}

std::string describe(FolderContents contents)
{
  switch (contents)
  {
    case FolderContents::Nothing:
      return "is empty";
    case FolderContents::Finished:
      return "holds the finished dataset of the same request";
    case FolderContents::FinishedOther:
      return "holds the finished dataset of another request";
    case FolderContents::Unfinished:
      return "holds an unfinished run of the same request";
    case FolderContents::UnfinishedOther:
      return "holds an unfinished run of another request";
    case FolderContents::Running:
      return "another run is writing into this folder";
    case FolderContents::Foreign:
      break;
  }
  return "holds files that are not a DGTk dataset";
}

} // namespace dgtk
