// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetRecords.h"

#include "dgtkHash.h"
#include "dgtkObjectChanges.h"
#include "dgtkObjectTruth.h"
#include "dgtkPathNames.h"
#include "dgtkRepresentation.h"
#include "dgtkSystem.h"
#include "dgtkThreadPool.h"
#include "dgtkWorkTime.h"

#include <algorithm>
#include <set>

namespace dgtk
{

std::vector<InputRecord> inputsOf(const Stage& stage, const std::string& folder, RunSession& session)
{
  const std::vector<std::string> files = stage.inputFiles();
  std::vector<InputRecord> inputs(files.size());
  const auto news =
    std::count_if(files.begin(), files.end(), [&](const std::string& file) { return !session.knows(file); });
  ThreadPool(news > 1 ? machineThreads() : 1)
    .parallelFor(static_cast<int>(files.size()),
      [&](int i)
      {
        const WorkTime load(WorkStage::Load);
        inputs[static_cast<std::size_t>(i)] = session.fileOf(files[static_cast<std::size_t>(i)]);
      });
  PathNames names;
  for (InputRecord& record : inputs)
  {
    record.path = names.relative(record.path, folder);
  }
  return inputs;
}

std::vector<CameraRecord> cameraRecords(
  const WorkPlan& plan, const Stage& stage, const std::string& folder, const std::map<std::string, std::string>& copies)
{
  PathNames names;
  std::vector<Job> jobs = plan.jobs;
  std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) { return a.camera < b.camera; });
  std::vector<CameraRecord> records;
  for (const Job& job : jobs)
  {
    const View view = stage.view(job.camera, job.frame, plan.request.width, plan.request.height);
    CameraRecord record;
    record.name = view.name;
    record.frame = job.frame;
    record.width = view.model->width();
    record.height = view.model->height();
    const auto linear = view.model->linear();
    const CameraParameters& parameters = view.model->parameters();
    record.hasK = linear || parameters.K;
    record.K = linear ? linear->K : parameters.K.value_or(record.K);
    record.numbers = parameters.numbers;
    for (const auto& [name, file] : parameters.files)
    {
      const auto copy = copies.find(file);
      record.files[name] = copy != copies.end() ? copy->second : names.relative(file, folder);
    }
    record.rollingShutter = parameters.rollingShutter;
    record.R = view.camera_from_world.rotation;
    record.t = view.camera_from_world.translation;
    record.model = view.model->name();
    record.near = view.near;
    record.far = view.far;
    records.push_back(record);
  }
  return records;
}

std::vector<ObjectRecord> objectRecords(
  const Stage& stage, int frame, const std::string& folder, const std::map<std::string, std::string>& copies)
{
  PathNames names;
  const std::shared_ptr<const SceneState> state = stage.at(frame);
  const std::vector<std::uint32_t> classes = classIds(*state);
  const std::vector<ObjectChange> changes = ObjectChanges(stage).changes();
  std::vector<ObjectRecord> records;
  for (std::size_t i = 0; i < state->instances.size(); ++i)
  {
    const Instance& instance = state->instances[i];
    ObjectRecord record;
    record.id = static_cast<std::uint32_t>(i + 1);
    record.name = instance.name;
    record.objectClass = instance.className;
    record.classId = classes[i];
    const auto copy = copies.find(instance.model->path);
    record.model = copy != copies.end() ? copy->second : names.relative(instance.model->path, folder);
    record.triangles = instance.model->triangles.size();
    record.isStatic = !changes[i].moves && !changes[i].deforms;
    record.deforming = changes[i].deforms;
    records.push_back(record);
  }
  return records;
}

std::vector<PoseRecord> poseRecords(const WorkPlan& plan, const Stage& stage)
{
  std::set<int> frames;
  for (const Job& job : plan.jobs)
  {
    frames.insert(job.frame);
  }
  const ObjectChanges objects(stage);
  std::vector<PoseRecord> records;
  for (const int frame : frames)
  {
    const std::vector<PlacedObject> places = objects.placesAt(frame);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const Affine3& world_from_object = places[i].world_from_object;
      const PlacedAxes axes = placedAxes(world_from_object.linear);
      PoseRecord record;
      record.frame = frame;
      record.id = static_cast<std::uint32_t>(i + 1);
      record.visible = places[i].visible;
      record.matrix << world_from_object.linear, world_from_object.translation;
      record.rigid = axes.rigid;
      record.R = axes.rotation;
      record.t = world_from_object.translation;
      record.scale = axes.scale;
      records.push_back(record);
    }
  }
  return records;
}

std::vector<ClassRecord> classRecords(const Stage& stage)
{
  std::vector<ClassRecord> records;
  for (const ClassDescription& one : stage.description().classes)
  {
    records.push_back(
      { std::uint32_t(one.id), one.name, one.supercategory, one.thing, one.color, one.keypoints, one.skeleton });
  }
  return records;
}

namespace
{
std::string hashOf(const std::vector<std::pair<std::string, std::string>>& pairs)
{
  Sha256 hash;
  for (const auto& [key, value] : pairs)
  {
    hash.update(key.data(), key.size() + 1);
    hash.update(value.data(), value.size() + 1);
  }
  return hash.hex();
}
} // namespace

std::vector<std::pair<std::string, std::string>> requestOf(
  const WorkPlan& plan, const Stage& stage, const std::string& classNumbers)
{
  std::vector<std::pair<std::string, std::string>> pairs = describeRequest(plan, stage);
  if (!classNumbers.empty())
  {
    pairs.emplace_back(classesKey, classNumbers);
  }
  return pairs;
}

std::string identityOf(
  const WorkPlan& plan, const Stage& stage, const std::string& classNumbers, const std::vector<InputRecord>& inputs)
{
  std::vector<std::pair<std::string, std::string>> identity = requestOf(plan, stage, classNumbers);
  const SceneDescription& scene = stage.description();
  if (scene.file.empty())
  {
    identity.emplace_back("scene", toJson(scene, scene.folder));
  }
  for (const InputRecord& input : inputs)
  {
    identity.emplace_back(input.path, input.sha256);
  }
  return hashOf(identity);
}

} // namespace dgtk
