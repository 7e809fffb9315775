// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDistributions.h"
#include "dgtkNormal.h"
#include "dgtkPortableMath.h"
#include "dgtkRandomScene.h"
#include "dgtkSampler.h"
#include "dgtkSceneRandom.h"

#include "dgtkError.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace dgtk;

namespace
{
constexpr int many = 100000;

/// `many` draws of a value, component by component.
std::vector<std::vector<double>> draws(const std::string& json, bool stratify = false)
{
  const JsonDocument document = parseJson("test", json);
  const JsonCursor at(document);
  const std::string word = randomWordOf({}, document.root);
  std::vector<std::vector<double>> values;
  for (int i = 0; i < many; ++i)
  {
    const SampleDraws draw(11, std::uint64_t(i));
    const JsonNode node = drawnValue(word, at, ValueUniforms(draw, "objects/a/b", 0, stratify), UpAxis::Y);
    std::vector<double> numbers{ node.number };
    if (node.type == JsonNode::Type::Array)
    {
      numbers.clear();
      for (const JsonNode& one : node.children)
      {
        numbers.push_back(one.number);
      }
    }
    values.resize(numbers.size());
    for (std::size_t k = 0; k < numbers.size(); ++k)
    {
      values[k].push_back(numbers[k]);
    }
  }
  return values;
}

/// Kolmogorov and Smirnov's distance times the root of the number; above 2.23 once in 10,000 sets.
double kolmogorov(std::vector<double> values, const std::function<double(double)>& distribution)
{
  std::sort(values.begin(), values.end());
  double largest = 0;
  const double n = double(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double p = distribution(values[i]);
    largest = std::max({ largest, p - double(i) / n, double(i + 1) / n - p });
  }
  return largest * std::sqrt(n);
}
constexpr double bound = 2.23;

double phi(double z) { return std::erfc(-z / std::sqrt(2.0)) / 2; }

/// Chi-square of counts against shares.
double chiSquare(const std::vector<double>& values, const std::map<double, double>& shares)
{
  std::map<double, int> counts;
  for (const double value : values)
  {
    ++counts[value];
  }
  double sum = 0;
  for (const auto& [value, share] : shares)
  {
    const double expected = share * double(values.size());
    sum += (counts[value] - expected) * (counts[value] - expected) / expected;
    counts.erase(value);
  }
  return counts.empty() ? sum : 1e9;
}

std::string sampledOf(const std::string& json, int number = 0, const std::string& folder = ".")
{
  const Sampler sampler(RandomScene::ofText(json, folder));
  return toJson(sampler.draw(std::uint64_t(number)).scene, folder);
}

void expectRefused(const std::string& json, const std::string& path, const std::string& says)
{
  const std::string line = test::thrownBy<Error>([&] { sampledOf(json); });
  EXPECT_NE(line, "") << "accepted: " << json;
  EXPECT_NE(line.find(path), std::string::npos) << line;
  EXPECT_NE(line.find(says), std::string::npos) << line;
}

std::string light(const std::string& members) { return R"({"lights":[{"name":"l",)" + members + "}]}"; }
} // namespace

TEST(SampleValues, FollowTheirDistributions)
{
  EXPECT_LT(kolmogorov(draws(R"({"uniform":[-2,3]})")[0], [](double x) { return (x + 2) / 5; }), bound);
  EXPECT_LT(
    kolmogorov(draws(R"({"logUniform":[0.01,100]})")[0], [](double x) { return std::log(x / 0.01) / std::log(1e4); }),
    bound);
  EXPECT_LT(
    kolmogorov(draws(R"({"normal":{"mean":2,"deviation":3}})")[0], [](double x) { return phi((x - 2) / 3); }), bound);
  const double least = phi(-1);
  const double most = phi(0.5);
  EXPECT_LT(kolmogorov(draws(R"({"normal":{"mean":2,"deviation":2,"min":0,"max":3}})")[0],
              [&](double x) { return (phi((x - 2) / 2) - least) / (most - least); }),
    bound);
  // Far out in the tail, where the differences of the distribution itself have no digits.
  EXPECT_LT(kolmogorov(draws(R"({"normal":{"mean":0,"deviation":1,"min":9,"max":10}})")[0],
              [](double x)
              {
                return (std::erfc(9 / std::sqrt(2.0)) - std::erfc(x / std::sqrt(2.0))) /
                       (std::erfc(9 / std::sqrt(2.0)) - std::erfc(10 / std::sqrt(2.0)));
              }),
    bound);
}

