// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAlbedo.h"
#include "dgtkObjectTruth.h"
#include "dgtkSyntheticScene.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <random>
#include <set>

using namespace dgtk;
using namespace dgtk::test;

// What crosses the near plane reaches from its far end to the image's border, wherever its other corners are.
TEST(BlockObjects, ObjectsThroughTheCameraMayHideOthersUpToTheBorder)
{
  const View view = makeView(); // from z = 5
  for (const bool through : { false, true })
  {
    const auto state = SceneBuilder()
                         .add(makeQuad({ { -9, -9, -3 }, { 18, 0, 0 }, { 0, 18, 0 } }))
                         .add(makeQuad({ { 0, -0.1, 0 }, { 0.1, 0, 0 }, { 0, 0, through ? 9.0 : 0.1 } }))
                         .state();
    const BlockObjects blocks(*state, view);
    int open = 0;
    for (int y = 0; y < 48; y += 8)
    {
      for (int x = 0; x < 64; x += 8)
      {
        open += blocks.mayHideOthers(x, y, 1) ? 1 : 0;
      }
    }
    EXPECT_GE(open, through ? 12 : 1); // the lower right of 8 x 6 blocks, and those beside the middle
    EXPECT_LE(open, through ? 20 : 4);
    EXPECT_EQ(blocks.mayHideOthers(63, 47, 1), through);
    EXPECT_TRUE(blocks.mayHideOthers(32, 24, 1));
  }
}

// A lens sees what is beside it and behind: any object may be anywhere.
TEST(BlockObjects, UnderALensAllMayHideOthers)
{
  View view = makeView();
  view.model = makeEquidistant(64, 48, 10);
  const auto state =
    SceneBuilder()
      .add(makeQuad({ { -9, -9, -3 }, { 18, 0, 0 }, { 0, 18, 0 } }))
      .add(makeQuad({ { 3, -1, 6 }, { 0, 2, 0 }, { 0, 0, 2 } })) // beside the camera, no part before it
      .state();
  const BlockObjects blocks(*state, view);
  EXPECT_TRUE(blocks.mayHideOthers(0, 0, 1));
  EXPECT_TRUE(blocks.mayHideOthers(60, 40, 1));
}

namespace
{
/// Decodes run lengths column by column to a row-major mask.
std::vector<char> decoded(const std::vector<std::uint64_t>& lengths, int width, int height)
{
  std::vector<char> mask(std::size_t(width) * height, 2);
  std::uint64_t at = 0;
  char value = 0;
  for (const std::uint64_t length : lengths)
  {
    for (std::uint64_t i = 0; i < length; ++i, ++at)
    {
      mask[(at % height) * width + at / height] = value;
    }
    value = static_cast<char>(1 - value);
  }
  return mask;
}

ObjectPixels pixelsOf(const std::vector<char>& mask, int width, int height)
{
  ObjectPixels pixels;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      if (mask[std::size_t(y) * width + x])
      {
        pixels.add(x, y, true);
      }
    }
  }
  return pixels;
}

/// All surfaces by trying all triangles with pixel centres; queries nothing else.
class BruteQuery : public OcclusionQuery
{
public:
  void setScene(std::shared_ptr<const SceneState> state) override { this->State = std::move(state); }
  void allHits(const View& view, const Eigen::Vector2d& pixel, std::vector<Hit>& hits) const override
  {
    ++this->Asked;
    hits.clear();
    for (std::size_t i = 0; i < this->State->instances.size(); ++i)
    {
      for (std::uint32_t t = 0; t < this->State->instances[i].model->triangles.size(); ++t)
      {
        const Hit hit{ std::uint32_t(i + 1), t };
        Eigen::Vector3d corners[3];
        triangleInWorld(*this->State, hit, corners);
        const CameraRay ray = view.model->rayThrough(pixel);
        Eigen::Matrix3d sides; // o + t d = a + u (b - a) + v (c - a)
        const Eigen::Vector3d first = view.camera_from_world * corners[0];
        sides << ray.direction, first - view.camera_from_world * corners[1],
          first - view.camera_from_world * corners[2];
        const Eigen::Vector3d p = sides.inverse() * (first - ray.origin);
        if (p.allFinite() && p.x() >= view.near && p.x() <= view.far && p.y() >= 0 && p.z() >= 0 && p.y() + p.z() <= 1)
        {
          hits.push_back(hit);
        }
      }
    }
  }
  Hit occluder(const View&, const Eigen::Vector3d&, const Hit&) const override { return {}; }
  void allHits(
    const View& view, const Eigen::Vector2d* pixels, std::size_t count, std::vector<Hit>* hits) const override
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      this->allHits(view, pixels[i], hits[i]);
    }
  }
  void occluders(const View&, const Eigen::Vector3d*, const Hit*, std::size_t, Hit*) const override {}
  void occludersAt(const View&, const double*, const Eigen::Vector3d*, const Hit*, std::size_t, Hit*) const override {}
  mutable int Asked = 0;

