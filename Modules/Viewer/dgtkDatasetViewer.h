// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDatasetViewer_h
#define dgtkDatasetViewer_h

#include "dgtkPictureLoader.h"
#include "dgtkViewerModule.h"

#include <QMainWindow>
#include <QTimer>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

class QAction;
class QDockWidget;
class QLabel;
class QMenu;
class QPlainTextEdit;
class QSplitter;
class QStackedWidget;
class QToolBar;

namespace dgtk
{

class CloudView;
class FrameRow;
class PaneGrid;
class PicturePane;
class PictureSync;
class ReadOut;

/// The window in which a finished dataset is looked at: pictures side by side, the numbers at a pixel, frames, and the
/// cameras and points in the world. Actions and fields have object names, by which tests find them.
class DGTKVIEWER_EXPORT DatasetViewer : public QMainWindow
{
  Q_OBJECT

public:
  explicit DatasetViewer(QWidget* parent = nullptr);
  ~DatasetViewer() override;

  /// Reads the folder of a dataset in the background; opened() or refused() follows, the latter after a dialog.
  void openFolder(const QString& folder);
  /// Null until one is open. The property "busy" is true while pictures or points are on their way.
  const DatasetPictures* dataset() const { return this->Dataset.get(); }

signals:
  void opened(const QString& folder);
  void refused(const QString& message);
  /// The window is closed.
  void left();
  /// The whole program is to end.
  void exitAsked();

protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

private:
  static constexpr int overlaySlot = -1;   ///< of what is waited for
  static constexpr int pointSlots = 1000;  ///< of the loader, above those of panes
  static constexpr int detailSlots = 2000; ///< likewise
  QAction* addAction(QMenu* menu, const QString& name, const QString& text, const QKeySequence& keys, bool tool = true);
  void makeFileMenu();
  void makeViewMenu();
  void makeFramesMenu();
  void makeCloudMenu();
  void makeHelpMenu();
  void enableActions(bool on);
  QWidget* makeEmptyPage();
  QWidget* makeCloudSide();
  void makeCalibration();
  void connectParts();

  void askOpen();
  void savePicture();
  void copyValues();
  void showDataset(const std::shared_ptr<const DatasetPictures>& dataset);
  void showRefusal(const QString& message);
  /// Whether there is no dataset, or another one in its place: then it is left, and that one opened, by and by.
  bool isLeft();
  void leaveReplaced();
  void chooseAgain();

  void chooseFirstLayers();
  void setPaneCount(int count);
  /// As many as there are of one of them, of which the other has one.
  void showPictures(const std::vector<std::string>& cameras, const std::vector<std::string>& labels);
  void layersOfOneCamera();
  void oneLayerOfCameras();
  const std::vector<PicturePane*>& panes() const;
  PicturePane* activePane() const;

  int frame() const;

  PictureAsk askOf(const PicturePane& pane, int frame) const;
  void askPane(PicturePane& pane);
  void askChosen(PicturePane* pane);
  void askAll();
  void prefetch();
  void askPoints();
  void askCloud();
  void askOverlays();
  void refreshCalibration();
  void refreshBusy();
  void receive(int slot, const ShownPointer& shown);
  void receiveOverlays(const std::shared_ptr<const FrameOverlays>& overlays, const QString& error);
  void showOverlayProblem(const QString& problem);
  void setRange(const PicturePane* pane, const std::optional<PictureRange>& range);

  void refreshReadOut();
  void refreshCloudCameras();
  std::optional<Eigen::Vector3d> worldUnder(const std::string& camera) const;

  std::shared_ptr<const DatasetPictures> Dataset;
  PictureLoader* Loader;
  PictureSync* Sync;
  std::map<std::string, PictureRange> Ranges;       ///< chosen by the user, by label
  std::map<std::string, ShownPointer> PointSources; ///< by camera
  bool IsOpening = false;                           ///< a folder that the user chose
  QString Awaited;                                  ///< the folder of a dataset that was replaced, until it is whole
  int AwaitedFrame = 0;                             ///< that was shown, from 0
  std::vector<std::pair<QString, QString>> AwaitedPanes; ///< camera and layer
  QString OverlayProblem;                                ///< that the status bar shows, or showed
  std::set<int> Pending; ///< the loader's slots whose picture of this frame is not there yet
  bool CloudFramed = false;
  bool CloudPending = false;
  QTimer CloudTimer;

  QStackedWidget* Pages = nullptr;
  QLabel* EmptyText = nullptr;
  QToolBar* Tools = nullptr;
  QSplitter* Split = nullptr;
  PaneGrid* Grid = nullptr;
  CloudView* Cloud = nullptr;
  QWidget* CloudSide = nullptr;
  QLabel* CloudText = nullptr;
  FrameRow* Frames = nullptr;
  ReadOut* Numbers = nullptr;
  QAction* AllCameras = nullptr;
  QAction* ColorByPane = nullptr;
  QAction* ShowCloud = nullptr;
  QAction* ShowBoxes = nullptr;
  QAction* ShowPoints = nullptr;
  QDockWidget* CalibrationDock = nullptr;
  QPlainTextEdit* Calibration = nullptr;
  QAction* Play = nullptr;
};

} // namespace dgtk

#endif
