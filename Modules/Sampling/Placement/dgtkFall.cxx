// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFall.h"

#include "dgtkPortableMath.h"

#include <Eigen/Eigenvalues>

#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
// Of sizes, which are about 1 in Bullet.
constexpr double margin = 0.002;
constexpr int calmLooks = 2;         ///< one after the other, after which a body rests
constexpr double timeOfLook = 1.5;   ///< between two looks, in square roots of size by gravity
constexpr double leastWeight = 0.05; ///< what is much lighter would be pressed into what it lies on
constexpr double contact = 0.02;     ///< distance at which contacts are found; most that bodies go in a step
constexpr double touching = 0.0005;  ///< at which they are kept apart: earlier, what bounces would be slowed down first
constexpr double thin = 0.01;        ///< plates are made this thick to each side
constexpr double leastOfStep = 0.015; ///< way that even the thinnest may go in a step
constexpr int mostParts = 16;
constexpr double quick = 0.5; ///< speed, in square roots of size times gravity
constexpr double stepsOfFall =
  20; ///< a second, times the square root of size by gravity: steps to fall a half of the size

btVector3 toBullet(const Eigen::Vector3d& v) { return { v.x(), v.y(), v.z() }; }

/// Volume, centre and moments of tetrahedra about the hulls' faces, from their corners: of the box of a flat one.
struct Mass
{
  double volume = 0;
  Eigen::Vector3d middle{ 0, 0, 0 };
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero(); ///< integral of x x^T, about the middle once done
};

/// The hull is taken as its corners, alike, with its volume: near enough for how things tumble.
Mass massOf(const std::vector<ConvexHull>& pieces, double size)
{
  Mass mass;
  for (const ConvexHull& piece : pieces)
  {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : piece.points)
    {
      mean += p / double(piece.points.size());
    }
    const double volume = std::max(piece.volume, 1e-6 * size * size * size);
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& p : piece.points)
    {
      // Of a box, its corners have three times the spread of the solid.
      spread += (p - mean) * (p - mean).transpose() / (3 * double(piece.points.size()));
    }
    mass.volume += volume;
    mass.middle += volume * mean;
    mass.spread += volume * (spread + mean * mean.transpose());
  }
  mass.middle /= mass.volume;
  mass.spread -= mass.volume * mass.middle * mass.middle.transpose();
  return mass;
}

/// A mesh whose closed parts are seen from outside only: what slides over the rim of a solid would be stopped by the
/// back of its side otherwise.
class StillShape : public btBvhTriangleMeshShape
{
public:
  /// `solid`: of each triangle, whether it is of a closed part.
  StillShape(btTriangleMesh& triangles, std::vector<char> solid)
    : btBvhTriangleMeshShape(&triangles, true)
    , Solid(std::move(solid))
  {
  }
  void processAllTriangles(btTriangleCallback* callback, const btVector3& low, const btVector3& high) const override
  {
    Seen seen(*callback, this->Solid, 0.5 * (low + high));
    const btVector3 near(contact, contact, contact);
    this->btBvhTriangleMeshShape::processAllTriangles(&seen, low - near, high + near);
  }

private:
  struct Seen : btTriangleCallback
  {
    btTriangleCallback& next;
    const std::vector<char>& solid;
    btVector3 from;
    Seen(btTriangleCallback& callback, const std::vector<char>& of, const btVector3& eye)
      : next(callback)
      , solid(of)
      , from(eye)
    {
    }
    void processTriangle(btVector3* corners, int part, int triangle) override
    {
      const btVector3 out = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
      if (!this->solid[std::size_t(triangle)] || out.dot(this->from - corners[0]) >= -contact * out.length())
      {
        this->next.processTriangle(corners, part, triangle);
      }
    }
  };
  std::vector<char> Solid;
};

struct StillBody
{
  btTriangleMesh triangles{ true, false };
  std::unique_ptr<StillShape> shape;
  std::unique_ptr<btRigidBody> body;
};

