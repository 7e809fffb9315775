// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFile.h"
#include "dgtkModelReader.h"
#include "dgtkModelSeeds.h"
#include "dgtkTestSupport.h"
#include "dgtkTextureFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

using dgtk::decodeTexture;
using dgtk::locateTexture;
using dgtk::writeFile;
using dgtk::test::TemporaryFolder;
using dgtk::test::u16;
using dgtk::test::u32;
using testing::HasSubstr;

namespace
{
/// 24- or 32-bit uncompressed TGA; pixels are given top to bottom as r g b (a).
std::string tga(int width, int height, int channels, const std::vector<std::uint8_t>& pixels)
{
  std::string out = { 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0 };
  out += u16(static_cast<unsigned>(width)) + u16(static_cast<unsigned>(height));
  out += static_cast<char>(channels * 8);
  out += static_cast<char>(channels == 4 ? 0x28 : 0x20); // rows top to bottom
  for (std::size_t i = 0; i < pixels.size(); i += static_cast<std::size_t>(channels))
  {
    out += { static_cast<char>(pixels[i + 2]), static_cast<char>(pixels[i + 1]), static_cast<char>(pixels[i]) };
    if (channels == 4)
    {
      out += static_cast<char>(pixels[i + 3]);
    }
  }
  return out;
}

/// 8-bit PCX whose palette entry i is (i, 255 - i, 7); rows are padded by a byte.
std::string pcx(int width, int height, const std::string& packed)
{
  std::string out(128, '\0');
  out[0] = 10;
  out[1] = 5;
  out[2] = 1;
  out[3] = 8;
  out.replace(8, 4, u16(static_cast<unsigned>(width - 1)) + u16(static_cast<unsigned>(height - 1)));
  out[65] = 1;
  out.replace(66, 2, u16(static_cast<unsigned>(width + 1)));
  out += packed + '\x0c';
  for (int i = 0; i < 256; ++i)
  {
    out += { static_cast<char>(i), static_cast<char>(255 - i), '\x07' };
  }
  return out;
}

std::vector<int> texel(const dgtk::Image& image, int x, int y)
{
  const std::uint8_t* p = &image.rgba[static_cast<std::size_t>(y * image.width + x) * 4];
  return { p[0], p[1], p[2], p[3] };
}

std::shared_ptr<const dgtk::Image> decoded(
  const std::string& name, const std::string& bytes, std::string* problem = nullptr)
{
  const TemporaryFolder folder;
  writeFile(folder.path(name), bytes);
  std::string why;
  auto image = decodeTexture(folder.path(name), why);
  if (problem)
  {
    *problem = why;
  }
  return image;
}
} // namespace

TEST(TextureFile, NamesAreResolvedInOrder)
{
  const TemporaryFolder folder;
  const std::string model = folder.path("models/car.ac");
  std::filesystem::create_directories(folder.path("models/skins"));
  std::filesystem::create_directories(folder.path("textures"));
  const auto put = [&](const std::string& name) { writeFile(folder.path(name), "x"); };
  const auto find = [&](const std::string& name)
  {
    const std::string path = locateTexture(model, name);
    return path.empty() ? path : std::filesystem::relative(path, folder.path()).string();
  };
  EXPECT_EQ(find("skins/Paint.PNG"), "");
  put("textures/paint.jpg");
  EXPECT_EQ(find("skins/Paint.PNG"), "textures/paint.jpg");
  put("models/paint.tga");
  EXPECT_EQ(find("skins/Paint.PNG"), "models/paint.tga");
  put("models/paint.jpg"); // of several extensions the order is fixed
  EXPECT_EQ(find("skins/Paint.PNG"), "models/paint.jpg");
  put("models/PAINT.png");
  EXPECT_EQ(find("skins/Paint.PNG"), "models/PAINT.png");
  put("models/Paint.PNG");
  EXPECT_EQ(find("skins/Paint.PNG"), "models/Paint.PNG");
  EXPECT_EQ(find("C:\\art\\Paint.PNG"), "models/Paint.PNG");
  EXPECT_EQ(find("/somewhere/else/Paint.PNG"), "models/Paint.PNG");
  put("models/skins/Paint.PNG");
  EXPECT_EQ(find("skins/Paint.PNG"), "models/skins/Paint.PNG");
  EXPECT_EQ(find("skins\\Paint.PNG"), "models/skins/Paint.PNG");
  EXPECT_EQ(find("../textures/paint.jpg"), "textures/paint.jpg");
}

