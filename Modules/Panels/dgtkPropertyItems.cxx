// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPropertiesPanel.h"

#include "dgtkCameraEntry.h"
#include "dgtkItemDialogs.h"
#include "dgtkNumberRow.h"
#include "dgtkScenePlaces.h"

#include <QDir>
#include <QFileInfo>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dgtk
{

// The rows of each kind of item, and of the scene.

namespace
{
constexpr double squareness = 1e-12; // ratio of a pixel's sides that rounding may change

[[noreturn]] void refuse(const QString& why) { throw std::runtime_error(why.toStdString()); }

/// A matrix stays where numbers of the lens move; what a field of view says goes with them.
void requireStillLens(const CameraDescription& camera)
{
  for (const auto& [name, value] : camera.parameters)
  {
    if (std::any_of(value.numbers.begin(), value.numbers.end(), [](const auto& number) { return number.animated(); }))
    {
      refuse(PropertiesPanel::tr("%1 has key frames, so a matrix and a field of view do not say the same: remove them "
                                 "first.")
               .arg(toText(name)));
    }
  }
}

Eigen::Matrix3d matrixOf(const CameraDescription& camera, int frame)
{
  return *makeCamera(camera.model, cameraParameters(camera, frame, camera.width, camera.height))->parameters().K;
}

/// What the field of view says, as a matrix of the camera's own size. Throws std::runtime_error where something moves.
void useMatrix(CameraDescription& camera, int frame)
{
  if (camera.fovY.animated())
  {
    refuse(PropertiesPanel::tr("The field of view has key frames, which a matrix cannot have: remove them first."));
  }
  requireStillLens(camera);
  if (camera.width <= 0 || camera.height <= 0)
  {
    camera.width = usualImageSize[0];
    camera.height = usualImageSize[1];
  }
  camera.K = matrixOf(camera, frame);
  camera.fovY = Track<double>{ CameraDescription().fovY.value };
  camera.aspect = 0;
}

/// What the matrix says, as a field of view. Throws std::runtime_error where that cannot say it.
void useFieldOfView(CameraDescription& camera)
{
  constexpr double sameImage = 1e-9; // part of the image's size that rounding may move
  constexpr double widest = 180;
  requireStillLens(camera);
  const Eigen::Matrix3d K = *camera.K;
  const double angle = fieldOfViewOf(camera).value_or(widest);
  if (angle >= widest)
  {
    refuse(PropertiesPanel::tr("A field of view is below 180 degrees: a wider lens needs its matrix."));
  }
  const double ratio = K(1, 1) / K(0, 0);
  camera.fovY = Track<double>{ angle };
  camera.aspect = std::abs(ratio - 1) < squareness ? 0 : ratio * camera.width / camera.height;
  camera.K.reset();
  if (!((matrixOf(camera, 0) - K).norm() < sameImage * (camera.width + camera.height)))
  {
    refuse(PropertiesPanel::tr("A field of view has its principal point in the middle of the image and no skew: set "
                               "cx, cy to %1, %2 and the skew to 0 first.")
             .arg(camera.width / 2.0)
             .arg(camera.height / 2.0));
  }
}
} // namespace

void PropertiesPanel::buildObject(std::size_t index)
{
  const ObjectDescription& now = this->State.scene().objects[index];
  const auto object = [index](SceneDescription& scene) -> ObjectDescription& { return scene.objects[index]; };
  this->addText(
    tr("Class"), "class", [index](const SceneDescription& scene) { return scene.objects[index].className; },
    [index](SceneDescription& scene, const std::string& text) { scene.objects[index].className = text; }, true);
  const QString model = toText(this->State.scene().resolve(now.model));
  const QFileInfo file(toText(this->State.document().path()));
  this->addLine(tr("Model"), file.filePath().isEmpty() ? toText(now.model) : file.dir().relativeFilePath(model));
  if (!now.parent.empty())
  {
    this->addLine(tr("Parent"), toText(now.parent));
  }
  this->addTrack(this->withUnits(tr("Position")), "position",
    [object](SceneDescription& scene) -> Track<Eigen::Vector3d>& { return object(scene).position; });
  this->addOrientation([object](SceneDescription& scene) -> Track<Quaternion>& { return object(scene).orientation; });
  this->addTrack(
    tr("Scale"), "scale", [object](SceneDescription& scene) -> Track<Eigen::Vector3d>& { return object(scene).scale; });
  this->addTrack(
    tr("Visible"), "visible", [object](SceneDescription& scene) -> Track<bool>& { return object(scene).visible; });
  this->buildSequence(index);
}

void PropertiesPanel::buildLight(std::size_t index)
{
  // In the order of Add light; what a kind does not have is not there.
  const LightTraits& now = traitsOf(this->State.scene().lights[index].kind);
  const auto light = [index](SceneDescription& scene) -> LightDescription& { return scene.lights[index]; };
  this->addChoice(
    tr("Kind"), "kind", lightKindNames(),
    [index](const SceneDescription& scene) { return lightKindPlace(scene.lights[index].kind); },
    [index](SceneDescription& scene, int place) { scene.lights[index].kind = lightKinds()[std::size_t(place)].kind; });
  using Vectors = Track<Eigen::Vector3d>;
  if (now.placed)
  {
    this->addTrack(this->withUnits(tr("Position")), "position",
      [light](SceneDescription& scene) -> Vectors& { return light(scene).position; });
  }
  if (now.aimed)
  {
    this->addTrack(this->withUnits(tr("Target")), "target",
      [light](SceneDescription& scene) -> Vectors& { return light(scene).target; });
  }
  using Scalars = Track<double>;
  this->addTrack(
    tr("Diffuse"), "diffuse", [light](SceneDescription& scene) -> Vectors& { return light(scene).diffuse; }, true);
  this->addTrack(
    tr("Specular"), "specular", [light](SceneDescription& scene) -> Vectors& { return light(scene).specular; }, true);
  this->addTrack(
    tr("Ambient"), "ambient", [light](SceneDescription& scene) -> Vectors& { return light(scene).ambient; }, true);
  this->addTrack(
    tr("Intensity"), "intensity", [light](SceneDescription& scene) -> Scalars& { return light(scene).intensity; });
  if (now.near)
  {
    this->addVector(tr("Attenuation (constant, linear, quadratic)"), "attenuation",
      [light](SceneDescription& scene) -> Eigen::Vector3d& { return light(scene).attenuation; });
  }
  if (now.cone)
  {
    this->addTrack(
      tr("Cone, \u00b0"), "coneAngle", [light](SceneDescription& scene) -> Scalars& { return light(scene).coneAngle; });
    this->addTrack(
      tr("Exponent"), "exponent", [light](SceneDescription& scene) -> Scalars& { return light(scene).exponent; });
  }
  this->addTrack(
    tr("Enabled"), "enabled", [light](SceneDescription& scene) -> Track<bool>& { return light(scene).enabled; });
  this->addCheck(tr("Shadows"), "shadows", [light](SceneDescription& scene) -> bool& { return light(scene).shadows; });
}

void PropertiesPanel::buildCamera(std::size_t index)
{
  const CameraDescription& now = this->State.scene().cameras[index];
  const auto camera = [index](SceneDescription& scene) -> CameraDescription& { return scene.cameras[index]; };
  this->addLine(tr("Model"), toText(now.model));
  using Vectors = Track<Eigen::Vector3d>;
  if (now.posed)
  {
    this->addTrack(this->withUnits(tr("Position")), "position",
      [camera](SceneDescription& scene) -> Vectors& { return camera(scene).position; });
    this->addOrientation([camera](SceneDescription& scene) -> Track<Quaternion>& { return camera(scene).orientation; });
  }
  else
  {
    this->addTrack(
      this->withUnits(tr("Eye")), "eye", [camera](SceneDescription& scene) -> Vectors& { return camera(scene).eye; });
    this->addTrack(this->withUnits(tr("Look at")), "lookAt",
      [camera](SceneDescription& scene) -> Vectors& { return camera(scene).lookAt; });
    this->addTrack(tr("Up"), "up", [camera](SceneDescription& scene) -> Vectors& { return camera(scene).up; });
  }
  if (hasParameter(now, "viewHeight"))
  {
    this->addTrack(this->withUnits(tr("View height")), "viewHeight",
      [camera](SceneDescription& scene) -> Track<double>& { return camera(scene).viewHeight; });
  }
  if (hasParameter(now, "fovY"))
  {
    this->buildLens(index);
  }
  this->buildParameters(index);
  this->addNumber(
    this->withUnits(tr("Near")), "near", [camera](SceneDescription& scene) -> double& { return camera(scene).near; });
  this->addNumber(
    this->withUnits(tr("Far")), "far", [camera](SceneDescription& scene) -> double& { return camera(scene).far; });
  this->addNumbers(
    tr("Size, pixels"), "size", 2,
    [index](const SceneDescription& scene) {
      return Numbers{ double(scene.cameras[index].width), double(scene.cameras[index].height) };
    },
    [camera](SceneDescription& scene, const Numbers& size)
    {
      // A size is given whole or not at all: the first number typed makes the usual shape.
      CameraDescription& its = camera(scene);
      const bool widthTyped = pixelsOf(size[0]) != its.width;
      its.width = pixelsOf(size[0]);
      its.height = pixelsOf(size[1]);
      if ((its.width == 0) != (its.height == 0) && widthTyped)
      {
        its.height = its.width == 0 ? 0 : std::max(1, its.width * 3 / 4);
      }
      else if ((its.width == 0) != (its.height == 0))
      {
        its.width = its.height == 0 ? 0 : std::max(1, its.height * 4 / 3);
      }
    });
}

void PropertiesPanel::buildLens(std::size_t index)
{
  const auto camera = [index](SceneDescription& scene) -> CameraDescription& { return scene.cameras[index]; };
  if (hasParameter(this->State.scene().cameras[index], "K"))
  {
    this->addChoice(
      tr("Lens"), "lens", { tr("by its field of view"), tr("by its matrix K") },
      [index](const SceneDescription& scene) { return scene.cameras[index].K ? 1 : 0; },
      [this, camera](SceneDescription& scene, int byMatrix)
      {
        if (byMatrix == 1 && !camera(scene).K)
        {
          useMatrix(camera(scene), this->State.frame());
        }
        else if (byMatrix == 0 && camera(scene).K)
        {
          useFieldOfView(camera(scene));
        }
      });
  }
  if (!this->State.scene().cameras[index].K)
  {
    this->addTrack(tr("Field of view, \u00b0"), "fovY",
      [camera](SceneDescription& scene) -> Track<double>& { return camera(scene).fovY; });
    this->addNumber(tr("Aspect (0: square)"), "aspect",
      [camera](SceneDescription& scene) -> double& { return camera(scene).aspect; });
    return;
  }
  const auto addPair = [&](const QString& label, const char* name, int row0, int column0, int row1, int column1)
  {
    this->addNumbers(
      label, name, 2,
      [=](const SceneDescription& scene)
      {
        const Eigen::Matrix3d& K = *scene.cameras[index].K;
        return Numbers{ K(row0, column0), K(row1, column1) };
      },
      [=](SceneDescription& scene, const Numbers& values)
      {
        (*camera(scene).K)(row0, column0) = values[0];
        (*camera(scene).K)(row1, column1) = values[1];
      });
  };
  addPair(tr("fx, fy, pixels"), "focal", 0, 0, 1, 1);
  addPair(tr("cx, cy, pixels"), "principal", 0, 2, 1, 2);
  this->addNumber(
    tr("Skew, pixels"), "skew", [camera](SceneDescription& scene) -> double& { return (*camera(scene).K)(0, 1); });
}

void PropertiesPanel::buildParameters(std::size_t index)
{
  const CameraDescription& now = this->State.scene().cameras[index];
  for (const CameraParameter& parameter : ownParameters(now.model))
  {
    const QString name = toText(parameter.name);
    const QString label = name.left(1).toUpper() + name.mid(1);
    const auto given = now.parameters.find(parameter.name);
    if (parameter.kind == CameraParameter::Kind::File)
    {
      this->addLine(label, given == now.parameters.end() ? QString() : toText(given->second.file));
      continue;
    }
    const auto get = [this, index, parameter](const SceneDescription& scene)
    {
      const auto& values = scene.cameras[index].parameters;
      const auto own = values.find(parameter.name);
      Numbers numbers;
      for (const Track<double>& track : own == values.end() ? std::vector<Track<double>>() : own->second.numbers)
      {
        numbers.push_back(boundedAt(track, this->State.frame()));
      }
      return numbers.empty() ? parameter.usual : numbers;
    };
    const auto set = [this, index, parameter](SceneDescription& scene, const Numbers& numbers)
    {
      std::vector<Track<double>>& tracks = scene.cameras[index].parameters[parameter.name].numbers;
      tracks.resize(numbers.size());
      for (std::size_t i = 0; i < numbers.size(); ++i)
      {
        setTrackAt(tracks[i], this->State.frame(), numbers[i]);
      }
    };
    this->addNumbers(parameter.unit.empty() ? label : tr("%1, %2").arg(label, toText(parameter.unit)), name,
      static_cast<int>(get(this->State.scene()).size()), get, set);
  }
}

void PropertiesPanel::buildScene()
{
  this->addText(
    tr("Units"), "units", [](const SceneDescription& scene) { return scene.units; },
    [](SceneDescription& scene, const std::string& units) { scene.units = units; }, false);
  this->addChoice(
    tr("Up axis"), "upAxis", { "y", "z" }, [](const SceneDescription& scene) { return static_cast<int>(scene.upAxis); },
    [](SceneDescription& scene, int axis) { scene.upAxis = static_cast<UpAxis>(axis); });
  using Vectors = Track<Eigen::Vector3d>;
  this->addTrack(
    tr("Background"), "background", [](SceneDescription& scene) -> Vectors& { return scene.background; }, true);
  this->addTrack(
    tr("Fog"), "fogColor", [](SceneDescription& scene) -> Vectors& { return scene.fog.color; }, true);
  this->addTrack(
    tr("Fog's density"), "fogDensity", [](SceneDescription& scene) -> Track<double>& { return scene.fog.density; });
  this->addTrack(this->withUnits(tr("Fog begins at")), "fogStart",
    [](SceneDescription& scene) -> Track<double>& { return scene.fog.start; });
}

} // namespace dgtk
