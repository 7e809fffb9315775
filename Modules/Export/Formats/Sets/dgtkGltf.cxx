// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGltf.h"
#include "dgtkPortableMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace dgtk::gltf
{

namespace
{
constexpr int floatType = 5126;
constexpr int uintType = 5125;

std::size_t componentsOf(const std::string& type)
{
  return type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
}

std::vector<double> listOf(const Eigen::VectorXd& vector) { return { vector.data(), vector.data() + vector.size() }; }

std::vector<double> rotationOf(const Eigen::Vector4d& q) { return { q[1], q[2], q[3], q[0] }; }
} // namespace

std::size_t Buffer::put(const void* data, std::size_t bytes, Json accessor, Use use)
{
  Json view{ { "buffer", 0 }, { "byteOffset", this->Bytes }, { "byteLength", bytes } };
  if (use != Use::Animation)
  {
    view["target"] = use == Use::Vertices ? 34962 : 34963;
  }
  this->File.write(data, bytes);
  this->Bytes += bytes; // of numbers of 4 bytes: the next one is aligned
  accessor["bufferView"] = this->Views.size();
  this->Views.push_back(view);
  this->Accessors.push_back(accessor);
  return this->Accessors.size() - 1;
}

std::size_t Buffer::add(const std::vector<float>& numbers, const std::string& type, Use use, bool limits)
{
  const std::size_t components = componentsOf(type);
  Json accessor{ { "componentType", floatType }, { "count", numbers.size() / components }, { "type", type } };
  if (limits)
  {
    std::vector<float> least(numbers.begin(), numbers.begin() + std::ptrdiff_t(components));
    std::vector<float> most = least;
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      least[i % components] = std::min(least[i % components], numbers[i]);
      most[i % components] = std::max(most[i % components], numbers[i]);
    }
    accessor["min"] = least;
    accessor["max"] = most;
  }
  return this->put(numbers.data(), numbers.size() * sizeof(float), accessor, use);
}

std::size_t Buffer::add(const std::vector<std::uint32_t>& indices)
{
  const Json accessor{ { "componentType", uintType }, { "count", indices.size() }, { "type", "SCALAR" } };
  return this->put(indices.data(), indices.size() * sizeof(std::uint32_t), accessor, Use::Indices);
}

void Buffer::describe(Json& asset, const std::string& name) const
{
  if (this->Bytes > 0)
  {
    asset["buffers"] = Json::array({ { { "uri", name }, { "byteLength", this->Bytes } } });
    asset["bufferViews"] = this->Views;
    asset["accessors"] = this->Accessors;
  }
}

Json placedNode(const Place& first)
{
  return { { "translation", listOf(first.t) }, { "rotation", rotationOf(first.q) }, { "scale", listOf(first.scale) } };
}

namespace
{
std::vector<float> rounded(const std::vector<double>& numbers, LayerRounding& account)
{
  account.values += numbers.size();
  for (const double number : numbers)
  {
    account.largest = std::max(account.largest, std::abs(double(static_cast<float>(number)) - number));
  }
  return { numbers.begin(), numbers.end() };
}
} // namespace

void animate(Json& animation, Buffer& buffer, std::size_t node, const std::vector<double>& times,
  const std::vector<Place>& places, KeyRounding& rounding)
{
  std::vector<double> t;
  std::vector<double> q;
  std::vector<double> scale;
  Eigen::Vector4d last = places.front().q;
  bool moves[3] = { false, false, false };
  for (const Place& place : places)
  {
    last = place.q.dot(last) < 0 ? Eigen::Vector4d(-place.q) : place.q; // the shorter way round
    const std::vector<double> turn = rotationOf(last);
    t.insert(t.end(), place.t.data(), place.t.data() + 3);
    q.insert(q.end(), turn.begin(), turn.end());
    scale.insert(scale.end(), place.scale.data(), place.scale.data() + 3);
    moves[0] = moves[0] || place.t != places.front().t;
    moves[1] = moves[1] || place.q != places.front().q;
    moves[2] = moves[2] || place.scale != places.front().scale;
  }
  if (!moves[0] && !moves[1] && !moves[2])
  {
    return;
  }
  const std::size_t input = buffer.add({ times.begin(), times.end() }, "SCALAR", Buffer::Use::Animation, true);
  const auto channel = [&](
                         const char* path, const std::vector<double>& values, const char* type, LayerRounding& account)
  {
    const std::size_t output = buffer.add(rounded(values, account), type, Buffer::Use::Animation);
    animation["channels"].push_back(
      { { "sampler", animation["samplers"].size() }, { "target", { { "node", node }, { "path", path } } } });
    animation["samplers"].push_back({ { "input", input }, { "output", output }, { "interpolation", "LINEAR" } });
  };
  if (moves[0])
  {
    channel("translation", t, "VEC3", rounding.places);
  }
  if (moves[1])
  {
    channel("rotation", q, "VEC4", rounding.turns);
  }
  if (moves[2])
  {
    channel("scale", scale, "VEC3", rounding.turns);
  }
}

