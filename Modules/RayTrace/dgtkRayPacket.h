// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRayPacket_h
#define dgtkRayPacket_h

#include "dgtkRayScene.h"

#include <cmath>
#include <cstdint>
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

/// What is done beside the tracing.
enum class TraceMode
{
  Bare, ///< nothing; for scenes made for it
  Exact ///< marks are set, and surfaces close together are ordered exactly
};

/// Traces the primary rays of a view, 4 x 4 pixels at a time. One thread.
class PacketTracer // NOLINT(clang-analyzer-optin.performance.Padding): one a thread
{
public:
  static constexpr int lanes = 16;
  static constexpr int side = 4;

  PacketTracer(const RayScene& scene, const View& view, bool coherent);

  /// Records the hits of `block`, at most Side x Side pixels inside buffer.rect; unless Bare, the marks, too.
  template <TraceMode Mode>
  void trace(const PixelRect& block, VisibilityBuffer& buffer, RayMarks& marks);

private:
  struct MeshLanes
  {
    alignas(64) float x[lanes];
    alignas(64) float y[lanes];
    alignas(64) float z[lanes];
    alignas(64) float sizes[lanes];
    alignas(64) float inverseEdge[lanes];
  };
  /// As withoutRoundings().
  float component(double value) const { return std::abs(value) < this->Least ? 0 : float(value); }
  void setLinear(const PixelRect& block);
  void setGeneral(const PixelRect& block);
  void mark(const PixelRect& block, const VisibilityBuffer& buffer, RayMarks& marks);
  bool anyHit() const;
  void toMesh(MeshLanes& out) const;
  void findClear(int clear[lanes]) const;

  const RayScene& Scene;
  const View& TheView;
  bool Linear;
  float* VaryingX = nullptr; ///< linear: what of the rays differs between pixels, x components
  float* VaryingY = nullptr;
  bool Traceable = true; ///< linear: all rays
  double Least = 0;      ///< linear: what a component has at least, or is 0
  double FirstX = 0, StepX = 0, Skew = 0, FirstY = 0, StepY = 0;
  float Near;
  float Far;
  RayContext Context;
  alignas(64) RTCRayHit16 Packet;
  alignas(64) int Valid[lanes];
};

} // namespace dgtk

#endif
