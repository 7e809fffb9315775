// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRenderProcess_h
#define dgtkRenderProcess_h

#include "dgtkRunLog.h"

#include <QObject>
#include <QString>
#include <QStringList>

class QTimer;

namespace dgtk
{

/// Words as a POSIX shell reads them: quoted where it would make something else of them.
QString shellLine(const QStringList& words);

/// `dgtk render` in a process that outlives the window, and how far it is: the files are those of the command line, and
/// what ends the editor ends no run. A later window follows the same run by its log.
class RenderProcess : public QObject
{
  Q_OBJECT

public:
  explicit RenderProcess(QObject* parent);
  /// A run that was cancelled is waited for; others go on.
  ~RenderProcess() override;

  /// The dgtk program beside this one, or the one that DGTK of the environment names.
  static QString program();

  /// `how`: further arguments, for a folder that is not empty.
  void start(const RunRequest& request, const QStringList& how);
  /// The latest run into that folder, which may have ended.
  void follow(const QString& folder);
  /// As Ctrl-C: what is finished stays and can be resumed. The second time the process is killed.
  void cancel();
  /// Whether cancel() was called since the start.
  bool cancelled() const { return this->Cancelled; }
  bool running() const;

signals:
  /// Several times a second.
  void progress(int done, int total);
  void line(const QString& text);
  /// `message`: the last line that the program wrote, or why there was no program.
  void finished(dgtk::RunLog::End end, const QString& message);

private:
  void look();
  void end(RunLog::End end, const QString& message);

  RunLog Log{ {} };
  QTimer* Clock;
  bool Cancelled = false;
};

} // namespace dgtk

#endif