double linear(std::uint8_t level) { return portable::linearFromSrgb(level / 255.0); }

namespace
{
Json attributesOf(Buffer& buffer, const ModelPly& model, bool mirrored, bool colored)
{
  std::vector<float> x;
  std::vector<float> n;
  std::vector<float> uv;
  std::vector<float> color;
  const double side = mirrored ? -1 : 1;
  bool unit = true;
  for (std::size_t i = 0; i < model.positions.size(); ++i)
  {
    const auto& p = model.positions[i];
    const Eigen::Vector3d normal = Eigen::Map<const Eigen::Vector3f>(model.normals[i].data()).cast<double>();
    const Eigen::Vector3d turned = normal.normalized();
    unit = unit && std::abs(turned.norm() - 1) < 1e-6;
    for (std::size_t c = 0; c < 3; ++c)
    {
      x.push_back(static_cast<float>(c == 0 ? side * p[c] : p[c]));
      n.push_back(static_cast<float>((c == 0 ? side : 1) * turned[Eigen::Index(c)]));
      color.push_back(static_cast<float>(linear(model.colors[i][c])));
    }
    if (!model.uvs.empty())
    {
      uv.push_back(static_cast<float>(model.uvs[i][0]));
      uv.push_back(static_cast<float>(1 - model.uvs[i][1])); // from the upper left corner
    }
  }
  Json attributes{ { "POSITION", buffer.add(x, "VEC3", Buffer::Use::Vertices, true) } };
  if (unit)
  {
    attributes["NORMAL"] = buffer.add(n, "VEC3", Buffer::Use::Vertices);
  }
  if (!uv.empty())
  {
    attributes["TEXCOORD_0"] = buffer.add(uv, "VEC2", Buffer::Use::Vertices);
  }
  if (colored)
  {
    attributes["COLOR_0"] = buffer.add(color, "VEC3", Buffer::Use::Vertices);
  }
  return attributes;
}

Look lookOf(const ModelPly& model, std::size_t triangle)
{
  const int number = model.textures[triangle];
  Look look;
  look.picture = number < 0 ? "" : model.pictures[static_cast<std::size_t>(number)];
  look.wrap = number < 0 ? "" : model.wraps[static_cast<std::size_t>(number)];
  return look;
}

/// Whether triangles have one colour each, and these are few.
bool hasFewLooks(const ModelPly& model)
{
  constexpr std::size_t few = 64;
  std::set<Look> looks;
  for (std::size_t i = 0; i < model.triangles.size() && looks.size() <= few; ++i)
  {
    const auto& [a, b, c] = model.triangles[i];
    if (model.colors[a] != model.colors[b] || model.colors[a] != model.colors[c])
    {
      return false;
    }
    Look look = lookOf(model, i);
    look.color = model.colors[a];
    looks.insert(look);
  }
  return looks.size() <= few;
}
} // namespace

Json samplerOf(const std::string& wrap)
{
  const auto mode = [](const std::string& word) { return word == "clamp" ? 33071 : word == "mirror" ? 33648 : 10497; };
  const std::size_t blank = wrap.find(' ');
  return { { "wrapS", mode(wrap.substr(0, blank)) }, { "wrapT", mode(wrap.substr(blank + 1)) } };
}

