// SPDX-License-Identifier: BSD-3-Clause
// The formats byte by byte, and through other people's readers.
#include "dgtkDepthPicture.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkTestImages.h"
#include "dgtkTestSupport.h"

#include <OpenImageIO/imageio.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
std::string bytesOfFile(const std::string& format, const LayerSpec& spec, const Rows& image)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x." + format);
  writeImage(format, path, spec, image, 1, testContext());
  return contentsOf(path);
}

template <typename T>
T valueAt(const std::string& bytes, std::size_t offset)
{
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// Pixels as OpenImageIO reads them, without any change of theirs.
template <typename T>
std::vector<T> throughOpenImageIO(const std::string& path, OIIO::TypeDesc type, OIIO::ImageSpec& spec)
{
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;
  const auto input = OIIO::ImageInput::open(path, &config);
  EXPECT_TRUE(input) << OIIO::geterror();
  if (!input)
  {
    return {};
  }
  spec = input->spec();
  std::vector<T> values(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
  EXPECT_TRUE(input->read_image(0, 0, 0, spec.nchannels, type, values.data())) << input->geterror();
  return values;
}
} // namespace

TEST(Ppm, IdsAreTwentyFourBitsRedHigh)
{
  Rows ids(PixelType::UInt32, 1, 2, 0, 1);
  ids.row<std::uint32_t>(0)[0] = 0x010203;
  ids.row<std::uint32_t>(0)[1] = 0xfffe;
  EXPECT_EQ(bytesOfFile("ppm", specOf(PixelType::UInt32, 1, "objects"), ids),
    std::string("P6\n2 1\n255\n") + std::string("\x01\x02\x03\x00\xff\xfe", 6));
  Rows deep(PixelType::UInt16, 3, 1, 0, 1);
  deep.row<std::uint16_t>(0)[0] = 0x1234;
  deep.row<std::uint16_t>(0)[1] = 1;
  deep.row<std::uint16_t>(0)[2] = 0;
  EXPECT_EQ(bytesOfFile("ppm", specOf(PixelType::UInt16, 3, "color"), deep),
    std::string("P6\n1 1\n65535\n") + std::string("\x12\x34\x00\x01\x00\x00", 6));
}

TEST(Pfm, BottomRowComesFirst)
{
  Rows rows(PixelType::Float32, 1, 1, 0, 2);
  rows.row<float>(0)[0] = 1;
  rows.row<float>(1)[0] = 2;
  EXPECT_EQ(bytesOfFile("pfm", specOf(PixelType::Float32, 1), rows),
    std::string("Pf\n1 2\n-1\n") + std::string("\x00\x00\x00\x40\x00\x00\x80\x3f", 8));
  EXPECT_EQ(
    bytesOfFile("pfm", specOf(PixelType::Float32, 3), testImage(specOf(PixelType::Float32, 3), 1, 1)).substr(0, 10),
    "PF\n1 1\n-1\n");
}

TEST(Pfm, OtherScalesAreRefusedAndBothOrdersOfBytesRead)
{
  const TemporaryFolder folder;
  const auto valueOf = [&](const std::string& scale, const std::string& value)
  {
    writeFile(folder.path("x.pfm"), "Pf\n1 1\n" + scale + '\n' + value);
    return readLayerFile(folder.path("x.pfm")).pixels.row<float>(0)[0];
  };
  EXPECT_EQ(valueOf("-1", std::string("\0\0\xc0\x3f", 4)), 1.5f);
  EXPECT_EQ(valueOf("1.0", std::string("\x3f\xc0\0\0", 4)), 1.5f);
  EXPECT_THROW(valueOf("2", std::string(4, '\0')), InputError);
  EXPECT_THROW(valueOf("-0.5", std::string(4, '\0')), InputError);
}

TEST(Dgd, MatricesColumnMajorThenSizeThenDepth)
{
  Rows rows(PixelType::Float64, 1, 3, 0, 2);
  for (int i = 0; i < 6; ++i)
  {
    rows.row<double>(0)[i] = i == 4 ? std::numeric_limits<double>::infinity() : 1.0 / (i + 3);
  }
  const std::string bytes = bytesOfFile("dgd", specOf(PixelType::Float64, 1), rows);
  ASSERT_EQ(bytes.size(), 128u + 128u + 8u + 48u);
  const LayerWriterContext context = testContext();
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 4; ++row)
    {
      const std::size_t offset = std::size_t(column * 4 + row) * 8;
      EXPECT_EQ(valueAt<double>(bytes, offset), context.projection(row, column));
      EXPECT_EQ(valueAt<double>(bytes, 128 + offset), context.modelView(row, column));
    }
  }
  EXPECT_EQ(valueAt<std::int32_t>(bytes, 256), 3);
  EXPECT_EQ(valueAt<std::int32_t>(bytes, 260), 2);
  EXPECT_EQ(valueAt<double>(bytes, 264), 1.0 / 3);
  EXPECT_EQ(valueAt<double>(bytes, 264 + 32), std::numeric_limits<double>::infinity());

  const TemporaryFolder folder;
  writeFile(folder.path("x.dgd"), bytes);
  const ImageData back = readLayerFile(folder.path("x.dgd"));
  EXPECT_EQ(back.matrices.projection, context.projection);
  EXPECT_EQ(back.matrices.modelView, context.modelView);
  for (const std::size_t matrix : { 0, 128 })
  {
    std::string broken = bytes;
    const double none = std::numeric_limits<double>::quiet_NaN();
    std::memcpy(&broken[matrix + 40], &none, sizeof none);
    writeFile(folder.path("x.dgd"), broken);
    EXPECT_THROW(readLayerFile(folder.path("x.dgd")), InputError) << matrix;
  }
}

