// SPDX-License-Identifier: BSD-3-Clause
// Laws that hold for every row of the registry of writers.
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkLayerReader.h"
#include "dgtkTestImages.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include <sys/resource.h>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;

namespace
{
constexpr int width = 37;
constexpr int height = 43;

bool isFloat(PixelType type) { return type == PixelType::Float32 || type == PixelType::Float64; }

/// What a reader of the format returns for a value that was written.
Rows expectedImage(const std::string& format, const Rows& image)
{
  const std::size_t count = image.bytes() / bytesOf(image.type());
  if (format == "ppm" && image.type() == PixelType::UInt32)
  {
    Rows bytes(PixelType::UInt8, 3, image.width(), 0, image.height());
    for (std::size_t i = 0; i < count; ++i)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        bytes.row<std::uint8_t>(0)[i * 3 + c] =
          static_cast<std::uint8_t>(image.row<std::uint32_t>(0)[i] >> (16 - 8 * c));
      }
    }
    return bytes;
  }
  if (format == "png" && image.type() == PixelType::UInt32)
  {
    Rows words(PixelType::UInt16, 1, image.width(), 0, image.height());
    std::copy_n(image.row<std::uint32_t>(0), count, words.row<std::uint16_t>(0));
    return words;
  }
  const bool narrows = format == "exr" || format == "pfm" || format == "flo";
  Rows same(narrows ? PixelType::Float32 : image.type(), image.channels(), image.width(), 0, image.height());
  for (std::size_t i = 0; narrows && i < count; ++i)
  {
    float value = image.type() == PixelType::Float32 ? image.row<float>(0)[i] : float(image.row<double>(0)[i]);
    const auto other = [&](std::size_t k)
    { return image.type() == PixelType::Float32 ? double(image.row<float>(0)[k]) : image.row<double>(0)[k]; };
    if (format == "flo" && !(std::isfinite(other(i)) && std::isfinite(other(i ^ 1))))
    {
      value = std::numeric_limits<float>::quiet_NaN();
    }
    same.row<float>(0)[i] = value;
  }
  if (!narrows)
  {
    std::memcpy(same.data(), image.data(), image.bytes());
  }
  return same;
}

/// Calls f(format, extension, spec) for everything that can be written.
template <typename F>
void forEachWriter(F f)
{
  int count = 0;
  for (const WriterInfo& info : layerWriters())
  {
    bool any = false;
    for (const LayerSpec& spec : allSpecs())
    {
      if (canWrite(info.format, spec))
      {
        SCOPED_TRACE(info.format + " " + spec.name + " " + std::to_string(spec.channels) + " x " + nameOf(spec.type));
        f(info, spec);
        any = true;
        ++count;
      }
    }
    EXPECT_TRUE(any) << info.format << " can write nothing";
  }
  EXPECT_GT(count, 100);
}
} // namespace

TEST(LayerWriters, RoundTripFromDisk)
{
  const TemporaryFolder folder;
  forEachWriter(
    [&](const WriterInfo& info, const LayerSpec& spec)
    {
      const std::string path = folder.path("x." + info.extension);
      const Rows image = testImage(spec, width, height);
      const FileRecord record = writeImage(info.format, path, spec, image, 7, testContext());
      EXPECT_EQ(record.path, path);
      EXPECT_EQ(record.bytes, std::filesystem::file_size(path));
      EXPECT_EQ(record.sha256, Sha256::ofFile(path));
      const ImageData back = readLayerFile(path);
      EXPECT_EQ(back.info.format, info.format);
      EXPECT_EQ(back.info.width, width);
      EXPECT_EQ(back.info.height, height);
      if (info.format == "png" && isFloat(spec.type))
      {
        return; // a picture, tested on its own
      }
      const Rows expected = expectedImage(info.format, image);
      ASSERT_EQ(back.info.type, expected.type());
      ASSERT_EQ(back.info.channels, expected.channels());
      if (info.format == "flo")
      {
        for (std::size_t i = 0; i < expected.bytes() / 4; ++i)
        {
          const float e = expected.row<float>(0)[i];
          const float b = back.pixels.row<float>(0)[i];
          ASSERT_TRUE(e == b || (std::isnan(e) && std::isnan(b))) << i;
        }
        return;
      }
      EXPECT_EQ(std::memcmp(back.pixels.data(), expected.data(), expected.bytes()), 0);
    });
}

TEST(LayerWriters, BlockHeightsDoNotShow)
{
  const TemporaryFolder folder;
  forEachWriter(
    [&](const WriterInfo& info, const LayerSpec& spec)
    {
      const Rows image = testImage(spec, width, height);
      const std::string path = folder.path("x." + info.extension);
      writeImage(info.format, path, spec, image, height, testContext());
      const std::string whole = contentsOf(path);
      for (const int block : { 1, 16, 19 })
      {
        writeImage(info.format, path, spec, image, block, testContext());
        EXPECT_EQ(contentsOf(path), whole) << block;
      }
    });
}