TEST(TextureFile, TheFolderThatIsWrittenComesFirst)
{
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("skins"));
  writeFile(folder.path("skins/paint.tga"), "x");
  writeFile(folder.path("paint.jpg"), "x");
  EXPECT_EQ(locateTexture(folder.path("car.ac"), "skins/Paint.PNG"), folder.path("skins/paint.tga"));
}

TEST(TextureFile, FoldersAreFoundInAnyCase)
{
  const TemporaryFolder folder;
  const std::string model = folder.path("car.ac");
  std::filesystem::create_directories(folder.path("Skins/Red"));
  std::filesystem::create_directories(folder.path("skins2"));
  writeFile(folder.path("Skins/Red/paint.png"), "x");
  writeFile(folder.path("skins2/paint.png"), "x");
  writeFile(folder.path("paint.png"), "x");
  EXPECT_EQ(locateTexture(model, "sKINS/red/Paint.png"), folder.path("Skins/Red/paint.png"));
  EXPECT_EQ(locateTexture(model, "skins\\RED\\paint.tga"), folder.path("Skins/Red/paint.png"));
  EXPECT_EQ(locateTexture(model, "skins3/red/paint.png"), folder.path("paint.png"));
}

TEST(TextureFile, OtherExtensionsAreThoseOfAllPictures)
{
  const TemporaryFolder folder;
  writeFile(folder.path("wood.png"), "x");
  writeFile(folder.path("sky.EXR"), "x");
  for (const std::string extension : { "webp", "exr", "HDR", "pcx", "psd" })
  {
    EXPECT_EQ(locateTexture(folder.path("m.ac"), "wood." + extension), folder.path("wood.png")) << extension;
  }
  EXPECT_EQ(locateTexture(folder.path("m.ac"), "sky.png"), folder.path("sky.EXR"));
}

TEST(TextureFile, ShortNames)
{
  const TemporaryFolder folder;
  writeFile(folder.path("brickwall_large.jpg"), "x");
  const auto find = [&](const std::string& name) { return !locateTexture(folder.path("m.3ds"), name).empty(); };
  EXPECT_TRUE(find("BRICKWAL.TGA"));
  EXPECT_TRUE(find("BRICKW~1.TGA"));
  EXPECT_FALSE(find("brickwall_old.png")) << "both are long";
  EXPECT_FALSE(find("brickwall_~old.png")) << "no short name";
  EXPECT_FALSE(find("BRICK.TGA"));
  EXPECT_FALSE(find("~1.TGA")) << "of nothing";
  writeFile(folder.path("PLANKS_O.png"), "x");
  EXPECT_TRUE(find("planks_of_oak.jpg")) << "the file has the short name";
  EXPECT_FALSE(find("BRICKWOR.TGA"));
  EXPECT_FALSE(find(""));
  EXPECT_FALSE(find(".."));
}

TEST(TextureFile, NamesLeadNoFurtherThanTheFolderAbove)
{
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("scene/parts/car/skins"));
  for (const std::string name : { "scene/a.png", "scene/parts/b.png", "scene/parts/other.png" })
  {
    writeFile(folder.path(name), "x");
  }
  const std::string model = folder.path("scene/parts/car/car.ac");
  EXPECT_EQ(locateTexture(model, "../b.png"), folder.path("scene/parts/b.png"));
  EXPECT_EQ(locateTexture(model, "skins/../../b.png"), folder.path("scene/parts/b.png"));
  EXPECT_EQ(locateTexture(model, "../../a.png"), "");
  EXPECT_EQ(locateTexture(model, "../../A.jpg"), "");
  EXPECT_EQ(locateTexture(model, "../../parts/b.png"), folder.path("scene/parts/b.png"));
  dgtk::TextureFinder inScene(model, folder.path("scene"));
  EXPECT_EQ(inScene.find("../../a.png"), folder.path("scene/a.png"));
  EXPECT_EQ(inScene.find("../../A.jpg"), folder.path("scene/a.png"));
  dgtk::TextureFinder inOther(model, folder.path("scene/parts/ca"));
  EXPECT_EQ(inOther.find("../../a.png"), "");
}

