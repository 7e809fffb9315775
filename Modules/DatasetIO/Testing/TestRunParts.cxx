// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRunParts.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkFolder.h"
#include "dgtkFolderContents.h"
#include "dgtkHash.h"
#include "dgtkJournal.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
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
  void write(const std::string& in, const std::string& name, const std::string& version = "1.2.3",
    const std::vector<std::pair<std::string, std::string>>& request = {}) const
  {
    makeFolders(std::filesystem::path(this->path(in + '/' + name)).parent_path().string());
    Manifest manifest;
    manifest.version = version;
    manifest.requestHash = this->Run.requestHash;
    manifest.request = request;
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

TEST_F(RunPartsTest, WhatIsWholeIsMergedAgainByDoingNothing)
{
  const auto refusal = [&] { return test::thrownBy<UsageError>([&] { mergeParts(this->path(), 1); }); };
  const std::string left = this->path(mergedName);
  EXPECT_EQ(refusal(), this->path() + ": holds no parts of a run");
  makeFolders(left); // by the merge of exports that have no document of the whole
  EXPECT_EQ(folderContents(this->path(), ""), FolderContents::Nothing);
  EXPECT_TRUE(mergeParts(this->path(), 1).merged);
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_EQ(refusal(), this->path() + ": holds no parts of a run");

  beginParts(this->path(), this->Run, 1);
  this->write(partName(0), "a");
  EXPECT_EQ(mergeParts(this->path(), 1).blocks, 1u);
  makeFolders(left + "/000000");
  for (int i = 0; i < 2; ++i)
  {
    const MergeReport report = mergeParts(this->path(), 1);
    EXPECT_TRUE(report.merged);
    EXPECT_EQ(report.blocks, 0u);
    EXPECT_EQ(report.files, 1u);
    EXPECT_FALSE(std::filesystem::exists(left));
  }
  writeFile(this->path(manifestName), "{}");
  EXPECT_THROW(mergeParts(this->path(), 1), InputError);
}

TEST_F(RunPartsTest, ARecordIsReplacedWhenAsked)
{
  beginParts(this->path(), this->Run, 7);
  this->Run.requestHash = Sha256::of("another request");
  EXPECT_THROW(beginParts(this->path(), this->Run, 1), UsageError);
  beginParts(this->path(), this->Run, 1, true);
  EXPECT_EQ(readParts(this->path()).requestHash, this->Run.requestHash);
  EXPECT_THAT(workersOf(this->path()), ElementsAre(1));
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

TEST_F(RunPartsTest, AScenesDatasetIsOfTheRunsRequest)
{
  struct Row
  {
    const char* key;
    const char* asked;
    const char* found;
    bool same;
  };
  this->Run.scenes = { "one" };
  for (const Row& row :
    std::vector<Row>{ { "layers", "depth", "distance", false }, { "layers", "depth,color", "color", false },
      { "layers", "depth,color,depth", "color,depth", true }, { "layers", "all", "color", true },
      { "layers", "", "color", true }, { "classes", "{}", "{\"a\": 1}", true }, { "cameras", "all", "left", false },
      { "cameras", "a,b", "a\\,b", true }, { "frames", "all", "0:3:1", false }, { "size", "own", "camera's own", true },
      { "size", "own", "640x480", false }, { "size", "8x6", "8x6", true }, { "exposure", "2.0", "2", true } })
  {
    SCOPED_TRACE(std::string(row.key) + ' ' + row.asked + ' ' + row.found);
    this->Run.request = { { "tile", "4x3" }, { row.key, row.asked } };
    beginParts(this->path(), this->Run, 1, true);
    this->write("one", "objects.json", "1.2.3", { { row.key, row.found }, { "renderer", "ray" } });
    const MergeReport report = mergeParts(this->path(), 1);
    EXPECT_EQ(report.merged, row.same);
    const std::string said = this->path("one") + ": is of another request: " + row.key + " (expected " + row.asked +
                             ", found " + row.found + ')';
    EXPECT_EQ(report.problems, row.same ? std::vector<std::string>() : std::vector<std::string>{ said });
  }
}
} // namespace