TEST(SampleValues, WholeNumbersAreAllAlike)
{
  std::map<double, double> shares;
  for (int i = -3; i <= 6; ++i)
  {
    shares[i] = 0.1;
  }
  EXPECT_LT(chiSquare(draws(R"({"integer":[-3,6]})")[0], shares), 33.7) << "9 degrees, once in 10,000";
  std::vector<double> indices;
  indices.reserve(many);
  for (int i = 0; i < many; ++i)
  {
    indices.push_back(double(chosen(SampleDraws(5, std::uint64_t(i)).uniform("c"), 3, { 1, 0, 3 })));
  }
  EXPECT_LT(chiSquare(indices, { { 0, 0.25 }, { 2, 0.75 } }), 15.2);
  std::vector<double> orders;
  for (int i = 0; i < many; ++i)
  {
    const SampleDraws draw(5, std::uint64_t(i));
    const std::vector<std::size_t> order = shuffled(3, ValueUniforms(draw, "p", 0, false));
    orders.push_back(double(order[0] * 100 + order[1] * 10 + order[2]));
  }
  EXPECT_LT(chiSquare(orders,
              { { 12, 1. / 6 }, { 21, 1. / 6 }, { 102, 1. / 6 }, { 120, 1. / 6 }, { 201, 1. / 6 }, { 210, 1. / 6 } }),
    25.8);
}

TEST(SampleValues, PointsAreUniformOverVolumeAndArea)
{
  const auto sphere = draws(R"({"inSphere":{"center":[1,2,3],"radius":2}})");
  std::vector<double> volume;
  std::vector<double> height;
  for (int i = 0; i < many; ++i)
  {
    const double x = sphere[0][i] - 1;
    const double y = sphere[1][i] - 2;
    const double z = sphere[2][i] - 3;
    const double r = std::sqrt(x * x + y * y + z * z);
    volume.push_back(r * r * r / 8);
    height.push_back((y / r + 1) / 2);
  }
  const auto identity = [](double p) { return p; };
  EXPECT_LT(kolmogorov(volume, identity), bound);
  EXPECT_LT(kolmogorov(height, identity), bound);
  const auto shell = draws(R"({"shell":{"center":[0,0,0],"radius":[2,4],"elevation":[10,60],"azimuth":[-30,90]}})");
  std::vector<double> radius;
  std::vector<double> sine;
  std::vector<double> azimuth;
  const double s0 = std::sin(10 * pi / 180);
  const double s1 = std::sin(60 * pi / 180);
  for (int i = 0; i < many; ++i)
  {
    const double r = std::hypot(std::hypot(shell[0][i], shell[1][i]), shell[2][i]);
    radius.push_back((r - 2) / 2);
    sine.push_back((shell[1][i] / r - s0) / (s1 - s0));
    azimuth.push_back((std::atan2(shell[0][i], shell[2][i]) * 180 / pi + 30) / 120);
  }
  EXPECT_LT(kolmogorov(radius, identity), bound);
  EXPECT_LT(kolmogorov(sine, identity), bound);
  EXPECT_LT(kolmogorov(azimuth, identity), bound);
  const auto box = draws(R"({"inBox":[[0,-1,5],[1,1,9]]})");
  EXPECT_LT(kolmogorov(box[2], [](double x) { return (x - 5) / 4; }), bound);
}