TEST(Flo, UnknownFlowIsTenToTheTen)
{
  Rows rows(PixelType::Float32, 2, 2, 0, 1);
  const float values[] = { 1.5f, -2, 3, std::numeric_limits<float>::quiet_NaN() };
  std::copy(values, values + 4, rows.row<float>(0));
  const std::string bytes = bytesOfFile("flo", specOf(PixelType::Float32, 2, "flow_forward"), rows);
  ASSERT_EQ(bytes.size(), 28u);
  EXPECT_EQ(valueAt<float>(bytes, 0), 202021.25f); // the format's tag
  EXPECT_EQ(valueAt<std::int32_t>(bytes, 4), 2);
  EXPECT_EQ(valueAt<std::int32_t>(bytes, 8), 1);
  EXPECT_EQ(valueAt<float>(bytes, 12), 1.5f);
  EXPECT_EQ(valueAt<float>(bytes, 16), -2.0f);
  EXPECT_EQ(valueAt<float>(bytes, 20), 1e10f);
  EXPECT_EQ(valueAt<float>(bytes, 24), 1e10f);
}

// Middlebury's: a component of 1e9 or more is unknown, and with it the other.
TEST(Flo, UnknownFlowIsRead)
{
  const float values[] = { 1e9f, 3, std::nextafter(1e9f, 0.0f), -2, 5, -1e9f, 7, 8 };
  std::string bytes = std::string("PIEH\4\0\0\0\1\0\0\0", 12);
  bytes.append(reinterpret_cast<const char*>(values), sizeof values);
  const TemporaryFolder folder;
  writeFile(folder.path("x.flo"), bytes);
  const ImageData flow = readLayerFile(folder.path("x.flo"));
  for (int i = 0; i < 8; ++i)
  {
    const bool unknown = i < 2 || i == 4 || i == 5;
    const float found = flow.pixels.row<float>(0)[i];
    EXPECT_TRUE(unknown ? std::isnan(found) : found == values[i]) << i;
  }
}