TEST(LayerWriters, UnfinishedLeavesNothingAndHarmsNothing)
{
  forEachWriter(
    [&](const WriterInfo& info, const LayerSpec& spec)
    {
      const TemporaryFolder folder;
      const std::string path = folder.path("x." + info.extension);
      for (const bool existing : { false, true })
      {
        if (existing)
        {
          writeImage(info.format, path, spec, testImage(spec, 3, 2), 2, testContext());
        }
        const std::string before = existing ? contentsOf(path) : "";
        {
          const auto writer = makeLayerWriter(info.format, path, spec, width, height, testContext());
          writer->write(testImage(spec, width, 20));
        }
        EXPECT_EQ(std::filesystem::exists(path), existing);
        EXPECT_EQ(existing ? contentsOf(path) : "", before);
        const auto entries = std::filesystem::directory_iterator(folder.path());
        EXPECT_EQ(std::distance(begin(entries), end(entries)), existing ? 1 : 0);
      }
    });
}

TEST(LayerWriters, RefuseRowsOutOfPlace)
{
  const TemporaryFolder folder;
  forEachWriter(
    [&](const WriterInfo& info, const LayerSpec& spec)
    {
      const auto writer =
        makeLayerWriter(info.format, folder.path("x." + info.extension), spec, width, height, testContext());
      EXPECT_THROW(writer->write(Rows(spec.type, spec.channels, width, 1, 1)), UsageError);
      EXPECT_THROW(writer->write(Rows(spec.type, spec.channels, width - 1, 0, 1)), UsageError);
      EXPECT_THROW(writer->write(Rows(spec.type, spec.channels + 1, width, 0, 1)), UsageError);
      EXPECT_THROW(writer->write(testImage(spec, width, height + 1)), UsageError);
      EXPECT_THROW(writer->finish(), UsageError);
    });
}

// Beyond the limit a write fails as on a full disk.
TEST(LayerWriters, FullDiskIsOneLineAndHarmsNothing)
{
  const TemporaryFolder folder;
  forEachWriter(
    [&](const WriterInfo& info, const LayerSpec& spec)
    {
      const std::string path = folder.path("x." + info.extension);
      writeImage(info.format, path, spec, testImage(spec, 3, 2), 2, testContext());
      const std::string before = contentsOf(path);
      // noise does not compress
      Rows image = testImage(spec, width, 400);
      for (std::size_t i = 0; i < image.bytes() && !isFloat(spec.type) && spec.type != PixelType::UInt32; ++i)
      {
        image.data()[i] = static_cast<std::byte>(mixed(i));
      }
      std::signal(SIGXFSZ, SIG_IGN);
      rlimit old{};
      ::getrlimit(RLIMIT_FSIZE, &old);
      rlimit low = old;
      low.rlim_cur = 2000;
      ::setrlimit(RLIMIT_FSIZE, &low);
      const std::string message =
        thrownBy<MachineError>([&] { writeImage(info.format, path, spec, image, 8, testContext()); });
      ::setrlimit(RLIMIT_FSIZE, &old);
      EXPECT_THAT(message, HasSubstr(path + ": cannot be written: File too large"));
      EXPECT_EQ(message.find('\n'), std::string::npos);
      EXPECT_EQ(contentsOf(path), before);
      EXPECT_FALSE(std::filesystem::exists(path + ".partial"));
    });
}

TEST(LayerWriters, RefusalsSayWhatIsWrong)
{
  const TemporaryFolder folder;
  const LayerSpec depth = specOf(PixelType::Float64, 1);
  EXPECT_THAT(thrownBy<UsageError>([&] { makeLayerWriter("gif", folder.path("x"), depth, 1, 1); }),
    HasSubstr("no such format: 'gif' (there are npy, ppm, png, exr, pfm, dgd, flo)"));
  EXPECT_THAT(thrownBy<UsageError>([&] { makeLayerWriter("ppm", folder.path("x"), depth, 1, 1); }),
    HasSubstr("layer 'depth' (1 x float64) cannot be written as ppm"));
  EXPECT_THAT(thrownBy<UsageError>([&] { makeLayerWriter("npy", folder.path("x"), depth, 0, 1); }),
    HasSubstr("an image of 0 x 1 pixels cannot be written"));
  EXPECT_THAT(
    thrownBy<UsageError>([&] { makeLayerWriter("png", folder.path("x"), depth, 1, 1); }), HasSubstr("near < far"));
  const LayerSpec ids = specOf(PixelType::UInt32, 1, "objects");
  const auto writeId = [&](const char* format, std::uint32_t id)
  {
    Rows one(PixelType::UInt32, 1, 1, 0, 1);
    *one.row<std::uint32_t>(0) = id;
    writeImage(format, folder.path(std::string("x.") + format), ids, one, 1, {});
  };
  EXPECT_EQ(thrownBy<UsageError>([&] { writeId("ppm", 0xffffff); }), "");
  EXPECT_THAT(thrownBy<UsageError>([&] { writeId("ppm", 0x1000000); }),
    HasSubstr("'objects': 16777216 does not fit a 24-bit .ppm"));
  EXPECT_EQ(thrownBy<UsageError>([&] { writeId("png", 65535); }), "");
  EXPECT_THAT(
    thrownBy<UsageError>([&] { writeId("png", 65536); }), HasSubstr("'objects': 65536 does not fit a 16-bit .png"));
  EXPECT_THROW(makeLayerWriter("npy", "/proc/nowhere/x.npy", depth, 1, 1), MachineError);
}

