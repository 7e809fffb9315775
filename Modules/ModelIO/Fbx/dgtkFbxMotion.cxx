// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFbxMotion.h"

#include "dgtkFbxCurve.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace dgtk::import
{

namespace
{
/// What an AnimationCurveNode drives: a part of a node, or a blend channel.
struct Driven
{
  std::int32_t node = noIndex;
  JointPart part = JointPart::Translation;
  std::int32_t blend = noIndex;
  std::array<double, 3> standing{}; ///< its value where nothing drives it

  bool operator<(const Driven& other) const
  {
    return std::tie(this->node, this->part, this->blend) < std::tie(other.node, other.part, other.blend);
  }
};

/// What changes nothing when it is added, or a scale multiplied.
std::array<double, 3> neutral(bool isFactor)
{
  const double one = isFactor ? 1 : 0;
  return { one, one, one };
}

class StackReader
{
public:
  StackReader(const FbxScene& scene, const FbxTargets& targets, std::size_t stack)
    : Scene(scene)
    , Targets(targets)
    , Stack(stack)
  {
  }

  Animation run()
  {
    const FbxObject& stack = this->Scene.object(this->Stack);
    this->To.name = stack.name;
    const bool isLocal = stack.says("LocalStop");
    const bool isSaid = isLocal || stack.says("ReferenceStop");
    const std::array<double, 2>* const take = isSaid ? nullptr : this->Scene.take(stack.name);
    const std::array<double, 2> times =
      take != nullptr ? *take
                      : std::array<double, 2>{ double(stack.integer(isLocal ? "LocalStart" : "ReferenceStart", 0)),
                          double(stack.integer(isLocal ? "LocalStop" : "ReferenceStop", 0)) };
    this->Begin = times[0];
    this->To.duration = std::max(times[1] - times[0], 0.0) / this->Scene.ticks();
    bool isBase = true;
    for (const std::size_t layer : this->Scene.childrenOf(this->Stack, "AnimationLayer"))
    {
      this->addLayer(layer, isBase);
      isBase = false;
    }
    for (auto& [driven, layers] : this->Layers)
    {
      if (driven.blend != noIndex)
      {
        this->To.blends.push_back({ driven.blend, std::move(layers) });
      }
      else
      {
        this->To.joints.push_back({ driven.node, driven.part, std::move(layers) });
      }
    }
    if (!isSaid && take == nullptr)
    {
      for (const Curve& curve : this->To.curves)
      {
        this->To.duration = std::max(this->To.duration, curve.times.back());
      }
    }
    return std::move(this->To);
  }

private:
  std::optional<Driven> drivenBy(const FbxObject& curves) const
  {
    for (const FbxObject::Link& link : curves.parents)
    {
      Driven driven;
      const auto blend = this->Targets.blends.find({ link.object, link.property });
      if (blend != this->Targets.blends.end())
      {
        driven.blend = blend->second;
        driven.standing[0] = this->Scene.object(link.object).number(link.property, 0);
        return driven;
      }
      driven.node = this->Targets.nodes[link.object];
      constexpr std::pair<const char*, JointPart> parts[] = { { "Lcl Translation", JointPart::Translation },
        { "Lcl Rotation", JointPart::Rotation }, { "Lcl Scaling", JointPart::Scale } };
      for (const auto& [property, part] : parts)
      {
        if (driven.node != noIndex && link.property == property)
        {
          driven.part = part;
          driven.standing = this->Scene.object(link.object).vector(property, neutral(part == JointPart::Scale));
          return driven;
        }
      }
    }
    return std::nullopt;
  }

  /// Index of a curve of the animation, or -1.
  std::int32_t curve(std::size_t object)
  {
    const auto [known, isNew] = this->Curves.try_emplace(object, -1);
    if (isNew)
    {
      Curve curve = readFbxCurve(*this->Scene.object(object).element, this->Begin, this->Scene.ticks());
      if (!curve.times.empty())
      {
        known->second = static_cast<std::int32_t>(this->To.curves.size());
        this->To.curves.push_back(std::move(curve));
      }
    }
    return known->second;
  }

  /// Values and curves of an AnimationCurveNode, whose properties are called "d|X" and so on; what is one number,
  /// "d|" and the name of what it drives. What is not said is `otherwise`.
  void readValues(const FbxObject& curves, const std::array<double, 3>& otherwise, Layer& to)
  {
    constexpr const char* names[] = { "d|X", "d|Y", "d|Z" };
    for (std::size_t i = 0; i < 3; ++i)
    {
      to.values[i] = curves.number(names[i], otherwise[i]);
    }
    for (const FbxObject::Link& link : curves.parents)
    {
      to.values[0] = curves.number("d|" + link.property, to.values[0]);
    }
    for (const FbxObject::Link& link : curves.children)
    {
      if (this->Scene.object(link.object).is("AnimationCurve"))
      {
        const auto component = std::find(std::begin(names), std::end(names), link.property);
        to.curves[component == std::end(names) ? 0 : std::size_t(component - names)] = this->curve(link.object);
      }
    }
  }

  void addLayer(std::size_t index, bool isBase)
  {
    const FbxObject& object = this->Scene.object(index);
    Layer layer;
    const std::int64_t mode = object.integer("BlendMode", 0);
    layer.mode = isBase || (mode != 0 && mode != 2) ? LayerMode::Replace
                 : mode == 0                        ? LayerMode::Add
                                                    : LayerMode::Blend;
    layer.weight = std::clamp(object.number("Weight", 100) / 100, 0.0, 1.0);
    for (const std::size_t curves : this->Scene.childrenOf(index, "AnimationCurveNode"))
    {
      for (const FbxObject::Link& link : this->Scene.object(curves).parents)
      {
        if (link.object == index && link.property == "Weight")
        {
          Layer weight;
          this->readValues(this->Scene.object(curves), {}, weight);
          layer.weightCurve = weight.curves[0];
        }
      }
    }
    for (const std::size_t curves : this->Scene.childrenOf(index, "AnimationCurveNode"))
    {
      const FbxObject& node = this->Scene.object(curves);
      const std::optional<Driven> driven = this->drivenBy(node);
      if (!driven)
      {
        continue;
      }
      Layer own = layer;
      const char* accumulation = driven->blend != noIndex              ? nullptr
                                 : driven->part == JointPart::Rotation ? "RotationAccumulationMode"
                                 : driven->part == JointPart::Scale    ? "ScaleAccumulationMode"
                                                                       : nullptr;
      own.composed = accumulation != nullptr && object.integer(accumulation, 0) == 0 ? 1 : 0;
      this->readValues(node,
        own.mode == LayerMode::Add ? neutral(own.composed != 0 && driven->part == JointPart::Scale) : driven->standing,
        own);
      this->Layers[*driven].push_back(own);
    }
  }

  const FbxScene& Scene;
  const FbxTargets& Targets;
  std::size_t Stack;
  double Begin = 0;
  Animation To;
  std::map<std::size_t, std::int32_t> Curves;
  std::map<Driven, std::vector<Layer>> Layers;
};
} // namespace

std::vector<Animation> readFbxAnimations(const FbxScene& scene, const FbxTargets& targets)
{
  std::vector<Animation> all;
  for (std::size_t i = 0; i < scene.objects().size(); ++i)
  {
    if (scene.object(i).is("AnimationStack"))
    {
      all.push_back(StackReader(scene, targets, i).run());
    }
  }
  return all;
}

} // namespace dgtk::import
