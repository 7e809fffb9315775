// SPDX-License-Identifier: BSD-3-Clause
// Readers on damaged files: an image or an InputError, nothing else.
#include "dgtkDatasetDocuments.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkTestImages.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;

namespace
{
constexpr int mutations = 2000;

/// Damages a file as seed `k` says: cuts it, changes a few bytes (mostly of the header), inserts or repeats some.
std::string damaged(const std::string& bytes, std::uint64_t k)
{
  std::string out = bytes;
  std::uint64_t state = mixed(k);
  const auto next = [&](std::uint64_t below) { return (state = mixed(state)) % below; };
  if (k % 4 == 0)
  {
    out.resize(next(out.size()));
    return out;
  }
  const std::size_t reach = k % 4 == 1 ? out.size() : std::min<std::size_t>(out.size(), 320);
  constexpr unsigned char telling[] = { 0, 1, 0x7f, 0x80, 0xff, '9', '-', '(', ' ' };
  for (std::uint64_t i = 0; i < 1 + next(4); ++i)
  {
    const std::size_t at = next(reach);
    out[at] = char(next(2) ? telling[next(sizeof telling)] : next(256));
  }
  if (k % 16 == 3)
  {
    out.insert(next(reach), out.substr(0, next(reach)));
  }
  return out;
}

void writeQuickly(const std::string& path, const std::string& bytes)
{
  // cut behind the new contents, not before: some file systems flush files that were emptied
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT, 0666);
  ASSERT_GE(file, 0);
  ASSERT_EQ(::pwrite(file, bytes.data(), bytes.size(), 0), ssize_t(bytes.size()));
  ASSERT_EQ(::ftruncate(file, off_t(bytes.size())), 0);
  ::close(file);
}

/// Reads a file in blocks; "" or the message of the InputError.
std::string readAll(const std::string& path)
{
  return thrownBy<InputError>(
    [&]
    {
      const auto reader = openLayerFile(path);
      EXPECT_LE(std::uint64_t(reader->info().width), std::uint64_t(1) << 24);
      while (reader->read(8).height() > 0)
      {
      }
    });
}

std::string messageOf(const std::string& name, const std::string& bytes)
{
  const TemporaryFolder folder;
  writeQuickly(folder.path(name), bytes);
  return readAll(folder.path(name));
}

class DamagedFiles : public testing::TestWithParam<std::string>
{
};
} // namespace

TEST_P(DamagedFiles, AreRefusedOrRead)
{
  const std::string format = GetParam();
  const TemporaryFolder folder;
  const std::string path = folder.path("x." + format);
  std::vector<LayerSpec> specs;
  for (const LayerSpec& spec : allSpecs())
  {
    if (canWrite(format, spec) && spec.name != "objects" && spec.name != "normal")
    {
      specs.push_back(spec);
    }
  }
  ASSERT_FALSE(specs.empty());
  int refused = 0;
  for (std::size_t i = 0; i < specs.size(); ++i)
  {
    writeImage(format, path, specs[i], testImage(specs[i], 23, 19), 19, testContext());
    const std::string bytes = contentsOf(path);
    for (std::size_t k = i; k < mutations; k += specs.size())
    {
      const std::string broken = damaged(bytes, k / specs.size());
      writeQuickly(path, broken);
      const std::string message = readAll(path);
      refused += !message.empty();
      if (!message.empty())
      {
        ASSERT_EQ(message.rfind(path + ":", 0), 0u) << message;
        ASSERT_EQ(message.find('\n'), std::string::npos) << message;
      }
      if (broken.size() < bytes.size())
      {
        ASSERT_FALSE(message.empty()) << "cut to " << broken.size() << " of " << bytes.size();
      }
    }
  }
  EXPECT_GT(refused, mutations / 4); // every fourth is cut
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedFiles, testing::Values("npy", "png", "ppm", "pfm", "exr", "flo", "dgd"),
  [](const auto& row) { return row.param; });

