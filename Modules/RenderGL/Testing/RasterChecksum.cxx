// SPDX-License-Identifier: BSD-3-Clause
// RasterChecksum BACKEND [unprepared]: draws a scene and prints the description of OpenGL and hashes of what it drew.
#include "dgtkTestScene.h"

#include "dgtkError.h"
#include "dgtkHash.h"

#include <cstdio>

using namespace dgtk;
using namespace dgtk::test;

namespace
{

std::shared_ptr<SceneState> scene()
{
  auto state = std::make_shared<SceneState>();
  state->background = { 0.1, 0.2, 0.3 };
  auto image = std::make_shared<Image>();
  image->width = 64;
  image->height = 32;
  for (int i = 0; i < 64 * 32; ++i)
  {
    const int checker = ((i % 64) / 8 + i / 64 / 8) % 2;
    image->rgba.insert(
      image->rgba.end(), { std::uint8_t(i % 64 * 4), std::uint8_t(i / 64 * 8), 128, std::uint8_t(checker ? 255 : 40) });
  }
  ModelBuilder model;
  Material plain = matte({ 0.8, 0.7, 0.6 });
  plain.specular = { 0.4, 0.4, 0.4 };
  plain.shininess = 12;
  plain.texture = model.texture(image);
  model.part(plain);
  model.sphere(24);
  Material leaf = plain;
  leaf.texture = 0;
  leaf.cutOut = true;
  model.part(leaf);
  model.quad({ -2, -1, 1.2 }, { 2, -1, 1.2 }, { 2, 1, 1.2 }, { -2, 1, 1.2 });
  Material glass = flat({ 0, 0.5, 0.5 });
  glass.opacity = 0.4;
  model.part(glass);
  model.quad({ -1, -2, 1.5 }, { 1, -2, 1.5 }, { 1, 2, 1.5 }, { -1, 2, 1.5 });
  const auto made = model.finish();
  for (int i = 0; i < 5; ++i)
  {
    state->instances.push_back(instanceOf(made, { 2.5 * i - 5, 0.3 * i, -1.0 * i }));
  }
  for (int i = 0; i < 3; ++i)
  {
    LightState light;
    light.kind = i == 0 ? LightKind::Head : i == 1 ? LightKind::Point : LightKind::Spot;
    light.position = { 3.0 * i, 4, 3 };
    light.diffuse = { 0.5, 0.4, 0.3 };
    state->lights.push_back(light);
  }
  return state;
}

} // namespace

int main(int argc, char** argv)
{
  try
  {
    const GLBackend backend = glBackendFromName(argc > 1 ? argv[1] : "auto");
    if (argc < 3)
    {
      prepareProcess(backend, argv, 2);
    }
    const auto engine = makeRasterSource(backend);
    std::printf("%s\n", engine->choice().description.c_str());
    const View view = viewOf(makePinholeFromFov(160, 120, 50, 0), { 1, 2, 9 }, { 0, 0, 0 });
    engine->setScene(scene(), view);
    VisibilityBuffer hits;
    ColorBuffer colors;
    Sha256 hash;
    engine->renderColor(whole(view), 1, colors, nullptr); // nothing was drawn before: OpenGL's state is its first
    hash.update(colors.rgb.data(), colors.rgb.size() * sizeof(float));
    engine->render(whole(view), hits);
    hash.update(hits.hits.data(), hits.hits.size() * sizeof(Hit));
    for (const int samples : { 1, 3 })
    {
      engine->renderColor(whole(view), samples, colors, &hits);
      hash.update(hits.hits.data(), hits.hits.size() * sizeof(Hit));
      hash.update(colors.rgb.data(), colors.rgb.size() * sizeof(float));
    }
    savePicture("dgtk-checksum", colors);
    std::printf("%s\n", hash.hex().c_str());
    return 0;
  }
  catch (const Error& error)
  {
    std::printf("%s\n", error.what());
    return int(error.code());
  }
}