TEST(SampleValues, RotationsAreUniform)
{
  const auto any = draws(R"({"rotation":"any"})");
  std::vector<double> angle;
  std::vector<double> turned; // where the z axis goes to
  for (int i = 0; i < many; ++i)
  {
    EXPECT_NEAR(
      any[0][i] * any[0][i] + any[1][i] * any[1][i] + any[2][i] * any[2][i] + any[3][i] * any[3][i], 1, 1e-12);
    angle.push_back(2 * std::acos(std::min(1.0, std::abs(any[0][i]))));
    turned.push_back(1 - (any[1][i] * any[1][i] + any[2][i] * any[2][i]));
  }
  EXPECT_LT(kolmogorov(angle, [](double a) { return (a - std::sin(a)) / pi; }), bound);
  EXPECT_LT(kolmogorov(turned, [](double p) { return p; }), bound);
  const auto axis = draws(R"({"rotation":{"axis":[0,2,0],"angle":[-90,90]}})");
  std::vector<double> degrees;
  degrees.reserve(many);
  for (int i = 0; i < many; ++i)
  {
    degrees.push_back((2 * std::atan2(axis[2][i], axis[0][i]) * 180 / pi + 90) / 180);
  }
  EXPECT_LT(kolmogorov(degrees, [](double p) { return p; }), bound);
}

// Of 2^m samples from a multiple of 2^m on, one is in each elementary interval of the first two dimensions.
TEST(SampleValues, StratifiedSamplesAreANet)
{
  for (const std::uint64_t first : { 0u, 256u, 65536u })
  {
    for (int columns = 0; columns <= 8; ++columns)
    {
      std::map<std::pair<int, int>, int> boxes;
      for (std::uint64_t i = first; i < first + 256; ++i)
      {
        const SampleDraws draw(3, i);
        const ValueUniforms uniform(draw, "objects/a/position", 0, true);
        ++boxes[{ int(uniform(0) * (1 << columns)), int(uniform(1) * (256 >> columns)) }];
      }
      EXPECT_EQ(boxes.size(), 256u) << first << ' ' << columns;
    }
  }
  EXPECT_LT(kolmogorov(draws(R"({"uniform":[0,1]})", true)[0], [](double x) { return x; }), 0.1);
}

namespace
{
using Stratified = std::array<std::array<double, 4>, 256>;

/// Whether some are in each box of each shape of area 2^t / 256, as in a (t, 8, 2)-net of two dimensions.
bool isNet(const Stratified& points, std::size_t a, std::size_t b, int t)
{
  const int cells = 256 >> t;
  for (int columns = 1; columns <= cells; columns *= 2)
  {
    std::set<int> boxes;
    for (const auto& point : points)
    {
      boxes.insert(int(point[a] * columns) * 256 + int(point[b] * (cells / columns)));
    }
    if (int(boxes.size()) != cells)
    {
      return false;
    }
  }
  return true;
}
} // namespace

// Each dimension alone, Sobol's property A, and the quality of each pair, which is that of Joe and Kuo's numbers alone.
TEST(SampleValues, StratifiedSamplesAreASobolSequence)
{
  Stratified points;
  std::array<std::set<int>, 4> intervals;
  for (std::uint32_t i = 0; i < 256; ++i)
  {
    const SampleDraws draw(3, 512 + i);
    const ValueUniforms uniform(draw, "objects/a/position", 0, true);
    for (std::uint32_t d = 0; d < 4; ++d)
    {
      points[i][d] = uniform(d);
      intervals[d].insert(int(points[i][d] * 256));
    }
  }
  for (const std::set<int>& hit : intervals)
  {
    EXPECT_EQ(hit.size(), 256U);
  }
  for (std::size_t first = 0; first < 256; first += 16)
  {
    std::set<int> corners;
    for (std::size_t i = first; i < first + 16; ++i)
    {
      const auto& [x, y, z, w] = points[i];
      corners.insert((x < 0.5 ? 0 : 1) + (y < 0.5 ? 0 : 2) + (z < 0.5 ? 0 : 4) + (w < 0.5 ? 0 : 8));
    }
    EXPECT_EQ(corners.size(), 16U) << first;
  }
  struct Pair
  {
    std::size_t a, b;
    int least;
  };
  for (const auto& [a, b, least] : { Pair{ 0, 1, 0 }, { 0, 2, 1 }, { 0, 3, 1 }, { 1, 2, 1 }, { 1, 3, 2 }, { 2, 3, 1 } })
  {
    EXPECT_TRUE(isNet(points, a, b, least)) << a << b;
    EXPECT_FALSE(least > 0 && isNet(points, a, b, least - 1)) << a << b;
  }
}

