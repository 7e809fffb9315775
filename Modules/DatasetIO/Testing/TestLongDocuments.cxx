// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFile.h"
#include "dgtkFileTable.h"
#include "dgtkLongDocuments.h"
#include "dgtkObjectDocuments.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace
{
using namespace dgtk;
using test::TemporaryFolder;

TEST(PoseIndex, FindsPosesInAnyOrder)
{
  const std::pair<int, std::uint32_t> order[] = { { 3, 2 }, { 3, 9 }, { 0, 1 }, { 3, 1 }, { 7, 4 }, { 0, 5 },
    { 3, 5 } };
  std::string list;
  for (const auto& [frame, id] : order)
  {
    PoseRecord pose;
    pose.frame = frame;
    pose.id = id;
    pose.t = { double(frame), double(id), 0.5 };
    const std::string text = posesText({ pose });
    const std::size_t begin = text.find('[') + 1;
    list += (list.empty() ? "" : ",") + text.substr(begin, text.rfind(']') - begin);
  }
  const TemporaryFolder folder;
  writeFile(folder.path("poses.json"), "{\"poses\": [" + list + "]}");
  const PoseIndex poses(folder.path("poses.json"));
  const auto ids = [&](int frame)
  {
    std::vector<std::uint32_t> found;
    for (const PoseRecord& pose : poses.at(frame))
    {
      EXPECT_EQ(pose.t, Eigen::Vector3d(frame, pose.id, 0.5));
      found.push_back(pose.id);
    }
    return found;
  };
  EXPECT_EQ(ids(0), (std::vector<std::uint32_t>{ 1, 5 }));
  EXPECT_EQ(ids(3), (std::vector<std::uint32_t>{ 1, 2, 5, 9 }));
  EXPECT_EQ(ids(7), (std::vector<std::uint32_t>{ 4 }));
  EXPECT_TRUE(ids(1).empty());
  EXPECT_TRUE(ids(8).empty());
}

DatasetFile fileOfShot(const std::string& path, const std::string& layer, const std::string& camera, int frame)
{
  DatasetFile file;
  file.path = path;
  file.layer = layer;
  file.camera = camera;
  file.frame = frame;
  file.bytes = path.size();
  file.sha256 = std::string(62, 'a') + "0f";
  return file;
}

TEST(FileTable, FindsFilesByPathAndByShot)
{
  const DatasetFile files[] = {
    fileOfShot("b/depth/000010.npy", "depth", "b", 10),
    fileOfShot("a/color/000000.png", "color", "a", 0),
    fileOfShot("a/depth/000000.npy", "depth", "a", 0),
    fileOfShot("a/depth/000000.dgd", "depth", "a", 0),
    fileOfShot("a/tracks.npz", "tracks", "a", 0),
    fileOfShot("elsewhere/000000.png", "color", "b", 10),
    fileOfShot("b/depth/1234567.npy", "depth", "b", 1234567),
    fileOfShot("objects.json", "", "", -1),
  };
  const std::uint32_t shots[] = { 1, 0, 0, 0, 0, 1, 2, FileTable::noShot };
  FileTable table;
  for (std::size_t i = 0; i < std::size(files); ++i)
  {
    table.add(files[i], shots[i]);
  }
  table.finish();
  EXPECT_EQ(table.size(), std::size(files));
  for (std::size_t i = 0; i < std::size(files); ++i)
  {
    const auto number = table.find(files[i].path);
    ASSERT_TRUE(number) << files[i].path;
    EXPECT_EQ(table.shotOf(*number), shots[i]);
    const DatasetFile found = table.at(*number);
    EXPECT_EQ(found.path, files[i].path);
    EXPECT_EQ(found.layer, files[i].layer);
    EXPECT_EQ(found.bytes, files[i].bytes);
    EXPECT_EQ(found.sha256, files[i].sha256);
  }
  EXPECT_FALSE(table.find("a/depth/000001.npy"));
  EXPECT_FALSE(table.find("z"));
  const auto paths = [&](const std::vector<std::uint32_t>& numbers)
  {
    std::vector<std::string> all;
    all.reserve(numbers.size());
    for (const std::uint32_t number : numbers)
    {
      all.push_back(table.pathOf(number));
    }
    return all;
  };
  EXPECT_EQ(paths(table.ofShot(0, "depth")), (std::vector<std::string>{ "a/depth/000000.dgd", "a/depth/000000.npy" }));
  EXPECT_EQ(paths(table.ofShot(1)), (std::vector<std::string>{ "b/depth/000010.npy", "elsewhere/000000.png" }));
  EXPECT_TRUE(table.ofShot(1, "flow").empty());
  EXPECT_TRUE(table.ofShot(FileTable::noShot).empty());
  EXPECT_TRUE(table.hasLayer("tracks"));
  EXPECT_FALSE(table.hasLayer("")) << "of no picture";
}
} // namespace