struct FallingBody
{
  std::vector<std::unique_ptr<btConvexHullShape>> hulls;
  std::unique_ptr<btCompoundShape> shape;
  std::unique_ptr<btRigidBody> body;
  Rigid3 body_from_bullet; ///< Bullet's frame has the axes of inertia; scene units
  std::vector<Rigid3> poses;
  btTransform looked;          ///< where it was when it was last looked at
  int calmLooks = 0;           ///< for how many looks it has hardly moved
  double mostOfStep = contact; ///< way that it may go in a step
  bool in = true;
};

/// About how thick it is, if it is a plate.
double thicknessOf(const ConvexHull& piece)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : piece.points)
  {
    box.extend(p);
  }
  return piece.volume / box.sizes().squaredNorm();
}
} // namespace

struct Fall::Impl
{
  FallSettings settings;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{ &configuration };
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{ &dispatcher, &broadphase, &solver, &configuration };
  std::vector<std::unique_ptr<StillBody>> still;
  std::vector<std::unique_ptr<FallingBody>> falling;
  int stepsOfFrame = 1;
  int stepsOfLook = 1;
  int steps = 0;
  double step = 0;

  explicit Impl(const FallSettings& s)
    : settings(s)
  {
    this->step = std::sqrt(s.size / s.gravity) / stepsOfFall;
    this->stepsOfFrame = std::max(1, int(std::ceil(s.frameTime / this->step)));
    this->step = s.frameTime / this->stepsOfFrame;
    this->stepsOfLook = int(std::ceil(timeOfLook * std::sqrt(s.size / s.gravity) / this->step));
    this->dispatcher.setDispatcherFlags(
      this->dispatcher.getDispatcherFlags() & ~btCollisionDispatcher::CD_USE_RELATIVE_CONTACT_BREAKING_THRESHOLD);
    this->world.getDispatchInfo().m_deterministicOverlappingPairs = true;
    this->world.setGravity(toBullet(s.down * (s.gravity / s.size)));
    btContactSolverInfo& info = this->world.getSolverInfo();
    info.m_numIterations = 20;
    info.m_splitImpulse = 1;
    info.m_splitImpulsePenetrationThreshold = -1e-4;
    info.m_linearSlop = 0;
  }
  ~Impl()
  {
    for (const auto& body : this->still)
    {
      this->world.removeRigidBody(body->body.get());
    }
    for (const auto& body : this->falling)
    {
      this->take(*body);
    }
  }

  void take(FallingBody& body)
  {
    if (body.in)
    {
      this->world.removeRigidBody(body.body.get());
      body.in = false;
    }
  }
  void addStill(const PlaceBody& it);
  void addFalling(const PlaceBody& it, const FallMatter& matter);
  Rigid3 poseOf(const FallingBody& body) const;
  bool advance(double lowest);
  double fastest() const;
  bool look();
  void thicken();
};

void Fall::Impl::addStill(const PlaceBody& it)
{
  auto one = std::make_unique<StillBody>();
  std::vector<btVector3> points;
  for (const Eigen::Vector3d& p : it.points())
  {
    points.push_back(toBullet(p / this->settings.size));
  }
  for (const auto& t : it.mesh().triangles)
  {
    one->triangles.addTriangle(points[t[0]], points[t[1]], points[t[2]]);
  }
  std::vector<char> solid(it.mesh().triangles.size(), 0);
  for (const SolidMesh::Part& part : it.mesh().parts)
  {
    std::fill_n(solid.begin() + std::ptrdiff_t(part.first), part.count, part.closed);
  }
  one->shape = std::make_unique<StillShape>(one->triangles, std::move(solid));
  one->shape->setMargin(0);
  btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, one->shape.get());
  one->body = std::make_unique<btRigidBody>(info);
  one->body->setFriction(1);
  one->body->setRestitution(1);
  this->world.addRigidBody(one->body.get());
  this->still.push_back(std::move(one));
}

