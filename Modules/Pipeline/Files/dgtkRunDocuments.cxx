// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRunDocuments.h"

#include "dgtkDatasetRecords.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkGeometryHash.h"
#include "dgtkLayers.h"
#include "dgtkRunNotes.h"
#include "dgtkRunParts.h"

#include "dgtkContactSheet.h"
#include "dgtkDatasetDocuments.h"
#include "dgtkNameTable.h"

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

namespace dgtk
{

namespace
{
// beside the manifest
constexpr const char* camerasName = "cameras.json";
constexpr const char* objectsName = "objects.json";
constexpr const char* sceneName = "scene.json";
constexpr const char* sheetName = "contact.png";
} // namespace

std::vector<std::string> filesOf(const WorkPlan& plan, const Stage& stage, const Job& job)
{
  std::vector<std::string> names;
  for (const LayerOutput& output : outputsOf(plan, stage, job))
  {
    const std::vector<std::string> own = output.files();
    names.insert(names.end(), own.begin(), own.end());
  }
  return names;
}

RunDocuments::RunDocuments(const Stage& stage, const WorkPlan& plan, const std::string& home, const std::string& folder,
  RunSession& session, const std::string& classNumbers)
  : Scene(stage)
  , Plan(plan)
  , Home(home)
  , Root(folder)
  , ClassNumbers(classNumbers)
  , Geometry(geometryHashes(stage))
{
  refuseOwnInputs(stage, home);
  if (option::pack().of(plan.request.options))
  {
    this->Packed = planPacking(stage, home);
  }
  this->Inputs = recordedInputs(stage, home, this->Packed ? &*this->Packed : nullptr, session);
  this->RequestHash = identityOf(plan, stage, classNumbers, this->Inputs);
  if (option::models().of(plan.request.options))
  {
    this->Models.emplace(stage, this->Geometry);
  }
}

void RunDocuments::pack(RunFiles& run)
{
  if (!this->Packed || !this->isFirst())
  {
    return;
  }
  const std::vector<std::string> files = this->Scene.inputFiles();
  std::map<std::string, std::string> hashes;
  for (const InputRecord& input : this->Inputs)
  {
    hashes[input.path] = input.sha256;
  }
  std::set<std::string> there; // a file may have two spellings
  for (const std::string& file : files)
  {
    const std::string& to = this->Packed->copies.at(file);
    if (!there.insert(to).second)
    {
      continue;
    }
    if (run.keep({ to }, {}))
    {
      continue;
    }
    Folder(this->Root).makeParents(to);
    run.plan({ to });
    const DatasetFile copy = writeDocument(this->Root, to, readFile(file));
    if (copy.sha256 != hashes.at(to))
    {
      throw InputError(file, "changed while it was copied");
    }
    run.add(copy);
  }
  Packing placed = *this->Packed;
  placed.scene.folder = this->Root; // of a part
  checkPacking(placed, this->Scene);
}

void RunDocuments::writeModels(RunFiles& files) const
{
  if (this->Models && this->isFirst())
  {
    this->Models->write(this->Root, files);
  }
}

std::map<std::string, std::string> RunDocuments::copies() const
{
  return this->Packed ? this->Packed->copies : std::map<std::string, std::string>();
}

/// Of a whole dataset, or its first part: what all parts would have alike is there alone.
bool RunDocuments::isFirst() const { return this->Root == this->Home || this->Root == this->Home + '/' + partName(0); }

/// Of a whole dataset: parts have not all pictures.
bool RunDocuments::wantsSheet() const
{
  return this->Home == this->Root && option::contactSheet().of(this->Plan.request.options);
}

std::vector<std::string> RunDocuments::documentNames() const
{
  std::vector<std::string> names = { camerasName, objectsName, posesName, sceneName };
  if (this->wantsSheet())
  {
    names.emplace_back(sheetName);
  }
  return names;
}

std::vector<std::string> RunDocuments::allNames() const
{
  std::vector<std::string> names = this->documentNames();
  for (const auto& [file, copy] : this->copies())
  {
    names.push_back(copy);
  }
  const std::vector<std::string> models = this->Models ? this->Models->names() : std::vector<std::string>();
  names.insert(names.end(), models.begin(), models.end());
  for (const Job& job : this->Plan.jobs)
  {
    const std::vector<std::string> own = filesOf(this->Plan, this->Scene, job);
    names.insert(names.end(), own.begin(), own.end());
  }
  return names;
}

JudgeOfFiles RunDocuments::judge() const
{
  struct Layers
  {
    std::vector<std::string> names;
    NameTable files; ///< with the number of the job, and that of the layer, from 1
  };
  const auto known = std::make_shared<Layers>();
  const auto visit = [this](const auto& take)
  {
    for (std::size_t job = 0; job < this->Plan.jobs.size(); ++job)
    {
      for (const LayerOutput& output : outputsOf(this->Plan, this->Scene, this->Plan.jobs[job]))
      {
        for (const std::string& name : output.files())
        {
          take(job, output.layer, name);
        }
      }
    }
  };
  visit([&](std::size_t, const std::string&, const std::string& name) { known->files.add(name); });
  known->files.finish();
  visit(
    [&](std::size_t job, const std::string& layer, const std::string& name)
    {
      const auto at = std::find(known->names.begin(), known->names.end(), layer);
      const auto number = static_cast<std::uint64_t>(at - known->names.begin()) + 1;
      if (at == known->names.end())
      {
        known->names.push_back(layer);
      }
      *known->files.numberOf(name) = std::uint64_t(job) << 32 | number;
    });
  return [this, known](const DatasetFile& file) -> std::string
  {
    const std::uint64_t* number = known->files.numberOf(file.path);
    if (!number && file.camera.empty() && file.frame == -1)
    {
      return ""; // a document, or what layers share
    }
    if (!number)
    {
      return dgtk::quoted(file.path) + " is listed as a picture's, and is no file of the run";
    }
    const Job& job = this->Plan.jobs[*number >> 32];
    const DatasetFile right{ file.path, file.bytes, file.sha256, known->names[(*number & 0xffffffff) - 1],
      this->Scene.description().cameras[job.camera].name, job.frame };
    const auto words = [](const DatasetFile& one)
    {
      return "layer " + dgtk::quoted(one.layer) + ", camera " + dgtk::quoted(one.camera) + ", frame " +
             std::to_string(one.frame);
    };
    return words(file) == words(right) ? ""
                                       : dgtk::quoted(file.path) + " is listed as another picture's (expected " +
                                           words(right) + ", found " + words(file) + ')';
  };
}

Manifest RunDocuments::manifest(const std::vector<std::string>& warnings) const
{
  Manifest manifest;
  manifest.version = DGTK_VERSION;
  manifest.requestHash = this->RequestHash;
  manifest.request = requestOf(this->Plan, this->Scene, this->ClassNumbers);
  const SceneDescription& scene = this->Scene.description();
  manifest.units = scene.units;
  manifest.metresPerUnit = scene.metres();
  manifest.fps = scene.fps;
  manifest.info = scene.dataset;
  manifest.inputs = this->Inputs;
  std::set<std::pair<std::string, std::string>> listed; // classes are the same beside each format of their layer
  for (const PlannedLayer& planned : this->Plan.layers)
  {
    for (const std::string& format : planned.formats)
    {
      for (const LayerRecord& record : planned.layer->records(this->Plan, format))
      {
        if (listed.emplace(record.spec.name, record.format).second)
        {
          manifest.layers.push_back(record);
        }
      }
    }
  }
  manifest.empty = this->Plan.empty;
  for (const std::string& line : warnings)
  {
    manifest.warnings.push_back(placelessLine(line, scene));
  }
  return manifest;
}

std::size_t RunDocuments::write(RunFiles& files, const std::vector<std::string>& warnings)
{
  Manifest manifest = this->manifest(warnings);
  manifest.files = files.files();
  if (!this->isFirst())
  {
    files.close(manifest);
    return 0;
  }
  files.plan(this->documentNames());
  const std::size_t pictures = manifest.files.size();
  manifest.files.push_back(writeDocument(
    this->Root, camerasName, camerasText(cameraRecords(this->Plan, this->Scene, this->Home, this->copies()))));
  std::vector<ObjectRecord> objects =
    objectRecords(this->Scene, this->Plan.jobs.front().frame, this->Home, this->copies());
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    objects[i].geometry = this->Geometry[i];
    objects[i].geometryFile = this->Models ? WrittenModels::nameOf(this->Geometry[i]) : "";
  }
  manifest.files.push_back(
    writeDocument(this->Root, objectsName, objectsText(std::move(objects), classRecords(this->Scene))));
  manifest.files.push_back(writeDocument(this->Root, posesName, posesText(poseRecords(this->Plan, this->Scene))));
  manifest.files.push_back(writeDocument(
    this->Root, sceneName, toJson(this->Packed ? this->Packed->scene : this->Scene.description(), this->Home)));
  if (this->wantsSheet())
  {
    manifest.files.push_back(writeContactSheet(this->Root, manifest, sheetName));
  }
  files.close(manifest);
  return manifest.files.size() - pictures;
}

} // namespace dgtk
