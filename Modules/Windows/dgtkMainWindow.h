// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMainWindow_h
#define dgtkMainWindow_h

#include "dgtkWindowsModule.h"

#include <QMainWindow>
#include <QString>
#include <QStringList>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

class QAction;
class QDockWidget;
class QMenu;

namespace dgtk
{

class BackgroundWork;
class EditorLog;
class EditorState;
class MatchDialog;
class ExportDialog;
class RenderDialog;
class RenderStatus;
class SceneClipboard;
class SceneDocument;
class SceneFiles;
class SceneViews;
class TruthView;
struct CameraDescription;

/// The desktop editor's window: four views, scene tree, properties, time line, log, menus and tool bar. Actions and
/// fields have object names, by which tests find them.
class DGTKWINDOWS_EXPORT MainWindow : public QMainWindow
{
  Q_OBJECT

public:
  /// Before the QApplication is made: OpenGL's format, sharp icons and text on dense displays.
  static void prepareApplication();
  /// After it is made: names by which settings are kept; numbers with a point.
  static void setupApplication();

  explicit MainWindow(QWidget* parent = nullptr);
  ~MainWindow() override;

  SceneDocument& document();

  /// Opens a scene (.scene, .json), after asking about unsaved work, or imports a model, by extension. The window
  /// handles events until it is read. False when it was refused, after a dialog that says why, or cancelled; the scene
  /// is then as before.
  bool openFile(const QString& path);
  bool importFile(const QString& path);
  /// Shows a finished dataset, by its folder or its manifest.json, in a window of its own.
  void openDataset(const QString& folder);
  /// The program was started to show datasets only: the window goes with the last of theirs, unless it has a scene.
  void openForDatasets() { this->IsForDatasets = true; }
  /// Asks about each copy of unsaved work that a crash left behind.
  void offerRecovery();
  /// Shows the run of an earlier window that goes on, and says how others ended since.
  void findRuns();
  /// False when it was refused.
  bool saveFile(const QString& path);

signals:
  /// The window goes for good: what belongs to it ends.
  void closed();

protected:
  void closeEvent(QCloseEvent* event) override;
  /// Past docks that lie behind the tabs of others.
  bool focusNextPrevChild(bool next) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

private:
  QAction* addAction(QMenu* menu, const QString& name, const QString& text, const QKeySequence& keys);
  void makeFileMenu();
  void makeEditMenu();
  void makeViewMenu();
  void makeToolsMenu();
  void makeHelpMenu();
  void makeDocks();
  QDockWidget* addDock(const QString& name, const QString& title, QWidget* widget);
  /// Where all are at the first start.
  void arrangeDocks();
  void resetLayout();

  void askDataset();
  void closeAfterDatasets();
  void allowFiles(bool busy);
  void addCamera();
  void addCameraArray();
  CameraDescription cameraOfView() const;
  void addLight();
  RenderDialog& rendering();
  void configureRendering();
  void exportDataset();
  /// False when the window is to stay because of a run that goes on, after asking.
  bool mayLeaveRun();
  void showCorrespondence();
  void makeItemActions(QMenu* menu);
  void refreshItemActions();
  void showContextMenu(const QPoint& global);
  void rename();
  /// What is selected, and says what goes with it.
  void remove();
  void showProperties();
  void preview();
  void refresh();
  /// What the user has arranged, from one start to the next.
  void saveSettings() const;
  void restoreSettings();
  void fail(const QString& message);
  void note(const QString& line);
  void noteReplacedModels();

  bool IsForDatasets = false;
  EditorState* State;
  SceneClipboard* Copied;
  BackgroundWork* Work = nullptr;
  SceneViews* Views = nullptr;
  TruthView* Truth = nullptr;
  SceneFiles* Files = nullptr;
  EditorLog* Log = nullptr;
  QMenu* Recent = nullptr;
  QMenu* ViewMenu = nullptr;
  RenderDialog* Rendering = nullptr;
  ExportDialog* Exporting = nullptr;
  RenderStatus* Run = nullptr;
  MatchDialog* Matching = nullptr;
};

} // namespace dgtk

#endif