/// A file of numpy.save(), of 2 x 3 bytes.
std::string npyOf(char version, const std::string& header, const std::string& values = "abcdef")
{
  const std::string length{ char(header.size() & 255), char(header.size() >> 8), 0, 0 };
  return std::string("\x93NUMPY") + version + '\0' + length.substr(0, version == 1 ? 2 : 4) + header + values;
}

TEST(Npy, HeadersOfAllVersionsAndAnyLengthAreRead)
{
  const TemporaryFolder folder;
  const std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3), }";
  for (const char version : { 1, 2, 3 })
  {
    for (const std::size_t blanks : { 0, 50, 5000 })
    {
      writeFile(folder.path("x.npy"), npyOf(version, header + std::string(blanks, ' ') + '\n'));
      const ImageData image = readLayerFile(folder.path("x.npy"));
      EXPECT_EQ(image.info.width, 3);
      EXPECT_EQ(image.info.height, 2);
      EXPECT_EQ(image.pixels.row<std::uint8_t>(1)[2], 'f') << int(version) << ' ' << blanks;
    }
  }
}

TEST(Npy, HeadersThatSayTooLittleOrTooMuchAreRefused)
{
  const TemporaryFolder folder;
  const auto refusal = [&](char version, const std::string& header, const std::string& values = "abcdef")
  {
    writeFile(folder.path("x.npy"), npyOf(version, header, values));
    return thrownBy<InputError>([&] { readLayerFile(folder.path("x.npy")); });
  };
  const auto expectIn = [](const std::string& message, const std::string& part)
  { EXPECT_NE(message.find(part), std::string::npos) << message; };
  const std::string type = "'descr': '|u1', ";
  const std::string order = "'fortran_order': False, ";
  const std::string shape = "'shape': (2, 3), ";
  expectIn(refusal(4, '{' + type + order + shape + '}'), "unsupported version of NumPy files");
  expectIn(refusal(1, '{' + order + shape + '}'), "incomplete header");
  expectIn(refusal(1, '{' + type + shape + '}'), "incomplete header");
  expectIn(refusal(1, '{' + type + order + '}'), "incomplete header");
  expectIn(refusal(1, '{' + type + order + "'shape': (2, 3, 1, 1), }"), "too many dimensions");
  expectIn(refusal(1, '{' + type + order + "'shape': (2, 3, 0), }"), "not the shape of an image");
  expectIn(
    refusal(1, '{' + type + order + "'shape': (1, 1, 1025), }", std::string(1025, 'x')), "not the shape of an image");
  EXPECT_EQ(refusal(1, '{' + type + order + "'shape': (1, 1, 1024), }", std::string(1024, 'x')), "");
}

TEST(Npy, HeaderIsVersionOneAndAligned)
{
  const std::string bytes =
    bytesOfFile("npy", specOf(PixelType::Float64, 1), testImage(specOf(PixelType::Float64, 1), 3, 2));
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t length = valueAt<std::uint16_t>(bytes, 8);
  EXPECT_EQ((10 + length) % 64, 0u);
  EXPECT_EQ(bytes[9 + length], '\n');
  EXPECT_EQ(bytes.substr(10, 57), "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3),");
  EXPECT_EQ(bytes.size(), 10 + length + 48);
}

TEST(Npy, NumPyReadsEveryType)
{
  const std::string python = "/usr/bin/python3";
  ASSERT_EQ(std::system((python + " -c 'import numpy'").c_str()), 0) << "see Utilities/Setup/packages.txt";
  const TemporaryFolder folder;
  std::string script = "import numpy as n\n";
  for (const PixelType type :
    { PixelType::UInt8, PixelType::UInt16, PixelType::UInt32, PixelType::Float32, PixelType::Float64 })
  {
    for (const int channels : { 1, 3 })
    {
      const LayerSpec spec = specOf(type, channels);
      const std::string path = folder.path(std::string(nameOf(type)) + std::to_string(channels));
      const Rows image = testImage(spec, 5, 4);
      writeImage("npy", path + ".npy", spec, image, 3, {});
      writeFile(path + ".raw", std::string(reinterpret_cast<const char*>(image.data()), image.bytes()));
      script += "a = n.load('" + path + ".npy')\nassert a.dtype == n." + nameOf(type) +
                ", a.dtype\nassert a.shape == " + (channels == 1 ? "(4, 5)" : "(4, 5, 3)") +
                ", a.shape\nassert a.flags.c_contiguous\nassert a.tobytes() == open('" + path + ".raw', 'rb').read()\n";
    }
  }
  writeFile(folder.path("check.py"), script);
  EXPECT_EQ(std::system((python + " " + folder.path("check.py")).c_str()), 0);
}

