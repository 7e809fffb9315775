// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRunLog_h
#define dgtkRunLog_h

#include "dgtkRunsModule.h"

#include <QByteArray>
#include <QString>
#include <QStringList>

#include <sys/types.h>

namespace dgtk
{

/// What was asked of `dgtk render`.
struct RunRequest
{
  QString folder;        ///< of the dataset, absolute
  QStringList arguments; ///< after the word dgtk, without what is for a folder that is not empty
  QByteArray scene;      ///< hash of the scene in the window, by which a later one is known as the same
};

/// What the editor keeps of its latest run into a folder: a file in the user's data folder, which outlives window and
/// run. The first line is the request, the second the number of the process; what the program writes follows. The
/// program has the file locked while it lives: the system lets go of the lock when it ends in any way, and process
/// numbers, which are given again, would not tell.
class DGTKRUNS_EXPORT RunLog
{
public:
  enum class End
  {
    Done,
    Stopped, ///< by a signal that asks for it
    Lost,    ///< without a word: killed, or the machine went off
    Failed
  };

  /// Of the dataset's folder, whether there was a run or not.
  explicit RunLog(const QString& folder);

  /// Folders of the runs that have a log, the latest first.
  static QStringList folders();
  /// Where the scene is kept that a run has of its own. Makes the folder.
  QString sceneCopy() const;

  /// Begins a new log. Returns its descriptor, locked, for the program to write to; -1 with errno when it cannot be
  /// written, or is that of a run that goes on.
  int begin(const RunRequest& request) const;
  /// Whether its run goes on.
  bool alive() const;
  /// Reads on from where the last call ended. Returns the program's messages: lines but progress and the last word of
  /// a run that failed.
  QStringList read();
  /// Its end is known to the user.
  void markShown() const;
  void remove() const;

  // As far as it was read.
  const RunRequest& request() const { return this->Request; }
  pid_t process() const { return this->Process; } ///< 0: unknown
  int done() const { return this->Done; }         ///< pictures
  int total() const { return this->Total; }       ///< 0: not known yet
  bool shown() const { return this->Shown; }      ///< markShown() was called
  /// Of a run that does not go on.
  End end() const;
  /// The program's last line but progress, of a run that failed without "dgtk: ".
  const QString& last() const { return this->Last; }

private:
  QString folderOfLog() const;
  QString path() const;
  void take(const QString& line, QStringList& messages);

  QString Folder;
  qint64 Offset = 0;
  int Lines = 0;
  RunRequest Request;
  pid_t Process = 0;
  int Done = 0;
  int Total = 0;
  bool Shown = false;
  bool Refused = false; ///< Last begins with "dgtk: "
  QString Last;
};

} // namespace dgtk

#endif
