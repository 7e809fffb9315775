// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPortableMath.h"
#include "dgtkTrack.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

using namespace dgtk;
using Vector = Eigen::Vector3d;

namespace
{
constexpr double rounding = 4e-15; // a dozen operations on numbers of size 1

Quaternion aboutZ(double angle) { return { std::cos(angle / 2), 0, 0, std::sin(angle / 2) }; }

double distance(const Quaternion& a, const Quaternion& b) { return (a - b).norm(); }

/// first, first + step, ... up to last; exact for steps of powers of two.
std::vector<double> steps(int first, int last, double step)
{
  std::vector<double> all;
  for (int i = 0; first + i * step <= last; ++i)
  {
    all.push_back(first + i * step);
  }
  return all;
}
} // namespace

TEST(Track, IsConstantWithoutKeys)
{
  const Track<Vector> track(Vector(1, 2, 3));
  EXPECT_EQ(track.at(-5), Vector(1, 2, 3));
  EXPECT_EQ(track.at(1e9), Vector(1, 2, 3));
}

TEST(Track, InterpolatesAsEquation413)
{
  Track<Vector> track;
  track.keys = { { 2, Vector(1, -3, 7) }, { 12, Vector(6, 2, 7) } };
  for (int frame = 2; frame <= 12; ++frame)
  {
    const Vector expected = Vector(1, -3, 7) + (Vector(6, 2, 7) - Vector(1, -3, 7)) / (12 - 2) * (frame - 2);
    EXPECT_LE((track.at(frame) - expected).norm(), rounding) << frame;
    EXPECT_EQ(track.at(frame)[2], 7); // what does not move stays the same to the bit
  }
}

TEST(Track, HoldsOutsideAndReproducesKeysExactly)
{
  Track<double> track;
  track.keys = { { 0, 0.1 }, { 3, 0.7 }, { 10, -0.3 } };
  for (const Interpolation how : { Interpolation::Linear, Interpolation::Step, Interpolation::Smooth })
  {
    track.interpolation = how;
    EXPECT_EQ(track.at(-7), 0.1);
    EXPECT_EQ(track.at(99), -0.3);
    for (const Key<double>& key : track.keys)
    {
      EXPECT_EQ(track.at(key.frame), key.value);
    }
  }
}

TEST(Track, StepsToTheLastKey)
{
  Track<double> track;
  track.keys = { { 0, 1 }, { 3, 2 } };
  track.interpolation = Interpolation::Step;
  EXPECT_EQ(track.at(2.999), 1);
  EXPECT_EQ(track.at(3), 2);
}

TEST(Track, AKeysOwnInterpolationHoldsUpToTheNext)
{
  Track<double> track;
  track.keys = { { 0, 0 }, { 4, 8, Interpolation::Step }, { 8, 4 }, { 10, 0, Interpolation::Smooth } };
  EXPECT_EQ(track.at(1), 2);
  EXPECT_EQ(track.at(7.99), 8);
  EXPECT_EQ(track.at(8), 4);
  EXPECT_EQ(track.at(9), 2);
  track.interpolation = Interpolation::Step;
  EXPECT_EQ(track.at(3.9), 0) << "a key without a kind of its own has the track's";
  track.keys[0].interpolation = Interpolation::Linear;
  EXPECT_EQ(track.at(3), 6);
  Track<double> smooth;
  smooth.keys = { { 0, 0 }, { 4, 1 }, { 10, -2 } };
  smooth.interpolation = Interpolation::Smooth;
  track.keys = { { 0, 0, Interpolation::Smooth }, { 4, 1, Interpolation::Smooth }, { 10, -2 } };
  EXPECT_EQ(track.at(2.5), smooth.at(2.5));
  EXPECT_EQ(track.at(6.5), smooth.at(6.5));
  Track<Quaternion> turn;
  turn.keys = { { 0, aboutZ(0), Interpolation::Step }, { 10, aboutZ(1) }, { 20, aboutZ(2) } };
  EXPECT_EQ(turn.at(9), aboutZ(0));
  EXPECT_LE(distance(turn.at(15), aboutZ(1.5)), rounding);
}

TEST(Track, SmoothReproducesALineAndHasNoKinks)
{
  Track<Vector> line;
  line.keys = { { 0, Vector(0, 0, 0) }, { 2, Vector(2, 4, 0) }, { 10, Vector(10, 20, 0) } };
  line.interpolation = Interpolation::Smooth;
  for (const double frame : steps(0, 10, 0.25))
  {
    EXPECT_LE((line.at(frame) - Vector(frame, 2 * frame, 0)).norm(), 1e-13) << frame;
  }
  Track<double> bend;
  bend.keys = { { 0, 0 }, { 4, 1 }, { 10, -2 } };
  bend.interpolation = Interpolation::Smooth;
  const double h = 1e-5;
  const double before = (bend.at(4) - bend.at(4 - h)) / h;
  const double after = (bend.at(4 + h) - bend.at(4)) / h;
  EXPECT_NEAR(before, after, 1e-4);
  EXPECT_NEAR(before, (-2 - 0) / 10.0, 1e-4); // Catmull-Rom's tangent
}

TEST(Track, SlerpTurnsAtConstantSpeed)
{
  for (const double angle : { 1e-12, 1e-4, 0.3, 1.5, 3.1 })
  {
    Track<Quaternion> track;
    track.keys = { { 0, aboutZ(0.2) }, { 10, aboutZ(0.2 + angle) } };
    for (const double frame : steps(0, 10, 0.5))
    {
      EXPECT_LE(distance(track.at(frame), aboutZ(0.2 + angle * frame / 10)), rounding) << angle << ' ' << frame;
    }
  }
}

