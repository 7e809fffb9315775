// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTestScene.h"

#include "dgtkError.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

using namespace dgtk;
using namespace dgtk::test;

namespace
{

constexpr double floatTolerance = 2e-5; // sums of a few products in single precision

constexpr double texelTolerance = 0.3; // Mesa's anisotropic filter blurs a little where it magnifies

void expectColor(const Eigen::Vector3d& found, const Eigen::Vector3d& expected, double tolerance = floatTolerance)
{
  EXPECT_LT((found.cwiseMin(1) - expected).cwiseAbs().maxCoeff(), tolerance) // rays keep light above white
    << "found " << found.transpose() << ", expected " << expected.transpose();
}

/// A square of side 2 in the plane z = `z`, facing +z.
std::shared_ptr<const Model> square(const Material& material, double z = 0, double size = 1)
{
  ModelBuilder model;
  model.part(material);
  model.quad({ -size, -size, z }, { size, -size, z }, { size, size, z }, { -size, size, z });
  return model.finish();
}

/// Point seen in the middle of a pixel of frontView().
Eigen::Vector3d pointAt(const View& view, int x, int y)
{
  const double scale = 2.0 / view.model->height();
  return { (x + 0.5 - view.model->width() / 2.0) * scale, (view.model->height() / 2.0 - y - 0.5) * scale, 0 };
}

std::shared_ptr<Image> picture(int width, int height, const std::vector<std::array<int, 4>>& texels)
{
  auto image = std::make_shared<Image>();
  image->width = width;
  image->height = height;
  for (const auto& texel : texels)
  {
    for (const int value : texel)
    {
      image->rgba.push_back(std::uint8_t(value));
      image->hasAlpha = image->hasAlpha || (&value == &texel[3] && value < 255);
    }
  }
  return image;
}

/// Colours of both renderers.
class PictureColor : public ::testing::TestWithParam<const char*>
{
protected:
  PictureColor() { usePictures(GetParam()); }
  ~PictureColor() override { usePictures("vtk"); }
};

} // namespace

INSTANTIATE_TEST_SUITE_P(By, PictureColor, ::testing::Values("vtk", "ray"));

TEST_P(PictureColor, FlatColorAndBackground)
{
  auto state = stateOf({ square(flat({ 0.25, 0.5, 0.75 }), 0, 0.5) });
  state->background = { 0.1, 0.2, 0.3 };
  const ColorBuffer colors = renderColor(state, frontView());
  expectColor(colorAt(colors, 32, 24), { 0.25, 0.5, 0.75 });
  expectColor(colorAt(colors, 1, 1), { 0.1, 0.2, 0.3 });
}

TEST_P(PictureColor, ImagesTopLeftIsUpAndLeft)
{
  ModelBuilder model;
  model.part(flat({ 1, 0, 0 }));
  model.quad({ -1.3, 0.5, 0 }, { -0.8, 0.5, 0 }, { -0.8, 0.9, 0 }, { -1.3, 0.9, 0 });
  const ColorBuffer colors = renderColor(stateOf({ model.finish() }), frontView());
  expectColor(colorAt(colors, 5, 6), { 1, 0, 0 });
  expectColor(colorAt(colors, 58, 6), { 0, 0, 0 });
  expectColor(colorAt(colors, 5, 41), { 0, 0, 0 });
}

TEST_P(PictureColor, TextureStandsUpright)
{
  // Rows from the top: red, green / blue, white.
  ModelBuilder model;
  Material material = flat({ 1, 1, 1 });
  material.texture = model.texture(
    picture(2, 2, { { 255, 0, 0, 255 }, { 0, 255, 0, 255 }, { 0, 0, 255, 255 }, { 255, 255, 255, 255 } }));
  model.part(material);
  model.quad({ -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 });
  const ColorBuffer colors = renderColor(stateOf({ model.finish() }), frontView());
  expectColor(colorAt(colors, 20, 12), { 1, 0, 0 }, texelTolerance);
  expectColor(colorAt(colors, 44, 12), { 0, 1, 0 }, texelTolerance);
  expectColor(colorAt(colors, 20, 36), { 0, 0, 1 }, texelTolerance);
  expectColor(colorAt(colors, 44, 36), { 1, 1, 1 }, texelTolerance);
}

