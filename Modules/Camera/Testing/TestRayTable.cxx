// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRandomCameras.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <limits>
#include <random>

using namespace dgtk;
using testing::HasSubstr;

namespace
{
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

class RayTables : public testing::Test
{
protected:
  std::shared_ptr<const CameraModel> camera(int width, int height, const std::string& name = "rays.npy") const
  {
    return makeCamera("raytable", { width, height, std::nullopt, {}, { { "rays", this->Folder.path(name) } } });
  }
  /// 4 x 3 directions towards a plane of unit squares.
  std::vector<double> plane() const
  {
    std::vector<double> numbers;
    for (int i = 0; i < 12; ++i)
    {
      numbers.insert(numbers.end(), { i % 4 - 1.5, double(i / 4) - 1, 2.0 });
    }
    return numbers;
  }
  void write(int rows, int columns, int channels, const std::vector<double>& numbers) const
  {
    test::RandomCameras::writeNpy(this->Folder.path("rays.npy"), rows, columns, channels, numbers);
  }
  std::string refusal() const
  {
    return test::thrownBy<InputError>([&] { this->camera(4, 3); });
  }

  test::TemporaryFolder Folder;
};
} // namespace

TEST_F(RayTables, HoldTheRaysOfPixels)
{
  this->write(3, 4, 3, this->plane());
  const auto camera = this->camera(4, 3);
  for (int i = 0; i < 12; ++i)
  {
    const Eigen::Vector3d expected(i % 4 - 1.5, i / 4 - 1, 2); // NOLINT: of the row
    const CameraRay ray = camera->rayThrough({ i % 4 + 0.5, i / 4 + 0.5 });
    EXPECT_LE((ray.direction - expected.normalized()).norm(), 1e-15);
    Eigen::Vector2d pixel;
    ASSERT_TRUE(camera->project(3 * expected, pixel));
    EXPECT_LE((pixel - Eigen::Vector2d(i % 4 + 0.5, i / 4 + 0.5)).norm(), 1e-12);
  }
  EXPECT_TRUE(camera->rayThrough({ 0, 0 }).exists()) << "up to the border";
  EXPECT_FALSE(camera->rayThrough({ -0.01, 1 }).exists());
  Eigen::Vector2d pixel;
  EXPECT_FALSE(camera->project({ 9, 0, 2 }, pixel));
  EXPECT_FALSE(camera->project({ 0.5, 0, -2 }, pixel)) << "behind";
  // finer
  const CameraRay fine = this->camera(12, 9)->rayThrough({ 4.5, 4.5 });
  EXPECT_LE((fine.direction - camera->rayThrough({ 1.5, 1.5 }).direction).norm(), 1e-15);
}

TEST_F(RayTables, OriginsComeFirst)
{
  std::vector<double> numbers;
  for (int i = 0; i < 12; ++i)
  {
    numbers.insert(numbers.end(), { i % 4 - 1.5, i / 4 - 1.0, 0.0, 0.0, 0.0, 5.0 }); // NOLINT: a parallel projection
  }
  this->write(3, 4, 6, numbers);
  const auto camera = this->camera(4, 3);
  const CameraRay ray = camera->rayThrough({ 2.5, 0.5 });
  EXPECT_LE((ray.origin - Eigen::Vector3d(0.5, -1, 0)).norm(), 1e-15);
  EXPECT_EQ(ray.direction, Eigen::Vector3d(0, 0, 1));
  Eigen::Vector2d pixel;
  ASSERT_TRUE(camera->project({ 1, 0.25, 7 }, pixel));
  EXPECT_LE((pixel - Eigen::Vector2d(3, 1.75)).norm(), 1e-12);
}

