// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRayTestScenes_h
#define dgtkRayTestScenes_h

#include "dgtkSyntheticScene.h"

#include <string>
#include <vector>

namespace dgtk::test
{

/// A scene and a view of it that the ray engine and the one that tries every triangle must see alike.
struct RayCase
{
  std::string name;
  std::shared_ptr<const SceneState> state;
  View view;
  /// A view with the same rays and a linear() projection, for edge distances.
  View linearView;
};

inline Affine3 scaled(const Eigen::Vector3d& scale, const Eigen::Vector3d& translation)
{
  return { Eigen::Matrix3d(scale.asDiagonal()), translation };
}

inline std::shared_ptr<SceneState> mixedScene(const Eigen::Vector3d& offset = { 0, 0, 0 })
{
  SceneBuilder scene;
  const auto sphere = makeSphere({ { 0, 0, 0 }, 1, 12, 20 });
  const auto box = makeBox();
  scene.add(sphere, placement(offset));
  scene.add(sphere, placement(offset + Eigen::Vector3d(1.5, 0.5, -1), 0.7, { 1, 2, 3 }, 0.8));
  scene.add(box, placement(offset + Eigen::Vector3d(-1.6, 0, 0.3), 0.5, { 0, 1, 1 }, 1.1));
  scene.add(box, scaled({ -0.5, 0.8, 0.3 }, offset + Eigen::Vector3d(0.2, 1.4, 0.4))); // mirrored
  QuadOptions floor;
  floor.corner = { -6, -1, 6 };
  floor.sideU = { 12, 0, 0 };
  floor.sideV = { 0, 0, -12 };
  floor.cellsU = floor.cellsV = 5;
  scene.add(makeQuad(floor), placement(offset));
  return scene.state();
}

inline std::shared_ptr<SceneState> cutOutScene()
{
  const auto leaf = makeQuad();
  addCutOut(*leaf, 16, 7);
  const auto ball = makeSphere({ { 0, 0, 0 }, 1, 12, 20 });
  addCutOut(*ball, 8, 8);
  SceneBuilder scene;
  scene.add(leaf, placement({ -0.5, 0, 1 }, 1, { 0, 1, 0 }, 0.4));
  scene.add(leaf, placement({ 0.6, 0.2, 1.2 }, 0.8, { 1, 0, 0 }, -0.7));
  scene.add(ball, placement({ 0, 0, -1 }, 1.5));
  scene.add(makeBox(), placement({ 0, 0, -5 }, 1.8));
  return scene.state();
}

inline View withModel(View view, std::shared_ptr<const CameraModel> model)
{
  view.model = std::move(model);
  return view;
}

inline std::vector<RayCase> rayCases()
{
  std::vector<RayCase> cases;
  const auto add = [&](const std::string& name, std::shared_ptr<const SceneState> state, const View& view) {
    cases.push_back({ name, std::move(state), view, view });
  };
  const View view = makeView({ 64, 48, 50, { 0.4, 0.8, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 1000 });
  add("mixed", mixedScene(), view);

  const Eigen::Vector3d far(1e6, -2e6, 3e6);
  ViewOptions options;
  options.eye = far + Eigen::Vector3d(0.4, 0.8, 5);
  options.lookAt = far;
  add("far from the origin", mixedScene(far), makeView(options));

  add("orthographic", mixedScene(), withModel(view, makeOrthographic(61, 47, 4.2, 0)));

  Eigen::Matrix3d K;
  K << 70.5, 1.25, 21.75, 0, 55.25, 30.5, 0, 0, 1;
  add("off-centre K", mixedScene(), withModel(view, makePinhole(63, 50, K)));

  RayCase lens{ "lens", mixedScene(), view, view };
  lens.view.model = hideLinear(view.model);
  cases.push_back(lens);

  View clipped = view;
  clipped.near = 4.6;
  clipped.far = 5.9;
  add("near and far", mixedScene(), clipped);

  View tele = withModel(view, makePinholeFromFov(64, 48, 0.05, 0));
  add("telephoto", mixedScene(), tele);

  SceneBuilder ground;
  QuadOptions plane;
  plane.corner = { -1000, 0, 1000 };
  plane.sideU = { 2000, 0, 0 };
  plane.sideV = { 0, 0, -2000 };
  ground.add(makeQuad(plane));
  ground.add(makeSphere({ { 0, 0, 0 }, 1, 12, 20 }), placement({ 0.5, 0.3, -3 }));
  add("ground under and behind", ground.state(),
    makeView({ 64, 48, 90, { 0.3, 1.1, 0.2 }, { 0.1, 0.4, -3 }, { 0, 1, 0 }, 0.1, 1000 }));

  // Single precision takes one for another: their coordinates are large, the camera is at their middle.
  SceneBuilder sheets;
  const Eigen::Vector3d across(2000, 11.7, 3.3);
  const Eigen::Vector3d along(5.1, -71.9, -2000);
  for (int i = 7; i >= 0; --i)
  {
    QuadOptions turned;
    turned.sideU = std::cos(0.1 * i) * across + std::sin(0.1 * i) * along;
    turned.sideV = std::cos(0.1 * i) * along - std::sin(0.1 * i) * across;
    turned.corner = Eigen::Vector3d(0, -1 - 2e-6 * i, 0) - (turned.sideU + turned.sideV) / 2;
    sheets.add(makeQuad(turned));
  }
  add("wide sheets close together", sheets.state(),
    makeView({ 64, 48, 60, { 0.1, 0.2, 0.3 }, { 0.3, -1, -0.5 }, { 0, 1, 0 }, 0.1, 1000 }));

  SceneBuilder soup;
  soup.add(makeSoup({ 1500, 1.5, 0.8, 3 }));
  soup.add(makeSoup({ 500, 1.5, 0.1, 4 }), placement({ 0.2, 0.1, 0.3 }, 0.9, { 1, 0, 1 }, 0.5));
  add("soup", soup.state(), view);

  // Rounding errors of single precision are a hundredth of a pixel here.
  SceneBuilder afar;
  afar.add(makeSoup({ 300, 1, 0.5, 6 }), placement({ 0, 0, 0 }, 1.5e-3));
  afar.add(makeSphere({ { 0, 0, 0 }, 1, 12, 20 }), placement({ 0, 0, 0 }, 0.9e-3));
  add("tiny from afar", afar.state(), makeView({ 64, 48, 0.03, { 1, 2, 4.5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 1000 }));

  SceneBuilder terrain;
  terrain.add(makeTerrain({ 24, 100, 4, 5 }));
  add("terrain", terrain.state(), makeView({ 64, 48, 60, { 0, 6, 30 }, { 0, 2, 0 }, { 0, 1, 0 }, 0.1, 1000 }));

  add("cut-outs", cutOutScene(), view);
  add("cut-outs, orthographic", cutOutScene(), withModel(view, makeOrthographic(61, 47, 4.2, 0)));

  SceneBuilder odd;
  const auto sphere = makeSphere({ { 0, 0, 0 }, 1, 12, 20 });
  odd.add(sphere, scaled({ 1, 1, 0 }, { 0, 0, 0 }));
  odd.add(sphere, scaled({ 1, 0.001, 1 }, { 0.5, 0.5, 0.5 }));
  odd.add(sphere, scaled({ 1e-3, 1e-3, 1e-3 }, { 0, 0, 4.9 }));
  odd.add(makeSphere({ { 1e5, 0, 0 }, 1e4, 12, 20 }), scaled({ 1e-4, -1e-4, 1e-4 }, { -11, 0, -1 }));
  add("flat, thin, tiny and shrunk", odd.state(), view);
  return cases;
}

} // namespace dgtk::test

#endif