TEST_P(PictureColor, TextureTimesMaterialAndNoTextureWithoutCoordinates)
{
  for (const bool coordinates : { true, false })
  {
    ModelBuilder model;
    Material material = flat({ 0.5, 0.5, 1 });
    material.texture = model.texture(picture(1, 3, { { 255, 51, 0, 255 }, { 255, 51, 0, 255 }, { 255, 51, 0, 255 } }));
    model.part(material);
    model.quad({ -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 });
    const ColorBuffer colors = renderColor(stateOf({ model.finish(coordinates) }), frontView());
    expectColor(colorAt(colors, 32, 24), coordinates ? Eigen::Vector3d(0.5, 0.1, 0) : Eigen::Vector3d(0.5, 0.5, 1));
  }
}

TEST_P(PictureColor, SumOfTwelveLightsOfEveryKind)
{
  const View view = frontView();
  auto state = stateOf({ square(matte({ 0.5, 0.4, 0.3 }), 0, 2) });
  for (int i = 0; i < 12; ++i)
  {
    LightState light;
    light.kind =
      std::array{ LightKind::Head, LightKind::Point, LightKind::Directional, LightKind::Spot }[std::size_t(i % 4)];
    light.position = { std::cos(i) * 2, std::sin(i) * 2, 1.0 + i % 3 };
    light.target = { 0.2 * i - 1, 0, 0 };
    light.diffuse = { 0.02 * i, 0.1, 0.2 - 0.01 * i };
    light.attenuation = { 1, 0.1 * (i % 3), 0.05 };
    light.coneAngle = 40;
    light.exponent = 2;
    light.intensity = 0.5 + 0.1 * i;
    state->lights.push_back(light);
  }
  const ColorBuffer colors = renderColor(state, view);
  for (const int x : { 5, 20, 33, 50, 61 })
  {
    const int y = 7 + x / 2;
    const Eigen::Vector3d p = pointAt(view, x, y);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const LightState& light : state->lights)
    {
      Eigen::Vector3d towards(0, 0, 1);
      double strength = 1;
      const Eigen::Vector3d axis = (light.target - light.position).normalized();
      if (light.kind == LightKind::Directional)
      {
        towards = -axis;
      }
      else if (light.kind != LightKind::Head)
      {
        const double d = (light.position - p).norm();
        towards = (light.position - p) / d;
        strength = 1 / (light.attenuation.x() + light.attenuation.y() * d + light.attenuation.z() * d * d);
        const double inside = -towards.dot(axis);
        if (light.kind == LightKind::Spot)
        {
          strength *= inside >= std::cos(40 * M_PI / 180) ? inside * inside : 0;
        }
      }
      sum += light.diffuse * (light.intensity * strength * std::max(0.0, towards.z()));
    }
    expectColor(colorAt(colors, x, y), sum.cwiseProduct(Eigen::Vector3d(0.5, 0.4, 0.3)).cwiseMin(1.0));
  }
}

TEST_P(PictureColor, MoreLightsThanUniforms)
{
  auto state = stateOf({ square(matte({ 1, 1, 1 }), 0, 2) });
  for (int i = 0; i < 100; ++i)
  {
    LightState light;
    light.kind = i % 2 ? LightKind::Point : LightKind::Head;
    light.position = { 0, 0, 1e6 };
    light.diffuse = Eigen::Vector3d(0.005, 0.002, 0.001);
    state->lights.push_back(light);
  }
  expectColor(colorAt(renderColor(state, frontView()), 32, 24), { 0.5, 0.2, 0.1 });
}

