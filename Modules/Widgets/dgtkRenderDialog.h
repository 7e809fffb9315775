// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRenderDialog_h
#define dgtkRenderDialog_h

// Private to Widgets.

#include "dgtkEditorState.h"
#include "dgtkProgressEstimate.h"
#include "dgtkRenderProcess.h"

#include <QDialog>
#include <QElapsedTimer>

#include <memory>
#include <vector>

class QCheckBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QTabWidget;
class QTimer;
class QVBoxLayout;

namespace dgtk
{

class RenderCameras;

/// What `dgtk render` is to make of the scene, with its progress. The scene is that of the file or, when it has
/// changes, a copy of it as it is now, which stays: one for each folder, so that an interrupted run can go on.
class RenderDialog : public QDialog
{
  Q_OBJECT

public:
  RenderDialog(EditorState& state, QWidget* parent);

  /// The words after `dgtk` for a scene file.
  QStringList arguments(const QString& scene) const;
  /// Interrupts the run, and is hidden.
  void end()
  {
    this->Process.cancel();
    this->hide();
  }

signals:
  void noted(const QString& line);
  void resultAsked(const QString& folder);

protected:
  void reject() override;

private:
  QWidget* makeInfo();
  QWidget* makeControls();
  void makeRunRow(QVBoxLayout* layout);
  void refresh();
  void browse();
  /// Beside the scene's file.
  QString usualFolder() const;
  /// Whether the run may begin in the folder; asks where a dataset is there that would go.
  bool mayReplace();
  void start();
  QStringList checkedLayers() const;
  QCheckBox* layerBox(const QString& layer) const;
  /// The objects of the layer matting: those selected, until others are typed.
  void showMatte();
  /// For the next start of the program.
  void rememberChoices() const;
  void takeProgress(int done, int total);
  void showProgress();
  /// The run ends after a row of tiles or so; asked again, at once.
  void cancel();
  void finish(bool ok, bool cancelled, const QString& message);
  void setRunning(bool on);
  QString sceneFile();

  EditorState& State;
  RenderProcess Process;
  ProgressEstimate Estimate;
  QElapsedTimer Running;
  QTimer* Clock = nullptr;
  QString Pictures; ///< done of all
  QTabWidget* Tabs = nullptr;
  QLabel* Info = nullptr;
  RenderCameras* Cameras = nullptr;
  QSpinBox* Tile[2] = { nullptr, nullptr };
  QSpinBox* Frames[3] = { nullptr, nullptr, nullptr };
  std::size_t Opened = 0; ///< SceneDocument::opened() of what is shown
  int SceneRange[2] = { 0, 0 };
  QSpinBox* Samples = nullptr;
  std::vector<QCheckBox*> Layers;
  QLineEdit* Matte = nullptr;
  QLineEdit* Folder = nullptr;
  QPushButton* Browse = nullptr;
  QCheckBox* Resume = nullptr;
  QPushButton* Start = nullptr;
  QPushButton* Cancel = nullptr;
  QPushButton* Open = nullptr;
  QPushButton* Result = nullptr;
  QProgressBar* Progress = nullptr;
  QLabel* Status = nullptr;
};

} // namespace dgtk

#endif
