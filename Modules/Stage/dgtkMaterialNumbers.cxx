// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMaterialNumbers.h"

#include "dgtkSceneTracks.h"

namespace dgtk
{

namespace
{
void append(std::vector<double>& numbers, double value) { numbers.push_back(value); }
void append(std::vector<double>& numbers, const Eigen::Vector3d& value)
{
  numbers.insert(numbers.end(), value.data(), value.data() + value.size());
}

bool moves(const ObjectDescription& object)
{
  bool any = false;
  for (const MaterialOverride& change : object.materials)
  {
    forEachTrackOf(change, [&any](const auto& track) { any = any || track.animated(); });
  }
  return any;
}
} // namespace

bool isFor(const MaterialOverride& change, const Material& material)
{
  return change.material == "*" || change.material == material.name;
}

void overrideNumbers(const MaterialOverride& change, double frame, Material& material)
{
  const auto put = [frame](const auto& track, auto& value)
  {
    if (track)
    {
      value = boundedAt(*track, frame);
    }
  };
  put(change.ambient, material.ambient);
  put(change.diffuse, material.diffuse);
  put(change.specular, material.specular);
  if (!material.isDark)
  {
    put(change.emission, material.emission);
  }
  put(change.shininess, material.shininess);
  put(change.opacity, material.opacity);
  put(change.bumpScale, material.bumpScale);
  if (change.metallic || change.roughness)
  {
    material.physical = material.physical.value_or(Material::Physical());
    put(change.metallic, material.physical->metallic);
    put(change.roughness, material.physical->roughness);
    material.physical->wanted = true;
  }
}

MaterialList MaterialNumbers::at(const ObjectDescription& object, const MaterialList& look, double frame)
{
  if (!moves(object))
  {
    return look;
  }
  std::vector<double> numbers;
  for (const MaterialOverride& change : object.materials)
  {
    forEachTrackOf(change, [&](const auto& track) { append(numbers, boundedAt(track, frame)); });
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  Made& made = this->Latest[object.name];
  if (made.look != look || made.numbers != numbers)
  {
    auto materials = std::make_shared<std::vector<Material>>(*look);
    for (const MaterialOverride& change : object.materials)
    {
      for (Material& material : *materials)
      {
        if (isFor(change, material))
        {
          overrideNumbers(change, frame, material);
        }
      }
    }
    made = { look, std::move(numbers), std::move(materials) };
  }
  return made.materials;
}

} // namespace dgtk
