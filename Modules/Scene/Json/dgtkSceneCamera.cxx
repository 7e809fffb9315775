// SPDX-License-Identifier: BSD-3-Clause
// A camera in .json and as its model is made: which keys it has is said by the rows of the model.
#include "dgtkError.h"
#include "dgtkSceneJson.h"
#include "dgtkText.h"

#include <algorithm>
#include <utility>

namespace dgtk::scenefile
{

namespace
{
using Camera = CameraDescription;
/// Parameters of models that have members of their own, in cameraFields().
constexpr const char* ownMembers[] = { "fovY", "aspect", "K", "viewHeight" };

bool isOwnMember(const std::string& name)
{
  return std::find(std::begin(ownMembers), std::end(ownMembers), name) != std::end(ownMembers);
}

void refuseTogether(const JsonCursor& at, const char* first, const char* second)
{
  if (!at.node().find(first) || !at.node().find(second))
  {
    return;
  }
  for (std::size_t i = 0; i < at.memberCount(); ++i)
  {
    if (at.key(i) == second)
    {
      at.member(i).fail(std::string("does not go together with ") + first, "one of them");
    }
  }
}

bool isOfAnyModel(const std::string& name)
{
  const std::vector<CameraRow>& rows = cameraRows();
  return std::any_of(
    rows.begin(), rows.end(), [&](const CameraRow& row) { return findCamera(row.model)->find(name) != nullptr; });
}

[[noreturn]] void failForeign(const JsonCursor& at, std::size_t i, const CameraEntry& model, const std::string& name)
{
  std::vector<std::string> has;
  for (const CameraParameter& parameter : model.parameters)
  {
    has.push_back(parameter.name);
  }
  at.member(i).fail("is not for a camera of the model " + quoted(name), has.empty() ? "no such key" : joined(has),
    at.member(i).node().described());
}

/// One number, or one of the counts in a list.
void readParameter(const JsonCursor& at, const CameraParameter& parameter, CameraValue& value)
{
  if (parameter.kind == CameraParameter::Kind::File)
  {
    value.file = at.string(false);
    return;
  }
  if (parameter.counts == std::vector<std::size_t>{ 1 })
  {
    value.numbers.resize(1);
    if (parameter.moves)
    {
      readTrack(at, parameter.range, value.numbers[0]);
    }
    else
    {
      value.numbers[0] = at.number(parameter.range);
    }
    return;
  }
  const std::size_t count = at.listSize();
  if (std::find(parameter.counts.begin(), parameter.counts.end(), count) == parameter.counts.end())
  {
    at.fail("has the wrong length", countsText(parameter) + " numbers", std::to_string(count));
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    value.numbers.emplace_back(at.element(i).number(parameter.range));
  }
}

/// Nothing for a usual value.
void writeParameter(const Camera& camera, const std::string& name, const CameraValue& value, JsonNode& node)
{
  const CameraEntry* const model = findCamera(camera.model);
  const CameraParameter* const parameter = model ? model->find(name) : nullptr;
  const std::vector<double> usual = parameter ? parameter->usual : std::vector<double>();
  const auto& numbers = value.numbers;
  if (!value.file.empty())
  {
    node.add(name, JsonNode::of(value.file));
    return;
  }
  if (std::equal(numbers.begin(), numbers.end(), usual.begin(), usual.end(), isConstant<double>))
  {
    return;
  }
  if (numbers.size() == 1 && !(parameter && parameter->counts.size() > 1))
  {
    node.add(name, writeTrack(numbers.front()));
    return;
  }
  JsonNode list(JsonNode::Type::Array);
  for (const Track<double>& number : numbers)
  {
    list.children.push_back(writeTrack(number));
  }
  node.add(name, std::move(list));
}
} // namespace

void readModel(const JsonCursor& at, Camera& camera)
{
  std::vector<std::string> words;
  for (const CameraRow& row : cameraRows())
  {
    words.push_back(row.model);
  }
  camera.model = words[at.oneOf(words)];
}

void readCamera(const JsonCursor& at, UpAxis upAxis, Camera& camera)
{
  if (upAxis == UpAxis::Z)
  {
    camera.up.value = { 0, 0, 1 };
  }
  for (std::size_t i = 0, n = at.memberCount(); i < n; ++i)
  {
    if (at.key(i) == "model") // says which other keys there are
    {
      readModel(at.member(i), camera);
    }
  }
  const CameraEntry& model = *findCamera(camera.model);
  const auto readOwn = [&](std::size_t i)
  {
    const CameraParameter* const parameter = model.find(at.key(i));
    if (parameter == nullptr && isOfAnyModel(at.key(i)))
    {
      failForeign(at, i, model, camera.model);
    }
    if (parameter == nullptr)
    {
      std::vector<std::string> known = keysOf(cameraFields());
      for (const CameraParameter& own : ownParameters(camera.model))
      {
        known.push_back(own.name);
      }
      failKey(at, i, known);
    }
    readParameter(at.member(i), *parameter, camera.parameters[at.key(i)]);
  };
  readFields(at, cameraFields(), camera, readOwn);
  const JsonNode& node = at.node();
  for (const char* lookAtKey : { "eye", "lookAt", "up" })
  {
    refuseTogether(at, lookAtKey, "position");
    refuseTogether(at, lookAtKey, "orientation");
  }
  refuseTogether(at, "K", "fovY");
  camera.posed = node.find("position") || node.find("orientation");
  const bool whole =
    camera.posed ? node.find("position") && node.find("orientation") : node.find("eye") && node.find("lookAt");
  if (!whole)
  {
    at.fail("has no pose", "eye and lookAt, or position and orientation");
  }
  for (std::size_t i = 0, n = at.memberCount(); i < n; ++i)
  {
    if (isOwnMember(at.key(i)) && model.find(at.key(i)) == nullptr)
    {
      failForeign(at, i, model, camera.model);
    }
  }
}

JsonNode writeCamera(const CameraDescription& camera, UpAxis upAxis)
{
  JsonNode node = writeFields(camera, cameraFields());
  const Eigen::Vector3d usual = upAxis == UpAxis::Z ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(0, 1, 0);
  if (!camera.posed && isConstant(camera.up, usual))
  {
    for (auto key = node.children.begin(); key != node.children.end(); key += 2)
    {
      if (key->text == "up")
      {
        node.children.erase(key, key + 2);
        break;
      }
    }
  }
  for (const auto& [name, value] : camera.parameters)
  {
    writeParameter(camera, name, value, node);
  }
  return node;
}

} // namespace dgtk::scenefile

