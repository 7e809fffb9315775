// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneRules.h"

#include "dgtkCameraModel.h"
#include "dgtkError.h"
#include "dgtkSceneText.h"
#include "dgtkText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace dgtk::scenefile
{

namespace
{
/// Whether a smooth track reaches 0 between a key and the next one where both have the same sign, in a component.
bool overshootsZero(const Track<Eigen::Vector3d>& track, std::size_t key)
{
  const double from = track.keys[key].frame;
  const double length = track.keys[key + 1].frame - from;
  std::array<Eigen::Vector3d, 4> p; // of a cubic in u, at 0, 1/3, 2/3 and 1
  for (int i = 0; i < 4; ++i)
  {
    p[std::size_t(i)] = i < 3 ? track.at(from + length * i / 3) : track.keys[key + 1].value;
  }
  for (int i = 0; i < 3; ++i)
  {
    const double a = (-11 * p[0][i] + 18 * p[1][i] - 9 * p[2][i] + 2 * p[3][i]) / 2;
    const double b = (18 * p[0][i] - 45 * p[1][i] + 36 * p[2][i] - 9 * p[3][i]) / 2;
    const double c = (-9 * p[0][i] + 27 * p[1][i] - 27 * p[2][i] + 9 * p[3][i]) / 2;
    const double root = std::sqrt(std::max(b * b - 3 * a * c, 0.0));
    // The zeros of a + 2 b u + 3 c u^2, in the form that does not divide by what may be 0.
    const double sum = -(b + std::copysign(root, b));
    for (const double u : { sum / (3 * c), a / sum })
    {
      const double value = p[0][i] + (a + (b + c * u) * u) * u;
      if (u > 0 && u < 1 && p[0][i] * p[3][i] > 0 && value * p[0][i] <= 0)
      {
        return true;
      }
    }
  }
  return false;
}

using Kind = SceneItem::Kind;

class Relations
{
public:
  Relations(const SceneDescription& scene, const Locator& locate)
    : Scene(scene)
    , Locate(locate)
  {
    for (const ClassDescription& one : scene.classes)
    {
      this->Classes.try_emplace(one.name, &one);
    }
  }

  void checkAll() const
  {
    this->checkNames(Kind::Object, this->Scene.objects);
    this->checkNames(Kind::Light, this->Scene.lights);
    this->checkNames(Kind::Camera, this->Scene.cameras);
    this->checkParents();
    this->checkClasses();
    this->checkMetres();
    for (std::size_t i = 0; i < this->Scene.objects.size(); ++i)
    {
      this->checkScale(i);
      this->checkKeypoints(i);
    }
    for (std::size_t i = 0; i < this->Scene.lights.size(); ++i)
    {
      this->checkLight(i);
    }
    for (std::size_t i = 0; i < this->Scene.cameras.size(); ++i)
    {
      this->checkCamera(i);
    }
    this->checkOrder();
  }

private:
  [[noreturn]] void fail(Kind kind, std::size_t index, const std::string& property, const std::string& what,
    const std::string& expected = {}, const std::string& found = {}) const
  {
    const Place place = this->Locate(kind, index, property);
    throw InputError(this->Scene.title(), place.line, place.what + ' ' + what, expected, found);
  }

  template <typename Item>
  void checkNames(Kind kind, const std::vector<Item>& items) const
  {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < items.size(); ++i)
    {
      if (!seen.insert(items[i].name).second)
      {
        this->fail(kind, i, "name", "is taken", "a name that no other has", quoted(items[i].name));
      }
    }
  }

  void checkParents() const
  {
    const std::vector<ObjectDescription>& objects = this->Scene.objects;
    std::unordered_map<std::string, std::size_t> index;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < objects.size(); ++i)
    {
      index[objects[i].name] = i;
      names.push_back(objects[i].name);
    }
    // 0 not yet seen, 1 on the way up, 2 known to end at the world
    std::vector<char> state(objects.size(), 0);
    for (std::size_t i = 0; i < objects.size(); ++i)
    {
      std::vector<std::size_t> chain;
      std::size_t at = i;
      while (state[at] == 0)
      {
        state[at] = 1;
        chain.push_back(at);
        if (objects[at].parent.empty())
        {
          break;
        }
        const auto parent = index.find(objects[at].parent);
        if (parent == index.end())
        {
          const std::string near = nearest(objects[at].parent, names);
          this->fail(Kind::Object, at, "parent", "is no object of the scene",
            near.empty() ? "the name of an object" : "perhaps " + quoted(near), quoted(objects[at].parent));
        }
        at = parent->second;
        if (state[at] == 1)
        {
          this->fail(Kind::Object, chain.back(), "parent", "leads back to the object itself",
            "parents that end at the world", quoted(objects[chain.back()].parent));
        }
      }
      for (const std::size_t c : chain)
      {
        state[c] = 2;
      }
    }
    for (std::size_t i = 0; i < objects.size(); ++i)
    {
      std::set<std::string> seen;
      for (const MaterialOverride& material : objects[i].materials)
      {
        if (!seen.insert(material.material).second)
        {
          this->fail(Kind::Object, i, "materials", "names " + quoted(material.material) + " twice");
        }
      }
    }
  }

  /// With a table of classes, everything that has an id has a class of the table.
  void checkClasses() const
  {
    if (this->Scene.classes.empty())
    {
      return;
    }
    std::string names;
    for (std::size_t i = 0; i < this->Scene.classes.size(); ++i)
    {
      names += (i == 0 ? "" : ", ") + (i < 20 ? quoted(this->Scene.classes[i].name) : "...");
      i += i < 20 ? 0 : this->Scene.classes.size();
    }
    for (std::size_t i = 0; i < this->Scene.objects.size(); ++i)
    {
      const ObjectDescription& object = this->Scene.objects[i];
      if ((isEver(object.visible) || !object.className.empty()) && !this->isNumbered(object.className))
      {
        const std::string& file = this->Scene.classFile;
        this->fail(Kind::Object, i, "class", "has no number in " + (file.empty() ? "the given classes" : file),
          "one of " + names, quoted(object.className));
      }
    }
  }

  void checkMetres() const
  {
    constexpr double tolerance = 1e-6;
    const double said = this->Scene.metresPerUnit;
    const double named = metresOfUnit(this->Scene.units);
    if (said > 0 && named > 0 && std::abs(said / named - 1) > tolerance)
    {
      throw InputError(this->Scene.title(), "metresPerUnit contradicts units " + quoted(this->Scene.units),
        plainNumber(named) + ", or units of another name", plainNumber(said));
    }
  }

  /// Where a class says which keypoints there are, its objects have no others.
  void checkKeypoints(std::size_t i) const
  {
    const ObjectDescription& object = this->Scene.objects[i];
    if (object.keypoints.empty())
    {
      return;
    }
    const auto own = this->Classes.find(object.className);
    const std::vector<std::string> names =
      own == this->Classes.end() ? std::vector<std::string>() : own->second->keypoints;
    const std::unordered_set<std::string> known(names.begin(), names.end());
    std::unordered_set<std::string> seen;
    for (const KeypointDescription& point : object.keypoints)
    {
      if (!seen.insert(point.name).second)
      {
        this->fail(Kind::Object, i, "keypoints", "names " + quoted(point.name) + " twice");
      }
      if (!known.empty() && known.count(point.name) == 0)
      {
        const std::string near = nearest(point.name, names);
        this->fail(Kind::Object, i, "keypoints", "names what is none of class " + quoted(object.className),
          near.empty() ? "one of its keypoints" : "perhaps " + quoted(near), quoted(point.name));
      }
    }
  }

  /// Between keys of different sign a scale may be 0 at a frame; between keys of one sign it must keep it.
  void checkScale(std::size_t i) const
  {
    const Track<Eigen::Vector3d>& scale = this->Scene.objects[i].scale;
    for (std::size_t k = 1; k < scale.keys.size(); ++k)
    {
      const Key<Eigen::Vector3d>& from = scale.keys[k - 1];
      const Key<Eigen::Vector3d>& to = scale.keys[k];
      const bool crosses = (from.value.array() * to.value.array() < 0).any();
      const Interpolation how = scale.interpolationAfter(k - 1);
      const bool checked = (crosses && how == Interpolation::Linear) || how == Interpolation::Smooth;
      for (int frame = from.frame + 1; checked && frame < to.frame; ++frame)
      {
        if ((scale.at(frame).array() == 0).any())
        {
          this->fail(
            Kind::Object, i, "scale", "passes through 0 at frame " + std::to_string(frame), "another interpolation");
        }
      }
      if (how == Interpolation::Smooth && overshootsZero(scale, k - 1))
      {
        this->fail(Kind::Object, i, "scale",
          "passes through 0 between frames " + std::to_string(from.frame) + " and " + std::to_string(to.frame),
          "another interpolation");
      }
    }
  }

  void checkLight(std::size_t i) const
  {
    const LightDescription& light = this->Scene.lights[i];
    if (light.attenuation.isZero(0))
    {
      this->fail(Kind::Light, i, "attenuation", "is zero", "a constant, linear or quadratic part above 0");
    }
    if (traitsOf(light.kind).aimed)
    {
      for (const int frame : orAnyFrame(allFrames(keyFramesOf({ &light.position, &light.target }))))
      {
        if (light.position.at(frame) == light.target.at(frame))
        {
          this->fail(
            Kind::Light, i, "target", "is the light's own position at frame " + std::to_string(frame), "another point");
        }
      }
    }
  }

  static std::vector<int> keyFramesOf(std::initializer_list<const Track<Eigen::Vector3d>*> tracks)
  {
    std::set<int> frames;
    for (const Track<Eigen::Vector3d>* track : tracks)
    {
      for (const Key<Eigen::Vector3d>& key : track->keys)
      {
        frames.insert(key.frame);
      }
    }
    return { frames.begin(), frames.end() };
  }

  static std::vector<int> orAnyFrame(const std::vector<int>& frames)
  {
    return frames.empty() ? std::vector<int>{ 0 } : frames;
  }

  /// Every frame between key frames, but for very long motions, of which only the key frames are looked at.
  static std::vector<int> allFrames(const std::vector<int>& keys)
  {
    constexpr int most = 20000;
    if (keys.empty() || keys.back() - keys.front() > most)
    {
      return keys;
    }
    std::vector<int> frames(std::size_t(keys.back() - keys.front()) + 1);
    std::iota(frames.begin(), frames.end(), keys.front());
    return frames;
  }

  void checkCamera(std::size_t i) const
  {
    const CameraDescription& camera = this->Scene.cameras[i];
    if (!(camera.far > camera.near))
    {
      this->fail(
        Kind::Camera, i, "far", "is not beyond near", "more than " + plainNumber(camera.near), plainNumber(camera.far));
    }
    if ((camera.width == 0) != (camera.height == 0))
    {
      this->fail(Kind::Camera, i, camera.width == 0 ? "width" : "height", "is missing or 0",
        "both width and height, or neither");
    }
    if (camera.K && camera.width == 0)
    {
      this->fail(Kind::Camera, i, "K", "has no image size to which it belongs", "width and height");
    }
    if (camera.K && camera.aspect != 0)
    {
      this->fail(Kind::Camera, i, "aspect", "is said by K already", "one of them");
    }
    if (camera.shutter.close < camera.shutter.open)
    {
      this->fail(Kind::Camera, i, "shutter", "closes before it opens", "close not below open");
    }
    this->checkModel(i, camera);
    if (!camera.posed)
    {
      this->checkPose(i, camera);
    }
  }

  /// What its parameters give together at the first frame; files are not opened.
  void checkModel(std::size_t i, const CameraDescription& camera) const
  {
    const auto& values = camera.parameters;
    const bool hasFile =
      std::any_of(values.begin(), values.end(), [](const auto& value) { return !value.second.file.empty(); });
    std::optional<LinearProjection> linear;
    try
    {
      constexpr int anySize = 64;
      const int width = camera.width > 0 ? camera.width : anySize;
      const int height = camera.height > 0 ? camera.height : anySize;
      linear = hasFile ? linear : makeCamera(camera.model, cameraParameters(camera, 0, width, height))->linear();
    }
    catch (const UsageError& error)
    {
      this->fail(Kind::Camera, i, "model", std::string("cannot be: ") + error.what());
    }
    if (camera.lens.blurs() && !(linear && linear->perspective))
    {
      this->fail(Kind::Camera, i, "lens", "is not for this camera", "a linear perspective, as of model pinhole");
    }
  }

  void checkPose(std::size_t i, const CameraDescription& camera) const
  {
    const std::vector<int> keys = keyFramesOf({ &camera.eye, &camera.lookAt, &camera.up });
    for (const int frame : orAnyFrame(allFrames(keys)))
    {
      const Eigen::Vector3d eye = camera.eye.at(frame);
      const Eigen::Vector3d lookAt = camera.lookAt.at(frame);
      const std::string when = keys.empty() ? std::string() : " at frame " + std::to_string(frame);
      try
      {
        lookAtPose(eye, lookAt, camera.up.at(frame));
      }
      catch (const UsageError&)
      {
        if ((lookAt - eye).isZero(0))
        {
          this->fail(Kind::Camera, i, "lookAt", "is the eye itself" + when, "another point");
        }
        this->fail(Kind::Camera, i, "up", "is zero or along the view" + when, "a direction across the view");
      }
    }
  }

  void checkOrder() const
  {
    if (this->Scene.order.empty())
    {
      return;
    }
    std::size_t next[3] = { 0, 0, 0 };
    bool good = true;
    for (const SceneItem& item : this->Scene.order)
    {
      good = good && item.index == next[static_cast<std::size_t>(item.kind)]++;
    }
    if (!good || next[0] != this->Scene.objects.size() || next[1] != this->Scene.lights.size() ||
        next[2] != this->Scene.cameras.size())
    {
      throw InputError(this->Scene.title(), "order does not list every object, light and camera once, in turn");
    }
  }

  bool isNumbered(const std::string& className) const
  {
    const auto found = this->Classes.find(className);
    return found != this->Classes.end() && found->second->id != 0;
  }

  const SceneDescription& Scene;
  const Locator& Locate;
  std::unordered_map<std::string, const ClassDescription*> Classes; ///< by name
};
} // namespace

Locator locateByName(const SceneDescription& scene)
{
  return [&scene](Kind kind, std::size_t index, const std::string& property) -> Place
  {
    switch (kind)
    {
      case Kind::Object:
        return { scene.objects[index].line, "object " + quoted(scene.objects[index].name) + ": " + property };
      case Kind::Light:
        return { scene.lights[index].line, "light " + quoted(scene.lights[index].name) + ": " + property };
      default:
        return { scene.cameras[index].line, "camera " + quoted(scene.cameras[index].name) + ": " + property };
    }
  };
}

void validateRelations(const SceneDescription& scene, const Locator& locate) { Relations(scene, locate).checkAll(); }

} // namespace dgtk::scenefile