TEST_F(RayTables, NothingIsSeenBesideARayThatIsNotThere)
{
  std::vector<double> numbers = this->plane();
  numbers[0] = notANumber;          // the first pixel
  std::fill_n(&numbers[9], 3, 0.0); // the last one of the first row
  this->write(3, 4, 3, numbers);
  const auto camera = this->camera(4, 3);
  EXPECT_FALSE(camera->rayThrough({ 0.5, 0.5 }).exists());
  EXPECT_FALSE(camera->rayThrough({ 1.2, 0.8 }).exists());
  EXPECT_FALSE(camera->rayThrough({ 3.5, 0.5 }).exists());
  EXPECT_TRUE(camera->rayThrough({ 0.5, 1.5 }).exists()) << "the cell below is whole";
  EXPECT_TRUE(camera->rayThrough({ 1.5, 0.5 }).exists()) << "the cell beside it is";
  Eigen::Vector2d pixel;
  EXPECT_FALSE(camera->project({ -1.2, -0.9, 2 }, pixel));
  EXPECT_TRUE(camera->project({ 0, -0.9, 2 }, pixel));
}

TEST_F(RayTables, HaveTimesBetweenThoseOfPixels)
{
  std::vector<double> numbers;
  for (int i = 0; i < 12; ++i)
  {
    numbers.insert(numbers.end(), { i % 4 - 1.5, double(i / 4) - 1, 2.0, 0.5 * double(i / 4) - 0.25 });
  }
  this->write(3, 4, 4, numbers);
  const auto camera = this->camera(4, 3);
  EXPECT_TRUE(camera->rolls());
  EXPECT_EQ(camera->times().first, -0.25);
  EXPECT_EQ(camera->times().last, 0.75);
  EXPECT_EQ(camera->timeAt({ 1.5, 1.5 }), 0.25);
  EXPECT_EQ(camera->timeAt({ 2.3, 2.0 }), 0.5) << "between the rows, whatever the column";
  EXPECT_EQ(camera->timeAt({ 2.3, -4 }), -0.25) << "beside the image as its border";
  EXPECT_EQ(this->camera(8, 6)->timeAt({ 3.4, 5.1 }), this->camera(8, 6)->timeAt({ 6.7, 5.1 }));
  CameraParameters rolling{ 4, 3, std::nullopt, {}, { { "rays", this->Folder.path("rays.npy") } } };
  rolling.rollingShutter = { 0.6, RollingShutter::Direction::Left };
  const auto both = makeCamera("raytable", rolling);
  EXPECT_NEAR(both->timeAt({ 3.5, 1.5 }), 0.25 - 0.6 * (3.5 / 4 - 0.5), 1e-15);
  EXPECT_NEAR(both->times().last, 0.75 + 0.3, 1e-15);
}

TEST_F(RayTables, HaveOriginsAndTimes)
{
  std::vector<double> numbers;
  for (int i = 0; i < 12; ++i)
  {
    numbers.insert(numbers.end(), { 0.1 * i, 0, -1, i % 4 - 1.5, double(i / 4) - 1, 2.0, 0.25 * i });
  }
  this->write(3, 4, 7, numbers);
  const auto camera = this->camera(4, 3);
  EXPECT_EQ(camera->timeAt({ 1.5, 2.5 }), 0.25 * 9);
  EXPECT_EQ(camera->rayThrough({ 1.5, 2.5 }).origin, Eigen::Vector3d(0.1 * 9, 0, -1));
  EXPECT_LT((camera->rayThrough({ 1.5, 2.5 }).direction - Eigen::Vector3d(-0.5, 1, 2).normalized()).norm(), 1e-15);
}

TEST_F(RayTables, HaveNoTimesOfRaysThatAreNotThere)
{
  for (const double time : { notANumber, 1e6 })
  {
    std::vector<double> numbers;
    for (int i = 0; i < 12; ++i)
    {
      numbers.insert(numbers.end(), { i % 4 - 1.5, double(i / 4) - 1, 2.0, 0.5 * double(i / 4) - 0.25 });
    }
    numbers[2] = notANumber; // the first pixel
    numbers[3] = time;
    const std::string name = time > 0 ? "late.npy" : "never.npy";
    test::RandomCameras::writeNpy(this->Folder.path(name), 3, 4, 4, numbers);
    const auto camera = this->camera(4, 3, name);
    EXPECT_FALSE(camera->rayThrough({ 0.5, 0.5 }).exists());
    EXPECT_EQ(camera->times().first, -0.25);
    EXPECT_EQ(camera->times().last, 0.75);
    EXPECT_EQ(camera->timeAt({ 2.5, 2.5 }), 0.75);
  }
}

