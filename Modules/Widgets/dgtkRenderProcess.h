// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRenderProcess_h
#define dgtkRenderProcess_h

// Private to Widgets.

#include <QObject>
#include <QProcess>
#include <QString>
#include <QStringList>

namespace dgtk
{

/// Words as a POSIX shell reads them: quoted where it would make something else of them.
QString shellLine(const QStringList& words);

/// `dgtk render` in a process of its own: the window stays responsive, and the files are those of the command line.
class RenderProcess : public QObject
{
  Q_OBJECT

public:
  explicit RenderProcess(QObject* parent);
  /// Interrupts a run and waits for it to end.
  ~RenderProcess() override;

  /// The dgtk program beside this one, or the one that DGTK of the environment names.
  static QString program();

  /// `arguments` as after the word dgtk.
  void start(const QStringList& arguments);
  /// As Ctrl-C: what is finished stays and can be resumed. The second time the process is killed.
  void cancel();
  /// Whether cancel() was called since the start.
  bool cancelled() const { return this->Cancelled; }
  bool running() const { return this->Process.state() != QProcess::NotRunning; }

signals:
  /// Several times a second.
  void progress(int done, int total);
  void line(const QString& text);
  /// `message`: the last line that the program wrote.
  void finished(bool ok, bool cancelled, const QString& message);

private:
  void read();
  void take(const QString& text);
  void end(int code, QProcess::ExitStatus status);

  /// Gives way to the window where both want the processor, and can be interrupted from the first.
  class Renderer : public QProcess
  {
  protected:
    void setupChildProcess() override;
  };

  Renderer Process;
  QByteArray Unread;
  QString Last;
  bool Cancelled = false;
};

} // namespace dgtk

#endif