TEST(SampleValues, NormalTailsAreThoseOfTheLibrary)
{
  for (int i = 0; i <= 162; ++i)
  {
    const double x = -30 + 0.37 * i;
    const double wanted = std::erfc(x / std::sqrt(2.0)) / 2;
    EXPECT_NEAR(normalTail(x) / wanted, 1, 1e-11) << x;
  }
  EXPECT_NEAR(truncatedNormal(0, 1, 2), 1, 1e-12);
}

TEST(SampleValues, WhatElseASceneHasChangesNoDraw)
{
  const std::string cup = R"({"name":"cup","position":{"inBox":[[0,0,0],[1,1,1]]},"intensity":{"uniform":[0,1]}})";
  const std::string swapped = R"({"intensity":{"uniform":[0,1]},"position":{"inBox":[[0,0,0],[1,1,1]]},"name":"cup"})";
  const auto lightOf = [](const std::string& json)
  {
    const Sampler sampler(RandomScene::ofText(json, "."));
    for (const LightDescription& light : sampler.draw(700).scene.lights)
    {
      if (light.name == "cup")
      {
        return light;
      }
    }
    return LightDescription();
  };
  const LightDescription alone = lightOf(R"({"lights":[)" + cup + "]}");
  EXPECT_GT(alone.position.value.x(), 0);
  for (const std::string& json : { R"({"lights":[{"name":"a","intensity":{"uniform":[0,1]}},)" + cup + "]}",
         R"({"parameters":{"x":{"uniform":[0,1]}},"lights":[)" + swapped + "]}",
         R"({"cameras":[{"name":"c","eye":{"inBox":[[0,0,0],[1,1,1]]},"lookAt":[9,9,9]}],"lights":[)" + cup + "]}" })
  {
    EXPECT_EQ(lightOf(json).position.value, alone.position.value) << json;
    EXPECT_EQ(lightOf(json).intensity.value, alone.intensity.value) << json;
  }
}

TEST(SampleValues, ParametersAreDrawnOnceASample)
{
  const Sampler sampler(RandomScene::ofText(
    R"({"parameters":{"b":{"uniform":["$a",2]},"a":{"uniform":[0,1]},"l":{"permutation":[1,2,3]}},
        "lights":[{"name":"x","intensity":"$b"},{"name":"y","intensity":"$b","position":"$l"}]})",
    "."));
  const SceneDescription one = sampler.draw(4).scene;
  EXPECT_EQ(one.lights[0].intensity.value, one.lights[1].intensity.value);
  EXPECT_NE(one.lights[0].intensity.value, sampler.draw(5).scene.lights[0].intensity.value);
  EXPECT_EQ(one.lights[1].position.value.sum(), 6);
  EXPECT_EQ(one.seed, seedOfSample(0, 4));
}

TEST(SampleValues, CountedObjectsAreRepeatedWithWhatHangsOnThem)
{
  const Sampler sampler(RandomScene::ofText(
    R"({"objects":[{"name":"lid","model":"a.obj","parent":"cup"},
        {"name":"cup","count":3,"model":"a.obj","class":{"permutation":["r","g","b"]},"scale":{"uniform":[1,2]}}],
        "order":["object","object"]})",
    "."));
  const SceneDescription scene = sampler.draw(0).scene;
  ASSERT_EQ(scene.objects.size(), 6u);
  EXPECT_EQ(scene.objects[1].name, "lid#2");
  EXPECT_EQ(scene.objects[1].parent, "cup#2");
  EXPECT_NE(scene.objects[3].scale.value, scene.objects[4].scale.value);
  std::string classes;
  for (std::size_t i = 3; i < 6; ++i)
  {
    classes += scene.objects[i].className;
  }
  std::sort(classes.begin(), classes.end());
  EXPECT_EQ(classes, "bgr");
}

