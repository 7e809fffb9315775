// SPDX-License-Identifier: BSD-3-Clause
// What the checks leave open: a disagreement within a tenth of each slack, and one of ten times, which must be named.
#include "dgtkHandMade.h"

#include "dgtkCheck.h"
#include "dgtkObjectDocuments.h"
#include "dgtkSeenPoint.h"
#include "dgtkSurfaceColor.h"
#include "dgtkTrackSamples.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace dgtk;
using Eigen::Vector2d;
using Eigen::Vector3d;
using test::HandMade;
using test::triangleModel;
using test::wallModel;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Bad values of a layer of one camera whose pixel (4, 2) alone shows the model, and that says `said` there.
std::uint64_t badOf(const std::string& model, const std::string& layer, const Vector3d& said)
{
  HandMade made({ model });
  made.image("a/" + layer + "/000000.npy", 3, [&](int x, int y, int c) { return x == 4 && y == 2 ? said[c] : nan; });
  const Residual residual = made.verify("geometry", layer);
  EXPECT_EQ(residual.count + residual.skipped, 48u);
  return residual.bad;
}

/// The side that is seen.
const Vector3d toCamera(0, 0, -1);

TEST(Slacks, NormalsOfSlivers)
{
  const auto sliver = [](double sine)
  {
    const double w = 0.004; // a pixel is 0.02
    const double h = sine * 2 * w;
    return triangleModel({ -w, -h / 2, 2 }, { w, -h / 2, 2 }, { 0, h / 2, 2 });
  };
  EXPECT_EQ(badOf(sliver(1e-5), "normal", toCamera), 0u);
  EXPECT_EQ(badOf(sliver(1e-5), "normal", Vector3d(1, 0, 0)), 1u);
  EXPECT_EQ(badOf(sliver(1e-7), "normal", Vector3d(1, 0, 0)), 0u);
}

TEST(Slacks, NormalsOfTrianglesSeenFromTheirEdge)
{
  const auto grazed = [](double cosine) {
    return triangleModel({ -0.003, -cosine, 1 }, { 0.003, -cosine, 1 }, { 0, cosine, 3 });
  };
  const auto badSides = [&](const std::string& layer, double cosine)
  {
    const Vector3d side = Vector3d(0, 1, -cosine).normalized();
    return badOf(grazed(cosine), layer, side) + badOf(grazed(cosine), layer, -side);
  };
  for (const char* const layer : { "normal", "shadingnormal" })
  {
    EXPECT_EQ(badSides(layer, 1e-8), 1u) << layer;
    EXPECT_EQ(badSides(layer, 1e-10), 0u) << layer;
  }
}

TEST(Slacks, ShadingNormalsThatCancelEachOther)
{
  const auto cancelling = [](double weight)
  {
    const double h = 0.008;
    return "vn 1 0 0\nvn -1 0 0\nvn 0 0 1\n" + triangleModel({ -0.004, -weight * h, 2 }, { 0.004, -weight * h, 2 },
                                                 { 0, (1 - weight) * h, 2 }, "f 1//1 2//2 3//3");
  };
  EXPECT_EQ(badOf(cancelling(1e-2), "shadingnormal", toCamera), 0u);
  EXPECT_EQ(badOf(cancelling(1e-2), "shadingnormal", Vector3d(0, 1, 0)), 1u);
  EXPECT_EQ(badOf(cancelling(1e-4), "shadingnormal", Vector3d(0, 1, 0)), 0u);
}

/// Two walls of one object side by side, a step of 0.01 of the depth, more or less.
TEST(Slacks, StepsOfDepth)
{
  const auto badAt = [](double more, double said)
  {
    const double far = 2.02 + 2 * more;
    HandMade made({ triangleModel({ 0.01, -90, 2 }, { 0.01, 90, 2 }, { -90, 0, 2 }) + "v 0.01 -90 " + numberText(far) +
                    "\nv 90 0 " + numberText(far) + "\nv 0.01 90 " + numberText(far) + "\nf 4 5 6\n" });
    made.image("a/edges/000000.npy", 1, [&](int x, int, int) { return x == 4 || x == 5 ? said : 0; });
    return made.verify("edges", "edges").bad;
  };
  EXPECT_EQ(badAt(1e-8, 128), 0u);
  EXPECT_EQ(badAt(1e-8, 0), 12u);
  EXPECT_EQ(badAt(-1e-8, 0), 0u);
  EXPECT_EQ(badAt(-1e-8, 128), 12u);
  for (const double more : { 1e-10, -1e-10 })
  {
    EXPECT_EQ(badAt(more, 0), 0u);
    EXPECT_EQ(badAt(more, 128), 0u);
  }
}

