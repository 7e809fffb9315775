// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTestScene.h"

#include <gtest/gtest.h>

#include <cmath>

#include <dlfcn.h>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
std::shared_ptr<const Model> ball(const Eigen::Vector3d& diffuse)
{
  ModelBuilder model;
  model.part(matte(diffuse));
  model.sphere(24);
  return model.finish();
}

/// Colours of the last of states, drawn one after another without hits.
ColorBuffer drawnAlone(const std::vector<std::shared_ptr<SceneState>>& states, const View& view)
{
  const auto source = makeRasterSource();
  source->setHits(false);
  ColorBuffer colors;
  for (const auto& state : states)
  {
    source->setScene(state, view);
    source->renderColor(whole(view), 1, colors, nullptr);
  }
  return colors;
}
} // namespace

TEST(RasterSource, PicturesReadLaterAreTheSame)
{
  const auto model = ball({ 0.9, 0.4, 0.2 });
  const auto early = makeRasterSource();
  const auto late = makeRasterSource();
  const View view = frontView(96, 72);
  std::vector<std::shared_ptr<SceneState>> states;
  std::vector<ColorBuffer> colors(3);
  std::vector<UnreadColor> unread;
  for (std::size_t i = 0; i < 3; ++i)
  {
    states.push_back(std::make_shared<SceneState>());
    states[i]->instances.push_back(instanceOf(model, { 0.3 * double(i), 0, 0 }));
    states[i]->lights.emplace_back();
    states[i]->background = { 0.1, 0.2, 0.1 * double(i) };
    late->setScene(states[i], view);
    unread.push_back(late->startColor(whole(view), 1, colors[i]));
  }
  for (const UnreadColor& picture : unread)
  {
    picture.read();
    picture.rest();
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    ColorBuffer expected;
    early->setScene(states[i], view);
    early->renderColor(whole(view), 1, expected, nullptr);
    EXPECT_EQ(colors[i].rgb, expected.rgb) << i;
  }
}

TEST(RasterSource, ColoursAloneAreTheSameAsWithHits)
{
  const auto state = stateOf({ ball({ 0.2, 0.4, 0.9 }) });
  state->lights.emplace_back();
  const View view = frontView(96, 72);
  const auto both = makeRasterSource();
  both->setScene(state, view);
  ColorBuffer expected;
  VisibilityBuffer hits;
  both->renderColor(whole(view), 1, expected, &hits);
  EXPECT_EQ(drawnAlone({ state }, view).rgb, expected.rgb);
}

// Of two translucent surfaces at one place, the one that the model lists first is drawn first, by its number; numbers
// are made when they are needed.
TEST(RasterSource, SurfacesThatBecomeTranslucentAreSortedAsThoseThatAlwaysWere)
{
  ModelBuilder twice;
  twice.part(matte({ 1, 1, 1 }));
  twice.quad({ -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 });
  twice.quad({ -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 });
  const auto model = std::make_shared<Model>(*twice.finish());
  std::swap(model->triangles[0], model->triangles[2]); // the later vertices are those of the earlier triangles
  std::swap(model->triangles[1], model->triangles[3]);
  const auto tilted = std::make_shared<Geometry>(*model->rest);
  std::fill(tilted->normals.begin() + 4, tilted->normals.end(), Eigen::Vector3f(0.8f, 0, 0.6f));
  model->rest = tilted;
  const auto withOpacity = [&model](double opacity)
  {
    auto state = stateOf({ model });
    auto materials = std::make_shared<std::vector<Material>>(model->materials);
    (*materials)[0].opacity = opacity;
    state->instances[0].materials = materials;
    state->lights.emplace_back().kind = LightKind::Head;
    return state;
  };
  const auto opaque = withOpacity(1);
  const auto half = withOpacity(0.5);
  const View view = frontView();
  EXPECT_EQ(drawnAlone({ opaque, half }, view).rgb, drawnAlone({ half }, view).rgb);
}

// Textures that a larger part was drawn to serve smaller ones.
TEST(RasterSource, SmallPartsAfterLargeOnesAreThoseOfANewSource)
{
  ModelBuilder panes;
  panes.part(matte({ 0.2, 0.4, 0.9 })).opacity = 0.5;
  for (int i = 0; i < 3; ++i)
  {
    panes.quad({ -1.5 + 0.5 * i, -1, 1.5 }, { 0.2 * i, -1, 1.0 - i }, { 0.2 * i, 1, 1.0 - i }, { -1.5, 1, 1.5 });
  }
  const auto state = stateOf({ ball({ 0.9, 0.4, 0.2 }), panes.finish() });
  state->lights.emplace_back();
  state->background = { 0.1, 0.2, 0.3 };
  const View view = frontView(96, 72);
  struct Drawn
  {
    VisibilityBuffer ids;
    ColorBuffer colors;
    VisibilityBuffer hits;
    SurfaceLists lists;
  };
  const auto peeled = [](RasterSource& source, const PixelRect& rect)
  {
    SurfaceLists lists;
    source.peel(rect, lists)();
    return lists;
  };
  const auto draw = [&](RasterSource& source, const PixelRect& rect)
  {
    Drawn drawn;
    source.render(rect, drawn.ids);
    source.renderColor(rect, 1, drawn.colors, &drawn.hits);
    drawn.lists = peeled(source, rect);
    return drawn;
  };
  const auto kept = makeRasterSource();
  kept->setScene(state, view);
  const PixelRect part{ 20, 10, 50, 40 };
  for (const PixelRect& rect :
    { part, whole(view), part, PixelRect{ 30, 0, 66, 20 }, PixelRect{ 0, 5, 10, 67 }, whole(view) })
  {
    const auto fresh = makeRasterSource();
    fresh->setScene(state, view);
    const Drawn expected = draw(*fresh, rect);
    const Drawn drawn = draw(*kept, rect);
    EXPECT_EQ(drawn.ids.hits, expected.ids.hits);
    EXPECT_EQ(drawn.colors.rgb, expected.colors.rgb);
    EXPECT_EQ(drawn.hits.hits, expected.hits.hits);
    EXPECT_EQ(drawn.lists.first, expected.lists.first);
    EXPECT_EQ(drawn.lists.hits, expected.lists.hits);
    EXPECT_EQ(drawn.lists.rgba, expected.lists.rgba);
  }
  const SurfaceLists before = peeled(*kept, part);
  VisibilityBuffer between;
  kept->render({ 0, 5, 10, 20 }, between);
  const SurfaceLists after = peeled(*kept, part);
  EXPECT_EQ(after.first, before.first) << "OpenGL's state is what VTK takes it to be";
  EXPECT_EQ(after.hits, before.hits);
}

