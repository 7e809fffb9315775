// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJournal.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

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
  const DatasetFile file = writeDocument(folder, name, text, "depth", "cam\tera", 3);
  journal.add(file);
  return file;
}

std::string refusal(const std::string& folder, const std::string& hash, bool resume)
{
  try
  {
    Journal journal(folder, hash, resume);
  }
  catch (const UsageError& error)
  {
    return error.what();
  }
  return {};
}
} // namespace

TEST(Journal, ResumesWhatWasFinished)
{
  const TemporaryFolder folder;
  const std::string dir = folder.path("new/data");
  {
    Journal journal(dir, "one", false);
    EXPECT_TRUE(journal.finished().empty());
    addFile(journal, dir, "a/depth/000000.npy", "first");
    addFile(journal, dir, "a/depth/000001.npy", "second");
    addFile(journal, dir, "a/depth/000002.npy", "third");
    writeFile(dir + "/a/depth/000003.npy.partial", "half");
  }
  writeFile(dir + "/a/depth/000001.npy", "other size");
  std::ofstream(dir + "/" + journalName, std::ios::app) << "deadbeef\t5\t3\tdep"; // a torn line
  Journal journal(dir, "one", true);
  ASSERT_EQ(journal.finished().size(), 2u);
  const DatasetFile* file = journal.find("a/depth/000002.npy");
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
    Journal journal(folder.path(), "one", false);
    addFile(journal, folder.path(), "a", "1");
  }
  {
    Journal journal(folder.path(), "one", true);
    addFile(journal, folder.path(), "b", "22");
  }
  EXPECT_EQ(Journal(folder.path(), "one", true).finished().size(), 2u);
}

TEST(Journal, ClosedIsAManifestAndNoJournal)
{
  const TemporaryFolder folder;
  Manifest manifest;
  manifest.requestHash = "one";
  {
    Journal journal(folder.path(), "one", false);
    manifest.files.push_back(addFile(journal, folder.path(), "a", "1"));
    journal.close(manifest);
  }
  EXPECT_FALSE(fs::exists(folder.path(journalName)));
  EXPECT_EQ(readManifest(folder.path(manifestName)).files.size(), 1u);
  // a whole dataset resumes with nothing left to do
  Journal again(folder.path(), "one", true);
  EXPECT_TRUE(again.find("a"));
  EXPECT_FALSE(fs::exists(folder.path(manifestName)));
}

TEST(Journal, AFreshStartRemovesWhatTheOldDatasetListed)
{
  const TemporaryFolder folder;
  {
    Journal journal(folder.path(), "one", false);
    Manifest manifest;
    manifest.files.push_back(addFile(journal, folder.path(), "a/depth/000000.npy", "1"));
    manifest.files.push_back({ "../outside", 1, std::string(64, '0'), "", "", -1 });
    journal.close(manifest);
  }
  writeFile(folder.path("notes.txt"), "mine");
  Journal journal(folder.path(), "two", false);
  EXPECT_TRUE(journal.finished().empty());
  EXPECT_FALSE(fs::exists(folder.path("a")));
  EXPECT_TRUE(fs::exists(folder.path("notes.txt")));
}

TEST(Journal, NeverRemovesOutsideTheFolder)
{
  const TemporaryFolder folder;
  writeFile(folder.path("outside"), "mine");
  Manifest manifest;
  for (const std::string& name : { std::string("../outside"), folder.path("outside"), std::string("x/../../outside") })
  {
    manifest.files.push_back({ name, 4, std::string(64, '0'), "", "", -1 });
  }
  makeFolders(folder.path("data"));
  writeFile(folder.path("data/manifest.json"), manifestText(manifest));
  const Journal journal(folder.path("data"), "one", false);
  EXPECT_TRUE(fs::exists(folder.path("outside")));
}

TEST(Journal, Refusals)
{
  const TemporaryFolder folder;
  writeFile(folder.path("thesis.txt"), "mine");
  EXPECT_THAT(refusal(folder.path(), "one", false), HasSubstr("holds files that are not a DGTk dataset"));
  EXPECT_EQ(contentsOf(folder.path("thesis.txt")), "mine");
  EXPECT_FALSE(fs::exists(folder.path(journalName)));
  writeFile(folder.path("manifest.json"), "{\"mine\": 1}");
  EXPECT_THAT(refusal(folder.path(), "one", false), HasSubstr("holds a manifest that is not DGTk's"));

  const TemporaryFolder other;
  {
    Journal journal(other.path(), "one", false);
    addFile(journal, other.path(), "a", "1");
  }
  EXPECT_THAT(refusal(other.path(), "two", true), HasSubstr("another request, which cannot be resumed"));
  EXPECT_TRUE(fs::exists(other.path("a")));
  {
    const Journal running(other.path(), "one", true);
    EXPECT_THAT(refusal(other.path(), "one", true), HasSubstr("another run is writing into this folder"));
  }
  EXPECT_THROW(Journal("/proc/nowhere", "one", false), MachineError);
  EXPECT_THROW(Journal(other.path("a"), "one", false), MachineError);
}