TEST_P(PictureColor, AmbientSpecularAndEmission)
{
  Material material = matte({ 0.2, 0.2, 0.2 });
  material.ambient = { 0.1, 0.05, 0 };
  material.specular = { 0.3, 0.2, 0.1 };
  material.emission = { 0, 0.1, 0.2 };
  material.shininess = 8;
  auto state = stateOf({ square(material) });
  LightState light;
  light.kind = LightKind::Directional;
  light.position = { 1, 0, 2 };
  light.ambient = { 0.5, 0.5, 0.5 };
  state->lights.push_back(light);
  const double cosine = 2 / std::sqrt(5.0);
  const Eigen::Vector3d expected =
    material.ambient * 0.7 + material.emission + material.diffuse * cosine + material.specular * std::pow(cosine, 8);
  expectColor(colorAt(renderColor(state, frontView()), 32, 24), expected);
  const auto lost = std::make_shared<Model>(*square(material));
  lost->textures.resize(1); // a picture that was not found
  lost->materials[0].emissionMap = 0;
  auto dark = stateOf({ lost });
  dark->lights = state->lights;
  expectColor(colorAt(renderColor(dark, frontView()), 32, 24), expected - material.emission);
}

// Microfacets by GGX, Smith and Schlick in linear light, seen along the normal, by double precision.
TEST_P(PictureColor, MetalAndRoughness)
{
  const auto linear = [](double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); };
  const auto displayed = [](double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; };
  for (const auto& [metal, rough, angle] :
    { std::tuple(0.0, 1.0, 0.0), { 0.0, 0.5, 0.5 }, { 1.0, 0.5, 0.5 }, { 0.5, 0.75, 1.0 }, { 1.0, 0.6, 0.0 } })
  {
    Material material = matte({ 0.5, 0.25, 0.125 });
    material.emission = { 0, 0.1, 0.4 };
    material.physical = Material::Physical{ metal, rough, true };
    auto state = stateOf({ square(material) });
    LightState light;
    light.kind = LightKind::Directional;
    light.position = { std::sin(angle), 0, std::cos(angle) };
    light.ambient = { 0.25, 0.25, 0.25 };
    state->lights.push_back(light);
    const double nl = std::cos(angle);
    const double nh = std::cos(angle / 2);
    const double a2 = std::pow(rough, 4);
    const double d = nh * nh * (a2 - 1) + 1;
    const double masking = nl + std::sqrt(nl * nl * (1 - a2) + a2);
    Eigen::Vector3d expected;
    for (int c = 0; c < 3; ++c)
    {
      const double base = linear(material.diffuse[c]);
      const double f0 = 0.04 + (base - 0.04) * metal;
      const double albedo = base * (1 - metal);
      const double fresnel = f0 + (1 - f0) * std::pow(1 - nh, 5);
      const double lit = nl * (albedo * (1 - fresnel) + fresnel * a2 / (d * d) * 0.5 / masking);
      expected[c] = displayed(lit + linear(0.25 + 0.2) * (albedo + f0) + linear(material.emission[c]));
    }
    expectColor(colorAt(renderColor(state, frontView()), 32, 24), expected.cwiseMin(1));
  }
}

TEST_P(PictureColor, BothSidesAndMirroredInstancesAreLitAlike)
{
  auto state = stateOf({ square(matte({ 1, 1, 1 })) });
  LightState light;
  light.kind = LightKind::Directional;
  light.position = { 1, 2, 3 };
  light.diffuse = { 0.9, 0.9, 0.9 };
  state->lights.push_back(light);
  const double expected = 0.9 * 3 / std::sqrt(14.0);
  const std::array<Eigen::Vector3d, 5> scales{ Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(-1, 1, 1),
    Eigen::Vector3d(1, 1, -1), Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, -2, 3) };
  for (const Eigen::Vector3d& scale : scales)
  {
    auto mirrored = std::make_shared<SceneState>(*state);
    mirrored->instances[0].world_from_object.linear = scale.asDiagonal();
    expectColor(colorAt(renderColor(mirrored, frontView()), 32, 24), Eigen::Vector3d::Constant(expected));
  }
  // From behind, the light lies behind the surface as it is seen.
  const View behind = viewOf(makeOrthographic(64, 48, 2, 0), { 0, 0, -10 }, { 0, 0, 0 }, 0.1, 100);
  expectColor(colorAt(renderColor(state, behind), 32, 24), { 0, 0, 0 });
}

