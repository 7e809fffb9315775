// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRayScene_h
#define dgtkRayScene_h

#include "dgtkExactRay.h"
#include "dgtkRayMesh.h"
#include "dgtkVisibility.h"

#include <cmath>
#include <memory>
#include <mutex>
#include <vector>

namespace dgtk
{

struct RayHit;
class SeenTriangles;

/// A scene state in the frame of one camera: instances are placed relative to the camera in double precision before
/// they are rounded, so that scenes far from the origin lose nothing.
class RayScene
{
public:
  struct Placed
  {
    std::shared_ptr<const RayMesh> mesh; ///< null: nothing to hit
    RTCGeometry geometry = nullptr;
    bool fits = true; ///< into single precision's range; Embree does not know it otherwise
    Affine3 camera_from_object;
    float mesh_from_camera[9]; ///< linear part, row by row
    float sizes = 0;           ///< largest coordinates that take part in single precision, units of the mesh
    double reach = 0;          ///< the same in the camera frame
  };

  RayScene(std::shared_ptr<RayDevice> device, bool bare);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Places the instances; what did not change is kept.
  void place(std::shared_ptr<const SceneState> state, const Rigid3& camera_from_world);

  RTCScene handle() const { return this->Scene; }
  const SceneState& state() const { return *this->State; }
  const Rigid3& pose() const { return this->Pose; }
  const Placed& placed(std::size_t instance) const { return this->Instances[instance]; }
  /// Largest `reach` of all instances.
  double reach() const { return this->Reach; }
  /// Whether Embree knows all instances.
  bool fits() const { return this->Fits; }
  /// Pixels: a bound of the error of single precision in the middle of an image (of a lens, where its middle row is
  /// finest), at distances of about the scene's size. Infinite where instances do not fit.
  double errorInPixels(const View& view) const;
  /// Surfaces whose single-precision t differ by less are compared exactly.
  float slack(float t) const { return float(2 * rayPrecision) * (t + float(this->Reach)); }

  Hit hit(unsigned int instance, unsigned int geometry, unsigned int primitive) const
  {
    return { instance + 1, this->Instances[instance].mesh->firstTriangle[geometry] + primitive };
  }
  /// Exact intersection with a triangle; inside is false outside the ray's range and at missing texels. `uncertain`:
  /// whether single precision cannot tell on which side of an edge the ray passes. `triangles`: of this
  /// scene, for many rays; null for one.
  ExactHit intersect(const ExactRay& ray, const Hit& hit, bool& uncertain, SeenTriangles* triangles) const;
  ExactHit intersect(const ExactRay& ray, const Hit& hit) const;
  /// The same without the range and the texels.
  ExactHit intersectTriangle(const ExactRay& ray, const Hit& hit) const;
  /// Where a ray passes corners of triangles as closely as single precision goes, all triangles that come as near to
  /// them are added: around a corner there may be more than rays beside this one meet.
  void addFans(const ExactRay& ray, std::vector<Hit>& hits) const;

  /// All surfaces along a ray in exact order, without single precision; for `nearest` at least the first.
  void collectExactly(const ExactRay& ray, bool nearest, std::vector<RayHit>& hits) const;

  TriangleFrom triangleFrom(const Eigen::Vector3d& origin, const Hit& hit) const;

private:
  double slackAt(const ExactRay& ray, const Hit& hit, double t) const;
  bool isThere(const ExactRay& ray, const Hit& hit, const ExactHit& exact) const;
  void setMesh(std::size_t index, const std::shared_ptr<const RayMesh>& mesh);
  void placeInstance(std::size_t index);
  void makeScene();