Json meshOf(
  Buffer& buffer, const ModelPly& model, bool mirrored, const std::function<std::size_t(const Look&)>& materials)
{
  const bool few = hasFewLooks(model);
  std::map<Look, std::vector<std::uint32_t>> parts;
  for (std::size_t i = 0; i < model.triangles.size(); ++i)
  {
    auto corners = model.triangles[i];
    Look look = lookOf(model, i);
    look.color = few ? model.colors[corners[0]] : look.color;
    if (mirrored)
    {
      std::swap(corners[1], corners[2]);
    }
    std::vector<std::uint32_t>& part = parts[look];
    part.insert(part.end(), corners.begin(), corners.end());
  }
  const Json attributes = attributesOf(buffer, model, mirrored, !few);
  Json primitives = Json::array();
  for (const auto& [look, indices] : parts)
  {
    primitives.push_back(
      { { "attributes", attributes }, { "indices", buffer.add(indices) }, { "material", materials(look) } });
  }
  return { { "primitives", primitives } };
}

namespace
{
/// A value of a light, the first key's of one that moves.
nlohmann::json valueOf(const nlohmann::json& light, const char* key, const nlohmann::json& usual, bool& moves)
{
  const auto found = light.find(key);
  if (found == light.end())
  {
    return usual;
  }
  if (!found->contains("keys"))
  {
    return *found;
  }
  moves = moves || found->at("keys").size() > 1;
  return found->at("keys").at(0).at(1);
}

Eigen::Vector3d vectorOf(const nlohmann::json& value)
{
  return { value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>() };
}

/// The rotation that takes -z to a direction.
Eigen::Vector4d turnTo(const Eigen::Vector3d& direction)
{
  const Eigen::Quaterniond q = Eigen::Quaterniond::FromTwoVectors(
    Eigen::Vector3d(0, 0, -1), direction.norm() > 0 ? direction : Eigen::Vector3d(0, 0, -1));
  return Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()).normalized();
}

Light lightOf(const nlohmann::json& one, const std::string& kind, double metres, bool& exact)
{
  bool moves = false;
  const Eigen::Vector3d position = vectorOf(valueOf(one, "position", { 0, 0, 0 }, moves));
  const Eigen::Vector3d target = vectorOf(valueOf(one, "target", { 0, 0, 0 }, moves));
  const Eigen::Vector3d color = vectorOf(valueOf(one, "diffuse", { 1, 1, 1 }, moves));
  const double most = std::max(color.maxCoeff(), 1e-300);
  double intensity = valueOf(one, "intensity", 1, moves).get<double>() * most * pi;
  Light light;
  light.place.t = position * metres;
  light.place.q = turnTo(target - position);
  if (kind != "directional")
  {
    const Eigen::Vector3d k = vectorOf(valueOf(one, "attenuation", { 1, 0, 0 }, moves));
    const double d = 1 / metres; // scene units of a metre
    intensity /= std::max(k[0] + k[1] * d + k[2] * d * d, 1e-300);
    exact = k[0] == 0 && k[1] == 0;
  }
  light.light = { { "type", kind }, { "color", listOf(Eigen::Vector3d(color / most)) }, { "intensity", intensity } };
  if (kind == "spot")
  {
    const double cone = valueOf(one, "coneAngle", 30, moves).get<double>();
    exact = exact && valueOf(one, "exponent", 0, moves).get<double>() == 0;
    light.light["spot"] = { { "innerConeAngle", 0.0 }, { "outerConeAngle", std::min(cone, 90.0) / 180 * pi } };
  }
  exact = exact && !moves;
  return light;
}
} // namespace

std::vector<Light> lightsOf(
  const nlohmann::json& scene, double metres, std::vector<std::string>& approximate, std::vector<std::string>& without)
{
  std::vector<Light> lights;
  const auto all = scene.find("lights");
  for (std::size_t i = 0; all != scene.end() && i < all->size(); ++i)
  {
    const nlohmann::json& one = all->at(i);
    const std::string name = one.value("name", "Light" + std::to_string(i));
    const std::string kind = one.value("kind", "point");
    bool switched = false;
    const bool enabled = valueOf(one, "enabled", true, switched).get<bool>();
    if (!enabled || (kind != "point" && kind != "directional" && kind != "spot"))
    {
      without.push_back(name);
      continue;
    }
    bool exact = true;
    Light light = lightOf(one, kind, metres, exact);
    light.light["name"] = name;
    lights.push_back(light);
    if (!exact || switched)
    {
      approximate.push_back(name);
    }
  }
  return lights;
}

} // namespace dgtk::gltf
