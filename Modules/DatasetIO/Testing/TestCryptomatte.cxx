// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCryptomatte.h"
#include "dgtkError.h"
#include "dgtkLayerReader.h"
#include "dgtkTestSupport.h"

#include <OpenImageIO/imageio.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <set>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
LayerSpec coverageSpec()
{
  LayerSpec spec;
  spec.name = "coverage";
  spec.type = PixelType::Float32;
  spec.channels = 12;
  spec.meaning = Meaning::Coverage;
  return spec;
}
} // namespace

TEST(Cryptomatte, MurmurHash3KnownValues)
{
  const auto hash = [](const std::string& text) { return murmurHash3(text.data(), text.size()); };
  EXPECT_EQ(hash(""), 0u);
  EXPECT_EQ(hash("hello"), 0x248bfa47u);
  EXPECT_EQ(hash("test"), 0xba6bd213u);
  EXPECT_EQ(hash("Hello, world!"), 0xc0363e43u);
  EXPECT_EQ(hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

TEST(Cryptomatte, IdsAreNormalNumbers)
{
  EXPECT_EQ(cryptomatteHash(""), 0x00800000u); // a hash of 0 would be the background
  std::set<std::uint32_t> kinds;
  for (int i = 0; i < 5000; ++i)
  {
    const std::string name = "object " + std::to_string(i);
    EXPECT_TRUE(std::isnormal(cryptomatteId(name))) << name;
    const std::uint32_t hash = murmurHash3(name.data(), name.size());
    const std::uint32_t exponent = hash >> 23 & 255;
    kinds.insert(exponent == 0 || exponent == 255 ? exponent : 1);
    EXPECT_EQ(cryptomatteHash(name) == hash, exponent != 0 && exponent != 255);
  }
  EXPECT_EQ(kinds.size(), 3u) << "names with both exponents were expected";
}

TEST(Cryptomatte, NamesBecomeDistinct)
{
  EXPECT_EQ(
    distinctNames({ "a", "b", "a", "", "a#3", "" }), (std::vector<std::string>{ "a", "b", "a#3#", "#4", "a#3", "#6" }));
}

TEST(Cryptomatte, ReadBackByOpenImageIO)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("c.exr");
  constexpr int width = 5;
  constexpr int height = 40;
  const std::vector<std::string> names{ "chair \"x\"", "table", "lamp", "d", "e", "f", "g" };
  CryptomatteWriter writer(path, coverageSpec(), width, height, names, 6);
  std::mt19937 random(2);
  std::vector<std::vector<CoveredId>> expected;
  while (expected.size() < width * height)
  {
    std::vector<CoveredId> ranks;
    // the last pixel needs seven ranks
    const auto count = static_cast<std::uint32_t>(expected.size() + 1 == width * height ? 7 : 1 + random() % 3);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const auto id = static_cast<std::uint32_t>(i == 0 ? random() % 2 : i + 1);
      ranks.push_back({ id, 1.0f / static_cast<float>(count) });
    }
    const std::uint32_t pixels =
      count == 7
        ? 1
        : static_cast<std::uint32_t>(std::min<std::size_t>(1 + random() % 8, width * height - 1 - expected.size()));
    writer.add(ranks, pixels);
    expected.insert(expected.end(), pixels, ranks);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  const FileRecord record = writer.finish();
  EXPECT_EQ(record.bytes, std::filesystem::file_size(path));

  const auto input = OIIO::ImageInput::open(path);
  ASSERT_TRUE(input);
  const OIIO::ImageSpec spec = input->spec();
  ASSERT_EQ(spec.nchannels, 16);
  const std::string prefix = "cryptomatte/" +
                             [&]
  {
    char text[9];
    std::snprintf(text, sizeof text, "%08x", cryptomatteHash("CryptoObject"));
    return std::string(text, 7);
  }() + '/';
  EXPECT_EQ(spec.get_string_attribute(prefix + "name"), "CryptoObject");
  EXPECT_EQ(spec.get_string_attribute(prefix + "hash"), "MurmurHash3_32");
  EXPECT_EQ(spec.get_string_attribute(prefix + "conversion"), "uint32_to_float32");
  EXPECT_THAT(spec.get_string_attribute(prefix + "manifest"), testing::HasSubstr("\"chair \\\"x\\\"\":\""));
  std::vector<float> values(std::size_t(width) * height * 16);
  ASSERT_TRUE(input->read_image(0, 0, 0, 16, OIIO::TypeFloat, values.data()));
  const auto channel = [&](const std::string& name)
  {
    const auto found = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
    EXPECT_NE(found, spec.channelnames.end()) << name;
    return found - spec.channelnames.begin();
  };
  for (int pixel = 0; pixel < width * height; ++pixel)
  {
    for (std::size_t rank = 0; rank < 8; ++rank)
    {
      const std::string level = "CryptoObject0" + std::to_string(rank / 2);
      const float id = values[std::size_t(pixel) * 16 + channel(level + (rank % 2 ? ".b" : ".r"))];
      const float coverage = values[std::size_t(pixel) * 16 + channel(level + (rank % 2 ? ".a" : ".g"))];
      const bool there = rank < expected[pixel].size();
      const std::uint32_t object = there ? expected[pixel][rank].id : 0;
      EXPECT_EQ(id, object == 0 ? 0.0f : cryptomatteId(names[object - 1])) << pixel << ' ' << rank;
      EXPECT_EQ(coverage, there ? expected[pixel][rank].coverage : 0.0f);
    }
  }
  // and by our own reader
  EXPECT_EQ(readLayerFile(path).info.channels, 16);
}

TEST(Cryptomatte, RunsMayPassTheEndsOfRowsAndBlocks)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("c.exr");
  constexpr int width = 5;
  constexpr int height = 300;
  CryptomatteWriter writer(path, coverageSpec(), width, height, { "a", "b" }, 2);
  writer.add({ { 1, 1.0f } }, 3);
  writer.add({ { 2, 1.0f } }, width * height - 4);
  writer.add({ { 1, 1.0f } }, 1);
  writer.finish();
  const ImageData read = readLayerFile(path);
  std::vector<std::uint64_t> changes; // pixels whose channels differ from those before
  for (std::uint64_t i = 1; i < std::uint64_t(width * height); ++i)
  {
    const float* own = read.pixels.row<float>(0) + i * std::uint64_t(read.info.channels);
    if (!std::equal(own, own + read.info.channels, own - read.info.channels))
    {
      changes.push_back(i);
    }
  }
  EXPECT_THAT(changes, testing::ElementsAre(3u, std::uint64_t(width * height - 1)));
}

TEST(Cryptomatte, RefusesAnIncompleteImage)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("c.exr");
  CryptomatteWriter writer(path, coverageSpec(), 4, 2, { "a" }, 6);
  writer.add({ { 1, 1.0f } }, 7);
  EXPECT_THROW(writer.finish(), UsageError);
  EXPECT_FALSE(std::filesystem::exists(path));
}
