// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkComputeLayer.h"
#include "dgtkError.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

// Laws that hold for every registered representation.

using namespace dgtk::test;

namespace
{
std::shared_ptr<dgtk::SceneState> someScene()
{
  auto withoutUv = makeBox();
  withoutUv->uvs.clear();
  return SceneBuilder()
    .add(makeSphere({ { 0, 0, 0 }, 1.1, 12, 20 }))
    .add(makeQuad({ { -40, -1, -40 }, { 80, 0, 0 }, { 0, 0, 80 }, 8, 8 }))
    .add(withoutUv, placement({ 1, 0.3, -1 }, 0.8, { 1, 1, 0 }, 0.7))
    .add(makeSoup({ 60, 1.5, 0.4, 9 }), placement({ -1, 1, 0 }, -1))
    .state();
}

std::vector<dgtk::View> someViews()
{
  ViewOptions options;
  options.eye = { 2, 1, 5 };
  std::vector<dgtk::View> views(4, makeView(options));
  views[1].model = dgtk::makeOrthographic(64, 48, 5, 0);
  views[2].model = hideLinear(views[0].model);
  views[3].model = hideLinear(views[1].model);
  return views;
}

template <typename T>
void expectAll(const dgtk::Rows& rows, T invalid)
{
  for (int y = rows.y(); y < rows.y() + rows.height(); ++y)
  {
    for (int i = 0; i < rows.width() * rows.channels(); ++i)
    {
      const T value = rows.row<T>(y)[i];
      ASSERT_TRUE(value == invalid || (value != value && invalid != invalid));
    }
  }
}

void expectAllInvalid(const dgtk::Rows& rows, const std::string& invalid)
{
  const double value = invalid == "nan"    ? std::nan("")
                       : invalid == "+inf" ? std::numeric_limits<double>::infinity()
                                           : std::stod(invalid);
  switch (rows.type())
  {
    case dgtk::PixelType::Float64:
      return expectAll<double>(rows, value);
    case dgtk::PixelType::Float32:
      return expectAll<float>(rows, static_cast<float>(value));
    case dgtk::PixelType::UInt32:
      return expectAll<std::uint32_t>(rows, static_cast<std::uint32_t>(value));
    default:
      FAIL() << "no rule for this type";
  }
}
} // namespace

TEST(Registry, NamesAreUniqueAndComplete)
{
  std::set<std::string> layers;
  for (const dgtk::RepresentationInfo& info : dgtk::representations())
  {
    SCOPED_TRACE(info.layer);
    EXPECT_TRUE(layers.insert(info.layer).second);
    const auto representation = dgtk::makeRepresentation(info.layer);
    const dgtk::LayerSpec spec = representation->spec();
    EXPECT_EQ(spec.name, info.layer);
    EXPECT_FALSE(info.description.empty());
    EXPECT_FALSE(spec.description.empty());
    EXPECT_FALSE(spec.unit.empty());
    EXPECT_FALSE(spec.invalid.empty());
    EXPECT_GE(spec.channels, 1);
    const std::vector<std::string> formats = representation->formats();
    EXPECT_FALSE(formats.empty());
    EXPECT_EQ(std::set<std::string>(formats.begin(), formats.end()).size(), formats.size());
  }
  EXPECT_EQ(layers, (std::set<std::string>{ "depth", "distance", "inversedepth", "objects", "classes", "parts",
                      "triangles", "normal", "shadingnormal", "position", "objectcoords", "uv", "barycentrics" }));
}

TEST(Registry, RefusesUnknownLayers)
{
  EXPECT_EQ(thrownBy<dgtk::UsageError>([&] { dgtk::makeRepresentation("depht"); }),
    "no such layer (expected one of depth, distance, inversedepth, objects, classes, parts, triangles, normal, "
    "shadingnormal, position, objectcoords, uv, barycentrics, found 'depht')");
}

TEST(EveryRepresentation, StripsOfAnyHeightGiveTheSameBytes)
{
  const auto state = someScene();
  for (const dgtk::View& view : someViews())
  {
    const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
    for (const dgtk::RepresentationInfo& info : dgtk::representations())
    {
      SCOPED_TRACE(info.layer + ' ' + view.model->name());
      const dgtk::Rows whole = computeLayer(info.layer, *state, view, buffer);
      for (const int height : { 1, 7, 47 })
      {
        for (int y = 0; y < 48; y += height)
        {
          const dgtk::Rows strip = computeLayer(info.layer, *state, view, buffer, y, std::min(height, 48 - y));
          ASSERT_EQ(std::memcmp(strip.data(), whole.data() + y * whole.rowBytes(), strip.bytes()), 0);
        }
      }
    }
  }
}