namespace dgtk
{

bool hasParameter(const CameraDescription& camera, const std::string& name)
{
  const CameraEntry* const model = findCamera(camera.model);
  return model != nullptr && model->find(name) != nullptr;
}

std::vector<CameraParameter> ownParameters(const std::string& model)
{
  std::vector<CameraParameter> own;
  if (const CameraEntry* const entry = findCamera(model))
  {
    std::copy_if(entry->parameters.begin(), entry->parameters.end(), std::back_inserter(own),
      [](const CameraParameter& parameter) { return !scenefile::isOwnMember(parameter.name); });
  }
  return own;
}

CameraParameters cameraParameters(
  const CameraDescription& camera, double frame, int width, int height, const std::string& folder)
{
  CameraParameters made{ width, height, camera.K };
  if (made.K)
  {
    made.K->row(0) *= double(width) / camera.width;
    made.K->row(1) *= double(height) / camera.height;
  }
  const CameraEntry* const model = findCamera(camera.model);
  const std::pair<const char*, double> members[] = { { "fovY", boundedAt(camera.fovY, frame) },
    { "aspect", camera.aspect }, { "viewHeight", boundedAt(camera.viewHeight, frame) } };
  for (const auto& [name, number] : members)
  {
    const CameraParameter* const parameter = model ? model->find(name) : nullptr;
    if (parameter && !(made.K && parameter->saidByK))
    {
      made.numbers[name] = { number };
    }
  }
  made.rollingShutter = camera.rollingShutter;
  SceneDescription place;
  place.folder = folder;
  for (const auto& [name, value] : camera.parameters)
  {
    if (!value.file.empty())
    {
      made.files[name] = place.resolve(value.file);
    }
    for (const Track<double>& number : value.numbers)
    {
      made.numbers[name].push_back(boundedAt(number, frame));
    }
  }
  return made;
}

} // namespace dgtk
