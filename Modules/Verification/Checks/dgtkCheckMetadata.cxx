// SPDX-License-Identifier: BSD-3-Clause
// What the documents say of the scene as a whole: units, classes, what moves, which models are the same.
#include "dgtkCheck.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

namespace dgtk
{

namespace
{
/// Of longer scenes as many frames are looked at, from the first to the last.
constexpr int mostFrames = 1000;

Offender inObjects(std::size_t id, const std::string& found, const std::string& expected)
{
  return { "objects.json", -1, -1, "object " + std::to_string(id) + ' ' + found, expected };
}

/// `flow_forward` of `flow_forward_class`, `matting` of `matting_alpha`: the folder of a layer's files, or its
/// beginning.
std::string folderOf(const std::string& layer)
{
  constexpr const char* matting = "matting_";
  const std::size_t kind = layer.rfind("_class");
  return layer.rfind(matting, 0) == 0 ? "matting" : kind != std::string::npos ? layer.substr(0, kind) : layer;
}

/// What the manifest says of its pictures' files: their paths are CAMERA/LAYER/FRAME, and the list of layers has them.
void checkFiles(const Dataset& dataset, Meter& meter)
{
  const Manifest& manifest = dataset.manifest();
  std::set<std::pair<std::string, std::string>> there; // layer and format
  std::set<std::string> cameras;
  for (const CameraRecord& camera : dataset.cameras())
  {
    cameras.insert(camera.name);
  }
  for (const DatasetFile& file : manifest.files)
  {
    const std::filesystem::path path(file.path);
    const std::string name = path.parent_path().filename().string();
    const std::string camera = path.parent_path().parent_path().generic_string();
    const std::string format = path.has_extension() ? path.extension().string().substr(1) : "";
    there.emplace(file.layer, format);
    const bool known = cameras.count(camera) > 0 || file.layer == "points";
    if (!known && file.frame < 0)
    {
      continue;
    }
    const std::string folder = folderOf(file.layer);
    const bool manyFolders = folder == "correspondence" || folder == "matting";
    int frame = -1;
    const std::string digits = path.filename().string();
    std::from_chars(digits.data(), digits.data() + digits.size(), frame);
    const bool same = !folder.empty() && (name == folder || (manyFolders && name.rfind(folder + '_', 0) == 0)) &&
                      frame == file.frame && (camera.empty() ? cameras.count(file.camera) > 0 : camera == file.camera);
    meter.equal(same,
      [&]
      {
        return Offender{ "manifest.json", -1, -1,
          file.path + " of layer '" + file.layer + "' camera '" + file.camera + "' frame " + std::to_string(file.frame),
          "what its path says" };
      });
  }
  std::set<std::pair<std::string, std::string>> listed;
  std::set<std::string> names{ "", "calibration", "tiles" }; // these are no layers of pixels
  for (const LayerRecord& layer : manifest.layers)
  {
    listed.emplace(layer.spec.name, layer.format); // earlier versions have some twice
    names.insert(layer.spec.name);
    const bool none = std::any_of(manifest.empty.begin(), manifest.empty.end(),
      [&](const EmptyRecord& one) { return one.layer == folderOf(layer.spec.name) && one.pictures == one.of; });
    meter.equal(none || there.count({ layer.spec.name, layer.format }) > 0,
      [&]
      {
        return Offender{ "manifest.json", -1, -1, "layer '" + layer.spec.name + "' as " + layer.format,
          "one that has files" };
      });
  }
  for (const auto& one : there)
  {
    const bool further = one.first.empty() || one.first == "calibration" || one.first == "tiles" ||
                         one.first == "points" || one.first == "pov" || one.first == "tracks";
    meter.equal(names.count(one.first) > 0 && (further || listed.count(one) > 0),
      [&] {
        return Offender{ "manifest.json", -1, -1, "no layer '" + one.first + "' as " + one.second, "one" };
      });
  }
}

void checkManifest(const Dataset& dataset, Results& results)
{
  const Manifest& manifest = dataset.manifest();
  const SceneDescription& scene = dataset.stage().description();
  if (manifest.fps == 0) // of a first dataset
  {
    return;
  }
  Meter meter(0);
  const auto equal = [&meter](const std::string& key, const std::string& found, const std::string& expected) {
    meter.equal(found == expected, [&] { return Offender{ "manifest.json", -1, -1, key + ' ' + found, expected }; });
  };
  equal("units", manifest.units, scene.units);
  equal("metres_per_unit", numberText(manifest.metresPerUnit),
    numberText(scene.metresPerUnit > 0 ? scene.metresPerUnit : metresOfUnit(scene.units)));
  equal("fps", numberText(manifest.fps), numberText(scene.fps));
  for (const std::string& word : datasetWords())
  {
    const auto found = manifest.info.find(word);
    const auto expected = scene.dataset.find(word);
    equal("info." + word, found == manifest.info.end() ? "none" : '\'' + found->second + '\'',
      expected == scene.dataset.end() ? "none" : '\'' + expected->second + '\'');
  }
  checkFiles(dataset, meter);
  results.add({ "manifest", "", { "manifest.json" } }, meter);
}

/// The words of a class that say more than its number.
std::string describe(const std::string& supercategory, const std::optional<bool>& thing,
  const std::optional<std::array<int, 3>>& color, const std::vector<std::string>& keypoints,
  const std::vector<std::array<int, 2>>& skeleton)
{
  std::string text = '\'' + supercategory + "' thing " + (thing ? (*thing ? "true" : "false") : "null") + " color";
  for (std::size_t i = 0; color && i < color->size(); ++i)
  {
    text += ' ' + std::to_string((*color)[i]);
  }
  text += " keypoints";
  for (const std::string& name : keypoints)
  {
    text += " '" + name + '\'';
  }
  text += " skeleton";
  for (const std::array<int, 2>& pair : skeleton)
  {
    text += ' ' + std::to_string(pair[0]) + '-' + std::to_string(pair[1]);
  }
  return text;
}

/// Those that the scene fixes; the numbers of others are those of their objects.
void checkClasses(const Dataset& dataset, Results& results)
{
  Meter meter(0);
  std::map<std::string, ClassRecord> known;
  for (const ClassRecord& one : readClasses(dataset.absolute("objects.json")))
  {
    known[one.name] = one;
  }
  for (const ClassDescription& one : dataset.stage().description().classes)
  {
    const ClassRecord& record = known[one.name];
    const std::string found =
      std::to_string(record.id) + ' ' +
      describe(record.supercategory, record.thing, record.color, record.keypoints, record.skeleton);
    const std::string expected =
      std::to_string(one.id) + ' ' + describe(one.supercategory, one.thing, one.color, one.keypoints, one.skeleton);
    meter.equal(found == expected,
      [&] {
        return Offender{ "objects.json", -1, -1, "class '" + one.name + "' " + found, expected };
      });
  }
  if (meter.Count > 0)
  {
    results.add({ "classes", "", { "objects.json" } }, meter);
  }
}

/// What the states of a scene's frames show of its objects.
class Changes
{
public:
  explicit Changes(const Dataset& dataset)
    : First(dataset.stage().at(dataset.stage().description().firstFrame()))
    , Moves(this->First->instances.size(), 0)
    , Deforms(this->First->instances.size(), 0)
  {
    const SceneDescription& scene = dataset.stage().description();
    const int first = scene.firstFrame();
    const int frames = scene.lastFrame() - first + 1;
    this->All = frames <= mostFrames;
    for (int i = 1; i < std::min(frames, mostFrames); ++i)
    {
      const int step = this->All ? i : int(std::int64_t(i) * (frames - 1) / (mostFrames - 1));
      this->look(*dataset.stage().at(first + step));
    }
  }