TEST(Png, OpenImageIOReadsTheSamePixels)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x.png");
  for (const char* name : { "color", "objects", "alpha" })
  {
    for (int channels = 1; channels <= 4; ++channels)
    {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(channels));
      const LayerSpec small = specOf(PixelType::UInt8, channels, name);
      const Rows bytes = testImage(small, 61, 33);
      writeImage("png", path, small, bytes, 5, {});
      OIIO::ImageSpec read;
      const auto back = throughOpenImageIO<std::uint8_t>(path, OIIO::TypeDesc::UINT8, read);
      ASSERT_EQ(read.nchannels, channels);
      EXPECT_EQ(read.format, OIIO::TypeDesc::UINT8);
      ASSERT_EQ(back.size(), bytes.bytes());
      EXPECT_EQ(std::memcmp(back.data(), bytes.data(), bytes.bytes()), 0);

      const LayerSpec wide = specOf(PixelType::UInt16, channels, name);
      const Rows words = testImage(wide, 61, 33);
      writeImage("png", path, wide, words, 5, {});
      const auto deep = throughOpenImageIO<std::uint16_t>(path, OIIO::TypeDesc::UINT16, read);
      EXPECT_EQ(read.format, OIIO::TypeDesc::UINT16);
      ASSERT_EQ(deep.size() * 2, words.bytes());
      EXPECT_EQ(std::memcmp(deep.data(), words.data(), words.bytes()), 0);
    }
  }
}

TEST(Png, EveryFilterOfRowsIsUndone)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x.png");
  for (const int filter : { 8, 16, 32, 64, 128 }) // none, left, above, their mean, Paeth's
  {
    for (int channels = 1; channels <= 4; ++channels)
    {
      for (const PixelType type : { PixelType::UInt8, PixelType::UInt16 })
      {
        SCOPED_TRACE(std::to_string(filter) + ' ' + std::to_string(channels) + ' ' + nameOf(type));
        const Rows image = testImage(specOf(type, channels, "color"), 61, 33);
        const auto output = OIIO::ImageOutput::create(path);
        const OIIO::TypeDesc stored = type == PixelType::UInt8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16;
        OIIO::ImageSpec spec(61, 33, channels, stored);
        spec.attribute("png:filter", filter);
        spec.attribute("oiio:UnassociatedAlpha", 1);
        ASSERT_TRUE(output->open(path, spec) && output->write_image(stored, image.data()) && output->close());
        const ImageData read = readLayerFile(path);
        ASSERT_EQ(read.pixels.bytes(), image.bytes());
        EXPECT_EQ(std::memcmp(read.pixels.data(), image.data(), image.bytes()), 0);
      }
    }
  }
}

