// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRenderDialog_h
#define dgtkRenderDialog_h

#include "dgtkEditorState.h"
#include "dgtkProgressEstimate.h"
#include "dgtkRenderProcess.h"
#include "dgtkRunFolder.h"
#include "dgtkRunsModule.h"

#include <QDialog>
#include <QElapsedTimer>

#include <vector>

class QCheckBox;
class QComboBox;
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
class RenderOptions;

/// What `dgtk render` is to make of the scene, with its progress. The scene is that of the file or, when it has
/// changes, a copy of it as it is now, which stays: one for each folder, so that an interrupted run can go on. Runs
/// outlive the window; one that was interrupted goes on as it was begun, by whichever window.
class DGTKRUNS_EXPORT RenderDialog : public QDialog
{
  Q_OBJECT

public:
  RenderDialog(EditorState& state, QWidget* parent);

  /// The words after `dgtk` for a scene file, without what is for a folder that is not empty.
  QStringList arguments(const QString& scene) const;
  bool running() const { return this->Process.running(); }
  /// "Pictures: 3 of 20"; "" before that is known.
  const QString& pictures() const { return this->Pictures; }
  /// The run ends after a row of tiles or so; asked again, at once.
  void cancel();
  /// Shows a run that goes on.
  void follow(const QString& folder);
  /// Offers the folder for the next run, unless one goes on.
  void offer(const QString& folder);

signals:
  void noted(const QString& line);
  void resultAsked(const QString& folder);
  void started(); ///< a new run, or one that goes on
  void shown();
  /// `fraction`: in [0, 1]; negative before it is known.
  void progressed(double fraction, const QString& left);
  /// `message`: what the dialog says of it.
  void ended(dgtk::RunLog::End end, const QString& message);

protected:
  void reject() override;
  void showEvent(QShowEvent* event) override;

private:
  QWidget* makeInfo();
  QWidget* makeControls();
  void makeRunRow(QVBoxLayout* layout);
  void refresh();
  void browse();
  /// What stands there: a finished dataset, a run to go on with.
  void lookAtFolder();
  /// An interrupted run, as it was begun.
  bool goesOn() const;
  /// What keeps a new run from beginning; "" for nothing.
  QString missing() const;
  RunRequest newRequest();
  void start();
  void begin();
  QStringList checkedLayers() const;
  QCheckBox* layerBox(const QString& layer) const;
  /// The names of the selected objects, for options that take objects.
  void offerSelection();
  /// For the next start of the program.
  void rememberChoices() const;
  void takeProgress(int done, int total);
  void showProgress();
  void finish(RunLog::End end, const QString& message);
  QString endText(RunLog::End end, const QString& message) const;
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
  RenderOptions* Options = nullptr;
  QComboBox* Export = nullptr; ///< that the dataset is for
  QSpinBox* Frames[3] = { nullptr, nullptr, nullptr };
  std::size_t Opened = 0; ///< SceneDocument::opened() of what is shown
  int SceneRange[2] = { 0, 0 };
  std::vector<QCheckBox*> Layers;
  QLineEdit* Folder = nullptr;
  RunFolder Found; ///< in the folder
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