TEST_F(RayTables, AreReadAnewWhenTheyHaveChanged)
{
  this->write(3, 4, 3, this->plane());
  const auto before = this->camera(4, 3);
  std::vector<double> numbers = this->plane();
  numbers.resize(9 * 2);
  this->write(3, 2, 3, numbers);
  EXPECT_NE(this->camera(4, 3)->rayThrough({ 3, 2 }).direction, before->rayThrough({ 3, 2 }).direction);
}

TEST_F(RayTables, OfTheSameSizeAreReadAnewToo)
{
  const auto path = this->Folder.path("rays.npy");
  const auto right = [this] { return this->camera(4, 3)->rayThrough({ 3, 2 }).direction.x(); };
  this->write(3, 4, 3, this->plane());
  const double before = right();
  const auto time = std::filesystem::last_write_time(path);
  std::vector<double> numbers = this->plane();
  for (std::size_t i = 0; i < numbers.size(); i += 3)
  {
    numbers[i] = -numbers[i];
  }
  this->write(3, 4, 3, numbers);
  std::filesystem::last_write_time(path, time + std::chrono::seconds(1));
  EXPECT_EQ(right(), -before);
  // as old, but longer
  numbers.insert(numbers.end(), numbers.end() - 12, numbers.end());
  numbers[3 * 12 + 9] = 7;
  this->write(4, 4, 3, numbers);
  std::filesystem::last_write_time(path, time + std::chrono::seconds(1));
  const CameraRay last = this->camera(4, 4)->rayThrough({ 3.5, 3.5 });
  EXPECT_LE((last.direction - Eigen::Vector3d(7, 1, 2).normalized()).norm(), 1e-15);
}

/// A file as numpy.save() may write it: `version` 1 has two bytes for the length of its header, 2 and 3 four.
TEST_F(RayTables, AreOfAnyVersionAndPrecision)
{
  int written = 0;
  const auto writeAs = [this, &written](
                         char version, const std::string& type, const std::string& order, const auto& numbers)
  {
    std::string header = "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': (3, 4, 3), }";
    header.resize(127, ' ');
    header += '\n';
    const std::string length{ char(header.size()), 0, 0, 0 };
    writeFile(this->Folder.path("rays.npy"),
      std::string("\x93NUMPY") + version + '\0' + length.substr(0, version == 1 ? 2 : 4) + header +
        std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(numbers[0])));
    const auto path = this->Folder.path("rays.npy"); // each a second younger, however fast they are written
    std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) + std::chrono::seconds(++written));
  };
  const std::vector<double> wide = this->plane();
  const std::vector<float> narrow(wide.begin(), wide.end());
  const auto expectPlane = [this]
  {
    const CameraRay ray = this->camera(4, 3)->rayThrough({ 3.5, 0.5 });
    EXPECT_LE((ray.direction - Eigen::Vector3d(1.5, -1, 2).normalized()).norm(), 1e-15);
  };
  for (const char version : { 1, 2, 3 })
  {
    writeAs(version, "<f8", "False", wide);
    expectPlane();
    writeAs(version, "<f4", "False", narrow);
    expectPlane();
  }
  const std::vector<std::uint16_t> half(36, 0x3c00);
  writeAs(1, "<f2", "False", half);
  EXPECT_THAT(this->refusal(), HasSubstr("'<f2'"));
  writeAs(1, "<i4", "False", narrow);
  EXPECT_THAT(this->refusal(), HasSubstr("'<i4'"));
  writeAs(1, ">f4", "False", narrow);
  EXPECT_THAT(this->refusal(), HasSubstr("'>f4'"));
  writeAs(1, "<f8", "True", wide);
  EXPECT_THAT(this->refusal(), HasSubstr("'fortran_order': True"));
  writeAs(4, "<f8", "False", wide);
  EXPECT_THAT(this->refusal(), HasSubstr("no NumPy file"));
}