TEST(Png, ColorSaysSrgbAndNothingElseIsAdded)
{
  const LayerSpec spec = specOf(PixelType::UInt8, 3, "color");
  const std::string bytes = bytesOfFile("png", spec, testImage(spec, 9, 9));
  EXPECT_EQ(bytes.substr(0, 16), std::string("\x89PNG\r\n\x1a\n\x00\x00\x00\x0dIHDR", 16));
  EXPECT_EQ(bytes.substr(16, 13), std::string("\0\0\0\x09\0\0\0\x09\x08\x02\0\0\0", 13));
  EXPECT_EQ(bytes.substr(37, 4), "sRGB");
  EXPECT_EQ(bytes.substr(50, 4), "IDAT");
  EXPECT_EQ(bytes.substr(bytes.size() - 8), "IEND\xae\x42\x60\x82"); // the published checksum of the empty chunk
  const LayerSpec ids = specOf(PixelType::UInt8, 1, "flow_class");
  EXPECT_EQ(bytesOfFile("png", ids, testImage(ids, 9, 9)).find("sRGB"), std::string::npos);
}

// Above 64 MiB of raw bytes rows are compressed while they come.
TEST(Png, LargeImagesAreStreamed)
{
  const LayerSpec spec = specOf(PixelType::UInt8, 3, "color");
  constexpr int width = 65536;
  constexpr int height = 350;
  const TemporaryFolder folder;
  const std::string path = folder.path("x.png");
  const auto writer = makeLayerWriter("png", path, spec, width, height);
  const auto value = [](std::size_t i, int y) { return static_cast<std::uint8_t>(i / 300 + std::size_t(y) / 7); };
  for (int y = 0; y < height; y += 50)
  {
    Rows rows(spec.type, 3, width, y, 50);
    for (int r = y; r < y + 50; ++r)
    {
      for (std::size_t i = 0; i < std::size_t(width) * 3; ++i)
      {
        rows.row<std::uint8_t>(r)[i] = value(i, r);
      }
    }
    writer->write(rows);
  }
  writer->finish();
  OIIO::ImageSpec read;
  const auto back = throughOpenImageIO<std::uint8_t>(path, OIIO::TypeDesc::UINT8, read);
  ASSERT_EQ(back.size(), std::size_t(width) * height * 3);
  for (std::size_t i = 0; i < back.size(); i += 1009)
  {
    ASSERT_EQ(back[i], value(i % (std::size_t(width) * 3), int(i / (std::size_t(width) * 3)))) << i;
  }
}

TEST(DepthPicture, BrighterNearerInEqualStepsOfTheLogarithm)
{
  const double values[] = { std::numeric_limits<double>::infinity(), 0.1, 0.5, std::sqrt(0.5 * 100), 100, 1000 };
  Rows rows(PixelType::Float64, 1, 6, 0, 1);
  std::copy(values, values + 6, rows.row<double>(0));
  const TemporaryFolder folder;
  writeImage("png", folder.path("x.png"), specOf(PixelType::Float64, 1), rows, 1, testContext());
  const ImageData back = readLayerFile(folder.path("x.png"));
  const int expected[] = { 0, 255, 255, 128, 1, 1 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(back.pixels.row<std::uint8_t>(0)[i], expected[i]) << values[i];
  }
}

TEST(DepthPicture, IsRoundedToTheNearestStep)
{
  const DepthPicture logarithmic(0.5, 128, "x");
  const DepthPicture linear(-2, 125, "x");
  for (const int step : { 1, 2, 100, 253 })
  {
    for (const double part : { -0.49, 0.0, 0.49 })
    {
      EXPECT_EQ(int(logarithmic(128 * std::pow(0.5 / 128, (step + part) / 254))), step + 1) << step << part;
      EXPECT_EQ(int(linear(125 - 127 * (step + part) / 254)), step + 1) << step << part;
    }
  }
  EXPECT_EQ(int(linear(-3)), 255);
  EXPECT_EQ(int(linear(126)), 1);
  EXPECT_EQ(int(linear(std::nan(""))), 0);
  EXPECT_THROW(DepthPicture(1, 1, "x"), UsageError);
  EXPECT_THROW(DepthPicture(1, INFINITY, "x"), UsageError);
}

