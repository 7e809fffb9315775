// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFallen.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int mostStarts = 16; ///< places that are tried for a start low down
constexpr double reach = 0.1;  ///< of the size, or of the mean of all that fall: how far down a body may be laid
constexpr int mostRounds = 4;  ///< of laying again what is not where it can be

double low(const PlaceBody& body, int up) { return body.box().min()[up]; }

/// A box that is wider by the clearance that its body is to keep when it lies.
Eigen::AlignedBox3d columnOf(const PlaceBody& body, double clearance, const PlaceWorld& world)
{
  Eigen::AlignedBox3d box = body.box();
  for (const int axis : world.level())
  {
    box.min()[axis] -= clearance;
    box.max()[axis] += clearance;
  }
  return box;
}

/// Above what is in the way: the body's box over those of the bodies that fall before and those that it would be in.
void raise(PlaceBody& body, double clearance, const std::vector<const PlaceBody*>& still,
  const std::vector<const PlaceBody*>& before, const PlaceWorld& world)
{
  const int up = world.upAxis();
  const double space = 0.01 * body.size();
  for (bool moved = true; moved;)
  {
    moved = false;
    const auto above = [&](const PlaceBody& other)
    {
      body.move(world.up() * (other.box().max()[up] + space - low(body, up)));
      moved = true;
    };
    for (const PlaceBody* other : before)
    {
      if (columnOf(body, clearance, world).intersects(other->box()))
      {
        above(*other);
      }
    }
    for (const PlaceBody* other : still)
    {
      if (body.box().intersects(other->box()) && penetration(body, *other).depth > 0)
      {
        above(*other);
      }
    }
  }
}

/// Of those places that are drawn, the first that is free, or the lowest; why there is none.
std::string startFall(PlaceWorld& world, const FallingObject& it, const SampleDraws& draws,
  const std::vector<const PlaceBody*>& still, const std::vector<const PlaceBody*>& before)
{
  PlaceBody& body = world.body(it.rule->object);
  const int up = world.upAxis();
  std::string why;
  bool found = false;
  Rigid3 best;
  double lowest = 0;
  for (int attempt = 0; attempt < std::min(it.rule->attempts, mostStarts); ++attempt)
  {
    it.note->attempts = attempt + 1;
    const std::string fault = startPlace(world, *it.rule, draws, attempt);
    if (!fault.empty())
    {
      why = fault;
      continue;
    }
    const double first = low(body, up);
    raise(body, it.rule->clearance, still, before, world);
    const bool free = low(body, up) <= first;
    if (!found || low(body, up) < lowest)
    {
      found = true;
      lowest = low(body, up);
      best = body.pose();
    }
    if (free)
    {
      break;
    }
  }
  body.setPose(found ? best : body.pose());
  return found ? std::string() : why;
}

/// Whether a body has stayed where it was to fall: its middle is above the floor of what it fell on or in, between its
/// sides.
bool stayed(PlaceWorld& world, const PlaceRule& rule)
{
  const Eigen::AlignedBox3d box = rule.support ? world.body(*rule.support).box() : rule.box;
  const Eigen::Vector3d middle = world.body(rule.object).middle();
  bool within = middle[world.upAxis()] > box.min()[world.upAxis()];
  for (const int axis : world.level())
  {
    within = within && middle[axis] >= box.min()[axis] && middle[axis] <= box.max()[axis];
  }
  return within;
}

class Drop
{
public:
  Drop(PlaceWorld& world, const SceneDescription& scene, std::vector<FallingObject>& falling)
    : World(world)
    , Falling(falling)
    , Still(world.others({}))
  {
    this->Settings.down = -world.up();
    this->Settings.gravity = 9.81 / (scene.metres() > 0 ? scene.metres() : 1);
    this->Settings.frameTime = 1 / scene.fps;
    for (std::size_t i = 0; i < falling.size(); ++i)
    {
      this->Order.push_back(i);
    }
    std::sort(this->Order.begin(), this->Order.end(),
      [&](std::size_t a, std::size_t b) { return this->body(a).name() < this->body(b).name(); });
  }

  void start(const SampleDraws& draws);
  void fall();
  void lay();

private:
  PlaceBody& body(std::size_t i) { return this->World.body(this->Falling[i].rule->object); }
  void leaveOut(std::size_t i, const std::string& why)
  {
    this->Falling[i].note->kept = false;
    this->Falling[i].note->why = why;
    this->World.takeOut(this->Falling[i].rule->object);
  }
  bool isIn(std::size_t i) const { return this->Falling[i].note->kept; }
  bool leaveOutUnsettled(Fall& fall, bool last);
  double fault(std::size_t i);
  const PlaceBody* tooNear(std::size_t i);
  bool leaveOutNear();
  bool leaveOutUnfit();
  void layOne(std::size_t i);

  PlaceWorld& World;
  std::vector<FallingObject>& Falling;
  std::vector<const PlaceBody*> Still;
  FallSettings Settings;
  std::vector<std::size_t> Order; ///< of names
};