TEST(TextureFile, OnlyFilesAreFound)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("wood.png"));
  std::string tried;
  EXPECT_EQ(locateTexture(folder.path("m.ac"), "wood.png", &tried), "");
  EXPECT_THAT(tried, HasSubstr("'wood.png' beside the model"));
}

TEST(TextureFile, RowsRunFromTheTop)
{
  const auto image = decoded("a.tga", tga(1, 2, 3, { 255, 0, 0, 0, 0, 255 }));
  ASSERT_TRUE(image);
  EXPECT_EQ(image->width, 1);
  EXPECT_EQ(image->height, 2);
  EXPECT_EQ(texel(*image, 0, 0), (std::vector<int>{ 255, 0, 0, 255 }));
  EXPECT_EQ(texel(*image, 0, 1), (std::vector<int>{ 0, 0, 255, 255 }));
  EXPECT_FALSE(image->hasAlpha);
}

TEST(TextureFile, AlphaIsNotMultipliedIntoColours)
{
  const auto image = decoded("a.tga", tga(2, 1, 4, { 200, 100, 50, 128, 1, 2, 3, 127 }));
  ASSERT_TRUE(image);
  EXPECT_EQ(texel(*image, 0, 0), (std::vector<int>{ 200, 100, 50, 128 }));
  EXPECT_EQ(texel(*image, 1, 0), (std::vector<int>{ 1, 2, 3, 127 }));
  EXPECT_TRUE(image->hasAlpha);
  EXPECT_TRUE(dgtk::isCutOut(*image)); // 128 / 255 is there, 127 / 255 is not
}

TEST(TextureFile, WhatIsACutOut)
{
  EXPECT_FALSE(dgtk::isCutOut(*decoded("a.tga", tga(2, 1, 4, { 1, 1, 1, 255, 1, 1, 1, 255 }))));
  EXPECT_FALSE(dgtk::isCutOut(*decoded("a.tga", tga(2, 1, 4, { 1, 1, 1, 255, 1, 1, 1, 130 }))));
  EXPECT_FALSE(dgtk::isCutOut(*decoded("a.tga", tga(2, 1, 4, { 1, 1, 1, 90, 1, 1, 1, 10 }))));
  const auto unused = decoded("a.tga", tga(2, 1, 4, { 1, 1, 1, 0, 1, 1, 1, 0 }));
  EXPECT_FALSE(unused->hasAlpha);
  EXPECT_EQ(texel(*unused, 0, 0)[3], 255) << "an alpha channel that was never painted";
}

TEST(TextureFile, ColourMapsBeginWithTheirFirstEntry)
{
  const auto mapped = [](char kind, char first, const std::string& pixels)
  {
    return std::string{ 0, 1, kind, first, 0, 2, 0, 24, 0, 0, 0, 0 } + u16(2) + u16(1) + std::string{ 8, 0x20 } +
           std::string{ 3, 2, 1, 6, 5, 4 } + pixels;
  };
  for (const auto& [kind, before] : { std::pair<char, std::string>{ 1, "" }, { 9, "\x01" } })
  {
    const auto image = decoded("a.tga", mapped(kind, 0, before + std::string{ 1, 0 }));
    ASSERT_TRUE(image);
    EXPECT_EQ(texel(*image, 0, 0), (std::vector<int>{ 4, 5, 6, 255 }));
    EXPECT_EQ(texel(*image, 1, 0), (std::vector<int>{ 1, 2, 3, 255 }));
    std::string problem;
    EXPECT_FALSE(decoded("a.tga", mapped(kind, 3, before + std::string{ 4, 3 }), &problem));
    EXPECT_THAT(problem, HasSubstr("has a colour map that does not begin with entry 0"));
  }
}