TEST(LayerWriters, PngHasACodeForNothing)
{
  const TemporaryFolder folder;
  LayerSpec spec = specOf(PixelType::UInt32, 1, "triangles");
  spec.invalid = "4294967295";
  const auto write = [&](std::uint32_t largest)
  {
    Rows ids(PixelType::UInt32, 1, 3, 0, 1);
    ids.row<std::uint32_t>(0)[0] = 0;
    ids.row<std::uint32_t>(0)[1] = 4294967295u;
    ids.row<std::uint32_t>(0)[2] = largest;
    writeImage("png", folder.path("x.png"), spec, ids, 1, {});
  };
  write(65534);
  EXPECT_NE(contentsOf(folder.path("x.png")).find(std::string("\0\0\0\2tRNS\xff\xff", 10)), std::string::npos);
  const ImageData read = readLayerFile(folder.path("x.png"));
  ASSERT_EQ(read.info.type, PixelType::UInt32);
  EXPECT_EQ(read.pixels.row<std::uint32_t>(0)[0], 0u);
  EXPECT_EQ(read.pixels.row<std::uint32_t>(0)[1], 4294967295u);
  EXPECT_EQ(read.pixels.row<std::uint32_t>(0)[2], 65534u);
  EXPECT_THROW(write(65535), UsageError);
  EXPECT_EQ(storedSpec("png", spec).invalid, "65535");
  EXPECT_EQ(storedSpec("npy", spec).invalid, "4294967295");
  EXPECT_EQ(largestStored("png", spec), 65534u);
  EXPECT_EQ(largestStored("npy", spec), 4294967295u);

  // ids of objects keep all 16 bits, and their files the bytes that they had
  spec = specOf(PixelType::UInt32, 1, "objects");
  spec.invalid = "0";
  Rows id(PixelType::UInt32, 1, 1, 0, 1);
  *id.row<std::uint32_t>(0) = 65535;
  writeImage("png", folder.path("y.png"), spec, id, 1, {});
  EXPECT_EQ(contentsOf(folder.path("y.png")).find("tRNS"), std::string::npos);
  EXPECT_EQ(readLayerFile(folder.path("y.png")).info.type, PixelType::UInt16);
  EXPECT_EQ(largestStored("png", spec), 65535u);
  EXPECT_EQ(largestStored("ppm", spec), 0xffffffu);
}

TEST(LayerWriters, ADamagedCodeForNothingIsRefused)
{
  const TemporaryFolder folder;
  LayerSpec spec = specOf(PixelType::UInt32, 1, "parts");
  spec.invalid = "4294967295";
  Rows ids(PixelType::UInt32, 1, 1, 0, 1);
  *ids.row<std::uint32_t>(0) = 7;
  writeImage("png", folder.path("x.png"), spec, ids, 1, {});
  std::string bytes = contentsOf(folder.path("x.png"));
  const std::size_t at = bytes.find("tRNS");
  bytes[at + 4] = '\x7f';
  writeFile(folder.path("x.png"), bytes);
  EXPECT_THROW(readLayerFile(folder.path("x.png")), InputError) << "checksum";
  bytes.replace(at - 4, 4, std::string("\0\0\0\1", 4));
  writeFile(folder.path("x.png"), bytes);
  EXPECT_THROW(readLayerFile(folder.path("x.png")), InputError) << "length";
}

TEST(LayerWriters, DepthIsNeverNamedWrongly)
{
  EXPECT_TRUE(canWrite("dgd", specOf(PixelType::Float64, 1, "depth")));
  EXPECT_FALSE(canWrite("dgd", specOf(PixelType::Float64, 1, "distance")));
  EXPECT_FALSE(canWrite("nothing", specOf(PixelType::Float64, 1, "depth")));
}
