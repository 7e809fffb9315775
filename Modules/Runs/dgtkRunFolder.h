// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRunFolder_h
#define dgtkRunFolder_h

#include "dgtkRunLog.h"
#include "dgtkRunsModule.h"

#include <QCoreApplication>

#include <optional>
#include <string>

class QWidget;

namespace dgtk
{

/// The folder that a dataset is to be rendered into, and what stood there when it was looked at.
class DGTKRUNS_EXPORT RunFolder
{
  Q_DECLARE_TR_FUNCTIONS(dgtk::RunFolder)

public:
  /// How a run begins in it.
  enum class Begin
  {
    Not,
    Fresh,
    GoOn,
    Replace
  };
  /// What a user is asked before a run begins.
  enum class Question
  {
    None,
    Unfinished, ///< to go on with the run that stands there, or to replace it
    OtherScene, ///< the same of a run that is to go on, but whose scene is not this one
    Finished    ///< to replace the dataset that stands there
  };

  /// Beside the scene's file; in the home folder for a scene that has none.
  static QString usual(const std::string& scene);

  RunFolder() = default;
  /// Looks at what stands there. `typed`: absolute, or below the current folder.
  explicit RunFolder(const QString& typed);

  const QString& path() const { return this->Path; }   ///< absolute
  bool finished() const { return this->Finished; }     ///< holds a whole dataset
  bool unfinished() const { return this->Unfinished; } ///< holds an interrupted run that can go on
  bool rendering() const { return this->Rendering; }   ///< a run into it goes on that an editor began
  /// What was asked of the interrupted run, if an editor began it.
  const std::optional<RunRequest>& interrupted() const { return this->Interrupted; }
  /// What a user should know of it; "" for nothing.
  const QString& text() const { return this->Text; }

  /// `goOn`: an interrupted run is to go on, not to be replaced. `scene`: hash of the scene in the window, as in
  /// RunRequest; empty where there is none that could be meant.
  Question question(bool goOn, const QByteArray& scene) const;
  /// How a run begins there; asks the user what has to be asked.
  Begin begin(bool goOn, const QByteArray& scene, QWidget* parent) const;

private:
  static Begin askToGoOn(const QString& what, QWidget* parent);
  static Begin askToReplace(const QString& what, QWidget* parent);

  QString Path;
  bool Finished = false;
  bool Unfinished = false;
  bool Rendering = false;
  std::optional<RunRequest> Interrupted;
  QString Text;
};

} // namespace dgtk

#endif
