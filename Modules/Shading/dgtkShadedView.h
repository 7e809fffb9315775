// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkShadedView_h
#define dgtkShadedView_h

// Private to Shading.

#include "dgtkRayDifferentials.h"
#include "dgtkShadedLight.h"

#include "dgtkShadowQuery.h"
#include "dgtkVisibility.h"

#include <array>
#include <memory>
#include <mutex>
#include <vector>

namespace dgtk
{

/// A scene at one instant as a camera sees it, to be shaded. Immutable but for what is made when it is asked for first;
/// thread-safe.
class ShadedView
{
public:
  ShadedView(std::shared_ptr<const SceneState> state, const View& view);

  /// A surface to be shaded by itself.
  struct Surface
  {
    int pixel = 0; ///< of a row, from its first
    Hit hit;
  };

  /// What one thread needs while it shades rows of a view, which outlives it.
  class Worker;

  /// Colours of pixels [x, x + count) of row y with these hits: RGB, display-referred, >= 0; black where
  /// there is no ray. Surfaces that are not opaque let see what is behind them.
  void row(Worker& worker, int x, int y, int count, const Hit* hits, float* rgb) const;

  /// Colour, cut off at black, and opacity of surfaces of pixels [x, x + count) of row y, four values each.
  void shadeRow(Worker& worker, int x, int y, int count, const std::vector<Surface>& surfaces, float* rgba) const;
  /// All surfaces along the rays through pixels, near to far; quicker where those that follow each other are
  /// neighbours.
  void allHits(const std::vector<Eigen::Vector2d>& pixels, std::vector<Hit>* hits) const;

  const View& view() const { return this->TheView; }

private:
  /// An object, placed in the frame of the camera.
  struct Placed
  {
    std::shared_ptr<const ShadedMaterials> materials;
    Affine3 camera_from_object;
    Matrix3 normals; ///< camera_from_object, of normals
    double side = 1; ///< -1: mirrored
  };
  static constexpr std::size_t lanes = LightPoints::count;
  static_assert(lanes <= ShadowQuery::mostPaths);
  /// A vector as a triangle sees it.
  struct Across
  {
    double off = 0;        ///< along its normal, times twice its area
    Eigen::Vector2d along; ///< what it adds to the barycentric coordinates of the second and third corner
  };
  /// A triangle in the frame of the camera: what does not depend on the pixel.
  struct Triangle
  {
    Across across(const Eigen::Vector3d& v) const
    {
      return { this->normal.dot(v),
        this->plane.col(0) * v.x() + this->plane.col(1) * v.y() + this->plane.col(2) * v.z() };
    }
    Hit hit;
    const ShadedMaterial* material = nullptr;
    double side = 1; ///< -1: of a mirrored object
    Eigen::Vector3d corner;
    Eigen::Vector3d normal;            ///< (second - first) x (third - first)
    Eigen::Matrix<double, 2, 3> plane; ///< gradients of the barycentric coordinates of the second and third corner
    Eigen::Matrix2d uvMore;            ///< texture coordinates: what these corners have more than the first ...
    Eigen::Vector2d uv;                ///< ... which has these
    Across toCorner, toRight, toBelow; ///< pinholes: from the eye; direction to the neighbouring pixels' rays
    Float4 shading; ///< normals: of the first corner, and what the others have more; not of unit length
    Float4 shadingSecond;
    Float4 shadingThird;
    Float4 tint; ///< colours of vertices, in the same way; ones where there are none
    Float4 tintSecond;
    Float4 tintThird;
    // Of lights that cast shadows: the corners, the tangent planes' normals there, and the triangle's own, all of its
    // own side.
    std::array<Eigen::Vector3d, 3> corners;
    std::array<Eigen::Vector3d, 3> tangents;
    Eigen::Vector3d outward;
    const Model* map = nullptr; ///< whose colorMap has them
    Eigen::Vector2d mapAt;
    Eigen::Vector2d mapSecond;
    Eigen::Vector2d mapThird;
  };
  void prepare(const Hit& hit, const RayDifferentials& rays, Triangle& triangle) const;
  static void prepareTint(const Model& model, const std::array<std::uint32_t, 3>& corners, Triangle& triangle);
  static Float4 tintOf(const Triangle& triangle, double second, double third);
  void place(const PixelRay& ray, const Triangle& triangle, ShadedPoint& point) const;
  static void lift(
    const Triangle& triangle, const Eigen::Vector3d& position, const double parts[3], bool front, ShadedPoint& point);
  /// `sink` takes the place of each surface and its colour and opacity, in their order.
  template <typename Sink>
  void shade(Worker& worker, const std::vector<PixelRay>& rays, const Surface* surfaces, std::size_t count,
    const Sink& sink) const;
  void findShadows(const ShadedPoint* points, std::size_t count, LightLanes* lit) const;
  void seeThrough(Worker& worker, int x, int y, const std::vector<PixelRay>& rays, float* rgb) const;
  Float4 skyAt(const PixelRay& ray) const;
  Float4 blended(Float4 color) const;
  bool isOpaque(const Hit& hit) const
  {
    const ShadedMaterials& materials = *this->Objects[hit.object - 1].materials;
    return !materials.translucentColors && materials.of(hit.triangle).opacity >= 1;
  }

  std::shared_ptr<const SceneState> State;
  View TheView;
  bool Pinhole; ///< all rays start at the eye, neighbours differ by the same everywhere
  ShadedLight Light;
  std::vector<Placed> Objects;
  bool Translucent = false;
  std::shared_ptr<const ShadowQuery> Shadows; ///< null where no light casts any
  mutable std::once_flag QueryMade;
  mutable std::unique_ptr<OcclusionQuery> Query; ///< of what is behind what is seen
};

class ShadedView::Worker
{
public:
  explicit Worker(const ShadedView& view)
    : Rays(*view.TheView.model)
    , Triangles(triangles)
    , Lit(view.Light.lights())
  {
  }

private:
  friend class ShadedView;
  static constexpr std::size_t triangles = 256;
  const Triangle& triangle(const ShadedView& view, const Hit& hit)
  {
    const std::size_t slot = (hit.triangle * 0x9E3779B1U ^ hit.object * 0x85EBCA77U) >> 24U;
    Triangle& kept = this->Triangles[slot];
    if (kept.hit != hit)
    {
      view.prepare(hit, this->Rays, kept);
    }
    return kept;
  }

  RayDifferentials Rays;
  std::vector<Triangle> Triangles; ///< those met last
  std::vector<LightLanes> Lit;
  std::vector<Surface> Surfaces;
  std::vector<Surface> Behind;
  std::vector<int> Translucent;
  std::vector<Eigen::Vector2d> SeenThrough; ///< pixels
  std::vector<std::vector<Hit>> Hits;
};

} // namespace dgtk

#endif
