// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneFiles_h
#define dgtkSceneFiles_h

#include "dgtkSceneDocument.h"

#include <QObject>

#include <functional>
#include <string>

class QMainWindow;
class QMenu;

namespace dgtk
{

class Autosave;
class BackgroundWork;
class EditorLog;
class EditorState;
class SampleDialog;
class SceneViews;

/// What the window knows and its files ask for.
struct SceneFilesHooks
{
  std::function<CameraDescription()> cameraOfView;
  std::function<bool()> mayDiscardMore; ///< of what is no scene
};

/// Scenes and models read and written, with all that is asked about them: unsaved work, models that are not there,
/// copies that a crash left.
class SceneFiles : public QObject
{
  Q_OBJECT

public:
  SceneFiles(EditorState& state, SceneViews& views, EditorLog& log, BackgroundWork& work, QMenu& recent,
    QMainWindow& window, SceneFilesHooks hooks);

  void newScene();
  void askOpen();
  /// As MainWindow has them.
  bool openFile(const QString& path);
  bool importFile(const QString& path);
  bool saveFile(const QString& path);
  void offerRecovery();
  bool save();
  bool saveAs();
  /// The box with why a file was not written offers another one.
  bool saveElsewhere(const QString& refusal);
  void askImport();
  void exportPov();
  void askSample();
  /// Shows the dialog that draws samples of a random scene into the window.
  void sampleFile(const QString& path);
  void closeSamples();
  /// Until there are none, or nobody looks for them.
  void findMissing();
  /// False when the scene's changes are to be kept.
  bool mayDiscard();
  void addRecent(const QString& path);

signals:
  void datasetAsked(const QString& folder);

private:
  /// Offers to draw samples of a random scene, which is not opened itself. `given`: the scene that may go for them.
  void offerToSample(const QString& path, const std::string& given);
  SampleDialog& sampling();
  /// The scene is a sample, perhaps edited, that is in no file.
  bool isSample() const;
  /// As mayDiscard(), but a sample as it was drawn may go: it can be drawn again.
  bool mayReplaceBySample();
  bool showSample(LoadedScene sample);
  bool addRead(const std::string& file, const ModelLibrary& models);
  /// Lists the models that are not there and offers to look for them. True when some were found.
  bool offerToFind();
  bool findModelsBelow(const QString& folder);
  /// False, with a note, while another file is being read.
  bool isFree();
  /// Work on another thread with progress and Cancel. False when it was cancelled, or failed, after a dialog.
  bool work(const QString& what, const std::function<void(const LoadProgress&)>& work);
  void refreshRecent();

  EditorState& State;
  SceneViews& Views;
  EditorLog& Log;
  BackgroundWork& Work;
  QMenu& Recent;
  QMainWindow& Window;
  SceneFilesHooks Hooks;
  Autosave* Copies;
  SampleDialog* Samples = nullptr;
  std::size_t SampleOpened = 0; ///< SceneDocument::opened() of the sample that is shown
  std::string Discarded;        ///< the scene that the user has given up for a sample
};

} // namespace dgtk

#endif
