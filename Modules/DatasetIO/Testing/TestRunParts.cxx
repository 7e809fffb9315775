// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRunParts.h"

#include "dgtkFile.h"
#include "dgtkFolder.h"
#include "dgtkHash.h"
#include "dgtkJournal.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace
{
using namespace dgtk;
using testing::ElementsAre;
using testing::IsEmpty;

/// A run that waits in a folder to be merged.
class RunPartsTest : public testing::Test
{
protected:
  RunPartsTest()
  {
    this->Run.version = "1.2.3";
    this->Run.requestHash = Sha256::of("request");
    this->Run.items = 1;
  }
  std::string path(const std::string& name = {}) const { return this->Folder.path(name); }
  /// A dataset of the run, of one file, in a folder of it.
  void write(const std::string& in, const std::string& name, const std::string& version = "1.2.3") const
  {
    makeFolders(std::filesystem::path(this->path(in + '/' + name)).parent_path().string());
    Manifest manifest;
    manifest.version = version;
    manifest.requestHash = this->Run.requestHash;
    manifest.files.push_back(writeDocument(this->path(in), name, "made", "color", "left", 0));
    writeFile(this->path(in + '/' + manifestName), manifestText(manifest));
  }

  test::TemporaryFolder Folder;
  RunParts Run;
};

TEST_F(RunPartsTest, AnyNumberOfProcessesIsKnown)
{
  for (const std::size_t workers : std::vector<std::size_t>{ 100, 999999999, 3, 100, 12 })
  {
    beginParts(this->path(), this->Run, workers);
  }
  for (const char* const foreign : { "/workers-", "/workers-7x", "/worker-8" })
  {
    writeFile(this->path(partsName + std::string(foreign)), "");
  }
  EXPECT_THAT(workersOf(this->path()), ElementsAre(3, 12, 100, 999999999));
}

TEST_F(RunPartsTest, AFileThatNoRunHasWrittenStays)
{
  const std::string name = "left/color/000000.png";
  beginParts(this->path(), this->Run, 1);
  this->write(partName(0), name);
  makeFolders(this->path("left/color"));
  writeFile(this->path(name), "mine");
  MergeReport report = mergeParts(this->path(), 1);
  EXPECT_FALSE(report.merged);
  EXPECT_THAT(report.problems, ElementsAre(this->path(name) + ": is in the way, and no run has written it"));
  EXPECT_EQ(test::contentsOf(this->path(name)), "mine");
  EXPECT_FALSE(std::filesystem::exists(this->path(manifestName)));
  EXPECT_TRUE(hasParts(this->path()));

  std::filesystem::remove(this->path(name));
  report = mergeParts(this->path(), 1);
  EXPECT_TRUE(report.merged);
  EXPECT_THAT(report.problems, IsEmpty());
  EXPECT_EQ(test::contentsOf(this->path(name)), "made");
  EXPECT_FALSE(hasParts(this->path()));
}

TEST_F(RunPartsTest, PartsOfAnotherRunAreRefused)
{
  RunParts other = this->Run;
  other.requestHash = Sha256::of("another request");
  const auto refusal = [&] { return test::thrownBy<UsageError>([&] { beginParts(this->path(), other, 1); }); };
  const std::string said = this->path() + ": holds an unfinished run of another request, in parts; remove ";
  beginParts(this->path(), this->Run, 1);
  EXPECT_EQ(refusal(), said + "its .dgtk-parts, or name another folder");

  std::filesystem::remove_all(this->path(".dgtk-parts"));
  this->Run.scenes = { "one" }; // whose dataset stands beside the parts
  beginParts(this->path(), this->Run, 1);
  EXPECT_EQ(refusal(), said + "it, or name another folder");
}

TEST_F(RunPartsTest, ASceneOfAnotherVersionIsNotMerged)
{
  this->Run.scenes = { "one", "two" };
  this->Run.items = 2;
  beginParts(this->path(), this->Run, 1);
  this->write("one", "objects.json");
  this->write("two", "objects.json", "1.2.4");
  MergeReport report = mergeParts(this->path(), 1);
  EXPECT_FALSE(report.merged);
  EXPECT_THAT(report.problems, ElementsAre(this->path("two") + ": is of another version of DGTk"));
  EXPECT_THAT(report.missing, IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(this->path(manifestName)));

  this->write("two", "objects.json");
  report = mergeParts(this->path(), 1);
  EXPECT_TRUE(report.merged);
  EXPECT_THAT(report.problems, IsEmpty());
  EXPECT_EQ(readDatasets(this->path()).datasets.size(), 2u);
}
} // namespace
