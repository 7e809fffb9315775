// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneJson_h
#define dgtkSceneJson_h

#include "dgtkSceneDescription.h"
#include "dgtkSceneRules.h"

#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace dgtk::scenefile
{

/// One row a key: how it is read, range-checked, and written when it is not the default. The order of the rows is that
/// of the canonical text.
template <typename T>
struct JsonField
{
  const char* key;
  void (*read)(const JsonCursor& at, T& into);
  void (*write)(const T& from, const char* key, JsonNode& object);
};

const std::vector<JsonField<ObjectDescription>>& objectFields();
const std::vector<JsonField<AnimationDescription>>& animationFields();
const std::vector<JsonField<MaterialOverride>>& materialFields();
const std::vector<JsonField<LightDescription>>& lightFields();
const std::vector<JsonField<CameraDescription>>& cameraFields();
const std::vector<JsonField<UnusedKeys>>& unusedFields();
const std::vector<JsonField<SceneDescription>>& sceneFields();
const std::vector<JsonField<EnvironmentDescription>>& environmentFields();
const std::vector<JsonField<FogDescription>>& fogFields();
const std::vector<JsonField<ShutterDescription>>& shutterFields();
const std::vector<JsonField<RollingShutter>>& rollingShutterFields();
const std::vector<JsonField<LensDescription>>& lensFields();
const std::vector<JsonField<ClassDescription>>& classFields();
JsonField<SceneDescription> classesRow();
JsonField<SceneDescription> datasetRow();
JsonField<SceneDescription> metresRow();
JsonField<ObjectDescription> keypointsRow();
JsonField<SceneDescription> backgroundRow();
JsonField<SceneDescription> environmentRow();
JsonField<SceneDescription> fogRow();

template <typename T>
std::vector<std::string> keysOf(const std::vector<JsonField<T>>& fields)
{
  std::vector<std::string> keys;
  keys.reserve(fields.size());
  for (const JsonField<T>& field : fields)
  {
    keys.emplace_back(field.key);
  }
  return keys;
}

/// Fails at a key that is none of these.
[[noreturn]] void failKey(const JsonCursor& at, std::size_t pair, const std::vector<std::string>& known);

/// Reads the members of an object by a table; `others` is called with the place of any other member.
template <typename T, typename Others>
void readFields(const JsonCursor& at, const std::vector<JsonField<T>>& fields, T& into, const Others& others)
{
  for (std::size_t i = 0, n = at.memberCount(); i < n; ++i)
  {
    const JsonField<T>* field = nullptr;
    for (const JsonField<T>& candidate : fields)
    {
      field = at.key(i) == candidate.key ? &candidate : field;
    }
    if (field)
    {
      field->read(at.member(i), into);
    }
    else
    {
      others(i);
    }
  }
}

/// An unknown key is an error.
template <typename T>
void readFields(const JsonCursor& at, const std::vector<JsonField<T>>& fields, T& into)
{
  readFields(at, fields, into, [&](std::size_t i) { failKey(at, i, keysOf(fields)); });
}

template <typename T>
JsonNode writeFields(const T& from, const std::vector<JsonField<T>>& fields)
{
  JsonNode object(JsonNode::Type::Object);
  for (const JsonField<T>& field : fields)
  {
    field.write(from, field.key, object);
  }
  return object;
}

void readModel(const JsonCursor& at, CameraDescription& camera);
void readCamera(const JsonCursor& at, UpAxis upAxis, CameraDescription& camera);
JsonNode writeCamera(const CameraDescription& camera, UpAxis upAxis);

/// Reads the contents of a .json scene; names are given, relations are checked. Without a file nothing has a line.
SceneDescription readJsonScene(const std::string& file, const std::string& folder, const std::string& contents);

/// Reads the file that `classFile` names into `classes`; nothing when it names none.
void readClassFile(SceneDescription& scene);
/// "classes" of a whole scene, and their file.
void readClassesOf(const JsonCursor& at, SceneDescription& scene);

/// The keys that the reader knows, by the name of the definition in the published schema.
DGTKSCENE_EXPORT std::map<std::string, std::vector<std::string>> jsonSceneKeys();

/// Text of a tree, two spaces an indentation, arrays of scalars and short arrays on one line; ends with a newline.
std::string printJson(const JsonNode& root);

// Values shared by the tables.

Eigen::Vector3d readScale(const JsonCursor& at); ///< a vector without zeros, or one number for all axes
Quaternion readQuaternion(const JsonCursor& at);
JsonNode writeValue(const Eigen::Vector3d& v);
JsonNode writeValue(const Quaternion& q);
/// The words of Interpolation, in the order of its values.
const std::vector<std::string>& interpolationWords();

inline bool readValue(const JsonCursor& at, const Range&, const bool*) { return at.boolean(); }
inline double readValue(const JsonCursor& at, const Range& range, const double*) { return at.number(range); }
inline Eigen::Vector3d readValue(const JsonCursor& at, const Range& range, const Eigen::Vector3d*)
{
  return &range == &rules::scale ? readScale(at) : at.vector(range);
}
inline Quaternion readValue(const JsonCursor& at, const Range&, const Quaternion*) { return readQuaternion(at); }
inline JsonNode writeValue(bool v) { return JsonNode::of(v); }
inline JsonNode writeValue(int v) { return JsonNode::of(double(v)); }
inline JsonNode writeValue(double v) { return JsonNode::of(v); }
inline JsonNode writeValue(const std::string& v) { return JsonNode::of(v); }
inline JsonNode writeValue(Interpolation v) { return JsonNode::of(interpolationWords()[static_cast<std::size_t>(v)]); }
/// What is true or false has steps, said or not.
template <typename T>
Interpolation readInterpolation(const JsonCursor& at)
{
  if constexpr (std::is_same_v<T, bool>)
  {
    at.oneOf({ "step" });
    return Track<T>().interpolation;
  }
  else
  {
    return static_cast<Interpolation>(at.oneOf(interpolationWords()));
  }
}

/// [frame, value] or [frame, value, interpolation]; frames must ascend.
template <typename T>
void readKeys(const JsonCursor& at, const Range& range, std::vector<Key<T>>& keys)
{
  const std::size_t n = at.listSize();
  keys.reserve(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const JsonCursor entry = at.element(i);
    const std::size_t parts = entry.node().children.size();
    if (entry.node().type != JsonNode::Type::Array || parts < 2 || parts > 3)
    {
      entry.failType("[frame, value] or [frame, value, interpolation]");
    }
    const JsonCursor frame = entry.element(0);
    Key<T> key;
    key.frame = static_cast<int>(frame.wholeNumber(rules::frame));
    if (!keys.empty() && key.frame <= keys.back().frame)
    {
      frame.fail(key.frame == keys.back().frame ? "is a key frame twice" : "is out of order",
        "more than " + std::to_string(keys.back().frame), std::to_string(key.frame));
    }
    key.value = readValue(entry.element(1), range, static_cast<const T*>(nullptr));
    if (parts == 3)
    {
      key.interpolation = readInterpolation<T>(entry.element(2));
    }
    keys.push_back(key);
  }
}

/// A constant, or {"value", "keys", "interpolation"}.
template <typename T>
void readTrack(const JsonCursor& at, const Range& range, Track<T>& track)
{
  if (at.node().type != JsonNode::Type::Object)
  {
    track.value = readValue(at, range, static_cast<const T*>(nullptr));
    return;
  }
  bool hasValue = false;
  for (std::size_t i = 0, n = at.memberCount(); i < n; ++i)
  {
    const JsonCursor member = at.member(i);
    if (at.key(i) == "value")
    {
      track.value = readValue(member, range, static_cast<const T*>(nullptr));
      hasValue = true;
    }
    else if (at.key(i) == "keys")
    {
      readKeys(member, range, track.keys);
    }
    else if (at.key(i) == "interpolation")
    {
      track.interpolation = readInterpolation<T>(member);
    }
    else
    {
      failKey(at, i, { "value", "keys", "interpolation" });
    }
  }
  if (track.keys.empty())
  {
    at.fail("has no key frames", "a list of [frame, value] under \"keys\"");
  }
  if (!hasValue)
  {
    track.value = track.keys.front().value;
  }
}

template <typename T>
JsonNode writeTrack(const Track<T>& track)
{
  if (!track.animated())
  {
    return writeValue(track.value);
  }
  JsonNode object(JsonNode::Type::Object);
  if (!(track.value == track.keys.front().value))
  {
    object.add("value", writeValue(track.value));
  }
  JsonNode keys(JsonNode::Type::Array);
  for (const Key<T>& key : track.keys)
  {
    JsonNode entry(JsonNode::Type::Array);
    entry.children.push_back(JsonNode::of(double(key.frame)));
    entry.children.push_back(writeValue(key.value));
    if (key.interpolation && !std::is_same_v<T, bool>)
    {
      entry.children.push_back(writeValue(*key.interpolation));
    }
    keys.children.push_back(std::move(entry));
  }
  object.add("keys", std::move(keys));
  if (track.interpolation != Interpolation::Linear && !std::is_same_v<T, bool>)
  {
    object.add("interpolation", writeValue(track.interpolation));
  }
  return object;
}

template <typename T>
bool isConstant(const Track<T>& track, const T& value)
{
  return !track.animated() && track.value == value;
}

} // namespace dgtk::scenefile

#endif
