// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColmapRigs.h"

#include "dgtkError.h"
#include "dgtkExportChecks.h"
#include "dgtkLayerFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace dgtk::colmap
{

namespace
{
using Json = nlohmann::ordered_json;

using Shots = std::vector<const DatasetShot*>; ///< of a camera

bool hasOneMatrix(const Shots& shots)
{
  const CameraRecord& first = shots.front()->camera;
  return std::all_of(shots.begin(), shots.end(),
    [&](const DatasetShot* shot)
    {
      const CameraRecord& one = shot->camera;
      return one.K == first.K && one.width == first.width && one.height == first.height && one.numbers == first.numbers;
    });
}

Rigid3 betweenAt(const DatasetShot& from, const DatasetShot& to)
{
  return cameraFromWorld(to.camera) * cameraFromWorld(from.camera).inverse();
}

/// The second camera's axes from the first one's; none where they are not always the same.
std::optional<Rigid3> between(const Shots& from, const Shots& to)
{
  constexpr double rounding = 1e-9;
  if (from.size() != to.size())
  {
    return std::nullopt;
  }
  const Rigid3 apart = betweenAt(*from[0], *to[0]);
  const auto isSame = [&](const DatasetShot* a, const DatasetShot* b)
  {
    const Rigid3 here = betweenAt(*a, *b);
    const double size = std::max({ a->camera.t.norm(), b->camera.t.norm(), 1e-300 });
    return a->frame() == b->frame() && (here.rotation - apart.rotation).cwiseAbs().maxCoeff() <= rounding &&
           (here.translation - apart.translation).norm() <= rounding * size;
  };
  const bool same = std::equal(from.begin(), from.end(), to.begin(), isSame);
  return same ? std::optional<Rigid3>(apart) : std::nullopt;
}

std::vector<double> poseNumbers(const Rigid3& pose)
{
  const Eigen::Vector4d q = quaternionOf(pose.rotation);
  const Eigen::Vector3d& t = pose.translation;
  return { q[0], q[1], q[2], q[3], t[0], t[1], t[2] };
}

/// What the names of a camera's pictures begin with.
std::string prefixOf(const Views& views, const DatasetShot& shot)
{
  const std::string name = views.name(shot);
  return name.substr(0, name.rfind(padded(shot.frame(), 6)));
}

/// A rig of a model, by COLMAP's numbers of cameras.
struct ModelRig
{
  std::vector<std::uint32_t> cameras;
  std::vector<Rigid3> fromFirst;
  std::vector<std::string> prefixes;
};

/// The dataset's rigs, and behind them every other camera as one of its own.
std::vector<ModelRig> rigsOfModel(
  const DatasetView& dataset, const Views& views, const std::vector<std::uint32_t>& cameraIds)
{
  std::map<std::string, std::size_t> firsts; // of a camera's pictures
  std::map<std::uint32_t, std::size_t> alone;
  for (std::size_t i = 0; i < cameraIds.size(); ++i)
  {
    firsts.emplace(views.shots[i]->name(), i);
    alone.emplace(cameraIds[i], i);
  }
  std::vector<ModelRig> rigs;
  const auto add = [&](ModelRig& rig, std::size_t picture, const Rigid3& pose)
  {
    rig.cameras.push_back(cameraIds[picture]);
    rig.fromFirst.push_back(pose);
    rig.prefixes.push_back(prefixOf(views, *views.shots[picture]));
    alone.erase(cameraIds[picture]);
  };
  for (const Rig& one : rigsOf(dataset))
  {
    ModelRig& rig = rigs.emplace_back();
    for (std::size_t i = 0; i < one.cameras.size() && firsts.count(one.cameras[i]) > 0; ++i)
    {
      add(rig, firsts.at(one.cameras[i]), one.fromFirst[i]);
    }
    if (rig.cameras.empty()) // its frames are in other models
    {
      rigs.pop_back();
    }
  }
  for (const auto& [id, picture] : std::map<std::uint32_t, std::size_t>(alone))
  {
    add(rigs.emplace_back(), picture, Rigid3());
  }
  return rigs;
}

/// One array for both of COLMAP's tools, each of which passes over the other's keys.
std::string configurationOf(const std::vector<ModelRig>& rigs)
{
  Json all = Json::array();
  for (const ModelRig& rig : rigs)
  {
    Json cameras = Json::array();
    for (std::size_t i = 0; i < rig.cameras.size() && rig.cameras.size() > 1; ++i)
    {
      const std::vector<double> n = poseNumbers(rig.fromFirst[i]);
      const Json rotation{ n[0], n[1], n[2], n[3] };
      const Json translation{ n[4], n[5], n[6] };
      Json camera{ { "camera_id", rig.cameras[i] }, { "image_prefix", rig.prefixes[i] }, { "rel_qvec", rotation },
        { "rel_tvec", translation } };
      if (i == 0)
      {
        camera["ref_sensor"] = true;
      }
      else
      {
        camera["cam_from_rig_rotation"] = rotation;
        camera["cam_from_rig_translation"] = translation;
      }
      cameras.push_back(camera);
    }
    if (!cameras.empty())
    {
      all.push_back({ { "ref_camera_id", rig.cameras[0] }, { "cameras", cameras } });
    }
  }
  return all.dump(1) + '\n';
}

/// Numbers one behind the other, as text or as bytes.
class Row
{
public:
  explicit Row(bool binary)
    : Binary(binary)
  {
  }
  template <typename Integer>
  Row& add(Integer number)
  {
    return this->put(std::to_string(number), number);
  }
  Row& sensor(std::uint32_t camera)
  {
    constexpr std::int32_t kind = 0; // a camera
    return this->put("CAMERA", kind).add(camera);
  }
  Row& pose(const Rigid3& pose)
  {
    for (const double number : poseNumbers(pose))
    {
      this->put(numbersLine({ number }), number);
    }
    return *this;
  }
  std::string text() const { return this->Text + (this->Binary ? "" : "\n"); }

private:
  template <typename Number>
  Row& put(const std::string& word, Number number)
  {
    if (this->Binary)
    {
      putLittle(this->Text, number);
    }
    else
    {
      this->Text += (this->Text.empty() ? "" : " ") + word;
    }
    return *this;
  }
  bool Binary;
  std::string Text;
};

std::string headOf(bool binary, const char* words, std::uint64_t count)
{
  return binary ? Row(true).add(count).text() : std::string("# ") + words + '\n';
}

std::string rigsText(const std::vector<ModelRig>& rigs, bool binary)
{
  std::string text = headOf(binary,
    "RIG_ID, NUM_SENSORS, REF_SENSOR_TYPE, REF_SENSOR_ID, SENSORS[] as (SENSOR_TYPE, SENSOR_ID, HAS_POSE, [QW, QX, QY, "
    "QZ, TX, TY, TZ])",
    rigs.size());
  for (std::size_t i = 0; i < rigs.size(); ++i)
  {
    const ModelRig& rig = rigs[i];
    Row row(binary);
    row.add(std::uint32_t(i + 1)).add(std::uint32_t(rig.cameras.size())).sensor(rig.cameras[0]);
    for (std::size_t k = 1; k < rig.cameras.size(); ++k)
    {
      row.sensor(rig.cameras[k]).add(std::uint8_t(1)).pose(rig.fromFirst[k]);
    }
    text += row.text();
  }
  return text;
}

/// Pictures of a rig at one of the dataset's frames.
using Instants = std::map<std::pair<int, std::uint32_t>, std::vector<std::uint32_t>>;

void writeFrames(ExportFile& file, const Views& views, const std::vector<std::uint32_t>& cameraIds,
  const std::vector<ModelRig>& rigs, bool binary)
{
  std::map<std::uint32_t, std::uint32_t> rigOf; // of a camera, from 1
  for (std::size_t i = 0; i < rigs.size(); ++i)
  {
    for (const std::uint32_t camera : rigs[i].cameras)
    {
      rigOf[camera] = std::uint32_t(i + 1);
    }
  }
  Instants instants;
  for (std::size_t i = 0; i < cameraIds.size(); ++i)
  {
    instants[{ views.shots[i]->frame(), rigOf.at(cameraIds[i]) }].push_back(std::uint32_t(i));
  }
  file.write(headOf(binary,
    "FRAME_ID, RIG_ID, RIG_FROM_WORLD[QW, QX, QY, QZ, TX, TY, TZ], NUM_DATA_IDS, DATA_IDS[] as (SENSOR_TYPE, "
    "SENSOR_ID, DATA_ID)",
    instants.size()));
  std::uint32_t number = 0;
  for (const auto& [place, pictures] : instants)
  {
    Row row(binary);
    row.add(++number).add(place.second).pose(cameraFromWorld(views.shots[pictures[0]]->camera));
    row.add(std::uint32_t(pictures.size()));
    for (const std::uint32_t picture : pictures)
    {
      row.sensor(cameraIds[picture]).add(std::uint64_t(picture + 1));
    }
    file.write(row.text());
  }
}
} // namespace

const SwitchOption& rigs()
{
  static const SwitchOption row("rigs", "COLMAP's rigs and frames of cameras that keep their places to each other");
  return row;
}

std::vector<Rig> rigsOf(const DatasetView& dataset)
{
  std::vector<Rig> rigs;
  std::vector<Shots> firsts; // of each rig's first camera
  for (const std::string& camera : dataset.cameras())
  {
    const Shots shots = dataset.shotsOf(camera);
    if (shots.size() < 2 || !hasOneMatrix(shots))
    {
      continue;
    }
    bool found = false;
    for (std::size_t i = 0; i < rigs.size() && !found; ++i)
    {
      if (const std::optional<Rigid3> pose = between(firsts[i], shots))
      {
        rigs[i].cameras.push_back(camera);
        rigs[i].fromFirst.push_back(*pose);
        found = true;
      }
    }
    if (!found)
    {
      rigs.push_back({ { camera }, { Rigid3() } });
      firsts.push_back(shots);
    }
  }
  rigs.erase(
    std::remove_if(rigs.begin(), rigs.end(), [](const Rig& rig) { return rig.cameras.size() < 2; }), rigs.end());
  return rigs;
}

void checkRigs(const DatasetView& dataset, const OptionValues& options, const std::string& format)
{
  if (!rigs().of(options))
  {
    return;
  }
  const std::vector<Rig> all = rigsOf(dataset);
  if (all.empty())
  {
    throw UsageError("rigs: no two cameras keep their places to each other through the frames, two at least");
  }
  const std::shared_ptr<const Views> views = viewsOf(dataset, options, PixelCentre::Half).front();
  std::map<std::string, std::string> prefixes; // by camera
  for (const std::string& camera : dataset.cameras())
  {
    prefixes[camera] = prefixOf(*views, *dataset.shotsOf(camera).front());
  }
  for (const Rig& rig : all)
  {
    for (const std::string& camera : rig.cameras)
    {
      const std::string& own = prefixes.at(camera);
      for (const auto& [other, prefix] : prefixes)
      {
        if (camera != other && prefix.find(own) != std::string::npos)
        {
          throw UsageError("rigs: " + format + " looks for " + quotedText(own) +
                           " anywhere in a picture's name, and it is in " + quotedText(prefix) +
                           ", too; rename camera " + quoted(camera));
        }
      }
    }
  }
}

std::vector<std::string> rigFiles(const std::string& folder, const OptionValues& options)
{
  const std::string extension = '.' + modelFormat().of(options);
  return rigs().of(options) ? std::vector<std::string>{ folder + "rigs" + extension, folder + "frames" + extension,
    folder + "rig_config.json" }
                            : std::vector<std::string>();
}

void writeRigs(ExportSink& sink, const DatasetView& dataset, const Views& views,
  const std::vector<std::uint32_t>& cameraIds, const std::vector<std::string>& files)
{
  if (files.empty())
  {
    return;
  }
  const bool binary = files[0].substr(files[0].size() - 4) == ".bin";
  const std::vector<ModelRig> all = rigsOfModel(dataset, views, cameraIds);
  sink.write(files[0], rigsText(all, binary));
  const std::unique_ptr<ExportFile> frames = sink.open(files[1]);
  writeFrames(*frames, views, cameraIds, all, binary);
  frames->finish();
  sink.write(files[2], configurationOf(all));
}

} // namespace dgtk::colmap
