// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCompare.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJournal.h"
#include "dgtkLdi.h"
#include "dgtkTestImages.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;

namespace
{
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

void writeValues(const std::string& path, const std::vector<double>& values, int width)
{
  Rows rows(PixelType::Float64, 1, width, 0, int(values.size()) / width);
  std::copy(values.begin(), values.end(), rows.row<double>(0));
  writeImage("npy", path, specOf(PixelType::Float64, 1), rows, 1, {});
}
} // namespace

TEST(Compare, NamesOfAnyBytesArePrintable)
{
  CompareResult result;
  result.path = "l\xe4"
                "ft\n/x.png";
  result.problem = "only in b\x1b\xfc";
  EXPECT_EQ(describe(result), "l\\xE4ft\\x0A/x.png: only in b\\x1B\\xFC");
}

TEST(Compare, CountsAndPlacesDifferences)
{
  const TemporaryFolder folder;
  writeValues(folder.path("a.npy"), { notANumber, infinite, 1, 2, 3, 4 }, 3);
  writeValues(folder.path("b.npy"), { notANumber, infinite, 1.5, 2, 7, 8 }, 3);
  const CompareResult result = compareFiles(folder.path("a.npy"), folder.path("b.npy"));
  EXPECT_FALSE(result.equal);
  EXPECT_EQ(result.pixels, 6u);
  EXPECT_EQ(result.differing, 3u);
  EXPECT_EQ(result.largest, 4);
  EXPECT_EQ(result.firstX, 2);
  EXPECT_EQ(result.firstY, 0);
  EXPECT_EQ(result.worstX, 1);
  EXPECT_EQ(result.worstY, 1);
  EXPECT_EQ(describe(result), "3 of 6 pixels differ, the first at (2, 0); largest difference 4 at (1, 1)");
  EXPECT_THAT(compareJson(result), HasSubstr("\"largest\": 4.0,\n  \"first\": [2, 0],\n  \"worst\": [1, 1]\n}"));
}

TEST(Compare, TablesMayHaveNoRows)
{
  const TemporaryFolder folder;
  const std::string shape = "{'descr': '<f8', 'fortran_order': False, 'shape': (0, 3), }\n";
  for (const char* const name : { "none.npy", "empty.npy" })
  {
    writeFile(folder.path(name), std::string("\x93NUMPY\x01\0", 8) + char(shape.size()) + '\0' + shape);
  }
  writeValues(folder.path("one.npy"), { 1, 2, 3 }, 3);
  const CompareResult same = compareFiles(folder.path("none.npy"), folder.path("empty.npy"));
  EXPECT_TRUE(same.equal);
  EXPECT_EQ(same.pixels, 0u);
  const CompareResult other = compareFiles(folder.path("none.npy"), folder.path("one.npy"));
  EXPECT_FALSE(other.equal);
  EXPECT_EQ(other.problem, "3 x 0 pixels of 1 x float64 against 3 x 1 pixels of 1 x float64");
  EXPECT_THROW(openLayerFile(folder.path("none.npy")), InputError) << "no image";
}

TEST(Compare, InvalidAgainstValidIsInfinite)
{
  const TemporaryFolder folder;
  writeValues(folder.path("a.npy"), { notANumber, infinite, 0 }, 3);
  writeValues(folder.path("b.npy"), { 1, -infinite, -0.0 }, 3);
  const CompareResult result = compareFiles(folder.path("a.npy"), folder.path("b.npy"));
  EXPECT_EQ(result.differing, 2u);
  EXPECT_EQ(result.largest, infinite);
  EXPECT_EQ(result.worstX, 0);
  EXPECT_THAT(compareJson(result), HasSubstr("\"largest\": null"));
}

TEST(Compare, TolerancesHoldToTheLastPixel)
{
  const TemporaryFolder folder;
  writeValues(folder.path("a.npy"), { 0, 0, 0, 0 }, 2);
  writeValues(folder.path("b.npy"), { 0, 0.5, -0.75, notANumber }, 2);
  const auto equal = [&](const CompareTolerance& tolerance)
  { return compareFiles(folder.path("a.npy"), folder.path("b.npy"), tolerance).equal; };
  EXPECT_FALSE(equal({}));
  EXPECT_TRUE(equal({ 0.75, 1, {} }));
  EXPECT_FALSE(equal({ 0.7499, 1, {} }));
  EXPECT_TRUE(equal({ 0.7499, 2, {} }));
  EXPECT_TRUE(equal({ 0.75, {}, 0.25 }));
  EXPECT_FALSE(equal({ 0.75, {}, 0.2499 }));
  EXPECT_FALSE(equal({ 0.75, 0, 0.25 }));
  EXPECT_FALSE(equal({ 1e300, {}, {} })) << "nothing is near a value that is not there";
  EXPECT_TRUE((CompareTolerance{ 0, {}, 0.29 }.allows(29, 100)));
  EXPECT_FALSE((CompareTolerance{ 0, {}, 0.29 }.allows(30, 100)));
  EXPECT_TRUE((CompareTolerance{ 0, {}, 0.29 }.allows(0, 0)));
}

