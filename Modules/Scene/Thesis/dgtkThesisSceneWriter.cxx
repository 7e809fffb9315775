// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkThesisScene.h"

#include "dgtkError.h"
#include "dgtkSceneJson.h"
#include "dgtkSceneText.h"
#include "dgtkText.h"

#include <algorithm>

namespace dgtk::scenefile
{

namespace
{
using Kind = SceneItem::Kind;
using Vector = Eigen::Vector3d;

std::string vectorText(const Vector& v)
{
  return plainNumber(v[0]) + ' ' + plainNumber(v[1]) + ' ' + plainNumber(v[2]);
}

class Writer
{
public:
  Writer(const SceneDescription& scene, const std::string& newFolder)
    : Scene(scene)
    , Models(scene.folder, newFolder)
    , Frames(scene.keyFrames())
    , Locate(locateByName(scene))
  {
    SceneDescription nameless = scene;
    const auto clear = [](auto& items)
    {
      for (auto& item : items)
      {
        item.name.clear();
      }
    };
    clear(nameless.objects);
    clear(nameless.cameras);
    nameAll(nameless);
    this->Usual = std::move(nameless);
  }

  std::string write()
  {
    this->refuseSceneProperties();
    const std::vector<SceneItem> items = this->Scene.items();
    this->Out = std::to_string(items.size()) + '\n';
    for (const SceneItem& item : items)
    {
      this->writeItem(item);
    }
    if (this->Frames.empty() && this->needsKeyFrame())
    {
      this->Frames.push_back(0);
    }
    this->Out += std::to_string(this->Frames.size()) + '\n';
    for (const int frame : this->Frames)
    {
      this->Out += std::to_string(frame) + '\n';
      for (const SceneItem& item : items)
      {
        this->writeKeys(item, frame);
      }
    }
    return std::move(this->Out);
  }

private:
  /// Throws unless `sayable`: the property of an item is one that .scene has no words for.
  void need(bool sayable, const SceneItem& item, const std::string& property, const std::string& expected = {}) const
  {
    if (!sayable)
    {
      const Place place = this->Locate(item.kind, item.index, property);
      throw InputError(this->Scene.title(), place.line, place.what + " cannot be said in .scene", expected);
    }
  }

  template <typename T>
  void needLinear(const Track<T>& track, const SceneItem& item, const std::string& property) const
  {
    for (std::size_t key = 0; key < track.keys.size(); ++key)
    {
      this->need(track.interpolationAfter(key) == Interpolation::Linear, item, property, "linear interpolation");
    }
  }

  void needLinear(const UnusedKeys& unused, const SceneItem& item, const std::string& property) const
  {
    this->needLinear(unused.orientation, item, property + ".orientation");
    this->needLinear(unused.scale, item, property + ".scale");
  }

  void needScene(bool sayable, const std::string& property) const
  {
    if (!sayable)
    {
      throw InputError(this->Scene.title(), property + " cannot be said in .scene");
    }
  }

  void refuseSceneProperties() const
  {
    const SceneDescription usual;
    this->needScene(this->Scene.fps == usual.fps, "fps");
    this->needScene(isConstant(this->Scene.background, usual.background.value), "background");
    const EnvironmentDescription& light = this->Scene.environment;
    this->needScene(light.image.empty() && light.intensity == usual.environment.intensity &&
                      light.rotation == usual.environment.rotation && light.background == usual.environment.background,
      "environment");
    const FogDescription& fog = this->Scene.fog;
    this->needScene(isConstant(fog.density, usual.fog.density.value) && isConstant(fog.color, usual.fog.color.value) &&
                      isConstant(fog.start, usual.fog.start.value),
      "fog");
    this->needScene(this->Scene.units.empty(), "units");
    this->needScene(this->Scene.metresPerUnit == 0, "metresPerUnit");
    this->needScene(this->Scene.dataset.empty(), "dataset");
    this->needScene(this->Scene.upAxis == usual.upAxis, "upAxis");
    this->needScene(this->Scene.seed == 0, "seed");
    this->needScene(this->Scene.classes.empty(), "classes");
  }

  void writeItem(const SceneItem& item)
  {
    switch (item.kind)
    {
      case Kind::Object:
        this->writeObject(item, this->Scene.objects[item.index]);
        break;
      case Kind::Light:
        this->writeLight(item, this->Scene.lights[item.index]);
        break;
      default:
        this->writeCamera(item, this->Scene.cameras[item.index]);
    }
  }

