// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLiveLayers_h
#define dgtkLiveLayers_h

#include "dgtkLiveScene.h"

#include "dgtkLayer.h"

#include <string>
#include <vector>

namespace dgtk
{

class ThreadPool;

struct LiveLayer
{
  std::string name;        ///< as the dataset's layer: "depth", "flow_forward", "flow_forward_class"
  std::string description; ///< one sentence
};

/// What can be shown of a view: "surface" (a draft of the colours, see SurfaceShading), all representations in the
/// order of their registry, flow to the frames beside and its visibility classes, scene flow, alpha.
DGTKWIDGETS_EXPORT const std::vector<LiveLayer>& liveLayers();

/// A view of a scene at a frame, traced by rays: the hits and values that `dgtk render --visibility ray` has of the
/// same camera, frame and size. One thread at a time.
class DGTKWIDGETS_EXPORT LiveEye
{
public:
  /// The view may have any size. `pool` must outlive the eye. Throws what LiveScene::at() throws.
  LiveEye(std::shared_ptr<const LiveScene> scene, int frame, LiveView view, ThreadPool& pool);
  ~LiveEye();
  LiveEye(const LiveEye&) = delete;
  LiveEye& operator=(const LiveEye&) = delete;

  const View& view() const;
  const LiveScene::Moment& moment() const;

  /// Hits of a rectangle inside the image.
  void trace(const PixelRect& rect, VisibilityBuffer& hits);
  /// Values of a layer at these hits: rows of the rectangle's width. Throws UsageError for an unknown layer.
  Rows values(const std::string& layer, const VisibilityBuffer& hits);
  /// Throws UsageError for an unknown layer.
  LayerSpec spec(const std::string& layer) const;
  /// Whether the layer needs the frame after the last one, or before the first, so that all of it is invalid.
  bool isBeyond(const std::string& layer) const;

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