  const SceneState& first() const { return *this->First; }
  /// Whether every frame was looked at.
  bool all() const { return this->All; }
  bool moves(std::size_t i) const { return this->Moves[i] != 0; }
  bool deforms(std::size_t i) const { return this->Deforms[i] != 0; }

private:
  void look(const SceneState& state)
  {
    for (std::size_t i = 0; i < state.instances.size(); ++i)
    {
      const Instance& before = this->First->instances[i];
      const Instance& now = state.instances[i];
      this->Moves[i] |= static_cast<char>(!(now.world_from_object == before.world_from_object));
      this->Deforms[i] |=
        static_cast<char>(now.geometry != before.geometry && now.geometry->positions != before.geometry->positions);
    }
  }

  std::shared_ptr<const SceneState> First;
  std::vector<char> Moves;
  std::vector<char> Deforms;
  bool All = true;
};

void checkFlags(const Changes& changes, const std::vector<ObjectRecord>& objects, Results& results)
{
  Meter meter(0);
  const auto equal = [&](const ObjectRecord& object, const char* key, bool found, bool expected, bool known)
  {
    if (found != expected && !known)
    {
      meter.skip();
      return;
    }
    const auto word = [&](bool value) { return std::string(key) + (value ? " true" : " false"); };
    meter.equal(found == expected, [&] { return inObjects(object.id, word(found), word(expected)); });
  };
  for (std::size_t i = 0; i < std::min(objects.size(), changes.first().instances.size()); ++i)
  {
    const bool changed = changes.moves(i) || changes.deforms(i);
    equal(objects[i], "static", objects[i].isStatic, !changed, changes.all() || changed);
    equal(objects[i], "deforming", objects[i].deforming, changes.deforms(i), changes.all() || changes.deforms(i));
  }
  results.add({ "flags", "", { "objects.json" } }, meter);
}

/// The same triangles with the same colours, as far as no texture decides.
bool looksEqual(const Instance& a, const Instance& b)
{
  if (a.geometry->positions != b.geometry->positions || a.model->triangles != b.model->triangles ||
      a.model->uvs != b.model->uvs || a.model->unplaced != b.model->unplaced ||
      a.model->parts.size() != b.model->parts.size())
  {
    return false;
  }
  for (std::size_t i = 0; i < a.model->parts.size(); ++i)
  {
    const Material& one = (*a.materials)[std::size_t(a.model->parts[i].material)];
    const Material& other = (*b.materials)[std::size_t(b.model->parts[i].material)];
    if (one.diffuse != other.diffuse || one.opacity != other.opacity || (one.texture < 0) != (other.texture < 0))
    {
      return false;
    }
  }
  return true;
}

/// Equal hashes for what is the same, others for what differs.
void checkIdentity(const SceneState& first, const std::vector<ObjectRecord>& objects, Results& results)
{
  using Key = std::tuple<const Model*, const Geometry*, const std::vector<Material>*>;
  std::map<Key, std::size_t> same;
  std::map<std::string, std::size_t> hashes;
  Meter meter(0);
  for (std::size_t i = 0; i < std::min(objects.size(), first.instances.size()); ++i)
  {
    const Instance& instance = first.instances[i];
    const std::string& hash = objects[i].geometry;
    const std::size_t known =
      same.emplace(Key(instance.model.get(), instance.geometry.get(), instance.materials.get()), i).first->second;
    const std::size_t like = hashes.emplace(hash, i).first->second;
    meter.equal(objects[known].geometry == hash,
      [&] { return inObjects(i + 1, "geometry " + hash, "that of object " + std::to_string(known + 1)); });
    meter.equal(looksEqual(first.instances[like], instance),
      [&] { return inObjects(i + 1, "geometry " + hash, "another one than object " + std::to_string(like + 1)); });
  }
  results.add({ "identity", "", { "objects.json" } }, meter);
}
} // namespace

void checkMetadata(Dataset& dataset, Results& results)
{
  checkManifest(dataset, results);
  checkClasses(dataset, results);
  const std::vector<ObjectRecord>& objects = dataset.objects();
  if (objects.empty() || objects.front().geometry.empty()) // of a first dataset
  {
    return;
  }
  const Changes changes(dataset);
  checkFlags(changes, objects, results);
  checkIdentity(changes.first(), objects, results);
}

} // namespace dgtk
