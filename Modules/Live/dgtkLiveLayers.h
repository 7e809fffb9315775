// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLiveLayers_h
#define dgtkLiveLayers_h

#include "dgtkLiveScene.h"

#include "dgtkLayer.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

class Layer;
struct LayerInfo;
class ThreadPool;

/// The picture with one sample a pixel and nothing blurred: no layer of a dataset, but the same bytes where a dataset's
/// is so, too.
extern DGTKLIVE_EXPORT const char* const draftLayer;

struct LiveLayer
{
  std::string name;        ///< of an image of a dataset: "depth", "flow_forward_class"; or draftLayer
  std::string description; ///< one sentence
};

/// What can be shown of a view: the picture, and the images of all layers but those of liveRefusal().
DGTKLIVE_EXPORT const std::vector<LiveLayer>& liveLayers();

/// Why the images of a layer cannot be seen while a scene is edited, one line; empty: they can. Rays give what pixels
/// meet; what else a layer reads is the renderer's.
DGTKLIVE_EXPORT std::string liveRefusal(const LayerInfo& info);

/// A camera's picture of a scene at a frame.
struct LiveQuestion
{
  std::shared_ptr<const LiveScene> scene;
  int frame = 0;
  CameraDescription camera; ///< of the scene, or another one without a name
  int width = 0;            ///< pixels; 0: the camera's own size, or 640 x 480
  int height = 0;
  int finest = 1; ///< pixels of the view, in x and y, for one of the finest picture
};

/// The view of a question. Throws what cameraView() throws.
DGTKLIVE_EXPORT View viewOf(const LiveQuestion& question);

/// One image of a layer.
struct LiveImageRows
{
  std::string name; ///< among the outputs of the picture: "correspondence_right" of the layer's image "correspondence"
  Rows rows;
};

/// A view of a scene at a frame, traced by rays: the hits and values that `dgtk render` has of the same camera, frame
/// and size, by the same layers. One thread at a time.
class DGTKLIVE_EXPORT LiveEye
{
public:
  /// Asked between strips of rows; true ends the work.
  using Stop = std::function<bool()>;

  /// A view of every `step`-th pixel. `pool` must outlive the eye. Throws what LiveScene::at() throws.
  LiveEye(const LiveQuestion& question, int step, ThreadPool& pool);
  ~LiveEye();
  LiveEye(const LiveEye&) = delete;
  LiveEye& operator=(const LiveEye&) = delete;

  const View& view() const;
  const LiveScene::Moment& moment() const;

  /// Hits of full-width rows. False when it was stopped.
  bool trace(int y, int height, VisibilityBuffer& hits, const Stop& stop = {});
  /// Values of a layer's image at the rows of these hits; those next to the image's edge are as if it ended there.
  /// Without rows when it was stopped, where missing() says why there is none, and where the layer needs the whole
  /// picture (LayerNeeds::whole) and these are not all rows. Throws UsageError for an unknown layer.
  Rows values(const std::string& layer, const VisibilityBuffer& hits, const Stop& stop = {});
  /// Likewise, of all the picture has of that image: one for each other camera where the layer relates two.
  std::vector<LiveImageRows> allValues(const std::string& layer, const VisibilityBuffer& hits, const Stop& stop = {});
  /// Throws UsageError for an unknown layer.
  LayerSpec spec(const std::string& layer) const;
  /// What the view lacks to have a layer's image; empty: nothing.
  std::string missing(const std::string& layer) const;

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