TEST(TextureFile, GreyPictures)
{
  const auto image = decoded("a.pgm", "P5 2 1 255\n" + std::string("\x10\xf0"));
  ASSERT_TRUE(image);
  EXPECT_EQ(texel(*image, 0, 0), (std::vector<int>{ 16, 16, 16, 255 }));
  EXPECT_EQ(texel(*image, 1, 0), (std::vector<int>{ 240, 240, 240, 255 }));
}

TEST(TextureFile, Pcx)
{
  // row 1: 5, 5, 200 and padding; row 2: a run of 3 times 9 and padding
  const auto image = decoded("skin.PCX", pcx(3, 2, std::string("\xc2\x05\xc1\xc8\x01\xc3\x09\x01")));
  ASSERT_TRUE(image);
  EXPECT_EQ(image->width, 3);
  EXPECT_EQ(texel(*image, 1, 0), (std::vector<int>{ 5, 250, 7, 255 }));
  EXPECT_EQ(texel(*image, 2, 0), (std::vector<int>{ 200, 55, 7, 255 }));
  EXPECT_EQ(texel(*image, 2, 1), (std::vector<int>{ 9, 246, 7, 255 }));
}

TEST(TextureFile, RunsOfPcxAreOfUpToSixtyThree)
{
  const auto image = decoded("skin.pcx", pcx(70, 1, std::string("\xff\x05\xc7\x06\x01")));
  ASSERT_TRUE(image);
  EXPECT_EQ(texel(*image, 62, 0)[0], 5);
  EXPECT_EQ(texel(*image, 63, 0)[0], 6);
  EXPECT_EQ(texel(*image, 69, 0)[0], 6);
}

TEST(TextureFile, PcxOfThreePlanes)
{
  std::string bytes = pcx(2, 1, "");
  bytes.resize(128);
  bytes[65] = 3;
  bytes += { 1, 2, 9, 3, 4, 9, 5, 6, 9 }; // red, green and blue of both pixels, each with its padding
  const auto image = decoded("skin.pcx", bytes);
  ASSERT_TRUE(image);
  EXPECT_EQ(texel(*image, 0, 0), (std::vector<int>{ 1, 3, 5, 255 }));
  EXPECT_EQ(texel(*image, 1, 0), (std::vector<int>{ 2, 4, 6, 255 }));
}

TEST(TextureFile, HeadersOfPcx)
{
  const std::string sound = pcx(3, 2, std::string(8, '\1'));
  struct Row
  {
    std::size_t at;
    std::string bytes;
    const char* problem; ///< "" for none
  };
  const Row table[] = { { 1, "\3", "" }, { 0, "\xb", "is not an 8-bit" },
    { 2, std::string(1, '\0'), "is not an 8-bit" }, { 3, "\4", "is not an 8-bit" }, { 65, "\2", "in 2 planes" },
    { 65, "\4", "in 4 planes" }, { 66, u16(3), "" },
    { 66, u16(2), "of 3 x 2 pixels in 1 planes, which cannot be read" }, { 8, u16(0xffff), "which cannot be read" },
    { 4, u16(2), "" }, { 4, u16(3), "which cannot be read" }, { 6, u16(1), "" }, { 6, u16(2), "which cannot be read" },
    { sound.size() - 769, "\xb", "without its palette" } };
  for (const Row& row : table)
  {
    std::string bytes = sound;
    bytes.replace(row.at, row.bytes.size(), row.bytes);
    std::string problem;
    EXPECT_EQ(decoded("a.pcx", bytes, &problem) != nullptr, *row.problem == '\0') << row.at << ": " << problem;
    EXPECT_THAT(problem, HasSubstr(row.problem)) << row.at;
  }
}

TEST(TextureFile, RefusedPictures)
{
  std::string problem;
  EXPECT_FALSE(decoded("a.png", "no picture at all", &problem));
  EXPECT_NE(problem, "");
  EXPECT_EQ(problem.find('\n'), std::string::npos);
  EXPECT_FALSE(decoded("a.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>", &problem));
  EXPECT_EQ(problem, "is in a format that is not read");
  EXPECT_FALSE(decoded("a.pgm", "P5 16385 1 255\n" + std::string(16385, 'x'), &problem));
  EXPECT_EQ(problem, "is 16385 x 1 pixels, at most 16384 a side");
  EXPECT_FALSE(decoded("a.pcx", pcx(3, 2, "").substr(0, 100), &problem));
  EXPECT_THAT(problem, HasSubstr("is not an 8-bit"));
  EXPECT_FALSE(decoded("a.pcx", pcx(3, 2, "\x01").substr(0, 300), &problem));
  EXPECT_THAT(problem, HasSubstr("palette"));
  EXPECT_FALSE(decoded("a.pcx", pcx(16384, 16384, "\x01"), &problem));
  EXPECT_THAT(problem, HasSubstr("cut short"));
}