// Parts of parts of a table are as large as all that is in them.
TEST_F(RayTables, FindPointsJustBeforeTheirOrigins)
{
  std::vector<double> numbers;
  for (int i = 0; i < 21 * 19; ++i)
  {
    numbers.insert(numbers.end(), { double(i % 21), double(i / 21), 0, 0, 0, 1 }); // NOLINT: a parallel projection
  }
  this->write(19, 21, 6, numbers);
  const auto camera = this->camera(21, 19);
  for (int i = 0; i < 21 * 19; ++i)
  {
    const Eigen::Vector2d at(i % 21, i / 21); // NOLINT: of the row
    Eigen::Vector2d pixel;
    ASSERT_TRUE(camera->project({ at.x(), at.y(), 1e-3 }, pixel)) << at.transpose();
    ASSERT_LE((pixel - at - Eigen::Vector2d(0.5, 0.5)).norm(), 1e-9);
    ASSERT_FALSE(camera->project({ at.x(), at.y(), -1e-3 }, pixel)) << "behind";
  }
}

/// Of a fine table directions differ so little from pixel to pixel that their roundings are more than 1e-14 pixels.
TEST_F(RayTables, FindEveryPointOfAFineImage)
{
  constexpr int width = 640;
  constexpr int height = 48;
  for (const int channels : { 3, 6 })
  {
    std::vector<double> numbers;
    for (int i = 0; i < width * height; ++i)
    {
      const double x = (i % width + 0.5 - 310) / 575;
      const double y = (i / width + 0.5 - 21) / 570; // NOLINT: of the row
      if (channels == 6)
      {
        numbers.insert(numbers.end(), { x / 100, y / 100, 0.1 });
      }
      numbers.insert(numbers.end(), { x, y, 1.0 });
    }
    this->write(height, width, channels, numbers);
    const auto camera = this->camera(width, height);
    std::mt19937_64 random(3);
    const auto between = [&random](double from, double to)
    { return std::uniform_real_distribution<double>(from, to)(random); };
    for (int i = 0; i < 3000; ++i)
    {
      const Eigen::Vector2d expected(between(0, width), between(0, height));
      const CameraRay ray = camera->rayThrough(expected);
      Eigen::Vector2d pixel;
      ASSERT_TRUE(camera->project(ray.origin + between(0.5, 20) * ray.direction, pixel)) << expected.transpose();
      EXPECT_LE((pixel - expected).norm(), 1e-8) << expected.transpose();
    }
  }
}

TEST_F(RayTables, RefuseWhatIsNone)
{
  const std::string path = this->Folder.path("rays.npy");
  EXPECT_THAT(this->refusal(), HasSubstr("rays.npy"));
  writeFile(path, "nothing");
  EXPECT_THAT(this->refusal(), HasSubstr("rays.npy: is no table of rays"));
  this->write(3, 4, 3, { 1, 2, 3 });
  EXPECT_THAT(this->refusal(), HasSubstr("and 24 bytes"));
  this->write(4, 3, 2, std::vector<double>(24));
  EXPECT_THAT(this->refusal(), HasSubstr("height x width x 3 (directions) or x 6"));
  this->write(1, 12, 3, this->plane());
  EXPECT_THAT(this->refusal(), HasSubstr("2 x 2 at least"));
  for (const double none : { 0.0, notANumber })
  {
    this->write(3, 4, 3, std::vector<double>(36, none));
    EXPECT_THAT(this->refusal(), HasSubstr("found directions that are all 0 or no number"));
  }
  std::vector<double> timed(48, 1);
  timed[3] = 1e4;
  this->write(3, 4, 4, timed);
  EXPECT_THAT(this->refusal(), HasSubstr("a time of 10000 frames (expected -1000 to 1000)"));
  timed[3] = -1000;
  this->write(3, 4, 4, timed);
  std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) + std::chrono::seconds(1));
  EXPECT_EQ(this->camera(4, 3)->times().first, -1000);
}
