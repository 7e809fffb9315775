// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJointMotion.h"

#include "dgtkJointPose.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
using import::Extrapolation;
using import::Joint;
using import::JointPart;
using import::Layer;
using import::LayerMode;
using import::Transform;
using Triple = std::array<double, 3>;

/// The parameter at which a cubic Bezier curve from 0 to 1 with control points `first` and `second` has the value `x`;
/// all are in [0, 1], so that it rises.
double parameterAt(double first, double second, double x)
{
  double low = 0;
  double high = 1;
  double t = x;
  for (int step = 0; step < 100; ++step)
  {
    const double u = 1 - t;
    const double error = 3 * u * t * (u * first + t * second) + t * t * t - x;
    (error > 0 ? high : low) = t;
    const double slope = 3 * (u * u * first + 2 * u * t * (second - first) + t * t * (1 - second));
    double next = t - (slope > 0 ? error / slope : 0);
    next = next > low && next < high ? next : (low + high) / 2;
    if (error == 0 || std::abs(next - t) < 1e-16)
    {
      break;
    }
    t = next;
  }
  return t;
}

/// Between the first and the last key.
double inside(const import::Curve& curve, double time)
{
  const auto after = std::upper_bound(curve.times.begin(), curve.times.end(), time);
  if (after == curve.times.begin())
  {
    return curve.values.front();
  }
  const auto i = static_cast<std::size_t>(after - curve.times.begin()) - 1;
  if (after == curve.times.end() || curve.times[i] == time)
  {
    return curve.values[i];
  }
  const double begin = curve.values[i];
  const double end = curve.values[i + 1];
  const double length = curve.times[i + 1] - curve.times[i];
  const double share = (time - curve.times[i]) / length;
  switch (curve.segments[i])
  {
    case import::Segment::Step:
      return curve.times[i + 1] - time <= roundingOf(time) ? end : begin;
    case import::Segment::StepToNext:
      return time - curve.times[i] <= roundingOf(time) ? begin : end;
    case import::Segment::Linear:
      return begin * (1 - share) + end * share;
    default:
      break;
  }
  const std::array<double, 4>& handles = curve.handles[i];
  const double t = parameterAt(handles[0] / length, 1 - handles[2] / length, share);
  const double u = 1 - t;
  return u * u * u * begin + 3 * u * u * t * (begin + handles[1]) + 3 * u * t * t * (end - handles[3]) +
         t * t * t * end;
}

/// Before the first or after the last key.
double beyond(const import::Curve& curve, double time)
{
  const bool isBefore = time < curve.times.front();
  const std::size_t side = isBefore ? 0 : 1;
  const double first = curve.times.front();
  const double last = curve.times.back();
  const double value = isBefore ? curve.values.front() : curve.values.back();
  const double away = isBefore ? first - time : time - last;
  const double length = last - first;
  const Extrapolation mode = curve.extrapolation[side];
  if (mode == Extrapolation::Slope)
  {
    return value + curve.slopes[side] * (isBefore ? -away : away);
  }
  if (mode == Extrapolation::Constant || !(length > 0) || curve.repeats[side] == 0)
  {
    return value;
  }
  double rounds = std::floor(away / length);
  double rest = away - rounds * length;
  if (curve.repeats[side] > 0 && rounds >= curve.repeats[side])
  {
    rounds = curve.repeats[side] - 1;
    rest = length;
  }
  const bool isMirrored = mode == Extrapolation::Mirror && std::fmod(rounds, 2) == 0;
  const bool isBackward = isMirrored != isBefore;
  const double found = inside(curve, isBackward ? last - rest : first + rest);
  const double gain = curve.values.back() - curve.values.front();
  return mode == Extrapolation::RepeatRelative ? found + (isBefore ? -gain : gain) * (rounds + 1) : found;
}