  void writeObject(const SceneItem& item, const ObjectDescription& object)
  {
    const AnimationDescription usual;
    const AnimationDescription& animation = object.animation;
    const std::string model = this->Models.of(object.model);
    this->need(!thesisTag(model).empty(), item, "model " + quoted(model), "a file in .ac, .acc, .pov, .3ds or .md2");
    this->need(model.front() != ' ' && model.back() != ' ' && model.back() != '\t', item, "model " + quoted(model));
    this->need(
      object.name == this->Usual.objects[item.index].name, item, "name", quoted(this->Usual.objects[item.index].name));
    this->need(object.className.empty(), item, "class");
    this->need(object.parent.empty(), item, "parent");
    this->need(isConstant(object.visible, true), item, "visible");
    this->need(animation.sequence.empty(), item, "animation.sequence");
    this->need(animation.start == usual.start, item, "animation.start");
    this->need(animation.offset == usual.offset, item, "animation.offset");
    this->need(animation.rate == usual.rate, item, "animation.rate");
    this->need(animation.loop == usual.loop, item, "animation.loop");
    this->need(object.materials.empty(), item, "materials");
    this->need(object.skin.empty(), item, "skin");
    this->need(object.keypoints.empty(), item, "keypoints");
    this->needLinear(object.position, item, "position");
    this->needLinear(object.orientation, item, "orientation");
    this->needLinear(object.scale, item, "scale");
    this->Out += thesisTag(model) + ": " + model + '\n';
  }

  void writeLight(const SceneItem& item, const LightDescription& light)
  {
    const LightDescription usual;
    this->need(light.kind == usual.kind, item, "kind", "a point light");
    this->need(isConstant(light.enabled, true), item, "enabled");
    this->need(isConstant(light.target, usual.target.value), item, "target");
    this->need(light.attenuation == usual.attenuation, item, "attenuation");
    this->need(isConstant(light.coneAngle, usual.coneAngle.value), item, "coneAngle");
    this->need(isConstant(light.exponent, usual.exponent.value), item, "exponent");
    this->need(isConstant(light.intensity, usual.intensity.value), item, "intensity");
    this->needOneColor(light.diffuse, item, "diffuse");
    this->needOneColor(light.specular, item, "specular");
    this->needOneColor(light.ambient, item, "ambient");
    this->need(!light.shadows, item, "shadows");
    this->need(light.shadowSize == usual.shadowSize, item, "shadowSize");
    this->need(
      light.name.find('(') == std::string::npos && light.name.front() != ' ' && light.name.back() != ' ', item, "name");
    this->needLinear(light.position, item, "position");
    this->needLinear(light.unused, item, "unused");
    this->Out += "glObject_Light:";
    // A name of the usual form is left out where the reader gives the same one.
    this->Out += light.name == this->usualLightName(item.index) ? "" : ' ' + light.name;
    const Vector& diffuse = light.diffuse.value;
    const Vector& specular = light.specular.value;
    const Vector& ambient = light.ambient.value;
    if (diffuse != usual.diffuse.value || specular != usual.specular.value || ambient != usual.ambient.value)
    {
      this->Out += " ( " + vectorText(diffuse) + ", " + vectorText(specular) + ", " + vectorText(ambient) + " )";
    }
    this->Out += '\n';
  }

  void needOneColor(const Track<Vector>& color, const SceneItem& item, const std::string& property) const
  {
    this->need(!color.animated(), item, property, "one value for all frames");
  }

  /// The name that nameAll() gives when exactly the lights of usual names have none.
  std::string usualLightName(std::size_t index) const
  {
    if (this->LightNames.empty())
    {
      SceneDescription nameless = this->Scene;
      std::vector<bool> own; // names that the reader would not give
      for (LightDescription& light : nameless.lights)
      {
        const bool usual = light.name.substr(0, 5) == "Light" &&
                           light.name.find_first_not_of("0123456789", 5) == std::string::npos && light.name.size() > 5;
        light.name = usual ? std::string() : light.name;
        own.push_back(!usual);
      }
      nameAll(nameless);
      for (const LightDescription& light : nameless.lights)
      {
        this->LightNames.push_back(light.name);
      }
      if (!std::equal(this->LightNames.begin(), this->LightNames.end(), this->Scene.lights.begin(),
            [](const std::string& name, const LightDescription& light) { return name == light.name; }))
      {
        std::fill(this->LightNames.begin(), this->LightNames.end(), std::string()); // then all are written
      }
      for (std::size_t i = 0; i < own.size(); ++i)
      {
        this->LightNames[i] = own[i] ? std::string() : this->LightNames[i];
      }
    }
    return this->LightNames[index];
  }

