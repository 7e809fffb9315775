// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFbxCurve.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace dgtk::import
{

namespace
{
/// Bits of KeyAttrFlags (FBX SDK, FbxAnimCurveDef).
enum KeyFlag : std::uint32_t
{
  IsConstant = 0x2,
  IsCubic = 0x8,
  ConstantNext = 0x100,
  TangentTcb = 0x200,
  TangentUser = 0x400,
  Clamp = 0x1000,
  TimeIndependent = 0x2000,
  ClampProgressive = 0x4000,
  WeightedRight = 0x1000000,
  WeightedNextLeft = 0x2000000
};

constexpr double third = 1. / 3;

/// A key as the file has it: what it says of its right side, and of the next key's left side.
struct Key
{
  double time = 0; ///< seconds
  double value = 0;
  std::uint32_t flags = 0;
  double data[3]{}; ///< slopes, or tension, continuity and bias
  double weights[2]{ third, third };
};

/// Numbers of KeyAttrDataFloat, which text files give as the bits of floats.
std::vector<float> attributes(const FbxElement& curve)
{
  std::vector<float> floats;
  const FbxElement* element = curve.find("KeyAttrDataFloat");
  const bool isBits = element != nullptr && !element->values.empty() &&
                      std::holds_alternative<std::vector<std::int64_t>>(element->values[0]);
  for (const std::int64_t whole : isBits ? curve.integers("KeyAttrDataFloat") : std::vector<std::int64_t>())
  {
    const auto bits = static_cast<std::uint32_t>(whole);
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    floats.push_back(value);
  }
  for (const double value : isBits ? std::vector<double>() : curve.numbers("KeyAttrDataFloat"))
  {
    floats.push_back(static_cast<float>(value));
  }
  return floats;
}

std::vector<Key> readKeys(const FbxElement& element, double begin, double ticks)
{
  const std::vector<std::int64_t> times = element.integers("KeyTime");
  const std::vector<double> values = element.numbers("KeyValueFloat");
  const std::vector<std::int64_t> flags = element.integers("KeyAttrFlags");
  const std::vector<float> data = attributes(element);
  const std::vector<std::int64_t> counts = element.integers("KeyAttrRefCount");
  std::vector<Key> keys;
  std::size_t attribute = 0;
  std::int64_t left = counts.empty() ? 0 : counts[0];
  for (std::size_t i = 0; i < std::min(times.size(), values.size()); ++i)
  {
    while (left <= 0 && attribute + 1 < counts.size())
    {
      left = counts[++attribute];
    }
    left -= left > 0 ? 1 : 0;
    Key key;
    key.time = (double(times[i]) - begin) / ticks;
    key.value = values[i];
    key.flags = attribute < flags.size() ? static_cast<std::uint32_t>(flags[attribute]) : 0u;
    if (4 * attribute + 3 < data.size())
    {
      const float* const four = &data[4 * attribute];
      std::copy(four, four + 3, key.data);
      std::uint32_t weights = 0; // two numbers of 16 bits, in ten thousandths
      std::memcpy(&weights, four + 2, sizeof weights);
      key.weights[0] = (key.flags & WeightedRight) != 0 ? double(weights & 0xffffu) * 1e-4 : third;
      key.weights[1] = (key.flags & WeightedNextLeft) != 0 ? double(weights >> 16) * 1e-4 : third;
    }
    if (std::isfinite(key.time) && std::isfinite(key.value) && (keys.empty() || key.time > keys.back().time))
    {
      keys.push_back(key);
    }
  }
  return keys;
}

double slopeBetween(const Key& a, const Key& b) { return (b.value - a.value) / (b.time - a.time); }

/// What a bias of more than 500 % adds to a slope.
double beyondBias(double bias, double sign)
{
  const double over = std::abs(bias) / 100 - 5;
  return over > 0 ? (sign > 0 ? 1 : -1) * over * over * 40 : 0;
}

/// Slope of an automatic tangent of key `k` between two others, with the bias that the file has in a slope's place.
double automatic(const Key* k, double bias, double leftWeight, double rightWeight)
{
  const Key& before = k[-1];
  const Key& here = k[0];
  const Key& after = k[1];
  constexpr double near = 1e-7;
  if ((here.flags & Clamp) != 0 &&
      std::min(std::abs(before.value - here.value), std::abs(after.value - here.value)) <= near)
  {
    return 0;
  }
  const double left = slopeBetween(before, here);
  const double right = slopeBetween(here, after);
  double slope = slopeBetween(before, after);
  if ((here.flags & TimeIndependent) == 0)
  {
    const double place = (here.time - before.time) / (after.time - before.time);
    slope = slope * 0.5 + (left * (1 - place) + right * place) * 0.5;
    const double share = std::abs(bias) / 100;
    if (share > 1e-4)
    {
      const double target = bias > 0 ? right : left;
      const double change = target - slope;
      slope = slope * (1 - share) + target * share + beyondBias(bias, std::abs(change) > 1e-5 ? change : bias);
    }
  }
  if ((here.flags & ClampProgressive) != 0)
  {
    // no further than the neighbours' values within the tangents' lengths
    const double sign = slope >= 0 ? 1 : -1;
    const double most[2] = { leftWeight > 0 ? sign * left / leftWeight : 0,
      rightWeight > 0 ? sign * right / rightWeight : 0 };
    slope = sign * std::min({ sign * slope, std::max(most[0], 0.0), std::max(most[1], 0.0) });
  }
  return slope;
}

/// The same for the first or the last key, whose neighbour is `other`.
double automaticAtEnd(const Key& here, const Key& other, double bias)
{
  constexpr double near = 1e-7;
  if ((here.flags & ClampProgressive) != 0 || ((here.flags & Clamp) != 0 && std::abs(here.value - other.value) <= near))
  {
    return 0;
  }
  const double slope = slopeBetween(here, other);
  return (here.flags & TimeIndependent) != 0 ? slope : slope + beyondBias(bias, bias);
}

/// Slopes and lengths (shares of the time to the neighbour) of a key's two tangents.
struct Tangents
{
  double slope[2]{};
  double weight[2]{ third, third };
};

/// Kochanek and Bartels 1984.
void tensionContinuityBias(const std::vector<Key>& keys, std::size_t i, Tangents& to)
{
  const double left = i > 0 ? slopeBetween(keys[i - 1], keys[i]) : 0;
  const double right = i + 1 < keys.size() ? slopeBetween(keys[i], keys[i + 1]) : 0;
  const double half = i > 0 && i + 1 < keys.size() ? 0.5 : 1;
  const auto [tension, continuity, bias] = keys[i].data;
  for (std::size_t side = 0; side < 2; ++side)
  {
    const double c = side == 0 ? -continuity : continuity;
    to.slope[side] = half * (1 - tension) * ((1 + bias) * (1 + c) * left + (1 - bias) * (1 - c) * right);
  }
}

void automaticTangents(const std::vector<Key>& keys, std::size_t i, Tangents& to)
{
  const double leftBias = -to.slope[0];
  const double rightBias = to.slope[1];
  if (keys.size() == 1)
  {
    to.slope[0] = to.slope[1] = 0;
  }
  else if (i == 0)
  {
    to.slope[0] = to.slope[1] = automaticAtEnd(keys[0], keys[1], rightBias);
  }
  else if (i + 1 == keys.size())
  {
    to.slope[0] = to.slope[1] = automaticAtEnd(keys[i], keys[i - 1], leftBias);
  }
  else
  {
    const bool isOne = std::abs(rightBias - leftBias) <= 1e-4;
    to.slope[1] = automatic(&keys[i], rightBias, to.weight[0], to.weight[1]);
    to.slope[0] = isOne ? to.slope[1] : automatic(&keys[i], leftBias, to.weight[0], to.weight[1]);
  }
}

std::vector<Tangents> tangentsOf(const std::vector<Key>& keys)
{
  std::vector<Tangents> all(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    const Key& key = keys[i];
    Tangents& own = all[i];
    const bool isCubic = (key.flags & IsCubic) != 0 && (key.flags & IsConstant) == 0;
    const bool isLinear = (key.flags & (IsCubic | IsConstant)) == 0;
    double next = 0;
    if (isCubic)
    {
      own.slope[1] = key.data[0];
      own.weight[1] = key.weights[0];
      next = key.data[1];
      if ((key.flags & TangentTcb) != 0)
      {
        tensionContinuityBias(keys, i, own);
        next = 0;
      }
      else if ((key.flags & TangentUser) == 0)
      {
        automaticTangents(keys, i, own);
      }
    }
    else if (isLinear && i + 1 < keys.size())
    {
      own.slope[1] = next = slopeBetween(key, keys[i + 1]);
    }
    if (i + 1 < keys.size())
    {
      all[i + 1].slope[0] = next;
      all[i + 1].weight[0] = isCubic && (key.flags & TangentTcb) == 0 ? key.weights[1] : third;
    }
  }
  return all;
}

void readExtrapolation(const FbxElement& element, const char* name, std::size_t side, Curve& to)
{
  const FbxElement* found = element.find(name);
  const FbxElement* type = found != nullptr ? found->find("Type") : nullptr;
  if (type == nullptr)
  {
    return;
  }
  constexpr std::pair<char, Extrapolation> modes[] = { { 'A', Extrapolation::RepeatRelative },
    { 'K', Extrapolation::Slope }, { 'M', Extrapolation::Mirror }, { 'R', Extrapolation::Repeat } };
  const std::int64_t letter = type->text(0).empty() ? type->integer(0, 0) : type->text(0)[0];
  for (const auto& [known, mode] : modes)
  {
    to.extrapolation[side] = letter == known ? mode : to.extrapolation[side];
  }
  if (const FbxElement* repeats = found->find("Repetition"))
  {
    to.repeats[side] = static_cast<std::int32_t>(std::clamp<std::int64_t>(repeats->integer(0, -1), -1, 1'000'000'000));
  }
}
} // namespace

Curve readFbxCurve(const FbxElement& element, double begin, double ticks)
{
  Curve to;
  readExtrapolation(element, "Pre-Extrapolation", 0, to);
  readExtrapolation(element, "Post-Extrapolation", 1, to);
  const std::vector<Key> keys = readKeys(element, begin, ticks);
  const std::vector<Tangents> tangents = tangentsOf(keys);
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    const Key& key = keys[i];
    to.times.push_back(key.time);
    to.values.push_back(key.value);
    to.segments.push_back((key.flags & IsConstant) != 0
                            ? ((key.flags & ConstantNext) != 0 ? Segment::StepToNext : Segment::Step)
                          : (key.flags & IsCubic) != 0 ? Segment::Bezier
                                                       : Segment::Linear);
    std::array<double, 4>& handles = to.handles.emplace_back();
    if (i + 1 < keys.size())
    {
      const double length = keys[i + 1].time - key.time;
      const double first = std::clamp(tangents[i].weight[1], 0.0, 1.0) * length;
      const double second = std::clamp(tangents[i + 1].weight[0], 0.0, 1.0) * length;
      handles = { first, first * tangents[i].slope[1], second, second * tangents[i + 1].slope[0] };
    }
  }
  if (!keys.empty())
  {
    to.slopes = { tangents.front().slope[1], tangents.back().slope[0] };
  }
  const auto finite = [](double x) { return std::isfinite(x); };
  const auto finiteHandles = [finite](const std::array<double, 4>& four)
  { return std::all_of(four.begin(), four.end(), finite); };
  if (!std::all_of(to.handles.begin(), to.handles.end(), finiteHandles) ||
      !std::all_of(to.slopes.begin(), to.slopes.end(), finite))
  {
    return {};
  }
  return to;
}

} // namespace dgtk::import