TEST(LyingHeaders, AreRefusedWithTheirOffset)
{
  EXPECT_THAT(
    messageOf("x.ppm", "P6\n60000 60000\n255\nabc"), HasSubstr("offset 22: has the wrong size for its header "
                                                               "(expected 10800000019 bytes, found 22 bytes)"));
  EXPECT_THAT(messageOf("x.ppm", "P6\n-5 3\n255\nabc"), HasSubstr("offset 3: unusable image size"));
  EXPECT_THAT(messageOf("x.ppm", "P6\n1 1\n17\nabc"), HasSubstr("unsupported largest value (expected 255 or 65535"));
  EXPECT_THAT(messageOf("x.ppm", "P7 1 1"), HasSubstr("offset 0: unexpected text (expected 'P6', found 'P7 1 1')"));
  EXPECT_THAT(messageOf("x.pfm", "PF\n99999999 1\n-1\n"), HasSubstr("offset 3: unusable image size"));
  EXPECT_THAT(messageOf("x.npy", "hello"), HasSubstr("offset 0: is not a NumPy file"));
  const auto npy = [](const std::string& dictionary)
  { return std::string("\x93NUMPY\x01\x00", 8) + char(dictionary.size()) + '\0' + dictionary; };
  EXPECT_THAT(messageOf("x.npy", npy("{'descr': '<i8', 'fortran_order': False, 'shape': (1, 1), }\n12345678")),
    HasSubstr("unsupported type of array (expected u1, u2, u4, f4 or f8"));
  EXPECT_THAT(messageOf("x.npy", npy("{'descr': '|u1', 'fortran_order': True, 'shape': (1, 1), }\n1")),
    HasSubstr("(expected 'False'"));
  EXPECT_THAT(messageOf("x.npy", npy("{'descr': '|u1', 'fortran_order': False, 'shape': (7,), }\n1")),
    HasSubstr("not the shape of an image"));
  EXPECT_THAT(messageOf("x.npy", npy("{'descr': '|u1', 'fortran_order': False, 'shape': (-1, 3), }\n1")),
    HasSubstr("unusable image size"));
  EXPECT_THAT(messageOf("x.npy", npy("{'descr': '|u1', 'fortran_order': False, 'shape': (0, 3), }\n")),
    HasSubstr("without rows"));
  EXPECT_THAT(messageOf("x.flo", "PIEHxxxxyyyy"), HasSubstr("unusable image size"));
  EXPECT_THAT(messageOf("x.dgd", std::string(264, '\0')), HasSubstr("offset 256: unusable image size"));
  EXPECT_THAT(messageOf("x.dgd", "short"), HasSubstr("offset 5: ends too early"));
  std::string png("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\xff\xff\0\0\xff\xff\x08\x06\0\0\0", 29);
  EXPECT_THAT(messageOf("x.png", png + "????"), HasSubstr("offset 33: is damaged"));
  std::uint32_t crc = ~0u; // ISO 3309, over the chunk's type and data
  for (std::size_t i = 12; i < png.size(); ++i)
  {
    crc ^= static_cast<unsigned char>(png[i]);
    for (int bit = 0; bit < 8; ++bit)
    {
      crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
  }
  for (int shift = 24; shift >= 0; shift -= 8)
  {
    png += char(~crc >> shift & 255);
  }
  EXPECT_THAT(messageOf("x.png", png), HasSubstr("offset 33: ends too early"));
  EXPECT_THAT(messageOf("x.png", png + std::string("\0\0\0\1IDAT", 8)),
    HasSubstr("offset 16: more pixels than a file of this size can hold (found 65535 x 65535)"));
  EXPECT_THAT(messageOf("x.png", "not a picture"), HasSubstr("offset 0: is not a PNG file"));
  EXPECT_THAT(messageOf("x.exr", "not a picture"), HasSubstr("offset 0: is not an OpenEXR file"));
}

TEST(LyingHeaders, OffsetsOfBlocksLieWithinTheFile)
{
  const TemporaryFolder folder;
  const LayerSpec spec = specOf(PixelType::Float32, 1);
  writeImage("exr", folder.path("x.exr"), spec, testImage(spec, 4, 4), 4, {});
  const std::string sound = contentsOf(folder.path("x.exr"));
  // The table of the one block ends where the block begins.
  std::size_t table = 0;
  for (std::size_t at = 8; table == 0 && at + 8 <= sound.size(); ++at)
  {
    std::uint64_t offset = 0;
    std::memcpy(&offset, &sound[at], 8);
    table = offset == at + 8 ? at : 0;
  }
  ASSERT_GT(table, 0u);
  for (const std::uint64_t wrong : { std::uint64_t(sound.size()) - 7, std::uint64_t(sound.size()),
         std::uint64_t(sound.size()) + 1, ~std::uint64_t(0), ~std::uint64_t(3) })
  {
    std::string bytes = sound;
    std::memcpy(&bytes[table], &wrong, 8);
    EXPECT_THAT(messageOf("y.exr", bytes),
      HasSubstr("offset " + std::to_string(table) + ": an offset beyond the end of the file"))
      << wrong;
  }
}

TEST(LyingHeaders, WholeImagesAboveTheLimitAreRefused)
{
  const TemporaryFolder folder;
  const LayerSpec spec = specOf(PixelType::Float64, 1);
  writeImage("npy", folder.path("x.npy"), spec, testImage(spec, 10, 10), 10, {});
  EXPECT_NO_THROW(readLayerFile(folder.path("x.npy"), 800));
  EXPECT_THROW(readLayerFile(folder.path("x.npy"), 799), InputError);
}

TEST(UnreadableFiles, AreInputErrors)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("d.npy"));
  EXPECT_THAT(readAll(folder.path("d.npy")), HasSubstr("(expected a file, found a directory)"));
  EXPECT_THAT(readAll(folder.path("none.npy")), HasSubstr("none.npy: cannot be read: No such file or directory"));
  EXPECT_THAT(messageOf("x.npy", ""), HasSubstr("is not a NumPy file"));
  EXPECT_THROW(openLayerFile(folder.path("x.jpeg2")), UsageError);
}

TEST(DamagedDocuments, AreRefusedOrRead)
{
  const TemporaryFolder folder;
  CameraRecord camera;
  camera.name = "left";
  camera.width = camera.height = 4;
  camera.far = 10;
  ObjectRecord object;
  object.id = 1;
  object.classId = 1;
  Manifest manifest;
  manifest.request = { { "layers", "color" } };
  manifest.files = { { "cameras.json", 12, std::string(64, 'a'), "", "", -1 } };
  manifest.layers = { { specOf(PixelType::UInt8, 3), "png" } };
  const std::string texts[] = { camerasText({ camera }), objectsText({ object }), manifestText(manifest),
    calibrationText(makeCalibration(testContext().projection, testContext().modelView, 640, 480)) };
  int refused = 0;
  for (int kind = 0; kind < 4; ++kind)
  {
    const std::string path = folder.path("document");
    for (int k = 0; k < mutations; ++k)
    {
      writeQuickly(path, damaged(texts[kind], std::uint64_t(k)));
      try
      {
        kind == 0   ? void(readCameras(path))
        : kind == 1 ? void(readObjects(path))
        : kind == 2 ? void(readManifest(path))
                    : void(readCalibration(path));
      }
      catch (const InputError& error)
      {
        ++refused;
        ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      }
    }
  }
  EXPECT_GT(refused, mutations);
}