TEST_P(PictureColor, CutOutTexelsAreNotThere)
{
  // A 4 x 2 picture, repeated 3 times each way; alpha 127 is cut out, 128 is not.
  std::vector<std::array<int, 4>> texels;
  const int alpha[8] = { 255, 0, 128, 127, 0, 200, 60, 255 };
  for (const int a : alpha)
  {
    texels.push_back({ 200, a < 128 ? 0 : 200, 0, a });
  }
  ModelBuilder front;
  Material material = flat({ 1, 1, 1 });
  material.texture = front.texture(picture(4, 2, texels));
  material.cutOut = true;
  front.part(material);
  front.quad({ -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 }, 3);
  auto state = stateOf({ front.finish(), square(flat({ 0, 0, 1 }), -1, 3) });
  const View view = frontView(256, 192);
  VisibilityBuffer hits;
  const ColorBuffer colors = renderColor(state, view, 1, &hits);
  savePicture("dgtk-cutout", colors);
  EXPECT_EQ(hits.hits, render(state, view).hits);
  for (int y = 0; y < 192; ++y)
  {
    for (int x = 0; x < 256; ++x)
    {
      const Eigen::Vector3d p = pointAt(view, x, y);
      const double u = (p.x() + 1) / 2 * 3;
      const double v = (p.y() + 1) / 2 * 3;
      const int column = int(std::floor(u * 4)) & 3;
      const int rowFromBottom = int(std::floor(v * 2)) & 1;
      const bool there = std::abs(p.x()) < 1 && alpha[(1 - rowFromBottom) * 4 + column] >= 128;
      ASSERT_EQ(hits.at(x, y).object, there ? 1u : 2u) << x << ' ' << y;
      if (there) // no fringe from the colour of what is cut out
      {
        EXPECT_GT(colorAt(colors, x, y).y(), 0.77);
      }
    }
  }
}

// By the definitions of OpenGL's wrap modes: texel -1 is the last, the first, or the first again, going back from
// there.
TEST_P(PictureColor, PicturesGoOnAsTheirTexturesSay)
{
  const auto wrapped = [](int texel, int size, TextureWrap wrap)
  {
    const int around = ((texel % size) + size) % size;
    const bool odd = (((texel - around) / size) & 1) != 0;
    return wrap == TextureWrap::Clamp           ? std::clamp(texel, 0, size - 1)
           : wrap == TextureWrap::Mirror && odd ? size - 1 - around
                                                : around;
  };
  const auto values = std::vector<std::array<int, 4>>{ { 255, 0, 51, 255 }, { 0, 102, 204, 0 }, { 51, 255, 0, 255 },
    { 0, 0, 255, 0 }, { 204, 153, 0, 255 }, { 102, 0, 0, 255 }, { 0, 51, 102, 255 }, { 255, 255, 255, 0 } };
  const auto flatter = [&values](std::size_t turn)
  {
    std::vector<std::array<int, 4>> all = values;
    std::rotate(all.begin(), all.begin() + std::ptrdiff_t(turn), all.end());
    std::for_each(all.begin(), all.end(), [](auto& texel) { texel[3] = 255; });
    return all;
  };
  /// Of a picture of 4 x 2 texels, interpolated.
  const auto seen =
    [&](const std::vector<std::array<int, 4>>& texels, const TextureWraps& wrap, const Eigen::Vector2d& uv)
  {
    const double x = uv.x() * 4 - 0.5;
    const double y = uv.y() * 2 - 0.5;
    const Eigen::Vector2i first(int(std::floor(x)), int(std::floor(y)));
    Eigen::Vector3d sum(0, 0, 0);
    for (const int i : { 0, 1 })
    {
      for (const int j : { 0, 1 })
      {
        const int column = wrapped(first.x() + i, 4, wrap[0]);
        const int row = 1 - wrapped(first.y() + j, 2, wrap[1]);
        const std::array<int, 4>& texel = texels[std::size_t(row * 4 + column)];
        sum += (i == 1 ? x - first.x() : 1 - x + first.x()) * (j == 1 ? y - first.y() : 1 - y + first.y()) / 255 *
               Eigen::Vector3d(texel[0], texel[1], texel[2]);
      }
    }
    return sum;
  };
  constexpr TextureWrap repeat = TextureWrap::Repeat;
  constexpr TextureWrap clamp = TextureWrap::Clamp;
  constexpr TextureWrap mirror = TextureWrap::Mirror;
  const View view = frontView(256, 192);
  for (const auto& [base, glow] : { std::pair{ TextureWraps{ clamp, clamp }, TextureWraps{ mirror, repeat } },
         std::pair{ TextureWraps{ mirror, mirror }, TextureWraps{ clamp, clamp } },
         std::pair{ TextureWraps{ repeat, clamp }, TextureWraps{ repeat, repeat } },
         std::pair{ TextureWraps{ clamp, mirror }, TextureWraps{ mirror, clamp } },
         std::pair{ TextureWraps{ repeat, repeat }, TextureWraps{ repeat, mirror } } })
  {
    for (const bool holes : { false, true })
    {
      ModelBuilder front;
      Material material = flat(Eigen::Vector3d::Constant(0.25));
      material.ambient = Eigen::Vector3d::Constant(2.5); // of a fifth
      material.texture = front.texture(picture(4, 2, holes ? values : flatter(0)), base);
      material.emissionMap = front.texture(picture(4, 2, flatter(3)), glow);
      material.cutOut = holes;
      front.part(material);
      front.quad({ -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 }, 5);
      auto model = std::make_shared<Model>(*front.finish());
      std::for_each(model->uvs.begin(), model->uvs.end(), [](Eigen::Vector2d& uv) { uv.array() -= 2; });
      VisibilityBuffer hits;
      const ColorBuffer colors = renderColor(stateOf({ model, square(flat({ 0, 0, 1 }), -1, 3) }), view, 1, &hits);
      for (int y = 0; y < 192; ++y)
      {
        for (int x = 0; x < 256; ++x)
        {
          const Eigen::Vector3d p = pointAt(view, x, y);
          const Eigen::Vector2d uv = 2.5 * p.head<2>() + Eigen::Vector2d(0.5, 0.5);
          const int column = wrapped(int(std::floor(uv.x() * 4)), 4, base[0]);
          const int row = 1 - wrapped(int(std::floor(uv.y() * 2)), 2, base[1]);
          const bool there = std::abs(p.x()) < 1 && (!holes || values[std::size_t(row * 4 + column)][3] > 0);
          ASSERT_EQ(hits.at(x, y).object, there ? 1u : 2u) << x << ' ' << y;
          if (there && !holes)
          {
            expectColor(
              colorAt(colors, x, y), 0.5 * seen(flatter(0), base, uv) + 0.25 * seen(flatter(3), glow, uv), 0.004);
          }
        }
      }
    }
  }
}

