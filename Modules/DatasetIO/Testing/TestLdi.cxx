// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCompare.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkLdi.h"
#include "dgtkTestSupport.h"

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;

namespace
{
constexpr int ldiWidth = 7;
constexpr int ldiHeight = 5;

/// Pixel i holds i % 4 surfaces.
LdiRows rowsOf(int first, int count)
{
  LdiRows rows;
  rows.y = first;
  rows.height = count;
  for (int i = first * ldiWidth; i < (first + count) * ldiWidth; ++i)
  {
    rows.counts.push_back(static_cast<std::uint32_t>(i % 4));
    for (int s = 0; s < i % 4; ++s)
    {
      const auto step = static_cast<float>(i);
      const auto id = static_cast<std::uint32_t>(1000 * i + s);
      rows.surfaces.push_back({ { step / 255, 0.5f, 1.5f, s == 0 ? 1.0f : 0.25f }, 0.1 + i + s / 3.0, id * 65537u, id,
        static_cast<std::uint32_t>(s), 0xFFFFFFF0u });
    }
  }
  return rows;
}

FileRecord write(const std::string& path, const std::string& format, int block)
{
  const auto writer = makeLdiWriter(format, path, ldiWidth, ldiHeight);
  for (int y = 0; y < ldiHeight; y += block)
  {
    writer->write(rowsOf(y, std::min(block, ldiHeight - y)));
  }
  return writer->finish();
}

/// Reads all rows; "" or the message of the InputError.
std::string complaint(const std::string& path)
{
  return thrownBy<InputError>(
    [&]
    {
      LdiReader reader(path);
      for (LdiRow row; reader.read(row);)
      {
        EXPECT_LT(row.records.capacity(), 2 * std::filesystem::file_size(path) / 16 + 64);
      }
    });
}

template <typename T>
std::string with(std::string bytes, std::size_t at, T value)
{
  std::memcpy(&bytes[at], &value, sizeof value);
  return bytes;
}
} // namespace

TEST(Ldi, IsTheThesisFileByteForByte)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("a.ldi");
  const FileRecord record = write(path, "ldi", ldiHeight);
  std::string expected;
  const auto put = [&](auto value) { expected.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(std::int32_t(ldiWidth));
  put(std::int32_t(ldiHeight));
  for (std::uint32_t i = 0; i < ldiWidth * ldiHeight; ++i)
  {
    put(std::uint32_t(i % 4));
    for (std::uint32_t s = 0; s < i % 4; ++s)
    {
      put(std::uint8_t(i));
      put(std::uint8_t(128));
      put(std::uint8_t(255));
      put(std::uint8_t(s == 0 ? 255 : 64));
      put(double(0.1 + i + s / 3.0));
      put(std::uint32_t((1000 * i + s) * 65537u));
    }
  }
  EXPECT_EQ(contentsOf(path), expected);
  EXPECT_EQ(record.bytes, expected.size());
  EXPECT_EQ(record.sha256, Sha256::ofFile(path));
}

TEST(Ldi, ReadsWhatItWrote)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("a.ldi");
  write(path, "ldi", 2);
  LdiReader reader(path);
  EXPECT_EQ(reader.width(), ldiWidth);
  EXPECT_EQ(reader.height(), ldiHeight);
  for (int pass = 0; pass < 2; ++pass, reader.rewind())
  {
    LdiRow row;
    for (int y = 0; y < ldiHeight; ++y)
    {
      const LdiRows expected = rowsOf(y, 1);
      ASSERT_TRUE(reader.read(row));
      EXPECT_EQ(row.counts, expected.counts);
      ASSERT_EQ(row.records.size(), expected.surfaces.size());
      for (std::size_t i = 0; i < row.records.size(); ++i)
      {
        EXPECT_EQ(row.records[i].depth, expected.surfaces[i].depth);
        EXPECT_EQ(row.records[i].splatIndex, expected.surfaces[i].splatIndex);
        EXPECT_EQ(row.records[i].rgba[1], 128);
      }
    }
    EXPECT_FALSE(reader.read(row));
  }
}

