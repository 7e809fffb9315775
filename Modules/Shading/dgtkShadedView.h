// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkShadedView_h
#define dgtkShadedView_h

// Private to Shading.

#include "dgtkRayDifferentials.h"
#include "dgtkShadedLight.h"

#include "dgtkShadowQuery.h"
#include "dgtkVisibility.h"

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
  ShadedView(std::shared_ptr<const SceneState> state, const View& view, ShadedMaterialLibrary& materials);

  /// Colours of pixels [x, x + count) of row y with these hits: RGB, display-referred, >= 0. Surfaces that are not
  /// opaque let see what is behind them.
  void row(int x, int y, int count, const Hit* hits, float* rgb) const;

  /// A surface to be shaded by itself.
  struct Surface
  {
    int pixel = 0; ///< of a row, from its first
    Hit hit;
  };
  /// Colour, cut off at black, and opacity of surfaces of pixels [x, x + count) of row y, four values each.
  void shadeRow(int x, int y, int count, const std::vector<Surface>& surfaces, float* rgba) const;
  /// All surfaces along the rays of a row, near to far.
  void allHits(int x, int y, int count, std::vector<Hit>* hits) const;

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
  static constexpr std::size_t lanes = ShadowQuery::mostPaths;
  void shade(const std::vector<PixelRay>& rays, const std::vector<Surface>& surfaces, float* rgba) const;
  void place(const PixelRay& ray, const Hit& hit, ShadedPoint& point) const;
  void findShadows(const ShadedPoint* points, std::size_t count, PointLight* lit) const;
  void seeThrough(int x, int y, const std::vector<PixelRay>& rays, const std::vector<int>& pixels, float* rgb) const;
  Float4 skyAt(const PixelRay& ray) const;
  const ShadedMaterial& materialOf(const Hit& hit) const
  {
    return this->Objects[hit.object - 1].materials->of(hit.triangle);
  }

  std::shared_ptr<const SceneState> State;
  View TheView;
  ShadedLight Light;
  std::vector<Placed> Objects;
  bool Translucent = false;
  std::shared_ptr<const ShadowQuery> Shadows; ///< null where no light casts any
  mutable std::once_flag QueryMade;
  mutable std::unique_ptr<OcclusionQuery> Query; ///< of what is behind what is seen
};

} // namespace dgtk

#endif
