// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJournal.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkRunParts.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <sys/file.h>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace
{
/// Writes a file of the dataset and records it.
DatasetFile addFile(Journal& journal, const std::string& folder, const std::string& name, const std::string& text)
{
  makeFolders(fs::path(folder + '/' + name).parent_path().string());
  DatasetFile file = writeDocument(folder, name, text, "depth", "cam\tera", 3);
  journal.add(file);
  return file;
}

constexpr JournalStart fresh = JournalStart::Fresh;
constexpr JournalStart resume = JournalStart::Resume;
constexpr JournalStart replace = JournalStart::Replace;

/// A dataset of request "one" that holds one file.
void finishRun(const std::string& folder, const std::string& name)
{
  Journal journal(folder, "one", fresh);
  Manifest manifest;
  manifest.requestHash = "one";
  manifest.files.push_back(addFile(journal, folder, name, "1"));
  journal.close(manifest);
}

std::string refusal(
  const std::string& folder, const std::string& hash, JournalStart start, const std::vector<std::string>& names = {})
{
  return thrownBy<UsageError>([&] { const Journal journal(folder, hash, start, names); });
}
} // namespace

TEST(Journal, ResumesWhatWasFinished)
{
  const TemporaryFolder folder;
  const std::string dir = folder.path("new/data");
  {
    Journal journal(dir, "one", fresh);
    EXPECT_EQ(journal.finished(), 0u);
    addFile(journal, dir, "a/depth/000000.npy", "first");
    addFile(journal, dir, "a/depth/000001.npy", "second");
    addFile(journal, dir, "a/depth/000002.npy", "third");
    journal.plan({ "a/depth/000003.npy" });
    writeFile(dir + "/a/depth/000003.npy.partial", "half");
  }
  writeFile(dir + "/a/depth/000001.npy", "other size");
  std::ofstream(dir + "/" + journalName, std::ios::app) << "deadbeef\t5\t3\tdep"; // a torn line
  Journal journal(dir, "one", resume);
  ASSERT_EQ(journal.finished(), 2u);
  const std::optional<DatasetFile> file = journal.find("a/depth/000002.npy");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->bytes, 5u);
  EXPECT_EQ(file->layer, "depth");
  EXPECT_EQ(file->camera, "cam\tera");
  EXPECT_EQ(file->frame, 3);
  EXPECT_FALSE(journal.find("a/depth/000001.npy"));
  EXPECT_FALSE(fs::exists(dir + "/a/depth/000003.npy.partial"));
}

TEST(Journal, ResumesTwice)
{
  const TemporaryFolder folder;
  {
    Journal journal(folder.path(), "one", fresh);
    addFile(journal, folder.path(), "a", "1");
  }
  {
    Journal journal(folder.path(), "one", resume);
    addFile(journal, folder.path(), "b", "22");
  }
  EXPECT_EQ(Journal(folder.path(), "one", resume).finished(), 2u);
}

TEST(Journal, ResumedAgainAndAgainListsTheSame)
{
  const TemporaryFolder folder;
  const std::string odd = "tab\tand\nline\\feed";
  {
    Journal journal(folder.path(), "one", fresh);
    journal.plan({ odd, "planned", "b" });
    addFile(journal, folder.path(), odd, "1");
    addFile(journal, folder.path(), "b", "22");
  }
  EXPECT_EQ(Journal(folder.path(), "one", resume).finished(), 2u);
  const std::string once = contentsOf(folder.path(journalName));
  Journal(folder.path(), "one", resume).plan({ "planned", odd });
  const Journal journal(folder.path(), "one", resume);
  EXPECT_EQ(contentsOf(folder.path(journalName)), once);
  EXPECT_EQ(journal.finished(), 2u);
  EXPECT_EQ(journal.find(odd).value().sha256, Sha256::of("1"));
  EXPECT_EQ(journal.find("b").value().bytes, 2u);
  EXPECT_FALSE(journal.find("planned"));
  EXPECT_FALSE(journal.find("nowhere"));
}