TEST(Ldi, SurfacesOfOneDepthAreTwo)
{
  const TemporaryFolder folder;
  const auto writer = makeLdiWriter("ldi", folder.path("a.ldi"), 1, 1);
  LdiRows rows;
  rows.y = 0;
  rows.height = 1;
  rows.counts = { 3 };
  for (const double depth : { 2.0, 5.0, 5.0 })
  {
    rows.surfaces.push_back({ { 1, 1, 1, 1 }, depth, 0, 1, 0, 0 });
  }
  writer->write(rows);
  writer->finish();
  EXPECT_EQ(complaint(folder.path("a.ldi")), "");
  const std::string bytes = contentsOf(folder.path("a.ldi"));
  writeFile(folder.path("b.ldi"), with(bytes, bytes.size() - 12, std::nextafter(5.0, 0.0)));
  EXPECT_THAT(complaint(folder.path("b.ldi")), HasSubstr("nearer than the one before"));
}

TEST(Ldi, LargeFilesAreReadTwice)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("a.ldi");
  constexpr int side = 300; // 1.8 MB, more than is read at once
  const auto writer = makeLdiWriter("ldi", path, side, side);
  for (int y = 0; y < side; ++y)
  {
    LdiRows rows;
    rows.y = y;
    rows.height = 1;
    rows.counts.assign(side, 1);
    rows.surfaces.resize(side);
    for (int x = 0; x < side; ++x)
    {
      rows.surfaces[x].depth = y * side + x;
    }
    writer->write(rows);
  }
  writer->finish();
  LdiReader reader(path);
  for (int pass = 0; pass < 2; ++pass, reader.rewind())
  {
    LdiRow row;
    double depth = 0;
    while (reader.read(row))
    {
      for (const LdiRecord& record : row.records)
      {
        ASSERT_EQ(record.depth, depth++);
      }
    }
    EXPECT_EQ(depth, side * side);
  }
}

TEST(Ldi, BlocksDoNotShowInTheBytes)
{
  const TemporaryFolder folder;
  for (const std::string format : { "ldi", "exr" })
  {
    write(folder.path("1." + format), format, 1);
    write(folder.path("5." + format), format, 5);
    EXPECT_EQ(contentsOf(folder.path("1." + format)), contentsOf(folder.path("5." + format))) << format;
  }
}

TEST(Ldi, DeepExrIsReadByOpenImageIO)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("a.exr");
  const FileRecord record = write(path, "exr", 2);
  EXPECT_EQ(record.bytes, std::filesystem::file_size(path));
  EXPECT_EQ(record.sha256, Sha256::ofFile(path));
  EXPECT_FALSE(std::filesystem::exists(path + ".partial"));
  EXPECT_TRUE(isDeepExr(path));
  EXPECT_FALSE(isDeepExr(folder.path("missing")));
  const auto input = OIIO::ImageInput::open(path);
  ASSERT_TRUE(input) << OIIO::geterror();
  ASSERT_TRUE(input->spec().deep);
  OIIO::DeepData deep;
  ASSERT_TRUE(input->read_native_deep_image(0, 0, deep)) << input->geterror();
  const auto channel = [&](const char* name) { return input->spec().channelindex(name); };
  const LdiRows all = rowsOf(0, ldiHeight);
  const LdiSurface* surface = all.surfaces.data();
  for (int i = 0; i < ldiWidth * ldiHeight; ++i)
  {
    ASSERT_EQ(deep.samples(i), i % 4);
    for (int s = 0; s < i % 4; ++s, ++surface)
    {
      EXPECT_EQ(deep.deep_value(i, channel("Z"), s), static_cast<float>(surface->depth));
      EXPECT_EQ(deep.deep_value(i, channel("A"), s), surface->rgba[3]);
      EXPECT_NEAR(deep.deep_value(i, channel("G"), s), 0.21404114f * surface->rgba[3], 1e-6f);
      EXPECT_EQ(deep.deep_value_uint(i, channel("id"), s), surface->object);
      EXPECT_EQ(deep.deep_value_uint(i, channel("part"), s), surface->part);
      EXPECT_EQ(deep.deep_value_uint(i, channel("triangle"), s), surface->triangle);
    }
  }
}

