// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureLoader_h
#define dgtkPictureLoader_h

#include "dgtkBackgroundQueue.h"
#include "dgtkDatasetPoints.h"
#include "dgtkPictureColors.h"
#include "dgtkPictureOverlay.h"

#include <QObject>
#include <QString>

#include <list>
#include <memory>
#include <mutex>
#include <optional>

namespace dgtk
{

/// Which picture is wanted, and how.
struct PictureAsk
{
  PictureKey key;
  int surface = 0;                   ///< of a layered depth image
  std::optional<PictureRange> range; ///< of the colours; nothing: the picture's own
  PixelRect window;                  ///< of no width: all
  int step = 0;                      ///< 0: as fine as memory allows
  bool operator==(const PictureAsk& o) const
  {
    return this->key == o.key && this->surface == o.surface && this->range == o.range && this->window == o.window &&
           this->step == o.step;
  }
};

/// A picture that can be painted, or the line that says why not.
struct ShownPicture
{
  std::shared_ptr<const DatasetPictures> dataset;
  PictureAsk ask;
  std::shared_ptr<const PictureValues> picture; ///< null: see `error`
  PictureColors colors;
  QString error;
};
using ShownPointer = std::shared_ptr<const ShownPicture>;

/// Which points are wanted.
struct CloudAsk
{
  std::vector<std::string> cameras;
  int frame = 0;
  std::string colorLayer;
};

/// Reads a dataset, its pictures and its points in the background, and keeps what was read lately.
class PictureLoader : public QObject
{
  Q_OBJECT

public:
  explicit PictureLoader(QObject* parent);

  void open(const QString& folder);
  /// Answers by ready(); a newer question of the same pane takes the place of an older one.
  void ask(int pane, const PictureAsk& ask);
  void drop(int pane) { this->Queue.drop(pane); }
  /// Has a picture read before it is asked for.
  void prefetch(int pane, const PictureAsk& ask);
  void askCloud(const CloudAsk& ask);
  /// Without cameras: answers at once with none.
  void askOverlays(const OverlayAsk& ask);
  /// Bytes that one picture may take; larger ones are thinned out.
  void setBudget(std::uint64_t bytes) { this->Budget = bytes; }

signals:
  void opened(std::shared_ptr<const dgtk::DatasetPictures> dataset);
  void refused(const QString& message);
  void ready(int pane, dgtk::ShownPointer picture);
  void cloudReady(std::shared_ptr<const dgtk::PointCloud> cloud, const QString& error);
  /// Null where `error` says why.
  void overlaysReady(std::shared_ptr<const dgtk::FrameOverlays> overlays, const QString& error);

private:
  using DatasetPointer = std::shared_ptr<const DatasetPictures>;
  ShownPointer load(
    const DatasetPointer& dataset, const PictureAsk& ask, std::uint64_t budget, const BackgroundQueue::GoOn& goOn);
  ShownPointer find(const DatasetPointer& dataset, const PictureAsk& ask, std::shared_ptr<const PictureValues>& values);
  void keep(const ShownPointer& shown);

  DatasetPointer Dataset;
  std::uint64_t Budget = std::uint64_t(64) << 20;
  std::mutex Mutex;             ///< of what is kept
  std::list<ShownPointer> Kept; ///< the latest used first
  std::uint64_t KeptBytes = 0;
  BackgroundQueue Queue; // last: its threads end first
};

} // namespace dgtk

#endif
