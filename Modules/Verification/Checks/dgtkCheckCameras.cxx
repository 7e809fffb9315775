// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

/// Numbers are written so that they read back as the same doubles; look-at matrices and tracks are computed once.
constexpr double cameraTolerance = 1e-12;

/// Difference of matrices relative to the larger of 1 and the expected one's largest value.
template <typename M>
double relative(const M& found, const M& expected)
{
  return (found - expected).cwiseAbs().maxCoeff() / std::max(1.0, expected.cwiseAbs().maxCoeff());
}

using Numbers = std::map<std::string, std::vector<double>>;

/// The first name whose numbers are not the same.
std::string differing(const Numbers& a, const Numbers& b)
{
  const auto [own, other] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  const bool isOwn = own != a.end() && (other == b.end() || own->first <= other->first);
  return isOwn ? own->first : other->first;
}

std::string listed(const Numbers& numbers, const std::string& name)
{
  const auto found = numbers.find(name);
  std::string text;
  for (const double number : found == numbers.end() ? std::vector<double>() : found->second)
  {
    text += (text.empty() ? "" : ", ") + numberText(number);
  }
  return text.empty() ? "none" : text;
}

/// cameras.json against the scene.
class CameraCheck
{
public:
  CameraCheck(const CameraRecord& record, const View& view, Meter& meter)
    : Record(record)
    , Scene(view)
    , TheMeter(meter)
  {
  }
  void run()
  {
    const auto linear = this->Scene.model->linear();
    const CameraParameters& expected = this->Scene.model->parameters();
    if (linear || expected.K)
    {
      this->matrix("K", this->Record.K, linear ? linear->K : *expected.K);
    }
    this->matrix("R", this->Record.R, this->Scene.camera_from_world.rotation);
    this->matrix("t", this->Record.t, this->Scene.camera_from_world.translation);
    this->number("near", this->Record.near, this->Scene.near);
    this->number("far", this->Record.far, this->Scene.far);
    this->TheMeter.equal(this->Record.model == this->Scene.model->name(),
      [&] { return this->offender("model", this->Record.model, this->Scene.model->name()); });
    this->TheMeter.equal(this->Record.numbers == expected.numbers,
      [&]
      {
        const std::string name = differing(this->Record.numbers, expected.numbers);
        return this->offender(name.c_str(), listed(this->Record.numbers, name), listed(expected.numbers, name));
      });
    const std::pair<const RollingShutter&, const RollingShutter&> shutters(
      this->Record.rollingShutter, expected.rollingShutter);
    this->number("rollingShutter duration", shutters.first.duration, shutters.second.duration);
    this->TheMeter.equal(shutters.first.direction == shutters.second.direction,
      [&]
      {
        return this->offender("rollingShutter direction", rollingDirections()[std::size_t(shutters.first.direction)],
          rollingDirections()[std::size_t(shutters.second.direction)]);
      });
    const Eigen::Matrix3d square = this->Record.R * this->Record.R.transpose();
    this->matrix<Eigen::Matrix3d>("R R^T", square, Eigen::Matrix3d::Identity());
  }

private:
  Offender offender(const char* key, const std::string& found, const std::string& expected) const
  {
    const std::string who = "camera '" + this->Record.name + "' frame " + std::to_string(this->Record.frame);
    return { "cameras.json", -1, -1, who + ' ' + key + ' ' + found, expected };
  }
  template <typename M>
  void matrix(const char* key, const M& found, const M& expected)
  {
    int i = 0;
    int j = 0;
    (found - expected).cwiseAbs().maxCoeff(&i, &j);
    this->TheMeter.add(relative<M>(found, expected),
      [&] { return this->offender(key, numberText(found(i, j)), numberText(expected(i, j))); });
  }
  void number(const char* key, double found, double expected)
  {
    this->TheMeter.add(found == expected ? 0 : (found - expected) / expected,
      [&] { return this->offender(key, numberText(found), numberText(expected)); });
  }

