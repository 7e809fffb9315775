// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetPictures.h"

#include "dgtkError.h"
#include "dgtkJournal.h"
#include "dgtkObjectDocuments.h"
#include "dgtkPictureOverlay.h"
#include "dgtkPictureValues.h"
#include "dgtkPixelText.h"
#include "dgtkTestDataset.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

namespace
{
using namespace dgtk;
using test::SmallDataset;
using testing::ElementsAre;
using testing::HasSubstr;

const LayerSpec depth{ "depth", PixelType::Float64, 1, "scene units", "camera", "+inf", "", Meaning::Depth };
const LayerSpec color{ "color", PixelType::UInt8, 3, "sRGB", "image", "none", "" };
const LayerSpec matches{ "correspondence", PixelType::Float64, 2, "pixels", "", "nan", "" };
const LayerSpec classes{ "correspondence_class", PixelType::UInt8, 1, "class", "", "0", "" };

double ramp(int x, int y, int channel) { return 1 + x + 100 * y + 10000 * channel; }
double small(int x, int y, int channel) { return x + 10 * y + channel; }

/// What opening says of a folder.
std::string refusal(const std::string& folder)
{
  return test::thrownBy<InputError>([&] { const DatasetPictures dataset(folder); });
}

PictureLayer layerOf(const LayerSpec& spec, const std::string& format) { return { spec.name, spec, format }; }

TEST(DatasetPictures, ListsWhatThereIs)
{
  SmallDataset files;
  files.add("left", "color", 0, "", "png", color, small);
  files.add("left", "color", 1, "", "png", color, small);
  files.add("left", "depth", 0, "", "dgd", depth, ramp);
  files.add("left", "depth", 0, "", "npy", depth, ramp);
  files.add("left", "correspondence_right", 0, "", "npy", matches, ramp);
  files.add("left", "correspondence_right", 0, "", "png", classes, small);
  files.add("left", "tracks", 0, "", "npy",
    { "tracks", PixelType::Float64, 1, "pixels, class", "image", "u, v nan", "" }, ramp); // no picture
  files.add("right", "tiles", 0, "_0_1", "png", { "tiles", PixelType::UInt8, 3, "sRGB", "", "", "" }, small);
  files.finish();
  const DatasetPictures dataset(files.path());
  EXPECT_THAT(dataset.cameras(), ElementsAre("left", "right"));
  EXPECT_THAT(dataset.frames(), ElementsAre(0, 1));
  EXPECT_THAT(dataset.layersOf("left"),
    ElementsAre("color", "depth", "depth .dgd", "correspondence_right", "correspondence_right class"));
  EXPECT_THAT(dataset.layersOf("right"), ElementsAre("tiles 0,1"));
  EXPECT_EQ(dataset.file({ "left", 0, "depth" }), files.path("left/depth/000000.npy"));
  EXPECT_EQ(dataset.file({ "left", 0, "depth .dgd" }), files.path("left/depth/000000.dgd"));
  EXPECT_EQ(dataset.file({ "left", 1, "depth" }), "");
  EXPECT_EQ(dataset.layer("correspondence_right class")->spec.name, "correspondence_class");
  EXPECT_EQ(dataset.layer("depth")->spec.invalid, "+inf");
  EXPECT_EQ(dataset.object(2)->name, "mill");
  EXPECT_EQ(dataset.object(4), nullptr);
  EXPECT_EQ(dataset.className(3), "plant");
  EXPECT_EQ(dataset.camera("right", 1)->t.x(), 1.5);
  EXPECT_EQ(dataset.camera("right", 2), nullptr);
  EXPECT_TRUE(dataset.warnings().empty());
  EXPECT_EQ(DatasetPictures(files.path("manifest.json")).folder(), files.path());
}

TEST(DatasetPictures, UnusableFoldersAreRefusedInALine)
{
  const test::TemporaryFolder folder;
  EXPECT_THAT(refusal(folder.path("nowhere")), HasSubstr("nowhere: is not the folder of a dataset"));
  EXPECT_THAT(refusal(folder.path()), HasSubstr("it has no manifest.json"));
  std::ofstream(folder.path(".dgtk-journal")) << "DGTk journal 1 x\n";
  EXPECT_THAT(refusal(folder.path()), HasSubstr("not finished: render it again"));
  const test::TemporaryFolder busy;
  Journal journal(busy.path(), "request", JournalStart::Fresh);
  journal.plan({ "left/color/000000.png" });
  EXPECT_THAT(refusal(busy.path()), HasSubstr("is being rendered: open it when that is done"));
  SmallDataset files;
  files.finish();
  EXPECT_THAT(refusal(files.path()), HasSubstr("has no pictures to look at"));
  const std::string whole = test::contentsOf(files.path("manifest.json"));
  for (std::size_t length = 0; length < whole.size(); length += 7)
  {
    std::ofstream(files.path("manifest.json")) << whole.substr(0, length);
    EXPECT_THAT(refusal(files.path()), HasSubstr("manifest.json")) << length;
  }
}

TEST(DatasetPictures, AnotherDatasetInTheirFolderIsNoticed)
{
  SmallDataset files;
  files.add("left", "depth", 0, "", "npy", depth, ramp);
  files.finish();
  const DatasetPictures dataset(files.path());
  EXPECT_FALSE(dataset.isReplaced());
  const std::string manifest = files.path("manifest.json");
  writeFile(manifest, readFile(manifest));
  EXPECT_FALSE(dataset.isReplaced()) << "the same bytes";
  files.add("left", "depth", 1, "", "npy", depth, ramp);
  files.finish();
  EXPECT_TRUE(dataset.isReplaced());
  const DatasetPictures now(files.path());
  EXPECT_FALSE(now.isReplaced());
  std::filesystem::remove(manifest);
  EXPECT_TRUE(now.isReplaced()) << "it is being replaced";
}

TEST(DatasetPictures, DocumentsAreNotNeededForPictures)
{
  SmallDataset files;
  files.add("left", "depth", 0, "", "npy", depth, ramp);
  files.finish();
  std::ofstream(files.path("objects.json")) << "{\"objects\": [{\"id\": 0}]}";
  std::filesystem::remove(files.path("cameras.json"));
  const DatasetPictures dataset(files.path());
  ASSERT_EQ(dataset.warnings().size(), 2u);
  EXPECT_THAT(dataset.warnings()[0], HasSubstr("cameras.json"));
  EXPECT_THAT(dataset.warnings()[1], HasSubstr("objects.json"));
  EXPECT_THAT(dataset.cameras(), ElementsAre("left"));
  EXPECT_EQ(dataset.camera("left", 0), nullptr);
}

TEST(DatasetPictures, ALayerIsWhatTheManifestSaysOfItsFormatOrElseOfAnother)
{
  LayerSpec whole = depth;
  whole.unit = "steps";
  SmallDataset files;
  for (const char* format : { "dgd", "npy", "pfm" })
  {
    files.add("left", "depth", 0, "", format, format == std::string("npy") ? whole : depth, ramp);
  }
  const auto unitOf = [&](const std::string& label)
  {
    files.finish();
    return DatasetPictures(files.path()).layer(label)->spec.unit;
  };
  EXPECT_EQ(unitOf("depth"), "steps"); // the second of three
  EXPECT_EQ(unitOf("depth .pfm"), "metre");
  for (LayerRecord& record : files.Parts.layers)
  {
    record.format = "exr"; // no file's
  }
  std::swap(files.Parts.layers[0], files.Parts.layers[1]);
  EXPECT_EQ(unitOf("depth"), "steps"); // the first of them
  EXPECT_EQ(unitOf("depth .pfm"), "steps");
}

TEST(DatasetPictures, ListsThatLeadOutsideAreRefused)
{
  SmallDataset files;
  files.add("left", "depth", 0, "", "npy", depth, ramp);
  files.add("../left", "depth", 0, "", "npy", depth, ramp);
  files.finish();
  EXPECT_THAT(
    test::thrownBy<Error>([&] { const DatasetPictures dataset(files.path()); }), HasSubstr("leads out of the dataset"))
    << "a file outside was taken into the dataset";
}

TEST(PictureValues, AreThoseOfTheFile)
{
  SmallDataset files;
  const LayerSpec flow{ "flow_forward", PixelType::Float32, 2, "pixels", "", "nan", "" };
  for (const char* const format : { "npy", "exr", "flo" })
  {
    files.add("left", "flow_forward", 0, "", format, flow, ramp);
    const std::string path = files.path(std::string("left/flow_forward/000000.") + format);
    const PictureValues picture = readPicture(path, layerOf(flow, format));
    ASSERT_EQ(picture.columns(), SmallDataset::width) << format;
    for (int y = 0; y < SmallDataset::height; ++y)
    {
      for (int x = 0; x < SmallDataset::width; ++x)
      {
        double values[2];
        picture.get(x, y, values);
        EXPECT_EQ(values[0], ramp(x, y, 0));
        EXPECT_EQ(values[1], ramp(x, y, 1));
      }
    }
  }
}

/// Every kept pixel has the file's value, whatever part and step.
TEST(PictureValues, PartsAndStepsKeepTheirPixels)
{
  SmallDataset files;
  const LayerSpec ids{ "objects", PixelType::UInt16, 3, "id", "", "0", "" };
  files.add("left", "depth", 0, "", "npy", depth, ramp);
  files.add("left", "objects", 0, "", "png", ids, ramp);
  const PixelRect windows[] = { {}, { 2, 1, 7, 5 }, { 11, 6, 1, 1 }, { -3, 4, 8, 90 } };
  for (const PixelRect& window : windows)
  {
    for (int step = 1; step <= 9; ++step)
    {
      for (const bool png : { false, true })
      {
        PictureRead read;
        read.window = window;
        read.step = step;
        const PictureValues picture = png
                                        ? readPicture(files.path("left/objects/000000.png"), layerOf(ids, "png"), read)
                                        : readPicture(files.path("left/depth/000000.npy"), layerOf(depth, "npy"), read);
        EXPECT_EQ(picture.columns(), (picture.window.width + step - 1) / step);
        EXPECT_EQ(picture.rows(), (picture.window.height + step - 1) / step);
        for (int row = 0; row < picture.rows(); ++row)
        {
          for (int column = 0; column < picture.columns(); ++column)
          {
            double values[3];
            picture.get(column, row, values);
            EXPECT_EQ(values[0], ramp(picture.x(column), picture.y(row), 0)) << step;
            EXPECT_TRUE(picture.exact(picture.x(column), picture.y(row)));
            EXPECT_EQ(picture.column(picture.x(column)), column);
          }
        }
      }
    }
  }
}

TEST(PictureValues, LargePicturesAreThinnedOut)
{
  const test::TemporaryFolder folder;
  constexpr int side = 65536;
  std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (65536, 65536), }";
  header.resize(118 - 1, ' ');
  header += '\n';
  {
    std::ofstream file(folder.path("large.npy"), std::ios::binary);
    file << "\x93NUMPY" << '\x01' << '\0' << '\x76' << '\0' << header;
  }
  std::filesystem::resize_file(folder.path("large.npy"), 128 + std::uint64_t(side) * side); // no bytes on the disk
  {
    std::fstream file(folder.path("large.npy"), std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(std::streamoff(128 + std::uint64_t(60000) * side + 12345));
    file.put(77);
  }
  const PictureLayer layer = layerOf({ "color", PixelType::UInt8, 1, "", "", "", "" }, "npy");
  PictureRead read;
  read.budget = 1 << 20;
  const PictureValues whole = readPicture(folder.path("large.npy"), layer, read);
  EXPECT_EQ(whole.info.width, side);
  EXPECT_EQ(whole.step, 64);
  EXPECT_LE(whole.bytes(), read.budget);
  read.window = { 12340, 59990, 100, 40 };
  const PictureValues part = readPicture(folder.path("large.npy"), layer, read);
  double value = 0;
  part.get(part.column(12345), part.row(60000), &value);
  EXPECT_EQ(value, 77);
  read.window = { 0, 60000, side, 1 };
  EXPECT_EQ(readPicture(folder.path("large.npy"), layer, read).step, 4) << "no side above 16384";
  int asked = 0;
  read.window = {};
  read.goOn = [&] { return ++asked < 3; };
  EXPECT_EQ(readPicture(folder.path("large.npy"), layer, read).columns(), 0);
}

TEST(PictureValues, DamagedFilesAreRefused)
{
  SmallDataset files;
  files.add("left", "depth", 0, "", "npy", depth, ramp);
  const std::string path = files.path("left/depth/000000.npy");
  std::filesystem::resize_file(path, 200);
  EXPECT_THROW(readPicture(path, layerOf(depth, "npy")), InputError);
  EXPECT_THROW(readPicture(files.path("left/depth/none.npy"), layerOf(depth, "npy")), InputError);
  EXPECT_THROW(pictureSize(path, layerOf(depth, "npy")), InputError);
}

TEST(PictureValues, LayeredImagesAreSeenInThreeWays)
{
  SmallDataset files;
  const LayerSpec spec{ "ldi", PixelType::Float64, 1, "scene units", "camera", "no record", "" };
  const std::string name = files.place("left", "ldi", 0, "", "ldi");
  const auto writer = makeLdiWriter("ldi", files.path(name), SmallDataset::width, SmallDataset::height);
  LdiRows rows;
  rows.height = SmallDataset::height;
  for (int i = 0; i < SmallDataset::width * SmallDataset::height; ++i)
  {
    const int count = i % 3;
    rows.counts.push_back(std::uint32_t(count));
    for (int k = 0; k < count; ++k)
    {
      LdiSurface surface;
      surface.rgba = { float(k), 0.2f, 1, 1 };
      surface.depth = 1 + i + k;
      rows.surfaces.push_back(surface);
    }
  }
  writer->write(rows);
  const FileRecord record = writer->finish();
  files.list({ name, record.bytes, record.sha256, "ldi", "left", 0 }, spec, "ldi");
  files.finish();
  const DatasetPictures dataset(files.path());
  ASSERT_THAT(dataset.layersOf("left"), ElementsAre("ldi color", "ldi count", "ldi depth"));
  const auto read = [&](const char* label, int surface)
  {
    PictureRead how;
    how.surface = surface;
    return readPicture(dataset.file({ "left", 0, label }), *dataset.layer(label), how);
  };
  const PictureValues counts = read("ldi count", 0);
  const PictureValues second = read("ldi depth", 1);
  const PictureValues colors = read("ldi color", 1);
  EXPECT_EQ(counts.surfaces, 2);
  for (int i = 0; i < SmallDataset::width * SmallDataset::height; ++i)
  {
    double value[3];
    counts.get(i % SmallDataset::width, i / SmallDataset::width, value);
    EXPECT_EQ(value[0], i % 3);
    second.get(i % SmallDataset::width, i / SmallDataset::width, value);
    EXPECT_EQ(value[0], i % 3 == 2 ? 2 + i : std::numeric_limits<double>::infinity());
    colors.get(i % SmallDataset::width, i / SmallDataset::width, value);
    EXPECT_TRUE(i % 3 == 2 ? value[0] == 255 && value[1] == 51 : std::isnan(value[0]));
  }
  EXPECT_EQ(valueText(dataset, second, 0, 0), "0 surfaces");
  EXPECT_EQ(valueText(dataset, second, 1, 0), "1 surface: 2 rgba(0, 51, 255, 255)");
  EXPECT_EQ(valueText(dataset, second, 2, 0), "2 surfaces: 3 rgba(0, 51, 255, 255); 4 rgba(255, 51, 255, 255)");
  // Parts of it, thinned out.
  for (const PixelRect& window : { PixelRect{ 2, 1, 7, 5 }, PixelRect{ 11, 6, 1, 1 }, PixelRect{ 0, 3, 5, 2 } })
  {
    for (int step = 1; step <= 3; ++step)
    {
      PictureRead how;
      how.window = window;
      how.step = step;
      how.surface = 1;
      const PictureValues part =
        readPicture(dataset.file({ "left", 0, "ldi depth" }), *dataset.layer("ldi depth"), how);
      ASSERT_EQ(part.columns(), (window.width + step - 1) / step);
      ASSERT_EQ(part.ldi->first.size(), std::size_t(part.columns()) * std::size_t(part.rows()) + 1);
      for (int at = 0; at < part.columns() * part.rows(); ++at)
      {
        const int column = at % part.columns();
        const int row = at / part.columns();
        const int i = part.y(row) * SmallDataset::width + part.x(column);
        EXPECT_EQ(part.ldi->first[std::size_t(at) + 1] - part.ldi->first[std::size_t(at)], std::size_t(i % 3));
        double value = 0;
        part.get(column, row, &value);
        EXPECT_EQ(value, i % 3 == 2 ? 2 + i : std::numeric_limits<double>::infinity());
      }
    }
  }
}

/// The step is the smallest that keeps the budget, to the byte.
TEST(PictureValues, StepsKeepTheBudget)
{
  SmallDataset files;
  static_assert(SmallDataset::width == 12 && SmallDataset::height == 7, "the table is of these");
  const LayerSpec ids{ "objects", PixelType::UInt16, 3, "id", "", "0", "" };
  files.add("left", "objects", 0, "", "png", ids, ramp);
  // bytes of a pixel: 2 * 3; kept are 12 x 7, 6 x 4, 4 x 3, 3 x 2, 2 x 2, 2 x 1 and 1 x 1
  for (const auto& [budget, step] : { std::pair(504, 1), std::pair(503, 2), std::pair(144, 2), std::pair(143, 3),
         std::pair(72, 3), std::pair(71, 4), std::pair(36, 4), std::pair(35, 6), std::pair(24, 6), std::pair(23, 7),
         std::pair(12, 7), std::pair(11, 12), std::pair(6, 12) })
  {
    PictureRead read;
    read.budget = std::uint64_t(budget);
    EXPECT_EQ(readPicture(files.path("left/objects/000000.png"), layerOf(ids, "png"), read).step, step) << budget;
    read.window = { 1, 1, 6, 4 };
    EXPECT_EQ(readPicture(files.path("left/objects/000000.png"), layerOf(ids, "png"), read).step == 1, budget >= 144);
  }
}

/// A dataset whose cameras see one box each; returns the names of the files.
std::vector<std::string> addBoxes(SmallDataset& files)
{
  std::vector<std::string> names;
  const LayerSpec boxes{ "boxes", PixelType::UInt8, 1, "", "", "", "" };
  for (const char* const camera : { "left", "right" })
  {
    files.add(camera, "color", 0, "", "png", color, small);
    BoxRecord box;
    box.id = 2;
    box.visible = Eigen::Vector4d(1, 2, 3, 4);
    names.push_back(files.place(camera, "boxes", 0, "", "json"));
    writeDocument(files.path(), names.back(), boxesText(camera, 0, { box }));
    files.list({ names.back(), 1, "", "boxes", camera, 0 }, boxes, "json");
  }
  files.finish();
  return names;
}

TEST(PictureOverlay, ACameraOfTwoPanesIsReadOnce)
{
  SmallDataset files;
  addBoxes(files);
  const DatasetPictures dataset(files.path());
  OverlayAsk ask;
  ask.boxes = true;
  for (const char* const camera : { "left", "right", "left" })
  {
    ask.cameras.insert(ask.cameras.end(), camera);
  }
  const FrameOverlays overlays = readOverlays(dataset, ask);
  EXPECT_EQ(overlays.cameras.at("left").boxes.size(), 1u);
  EXPECT_EQ(overlays.cameras.at("right").boxes.size(), 1u);
}

TEST(PictureOverlay, ADamagedFileLeavesTheOthers)
{
  SmallDataset files;
  const std::vector<std::string> names = addBoxes(files);
  std::ofstream(files.path(names[0])) << "{\"objects\": [";
  const DatasetPictures dataset(files.path());
  OverlayAsk ask;
  ask.boxes = true;
  ask.cameras = { "left", "right" };
  const FrameOverlays overlays = readOverlays(dataset, ask);
  EXPECT_EQ(overlays.cameras.at("left").boxes.size(), 0u);
  EXPECT_EQ(overlays.cameras.at("right").boxes.size(), 1u);
  EXPECT_THAT(overlays.problems, ElementsAre(HasSubstr(names[0])));
}
} // namespace
