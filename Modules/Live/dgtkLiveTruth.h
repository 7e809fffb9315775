// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLiveTruth_h
#define dgtkLiveTruth_h

#include "dgtkLiveLayers.h"
#include "dgtkNewestTask.h"

#include "dgtkLayerPicture.h"
#include "dgtkThreadPool.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

struct LivePicture
{
  LayerPicture picture;
  Meaning meaning = Meaning::Unknown;
  int step = 1;       ///< pixels of the view, in x and y, that are one of the picture
  int coarseness = 1; ///< 1: as fine as was asked
  double least = 0;   ///< of the finite values of a layer with one real channel; least > most: there are none
  double most = -1;
  std::string message; ///< why there is nothing to see, one line; empty usually
};

/// A surface along the ray of a pixel.
struct PixelLayer
{
  std::string object; ///< its name
  std::uint32_t id = 0;
  std::uint32_t part = 0;
  std::uint32_t triangle = 0; ///< within the part
  double depth = 0;           ///< of a camera that is not linear the distance along the pixel's ray
  std::array<std::uint8_t, 3> color{};
  double opacity = 1;
};

/// A value of a pixel under a layer's specification.
struct PixelValue
{
  std::string name; ///< of the image: "correspondence_right", whose specification is called "correspondence"
  LayerSpec spec;
  std::vector<double> values; ///< the spec's channels; exact
};

/// Everything known about one pixel.
struct PixelTruth
{
  int column = 0;
  int row = 0;
  int frame = 0;
  std::string object; ///< empty: nothing is there
  std::string className;
  std::string part;
  std::uint32_t id = 0;
  std::uint32_t partId = 0;
  std::uint32_t triangle = 0;     ///< within the part
  std::vector<PixelValue> values; ///< of all liveLayers() but the draft
  std::vector<PixelLayer> layers; ///< near to far
  bool isLinear = true;           ///< the camera is: depths of `layers` are depths
  std::string message;            ///< why nothing is known
};

/// The picture of a layer, every `step` pixels. `stop` is asked between strips; the picture is empty then. Throws what
/// LiveEye throws.
DGTKLIVE_EXPORT LivePicture livePicture(const LiveQuestion& question, const std::string& layer, int step,
  ThreadPool& pool, const std::function<bool()>& stop = {});

/// Throws UsageError for a pixel outside the view, and what LiveEye throws.
DGTKLIVE_EXPORT PixelTruth pixelTruth(const LiveQuestion& question, int column, int row, ThreadPool& pool);

/// Answers questions about a scene that changes on threads of its own. Pictures come coarse first, then fine; pixels
/// do not wait for pictures. The newest question wins: one that waits is dropped, and a picture is given up at its next
/// strip once its coarse form is there. What goes wrong is an answer's message.
class DGTKLIVE_EXPORT LiveTruth
{
public:
  LiveTruth();
  /// Ends its threads; nobody is called any more.
  ~LiveTruth();

  /// `receive` is called on a thread of LiveTruth, once or more; it must not throw.
  void askPicture(LiveQuestion question, std::string layer, std::function<void(const LivePicture&)> receive);
  void askPixel(LiveQuestion question, int column, int row, std::function<void(const PixelTruth&)> receive);
  /// Until every question is answered or dropped.
  void wait();

private:
  ThreadPool Pool;
  ThreadPool Alone; ///< for pixels
  NewestTask Pictures;
  NewestTask Pixels;
};

} // namespace dgtk

#endif