/// Formats refuse by it before anything is written.
TEST(EveryRepresentation, NoIdIsLargerThanTheLargest)
{
  auto parts = makeBox();
  parts->parts = { parts->parts[0], parts->parts[0], parts->parts[0] };
  parts->parts[0].triangles = 2;
  parts->parts[1].firstTriangle = 2;
  parts->parts[1].triangles = 7;
  parts->parts[2].firstTriangle = 9;
  parts->parts[2].triangles = 3;
  const auto nothing = SceneBuilder().state();
  const auto one = SceneBuilder().add(makeSoup({ 1, 0.1, 0.1, 1 })).state();
  const auto boxes = SceneBuilder().add(parts).add(makeSoup({ 3, 0.1, 0.1, 1 })).state();
  const auto numbered = SceneBuilder().add(parts).add(makeBox()).add(makeBox()).state();
  numbered->instances[0].className = "a";
  numbered->instances[1].className = "b";
  numbered->instances[1].classId = 900;
  numbered->instances[2].className = "c";
  // The last is a copy that goes on where its object's model, elsewhere in the file, ended.
  const auto copies = SceneBuilder().add(parts).add(makeBox()).add(parts).state();
  copies->copies = 1;
  copies->instances[2].copyOf = 1;
  copies->instances[2].firstPart = 2;
  copies->instances[2].firstInPart = 30;
  for (const auto& state : { someScene(), nothing, one, boxes, numbered, copies })
  {
    std::vector<dgtk::Hit> all;
    for (std::size_t i = 0; i < state->instances.size(); ++i)
    {
      for (std::size_t k = 0; k < state->instances[i].model->triangles.size(); ++k)
      {
        all.push_back({ std::uint32_t(i + 1), std::uint32_t(k) });
      }
    }
    // Each triangle at several pixels: the rays of some run away from its plane.
    dgtk::VisibilityBuffer buffer;
    buffer.resize({ 0, 0, 64, 48 });
    for (std::size_t i = 0; i < buffer.hits.size() && !all.empty(); ++i)
    {
      buffer.hits[i] = all[i % all.size()];
    }
    for (const char* layer : { "objects", "classes", "parts", "triangles" })
    {
      const dgtk::Rows rows = computeLayer(layer, *state, makeView(), buffer);
      std::uint32_t largest = 0;
      for (std::size_t i = 0; i < buffer.hits.size(); ++i)
      {
        const std::uint32_t id = rows.row<std::uint32_t>(0)[i];
        largest = id == 0xffffffff ? largest : std::max(largest, id);
      }
      EXPECT_EQ(dgtk::makeRepresentation(layer)->largest(*state), largest) << layer << ' ' << all.size();
    }
  }
}

TEST(EveryRepresentation, BackgroundIsTheDeclaredInvalidValue)
{
  const auto state = someScene();
  const dgtk::View view = makeView();
  dgtk::VisibilityBuffer buffer;
  buffer.resize({ 0, 0, 64, 48 });
  for (const dgtk::RepresentationInfo& info : dgtk::representations())
  {
    SCOPED_TRACE(info.layer);
    expectAllInvalid(
      computeLayer(info.layer, *state, view, buffer), dgtk::makeRepresentation(info.layer)->spec().invalid);
  }
}

TEST(EveryRepresentation, ATriangleWithoutAreaIsBackground)
{
  auto model = makeSoup({ 1, 0.1, 0.1, 1 });
  auto geometry = std::make_shared<dgtk::Geometry>(*model->rest);
  geometry->positions = { { -1, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 } };
  model->rest = geometry;
  const auto state = SceneBuilder().add(model).state();
  dgtk::VisibilityBuffer buffer;
  buffer.resize({ 0, 0, 64, 48 });
  buffer.hits.assign(buffer.hits.size(), { 1, 0 });
  for (const dgtk::RepresentationInfo& info : dgtk::representations())
  {
    SCOPED_TRACE(info.layer);
    expectAllInvalid(
      computeLayer(info.layer, *state, makeView(), buffer), dgtk::makeRepresentation(info.layer)->spec().invalid);
  }
}

TEST(EveryRepresentation, ALensGivesWhatItsPinholeGives)
{
  const auto state = someScene();
  const std::vector<dgtk::View> views = someViews();
  for (const int i : { 0, 1 })
  {
    const dgtk::VisibilityBuffer buffer = bruteForce(*state, views[i]);
    for (const dgtk::RepresentationInfo& info : dgtk::representations())
    {
      SCOPED_TRACE(info.layer);
      const dgtk::Rows linear = computeLayer(info.layer, *state, views[i], buffer);
      const dgtk::Rows lens = computeLayer(info.layer, *state, views[i + 2], buffer);
      if (linear.type() != dgtk::PixelType::Float64)
      {
        ASSERT_EQ(std::memcmp(linear.data(), lens.data(), linear.bytes()), 0);
        continue;
      }
      for (std::size_t k = 0; k < linear.bytes() / sizeof(double); ++k)
      {
        const double a = linear.row<double>(0)[k];
        const double b = lens.row<double>(0)[k];
        ASSERT_TRUE(a == b || std::abs(a - b) <= 1e-11 * (1 + std::abs(a)) || (a != a && b != b));
      }
    }
  }
}

// Also of mirrored things, from both sides, and where normals are missing.
TEST(ShadingNormals, AreTurnedToTheViewer)
{
  for (const double scale : { 2.0, -2.0 })
  {
    for (const double side : { 5.0, -5.0 })
    {
      for (const Eigen::Vector3f& own : { Eigen::Vector3f(0.6F, 0, 0.8F), Eigen::Vector3f(0, 0, 0) })
      {
        const auto quad = makeQuad();
        auto geometry = std::make_shared<dgtk::Geometry>(*quad->rest);
        geometry->normals.assign(4, own);
        quad->rest = geometry;
        const auto state = SceneBuilder().add(quad, placement({ 0, 0, 0 }, scale)).state();
        ViewOptions options;
        options.eye = { 0, 0, side };
        const dgtk::View view = makeView(options);
        const dgtk::Rows rows = computeLayer("shadingnormal", *state, view, bruteForce(*state, view));
        const double* const found = rows.row<double>(24) + std::size_t(3) * 32;
        // In the camera's axes x is to the right, the world's x for a viewer at +z.
        const bool flat = own.isZero(0);
        const Eigen::Vector3d expected(flat ? 0 : 0.6, 0, flat ? -1 : -0.8);
        EXPECT_LE((Eigen::Map<const Eigen::Vector3d>(found) - expected).norm(), 1e-7) << scale << ' ' << side;
      }
    }
  }
}