private:
  std::shared_ptr<const SceneState> State;
};
} // namespace

TEST(ColumnRunLengths, DecodeToTheMask)
{
  std::mt19937 random(11);
  for (int round = 0; round < 400; ++round)
  {
    const int width = 1 + static_cast<int>(random() % 9);
    const int height = 1 + static_cast<int>(random() % 9);
    const unsigned int density = random() % 5;
    std::vector<char> mask(std::size_t(width) * height);
    for (char& value : mask)
    {
      value = random() % 4 < density;
    }
    const std::vector<std::uint64_t> lengths = columnRunLengths(pixelsOf(mask, width, height).runs, width, height);
    EXPECT_EQ(decoded(lengths, width, height), mask) << width << 'x' << height;
    for (std::size_t i = 1; i < lengths.size(); ++i)
    {
      EXPECT_GT(lengths[i], 0u) << "a run of no pixel";
    }
  }
}

TEST(ObjectPixels, StripsAddUpToTheWhole)
{
  const int width = 7;
  std::vector<char> mask(width * 6, 0);
  mask[2 * width + 3] = mask[2 * width + 4] = mask[4 * width + 1] = 1;
  const ObjectPixels whole = pixelsOf(mask, width, 6);
  EXPECT_EQ(whole.count, 3u);
  EXPECT_EQ((std::vector<int>{ whole.x0, whole.y0, whole.x1, whole.y1 }), (std::vector<int>{ 1, 2, 5, 5 }));
  ObjectPixels sum;
  ObjectPixels part;
  part.add(3, 2, true);
  part.add(4, 2, true);
  sum.append(part);
  sum.append({});
  ObjectPixels last;
  last.add(1, 4, true);
  sum.append(last);
  EXPECT_EQ(columnRunLengths(sum.runs, width, 6), columnRunLengths(whole.runs, width, 6));
  EXPECT_EQ(sum.x0, 1);
  EXPECT_EQ(sum.y1, 5);
}

TEST(ObjectPose, ABoxInItsOwnFrame)
{
  BoxOptions box;
  box.min = { -1, -2, -3 };
  box.max = { 2, 1, 0.5 };
  const Affine3 world_from_object = placement({ 0.5, -0.25, 1 }, 1.5, { 1, 2, 3 }, 0.7);
  const auto state = SceneBuilder().add(makeBox(box), world_from_object).state();
  ViewOptions options;
  options.eye = { 2, 3, 12 };
  const View view = makeView(options);
  const ObjectPose pose = objectPose(*state, 1, view);
  ASSERT_TRUE(pose.rigid);
  EXPECT_NEAR(pose.rotation.determinant(), 1, 1e-12);
  EXPECT_TRUE(pose.scale.isApprox(Eigen::Vector3d::Constant(1.5), 1e-12));
  Eigen::Vector4d extent(1e9, 1e9, -1e9, -1e9);
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d own(
      (corner & 1 ? box.max : box.min).x(), (corner & 2 ? box.max : box.min).y(), (corner & 4 ? box.max : box.min).z());
    const Eigen::Vector3d expected = view.camera_from_world * (world_from_object * own);
    EXPECT_TRUE(pose.corners.row(corner).transpose().isApprox(expected, 1e-12));
    EXPECT_TRUE((pose.rotation * pose.scale.asDiagonal() * own + pose.translation).isApprox(expected, 1e-12));
    EXPECT_TRUE((pose.matrix.leftCols<3>() * own + pose.matrix.col(3)).isApprox(expected, 1e-12));
    Eigen::Vector2d pixel;
    ASSERT_TRUE(view.model->project(expected, pixel));
    extent.head<2>() = extent.head<2>().cwiseMin(pixel);
    extent.tail<2>() = extent.tail<2>().cwiseMax(pixel);
  }
  ASSERT_TRUE(pose.projected.has_value());
  EXPECT_TRUE(pose.projected->isApprox(extent, 1e-12));
}

TEST(ObjectPose, MirroredAndShearedObjects)
{
  Affine3 mirrored = placement({ 0, 0, 0 }, 1, { 0, 0, 1 }, 0.3);
  mirrored.linear.col(1) *= -2;
  Affine3 sheared;
  sheared.linear(0, 1) = 0.5;
  Affine3 flat;
  flat.linear.col(2).setZero();
  const auto state = SceneBuilder().add(makeBox(), mirrored).add(makeBox(), sheared).add(makeBox(), flat).state();
  const View view = makeView();
  const ObjectPose pose = objectPose(*state, 1, view);
  ASSERT_TRUE(pose.rigid);
  EXPECT_NEAR(pose.rotation.determinant(), 1, 1e-12);
  EXPECT_LT(pose.scale.x(), 0);
  EXPECT_TRUE((pose.rotation * pose.scale.asDiagonal()).isApprox(view.camera_from_world.rotation * mirrored.linear));
  EXPECT_FALSE(objectPose(*state, 2, view).rigid);
  EXPECT_FALSE(objectPose(*state, 3, view).rigid);
}