/// Degrees of a rotation about three axes, about `order[0]` first.
Triple anglesOf(const Eigen::Matrix3d& r, const std::array<std::int32_t, 3>& order)
{
  const auto [i, j, k] = order;
  const double parity = (i + 1) % 3 == j ? 1 : -1;
  const double sine = std::clamp(-parity * r(k, i), -1.0, 1.0);
  Triple angles{};
  angles[std::size_t(j)] = portable::asin(sine);
  if (std::abs(sine) < 1 - 1e-14)
  {
    angles[std::size_t(i)] = portable::atan2(parity * r(k, j), r(k, k));
    angles[std::size_t(k)] = portable::atan2(parity * r(j, i), r(i, i));
  }
  else
  {
    angles[std::size_t(i)] = portable::atan2(-parity * r(j, k), r(j, j)); // only the sum of both is given
  }
  for (double& angle : angles)
  {
    angle *= 180 / pi;
  }
  return angles;
}

/// Of angles in degrees, about `order[0]` first.
Eigen::Quaterniond rotationOf(const Triple& degrees, const std::array<std::int32_t, 3>& order)
{
  Eigen::Quaterniond all = Eigen::Quaterniond::Identity();
  for (const std::int32_t axis : order)
  {
    const double half = degrees[std::size_t(axis)] * pi / 360;
    Eigen::Quaterniond one(portable::cos(half), 0, 0, 0);
    one.vec()[axis] = portable::sin(half);
    all = one * all;
  }
  return all;
}

/// Of a weight as the exponent: what has none does not count, whatever it is.
double power(double base, double exponent)
{
  if (exponent <= 0 || exponent >= 1)
  {
    return exponent <= 0 ? 1 : base;
  }
  const double size = portable::pow(std::abs(base), exponent);
  return base < 0 ? -size : size;
}

/// A layer on top of what is below it: the vector that both make.
Triple combined(const Triple& below, const Triple& own, const Layer& layer, double weight, JointPart part,
  const std::array<std::int32_t, 3>& order)
{
  const bool isBlend = layer.mode == LayerMode::Blend;
  if (layer.composed != 0 && part == JointPart::Rotation)
  {
    const Eigen::Quaterniond a = rotationOf(below, order);
    const Eigen::Quaterniond b = rotationOf(own, order);
    const Eigen::Quaterniond both =
      isBlend ? slerp(a, b, weight) : a * slerp(Eigen::Quaterniond::Identity(), b, weight);
    return anglesOf(both.normalized().toRotationMatrix(), order);
  }
  Triple both;
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (layer.composed != 0 && part == JointPart::Scale)
    {
      both[i] = (isBlend ? power(below[i], 1 - weight) : below[i]) * power(own[i], weight);
    }
    else
    {
      both[i] = (isBlend ? below[i] * (1 - weight) : below[i]) + own[i] * weight;
    }
  }
  return both;
}

Triple valueOf(const std::vector<Layer>& layers, const import::Animation& animation, double time, Triple value,
  JointPart part, const std::array<std::int32_t, 3>& order)
{
  const auto curve = [&](std::int32_t index, double otherwise)
  { return index >= 0 ? valueAt(animation.curves[static_cast<std::size_t>(index)], time) : otherwise; };
  for (const Layer& layer : layers)
  {
    Triple own;
    for (std::size_t i = 0; i < 3; ++i)
    {
      own[i] = curve(layer.curves[i], layer.values[i]);
    }
    const double weight = std::clamp(curve(layer.weightCurve, 100 * layer.weight) / 100, 0.0, 1.0);
    value = layer.mode == LayerMode::Replace ? own : combined(value, own, layer, weight, part, order);
  }
  return value;
}