  void writeCamera(const SceneItem& item, const CameraDescription& camera)
  {
    const CameraDescription usual;
    this->need(camera.model == usual.model, item, "model", "pinhole");
    this->need(!camera.K, item, "K");
    for (const auto& parameter : camera.parameters)
    {
      this->need(false, item, parameter.first);
    }
    this->need(camera.width == 0, item, "width");
    this->need(camera.height == 0, item, "height");
    const ShutterDescription& shutter = camera.shutter;
    this->need(
      shutter.open == 0 && shutter.close == 0 && shutter.exposures == usual.shutter.exposures, item, "shutter");
    const RollingShutter& rolling = camera.rollingShutter;
    this->need(rolling.duration == 0 && rolling.direction == usual.rollingShutter.direction, item, "rollingShutter");
    const LensDescription& lens = camera.lens;
    this->need(
      lens.aperture == 0 && isConstant(lens.focus, usual.lens.focus.value) && lens.exposures == usual.lens.exposures,
      item, "lens");
    this->need(!camera.sensor, item, "sensor");
    this->need(!camera.posed, item, "orientation", "eye and lookAt");
    this->need(!camera.fovY.animated(), item, "fovY", "one value for all frames");
    this->need(!camera.up.animated(), item, "up", "one value for all frames");
    this->need(
      camera.name == this->Usual.cameras[item.index].name, item, "name", quoted(this->Usual.cameras[item.index].name));
    this->needLinear(camera.eye, item, "eye");
    this->needLinear(camera.lookAt, item, "lookAt");
    this->needLinear(camera.unusedEye, item, "unusedEye");
    this->needLinear(camera.unusedLookAt, item, "unusedLookAt");
    this->Out += "glObject_Camera: ( " + plainNumber(camera.fovY.value) + ", " + plainNumber(camera.near) + ", " +
                 plainNumber(camera.far) + ", " + plainNumber(camera.aspect) + " )\n[ " + vectorText(camera.eye.value) +
                 ", " + vectorText(camera.lookAt.value) + ", " + vectorText(camera.up.value) + " ]\n";
  }

  bool needsKeyFrame() const
  {
    const auto objectMoved = [](const ObjectDescription& o)
    {
      return o.position.value != Vector(0, 0, 0) || o.orientation.value != Quaternion() ||
             o.scale.value != Vector(1, 1, 1);
    };
    const auto lightMoved = [](const LightDescription& l) { return l.position.value != Vector(0, 0, 0); };
    return std::any_of(this->Scene.objects.begin(), this->Scene.objects.end(), objectMoved) ||
           std::any_of(this->Scene.lights.begin(), this->Scene.lights.end(), lightMoved);
  }

  void writeKeys(const SceneItem& item, int frame)
  {
    if (item.kind == Kind::Object)
    {
      const ObjectDescription& object = this->Scene.objects[item.index];
      this->writeLine(object.position.at(frame), object.orientation, object.scale, frame);
    }
    else if (item.kind == Kind::Light)
    {
      const LightDescription& light = this->Scene.lights[item.index];
      this->writeLine(light.position.at(frame), light.unused.orientation, light.unused.scale, frame);
    }
    else
    {
      const CameraDescription& camera = this->Scene.cameras[item.index];
      this->writeLine(camera.eye.at(frame), camera.unusedEye.orientation, camera.unusedEye.scale, frame);
      this->writeLine(camera.lookAt.at(frame), camera.unusedLookAt.orientation, camera.unusedLookAt.scale, frame);
    }
  }

  void writeLine(const Vector& position, const Track<Quaternion>& orientation, const Track<Vector>& scale, int frame)
  {
    const Quaternion q = orientation.at(frame);
    this->Out += "< " + vectorText(position) + " > { " + plainNumber(q.w) + ", < " + plainNumber(q.x) + ", " +
                 plainNumber(q.y) + ", " + plainNumber(q.z) + " > }";
    if (scale.animated() || scale.value != Vector(1, 1, 1))
    {
      this->Out += " [ " + vectorText(scale.at(frame)) + " ]";
    }
    this->Out += '\n';
  }

  const SceneDescription& Scene;
  Relocation Models;
  std::vector<int> Frames;
  Locator Locate;
  SceneDescription Usual;
  mutable std::vector<std::string> LightNames;
  std::string Out;
};
} // namespace

std::string thesisTag(const std::string& model)
{
  const std::string extension = extensionOf(model);
  if (extension == "ac" || extension == "acc" || extension == "pov")
  {
    return "glObject_AC";
  }
  return extension == "3ds" ? "glObject_3DS" : extension == "md2" ? "glObject_Md2" : "";
}

} // namespace dgtk::scenefile

namespace dgtk
{

using namespace scenefile;

std::string toThesisScene(const SceneDescription& scene, const std::string& newFolder)
{
  SceneDescription named = scene;
  nameAll(named);
  validate(named);
  return Writer(named, newFolder).write();
}

} // namespace dgtk