TEST(Exr, OpenImageIOReadsTheSamePixelsAndNoClock)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x.exr");
  const struct
  {
    const char* layer;
    int channels;
    std::vector<std::string> names;
  } cases[] = { { "depth", 1, { "Z" } }, { "distance", 1, { "Y" } }, { "uv", 2, { "U", "V" } },
    { "color", 3, { "R", "G", "B" } }, { "normal", 3, { "X", "Y", "Z" } }, { "color", 4, { "R", "G", "B", "A" } } };
  for (const auto& row : cases)
  {
    SCOPED_TRACE(row.layer);
    const LayerSpec spec = specOf(PixelType::Float32, row.channels, row.layer);
    const Rows image = testImage(spec, 61, 50);
    writeImage("exr", path, spec, image, 7, {});
    OIIO::ImageSpec read;
    const auto back = throughOpenImageIO<float>(path, OIIO::TypeDesc::FLOAT, read);
    ASSERT_EQ(back.size() * 4, image.bytes());
    EXPECT_EQ(read.get_string_attribute("compression"), "zip");
    EXPECT_FALSE(read.find_attribute("DateTime"));
    EXPECT_FALSE(read.find_attribute("Software"));
    for (int c = 0; c < row.channels; ++c)
    {
      const int there = read.channelindex(row.names[std::size_t(c)]);
      ASSERT_GE(there, 0) << row.names[std::size_t(c)];
      for (std::size_t i = 0; i < back.size() / std::size_t(row.channels); ++i)
      {
        ASSERT_EQ(back[i * std::size_t(row.channels) + std::size_t(there)],
          image.row<float>(0)[i * std::size_t(row.channels) + std::size_t(c)]);
      }
    }
  }
}

TEST(Exr, ReadsWhatOpenImageIOWrites)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x.exr");
  const Rows image = testImage(specOf(PixelType::Float32, 3), 61, 50);
  for (const char* compression : { "none", "zips", "zip" })
  {
    SCOPED_TRACE(compression);
    OIIO::ImageSpec spec(61, 50, 3, OIIO::TypeDesc::FLOAT);
    spec["compression"] = compression;
    const auto output = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(output && output->open(path, spec) && output->write_image(OIIO::TypeDesc::FLOAT, image.data()));
    output->close();
    const ImageData back = readLayerFile(path);
    ASSERT_EQ(back.pixels.bytes(), image.bytes());
    EXPECT_EQ(std::memcmp(back.pixels.data(), image.data(), image.bytes()), 0);
  }
}

TEST(LayerReaders, RowsInBlocksAreTheWholeImage)
{
  const TemporaryFolder folder;
  for (const WriterInfo& info : layerWriters())
  {
    SCOPED_TRACE(info.format);
    const LayerSpec spec = info.format == "ppm" || info.format == "png" ? specOf(PixelType::UInt8, 3)
                           : info.format == "flo"                       ? specOf(PixelType::Float32, 2)
                                                                        : specOf(PixelType::Float64, 1);
    const std::string path = folder.path("x." + info.extension);
    writeImage(info.format, path, spec, testImage(spec, 17, 41), 9, testContext());
    const ImageData whole = readLayerFile(path);
    const auto reader = openLayerFile(path);
    int y = 0;
    for (Rows part = reader->read(6); part.height() > 0; part = reader->read(6))
    {
      EXPECT_EQ(part.y(), y);
      EXPECT_EQ(
        std::memcmp(part.data(), whole.pixels.data() + whole.pixels.rowBytes() * std::size_t(y), part.bytes()), 0);
      y += part.height();
    }
    EXPECT_EQ(y, 41);
    const auto some = openLayerFile(path);
    for (int row = 3; row < 41; row += 11)
    {
      some->skip(row == 3 ? 3 : 10);
      const Rows one = some->read(1);
      EXPECT_EQ(one.y(), row);
      EXPECT_EQ(
        std::memcmp(one.data(), whole.pixels.data() + whole.pixels.rowBytes() * std::size_t(row), one.bytes()), 0);
    }
    some->skip(1000);
    EXPECT_EQ(some->read(1).height(), 0);
  }
}