TEST(Journal, AManifestOfAnotherRequestFinishesNothing)
{
  const TemporaryFolder folder;
  finishRun(folder.path(), "a"); // of request "one", as if it had come back beside a journal of "two"
  const std::string manifest = contentsOf(folder.path(manifestName));
  {
    Journal journal(folder.path(), "two", replace);
    addFile(journal, folder.path(), "b", "2");
  }
  writeFile(folder.path(manifestName), manifest);
  writeFile(folder.path("a"), "1");
  {
    const Journal journal(folder.path(), "two", resume);
    EXPECT_EQ(journal.finished(), 1u);
    EXPECT_TRUE(journal.find("b"));
    EXPECT_FALSE(journal.find("a"));
  }
  const Journal journal(folder.path(), "three", replace); // both list what goes
  EXPECT_FALSE(fs::exists(folder.path("a")));
  EXPECT_FALSE(fs::exists(folder.path("b")));
}

TEST(Journal, ManyFilesAreKeptOrRemoved)
{
  const TemporaryFolder folder;
  constexpr int files = 9000; // more than are looked at together
  const auto name = [](int i) { return "f/" + std::to_string(i); };
  std::string lines = "DGTk journal 1 one\n";
  makeFolders(folder.path("f"));
  for (int i = 0; i < files; ++i)
  {
    writeFile(folder.path(name(i)), std::to_string(i));
    lines += "planned\t" + name(i) + '\n';
    lines +=
      Sha256::of(std::to_string(i)) + '\t' + std::to_string(std::to_string(i).size()) + "\t-1\t\t\t" + name(i) + '\n';
  }
  writeFile(folder.path(journalName), lines);
  writeFile(folder.path(name(7777)), "oops"); // as many bytes
  writeFile(folder.path(name(files)), "mine");
  {
    const Journal journal(folder.path(), "one", resume);
    EXPECT_EQ(journal.finished(), std::size_t(files - 1));
    for (int i = 0; i < files; ++i)
    {
      const std::optional<DatasetFile> file = journal.find(name(i));
      ASSERT_EQ(bool(file), i != 7777) << i;
      ASSERT_EQ(file ? file->sha256 : Sha256::of(std::to_string(i)), Sha256::of(std::to_string(i)));
    }
  }
  const Journal journal(folder.path(), "two", replace);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path("f")), fs::directory_iterator()), 1);
  EXPECT_EQ(contentsOf(folder.path(name(files))), "mine");
}

TEST(NameTable, KnowsEachNameOnce)
{
  NameTable table;
  for (const int step : { 1, 3 })
  {
    for (int i = 0; i < 30000; i += step)
    {
      table.add("camera/depth/" + std::to_string(i) + ".npy");
    }
  }
  table.finish();
  EXPECT_EQ(table.size(), 30000u);
  for (int i = 0; i < 30000; ++i)
  {
    std::uint64_t* number = table.numberOf("camera/depth/" + std::to_string(i) + ".npy");
    ASSERT_TRUE(number);
    ASSERT_EQ(*number, 0u);
    *number = std::uint64_t(i) + 1;
  }
  EXPECT_FALSE(table.has("camera/depth/30000.npy"));
  EXPECT_FALSE(table.has(""));
  EXPECT_EQ(NameTable().size(), 0u);
}

TEST(Journal, ClosedIsAManifestAndNoJournal)
{
  const TemporaryFolder folder;
  Manifest manifest;
  manifest.requestHash = "one";
  {
    Journal journal(folder.path(), "one", fresh);
    manifest.files.push_back(addFile(journal, folder.path(), "a", "1"));
    journal.close(manifest);
  }
  EXPECT_FALSE(fs::exists(folder.path(journalName)));
  EXPECT_EQ(readManifest(folder.path(manifestName)).files.size(), 1u);
  // a whole dataset resumes with nothing left to do
  Journal again(folder.path(), "one", resume);
  EXPECT_TRUE(again.find("a"));
  EXPECT_FALSE(fs::exists(folder.path(manifestName)));
}

