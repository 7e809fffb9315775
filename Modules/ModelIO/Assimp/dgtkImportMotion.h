// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkImportMotion_h
#define dgtkImportMotion_h

#include <array>
#include <cstdint>
#include <vector>

/// How things move in FBX files: a part of what dgtk-import hands to the library (dgtkAssimpStream.h).
namespace dgtk::import
{

/// What a curve does from a key to the next one.
enum class Segment : std::int32_t
{
  Step,       ///< the key's value
  StepToNext, ///< the next key's value
  Linear,
  Bezier ///< a cubic Bezier curve of time and value
};

/// What a curve does before its first or after its last key.
enum class Extrapolation : std::int32_t
{
  Constant,
  Slope,         ///< goes on as it began or ended
  Repeat,        ///< from the other end again
  Mirror,        ///< there and back
  RepeatRelative ///< again, from the value that it had reached
};

struct Curve
{
  std::vector<double> times; ///< seconds, increasing
  std::vector<double> values;
  std::vector<Segment> segments; ///< one a key
  /// Of Bezier segments, one a key: time and value of the first control point from the key, and to the next key from
  /// the second one.
  std::vector<std::array<double, 4>> handles;
  std::array<Extrapolation, 2> extrapolation{};  ///< before, after
  std::array<std::int32_t, 2> repeats{ -1, -1 }; ///< how often; -1: for ever
  std::array<double, 2> slopes{};                ///< of Extrapolation::Slope, a second
};

/// How a layer of an animation changes what those below it say.
enum class LayerMode : std::int32_t
{
  Replace,
  Blend, ///< with its weight, the rest from below
  Add    ///< times its weight
};

/// A vector over time, as one layer has it.
struct Layer
{
  LayerMode mode = LayerMode::Replace;
  std::int32_t composed = 0; ///< rotations are joined as rotations, scales as factors, instead of number by number
  double weight = 1;
  std::int32_t weightCurve = -1; ///< per cent
  std::array<double, 3> values{};
  std::array<std::int32_t, 3> curves{ -1, -1, -1 }; ///< indices of the animation's curves instead of values
};

/// How a node takes over what scales its parent (the FBX SDK's names).
enum class Inherit : std::int32_t
{
  RrSs, ///< the parent's scale, in the node's own axes
  RSrs, ///< the parent's whole transform
  Rrs   ///< not the parent's own scale
};

/// Where a node is in its parent: translation * before * rotation * middle * scale * after.
struct Joint
{
  std::array<double, 3> translation{};
  std::array<double, 3> rotation{}; ///< degrees
  std::array<double, 3> scale{ 1, 1, 1 };
  std::array<std::int32_t, 3> order{ 0, 1, 2 }; ///< axes, the first one turned about first
  Inherit inherit = Inherit::RSrs;
  std::array<double, 16> before{}; ///< row-major, these three without scale
  std::array<double, 16> middle{};
  std::array<double, 16> after{};
};

enum class JointPart : std::int32_t
{
  Translation,
  Rotation,
  Scale
};

struct JointChannel
{
  std::int32_t node = -1;
  JointPart part = JointPart::Translation;
  std::vector<Layer> layers;
};

/// Targets of a mesh that one percentage mixes: each is reached at its own.
struct Blend
{
  std::int32_t number = 0; ///< that of its BlendChannel
  double percent = 0;      ///< when no animation says otherwise
  std::vector<std::uint32_t> targets;
  std::vector<double> full; ///< percentages, increasing
};

struct BlendChannel
{
  std::int32_t number = 0;
  std::vector<Layer> layers; ///< the first component counts
};

template <class A>
void io(A& a, Curve& c)
{
  a(c.times), a(c.values), a(c.segments), a(c.handles), a(c.extrapolation), a(c.repeats), a(c.slopes);
}
template <class A>
void io(A& a, Layer& l)
{
  a(l.mode), a(l.composed), a(l.weight), a(l.weightCurve), a(l.values), a(l.curves);
}
template <class A>
void io(A& a, Joint& j)
{
  a(j.translation), a(j.rotation), a(j.scale), a(j.order), a(j.inherit), a(j.before), a(j.middle), a(j.after);
}
template <class A>
void io(A& a, JointChannel& c)
{
  a(c.node), a(c.part), a(c.layers);
}
template <class A>
void io(A& a, Blend& b)
{
  a(b.number), a(b.percent), a(b.targets), a(b.full);
}
template <class A>
void io(A& a, BlendChannel& c)
{
  a(c.number), a(c.layers);
}

} // namespace dgtk::import

#endif