TEST(SampleValues, MisuseNamesItsPlace)
{
  expectRefused(light(R"("intensity":{"uniform":[2,1]})"), "lights[0].intensity.uniform", "is empty");
  expectRefused(light(R"("intensity":{"uniform":[1,"a"]})"), "lights[0].intensity.uniform[1]", "wrong type");
  expectRefused(light(R"("intensity":{"uniform":[1,2],"by":3})"), "lights[0].intensity", "unknown key 'by'");
  expectRefused(light(R"("intensity":{"uniform":[1,2],"stratifi":true})"), "lights[0].intensity", "perhaps");
  expectRefused(light(R"("intensity":{"uniform":[-2,-1]})"), "lights[0].intensity", "out of range");
  expectRefused(light(R"("intensity":{"integer":[0.5,1]})"), "lights[0].intensity.integer[0]", "whole number");
  expectRefused(light(R"("intensity":{"integer":[0,1.5]})"), "lights[0].intensity.integer[1]", "whole number");
  expectRefused(light(R"("intensity":{"logUniform":[0,1]})"), "lights[0].intensity.logUniform[0]", "above 0");
  expectRefused(light(R"("intensity":{"normal":{"mean":0}})"), "lights[0].intensity.normal.deviation", "missing");
  expectRefused(light(R"("intensity":{"normal":{"mean":0,"deviation":1,"min":99}})"), "intensity.normal", "too far");
  expectRefused(light(R"("intensity":{"choice":[]})"), "lights[0].intensity.choice", "nothing to choose");
  expectRefused(light(R"("intensity":{"choice":[1,2],"weights":[1]})"), "lights[0].intensity.weights", "list of 2");
  expectRefused(light(R"("intensity":{"choice":[1],"weights":[0]})"), "lights[0].intensity.weights", "nothing");
  expectRefused(light(R"("name2":{"choice":[1]})"), "name2", "name2");
  expectRefused(light(R"("intensity":{"choice":{"files":"no/*.x"}})"), "intensity.choice.files", "names no file");
  expectRefused(light(R"("intensity":"$no")"), "lights[0].intensity", "names no parameter");
  expectRefused(light(R"("position":{"shell":{"center":[0,0,0],"radius":-1}})"), "position.shell.radius", "from 0");
  expectRefused(light(R"("position":{"onSurface":"no"})"), "lights[0].position", "names no object");
  expectRefused(light(R"("target":"no")"), "lights[0].target", "names no object");
  expectRefused(R"({"parameters":{"a":"$b","b":"$a"}})", "parameters.", "depends on itself");
  expectRefused(R"({"lights":[{"intensity":{"uniform":[0,1]}}]})", "lights[0].intensity", "has no name");
  expectRefused(R"({"lights":[{"name":{"choice":["a"]}}]})", "lights[0].name", "cannot be random");
  expectRefused(R"({"lights":{"choice":[[]]}})", "lights", "cannot be random as a whole");
  expectRefused(R"({"objects":[{"name":"a","model":"a.obj","count":-1}]})", "objects[0].count", "0 to 100000");
  expectRefused(R"({"cameras":[{"name":"c","eye":[0,0,1],"lookAt":[0,0,0],"require":{}}]})", "cameras[0].require",
    "asks for nothing");
  expectRefused(R"({"cameras":[{"name":"c","path":{"orbit":{"center":[0,0,0],"radius":1}}}]})",
    "cameras[0].path.orbit.frames", "missing");
  expectRefused(R"({"cameras":[{"name":"c","eye":[0,0,0],"path":{"orbit":{}}}]})", "cameras[0].eye", "beside a path");
}

// Every value of a plain scene, one at a time, as a choice of one: the scene that is drawn is the plain one.
TEST(SampleValues, StandWhereValuesStand)
{
  const std::string plain = R"({"units":"m","fps":20,"background":[0.1,0.2,0.3],"keyFrames":[3,9],
    "environment":{"image":"sky.hdr","rotation":30},"fog":{"density":0.1},"classes":{"toy":3},
    "objects":[{"name":"a","class":"toy","model":"a.obj","visible":true,
      "position":{"keys":[[0,[1,2,3]],[4,[2,2,3],"step"]],"interpolation":"smooth"},"orientation":[0,1,0,0],
      "scale":[2,2,3],"animation":{"rate":0.5,"loop":false},"materials":{"*":{"diffuse":[1,0,0.5],"texture":"t.png"}},
      "keypoints":{"nose":[0,1,0],"tip":2}},{"name":"b","class":"toy","model":"b.obj","parent":"a","skin":"s"}],
    "lights":[{"name":"l","kind":"spot","position":[1,2,3],"attenuation":[1,0.1,0],"shadows":true}],
    "cameras":[{"name":"c","fovY":{"keys":[[0,40],[5,50]]},"eye":[0,0,5],"lookAt":[0,1,0],"near":0.5,
      "shutter":{"close":1},"sensor":{"color":{"readNoise":3,"psf":{"gaussian":1}}}},
      {"name":"d","width":64,"height":48,"K":[[50,0,32],[0,50,24],[0,0,1]],"position":[1,2,3],
      "orientation":[0,1,0,0]}],"order":["object","light","object","camera","camera"]})";
  const std::string wanted = sampledOf(plain);
  JsonDocument document = parseJson("test", plain);
  int places = 0;
  const std::function<std::string(const JsonNode&, const JsonNode*, bool)> text =
    [&](const JsonNode& node, const JsonNode* chosen, bool inner)
  {
    if (&node == chosen && !inner)
    {
      return R"({"choice":[)" + text(node, chosen, true) + "]}";
    }
    std::string out;
    const bool object = node.type == JsonNode::Type::Object;
    switch (node.type)
    {
      case JsonNode::Type::Array:
      case JsonNode::Type::Object:
        for (std::size_t i = 0; i < node.children.size(); ++i)
        {
          out += (i == 0 ? "" : object && i % 2 == 1 ? ":" : ",") + text(node.children[i], chosen, false);
        }
        return object ? '{' + out + '}' : '[' + out + ']';
      case JsonNode::Type::String:
        return jsonString(node.text);
      case JsonNode::Type::Boolean:
        return std::string(node.boolean ? "true" : "false");
      default:
        return std::to_string(node.number);
    }
  };
  const std::function<void(const JsonNode&, const std::string&, int)> each =
    [&](const JsonNode& node, const std::string& key, int depth)
  {
    static const std::vector<std::string> lists{ "objects", "lights", "cameras", "order" };
    const bool item = depth <= 2 && (key == "item" || std::count(lists.begin(), lists.end(), key) != 0);
    static const std::vector<std::string> named{ "materials", "classes", "keypoints", "environment", "name" };
    if (depth > 0 && !item && std::count(named.begin(), named.end(), key) == 0)
    {
      EXPECT_EQ(sampledOf(text(document.root, &node, false)), wanted) << text(document.root, &node, false);
      ++places;
    }
    const bool object = node.type == JsonNode::Type::Object;
    for (std::size_t i = object; i < node.children.size() && key != "order"; i += 1 + object)
    {
      each(node.children[i], object ? node.children[i - 1].text : depth == 1 && item ? "item" : "", depth + 1);
    }
  };
  each(document.root, {}, 0);
  EXPECT_GT(places, 110);
}

TEST(SampleValues, PatternsAreLikeNames)
{
  EXPECT_TRUE(isLike("cup#12", "cup*"));
  EXPECT_TRUE(isLike("abcabd", "*ab?"));
  EXPECT_FALSE(isLike("abc", "ab"));
  EXPECT_FALSE(isLike("abc", "?*?c?"));
}