// More surfaces than OpenGL's list takes at once.
TEST(RasterSource, NoRowIsLostWhereSurfacesAreTakenInStrips)
{
  constexpr int squares = 33;
  constexpr int side = 256;
  ModelBuilder model;
  model.part(flat({ 1, 1, 1 }));
  for (int i = 0; i < squares; ++i)
  {
    const double z = -0.1 * i;
    model.quad({ -2, -2, z }, { 2, -2, z }, { 2, 2, z }, { -2, 2, z });
  }
  source().setScene(stateOf({ model.finish() }), frontView(side, side));
  SurfaceLists lists;
  source().peel({ 0, 0, side, side }, lists)();
  ASSERT_EQ(lists.first.size(), std::size_t(side * side + 1));
  int wrong = 0;
  for (std::size_t i = 0; i + 1 < lists.first.size(); ++i)
  {
    wrong += lists.first[i + 1] - lists.first[i] != squares;
  }
  EXPECT_EQ(wrong, 0);
}

// Along the axis of a parallel projection, not from its middle.
TEST(RasterSource, FogOfAParallelProjectionIsThatOfTheDepth)
{
  ModelBuilder model;
  model.part(flat({ 1, 1, 1 }));
  model.quad({ -20, -15, 0 }, { 20, -15, 0 }, { 20, 15, 0 }, { -20, 15, 0 });
  const auto state = stateOf({ model.finish() });
  state->fog = { { 0, 0, 0 }, 0.125, 2 };
  const View view = viewOf(makeOrthographic(64, 48, 30, 0), { 0, 0, 10 }, { 0, 0, 0 }, 0.1, 100);
  const ColorBuffer colors = renderColor(state, view);
  for (const auto& [x, y] : { std::pair(32, 24), { 2, 24 }, { 60, 45 } })
  {
    EXPECT_LT((colorAt(colors, x, y).array() - std::exp(-0.125 * 8)).abs().maxCoeff(), 2e-5) << x << ' ' << y;
  }
}

TEST(RasterSource, PicturesOfScenesThatAreGoneAreFreed)
{
  const auto isTexture = reinterpret_cast<unsigned char (*)(unsigned int)>(::dlsym(RTLD_DEFAULT, "glIsTexture"));
  ASSERT_NE(isTexture, nullptr);
  const auto textures = [isTexture]
  {
    int count = 0;
    for (unsigned int name = 1; name < 1000; ++name)
    {
      count += isTexture(name) != 0 ? 1 : 0;
    }
    return count;
  };
  const auto picture = []
  {
    auto image = std::make_shared<Image>();
    image->width = image->height = 2;
    image->rgba.assign(16, 200);
    return image;
  };
  const auto kept = makeRasterSource();
  std::vector<int> counts;
  for (int i = 0; i < 4; ++i)
  {
    ModelBuilder model;
    Material material = matte({ 1, 1, 1 });
    material.texture = model.texture(picture());
    material.emissionMap = model.texture(picture());
    model.part(material);
    model.quad({ -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 });
    material.cutOut = true;
    material.emissionMap = 0;
    model.part(material);
    model.quad({ -1, -1, 1 }, { 0, -1, 1 }, { 0, 0, 1 }, { -1, 0, 1 });
    kept->setScene(stateOf({ model.finish() }), frontView());
    ColorBuffer colors;
    kept->renderColor(whole(frontView()), 1, colors, nullptr);
    counts.push_back(textures());
  }
  EXPECT_EQ(counts[3], counts[1]);
  EXPECT_GT(counts[1], 3);
}

// Rows of 5 texels of three bytes are not aligned; VTK remembers how it takes them.
TEST(RasterSource, PicturesTakenAfterMapsAreTheirOwn)
{
  const auto picture = []
  {
    auto image = std::make_shared<Image>();
    image->width = image->height = 5;
    for (int i = 0; i < 25; ++i)
    {
      image->rgba.insert(image->rgba.end(), { 255, 51, 0, 255 });
    }
    return image;
  };
  const auto kept = makeRasterSource();
  for (const bool mapped : { false, true })
  {
    ModelBuilder model;
    Material material = flat({ 0.5, 0.5, 1 });
    material.texture = model.texture(picture());
    model.part(material);
    model.quad({ -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 });
    material.emissionMap = mapped ? model.texture(picture()) : -1;
    model.part(material);
    model.quad({ -3, -3, -1 }, { 3, -3, -1 }, { 3, 3, -1 }, { -3, 3, -1 });
    ColorBuffer colors;
    kept->setScene(stateOf({ model.finish() }), frontView());
    kept->renderColor(whole(frontView()), 1, colors, nullptr);
    EXPECT_LT((colorAt(colors, 32, 24) - Eigen::Vector3d(0.5, 0.1, 0)).norm(), 1e-3) << mapped;
  }
}