TEST(Compare, OtherFormatsAndTypesByValue)
{
  const TemporaryFolder folder;
  const LayerSpec wide = specOf(PixelType::Float64, 1);
  const Rows image = testImage(wide, 20, 10);
  writeImage("npy", folder.path("a.npy"), wide, image, 4, {});
  writeImage("dgd", folder.path("a.dgd"), wide, image, 4, {});
  writeImage("exr", folder.path("a.exr"), wide, image, 4, {});
  const CompareResult same = compareFiles(folder.path("a.npy"), folder.path("a.dgd"));
  EXPECT_TRUE(same.equal);
  EXPECT_FALSE(same.sameBytes);
  EXPECT_EQ(describe(same), "the same pixels in other bytes");
  EXPECT_LT(compareFiles(folder.path("a.npy"), folder.path("a.exr")).largest, 1e-4);
  writeImage("npy", folder.path("b.npy"), wide, testImage(wide, 10, 20), 4, {});
  EXPECT_EQ(compareFiles(folder.path("a.npy"), folder.path("b.npy")).problem,
    "20 x 10 pixels of 1 x float64 against 10 x 20 pixels of 1 x float64");
  EXPECT_THROW(compareFiles(folder.path("a.npy"), folder.path("none.npy")), InputError);
}

TEST(Compare, ImagesOfOtherShapesAreNotComparedPixelByPixel)
{
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, int channels, int width, int height)
  {
    Rows rows(PixelType::Float64, channels, width, 0, height);
    writeImage("npy", folder.path(name), specOf(PixelType::Float64, channels), rows, 1, {});
  };
  write("a.npy", 2, 4, 3);
  int number = 0;
  for (const auto& [channels, width, height] : { std::tuple(1, 4, 3), { 2, 5, 3 }, { 2, 4, 2 } })
  {
    const std::string name = std::to_string(++number) + ".npy";
    write(name, channels, width, height);
    const CompareResult result = compareFiles(folder.path("a.npy"), folder.path(name));
    EXPECT_FALSE(result.equal);
    EXPECT_THAT(result.problem, HasSubstr("4 x 3 pixels of 2 x float64 against ")) << name;
  }
}

TEST(Compare, TheBeginningOfAFileIsNotTheFile)
{
  const TemporaryFolder folder;
  writeFile(folder.path("a.txt"), "text");
  writeFile(folder.path("b.txt"), "text, and more");
  for (const auto& [a, b] : { std::pair("a.txt", "b.txt"), std::pair("b.txt", "a.txt") })
  {
    const CompareResult result = compareFiles(folder.path(a), folder.path(b));
    EXPECT_FALSE(result.equal || result.sameBytes) << a;
  }
}

TEST(Compare, DeepFilesOnOneSideAreComparedByTheirBytes)
{
  const TemporaryFolder folder;
  Rows rows(PixelType::Float32, 1, 2, 0, 1);
  std::fill_n(rows.row<float>(0), 2, 1.0f);
  writeImage("exr", folder.path("flat.exr"), specOf(PixelType::Float32, 1), rows, 1, {});
  const auto writer = makeLdiWriter("exr", folder.path("deep.exr"), 2, 1);
  LdiRows none;
  none.y = 0;
  none.height = 1;
  none.counts = { 0, 0 };
  writer->write(none);
  writer->finish();
  for (const auto& [a, b] : { std::pair("flat.exr", "deep.exr"), std::pair("deep.exr", "flat.exr") })
  {
    const CompareResult result = compareFiles(folder.path(a), folder.path(b));
    EXPECT_FALSE(result.equal);
    EXPECT_EQ(result.problem, "the bytes differ");
  }
}

