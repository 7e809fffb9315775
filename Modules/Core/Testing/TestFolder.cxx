// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkFolder.h"
#include "dgtkPathNames.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <map>

#include <fcntl.h>
#include <sys/stat.h>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace
{
/// data/ with a file and links of every kind, outside/ with a file.
struct Hostile : testing::Test
{
  Hostile()
  {
    makeFolders(this->place.path("data/in"));
    makeFolders(this->place.path("outside"));
    writeFile(this->place.path("data/in/file"), "ours");
    writeFile(this->place.path("outside/file"), "theirs");
    fs::create_symlink("../outside", this->place.path("data/out"));
    fs::create_symlink("../outside/file", this->place.path("data/link"));
    fs::create_symlink("../outside/new", this->place.path("data/dangling"));
    fs::create_symlink("loop", this->place.path("data/loop"));
    fs::create_symlink("in", this->place.path("data/inside"));
    EXPECT_EQ(::mkfifo(this->place.path("data/pipe").c_str(), 0600), 0);
  }
  ~Hostile() override
  {
    EXPECT_EQ(contentsOf(this->place.path("outside/file")), "theirs");
    EXPECT_EQ(std::distance(fs::directory_iterator(this->place.path("outside")), fs::directory_iterator()), 1);
  }

  TemporaryFolder place;
  const Folder data{ place.path("data") };
};
} // namespace

TEST(Folder, PlainNamesStayInside)
{
  for (const char* name : { "a", "a/b", "a.b/..c", ".a" })
  {
    EXPECT_TRUE(Folder::isPlain(name)) << name;
  }
  for (const char* name : { "", "/", "/a", "a/", "a//b", ".", "..", "a/./b", "a/..", "../a" })
  {
    EXPECT_FALSE(Folder::isPlain(name)) << name;
    EXPECT_THROW(Folder("/tmp").look(name), UsageError) << name;
  }
  EXPECT_FALSE(Folder::isPlain(std::string("a\0b", 3)));
}

TEST_F(Hostile, LooksWithoutFollowing)
{
  const std::map<std::string, EntryKind> kinds = { { "in", EntryKind::Folder }, { "in/file", EntryKind::File },
    { "in/none", EntryKind::Nothing }, { "none/none", EntryKind::Nothing }, { "out", EntryKind::Link },
    { "out/file", EntryKind::Blocked }, { "inside/file", EntryKind::Blocked }, { "link", EntryKind::Link },
    { "dangling", EntryKind::Link }, { "loop", EntryKind::Link }, { "loop/x", EntryKind::Blocked },
    { "pipe", EntryKind::Other }, { "in/file/x", EntryKind::Blocked } };
  std::set<std::string> names;
  for (const auto& [name, kind] : kinds)
  {
    EXPECT_EQ(this->data.look(name), kind) << name;
    names.insert(name);
  }
  std::size_t seen = 0;
  this->data.look(names,
    [&](const std::string& name, EntryKind kind)
    {
      ++seen;
      EXPECT_EQ(kind, kinds.at(name)) << name;
    });
  EXPECT_EQ(seen, names.size());
}

TEST_F(Hostile, OpensNothingThroughLinks)
{
  for (const char* name : { "out/file", "out/new", "link", "dangling", "loop", "inside/file" })
  {
    EXPECT_FALSE(this->data.open(name, O_WRONLY | O_CREAT | O_TRUNC)) << name;
  }
  EXPECT_TRUE(this->data.open("in/file", O_RDONLY));
}

TEST_F(Hostile, RemovesLinksAndNotWhatTheyLeadTo)
{
  for (const char* name : { "link", "dangling", "loop", "out", "inside", "pipe", "in/file" })
  {
    EXPECT_TRUE(this->data.remove(name)) << name;
    EXPECT_EQ(this->data.look(name), EntryKind::Nothing) << name;
    EXPECT_FALSE(this->data.remove(name)) << name;
  }
  EXPECT_FALSE(this->data.remove("in"));
  this->data.removeEmptyParents("in/file");
  EXPECT_EQ(this->data.look("in"), EntryKind::Nothing);
}

TEST_F(Hostile, MakesNoFoldersThroughLinks)
{
  this->data.makeParents("in/a/b/file");
  EXPECT_EQ(this->data.look("in/a/b"), EntryKind::Folder);
  for (const char* name : { "out/a/file", "inside/a/file", "dangling/file", "loop/file", "pipe/file", "in/file/x" })
  {
    errno = 0; // of what failed last
    try
    {
      this->data.makeParents(name);
      ADD_FAILURE() << name;
    }
    catch (const MachineError& error)
    {
      EXPECT_THAT(error.what(), HasSubstr("a link or a file stands where a folder has to be")) << name;
    }
  }
}

TEST_F(Hostile, ReplacesTheLinkNotItsTarget)
{
  writeFile(this->place.path("data/new"), "new");
  this->data.rename("new", "link");
  EXPECT_EQ(this->data.look("link"), EntryKind::File);
  EXPECT_EQ(contentsOf(this->place.path("data/link")), "new");
}

TEST_F(Hostile, MayBeALinkItself)
{
  fs::create_symlink("data", this->place.path("named"));
  EXPECT_EQ(Folder(this->place.path("named")).look("in/file"), EntryKind::File);
}

TEST_F(Hostile, NamesOfPathsAreThoseOfTheSystem)
{
  PathNames names;
  for (int again = 0; again < 2; ++again)
  {
    for (const char* name : { "data/in/file", "data/out/file", "data/link", "data/inside/file", "data/dangling",
           "data/pipe", "data/in/../out/./file", "data//in/", "data/out/..", "data/none/file", "none", "." })
    {
      const std::string path = this->place.path(name);
      EXPECT_EQ(names.of(path), fs::weakly_canonical(path).string()) << name;
      EXPECT_EQ(names.relative(path, this->place.path("data/inside")),
        fs::relative(path, this->place.path("data/inside")).generic_string())
        << name;
    }
  }
  EXPECT_EQ(names.of("/"), "/");
  EXPECT_EQ(names.of("a/../b"), fs::weakly_canonical(fs::absolute("a/../b")).string());
}

TEST(PathNames, AMessageHasNoWayInAndOutAgain)
{
  const dgtk::test::TemporaryFolder folder;
  dgtk::makeFolders(folder.path("a/b"));
  dgtk::makeFolders(folder.path("c"));
  fs::create_symlink(folder.path("a/b"), folder.path("link"));
  EXPECT_EQ(dgtk::tidied(folder.path("c/../a/b/../none.ac")), folder.path("a/none.ac"));
  EXPECT_EQ(dgtk::tidied(folder.path("c/./x.ac")), folder.path("c/./x.ac"));
  for (const std::string& same : { std::string("../../x"), std::string(".."), std::string(), folder.path("x") })
  {
    EXPECT_EQ(dgtk::tidied(same), same);
  }
  EXPECT_EQ(dgtk::tidied(folder.path("link/../x")), folder.path("link/../x")) << "it is a/x";
}
