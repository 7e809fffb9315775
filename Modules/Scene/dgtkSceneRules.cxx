// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneRules.h"

#include "dgtkError.h"
#include "dgtkSceneJson.h"
#include "dgtkSceneText.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dgtk::scenefile
{

std::string faultOf(const Quaternion& q)
{
  const double length = q.norm();
  return std::abs(length - 1) <= rules::quaternionTolerance ? "" : "a quaternion (w, x, y, z) of length 1";
}

std::string faultOf(const Eigen::Matrix3d& K)
{
  const bool good =
    K(0, 0) > 0 && K(1, 1) > 0 && K(1, 0) == 0 && K(2, 0) == 0 && K(2, 1) == 0 && K(2, 2) == 1 && K.allFinite();
  return good ? "" : "[[fx, s, cx], [0, fy, cy], [0, 0, 1]] with fx and fy above 0";
}

std::string faultOfCameraName(const std::string& name)
{
  static const std::set<std::string> taken{ "manifest.json", "cameras.json", "objects.json", "poses.json", "scene.json",
    "contact.png" };
  if (taken.count(name) != 0)
  {
    return "a name that is not that of a file of datasets";
  }
  const bool good = name.size() <= 128 && name.find_first_of("/\\,@:") == std::string::npos && name[0] != '.' &&
                    name[0] != ' ' && name[0] != '-' && name.back() != ' ';
  return good ? ""
              : "a name fit for a folder: at most 128 bytes, none of / \\ , @ :, not starting with a dot, dash or "
                "space, not ending with a space";
}

namespace
{
std::string freeName(const std::string& stem, int& number, std::set<std::string>& taken)
{
  std::string name;
  do
  {
    name = stem + std::to_string(number++);
  } while (!taken.insert(name).second);
  return name;
}

template <typename Item, typename StemOf>
void nameItems(std::vector<Item>& items, int first, const StemOf& stemOfItem)
{
  std::set<std::string> taken;
  for (const Item& item : items)
  {
    taken.insert(item.name);
  }
  std::map<std::string, int> next;
  for (Item& item : items)
  {
    if (item.name.empty())
    {
      const std::string stem = stemOfItem(item);
      item.name = freeName(stem, next.emplace(stem, first).first->second, taken);
    }
  }
}
} // namespace

} // namespace dgtk::scenefile

namespace dgtk
{

using namespace scenefile;

void nameAll(SceneDescription& scene)
{
  nameItems(scene.objects, 1, [](const ObjectDescription& object) { return stemOf(object.model) + '-'; });
  nameItems(scene.lights, 0, [](const LightDescription&) { return std::string("Light"); });
  nameItems(scene.cameras, 0, [](const CameraDescription&) { return std::string("Camera"); });
}

// A scene made by program obeys the rules of the .json reader: each item is put into its tree and read back.
void validate(const SceneDescription& scene)
{
  const std::string title = scene.title();
  for (const ObjectDescription& object : scene.objects)
  {
    const JsonDocument tree{ writeFields(object, objectFields()), title, "object " + quoted(object.name) + ": ",
      object.line };
    ObjectDescription read;
    readFields(JsonCursor(tree), objectFields(), read);
  }
  for (const LightDescription& light : scene.lights)
  {
    const JsonDocument tree{ writeFields(light, lightFields()), title, "light " + quoted(light.name) + ": ",
      light.line };
    LightDescription read;
    readFields(JsonCursor(tree), lightFields(), read);
  }
  for (const CameraDescription& camera : scene.cameras)
  {
    const JsonDocument tree{ writeCamera(camera, scene.upAxis), title, "camera " + quoted(camera.name) + ": ",
      camera.line };
    CameraDescription read;
    readCamera(JsonCursor(tree), scene.upAxis, read);
  }
  SceneDescription rest;
  rest.dataset = scene.dataset;
  rest.units = scene.units;
  rest.metresPerUnit = scene.metresPerUnit;
  rest.upAxis = scene.upAxis;
  rest.fps = scene.fps;
  rest.background = scene.background;
  rest.environment = scene.environment;
  rest.fog = scene.fog;
  rest.seed = scene.seed;
  rest.classes = scene.classes; // whose file says no more
  rest.extraKeyFrames = scene.extraKeyFrames;
  const JsonDocument tree{ writeFields(rest, sceneFields()), title };
  SceneDescription read;
  readFields(JsonCursor(tree), sceneFields(), read);
  validateRelations(scene, locateByName(scene));
}

} // namespace dgtk