TEST(Track, SlerpTakesTheShorterArc)
{
  Track<Quaternion> track;
  track.keys = { { 0, aboutZ(0) }, { 2, aboutZ(2 * pi - 0.4).scaled(1) } }; // -0.4 the short way
  const Quaternion half = track.at(1);
  EXPECT_LE((half.matrix() - aboutZ(-0.2).matrix()).norm(), rounding);
  track.keys[1].value = aboutZ(-0.4);
  EXPECT_LE((track.at(1).matrix() - half.matrix()).norm(), rounding);
}

TEST(Track, QuaternionKeysAreReturnedAsWritten)
{
  Track<Quaternion> track;
  const Quaternion written{ 0.7071, 0, 0.7071, 0 };
  track.keys = { { 0, written }, { 4, aboutZ(1) } };
  EXPECT_EQ(track.at(0), written);
  EXPECT_NEAR(track.at(1).norm(), 1, rounding);
  const Eigen::Matrix3d R = written.matrix();
  EXPECT_LE((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), rounding);
}

TEST(Track, SmoothRotationsPassThroughTheirKeysWithoutKinks)
{
  Track<Quaternion> track;
  track.interpolation = Interpolation::Smooth;
  track.keys = { { 0, aboutZ(0) }, { 5, aboutZ(1).scaled(-1) },
    { 10, Quaternion{ std::cos(0.4), std::sin(0.4), 0, 0 } } };
  const double h = 1e-5;
  const Eigen::Matrix3d before = (track.at(5).matrix() - track.at(5 - h).matrix()) / h;
  const Eigen::Matrix3d after = (track.at(5 + h).matrix() - track.at(5).matrix()) / h;
  EXPECT_LE((before - after).norm(), 1e-3);
  EXPECT_NEAR(track.at(2.5).norm(), 1, rounding);
}

TEST(Track, SmoothRotationsDoNotDependOnTheSignOfTheirKeys)
{
  // q and -q are one rotation: whichever of them a key holds, the way is the shorter one.
  const double angle[4] = { 0, 0.8, 1.5, 2.9 };
  Track<Quaternion> plain;
  plain.interpolation = Interpolation::Smooth;
  for (int i = 0; i < 4; ++i)
  {
    plain.keys.push_back({ 10 * i, aboutZ(angle[i]) });
  }
  for (int signs = 1; signs < 16; ++signs)
  {
    Track<Quaternion> track = plain;
    for (int i = 0; i < 4; ++i)
    {
      track.keys[i].value = track.keys[i].value.scaled((signs >> i & 1) != 0 ? -1 : 1);
    }
    for (const double frame : steps(0, 30, 1.25))
    {
      EXPECT_LE((track.at(frame).matrix() - plain.at(frame).matrix()).norm(), rounding) << signs << ' ' << frame;
    }
  }
  // Between the keys it turns forward only.
  for (const double frame : steps(1, 30, 1))
  {
    const Vector turned = plain.at(frame).matrix() * Vector(1, 0, 0);
    const Vector before = plain.at(frame - 1).matrix() * Vector(1, 0, 0);
    EXPECT_GT(before.cross(turned).z(), 0.02) << frame;
  }
}

TEST(Track, RotationMatrixIsTheUsualOne)
{
  const Vector turned = aboutZ(pi / 2).matrix() * Vector(1, 0, 0);
  EXPECT_LE((turned - Vector(0, 1, 0)).norm(), rounding);
  // Rodrigues' formula about another axis
  const Vector axis = Vector(1, 2, -2) / 3;
  const double angle = 0.9;
  const Quaternion q{ std::cos(angle / 2), std::sin(angle / 2) * axis[0], std::sin(angle / 2) * axis[1],
    std::sin(angle / 2) * axis[2] };
  const Vector v(0.3, -1, 2);
  const Vector expected =
    v * std::cos(angle) + axis.cross(v) * std::sin(angle) + axis * axis.dot(v) * (1 - std::cos(angle));
  EXPECT_LE((q.matrix() * v - expected).norm(), rounding);
}

TEST(Track, BoundedValuesStayBetweenTheirKeys)
{
  // From 1 on two keys of 0, whose tangents lead below it and above 1.
  Track<double> number;
  number.keys = { { 0, 1 }, { 10, 0 }, { 20, 0 }, { 30, 1 } };
  number.interpolation = Interpolation::Smooth;
  Track<Vector> vector;
  vector.interpolation = Interpolation::Smooth;
  for (const Key<double>& key : number.keys)
  {
    vector.keys.push_back({ key.frame, Vector(key.value, 2 - key.value, 3) });
  }
  EXPECT_LT(number.at(15), -0.1);
  EXPECT_EQ(boundedAt(number, 15), 0);
  EXPECT_GT(vector.at(15).y(), 2.1);
  EXPECT_EQ(boundedAt(vector, 15), Vector(0, 2, 3));
  for (const double frame : steps(-1, 31, 0.25))
  {
    const double value = number.at(frame);
    EXPECT_EQ(boundedAt(number, frame), std::clamp(value, 0.0, 1.0)) << frame;
    EXPECT_EQ(boundedAt(vector, frame), vector.at(frame).cwiseMax(Vector(0, 1, 3)).cwiseMin(Vector(1, 2, 3))) << frame;
  }
  EXPECT_EQ(boundedAt(Track<double>(-7), 3), -7) << "without keys";
}