void Fall::Impl::addFalling(const PlaceBody& it, const FallMatter& matter)
{
  auto one = std::make_unique<FallingBody>();
  const double size = this->settings.size;
  const Mass mass = massOf(it.pieces(), it.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(mass.spread / mass.volume);
  one->body_from_bullet.rotation = axes.eigenvectors();
  if (one->body_from_bullet.rotation.determinant() < 0)
  {
    one->body_from_bullet.rotation.col(0) *= -1;
  }
  one->body_from_bullet.translation = mass.middle;
  const Rigid3 bullet_from_body = one->body_from_bullet.inverse();
  one->shape = std::make_unique<btCompoundShape>();
  for (const ConvexHull& piece : it.pieces())
  {
    // Shrunk by the margin, which stands out around what Bullet is given; less so where the hull is without corners.
    auto hull = std::make_unique<btConvexHullShape>();
    const double thickness = thicknessOf(piece);
    const double around = std::max(thickness < thin * size ? thin * size : margin * size, piece.left);
    const double shrink = std::max(0.0, std::min(around, margin * size) - piece.left);
    one->mostOfStep = std::clamp(0.5 * thickness / size, leastOfStep, one->mostOfStep);
    for (const Eigen::Vector3d& p : convexHull(piece.points, piece.faces.empty() ? 0 : shrink).points)
    {
      hull->addPoint(toBullet((bullet_from_body * p) / size), false);
    }
    hull->setMargin(around / size);
    hull->recalcLocalAabb();
    one->shape->addChildShape(btTransform::getIdentity(), hull.get());
    one->hulls.push_back(std::move(hull));
  }
  one->shape->setMargin(margin);
  const Eigen::Vector3d spread = axes.eigenvalues().cwiseMax(1e-6 * it.size() * it.size()) / (size * size);
  const double weight = std::max(mass.volume / (size * size * size), leastWeight);
  const btVector3 inertia(
    weight * (spread.y() + spread.z()), weight * (spread.x() + spread.z()), weight * (spread.x() + spread.y()));
  btRigidBody::btRigidBodyConstructionInfo info(weight, nullptr, one->shape.get(), inertia);
  const Rigid3 pose = it.pose() * one->body_from_bullet;
  const Eigen::Matrix3d& r = pose.rotation;
  info.m_startWorldTransform =
    btTransform(btMatrix3x3(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)),
      toBullet(pose.translation / size));
  info.m_friction = matter.friction;
  info.m_restitution = matter.restitution;
  info.m_rollingFriction = 0.01; // lever, of the size: Bullet multiplies it with the other's friction
  info.m_spinningFriction = 0.01;
  info.m_linearDamping = 0.05;
  info.m_angularDamping = 0.2;
  one->body = std::make_unique<btRigidBody>(info);
  one->body->setActivationState(DISABLE_DEACTIVATION);
  one->body->setContactProcessingThreshold(touching);
  one->looked = info.m_startWorldTransform;
  this->world.addRigidBody(one->body.get());
  this->falling.push_back(std::move(one));
  this->falling.back()->poses.push_back(this->poseOf(*this->falling.back()));
}

Rigid3 Fall::Impl::poseOf(const FallingBody& body) const
{
  const btTransform& at = body.body->getWorldTransform();
  Rigid3 pose;
  for (int i = 0; i < 3; ++i)
  {
    pose.translation[i] = at.getOrigin()[i] * this->settings.size;
    for (int j = 0; j < 3; ++j)
    {
      pose.rotation(i, j) = at.getBasis()[i][j];
    }
  }
  return pose * body.body_from_bullet.inverse();
}

