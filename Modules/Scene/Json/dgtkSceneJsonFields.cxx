// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneJsonRows.h"
#include "dgtkSensorDescription.h"

namespace dgtk::scenefile
{

namespace
{
using Object = ObjectDescription;
using Animation = AnimationDescription;
using Light = LightDescription;
using Camera = CameraDescription;

/// The row of one half of a camera's pose; it is written when the camera is posed that way, default or not.
template <auto Member, const Range& Allowed, bool Posed>
auto poseRow(const char* key)
{
  return JsonField<Camera>{ key, [](const JsonCursor& at, Camera& into) { readInto(at, Allowed, into.*Member); },
    [](const Camera& from, const char* name, JsonNode& object)
    {
      if (from.posed == Posed)
      {
        object.add(name, writeTrack(from.*Member));
      }
    } };
}

void readLightKind(const JsonCursor& at, Light& light)
{
  std::vector<std::string> words;
  for (const LightTraits& kind : lightKinds())
  {
    words.emplace_back(kind.word);
  }
  light.kind = lightKinds()[at.oneOf(words)].kind;
}

void writeLightKind(const Light& light, const char* key, JsonNode& node)
{
  if (light.kind != Light().kind)
  {
    node.add(key, JsonNode::of(traitsOf(light.kind).word));
  }
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

void readCameraMatrix(const JsonCursor& at, Camera& camera)
{
  camera.K = at.matrix<Eigen::Matrix3d>(rules::coordinate);
  const std::string fault = faultOf(*camera.K);
  if (!fault.empty())
  {
    at.fail("is not a camera matrix", fault);
  }
}

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
    keypointsRow(),
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
    row<&MaterialOverride::metallic, rules::unit>("metallic"),
    row<&MaterialOverride::roughness, rules::unit>("roughness"),
    row<&MaterialOverride::normalMap>("normalMap"),
    row<&MaterialOverride::bump>("bump"),
    row<&MaterialOverride::bumpScale, rules::coordinate>("bumpScale"),
    row<&MaterialOverride::metallicRoughnessMap>("metallicRoughnessMap"),
    row<&MaterialOverride::emissionMap>("emissionMap"),
    row<&MaterialOverride::occlusionMap>("occlusionMap"),
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
    { "kind", readLightKind, writeLightKind },
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
    row<&Light::shadows>("shadows"),
    row<&Light::shadowSize, rules::shadowSize>("shadowSize"),
    structRow<&Light::unused, unusedFields>("unused"),
  };
  return fields;
}

const std::vector<JsonField<Camera>>& cameraFields()
{
  static const std::vector<JsonField<Camera>> fields{
    { "name", readCameraName, textRow<&Camera::name>("name").write },
    { "model", readModel, row<&Camera::model>("model").write },
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
    structRow<&Camera::shutter, shutterFields>("shutter"),
    structRow<&Camera::rollingShutter, rollingShutterFields>("rollingShutter"),
    structRow<&Camera::lens, lensFields>("lens"),
    sensorRow(),
    structRow<&Camera::unusedEye, unusedFields>("unusedEye"),
    structRow<&Camera::unusedLookAt, unusedFields>("unusedLookAt"),
  };
  return fields;
}

} // namespace dgtk::scenefile
