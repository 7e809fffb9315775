// SPDX-License-Identifier: BSD-3-Clause
// Cameras of a dataset: cameras.json.
#include "dgtkDatasetDocuments.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;

namespace
{
CameraRecord smallCamera(const std::string& model)
{
  CameraRecord camera;
  camera.name = "c";
  camera.width = camera.height = 8;
  camera.model = model;
  camera.near = 1;
  camera.far = 100;
  return camera;
}
} // namespace

TEST(Cameras, RoundTripIsExactAndSorted)
{
  const TemporaryFolder folder;
  CameraRecord a;
  a.name = "a \"quoted\"\n";
  a.frame = 2;
  a.width = 640;
  a.height = 480;
  a.K << 500.1, 0, 320, 0, 1.0 / 3, 240, 0, 0, 1;
  a.R = Eigen::Matrix3d::Identity();
  a.R(0, 1) = -0.0;
  a.t << 1e-17, 2.5, -3;
  a.model = "brown";
  a.numbers["distortion"] = { 0.1, -0.02 };
  a.numbers["xi"] = { 0.75 };
  a.near = 0.1;
  a.far = std::numeric_limits<double>::infinity();
  CameraRecord b = a;
  b.frame = -1;
  const std::string text = camerasText({ a, b });
  EXPECT_EQ(text, camerasText({ b, a }));
  writeFile(folder.path("cameras.json"), text);
  const std::vector<CameraRecord> read = readCameras(folder.path("cameras.json"));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].frame, -1);
  EXPECT_EQ(read[1].name, a.name);
  EXPECT_EQ(read[1].K, a.K);
  EXPECT_EQ(read[1].R, a.R);
  EXPECT_EQ(read[1].t, a.t);
  EXPECT_EQ(read[1].numbers, a.numbers);
  EXPECT_TRUE(read[1].hasK);
  EXPECT_EQ(read[1].far, a.far);
  EXPECT_EQ(camerasText(read), text);
}

TEST(Cameras, AModelWithoutMatrixHasItsOwnKeys)
{
  const TemporaryFolder folder;
  CameraRecord camera = smallCamera("raytable");
  camera.hasK = false;
  camera.numbers["shift"] = { 1, 2 };
  camera.files["rays"] = "inputs/rays.npy";
  const std::string text = camerasText({ camera });
  EXPECT_EQ(text.find("\"K\""), std::string::npos);
  EXPECT_THAT(
    text, HasSubstr("\"distortion\": [],\n      \"shift\": [1.0, 2.0],\n      \"rays\": \"inputs/rays.npy\""));
  writeFile(folder.path("cameras.json"), text);
  const CameraRecord read = readCameras(folder.path("cameras.json")).at(0);
  EXPECT_FALSE(read.hasK);
  EXPECT_EQ(read.numbers, camera.numbers);
  EXPECT_EQ(read.files.at("rays"), folder.path("inputs/rays.npy"));
  std::string wrong = text;
  wrong.replace(wrong.find("[1.0, 2.0]"), 10, "true");
  writeFile(folder.path("cameras.json"), wrong);
  EXPECT_THAT(thrownBy<InputError>([&] { readCameras(folder.path("cameras.json")); }), HasSubstr("cameras[0].shift"));
}

// Rays of such cameras would be none, or lead backwards.
TEST(Cameras, WhatCannotSeeIsRefused)
{
  const TemporaryFolder folder;
  const CameraRecord camera = smallCamera("pinhole");
  const auto refused = [&](const CameraRecord& wrong)
  {
    writeFile(folder.path("cameras.json"), camerasText({ wrong }));
    return thrownBy<InputError>([&] { readCameras(folder.path("cameras.json")); });
  };
  EXPECT_EQ(refused(camera), "");
  for (const double near : { 0.0, -1.0 })
  {
    CameraRecord wrong = camera;
    wrong.near = near;
    EXPECT_THAT(refused(wrong), HasSubstr("cameras[0].near is out of range (expected a number above 0"));
  }
  for (const double scale : { 0.0, 0.99, 1.01, 1e300 })
  {
    CameraRecord wrong = camera;
    wrong.R(1, 1) = scale;
    EXPECT_THAT(refused(wrong), HasSubstr("cameras[0].R is no rotation")) << scale;
    wrong.R(1, 1) = scale > 0.5 && scale < 2 ? 1 + (scale - 1) / 4 : 1;
    EXPECT_EQ(refused(wrong), "") << scale;
  }
}
