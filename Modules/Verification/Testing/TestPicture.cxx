// SPDX-License-Identifier: BSD-3-Clause
// Which surfaces a pixel may show, and where they end. All of pixel (4, 2), through whose centre runs the axis.
#include "dgtkHandMade.h"
#include "dgtkPicture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace
{
using namespace dgtk;
using Eigen::Vector3d;
using test::HandMade;
using test::triangleModel;
using test::wallModel;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

constexpr double within = 0.01; ///< pixels: of the reach of an edge
constexpr double beyond = 0.03;

/// Pixels right of the axis as x at a depth.
double across(double pixels, double depth) { return pixels * depth / 100; }

/// Covers what is right of a vertical line, in pixels from the centre.
std::string rightOf(double pixels, double depth)
{
  return triangleModel({ across(pixels, depth), -90, depth }, { 90, 0, depth }, { across(pixels, depth), 90, depth });
}

std::string two(const std::string& first, const std::string& second)
{
  std::string text = first + second;
  return text.replace(text.rfind("f 1 2 3"), 7, "f 4 5 6");
}

class Seen
{
public:
  explicit Seen(const std::vector<std::string>& models, const std::vector<std::string>& more = {})
    : Made(models, more)
    , TheDataset(this->Made.dataset())
    , ThePicture(*this->TheDataset, this->Made.camera())
  {
  }
  /// Objects of the surfaces, 0 for none.
  std::vector<std::uint32_t> nearby(int x = 4, int y = 2) const
  {
    std::vector<std::uint32_t> objects;
    for (const Hit& hit : this->ThePicture.nearby(x, y))
    {
      objects.push_back(hit.object);
    }
    return objects;
  }
  bool ends(double depth, int x = 4, int y = 2) const { return this->ThePicture.isEdgeAt(x, y, depth); }

private:
  HandMade Made;
  std::unique_ptr<Dataset> TheDataset;
  Picture ThePicture;
};

TEST(Picture, SurfacesNearAPixel)
{
  EXPECT_THAT(Seen({ wallModel(2) }).nearby(), ElementsAre(1));
  EXPECT_THAT(Seen({ wallModel(2), rightOf(within, 1) }).nearby(), ElementsAre(1, 2));
  EXPECT_THAT(Seen({ wallModel(2), rightOf(-within, 1) }).nearby(), UnorderedElementsAre(1, 2));
  EXPECT_THAT(Seen({ wallModel(2), rightOf(beyond, 1) }).nearby(), ElementsAre(1));
  EXPECT_THAT(Seen({ wallModel(2), rightOf(-beyond, 1) }).nearby(), ElementsAre(2));
  EXPECT_THAT(Seen({ rightOf(within, 1) }).nearby(), ElementsAre(0, 1));
  EXPECT_THAT(Seen({ rightOf(beyond, 1) }).nearby(), ElementsAre(0));
  EXPECT_THAT(Seen({ wallModel(200) }).nearby(), ElementsAre(0)) << "beyond far";
}

TEST(Picture, SurfacesThatCoincide)
{
  EXPECT_THAT(Seen({ wallModel(2), wallModel(2 * (1 + 1e-10)) }).nearby(), UnorderedElementsAre(1, 2));
  EXPECT_THAT(Seen({ wallModel(2), wallModel(2 * (1 + 1e-8)) }).nearby(), ElementsAre(1));
  EXPECT_THAT(Seen({ wallModel(2), wallModel(2 * (1 - 1e-8)) }).nearby(), ElementsAre(2));
}

TEST(Picture, WhatASolidSurfaceHidesIsNotNear)
{
  EXPECT_THAT(Seen({ rightOf(-within, 1), wallModel(2), wallModel(3) }).nearby(), UnorderedElementsAre(1, 2));
  EXPECT_THAT(Seen({ wallModel(2), rightOf(-within, 3) }).nearby(), ElementsAre(1));
  EXPECT_THAT(Seen({ rightOf(-within, 1), rightOf(-within, 2), wallModel(3) }).nearby(), UnorderedElementsAre(1, 2, 3));
}

/// Between the outer rays, and beside the one through the centre.
TEST(Picture, SliversNearAPixel)
{
  const auto sliver = [](double from, double to) {
    return triangleModel({ across(from, 1), -90, 1 }, { across(to, 1), 0, 1 }, { across(from, 1), 90, 1 });
  };
  EXPECT_THAT(Seen({ wallModel(2), sliver(0.003, 0.005) }).nearby(), UnorderedElementsAre(1, 2));
  EXPECT_THAT(Seen({ wallModel(2), sliver(-0.001, 0.001) }).nearby(), UnorderedElementsAre(1, 2));
}

TEST(Picture, SurfacesEndAtTheirEdges)
{
  const Seen seen({ rightOf(-within, 2), rightOf(-beyond, 3), rightOf(within, 4), rightOf(-within, 5),
                    rightOf(beyond, 7), two(wallModel(8), rightOf(-within, 6)) },
    { "", "", "", R"(, "visible": {"keys": [[0, false], [1, true]]})" });
  EXPECT_TRUE(seen.ends(2));
  EXPECT_FALSE(seen.ends(3));
  EXPECT_TRUE(seen.ends(4)) << "just beside the centre";
  EXPECT_FALSE(seen.ends(5)) << "it is not there";
  EXPECT_TRUE(seen.ends(6)) << "the last triangle of the last object";
  EXPECT_FALSE(seen.ends(7));
  EXPECT_FALSE(seen.ends(8));
  EXPECT_FALSE(seen.ends(9));
  EXPECT_TRUE(seen.ends(2 * (1 + 1e-10)));
  EXPECT_TRUE(seen.ends(2 * (1 - 1e-10)));
  EXPECT_FALSE(seen.ends(2 * (1 + 1e-8)));
  EXPECT_FALSE(seen.ends(2 * (1 - 1e-8)));
  const Seen far({ rightOf(-within, 50) });
  EXPECT_TRUE(far.ends(50 * (1 + 5e-10)));
  EXPECT_FALSE(far.ends(50 * (1 + 2e-9)));
  EXPECT_TRUE(seen.ends(2, 4, 5)) << "the same column";
  EXPECT_FALSE(seen.ends(2, 3, 2));
  EXPECT_FALSE(seen.ends(2, 5, 2));
}

TEST(Picture, EveryEdgeAndCornerCounts)
{
  const Vector3d corners[] = { { across(-within, 2), -1, 2 }, { 1, 0, 2 }, { across(-within, 2), 0.05, 2 } };
  for (int first = 0; first < 3; ++first)
  {
    const auto corner = [&](int i) -> const Vector3d& { return corners[(first + i) % 3]; };
    EXPECT_TRUE(Seen({ triangleModel(corner(0), corner(1), corner(2)) }).ends(2)) << first;
    EXPECT_TRUE(Seen({ triangleModel(corner(2), corner(1), corner(0)) }).ends(2)) << first;
  }
  // Beside a corner, within the reach and not; the lines of both edges run through the centre or near it.
  for (const double sign : { 1.0, -1.0 })
  {
    for (const double off : { within, beyond })
    {
      const double x = across(sign * off, 2);
      EXPECT_EQ(Seen({ triangleModel({ x, 0, 2 }, { sign, 0, 2 }, { sign, 1, 2 }) }).ends(2), off == within);
      EXPECT_EQ(Seen({ triangleModel({ sign, 0, 2 }, { x, 0, 2 }, { sign, 1, 2 }) }).ends(2), off == within);
    }
  }
}

/// Where it ends in the image is not known.
TEST(Picture, WhatReachesBehindTheCameraHasNoEdges)
{
  const double x = across(-within, 2);
  const Seen seen({ triangleModel({ x, -1, 2 }, { 50, 0, -1 }, { x, 1, 2 }) });
  EXPECT_FALSE(seen.ends(2 - 3 * -x / (50 - x)));
}

/// At a frame that has no picture it is the scene's, in the size of its other pictures.
TEST(Dataset, CamerasOfOtherFramesAreTheScenes)
{
  HandMade made({ wallModel(2) });
  made.camera().width = 16;
  made.camera().height = 12;
  made.camera().near = 0.5;
  const std::unique_ptr<Dataset> dataset = made.dataset();
  const std::optional<Eye> own = dataset->eye("a", 0, {});
  ASSERT_TRUE(own);
  EXPECT_EQ(own->record().near, 0.5) << "as cameras.json has it";
  const std::optional<Eye> other = dataset->eye("a", 7, {});
  ASSERT_TRUE(other);
  const CameraRecord& record = other->record();
  EXPECT_EQ(record.name, "a");
  EXPECT_EQ(record.frame, 7);
  EXPECT_EQ(record.model, "pinhole");
  EXPECT_EQ(record.width, 16);
  EXPECT_EQ(record.height, 12);
  EXPECT_EQ(record.near, 0.1);
  EXPECT_EQ(record.far, 100);
  EXPECT_TRUE(record.hasK);
  EXPECT_DOUBLE_EQ(record.K(0, 2), 8);
  EXPECT_DOUBLE_EQ(record.K(1, 2), 6);
  EXPECT_LT((record.R * Vector3d(0, 0, 1) - Vector3d(0, 0, 1)).norm(), 1e-15);
  EXPECT_LT((record.R * Vector3d(0, 1, 0) - Vector3d(0, -1, 0)).norm(), 1e-15);
  EXPECT_EQ(record.t, Vector3d(0, 0, 0));
  EXPECT_FALSE(dataset->eye("b", 0, {}));
}

/// On the edge of a wall, a file may say that it is there, and that nothing is; also where it is the only one.
TEST(Picture, FilesOfPartsAndTrianglesSayThatThereIsNothing)
{
  for (const std::string layer : { "parts", "triangles" })
  {
    for (const double pixels : { within, beyond })
    {
      for (const double off : { -pixels, pixels })
      {
        HandMade made({ rightOf(off, 2) });
        const bool isThere = off < 0;
        made.image("a/" + layer + "/000000.npy", 1,
          [&](int x, int, int) { return x > 4 || (x == 4 && !isThere) ? 0.0 : double(noId); });
        EXPECT_EQ(made.verify("objects", layer).bad, pixels == within ? 0u : 6u) << layer << off;
      }
    }
  }
}

TEST(Dataset, FilesAreThoseOfTheirCameraFrameAndLayer)
{
  HandMade made({ wallModel(2) }, {}, { "a", "b" });
  for (const char* const file : { "a/depth/000000.npy", "a/depth/000000.pfm", "a/depth/000001.exr",
         "a/edges/000000.png", "b/depth/000000.dgd", "b/edges/000000.npy" })
  {
    made.file(file, "");
  }
  const std::unique_ptr<Dataset> dataset = made.dataset();
  EXPECT_THAT(dataset->suffixes("a", "depth", 0), ElementsAre(".npy", ".pfm"));
  EXPECT_THAT(dataset->suffixes("a", "depth", 1), ElementsAre(".exr"));
  EXPECT_THAT(dataset->suffixes("a", "edges", 0), ElementsAre(".png"));
  EXPECT_THAT(dataset->suffixes("b", "depth", 0), ElementsAre(".dgd"));
  EXPECT_THAT(dataset->suffixes("b", "edges", 0), ElementsAre(".npy"));
  EXPECT_THAT(dataset->suffixes("a", "coverage", 0), ElementsAre()) << "before all others";
  EXPECT_THAT(dataset->suffixes("a", "edges", 1), ElementsAre());
  EXPECT_THAT(dataset->layers("a", 0), ElementsAre("depth", "edges"));
  EXPECT_THAT(dataset->layers("a", 1), ElementsAre("depth"));
  EXPECT_THAT(dataset->layers("a", 2), ElementsAre());
  EXPECT_THAT(dataset->layers("b", 0), ElementsAre("depth", "edges"));
  EXPECT_EQ(dataset->find("a", "depth", 0, { ".exr", ".pfm", ".npy" }), "a/depth/000000.pfm");
  EXPECT_EQ(dataset->find("a", "edges", 1, { ".png" }), "");
}
} // namespace
