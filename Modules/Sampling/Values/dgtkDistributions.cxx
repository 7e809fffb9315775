// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDistributions.h"

#include "dgtkNormal.h"
#include "dgtkPortableMath.h"
#include "dgtkRuleValues.h"
#include "dgtkTrack.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dgtk
{

using namespace samplerule;

namespace
{
constexpr Range latitude{ -90, 90, false, false, "degrees from -90 to 90" };
constexpr Range whole{ -0x1p53, 0x1p53, false, false, "a whole number, at most 2^53 in size" };
constexpr char geometryKey[] = "$geometry";

JsonNode listOf(const std::vector<double>& numbers, int line)
{
  JsonNode list(JsonNode::Type::Array);
  list.line = line;
  for (const double number : numbers)
  {
    list.children.push_back(JsonNode::of(number));
    list.children.back().line = line;
  }
  return list;
}

JsonNode pointNode(const Eigen::Vector3d& v, int line)
{
  return listOf(std::vector<double>{ v.x(), v.y(), v.z() }, line);
}

JsonNode numberOf(double value, int line)
{
  JsonNode node = JsonNode::of(value);
  node.line = line;
  return node;
}

struct Interval
{
  double least;
  double most;
  double at(double u) const { return std::min(this->least + u * (this->most - this->least), this->most); }
};

/// [a, b] with a <= b; with `single`, also one number.
Interval intervalOf(const JsonCursor& at, const Range& range, bool single = false)
{
  if (single && at.node().type == JsonNode::Type::Number)
  {
    const double value = at.number(range);
    return { value, value };
  }
  at.listSize(2);
  const Interval interval{ at.element(0).number(range), at.element(1).number(range) };
  if (interval.least > interval.most)
  {
    at.fail(
      "is empty", "[least, most]", at.element(0).node().described() + " above " + at.element(1).node().described());
  }
  return interval;
}

double drawnNormal(const JsonCursor& at, double u)
{
  onlyKeys(at, { "mean", "deviation", "min", "max" });
  const double mean = at["mean"].number(coordinate);
  const double deviation = at["deviation"].number(positive);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double least = at.has("min") ? at["min"].number(coordinate) : -infinity;
  const double most = at.has("max") ? at["max"].number(coordinate) : infinity;
  constexpr double farthest = 37;
  if (least >= most || (least - mean) / deviation > farthest || (most - mean) / deviation < -farthest)
  {
    at.fail(least >= most ? "is empty" : "is too far from its mean", "min below max, within 37 deviations of the mean");
  }
  const double z = truncatedNormal(u, (least - mean) / deviation, (most - mean) / deviation);
  return std::clamp(mean + deviation * z, least, most);
}

/// Unit vector of longitude (degrees; 0: y up: +z, z up: +x; counter-clockwise seen from above) and sine of latitude.
Eigen::Vector3d directionOf(double azimuth, double sine, UpAxis up)
{
  const portable::SineCosine turn = portable::sinCos(azimuth * (pi / 180));
  const double cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
  return up == UpAxis::Y ? Eigen::Vector3d(turn.sine * cosine, sine, turn.cosine * cosine)
                         : Eigen::Vector3d(turn.cosine * cosine, turn.sine * cosine, sine);
}

/// `offset` from a centre: a point, an object's name, or a point that geometry decides.
JsonNode around(const JsonCursor& center, const Eigen::Vector3d& offset, int line)
{
  if (center.node().type == JsonNode::Type::String)
  {
    return nodeOf({ false, center.string(false), offset, 0 }, line);
  }
  if (isGeometryPoint(center.node()))
  {
    GeometryPoint point = geometryPointOf(center.node());
    if (point.onSurface)
    {
      center.fail("cannot be on a surface", "a point or the name of an object");
    }
    point.numbers += offset;
    return nodeOf(point, line);
  }
  return pointNode(center.vector(coordinate) + offset, line);
}

JsonNode drawnRotation(const JsonCursor& at, const ValueUniforms& u, int line)
{
  if (at.node().type == JsonNode::Type::String)
  {
    at.oneOf({ "any" });
    // Shoemake, "Uniform random rotations", Graphics Gems III, 1992.
    const portable::SineCosine a = portable::sinCos(2 * pi * u(1));
    const portable::SineCosine b = portable::sinCos(2 * pi * u(2));
    const double in = std::sqrt(1 - u(0));
    const double out = std::sqrt(u(0));
    return listOf(std::vector<double>{ out * b.cosine, in * a.sine, in * a.cosine, out * b.sine }, line);
  }
  onlyKeys(at, { "axis", "angle" });
  const Eigen::Vector3d axis = at["axis"].vector(coordinate);
  const double length = std::sqrt(axis.x() * axis.x() + axis.y() * axis.y() + axis.z() * axis.z());
  if (length == 0)
  {
    at["axis"].fail("has no direction", "three numbers that are not all 0");
  }
  const Interval turns = at.has("angle") ? intervalOf(at["angle"], degrees, true) : Interval{ 0, 360 };
  const portable::SineCosine half = portable::sinCos(turns.at(u(0)) * (pi / 360));
  const Eigen::Vector3d v = axis * (half.sine / length);
  return listOf(std::vector<double>{ half.cosine, v.x(), v.y(), v.z() }, line);
}

JsonNode drawnInBox(const JsonCursor& at, const ValueUniforms& u, int line)
{
  at.listSize(2);
  const Eigen::Vector3d least = at.element(0).vector(coordinate);
  const Eigen::Vector3d most = at.element(1).vector(coordinate);
  Eigen::Vector3d x;
  for (int i = 0; i < 3; ++i)
  {
    if (least[i] > most[i])
    {
      at.fail("is empty", "[[least x, y, z], [most x, y, z]]");
    }
    x[i] = Interval{ least[i], most[i] }.at(u(std::uint32_t(i)));
  }
  return pointNode(x, line);
}

JsonNode drawnInSphere(const JsonCursor& at, const ValueUniforms& u, int line)
{
  onlyKeys(at, { "center", "radius" });
  const double distance = at["radius"].number(notNegative) * portable::pow(u(2), 1.0 / 3);
  return around(at["center"], distance * directionOf(360 * u(0), 2 * u(1) - 1, UpAxis::Z), line);
}

JsonNode drawnShell(const JsonCursor& at, const ValueUniforms& u, UpAxis up, int line)
{
  onlyKeys(at, { "center", "radius", "elevation", "azimuth" });
  const double radius = intervalOf(at["radius"], notNegative, true).at(u(2));
  const Interval elevation = at.has("elevation") ? intervalOf(at["elevation"], latitude, true) : Interval{ -90, 90 };
  const Interval azimuth = at.has("azimuth") ? intervalOf(at["azimuth"], degrees, true) : Interval{ 0, 360 };
  const auto sine = [](double angle) { return portable::sinCos(angle * (pi / 180)).sine; };
  const double height = Interval{ sine(elevation.least), sine(elevation.most) }.at(u(1));
  return around(at["center"], radius * directionOf(azimuth.at(u(0)), height, up), line);
}

JsonNode drawnOnSurface(const JsonCursor& at, const ValueUniforms& u, int line)
{
  GeometryPoint point{ true, {}, { u(0), u(1), u(2) }, 0 };
  if (at.node().type == JsonNode::Type::String)
  {
    point.object = at.string(false);
    return nodeOf(point, line);
  }
  onlyKeys(at, { "object", "above" });
  point.object = at["object"].string(false);
  point.above = at.has("above") ? at["above"].number(coordinate) : 0;
  return nodeOf(point, line);
}

double drawnNumber(const std::string& word, const JsonCursor& at, const ValueUniforms& u)
{
  if (word == "uniform")
  {
    return intervalOf(at, coordinate).at(u(0));
  }
  if (word == "normal")
  {
    return drawnNormal(at, u(0));
  }
  if (word == "logUniform")
  {
    const Interval interval = intervalOf(at, positive);
    const Interval logs{ portable::log(interval.least), portable::log(interval.most) };
    return std::clamp(portable::exp(logs.at(u(0))), interval.least, interval.most);
  }
  at.listSize(2);
  at.element(0).wholeNumber(whole);
  at.element(1).wholeNumber(whole);
  const Interval interval = intervalOf(at, whole);
  return std::min(interval.least + std::floor(u(0) * (interval.most - interval.least + 1)), interval.most);
}
} // namespace

JsonNode nodeOf(const GeometryPoint& point, int line)
{
  JsonNode node(JsonNode::Type::Object);
  node.line = line;
  node.add(geometryKey, JsonNode::of(point.onSurface));
  node.add("object", JsonNode::of(point.object));
  node.add("numbers", pointNode(point.numbers, line));
  node.add("above", JsonNode::of(point.above));
  return node;
}

bool isGeometryPoint(const JsonNode& node)
{
  return node.type == JsonNode::Type::Object && node.find(geometryKey) != nullptr;
}

GeometryPoint geometryPointOf(const JsonNode& node)
{
  const std::vector<JsonNode>& numbers = node.find("numbers")->children;
  return { node.find(geometryKey)->boolean, node.find("object")->text,
    { numbers[0].number, numbers[1].number, numbers[2].number }, node.find("above")->number };
}

JsonNode drawnValue(const std::string& word, const JsonCursor& object, const ValueUniforms& uniform, UpAxis up)
{
  onlyKeys(object, { word, "stratify" });
  const JsonCursor at = object[word];
  const int line = object.node().line;
  if (word == "rotation")
  {
    return drawnRotation(at, uniform, line);
  }
  if (word == "inBox")
  {
    return drawnInBox(at, uniform, line);
  }
  if (word == "inSphere")
  {
    return drawnInSphere(at, uniform, line);
  }
  if (word == "shell")
  {
    return drawnShell(at, uniform, up, line);
  }
  if (word == "onSurface")
  {
    return drawnOnSurface(at, uniform, line);
  }
  if (word == "centerOf")
  {
    return nodeOf({ false, at.string(false), { 0, 0, 0 }, 0 }, line);
  }
  return numberOf(drawnNumber(word, at, uniform), line);
}

std::size_t chosen(double uniform, std::size_t count, const std::vector<double>& weights)
{
  if (weights.empty())
  {
    return std::min(std::size_t(uniform * double(count)), count - 1);
  }
  const double place = uniform * std::accumulate(weights.begin(), weights.end(), 0.0);
  double sum = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    sum += weights[i];
    if (weights[i] > 0 && place < sum)
    {
      return i;
    }
    last = weights[i] > 0 ? i : last;
  }
  return last;
}

std::vector<std::size_t> shuffled(std::size_t count, const ValueUniforms& uniform)
{
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  for (std::size_t i = count; i > 1; --i) // Fisher and Yates
  {
    const std::size_t other = std::min(std::size_t(uniform(std::uint32_t(i)) * double(i)), i - 1);
    std::swap(order[i - 1], order[other]);
  }
  return order;
}

} // namespace dgtk