TEST(TextureFile, PackedBmpWhoseLastRowEnds)
{
  const std::string head = "BM" + u32(0) + u32(0) + u32(62) + u32(40) + u32(4) + u32(2) + u16(1) + u16(8) + u32(1) +
                           u32(0) + u32(0) + u32(0) + u32(2) + u32(2) + u32(0x010203) + u32(0x040506);
  // four pixels of a kind; four as they are, the last two of which look like the end of a row
  const std::string rows("\x04\x01\0\0\0\x04\x01\x01\0\0\0\0\0\x01", 14);
  for (const std::string& packed : { rows, std::string(rows).erase(10, 2) })
  {
    const auto image = decoded("a.bmp", head + packed);
    ASSERT_TRUE(image) << packed.size();
    EXPECT_EQ(texel(*image, 1, 0), (std::vector<int>{ 4, 5, 6, 255 }));
    EXPECT_EQ(texel(*image, 3, 0), (std::vector<int>{ 1, 2, 3, 255 }));
  }
}

TEST(TextureFile, OneFileIsDecodedOnce)
{
  const TemporaryFolder folder;
  writeFile(folder.path("leaf.tga"), tga(2, 1, 4, { 1, 1, 1, 255, 1, 1, 1, 0 }));
  const std::string object =
    "OBJECT poly\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0\nmat 0\nrefs 3\n0 0 0\n1 1 0\n2 0 "
    "1\nkids 0\n";
  std::string text = "AC3Db\nMATERIAL \"a\" rgb 1 1 1\nOBJECT world\nkids 3\n";
  for (const std::string name : { "leaf.tga", "LEAF.TGA", "leaf.tga" })
  {
    text += object;
    text.insert(text.rfind("numvert"), "texture \"" + name + "\"\n");
  }
  writeFile(folder.path("m.ac"), text);
  const auto model = dgtk::readModel(folder.path("m.ac"));
  ASSERT_EQ(model->textures.size(), 2u);
  EXPECT_EQ(model->textures[0].image, model->textures[1].image);
  ASSERT_EQ(model->parts.size(), 3u);
  EXPECT_EQ(model->parts[0].material, model->parts[2].material);
  EXPECT_TRUE(model->materials[static_cast<std::size_t>(model->parts[0].material)].cutOut);
  dgtk::ReadOptions options;
  options.decodeTextures = false;
  const auto located = dgtk::readModel(folder.path("m.ac"), options);
  EXPECT_FALSE(located->textures[0].image);
  EXPECT_EQ(located->textures[0].path, model->textures[0].path);
}