void Drop::start(const SampleDraws& draws)
{
  std::vector<const PlaceBody*> before;
  double sum = 0;
  for (const std::size_t i : this->Order)
  {
    const std::string why = this->body(i).size() > 0 && !this->body(i).pieces().empty()
                              ? startFall(this->World, this->Falling[i], draws, this->Still, before)
                              : "it has no surface";
    if (!why.empty())
    {
      this->leaveOut(i, why);
      continue;
    }
    this->Falling[i].note->kept = true;
    before.push_back(&this->body(i));
    sum += this->body(i).size();
  }
  this->Settings.size = before.empty() ? 1 : sum / double(before.size());
}

/// Takes what fell off, or does not come to rest, out of the fall; whether there was such a body.
bool Drop::leaveOutUnsettled(Fall& fall, bool last)
{
  bool some = false;
  std::size_t at = 0;
  for (const std::size_t i : this->Order)
  {
    if (!this->isIn(i) && this->Falling[i].poses.empty())
    {
      continue; // was never in the fall
    }
    const std::size_t k = at++;
    if (!this->isIn(i))
    {
      continue;
    }
    this->body(i).setPose(fall.pose(k));
    const bool fell = !fall.isIn(k) || !stayed(this->World, *this->Falling[i].rule);
    if (fell || !fall.rests(k))
    {
      this->leaveOut(i, fell ? "it fell off" : "it does not come to rest");
      fall.remove(k);
      some = true;
    }
  }
  return some && !last;
}

void Drop::fall()
{
  std::vector<PlaceBody*> bodies;
  std::vector<FallMatter> matter;
  double seconds = 0;
  double lowest = -1e300;
  for (const PlaceBody* still : this->Still)
  {
    lowest = std::max(
      lowest, this->Settings.down.dot(still->box().center()) + 0.5 * still->box().sizes()[this->World.upAxis()]);
  }
  for (const std::size_t i : this->Order)
  {
    if (this->isIn(i))
    {
      const DropRule& drop = *this->Falling[i].rule->drop;
      bodies.push_back(&this->body(i));
      matter.push_back({ drop.friction, drop.restitution });
      seconds = std::max(seconds, drop.seconds);
      this->Falling[i].poses.push_back(this->body(i).pose());
    }
  }
  if (bodies.empty())
  {
    return;
  }
  Fall fall(this->Settings, this->Still, bodies, matter);
  constexpr int rounds = 4; // what lay on something that was left out falls on
  for (int round = 0; round < rounds; ++round)
  {
    fall.run(fall.time() + seconds, lowest + this->Settings.size);
    if (!this->leaveOutUnsettled(fall, round + 1 == rounds))
    {
      break;
    }
  }
  std::size_t k = 0;
  for (const std::size_t i : this->Order)
  {
    if (!this->Falling[i].poses.empty())
    {
      this->Falling[i].poses = fall.poses(k++);
    }
  }
}

/// What a body is nearer to than its clearance, what it lies on or in apart; none.
const PlaceBody* Drop::tooNear(std::size_t i)
{
  const PlaceRule& rule = *this->Falling[i].rule;
  if (rule.clearance <= 0)
  {
    return nullptr;
  }
  for (const PlaceBody* other : this->World.others({ rule.object }))
  {
    const bool holds = rule.support ? other == &this->World.body(*rule.support)
                                    : std::find(this->Still.begin(), this->Still.end(), other) != this->Still.end();
    if (!holds && distance(this->body(i), *other, rule.clearance) < rule.clearance)
    {
      return other;
    }
  }
  return nullptr;
}

/// Takes out what is too near to another body; whether there was such a body.
bool Drop::leaveOutNear()
{
  for (auto i = this->Order.rbegin(); i != this->Order.rend(); ++i)
  {
    const PlaceBody* const other = this->isIn(*i) ? this->tooNear(*i) : nullptr;
    if (other != nullptr)
    {
      this->leaveOut(*i, "it is too near to " + quoted(other->name()));
      this->Falling[*i].note->measured.clear();
      return true;
    }
  }
  return false;
}

/// How many of its tolerances a body is in others, or above what holds it; it is noted.
double Drop::fault(std::size_t i)
{
  const PlaceRule& rule = *this->Falling[i].rule;
  const double tolerance = this->World.tolerance(rule);
  const PlaceMeasure measure =
    measurePlace(this->body(i), this->World.others({ rule.object }), this->Settings.down, 4 * tolerance);
  this->Falling[i].note->measured = { { "penetration", measure.penetration }, { "gap", measure.gap },
    { "tolerance", tolerance } };
  this->Falling[i].note->why = measure.penetration > measure.gap ? "it is in another object" : "it hovers";
  return std::max(measure.penetration, measure.gap) / tolerance;
}

