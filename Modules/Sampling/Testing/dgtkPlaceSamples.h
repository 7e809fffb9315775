// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPlaceSamples_h
#define dgtkPlaceSamples_h

#include "dgtkError.h"
#include "dgtkModel.h"
#include "dgtkPlacement.h"
#include "dgtkTestSupport.h"

#include <Eigen/Geometry>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// A random scene in the making: objects, and rules as their JSON texts.
struct PlaceScene
{
  SceneDescription scene;
  std::vector<SampleRule> rules;

  ObjectDescription& add(const std::string& name, const std::string& model, const std::string& rule = {})
  {
    ObjectDescription object;
    object.name = name;
    object.model = model.find('/') == std::string::npos ? test::sourceFile("Data/Models/" + model) : model;
    this->scene.objects.push_back(object);
    if (!rule.empty())
    {
      this->rules.push_back(
        { this->scene.objects.size() - 1, "objects/" + name + "/place", parseJson("test.json", rule) });
    }
    return this->scene.objects.back();
  }
  std::vector<PlaceOutcome> place(std::uint64_t sample = 0)
  {
    return placeObjects(this->scene, this->rules, SampleDraws(5, sample), this->models());
  }
  static SampleModels& models()
  {
    static SampleModels all;
    return all;
  }
};

inline double measured(const PlaceOutcome& placed, const std::string& name)
{
  for (const auto& one : placed.note.measured)
  {
    if (one.first == name)
    {
      return one.second;
    }
  }
  return -1;
}

/// Why it cannot be placed; "" when it can.
inline std::string failure(PlaceScene made)
{
  return test::thrownBy<Error>([&] { made.place(); });
}

/// A quaternion uniform over rotations, of three uniforms (Shoemake 1992).
inline Quaternion anyRotation(double u, double v, double w)
{
  constexpr double pi = 3.14159265358979323846;
  const double a = std::sqrt(1 - u);
  const double b = std::sqrt(u);
  return { b * std::cos(2 * pi * w), a * std::sin(2 * pi * v), a * std::cos(2 * pi * v), b * std::sin(2 * pi * w) };
}

/// Twenty things, turned anyhow: bottles, bowls, bricks, chairs, rings, a crate and `more` models by their paths, each
/// about 0.1 m in size.
inline PlaceScene twentyThings(
  const std::string& support, const std::string& rule, std::uint64_t sample, const std::vector<std::string>& more = {})
{
  PlaceScene made;
  made.add("support", support);
  std::vector<std::pair<std::string, double>> kinds = { { "bottle.ac", 0.5 }, { "bowl.ac", 0.8 }, { "brick.ac", 1 },
    { "chair.3ds", 0.11 }, { "torus.ac", 1 }, { "crate.ac", 0.08 }, { "vase.pov", 0.3 }, { "ball.ac", 0.1 } };
  for (const std::string& path : more)
  {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : PlaceScene::models().model(path)->rest->positions)
    {
      box.extend(p);
    }
    kinds.emplace_back(path, 0.1 / box.sizes().maxCoeff());
  }
  for (std::size_t i = 0; i < 20; ++i)
  {
    const std::string name = "thing#" + std::to_string(i + 1);
    const auto& kind = kinds[i % kinds.size()];
    ObjectDescription& object = made.add(name, kind.first, rule);
    object.scale = Eigen::Vector3d(Eigen::Vector3d::Constant(kind.second));
    const SampleDraws draws(11, sample);
    const auto uv = draws.uniforms(name, 0);
    object.orientation = anyRotation(uv[0], uv[1], draws.uniform(name, 1));
  }
  return made;
}

} // namespace dgtk

#endif