/// Joints as an animation has them.
std::vector<Joint> jointsAt(const std::vector<import::Node>& nodes, const import::Animation* animation, double time)
{
  std::vector<Joint> joints(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    joints[i] = nodes[i].joint.empty() ? Joint() : nodes[i].joint.front();
  }
  if (animation == nullptr)
  {
    return joints;
  }
  for (const import::JointChannel& channel : animation->joints)
  {
    Joint& joint = joints[static_cast<std::size_t>(channel.node)];
    Triple& value = channel.part == JointPart::Translation ? joint.translation
                    : channel.part == JointPart::Rotation  ? joint.rotation
                                                           : joint.scale;
    value = valueOf(channel.layers, *animation, time, value, channel.part, joint.order);
  }
  return joints;
}

/// What children take over from a node.
struct Inherited
{
  Eigen::Affine3d unscaled = Eigen::Affine3d::Identity(); ///< model_from_node without the node's own scale
  Eigen::Vector3d scale{ 1, 1, 1 };                       ///< its own, and what it has taken over
  Eigen::Vector3d taken{ 1, 1, 1 };                       ///< what it has taken over
};
} // namespace

Eigen::Affine3d affineOf(const import::Matrix& matrix)
{
  Eigen::Affine3d result(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(matrix.data()));
  result.makeAffine();
  return result;
}

double roundingOf(double time) { return 1e-6 * std::max(1.0, std::abs(time)); }

double valueAt(const import::Curve& curve, double time)
{
  const bool isInside = time >= curve.times.front() && time <= curve.times.back();
  return curve.times.size() == 1 ? curve.values.front() : isInside ? inside(curve, time) : beyond(curve, time);
}

Eigen::Quaterniond slerp(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double u)
{
  const double cosine = a.dot(b);
  const double angle = 2 * portable::asin(std::sqrt(std::max(0.0, (1 - std::abs(cosine)) / 2)));
  const double sine = portable::sin(angle);
  const double first = sine < 1e-9 ? 1 - u : portable::sin((1 - u) * angle) / sine;
  const double second = sine < 1e-9 ? u : portable::sin(u * angle) / sine;
  return Eigen::Quaterniond(first * a.coeffs() + (cosine < 0 ? -second : second) * b.coeffs());
}

std::vector<Eigen::Affine3d> poseOf(const std::vector<import::Node>& nodes,
  const std::vector<Eigen::Affine3d>& parent_from_node, const import::Animation* animation, double time)
{
  std::vector<Eigen::Affine3d> pose = parent_from_node;
  const bool hasJoints =
    std::any_of(nodes.begin(), nodes.end(), [](const import::Node& node) { return !node.joint.empty(); });
  const std::vector<Joint> joints = hasJoints ? jointsAt(nodes, animation, time) : std::vector<Joint>();
  std::vector<Inherited> inherited(hasJoints ? nodes.size() : 0);
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    const bool hasParent = nodes[i].parent >= 0;
    const auto above = static_cast<std::size_t>(std::max(nodes[i].parent, 0));
    if (nodes[i].joint.empty())
    {
      pose[i] = hasParent ? pose[above] * parent_from_node[i] : parent_from_node[i];
      continue;
    }
    const Joint& joint = joints[i];
    const Transform before(joint.before);
    const Transform turn = Transform::turn(joint.rotation, joint.order);
    const Transform middle(joint.middle);
    Eigen::Affine3d own = affineOf((Transform::shift(joint.translation) * before * turn * middle *
                                    Transform::scale(joint.scale) * Transform(joint.after))
                                     .matrix());
    const Inherited from = hasParent ? inherited[above] : Inherited();
    Inherited& to = inherited[i];
    Eigen::Affine3d model_from_parent = hasParent ? pose[above] : Eigen::Affine3d(Eigen::Affine3d::Identity());
    if (joint.inherit != import::Inherit::RSrs)
    {
      model_from_parent = from.unscaled;
      own.translation() = own.translation().cwiseProduct(from.scale);
      to.taken = joint.inherit == import::Inherit::RrSs ? from.scale : from.taken;
    }
    to.scale = Eigen::Vector3d(joint.scale.data()).cwiseProduct(to.taken);
    Eigen::Affine3d turned = own;
    turned.linear() = affineOf((before * turn * middle).matrix()).linear();
    own.linear() = turned.linear() * to.scale.asDiagonal();
    to.unscaled = model_from_parent * turned;
    pose[i] = model_from_parent * own;
  }
  return pose;
}

