// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetScenes.h"

#include "dgtkError.h"
#include "dgtkFolder.h"
#include "dgtkHash.h"
#include "dgtkJournal.h"
#include "dgtkSceneFolders.h"

#include <algorithm>

namespace dgtk
{

namespace
{
bool alike(const ClassRecord& a, const ClassRecord& b)
{
  return a.id == b.id && a.name == b.name && a.keypoints == b.keypoints && a.thing == b.thing;
}

std::uint32_t largestObjectIn(const std::string& folder)
{
  std::uint32_t largest = 0;
  for (const ObjectRecord& object : readObjects(Folder(folder).fileAt("objects.json")))
  {
    largest = std::max(largest, object.id);
  }
  return largest;
}
} // namespace

DatasetScenes::DatasetScenes(const std::string& folder, const DatasetSelection& selection)
{
  const std::vector<std::string> names = sceneFoldersIn(folder);
  this->Many = !names.empty();
  if (!this->Many)
  {
    this->add(folder, selection, {});
    this->Hash = this->first().manifestHash();
    return;
  }
  this->Hash = Sha256::ofFile(Folder(folder).fileAt(manifestName));
  SceneOfMany scene;
  scene.count = static_cast<int>(names.size());
  for (const std::string& name : names)
  {
    scene.largestObject = std::max(scene.largestObject, largestObjectIn(folder + '/' + name));
  }
  for (const std::string& name : names)
  {
    scene.name = name;
    this->add(folder + '/' + name, selection, scene);
    scene.shotsBefore += this->Views.back()->shots().size();
    ++scene.place;
  }
  this->requireAlike();
}

void DatasetScenes::add(const std::string& folder, const DatasetSelection& selection, const SceneOfMany& scene)
{
  this->Views.push_back(std::make_unique<const DatasetView>(folder, selection, scene));
  this->Pointers.push_back(this->Views.back().get());
}

void DatasetScenes::requireAlike() const
{
  const DatasetView& one = this->first();
  SafeNames safe;
  for (const DatasetView* other : this->Pointers)
  {
    const std::string both = quoted(one.scene().name) + " and " + quoted(other->scene().name);
    if (!std::equal(
          one.classes().begin(), one.classes().end(), other->classes().begin(), other->classes().end(), alike))
    {
      throw UsageError(
        "the scenes " + both +
        " have other classes, or other numbers for them; a file of classes that all scenes name fixes them");
    }
    if (one.knowsMetres() != other->knowsMetres() || (one.knowsMetres() && one.metres() != other->metres()))
    {
      throw UsageError("the scenes " + both + " have units of other lengths, which one export of all cannot say");
    }
    for (const std::string& camera : other->cameras())
    {
      if (SafeNames().of(camera) != safe.of(camera))
      {
        throw UsageError(
          "the scenes have two cameras whose names differ only in characters that formats cannot have: " +
          quoted(camera));
      }
    }
  }
}

} // namespace dgtk