  std::shared_ptr<RayDevice> Device;
  bool Bare;
  RTCScene Scene = nullptr;
  std::shared_ptr<const SceneState> State;
  Rigid3 Pose;
  std::vector<Placed> Instances;
  double Reach = 0;
  bool Fits = true;
  /// Of the instances' boxes in the camera frame.
  struct ExactTree
  {
    std::once_flag once;
    BoxTree boxes;
  };
  const BoxTree& exactTree() const;
  std::unique_ptr<ExactTree> Exact = std::make_unique<ExactTree>(); ///< made when somebody asks for it
};

/// Triangles of a scene as seen from the points where rays start, those met last: mostly rays side by side start at one
/// point and meet the same ones. One thread.
class SeenTriangles
{
public:
  explicit SeenTriangles(const RayScene& scene)
    : Scene(scene)
    , Entries(entryCount)
  {
  }
  const TriangleFrom& from(const Eigen::Vector3d& origin, const Hit& hit)
  {
    Entry& entry = this->Entries[(hit.triangle * 0x9E3779B1U ^ hit.object * 0x85EBCA77U) >> 25U];
    if (entry.hit != hit || entry.origin != origin)
    {
      entry = { hit, origin, this->Scene.triangleFrom(origin, hit) };
    }
    return entry.triangle;
  }

private:
  static constexpr std::size_t entryCount = 128;
  struct Entry
  {
    Hit hit;
    Eigen::Vector3d origin;
    TriangleFrom triangle;
  };
  const RayScene& Scene;
  std::vector<Entry> Entries;
};

/// The ray through an image point with the view's near and far; with an empty range where none is.
ExactRay rayOf(const View& view, const Eigen::Vector2d& pixel);

/// Whether `a` at `ta` comes before `b` at `tb` on a ray: nearer, or equally near and of the lower object, then
/// triangle.
bool comesBefore(double ta, const Hit& a, double tb, const Hit& b);

/// A surface along a ray.
struct RayHit
{
  double t = 0;
  Hit hit;
};

/// By t, then each group of equally near surfaces by (object, triangle).
void sortHits(std::vector<RayHit>& hits);

/// All surfaces along a ray in exact order. `nearby`: looks also beside the ray, for surfaces that single precision
/// misses by a rounding; otherwise only when some surface is marginal.
void collectHits(const RayScene& scene, const ExactRay& ray, bool nearby, std::vector<RayHit>& hits);
/// The same where all candidates along the ray itself are in `found`, which gets those beside it.
void settleHits(const RayScene& scene, const ExactRay& ray, bool nearby, SeenTriangles* triangles,
  std::vector<Hit>& found, std::vector<RayHit>& hits);

/// Half a rounding of single precision, a part of a value.
constexpr double halfRounding = 0x1p-24;

/// A vector, or a matrix by its columns, whose components below half a rounding of the largest are 0. Embree's bounds
/// of coherent packets lose surfaces where a ray has a component between -1e-18 and 0 in the axes of an instance (it
/// sorts the ray among negative ones and divides by a positive number); products of two roundings are such components.
template <typename Vectors>
Vectors withoutRoundings(Vectors vectors)
{
  for (Eigen::Index i = 0; i < vectors.cols(); ++i)
  {
    const double limit = halfRounding * vectors.col(i).cwiseAbs().maxCoeff();
    vectors.col(i) = vectors.col(i).unaryExpr([limit](double v) { return std::abs(v) < limit ? 0 : v; }).eval();
  }
  return vectors;
}

/// Whether the rays of a view are enough alike for Embree's bounds of coherent packets.
bool isCoherent(const View& view);

/// Part of t by which equally near surfaces may differ: a few roundings of vertices far from the origin.
constexpr double sameDistance = 1e-9;

/// Embree's filter of all modes, set in the context.
void rayFilter(const RTCFilterFunctionNArguments* arguments);

/// Embree's context with what the filter needs, first member first.
struct RayContext
{
  RTCIntersectContext context;
  const RayScene* scene = nullptr;
  enum class Mode
  {
    Nearest, ///< the nearest surface of each lane, near ties decided exactly
    Checked, ///< the nearest surface of each lane that is exactly inside the range of `rays` and is not `skip`
    Collect  ///< all candidates
  } mode = Mode::Nearest;
  // Nearest: rays by lane (RTCRay::id), and what was accepted.
  const View* view = nullptr;     ///< rays through 4 x 4 pixels of a view, the first one at (x, y) ...
  const ExactRay* rays = nullptr; ///< ... or one given ray a lane
  int x = 0;
  int y = 0;
  float t[16];
  Hit best[16];
  const Hit* skip = nullptr;          ///< Checked: a triangle that is not there, a lane
  SeenTriangles* triangles = nullptr; ///< Checked: of several rays, or null
  unsigned int marginal = 0;          ///< Checked: bits of lanes in which single precision may have missed something
  std::vector<Hit>* found = nullptr;  ///< Collect: a list a lane
};

/// Traces those of up to 16 rays whose bits are set in `active`: one alone, several as a packet.
void traceRays(const RayScene& scene, const ExactRay* rays, unsigned int active, RayContext& context);

/// Whether single precision, and Embree, can follow a ray; one of a camera beyond reason cannot be, and meets nothing.
inline bool isTraceable(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
{
  constexpr double most = 1e18; // Embree's FLT_LARGE is 1.8e18
  return origin.cwiseAbs().sum() + direction.cwiseAbs().sum() < most;
}

/// Embree's ray of an exact one, its range a little wider.
RTCRayHit makeQuery(const ExactRay& ray);

/// Part of near and far by which Embree's range is wider than the exact one.
constexpr float rangeSlack = 1e-5F;

} // namespace dgtk

#endif
