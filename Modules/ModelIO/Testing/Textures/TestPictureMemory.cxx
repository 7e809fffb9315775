// SPDX-License-Identifier: BSD-3-Clause
// What pictures of strangers may cost: memory, and the process that decodes them.
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelReader.h"
#include "dgtkTestSupport.h"
#include "dgtkTextureFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <sys/resource.h>

using namespace dgtk::test;
using testing::HasSubstr;

namespace
{
/// A header that promises 16384 x 16384 pixels, and as many bytes as a sound file could have.
std::string hugePng()
{
  const auto big = [](std::uint32_t v) { return std::string{ char(v >> 24), char(v >> 16), char(v >> 8), char(v) }; };
  const std::string header = big(16384) + big(16384) + std::string("\x08\x02\x00\x00\x00", 5);
  // zlib's crc of "IHDR" and the header
  return "\x89PNG\r\n\x1a\n" + big(13) + "IHDR" + header + big(0x26aa87d3u) + big(900000) + "IDAT" +
         std::string(900000, '\0');
}

std::string modelWith(const std::vector<std::string>& textures)
{
  std::string text = "AC3Db\nMATERIAL \"a\" rgb 1 1 1\nOBJECT world\nkids " + std::to_string(textures.size()) + '\n';
  for (const std::string& texture : textures)
  {
    text += "OBJECT poly\ntexture \"" + texture +
            "\"\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0\nmat 0\nrefs 3\n0 0 0\n1 1 0\n2 0 1\nkids 0\n";
  }
  return text;
}

/// A run of five pixels in a row of two: OpenImageIO 2.4 ends the process.
std::string deadlySgi()
{
  std::string bytes(512, '\0');
  bytes.replace(0, 12, std::string("\x01\xda\x01\x01\0\x02\0\x02\0\x01\0\x01", 12));
  bytes[19] = '\xff';
  return bytes + std::string("\0\0\x02\x08\0\0\0\x03\x85\x01\x02", 11);
}

/// Addresses this process may take beyond those that it has, for as long as the object lives.
class FewAddresses
{
public:
  explicit FewAddresses(std::uint64_t bytes)
  {
    ::getrlimit(RLIMIT_AS, &this->Before);
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit now = this->Before;
    now.rlim_cur = pages * 4096 + bytes;
    ::setrlimit(RLIMIT_AS, &now);
  }
  ~FewAddresses() { ::setrlimit(RLIMIT_AS, &this->Before); }
  FewAddresses(const FewAddresses&) = delete;
  FewAddresses& operator=(const FewAddresses&) = delete;

private:
  rlimit Before{};
};

/// What is decoded where the machine has too little room for any picture: 0 a picture, 1 none, 2 the machine's fault.
int decodedInLittleRoom(const std::string& path)
{
  const FewAddresses few(std::uint64_t(200) << 20); // a decoder has 512 MiB
  std::string problem;
  try
  {
    return dgtk::decodeTexture(path, problem) ? 0 : 1;
  }
  catch (const dgtk::MachineError&)
  {
    return 2;
  }
}
} // namespace

TEST(PictureMemory, APictureThatEndsItsDecoderCostsItself)
{
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("bad.rgb"), deadlySgi());
  dgtk::writeFile(folder.path("good.ppm"), "P6 1 1 255\nabc");
  std::string problem;
  EXPECT_FALSE(dgtk::decodeTexture(folder.path("bad.rgb"), problem));
  EXPECT_EQ(problem, "is damaged: its decoder ended abnormally (signal 6, Aborted)");
  EXPECT_FALSE(dgtk::decodeRadiance(folder.path("bad.rgb"), problem));
  EXPECT_THAT(problem, HasSubstr("ended abnormally"));
  EXPECT_TRUE(dgtk::decodeTexture(folder.path("good.ppm"), problem)) << problem;
  dgtk::writeFile(folder.path("m.ac"), modelWith({ "bad.rgb", "good.ppm" }));
  const auto model = dgtk::readModel(folder.path("m.ac"));
  ASSERT_EQ(model->textures.size(), 2u);
  EXPECT_FALSE(model->textures[0].image);
  EXPECT_TRUE(model->textures[1].image);
  ASSERT_EQ(model->warnings.size(), 1u);
  EXPECT_THAT(model->warnings[0], HasSubstr("bad.rgb cannot be decoded: is damaged"));
}

