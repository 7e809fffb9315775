// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTrackDocuments.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkLayerReader.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;

TEST(TrackDocuments, PointsAndPlacesAreReadAsWritten)
{
  const TemporaryFolder folder;
  TrackPoint point;
  point.object = 3;
  point.triangle = 12;
  point.barycentric = Eigen::Vector3d(0.1, 0.2, 0.7);
  point.x = Eigen::Vector3d(1e-300, -2, 1.0 / 3);
  point.color[0] = 255;
  point.color[2] = 7;
  point.isStatic = true;
  point.camera = "left \"1\"";
  point.frame = -4;
  TrackPoint other;
  other.object = 1;
  const std::string text = tracksText({ point, other });
  const std::string path = folder.path("points.json");
  writeFile(path, text);
  const std::vector<TrackPoint> read = readTrackPoints(path);
  EXPECT_EQ(tracksText(read), text);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].barycentric, point.barycentric);
  EXPECT_EQ(read[0].x, point.x);
  EXPECT_EQ(read[0].camera, point.camera);
  EXPECT_TRUE(read[0].isStatic);
  EXPECT_FALSE(read[1].isStatic);
  writeFile(path, tracksText({}));
  EXPECT_TRUE(readTrackPoints(path).empty());

  const std::string file = folder.path("000001.npy");
  writeFile(file, trackPlacesNpy({ { 1.5, -2.25, 1 }, { std::nan(""), std::nan(""), 5 } }));
  const std::vector<TrackPlace> places = readTrackPlaces(file, 2);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].v, -2.25);
  EXPECT_EQ(places[0].visibility, 1);
  EXPECT_TRUE(std::isnan(places[1].u));
  const ImageData image = readLayerFile(file);
  EXPECT_EQ(image.info.width, 3);
  EXPECT_EQ(image.info.height, 2);
  EXPECT_EQ(image.pixels.row<double>(0)[1], -2.25);
  EXPECT_THAT(
    thrownBy<InputError>([&] { readTrackPlaces(file, 3); }), HasSubstr("expected 3 x 3 float64, found 2 x 3 float64"));
  EXPECT_TRUE(readTrackPlaces(file, 0).empty());
}

TEST(TrackDocuments, RefusalsNameThePlace)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("points.json");
  TrackPoint point;
  point.object = 1;
  const std::string text = tracksText({ point });
  const auto with = [&](const std::string& from, const std::string& to)
  {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    writeFile(path, changed);
    return thrownBy<InputError>([&] { readTrackPoints(path); });
  };
  EXPECT_EQ(with("[0, 0, 0]", "[0, 255, 0]"), "");
  EXPECT_THAT(with("[0, 0, 0]", "[0, 256, 0]"), HasSubstr(path + ":3: points[0].color[1] is out of range"));
  EXPECT_THAT(with("\"object\": 1", "\"object\": 0"), HasSubstr("points[0].object is out of range"));
  EXPECT_THAT(with("false", "0"), HasSubstr("points[0].static has the wrong type"));
  EXPECT_THAT(with("\"frame\": 0", "\"time\": 0"), HasSubstr("points[0]"));
}