/// A pixel whose centre is beside an edge may show either side, up to 1/64 pixel.
TEST(Slacks, EdgesOfWhatIsSeen)
{
  const auto depths = [](double off, int from)
  {
    const double x = off / 100;
    HandMade made({ wallModel(2), triangleModel({ x, -90, 1 }, { 90, 0, 1 }, { x, 90, 1 }) });
    made.image("a/depth/000000.npy", 1, [&](int column, int, int) { return column >= from ? 1 : 2; });
    const Residual residual = made.verify("depth", "depth");
    EXPECT_EQ(residual.count + residual.skipped, 48u);
    return std::pair(residual.bad, residual.skipped);
  };
  using Found = std::pair<std::uint64_t, std::uint64_t>;
  EXPECT_EQ(depths(0.0015, 4), Found(0, 6));
  EXPECT_EQ(depths(0.15, 4), Found(6, 0));
  EXPECT_EQ(depths(-0.0015, 5), Found(0, 6));
  EXPECT_EQ(depths(-0.15, 5), Found(6, 0));
}

/// Values that are right to the last digit are compared, not left open.
TEST(Slacks, DistancesAreCompared)
{
  const auto found = [](double factor)
  {
    HandMade made({ wallModel(2) });
    made.image("a/distance/000000.npy", 1,
      [&](int x, int y, int) { return 2 * Vector3d((x - 4) / 100.0, (y - 2) / 100.0, 1).norm() * factor; });
    return made.verify("geometry", "distance");
  };
  for (const auto& [factor, bad] : { std::pair(1.0, 0u), std::pair(1 + 1e-8, 48u), std::pair(1 - 1e-8, 48u) })
  {
    const Residual residual = found(factor);
    EXPECT_EQ(residual.count, 48u) << factor;
    EXPECT_EQ(residual.skipped, 0u) << factor;
    EXPECT_EQ(residual.bad, bad) << factor;
  }
}

/// Beside an edge of an object its other side may be shown; what is named as expected is the pixel's own, whatever was
/// tried.
TEST(Slacks, NormalsBesideAnEdgeOfOneObject)
{
  const double x = 0.01 / 100;
  const double slope = 0.1;
  const std::string both =
    wallModel(2) + triangleModel({ x, -90, 1 }, { 90, 0, 1 + (90 - x) * slope }, { x, 90, 1 }, "f 4 5 6");
  const Vector3d turned = Vector3d(slope, 0, -1).normalized();
  const auto found = [&](const Vector3d& atCentre)
  {
    HandMade made({ both });
    made.image("a/normal/000000.npy", 3,
      [&](int column, int row, int c) {
        return column == 4 && row == 2 ? atCentre[c] : column > 4 ? turned[c] : toCamera[c];
      });
    return made.verify("geometry", "normal");
  };
  EXPECT_EQ(found(toCamera).skipped, 0u);
  EXPECT_EQ(found(toCamera).bad, 0u);
  EXPECT_EQ(found(turned).skipped, 1u);
  EXPECT_EQ(found(turned).bad, 0u);
  const Residual wrong = found(Vector3d(0, 1, 0));
  EXPECT_EQ(wrong.skipped, 0u);
  EXPECT_EQ(wrong.bad, 1u);
  EXPECT_EQ(wrong.worst.expected, "(-0, -0, -1)");
}