TEST(PictureMemory, AllTexturesOfAModelHaveOneBudget)
{
  const TemporaryFolder folder;
  std::vector<std::string> names;
  for (int i = 0; i < 10; ++i)
  {
    names.push_back("huge" + std::to_string(i) + ".png");
    dgtk::writeFile(folder.path(names.back()), hugePng());
  }
  dgtk::writeFile(folder.path("m.ac"), modelWith(names));
  EXPECT_EQ(thrownBy<dgtk::MachineError>([&] { dgtk::readModel(folder.path("m.ac")); }),
    folder.path("huge4.png") +
      ": a texture of 16384 x 16384 pixels; with it, all textures take 5120 MiB of memory, more than the 4096 MiB "
      "that they may (DGTK_TEXTURE_MEMORY raises it)")
    << "ten textures of 1 GiB";
  dgtk::ReadOptions located;
  located.decodeTextures = false;
  EXPECT_EQ(dgtk::readModel(folder.path("m.ac"), located)->textures.size(), 10u);
}

TEST(PictureMemory, AStoreIsSharedAndItsMemoryIsSet)
{
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("a.ppm"), "P6 2 1 255\nabcdef");
  dgtk::writeFile(folder.path("m.ac"), modelWith({ "a.ppm", "A.ppm" })); // one file, once
  dgtk::ReadOptions options;
  options.textures = std::make_shared<dgtk::TextureStore>(16);
  EXPECT_TRUE(dgtk::readModel(folder.path("m.ac"), options)->textures[1].image);
  std::string problem;
  const auto image = dgtk::decodeTexture(folder.path("a.ppm"), problem, options.textures.get());
  EXPECT_EQ(image, dgtk::readModel(folder.path("m.ac"), options)->textures[1].image) << "decoded once";
  dgtk::writeFile(folder.path("b.ppm"), "P6 2 1 255\nabcdef");
  EXPECT_TRUE(dgtk::decodeTexture(folder.path("b.ppm"), problem, options.textures.get()));
  dgtk::writeFile(folder.path("c.ppm"), "P6 2 1 255\nabcdef");
  EXPECT_THROW(dgtk::decodeTexture(folder.path("c.ppm"), problem, options.textures.get()), dgtk::MachineError);
  dgtk::TextureStore none(100);
  for (int i = 0; i < 2; ++i)
  {
    EXPECT_FALSE(dgtk::decodeTexture(folder.path("d.ppm"), problem, &none)) << "each one is told";
    EXPECT_THAT(problem, HasSubstr("cannot be opened"));
  }
  dgtk::TextureStore light(23); // three floats a pixel
  EXPECT_THROW(dgtk::decodeRadiance(folder.path("a.ppm"), problem, &light), dgtk::MachineError);
  ::setenv("DGTK_TEXTURE_MEMORY", "0", 1);
  EXPECT_THROW(dgtk::readModel(folder.path("m.ac")), dgtk::MachineError);
  ::setenv("DGTK_TEXTURE_MEMORY", "1", 1);
  EXPECT_TRUE(dgtk::readModel(folder.path("m.ac"))->textures[0].image);
  ::setenv("DGTK_TEXTURE_MEMORY", "a lot", 1);
  EXPECT_THROW(dgtk::readModel(folder.path("m.ac")), dgtk::MachineError);
  ::unsetenv("DGTK_TEXTURE_MEMORY");
}

TEST(PictureMemory, TooLittleMemoryIsTheMachinesFault)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve terabytes of addresses";
#endif
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("a.pgm"), std::string("P5 16000 5000 255\n").append(80'000'000, 'x'));
  dgtk::writeFile(folder.path("m.ac"), modelWith({ "a.pgm" }));
  std::string problem;
  const FewAddresses few(std::uint64_t(200) << 20); // of 320 MB
  EXPECT_THROW(dgtk::decodeTexture(folder.path("a.pgm"), problem), dgtk::MachineError);
  EXPECT_THROW(dgtk::readModel(folder.path("m.ac")), dgtk::MachineError);
}

TEST(PictureMemory, InTooLittleRoomNobodyCanSayThatAPictureIsDamaged)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve terabytes of addresses";
#endif
  testing::FLAGS_gtest_death_test_style = "threadsafe"; // a program of its own has a decoder of its own
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("a.png"), "no picture");
  const auto leave = [&folder](int found)
  {
    std::filesystem::remove_all(folder.path("")); // of the program that ends here
    std::_Exit(found);
  };
  EXPECT_EXIT(leave(decodedInLittleRoom(folder.path("a.png"))), testing::ExitedWithCode(2), "");
}