double percentAt(const import::Blend& blend, const import::Animation* animation, double time)
{
  double percent = blend.percent;
  if (animation != nullptr)
  {
    const std::vector<import::BlendChannel>& all = animation->blends;
    const auto found = std::lower_bound(all.begin(), all.end(), blend.number,
      [](const import::BlendChannel& channel, std::int32_t number) { return channel.number < number; });
    if (found != all.end() && found->number == blend.number)
    {
      percent = valueOf(found->layers, *animation, time, { percent, 0, 0 }, JointPart::Translation, {})[0];
    }
  }
  return percent;
}

void addWeights(const import::Blend& blend, double percent, std::vector<double>& weights)
{
  // away from 0: between nothing, which is there, and the first target of that side (else of the other one), or two
  // neighbours; the line of the last two goes on
  const auto count = static_cast<std::ptrdiff_t>(blend.full.size());
  const std::ptrdiff_t negative =
    std::find_if(blend.full.begin(), blend.full.end(), [](double full) { return full >= 0; }) - blend.full.begin();
  const std::ptrdiff_t side = percent > 0 ? 1 : -1;
  const std::ptrdiff_t nearest = side > 0 ? negative : negative - 1;
  const bool hasSide = nearest >= 0 && nearest < count;
  const std::ptrdiff_t first = hasSide ? nearest : nearest - side;
  std::ptrdiff_t next = first;
  while (hasSide && next + side >= 0 && next + side < count &&
         double(side) * blend.full[std::size_t(next)] <= double(side) * percent)
  {
    next += side;
  }
  if (next < 0 || next >= count)
  {
    return;
  }
  const double begin = next == first ? 0 : blend.full[std::size_t(next - side)];
  const double length = blend.full[std::size_t(next)] - begin;
  const double share = length != 0 ? (percent - begin) / length : 0;
  weights[blend.targets[std::size_t(next)]] += share;
  if (next != first)
  {
    weights[blend.targets[std::size_t(next - side)]] += 1 - share;
  }
}

void DualQuaternions::add(const Eigen::Affine3d& transform, double weight)
{
  Eigen::Vector3d scale = transform.linear().colwise().norm().transpose();
  scale[2] = transform.linear().determinant() < 0 ? -scale[2] : scale[2];
  Eigen::Matrix3d rotation = transform.linear();
  for (int i = 0; i < 3; ++i)
  {
    rotation.col(i) /= scale[i] != 0 ? scale[i] : 1;
  }
  const Eigen::Quaterniond real(rotation);
  const Eigen::Vector3d half = 0.5 * transform.translation();
  const Eigen::Quaterniond dual = Eigen::Quaterniond(0, half[0], half[1], half[2]) * real;
  this->First = this->Total == 0 ? Eigen::Vector4d(real.coeffs()) : this->First;
  const double sign = this->First.dot(real.coeffs()) < 0 ? -weight : weight;
  this->Real += sign * real.coeffs();
  this->Dual += sign * dual.coeffs();
  this->Scale += weight * scale;
  this->Total += weight;
}

Eigen::Vector3d DualQuaternions::operator()(const Eigen::Vector3d& point) const
{
  const double length = this->Real.norm();
  const Eigen::Quaterniond real(Eigen::Vector4d(this->Real / length));
  const Eigen::Quaterniond dual(Eigen::Vector4d(this->Dual / length));
  const Eigen::Vector3d translation = 2 * (dual * real.conjugate()).vec();
  return real.toRotationMatrix() * (this->Scale / this->Total).cwiseProduct(point) + translation;
}

} // namespace dgtk