  const CameraRecord& Record;
  const View& Scene;
  Meter& TheMeter;
};

/// One number a class, one class a number.
void checkClassIds(const std::vector<ObjectRecord>& objects, Meter& meter)
{
  std::map<std::string, std::uint32_t> idOf;
  std::map<std::uint32_t, std::string> classOf;
  for (const ObjectRecord& object : objects)
  {
    const std::uint32_t id = idOf.try_emplace(object.objectClass, object.classId).first->second;
    const std::string& name = classOf.try_emplace(object.classId, object.objectClass).first->second;
    meter.equal(id == object.classId && name == object.objectClass,
      [&]
      {
        return Offender{ "objects.json", -1, -1,
          "object " + std::to_string(object.id) + " of class " + std::to_string(object.classId) + " '" +
            object.objectClass + '\'',
          "one number for each class" };
      });
  }
}

/// Whether a path of the dataset's documents leads to a file.
bool leadsTo(const Dataset& dataset, const std::string& path, const std::string& file)
{
  std::error_code code;
  return fs::weakly_canonical(fs::path(dataset.folder()) / path, code) == fs::weakly_canonical(file, code);
}

void compareObjects(Dataset& dataset, Meter& meter)
{
  const int frame = dataset.cameras().empty() ? 0 : dataset.cameras().front().frame;
  const std::vector<Instance>& instances = dataset.state(frame)->instances;
  const std::vector<ObjectRecord>& objects = dataset.objects();
  meter.equal(objects.size() == instances.size(),
    [&]
    {
      return Offender{ "objects.json", -1, -1, std::to_string(objects.size()) + " objects",
        std::to_string(instances.size()) };
    });
  std::map<std::pair<std::string, std::string>, bool> known; // paths of models: they may be few, and their objects many
  for (std::size_t i = 0; i < std::min(objects.size(), instances.size()); ++i)
  {
    const auto text = [](std::uint64_t id, const std::string& name, const std::string& type, std::uint64_t triangles)
    { return std::to_string(id) + " '" + name + "' '" + type + "' " + std::to_string(triangles) + " triangles"; };
    const std::string found = text(objects[i].id, objects[i].name, objects[i].objectClass, objects[i].triangles);
    const std::string expected =
      text(i + 1, instances[i].name, instances[i].className, instances[i].model->triangles.size());
    meter.equal(found == expected, [&] { return Offender{ "objects.json", -1, -1, found, expected }; });
    const std::string& model = instances[i].model->path;
    const auto [same, isNew] = known.try_emplace({ objects[i].model, model }, false);
    same->second = isNew ? leadsTo(dataset, objects[i].model, model) : same->second;
    meter.equal(same->second,
      [&] {
        return Offender{ "objects.json", -1, -1, found + " of " + objects[i].model, model };
      });
    const std::uint32_t fixed = instances[i].classId;
    meter.equal(fixed == 0 || objects[i].classId == fixed,
      [&]
      {
        return Offender{ "objects.json", -1, -1,
          "object " + std::to_string(i + 1) + " of class " + std::to_string(objects[i].classId),
          std::to_string(fixed) };
      });
  }
  checkClassIds(objects, meter);
}
} // namespace

void checkCameras(Dataset& dataset, Results& results)
{
  Meter cameras(cameraTolerance);
  std::set<std::pair<std::string, int>> seen;
  for (const CameraRecord& record : dataset.cameras())
  {
    cameras.equal(seen.emplace(record.name, record.frame).second,
      [&]
      {
        return Offender{ "cameras.json", -1, -1,
          "camera '" + record.name + "' frame " + std::to_string(record.frame) + " twice", "once" };
      });
    CameraCheck(record, dataset.sceneView(record), cameras).run();
  }
  results.add({ "cameras", "relative", { "cameras.json" } }, cameras);
  Meter objects(0);
  compareObjects(dataset, objects);
  results.add({ "objects", "", { "objects.json" } }, objects);
}

} // namespace dgtk