TEST(Journal, OneThatAKilledRunLeftBesideItsManifestGoes)
{
  const TemporaryFolder folder;
  const std::string journal = folder.path(journalName);
  const std::string notes = folder.path(notesName);
  std::string killed;
  {
    Journal run(folder.path(), "one", fresh);
    Manifest manifest;
    manifest.requestHash = "one";
    manifest.files.push_back(addFile(run, folder.path(), "a.npy", "1"));
    EXPECT_FALSE(isFinished(folder.path(), "one"));
    killed = readFile(journal);
    writeFile(partialName(journal), "of one who was killed");
    writeFile(notes, "of an export");
    run.close(manifest);
    EXPECT_FALSE(fs::exists(partialName(journal)));
    EXPECT_FALSE(fs::exists(notes));
  }
  writeFile(journal, killed);
  writeFile(partialName(journal), killed);
  writeFile(notes, "of an export");
  EXPECT_FALSE(isFinished(folder.path(), "other"));
  EXPECT_TRUE(fs::exists(journal));
  {
    const FileDescriptor running(::open(journal.c_str(), O_RDWR | O_CLOEXEC));
    ASSERT_EQ(::flock(running.number(), LOCK_EX | LOCK_NB), 0);
    EXPECT_FALSE(isFinished(folder.path(), "one")) << "a process is at it";
    EXPECT_TRUE(fs::exists(journal));
    EXPECT_TRUE(fs::exists(partialName(journal)));
    EXPECT_TRUE(fs::exists(notes));
  }
  removeLeftJournal(folder.path(), "export.json");
  EXPECT_TRUE(fs::exists(journal)) << "no such document";
  EXPECT_TRUE(isFinished(folder.path(), "one"));
  EXPECT_FALSE(fs::exists(journal));
  EXPECT_FALSE(fs::exists(partialName(journal)));
  EXPECT_FALSE(fs::exists(notes));
  EXPECT_TRUE(isFinished(folder.path(), "one"));
  EXPECT_EQ(readFile(folder.path("a.npy")), "1");
}

TEST(Journal, WhatAKilledMergeLeftBesideAWholeRunGoes)
{
  const TemporaryFolder folder;
  const std::string merged = folder.path(mergedName);
  const auto leave = [&] { makeFolders(merged + "/000001"), writeFile(merged + "/000001/a", "1"); };
  finishRun(folder.path(), "a");
  leave();
  EXPECT_FALSE(isFinished(folder.path(), "other"));
  EXPECT_TRUE(fs::exists(merged));
  EXPECT_TRUE(isFinished(folder.path(), "one"));
  EXPECT_FALSE(fs::exists(merged));
  leave();
  removeLeftJournal(folder.path(), "export.json");
  EXPECT_TRUE(fs::exists(merged)) << "no such document";
  EXPECT_THAT(refusal(folder.path(), "two", fresh), HasSubstr("of another request"));
  EXPECT_TRUE(fs::exists(merged));
  {
    const Journal journal(folder.path(), "one", resume);
    EXPECT_FALSE(fs::exists(merged));
  }
  EXPECT_EQ(contentsOf(folder.path("a")), "1");
}