/// Takes out the body that is furthest from being where it can be; whether there was one.
bool Drop::leaveOutUnfit()
{
  double worst = 1;
  std::size_t unfit = 0;
  for (const std::size_t i : this->Order)
  {
    const double fault = this->isIn(i) ? this->fault(i) : 0;
    unfit = fault > worst ? i : unfit;
    worst = std::max(worst, fault);
  }
  if (worst > 1)
  {
    this->leaveOut(unfit, std::string(this->Falling[unfit].note->why));
    this->Falling[unfit].note->measured.clear();
  }
  return worst > 1;
}

/// Lays a body on all that is in.
void Drop::layOne(std::size_t i)
{
  layDown(this->body(i), this->World.others({ this->Falling[i].rule->object }), this->Settings.down,
    reach * std::max(this->body(i).size(), this->Settings.size));
}

void Drop::lay()
{
  const int up = this->World.upAxis();
  do
  {
    std::vector<std::size_t> bottomUp;
    for (const std::size_t i : this->Order)
    {
      if (this->isIn(i))
      {
        bottomUp.push_back(i);
        this->World.takeOut(this->Falling[i].rule->object);
      }
    }
    std::stable_sort(bottomUp.begin(), bottomUp.end(),
      [&](std::size_t a, std::size_t b) { return low(this->body(a), up) < low(this->body(b), up); });
    for (const std::size_t i : bottomUp)
    {
      this->layOne(i);
      this->World.putIn(this->Falling[i].rule->object);
    }
    // What leans on something that reaches less far down came too early; what lies on it follows.
    bool moved = true;
    for (int round = 0; round < mostRounds && moved; ++round)
    {
      moved = false;
      for (const std::size_t i : bottomUp)
      {
        if (this->fault(i) > 1)
        {
          this->layOne(i);
          moved = true;
        }
      }
    }
  } while (this->leaveOutUnfit() || this->leaveOutNear());
  for (const std::size_t i : this->Order)
  {
    if (this->isIn(i))
    {
      this->Falling[i].note->why.clear();
      this->Falling[i].poses.push_back(this->body(i).pose());
    }
  }
}
} // namespace

std::string startPlace(PlaceWorld& world, const PlaceRule& rule, const SampleDraws& draws, int attempt)
{
  PlaceBody& body = world.body(rule.object);
  const Eigen::AlignedBox3d box = rule.support ? world.body(*rule.support).box() : rule.box;
  const int up = world.upAxis();
  const std::array<double, 2> first = draws.uniforms(rule.path, 0, std::uint32_t(attempt));
  const double third = draws.uniform(rule.path, 1, std::uint32_t(attempt));
  Eigen::Vector3d target = body.box().center();
  const Eigen::Vector3d half = 0.5 * body.box().sizes();
  for (std::size_t i = 0; i < 2; ++i)
  {
    const int axis = world.level()[i];
    double least = box.min()[axis] + half[axis];
    double most = box.max()[axis] - half[axis];
    if (rule.region)
    {
      least = rule.region->min()[Eigen::Index(i)];
      most = rule.region->max()[Eigen::Index(i)];
    }
    else if (least > most && rule.in)
    {
      return "it is wider than what it is put in";
    }
    else if (least > most)
    {
      least = most = 0.5 * (least + most);
    }
    target[axis] = least + (most - least) * first[i];
  }
  if (rule.in && !rule.drop)
  {
    const double space = box.sizes()[up] - 2 * half[up];
    if (space < 0)
    {
      return "it is higher than what it is put in";
    }
    target[up] = box.min()[up] + half[up] + space * third;
  }
  else
  {
    target[up] = box.max()[up] + half[up] + (rule.drop ? rule.drop->height : 0) + 0.01 * body.size();
  }
  body.move(target - body.box().center());
  if (rule.drop && rule.support)
  {
    const double most = low(body, up) - box.min()[up] + body.size();
    const double way = wayDown(body, world.body(*rule.support), -world.up(), most, 0);
    if (way >= most)
    {
      return "nothing of " + quoted(world.body(*rule.support).name()) + " is below it";
    }
    body.move(world.up() * (rule.drop->height + 0.01 * body.size() - way));
  }
  return {};
}

void dropObjects(
  PlaceWorld& world, const SceneDescription& scene, const SampleDraws& draws, std::vector<FallingObject>& falling)
{
  Drop drop(world, scene, falling);
  drop.start(draws);
  drop.fall();
  drop.lay();
}

Quaternion quaternionOf(const Eigen::Matrix3d& rotation)
{
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  const double sign = q.w() < 0 ? -1 : 1;
  return { sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z() };
}

void writeFall(ObjectDescription& object, const FallingObject& fallen)
{
  const DropRule& drop = *fallen.rule->drop;
  if (!drop.keys)
  {
    return;
  }
  for (std::size_t i = 0; i < fallen.poses.size(); ++i)
  {
    const int frame = drop.from + int(i);
    object.position.keys.push_back({ frame, fallen.poses[i].translation });
    object.orientation.keys.push_back({ frame, quaternionOf(fallen.poses[i].rotation) });
  }
  fallen.note->measured.emplace_back("frames", double(fallen.poses.size()));
}

} // namespace dgtk