/// A point of an object at depth 2 that something else may hide, and that may be at the limits of what is seen.
TEST(Slacks, LimitsOfKeypoints)
{
  struct Case
  {
    double before; ///< where the other object is
    double near;
    double x;
    int said;
    bool bad;
  };
  // The format: what is less than a hundredth of the box's diagonal, here 1, before a point does not hide it.
  const Case cases[] = {
    { 0.0099, 0.1, 0.001, 1, false },
    { 0.0099, 0.1, 0.001, 2, true },
    { 0.0101, 0.1, 0.001, 1, true },
    { 0.0101, 0.1, 0.001, 2, false },
    { 0.01 + 2e-7, 0.1, 0.001, 1, false },
    { 0.01 + 2e-5, 0.1, 0.001, 1, true },
    { -1, 2 * (1 - 1e-7), 0.001, 4, false },
    { -1, 2 * (1 - 1e-5), 0.001, 4, true },
    { -1, 0.1, 0.02 * (-4.5 + 1e-7), 4, false },
    { -1, 0.1, 0.02 * (-4.5 + 1e-5), 4, true },
    { -1, 0.1, 0.02 * (3.5 - 1e-7), 4, false },
    { -1, 0.1, 0.02 * (3.5 - 1e-5), 4, true },
  };
  for (const Case& one : cases)
  {
    HandMade made(
      { wallModel(2), wallModel(2 - one.before) }, { R"(, "keypoints": {"p": [)" + numberText(one.x) + ", 0, 2]}" });
    made.camera().near = one.near;
    BoxRecord box;
    box.id = 1;
    box.corners.row(7) = Vector3d(0, 0, 1).transpose();
    KeypointRecord point;
    point.name = "p";
    point.x = Vector3d(one.x, 0, 2);
    point.pixel = Vector2d(50 * one.x + 4.5, 2.5);
    point.visibility = one.said;
    box.keypoints = { point };
    made.file("a/boxes/000000.json", boxesText("a", 0, { box }));
    EXPECT_EQ(made.verify("keypoints", "visible").bad, one.bad ? 1u : 0u) << &one - cases;
  }
}

/// What poses.json says of objects whose axes are all but perpendicular, or have no length.
std::uint64_t badPoses(const std::vector<std::string>& places, const std::vector<Vector3d>& scales)
{
  HandMade made({ wallModel(2), wallModel(3) }, places);
  std::vector<PoseRecord> poses(2);
  for (std::uint32_t id = 1; id <= 2; ++id)
  {
    PoseRecord& pose = poses[id - 1];
    const Affine3 world = made.dataset()->state(0)->instances[id - 1].world_from_object;
    pose.id = id;
    pose.matrix << world.linear, world.translation;
    pose.t = world.translation;
    pose.rigid = id <= scales.size();
    pose.scale = pose.rigid ? scales[id - 1] : pose.scale;
    for (int i = 0; i < 3; ++i)
    {
      pose.R.col(i) = world.linear.col(i).stableNormalized();
    }
  }
  made.file("poses.json", posesText(poses));
  return made.verify("poses", "poses").bad;
}

TEST(Slacks, ShearedObjects)
{
  // A child of a parent that stretches.
  const auto badAt = [](double cosine, bool rigid)
  {
    const double size = std::sqrt((1 + std::pow(1 + cosine, 2)) / 2); // of axes at 45 degrees
    return badPoses({ R"(, "scale": [1, )" + numberText(1 + cosine) + ", 1]",
                      R"(, "parent": "o1", "orientation": [0.92387953251128674, 0, 0, 0.38268343236508977])" },
      rigid ? std::vector<Vector3d>{ { 1, 1 + cosine, 1 }, { size, size, 1 } }
            : std::vector<Vector3d>{ { 1, 1 + cosine, 1 } });
  };
  EXPECT_EQ(badAt(5e-11, false), 1u) << "not known, though it could be";
  EXPECT_EQ(badAt(5e-11, true), 0u);
  EXPECT_EQ(badAt(5e-9, false), 0u);
  EXPECT_EQ(badAt(5e-9, true), 1u) << "sheared";
  const std::string flat = R"(, "scale": [1, 1, 1e-200])";
  EXPECT_EQ(badPoses({ flat, flat }, { Vector3d(1, 1, 1e-200) }), 1u) << "one of the two";
}