TEST_P(PictureColor, TranslucentSurfacesBlendInOrder)
{
  Material red = flat({ 1, 0, 0 });
  red.opacity = 0.25;
  Material green = flat({ 0, 1, 0 });
  green.opacity = 0.5;
  // The nearer one is listed last; opaque blue lies behind, white covers all on the right side.
  ModelBuilder cover;
  cover.part(flat({ 1, 1, 1 }));
  cover.quad({ 0.5, -1, 3 }, { 1, -1, 3 }, { 1, 1, 3 }, { 0.5, 1, 3 });
  auto state = stateOf({ square(flat({ 0, 0, 1 }), -1), square(green, 0), square(red, 1), cover.finish() });
  VisibilityBuffer hits;
  const ColorBuffer colors = renderColor(state, frontView(), 1, &hits);
  expectColor(colorAt(colors, 30, 24), { 0.25, 0.75 * 0.5, 0.75 * 0.5 });
  expectColor(colorAt(colors, 50, 24), { 1, 1, 1 });
  expectColor(colorAt(colors, 2, 24), { 0, 0, 0 });
  EXPECT_EQ(hits.at(30, 24).object, 3u); // glass is a surface for labels
  EXPECT_EQ(hits.at(50, 24).object, 4u);
}

TEST_P(PictureColor, CoincidentTranslucentSurfacesAllCount)
{
  Material half = flat({ 1, 1, 1 });
  half.opacity = 0.5;
  const auto model = square(half);
  auto state = stateOf({ model, model, model });
  expectColor(colorAt(renderColor(state, frontView()), 30, 24), Eigen::Vector3d::Constant(0.875));
}

