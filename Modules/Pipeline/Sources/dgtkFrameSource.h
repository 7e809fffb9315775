// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFrameSource_h
#define dgtkFrameSource_h

#include "dgtkDrawnBand.h"
#include "dgtkExposures.h"
#include "dgtkMattingSource.h"
#include "dgtkPovColorSource.h"
#include "dgtkRasterSource.h"
#include "dgtkSpareVectors.h"
#include "dgtkWorkPlan.h"

#include "dgtkVisibility.h"

#include <memory>
#include <optional>
#include <string>

namespace dgtk
{

/// What is drawn, and by which engine.
struct FrameSourceOptions
{
  LayerNeeds needs;
  bool raster = false; ///< engine of the hits
  bool drawn = false;  ///< colours are OpenGL's; else they are shaded where rays hit
  int samples = 1;
  PixelFilter filter = PixelFilter::Box;
  std::string gl = "auto";
  std::optional<PovColorSettings> pov; ///< colours are POV-Ray's
};

/// What the built-in renderer has to do for a plan. Throws UsageError for an unknown filter.
FrameSourceOptions sourceOptions(const WorkPlan& plan);

/// Draws the bands of pictures with the engines that the options need. To be used from one thread: that of OpenGL.
class FrameSource
{
public:
  /// Starts OpenGL when colours or the raster engine are wanted; throws MachineError when it cannot.
  FrameSource(const FrameSourceOptions& options, ThreadPool& pool);
  ~FrameSource();

  /// The scene and view of ground truth.
  void setScene(const std::shared_ptr<const SceneState>& state, const View& view);
  /// What colours are the mean of, from now to the next setScene(); one or none: of the view itself.
  void expose(std::vector<Exposure> exposures, ExposedColor::StateAt stateAt);
  int bands() const;
  /// False where nothing is needed of a picture.
  bool drawsAnything() const;
  /// Takes a band; what needs neither OpenGL nor this source is left to DrawnBand::whole().
  using Receiver = std::function<void(std::shared_ptr<DrawnBand>)>;
  /// Draws band `row`, 0 <= row < bands(), which `receiver` gets: at once, or, while OpenGL still works on it, with the
  /// next draw() or finish(). Bands are given in the order in which they are drawn.
  void draw(int row, const Receiver& receiver);
  /// Reads and gives the band that OpenGL still works on. To be called before anything waits for what receivers do.
  void finish();
  /// Forgets that band.
  void drop() { this->Late = {}; }
  /// How OpenGL was reached, one line; empty when it is not used.
  const std::string& glDescription() const { return this->Description; }

private:
  struct Tile;
  /// Of bands that are gone.
  struct Spare
  {
    SpareVectors<Hit> hits;
    SpareVectors<float> colors;
  };
  /// A band whose colours OpenGL has not handed over yet.
  struct LateBand
  {
    std::shared_ptr<DrawnBand> band;
    std::function<void()> read;
    Receiver receiver;
  };
  std::shared_ptr<Tile> drawTile(const PixelRect& rect);
  void drawColor(const PixelRect& rect, Tile& tile);
  std::function<void()> drawBand(int row, DrawnBand& drawn);
  void drawTiles(int row, Band& band);
  /// Whether this source makes the colours.
  bool ownColor() const { return this->Options.needs.color && !this->Pov; }
  bool shadesHits() const;
  FrameSourceOptions Options;
  ThreadPool& Pool;
  std::unique_ptr<VisibilitySource> Ray; ///< of hits where no picture is made of them
  std::unique_ptr<RasterSource> Raster;
  std::unique_ptr<PictureSource> Shaded;
  PictureSource* Pictures = nullptr; ///< Raster or Shaded; null where no colours are needed
  std::unique_ptr<MattingSource> Matting;
  std::unique_ptr<PovColorSource> Pov;
  std::unique_ptr<ExposedColor> Exposed;
  std::shared_ptr<const SceneState> State;
  View TheView;
  std::unique_ptr<TileGrid> Grid;
  std::string Description;
  std::shared_ptr<Spare> Buffers = std::make_shared<Spare>(); ///< bands may outlive their source
  LateBand Late;                                              ///< the only one: nothing else remembers what is not read
};

} // namespace dgtk

#endif