TEST(Slacks, PointsOfTheGrid)
{
  struct Case
  {
    double own;     ///< off the centre of pixel (4, 3), where a new point is; nan: none is
    double earlier; ///< from that centre to the point of an earlier view; nan: none
    double hidden;  ///< part of the depth by which the other surface is nearer
    std::uint64_t bad;
    std::uint64_t open;
  };
  // A grid of steps of 6: one pixel, in whose middle is (3.5, 3.5).
  const Case cases[] = {
    { 0, nan, -1, 0, 0 },
    { 1e-9, nan, -1, 0, 0 },
    { 1e-7, nan, -1, 2, 0 },
    { nan, nan, -1, 1, 0 },
    { 0, 2.5, -1, 1, 0 },
    { nan, 2.5, -1, 0, 0 },
    { nan, 3 + 1e-7, -1, 0, 1 },
    { 0, 3 - 1e-7, -1, 0, 1 },
    { nan, 3 + 1e-5, -1, 1, 0 },
    { 0, 3 - 1e-5, -1, 1, 0 },
    { 0, 3 + 1e-5, -1, 0, 0 },
    { 0, nan, 1e-10, 0, 0 },
    { 0, nan, 1e-8, 1, 0 },
  };
  for (const Case& one : cases)
  {
    HandMade made({ wallModel(2), wallModel(2 * (1 - one.hidden)) });
    const std::unique_ptr<Dataset> dataset = made.dataset();
    TrackView view;
    view.index = 1;
    view.sampled = true;
    view.file = "f";
    view.sight = dataset->timedSight(Eye(made.camera(), nullptr), 0);
    std::vector<TrackOrigin> points;
    if (!std::isnan(one.earlier))
    {
      points.push_back({ { 1, 0 }, 0 });
      view.places.push_back({ 3.5, 3.5 - one.earlier, trackVisible });
    }
    if (!std::isnan(one.own))
    {
      points.push_back({ { 1, 0 }, 1 });
      view.places.push_back({ 3.5 + one.own, 3.5, trackVisible });
    }
    const Meter meter = meterTrackSamples(*dataset, view, points, 6);
    EXPECT_EQ(meter.Bad, one.bad) << &one - cases;
    EXPECT_EQ(meter.Skipped, one.open) << &one - cases;
  }
}

TEST(Slacks, BordersOfTexels)
{
  auto model = std::make_shared<Model>();
  model->triangles = { { 0, 1, 2 } };
  model->uvs = { { 0, 0 }, { 1, 0 }, { 0, 1 } };
  model->parts = { { "p", 0, 0, 1 } };
  auto image = std::make_shared<Image>();
  image->width = image->height = 2;
  image->rgba = { 0, 0, 0, 255, 0, 0, 0, 255, 200, 0, 0, 255, 0, 0, 0, 255 }; // red at the lower left
  model->textures.resize(1);
  model->textures[0].image = image;
  Instance instance;
  instance.model = model;
  Material material;
  material.diffuse = Vector3d(1, 1, 1);
  material.texture = 0;
  instance.materials = std::make_shared<std::vector<Material>>(1, material);
  const auto measured = [&](double u, double v, std::uint8_t red)
  {
    Meter meter(colorTolerance);
    const std::uint8_t color[3] = { red, 0, 0 };
    meterColor(
      instance, { 1, 0 }, Vector3d(1 - u - v, u, v), color,
      [](const std::string&, const std::string&) { return Offender{}; }, meter);
    return meter;
  };
  for (const double sign : { 1.0, -1.0 })
  {
    for (const int red : { 0, 200, 100 })
    {
      EXPECT_EQ(measured(0.5 + sign * 0.5e-7, 0.2, std::uint8_t(red)).Bad, red == 100 ? 1u : 0u) << "either, no other";
      EXPECT_EQ(measured(0.2, 0.5 + sign * 0.5e-7, std::uint8_t(red)).Bad, red == 100 ? 1u : 0u);
    }
    EXPECT_EQ(measured(sign * 0.5e-7, 0, 200).Bad, 0u) << "where the texture begins again";
    EXPECT_EQ(measured(0.5 + sign * 0.5e-5, 0.2, 200).Bad, sign > 0 ? 1u : 0u);
    EXPECT_EQ(measured(0.2, 0.5 + sign * 0.5e-5, 200).Bad, sign > 0 ? 1u : 0u);
  }
  EXPECT_EQ(measured(0.2, 0.2, 201).Bad, 1u);
}
} // namespace