TEST_P(PictureColor, PeeledLayersAreAllSurfacesInOrder)
{
  Material glass = flat({ 0, 1, 0 });
  glass.opacity = 0.5;
  auto state = stateOf({ square(flat({ 0, 0, 1 }), -1), square(glass, 0), square(flat({ 1, 0, 0 }), 0, 0.5) });
  const View view = frontView();
  pictures().setScene(state, view);
  SurfaceLists lists;
  pictures().peel(whole(view), lists)();
  ASSERT_EQ(lists.first.size(), std::size_t(64 * 48 + 1));
  const std::uint32_t* const middle = &lists.first[30 + 24 * 64];
  const std::uint32_t* const side = &lists.first[12 + 24 * 64];
  ASSERT_EQ(middle[1] - middle[0], 3u);
  EXPECT_EQ(lists.hits[middle[0]].object, 2u);
  EXPECT_EQ(lists.hits[middle[0] + 1].object, 3u); // coincident with the first
  EXPECT_EQ(lists.hits[middle[0] + 2].object, 1u);
  ASSERT_EQ(side[1] - side[0], 2u);
  EXPECT_EQ(lists.hits[side[0]].object, 2u);
  EXPECT_EQ(lists.hits[side[0] + 1].object, 1u);
  EXPECT_FLOAT_EQ(lists.rgba[std::size_t(middle[0]) * 4 + 3], 0.5f);
  EXPECT_FLOAT_EQ(lists.rgba[std::size_t(middle[0] + 1) * 4], 1.0f);
  EXPECT_FLOAT_EQ(lists.rgba[std::size_t(side[0] + 1) * 4 + 2], 1.0f);
  const VisibilityBuffer hits = render(state, view);
  for (std::size_t i = 0; i < hits.hits.size(); ++i)
  {
    const bool any = lists.first[i] < lists.first[i + 1];
    ASSERT_EQ(any ? lists.hits[lists.first[i]] : Hit{}, hits.hits[i]) << i;
  }
}

TEST_P(PictureColor, SamplesAverageAnEdge)
{
  // An upright edge 0.3 pixels right of a pixel's left side; 10 x 10 samples, of whose columns 3 are covered.
  const View view = frontView();
  ModelBuilder model;
  model.part(flat({ 1, 1, 1 }));
  const double edge = (20.3 - 32) * 2.0 / 48;
  model.quad({ -3, -3, 0 }, { edge, -3, 0 }, { edge, 3, 0 }, { -3, 3, 0 });
  VisibilityBuffer hits;
  const ColorBuffer colors = renderColor(stateOf({ model.finish() }), view, 10, &hits);
  expectColor(colorAt(colors, 19, 11), { 1, 1, 1 });
  expectColor(colorAt(colors, 20, 11), { 0.3, 0.3, 0.3 });
  expectColor(colorAt(colors, 21, 11), { 0, 0, 0 });
  EXPECT_EQ(hits.at(19, 11).object, 1u);
  EXPECT_EQ(hits.at(20, 11).object, 0u); // the pixel's centre
  EXPECT_THROW(renderColor(stateOf({}), view, 0), UsageError);
}

TEST_P(PictureColor, ManySamplesAreDrawnInPieces)
{
  const View view = frontView(300, 200);
  auto state = stateOf({ square(flat({ 0.5, 0.5, 0.5 }), 0, 0.5) });
  const ColorBuffer colors = renderColor(state, view, 16); // 4800 x 3200 samples
  double sum = 0;
  for (const float value : colors.rgb)
  {
    sum += value;
  }
  EXPECT_NEAR(sum / 3, 0.5 * 100 * 100, 1);
  expectColor(colorAt(colors, 150, 100), { 0.5, 0.5, 0.5 });
}

TEST_P(PictureColor, AnEmptySceneIsBackground)
{
  auto state = std::make_shared<SceneState>();
  state->background = { 0.25, 0.5, 1 };
  VisibilityBuffer hits;
  const ColorBuffer colors = renderColor(state, frontView(), 1, &hits);
  expectColor(colorAt(colors, 3, 3), { 0.25, 0.5, 1 });
  EXPECT_EQ(hits.at(3, 3).object, 0u);
}