TEST(Ldi, FilesAreComparedByTheirBytes)
{
  const TemporaryFolder folder;
  for (const std::string format : { "ldi", "exr" })
  {
    write(folder.path("a." + format), format, 1);
    write(folder.path("b." + format), format, 2);
    EXPECT_TRUE(compareFiles(folder.path("a." + format), folder.path("b." + format)).equal);
    const std::string bytes = contentsOf(folder.path("b." + format));
    writeFile(folder.path("b." + format), with(bytes, bytes.size() - 1, char(bytes.back() + 1)));
    EXPECT_FALSE(compareFiles(folder.path("a." + format), folder.path("b." + format)).equal);
  }
}

TEST(Ldi, NothingIsLeftOfAFileThatIsNotFinished)
{
  const TemporaryFolder folder;
  for (const std::string format : { "ldi", "exr" })
  {
    makeLdiWriter(format, folder.path("a." + format), ldiWidth, ldiHeight)->write(rowsOf(0, 2));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Ldi, WrongRowsAreRefused)
{
  const TemporaryFolder folder;
  EXPECT_THROW(makeLdiWriter("png", folder.path("a"), 1, 1), UsageError);
  EXPECT_THROW(makeLdiWriter("ldi", folder.path("no/such/folder.ldi"), 1, 1), MachineError);
  const auto writer = makeLdiWriter("ldi", folder.path("a"), ldiWidth, ldiHeight);
  EXPECT_THROW(writer->write(rowsOf(1, 1)), UsageError);
  EXPECT_THROW(writer->finish(), UsageError);
  LdiRows missing = rowsOf(0, 1);
  missing.surfaces.pop_back();
  EXPECT_THROW(writer->write(missing), UsageError);
}

TEST(Ldi, DamagedFilesAreRefusedByName)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("a.ldi");
  write(path, "ldi", ldiHeight);
  const std::string good = contentsOf(path);
  ASSERT_EQ(complaint(path), "");
  const auto says = [&](const std::string& bytes)
  {
    writeFile(path, bytes);
    return complaint(path);
  };
  EXPECT_THAT(says(""), HasSubstr("cut off in its header"));
  EXPECT_THAT(says(good.substr(0, 7)), HasSubstr("a.ldi"));
  EXPECT_THAT(says(with(good, 0, std::int32_t(-7))), HasSubstr("a.ldi"));
  EXPECT_THAT(says(with(good, 4, std::int32_t(0))), HasSubstr("a.ldi"));
  EXPECT_THAT(says(with(good, 0, std::int32_t(1 << 23))), HasSubstr("too short for its size"));
  EXPECT_THAT(says(with(good, 8, 0xFFFFFFFFu)), HasSubstr("more records in a pixel than the rest of the file holds"));
  // all records of the file, 16 bytes each behind the header and a count of 4 bytes for each pixel
  const std::size_t records = (good.size() - 8 - 4 * std::size_t(ldiWidth * ldiHeight)) / 16;
  EXPECT_THAT(says(with(good, 8, 0xFFFFFFFFu)), HasSubstr("expected at most " + std::to_string(records) + ", found "));
  EXPECT_THAT(says(good + "x"), HasSubstr("goes on behind its last pixel"));
  // the first record stands behind the counts of pixels 0 and 1
  EXPECT_THAT(says(with(good, 20, std::numeric_limits<double>::infinity())),
    HasSubstr("offset 20: has a depth that is not finite"));
  EXPECT_THAT(says(with(good, 36 + 4, 1e9)), HasSubstr("nearer than the one before")); // of two records the first
  for (std::size_t bytes = 0; bytes < good.size(); ++bytes)
  {
    ASSERT_NE(says(good.substr(0, bytes)), "") << bytes;
  }
  EXPECT_THAT(complaint(folder.path()), HasSubstr("a directory"));
}