/// One step; whether everything rests.
bool Fall::Impl::advance(double lowest)
{
  // What is fast goes in smaller steps: Bullet sees what is nearer than its threshold of contact, beyond which thin
  // things would go through one another.
  const double fastest = this->fastest();
  const int parts = std::clamp(int(std::ceil(this->step * fastest)), 1, mostParts);
  // All corners of a side that comes down flat are contacts at once: one after the other they would turn what falls.
  // Bullet takes the number for pairs that begin to be near one another in this step; what is slow then does not turn
  // much, and lies in many contacts.
  const double quickest = quick / contact * std::sqrt(this->settings.gravity / this->settings.size);
  this->configuration.setConvexConvexMultipointIterations(fastest > quickest ? 4 : 0, 2);
  for (int i = 0; i < parts; ++i)
  {
    this->world.stepSimulation(this->step / parts, 0);
  }
  ++this->steps;
  for (const auto& body : this->falling)
  {
    if (!body->in)
    {
      continue;
    }
    const btVector3& middle = body->body->getWorldTransform().getOrigin();
    if (middle.dot(toBullet(this->settings.down)) * this->settings.size > lowest)
    {
      this->take(*body);
    }
  }
  if (this->steps % this->stepsOfFrame == 0)
  {
    for (const auto& body : this->falling)
    {
      body->poses.push_back(this->poseOf(*body));
    }
  }
  return this->steps % this->stepsOfLook == 0 && this->look();
}

/// Of all bodies, the most ways a second that may be a step's.
double Fall::Impl::fastest() const
{
  double most = 0;
  for (const auto& body : this->falling)
  {
    if (body->in)
    {
      const double speed = body->body->getLinearVelocity().length() + 0.5 * body->body->getAngularVelocity().length();
      most = std::max(most, speed / body->mostOfStep);
    }
  }
  return most;
}

/// Whether everything rests: what has moved by less than a fiftieth of a size since the last look. Contacts make what
/// lies still tremble, which says nothing about where it goes.
bool Fall::Impl::look()
{
  constexpr double hardly = 0.02;
  bool rest = true;
  for (const auto& body : this->falling)
  {
    const btTransform& now = body->body->getWorldTransform();
    const double moved = now.getOrigin().distance(body->looked.getOrigin());
    const double turned = now.getRotation().angleShortestPath(body->looked.getRotation());
    body->calmLooks = moved < hardly && turned < 2 * hardly ? body->calmLooks + 1 : 0;
    body->looked = now;
    rest = rest && (!body->in || body->calmLooks >= calmLooks);
  }
  this->thicken();
  return rest;
}

/// What rocks, rolls and creeps for long comes to rest as in air that becomes thicker.
void Fall::Impl::thicken()
{
  constexpr int free = 10;    ///< looks
  constexpr int doubling = 2; ///< looks
  const int late = this->steps / this->stepsOfLook - free;
  if (late < 0)
  {
    return;
  }
  const double rate = std::sqrt(this->settings.gravity / this->settings.size) *
                      std::min(1.0, std::ldexp(0.07, late / doubling)); // of the speed, a second
  for (const auto& body : this->falling)
  {
    body->body->setDamping(1 - portable::exp(-rate), 1 - portable::exp(-4 * rate));
  }
}

Fall::Fall(const FallSettings& settings, const std::vector<const PlaceBody*>& still,
  const std::vector<PlaceBody*>& falling, const std::vector<FallMatter>& matter)
  : Self(std::make_unique<Impl>(settings))
{
  for (const PlaceBody* body : still)
  {
    if (!body->mesh().triangles.empty())
    {
      this->Self->addStill(*body);
    }
  }
  for (std::size_t i = 0; i < falling.size(); ++i)
  {
    this->Self->addFalling(*falling[i], matter[i]);
  }
}

Fall::~Fall() = default;

void Fall::run(double until, double lowest)
{
  for (const auto& body : this->Self->falling)
  {
    body->calmLooks = 0;
  }
  while (this->time() < until && !this->Self->advance(lowest))
  {
  }
}

void Fall::remove(std::size_t body) { this->Self->take(*this->Self->falling[body]); }

bool Fall::isIn(std::size_t body) const { return this->Self->falling[body]->in; }

bool Fall::rests(std::size_t body) const { return this->Self->falling[body]->calmLooks >= calmLooks; }

double Fall::time() const { return this->Self->steps * this->Self->step; }

Rigid3 Fall::pose(std::size_t body) const { return this->Self->poseOf(*this->Self->falling[body]); }

const std::vector<Rigid3>& Fall::poses(std::size_t body) const { return this->Self->falling[body]->poses; }

} // namespace dgtk
