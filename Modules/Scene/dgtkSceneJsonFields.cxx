// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneJson.h"

namespace dgtk::scenefile
{

namespace
{
using Object = ObjectDescription;
using Animation = AnimationDescription;
using Light = LightDescription;
using Camera = CameraDescription;

// How a member of each type is read.

void readInto(const JsonCursor& at, const Range&, std::string& into) { into = at.string(); }
void readInto(const JsonCursor& at, const Range&, bool& into) { into = at.boolean(); }
void readInto(const JsonCursor& at, const Range& range, int& into) { into = static_cast<int>(at.wholeNumber(range)); }
void readInto(const JsonCursor& at, const Range& range, double& into) { into = at.number(range); }
void readInto(const JsonCursor& at, const Range& range, Eigen::Vector3d& into) { into = at.vector(range); }
template <typename T>
void readInto(const JsonCursor& at, const Range& range, Track<T>& into)
{
  readTrack(at, range, into);
}
template <typename T>
void readInto(const JsonCursor& at, const Range& range, std::optional<T>& into)
{
  into.emplace();
  readInto(at, range, *into);
}

// How it is written, and when it is its default.

template <typename T>
void add(JsonNode& object, const char* key, const T& value, const T& usual)
{
  if (!(value == usual))
  {
    object.add(key, writeValue(value));
  }
}
void add(JsonNode& object, const char* key, const std::string& value, const std::string& usual)
{
  if (value != usual)
  {
    object.add(key, JsonNode::of(value));
  }
}
void add(JsonNode& object, const char* key, bool value, bool usual)
{
  if (value != usual)
  {
    object.add(key, JsonNode::of(value));
  }
}
template <typename T>
void add(JsonNode& object, const char* key, const Track<T>& track, const Track<T>& usual)
{
  if (!isConstant(track, usual.value))
  {
    object.add(key, writeTrack(track));
  }
}
template <typename T>
void add(JsonNode& object, const char* key, const std::optional<T>& value, const std::optional<T>&)
{
  if (value)
  {
    object.add(key, writeValue(*value));
  }
}

template <typename C, typename M>
C classOf(M C::*);

/// The row of a plain member; its default is that of the struct.
template <auto Member, const Range& range = rules::none>
auto row(const char* key)
{
  using T = decltype(classOf(Member));
  return JsonField<T>{ key, [](const JsonCursor& at, T& into) { readInto(at, range, into.*Member); },
    [](const T& from, const char* name, JsonNode& object)
    {
      static const T usual;
      add(object, name, from.*Member, usual.*Member);
    } };
}

/// The row of a text that is never empty and always written.
template <auto Member>
auto textRow(const char* key)
{
  using T = decltype(classOf(Member));
  return JsonField<T>{ key, [](const JsonCursor& at, T& into) { into.*Member = at.string(false); },
    [](const T& from, const char* name, JsonNode& object) { object.add(name, JsonNode::of(from.*Member)); } };
}

/// The row of one of several words; the first is the default.
template <auto Member, const std::vector<std::string>& (*words)()>
auto wordRow(const char* key)
{
  using T = decltype(classOf(Member));
  return JsonField<T>{ key,
    [](const JsonCursor& at, T& into)
    { into.*Member = static_cast<std::decay_t<decltype(into.*Member)>>(at.oneOf(words())); },
    [](const T& from, const char* name, JsonNode& object)
    {
      const auto index = static_cast<std::size_t>(from.*Member);
      if (index != 0)
      {
        object.add(name, JsonNode::of(words()[index]));
      }
    } };
}

/// The row of a struct that has a table of its own.
template <auto Member, auto fields>
auto structRow(const char* key)
{
  using T = decltype(classOf(Member));
  return JsonField<T>{ key, [](const JsonCursor& at, T& into) { readFields(at, fields(), into.*Member); },
    [](const T& from, const char* name, JsonNode& object)
    {
      JsonNode child = writeFields(from.*Member, fields());
      if (!child.children.empty())
      {
        object.add(name, std::move(child));
      }
    } };
}

/// The row of one half of a camera's pose; it is written when the camera is posed that way, default or not.
template <auto Member, const Range& range, bool posed>
auto poseRow(const char* key)
{
  return JsonField<Camera>{ key, [](const JsonCursor& at, Camera& into) { readInto(at, range, into.*Member); },
    [](const Camera& from, const char* name, JsonNode& object)
    {
      if (from.posed == posed)
      {
        object.add(name, writeTrack(from.*Member));
      }
    } };
}

const std::vector<std::string>& lightWords()
{
  static const std::vector<std::string> words{ "point", "head", "directional", "spot" };
  return words;
}

const std::vector<std::string>& cameraWords()
{
  static const std::vector<std::string> words{ "pinhole", "orthographic" };
  return words;
}

void readMaterials(const JsonCursor& at, Object& object)
{
  for (std::size_t i = 0, n = at.memberCount(); i < n; ++i)
  {
    MaterialOverride material;
    material.material = at.key(i);
    const std::string fault = faultOfText(material.material, false);
    const JsonCursor member = at.member(i);
    if (!fault.empty())
    {
      member.fail("cannot be used", fault);
    }
    readFields(member, materialFields(), material);
    object.materials.push_back(material);
  }
}

void writeMaterials(const Object& object, const char* key, JsonNode& node)
{
  JsonNode materials(JsonNode::Type::Object);
  for (const MaterialOverride& material : object.materials)
  {
    materials.add(material.material, writeFields(material, materialFields()));
  }
  if (!materials.children.empty())
  {
    node.add(key, std::move(materials));
  }
}

void readCameraName(const JsonCursor& at, Camera& camera)
{
  camera.name = at.string(false);
  const std::string fault = faultOfCameraName(camera.name);
  if (!fault.empty())
  {
    at.fail("cannot be used", fault, at.node().described());
  }
}

void readCameraMatrix(const JsonCursor& at, Camera& camera) { camera.K = at.cameraMatrix(); }

void writeCameraMatrix(const Camera& camera, const char* key, JsonNode& node)
{
  if (camera.K)
  {
    JsonNode rows(JsonNode::Type::Array);
    for (int i = 0; i < 3; ++i)
    {
      rows.children.push_back(writeValue(Eigen::Vector3d(camera.K->row(i))));
    }
    node.add(key, std::move(rows));
  }
}
} // namespace

const std::vector<std::string>& interpolationWords()
{
  static const std::vector<std::string> words{ "linear", "step", "smooth" };
  return words;
}

JsonNode writeValue(const Eigen::Vector3d& v)
{
  JsonNode list(JsonNode::Type::Array);
  list.children = { JsonNode::of(v[0]), JsonNode::of(v[1]), JsonNode::of(v[2]) };
  return list;
}

JsonNode writeValue(const Quaternion& q)
{
  JsonNode list(JsonNode::Type::Array);
  list.children = { JsonNode::of(q.w), JsonNode::of(q.x), JsonNode::of(q.y), JsonNode::of(q.z) };
  return list;
}

const std::vector<JsonField<Object>>& objectFields()
{
  static const std::vector<JsonField<Object>> fields{
    textRow<&Object::name>("name"),
    row<&Object::className>("class"),
    textRow<&Object::model>("model"),
    row<&Object::parent>("parent"),
    row<&Object::visible>("visible"),
    row<&Object::position, rules::coordinate>("position"),
    row<&Object::orientation>("orientation"),
    row<&Object::scale, rules::scale>("scale"),
    structRow<&Object::animation, animationFields>("animation"),
    { "materials", readMaterials, writeMaterials },
    row<&Object::skin>("skin"),
  };
  return fields;
}

const std::vector<JsonField<Animation>>& animationFields()
{
  static const std::vector<JsonField<Animation>> fields{
    row<&Animation::sequence>("sequence"),
    row<&Animation::start, rules::startFrame>("start"),
    row<&Animation::offset, rules::modelFrame>("offset"),
    row<&Animation::rate, rules::rate>("rate"),
    row<&Animation::loop>("loop"),
  };
  return fields;
}

const std::vector<JsonField<MaterialOverride>>& materialFields()
{
  static const std::vector<JsonField<MaterialOverride>> fields{
    row<&MaterialOverride::ambient, rules::unit>("ambient"),
    row<&MaterialOverride::diffuse, rules::unit>("diffuse"),
    row<&MaterialOverride::specular, rules::unit>("specular"),
    row<&MaterialOverride::emission, rules::unit>("emission"),
    row<&MaterialOverride::shininess, rules::exponent>("shininess"),
    row<&MaterialOverride::opacity, rules::unit>("opacity"),
    row<&MaterialOverride::texture>("texture"),
  };
  return fields;
}

const std::vector<JsonField<UnusedKeys>>& unusedFields()
{
  static const std::vector<JsonField<UnusedKeys>> fields{
    row<&UnusedKeys::orientation>("orientation"),
    row<&UnusedKeys::scale, rules::scale>("scale"),
  };
  return fields;
}

const std::vector<JsonField<Light>>& lightFields()
{
  static const std::vector<JsonField<Light>> fields{
    textRow<&Light::name>("name"),
    wordRow<&Light::kind, lightWords>("kind"),
    row<&Light::enabled>("enabled"),
    row<&Light::position, rules::coordinate>("position"),
    row<&Light::target, rules::coordinate>("target"),
    row<&Light::ambient, rules::light>("ambient"),
    row<&Light::diffuse, rules::light>("diffuse"),
    row<&Light::specular, rules::light>("specular"),
    row<&Light::attenuation, rules::light>("attenuation"),
    row<&Light::coneAngle, rules::coneAngle>("coneAngle"),
    row<&Light::exponent, rules::exponent>("exponent"),
    row<&Light::intensity, rules::light>("intensity"),
    structRow<&Light::unused, unusedFields>("unused"),
  };
  return fields;
}

const std::vector<JsonField<Camera>>& cameraFields()
{
  static const std::vector<JsonField<Camera>> fields{
    { "name", readCameraName, textRow<&Camera::name>("name").write },
    wordRow<&Camera::kind, cameraWords>("model"),
    row<&Camera::width, rules::size>("width"),
    row<&Camera::height, rules::size>("height"),
    row<&Camera::aspect, rules::aspect>("aspect"),
    row<&Camera::fovY, rules::fovY>("fovY"),
    { "K", readCameraMatrix, writeCameraMatrix },
    row<&Camera::viewHeight, rules::length>("viewHeight"),
    row<&Camera::near, rules::length>("near"),
    row<&Camera::far, rules::length>("far"),
    poseRow<&Camera::eye, rules::coordinate, false>("eye"),
    poseRow<&Camera::lookAt, rules::coordinate, false>("lookAt"),
    poseRow<&Camera::up, rules::coordinate, false>("up"),
    poseRow<&Camera::position, rules::coordinate, true>("position"),
    poseRow<&Camera::orientation, rules::unit, true>("orientation"),
    structRow<&Camera::unusedEye, unusedFields>("unusedEye"),
    structRow<&Camera::unusedLookAt, unusedFields>("unusedLookAt"),
  };
  return fields;
}

} // namespace dgtk::scenefile
