// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderProcess.h"

#include "dgtkDetachedProgram.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QFile>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QThread>
#include <QTimer>

#include <cerrno>
#include <csignal>
#include <cstring>

#include <unistd.h>

namespace dgtk
{

namespace
{
constexpr int longestEnd = 10000; // milliseconds
constexpr int lookEvery = 100;    // milliseconds
constexpr int waitStep = 10;      // milliseconds
constexpr const char* secondsBetweenReports = "0.5";

QList<QByteArray> encoded(const QStringList& words)
{
  QList<QByteArray> bytes;
  for (const QString& word : words)
  {
    bytes << QFile::encodeName(word);
  }
  return bytes;
}

/// This program's, and how often the run is to say how far it is.
QList<QByteArray> environmentOfRun()
{
  const QByteArray progress = "DGTK_PROGRESS=";
  QList<QByteArray> environment{ progress + secondsBetweenReports };
  for (char** at = environ; *at != nullptr; ++at)
  {
    const QByteArray variable(*at);
    if (!variable.startsWith(progress))
    {
      environment << variable;
    }
  }
  return environment;
}
} // namespace

QString shellLine(const QStringList& words)
{
  static const QRegularExpression plain("^[A-Za-z0-9_@%+=:,./-]+$");
  QStringList quoted;
  for (QString word : words)
  {
    quoted << (plain.match(word).hasMatch() ? word : '\'' + word.replace('\'', "'\\''") + '\'');
  }
  return quoted.join(' ');
}

RenderProcess::RenderProcess(QObject* parent)
  : QObject(parent)
  , Clock(new QTimer(this))
{
  connect(this->Clock, &QTimer::timeout, this, &RenderProcess::look);
}

RenderProcess::~RenderProcess()
{
  QElapsedTimer waited;
  waited.start();
  while (this->Cancelled && this->running() && this->Log.alive())
  {
    if (waited.elapsed() > longestEnd)
    {
      this->cancel();
      return;
    }
    QThread::msleep(waitStep);
  }
}

QString RenderProcess::program()
{
  const QString named = QString::fromLocal8Bit(qgetenv("DGTK"));
  const QString found = named.contains('/') ? named : QStandardPaths::findExecutable(named);
  return named.isEmpty() ? QCoreApplication::applicationDirPath() + "/dgtk" : found.isEmpty() ? named : found;
}

bool RenderProcess::running() const { return this->Clock->isActive(); }

void RenderProcess::start(const RunRequest& request, const QStringList& how)
{
  this->Log = RunLog(request.folder);
  this->Cancelled = false;
  const int log = this->Log.begin(request);
  if (log < 0)
  {
    emit this->finished(RunLog::End::Failed,
      tr("The progress of the run cannot be kept: %1").arg(QString::fromLocal8Bit(std::strerror(errno))));
    return;
  }
  const QString error =
    startDetached(encoded(QStringList(program()) + request.arguments + how), environmentOfRun(), log);
  ::close(log);
  if (!error.isEmpty())
  {
    this->end(RunLog::End::Failed, tr("%1 cannot be started: %2").arg(program(), error));
    return;
  }
  this->Clock->start(lookEvery);
  this->look();
}

void RenderProcess::follow(const QString& folder)
{
  this->Log = RunLog(folder);
  this->Cancelled = false;
  this->Clock->start(lookEvery);
  this->look();
}

void RenderProcess::cancel()
{
  if (!this->running() || this->Log.process() <= 0 || !this->Log.alive())
  {
    return;
  }
  // Two of a kind that come soon after one another are one. It leads a group, with what it has started itself.
  const bool again = this->Cancelled;
  ::kill(again ? -this->Log.process() : this->Log.process(), again ? SIGKILL : SIGINT);
  this->Cancelled = true;
}

void RenderProcess::look()
{
  const bool alive = this->Log.alive(); // before its last words are read
  for (const QString& message : this->Log.read())
  {
    emit this->line(message);
  }
  if (this->Log.total() > 0)
  {
    emit this->progress(this->Log.done(), this->Log.total());
  }
  if (!alive)
  {
    this->end(this->Log.end(), this->Log.last());
  }
}

void RenderProcess::end(RunLog::End end, const QString& message)
{
  this->Clock->stop();
  this->Log.markShown();
  emit this->finished(end, message);
}

} // namespace dgtk
