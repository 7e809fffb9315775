// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExposures_h
#define dgtkExposures_h

#include "dgtkPictureSource.h"
#include "dgtkStage.h"

#include <functional>
#include <memory>
#include <vector>

namespace dgtk
{

class ThreadPool;

/// Colours as the mean, in linear light, of the pictures of several instants and points of a lens, summed in their
/// order. To be used from the thread of OpenGL.
class ExposedColor
{
public:
  /// Gives the scene at a frame, fractions included.
  using StateAt = std::function<std::shared_ptr<const SceneState>(double frame)>;

  ExposedColor(PictureSource& source, ThreadPool& pool)
    : Source(source)
    , Pool(pool)
  {
  }
  void set(std::vector<Exposure> exposures, StateAt stateAt);
  /// Whether colour is other than that of the frame's own instant and pinhole.
  bool blurs() const { return !this->Exposures.empty(); }
  /// Leaves the source with another scene.
  void draw(const PixelRect& rect, int samples, ColorBuffer& colors);

private:
  PictureSource& Source;
  ThreadPool& Pool;
  std::vector<Exposure> Exposures;
  StateAt At;
};

} // namespace dgtk

#endif