TEST(Journal, ReplacingRemovesWhatTheOldRunListed)
{
  const TemporaryFolder folder;
  finishRun(folder.path(), "a/depth/000000.npy");
  writeFile(folder.path("notes.txt"), "mine");
  writeFile(folder.path("notes.txt.partial"), "mine");
  {
    Journal journal(folder.path(), "two", replace);
    EXPECT_EQ(journal.finished(), 0u);
    EXPECT_FALSE(fs::exists(folder.path("a")));
    journal.plan({ "b/depth/000000.npy", "b/depth/000001.npy", "b/depth/000002.npy" });
    addFile(journal, folder.path(), "b/depth/000000.npy", "1");
    writeFile(folder.path("b/depth/000001.npy"), "written, and not recorded any more");
    writeFile(folder.path("b/depth/000002.npy.partial"), "half");
  }
  const Journal journal(folder.path(), "three", replace);
  EXPECT_FALSE(fs::exists(folder.path("b")));
  EXPECT_TRUE(fs::exists(folder.path("notes.txt")));
  EXPECT_TRUE(fs::exists(folder.path("notes.txt.partial")));
}

TEST(Journal, TheSameRequestIsMadeAnew)
{
  const TemporaryFolder folder;
  finishRun(folder.path(), "a");
  const Journal journal(folder.path(), "one", fresh);
  EXPECT_EQ(journal.finished(), 0u);
  EXPECT_FALSE(fs::exists(folder.path("a")));
}

TEST(Journal, ListsThatLeadOutOfTheFolderAreNotOurs)
{
  const TemporaryFolder folder;
  writeFile(folder.path("outside"), "mine");
  for (const std::string& name : { std::string("../outside"), folder.path("outside"), std::string("x/../../outside"),
         std::string("./x"), std::string("x//y"), std::string() })
  {
    SCOPED_TRACE(name);
    fs::remove_all(folder.path("data"));
    makeFolders(folder.path("data"));
    Manifest manifest;
    manifest.requestHash = "one";
    manifest.files.push_back({ name, 4, std::string(64, '0'), "", "", -1 });
    writeFile(folder.path("data/manifest.json"), manifestText(manifest));
    EXPECT_THAT(refusal(folder.path("data"), "one", replace), HasSubstr("leads out of the dataset"));
    fs::remove(folder.path("data/manifest.json"));
    for (const std::string& line : { std::string(64, '0') + "\t4\t-1\t\t\t" + name, "planned\t" + name })
    {
      writeFile(folder.path("data/.dgtk-journal"), "DGTk journal 1 one\n" + line + "\n");
      EXPECT_THAT(refusal(folder.path("data"), "one", replace), HasSubstr("leads out of the dataset"));
      EXPECT_EQ(folderContents(folder.path("data"), "one"), FolderContents::Foreign);
    }
    EXPECT_EQ(contentsOf(folder.path("outside")), "mine");
  }
}

TEST(Journal, AFileThatNobodyHasWrittenIsNotReplaced)
{
  const TemporaryFolder folder;
  finishRun(folder.path(), "a");
  writeFile(folder.path("b"), "mine");
  for (const JournalStart start : { fresh, resume, replace })
  {
    EXPECT_THAT(refusal(folder.path(), "one", start, { "a", "b" }), HasSubstr("/b: is in the way"));
    EXPECT_THAT(refusal(folder.path(), "one", start, { "a/c" }), HasSubstr("where a folder of the dataset has to be"));
  }
  EXPECT_EQ(folderContents(folder.path(), "one"), FolderContents::Finished);
  EXPECT_EQ(contentsOf(folder.path("a")), "1");
  EXPECT_EQ(contentsOf(folder.path("b")), "mine");
  Journal journal(folder.path(), "one", resume, { "a" });
  EXPECT_THROW(journal.planLate("b"), UsageError);
  journal.planLate("c");
}

