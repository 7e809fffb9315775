// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSyntheticScene_h
#define dgtkSyntheticScene_h

#include "dgtkSurfaceRows.h"
#include "dgtkVisibility.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <string>

namespace dgtk::test
{

// Models, scene states and views made of numbers, and an engine that tries every triangle. All models have one part,
// one material, texture coordinates and no texture.

/// A parallelogram, cut into cellsU x cellsV cells of two triangles; uv runs from (0, 0) at `corner` to (1, 1).
struct QuadOptions
{
  Eigen::Vector3d corner{ -1, -1, 0 };
  Eigen::Vector3d sideU{ 2, 0, 0 };
  Eigen::Vector3d sideV{ 0, 2, 0 };
  int cellsU = 1;
  int cellsV = 1;
};
std::shared_ptr<Model> makeQuad(const QuadOptions& options = {});

/// A sphere of latitude and longitude, poles on the y axis; vertices on the sphere.
struct SphereOptions
{
  Eigen::Vector3d centre{ 0, 0, 0 };
  double radius = 1;
  int rings = 16;
  int segments = 32;
};
std::shared_ptr<Model> makeSphere(const SphereOptions& options = {});

/// An axis-parallel box of 12 triangles.
struct BoxOptions
{
  Eigen::Vector3d min{ -1, -1, -1 };
  Eigen::Vector3d max{ 1, 1, 1 };
};
std::shared_ptr<Model> makeBox(const BoxOptions& options = {});

/// A square height field in x and z around the origin, 2 cells^2 triangles, heights random in [0, height].
struct TerrainOptions
{
  int cells = 100;
  double size = 100;
  double height = 1;
  std::uint64_t seed = 1;
};
std::shared_ptr<Model> makeTerrain(const TerrainOptions& options = {});

/// Triangles with random corners: a centre in the cube [-extent, extent]^3 and corners within `size` of it.
struct SoupOptions
{
  int triangles = 1000;
  double extent = 1;
  double size = 0.1;
  std::uint64_t seed = 1;
};
std::shared_ptr<Model> makeSoup(const SoupOptions& options = {});

/// Gives the model a cut-out texture of size x size random texels, about half of them missing.
void addCutOut(Model& model, int size, std::uint64_t seed);

/// Collects instances; the first one added is object 1.
class SceneBuilder
{
public:
  SceneBuilder& add(
    std::shared_ptr<const Model> model, const Affine3& world_from_object = {}, const std::string& name = {});
  std::shared_ptr<SceneState> state() const { return std::make_shared<SceneState>(this->State); }

private:
  SceneState State;
};

/// Scale, then rotation by `angle` radians about `axis`, then translation.
Affine3 placement(
  const Eigen::Vector3d& translation, double scale = 1, const Eigen::Vector3d& axis = { 0, 1, 0 }, double angle = 0);

struct ViewOptions
{
  int width = 64;
  int height = 48;
  double fovY = 45; ///< degrees
  Eigen::Vector3d eye{ 0, 0, 5 };
  Eigen::Vector3d lookAt{ 0, 0, 0 };
  Eigen::Vector3d up{ 0, 1, 0 };
  double near = 0.1;
  double far = 1000;
};
View makeView(const ViewOptions& options = {});

/// A pinhole or parallel camera that does not say that it is linear, as a lens would.
std::shared_ptr<const CameraModel> hideLinear(std::shared_ptr<const CameraModel> model);

/// A fisheye: image points are `pixelsPerRadian` times their angle from the axis away from the image's middle.
std::shared_ptr<const CameraModel> makeEquidistant(int width, int height, double pixelsPerRadian);

/// What the ray through each pixel's centre meets first, by trying all triangles in extended precision. Edges belong to
/// their triangle; of equally near surfaces (relative 1e-12) the one with the lowest object, then triangle.
VisibilityBuffer bruteForce(const SceneState& state, const View& view, const PixelRect& rect);
/// The whole image.
VisibilityBuffer bruteForce(const SceneState& state, const View& view);

/// Distance in pixels of an image point from the projected edges of the triangle of `hit` (object != 0); the parts of
/// edges behind the camera do not count. Straight edges: linear cameras.
double edgeDistance(const SceneState& state, const View& view, const Hit& hit, const Eigen::Vector2d& pixel);

} // namespace dgtk::test

#endif