TEST(ObjectPose, NothingIsProjectedOfAnObjectBehindTheCamera)
{
  const auto state = SceneBuilder().add(makeBox(), placement({ 0, 0, 20 })).state();
  EXPECT_FALSE(objectPose(*state, 1, makeView()).projected.has_value());
}

TEST(CollectObjects, EqualsAllHitsEverywhereAndAsksLittle)
{
  SphereOptions small;
  small.radius = 0.5;
  small.rings = 6;
  small.segments = 8;
  const auto state = SceneBuilder()
                       .add(makeBox(), placement({ 0, 0, -2 }))
                       .add(makeSphere(small), placement({ 0.4, 0.2, 1 }))
                       .add(makeSphere(small), placement({ -2, -1, 0 }))
                       .add(makeQuad(), placement({ 0, 0, 4.95 }, 0.02)) // before the near plane
                       .state();
  View view = makeView();
  view.near = 0.5;
  const VisibilityBuffer buffer = bruteForce(*state, view);
  BruteQuery query;
  query.setScene(state);
  std::vector<std::set<std::pair<int, int>>> expected(4);
  std::vector<Hit> all;
  int surfaces = 0;
  for (int y = 0; y < buffer.rect.height; ++y)
  {
    for (int x = 0; x < buffer.rect.width; ++x)
    {
      surfaces += buffer.at(x, y).object != 0;
      query.allHits(view, { x + 0.5, y + 0.5 }, all);
      for (const Hit& hit : all)
      {
        expected[hit.object - 1].insert({ x, y });
      }
    }
  }
  query.Asked = 0;
  ObjectRows rows;
  collectObjects(*state, view, query, BlockObjects(*state, view), buffer.rect, buffer.hits.data(), true, rows);
  EXPECT_LT(query.Asked, surfaces * 3 / 4);
  ASSERT_GT(query.Asked, 0);
  for (std::size_t i = 0; i < 4; ++i)
  {
    std::set<std::pair<int, int>> found;
    for (const PixelRun& run : rows.amodal[i].runs)
    {
      for (int x = run.x0; x < run.x1; ++x)
      {
        found.insert({ x, run.y });
      }
    }
    EXPECT_EQ(found, expected[i]) << "object " << i + 1;
    EXPECT_EQ(rows.amodal[i].count, expected[i].size());
    EXPECT_LE(rows.visible[i].count, rows.amodal[i].count);
  }
  EXPECT_EQ(rows.amodal[3].count, 0u);
  EXPECT_LT(rows.visible[0].count, rows.amodal[0].count);
}

TEST(Albedo, MultipliesDiffuseWithTheNearestTexel)
{
  std::shared_ptr<Model> model = makeQuad();
  auto image = std::make_shared<Image>();
  image->width = image->height = 2;
  image->rgba = { 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255 }; // rows from the top
  model->textures.push_back({ "t", "t", image });
  model->materials.at(0).texture = 0;
  model->materials.at(0).diffuse = { 0.5, 1, 0.2 };
  const auto state = SceneBuilder().add(model).state();
  const auto at = [&](double u, double v)
  {
    // find the triangle that holds the texture coordinate
    for (std::uint32_t t = 0; t < 2; ++t)
    {
      const auto& c = model->triangles[t];
      Eigen::Matrix2d sides;
      sides << model->uvs[c[1]] - model->uvs[c[0]], model->uvs[c[2]] - model->uvs[c[0]];
      const Eigen::Vector2d b = sides.inverse() * (Eigen::Vector2d(u, v) - model->uvs[c[0]]);
      if (b.minCoeff() >= 0 && b.sum() <= 1)
      {
        return albedoAt(state->instances[0], t, b);
      }
    }
    return std::array<std::uint8_t, 3>{ 1, 2, 3 };
  };
  EXPECT_EQ(at(0.2, 0.9), (std::array<std::uint8_t, 3>{ 128, 0, 0 })); // upper left
  EXPECT_EQ(at(0.9, 0.8), (std::array<std::uint8_t, 3>{ 0, 255, 0 }));
  EXPECT_EQ(at(0.2, 0.1), (std::array<std::uint8_t, 3>{ 0, 0, 51 }));
  EXPECT_EQ(at(0.8, 0.1), (std::array<std::uint8_t, 3>{ 128, 255, 51 }));
  model->colors.assign(model->rest->positions.size(), { 0, 255, 51, 255 });
  EXPECT_EQ(at(0.8, 0.1), (std::array<std::uint8_t, 3>{ 0, 255, 10 }));
  model->colors.clear();
  model->colorMap = image;
  model->colorMapAt.assign(model->rest->positions.size(), { 0.2, 0.1 }); // blue
  EXPECT_EQ(at(0.8, 0.1), (std::array<std::uint8_t, 3>{ 0, 0, 51 }));
}