TEST(TextureFile, PicturesOfLight)
{
  const TemporaryFolder folder;
  std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
  for (const unsigned char byte : { 128, 64, 0, 130, 255, 255, 255, 128 }) // mantissas of 256, exponent from 128
  {
    text += char(byte);
  }
  writeFile(folder.path("sky.hdr"), text);
  std::string problem;
  const auto sky = dgtk::decodeRadiance(folder.path("sky.hdr"), problem);
  ASSERT_TRUE(sky) << problem;
  ASSERT_EQ(sky->rgb.size(), 6u);
  EXPECT_NEAR(sky->rgb[0], 2.0, 0.02);
  EXPECT_NEAR(sky->rgb[1], 1.0, 0.02);
  EXPECT_NEAR(sky->rgb[2], 0.0, 0.02);
  EXPECT_NEAR(sky->rgb[3], 0.9961, 0.005);
  writeFile(folder.path("day.tga"), tga(1, 1, 3, { 255, 188, 0 }));
  const auto day = dgtk::decodeRadiance(folder.path("day.tga"), problem);
  ASSERT_TRUE(day) << problem;
  EXPECT_NEAR(day->rgb[0], 1, 1e-6);
  EXPECT_NEAR(day->rgb[1], 0.502886, 1e-5); // IEC 61966-2-1
  EXPECT_EQ(day->rgb[2], 0);
  writeFile(folder.path("grey.pgm"), "P5 2 1 255\n\xff\xbc");
  writeFile(folder.path("clear.tga"), tga(1, 1, 4, { 255, 188, 0, 64 })); // light is light, however opaque
  const auto clear = dgtk::decodeRadiance(folder.path("clear.tga"), problem);
  ASSERT_TRUE(clear) << problem;
  EXPECT_EQ(clear->rgb, day->rgb);
  const auto grey = dgtk::decodeRadiance(folder.path("grey.pgm"), problem);
  ASSERT_TRUE(grey) << problem;
  for (std::size_t i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(grey->rgb.at(i), i < 3 ? 1 : 0.502886, 1e-5) << i;
  }
  writeFile(folder.path("torn.hdr"), text.substr(0, text.size() - 3));
  EXPECT_FALSE(dgtk::decodeRadiance(folder.path("torn.hdr"), problem));
  EXPECT_FALSE(problem.empty());
  EXPECT_FALSE(dgtk::decodeRadiance(folder.path("no.hdr"), problem));
  EXPECT_EQ(problem.find('\n'), std::string::npos);
}

// Ward 1991: the first axis is that of the rows, "-Y" goes down and "+X" to the right.
TEST(TextureFile, PicturesOfLightAreTurnedAsTheyAreMeant)
{
  struct Row
  {
    const char* resolution;
    std::vector<int> stored; ///< of the picture 1 2 3 above 4 5 6
  };
  const TemporaryFolder folder;
  std::string problem;
  std::vector<std::uint8_t> upright; ///< texels of the first
  for (const Row& row : { Row{ "-Y 2 +X 3", { 1, 2, 3, 4, 5, 6 } }, Row{ "-Y 2 -X 3", { 3, 2, 1, 6, 5, 4 } },
         Row{ "+Y 2 +X 3", { 4, 5, 6, 1, 2, 3 } }, Row{ "+Y 2 -X 3", { 6, 5, 4, 3, 2, 1 } },
         Row{ "+X 3 -Y 2", { 1, 4, 2, 5, 3, 6 } }, Row{ "+X 3 +Y 2", { 4, 1, 5, 2, 6, 3 } },
         Row{ "-X 3 -Y 2", { 3, 6, 2, 5, 1, 4 } }, Row{ "-X 3 +Y 2", { 6, 3, 5, 2, 4, 1 } } })
  {
    std::string text =
      "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\nEXPOSURE= 4\n\n" + std::string(row.resolution) + '\n';
    for (const int value : row.stored)
    {
      text += std::string(3, char(16 * value)) + '\x84'; // 16 v / 256 * 2^4
    }
    writeFile(folder.path("sky.hdr"), text);
    const auto sky = dgtk::decodeRadiance(folder.path("sky.hdr"), problem);
    ASSERT_TRUE(sky) << problem;
    ASSERT_EQ(sky->width, 3) << row.resolution;
    for (std::size_t i = 0; i < 18; ++i)
    {
      EXPECT_FLOAT_EQ(sky->rgb.at(i), float(i / 3 + 1) / 8) << row.resolution << ' ' << i;
    }
    const auto texture = decodeTexture(folder.path("sky.hdr"), problem);
    ASSERT_EQ(texture->width, 3) << row.resolution;
    upright = upright.empty() ? texture->rgba : upright;
    EXPECT_EQ(texture->rgba, upright) << row.resolution;
  }
  for (const std::string wrong : { "0", "-1", "nan", "1e300" })
  {
    writeFile(folder.path("wrong.hdr"),
      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=" + wrong + "\n\n-Y 1 +X 1\n\x40\x40\x40\x84");
    EXPECT_FALSE(dgtk::decodeRadiance(folder.path("wrong.hdr"), problem)) << wrong;
    EXPECT_EQ(problem, "has an EXPOSURE that is no number above 0");
  }
}
