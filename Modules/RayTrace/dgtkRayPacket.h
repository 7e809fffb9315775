// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRayPacket_h
#define dgtkRayPacket_h

#include "dgtkRayScene.h"

#include <vector>

namespace dgtk
{

/// What single precision says of each pixel of a buffer beside its hit.
struct RayMarks
{
  std::vector<float> nearness;        ///< 1 / t; 0 where there is nothing
  std::vector<std::uint8_t> doubtful; ///< whether exact arithmetic has to decide
  void resize(const PixelRect& rect)
  {
    this->nearness.resize(std::size_t(rect.width) * rect.height);
    this->doubtful.resize(std::size_t(rect.width) * rect.height);
  }
};

/// Rays of the pixels of a view, affine in the pixel for linear cameras.
class PacketRays
{
public:
  explicit PacketRays(const dgtk::View& view);
  const dgtk::View& view() const { return this->TheView; }
  /// Fills lane `lane` for pixel (x, y).
  void set(RTCRayHit16& packet, int lane, int x, int y) const;
  bool perspective() const { return this->Linear && this->Perspective; }

private:
  const dgtk::View& TheView;
  bool Linear;
  bool Perspective = true;
  CameraRay First, AlongX, AlongY; ///< pixel (0, 0) and the steps to its neighbours
};

/// Traces the rays of `block`, at most 4 x 4 pixels inside buffer.rect. Without `Exact`, `marks` is not touched.
template <bool Exact>
void tracePacket(
  const RayScene& scene, const PacketRays& rays, const PixelRect& block, VisibilityBuffer& buffer, RayMarks& marks);

} // namespace dgtk

#endif