TEST(Compare, DatasetsFileByFile)
{
  const TemporaryFolder folder;
  for (const char* name : { "one", "two" })
  {
    const std::string dir = folder.path(name);
    makeFolders(dir);
    Manifest manifest;
    manifest.request = { { "tile", name } };
    for (const char* file : { "a.npy", "b.npy", "c.txt" })
    {
      manifest.files.push_back({ file, 0, std::string(64, '0'), "", "", -1 });
    }
    writeValues(dir + "/a.npy", { 1, 2 }, 2);
    writeValues(dir + "/b.npy", { 1, 2 }, 2);
    writeFile(dir + "/c.txt", "text");
    writeFile(dir + "/manifest.json", manifestText(manifest));
  }
  const auto compare = [&] { return compareDatasets(folder.path("one"), folder.path("two")); };
  DatasetComparison result = compare();
  EXPECT_TRUE(result.equal);
  EXPECT_EQ(result.files, 3u);
  EXPECT_TRUE(result.differing.empty());
  EXPECT_EQ(result.manifest, std::vector<std::string>{ "request: tile" });

  writeValues(folder.path("two/b.npy"), { 1, 2.5 }, 2);
  writeFile(folder.path("two/c.txt"), "test");
  std::filesystem::remove(folder.path("one/a.npy"));
  result = compare();
  EXPECT_FALSE(result.equal);
  ASSERT_EQ(result.differing.size(), 3u);
  EXPECT_EQ(describe(result.differing[0]), "a.npy: is missing in " + folder.path("one"));
  EXPECT_EQ(result.differing[1].largest, 0.5);
  EXPECT_EQ(describe(result.differing[2]), "c.txt: the bytes differ");
  EXPECT_THAT(compareJson(result), HasSubstr("\"equal\": false"));
  EXPECT_THROW(compareDatasets(folder.path("one"), folder.path("none")), InputError);
}

// A journal is not part of what a run makes; links are.
TEST(Compare, FoldersWithoutAManifestAreComparedWhole)
{
  const TemporaryFolder folder;
  for (const std::string name : { "one", "two" })
  {
    makeFolders(folder.path(name + "/deep"));
    writeFile(folder.path(name + "/deep/a.txt"), "text");
    writeFile(folder.path(name + '/' + journalName), name);
  }
  const auto compare = [&] { return compareDatasets(folder.path("one"), folder.path("two")); };
  EXPECT_TRUE(compare().equal);
  EXPECT_EQ(compare().files, 1u);
  std::filesystem::create_symlink("nowhere", folder.path("two/link"));
  EXPECT_FALSE(compare().equal);
  EXPECT_EQ(compare().files, 2u);
}

TEST(Compare, TolerancesAreOfLayersThatTheDatasetHas)
{
  const TemporaryFolder folder;
  Manifest manifest;
  manifest.layers.push_back({ specOf(PixelType::UInt32, 1, "objects"), "npy" });
  manifest.layers.back().spec.unit = "id";
  manifest.layers.push_back({ specOf(PixelType::Float64, 1, "depth"), "npy" });
  manifest.files = { { "a.npy", 0, std::string(64, '0'), "depth", "", -1 },
    { "b.npy", 0, std::string(64, '0'), "objects", "", -1 }, { "c.txt", 0, std::string(64, '0'), "", "", -1 },
    { "d.json", 0, std::string(64, '0'), "boxes", "", -1 }, { "e.exr", 0, std::string(64, '0'), "ldi", "", -1 },
    { "f.png", 0, std::string(64, '0'), "color", "", -1 } };
  writeFile(folder.path("manifest.json"), manifestText(manifest));
  writeValues(folder.path("a.npy"), { 1, 2 }, 2);
  writeValues(folder.path("b.npy"), { 1, 2 }, 2);
  writeFile(folder.path("c.txt"), "text");
  const auto refusal = [&](const std::string& layer, const CompareTolerance& tolerance) -> std::string {
    return thrownBy<UsageError>([&] { compareDatasets(folder.path(), folder.path(), { { layer, tolerance } }); });
  };
  EXPECT_EQ(refusal("depth", { 1, {}, {} }), "");
  EXPECT_THAT(
    refusal("colour", { 1, {}, {} }), HasSubstr("has no such layer (it has boxes, color, depth, ldi, objects)"));
  EXPECT_THAT(refusal("", { 1, {}, {} }), HasSubstr("has no such layer")); // files of no layer are not one
  EXPECT_THAT(refusal("objects", { 1, {}, {} }), HasSubstr("its values are names"));
  EXPECT_EQ(refusal("objects", { 0, 3, {} }), "");
  const auto deep = makeLdiWriter("exr", folder.path("e.exr"), 1, 1);
  LdiRows none;
  none.height = 1;
  none.counts = { 0 };
  deep->write(none);
  deep->finish();
  EXPECT_EQ(refusal("boxes", { 0, 3, {} }), "a tolerance for boxes: its files are no images");
  EXPECT_EQ(refusal("ldi", { 1, {}, {} }), "a tolerance for ldi: its files are no images");
  EXPECT_EQ(refusal("color", { 1, {}, {} }), "") << "its only picture is missing";
  for (const char* unit : { "class", "pixels, class" })
  {
    manifest.layers[0].spec.unit = unit;
    writeFile(folder.path("manifest.json"), manifestText(manifest));
    EXPECT_THAT(refusal("objects", { 1, {}, {} }), HasSubstr("its values are names"));
  }
}