TEST(Journal, OneThatBeginsWhileTheFolderIsLookedAtIsNotForeign)
{
  for (const bool stays : { true, false })
  {
    const TemporaryFolder folder;
    const std::string& dir = folder.path();
    {
      Journal journal(dir, "one", fresh);
      addFile(journal, dir, "a", "1");
    }
    std::unique_ptr<Journal> other;
    const ForNames names = [&](const std::function<void(const std::string&)>& visit)
    {
      if (!fs::exists(dir + "/b")) // a file of the other one, which this one has not read of
      {
        other = std::make_unique<Journal>(dir, "one", resume);
        addFile(*other, dir, "b", "2");
        other = stays ? std::move(other) : nullptr;
      }
      visit("a");
      visit("b");
    };
    const auto start = [&] { return Journal(dir, "one", resume, names).finished(); };
    if (stays)
    {
      EXPECT_THAT(thrownBy<FolderError>(start), HasSubstr("another run is writing into this folder"));
    }
    else
    {
      EXPECT_EQ(start(), 2u);
    }
  }
}

TEST(FolderContents, SaysWhatStandsThere)
{
  const TemporaryFolder place;
  const std::string dir = place.path("d");
  const auto contents = [&] { return std::make_pair(folderContents(dir, "one"), folderContents(dir, "two")); };
  const auto both = [](FolderContents a, FolderContents b) { return std::make_pair(a, b); };
  const auto alike = [](FolderContents a) { return std::make_pair(a, a); };
  EXPECT_EQ(contents(), alike(FolderContents::Nothing));
  makeFolders(dir);
  EXPECT_EQ(contents(), alike(FolderContents::Nothing));
  {
    Journal journal(dir, "one", fresh);
    EXPECT_EQ(contents(), alike(FolderContents::Running));
  }
  EXPECT_EQ(contents(), alike(FolderContents::Nothing)); // it ended before its first file
  {
    Journal(dir, "one", fresh).plan({ "a" });
    EXPECT_EQ(contents(), both(FolderContents::Unfinished, FolderContents::UnfinishedOther));
    EXPECT_EQ(folderContents(dir, ""), FolderContents::UnfinishedOther);
    Journal journal(dir, "one", resume);
    Manifest manifest;
    manifest.requestHash = "one";
    manifest.files.push_back(addFile(journal, dir, "a", "1"));
    journal.close(manifest);
  }
  EXPECT_EQ(contents(), both(FolderContents::Finished, FolderContents::FinishedOther));
  EXPECT_EQ(folderContents(dir, ""), FolderContents::FinishedOther);
  fs::remove(dir + "/manifest.json");
  EXPECT_EQ(contents(), alike(FolderContents::Foreign));
  EXPECT_THROW(folderContents(dir + "/a", "one"), MachineError);
}

TEST(Journal, Refusals)
{
  const TemporaryFolder folder;
  writeFile(folder.path("thesis.txt"), "mine");
  EXPECT_THAT(refusal(folder.path(), "one", fresh), HasSubstr("holds files that are not a DGTk dataset"));
  EXPECT_EQ(contentsOf(folder.path("thesis.txt")), "mine");
  EXPECT_FALSE(fs::exists(folder.path(journalName)));
  writeFile(folder.path("manifest.json"), "{\"mine\": 1}");
  EXPECT_THAT(refusal(folder.path(), "one", replace), HasSubstr("manifest.json:1: "));

  const TemporaryFolder other;
  {
    Journal journal(other.path(), "one", fresh);
    addFile(journal, other.path(), "a", "1");
  }
  EXPECT_THAT(refusal(other.path(), "one", fresh), HasSubstr("an unfinished run of the same request"));
  EXPECT_THAT(refusal(other.path(), "two", fresh), HasSubstr("an unfinished run of another request"));
  EXPECT_THAT(
    refusal(other.path(), "two", resume), HasSubstr("an unfinished run of another request, which cannot be resumed"));
  EXPECT_TRUE(fs::exists(other.path("a")));
  {
    const Journal running(other.path(), "one", resume);
    EXPECT_THAT(refusal(other.path(), "one", resume), HasSubstr("another run is writing into this folder"));
  }
  EXPECT_THROW(Journal("/proc/nowhere", "one", fresh), MachineError);
  EXPECT_THROW(Journal(other.path("a"), "one", fresh), MachineError);
}
