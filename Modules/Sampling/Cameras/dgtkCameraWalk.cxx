// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraWalk.h"

#include "dgtkPathRule.h"
#include "dgtkPortableMath.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <optional>

namespace dgtk
{

using namespace samplerule;

namespace
{
constexpr std::uint32_t triesAStep = 64;

struct WalkRule
{
  Eigen::Vector3d least;
  Eigen::Vector3d most;
  std::optional<Eigen::Vector3d> start;
  double speed = 0;     ///< scene units a frame
  double turn = 0;      ///< degrees a frame
  double clearance = 0; ///< scene units
  bool level = true;
  int attempts = 100;
  std::vector<int> frames;
};

WalkRule readWalk(const JsonCursor& at)
{
  onlyKeys(at, { "box", "start", "speed", "turn", "clearance", "level", "attempts", "frames" });
  WalkRule rule;
  const JsonCursor box = at["box"];
  box.listSize(2);
  rule.least = box.element(0).vector(coordinate);
  rule.most = box.element(1).vector(coordinate);
  if ((rule.least.array() > rule.most.array()).any())
  {
    box.fail("is empty", "[[least x, y, z], [most x, y, z]]");
  }
  if (at.has("start"))
  {
    rule.start = at["start"].vector(coordinate);
  }
  constexpr Range turns{ 0, 180, true, false, "degrees above 0, at most 180" };
  rule.speed = at["speed"].number(positive);
  rule.turn = at.has("turn") ? at["turn"].number(turns) : 10;
  rule.clearance = at.has("clearance") ? at["clearance"].number(notNegative) : 0;
  rule.level = !at.has("level") || at["level"].boolean();
  rule.attempts = attemptsOf(at);
  rule.frames = framesOf(at);
  return rule;
}

bool isInside(const WalkRule& rule, const Eigen::Vector3d& x)
{
  return (x.array() >= rule.least.array()).all() && (x.array() <= rule.most.array()).all();
}

/// Whether every point between two whose distances are known keeps the clearance: a distance changes by no more than
/// what is walked, so that halves that are short enough are proven by their ends.
bool keepsClear(const SurfaceDistance& surfaces, const Eigen::Vector3d& a, double atA, const Eigen::Vector3d& b,
  double atB, double clearance, int depth)
{
  if (atA < clearance || atB < clearance)
  {
    return false;
  }
  const double length = (b - a).norm();
  if (atA + atB - length >= 2 * clearance)
  {
    return true;
  }
  if (depth == 0)
  {
    return false;
  }
  const Eigen::Vector3d middle = (a + b) / 2;
  const double atMiddle = surfaces.at(middle);
  return keepsClear(surfaces, a, atA, middle, atMiddle, clearance, depth - 1) &&
         keepsClear(surfaces, middle, atMiddle, b, atB, clearance, depth - 1);
}

/// One try of a walk.
class Walker
{
public:
  Walker(const WalkRule& rule, SampleWorld& world, UpAxis up, const SampleDraws& draws, std::string path,
    std::uint32_t attempt)
    : Rule(rule)
    , World(world)
    , Up(up == UpAxis::Y ? 1 : 2)
    , Draws(draws)
    , Path(std::move(path))
    , Attempt(attempt)
  {
  }

  /// The places at the frames and where the walk goes on from the last one; nothing when it ends before.
  std::optional<std::vector<Eigen::Vector3d>> walk()
  {
    Eigen::Vector3d place = this->Rule.start ? *this->Rule.start : this->anyPlace();
    if (!isInside(this->Rule, place) ||
        this->World.surfacesAt(this->Rule.frames.front()).at(place) < this->Rule.clearance)
    {
      return {};
    }
    Eigen::Vector3d heading = this->anyDirection(this->next());
    std::vector<Eigen::Vector3d> places{ place };
    for (std::size_t i = 1; i < this->Rule.frames.size(); ++i)
    {
      for (int frame = this->Rule.frames[i - 1]; frame < this->Rule.frames[i]; ++frame)
      {
        if (!this->step(frame, place, heading))
        {
          return {};
        }
      }
      places.push_back(place);
    }
    places.emplace_back(place + heading);
    return places;
  }

private:
  std::array<double, 2> next() { return this->Draws.uniforms(this->Path, this->Draw++, this->Attempt); }

  Eigen::Vector3d anyPlace()
  {
    const std::array<double, 2> u = this->next();
    const std::array<double, 2> v = this->next();
    return this->Rule.least + Eigen::Vector3d(u[0], u[1], v[0]).cwiseProduct(this->Rule.most - this->Rule.least);
  }

  Eigen::Vector3d anyDirection(const std::array<double, 2>& u) const
  {
    const portable::SineCosine turn = portable::sinCos(2 * pi * u[0]);
    const double height = this->Rule.level ? 0 : 2 * u[1] - 1;
    const double across = std::sqrt(1 - height * height);
    Eigen::Vector3d direction;
    direction[this->Up] = height;
    direction[(this->Up + 1) % 3] = across * turn.cosine;
    direction[(this->Up + 2) % 3] = across * turn.sine;
    return direction;
  }

  /// Within the largest turn of a heading.
  Eigen::Vector3d turned(const Eigen::Vector3d& heading)
  {
    const std::array<double, 2> u = this->next();
    if (this->Rule.level)
    {
      const portable::SineCosine turn = portable::sinCos((2 * u[0] - 1) * this->Rule.turn * (pi / 180));
      Eigen::Vector3d direction = heading;
      const int a = (this->Up + 1) % 3;
      const int b = (this->Up + 2) % 3;
      direction[a] = turn.cosine * heading[a] - turn.sine * heading[b];
      direction[b] = turn.sine * heading[a] + turn.cosine * heading[b];
      return direction / direction.norm();
    }
    // Uniform over the cap of the sphere around the heading.
    const double cosine = 1 - u[0] * (1 - portable::sinCos(this->Rule.turn * (pi / 180)).cosine);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    Eigen::Index thin = 0;
    heading.cwiseAbs().minCoeff(&thin);
    Eigen::Vector3d side = heading.cross(Eigen::Vector3d::Unit(thin));
    side /= side.norm();
    const portable::SineCosine around = portable::sinCos(2 * pi * u[1]);
    const Eigen::Vector3d direction =
      cosine * heading + sine * (around.cosine * side + around.sine * heading.cross(side));
    return direction / direction.norm();
  }

  bool step(int frame, Eigen::Vector3d& place, Eigen::Vector3d& heading)
  {
    const SurfaceDistance& before = this->World.surfacesAt(frame);
    const SurfaceDistance& after = this->World.surfacesAt(frame + 1);
    const double atPlace = before.at(place);
    for (std::uint32_t i = 0; i < triesAStep; ++i)
    {
      const Eigen::Vector3d direction = this->turned(heading);
      const Eigen::Vector3d next = place + this->Rule.speed * direction;
      constexpr int halvings = 12;
      if (isInside(this->Rule, next) && after.at(next) >= this->Rule.clearance &&
          keepsClear(before, place, atPlace, next, before.at(next), this->Rule.clearance, halvings))
      {
        place = next;
        heading = direction;
        return true;
      }
    }
    return false;
  }

  const WalkRule& Rule;
  SampleWorld& World;
  int Up;
  const SampleDraws& Draws;
  std::string Path;
  std::uint32_t Attempt;
  std::uint32_t Draw = 0;
};
} // namespace

TravelledPath walkedPath(const JsonCursor& at, const std::string& path, SampleWorld& world, UpAxis up,
  const SampleDraws& draws, std::uint32_t attempt, bool looks)
{
  const WalkRule rule = readWalk(at);
  for (int i = 0; i < rule.attempts; ++i)
  {
    const auto places = Walker(rule, world, up, draws, path + '/' + std::to_string(i), attempt).walk();
    if (!places)
    {
      continue;
    }
    TravelledPath found;
    found.attempts = i + 1;
    for (std::size_t k = 0; k < rule.frames.size(); ++k)
    {
      found.eye.push_back({ rule.frames[k], (*places)[k] });
      if (!looks)
      {
        const Eigen::Vector3d way = (*places)[k + 1] - (*places)[k];
        found.lookAt.push_back({ rule.frames[k], (*places)[k] + way / way.norm() });
      }
    }
    return found;
  }
  throw SampleRefused(path,
    "no way of " + std::to_string(rule.frames.back() - rule.frames.front()) +
      " frames was found that stays in the box and keeps the clearance",
    rule.attempts);
}

} // namespace dgtk
